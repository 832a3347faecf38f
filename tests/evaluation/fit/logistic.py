"""Logistic regression of signs, and what it would decide on captures that were left out."""

import numpy as np

FOLDS = 10
ROUNDS = 50
SMALL_STEP = 1e-6
RIDGE = 1e-4  # keeps the equations solvable where all is told apart


def fit(signs, is_so, weights):
    """The numbers whose sum with `signs` is the logarithm of the odds; by Newton's method. Weights sum up to one or so."""
    numbers = np.zeros(signs.shape[1])
    for _ in range(ROUNDS):
        chance = 1.0 / (1.0 + np.exp(-signs @ numbers))
        slope = signs.T @ (weights * (chance - is_so)) + RIDGE * numbers
        bend = (signs * (weights * chance * (1.0 - chance))[:, None]).T @ signs + RIDGE * np.eye(len(numbers))
        step = np.linalg.solve(bend, slope)
        numbers = numbers - step
        if np.abs(step).max() < SMALL_STEP:
            break
    return numbers


def tell_left_out(captures, signs, fit_lines):
    """Log odds of each line by a fit to other captures: a tenth of them is left out at a time. `fit_lines` gives the numbers
    of the lines that are true in what it is handed."""
    names = np.array(sorted(set(captures)))
    order = np.random.default_rng(1).permutation(len(names))
    told = np.zeros(len(captures))
    for fold in range(FOLDS):
        left_out = np.isin(captures, names[order[fold::FOLDS]])
        if left_out.any() and not left_out.all():
            told[left_out] = signs[left_out] @ fit_lines(~left_out)
    return told
