"""What the entrants of this repository share: reading a case, writing an answer. Nobody else needs it."""

import csv
import json
import os

import numpy as np


def read_csv(path):
    """Columns by name; the unit behind each name is left out."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names = [cell.split(" [")[0] for cell in next(rows)]
        values = np.array([[float(cell) for cell in row] for row in rows])
    return {name: values[:, i] for i, name in enumerate(names)}


class Case:
    def __init__(self, folder):
        self.folder = folder
        with open(os.path.join(folder, "case.json"), encoding="utf-8") as file:
            self.about = json.load(file)
        self.allowed = {(entry["kind"], entry["place"]) for entry in self.about["allowed"]}
        self.columns = self.about["columns"]
        self.drives = {drive["joint"]: drive for drive in self.about["drives"]}
        self.period = self.about["period"]["value"]

    def recordings(self, role):
        """[(entry of case.json, table)]"""
        return [(entry, read_csv(os.path.join(self.folder, entry["file"])))
                for entry in self.about["recordings"] if entry["role"] == role]

    def positions(self):
        """Names of the columns with positions, those that a prediction must have."""
        return [name for name, about in self.columns.items() if about["is"] in ("joint position", "motor position")]


def write_prediction(folder, name, time, table, columns):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(",".join(["t [s]"] + [f"{c} [{columns[c]['unit']}]" for c in table]) + "\n")
        for row in np.column_stack([time] + list(table.values())):
            file.write(",".join(f"{x:.8g}" for x in row) + "\n")


def left_out(folder, out):
    """Of a robot on a floating base the regressions say nothing: where the base goes and what the ground does are not measured. Their
    prediction is that each joint is where it was told to be. True if the case is such a one."""
    case = Case(folder)
    if "floating_base" not in case.about:
        return False
    os.makedirs(out, exist_ok=True)
    write_answer(out, case, "nothing", [], otherwise=1.0 / len(case.allowed))
    told = {about["joint"]: name for name, about in case.columns.items() if about["is"] == "target"}
    for entry, table in case.recordings("test"):
        followed = {name: table[told[case.columns[name]["joint"]]] for name in case.positions()}
        write_prediction(out, entry["file"], table["t"], followed, case.columns)
    return True


def write_answer(folder, case, verdict, found, others=(), otherwise=0.01):
    """found: lists of names, first name first; a name is a dict with kind, place, confidence and perhaps values."""
    answer = {"format": "missing-effect-answer/1", "case": case.about["id"], "verdict": verdict,
              "found": [{"names": names} for names in found], "others": list(others), "otherwise": otherwise}
    with open(os.path.join(folder, "answer.json"), "w", encoding="utf-8") as file:
        json.dump(answer, file, indent=1)
        file.write("\n")
