"""Writes a case as plain files: robot.urdf, case.json, one CSV for each recording; and its truth beside it. Reads such a CSV."""

import json
import os

import numpy as np

from generator import motion
from generator.laws import KINDS
from generator.machines import GRAVITY
from generator.world import PERIOD

AXES = {"rail": "0 0 1", "leg": "0 0 -1", "along": "1 0 0", "up": "0 0 1"}  # of sliding joints; the others turn about y
AT_JOINTS = ("viscous_friction", "coulomb_friction", "stribeck_friction", "asymmetric_friction", "quadratic_drag",
             "constant_force", "spring", "nonlinear_spring", "hard_stop")
AT_DRIVES = ("load_friction", "torque_ripple", "torque_gain", "actuator_lag", "actuator_delay", "rotor_inertia", "elastic_drive",
             "backlash")


def allowed(machine):
    """Every (kind, place) that an answer may name."""
    driven = list(machine.stated["drives"])
    pairs = [(kind, joint) for kind in AT_JOINTS for joint in machine.joints]
    pairs += [(kind, joint) for kind in AT_DRIVES for joint in driven]
    pairs += [("payload", link) for link in machine.stated["links"]]
    if not machine.sliding:
        pairs += [("center_of_mass", link) for link in machine.stated["links"]] + [("gravity_tilt", "base")]
    sensors = [name for name, about in columns(machine).items() if about["is"].endswith("position")]
    pairs += [(kind, sensor) for kind in ("sensor_offset", "sensor_gain") for sensor in sensors]
    pairs += [("switch_delay", name) for name, about in columns(machine).items() if about["is"] == "contact switch"]
    for place, ground in machine.stated.get("ground", {}).items():
        pairs += [(kind, place) for kind in ("ground_stiffness", "ground_damping", "ground_height")]
        pairs += [("ground_friction", place)] if "friction" in ground else []
    return [{"kind": kind, "place": place} for kind, place in pairs]


def urdf(machine):
    lines = ['<?xml version="1.0"?>', f'<robot name="{machine.name}">', '  <link name="world"/>']
    parent, origin = "world", 0.0
    for joint in machine.joints:
        name = machine.links[joint]
        link = machine.stated["links"].get(name)
        lines += urdf_link(name, link, joint in machine.sliding) + [
            f'  <joint name="{joint}" type="{"prismatic" if joint in machine.sliding else "continuous"}">',
            f'    <parent link="{parent}"/><child link="{name}"/><origin xyz="0 0 {origin}"/>',
            f'    <axis xyz="{AXES.get(joint, "0 1 0")}"/>']
        lines += ['    <limit lower="-2" upper="2" effort="500" velocity="50"/>'] if joint in machine.sliding else []
        lines += ['  </joint>']
        parent, origin = name, -(link or {}).get("length", 0.0)
    return "\n".join(lines + ["</robot>", ""])


def urdf_link(name, link, slides):
    """A link without mass has only a name."""
    if not link:
        return [f'  <link name="{name}"/>']
    inertia = link.get("inertia", 0.01)
    return [f'  <link name="{name}">',
            f'    <inertial><origin xyz="0 0 {-link.get("center", 0.0)}"/><mass value="{link["mass"]}"/>'
            f'<inertia ixx="{inertia}" ixy="0" ixz="0" iyy="{inertia}" iyz="0" izz="{inertia if slides else 0.1 * inertia}"/>'
            '</inertial>', '  </link>']


def quantity(value, unit, share=0.0):
    return {"value": value, "unit": unit, "standard_deviation": share * abs(value)}


def drives(machine):
    out = []
    for joint, drive in machine.stated["drives"].items():
        slides = joint in machine.sliding
        out.append({
            "joint": joint,
            "ratio": quantity(drive["ratio"], "rad/m" if slides else "1"),
            "rotor_inertia": quantity(drive["rotor_inertia"], "kg m^2", motion.KNOWN["rotor_inertia"]),
            "torque_gain": quantity(1.0, "1", motion.KNOWN["gain"]),
            "joint_damping": quantity(drive["damping"], "N s/m" if slides else "N m s/rad", motion.KNOWN["damping"])})
    return out


def columns(machine):
    out = {}
    for joint in machine.stated["drives"]:
        out[f"u_{joint}"] = {"is": "command", "joint": joint, "unit": "N m"}
    for joint in machine.joints:
        if machine.name != "hopper" or joint == "rail":  # the hopper's leg is seen by its motor only
            sensor = motion.sensor_kind(machine, joint)
            out[f"q_{joint}"] = {"is": "joint position", "joint": joint, "unit": "m" if joint in machine.sliding else "rad",
                                 "resolution": sensor[0], "noise": sensor[1]}
    for joint in machine.stated["drives"]:
        out[f"m_{joint}"] = {"is": "motor position", "joint": joint, "unit": "rad",
                             "resolution": motion.SENSORS["motor"][0], "noise": motion.SENSORS["motor"][1]}
    if "toe" in machine.stated.get("ground", {}):
        out["c_toe"] = {"is": "contact switch", "foot": "toe", "unit": "1"}
    return out


NORMAL = "force = depth^exponent (stiffness + damping depth_rate), never pulling; depth below z = 0, in m"
ALONG = "; along the ground -friction force tanh(slip / slip_scale), slip in m/s"


def feet(machine):
    """Points that may meet the ground. Effects of the ground are named at its place: the foot's name, where no other is given."""
    out = []
    for place, ground in machine.stated.get("ground", {}).items():
        about = {"law": NORMAL, "exponent": ground["exponent"], "stiffness": quantity(ground["stiffness"], "N/m^1.5"),
                 "damping": quantity(ground["damping"], "N s/m^2.5")}
        if "friction" not in ground:
            out.append({"name": place, "link": "foot", "point": [0.0, 0.0, -ground["length"]], "ground": about})
            continue
        about |= {"law": NORMAL + ALONG, "friction": quantity(ground["friction"], "1"), "slip_scale": quantity(ground["slip_scale"], "m/s")}
        out += [{"name": f"corner_{i + 1}", "place": place, "link": "cube", "point": [px, 0.0, pz], "ground": about}
                for i, (px, pz) in enumerate(machine.corners())]
    return out


def describe(identifier, machine, records):
    case = {
        "format": "missing-effect-case/1", "id": identifier, "machine": machine.name, "title": machine.title,
        "licence": "CC-BY-4.0", "robot": "robot.urdf", "gravity": quantity(GRAVITY, "m/s^2"),
        "period": quantity(PERIOD, "s"), "seconds_allowed": 120,
        "masses": {name: quantity(link["mass"], "kg", motion.KNOWN["mass"]) for name, link in machine.stated["links"].items()},
        "drives": drives(machine), "springs": [], "feet": [], "columns": columns(machine),
        "recordings": [{"file": f"{name}.csv", "role": role,
                        "start": dict(zip(machine.joints, [round(float(x), 6) for x in start]))}
                       for name, role, _, start in records],
        "allowed": allowed(machine), "meaning": KINDS}
    for joint, spring in machine.stated.get("springs", {}).items():
        slides = joint in machine.sliding
        case["springs"].append({"joint": joint, "stiffness": quantity(spring["stiffness"], "N/m" if slides else "N m/rad", motion.KNOWN["spring"]),
                                "rest": quantity(spring["rest"], "m" if slides else "rad")})
    case["feet"] = feet(machine)
    return case


def numbers_of_csv(path):
    """Columns by name; the unit behind each name is left out."""
    with open(path, encoding="utf-8") as file:
        names = [cell.split(" [")[0] for cell in file.readline().strip().split(",")]
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    return {name: values[:, i] for i, name in enumerate(names)}


def write_csv(path, units, table):
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(f"{name} [{unit}]" for name, unit in units) + "\n")
        for row in table:
            file.write(",".join(f"{x:.7g}" for x in row) + "\n")


def rounded(content):
    """Numbers with ten digits, so that a truth is the same, letter by letter, where a library's sine differs in the last place."""
    if isinstance(content, dict):
        return {key: rounded(value) for key, value in content.items()}
    if isinstance(content, (list, tuple)):
        return [rounded(value) for value in content]
    return float(f"{content:.10g}") if isinstance(content, float) else content


def write_json(path, content):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(content, file, indent=1, sort_keys=False)
        file.write("\n")


def write_recording(path, case, table, withheld, period):
    """table: by column's name. Of a test recording only time and what the robot was told is written: targets, or else commands."""
    kinds = [c["is"] for c in case["columns"].values()]
    told = "target" if "target" in kinds else "command"
    names = [n for n, c in case["columns"].items() if not withheld or c["is"] == told]
    units = [("t", "s")] + [(n, case["columns"][n]["unit"]) for n in names]
    count = len(next(iter(table.values())))
    write_csv(path, units, np.column_stack([np.arange(count) * period] + [table[n] for n in names]))


def write_case(out, case, machine, tables, truth):
    write_files(out, case, urdf(machine), tables, truth, PERIOD)


def write_files(out, case, robot, tables, truth, period):
    """Two folders: cases/ID for entrants, truths/ID for the score."""
    open_folder, truth_folder = (os.path.join(out, kind, case["id"]) for kind in ("cases", "truths"))
    for folder in (open_folder, truth_folder):
        os.makedirs(folder, exist_ok=True)
    with open(os.path.join(open_folder, "robot.urdf"), "w", encoding="utf-8") as file:
        file.write(robot)
    write_json(os.path.join(open_folder, "case.json"), case)
    write_json(os.path.join(truth_folder, "truth.json"), rounded(truth))
    for record in case["recordings"]:
        table = tables[record["file"]]
        write_recording(os.path.join(open_folder, record["file"]), case, table, record["role"] == "test", period)
        if record["role"] == "test":
            write_recording(os.path.join(truth_folder, record["file"]), case, table, False, period)
