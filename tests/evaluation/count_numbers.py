#!/usr/bin/env python3
"""Counts the numbers in core that somebody chose, by folder.

    tests/evaluation/count_numbers.py [--list] [ROOT]

Three kinds are counted. A parameter is a numeric member with a default in a struct whose name ends in Params, Setup,
Size or Limits. A constant is a constexpr or const of numeric type whose value is written down. A literal is any other
number in the code beside the trivial ones (0, 1, 2, 4, 0.5 and the like). A constant or parameter that is computed from
others with trivial numbers alone is derived: it follows from what is
counted already. Tables of directions, of 0 and 1 alone, are not counted. --list prints each number.
"""

import re
import sys
from collections import Counter
from pathlib import Path

HINT = re.compile(r"\b(items|weakest_border|border_step|likeness_step|most_likeness|doubtful_likeness) = ")
FOOD = re.compile(r"segmentation/(food_parts|part_joining|item_split|tv_segmentation|food_evidence|standing_food|glaze)|pipeline/segmenter_hint")
APART = ("paper", "enrolment")
KINDS = ("parameters", "constants", "derived", "literals")
TYPE = r"(?:std::)?(?:u?int(?:\d+_t)?|size_t|ptrdiff_t|unsigned|long|float|double|auto|array<[^;={]*>|[A-Z]\w*)"
STRUCT = re.compile(r"\b(?:struct|class)\s+(?:alignas\(\w+\)\s+)?(\w+)[^;()]*\{")
PARAMETER_STRUCT = re.compile(r"(Params|Setup|Size|Limits)$")
MEMBER = re.compile(r"^\s*(?:std::)?(?:u?int\d*(?:_t)?|size_t|unsigned|float|double)\s+(\w+)\s*(?:=\s*([^;]+)|\{([^;}]*)\});")
CONSTANT = re.compile(
    r"^\s*(?:inline |static )*const(?:expr)?(?: inline| static)* " + TYPE + r"\s+(\w+)(?:\[[^\]]*\])?\s*(?:=\s*|(?=[{(]))([^;]*)"
)
NUMBER = re.compile(r"(?<![\w.])(?:0x[\da-fA-F']+|\d[\d']*\.?\d*(?:[eE][-+]?\d+)?|\.\d+)(?:[uUlLfFzZ]*)(?![\w.])")
TRIVIAL = {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}
WRITTEN = re.compile(r"^[-+*/()<>\s\d.'eExXa-fA-FuUlLzZ]+$")


def value_of(text):
    text = text.replace("'", "").rstrip("uUlLzZ")
    if text.lower().startswith("0x"):
        return float(int(text, 16))
    return float(text.rstrip("fF"))


def code_of(path):
    """The text without comments and strings, with its line ends."""
    text = path.read_text(encoding="utf-8")
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|#include[^\n]*", blank, text, flags=re.S)


def odd_numbers(text):
    return [number for number in NUMBER.findall(text) if value_of(number) not in TRIVIAL]


def is_derived(text):
    """Whether a value follows from other names: it has some, and only trivial numbers beside them."""
    names = re.findall(r"\b[A-Za-z_]\w*", NUMBER.sub(" ", re.sub(r"\b(std|sqrt|static_cast|sizeof|int|double|float|size_t)\b|U'", " ", text)))
    return bool(names) and not odd_numbers(text)


def is_table_of_directions(text):
    return "{" in text and {value_of(number) for number in NUMBER.findall(text)} <= {0.0, 1.0} and "," in text


def statements(code):
    """The lines of the code, each joined with the following ones up to its end where it begins a constant."""
    lines = code.split("\n")
    index = 0
    while index < len(lines):
        line, first = lines[index], index
        if CONSTANT.match(line) or MEMBER.match(line + ";"):
            while ";" not in line and index + 1 < len(lines):
                index += 1
                line += " " + lines[index].strip()
        yield first + 1, line
        index += 1


def numbers_of(path):
    """(kind, line, text) of each number of a file."""
    depth, structs = 0, []
    for line_number, line in statements(code_of(path)):
        struct = STRUCT.search(line)
        if struct:
            structs.append((depth, struct.group(1)))
        in_parameters = bool(structs) and PARAMETER_STRUCT.search(structs[-1][1]) and depth == structs[-1][0] + 1
        member, constant = MEMBER.match(line), CONSTANT.match(line)
        if in_parameters and member:
            value = (member.group(2) or member.group(3) or "").strip()
            yield ("derived" if is_derived(value) else "parameters"), line_number, line.strip()
        elif constant and is_table_of_directions(constant.group(2)):
            pass
        elif constant and (re.match(r"k[A-Z]", constant.group(1)) or WRITTEN.match(constant.group(2))) and NUMBER.search(constant.group(2)):
            value = constant.group(2)
            yield ("derived" if is_derived(value) else "constants"), line_number, line.strip()
        else:
            for _ in odd_numbers(line):
                yield "literals", line_number, line.strip()
        depth += line.count("{") - line.count("}")
        while structs and depth <= structs[-1][0]:
            structs.pop()


def group_of(path, text):
    if path.parts[1] in APART:
        return path.parts[1]
    is_hint = path.name == "segmenter_params.hpp" and HINT.search(text)
    return "food rules" if FOOD.search(str(path)) or is_hint else path.parts[1]


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--list"]
    root = Path(arguments[0] if arguments else ".")
    counts = {}
    for path in sorted((root / "core").rglob("*.[ch]pp")):
        place = path.relative_to(root)
        for kind, line, text in numbers_of(path):
            counts.setdefault(group_of(place, text), Counter())[kind] += 1
            if "--list" in sys.argv:
                print(f"{kind}\t{place}:{line}\t{text}")
    print(f"{'':16}" + "".join(f"{kind:>12}" for kind in KINDS))
    total = Counter()
    apart = ("food rules",) + APART
    for group in sorted(set(counts) - set(apart)):
        total += counts[group]
        print(f"{group:16}" + "".join(f"{counts[group][kind]:12}" for kind in KINDS))
    print(f"{'core':16}" + "".join(f"{total[kind]:12}" for kind in KINDS))
    print(f"{'parameters and constants':28}{total['parameters'] + total['constants']}")
    print("apart:")
    for group in apart:
        print(f"{group:16}" + "".join(f"{counts.get(group, Counter())[kind]:12}" for kind in KINDS))


if __name__ == "__main__":
    main()
