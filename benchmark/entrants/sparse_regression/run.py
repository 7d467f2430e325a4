#!/usr/bin/env python3
"""Sparse regression over a library of terms: sequentially thresholded least squares (STLSQ; Brunton, Proctor and Kutz, PNAS 113, 2016).

At each joint the force that the stated model leaves is written as a sum of few terms of a library. The threshold is the one of a row with
the smallest error on the validation recording; a term's confidence is the share of resampled train recordings that keep it.

Terms are chosen with the accelerations of the stated model, and fitted with the measured ones.

Usage: run.py CASE_FOLDER OUT_FOLDER
"""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from common import left_out, write_answer  # noqa: E402
from regression import Problem, at_joint, numbers_terms, sign, write_predictions  # noqa: E402

STRIDE = 10
THRESHOLDS = np.geomspace(0.01, 1.0, 13)  # shares of the force that is left, that a term must give to stay
NOISE = 1.3  # an error in units of what the sensors leave, at which nothing is left to explain
RESAMPLES, BLOCK = 30, 15  # blocks of so many rows are drawn
# kind of a term: function of one joint's position, speed, acceleration, command, rate of the command
LIBRARY = [
    ("constant_force", lambda q, v, a, u, du: 1.0 + 0.0 * q),
    ("spring", lambda q, v, a, u, du: -q),
    ("nonlinear_spring", lambda q, v, a, u, du: -q ** 2),
    ("nonlinear_spring", lambda q, v, a, u, du: -q ** 3),
    ("viscous_friction", lambda q, v, a, u, du: -v),
    ("asymmetric_friction", lambda q, v, a, u, du: -abs(v)),
    ("quadratic_drag", lambda q, v, a, u, du: -abs(v) * v),
    ("quadratic_drag", lambda q, v, a, u, du: -v ** 3),
    ("coulomb_friction", lambda q, v, a, u, du: -sign(v)),
    ("stribeck_friction", lambda q, v, a, u, du: -sign(v) * np.exp(-(v / 0.2) ** 2)),
]
DRIVEN = [
    ("torque_gain", lambda q, v, a, u, du: u),
    ("rotor_inertia", lambda q, v, a, u, du: -a),
    ("load_friction", lambda q, v, a, u, du: -abs(u) * sign(v)),
    ("actuator_delay", lambda q, v, a, u, du: -du),
]
TURNING = [("payload", lambda q, v, a, u, du: -np.sin(q)), ("gravity_tilt", lambda q, v, a, u, du: np.cos(q))]
VALUES = {"viscous_friction": "damping", "coulomb_friction": "level", "quadratic_drag": "drag", "constant_force": "force",
          "load_friction": "coefficient", "spring": "stiffness", "torque_gain": "gain", "rotor_inertia": "inertia",
          "actuator_delay": "delay"}


def library_of(problem, joint):
    """[(kind, place, term)] of one joint."""
    terms, (_, slides, *_) = list(LIBRARY), problem.chain.joints[problem.joints.index(joint)]
    terms += DRIVEN if joint in problem.case.drives else []
    terms += [] if slides else TURNING
    link = problem.chain.bodies[problem.joints.index(joint)]["name"]
    places = {"payload": link, "gravity_tilt": "base"}
    out = [(kind, places.get(kind, joint), at_joint(problem, joint, function)) for kind, function in terms]
    if joint in problem.case.drives:
        ratio = problem.drive(joint, "ratio")
        for cycles in (1, 2, 3):
            out += [("torque_ripple", joint, at_joint(problem, joint, lambda q, v, a, u, du, k=cycles * ratio: np.sin(k * q))),
                    ("torque_ripple", joint, at_joint(problem, joint, lambda q, v, a, u, du, k=cycles * ratio: np.cos(k * q)))]
    return out


def only_at(term, deviation, j):
    """A stated number's term in units of its deviation, as far as it acts on one joint."""
    def masked(problem, m):
        full = term(problem, m)
        out = np.zeros_like(full)
        out[:, j] = deviation * full[:, j]
        return out
    return masked


class Rows:
    """Columns (stated numbers first, then the library) and the force that is left at one joint, in units of what the sensors leave."""

    def __init__(self, problem, role, j, numbers, library, measured=False):
        tables = [table for _, table in problem.case.recordings(role)]
        motions, jitter = [problem.motion(table) for table in tables], np.random.default_rng(1)

        def stacked(term, motions=motions):
            return np.concatenate([problem.smoothed(term(problem, m), STRIDE)[:, j] for m in motions])

        def residual(p, m):
            return p.residual(m)

        left = stacked(residual)
        noise = np.sqrt(np.mean((stacked(residual, [problem.motion(t, jitter) for t in tables]) - left) ** 2))
        self.fixed = len(numbers)
        seen = motions if measured else [problem.modelled(m) for m in motions]
        self.columns = np.stack([stacked(term, seen) for term in numbers + [term for _, _, term in library]], axis=1) / noise
        self.left = left / noise

    def drawn(self, index):
        out = object.__new__(Rows)
        out.fixed, out.columns, out.left = self.fixed, self.columns[index], self.left[index]
        return out

    def error(self, values):
        return float(np.sqrt(np.mean((self.left - self.columns @ values) ** 2)))


def stlsq(train, threshold):
    """Least squares, with the terms left out that give less than a share of the force that is left, until nothing changes. Stated numbers
    stay, each with one row that says how well it is known."""
    size, scale = np.sqrt(np.mean(train.columns ** 2, axis=0)), np.sqrt(np.mean(train.left ** 2))
    kept = size > 1e-9 * np.max(size)
    ridge = 1e-3 * len(train.left) * np.ones(len(kept))
    values, free = np.zeros(len(kept)), np.arange(len(kept)) >= train.fixed
    for _ in range(len(kept)):
        values[:] = 0.0
        scaled = train.columns[:, kept] / size[kept]
        known = np.where(free, ridge, 1.0 / np.maximum(size, 1e-100) ** 2)[kept]
        values[kept] = np.linalg.solve(scaled.T @ scaled + np.diag(known), scaled.T @ train.left) / size[kept]
        small = kept & free & (np.abs(values) * size < threshold * scale)
        if not small.any():
            break
        kept &= ~small
    return values


def refitted(rows, solution):
    """Values of the kept terms on other columns."""
    kept, out = np.flatnonzero(solution), np.zeros_like(solution)
    chosen = rows.drawn(slice(None))
    chosen.columns, chosen.fixed = rows.columns[:, kept], int(np.sum(kept < rows.fixed))
    out[kept] = stlsq(chosen, 0.0)
    return out


def best_threshold(train, check):
    """The sparsest one whose error on the validation recording is within 5 % of the smallest, or as small as sensors leave it."""
    thresholds = list(THRESHOLDS) + [np.inf]
    errors = [check.error(stlsq(train, threshold)) for threshold in thresholds]
    near = [i for i, e in enumerate(errors) if e <= max(NOISE, 1.05 * min(errors))]
    return thresholds[near[-1]]


def resampled(train, threshold, rng):
    """How often each term is kept when blocks of rows are drawn with replacement, and how its value scatters."""
    begins, values = np.arange(0, len(train.left) - BLOCK + 1, BLOCK), []
    for _ in range(RESAMPLES):
        index = (rng.choice(begins, len(begins))[:, None] + np.arange(BLOCK)).ravel()
        values.append(stlsq(train.drawn(index), threshold))
    return np.mean(np.array(values) != 0.0, axis=0), np.std(values, axis=0)


def names_of_joint(library, columns, values, shares, spread):
    """One slot for each kind that is kept, strongest first: (strength, slot)."""
    out = {}
    strengths = np.abs(values) * np.sqrt(np.mean(columns ** 2, axis=0))
    for i, (kind, place, _) in enumerate(library):
        if values[i] == 0.0:
            continue
        strength, slot = out.get((kind, place), (0.0, {"kind": kind, "place": place, "confidence": 0.0, "values": {}}))
        slot["confidence"] = max(slot["confidence"], float(shares[i]))
        if kind in VALUES and not slot["values"]:
            value = values[i] + (1.0 if kind == "torque_gain" else 0.0)
            slot["values"] = {VALUES[kind]: {"value": float(value), "interval": [float(value - 1.96 * spread[i]),
                                                                                  float(value + 1.96 * spread[i])]}}
        out[(kind, place)] = (max(strength, strengths[i]), slot)
    return list(out.values())


def main(folder, out):
    if left_out(folder, out):
        return
    os.makedirs(out, exist_ok=True)
    problem, rng = Problem(folder), np.random.default_rng(1)
    slots, terms, values = [], [], []
    for j, joint in enumerate(problem.joints):
        library, numbers = library_of(problem, joint), [only_at(t, d, j) for t, d in numbers_terms(problem)]
        train, check = (Rows(problem, role, j, numbers, library) for role in ("train", "validation"))
        threshold, fixed = best_threshold(train, check), len(numbers)
        solution = stlsq(train, threshold)
        shares, spread = resampled(train, threshold, rng)
        slots += names_of_joint(library, train.columns[:, fixed:], solution[fixed:], shares[fixed:], spread[fixed:])
        solution = refitted(Rows(problem, "train", j, numbers, library, True), solution)
        used = [(t, x) for t, x in zip(numbers + [t for _, _, t in library], solution) if x != 0.0]
        terms += [t for t, _ in used]
        values += [x for _, x in used]
    allowed = [(s, slot) for s, slot in slots if (slot["kind"], slot["place"]) in problem.case.allowed]
    allowed.sort(key=lambda pair: -pair[0])
    write_answer(out, problem.case, "found" if allowed else "nothing", [[slot] for _, slot in allowed])
    write_predictions(problem, out, terms, values)


if __name__ == "__main__":
    main(*sys.argv[1:3])
