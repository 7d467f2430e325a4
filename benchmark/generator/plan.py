"""Which cases there are: what is hidden in which machine, where and how strong. Values are drawn within 15 %."""

STRENGTHS = {"weak": 0.12, "medium": 0.5, "strong": 1.5}

# (kind, place, values at medium strength, the value that strength multiplies). A value after "1+" is 1 + strength * (value - 1); after
# "1/" it is divided by strength, one after "0-" lowered by a fifth of it.
SINGLES = {
    "pendulum": [
        ("coulomb_friction", "shoulder", {"level": 0.15}, "level"),
        ("stribeck_friction", "shoulder", {"level": 0.1, "rise": 0.15, "speed": 0.3}, "rise level"),
        ("load_friction", "shoulder", {"coefficient": 0.12}, "coefficient"),
        ("quadratic_drag", "shoulder", {"drag": 0.03}, "drag"),
        ("torque_ripple", "shoulder", {"amplitude": 0.12, "cycles": 2, "phase": 0.6}, "amplitude"),
        ("constant_force", "shoulder", {"force": 0.12}, "force"),
        ("torque_gain", "shoulder", {"gain": 1.2}, "1+gain"),
        ("actuator_lag", "shoulder", {"time_constant": 0.008}, "time_constant"),
        ("actuator_delay", "shoulder", {"delay": 0.006}, "delay"),
        ("rotor_inertia", "shoulder", {"inertia": 0.02}, "inertia"),
        ("payload", "arm", {"mass": 0.12, "distance": 0.4}, "mass"),
        ("spring", "shoulder", {"stiffness": 0.5, "rest": 0.2}, "stiffness"),
        ("hard_stop", "shoulder", {"position": 0.6, "stiffness": 300.0, "damping": 2.0}, "0-position"),
        ("elastic_drive", "shoulder", {"stiffness": 70.0, "damping": 0.15}, "1/stiffness"),
        ("backlash", "shoulder", {"gap": 0.02}, "gap"),
        ("gravity_tilt", "base", {"angle": 0.05}, "angle"),
    ],
    "arm": [
        ("coulomb_friction", "elbow", {"level": 0.08}, "level"),
        ("load_friction", "shoulder", {"coefficient": 0.12}, "coefficient"),
        ("asymmetric_friction", "shoulder", {"level": 0.2, "difference": 0.08}, "level difference"),
        ("payload", "fore", {"mass": 0.15, "distance": 0.28}, "mass"),
        ("elastic_drive", "shoulder", {"stiffness": 150.0, "damping": 0.4}, "1/stiffness"),
        ("backlash", "elbow", {"gap": 0.02}, "gap"),
        ("actuator_delay", "elbow", {"delay": 0.006}, "delay"),
        ("rotor_inertia", "shoulder", {"inertia": 0.05}, "inertia"),
        ("torque_gain", "elbow", {"gain": 1.2}, "1+gain"),
        ("spring", "elbow", {"stiffness": 0.5, "rest": 0.2}, "stiffness"),
    ],
    "hopper": [
        ("coulomb_friction", "rail", {"level": 3.0}, "level"),
        ("viscous_friction", "leg", {"damping": 12.0}, "damping"),
        ("constant_force", "leg", {"force": 6.0}, "force"),
        ("torque_gain", "leg", {"gain": 1.2}, "1+gain"),
        ("actuator_lag", "leg", {"time_constant": 0.008}, "time_constant"),
        ("payload", "body", {"mass": 0.5, "distance": 0.0}, "mass"),
        ("quadratic_drag", "rail", {"drag": 3.0}, "drag"),
        ("ground_stiffness", "toe", {"scale": 0.6}, "1+scale"),
        ("ground_damping", "toe", {"scale": 1.8}, "1+scale"),
        ("ground_height", "toe", {"height": 0.004}, "height"),
    ],
    "cube": [
        ("payload", "cube", {"mass": 0.08, "distance": 0.04}, "mass"),
        ("center_of_mass", "cube", {"shift": 0.008}, "shift"),
        ("ground_stiffness", "table", {"scale": 0.6}, "1+scale"),
        ("ground_damping", "table", {"scale": 1.8}, "1+scale"),
        ("ground_friction", "table", {"scale": 1.6}, "1+scale"),
        ("ground_height", "table", {"height": 0.004}, "height"),
        ("quadratic_drag", "up", {"drag": 0.15}, "drag"),
        ("viscous_friction", "turn", {"damping": 1.0e-3}, "damping"),
        ("gravity_tilt", "base", {"angle": 0.05}, "angle"),
        ("spring", "along", {"stiffness": 3.0, "rest": 0.0}, "stiffness"),
    ],
    "leg": [
        ("coulomb_friction", "knee", {"level": 0.1}, "level"),
        ("viscous_friction", "ankle", {"damping": 0.01}, "damping"),
        ("payload", "foot", {"mass": 0.1, "distance": 0.1}, "mass"),
        ("elastic_drive", "knee", {"stiffness": 90.0, "damping": 0.25}, "1/stiffness"),
        ("spring", "ankle", {"stiffness": 0.4, "rest": 0.1}, "stiffness"),
        ("center_of_mass", "thigh", {"shift": 0.02}, "shift"),
        ("actuator_lag", "hip", {"time_constant": 0.008}, "time_constant"),
        ("torque_gain", "knee", {"gain": 1.2}, "1+gain"),
        ("load_friction", "hip", {"coefficient": 0.12}, "coefficient"),
        ("hard_stop", "knee", {"position": 0.6, "stiffness": 300.0, "damping": 2.0}, "0-position"),
    ],
    "quadruped": [
        ("payload", "trunk", {"mass": 3.0, "x": 0.12, "y": 0.05, "z": 0.07}, "mass"),
        ("viscous_friction", "fr_knee", {"damping": 1.4}, "damping"),
        ("coulomb_friction", "rl_hip", {"level": 4.0}, "level"),
        ("actuator_delay", "rl_leg", {"delay": 0.006}, "delay"),
        ("actuator_lag", "fl_hip", {"time_constant": 0.008}, "time_constant"),
        ("rotor_inertia", "rr_knee", {"inertia": 0.05}, "inertia"),
        ("ground_stiffness", "floor", {"scale": 0.4}, "1+scale"),
        ("ground_friction", "floor", {"scale": 0.5}, "1+scale"),
        ("torque_gain", "fr_hip", {"gain": 1.8}, "1+gain"),
    ],
}

PAIRS = {
    "pendulum": [(0, 5), (10, 8), (11, 9), (2, 13)],
    "arm": [(0, 3), (1, 6), (7, 8), (4, 0)],
    "hopper": [(0, 3), (5, 1), (7, 2), (6, 4)],
    "cube": [(0, 4), (2, 8), (3, 7), (6, 1)],
    "leg": [(0, 2), (6, 7), (4, 1), (8, 5)],
    "quadruped": [(0, 1)],
}

OUTSIDE = {
    "pendulum": [("patch_friction", "shoulder", {"damping": 0.5, "center": 0.3, "width": 0.12}),
                 ("latch", "shoulder", {"pull": 0.4, "center": -0.25, "width": 0.08}),
                 ("absorber", "shoulder", {"inertia": 0.012, "stiffness": 2.5, "damping": 0.02}),
                 ("fading", "shoulder", {"loss": 0.5, "time": 1.2})],
    "arm": [("patch_friction", "elbow", {"damping": 0.3, "center": 0.3, "width": 0.15}),
            ("latch", "shoulder", {"pull": 0.8, "center": -0.2, "width": 0.08}),
            ("absorber", "elbow", {"inertia": 0.006, "stiffness": 1.5, "damping": 0.01}),
            ("fading", "shoulder", {"loss": 0.5, "time": 1.2})],
    "hopper": [("patch_friction", "rail", {"damping": 25.0, "center": 0.44, "width": 0.01}),
               ("warming", "leg", {"damping": 30.0, "time": 0.8}),
               ("absorber", "rail", {"inertia": 0.6, "stiffness": 900.0, "damping": 1.0}),
               ("fading", "leg", {"loss": 0.5, "time": 1.2})],
    "cube": [("patch_friction", "along", {"damping": 6.0, "center": 0.0, "width": 0.12}),
             ("latch", "up", {"pull": 2.0, "center": 0.12, "width": 0.02}),
             ("absorber", "turn", {"inertia": 2.0e-4, "stiffness": 0.15, "damping": 2.0e-4}),
             ("warming", "along", {"damping": 3.0, "time": 0.4})],
    "leg": [("patch_friction", "knee", {"damping": 0.4, "center": 0.3, "width": 0.15}),
            ("latch", "hip", {"pull": 0.9, "center": -0.2, "width": 0.08}),
            ("absorber", "knee", {"inertia": 0.006, "stiffness": 1.5, "damping": 0.01}),
            ("fading", "hip", {"loss": 0.5, "time": 1.2})],
    "quadruped": [("patch_friction", "fl_knee", {"damping": 8.0, "center": -1.75, "width": 0.08}),
                  ("absorber", "trunk", {"mass": 0.8, "stiffness": 290.0, "damping": 2.0, "x": -0.1, "y": 0.03, "z": 0.07})],
}

NOTHING = {"quadruped": (2, 2)}  # cases without an effect in the first set and in all; of the others 3 and 6

# Machines in the order in which they came: numbers of the cases that were there before stay.
BLOCKS = (("pendulum", "arm", "hopper"), ("cube",), ("leg",), ("quadruped",))


def scaled(values, rule, strength, rng):
    """The values of a single effect at a strength, scattered by the generator of random numbers."""
    values = dict(values)
    factor = strength * rng.uniform(0.85, 1.15)
    for name in rule.split():
        if name.startswith("1+"):
            values[name[2:]] = 1.0 + factor * (values[name[2:]] - 1.0)
        elif name.startswith("1/"):
            values[name[2:]] /= factor
        elif name.startswith("0-"):
            values[name[2:]] -= 0.2 * factor
        else:
            values[name] *= factor
    if "cycles" in values:
        values["cycles"] = int(rng.integers(1, 4))
    if "scale" in values:
        values["scale"] = max(0.15, values["scale"])
    return values


def effect(single, strength, rng):
    kind, place, values, rule = single
    return {"kind": kind, "place": place, "values": scaled(values, rule, STRENGTHS[strength], rng)}


def entries(everything, machines):
    """(machine, group, strength, maker of the effects) of all cases, or of those of the first set: each single once."""
    for machine in machines:
        singles = SINGLES[machine]
        for index, single in enumerate(singles):
            names = list(STRENGTHS)
            for strength in names if everything else [names[(index + 1) % 3]]:
                yield machine, "single", strength, lambda rng, s=single, w=strength: [effect(s, w, rng)]
        for index, (one, other) in enumerate(PAIRS[machine]):
            if everything or index < 3:
                yield machine, "pair", "medium", lambda rng, p=(singles[one], singles[other]): [
                    effect(s, "medium", rng) for s in p]
        for index in range(NOTHING.get(machine, (3, 6))[everything]):
            yield machine, "nothing", "", lambda rng: []
        for index, (kind, place, values) in enumerate(OUTSIDE[machine]):
            if everything or index < 3:
                yield machine, "outside", "", lambda rng, e=(kind, place, values): [
                    {"kind": e[0], "place": e[1],
                     "values": {k: (v * rng.uniform(0.9, 1.1) if k not in ("center",) else v) for k, v in e[2].items()}}]
