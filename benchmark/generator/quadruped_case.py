"""A case of the quadruped: what is stated and may be named, what its sensors read, and how far what is hidden shows."""

import math

import numpy as np

from generator import files, motion, quadruped as robot, quadruped_motion
from generator.laws import KINDS
from generator.machines import GRAVITY

# Resolution and noise (standard deviation) of the encoders, rad; noise of the inertial unit.
ENCODER = (2.0e-4, 1.0e-4)
NOISE = {"orientation": 1.0e-3, "gyroscope": 3.0e-3, "accelerometer": 0.05}  # rad about each axis, rad/s, m/s^2
UNITS = {"orientation": "1", "gyroscope": "rad/s", "accelerometer": "m/s^2"}
SECONDS_ALLOWED = 600
LIMBS = {f"{leg}_leg": [f"{leg}_{joint}" for joint in ("side", "hip", "knee")] for leg in robot.LEGS}


def columns():
    out = {f"r_{joint}": {"is": "target", "joint": joint, "unit": "rad"} for joint in robot.JOINTS}
    out |= {f"u_{joint}": {"is": "command", "joint": joint, "unit": "N m"} for joint in robot.JOINTS}
    out |= {f"q_{joint}": {"is": "joint position", "joint": joint, "unit": "rad", "resolution": ENCODER[0], "noise": ENCODER[1]}
            for joint in robot.JOINTS}
    for kind, noise in NOISE.items():
        for component in ("wxyz" if kind == "orientation" else "xyz"):
            out[f"{kind}_{component}"] = {"is": f"imu {kind}", "link": "trunk", "component": component, "point": list(robot.IMU),
                                          "unit": UNITS[kind], "resolution": 0.0, "noise": noise}
    return out


def allowed():
    pairs = [(kind, joint) for kind in files.AT_JOINTS + files.AT_DRIVES for joint in robot.JOINTS]
    pairs += [("actuator_delay", limb) for limb in LIMBS]
    pairs += [(kind, link) for kind in ("payload", "center_of_mass") for link in robot.LINKS]
    pairs += [(kind, f"q_{joint}") for kind in ("sensor_offset", "sensor_gain") for joint in robot.JOINTS]
    pairs += [(f"ground_{name}", robot.PLACE) for name in robot.GROUND]
    return [{"kind": kind, "place": place} for kind, place in pairs]


def feet():
    law = ("force = stiffness depth + damping depth_rate, never pulling; depth of the sphere's lowest point below z = 0, in m; along the "
           "ground up to friction force, against the slip; below that the foot holds")
    known = robot.KNOWN["ground"]
    ground = {"law": law, "exponent": files.quantity(1.0, "1"),
              "stiffness": files.quantity(robot.GROUND["stiffness"], "N/m", known["stiffness"]),
              "damping": files.quantity(robot.GROUND["damping"], "N s/m", known["damping"]),
              "friction": files.quantity(robot.GROUND["friction"], "1", known["friction"])}
    return [{"name": f"{leg}_foot", "place": robot.PLACE, "link": f"{leg}_shin", "point": list(robot.mounts(leg)[3]), "radius": robot.RADIUS,
             "ground": ground} for leg in robot.LEGS]


def drives():
    known = robot.KNOWN
    return [{"joint": joint, "ratio": files.quantity(1.0, "1"),
             "rotor_inertia": files.quantity(robot.DRIVE["rotor_inertia"], "kg m^2", known["rotor_inertia"]),
             "torque_gain": files.quantity(1.0, "1", known["gain"]),
             "joint_damping": files.quantity(robot.DRIVE["damping"], "N m s/rad", known["damping"])} for joint in robot.JOINTS]


def describe(identifier, records):
    law = "command = position_gain (target - position) - velocity_gain speed: of the joint itself, at each row, held to the next one"
    return {
        "format": "missing-effect-case/1", "id": identifier, "machine": robot.NAME, "title": robot.TITLE, "licence": "CC-BY-4.0",
        "robot": "robot.urdf", "floating_base": "trunk", "gravity": files.quantity(GRAVITY, "m/s^2"),
        "period": files.quantity(robot.PERIOD, "s"), "seconds_allowed": SECONDS_ALLOWED,
        "masses": {link: files.quantity(robot.body(link)[0], "kg", robot.KNOWN["mass"]) for link in robot.LINKS},
        "drives": drives(), "limbs": LIMBS,
        "control": {"law": law, "position_gain": files.quantity(robot.POSITION_GAIN, "N m/rad"),
                    "velocity_gain": files.quantity(robot.VELOCITY_GAIN, "N m s/rad")},
        "springs": [], "feet": feet(), "columns": columns(),
        "recordings": [{"file": f"{name}.csv", "role": role, "start": dict(zip(robot.JOINTS, start["joints"])),
                        "start_base": {"position": start["position"], "orientation": start["orientation"]}}
                       for name, role, _, start in records],
        "allowed": allowed(), "meaning": KINDS}


def turned(orientations, rng):
    """Quaternions (w first) with a small turn about each of the sensor's axes."""
    half = 0.5 * rng.normal(0.0, NOISE["orientation"], (len(orientations), 3))
    w, v = orientations[:, :1], orientations[:, 1:]
    return np.hstack([w - np.sum(v * half, axis=1, keepdims=True), v + w * half + np.cross(v, half)])


def readings(log, targets, rng):
    """By column, what a recording has."""
    table = {f"r_{joint}": targets[:, i] for i, joint in enumerate(robot.JOINTS)}
    table |= {f"u_{joint}": log["u"][:, i] for i, joint in enumerate(robot.JOINTS)}
    table |= {f"q_{joint}": motion.read(log["q"][:, i], ENCODER, rng) for i, joint in enumerate(robot.JOINTS)}
    orientation = turned(log["orientation"], rng)
    table |= {f"orientation_{component}": orientation[:, i] for i, component in enumerate("wxyz")}
    for kind in ("gyroscope", "accelerometer"):
        seen = log[kind] + rng.normal(0.0, NOISE[kind], log[kind].shape)
        table |= {f"{kind}_{component}": seen[:, i] for i, component in enumerate("xyz")}
    return table


def also_right(effects):
    """A late leg is, letter by letter, its three motors late alike."""
    for effect in effects:
        if effect["place"] in LIMBS:
            rest = [e for e in effects if e is not effect]
            return [rest + [dict(effect, place=joint) for joint in LIMBS[effect["place"]]]]
    return []


def shows(world, numbers, logs, records):
    """By how many floors joint positions of the train recordings, from their starts to their ends, differ without what is hidden, under the
    same law: root mean square."""
    squares = []
    for log, (_, _, targets, start) in zip(logs, records):
        squares.append(np.mean((world.run(numbers, [], start, targets)["q"] - log["q"]) ** 2))
    return float(np.sqrt(np.mean(squares)) / math.hypot(ENCODER[0] / math.sqrt(12.0), ENCODER[1]))


def make(world, out, identifier, entry, seed):
    _, group, strength, maker = entry
    rng = np.random.default_rng(seed)
    effects = maker(rng)
    numbers = robot.true_numbers(rng)
    records = quadruped_motion.recordings(rng)
    tables, logs = {}, []
    for name, role, targets, start in records:
        log = world.run(numbers, effects, start, targets)
        logs += [log] if role == "train" else []
        tables[f"{name}.csv"] = readings(log, targets, rng)
    truth = {"id": identifier, "group": group, "strength": strength, "effects": effects, "numbers": numbers,
             "shows": shows(world, numbers, logs, records) if effects else 0.0, "period": robot.PERIOD}
    others = also_right(effects)
    if others:
        truth["also_right"] = others
    files.write_files(out, describe(identifier, records), robot.urdf(), tables, truth, robot.PERIOD)
    return truth
