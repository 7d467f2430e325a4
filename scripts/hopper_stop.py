#!/usr/bin/python3
"""A hopper whose leg meets its stop earlier than the model says, by equations of its own (nothing of the program in them).

    scripts/hopper_stop.py PLUMBLINE DIR

Lagrange's equations of robots/hopper, written by hand, RK4 at 1e-5 s. The model states a cubic stop at 22 mm of the
spring's compression; the leg that is simulated has a linear one, 4e5 N/m and 400 N s/m, at 12 mm. PLUMBLINE makes
the commands from the robot's own experiments and a twin without a stop, which the equations are held against first.
DIR then has model.yaml, bounce (train) and drop (held-out)."""
import csv
import math
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HOPPER = os.path.join(ROOT, "robots", "hopper")
TRIALS = ("bounce", "drop")
STATED_STOP, TRUE_STOP = 0.022, 0.012  # m
STOP = """  - effect: hard_stop         # rubber at the end of the leg's way
    at: spring
    values:
      cubic_stiffness: {value: 1e9, unit: N/m^3, assumed: "rubber"}
      damping: {value: 400, unit: N s/m, assumed: "rubber"}
      root_damping: {value: 0, unit: N, assumed: "rubber"}
      position: {value: %g, unit: m, assumed: "drawing"}
      side: {value: 1, unit: "1", assumed: "drawing"}

sensors:""" % STATED_STOP

BODY, SLIDER, FOOT, ROTOR, GRAVITY, PER_METRE = 6.0, 0.8, 0.35, 2e-4, 9.80665, 50.0
HEIGHT_STEP, SPRING_STEP, DRIVE_STEP = 1e-5, 1e-5, 2.0 * math.pi / 8192.0


def inverse(matrix):
    """Of a 3 x 3 matrix, by cofactors."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return [[(e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det],
            [(f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det],
            [(d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det]]


# T = BODY h'^2/2 + SLIDER (h' - c')^2/2 + FOOT (h' - c' + s')^2/2 + ROTOR (50 c')^2/2, in h, c, s.
INVERSE_MASS = inverse([[BODY + SLIDER + FOOT, -(SLIDER + FOOT), FOOT],
                        [-(SLIDER + FOOT), SLIDER + FOOT + ROTOR * PER_METRE**2, -FOOT],
                        [FOOT, -FOOT, FOOT]])


def rate(x, torque, stop):
    h, c, s, hd, cd, sd = x
    depth, depth_rate = -(h - c + s - 0.4), -(hd - cd + sd)
    ground = max(0.0, depth**1.5 * (2e6 + 1.2e6 * depth_rate)) if depth > 0.0 else 0.0
    spring = -6000.0 * s - 15.0 * sd
    if stop is not None and s > stop:
        spring -= max(0.0, 4e5 * (s - stop) + 400.0 * sd)
    forces = (-(BODY + SLIDER + FOOT) * GRAVITY + ground,
              (SLIDER + FOOT) * GRAVITY - ground - 1200.0 * (c - 0.049) - 10.0 * cd + PER_METRE * torque,
              -FOOT * GRAVITY + ground + spring)
    return (hd, cd, sd) + tuple(sum(m * f for m, f in zip(row, forces)) for row in INVERSE_MASS)


def step(x, torque, stop, dt):
    moved = lambda k, part: [a + part * dt * b for a, b in zip(x, k)]
    k1 = rate(x, torque, stop)
    k2 = rate(moved(k1, 0.5), torque, stop)
    k3 = rate(moved(k2, 0.5), torque, stop)
    k4 = rate(moved(k3, 1.0), torque, stop)
    return tuple(a + dt / 6.0 * (b + 2.0 * c + 2.0 * d + e) for a, b, c, d, e in zip(x, k1, k2, k3, k4))


def simulate(torques, height, stop):
    """Rows of t, torque, height, drive, spring, contact: what the sensors say, every millisecond."""
    counted = lambda value, size: round(value / size) * size
    x, rows = (height, 0.0, 0.0, 0.0, 0.0, 0.0), []
    for k, torque in enumerate(torques):
        rows.append([k * 1e-3, torque, counted(x[0], HEIGHT_STEP), counted(PER_METRE * x[1], DRIVE_STEP),
                     counted(x[2], SPRING_STEP), int(x[0] - x[1] + x[2] < 0.4)])
        for _ in range(100):
            x = step(x, torque, stop, 1e-5)
    return rows


def main(program, out):
    twin = os.path.join(out, "twin")
    experiments = [os.path.join(HOPPER, "experiments", name + ".yaml") for name in TRIALS]
    subprocess.run([program, "twin", "--model", os.path.join(HOPPER, "hopper.yaml"), "--experiment", *experiments, "-o",
                    twin], check=True)
    model = open(os.path.join(HOPPER, "hopper.yaml")).read()
    model = model.replace("skeleton: hopper.sdf", "skeleton: " + os.path.join(HOPPER, "hopper.sdf"))
    with open(os.path.join(out, "model.yaml"), "w") as file:
        file.write(model.replace("\nsensors:", STOP, 1))
    for name in TRIALS:
        with open(os.path.join(twin, name, "data.csv")) as file:
            head, *rows = list(csv.reader(file))
        rows = [[float(cell) for cell in row] for row in rows]
        torques, height = [row[1] for row in rows], rows[0][2]
        without = simulate(torques, height, None)
        worst = max(abs(a[i] - b[i]) for a, b in zip(without, rows) for i in (2, 4))
        stopped = simulate(torques, height, TRUE_STOP)
        print(f"{name}: without a stop {worst:.1e} m from the twin; with it "
              f"{sum(row[4] > TRUE_STOP for row in stopped)} of {len(rows)} samples at the stop")
        os.makedirs(os.path.join(out, name))
        with open(os.path.join(out, name, "data.csv"), "w", newline="") as file:
            csv.writer(file).writerows([head, *stopped])
        with open(os.path.join(twin, name, "trial.yaml")) as file:
            lines = ["model: ../model.yaml" if line.startswith("model:") else line.rstrip() for line in file]
        with open(os.path.join(out, name, "trial.yaml"), "w") as file:
            file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
