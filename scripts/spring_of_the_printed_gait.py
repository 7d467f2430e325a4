#!/usr/bin/env python3
"""What the printed curves of MABEL's walking gait say of the model that they were computed on.

Reads robots/mabel/published/walking_nominal.csv (Sreenath et al. 2011, Figures 5 to 8) and prints
 - stiffness and damping of the stance spring: while the leg-shape motor is held (phases sc and sd), the
   differential passes u_mLS = -(K q + D dq/dt) 5.18/31.42 on, whatever the rest of the robot does;
 - how much higher than in Table VI (Park et al.) the torso's centre of mass is, from the printed height of
   the robot's centre of mass.
Run: python3 scripts/spring_of_the_printed_gait.py
"""
import csv
import pathlib

import numpy as np

CURVES = pathlib.Path(__file__).parent.parent / "robots/mabel/published/walking_nominal.csv"
RATIO = 5.18 / 31.42  # Park et al. equation 7
PHASES = {"sc": (0.036, 0.108), "sd": (0.545, 0.715)}  # s, clear of the switches

# Park et al. Table VI: mass (kg) and distance of the centre of mass from the joint (m).
TORSO, THIGH, SHIN = (40.8953, 0.18337), (3.2818, 0.1978), (1.5007, 0.1570)
C_SPRING, C_SHIN = (1.8987, 0.1181), (1.6987, 0.08684)
C_SPRING_PIVOT = 0.2  # m above the hip (robots/mabel/sources.md)
MASS = TORSO[0] + 2 * (THIGH[0] + SHIN[0] + C_SPRING[0] + C_SHIN[0])


def read_curves():
    with open(CURVES, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split()[0] for name in rows[0]]
    return dict(zip(names, np.array(rows[1:], dtype=float).T))


def spring(curves, begin, end):
    """K (N m/rad), D (N m s/rad) and what is left of the torque (N m, rms)."""
    t = curves["t"]
    inside = (t >= begin) & (t <= end)
    s = (t[inside] - begin) / (end - begin)
    fitted = np.polynomial.Polynomial.fit(s, np.radians(curves["spring_stance"][inside]), 6)
    regressors = np.column_stack([fitted(s), fitted.deriv()(s) / (end - begin)])
    torque = -curves["u_shape_stance"][inside] / RATIO
    values, *_ = np.linalg.lstsq(regressors, torque, rcond=None)
    left = (regressors @ values - torque) * RATIO
    return values[0], values[1], np.sqrt(np.mean(left**2))


def centre_of_mass(curves):
    """Height by Table VI over the stance foot, m; zero angles hang straight down."""
    angle = {name: np.radians(curves[name]) for name in curves if name != "t"}
    torso = angle["trunk"]
    thigh = {leg: torso + angle["angle_" + leg] + angle["shape_" + leg] for leg in ("stance", "swing")}
    shin = {leg: torso + angle["angle_" + leg] - angle["shape_" + leg] for leg in ("stance", "swing")}
    hip = 0.5 * (np.cos(thigh["stance"]) + np.cos(shin["stance"]))
    moment = TORSO[0] * (hip + TORSO[1] * np.cos(torso) + 0.01229 * np.sin(torso))
    for leg in ("stance", "swing"):
        moment += THIGH[0] * (hip - THIGH[1] * np.cos(thigh[leg]))
        moment += SHIN[0] * (hip - 0.5 * np.cos(thigh[leg]) - SHIN[1] * np.cos(shin[leg]))
        turned = torso + 2.0 * angle["shape_" + leg]
        moment += C_SPRING[0] * (hip + C_SPRING_PIVOT * np.cos(torso) - C_SPRING[1] * np.cos(turned))
        moment += C_SHIN[0] * (hip - C_SHIN[1] * np.cos(shin[leg]))
    return moment / MASS, torso


def main():
    curves = read_curves()
    for phase, (begin, end) in PHASES.items():
        stiffness, damping, left = spring(curves, begin, end)
        print(f"{phase}: K = {stiffness:.1f} N m/rad, D = {damping:.2f} N m s/rad; {left:.4f} N m are left")
    height, torso = centre_of_mass(curves)
    higher = curves["com_height"] / 100.0 - height
    shift = higher * MASS / TORSO[0] / np.cos(torso)
    print(f"centre of mass: {100 * higher.mean():.2f} cm higher than by Table VI ({100 * higher.min():.2f} to "
          f"{100 * higher.max():.2f}); of the torso alone {1e3 * shift.mean():.1f} +- {1e3 * shift.std():.1f} mm")


if __name__ == "__main__":
    main()
