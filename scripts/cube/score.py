#!/usr/bin/env python3
"""How far off simulated tosses are: score.py DATA NAME=FOLDER...

DATA has the recordings (toss_NNN.csv), each FOLDER simulated ones of the same names: t, x, y, z and qw, qx, qy, qz, or a
trace of plumbline simulate (q_x, ..., q_yaw, q_pitch, q_roll). Position in per cent of the cube's side, rotation in degrees,
over the held-out tosses (60 on), all samples from the first on; a cube's rotations of its symmetry count as rotations.
"""

import csv
import math
import pathlib
import statistics
import sys

from make_trials import TRAIN, angles, changed, read, rotation

SIDE = 0.1048  # m


def from_angles(yaw, pitch, roll):
    cy, sy, cp, sp, cr, sr = (f(a) for a in (yaw, pitch, roll) for f in (math.cos, math.sin))
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr]]


def simulated(path, measured):
    """Places and rotation matrices, in the recording's axes of the cube."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in rows]
    if "qw" in rows[0]:
        return [[r["x"], r["y"], r["z"]] for r in rows], [rotation(r["qw"], r["qx"], r["qy"], r["qz"]) for r in rows]
    turns = [from_angles(r["q_yaw"], r["q_pitch"], r["q_roll"]) for r in rows]
    back = min(range(3), key=lambda k: angle(changed(turns[0], k), measured[0]))  # from the frame of its trial
    return [[r["q_x"], r["q_y"], r["q_z"]] for r in rows], [changed(R, back) for R in turns]


def angle(A, B):
    """Of the rotation from A to B, degrees."""
    trace = sum(A[i][j] * B[i][j] for i in range(3) for j in range(3))
    return math.degrees(math.acos(max(-1.0, min(1.0, 0.5 * (trace - 1.0)))))


def errors(recording, path):
    """End and mean of a toss: position (%), rotation (degrees). One that was not simulated stays where it began."""
    _, places, poses = read(recording)
    if path.exists():
        there, turned = simulated(path, poses)
    else:
        there, turned = [], []
    there += [(there or places)[-1 if there else 0]] * (len(places) - len(there))
    turned += [(turned or poses)[-1 if turned else 0]] * (len(poses) - len(turned))
    position = [100.0 * math.dist(a, b) / SIDE for a, b in zip(places, there)]
    turn = [angle(a, b) for a, b in zip(poses, turned)]
    return position[-1], statistics.mean(position), turn[-1], statistics.mean(turn)


def main():
    if len(sys.argv) < 3 or any("=" not in arg for arg in sys.argv[2:]):
        sys.exit(__doc__)
    tosses = sorted(pathlib.Path(sys.argv[1]).glob("toss_*.csv"))[TRAIN:]
    print("| simulator | position, end | position, mean | rotation, end | rotation, mean | medians | not simulated |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, folder in (arg.split("=", 1) for arg in sys.argv[2:]):
        files = [pathlib.Path(folder) / toss.name for toss in tosses]
        columns = list(zip(*(errors(toss, file) for toss, file in zip(tosses, files))))
        means = [statistics.mean(c) for c in columns]
        medians = [statistics.median(c) for c in columns]
        print(f"| {name} | {means[0]:.1f} % | {means[1]:.1f} % | {means[2]:.1f} deg | {means[3]:.1f} deg | "
              f"{medians[0]:.1f} %, {medians[1]:.1f} %, {medians[2]:.1f} deg, {medians[3]:.1f} deg | "
              f"{sum(not f.exists() for f in files)} |")


if __name__ == "__main__":
    main()
