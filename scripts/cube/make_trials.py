#!/usr/bin/env python3
"""Trials (docs/formats/trial.md) of the tossed cube from recordings of its pose: make_trials.py DATA OUT

DATA has toss_000.csv, ... with t [s], x, y, z [m] and the quaternion qw, qx, qy, qz; OUT gets a folder for each. The first
60 are train trials, the others held out. A cube is the same after its axes have been changed cyclically: each toss is
written in that of the three frames whose pitch stays farthest from +-90 degrees, and into OUT.other and OUT.last in the
two others, for a simulated cube that comes there where the recorded one does not.
"""

import csv
import math
import pathlib
import sys

TRAIN = 60
CHANNELS = ("yaw", "pitch", "roll")


def rotation(w, x, y, z):
    """Rotation matrix of a unit quaternion, rows."""
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def changed(R, k):
    """The cube's axes changed cyclically, k times: columns k, k + 1, k + 2."""
    return [[row[(k + j) % 3] for j in range(3)] for row in R]


def angles(R):
    """Yaw, pitch, roll with R = Rz(yaw) Ry(pitch) Rx(roll)."""
    return (math.atan2(R[1][0], R[0][0]), math.asin(max(-1.0, min(1.0, -R[2][0]))), math.atan2(R[2][1], R[2][2]))


def unwrapped(rows):
    """The same angles without jumps of a turn."""
    for i in range(1, len(rows)):
        rows[i] = [a + 2 * math.pi * round((b - a) / (2 * math.pi)) for a, b in zip(rows[i], rows[i - 1])]
    return rows


def read(path):
    with open(path, newline="") as file:
        rows = [[float(v) for v in row] for row in list(csv.reader(file))[1:]]
    return [r[0] for r in rows], [r[1:4] for r in rows], [rotation(*r[4:8]) for r in rows]


def write(folder, model, role, time, places, turns):
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "data.csv", "w", newline="") as file:
        file.write("t [s],x [m],y [m],z [m],yaw [rad],pitch [rad],roll [rad]\n")
        for row in zip(time, places, turns):
            file.write(",".join(f"{v:.9g}" for v in (row[0], *row[1], *row[2])) + "\n")
    lines = ["plumbline: trial/1", f"title: The cube, {folder.name}", f"model: {model}", f"role: {role}", "data: data.csv",
             "time: {column: t, unit: s, resample: even}", "measured:"]
    lines += [f"  {c}: {{column: {c}, unit: m}}" for c in "xyz"] + [f"  {c}: {{column: {c}, unit: rad}}" for c in CHANNELS]
    (folder / "trial.yaml").write_text("\n".join(lines) + "\n")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    data, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    model = pathlib.Path(__file__).resolve().parents[2] / "robots/cube/cube.yaml"
    files = sorted(data.glob("toss_*.csv"))
    if not files:
        sys.exit(f"{data}: found no toss_*.csv, expected the recordings")
    for i, path in enumerate(files):
        time, places, poses = read(path)
        frames = sorted(range(3), key=lambda k: -min(math.cos(angles(changed(R, k))[1]) for R in poses))
        for frame, end in zip(frames, ("", ".other", ".last")):
            turns = unwrapped([list(angles(changed(R, frame))) for R in poses])
            write(pathlib.Path(f"{out}{end}") / path.stem, model, "train" if i < TRAIN else "held-out", time, places, turns)
    print(f"{len(files)} trials in {out}")


if __name__ == "__main__":
    main()
