#!/usr/bin/python3
"""A quadruped with something hidden: the Go2 of MuJoCo's menagerie, simulated by MuJoCo, logged as a robot logs.

    scripts/go2_hidden.py PLUMBLINE MENAGERIE/unitree_go2 DIR [CASE ...]

The robot moves under a PD law for 10 s a recording. DIR gets model.yaml (what `plumbline new-model` makes of go2.xml, with
its feet, a floor and an inertial unit) and for each CASE (nothing, payload, knee, delay, floor; left out: all) a folder with
the trials sway and bow (train) and twist (held-out): 12 encoders, 12 commanded torques and the inertial unit at 500 Hz, no
position of the trunk. The menagerie's folder is read, never copied: MuJoCo gets the file without its meshes, on a floor.
Needs numpy, a C compiler and MuJoCo 2.2 (Debian: libmujoco-dev)."""
import os
import subprocess
import sys
import xml.etree.ElementTree as xml

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LEGS, PARTS = ("FL", "FR", "RL", "RR"), ("hip", "thigh", "calf")
JOINTS = [f"{leg}_{part}_joint" for leg in LEGS for part in PARTS]
SAMPLE, STEPS, DURATION = 2e-3, 20, 10.0  # s
KP, KD = 80.0, 2.0
COUNTS = 2.0 * np.pi / 2**13  # rad: of an encoder
TURN, RATE, PULL = np.radians(0.05), 3e-3, 0.05  # noise of the inertial unit: rad, rad/s, m/s^2
IMU = "-0.02557 0 0.04232"

# The floor decides the contact (priority 2): a spring and a damper, friction as on rubber, no rolling friction. MuJoCo's law with
# direct solref (s, b) and the constant impedance d is F = (s depth + b rate + d acceleration)/((1 - d) A), A = 1.77/kg of a
# calf: 1e4 N/m, 150 N s/m and 0.01 kg at each foot.
SPRING, DAMPER, IMPEDANCE = 17300.0, 260.0, 0.02
CASES = {"nothing": {}, "payload": {"payload": (1.5, "0.12 0.05 0.07")}, "knee": {"knee": ("FR_calf_joint", 1.0)},
         "delay": {"late": (2, 2)}, "floor": {"softer": 0.5}}


def world(go2, change):
    """go2.xml for MuJoCo: without meshes, on a floor, with the inertial unit; and with what is hidden."""
    root = xml.parse(os.path.join(go2, "go2.xml")).getroot()
    for parent in list(root.iter()):
        for child in [c for c in parent if c.tag in ("mesh", "material") or (c.tag == "geom" and c.get("mesh"))]:
            parent.remove(child)
    option = root.find("option")
    option.set("impratio", "10000")
    option.set("gravity", "0 0 -9.81")
    softer = change.get("softer", 1.0)
    xml.SubElement(root.find("worldbody"), "geom", type="plane", size="9 9 0.1", priority="2", condim="3", friction="0.8",
                   solref=f"{-SPRING * softer:g} {-DAMPER:g}", solimp=f"{IMPEDANCE} {IMPEDANCE} 0.01")
    sensors = xml.SubElement(root, "sensor")
    xml.SubElement(sensors, "framequat", objtype="site", objname="imu")
    xml.SubElement(sensors, "gyro", site="imu")
    xml.SubElement(sensors, "accelerometer", site="imu")
    trunk = root.find("worldbody/body")
    if "payload" in change:
        mass, at = change["payload"]
        load = xml.SubElement(trunk, "body", name="payload", pos=at)
        xml.SubElement(load, "inertial", pos="0 0 0", mass=f"{mass:g}", diaginertia="1e-5 1e-5 1e-5")
    if "knee" in change:
        joint, more = change["knee"]
        next(j for j in root.iter("joint") if j.get("name") == joint).set("damping", f"{2.0 + more:g}")
    return xml.tostring(root)


def waves(t, rng, size, lowest, highest):
    """A sum of five sines, rising from rest."""
    total = sum(np.sin(2.0 * np.pi * f * t + rng.uniform(0.0, 2.0 * np.pi)) for f in rng.uniform(lowest, highest, 5))
    return size / 2.2 * total * np.clip(t / 0.5, 0.0, 1.0)


def motion(name, t):
    """Of the trunk over its feet: x, y, height (m), roll, pitch, yaw (rad)."""
    rng = np.random.default_rng({"sway": 1, "bow": 2, "twist": 3}[name])
    size, lowest, highest = {"sway": (1.0, 0.3, 1.6), "bow": (0.7, 0.5, 2.5), "twist": (0.9, 0.4, 2.0)}[name]
    share = {"sway": (1.0, 1.0, 0.7, 0.6, 0.6, 0.3), "bow": (0.4, 0.4, 1.0, 0.3, 1.0, 0.3),
             "twist": (0.6, 1.0, 0.8, 1.0, 0.4, 1.0)}[name]
    full = (0.02, 0.015, 0.03, 0.07, 0.08, 0.12)
    body = [waves(t, rng, size * s * f, lowest, highest) for s, f in zip(share, full)]
    stands_up = {"sway": 0.18, "bow": 0.26, "twist": 0.26}[name]
    body[2] = body[2] + stands_up + (0.26 - stands_up) * 0.5 * (1.0 - np.cos(np.pi * np.clip(t / 0.8, 0.0, 1.0)))
    return np.array(body)


def joints(body):
    """Joint positions that hold the feet where they stand, samples x 12."""
    x, y, z, roll, pitch, yaw = body
    cr, sr, cp, sp, cy, sy = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
    R = np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                  [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]])
    columns = []
    for leg in LEGS:
        front, left = (1 if leg[0] == "F" else -1), (1 if leg[1] == "L" else -1)
        hip = np.array([0.1934 * front, 0.0465 * left, 0.0])
        foot = np.array([[0.1934 * front - 0.02], [0.145 * left], [0.022]]) - np.array([x, y, z])
        f = np.einsum("jik,jk->ik", R, foot) - hip[:, None]  # in the trunk
        out = 0.0955 * left
        down = np.sqrt(np.maximum(f[1]**2 + f[2]**2 - out**2, 1e-6))
        hips = np.arctan2(f[1], -f[2]) - np.arctan2(out, down)
        length = np.clip(np.hypot(f[0], down), 0.1, 0.42)
        knee = -2.0 * np.arccos(length / 0.426)
        thigh = np.arctan2(-f[0], down) - 0.5 * knee
        columns += [hips, thigh, knee]
    return np.array(columns).T


def record(program, folder, xml_file, name, change, seed):
    """One recording: rows of encoders, commands, quaternion, rates, specific force."""
    t = np.arange(0.0, DURATION, SAMPLE)
    reference, log = os.path.join(folder, "reference.txt"), os.path.join(folder, "log.txt")
    np.savetxt(reference, joints(motion(name, t)), fmt="%.9g")
    leg, late = change.get("late", (-1, 0))
    subprocess.run([program, xml_file, reference, log, str(SAMPLE), str(STEPS), str(KP), str(KD), str(3 * leg if leg >= 0 else -1),
                    str(late)], check=True)
    rows = np.loadtxt(log)
    rng = np.random.default_rng(seed)
    rows[:, :12] = np.round(rows[:, :12] / COUNTS) * COUNTS
    half = 0.5 * rng.normal(0.0, TURN, (len(rows), 3))  # a small turn about the sensor's axes
    w, v = rows[:, 24:25].copy(), rows[:, 25:28].copy()
    rows[:, 24:25] = w - np.sum(v * half, axis=1, keepdims=True)
    rows[:, 25:28] = v + w * half + np.cross(v, half)
    rows[:, 28:31] += rng.normal(0.0, RATE, (len(rows), 3))
    rows[:, 31:34] += rng.normal(0.0, PULL, (len(rows), 3))
    os.remove(reference)
    os.remove(log)
    return np.column_stack([t[:len(rows)], rows])


def write_trial(folder, rows, name, role):
    os.makedirs(folder, exist_ok=True)
    head = ["t [s]"] + [f"q_{j} [rad]" for j in JOINTS] + [f"u_{j} [N m]" for j in JOINTS]
    head += ["qw [1]", "qx [1]", "qy [1]", "qz [1]"] + [f"{c}{a} [{u}]" for c, u in (("w", "rad/s"), ("a", "m/s^2"))
                                                        for a in "xyz"]
    np.savetxt(os.path.join(folder, "data.csv"), rows, fmt="%.8g", delimiter=",", header=",".join(head), comments="")
    lines = ["plumbline: trial/1", f"title: Go2, {name}", "model: ../../model.yaml", f"role: {role}", "data: data.csv",
             "time: {column: t, unit: s}", "commands:"]
    lines += [f"  {j}_motor: {{column: u_{j}, unit: N m}}" for j in JOINTS] + ["measured:"]
    lines += [f"  {j}: {{column: q_{j}, unit: rad}}" for j in JOINTS]
    lines += ["  imu_turn: {columns: [qw, qx, qy, qz], unit: \"1\"}", "  imu_rate: {columns: [wx, wy, wz], unit: rad/s}",
              "  imu_pull: {columns: [ax, ay, az], unit: m/s^2}"]
    with open(os.path.join(folder, "trial.yaml"), "w") as file:
        file.write("\n".join(lines) + "\n")


GROUND = """
  - effect: ground_normal
    at: feet
    values:
      stiffness: {value: 40, unit: N, uncertainty: 5 %, assumed: "1e4 N/m: a pad that was measured"}
      damping: {value: 150, unit: N s/m, uncertainty: 20 %, assumed: "a pad that was measured"}
      exponent: {value: 1, unit: "1", assumed: "a pad"}
      reference_depth: {value: 4, unit: mm, assumed: "the depth under a quarter of the weight"}
  - effect: ground_friction
    at: feet
    values:
      bristle_stiffness: {value: 20000, unit: 1/m, assumed: "stiff rubber"}
      bristle_damping: {value: 10, unit: s/m, assumed: "stiff rubber"}
      friction: {value: 0.8, unit: "1", assumed: "rubber"}

"""


def write_model(plumbline, go2, out):
    file = os.path.join(out, "model.yaml")
    if os.path.exists(file):
        os.remove(file)
    subprocess.run([plumbline, "new-model", os.path.join(go2, "go2.xml"), "-o", file], check=True, stdout=subprocess.DEVNULL)
    text = open(file).read()
    text = text.replace("{uncertainty: 10 %, assumed:", "{uncertainty: 2 %, assumed:")
    text = text.replace("uncertainty: 50 %", "uncertainty: 10 %").replace("value: 0.0001, unit: rad", f"value: {COUNTS:.8g}, unit: rad")
    text = text.replace("\n# A sensor for each joint.", GROUND + "feet: take\n\n# A sensor for each joint.")
    at = "at: {value: [%s], unit: m}, " % IMU.replace(" ", ", ")
    for kind, name, noise, unit, place in (("orientation", "imu_turn", TURN, "rad", ""), ("gyroscope", "imu_rate", RATE, "rad/s", ""),
                                           ("accelerometer", "imu_pull", PULL, "m/s^2", at)):
        text += f"  {name}: {{{kind}: base, {place}noise: {{value: {noise:.6g}, unit: {unit}}}, source: \"data sheet\"}}\n"
    with open(file, "w") as written:
        written.write(text)


def main(plumbline, go2, out, *cases):
    os.makedirs(out, exist_ok=True)
    program = os.path.join(out, "world")
    subprocess.run([os.environ.get("CC", "cc"), "-O2", os.path.join(HERE, "go2", "world.c"), "-o", program, "-lmujoco", "-lm"], check=True)
    write_model(plumbline, os.path.abspath(go2), out)
    for case in cases or CASES:
        change, folder = CASES[case], os.path.join(out, case)
        os.makedirs(folder, exist_ok=True)
        xml_file = os.path.join(folder, "world.xml")
        with open(xml_file, "wb") as file:
            file.write(world(go2, change))
        for seed, (name, role) in enumerate((("sway", "train"), ("bow", "train"), ("twist", "held-out"))):
            write_trial(os.path.join(folder, name), record(program, folder, xml_file, name, change, seed), f"{name}, {case}", role)
        os.remove(xml_file)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
