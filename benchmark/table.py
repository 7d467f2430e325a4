#!/usr/bin/env python3
"""Writes the page of results from what entrants answered. What a rival does better stands first.

Usage: table.py DIR --out FILE [--own NAME] [--reasons FILE] [--version TEXT] [--date TEXT]

DIR has cases, truths and answers/NAME for every entrant. Only cases that every entrant was run on count. --reasons: a JSON file that says
why a rival is better, by "measure/group".
"""

import argparse
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import score  # noqa: E402

# measure: (title, form, whether more is better)
MEASURES = {
    "first": ("right at first place", "{:.0%}", True), "group": ("right in the group", "{:.0%}", True),
    "lead": ("right, with leads", "{:.0%}", True), "invented": ("invented names a case", "{:.2f}", False),
    "log_score": ("log score, nats", "{:.2f}", False), "prediction": ("prediction, floors", "{:.2f}", False),
    "coverage": ("intervals that hold", "{:.0%}", None), "seconds": ("seconds", "{:.1f}", False),
}
JUDGED = ("first", "group", "invented", "log_score", "prediction", "seconds")
SPLITS = (("By kind", "kind"), ("By machine", "machine"), ("By strength of a single effect", "strength"))


def run_on(answers, cases):
    """Cases that every entrant was run on."""
    done = [{c for c in os.listdir(os.path.join(answers, e)) if os.path.exists(os.path.join(answers, e, c, "run.json"))}
            for e in sorted(os.listdir(answers))]
    return sorted(set(os.listdir(cases)).intersection(*done))


def table(header, rows):
    return ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)] + ["| " + " | ".join(r) + " |" for r in rows]


def cell(measure, line):
    value = line[measure]
    text = "-" if value is None else MEASURES[measure][1].format(value)
    return f"{text} of {line['intervals']}" if measure == "coverage" and value is not None else text


def order(results):
    """Entrants, best first: by names, then by log score."""
    return sorted(results, key=lambda e: (-score.summary(results[e])["first"], score.summary(results[e])["log_score"]))


def split(rows, key):
    groups = {}
    for row in rows:
        if row[key] and (key != "strength" or row["kind"] == "single"):
            groups.setdefault(row[key], []).append(row)
    return groups


def better(results, own, reasons):
    """Measures and groups in which a rival is better than the own entrant."""
    lines, groups = [], {"all": results}
    for _, key in SPLITS[:2]:
        for value in sorted(split(results[own], key)):
            groups[value] = {e: split(rows, key).get(value, []) for e, rows in results.items()}
    for group, chosen in groups.items():
        sums = {e: score.summary(rows) for e, rows in chosen.items()}
        for measure in JUDGED if group == "all" else JUDGED[:-1]:  # seconds once
            more = 1.0 if MEASURES[measure][2] else -1.0
            rivals = {e: s[measure] for e, s in sums.items() if e != own and s[measure] is not None}
            best = max(rivals, key=lambda e: more * rivals[e])
            if more * rivals[best] > more * sums[own][measure] + 1e-9:
                why = reasons.get(f"{measure}/{group}") or reasons.get(measure) or "not looked into yet"
                lines.append([MEASURES[measure][0], group, f"{best} {cell(measure, sums[best])}", cell(measure, sums[own]), why])
    return lines


def said(folder):
    answer = score.load(os.path.join(folder, "answer.json")) if os.path.exists(os.path.join(folder, "answer.json")) else None
    if answer is None:
        return "no answer"
    slots = ["/".join(f"{k}@{p}" for k, p in slot) for slot in score.slots_of(answer)]
    words = ", ".join(slots)
    return words if answer["verdict"] == "found" else answer["verdict"] + (f" (leads: {words})" if words else "")


def case_rows(root, cases, shown):
    rows = []
    for case in cases:
        truth = score.load(os.path.join(root, "truths", case, "truth.json"))
        hidden = ", ".join(f"{e['kind']}@{e['place']}" for e in truth["effects"]) or "nothing"
        if truth["group"] == "outside":
            hidden = f"outside: {hidden}"
        machine = score.load(os.path.join(root, "cases", case, "case.json"))["machine"]
        rows.append([case.removeprefix("case_"), machine, f"{hidden} {truth['strength']}".strip(), f"{truth['shows']:.0f}"]
                    + [said(os.path.join(root, "answers", e, case)) for e in shown])
    return rows


def split_tables(results, names):
    lines = []
    for title, key in SPLITS:
        rows = []
        for value in sorted(split(results[names[0]], key)):
            for entrant in names:
                line = score.summary(split(results[entrant], key)[value])
                rows.append([value, str(line["cases"]), entrant] + [cell(m, line) for m in ("first", "group", "lead", "invented", "log_score", "prediction")])
        lines += ["", f"## {title}", ""] + table(["", "cases", "entrant", "first", "group", "with leads", "invented", "log score", "prediction"], rows)
    return lines


def reliability(results, names):
    rows = []
    for entrant in names:
        for line in score.summary(results[entrant])["reliability"]:
            rows.append([entrant, f"{line['from']:.2f} to {line['to']:.2f}", str(line["count"]), f"{line['stated']:.3f}", f"{line['true']:.3f}"])
    return table(["entrant", "confidence", "names", "stated, mean", "true, share"], rows)


def page(root, results, cases, options, reasons):
    names = order(results)
    total = len(os.listdir(os.path.join(root, "cases")))
    lines = ["# Naming a missing effect: the benchmark's table", "",
             f"{options.date}, version {options.version}. Definitions: [benchmark/README.md](../../benchmark/README.md). Written by `benchmark/table.py`.",
             f"All entrants were run on the same {len(cases)} of {total} cases of seed {options.seed} (`make_cases.py --seed {options.seed}`), within 120 s of "
             "processor time a case, on a machine with two cores that did other work.", *options.remarks, "",
             "## Where a rival is better", ""]
    worse = better(results, options.own, reasons)
    lines += table(["measure", "cases", "rival", options.own, "why"], worse) if worse else ["Nowhere."]
    rows = [[e] + [cell(m, score.summary(results[e])) for m in MEASURES] for e in names]
    lines += ["", "## All cases", ""] + table(["entrant"] + [m[0] for m in MEASURES.values()], rows)
    lines += split_tables(results, names) + ["", "## Confidences", ""] + reliability(results, names)
    shown = [e for e in names if e != "says_nothing"]
    lines += ["", "## Case by case", "", "*shows*: floors at joint positions over a quarter of a second. Names of one slot are parted by a stroke.", ""]
    return lines + table(["case", "machine", "hidden", "shows"] + shown, case_rows(root, cases, shown))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root")
    parser.add_argument("--out", required=True)
    parser.add_argument("--own", default="plumbline")
    parser.add_argument("--reasons", help="JSON: {\"measure/group\": why a rival is better, \"remarks\": [lines]}")
    parser.add_argument("--version", default="unknown")
    parser.add_argument("--date", default="undated")
    parser.add_argument("--seed", default="2026")
    options = parser.parse_args()
    answers, reasons = os.path.join(options.root, "answers"), score.load(options.reasons) if options.reasons else {}
    options.remarks = reasons.get("remarks", [])
    cases = run_on(answers, os.path.join(options.root, "cases"))
    results = {e: score.score(os.path.join(answers, e), os.path.join(options.root, "cases"), os.path.join(options.root, "truths"), cases)
               for e in sorted(os.listdir(answers))}
    with open(options.out, "w", encoding="utf-8") as file:
        file.write("\n".join(page(options.root, results, cases, options, reasons)) + "\n")


if __name__ == "__main__":
    main()
