"""The benchmark's machines against closed forms, the balance of energy and halved steps."""

import copy
import math
import unittest

import numpy as np

from generator import world as worlds
from generator.machines import GRAVITY, MACHINES, with_payload
from generator.world import PERIOD, World


def undamped(machine):
    numbers = copy.deepcopy(MACHINES[machine].stated)
    for drive in numbers["drives"].values():
        drive["damping"] = 0.0
    for ground in numbers.get("ground", {}).values():
        ground["damping"] = 0.0
        ground["friction"] = 0.0
    return numbers


def energy(world, y):
    """Of links, rotors, springs, transmissions, the ground and a hidden mass."""
    n = len(world.joints)
    q, v = y[:n], y[n:2 * n]
    total = world.machine.energy(q, v)
    slots = {index: 2 * n + 2 * slot for slot, index in enumerate(world.flexible)}
    for j in range(n):
        speed = y[slots[j] + 1] if j in slots else v[j]
        total += 0.5 * world.reflected[j] * speed ** 2
        if world.springs[j]:
            total += 0.5 * world.springs[j]["stiffness"] * (q[j] - world.springs[j]["rest"]) ** 2
        if j in slots:
            total += 0.5 * world.flexible[j]["stiffness"] * (y[slots[j]] - q[j]) ** 2
    if world.absorber:
        index, values = world.absorber
        total += 0.5 * values["inertia"] * (v[index] + y[-1]) ** 2 + 0.5 * values["stiffness"] * y[-2] ** 2
    if hasattr(world.machine, "stored"):
        total += world.machine.stored(q)
    elif hasattr(world.machine, "ground"):
        ground = world.machine.ground
        depth = max(0.0, ground["length"] + q[1] - q[0])
        total += ground["stiffness"] * depth ** (ground["exponent"] + 1.0) / (ground["exponent"] + 1.0)
    return total


def fall(machine, start, effects=(), seconds=1.0):
    world = World(machine, undamped(machine), list(effects))
    commands = np.zeros((int(seconds / PERIOD), len(start)))
    return world, world.run(world.start(start), commands.tolist())


def fall_as_stated(machine, start, effects=(), seconds=1.0):
    world = World(machine, MACHINES[machine].stated, list(effects))
    return world, world.run(world.start(start), np.zeros((int(seconds / PERIOD), len(start))).tolist())


class EnergyStays(unittest.TestCase):
    def check(self, machine, start, effects=(), tolerance=1e-8):
        world, states = fall(machine, start, effects)
        energies = np.array([energy(world, list(y)) for y in states])
        swing = np.ptp([MACHINES[machine].energy(world.machine, y[:len(start)], [0.0] * len(start)) for y in states])
        self.assertGreater(swing, 0.1)  # J: something moves
        self.assertLess(np.ptp(energies) / swing, tolerance)

    def test_pendulum(self):
        self.check("pendulum", [1.0])

    def test_arm(self):
        self.check("arm", [0.8, -1.1])

    def test_hopper_that_bounces(self):
        # The ground's force has a corner at touchdown, where the order of the method is lost: five times what was seen with this step (1.6e-5).
        self.check("hopper", [0.46, 0.0196], tolerance=8e-5)

    def test_cube_that_bounces_and_turns(self):
        # The centre of mass out of the middle couples all three; corners at touchdown as for the hopper.
        effects = [{"kind": "center_of_mass", "place": "cube", "values": {"shift": 0.02}},
                   {"kind": "gravity_tilt", "place": "base", "values": {"angle": 0.05}}]
        self.check("cube", [0.0, 0.3, 0.4], effects, tolerance=5e-4)

    def test_leg(self):
        self.check("leg", [0.6, 0.9, -0.4], [{"kind": "payload", "place": "shin", "values": {"mass": 0.3, "distance": 0.24}}])

    def test_elastic_drive(self):
        self.check("arm", [0.8, -0.5], [{"kind": "elastic_drive", "place": "elbow", "values": {"stiffness": 60.0, "damping": 0.0}}])

    def test_hidden_mass(self):
        self.check("pendulum", [0.7], [{"kind": "absorber", "place": "shoulder",
                                        "values": {"inertia": 0.01, "stiffness": 2.0, "damping": 0.0}}])


class ClosedForms(unittest.TestCase):
    def test_period_of_a_large_swing(self):
        """T = 2 pi / (w agm(1, cos(a / 2))), Gauss."""
        a = 1.2
        _, states = fall("pendulum", [a], seconds=2.5)
        arm, drive = (MACHINES["pendulum"].stated[k] for k in ("links", "drives"))
        arm, drive = arm["arm"], drive["shoulder"]
        inertia = arm["inertia"] + arm["mass"] * arm["center"] ** 2 + drive["ratio"] ** 2 * drive["rotor_inertia"]
        slow, fast = 1.0, math.cos(a / 2.0)
        for _ in range(8):
            slow, fast = 0.5 * (slow + fast), math.sqrt(slow * fast)
        period = 2.0 * math.pi / math.sqrt(arm["mass"] * arm["center"] * GRAVITY / inertia) / slow
        v = states[:, 1]
        rising = [k for k in range(1, len(v) - 1) if v[k] > 0.0 >= v[k + 1]]  # back at the top
        k = rising[0]
        top = (k + v[k] / (v[k] - v[k + 1])) * PERIOD
        self.assertAlmostEqual(top, period, delta=1e-5)  # straight line between samples of 2 ms

    def test_free_fall(self):
        """The centre of mass falls with g while the foot is in the air."""
        _, states = fall("hopper", [0.9, 0.0], seconds=0.25)
        links = MACHINES["hopper"].stated["links"]
        body, foot = links["body"]["mass"], links["foot"]["mass"]
        center = (body * states[:, 0] + foot * (states[:, 0] - states[:, 1])) / (body + foot)
        # The rotor's inertia is felt between body and foot and moves no centre of mass.
        t = np.arange(len(center)) * PERIOD
        self.assertLess(np.max(np.abs(center - center[0] + 0.5 * GRAVITY * t ** 2)), 1e-9)

    def test_cube_rests_on_two_corners(self):
        """Each bears half of the weight: depth^1.5 k = m g / 2. Nothing accelerates there."""
        cube = MACHINES["cube"]
        ground, mass = cube.stated["ground"]["table"], cube.stated["links"]["cube"]["mass"]
        depth = (0.5 * mass * GRAVITY / ground["stiffness"]) ** (1.0 / ground["exponent"])
        world = World("cube", cube.stated, [])
        rates = world.rates(0.0, world.start([0.1, cube.half - depth, 0.0]), [0.0] * 3)
        self.assertLess(np.max(np.abs(rates)), 1e-9)

    def test_cube_slides_down_a_slope(self):
        """Steady sliding on a table that is tilted by more than the angle of friction: a = g (sin - mu cos)."""
        angle = 0.5
        _, states = fall_as_stated("cube", [0.0, 0.052, 0.0], [{"kind": "gravity_tilt", "place": "base", "values": {"angle": angle}}])
        mu = MACHINES["cube"].stated["ground"]["table"]["friction"]
        late = states[-100:]
        gained = (late[-1, 3] - late[0, 3]) / (99 * PERIOD)
        self.assertAlmostEqual(gained, GRAVITY * (math.sin(angle) - mu * math.cos(angle)), delta=1e-3)

    def test_leg_that_is_stiff_is_a_pendulum_and_an_arm(self):
        """With a foot that weighs nothing it is the arm; with knee and ankle that do not move one rigid body."""
        links = copy.deepcopy(MACHINES["leg"].stated["links"])
        links["foot"] = dict(links["foot"], mass=0.0, inertia=0.0)
        arm = MACHINES["arm"]({"links": {"upper": links["thigh"], "fore": links["shin"]}}, 0.1)
        q, v = [0.3, -0.7, 0.4], [1.1, -2.0, 0.6]
        mass, bias = MACHINES["leg"]({"links": links}, 0.1).equations(q, v)
        mass2, bias2 = arm.equations(q[:2], v[:2])
        self.assertTrue(np.allclose([row[:2] for row in mass[:2]], mass2, rtol=1e-13))
        self.assertTrue(np.allclose(bias[:2], bias2, rtol=1e-13))
        links = MACHINES["leg"].stated["links"]
        mass, bias = MACHINES["leg"]({"links": links}).equations([0.5, 0.0, 0.0], [3.0, 0.0, 0.0])
        ends = np.cumsum([0.0] + [links[name]["length"] for name in ("thigh", "shin", "foot")])
        middles = [end + link["center"] for end, link in zip(ends, links.values())]
        self.assertAlmostEqual(mass[0][0], sum(l["inertia"] + l["mass"] * r ** 2 for l, r in zip(links.values(), middles)), places=14)
        self.assertAlmostEqual(bias[0], GRAVITY * math.sin(0.5) * sum(l["mass"] * r for l, r in zip(links.values(), middles)), places=13)

    def test_payload(self):
        heavier = with_payload({"mass": 1.0, "center": 0.2, "inertia": 0.01, "length": 0.4}, 0.5, 0.5)
        self.assertAlmostEqual(heavier["mass"] * heavier["center"], 1.0 * 0.2 + 0.5 * 0.5)
        about_joint = heavier["inertia"] + heavier["mass"] * heavier["center"] ** 2
        self.assertAlmostEqual(about_joint, 0.01 + 0.2 ** 2 + 0.5 * 0.5 ** 2)

    def test_delay_shifts_the_motion(self):
        """From rest at the bottom, a delay of k samples is the same motion k samples later."""
        commands = [[0.02]] * 200
        plain = World("pendulum", MACHINES["pendulum"].stated, [])
        late = World("pendulum", MACHINES["pendulum"].stated,
                     [{"kind": "actuator_delay", "place": "shoulder", "values": {"delay": 5 * PERIOD}}])
        a, b = (w.run(w.start([0.0]), commands) for w in (plain, late))
        self.assertLess(np.max(np.abs(a[:-5, 0] - b[5:, 0])), 1e-12)


class StepsAreSmallEnough(unittest.TestCase):
    def test_halved(self):
        """Half the step moves nothing by a tenth of a floor, where dry friction and the ground are."""
        friction = {"kind": "coulomb_friction", "place": "leg", "values": {"level": 4.0}}
        runs = []
        for size in (worlds.STEP, worlds.STEP / 2.0):
            world = World("hopper", MACHINES["hopper"].stated, [friction])
            y, rows = world.start([0.44, 0.0196]), []
            for k in range(round(0.6 / size)):
                y = worlds.step(world.rates, k * size, y, [0.0, 0.5], size)
                rows.append(y[0])
            runs.append(rows[-1])
        self.assertLess(abs(runs[0] - runs[1]), 1e-6)


if __name__ == "__main__":
    unittest.main()
