#!/usr/bin/env python3
"""Makes cases of real machines from recordings of others that the user has: OUT/cases/real_* and OUT/truths/real_*.

Usage: real_cases.py --data FOLDER --out DIR [--only TEXT]

FOLDER has a folder for each machine; README.md says where its files come from. A machine whose files are not there is left out, and said.
Nothing recorded is part of this repository. What a truth rests on stands in truth.json ("source"), and what says the same in other names
("also_right"). The machines below have one joint, that of real_arm.py six; numbers are at the joint, so a drive's ratio is 1.
"""

import argparse
import os
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from generator import files  # noqa: E402
from generator.laws import KINDS  # noqa: E402
from real_arm import LoadedArm  # noqa: E402

AT_JOINT = files.AT_JOINTS + files.AT_DRIVES


def numbers_of_mat(path):
    """Arrays of doubles of a MATLAB 5 file by name (MathWorks, MAT-File Format)."""
    with open(path, "rb") as file:
        content, at, out = file.read(), 128, {}
    while at < len(content):
        kind, size = struct.unpack_from("<II", content, at)
        body = content[at + 8:at + 8 + size]
        at += 8 + size
        if kind == 15:  # compressed
            body = zlib.decompress(body)[8:]
        parts, i = [], 0
        while i < len(body):
            kind, size = struct.unpack_from("<II", body, i)
            if kind >> 16:  # small: size and kind in one word
                kind, size, begin, i = kind & 0xFFFF, kind >> 16, i + 4, i + 8
            else:
                begin, i = i + 8, i + 8 + size + (-size) % 8
            parts.append((kind, body[begin:begin + size]))
        if len(parts) > 3 and parts[3][0] == 9:
            out[parts[2][1].decode()] = np.frombuffer(parts[3][1], "<f8")
    return out


def even(time, command, position, period, begin, end):
    """On even times: the command's last value holds, positions lie on straight lines between readings."""
    t = np.arange(begin, min(end, time[-1]), period)
    held = np.maximum(0, np.searchsorted(time, t + 1e-9, "right") - 1)
    return {"u": command[held], "q": np.interp(t, time, position)}


class Machine:
    """What a case says of one joint. recordings: (name, role, table of u and q)."""

    unit, sliding, center, inertia, links = "rad", False, 0.0, 1.0e-4, 0.0
    also_right = []

    def case(self):
        slide = self.sliding
        allowed = [{"kind": kind, "place": self.joint} for kind in AT_JOINT]
        allowed += [{"kind": "payload", "place": self.link}]
        allowed += [] if slide else [{"kind": "center_of_mass", "place": self.link}, {"kind": "gravity_tilt", "place": "base"}]
        allowed += [{"kind": kind, "place": f"q_{self.joint}"} for kind in ("sensor_offset", "sensor_gain")]
        quantity = files.quantity
        mass, rotor, damping, gain = self.stated
        return {
            "format": "missing-effect-case/1", "id": f"real_{self.name}", "machine": self.name, "title": self.title,
            "licence": self.licence, "source": self.where, "robot": "robot.urdf", "gravity": quantity(9.80665, "m/s^2"),
            "period": quantity(self.period, "s"), "seconds_allowed": 120, "masses": {self.link: quantity(mass[0], "kg", mass[1])},
            "drives": [{"joint": self.joint, "ratio": quantity(1.0, "rad/m" if slide else "1"),
                        "rotor_inertia": quantity(rotor[0], "kg m^2", rotor[1]),
                        "torque_gain": quantity(1.0, "1", gain),
                        "joint_damping": quantity(damping[0], "N s/m" if slide else "N m s/rad", damping[1])}],
            "springs": [], "feet": [],
            "columns": {f"u_{self.joint}": {"is": "command", "joint": self.joint, "unit": "N m"},
                        f"q_{self.joint}": {"is": "joint position", "joint": self.joint, "unit": self.unit,
                                            "resolution": self.resolution, "noise": self.noise, "judged_in": self.judged_in}},
            "recordings": [{"file": f"{name}.csv", "role": role, "start": {self.joint: float(f"{table['q'][0]:.9g}")}}
                           for name, role, table in self.recordings],
            "allowed": allowed, "meaning": KINDS}

    def urdf(self):
        i, mass = self.inertia, self.stated[0][0]
        limit = '<limit lower="-2" upper="2" effort="500" velocity="50"/>' if self.sliding else ""
        return (f'<?xml version="1.0"?>\n<robot name="{self.name}">\n  <link name="world"/>\n  <link name="{self.link}"><inertial>'
                f'<origin xyz="0 0 {-self.center}"/><mass value="{mass}"/><inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/>'
                f'</inertial></link>\n  <joint name="{self.joint}" type="{"prismatic" if self.sliding else "continuous"}">'
                f'<parent link="world"/><child link="{self.link}"/><origin xyz="0 0 0"/>'
                f'<axis xyz="{"1 0 0" if self.sliding else "0 1 0"}"/>{limit}</joint>\n</robot>\n')

    def write(self, out):
        case = self.case()
        truth = {"id": case["id"], "group": "real", "strength": "", "shows": None, "effects": self.effects, "also_right": self.also_right,
                 "source": self.source}
        tables = {f"{name}.csv": {f"u_{self.joint}": table["u"], f"q_{self.joint}": table["q"]} for name, _, table in self.recordings}
        files.write_files(out, case, self.urdf(), tables, truth, self.period)


def named(*pairs):
    return [{"kind": kind, "place": place, "values": {}} for kind, place in pairs]


class Emps(Machine):
    name, title, joint, link = "emps", "A carriage on a ball screw (EMPS)", "guide", "carriage"
    sliding, unit, period = True, "m", 0.002
    licence = "as the data set's authors give it: none is stated"
    where = "A. Janot, M. Gautier, M. Brunot, Data Set and Reference Models of EMPS, 2019, nonlinearbenchmark.org"
    # The moved mass, 95.1089 kg, is half link and half rotor: only the sum matters.
    stated = ((47.55445, 0.05), (47.55445, 0.05), (203.5034, 0.2), 0.02)
    resolution, noise, judged_in = 1.0e-7, 2.0e-8, 1.0e-4  # a CSV has seven digits; the sensor half of that
    effects = named(("asymmetric_friction", "guide"))
    also_right = [named(("coulomb_friction", "guide"), ("constant_force", "guide"))]
    source = ("The authors: dry friction, of another level in either direction (wear of the screw): inverse model's error 4.08 % without and "
              "3.11 % with it. Two levels are a mean level and a constant force.")

    def __init__(self, data):
        one, other = (numbers_of_mat(os.path.join(data, "emps", name)) for name in ("DATA_EMPS.mat", "DATA_EMPS_PULSES.mat"))

        def part(table, begin, end):
            return even(table["t"], 35.15065 * table["vir"], table["qm"], self.period, begin, end)
        self.recordings = [("train_1", "train", part(one, 2.0, 12.0)), ("train_2", "train", part(one, 12.0, 20.0)),
                           ("validation_1", "validation", part(other, 4.0, 14.0)), ("test_1", "test", part(one, 0.0, 2.0)),
                           ("test_2", "test", part(other, 0.0, 2.0))]


class Servo(Machine):
    name, title, joint, link = "servo", "A servo that swings a mass", "hinge", "arm"
    period, center, inertia = 0.005, 0.1, 1.0e-6
    licence = "Apache-2.0, of Rhoban/bam"
    where = "Rhoban/bam (af22604), data.bak/raw; Extended friction models for the physics simulation of servo actuators"
    stated = ((0.49, 0.03), (2.0e-3, 0.4), (0.048, 0.25), 0.2)  # back EMF as damping; data sheet of the XL330-M288
    resolution, noise, judged_in = 1.533981e-3, 0.0, 1.0e-2
    effects = named(("load_friction", "hinge"))
    also_right = [named(("load_friction", "hinge"), (kind, "hinge")) for kind in ("coulomb_friction", "stribeck_friction")]
    source = "The authors compared models of friction on this machine: those that grow with the load predict best (M3 to M6 of their paper)."

    def __init__(self, data):
        def part(name, begin=0.0, end=6.0):
            table = files.numbers_of_csv(os.path.join(data, "servo-pendulum", "trials", name, "data.csv"))
            return even(table["t"], 0.104 * table["u"], table["q"], self.period, table["t"][0] + begin, end)
        self.recordings = [("train_1", "train", part("kp100_sin_sin")), ("train_2", "train", part("kp200_up_and_down")),
                           ("train_3", "train", part("kp400_lift_and_drop")),
                           ("validation_1", "validation", part("kp400_sin_time_square")),
                           ("test_1", "test", part("kp800_sin_sin", end=2.0)), ("test_2", "test", part("kp800_up_and_down", end=2.0))]


class Pendulum(Machine):
    name, title, joint, link = "torque_pendulum", "A pendulum on a drive of low ratio", "shoulder", "arm"
    period, center, inertia = 0.003, 0.4519, 9.27e-3
    licence = "BSD-3-Clause, of the DFKI's underactuated lab"
    where = "dfki-ric-underactuated-lab/torque_limited_simple_pendulum (ed17ea2), results"
    stated = ((0.676, 0.03), (2.186e-3, 0.1), (0.0, 0.0), 0.05)
    resolution, noise, judged_in = 2.91447e-3, 0.0, 1.0e-2
    effects = named(("viscous_friction", "shoulder"), ("coulomb_friction", "shoulder"))
    source = "The authors' identified model: viscous and Coulomb friction. No experiment took either away."

    def __init__(self, data):
        def part(name, end=10.0):
            table = files.numbers_of_csv(os.path.join(data, "pendulum", "trials", name, "data.csv"))
            return even(table["t"], table["torque"], table["q"], self.period, 0.0, end)
        self.recordings = [("train_1", "train", part("pd_system_identification")), ("train_2", "train", part("energy_shaping", 8.0)),
                           ("validation_1", "validation", part("direct_collocation")), ("test_1", "test", part("ddp", 3.0)),
                           ("test_2", "test", part("sac", 2.0))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    for machine in (Emps, Servo, Pendulum, LoadedArm):
        if options.only in machine.name:
            try:
                machine(options.data).write(options.out)
                print(f"real_{machine.name}")
            except FileNotFoundError as missing:
                print(f"real_{machine.name} left out: {missing.filename} is not there; {machine.where}", file=sys.stderr)


if __name__ == "__main__":
    main()
