"""The effects that the search tries: forces of a motion and of values, or changes of the commands. Values are unknowns times scales."""

import numpy as np

from regression import of_body, sign

SHARE = 0.2  # an unknown of 1 is about this share of the forces at the joint


class Candidate:
    """force(problem, motion, values by row) -> forces by row; command(problem, rows, values) -> changed commands."""

    def __init__(self, name, values, size, labels=(), force=None, command=None):
        self.name, self.values, self.size, self.labels, self.force, self.command = name, values, size, labels, force, command


def on(j, function):
    """A force on one joint: function(q, v, a, u, values)."""
    def force(problem, m, x):
        out = np.zeros_like(m.q)
        out[:, j] = function(m.q[:, j], m.v[:, j], m.a[:, j], m.u[:, j], x)
        return out
    return force


def scaled(scales, shift=0.0):
    return lambda unknowns: np.asarray(scales) * unknowns + shift


def late(j):
    """Commands of one drive after a pure delay; between samples on a straight line."""
    def command(problem, rows, values):
        out, delay = rows.copy(), abs(values[0]) / problem.case.period
        k = np.arange(len(rows)) - delay
        out[:, j] = np.interp(k, np.arange(len(rows)), rows[:, j], left=0.0)
        return out
    return command


def lagging(j):
    """Commands of one drive after a first-order lag, mean over each sample."""
    def command(problem, rows, values):
        out, keep, state = rows.copy(), np.exp(-problem.case.period / max(1e-5, abs(values[0]))), 0.0
        for k, u in enumerate(rows[:, j]):
            after = u + (state - u) * keep
            out[k, j], state = 0.5 * (state + after), after
        return out
    return command


def at_joint(joint, j, typical):
    force, speed, q = typical["force"][j], typical["speed"][j], typical["q"][:, j]
    middle, half = 0.5 * (q.min() + q.max()), 0.5 * np.ptp(q) + 1e-9
    f, c = SHARE * force, Candidate
    out = [
        c(("viscous_friction", joint), scaled([f / speed]), 1, ("damping",), on(j, lambda q, v, a, u, x: -x[:, 0] * v)),
        c(("coulomb_friction", joint), scaled([f]), 1, ("level",), on(j, lambda q, v, a, u, x: -x[:, 0] * sign(v))),
        c(("stribeck_friction", joint), lambda p: np.array([f * p[0], f * p[1], speed * np.exp(min(2.0, p[2]) - 1.5)]), 3, (),
          on(j, lambda q, v, a, u, x: -(x[:, 0] + x[:, 1] * np.exp(-(v / x[:, 2]) ** 2)) * sign(v))),
        c(("asymmetric_friction", joint), scaled([f, f]), 2, (), on(j, lambda q, v, a, u, x: -(x[:, 0] + x[:, 1] * sign(v)) * sign(v))),
        c(("quadratic_drag", joint), scaled([f / speed ** 2]), 1, ("drag",), on(j, lambda q, v, a, u, x: -x[:, 0] * abs(v) * v)),
        c(("constant_force", joint), scaled([f]), 1, ("force",), on(j, lambda q, v, a, u, x: x[:, 0])),
        c(("spring", joint), scaled([f / half, f]), 2, ("stiffness",), on(j, lambda q, v, a, u, x: x[:, 1] - x[:, 0] * (q - middle))),
        c(("nonlinear_spring", joint), scaled([f / half ** 3]), 1, (), on(j, lambda q, v, a, u, x: -x[:, 0] * (q - middle) ** 3)),
    ]
    for side in (1.0, -1.0):  # stiffness; where it begins, from the end of the travel
        out.append(c(("hard_stop", joint), lambda p, s=side: np.array([20.0 * f / half * np.exp(min(3.0, p[0])), middle + s * half * (1.0 - 0.3 * abs(p[1]))]),
                     2, (), on(j, lambda q, v, a, u, x, s=side: -s * x[:, 0] * np.maximum(0.0, s * (q - x[:, 1])))))
    return out


def at_drive(problem, joint, j, typical):
    f, c = SHARE * typical["force"][j], Candidate
    out = [
        c(("load_friction", joint), scaled([SHARE]), 1, ("coefficient",), on(j, lambda q, v, a, u, x: -x[:, 0] * abs(u) * sign(v))),
        c(("torque_gain", joint), scaled([SHARE], 1.0), 1, ("gain",), on(j, lambda q, v, a, u, x: (x[:, 0] - 1.0) * u)),
        c(("rotor_inertia", joint), scaled([f / typical["acceleration"][j]]), 1, ("inertia",), on(j, lambda q, v, a, u, x: -x[:, 0] * a)),
        c(("actuator_delay", joint), lambda p: np.abs(0.006 * p), 1, ("delay",), None, late(j)),
        c(("actuator_lag", joint), lambda p: np.abs(0.008 * p), 1, ("time_constant",), None, lagging(j)),
    ]
    for cycles in (1, 2, 3):
        turn = cycles * problem.drive(joint, "ratio")
        out.append(c(("torque_ripple", joint), scaled([f, f]), 2, (),
                     on(j, lambda q, v, a, u, x, k=turn: x[:, 0] * np.sin(k * q) + x[:, 1] * np.cos(k * q))))
    return out


def at_bodies(problem):
    """A mass that hangs on a link (mass, moment; a point's inertia goes with them), a shifted centre of mass, a tilt."""
    out, chain = [], problem.chain
    for body in (b for b in chain.bodies if b["mass"]):
        name, tip = body["name"], [0.0, 0.0, -1.0]
        unit, shifted = chain.changed(name, mass=1.0), chain.changed(name, mass=1.0, moment=tip, inertia=-1.0)
        inertia = chain.changed(name, inertia=1.0)
        mass, moment, turning = (of_body(b) for b in (unit, shifted, inertia))

        def payload(p, m, x, mass=mass, moment=moment, turning=turning):
            # The moment's unit is a unit of mass too: it is taken off the mass.
            hung = x[:, 0] * x[:, 1]
            return ((x[:, 0] - hung)[:, None] * mass(p, m) + hung[:, None] * moment(p, m) + (x[:, 0] * x[:, 1] ** 2)[:, None] * turning(p, m))

        def shift(p, m, x, mass=mass, moment=moment):
            return x[:, :1] * (moment(p, m) - mass(p, m))
        reach = max(0.1, 2.0 * abs(body["center"][2]))
        out += [Candidate(("payload", name), lambda p, b=body, r=reach: np.array([0.1 * b["mass"] * p[0], r * np.tanh(1.0 + p[1])]), 2, ("mass",), payload),
                Candidate(("center_of_mass", name), scaled([0.05 * body["mass"] * reach]), 1, (), shift)]

    def tilt(problem, m, x):
        still = 0.0 * m.q
        down = problem.chain.gravity
        level = problem.chain.needed(m.q, still, still)
        problem.chain.gravity = np.array([-down[2], 0.0, 0.0])
        sideways = problem.chain.needed(m.q, still, still)
        problem.chain.gravity = down
        return level - (np.cos(x[:, :1]) * level + np.sin(x[:, :1]) * sideways)
    return out + [Candidate(("gravity_tilt", "base"), scaled([0.05]), 1, (), tilt)]


def at_ground(problem):
    out = []
    for place in {foot.get("place", foot["name"]) for foot in problem.case.about["feet"]}:
        for change in ("stiffness", "damping", "friction", "height"):
            def force(p, m, x, c=change, at=place):
                return (x[:, :1] - (c != "height")) * p.ground(m, c, at)
            is_height = change == "height"
            out.append(Candidate((f"ground_{change}", place), scaled([0.002] if is_height else [0.3], 0.0 if is_height else 1.0), 1,
                                 ("height" if is_height else "scale",), force))
    return out


def candidates(problem):
    motions = [problem.motion(table) for _, table in problem.case.recordings("train")]
    stacked = {key: np.vstack([getattr(m, key) for m in motions]) for key in ("q", "v", "a", "u")}
    needed = np.vstack([problem.stated(m) for m in motions])
    typical = {"q": stacked["q"], "speed": np.sqrt(np.mean(stacked["v"] ** 2, axis=0)) + 1e-9,
               "acceleration": np.sqrt(np.mean(stacked["a"] ** 2, axis=0)) + 1e-9}
    commanded, moved = (np.sqrt(np.mean(x ** 2, axis=0)) for x in (stacked["u"], needed))
    typical["force"] = np.where(commanded > 0.0, commanded, moved)
    out = []
    for j, joint in enumerate(problem.joints):
        out += at_joint(joint, j, typical)
        out += at_drive(problem, joint, j, typical) if joint in problem.case.drives else []
    out += at_bodies(problem) + at_ground(problem)
    return [c for c in out if c.name in problem.case.allowed]
