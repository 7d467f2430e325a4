"""The hidden effects as laws, each written for the benchmark. SI units, on the joint's side of the gear.

A force law is made from its values and returns a function (t, q, v, angle) -> generalised force on its joint, with position q and speed
v of the joint and the motor's angle. Dry friction changes sign within SHARPNESS of standstill.
"""

import math

SHARPNESS = 0.002  # rad/s or m/s


def sign(speed):
    return math.tanh(speed / SHARPNESS)


def viscous(values):
    return lambda t, q, v, angle: -values["damping"] * v


def coulomb(values):
    return lambda t, q, v, angle: -values["level"] * sign(v)


def stribeck(values):
    level, rise, speed = values["level"], values["rise"], values["speed"]
    return lambda t, q, v, angle: -(level + rise * math.exp(-(v / speed) ** 2)) * sign(v)


def asymmetric(values):
    """Coulomb friction of another level in either direction: level + difference forward, level - difference backward."""
    return lambda t, q, v, angle: -(values["level"] + values["difference"] * sign(v)) * sign(v)


def quadratic(values):
    return lambda t, q, v, angle: -values["drag"] * abs(v) * v


def ripple(values):
    return lambda t, q, v, angle: values["amplitude"] * math.sin(values["cycles"] * angle + values["phase"])


def constant(values):
    return lambda t, q, v, angle: values["force"]


def spring(values):
    return lambda t, q, v, angle: -values["stiffness"] * (q - values["rest"])


def hard_stop(values):
    """Beyond a position, on the side of growing q: stiff and damped, never pulling."""
    def force(t, q, v, angle):
        depth = q - values["position"]
        return -max(0.0, values["stiffness"] * depth + values["damping"] * v) if depth > 0.0 else 0.0
    return force


# Outside any usual catalogue.

def patch_friction(values):
    """Viscous friction that is there in one part of the travel only, as over a worn patch or a magnet."""
    return lambda t, q, v, angle: -values["damping"] * v * math.exp(-((q - values["center"]) / values["width"]) ** 2)


def latch(values):
    """A magnet beside the path: pulls towards a position from either side, and lets go."""
    def force(t, q, v, angle):
        x = (q - values["center"]) / values["width"]
        return -values["pull"] * x * math.exp(0.5 - 0.5 * x * x)
    return force


def warming(values):
    """Viscous friction that changes with time, as oil does that warms up."""
    return lambda t, q, v, angle: -values["damping"] * math.exp(-t / values["time"]) * v


FORCES = {
    "viscous_friction": viscous, "coulomb_friction": coulomb, "stribeck_friction": stribeck,
    "asymmetric_friction": asymmetric, "quadratic_drag": quadratic, "torque_ripple": ripple, "constant_force": constant,
    "spring": spring, "hard_stop": hard_stop, "patch_friction": patch_friction, "latch": latch, "warming": warming,
}

# What an answer may name: kind -> meaning. The generator knows more (patch_friction, latch, warming, absorber): they are outside.
KINDS = {
    "viscous_friction": "friction in proportion to speed, beyond what is stated",
    "coulomb_friction": "dry friction of constant level",
    "stribeck_friction": "dry friction that is higher near standstill",
    "asymmetric_friction": "dry friction of another level in either direction",
    "load_friction": "dry friction in proportion to the force that the gear passes on",
    "quadratic_drag": "drag in proportion to the square of speed",
    "torque_ripple": "a force that repeats with the motor's angle (cogging)",
    "constant_force": "a constant force or torque, of the drive or beside it",
    "torque_gain": "the drive gives another multiple of its command than stated",
    "actuator_lag": "the drive follows its command as a first-order lag",
    "actuator_delay": "the drive follows its command after a pure delay",
    "rotor_inertia": "more inertia at the drive than stated",
    "payload": "a mass that hangs on a link",
    "center_of_mass": "a link whose mass is as stated, and sits elsewhere",
    "spring": "a linear spring at a joint, beyond what is stated",
    "nonlinear_spring": "a spring whose force is not linear, or that acts on one side only",
    "hard_stop": "a stiff contact beyond a position",
    "elastic_drive": "a transmission that stretches as a damped spring",
    "backlash": "a transmission with play",
    "gravity_tilt": "a base that is not level",
    "sensor_offset": "a sensor whose zero is displaced",
    "sensor_gain": "a sensor that reads a multiple of the position",
    "switch_delay": "a contact switch that reads late or early",
    "ground_stiffness": "a ground that is stiffer or softer than stated",
    "ground_damping": "a ground that is damped otherwise than stated",
    "ground_friction": "a ground that holds more or less along its surface than stated",
    "ground_height": "a ground that is higher or lower than stated",
}
