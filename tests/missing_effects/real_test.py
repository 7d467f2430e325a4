"""Cases of real machines, from recordings that the test makes up: files of MATLAB, columns, what is withheld, what is missing."""

import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy as np

import fetch_recordings
import real_cases

BENCHMARK = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "benchmark")
sys.path.insert(0, os.path.join(BENCHMARK, "entrants"))
import rigid  # noqa: E402


def element(kind, body):
    return struct.pack("<II", kind, len(body)) + body + b"\0" * (-len(body) % 8)


def mat(path, arrays):
    """MATLAB 5 by its published format: a header of 128 bytes, each array a compressed matrix of doubles."""
    with open(path, "wb") as file:
        file.write(b"MATLAB 5.0".ljust(124) + struct.pack("<H2s", 0x0100, b"IM"))
        for name, values in arrays.items():
            matrix = (element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", len(values), 1))
                      + element(1, name.encode()) + element(9, np.asarray(values, "<f8").tobytes()))
            packed = zlib.compress(element(14, matrix))
            file.write(struct.pack("<II", 15, len(packed)) + packed)


TURNED_LINK = """<robot name="r"><link name="world"/>
<link name="bar"><inertial><origin xyz="0.5 0 0"/><mass value="2"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="world"/><child link="bar"/><origin xyz="0 0 0" rpy="0 0.5235987755982988 0"/>
<axis xyz="0 1 0"/></joint></robot>"""


class Arm(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name

    def test_case_of_raw_columns(self):
        rows = []
        for k in range(4000):  # time, positions, speeds, currents, and what the recording has behind them
            row = [100.0 + 0.01 * k] + [0.1 * j for j in range(6)] + [9.0] * 6 + [0.5 + j for j in range(6)] + [7.0] * 12
            rows.append(",".join(f"{x:.4f}" for x in row))
        os.makedirs(os.path.join(self.root, "ur10e-payload"))
        with open(os.path.join(self.root, "ur10e-payload", "loaded.csv"), "w", encoding="utf-8") as file:
            file.write(fetch_recordings.converted("\n".join(rows)))
        subprocess.run([sys.executable, os.path.join(BENCHMARK, "real_cases.py"), "--data", self.root, "--out", self.root, "--only", "ur10e"],
                       check=True, capture_output=True)
        with open(os.path.join(self.root, "cases/real_ur10e/case.json"), encoding="utf-8") as file:
            case = json.load(file)
        table = {}
        with open(os.path.join(self.root, "cases/real_ur10e/train_1.csv"), encoding="utf-8") as file:
            names = [cell.split(" [")[0] for cell in file.readline().split(",")]
            table = dict(zip(names, (float(x) for x in file.readline().split(","))))
        self.assertAlmostEqual(table["q_elbow"], 0.2, places=6)
        self.assertAlmostEqual(table["u_elbow"], 8.46 * 2.5, places=4)  # amperes times the stated gain
        self.assertEqual(case["drives"][0]["joint_friction"]["value"], 12.5)
        with open(os.path.join(self.root, "cases/real_ur10e/robot.urdf"), encoding="utf-8") as file:
            robot = file.read()
        self.assertIn('name="world"', robot)
        self.assertNotIn("flange", robot)
        self.assertNotIn("2.805", json.dumps(case))

    def test_turned_frames(self):
        """A bar that its joint's frame holds 30 degrees below the horizontal: m g l cos(30 deg + q), about y downwards."""
        path = os.path.join(self.root, "robot.urdf")
        with open(path, "w", encoding="utf-8") as file:
            file.write(TURNED_LINK)
        q = np.array([[0.0], [0.3]])
        torque = rigid.Chain(path, 9.81).needed(q, 0 * q, 0 * q)
        for angle, found in zip(q[:, 0], torque[:, 0]):
            self.assertAlmostEqual(found, -2 * 9.81 * 0.5 * np.cos(np.pi / 6 + angle), places=9)


class Real(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        os.makedirs(os.path.join(self.root, "emps"))
        t = np.arange(20001) * 1e-3
        for name in ("DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"):
            mat(os.path.join(self.root, "emps", name), {"t": t, "qm": 0.1 * np.sin(t), "vir": np.cos(3.0 * t)})

    def make(self):
        return subprocess.run([sys.executable, os.path.join(BENCHMARK, "real_cases.py"), "--data", self.root, "--out", self.root],
                              capture_output=True, text=True)

    def test_numbers_of_mat(self):
        table = real_cases.numbers_of_mat(os.path.join(self.root, "emps", "DATA_EMPS.mat"))
        self.assertEqual(sorted(table), ["qm", "t", "vir"])
        self.assertAlmostEqual(table["qm"][1000], 0.1 * np.sin(1.0))

    def test_case(self):
        done = self.make()
        self.assertEqual(done.stdout.split(), ["real_emps"])
        self.assertIn("real_servo left out", done.stderr)
        with open(os.path.join(self.root, "cases/real_emps/case.json"), encoding="utf-8") as file:
            case = json.load(file)
        with open(os.path.join(self.root, "cases/real_emps/train_1.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip(), "t [s],u_guide [N m],q_guide [m]")
            first = [float(x) for x in file.readline().split(",")]
        # Two seconds in; volts are newtons by the drive's gain.
        self.assertAlmostEqual(first[1], 35.15065 * np.cos(6.0), places=4)
        self.assertAlmostEqual(first[2], 0.1 * np.sin(2.0), places=6)
        with open(os.path.join(self.root, "cases/real_emps/test_1.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip(), "t [s],u_guide [N m]")
        # The motor's angle by a place: the same units as of the made machines that slide.
        self.assertEqual(case["drives"][0]["ratio"]["unit"], "rad/m")
        self.assertEqual(case["drives"][0]["rotor_inertia"]["unit"], "kg m^2")
        self.assertIn({"kind": "asymmetric_friction", "place": "guide"}, case["allowed"])
        self.assertNotIn("truth", json.dumps(case))


if __name__ == "__main__":
    unittest.main()
