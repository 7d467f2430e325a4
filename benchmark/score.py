#!/usr/bin/env python3
"""Scores answers against truths. Definitions: benchmark/README.md.

Usage: score.py ANSWERS_FOLDER CASES_FOLDER TRUTHS_FOLDER [--json FILE] [--cases NAME ...]

ANSWERS_FOLDER has one folder for each case, with answer.json and predictions. A case without an answer counts as "nothing", with a
confidence of 0.01 for every name.
"""

import argparse
import csv
import json
import math
import os

import numpy as np

LOWEST = 0.001  # confidences are cut to [LOWEST, 1 - LOWEST]
LARGEST_GROUP = 3  # names of one slot that count
WORST = 1.0e4  # floors: a prediction that is not there, not finite or worse
BINS = (0.0, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0)


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def read_csv(path):
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names = [cell.split(" [")[0] for cell in next(rows)]
        values = np.array([[float(cell) for cell in row] for row in rows]).reshape(-1, len(names))
    return {name: values[:, i] for i, name in enumerate(names)}


def name_of(entry):
    return entry["kind"], entry["place"]


def true_names(truth, case, effects=None):
    """What an answer can name; effects outside the allowed list are none."""
    allowed = {name_of(entry) for entry in case["allowed"]}
    return {name_of(effect) for effect in (truth["effects"] if effects is None else effects)} & allowed


def two_levels(names):
    """Dry friction of two levels is, letter by letter, Coulomb friction of their mean and a constant force of half their difference."""
    out = set(names)
    for kind, place in names:
        both = {("coulomb_friction", place), ("constant_force", place)}
        if kind == "asymmetric_friction" and not both & names:
            out = out - {(kind, place)} | both
        elif both <= names and ("asymmetric_friction", place) not in names:
            out = out - both | {("asymmetric_friction", place)}
    return out


def nearest_truth(answer, truth, case):
    """Of the truth and what says the same in other names ("also_right", two_levels), the one that the answer meets best."""
    candidates = [true_names(truth, case)] + [true_names(truth, case, effects) for effects in truth.get("also_right", [])]
    candidates += [two_levels(names) for names in candidates]

    def merit(names):
        got = names_score(answer, names, truth["group"])
        return got["first"], got["group"], got["lead"], -got["invented"]
    return max(candidates, key=merit)


def slots_of(answer):
    """Lists of names, at most LARGEST_GROUP each; only the verdict "found" claims any."""
    return [[name_of(n) for n in slot["names"]][:LARGEST_GROUP] for slot in answer.get("found", []) if slot["names"]]


def names_score(answer, true, group):
    """Right at the first place, right in the group, invented names."""
    claimed = slots_of(answer) if answer["verdict"] == "found" else []
    invented = sum(1 for slot in claimed if not true & set(slot))
    if group == "nothing":
        right = answer["verdict"] == "nothing"
        return {"first": right, "group": right, "invented": invented, "lead": right}
    if group == "outside":
        right = answer["verdict"] == "outside"
        return {"first": right, "group": right, "invented": invented, "lead": right}
    leads = {slot[0] for slot in slots_of(answer)}
    return {"first": true <= {slot[0] for slot in claimed}, "group": true <= {n for slot in claimed for n in slot},
            "invented": invented, "lead": true <= leads}


def confidences(answer, case):
    """One for each allowed name; a name that is given twice has the larger."""
    otherwise = float(answer.get("otherwise", 0.01))
    out = {name_of(entry): None for entry in case["allowed"]}
    given = [n for slot in answer.get("found", []) for n in slot["names"]] + list(answer.get("others", []))
    for entry in given:
        name = name_of(entry)
        if name in out:
            out[name] = max(out[name] or 0.0, float(entry["confidence"]))
    return {name: min(1.0 - LOWEST, max(LOWEST, otherwise if p is None else p)) for name, p in out.items()}


def log_score(given, true):
    """Nats of one case: minus the logarithm of what was given to what is so, summed over all allowed names. Less is better."""
    return -sum(math.log(p if name in true else 1.0 - p) for name, p in given.items())


def prediction_error(folder, truth_folder, case):
    """Root mean square over the position columns of all test recordings, in floors; each value at most WORST."""
    squares = []
    positions = {n: c.get("judged_in") or math.hypot(c["resolution"] / math.sqrt(12.0), c["noise"]) for n, c in case["columns"].items()
                 if c["is"].endswith("position")}
    for entry in case["recordings"]:
        if entry["role"] != "test":
            continue
        measured = read_csv(os.path.join(truth_folder, entry["file"]))
        try:
            predicted = read_csv(os.path.join(folder, entry["file"]))
        except (OSError, ValueError, StopIteration):
            predicted = {}
        for name, floor in positions.items():
            squares.append(column_error(predicted.get(name), measured[name], floor) ** 2)
    return math.sqrt(sum(squares) / len(squares))


def column_error(predicted, measured, floor):
    if predicted is None or len(predicted) != len(measured) or not np.all(np.isfinite(predicted)):
        return WORST
    return min(WORST, float(np.sqrt(np.mean((predicted - measured) ** 2))) / floor)


def coverage(answer, truth):
    """(intervals that hold the true value, intervals) of the names that are right."""
    values = {name_of(effect): effect["values"] for effect in truth["effects"]}
    held = count = 0
    for slot in answer.get("found", []) if answer["verdict"] == "found" else []:
        for entry in slot["names"][:1]:
            for name, given in entry.get("values", {}).items():
                true = values.get(name_of(entry), {}).get(name)
                if true is not None and "interval" in given:
                    count += 1
                    held += given["interval"][0] <= true <= given["interval"][1]
    return held, count


def score_case(folder, case, truth, truth_folder):
    path = os.path.join(folder, "answer.json")
    answered = os.path.exists(path)
    answer = load(path) if answered else {"verdict": "nothing", "found": []}
    true = nearest_truth(answer, truth, case)
    given = confidences(answer, case)
    held, count = coverage(answer, truth)
    run = os.path.join(folder, "run.json")
    return {"id": case["id"], "machine": case["machine"], "kind": truth["group"], "strength": truth["strength"], "answered": answered,
            "verdict": answer["verdict"], **names_score(answer, true, truth["group"]), "log_score": log_score(given, true),
            "stated": [[p, name in true] for name, p in given.items()],
            "prediction": prediction_error(folder, truth_folder, case), "held": held, "intervals": count,
            "seconds": load(run)["processor_seconds"] if os.path.exists(run) else None}


def reliability(rows):
    """Of stated confidences in each bin: how many, their mean, and how often the name was true."""
    pairs = [pair for row in rows for pair in row["stated"]]
    out = []
    for low, high in zip(BINS, BINS[1:]):
        inside = [(p, t) for p, t in pairs if low <= p < high or (high == 1.0 and p == 1.0)]
        if inside:
            out.append({"from": low, "to": high, "count": len(inside), "stated": float(np.mean([p for p, _ in inside])),
                        "true": float(np.mean([t for _, t in inside]))})
    return out


def summary(rows):
    """Shares and medians over cases."""
    if not rows:
        return None
    seconds = [row["seconds"] for row in rows if row["seconds"] is not None]
    intervals = sum(row["intervals"] for row in rows)
    return {"cases": len(rows), "answered": sum(row["answered"] for row in rows),
            "first": float(np.mean([row["first"] for row in rows])), "group": float(np.mean([row["group"] for row in rows])),
            "lead": float(np.mean([row["lead"] for row in rows])), "invented": float(np.mean([row["invented"] for row in rows])),
            "log_score": float(np.mean([row["log_score"] for row in rows])),
            "prediction": float(np.median([row["prediction"] for row in rows])),
            "intervals": intervals, "coverage": sum(row["held"] for row in rows) / intervals if intervals else None,
            "seconds": float(np.median(seconds)) if seconds else None, "reliability": reliability(rows)}


def score(answers, cases, truths, only=None):
    rows = []
    for identifier in sorted(os.listdir(cases)):
        truth_folder = os.path.join(truths, identifier)
        if (only is None or identifier in only) and os.path.exists(os.path.join(truth_folder, "truth.json")):
            rows.append(score_case(os.path.join(answers, identifier), load(os.path.join(cases, identifier, "case.json")),
                                   load(os.path.join(truth_folder, "truth.json")), truth_folder))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("answers")
    parser.add_argument("cases")
    parser.add_argument("truths")
    parser.add_argument("--json", help="write rows and summaries to this file")
    parser.add_argument("--cases", dest="only", nargs="+", help="only these cases")
    options = parser.parse_args()
    rows = score(options.answers, options.cases, options.truths, options.only)
    groups = {"simulated": [r for r in rows if r["kind"] != "real"],
              **{k: [r for r in rows if r["kind"] == k] for k in ("single", "pair", "nothing", "outside", "real")},
              **{m: [r for r in rows if r["machine"] == m] for m in sorted({r["machine"] for r in rows})}}
    result = {name: summary(chosen) for name, chosen in groups.items()}
    for name, line in result.items():
        if line:
            covered = "-" if line["coverage"] is None else f"{line['coverage']:.2f} of {line['intervals']}"
            seconds = "-" if line["seconds"] is None else f"{line['seconds']:.1f} s"
            print(f"{name:15} {line['cases']:4} cases  first {line['first']:.2f}  group {line['group']:.2f}  invented {line['invented']:.2f}  "
                  f"log {line['log_score']:7.2f}  prediction {line['prediction']:8.2f}  covered {covered}  {seconds}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"rows": rows, "summary": result}, file, indent=1)


if __name__ == "__main__":
    main()
