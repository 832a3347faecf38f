#!/usr/bin/env python3
"""Weights that drew the errors are found again, and all that is scaled keeps its promise."""

import math
import random
import statistics
import sys
import unittest

import fit_uncertainty

WEIGHTS = [0.03, 0.15, 0.2, 0.7, 0.2, 0.3]


class DrawnVolumes(fit_uncertainty.Volumes):
    """Volumes whose errors follow the weights; in each item one term leads, so that the errors tell the terms apart."""

    def __init__(self, seed, count):
        random.seed(seed)
        self.name = "drawn"
        self.volumes = [random.uniform(50.0, 250.0) for _ in range(count)]
        self.rest = [random.uniform(0.0, 0.1) for _ in range(count)]
        self.factors = []
        for index, volume in enumerate(self.volumes):
            shares = [1.0 if term == index % len(WEIGHTS) else random.uniform(0.02, 0.3) for term in range(len(WEIGHTS))]
            self.factors.append([(volume * 0.03 / weight * share) ** 2 for weight, share in zip(WEIGHTS, shares)])
        self.errors = []
        for variance in self.variances([weight**2 for weight in WEIGHTS]):
            freedom = fit_uncertainty.DEGREES_OF_FREEDOM
            chi_square = random.gammavariate(0.5 * freedom, 2.0)
            self.errors.append(math.sqrt(variance * freedom / chi_square) * random.gauss(0.0, 1.0))


class FitUncertainty(unittest.TestCase):
    def setUp(self):
        self.seed = int(sys.argv[1]) if len(sys.argv) > 1 else random.randrange(1 << 30)
        fit_uncertainty.ROUNDS = 300

    def test_finds_the_weights_that_drew_the_errors(self):
        drawn = DrawnVolumes(self.seed, 1500)
        squares = fit_uncertainty.fit([drawn], [1.0] * len(WEIGHTS))
        ratios = [math.sqrt(square) / weight for square, weight in zip(squares, WEIGHTS)]
        middle = statistics.median(ratios)
        for ratio in ratios:
            # Of 250 errors each weight is known to 6 % (150 seeds): a factor of 1.5 is six sigma.
            self.assertLess(abs(math.log(ratio / middle)), math.log(1.5), f"seed {self.seed}: {ratios}")

    def test_scales_to_the_median_that_is_promised(self):
        drawn = DrawnVolumes(self.seed, 200)
        squares = fit_uncertainty.scaled([drawn], [weight**2 for weight in WEIGHTS])
        median = statistics.median(fit_uncertainty.relative_sigmas([drawn], squares))
        self.assertAlmostEqual(median, fit_uncertainty.MEDIAN_SIGMA, places=6, msg=f"seed {self.seed}")

    def test_drops_a_term_that_no_error_follows(self):
        drawn = DrawnVolumes(self.seed, 400)
        drawn.errors = [0.02 * volume * random.gauss(0.0, 1.0) for volume in drawn.volumes]
        drawn.factors = [[volume**2, 1.0 / volume**2, 0.0, 0.0, 0.0, 0.0] for volume in drawn.volumes]
        squares = fit_uncertainty.fit([drawn], [1.0] * len(WEIGHTS))
        self.assertAlmostEqual(math.sqrt(squares[0]), 0.02, delta=0.003, msg=f"seed {self.seed}")
        self.assertEqual(squares[2], 0.0, f"seed {self.seed}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
