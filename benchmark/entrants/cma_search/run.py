#!/usr/bin/env python3
"""A search over effects by prediction: every candidate effect is put into the simulated rigid bodies, a CMA-ES finds its values on windows of
the train recordings, and the candidate that predicts windows of the validation recording best is taken; then once more on top of it.

Stated numbers and the states at which windows begin move along to first order: what they can explain of a window's error is taken off it
(linear least squares on sensitivities of the stated model, no number beyond two deviations). Half of the candidates are dropped
each few generations. No constants were chosen on cases of seed 2026.

Usage: run.py CASE_FOLDER OUT_FOLDER
"""

import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from candidates import candidates  # noqa: E402
from cma import Cma  # noqa: E402
from common import left_out, write_answer, write_prediction  # noqa: E402
from regression import Motion, Problem, numbers_terms  # noqa: E402

SECONDS = 0.2  # of a window
TRAIN_WINDOWS, CHECK_WINDOWS = 12, 12
POPULATION, GENERATIONS, HALVE = 6, 24, 6
ROUNDS = ((0.5, 1.0), (0.8, 0.5))  # share of the time at which a round ends, share of the generations
BETTER = 0.9  # an effect is taken if the validation error falls below this share of what it was
ENOUGH = 1.3  # an error in units of what sensors leave, below which nothing is asked
PLAUSIBLE = 0.05
FARTHEST = 2.0  # deviations of a stated number: case.json's are cut there


class Windows:
    """Pieces of recordings of a role, and what of a prediction's error neither their beginnings nor the stated numbers explain."""

    def __init__(self, problem, role, count, rng):
        self.problem, self.length = problem, max(20, round(SECONDS / problem.case.period))
        tables = [table for _, table in problem.case.recordings(role)]
        self.starts, self.commands, self.measured = [], [], []
        for k in range(count):
            table = tables[k % len(tables)]
            positions, self.floors = problem.raw_positions(table)
            m, offset = problem.motion(table), problem.light + 1
            i = int(rng.integers(0, len(m.q) - self.length))
            self.starts.append(np.concatenate([m.q[i], m.v[i]]))
            self.commands.append((table, i + offset))
            self.measured.append(positions[i + offset:i + offset + self.length])
        self.starts, self.measured = np.array(self.starts), np.array(self.measured)
        self.count = count
        self.free = self._free()

    def _free(self):
        """Per window an orthonormal basis of what its beginning does; sensitivities to the stated numbers without it; their solver."""
        n, tiny = len(self.problem.joints), 1.0e-5
        base = self.predicted([])
        begin = []
        for i in range(2 * n):
            shifted = self.starts.copy()
            shifted[:, i] += tiny
            begin.append((self.predicted([], shifted) - base) / tiny / self.floors)
        basis = np.stack([b.reshape(self.count, -1) for b in begin], axis=2)
        basis = np.linalg.qr(basis)[0]
        numbers = []
        for term, deviation in numbers_terms(self.problem):
            if deviation > 0.0:
                moved = self.predicted([(lambda p, m, x, t=term: x[:, :1] * t(p, m), np.full((self.count, 1), deviation))])
                numbers.append(self.without(((moved - base) / self.floors).reshape(self.count, -1), basis).ravel())
        sensitivity = np.array(numbers).T if numbers else np.zeros((base.size, 0))
        sensitivity = np.nan_to_num(sensitivity, posinf=0.0, neginf=0.0)
        return basis, sensitivity, sensitivity.T @ sensitivity + np.eye(sensitivity.shape[1])

    @staticmethod
    def without(errors, basis):
        return errors - np.einsum("wtk,wk->wt", basis, np.einsum("wtk,wt->wk", basis, errors))

    def predicted(self, effects, starts=None):
        """Positions of all windows, (window, sample, joint). effects: [(force, values by window)]."""
        return simulate(self.problem, self.starts if starts is None else starts, self.command_rows([(None, None)]),
                        [(slice(None), force, values) for force, values in effects]).reshape(self.count, self.length, -1)

    def command_rows(self, changes):
        """Forces commanded, (row, sample, joint): all windows for each change of the commands (function, values)."""
        out = []
        for change, values in changes:
            for table, begin in self.commands:
                out.append(commands_of(self.problem, table, change, values)[begin:begin + self.length])
        return np.array(out)

    def losses(self, members):
        """Root mean square errors of members: [(effects, change of commands)], each effect (force, values)."""
        rows = self.command_rows([change for _, change in members])
        effects = []
        for i, (mine, _) in enumerate(members):
            part = slice(i * self.count, (i + 1) * self.count)
            effects += [(part, force, np.tile(values, (self.count, 1))) for force, values in mine]
        positions = simulate(self.problem, np.tile(self.starts, (len(members), 1)), rows, merged(effects))
        return np.array([self.loss(p) for p in positions.reshape(len(members), self.count, self.length, -1)])

    def loss(self, positions):
        basis, sensitivity, normal = self.free
        errors = ((self.measured - positions) / self.floors).reshape(self.count, -1)
        if not np.all(np.isfinite(errors)):
            return 1.0e6
        left = self.without(errors, basis).ravel()
        numbers = bounded(normal, sensitivity.T @ left)
        return float(np.sqrt((np.sum((left - sensitivity @ numbers) ** 2) + np.sum(numbers ** 2)) / left.size))


def bounded(normal, right):
    """Least squares of the stated numbers, in deviations, none beyond FARTHEST: those that want farther stay there, the others follow."""
    values, held = np.zeros(len(right)), np.zeros(len(right), bool)
    for _ in range(len(right)):
        free = ~held
        values[free] = np.linalg.solve(normal[np.ix_(free, free)], right[free] - normal[np.ix_(free, held)] @ values[held])
        beyond = free & (np.abs(values) > FARTHEST)
        if not beyond.any():
            break
        worst = int(np.argmax(np.where(beyond, np.abs(values), 0.0)))
        values[worst], held[worst] = np.copysign(FARTHEST, values[worst]), True
    return np.clip(values, -FARTHEST, FARTHEST)


def merged(effects):
    """Effects of one force on neighbouring rows, together: one evaluation instead of many."""
    out = []
    for part, force, values in effects:
        if out and out[-1][1] is force and out[-1][0].stop == part.start:
            out[-1] = (slice(out[-1][0].start, part.stop), force, np.vstack([out[-1][2], values]))
        else:
            out.append((part, force, values))
    return out


def commands_of(problem, table, change=None, values=None):
    rows = np.stack([table[f"u_{j}"] * problem.drive(j, "ratio") if f"u_{j}" in table else np.zeros(len(table["t"]))
                     for j in problem.joints], axis=1)
    return change(problem, rows, values) if change else rows


def simulate(problem, starts, commands, effects):
    """Positions (row, sample, joint) from rows of starts (q, v) and commands (row, sample, joint), by the midpoint rule."""
    n, (rows, samples, _) = len(problem.joints), commands.shape
    substeps = 2 if problem.case.about["feet"] else 1
    h, y = problem.case.period / substeps, starts.copy()
    out = np.empty((rows, samples, n))
    basis = np.repeat(np.vstack([np.zeros(n), np.eye(n)])[:, None, :], rows, axis=1)

    def rates(y, u):
        def wide(x):
            return np.broadcast_to(x, (n + 1, rows, n))
        m = Motion(*(wide(x).reshape(-1, n) for x in (y[:, :n], y[:, n:])), basis.reshape(-1, n), wide(u).reshape(-1, n), np.zeros(((n + 1) * rows, n)), None)
        force = problem.residual(m).reshape(n + 1, rows, n)
        for part, term, values in effects:
            mine = Motion(*(x.reshape(n + 1, rows, n)[:, part].reshape(-1, n) for x in (m.q, m.v, m.a, m.u, m.du)), None)
            force[:, part] -= term(problem, mine, np.tile(values, (n + 1, 1))).reshape(n + 1, -1, n)
        mass = np.moveaxis(force[1:] - force[0], 0, 2)
        acceleration = np.linalg.solve(mass, -force[0][:, :, None])[:, :, 0]
        return np.concatenate([y[:, n:], np.clip(acceleration, -1e6, 1e6)], axis=1)

    with np.errstate(all="ignore"):
        for k in range(samples):
            out[:, k] = y[:, :n]
            for _ in range(substeps):
                y = y + h * rates(y + 0.5 * h * rates(y, commands[:, k]), commands[:, k])
                y = np.clip(np.nan_to_num(y, nan=1e6), -1e6, 1e6)
    return out


def member(candidate, unknowns, taken):
    """(effects, change of commands) of a candidate with some values on top of what was taken."""
    effects, change = [(c.force, v) for c, v in taken if c.force], next(((c.command, v) for c, v in taken if c.command), (None, None))
    if candidate:
        values = candidate.values(unknowns)
        effects += [(candidate.force, values)] if candidate.force else []
        change = (candidate.command, values) if candidate.command else change
    return effects, change


def search(train, library, taken, until, generations, rng):
    """A CMA-ES for each candidate, all in one batch of simulations; the worse half is dropped now and then. Returns those that are left."""
    alive = [(c, Cma(c.size, POPULATION, 1.0, rng)) for c in library]
    for generation in range(generations):
        asked = [s.ask() for _, s in alive]
        members = [member(c, x, taken) for (c, _), rows in zip(alive, asked) for x in rows]
        losses = train.losses(members).reshape(len(alive), POPULATION)
        for (_, strategy), row in zip(alive, losses):
            strategy.tell(row)
        if generation % HALVE == HALVE - 1 and len(alive) > 6:
            alive = sorted(alive, key=lambda pair: pair[1].best_loss)[:max(6, len(alive) // 2)]
        if time.process_time() > until:
            break
    return alive


def chosen(alive, check, taken):
    """[(loss on the validation windows, candidate, unknowns)], best first, each name once."""
    losses = check.losses([member(c, s.best, taken) for c, s in alive])
    out = []
    for loss, (candidate, strategy) in sorted(zip(losses, alive), key=lambda pair: pair[0]):
        if candidate.name not in [c.name for _, c, _ in out]:
            out.append((float(loss), candidate, strategy.best))
    return out


def slot(ranked, before, count):
    """The best and its rivals; weights as of a likelihood with one degree of freedom for each window and an unknown error's size."""
    raw = np.array([(loss / ranked[0][0]) ** -count for loss, _, _ in ranked] + [(before / ranked[0][0]) ** -count])
    shares = raw / raw.sum()
    names = []
    for share, (_, candidate, unknowns) in zip(shares, ranked):
        if not names or (share > PLAUSIBLE and len(names) < 3):
            names.append({"kind": candidate.name[0], "place": candidate.name[1], "confidence": float(min(0.95, share))})
    names[0]["values"] = {label: {"value": float(x)} for label, x in zip(ranked[0][1].labels, ranked[0][1].values(ranked[0][2])) if label}
    return names


def write_predictions(problem, out, taken):
    for entry, table in problem.case.recordings("test"):
        effects, (change, values) = member(None, None, taken)
        start = np.concatenate([[entry["start"][j] for j in problem.joints], np.zeros(len(problem.joints))])[None]
        rows = commands_of(problem, table, change, values)[None]
        positions = simulate(problem, start, rows, [(slice(None), f, v[None]) for f, v in effects])[0]
        write_prediction(out, entry["file"], table["t"], problem.columns_of(positions), problem.case.columns)


def main(folder, out):
    if left_out(folder, out):
        return
    os.makedirs(out, exist_ok=True)
    problem, rng = Problem(folder), np.random.default_rng(1)
    limit, taken, found = problem.case.about["seconds_allowed"], [], []
    write_answer(out, problem.case, "nothing", [])
    write_predictions(problem, out, taken)
    train, check = (Windows(problem, role, count, rng) for role, count in (("train", TRAIN_WINDOWS), ("validation", CHECK_WINDOWS)))
    library, before = candidates(problem), float(check.losses([member(None, None, taken)])[0])
    for share, part in ROUNDS:
        if before < ENOUGH:
            break
        ranked = chosen(search(train, [c for c in library if c.name not in [t.name for t, _ in taken]], taken, share * limit,
                               round(part * GENERATIONS), rng), check, taken)
        if ranked[0][0] > BETTER * before:
            break
        found.append(slot(ranked, before, CHECK_WINDOWS))
        taken.append((ranked[0][1], ranked[0][1].values(ranked[0][2])))
        before = ranked[0][0]
        write_answer(out, problem.case, "found", found)
        write_predictions(problem, out, taken)


if __name__ == "__main__":
    main(*sys.argv[1:3])
