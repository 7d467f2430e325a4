#!/usr/bin/env python3
"""Says that nothing is missing, and predicts that nothing moves: what any method must be better than.

Usage: run.py CASE_FOLDER OUT_FOLDER
"""

import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from common import Case, write_answer, write_prediction  # noqa: E402


def main(folder, out):
    case = Case(folder)
    os.makedirs(out, exist_ok=True)
    # About one of all allowed names is true where something is missing.
    write_answer(out, case, "nothing", [], otherwise=1.0 / len(case.allowed))
    for entry, table in case.recordings("test"):
        held = {}
        for name in case.positions():
            about = case.columns[name]
            factor = case.drives[about["joint"]]["ratio"]["value"] if about["is"] == "motor position" else 1.0
            held[name] = np.full(len(table["t"]), factor * entry["start"][about["joint"]])
        write_prediction(out, entry["file"], table["t"], held, case.columns)


if __name__ == "__main__":
    main(*sys.argv[1:3])
