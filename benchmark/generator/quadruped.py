"""A quadruped of plain numbers, simulated by MuJoCo (quadruped_world.c) under a PD law: its bodies, what is known of them, what is hidden.

A trunk of 7.5 kg on four legs of three joints, 14.9 kg in all; spherical feet. Axes: x forward, y to the left, z up. Each joint's
side axis is x, its hip's and knee's y; the legs hang down at zero. MuJoCo and a C compiler are needed for this machine alone.
"""

import copy
import math
import os
import shutil
import subprocess
import tempfile

import numpy as np

from generator.machines import GRAVITY

NAME = "quadruped"
TITLE = "A quadruped of 15 kg under a PD law, on a floor"
LEGS = ("fl", "fr", "rl", "rr")  # front left, ...
JOINTS = tuple(f"{leg}_{joint}" for leg in LEGS for joint in ("side", "hip", "knee"))
LINKS = ("trunk",) + tuple(f"{leg}_{link}" for leg in LEGS for link in ("hub", "thigh", "shin"))
PLACE = "floor"  # where effects of the ground are named
PERIOD = 4.0e-3  # s, of sensors and of the control
STEPS = 80  # of MuJoCo in a sample
POSITION_GAIN, VELOCITY_GAIN = 120.0, 3.0  # N m/rad, N m s/rad
HIP_X, HIP_Y, OFFSET, THIGH, SHIN, RADIUS = 0.19, 0.05, 0.085, 0.2, 0.2, 0.02  # m
IMU = (0.02, 0.0, 0.04)  # m, in the trunk
IMPEDANCE = 0.03  # of MuJoCo's contact: it feels as some 20 g more at a foot
HELD = 1.0e4  # how much stiffer than its normal damper a foot's damper along the ground is, while it holds
# By link: mass (kg), centre (m, y to the outside), inertia about it (kg m^2, along x, y, z).
BODIES = {"trunk": (7.5, (0.0, 0.0, 0.0), (0.032, 0.106, 0.125)), "hub": (0.65, (0.0, 0.02, 0.0), (6.0e-4, 9.0e-4, 6.0e-4)),
          "thigh": (1.0, (0.0, -0.02, -0.04), (5.5e-3, 5.0e-3, 1.2e-3)), "shin": (0.2, (0.0, 0.0, -0.1), (1.5e-3, 1.5e-3, 5.0e-5))}
DRIVE = {"rotor_inertia": 0.01, "damping": 2.0}  # at the joint
GROUND = {"stiffness": 1.0e4, "damping": 300.0, "friction": 0.8}  # N/m, N s/m, 1
# One standard deviation of what is stated, as a share.
KNOWN = {"mass": 0.01, "rotor_inertia": 0.05, "damping": 0.1, "gain": 0.02, "ground": {"stiffness": 0.05, "damping": 0.1, "friction": 0.05}}


class Missing(Exception):
    """MuJoCo or a compiler is not there."""


def body(link):
    """(mass, centre, inertia) as stated; the outside is left for left legs."""
    mass, center, inertia = BODIES[link.split("_")[-1]]
    side = -1.0 if link[1:2] == "r" and link != "trunk" else 1.0
    return mass, (center[0], side * center[1], center[2]), inertia


def stated():
    return {"links": {link: {"mass": body(link)[0]} for link in LINKS},
            "drives": {joint: dict(DRIVE, gain=1.0) for joint in JOINTS}, "ground": dict(GROUND)}


def true_numbers(rng):
    """The stated numbers, scattered within what is stated of them: normal, cut at two deviations."""
    def factor(share):
        return 1.0 + share * float(np.clip(rng.normal(), -2.0, 2.0))

    numbers = stated()
    for link in numbers["links"].values():
        link["mass"] *= factor(KNOWN["mass"])
    for drive in numbers["drives"].values():
        for name in ("rotor_inertia", "damping", "gain"):
            drive[name] *= factor(KNOWN[name])
    for name, share in KNOWN["ground"].items():
        numbers["ground"][name] *= factor(share)
    return numbers


def mounts(leg):
    """Where the three joints of a leg sit in the link before, and the foot's centre in the shin."""
    front, left = (1.0 if leg[0] == "f" else -1.0), (1.0 if leg[1] == "l" else -1.0)
    return (front * HIP_X, left * HIP_Y, 0.0), (0.0, left * OFFSET, 0.0), (0.0, 0.0, -THIGH), (0.0, 0.0, -SHIN)


def words(numbers):
    return " ".join(f"{x:.10g}" for x in numbers)


def urdf():
    lines = ['<?xml version="1.0"?>', f'<robot name="{NAME}">', '  <link name="world"/>'] + urdf_link("trunk")
    lines += ['  <joint name="base" type="floating">', '    <parent link="world"/><child link="trunk"/>', '  </joint>']
    for leg in LEGS:
        before = "trunk"
        for joint, link, axis, at in zip(("side", "hip", "knee"), ("hub", "thigh", "shin"), ("1 0 0", "0 1 0", "0 1 0"), mounts(leg)):
            lines += urdf_link(f"{leg}_{link}") + [
                f'  <joint name="{leg}_{joint}" type="continuous">',
                f'    <parent link="{before}"/><child link="{leg}_{link}"/><origin xyz="{words(at)}"/>', f'    <axis xyz="{axis}"/>', '  </joint>']
            before = f"{leg}_{link}"
    return "\n".join(lines + ["</robot>", ""])


def urdf_link(link):
    mass, center, (ixx, iyy, izz) = body(link)
    return [f'  <link name="{link}">', f'    <inertial><origin xyz="{words(center)}"/><mass value="{mass}"/>'
            f'<inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>', '  </link>']


def inertial(link, mass):
    nominal, center, inertia = body(link)
    return f'<inertial pos="{words(center)}" mass="{mass:.10g}" diaginertia="{words(np.array(inertia) * mass / nominal)}"/>'


def mjcf(numbers, effects, start):
    """For MuJoCo. What is hidden in bodies and joints is in it, what is hidden in motors and ground is in control_numbers()."""
    drives = copy.deepcopy(numbers["drives"])
    extra = ""
    for effect in effects:
        values, place = effect["values"], effect["place"]
        if effect["kind"] == "payload":
            at = words([values["x"], values["y"], values["z"]])
            extra += f'<body pos="{at}"><inertial pos="0 0 0" mass="{values["mass"]:.10g}" diaginertia="1e-6 1e-6 1e-6"/></body>'
        elif effect["kind"] == "absorber":  # a mass that slides upright on a spring
            extra += (f'<body pos="{words([values["x"], values["y"], values["z"]])}"><joint type="slide" axis="0 0 1" stiffness="{values["stiffness"]:.10g}" '
                      f'damping="{values["damping"]:.10g}"/><inertial pos="0 0 0" mass="{values["mass"]:.10g}" diaginertia="1e-6 1e-6 1e-6"/></body>')
        elif effect["kind"] == "viscous_friction":
            drives[place]["damping"] += values["damping"]
        elif effect["kind"] == "rotor_inertia":
            drives[place]["rotor_inertia"] += values["inertia"]
    legs = "".join(mjcf_leg(i, leg, numbers, drives) for i, leg in enumerate(LEGS))
    pose = words(start["position"]) + " " + words(start["orientation"]) + " " + words(start["joints"])
    pose += " 0" * sum(effect["kind"] == "absorber" for effect in effects)
    motors = "".join(f'<motor joint="{joint}"/>' for joint in JOINTS)
    return (f'<mujoco><compiler angle="radian" autolimits="false"/><option gravity="0 0 {-GRAVITY}" cone="elliptic" impratio="{HELD}" tolerance="1e-12"/>'
            '<worldbody><geom type="plane" size="9 9 0.1"/>'
            f'<body name="trunk"><freejoint/>{inertial("trunk", numbers["links"]["trunk"]["mass"])}<site name="imu" pos="{words(IMU)}"/>{legs}{extra}</body>'
            f'</worldbody><actuator>{motors}</actuator><sensor><framequat objtype="site" objname="imu"/><gyro site="imu"/><accelerometer site="imu"/></sensor>'
            f'<keyframe><key qpos="{pose}"/></keyframe></mujoco>')


def mjcf_leg(index, leg, numbers, drives):
    opening, closing = "", ""
    for joint, link, axis, at in zip(("side", "hip", "knee"), ("hub", "thigh", "shin"), ("1 0 0", "0 1 0", "0 1 0"), mounts(leg)):
        drive = drives[f"{leg}_{joint}"]
        opening += (f'<body name="{leg}_{link}" pos="{words(at)}">{inertial(f"{leg}_{link}", numbers["links"][f"{leg}_{link}"]["mass"])}'
                    f'<joint name="{leg}_{joint}" axis="{axis}" armature="{drive["rotor_inertia"]:.10g}" damping="{drive["damping"]:.10g}"/>')
        closing += "</body>"
    return opening + f'<geom name="foot_{index}" type="sphere" size="{RADIUS}" pos="{words(mounts(leg)[3])}"/>' + closing


def control_numbers(numbers, effects, steps):
    """What quadruped_world.c reads."""
    gain = [numbers["drives"][joint]["gain"] for joint in JOINTS]
    delay, lag, dry = [0.0] * 12, [0.0] * 12, [0.0] * 12
    patch, ground = [-1.0, 0.0, 0.0, 1.0], dict(numbers["ground"])
    for effect in effects:
        kind, place, values = effect["kind"], effect["place"], effect["values"]
        if kind == "actuator_delay":
            for i, joint in enumerate(JOINTS):
                if joint == place or joint.split("_")[0] + "_leg" == place:
                    delay[i] = round(values["delay"] / PERIOD * steps)
        elif kind in ("ground_stiffness", "ground_damping", "ground_friction"):
            name = kind.removeprefix("ground_")
            ground[name] = GROUND[name] * values["scale"]  # of the stated one
        elif place in JOINTS:
            i = JOINTS.index(place)
            if kind == "torque_gain":
                gain[i] *= values["gain"]
            elif kind == "actuator_lag":
                lag[i] = values["time_constant"]
            elif kind == "coulomb_friction":
                dry[i] = values["level"]
            elif kind == "patch_friction":
                patch = [float(i), values["damping"], values["center"], values["width"]]
    return [PERIOD, float(steps), POSITION_GAIN, VELOCITY_GAIN, *gain, *delay, *lag, *dry, *patch, *(ground[n] for n in GROUND), IMPEDANCE]


class World:
    """MuJoCo behind a compiled program; its files lie in a folder of their own until close()."""

    def __init__(self):
        self.folder = tempfile.mkdtemp(prefix="quadruped_")
        self.program = os.path.join(self.folder, "quadruped_world")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "quadruped_world.c")
        compiler = shutil.which(os.environ.get("CC", "cc"))
        if not compiler:
            self.close()
            raise Missing("no C compiler")
        done = subprocess.run([compiler, "-O2", source, "-o", self.program, "-lmujoco", "-lm"], capture_output=True, text=True)
        if done.returncode:
            self.close()
            raise Missing("MuJoCo's library or headers are not installed")

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, numbers, effects, start, targets, steps=STEPS):
        """What there is at each sample, by name: arrays with a row for each."""
        paths = [os.path.join(self.folder, name) for name in ("model.xml", "numbers.txt", "targets.txt")]
        for path, text in zip(paths, (mjcf(numbers, effects, start), words(control_numbers(numbers, effects, steps)))):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        np.savetxt(paths[2], targets, fmt="%.10g")
        done = subprocess.run([self.program, *paths], capture_output=True)
        if done.returncode:
            raise RuntimeError(done.stderr.decode())
        rows = np.frombuffer(done.stdout).reshape(len(targets), 57)
        widths = {"q": 12, "v": 12, "u": 12, "orientation": 4, "gyroscope": 3, "accelerometer": 3, "normal": 4, "place": 3, "turn": 4}
        ends = np.cumsum(list(widths.values()))
        return {name: rows[:, end - width:end] for (name, width), end in zip(widths.items(), ends)}


def total_mass(numbers):
    return math.fsum(link["mass"] for link in numbers["links"].values())
