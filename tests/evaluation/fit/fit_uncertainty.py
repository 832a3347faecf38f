#!/usr/bin/env python3
"""Fits the weights of core/volume/uncertainty.hpp to the errors of rendered captures.

    tests/evaluation/fit/fit_uncertainty.py PROGRAM SET... [--held-out SET...]

Sigma's square is a sum over terms, each a weight squared times what was measured of an item. `evaluate --set` with one
weight large and the others nought tells what each weight is multiplied with. The weights are then those under which the
errors of the volumes are most likely, if an error over its sigma follows a t distribution of six degrees of freedom; all
of them are scaled alike until the median sigma is 2 % of the volume. Two numbers follow by themselves: what a found
outline adds (68 of 100 volumes move by less when outlines are found), and the share of the volume from which an item is
doubted (one in thirty). Prints the members of UncertaintyParams, and how often the truth lies within two sigma with the
program's weights and with the fitted ones: over the sets of the fit, each set left out of it, and those held out.
"""

import argparse
import csv
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

DEGREES_OF_FREEDOM = 6.0
ROUNDS = 2000
MEDIAN_SIGMA = 0.02
DOUBTED = 1.0 / 30.0
WITHIN_ONE_SIGMA = 0.6827
FITTED = ("disparity_bias_px", "height_mm", "hidden_fraction", "outline_px", "wall_mm", "filled_fraction")
FOUND = "found_outline_mm"
# Large, so that the sigmas that are written in ml to three digits are precise.
LARGE = 100.0


def estimates_of(program, captures, labels, weights):
    """The rows of estimates.csv of all foods that were measured, by what identifies them."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "evaluate", captures, "--runs", "1", "--out", folder]
        if labels:
            command += ["--labels", labels]
        for name, value in weights.items():
            command += ["--set", f"uncertainty.{name}={value}"]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        table = Path(folder) / "estimates.csv"
        if not table.exists():
            sys.exit(f"{' '.join(command)}: no estimates.csv was written: {done.stderr.strip()}")
        with table.open(encoding="utf-8") as rows:
            return {
                (row["capture"], row["first"], row["second"], row["label"]): row
                for row in csv.DictReader(rows)
                if row["kind"] == "heightfield" and row["status"] == "ok"
            }


def program_weights(program):
    """The defaults, as the program lists them."""
    listed = subprocess.run([program, "evaluate", "--parameters"], capture_output=True, text=True, check=True).stdout
    words = [line.split()[0] for line in listed.splitlines() if line.startswith("uncertainty.")]
    return {name.removeprefix("uncertainty."): float(value) for name, value in (word.split("=") for word in words)}


class Volumes:
    """A set's volumes with their errors, the factors of each weight squared, and the rest of sigma squared, in ml."""

    def __init__(self, program, captures):
        self.name = Path(captures).name
        nought = dict.fromkeys((*FITTED, FOUND), 0.0)
        rest = estimates_of(program, captures, None, nought)
        keys = sorted(rest)
        self.volumes = [float(rest[key]["volume_ml"]) for key in keys]
        self.errors = [float(rest[key]["volume_ml"]) - float(rest[key]["truth_ml"]) for key in keys]
        self.rest = [float(rest[key]["sigma_ml"]) ** 2 for key in keys]
        columns = []
        for name in FITTED:
            rows = estimates_of(program, captures, None, {**nought, name: LARGE})
            columns.append([(float(rows[key]["sigma_ml"]) ** 2 - r) / LARGE**2 for key, r in zip(keys, self.rest)])
        self.factors = [[max(value, 0.0) for value in row] for row in zip(*columns)]
        found = estimates_of(program, captures, "auto", {**nought, FOUND: LARGE})
        without = estimates_of(program, captures, "auto", nought)
        self.moves = [
            abs(float(found[key]["volume_ml"]) - float(rest[key]["volume_ml"])) / step
            for key in keys
            if key in found and (step := outline_step(found[key], without[key])) > 0.0
        ]

    def variances(self, squares):
        return [r + sum(s * f for s, f in zip(squares, row)) for r, row in zip(self.rest, self.factors)]


def outline_step(with_outline, without):
    """What a millimetre of outline is in ml."""
    square = float(with_outline["sigma_ml"]) ** 2 - float(without["sigma_ml"]) ** 2
    return math.sqrt(max(square, 0.0)) / LARGE


def fit(sets, start):
    """Squares of the weights: variance components of a scale mixture, by multiplicative steps that keep them >= 0."""
    rows = [(e * e, r, f) for s in sets for e, r, f in zip(s.errors, s.rest, s.factors)]
    squares = [value**2 for value in start]
    for _ in range(ROUNDS):
        above, below = [0.0] * len(squares), [0.0] * len(squares)
        for square, rest, factors in rows:
            variance = rest + sum(s * f for s, f in zip(squares, factors))
            if variance <= 0.0:
                continue
            mixed = (DEGREES_OF_FREEDOM + 1.0) / (DEGREES_OF_FREEDOM + square / variance)
            for k, factor in enumerate(factors):
                above[k] += mixed * square * factor / variance**2
                below[k] += factor / variance
        squares = [s * math.sqrt(a / b) if b > 0.0 else 0.0 for s, a, b in zip(squares, above, below)]
    return scaled(sets, squares)


def relative_sigmas(sets, squares):
    return [math.sqrt(v) / volume for s in sets for v, volume in zip(s.variances(squares), s.volumes)]


def scaled(sets, squares):
    """Alike, until the median sigma is what is promised; what the cameras leave open stays."""
    low, high = 0.0, 100.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if statistics.median(relative_sigmas(sets, [middle * s for s in squares])) < MEDIAN_SIGMA:
            low = middle
        else:
            high = middle
    return [low * s for s in squares]


def describe(sets, squares):
    inside = [e * e <= 4.0 * v for s in sets for e, v in zip(s.errors, s.variances(squares))]
    median = 100.0 * statistics.median(relative_sigmas(sets, squares))
    return f"{100.0 * sum(inside) / len(inside):5.1f} % of {len(inside)} in two sigma, median {median:.2f} %"


def quantile(values, share):
    ordered = sorted(values)
    return ordered[min(int(share * len(ordered)), len(ordered) - 1)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("sets", nargs="+")
    parser.add_argument("--held-out", nargs="+", default=[])
    arguments = parser.parse_args()
    defaults = program_weights(arguments.program)
    start = [defaults[name] for name in FITTED]
    used = [Volumes(arguments.program, captures) for captures in arguments.sets]
    held = [Volumes(arguments.program, captures) for captures in arguments.held_out]
    squares = fit(used, start)
    for name, square in zip(FITTED, squares):
        print(f"  double {name} = {math.sqrt(square):.3f};  // the program has {defaults[name]:g}")
    found = quantile([move for s in used for move in s.moves], WITHIN_ONE_SIGMA)
    print(f"  double {FOUND} = {found:.2f};  // the program has {defaults[FOUND]:g}")
    now = [value**2 for value in start]
    doubted = quantile(relative_sigmas(used, now), 1.0 - DOUBTED)
    print(f"one volume in thirty has a sigma beyond {doubted:.4f} of it with the program's weights")
    print(f"{'fitted to':28}program {describe(used, now)}; fit {describe(used, squares)}")
    for left_out in used if len(used) > 1 else []:
        others = fit([s for s in used if s is not left_out], start)
        print(f"{left_out.name + ', left out':28}program {describe([left_out], now)}; fit {describe([left_out], others)}")
    for s in held:
        print(f"{s.name + ', held out':28}program {describe([s], now)}; fit {describe([s], squares)}")


if __name__ == "__main__":
    main()
