#!/usr/bin/env python3
"""Writes manual pages and the shell's completion from what the programs say of themselves.

write_manual.py --programs FOLDER --changelog CHANGELOG.md --package-version VERSION --out FOLDER [--emulator COMMAND]

Each program prints its commands and options by `--describe` (firmware/command/program.cpp), with the sentences of its
`--help`. The date of a page is that of the newest release in the changelog, so that a page is the same whenever it is made. The changelog is written anew in the form of Debian's.
"""
import argparse
import datetime
import gzip
import pathlib
import re
import subprocess
import textwrap

# Which program has the options of a command of `traygauge`, and what it puts before the words that it tells.
SIBLINGS = {"calibrate": ("traygauge-calibrate", "calibrate"), "card": ("traygauge-card", ""), "hub": ("traygauge-hub", ""),
            "collect": ("traygauge-collect", "")}

MAINTAINER = "The Traygauge authors <traygauge@users.noreply.github.com>"
EXIT_STATUS = [
    ("0", "Measured, or done; of some items only, where the status is partial."),
    ("1", "Not measurable, or a check failed: the output says why."),
    ("2", "Wrong use, unreadable input, or output that could not be written: one line says what to do."),
]
FILES = [
    ("/etc/traygauge/station.toml", "The station's devices, lens, card, and where results go; it explains every key."),
    ("/var/lib/traygauge/station", "Results that wait for the hub, and the number of the last scan."),
    ("/var/lib/traygauge/hub", "The hub's store of results."),
    ("/usr/share/traygauge/config/dishes", "The dishes that are known, unless a folder dishes lies beside the station file."),
    ("/usr/share/traygauge/config/network", "The network that tells which food is one item, and its model card."),
]
DEMO = """traygauge\\-demo starts a hub and a simulated station, which plays two recorded trays again and again until Ctrl\\-C. It
prints the volumes, and the address of the page that shows them. Results go to a folder that is removed at the end."""


class Option:
    def __init__(self, fields):
        names, self.kind, need, self.default, self.variable, self.text = fields
        self.names = names.split(",")
        self.required = need == "required"


class Command:
    def __init__(self, words, text):
        self.words, self.text, self.options = words, text, []


def read_description(lines):
    """The commands of a program by their words, in the order in which it tells them; the program itself is ''."""
    commands = {}
    for line in lines:
        kind, words, *fields = line.split("\t")
        if kind == "command":
            commands[words] = Command(words, *fields)
        else:
            commands[words].options.append(Option(fields))
    return commands


def describe(program, emulator):
    said = subprocess.run([*emulator, program, "--describe"], check=True, capture_output=True, text=True)
    return read_description(said.stdout.splitlines())


def describe_traygauge(folder, emulator):
    commands = {}
    for words, command in describe(folder / "traygauge", emulator).items():
        if words not in SIBLINGS:
            commands[words] = command
            continue
        name, prefix = SIBLINGS[words]
        for own, part in describe(folder / name, emulator).items():
            if own or prefix:
                part.words = " ".join(word for word in (prefix, own) if word)
                part.text = part.text if own else command.text
                commands[part.words] = part
    return commands


def escape(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r"^([.'])", r"\\&\1", text)
    return text.replace("°", "\\[de]").replace("±", "\\[+\\-]").replace("…", "...")


def placeholder(option):
    return "N" if re.fullmatch(r"-?[0-9.]+", option.default) else "VALUE"


def option_lines(option):
    if option.kind == "argument":
        head = f"\\fI{escape(option.names[0])}\\fR"
    else:
        head = ", ".join(f"\\fB{escape(name)}\\fR" for name in option.names)
        if option.kind == "value":
            head += f" \\fI{placeholder(option)}\\fR"
    more = ""
    if option.default:
        more += f" Default: {option.default}."
    if option.variable:
        more += f" The variable {option.variable} counts where it is not given."
    sentence = option.text if option.text.endswith(".") else option.text + "."
    return [".TP", head, escape(sentence + more)]


def synopsis(program, command):
    line = f".B {escape(program)}" + (f" {escape(command.words)}" if command.words else "")
    parts = ["[\\fIOPTIONS\\fR]"]
    for option in command.options:
        if option.kind == "argument":
            parts.append(f"\\fI{escape(option.names[0])}\\fR")
        elif option.required:
            parts.append(f"\\fB{escape(option.names[-1])}\\fR \\fI{placeholder(option)}\\fR")
    return [line, " ".join(parts), ".br"]


def is_group(command, commands):
    return any(words.startswith(command.words + " ") for words in commands) if command.words else True


def manual_page(program, commands, release, see_also):
    version, date = release
    whole = commands[""]
    text = whole.text.rstrip(".").removeprefix(program.capitalize() + " ")
    lines = [f'.TH {escape(program.upper())} 1 "{date}" "traygauge {version}" "Traygauge"', ".SH NAME",
             f"{escape(program)} \\- {escape(text[0].lower() + text[1:])}", ".SH SYNOPSIS"]
    leaves = [command for command in commands.values() if not is_group(command, commands)]
    for command in leaves:
        lines += synopsis(program, command)
    lines += [".SH DESCRIPTION", escape(whole.text), ".SH OPTIONS"]
    for option in whole.options:
        lines += option_lines(option)
    lines.append(".SH COMMANDS")
    for command in leaves:
        lines += [f'.SS "{escape(program)} {escape(command.words)}"', escape(command.text.rstrip(".") + ".")]
        for option in command.options:
            lines += option_lines(option)
    lines.append(".SH EXIT STATUS")
    for status, meaning in EXIT_STATUS:
        lines += [".TP", f".B {status}", escape(meaning)]
    if program == "traygauge":
        lines.append(".SH FILES")
        for name, meaning in FILES:
            lines += [".TP", f".I {escape(name)}", escape(meaning)]
    lines += [".SH SEE ALSO", ", ".join(f".BR {escape(name)} (1)" if i == 0 else f"{escape(name)}(1)"
                                          for i, name in enumerate(see_also))]
    return "\n".join(lines) + "\n"


def demo_page(release):
    version, date = release
    return "\n".join([
        f'.TH TRAYGAUGE\\-DEMO 1 "{date}" "traygauge {version}" "Traygauge"', ".SH NAME",
        "traygauge\\-demo \\- play recorded trays on a simulated station", ".SH SYNOPSIS", ".B traygauge\\-demo",
        ".SH DESCRIPTION", DEMO, ".SH ENVIRONMENT", ".TP", ".B DEMO_SCANS", "End after so many trays.", ".TP",
        ".B DEMO_LISTEN", "Where the page is served. Default: 127.0.0.1:8080.", ".SH SEE ALSO", ".BR traygauge (1)"]) + "\n"


def completion(program, commands):
    """Words of commands, then their options; what takes a value or is an argument is completed as a file's name."""
    function = "_" + program.replace("-", "_")
    lines = [f"# Completion of {program} for bash; made by firmware/manual/write_manual.py.", f"{function}() {{",
             "  local word=${COMP_WORDS[COMP_CWORD]} typed= i", "  COMPREPLY=()",
             "  for ((i = 1; i < COMP_CWORD; ++i)); do", "    case \"${typed:+$typed }${COMP_WORDS[i]}\" in"]
    words = [command.words for command in commands.values() if command.words]
    lines += [f"      {'|'.join(shell_pattern(word) for word in words)}) typed=${{typed:+$typed }}${{COMP_WORDS[i]}} ;;",
              "      *) break ;;", "    esac", "  done", "  local commands= options="]
    lines.append('  case "$typed" in')
    for command in commands.values():
        depth = command.words.count(" ") + 2 if command.words else 1
        below = [word.split(" ")[-1] for word in words
                 if word.startswith(command.words + " " if command.words else "") and word.count(" ") + 1 == depth]
        options = [name for option in command.options if option.kind != "argument" for name in option.names]
        lines.append(f"    '{command.words}') commands='{' '.join(below)}' options='{' '.join(options)}' ;;")
    lines += ["  esac", '  if [[ $word == -* ]]; then', '    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")',
              '  elif [[ -n $commands ]]; then', '    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")', "  else",
              "    compopt -o filenames", '    mapfile -t COMPREPLY < <(compgen -f -- "$word")', "  fi", "}",
              f"complete -F {function} {program}"]
    return "\n".join(lines) + "\n"


def shell_pattern(word):
    return "'" + word + "'"


def releases(changelog):
    """(version, date, text) of each, the newest first."""
    parts = re.split(r"^## \[([0-9.]+)\] - (\d{4}-\d{2}-\d{2})$", changelog.read_text(), flags=re.MULTILINE)
    if len(parts) < 4:
        raise SystemExit(f"{changelog}: expected a line such as '## [0.1.0] - 2026-11-28', found none")
    return list(zip(parts[1::3], parts[2::3], parts[3::3]))


def debian_changelog(entries, package_version):
    """Debian's form; `package_version` is that of the newest release, such as 0.1.0~deb12."""
    suffix = package_version.removeprefix(entries[0][0])
    text = ""
    for version, date, changes in entries:
        points = re.findall(r"^- (.*(?:\n  .*)*)", changes, re.MULTILINE)
        day = datetime.date.fromisoformat(date).strftime("%a, %d %b %Y")
        lines = ["  * " + "\n    ".join(textwrap.wrap(" ".join(point.split()), 74)) for point in points] or ["  * See CHANGELOG.md."]
        text += f"traygauge ({version}{suffix}) stable; urgency=medium\n\n" + "\n".join(lines) + \
            f"\n\n -- {MAINTAINER}  {day} 00:00:00 +0000\n\n"
    return text


def write_compressed(path, text):
    with path.open("wb") as file:
        with gzip.GzipFile(filename="", mode="wb", compresslevel=9, fileobj=file, mtime=0) as packed:
            packed.write(text.encode())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", type=pathlib.Path, required=True)
    parser.add_argument("--changelog", type=pathlib.Path, required=True)
    parser.add_argument("--package-version", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--emulator", default="", help="what runs programs of another processor; its words separated by ;")
    options = parser.parse_args()
    emulator = [word for word in options.emulator.split(";") if word]
    entries = releases(options.changelog)
    release = entries[0][:2]
    options.out.mkdir(parents=True, exist_ok=True)
    traygauge = describe_traygauge(options.programs, emulator)
    simulate = describe(options.programs / "traygauge-simulate", emulator)
    write_compressed(options.out / "traygauge.1.gz", manual_page("traygauge", traygauge, release, ["systemctl"]))
    write_compressed(options.out / "traygauge-simulate.1.gz", manual_page("traygauge-simulate", simulate, release, ["traygauge"]))
    write_compressed(options.out / "traygauge-demo.1.gz", demo_page(release))
    write_compressed(options.out / "changelog.gz", debian_changelog(entries, options.package_version))
    (options.out / "traygauge.bash").write_text(completion("traygauge", traygauge))
    (options.out / "traygauge-simulate.bash").write_text(completion("traygauge-simulate", simulate))


if __name__ == "__main__":
    main()
