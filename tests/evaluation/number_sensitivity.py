#!/usr/bin/env python3
"""What each number in core does to the result: halved and doubled, one at a time.

    tests/evaluation/number_sensitivity.py instrument COPY
    tests/evaluation/number_sensitivity.py measure PROGRAM SET [--labels auto] [--only PREFIX]... > rows.tsv
    tests/evaluation/number_sensitivity.py try PROGRAM SET [--labels auto] "NAME=VALUE,NAME*FACTOR"...

`instrument` rewrites the sources in a copy of the tree, so that each floating-point constant and each member of a
parameter struct (as count_numbers.py finds them) is looked up in the environment variable TUNE at run time, and writes
COPY/numbers.tsv. Build `traygauge` there with TRAYGAUGE_WERROR=OFF. What has to be known at compile time stays as it is:
such a number must be listed in COPY/fixed.txt, a name a line. `measure` prints a row a number: MAPE and refusals of the
foods as it is, with half of it and with twice of it ("=" where every volume and sigma is the same to the last digit,
"-" where the number was never read). `try` does the same for given values, and says by how much a volume
changes at most.
"""

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import count_numbers

APART = ("paper", "enrolment", "food rules")
MEMBER = re.compile(r"^(\s*)((?:std::)?(?:u?int\d*(?:_t)?|size_t|unsigned|float|double))\s+(\w+)\s*=\s*([^;]+);(.*)$")
CONSTANT = re.compile(r"^(\s*)((?:inline |static )*)const(?:expr)? (float|double)\s+(\w+)\s*=\s*([^;]+);(.*)$")
LOOK_UP = """#pragma once
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>
namespace traygauge {
struct TunedNumbers {
  struct Number { char name[128]; char sign; double value; bool was_read; };
  Number numbers[16];
  int count = 0;
  TunedNumbers() {
    const char* text = std::getenv("TUNE");
    for (; text != nullptr && *text != 0 && count < 16; ++count) {
      const std::size_t length = std::strcspn(text, "=*");
      Number& number = numbers[count];
      std::memcpy(number.name, text, length);
      number.name[length] = 0;
      number.sign = text[length];
      char* end = nullptr;
      number.value = std::strtod(text + length + 1, &end);
      number.was_read = false;
      text = *end == ',' ? end + 1 : end;
    }
  }
};
inline TunedNumbers& tuned_numbers() { static TunedNumbers numbers; return numbers; }
template <class T> T tuned_now(const char* name, T value) {
  TunedNumbers& list = tuned_numbers();
  for (int i = 0; i < list.count; ++i) {
    TunedNumbers::Number& number = list.numbers[i];
    if (std::strcmp(number.name, name) != 0) continue;
    if (!number.was_read) std::fprintf(stderr, "TUNED %s\\n", name);
    number.was_read = true;
    const double tuned = number.sign == '=' ? number.value : static_cast<double>(value) * number.value;
    return static_cast<T>(std::is_integral_v<T> ? tuned + (tuned < 0 ? -0.5 : 0.5) : tuned);
  }
  return value;
}
template <class T> constexpr T tuned(const char* name, T value) {
  if (std::is_constant_evaluated()) return value;
  return tuned_now<T>(name, value);
}
}
"""


def statement_at(lines, index):
    """The constant that begins in a line, joined, and the line that it ends in."""
    text, last = lines[index], index
    while ";" not in text.split("//")[0] and last + 1 < len(lines):
        last += 1
        text = text.split("//")[0] + " " + lines[last].strip()
    return text, last


def rewritten(kind, lines, index, stem, fixed, is_header):
    """(name, value) of the number in a line, which is replaced; None where it stays."""
    if kind == "parameters":
        member = MEMBER.match(lines[index])
        if not member or f"{stem}.{member[3]}" in fixed:
            return None
        space, type_name, name, value, rest = member.groups()
        lines[index] = f'{space}{type_name} {name} = tuned<{type_name}>("{stem}.{name}", static_cast<{type_name}>({value}));{rest}'
        return f"{stem}.{name}", value
    text, last = statement_at(lines, index)
    constant = CONSTANT.match(text)
    if not constant or f"{stem}.{constant[4]}" in fixed:
        return None
    space, storage, type_name, name, value, rest = constant.groups()
    if "static" in storage:
        storage = "static inline " if space and is_header else ""
    lines[index] = f'{space}{storage}const {type_name} {name} = tuned_now<{type_name}>("{stem}.{name}", static_cast<{type_name}>({value}));{rest}'
    for extra in range(index + 1, last + 1):
        lines[extra] = ""
    return f"{stem}.{name}", value


def instrument(copy):
    fixed_file = copy / "fixed.txt"
    fixed = set(fixed_file.read_text(encoding="utf-8").split()) if fixed_file.exists() else set()
    rows = []
    for path in sorted((copy / "core").rglob("*.[ch]pp")):
        place = path.relative_to(copy)
        numbers = [
            (kind, line)
            for kind, line, text in count_numbers.numbers_of(path)
            if kind in ("parameters", "constants") and count_numbers.group_of(place, text) not in APART
        ]
        lines = path.read_text(encoding="utf-8").split("\n")
        found = [rewritten(kind, lines, line - 1, path.stem, fixed, path.suffix == ".hpp") for kind, line in numbers]
        found = [number for number in found if number]
        if not found:
            continue
        rows += [f"{name}\t{place}\t{value}" for name, value in found]
        first = next(i for i, line in enumerate(lines) if line.startswith(("#include", "#pragma")))
        lines.insert(first + lines[first].startswith("#pragma"), '#include "core/base/tuned.hpp"')
        path.write_text("\n".join(lines), encoding="utf-8")
    (copy / "core/base/tuned.hpp").write_text(LOOK_UP, encoding="utf-8")
    (copy / "numbers.tsv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    print(f"{len(rows)} numbers")


def measure(program, captures, labels, tune):
    """MAPE %, bias %, refusals, the volumes' columns, and whether the number was read."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "evaluate", captures, "--runs", "1", "--jobs", "1", "--out", folder]
        command += ["--labels", labels] if labels else []
        done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "TUNE": tune})
        summary = Path(folder) / "summary.json"
        if not summary.exists():
            return None
        foods = json.loads(summary.read_text(encoding="utf-8"))["groups"]["foods"]
        with (Path(folder) / "estimates.csv").open(encoding="utf-8") as rows:
            volumes = [(row["volume_ml"], row["sigma_ml"], row["status"]) for row in csv.DictReader(rows)]
        return foods["mape_percent"], foods["bias_percent"], foods["refused"], volumes, "TUNED" in done.stderr


def largest_change_ml(base, result):
    """Of the volumes that both have, which are in the same order."""
    pairs = [(float(a[0]), float(b[0])) for a, b in zip(base[3], result[3]) if a[0] and b[0]]
    return max((abs(a - b) for a, b in pairs), default=0.0)


def cell(base, result):
    if result is None:
        return "failed"
    if not result[4]:
        return "-"
    if result[3] == base[3]:
        return "="
    refused = f", {result[2] - base[2]:+d} refused" if result[2] != base[2] else ""
    return (f"{result[0]:.3f}" if result[0] is not None else "none") + refused


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("instrument", "measure", "try"))
    parser.add_argument("place", help="copy of the tree, or program")
    parser.add_argument("captures", nargs="?")
    parser.add_argument("tunes", nargs="*")
    parser.add_argument("--labels", default="")
    parser.add_argument("--numbers", help="numbers.tsv of the copy", default="numbers.tsv")
    parser.add_argument("--only", action="append", default=[], help="names that begin so")
    arguments = parser.parse_args()
    if arguments.what == "instrument":
        return instrument(Path(arguments.place))
    base = measure(arguments.place, arguments.captures, arguments.labels, "")
    if base is None:
        sys.exit(f"{arguments.captures} could not be measured by {arguments.place}")
    print(f"as it is\t{base[0]:.3f}, bias {base[1]:+.3f}, {base[2]} refused", flush=True)
    if arguments.what == "try":
        for tune in arguments.tunes:
            result = measure(arguments.place, arguments.captures, arguments.labels, tune)
            change = f"\tup to {largest_change_ml(base, result):.3f} ml" if result else ""
            print(f"{tune}\t{cell(base, result)}{change}", flush=True)
        return None
    for line in Path(arguments.numbers).read_text(encoding="utf-8").splitlines():
        name, _, value = line.split("\t")
        if arguments.only and not name.startswith(tuple(arguments.only)):
            continue
        cells = [cell(base, measure(arguments.place, arguments.captures, arguments.labels, f"{name}*{f}")) for f in (0.5, 2)]
        print(f"{name}\t{value}\t" + "\t".join(cells), flush=True)
    return None


if __name__ == "__main__":
    main()
