#!/usr/bin/env python3
"""Checks that manual pages and completion have every command and option that the programs' own --help lists.

manual_test.py BUILD_FOLDER
"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
manual = build / "manual"
problems = []


def say(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def listed(help_text):
    """Commands and options of a help."""
    commands = []
    section = ""
    for line in help_text.splitlines():
        if re.match(r"^\S.*:$", line):
            section = line.lower()
        found = re.match(r"^  ([a-z][a-z-]*)", line)
        if found and section.startswith("subcommands"):
            commands.append(found.group(1))
    names = [name for line in re.findall(r"(?m)^  (-\S+)", help_text) for name in line.split(",")]
    return commands, sorted(names)


def walk(program, words=()):
    """(words, options, whether commands follow) of each command, by the program's help."""
    commands, options = listed(say(str(build / program), *words, "--help"))
    yield words, options, commands
    for command in commands:
        yield from walk(program, (*words, command))


def plain(page):
    """A page's text as troff's escapes mean it."""
    text = re.sub(r"\\f[BIRP]", "", gzip.open(page, "rt").read())
    return text.replace("\\-", "-").replace("\\&", "").replace("\\e", "\\")


def section_of(page, heading):
    found = re.search(rf'^\.SS "{re.escape(heading)}"\n(.*?)(?=^\.S[SH] )', page, re.MULTILINE | re.DOTALL)
    return found.group(1) if found else None


def complete(program, *typed):
    script = f'source "{manual}/{program}.bash"; COMP_WORDS=({program} {" ".join(typed)} ""); COMP_CWORD={len(typed) + 1}; '
    function = "_" + program.replace("-", "_")
    words = say("bash", "-c", "compopt() { :; }; " + script + function + ' 2>&1; echo "${COMPREPLY[@]}"').split()
    last = script.replace('"")', "-)")
    options = say("bash", "-c", "compopt() { :; }; " + last + function + ' 2>&1; echo "${COMPREPLY[@]}"').split()
    return words, options


def check(program):
    page = plain(manual / f"{program}.1.gz")
    count = 0
    for words, options, commands in walk(program):
        count += 1
        completed, completed_options = complete(program, *words)
        if commands and sorted(completed) != sorted(commands):
            problems.append(f"{program} {words}: completed as {completed}, there are {commands}")
        if set(completed_options) != set(options):
            problems.append(f"{program} {words}: options completed as {completed_options}, there are {options}")
        if commands:
            continue
        section = section_of(page, " ".join((program, *words)))
        if section is None:
            problems.append(f"{program}.1 has no section on {' '.join(words)}")
            continue
        for option in set(options) - {"-h"}:
            if not re.search(rf"^(.*, )?{option}(,| |$)", section, re.MULTILINE):
                problems.append(f"{program}.1 does not tell {' '.join(words)} {option}")
    return count


commands = check("traygauge") + check("traygauge-simulate")
if commands < 20:
    problems.append(f"only {commands} commands were found: this test sees nothing")
# A sentence of the help stands in the page.
if "Seed of the random samples" not in plain(manual / "traygauge.1.gz"):
    problems.append("the help's sentences are not in the page")
if shutil.which("man"):
    for page in manual.glob("*.1.gz"):
        told = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page], capture_output=True, text=True,
                              env={"MANWIDTH": "80", "PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"})
        if told.stderr.strip():
            problems.append(f"{page.name}: {told.stderr.strip()}")
changes = gzip.open(manual / "changelog.gz", "rt").read()
if not re.match(r"^traygauge \([0-9.]+~deb[0-9]+\) stable; urgency=medium\n\n  \* ", changes):
    problems.append("changelog.gz is not in Debian's form:\n" + changes[:200])
print("\n".join(problems) or f"{commands} commands are in manual and completion")
sys.exit(bool(problems))
