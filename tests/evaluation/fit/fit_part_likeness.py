#!/usr/bin/env python3
"""Fits PartLikenessParams (core/segmentation/part_joining.hpp): the logarithm of the odds that two parts of food that
meet are one item, by logistic regression.

Usage: part_borders CAPTURE... | fit_part_likeness.py

A capture counts as much as another, and borders within an item as much as those between two. Prints the numbers,
and how often they decide rightly on captures that were left out, a tenth at a time.
"""

import csv
import sys

import numpy as np

from logistic import fit, tell_left_out

SIGNS = ("embedding", "share")
MOST_SHARE = 0.4  # PartLikenessParams::most_share
LARGE_BLOCKS = 12  # ItemSplitParams::min_told_blocks


def read_borders(stream):
    rows = list(csv.DictReader(stream))
    captures = np.array([row["capture"] for row in rows])
    is_one = np.array([int(row["is_one"]) for row in rows])
    blocks = np.array([int(row["blocks"]) for row in rows])
    signs = np.array([[1.0, float(row["embedding"]), min(float(row["share"]), MOST_SHARE)] for row in rows])
    return captures, is_one, blocks, signs


def weigh(captures, is_one):
    weights = np.zeros(len(is_one))
    for kind in (0, 1):
        for capture in set(captures):
            own = (captures == capture) & (is_one == kind)
            if own.any():
                weights[own] = 1.0 / own.sum()
        own = is_one == kind
        weights[own] /= weights[own].sum()
    return weights


def main():
    captures, is_one, blocks, signs = read_borders(sys.stdin)

    def fit_lines(kept):
        return fit(signs[kept], is_one[kept], weigh(captures[kept], is_one[kept]))

    told = tell_left_out(captures, signs, fit_lines)
    numbers = fit_lines(np.ones(len(captures), bool))
    print(f"{len(set(captures))} captures, {len(is_one)} borders")
    print(", ".join(f"{name} {number:.2f}" for name, number in zip(("constant", *SIGNS), numbers)))
    for text, kind in (("within an item", 1), ("between two", 0)):
        own = (is_one == kind) & (blocks >= LARGE_BLOCKS)
        right = float(((told[own] > 0) == kind).mean()) if own.any() else float("nan")
        print(f"left out, parts of {LARGE_BLOCKS} blocks and more, {text}: {100.0 * right:.1f} % right of {own.sum()}")


if __name__ == "__main__":
    main()
