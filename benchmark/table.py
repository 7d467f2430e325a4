#!/usr/bin/env python3
"""Writes the page of results from what entrants answered, in Markdown and in HTML. What a rival does better stands first.

Usage: table.py DIR --out FILE [--html FILE] [--own NAME] [--fewer NAME ...] [--reasons FILE] [--version TEXT] [--date TEXT]

DIR has cases, truths and answers/NAME for every entrant. Only cases that every entrant was run on count; real machines stand for themselves.
--fewer: entrants that were run on fewer cases; each stands in a table of its own, beside all others on those. --html: the same with
pictures, in one file that needs no other. --reasons: a JSON file that says why a rival is better, by "measure/group".
"""

import argparse
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pictures  # noqa: E402
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


def run_on(answers, entrants, cases):
    """Cases that every entrant was run on, to its own end or the limit of processor time."""
    done = [{c for c in os.listdir(os.path.join(answers, e)) if ran(os.path.join(answers, e, c, "run.json"))} for e in entrants]
    return sorted(set(os.listdir(cases)).intersection(*done))


def ran(path):
    """A run that the wall clock ended, on a machine that was busy with other work, says nothing of the entrant."""
    return os.path.exists(path) and score.load(path)["ending"] != "wall clock limit"


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
        rows.append([case.removeprefix("case_"), machine, f"{hidden} {truth['strength']}".strip(), "-" if truth["shows"] is None else f"{truth['shows']:.0f}"]
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


def standing(simulated, names):
    rows = [[e] + [cell(m, score.summary(simulated[e])) for m in MEASURES] for e in names]
    return table(["entrant"] + [m[0] for m in MEASURES.values()], rows)


def beside_fewer(answers, results, options):
    """Tables of the simulated cases that an entrant was run on which was not run on all."""
    lines = []
    for entrant in options.fewer:
        cases = run_on(answers, [entrant, *results], os.path.join(options.root, "cases"))
        cases = [c for c in cases if not c.startswith("real_")]
        chosen = {e: [r for r in rows if r["id"] in cases] for e, rows in results.items()}
        chosen[entrant] = score.score(os.path.join(answers, entrant), os.path.join(options.root, "cases"), os.path.join(options.root, "truths"), cases)
        lines += ["", f"## The {len(cases)} simulated cases that {entrant} was run on, too", ""] + standing(chosen, order(chosen))
    return lines


def page(root, results, cases, options, reasons):
    simulated = {e: [r for r in rows if r["kind"] != "real"] for e, rows in results.items()}
    real = {e: [r for r in rows if r["kind"] == "real"] for e, rows in results.items()}
    names, folder = order(simulated), os.path.join(root, "cases")
    total = len([c for c in os.listdir(folder) if not c.startswith("real_")])
    count = len(simulated[names[0]])
    lines = ["# Naming a missing effect: the benchmark's table", "",
             f"{options.date}, version {options.version}. Definitions: [benchmark/README.md](../../benchmark/README.md). Written by `benchmark/table.py`.",
             f"All entrants were run on the same {count} of {total} simulated cases of seed {options.seed} (`make_cases.py --seed {options.seed}`) and on "
             f"{len(cases) - count} of real machines, within the processor time that a case allows (120 s; 600 s for the arm of six joints and the quadruped), on a machine with two cores that did other work.",
             *options.remarks, "", "## Where a rival is better", ""]
    worse = better(simulated, options.own, reasons)
    lines += table(["measure", "cases", "rival", options.own, "why"], worse) if worse else ["Nowhere."]
    lines += ["", "## All simulated cases", ""] + standing(simulated, names) + beside_fewer(os.path.join(root, "answers"), results, options)
    if real[names[0]]:
        lines += ["", "## Real machines", ""] + standing(real, order(real))
    lines += split_tables(simulated, names) + ["", "## Confidences", ""] + reliability(simulated, names)
    shown = [e for e in names if e != "says_nothing"]
    lines += ["", "## Case by case", "", "*shows*: floors at joint positions over a quarter of a second (quadruped: over whole recordings, its control at work). Names of one slot are parted by a stroke.", ""]
    return lines + table(["case", "machine", "hidden", "shows"] + shown, case_rows(root, cases, shown))


def figures(results):
    """{heading: [(caption, picture)]} of the HTML page."""
    results = {e: [r for r in rows if r["kind"] != "real"] for e, rows in results.items()}
    names = order(results)
    colours = dict(zip(names, pictures.COLOURS))

    def shares(key):
        groups = sorted({row[key] for row in results[names[0]] if row[key]})
        return [(f"{g} ({len(split(results[names[0]], key)[g])})",
                 {e: score.summary(split(results[e], key)[g])["first"] for e in names}) for g in groups if g in split(results[names[0]], key)]
    strengths = {"weak": 0.0, "medium": 0.5, "strong": 1.0}
    points = {e: [(x, score.summary(part[w])["first"], len(part[w])) for w, x in strengths.items() if w in part]
              for e, part in ((e, split(results[e], "strength")) for e in names)}
    return {
        "All simulated cases": [("Hit rate by kind of case (cases)", pictures.bars(shares("kind"), names, colours, "by kind"))],
        "By machine": [("Hit rate by machine (cases)", pictures.bars(shares("machine"), names, colours, "by machine"))],
        "By strength of a single effect": [("Hit rate of single effects against their strength; dots grow with the number of cases",
                                            pictures.lines(points, names, colours, "by strength", "strength", [(x, w) for w, x in strengths.items()]))],
        "Confidences": [("Share of names that are true against the confidence stated; on the dashed line an entrant says what it knows",
                         pictures.reliability({e: score.summary(results[e])["reliability"] for e in names}, names, colours))]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root")
    parser.add_argument("--out", required=True)
    parser.add_argument("--html")
    parser.add_argument("--entrants", nargs="+", help="only these")
    parser.add_argument("--fewer", nargs="+", default=[], help="entrants that were run on fewer cases")
    parser.add_argument("--own", default="plumbline")
    parser.add_argument("--reasons", help="JSON: {\"measure/group\": why a rival is better, \"remarks\": [lines]}")
    parser.add_argument("--version", default="unknown")
    parser.add_argument("--date", default="undated")
    parser.add_argument("--seed", default="2026")
    options = parser.parse_args()
    answers, reasons = os.path.join(options.root, "answers"), score.load(options.reasons) if options.reasons else {}
    options.remarks = reasons.get("remarks", [])
    entrants = options.entrants or [e for e in sorted(os.listdir(answers)) if e not in options.fewer]
    cases = run_on(answers, entrants, os.path.join(options.root, "cases"))
    results = {e: score.score(os.path.join(answers, e), os.path.join(options.root, "cases"), os.path.join(options.root, "truths"), cases)
               for e in entrants}
    lines = page(options.root, results, cases, options, reasons)
    with open(options.out, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    if options.html:
        with open(options.html, "w", encoding="utf-8") as file:
            file.write(pictures.page(lines, figures(results)))


if __name__ == "__main__":
    main()
