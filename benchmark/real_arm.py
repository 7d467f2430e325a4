"""A case of a measured arm with six joints and something known at its flange.

The numbers that are stated are those of the arm without it: rough masses, and the gains and frictions that its authors identified, all at
the joints, so a drive's ratio is 1. robots/ur10e/sources.md says where each comes from.
"""

import os
import xml.etree.ElementTree as xml

import numpy as np

from generator import files
from generator.laws import KINDS

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# joint: gain in N m/A, viscous friction in N m s/rad, Coulomb friction in N m
DRIVES = {"shoulder_pan": (10.0, 21.3, 12.5), "shoulder_lift": (10.7, 20.2, 13.3), "elbow": (8.46, 10.4, 5.0),
          "wrist_1": (9.0, 3.6, 2.0), "wrist_2": (9.48, 2.5, 2.7), "wrist_3": (10.1, 3.0, 2.3)}


def even(table, period, begin, end):
    """On even times: commands and positions on straight lines between readings, which come about every 10 ms."""
    t = np.arange(begin, end, period)
    out = {f"q_{joint}": np.interp(t, table["t"], table[f"q_{joint}"]) for joint in DRIVES}
    for joint, (gain, _, _) in DRIVES.items():
        out[f"u_{joint}"] = gain * np.interp(t, table["t"], table[f"i_{joint}"])
    return out


class LoadedArm:
    name, period, loaded_link = "ur10e", 0.01, "wrist_3_link"
    where = "shamilmamedov/dynamic_calibration (11af40e), dataset_ur10e; Mamedov and Mikhel, Frontiers in Robotics and AI 2020"
    source = "2.805 kg were at the flange (estimate_drive_gains.m of the recordings' repository); the stated numbers are those of the arm without them."

    def __init__(self, data):
        table = files.numbers_of_csv(os.path.join(data, "ur10e-payload", "loaded.csv"))
        parts = (("train_1", "train", 5.0, 20.0), ("validation_1", "validation", 22.0, 35.0), ("test_1", "test", 0.0, 1.0))
        self.recordings = [(name, role, even(table, self.period, begin, end)) for name, role, begin, end in parts]

    def skeleton(self):
        """Without the flange, and with the world as its root."""
        tree = xml.parse(os.path.join(ROOT, "robots", "ur10e", "ur10e.urdf"))
        robot = tree.getroot()
        for element in list(robot):
            if element.get("name") in ("flange", "flange_mount"):
                robot.remove(element)
        root = robot.find("link")
        robot.find(f"joint/parent[@link='{root.get('name')}']").set("link", "world")
        root.set("name", "world")
        return robot

    def allowed(self, links):
        pairs = [(kind, joint) for kind in files.AT_JOINTS + files.AT_DRIVES for joint in DRIVES]
        pairs += [(kind, link) for kind in ("payload", "center_of_mass") for link in links] + [("gravity_tilt", "base")]
        pairs += [(kind, f"q_{joint}") for kind in ("sensor_offset", "sensor_gain") for joint in DRIVES]
        return [{"kind": kind, "place": place} for kind, place in pairs]

    def case(self, robot):
        quantity = files.quantity
        masses = {link.get("name"): float(link.find("inertial/mass").get("value"))
                  for link in robot.findall("link") if link.find("inertial") is not None}
        columns = {f"u_{joint}": {"is": "command", "joint": joint, "unit": "N m"} for joint in DRIVES}
        columns |= {f"q_{joint}": {"is": "joint position", "joint": joint, "unit": "rad", "resolution": 1.0e-4, "noise": 0.0,
                                   "judged_in": 1.0e-2} for joint in DRIVES}
        return {
            "format": "missing-effect-case/1", "id": f"real_{self.name}", "machine": self.name,
            "title": "An arm with six joints", "licence": "none is stated by the recordings' owners", "source": self.where,
            "robot": "robot.urdf", "gravity": quantity(9.80665, "m/s^2"), "period": quantity(self.period, "s"), "seconds_allowed": 600,
            "masses": {link: quantity(mass, "kg", 0.1) for link, mass in masses.items()},
            "drives": [{"joint": joint, "ratio": quantity(1.0, "1"), "rotor_inertia": quantity(0.3, "kg m^2", 1.0),
                        "torque_gain": quantity(1.0, "1", 0.1), "joint_damping": quantity(viscous, "N m s/rad", 0.4),
                        "joint_friction": quantity(dry, "N m", 0.4)} for joint, (_, viscous, dry) in DRIVES.items()],
            "springs": [], "feet": [], "columns": columns,
            "recordings": [{"file": f"{name}.csv", "role": role, "start": {j: float(f"{table[f'q_{j}'][0]:.9g}") for j in DRIVES}}
                           for name, role, table in self.recordings],
            "allowed": self.allowed(masses), "meaning": KINDS}

    def write(self, out):
        robot = self.skeleton()
        case = self.case(robot)
        hidden = {"kind": "payload", "place": self.loaded_link, "values": {"mass": 2.805}}
        truth = {"id": case["id"], "group": "real", "strength": "", "shows": None, "effects": [hidden], "also_right": [],
                 "source": self.source}
        tables = {f"{name}.csv": table for name, _, table in self.recordings}
        files.write_files(out, case, xml.tostring(robot, encoding="unicode") + "\n", tables, truth, self.period)
