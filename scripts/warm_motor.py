#!/usr/bin/env python3
"""Logs of a drive whose motor warms for two hours: a geared arm, commanded currents and one encoder at 50 Hz.

    scripts/warm_motor.py DIR [--hours 2] [--seed 1] [--cold]

DIR gets arm.urdf, model.yaml (what data sheets say of the drive; nothing of heat), two trials with their CSV files, and
what no log shows in truth.csv of each: t, temperature of the winding and of the housing [K], torque constant [N m/A].

    monday   train, --hours long: 12 minutes of work, 6 of rest, again and again
    tuesday  held-out, a third as long, another motion and other shifts; the motor has cooled down over night

    then   plumbline diagnose DIR/monday DIR/tuesday --windows 40

The equations are written here once more, in the quantities of a data sheet, and share nothing with the program that is tried:

    (J + N^2 Jr) q'' = N K i - N^2 b q' - m g l sin q,             K = K0 (1 - s (Th - Ta))
    Cw Tw' = R (1 + a (Tw - Ta)) i^2 - (Tw - Th)/Rwh,        Ch Th' = (Tw - Th)/Rwh - (Th - Ta)/Rha

by the classical Runge-Kutta method in steps of 4 ms, the current held for 20 ms. The magnets lose s of the torque constant for
each kelvin of the housing; an amplifier sets the current, so that the winding's resistance only makes heat. Masses,
rotor, torque constant and friction are drawn within what model.yaml states of them. --cold: s = 0. Needs numpy.
"""
import argparse
import math
import os

import numpy as np

PERIOD, STEPS = 0.02, 5  # s of a sample, steps in it
GRAVITY, GEAR = 9.80665, 20.0
MASS, LENGTH, CENTRAL = 1.2, 0.3, 0.036  # kg, m, kg m^2 of the arm
ROTOR, TORQUE_CONSTANT, FRICTION = 1e-4, 0.05, 2e-4  # kg m^2, N m/A, N m s/rad at the motor
RESISTANCE, COPPER, MAGNETS = 1.5, 3.9e-3, 1.9e-3  # ohm, 1/K, 1/K (ferrite)
OF_WINDING, OF_HOUSING = 24.0, 240.0  # J/K
INWARD, OUTWARD = 1.25, 5.0  # K/W from winding to housing, from there to the air
AIR = 293.15  # K
COUNTS = 2.0 * math.pi / 4096  # of the motor's encoder

URDF = f"""<?xml version="1.0"?>
<robot name="arm_drive">
  <link name="world"/>
  <link name="arm">
    <inertial>
      <origin xyz="0 0 -{LENGTH}" rpy="0 0 0"/>
      <mass value="{MASS}"/>
      <inertia ixx="{CENTRAL}" ixy="0" ixz="0" iyy="{CENTRAL}" iyz="0" izz="0.001"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="world"/>
    <child link="arm"/>
    <origin xyz="0 0 1" rpy="0 0 0"/>
    <axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="20" velocity="20"/>
  </joint>
</robot>
"""

MODEL = f"""plumbline: model/1
robot: arm drive
skeleton: arm.urdf
masses:
  arm: {{uncertainty: 2 %, source: "kitchen scale"}}
coordinates:
  shoulder: {{of: {{shoulder: 1}}}}
motors:
  drive:
    command_unit: A
    rotor_inertia: {{value: {ROTOR}, unit: kg m^2, uncertainty: 10 %, source: "motor data sheet"}}
    torque_constant: {{value: {TORQUE_CONSTANT}, unit: N m/A, uncertainty: 5 %, source: "motor data sheet, cold"}}
ratios:
  shoulder: {{motor: drive, ratio: {{value: {GEAR:g}, unit: "1", source: "gearbox data sheet"}}}}
effects:
  - effect: viscous
    at: drive
    values:
      damping: {{value: {FRICTION}, unit: N m s/rad, uncertainty: 50 %, source: "coasting down by hand"}}
sensors:
  drive: {{measures: drive, counts_per_turn: 4096, gear: 1, noise: {{value: 0, unit: rad, assumed: "incremental encoder"}}, source: "encoder data sheet"}}
"""

TRIAL = """plumbline: trial/1
title: {title}
model: ../model.yaml
role: {role}
data: log.csv
time: {{column: t, unit: s}}
commands:
  drive: {{column: current, unit: A}}
measured:
  drive: {{column: angle, unit: rad}}
"""


def currents(seconds, sines, steps, work, rest, random):
    """The current of each sample: sines and steps of two seconds, at a fifth while the drive rests."""
    t = np.arange(int(round(seconds / PERIOD))) * PERIOD
    i = sum(size * np.sin(2.0 * np.pi * f * t + random.uniform(0.0, 2.0 * np.pi)) for f, size in sines)
    i += np.repeat(random.uniform(-steps, steps, len(t) // 100 + 1), 100)[: len(t)]
    return t, i * np.where(t % (work + rest) < work, 1.0, 0.2)


def warming(winding, housing, current):
    """Rates of both temperatures, K/s."""
    inward = (winding - housing) / INWARD
    made = RESISTANCE * (1.0 + COPPER * (winding - AIR)) * current**2
    return (made - inward) / OF_WINDING, (inward - (housing - AIR) / OUTWARD) / OF_HOUSING


def simulate(current, robot):
    """Angles of the motor, and temperatures and torque constant, at the samples."""
    mass, rotor, constant, friction, sag = robot
    inertia = CENTRAL + mass * LENGTH**2 + GEAR**2 * rotor
    weight, damping = mass * GRAVITY * LENGTH / inertia, GEAR**2 * friction / inertia
    h = PERIOD / STEPS
    q = v = 0.0
    winding = housing = AIR
    sin = math.sin
    out = np.empty((len(current), 4))
    for k, i in enumerate(current.tolist()):
        out[k] = GEAR * q, winding, housing, constant * (1.0 - sag * (housing - AIR))
        # Over a sample both temperatures are all but straight: the middle of it by Euler, the end by the midpoint rule.
        dw, dh = warming(winding, housing, i)
        middle = housing + 0.5 * PERIOD * dh
        dw, dh = warming(winding + 0.5 * PERIOD * dw, middle, i)
        winding, housing = winding + PERIOD * dw, housing + PERIOD * dh
        push = GEAR * constant * (1.0 - sag * (middle - AIR)) * i / inertia
        for _ in range(STEPS):
            a1 = push - damping * v - weight * sin(q)
            v2 = v + 0.5 * h * a1
            a2 = push - damping * v2 - weight * sin(q + 0.5 * h * v)
            v3 = v + 0.5 * h * a2
            a3 = push - damping * v3 - weight * sin(q + 0.5 * h * v2)
            v4 = v + h * a3
            a4 = push - damping * v4 - weight * sin(q + h * v3)
            q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return out


def write(folder, name, role, title, t, current, robot):
    where = os.path.join(folder, name)
    os.makedirs(where, exist_ok=True)
    out = simulate(current, robot)
    angle = COUNTS * np.round(out[:, 0] / COUNTS)
    np.savetxt(os.path.join(where, "log.csv"), np.column_stack([t, current, angle]), fmt=["%.2f", "%.5f", "%.6f"],
               delimiter=",", header="t,current,angle", comments="")
    np.savetxt(os.path.join(where, "truth.csv"), np.column_stack([t, out[:, 1:]])[::50], fmt=["%.2f", "%.3f", "%.3f", "%.7f"],
               delimiter=",", header="t,winding,housing,torque_constant", comments="")
    with open(os.path.join(where, "trial.yaml"), "w", encoding="utf-8") as file:
        file.write(TRIAL.format(title=title, role=role))
    print(f"{name}: {len(t)} samples, {np.sqrt(np.mean(current**2)):.2f} A rms, largest angle {np.abs(out[:, 0]).max() / GEAR:.2f} rad, "
          f"housing up to {out[:, 2].max() - AIR:.1f} K above the air, torque constant {out[0, 3]:.5f} to {out[:, 3].min():.5f} N m/A")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--hours", type=float, default=2.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cold", action="store_true")
    options = parser.parse_args()
    random = np.random.default_rng(options.seed)
    off = np.clip(random.normal(size=4), -2.0, 2.0) * [0.02, 0.1, 0.05, 0.5]
    robot = [*(np.array([MASS, ROTOR, TORQUE_CONSTANT, FRICTION]) * (1.0 + off)), 0.0 if options.cold else MAGNETS]
    os.makedirs(options.folder, exist_ok=True)
    for name, text in (("arm.urdf", URDF), ("model.yaml", MODEL)):
        with open(os.path.join(options.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    print("mass {:.4f} kg, rotor {:.4g} kg m^2, torque constant {:.5f} N m/A cold, friction {:.4g} N m s/rad, {:.3g} 1/K".format(*robot))
    seconds = 3600.0 * options.hours
    t, current = currents(seconds, [(0.11, 0.8), (1.7, 1.6), (2.9, 2.0), (4.3, 2.2)], 0.7, 720.0, 360.0, random)
    write(options.folder, "monday", "train", "A shift", t, current, robot)
    t, current = currents(seconds / 3.0, [(0.17, 0.7), (1.4, 1.2), (2.3, 1.9), (5.1, 2.6)], 0.6, 500.0, 200.0, random)
    write(options.folder, "tuesday", "held-out", "Another day, another motion", t, current, robot)


if __name__ == "__main__":
    main()
