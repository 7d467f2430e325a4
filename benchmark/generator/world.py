"""A machine with its drives, springs, ground and hidden effects, integrated by the classical Runge-Kutta method in fixed steps.

A drive is rigid unless elastic_drive or backlash is hidden in it. Then its motor has a position of its own, phi (in joint units), and
N^2 J phi'' = drive - friction - T, with the torque T that the transmission passes on. Friction of a joint with a drive sits at the motor.
"""

import copy
import math

import numpy as np

from generator import laws
from generator.machines import MACHINES, with_payload

STEP = 2.0e-4  # s, of the integrator
PERIOD = 2.0e-3  # s, of sensors and commands: commands are held over a sample
PLAY_STIFFNESS, PLAY_DAMPING = 4.0e3, 1.0  # N m/rad and N m s/rad at the flanks of a play


class World:
    def __init__(self, machine, numbers, effects):
        self.kind = MACHINES[machine]
        self.joints = self.kind.joints
        self.numbers = copy.deepcopy(numbers)
        self.effects = effects
        self.laws = [[] for _ in self.joints]
        self.gain = [1.0] * len(self.joints)
        self.delay = [0.0] * len(self.joints)
        self.lag = {}
        self.load = [0.0] * len(self.joints)
        self.flexible = {}
        self.absorber = None
        self.fading = None
        tilt = 0.0
        for effect in effects:
            tilt += self._take(effect)
        self.machine = self.kind(self.numbers, tilt)
        self._prepare()

    def _take(self, effect):
        """Puts one effect where it acts; returns a tilt."""
        kind, place, values = effect["kind"], effect["place"], effect["values"]
        if kind == "gravity_tilt":
            return values["angle"]
        if kind == "payload":
            link = self.numbers["links"][place]
            self.numbers["links"][place] = (with_payload(link, values["mass"], values["distance"]) if "center" in link
                                            else dict(link, mass=link["mass"] + values["mass"]))
        elif kind == "center_of_mass":
            self.numbers["links"][place]["center"] += values["shift"]
        elif kind.startswith("ground_"):
            ground = self.numbers["ground"][place]
            if kind == "ground_height":
                ground["height"] = values["height"]
            else:
                ground[kind.removeprefix("ground_")] *= values["scale"]
        elif kind != "sensor_gain":
            self._take_at_joint(kind, self.joints.index(place), place, values)
        return 0.0

    def _take_at_joint(self, kind, index, place, values):
        if kind == "torque_gain":
            self.gain[index] = values["gain"]
        elif kind == "actuator_delay":
            self.delay[index] = values["delay"]
        elif kind == "actuator_lag":
            self.lag[index] = values["time_constant"]
        elif kind == "rotor_inertia":
            drive = self.numbers["drives"][place]
            drive["rotor_inertia"] += values["inertia"] / drive["ratio"] ** 2
        elif kind == "load_friction":
            self.load[index] = values["coefficient"]
        elif kind in ("elastic_drive", "backlash"):
            self.flexible[index] = values
        elif kind == "absorber":
            self.absorber = (index, values)
        elif kind == "fading":
            self.fading = (index, values)
        else:
            self.laws[index].append(laws.FORCES[kind](values))

    def _prepare(self):
        drives = [self.numbers["drives"].get(joint) for joint in self.joints]
        self.ratio = [d["ratio"] if d else 0.0 for d in drives]
        self.reflected = [d["ratio"] ** 2 * d["rotor_inertia"] if d else 0.0 for d in drives]
        for index, drive in enumerate(drives):
            if drive:
                self.laws[index].append(laws.viscous({"damping": drive["damping"]}))
        self.springs = [self.numbers.get("springs", {}).get(joint) for joint in self.joints]
        self.scale = [d.get("gain", 1.0) if d else 1.0 for d in drives]
        self.states = 2 * len(self.joints) + 2 * len(self.flexible) + len(self.lag) + (2 if self.absorber else 0)

    def start(self, q):
        """At rest; transmissions unstretched, actuators without torque."""
        y = list(q) + [0.0] * (self.states - len(self.joints))
        for slot, index in enumerate(self.flexible):
            y[2 * len(self.joints) + 2 * slot] = q[index]
        return y

    def _transmission(self, values, stretch, rate):
        if "gap" not in values:
            return values["stiffness"] * stretch + values["damping"] * rate
        beyond = abs(stretch) - 0.5 * values["gap"]
        if beyond <= 0.0:
            return 0.0
        side = math.copysign(1.0, stretch)
        return side * max(0.0, PLAY_STIFFNESS * beyond + PLAY_DAMPING * side * rate)

    def _drive(self, t, y, u, rates):
        """Torques of the drives in joint units, with the lag's states."""
        n = len(self.joints)
        out = [self.ratio[j] * self.scale[j] * self.gain[j] * u[j] for j in range(n)]
        at = 2 * n + 2 * len(self.flexible)
        for slot, (index, time) in enumerate(self.lag.items()):
            rates[at + slot] = (out[index] - y[at + slot]) / time
            out[index] = y[at + slot]
        if self.fading:
            index, values = self.fading
            out[index] *= 1.0 - values["loss"] * (1.0 - math.exp(-t / values["time"]))
        return out

    def rates(self, t, y, u):
        n = len(self.joints)
        q, v = y[:n], y[n:2 * n]
        rates = [0.0] * self.states
        rates[:n] = v
        drive = self._drive(t, y, u, rates)
        mass, bias = self.machine.equations(q, v)
        mass = [list(row) for row in mass]
        force = [-b for b in bias]
        slots = {index: 2 * n + 2 * slot for slot, index in enumerate(self.flexible)}
        for j in range(n):
            if self.springs[j]:
                force[j] -= self.springs[j]["stiffness"] * (q[j] - self.springs[j]["rest"])
            at = slots.get(j)
            position, speed = (y[at], y[at + 1]) if at else (q[j], v[j])
            acting = drive[j] + sum(law(t, position, speed, self.ratio[j] * position) for law in self.laws[j])
            if at:
                passed = self._transmission(self.flexible[j], position - q[j], speed - v[j])
                rates[at], rates[at + 1] = speed, (acting - passed) / self.reflected[j]
                acting = passed
            else:
                mass[j][j] += self.reflected[j]
            force[j] += acting
        self._ground(q, v, force)
        self._absorb(y, q, v, rates, force)
        rates[n:2 * n] = self._accelerations(mass, force, drive, v)
        if self.absorber:
            rates[-1] -= rates[n + self.absorber[0]]
        return rates

    def _ground(self, q, v, force):
        if hasattr(self.machine, "ground_forces"):
            for j, acting in enumerate(self.machine.ground_forces(q, v)):
                force[j] += acting

    def _absorb(self, y, q, v, rates, force):
        """A mass on a spring on the joint's link, with the stretch x: m (x'' + a) = -k x - d x'."""
        if self.absorber:
            index, values = self.absorber
            pull = values["stiffness"] * y[-2] + values["damping"] * y[-1]
            rates[-2], rates[-1] = y[-1], -pull / values["inertia"]
            force[index] += pull

    def _accelerations(self, mass, force, drive, v):
        acceleration = solve(mass, force)
        if any(self.load):  # what the gear passes on depends on the acceleration: a contraction, five times
            for _ in range(5):
                extra = [-self.load[j] * abs(drive[j] - self.reflected[j] * acceleration[j]) * laws.sign(v[j])
                         for j in range(len(v))]
                acceleration = solve(mass, [f + e for f, e in zip(force, extra)])
        return acceleration

    def run(self, start, commands, sample_from=0):
        """States at the samples, one row each. commands: rows of u by joint, held over a sample."""
        y, rows = list(start), []
        per_sample = round(PERIOD / STEP)
        shift = [round(d / STEP) for d in self.delay]
        for k in range(len(commands)):
            rows.append(list(y))
            for i in range(per_sample):
                at = k * per_sample + i
                u = [commands[max(0, at - shift[j]) // per_sample][j] if at >= shift[j] else 0.0 for j in range(len(shift))]
                y = step(self.rates, (sample_from * per_sample + at) * STEP, y, u)
        return np.array(rows)

    def positions(self, states):
        """(joint positions, motor positions) by joint; motor angles are counted at the motor."""
        n = len(self.joints)
        joints = {name: states[:, j] for j, name in enumerate(self.joints)}
        motors = {name: self.ratio[j] * states[:, j] for j, name in enumerate(self.joints) if self.ratio[j]}
        for slot, index in enumerate(self.flexible):
            motors[self.joints[index]] = self.ratio[index] * states[:, 2 * n + 2 * slot]
        return joints, motors


def solve(mass, force):
    if len(force) == 1:
        return [force[0] / mass[0][0]]
    if len(force) == 3:
        return solve_three(mass, force)
    (a, b), (c, d) = mass
    determinant = a * d - b * c
    return [(d * force[0] - b * force[1]) / determinant, (a * force[1] - c * force[0]) / determinant]


def solve_three(mass, force):
    """Symmetric 3 x 3, by cofactors."""
    (a, b, c), (_, d, e), (_, _, f) = mass
    A, B, C, D, E, F = d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e, a * d - b * b
    x, y, z = force
    determinant = a * A + b * B + c * C
    return [(A * x + B * y + C * z) / determinant, (B * x + D * y + E * z) / determinant, (C * x + E * y + F * z) / determinant]


def step(rates, t, y, u, size=STEP):
    """One classical Runge-Kutta step with a held command."""
    k1 = rates(t, y, u)
    k2 = rates(t + 0.5 * size, [a + 0.5 * size * b for a, b in zip(y, k1)], u)
    k3 = rates(t + 0.5 * size, [a + 0.5 * size * b for a, b in zip(y, k2)], u)
    k4 = rates(t + size, [a + size * b for a, b in zip(y, k3)], u)
    return [a + size / 6.0 * (p + 2.0 * (r + s) + w) for a, p, r, s, w in zip(y, k1, k2, k3, k4)]
