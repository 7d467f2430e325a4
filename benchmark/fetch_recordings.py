#!/usr/bin/env python3
"""Fetches recordings of others that may not be handed on, and writes them as real_cases.py reads them.

Usage: fetch_recordings.py --data FOLDER [--from CLONE]

Only the arm's (FOLDER/ur10e-payload) can be fetched: its repository is public and has no licence. CLONE is a copy of that repository which
is there already. EMPS is downloaded by hand from nonlinearbenchmark.org. Needs git.
"""

import argparse
import os
import subprocess
import sys
import tempfile

ADDRESS, COMMIT = "https://github.com/shamilmamedov/dynamic_calibration", "11af40e"
FILES = {"free": "dataset_ur10e/identification_data/ur-20_02_19_14harm50sec.csv",
         "loaded": "dataset_ur10e/identification_data/ur-20_02_19_14harm50secLoad.csv"}
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
CURRENTS_AT = 13  # behind the time, six positions and six speeds
SECONDS = 40.0


def git(*arguments):
    done = subprocess.run(["git", *arguments], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"git {' '.join(arguments)}: {done.stderr.strip()}")
    return done.stdout


def converted(text):
    """Rows of time from zero, positions and currents, as they were written."""
    rows = [line.split(",") for line in text.splitlines() if line]
    header = ["t [s]"] + [f"q_{joint} [rad]" for joint in JOINTS] + [f"i_{joint} [A]" for joint in JOINTS]
    out = [",".join(header)]
    for row in rows:
        time = float(row[0]) - float(rows[0][0])
        if time <= SECONDS:
            out.append(",".join([f"{time:.4f}"] + row[1:7] + row[CURRENTS_AT:CURRENTS_AT + 6]))
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", required=True)
    parser.add_argument("--from", dest="clone", default="")
    options = parser.parse_args()
    folder = os.path.join(options.data, "ur10e-payload")
    os.makedirs(folder, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        clone = options.clone or os.path.join(scratch, "repository")
        if not options.clone:
            git("clone", "--quiet", "--filter=blob:none", "--no-checkout", ADDRESS, clone)
        for name, path in FILES.items():
            text = converted(git("-C", clone, "show", f"{COMMIT}:{path}"))
            with open(os.path.join(folder, f"{name}.csv"), "w", encoding="utf-8") as file:
                file.write(text)
            print(f"{folder}/{name}.csv: {text.count(chr(10)) - 1} samples")


if __name__ == "__main__":
    sys.exit(main())
