"""Commands of the recordings, true numbers, sensors: what an experimenter chooses and what a bench makes of it."""

import copy

import numpy as np

from generator.world import PERIOD

LEVEL = {"pendulum": {"shoulder": 1.0}, "arm": {"shoulder": 1.8, "elbow": 0.45}, "hopper": {"leg": 34.0}, "cube": {},
         "leg": {"hip": 2.0, "knee": 0.8}}  # N m or N at the joint
BAND = {"pendulum": (0.4, 5.0), "arm": (0.4, 5.0), "hopper": (1.5, 6.0), "cube": (1.0, 1.0), "leg": (0.4, 5.0)}  # Hz
SECONDS = {"train": 3.0, "validation": 3.0, "test": 1.0}
DROP_SECONDS = {"train": 1.2, "validation": 1.2, "test": 0.6}  # of the cube: it soon lies still
# One standard deviation of what is stated, as a share.
KNOWN = {"mass": 0.01, "rotor_inertia": 0.05, "damping": 0.1, "gain": 0.02, "spring": 0.01}
# Resolution and noise (standard deviation) of positions, rad or m; a motor's at the motor.
SENSORS = {"turn": (1.0e-4, 5.0e-5), "slide": (2.0e-5, 1.0e-5), "motor": (1.5e-3, 5.0e-4)}


def multisine(rng, level, band, count):
    t = np.arange(count) * PERIOD
    frequencies = np.exp(rng.uniform(np.log(band[0]), np.log(band[1]), 5))
    return level * sum(np.sin(2 * np.pi * f * t + rng.uniform(0, 2 * np.pi)) for f in frequencies) / 1.8


def chirp(rng, level, band, count):
    t = np.arange(count) * PERIOD
    length, growth = count * PERIOD, np.log(band[1] / band[0])
    return level * np.sin(2 * np.pi * band[0] * length / growth * (np.exp(growth * t / length) - 1) + rng.uniform(0, 6))


def steps(rng, level, band, count):
    out, k = np.zeros(count), 0
    while k < count:
        length = int(rng.uniform(0.1, 0.45) / PERIOD)
        out[k:k + length] = level * rng.uniform(-1.0, 1.0)
        k += length
    return out + 0.4 * multisine(rng, level, band, count)


def recordings(machine, rng):
    """[(name, role, commands in N m or N at the joint, start positions)]."""
    kind, out = machine.name, []
    for name, role, shape in (("train_1", "train", multisine), ("train_2", "train", chirp), ("validation_1", "validation", steps),
                              ("test_1", "test", steps), ("test_2", "test", multisine)):
        count = int((DROP_SECONDS if kind == "cube" else SECONDS)[role] / PERIOD)
        commands = np.zeros((count, len(machine.joints)))
        for joint, level in LEVEL[kind].items():
            commands[:, machine.joints.index(joint)] = shape(rng, level, BAND[kind], count)
        if kind == "hopper":
            extension = 0.0196
            start = [0.4 + extension + rng.uniform(0.015, 0.035), extension]
        elif kind == "cube":
            start = [rng.uniform(-0.1, 0.1), rng.uniform(0.15, 0.35), rng.choice((-1, 1)) * rng.uniform(0.2, 0.6)]
        else:
            start = list(rng.uniform(-0.5, 0.5, len(machine.joints)))
        out.append((name, role, commands, start))
    return out


def true_numbers(machine, rng):
    """The stated numbers, scattered within what is stated of them: normal, cut at two deviations."""
    def factor(share):
        return 1.0 + share * float(np.clip(rng.normal(), -2.0, 2.0))

    numbers = copy.deepcopy(machine.stated)
    for link in numbers["links"].values():
        f = factor(KNOWN["mass"])
        link["mass"] *= f
        if "inertia" in link:
            link["inertia"] *= f
    for drive in numbers["drives"].values():
        drive["rotor_inertia"] *= factor(KNOWN["rotor_inertia"])
        drive["damping"] *= factor(KNOWN["damping"])
        drive["gain"] = factor(KNOWN["gain"])
    for spring in numbers.get("springs", {}).values():
        spring["stiffness"] *= factor(KNOWN["spring"])
    return numbers


def sensor_kind(machine, joint):
    return SENSORS["slide" if joint in machine.sliding else "turn"]


def read(values, sensor, rng):
    """Counts of a noisy sensor, as positions."""
    resolution, noise = sensor
    return resolution * np.round((values + noise * rng.normal(size=len(values))) / resolution)


def floor(sensor):
    resolution, noise = sensor
    return float(np.hypot(resolution / np.sqrt(12.0), noise))
