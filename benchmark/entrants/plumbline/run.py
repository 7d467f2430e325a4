#!/usr/bin/env python3
"""Plumbline as an entrant: writes model.yaml and trials of a case, runs `diagnose --json`, and translates the answer.

Usage: run.py CASE_FOLDER OUT_FOLDER [--program PATH] [--keep]
"""

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from common import Case, read_csv, write_answer, write_prediction  # noqa: E402

KINDS = {
    "viscous": "viscous_friction", "coulomb": "coulomb_friction", "stribeck": "stribeck_friction", "lugre": "stribeck_friction",
    "viscous_directional": "asymmetric_friction", "coulomb_directional": "asymmetric_friction", "load_friction": "load_friction",
    "gear_friction": "load_friction", "quadratic": "quadratic_drag", "backlash": "backlash", "cable_stretch": "elastic_drive",
    "spring": "spring", "preload": "constant_force", "torque_bias": "constant_force", "hardening": "nonlinear_spring",
    "unilateral_spring": "nonlinear_spring", "hard_stop": "hard_stop", "cogging": "torque_ripple",
    "torque_constant_error": "torque_gain", "actuator_lag": "actuator_lag", "command_delay": "actuator_delay", "bus_delay": "actuator_delay",
    "rotor_inertia": "rotor_inertia", "added_mass": "payload", "payload": "payload", "com_shift": "center_of_mass",
    "gravity_tilt": "gravity_tilt", "encoder_offset": "sensor_offset", "encoder_scale": "sensor_gain",
    "switch_lateness": "switch_delay", "ground_stiffness_error": "ground_stiffness", "ground_damping_error": "ground_damping",
    "ground_friction_error": "ground_friction", "ground_height_error": "ground_height",
    "gear_efficiency": "load_friction", "asymmetric_spring": "nonlinear_spring", "current_loop": "actuator_lag", "winding": "actuator_lag",
    "harmonic_drive": "elastic_drive", "torque_ripple": "torque_ripple", "torque_saturation": "torque_gain", "voltage_limit": "torque_gain",
    "thermal_motor": "torque_gain", "battery": "torque_gain",
}
# (kind, parameter of the program) -> (name of the benchmark, power of the gear's ratio at a motor, sign)
VALUES = {
    ("coulomb_friction", "level"): ("level", 1, 1), ("viscous_friction", "damping"): ("damping", 2, 1),
    ("load_friction", "coefficient"): ("coefficient", 0, 1), ("quadratic_drag", "drag"): ("drag", 3, 1),
    ("constant_force", "bias"): ("force", 1, 1), ("constant_force", "preload"): ("force", 1, -1),
    ("torque_gain", "scale"): ("gain", 0, 1), ("actuator_lag", "time_constant"): ("time_constant", 0, 1),
    ("actuator_delay", "delay"): ("delay", 0, 1), ("rotor_inertia", "inertia"): ("inertia", 2, 1),
    ("payload", "mass"): ("mass", 0, 1), ("spring", "stiffness"): ("stiffness", 0, 1),
    ("elastic_drive", "stiffness"): ("stiffness", 2, 1), ("backlash", "gap"): ("gap", -1, 1),
    ("ground_friction", "scale"): ("scale", 0, 1), ("ground_stiffness", "scale"): ("scale", 0, 1), ("ground_damping", "scale"): ("scale", 0, 1),
    ("ground_height", "height"): ("height", 0, 1),
}
AT_RATIO = ("elastic_drive", "backlash")  # at the joint's name, in the motor's units
WHY = 'assumed: "stated in case.json"'


def number(value, unit, deviation=0.0):
    uncertain = f", uncertainty: {deviation}" if deviation else ""
    return f'{{value: {value}, unit: "{unit}"{uncertain}, {WHY}}}'


def model_text(case):
    about, joints = case.about, [r for r in case.about["recordings"][0]["start"]]
    lines = ["plumbline: model/1", f"robot: {json.dumps(about['title'])}", "skeleton: robot.urdf",
             f"gravity: {number(about['gravity']['value'], 'm/s^2')}", "masses:"]
    for link, mass in about["masses"].items():
        share = 100.0 * mass["standard_deviation"] / mass["value"]
        lines.append(f"  {link}: {{uncertainty: {share:.6g} %, {WHY}}}")
    lines += ["coordinates:"] + [f"  {joint}: {{of: {{{joint}: 1}}}}" for joint in joints] + ["motors:"] * bool(case.drives)
    for joint, drive in case.drives.items():
        inertia, gain = drive["rotor_inertia"], drive["torque_gain"]
        lines += [f"  {joint}_motor:", "    command_unit: N m",
                  f"    rotor_inertia: {number(inertia['value'], 'kg m^2', inertia['standard_deviation'])}",
                  f"    torque_constant: {number(gain['value'], '1', gain['standard_deviation'])}"]
    lines += ["ratios:"] * bool(case.drives)
    for joint, drive in case.drives.items():
        lines.append(f"  {joint}: {{motor: {joint}_motor, ratio: {number(drive['ratio']['value'], drive['ratio']['unit'])}}}")
    lines += feet_lines(case) + effect_lines(case) + sensor_lines(case)
    return "\n".join(lines) + "\n"


def ground_of(case, foot):
    """Feet on one ground share its laws as a group, which has the place's name; a foot that is alone on it keeps its own."""
    shared = [other for other in case.about["feet"] if other.get("place") == foot.get("place")]
    return foot["place"] if len(shared) > 1 or "radius" in foot else foot["name"]


def feet_lines(case):
    feet = case.about["feet"]
    lines = ["feet:"] * bool(feet)
    for foot in feet:
        ground = ground_of(case, foot)
        group = f"group: {ground}, " if ground != foot["name"] else ""
        radius = f"radius: {foot['radius']}, " if "radius" in foot else ""
        lines.append(f"  {foot['name']}: {{link: {foot['link']}, value: {foot['point']}, unit: m, {radius}{group}{WHY}}}")
    return lines


def sphere_lines(case):
    """The stated law in the program's numbers: at its reference depth, the one under the feet's share of the weight, it has the stated
    stiffness and damping. Such feet hold: bristles that hardly bend."""
    lines = []
    for place, foot in {foot["place"]: foot for foot in case.about["feet"] if "radius" in foot}.items():
        ground = foot["ground"]
        weight = case.about["gravity"]["value"] * sum(mass["value"] for mass in case.about["masses"].values())
        depth = weight / len(case.about["feet"]) / ground["stiffness"]["value"]
        stiffness = {key: depth * ground["stiffness"][key] for key in ("value", "standard_deviation")}
        damping, friction = ground["damping"], ground["friction"]
        lines += [f"  - {{effect: ground_normal, at: {place}, values: {{stiffness: {number(stiffness['value'], 'N', stiffness['standard_deviation'])}, "
                  f"damping: {number(damping['value'], 'N s/m', damping['standard_deviation'])}, exponent: {number(1, '1')}, "
                  f"reference_depth: {number(depth, 'm')}}}}}",
                  f"  - {{effect: ground_friction, at: {place}, values: {{bristle_stiffness: {number(20000, '1/m')}, bristle_damping: {number(10, 's/m')}, "
                  f"friction: {number(friction['value'], '1', friction['standard_deviation'])}}}}}"]
    return lines


def effect_lines(case):
    lines = ["effects:"]
    for joint, drive in case.drives.items():
        damping, square = drive["joint_damping"], drive["ratio"]["value"] ** 2
        value = number(damping["value"] / square, "N m s/rad", damping["standard_deviation"] / square)
        lines.append(f"  - {{effect: viscous, at: {joint}_motor, values: {{damping: {value}}}}}")
        if "joint_friction" in drive:
            dry, ratio = drive["joint_friction"], drive["ratio"]["value"]
            level = number(dry["value"] / ratio, "N m", dry["standard_deviation"] / ratio)
            lines.append(f"  - {{effect: coulomb, at: {joint}_motor, values: {{level: {level}, smoothing_speed: {number(0.01 * ratio, 'rad/s')}}}}}")
    for spring in case.about["springs"]:
        stiffness, rest = spring["stiffness"], spring["rest"]
        lines.append(f"  - {{effect: spring, at: {spring['joint']}, values: {{"
                     f"stiffness: {number(stiffness['value'], stiffness['unit'], stiffness['standard_deviation'])}, "
                     f"rest: {number(rest['value'], rest['unit'])}}}}}")
    lines += sphere_lines(case)
    points = {ground_of(case, foot): foot["ground"] for foot in case.about["feet"] if "radius" not in foot}
    for at, ground in points.items():
        lines.append(f"  - {{effect: ground_normal, at: {at}, values: {{"
                     f"stiffness: {number(ground['stiffness']['value'], 'N')}, damping: {number(ground['damping']['value'], 'N s/m')}, "
                     f"exponent: {number(ground['exponent'], '1')}}}}}")
        if "friction" in ground:
            lines.append(friction(at, ground))
    return lines if len(lines) > 1 else []


def friction(at, ground):
    return (f"  - {{effect: ground_coulomb, at: {at}, values: {{friction: {number(ground['friction']['value'], '1')}, "
            f"slip_speed: {number(ground['slip_scale']['value'], 'm/s')}}}}}")


def sensor_lines(case):
    lines = ["sensors:"]
    for name, about in case.columns.items():
        if about["is"] == "contact switch":
            lines.append(f"  {name}: {{contact: {about['foot']}, {WHY}}}")
        elif about["is"].endswith("position"):
            what = about["joint"] + ("_motor" if about["is"] == "motor position" else "")
            lines.append(f"  {name}: {{measures: {what}, resolution: {number(about['resolution'], about['unit'])}, "
                         f"noise: {number(about['noise'], about['unit'])}, {WHY}}}")
    for kind, names in inertial(case).items():
        about = case.columns[names[0]]
        at = f"at: {{value: {about['point']}, unit: m}}, " if kind == "accelerometer" else ""
        noise = number(about["noise"], "rad" if kind == "orientation" else about["unit"])
        lines.append(f"  imu_{kind}: {{{kind}: {about['link']}, {at}noise: {noise}, {WHY}}}")
    return lines


def inertial(case):
    """Columns of the inertial unit by what they are, in the order of their components."""
    out = {}
    for name, about in case.columns.items():
        if about["is"].startswith("imu "):
            out.setdefault(about["is"].removeprefix("imu "), []).append(name)
    return out


def trial_text(case, data, role, held):
    """held: the robot was let go with the first row, its actuators without torque."""
    before = ", before: {value: 0, unit: N m}" if held else ""
    lines = ["plumbline: trial/1", f"title: {os.path.basename(data)}", "model: ../model.yaml", f"role: {role}", f"data: {data}",
             "time: {column: t, unit: s}"] + ["commands:"] * bool(case.drives)
    lines += [f"  {about['joint']}_motor: {{column: {name}, unit: N m{before}}}" for name, about in case.columns.items()
              if about["is"] == "command"]
    lines.append("measured:")
    lines += [f"  {name}: {{column: {name}, unit: \"{about['unit']}\"}}" for name, about in case.columns.items()
              if about["is"].endswith("position") or about["is"] == "contact switch"]
    lines += [f"  imu_{kind}: {{columns: [{', '.join(names)}], unit: \"{case.columns[names[0]]['unit']}\"}}" for kind, names in inertial(case).items()]
    return "\n".join(lines) + "\n"


def closed_loop_text(case, data):
    """A trial to predict whose commands follow from the control's law, here a cascade of the same gains; the recorded commands beside it are
    zeros that nobody uses. Its readings are not rounded: the law knows the joints themselves."""
    law = case.about["control"]
    damping, stiffness = law["velocity_gain"], law["position_gain"]
    text = trial_text(case, data, "held-out", held=False)
    head, measured = text[:text.index("measured:")], text[text.index("measured:"):]
    for name, about in case.columns.items():
        if about["is"] == "joint position":
            measured = measured.replace(f"column: {name},", f"column: {name}, resolution: {number(1e-9, about['unit'])},")
    lines = ["controllers:"]
    for name, about in case.columns.items():
        if about["is"] == "target":
            lines.append(f"  - {{kind: cascade_pd, motor: {about['joint']}_motor, sensor: q_{about['joint']}, reference: {{column: {name}, unit: {about['unit']}}}, "
                         f"position_gain: {number(stiffness['value'] / damping['value'], '1/s')}, "
                         f"velocity_gain: {number(damping['value'], damping['unit'])}}}")
    return head + "\n".join(lines) + "\n" + measured


def start_row(case, entry):
    """What the sensors read of a robot that is held at its start, with its feet in the air."""
    start, row = entry["start"], {name: 0.0 for name, about in case.columns.items() if about["is"] == "contact switch"}
    for kind, names in inertial(case).items():
        rest = {"orientation": entry["start_base"]["orientation"], "gyroscope": [0.0] * 3,
                "accelerometer": [0.0, 0.0, case.about["gravity"]["value"]]}[kind]  # a base that is level
        row |= dict(zip(names, rest))
    return {**row, **{name: start[about["joint"]] * (case.drives[about["joint"]]["ratio"]["value"]
                                           if about["is"] == "motor position" else 1.0)
            for name, about in case.columns.items() if name in case.positions()}}


def write_inputs(case, work):
    """Model and trials; returns the trials to diagnose and those to predict, {file: folder}."""
    shutil.copy(os.path.join(case.folder, "robot.urdf"), work)
    with open(os.path.join(work, "model.yaml"), "w", encoding="utf-8") as file:
        file.write(model_text(case))
    given, asked = [], {}
    for entry in case.about["recordings"]:
        folder = os.path.join(work, entry["file"].removesuffix(".csv"))
        os.makedirs(folder, exist_ok=True)
        test = entry["role"] == "test"
        with open(os.path.join(folder, "trial.yaml"), "w", encoding="utf-8") as file:
            held = "control" not in case.about and (test or not case.about["id"].startswith("real_"))
            file.write(closed_loop_text(case, entry["file"]) if test and "control" in case.about
                       else trial_text(case, entry["file"], "train" if entry["role"] == "train" else "held-out", held))
        if test:  # what is to be predicted is not there: the program begins where these constants say
            table = read_csv(os.path.join(case.folder, entry["file"]))
            held = {n: np.full(len(table["t"]), x) for n, x in start_row(case, entry).items()}
            units = {n: case.columns[n] for n in case.columns}
            idle = {n: np.zeros(len(table["t"])) for n in case.columns if case.columns[n]["is"] == "command" and n not in table}
            body = {n: table[n] for n in table if n != "t"} | idle
            write_prediction(folder, entry["file"], table["t"], {**body, **held}, units)
            asked[entry["file"]] = folder
        else:
            shutil.copy(os.path.join(case.folder, entry["file"]), folder)
            given.append(folder)
    return given, asked


def place_of(case, at):
    places = {foot["name"]: foot.get("place", foot["name"]) for foot in case.about["feet"]}
    return "base" if at == "world" else places.get(at, at.removesuffix("_motor"))


def limb_of(case, at):
    """The program names a limb by its first link."""
    root = xml.parse(os.path.join(case.folder, "robot.urdf")).getroot()
    first = {joint.get("name"): joint.find("child").get("link") for joint in root.findall("joint")}
    return next((limb for limb, joints in case.about.get("limbs", {}).items() if first[joints[0]] == at), place_of(case, at))


def name_of(case, effect):
    """(kind, place) of what the program says."""
    at = effect["at"]
    return KINDS.get(effect["effect"], "other"), limb_of(case, at) if effect["effect"] == "bus_delay" else place_of(case, at)


def values_of(case, kind, at, parameters):
    out = {}
    for parameter in parameters:
        rule = VALUES.get((kind, parameter["name"]))
        if not rule or parameter.get("chosen") or parameter["standard_deviation"] in (None, "inf"):
            continue
        name, power, sign = rule
        at_motor = at.endswith("_motor") or kind in AT_RATIO
        factor = sign * (case.drives[place_of(case, at)]["ratio"]["value"] ** power if at_motor else 1.0)
        middle, half = factor * parameter["value"], 1.96 * abs(factor) * parameter["standard_deviation"]
        out[name] = {"value": middle, "interval": [middle - half, middle + half]}
    return out


def translate(case, result):
    """Verdict and slots. A name's confidence is the share of resamples that chose it; its rivals share what is left."""
    verdict = {"missing": "found", "nothing_missing": "nothing", "unexplained": "outside"}[result["verdict"]]
    slots = []
    for accepted in result["accepted"]:
        kind, place = name_of(case, accepted)
        if (kind, place) in [(n[0]["kind"], n[0]["place"]) for n in slots]:
            continue  # another law of the same kind there
        share = min(0.95, max(0.05, accepted["selected_share"]))
        names = [{"kind": kind, "place": place, "confidence": share,
                  "values": values_of(case, kind, accepted["at"], accepted["parameters"])}]
        rivals = [name_of(case, rival) for rival in accepted["rivals"]]
        rivals = [name for name in rivals if name == (kind, place) or name in case.allowed]
        for rival in rivals:  # laws of one kind share a name
            one = next((n for n in names if (n["kind"], n["place"]) == rival), None)
            if one is None:
                one = {"kind": rival[0], "place": rival[1], "confidence": 0.0}
                names.append(one)
            one["confidence"] += (1.0 - share) / len(rivals)
        for name in names:
            name["confidence"] = min(0.95, max(0.01, name["confidence"]))
        slots.append(names)
    if verdict == "outside":
        for name in (n for names in slots for n in names):
            name["confidence"] *= 0.5
    return verdict, slots


def predict(case, program, asked, model, out):
    for name, folder in asked.items():
        trace = os.path.join(folder, "trace.csv")
        loop = ["--closed-loop"] if "control" in case.about else []
        done = subprocess.run([program, "simulate", folder, "--model", model, "-o", trace, *loop], capture_output=True, text=True)
        if done.returncode == 0:
            table = read_csv(trace)
            write_prediction(out, name, table["t"], {c: table[f"q_{c}"] for c in case.positions()}, case.columns)
        else:
            print(done.stderr.strip(), file=sys.stderr)


def processor_seconds(process):
    """Of a child that runs, from Linux' account of it."""
    with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def diagnose(command, seconds):
    """Ends the diagnosis as Ctrl-C does when 85 % of the time are over: it then writes what it has."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    while process.poll() is None:
        if processor_seconds(process) > 0.85 * seconds:
            process.send_signal(signal.SIGINT)
            process.wait()
        time.sleep(0.1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("out")
    parser.add_argument("--program", default="plumbline")
    parser.add_argument("--keep", action="store_true", help="leave the program's files in OUT_FOLDER/work")
    options = parser.parse_args()
    case, work = Case(options.case), os.path.join(options.out, "work")
    os.makedirs(work, exist_ok=True)
    given, asked = write_inputs(case, work)
    found, result = os.path.join(work, "found.yaml"), os.path.join(work, "result.json")
    model = os.path.join(work, "model.yaml")
    predict(case, options.program, asked, model, options.out)  # should the time end: the model as it was given
    write_answer(options.out, case, "nothing", [], otherwise=0.02)
    # A robot that stands on its feet: few windows, short as its contacts are.
    windows = ["--window", "0.25", "--windows", "4"] if "floating_base" in case.about else []
    diagnose([options.program, "diagnose", *given, *windows, "--json", result, "--save", found], case.about["seconds_allowed"])
    with open(result, encoding="utf-8") as file:
        verdict, slots = translate(case, json.load(file))
    write_answer(options.out, case, verdict, slots)
    predict(case, options.program, asked, found if os.path.exists(found) else model, options.out)
    if not options.keep:
        shutil.rmtree(work)


if __name__ == "__main__":
    main()
