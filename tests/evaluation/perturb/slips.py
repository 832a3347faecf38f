#!/usr/bin/env python3
"""What a measurement makes of captures in which something slipped between the pictures, or whose card does not lie flat.

    build/traygauge-simulate render slips-10 --seed 71 --reduced --out slips
    build/traygauge-simulate render cards-8 --seed 71 --reduced --out cards
    tests/evaluation/perturb/slips.py build/traygauge slips cards --labels auto

Measures every pair and prints, by what is wrong and how much, how many were refused, left a dish or an item out,
were warned of by name, gave the sum of all food within 10 %, were wrong with a warning that a volume may be far off,
or were wrong in silence.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys

CARD = 255
FIRST_FOOD, LAST_FOOD = 2, 199
NAMED = {"dish_moved", "item_moved", "scale_disagrees", "card_lifted", "card_not_flat", "dish_differs"}
UNSURE = {"item_hardly_matched", "item_uncertain"}
FAR_OFF = 0.10  # of the sum
OUTCOMES = ["refused", "left out", "warned", "right", "unsure", "silent"]


def kind_of(truth, view):
    if truth.get("card_tilt_deg"):
        return "card leans, degrees", truth["card_tilt_deg"]
    if truth.get("card_curl_mm"):
        return "card bent, mm", truth["card_curl_mm"]
    if not truth["displaced"][view]:
        return "nothing", 0.0
    slip = truth["displaced"][view][0]
    length_mm = round((slip["shift_mm"][0] ** 2 + slip["shift_mm"][1] ** 2) ** 0.5, 1)
    if slip["label"] == CARD:
        return "card slipped, mm", length_mm
    return ("food slipped, mm" if FIRST_FOOD <= slip["label"] <= LAST_FOOD else "dish slipped, mm"), length_mm


def outcome_of(document, truth_ml):
    if document["status"] not in ("ok", "partial"):
        return "refused"
    if any(item["status"] != "ok" for item in document["items"]):
        return "left out"
    warnings = {warning["code"] for warning in document["warnings"]}
    if NAMED & warnings:
        return "warned"
    measured_ml = sum(item["volume_ml"] for item in document["items"])
    if abs(measured_ml / truth_ml - 1.0) <= FAR_OFF:
        return "right"
    return "unsure" if UNSURE & warnings else "silent"


def measure(program, folder, pair, labels):
    command = [program, "measure", str(folder), "--pair", f"{pair[0]},{pair[1]}", "--labels", labels, "--json"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode > 1:
        sys.exit(result.stderr)
    return json.loads(result.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program traygauge")
    parser.add_argument("captures", type=pathlib.Path, nargs="+", help="folders of captures of the sets slips-10, cards-8")
    parser.add_argument("--labels", choices=["given", "auto"], default="auto")
    options = parser.parse_args()
    counts = collections.defaultdict(collections.Counter)
    for folder in sorted(path.parent for folder in options.captures for path in folder.glob("*/truth.json")):
        truth = json.loads((folder / "truth.json").read_text())
        truth_ml = sum(item["volume_ml"] for item in truth["items"])
        for pair in json.loads((folder / "capture.json").read_text())["pairs"]:
            document = measure(options.program, folder, pair, options.labels)
            counts[kind_of(truth, pair[1])][outcome_of(document, truth_ml)] += 1
    if not counts:
        sys.exit("no captures; render some with traygauge-simulate render slips-10")
    print(f"{'what':19} {'much':>5} " + " ".join(f"{name:>9}" for name in OUTCOMES))
    for (kind, amount), of_kind in sorted(counts.items()):
        print(f"{kind:19} {amount:5.1f} " + " ".join(f"{of_kind[name]:9d}" for name in OUTCOMES))


if __name__ == "__main__":
    main()
