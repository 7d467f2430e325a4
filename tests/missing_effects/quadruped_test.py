"""The benchmark's quadruped: weight at rest, closed forms of its motors, halved steps, what a case says and does not say. Without MuJoCo
the tests of its world are left out, and the generator's line about that is tested alone."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

import numpy as np

import score
from generator import files, plan, quadruped as robot, quadruped_case, quadruped_motion
from generator.machines import GRAVITY

BENCHMARK = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "benchmark")
FLOOR = 1.0e-4  # rad, about that of the encoders

try:
    WORLD, WHY = robot.World(), ""
except robot.Missing as missing:
    WORLD, WHY = None, str(missing)


def tearDownModule():
    if WORLD:
        WORLD.close()


def asked(motion, seconds, seed=1):
    targets = quadruped_motion.targets(np.random.default_rng(seed), motion, seconds)
    return targets, quadruped_motion.start(targets[0])


def run(effects, motion="sway", seconds=1.0, **options):
    targets, start = asked(motion, seconds)
    return WORLD.run(robot.stated(), effects, start, targets, **options)


def hidden(kind, place, **values):
    return [{"kind": kind, "place": place, "values": values}]


def stand(effects=()):
    """After five seconds under the first targets."""
    targets, start = asked("sway", 1.0)
    log = WORLD.run(robot.stated(), list(effects), start, np.tile(targets[0], (1250, 1)))
    return {name: values[-1] for name, values in log.items()}


@unittest.skipUnless(WORLD, WHY)
class AtRest(unittest.TestCase):
    def test_feet_bear_the_weight(self):
        weight = robot.total_mass(robot.stated()) * GRAVITY
        end = stand()
        self.assertLess(np.max(np.abs(end["v"])), 1e-3)
        self.assertAlmostEqual(np.sum(end["normal"]) / weight, 1.0, delta=1e-3)
        # The specific force of what is at rest: g, upwards in the world.
        self.assertAlmostEqual(np.linalg.norm(end["accelerometer"]), GRAVITY, delta=0.01)
        heavier = stand(hidden("payload", "trunk", mass=1.5, x=0.12, y=0.05, z=0.07))
        self.assertAlmostEqual(np.sum(heavier["normal"]), weight + 1.5 * GRAVITY, delta=0.05)
        self.assertGreater(heavier["normal"][0], end["normal"][0] + 3.0)  # in front and to the left

    def test_feet_sink_as_stated(self):
        """depth = force / stiffness, of the sphere's lowest point; at a softer ground more."""
        for scale in (1.0, 0.5):
            end = stand(hidden("ground_stiffness", robot.PLACE, scale=scale))
            for leg, force in enumerate(end["normal"]):
                depth = robot.RADIUS - foot_height(end, leg)
                self.assertAlmostEqual(depth, force / robot.GROUND["stiffness"] / scale, delta=2e-5)

    def test_motors_balance_the_control(self):
        end = stand(hidden("torque_gain", "fr_hip", gain=1.25))
        targets, _ = asked("sway", 1.0)
        self.assertLess(np.max(np.abs(end["u"] - robot.POSITION_GAIN * (targets[0] - end["q"]) + robot.VELOCITY_GAIN * end["v"])), 1e-9)


def foot_height(end, leg):
    """Of its centre, by the forward kinematics of the stated mounts."""
    w, *v = end["turn"]
    v, at, turn = np.array(v), np.zeros(3), np.eye(3)
    side, hip, knee = end["q"][3 * leg:3 * leg + 3]
    for mount, rotation in zip(robot.mounts(robot.LEGS[leg]), (about(0, side), about(1, hip), about(1, knee), np.eye(3))):
        at = at + turn @ np.array(mount)
        turn = turn @ rotation
    return (end["place"] + at + 2.0 * w * np.cross(v, at) + 2.0 * np.cross(v, np.cross(v, at)))[2]


def about(axis, angle):
    one, two = (axis + 1) % 3, (axis + 2) % 3
    out = np.eye(3)
    out[one, one] = out[two, two] = np.cos(angle)
    out[one, two], out[two, one] = -np.sin(angle), np.sin(angle)
    return out


@unittest.skipUnless(WORLD, WHY)
class Moving(unittest.TestCase):
    def test_the_same_again_and_halved_steps(self):
        one, again, halved = run([]), run([]), run([], steps=2 * robot.STEPS)
        self.assertTrue(np.array_equal(one["q"], again["q"]))
        self.assertLess(np.sqrt(np.mean((one["q"] - halved["q"]) ** 2)), 0.2 * FLOOR)

    def test_delays_begin_late(self):
        """What a late leg is told changes nothing until the delay is over, and then that leg."""
        targets, start = asked("sway", 0.06)
        moved, late = targets.copy(), hidden("actuator_delay", "rl_leg", delay=2 * robot.PERIOD)
        moved[:, 6:9] += 0.02
        difference = np.abs(WORLD.run(robot.stated(), late, start, moved)["q"] - WORLD.run(robot.stated(), late, start, targets)["q"])
        self.assertEqual(np.max(difference[:3]), 0.0)
        self.assertGreater(np.min(difference[3, 6:9]), 1e-4)
        self.assertGreater(np.min(difference[3, 6:9]), 3.0 * np.max(difference[3, :6]))

    def test_each_effect_shows_in_a_recording(self):
        """Of medium strength, twice as far as the floor where it is moved, in steps."""
        bare, rng = run([], "steps", 3.0), np.random.default_rng(1)
        for single in plan.SINGLES[robot.NAME]:
            effect = plan.effect(single, "medium", rng)
            if effect["kind"] != "ground_friction":  # that one slips where the trunk is shaken
                difference = run([effect], "steps", 3.0)["q"] - bare["q"]
                self.assertGreater(np.sqrt(np.mean(difference ** 2)), 2.0 * FLOOR, effect)

    def test_without_a_slip_friction_does_nothing(self):
        a, b = (stand(hidden("ground_friction", robot.PLACE, scale=scale)) for scale in (1.0, 0.8))
        self.assertLess(np.max(np.abs(a["q"] - b["q"])), 1e-3)


class Case(unittest.TestCase):
    def test_the_robot_is_as_stated(self):
        root = xml.fromstring(robot.urdf())
        masses = {link.get("name"): float(link.find("inertial/mass").get("value")) for link in root.findall("link") if link.find("inertial") is not None}
        case = quadruped_case.describe("case_x", [])
        self.assertEqual(masses, {name: mass["value"] for name, mass in case["masses"].items()})
        self.assertAlmostEqual(sum(masses.values()), robot.total_mass(robot.stated()))
        inertia = [[float(x) for x in link.find("inertial/inertia").attrib.values()][::1] for link in root.findall("link") if link.find("inertial") is not None]
        for ixx, _, _, iyy, _, izz in inertia:  # no body has less
            self.assertLess(max(ixx, iyy, izz), 0.5 * (ixx + iyy + izz) + 1e-12)

    def test_every_hidden_effect_may_be_named_and_others_not(self):
        names = {(entry["kind"], entry["place"]) for entry in quadruped_case.allowed()}
        self.assertTrue(all((kind, place) in names for kind, place, _, _ in plan.SINGLES[robot.NAME]))
        self.assertFalse(any((kind, place) in names for kind, place, _ in plan.OUTSIDE[robot.NAME]))

    def test_numbers_of_cases_stay(self):
        """Machines that came before have the numbers 1 to 101."""
        counts = [len(list(plan.entries(False, machines))) for machines in plan.BLOCKS]
        self.assertEqual((counts[:3], plan.BLOCKS[3]), ([63, 19, 19], (robot.NAME,)))

    def test_a_late_leg_is_three_late_motors(self):
        effects = hidden("actuator_delay", "rl_leg", delay=0.004)
        other, = quadruped_case.also_right(effects)
        self.assertEqual([e["place"] for e in other], ["rl_side", "rl_hip", "rl_knee"])
        case = {"allowed": quadruped_case.allowed()}
        truth = {"effects": effects, "also_right": [other], "group": "single"}
        answer = {"verdict": "found", "found": [{"names": [{"kind": "actuator_delay", "place": e["place"]}]} for e in other]}
        self.assertTrue(score.names_score(answer, score.nearest_truth(answer, truth, case), "single")["first"])

    def test_an_orientation_s_noise_is_a_small_turn(self):
        still = np.tile([1.0, 0.0, 0.0, 0.0], (4000, 1))
        seen = quadruped_case.turned(still, np.random.default_rng(1))
        self.assertAlmostEqual(np.std(2.0 * seen[:, 1:]) / quadruped_case.NOISE["orientation"], 1.0, delta=0.03)

    def test_test_recordings_have_targets_alone(self):
        case = {"id": "x", "columns": quadruped_case.columns(), "recordings": []}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "test_1.csv")
            files.write_recording(path, case, {name: np.zeros(3) for name in case["columns"]}, True, robot.PERIOD)
            self.assertEqual(list(files.numbers_of_csv(path)), ["t"] + [f"r_{joint}" for joint in robot.JOINTS])


class Missing(unittest.TestCase):
    def test_one_line_says_that_mujoco_is_missing(self):
        """A compiler that fails stands for a library that is not there; the other machines' cases are made."""
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, os.path.join(BENCHMARK, "make_cases.py"), "--out", folder, "--seed", "3", "--only", "d", "--case",
                                   "case_105", "case_106", first_pendulum(3)], capture_output=True, text=True, env={**os.environ, "CC": "false"})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn("The cases of the quadruped, from case_105 on, are left out: MuJoCo", done.stderr)
            self.assertEqual(os.listdir(os.path.join(folder, "cases")), [first_pendulum(3)])

    def test_entrants_that_cannot_say_so(self):
        """least_squares and says_nothing answer a case of the quadruped that has targets and no recording of motion."""
        with tempfile.TemporaryDirectory() as folder:
            targets, start = asked("sway", 0.1)
            case = quadruped_case.describe("case_x", [("test_1", "test", targets, start)])
            table = {name: np.zeros(len(targets)) for name in case["columns"]} | {f"r_{joint}": targets[:, i] for i, joint in enumerate(robot.JOINTS)}
            files.write_files(folder, case, robot.urdf(), {"test_1.csv": table}, {"id": "case_x"}, robot.PERIOD)
            for entrant in ("says_nothing", "least_squares", "sparse_regression", "cma_search"):
                out = os.path.join(folder, entrant)
                subprocess.run([sys.executable, os.path.join(BENCHMARK, "entrants", entrant, "run.py"), os.path.join(folder, "cases/case_x"), out], check=True)
                with open(os.path.join(out, "answer.json"), encoding="utf-8") as file:
                    self.assertEqual(json.load(file)["verdict"], "nothing")
                predicted = score.read_csv(os.path.join(out, "test_1.csv"))
                self.assertEqual(sorted(predicted), sorted(["t"] + [f"q_{joint}" for joint in robot.JOINTS]))


def first_pendulum(seed):
    order = np.random.default_rng(seed).permutation(63)
    machines = [entry[0] for entry in plan.entries(False, plan.BLOCKS[0])]
    return next(f"case_{number + 1:03d}" for number, index in enumerate(order) if machines[index] == "pendulum")


if __name__ == "__main__":
    unittest.main()
