"""A covariance matrix adaptation evolution strategy for few unknowns.

N. Hansen, The CMA Evolution Strategy: A Tutorial, arXiv:1604.00772, with its standard constants: weighted recombination of the better half,
cumulative step size, rank-one and rank-mu update of the covariance. Unknowns are in units of their scales; the search begins at zero.
"""

import numpy as np


class Cma:
    def __init__(self, size, population, step, rng):
        self.size, self.rng = size, rng
        self.mean, self.step, self.covariance = np.zeros(size), step, np.eye(size)
        self.path_step, self.path_covariance, self.count = np.zeros(size), np.zeros(size), 0
        half = population // 2
        weights = np.log(half + 0.5) - np.log(np.arange(1, half + 1))
        self.population, self.weights = population, weights / weights.sum()
        self.mass = 1.0 / np.sum(self.weights ** 2)
        n, m = size, self.mass
        self.c_step = (m + 2.0) / (n + m + 5.0)
        self.damping = 1.0 + 2.0 * max(0.0, np.sqrt((m - 1.0) / (n + 1.0)) - 1.0) + self.c_step
        self.c_path = (4.0 + m / n) / (n + 4.0 + 2.0 * m / n)
        self.c_one = 2.0 / ((n + 1.3) ** 2 + m)
        self.c_mu = min(1.0 - self.c_one, 2.0 * (m - 2.0 + 1.0 / m) / ((n + 2.0) ** 2 + m))
        self.length = np.sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n ** 2))  # of a normal vector, mean
        self.best, self.best_loss = np.zeros(size), np.inf

    def ask(self):
        """Rows of unknowns."""
        values, vectors = np.linalg.eigh(self.covariance)
        self.root = vectors * np.sqrt(np.maximum(values, 1e-20))
        self.back = vectors / np.sqrt(np.maximum(values, 1e-20)) @ vectors.T
        self.asked = self.mean + self.step * self.rng.normal(size=(self.population, self.size)) @ self.root.T
        return self.asked

    def tell(self, losses):
        order = np.argsort(losses)
        if losses[order[0]] < self.best_loss:
            self.best, self.best_loss = self.asked[order[0]].copy(), float(losses[order[0]])
        steps = (self.asked[order[:len(self.weights)]] - self.mean) / self.step
        move = self.weights @ steps
        self.mean, self.count = self.mean + self.step * move, self.count + 1
        self.path_step = (1.0 - self.c_step) * self.path_step + np.sqrt(self.c_step * (2.0 - self.c_step) * self.mass) * self.back @ move
        norm = np.linalg.norm(self.path_step)
        held = norm / np.sqrt(1.0 - (1.0 - self.c_step) ** (2 * self.count)) < (1.4 + 2.0 / (self.size + 1.0)) * self.length
        self.path_covariance = ((1.0 - self.c_path) * self.path_covariance
                                + held * np.sqrt(self.c_path * (2.0 - self.c_path) * self.mass) * move)
        self.covariance = ((1.0 - self.c_one - self.c_mu) * self.covariance
                           + self.c_one * np.outer(self.path_covariance, self.path_covariance)
                           + self.c_mu * (steps.T * self.weights) @ steps)
        self.step *= np.exp(min(1.0, self.c_step / self.damping * (norm / self.length - 1.0)))
