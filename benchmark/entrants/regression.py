"""What the regressions of this repository share: smoothed motions, the force that the stated model leaves, terms, and a forward run."""

import os

import numpy as np

from common import Case
from rigid import Chain

SMOOTHING = 0.01  # rad/s or m/s: where dry friction changes sign
LIGHT, HALF_WIDTH, HALF_WIDTH_FEET = 3, 20, 12  # samples of a smoothing window to either side; less (light: none) where feet strike


def smoothing_weights(half):
    """A Hann window. The same for positions and commands: what is linear in the equations stays true of what is smoothed."""
    weights = 1.0 + np.cos(np.pi * np.arange(-half, half + 1) / (half + 1))
    return weights / np.sum(weights)


class Motion:
    """Positions, speeds, accelerations, commands (force at the joint) by joint, smoothed alike."""

    def __init__(self, q, v, a, u, du, time):
        self.q, self.v, self.a, self.u, self.du, self.time = q, v, a, u, du, time


class Problem:
    def __init__(self, folder):
        self.case = Case(folder)
        self.chain = Chain(os.path.join(folder, "robot.urdf"), self.case.about["gravity"]["value"])
        self.joints = self.chain.names
        self.light = 0 if self.case.about["feet"] else LIGHT
        self.half = HALF_WIDTH_FEET if self.case.about["feet"] else HALF_WIDTH
        self.ratio = np.array([self.drive(j, "ratio") for j in self.joints])
        self.reflected = np.array([self.drive(j, "rotor_inertia") for j in self.joints]) * self.ratio ** 2
        self.damping = np.array([self.drive(j, "joint_damping") for j in self.joints])
        self.dry = np.array([self.drive(j, "joint_friction") for j in self.joints])
        self.springs = [(self.joints.index(s["joint"]), s["stiffness"]["value"], s["rest"]["value"])
                        for s in self.case.about["springs"]]

    def drive(self, joint, key):
        return self.case.drives.get(joint, {}).get(key, {"value": 0.0})["value"]

    def raw_positions(self, table):
        """By joint: its own sensor, or its motor's. And their floors."""
        out, floors = [], []
        for joint in self.joints:
            column, factor = (f"q_{joint}", 1.0) if f"q_{joint}" in table else (f"m_{joint}", self.drive(joint, "ratio"))
            about = self.case.columns[column]
            out.append(table[column] / factor)
            floors.append(np.hypot(about["resolution"] / np.sqrt(12.0), about["noise"]) / factor)
        return np.stack(out, axis=1), np.array(floors)

    def motion(self, table, jitter=None):
        """jitter: random numbers of the sensors' size are added, to see what the sensors make of a residual."""
        positions, floors = self.raw_positions(table)
        if jitter is not None:
            positions = positions + floors * jitter.normal(size=positions.shape)
        commands = np.stack([table[f"u_{j}"] * self.drive(j, "ratio") if f"u_{j}" in table else np.zeros(len(positions))
                             for j in self.joints], axis=1)
        # Held over the sample that begins: at the instant of a reading the mean of before and after.
        commands = 0.5 * (commands + np.vstack([commands[:1], commands[:-1]]))
        weights, h, edge = smoothing_weights(self.light), self.case.period, slice(1, -1)
        q, u = (np.stack([np.convolve(c, weights, "valid") for c in x.T], axis=1) for x in (positions, commands))

        def rate(x):
            return (x[2:] - x[:-2]) / (2.0 * h)

        return Motion(q[edge], rate(q), (q[2:] - 2.0 * q[1:-1] + q[:-2]) / h ** 2, u[edge], rate(u),
                      table["t"][self.light + 1:-self.light - 1])

    def smoothed(self, forces, stride):
        """Forces are formed of lightly smoothed motions and smoothed after that, so that sharp corners stay where they are; every so-many-th
        sample, for neighbours tell the same."""
        weights = smoothing_weights(self.half)
        return np.stack([np.convolve(c, weights, "valid")[::stride] for c in forces.T], axis=1)

    def ground(self, m, change="", place=""):
        """Generalised forces of the stated ground; change: the derivative by a scale of stiffness, damping or friction, or by height, of the
        ground at a place."""
        out = np.zeros_like(m.q)
        for foot in self.case.about["feet"]:
            if place not in ("", foot.get("place", foot["name"])):
                continue
            law, point = foot["ground"], (foot["link"], foot["point"])
            step = 1.0e-6
            jacobian = np.stack([(self.chain.point(m.q + step * e, *point) - self.chain.point(m.q - step * e, *point)) / (2 * step)
                                 for e in np.eye(len(self.joints))], axis=2)
            depth = np.maximum(0.0, -self.chain.point(m.q, *point)[:, 2])
            along, _, up = np.moveaxis(np.einsum("tij,tj->ti", jacobian, m.v), 1, 0)
            stiffness, damping, n = law["stiffness"]["value"], law["damping"]["value"], law["exponent"]
            whole = np.maximum(0.0, depth ** n * (stiffness - damping * up))
            normal = {"": whole, "friction": whole, "stiffness": depth ** n * stiffness, "damping": -depth ** n * damping * up,
                      "height": n * depth ** (n - 1.0) * stiffness}[change]
            holding = law["friction"]["value"] * np.tanh(along / law["slip_scale"]["value"]) if "friction" in law else 0.0 * along
            out += -jacobian[:, 0] * (holding * normal)[:, None]
            out += jacobian[:, 2] * (normal if change != "friction" else 0.0 * normal)[:, None]
        return out

    def stated(self, m):
        """What the stated model's drives must give for this motion."""
        out = self.chain.needed(m.q, m.v, m.a) + self.reflected * m.a + self.damping * m.v + self.dry * sign(m.v) - self.ground(m)
        for j, stiffness, rest in self.springs:
            out[:, j] += stiffness * (m.q[:, j] - rest)
        return out

    def residual(self, m):
        return self.stated(m) - m.u

    def modelled(self, m):
        """The motion with the accelerations that the stated model has for it. Terms are chosen on these: measured accelerations carry the
        same noise as the force that is left, and terms of the stated equation together could take that equation away from itself."""
        n, zero = len(self.joints), np.zeros_like(m.a)

        def needed(a):
            return self.residual(Motion(m.q, m.v, a, m.u, m.du, m.time))

        base = needed(zero)
        mass = np.stack([needed(zero + e) - base for e in np.eye(n)], axis=2)
        return Motion(m.q, m.v, np.linalg.solve(mass, -base[:, :, None])[:, :, 0], m.u, m.du, m.time)

    def predict(self, start, table, terms, values):
        """Runs stated model plus sum of value times term from rest, with held commands; positions by joint at the samples."""
        commands = np.stack([table[f"u_{j}"] * self.drive(j, "ratio") if f"u_{j}" in table else np.zeros(len(table["t"]))
                             for j in self.joints], axis=1)
        substeps = 2 if self.case.about["feet"] else 1
        n, h = len(self.joints), self.case.period / substeps
        y, rows = np.concatenate([np.array([start[j] for j in self.joints]), np.zeros(n)]), []
        basis = np.vstack([np.zeros(n), np.eye(n)])
        for k, u in enumerate(commands):
            rows.append(y[:n])
            slope = (u - commands[k - 1]) / self.case.period if k else np.zeros(n)

            def rates(y, time):
                m = Motion(*(np.broadcast_to(x, (n + 1, n)) for x in (y[:n], y[n:])), basis,
                           *(np.broadcast_to(x, (n + 1, n)) for x in (u, slope)), np.full(n + 1, time))
                force = self.residual(m) - sum((x * term(self, m) for x, term in zip(values, terms)), np.zeros((n + 1, n)))
                return np.concatenate([y[n:], np.linalg.solve((force[1:] - force[0]).T, -force[0])])

            for i in range(substeps):
                time = table["t"][k] + i * h
                k1 = rates(y, time)
                k2 = rates(y + 0.5 * h * k1, time)
                k3 = rates(y + 0.5 * h * k2, time)
                y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rates(y + h * k3, time))
            if not np.all(np.isfinite(y)):
                raise FloatingPointError("the predicted motion has no bounds")
        return np.array(rows)

    def columns_of(self, positions):
        """Position columns of a prediction from positions by joint."""
        out = {}
        for name in self.case.positions():
            about = self.case.columns[name]
            factor = self.drive(about["joint"], "ratio") if about["is"] == "motor position" else 1.0
            out[name] = factor * positions[:, self.joints.index(about["joint"])]
        return out


def at_joint(problem, joint, function):
    """A term that acts on one joint: function(q, v, a, u, du) of that joint."""
    j = problem.joints.index(joint)

    def term(problem, m):
        out = np.zeros_like(m.q)
        out[:, j] = function(m.q[:, j], m.v[:, j], m.a[:, j], m.u[:, j], m.du[:, j])
        return out
    return term


def of_body(bodies):
    """Minus the force that a change of bodies needs: what it does to the joints."""
    return lambda problem, m: -(problem.chain.needed(m.q, m.v, m.a, bodies))


def numbers_terms(problem):
    """(term, prior deviation) of the stated numbers: masses, rotor inertias, gains, dampings, springs."""
    about, out = problem.case.about, []
    for body in (b for b in problem.chain.bodies if b["mass"]):
        share = about["masses"][body["name"]]["standard_deviation"] / body["mass"]
        bodies = [dict(b, mass=b["mass"] * (b is body), inertia=b["inertia"] * (b is body)) for b in problem.chain.bodies]
        out.append((of_body(bodies), share))
    for joint, drive in problem.case.drives.items():
        n = drive["ratio"]["value"] ** 2
        out += [(at_joint(problem, joint, lambda q, v, a, u, du: -a), n * drive["rotor_inertia"]["standard_deviation"]),
                (at_joint(problem, joint, lambda q, v, a, u, du: u), drive["torque_gain"]["standard_deviation"]),
                (at_joint(problem, joint, lambda q, v, a, u, du: -v), drive["joint_damping"]["standard_deviation"])]
        if "joint_friction" in drive:
            out.append((at_joint(problem, joint, lambda q, v, a, u, du: -sign(v)), drive["joint_friction"]["standard_deviation"]))
    for spring in about["springs"]:
        rest = spring["rest"]["value"]
        out.append((at_joint(problem, spring["joint"], lambda q, v, a, u, du, r=rest: r - q),
                    spring["stiffness"]["standard_deviation"]))
    return out


def sign(v):
    return np.tanh(v / SMOOTHING)


def write_predictions(problem, out, terms, values):
    """Predicts every test recording; one that diverges is left out."""
    from common import write_prediction
    for entry, table in problem.case.recordings("test"):
        with np.errstate(all="ignore"):
            try:
                positions = problem.predict(entry["start"], table, terms, values)
            except (FloatingPointError, np.linalg.LinAlgError):
                continue
        write_prediction(out, entry["file"], table["t"], problem.columns_of(positions), problem.case.columns)
