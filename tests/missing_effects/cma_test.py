"""The strategy of the entrant cma_search on functions whose least value is known."""

import os
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "benchmark", "entrants", "cma_search"))
from cma import Cma  # noqa: E402


def least(function, size, population, generations):
    strategy = Cma(size, population, 1.0, np.random.default_rng(2))
    for _ in range(generations):
        strategy.tell(np.array([function(x) for x in strategy.ask()]))
    return strategy


class Strategy(unittest.TestCase):
    def test_a_turned_ellipsoid(self):
        """Axes a hundred times as long as others, turned: only an adapted covariance gets there."""
        turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        target = np.array([1.0, -2.0, 0.5])
        found = least(lambda x: np.sum(np.array([1.0, 1e2, 1e4]) * (turn @ (x - target)) ** 2), 3, 8, 250)
        self.assertLess(found.best_loss, 1e-8)
        self.assertLess(np.max(np.abs(found.best - target)), 1e-3)

    def test_one_unknown(self):
        found = least(lambda x: abs(x[0] - 0.7), 1, 6, 40)
        self.assertAlmostEqual(found.best[0], 0.7, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
