#!/usr/bin/env python3
"""Ordinary least squares on the equations of motion: which friction, inertia, spring or gain explains the force that is left?

Terms are taken one after the other while the Bayesian information criterion (BIC) falls. The stated numbers move beside them, within what
is stated of them. Train recordings decide values and terms; the validation recording decides whether they explain what is left.

Usage: run.py CASE_FOLDER OUT_FOLDER
"""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from common import left_out, write_answer  # noqa: E402
from regression import Problem, at_joint, numbers_terms, of_body, sign, write_predictions  # noqa: E402

STRIDE = 20  # samples; neighbours within the smoothing window say the same
MOST = 4  # terms
DECISIVE = 10.0  # by so much a term must lower the BIC: very strong evidence by Kass and Raftery, J. Am. Statistical Association 90, 1995
PLAUSIBLE = 0.05  # weight beside the best from which a rival is named


def candidates(problem):
    """{(kind, place): [terms]}; the values of a term are those of the benchmark where a name is given."""
    out = {}
    for joint in problem.joints:
        def term(function, joint=joint):
            return at_joint(problem, joint, function)
        one, position = term(lambda q, v, a, u, du: 1.0 + 0.0 * q), term(lambda q, v, a, u, du: -q)
        dry = term(lambda q, v, a, u, du: -sign(v))
        out |= {("viscous_friction", joint): [("damping", term(lambda q, v, a, u, du: -v))],
                ("coulomb_friction", joint): [("level", dry)],
                ("asymmetric_friction", joint): [("level", dry), ("difference", term(lambda q, v, a, u, du: -sign(v) ** 2))],
                ("quadratic_drag", joint): [("drag", term(lambda q, v, a, u, du: -abs(v) * v))],
                ("constant_force", joint): [("force", one)],
                ("spring", joint): [("stiffness", position), ("", one)]}
        if joint in problem.case.drives:
            out |= {("load_friction", joint): [("coefficient", term(lambda q, v, a, u, du: -abs(u) * sign(v)))],
                    ("torque_gain", joint): [("gain", term(lambda q, v, a, u, du: u))],
                    ("rotor_inertia", joint): [("inertia", term(lambda q, v, a, u, du: -a))],
                    ("actuator_delay", joint): [("delay", term(lambda q, v, a, u, du: -du))]}
    for body in problem.chain.bodies:
        name, tip = body["name"], [0.0, 0.0, -1.0]
        heavier = [("mass", of_body(problem.chain.changed(name, mass=1.0)))]
        if ("center_of_mass", name) in problem.case.allowed:
            # A unit of mass at 1 m, less the inertia that goes with it: the moment alone; and the inertia alone.
            shifted = problem.chain.changed(name, mass=1.0, moment=tip, inertia=-1.0)
            out[("payload", name)] = [("", of_body(shifted)), ("", of_body(problem.chain.changed(name, inertia=1.0)))]
            if body is not problem.chain.bodies[0]:  # mass at the first joint does nothing
                out[("payload", name)] += heavier
            out[("center_of_mass", name)] = [("", of_body(shifted))]
        else:
            out[("payload", name)] = heavier
    for place in {foot.get("place", foot["name"]) for foot in problem.case.about["feet"]}:
        for change in ("stiffness", "damping", "friction", "height"):
            out[(f"ground_{change}", place)] = [
                ("height" if change == "height" else "scale", lambda p, m, c=change, at=place: p.ground(m, c, at))]
    return {name: terms for name, terms in out.items() if name in problem.case.allowed}


class Fit:
    """Least squares on all recordings of a role with the stated numbers' priors; columns are scaled by the noise of each joint. With
    measured=False the terms see the accelerations that the stated model has for the motion."""

    def __init__(self, problem, role, measured):
        self.problem = problem
        self.motions = [problem.motion(table) for _, table in problem.case.recordings(role)]
        self.left = self.stack(lambda p, m: p.residual(m))
        jitter = np.random.default_rng(1)
        shaken = [problem.motion(table, jitter) for _, table in problem.case.recordings(role)]
        noise = np.vstack([problem.smoothed(problem.residual(m), STRIDE) for m in shaken]) - self.left
        self.noise = np.sqrt(np.mean(noise ** 2, axis=0))
        self.motions = self.motions if measured else [problem.modelled(m) for m in self.motions]
        numbers = numbers_terms(problem)
        self.fixed = np.stack([self.column(term) * deviation for term, deviation in numbers], axis=1)
        self.number_terms = [(term, deviation) for term, deviation in numbers]

    def stack(self, term):
        return np.vstack([self.problem.smoothed(term(self.problem, m), STRIDE) for m in self.motions])

    def column(self, term):
        return (self.stack(term) / self.noise).ravel()

    def solve(self, columns, scale=1.0):
        """Values of (stated numbers in deviations, terms), the squared error and the inverse of the normal matrix."""
        a = np.column_stack([self.fixed] + columns) if columns else self.fixed
        fixed = self.fixed.shape[1]
        prior = np.zeros(a.shape[1])
        prior[:fixed] = scale ** 2
        y = (self.left / self.noise).ravel()
        size = np.maximum(np.sqrt(np.sum(a ** 2, axis=0)), 1e-12)
        normal = (a.T @ a + np.diag(prior)) / np.outer(size, size) + 1e-12 * np.eye(a.shape[1])
        inverse = np.linalg.inv(normal) / np.outer(size, size)
        values = inverse @ (a.T @ y)
        return values, float(np.sum((y - a @ values) ** 2) + np.sum(prior * values ** 2)), inverse

    def bic(self, columns):
        error, count = self.solve(columns)[1], self.left.size
        return count * np.log(error / count) + len(columns) * np.log(count)


def select(fit, library):
    """Names in the order in which they were taken, while the BIC falls decisively."""
    columns = {name: [fit.column(term) for _, term in terms] for name, terms in library.items()}

    def bic(names):
        return fit.bic([c for n in names for c in columns[n]])

    taken = []
    while len(taken) < MOST:
        name = min((n for n in library if n not in taken), key=lambda n: bic(taken + [n]))
        if bic(taken + [name]) >= bic(taken) - DECISIVE:
            break
        taken = exchanged(taken + [name], library, bic)
    for name in list(taken):  # one that the later ones make superfluous
        rest = [n for n in taken if n != name]
        if bic(rest) <= bic(taken) + DECISIVE:
            taken = rest
    return taken, columns


def exchanged(taken, library, bic):
    """Each name gives way to another one that is better in its place."""
    for i in range(len(taken)):
        rest = taken[:i] + taken[i + 1:]
        best = min((n for n in library if n not in rest), key=lambda n: bic(rest + [n]))
        taken = taken[:i] + [best] + taken[i + 1:]
    return taken


def weights(fit, taken, name, columns):
    """Weights exp(-BIC / 2) of a name, of each rival in its place, and of nothing in its place."""
    rest = [n for n in taken if n != name]
    scores = {n: fit.bic([c for m in rest + [n] for c in columns[m]]) for n in columns if n not in rest}
    scores[None] = fit.bic([c for m in rest for c in columns[m]])
    lowest = min(scores.values())
    raw = {n: np.exp(-0.5 * (s - lowest)) for n, s in scores.items()}
    total = sum(raw.values())
    return {n: float(w / total) for n, w in raw.items()}


def left_over(problem, taken, library, values, numbers):
    """Error on the validation recording, in units of the noise."""
    check, terms = Fit(problem, "validation", True), [term for name in taken for _, term in library[name]]
    left = check.left - sum(x * d * check.stack(t) for x, (t, d) in zip(numbers, check.number_terms))
    left = left - sum((x * check.stack(t) for x, t in zip(values, terms)), np.zeros_like(left))
    return float(np.sqrt(np.mean((left / check.noise) ** 2)))


def slot(fit, taken, name, columns, library, values, errors):
    shares = weights(fit, taken, name, columns)
    order = sorted((n for n in shares if n and (n == name or shares[n] > PLAUSIBLE)), key=lambda n: (n != name, -shares[n]))
    names = [{"kind": n[0], "place": n[1], "confidence": shares[n]} for n in order[:3]]
    at = sum(len(library[n]) for n in taken[:taken.index(name)])
    stated = {}
    for i, (label, _) in enumerate(library[name]):
        if label:
            value, half = values[at + i] + (1.0 if label in ("gain", "scale") else 0.0), 1.96 * errors[at + i]
            stated[label] = {"value": float(value), "interval": [float(value - half), float(value + half)]}
    names[0]["values"] = stated
    return names


def main(folder, out):
    if left_out(folder, out):
        return
    os.makedirs(out, exist_ok=True)
    problem = Problem(folder)
    fit, final, library = Fit(problem, "train", False), Fit(problem, "train", True), candidates(problem)
    taken, columns = select(fit, library)
    solution, error, inverse = final.solve([final.column(term) for n in taken for _, term in library[n]])
    fixed = fit.fixed.shape[1]
    numbers, values = solution[:fixed], solution[fixed:]
    errors = np.sqrt(np.diag(inverse)[fixed:] * max(1.0, error / fit.left.size))
    found = [slot(fit, taken, name, columns, library, values, errors) for name in taken]
    after = left_over(problem, taken, library, values, numbers)
    before = float(np.sqrt(fit.solve([])[1] / fit.left.size))
    verdict = "nothing" if not taken else "found" if after < max(3.0, 0.5 * before) else "outside"
    write_answer(out, problem.case, verdict, found)
    terms = [lambda p, m, t=t, d=d: d * t(p, m) for t, d in fit.number_terms] + [t for n in taken for _, t in library[n]]
    write_predictions(problem, out, terms, list(numbers) + list(values))


if __name__ == "__main__":
    main(*sys.argv[1:3])
