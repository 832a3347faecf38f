#!/usr/bin/env python3
"""Fits the numbers of FoodEvidenceParams (core/segmentation/food_evidence.hpp): the logarithm of the odds that a place of a
dish is food, by logistic regression.

Usage: food_places CAPTURE... | fit_food_evidence.py

Every capture counts alike. Where a network errs it misses all of a food, not a place here and there: it is taken to miss
MISSED of all food without a doubt, so that the other signs can speak against it. Prints the numbers; and how often they
decide wrongly on captures that were left out, a tenth at a time, beside what is decided without one of the signs.

Then the numbers about food that the network denies. It denies food of the glaze's own colour, which height alone tells: they
are fitted to places of that colour, of which half count as food, since some is known to be there. The colour's weight is
that of the numbers before.
"""

import csv
import sys

import numpy as np

from logistic import fit, tell_left_out

SIGNS = ("lift", "against", "colour", "margin")
COLOUR, MARGIN = 1 + SIGNS.index("colour"), 1 + SIGNS.index("margin")
MISSED = 0.03  # share of food
MOST_MARGIN = 4.0  # FoodEvidenceParams::most_margin
LEAST_COLOUR = -0.25  # FoodEvidenceParams::least_colour


def read_places(stream):
    rows = csv.reader(stream)
    next(rows)
    captures, is_food, signs = [], [], []
    for name, food, *values in rows:
        captures.append(name)
        is_food.append(int(food))
        signs.append([1.0, *map(float, values)])
    return np.array(captures), np.array(is_food), np.array(signs)


def weigh(captures):
    _, own, counts = np.unique(captures, return_inverse=True, return_counts=True)
    return 1.0 / counts[own] / len(counts)


def fit_places(captures, is_food, signs, used):
    """The numbers of the signs in `used`, of places some of which show food that the network misses."""
    weights = weigh(captures)
    food = is_food == 1
    missed = signs[food].copy()
    missed[:, MARGIN] = -MOST_MARGIN
    return fit(
        np.vstack([signs, missed])[:, used],
        np.concatenate([is_food, np.ones(len(missed), int)]),
        np.concatenate([np.where(food, 1.0 - MISSED, 1.0) * weights, MISSED * weights[food]]),
    )


def fit_denied(is_food, signs, weights):
    """Of the constant, lift and against, at places of one colour: what that adds is in the constant."""
    halves = [weights * (is_food == kind) / weights[is_food == kind].sum() for kind in (0, 1)]
    return fit(signs, is_food, 0.5 * (halves[0] + halves[1]))


def print_denied(captures, is_food, signs, weights, colour_weight):
    alike = signs[:, COLOUR] <= LEAST_COLOUR
    captures, is_food, signs, weights = captures[alike], is_food[alike], signs[alike, :COLOUR], weights[alike]
    constant, lift, against = fit_denied(is_food, signs, weights)
    constant -= LEAST_COLOUR * colour_weight
    print(f"denied: constant {constant:.2f}, lift {lift:.2f}, against {against:.2f}, colour {colour_weight:.2f}")
    told = tell_left_out(captures, signs, lambda kept: fit_denied(is_food[kept], signs[kept], weights[kept]))
    for kind, name, wrong in ((1, "food", told <= 0), (0, "glaze", told > 0)):
        own = is_food == kind
        print(f"left out, {name} of the glaze's colour: {100.0 * weights[own] @ wrong[own] / weights[own].sum():.1f} % wrong")


def main():
    captures, is_food, signs = read_places(sys.stdin)
    weights = weigh(captures)
    print(f"{len(set(captures))} captures, {len(is_food)} places")
    numbers = fit_places(captures, is_food, signs, list(range(1 + len(SIGNS))))
    print(", ".join(f"{name} {number:.2f}" for name, number in zip(("constant", *SIGNS), numbers)))
    for left in (None, *range(len(SIGNS))):
        used = [0] + [1 + sign for sign in range(len(SIGNS)) if sign != left]
        told = tell_left_out(
            captures, signs[:, used], lambda kept, used=used: fit_places(captures[kept], is_food[kept], signs[kept], used)
        )
        wrong = float(weights @ ((told > 0) != is_food))
        print(f"left out, {'all signs' if left is None else 'without ' + SIGNS[left]}: {100.0 * wrong:.2f} % wrong")
    print_denied(captures, is_food, signs, weights, numbers[COLOUR])


if __name__ == "__main__":
    main()
