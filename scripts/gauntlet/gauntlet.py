"""Every measured machine that there is, through the same commands with their defaults, as one table.

    ./plumb gauntlet --data DIR [--only NAME] [--out DIR] [--against results.json]

DIR has a folder of recordings for each machine (machines.json: `data`); machines without one are left out and named. A row: the model as
given, least squares by numpy on the same windows, standard identification, the best model found, what was named; held-out errors in floors.
With --against a row whose best model is 5 % worse than before fails (exit status 1).
"""

import argparse
import glob
import json
import os
import subprocess
import sys
import time

import least_squares
import plumbline as pl

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
PROGRAM = os.environ.get("PLUMBLINE", os.path.join(ROOT, "build/validation/cli/plumbline"))


class Slides:
    """Masses on slides: what a chain is without turns or weight."""

    def __init__(self, masses):
        self.names, self.masses = list(masses), list(masses.values())

    def forces(self, q, v, a):
        return a * self.masses


def join_columns(folder):
    """The recordings of the TX40 stand in two files without times, at 5 kHz."""
    joined = os.path.join(folder, "tx40.csv")
    if os.path.exists(joined):
        return
    with open(os.path.join(folder, "pos_read_data.csv")) as q, open(os.path.join(folder, "curr_data.csv")) as u:
        rows = [(a.strip(), b.strip()) for a, b in zip(q, u)][1:]
    with open(joined + ".new", "w") as out:
        out.write("t," + ",".join(f"{c}_{k}" for c in "qu" for k in range(1, 7)) + "\n")
        for i, (a, b) in enumerate(rows):
            out.write(f"{i / 5000:.4f},{a},{b}\n")
    os.replace(joined + ".new", joined)


def trials_of(machine, data):
    found = []
    for pattern in machine["trials"]:
        found += sorted(glob.glob(os.path.join(ROOT, pattern.format(data=data))))
    return found


def run(arguments):
    """Output as JSON, seconds on the clock and of processor; None and the message where the program refuses."""
    before, begun = os.times(), time.time()
    done = subprocess.run([PROGRAM] + arguments, capture_output=True, text=True)
    after = os.times()
    seconds = time.time() - begun
    processor = after.children_user + after.children_system - before.children_user - before.children_system
    return done, seconds, processor


def folder_of(machine, data):
    """Trials that lie beside their recordings know them; others are told the folder."""
    return "" if machine["trials"][0].startswith("{data}") else data


def told(folder):
    return ["--data", folder] if folder else []


def errors(trials, folder, model, out):
    file = os.path.join(out, "compare.json")
    done, _, _ = run(["compare", *trials, *told(folder), "--json", file] + (["--model", model] if model else []))
    if done.returncode:
        return None, done.stderr.strip()
    with open(file) as f:
        scores = json.load(f)
    return (scores["train"], scores["held_out"]), ""


def overlay(model, wanted, file):
    """A model file that stands on `model`; wanted: {(effect, place): {parameter: (value, unit)}}."""
    has = {(e["effect"], e["at"]) for e in model.effects}
    added, values = [], []
    for (effect, at), parameters in wanted.items():
        cells = {k: f'{{value: {v:.9g}, unit: "{unit}", source: "least squares by numpy"}}' for k, (v, unit) in parameters.items()}
        if (effect, at) in has:
            values += [f"  {effect}@{at}:{k}: {cell}" for k, cell in cells.items() if k != "smoothing_speed"]
        else:
            added.append(f"  - {{effect: {effect}, at: {at}, values: {{" + ", ".join(f"{k}: {c}" for k, c in cells.items()) + "}}")
    with open(file, "w") as out:
        out.write(f"plumbline: model/1\nbase: {os.path.abspath(model.file)}\nnote: least squares by numpy\n")
        out.write("".join(line + "\n" for line in (["effects:"] + added if added else []) + (["values:"] + values if values else [])))


def by_least_squares(machine, data, trials, file):
    """Writes a model with the values of numpy's least squares of the train trials."""
    loaded = [pl.load_trial(trial, data=folder_of(machine, data)) for trial in trials]
    model = loaded[0].model
    chain = Slides(machine["slide"]) if "slide" in machine else least_squares.Chain(os.path.join(ROOT, machine["urdf"].format(data=data)))
    stated = {motor["name"]: motor for motor in model.motors}
    gains = {name: motor["torque_constant"]["value"] or 1.0 for name, motor in stated.items()}
    train = [(t.period, {machine["sensors"].get(k, k): v for k, v in t.measured.items()}, {m: gains[m] * u for m, u in t.commands.items()})
             for t in loaded if t.role == "train"]
    drives, passive = least_squares.identify(chain, machine["motors"], train)
    wanted, slides = {}, "slide" in machine
    turn, length = ("N s/m", "m/s") if slides else ("N m s/rad", "rad/s")
    force, inertia = ("N", "kg") if slides else ("N m", "kg m^2")
    for at, found in {**drives, **passive}.items():
        wanted["viscous", at] = {"damping": (max(found["viscous"], 0.0), turn)}
        wanted["coulomb", at] = {"level": (max(found["coulomb"], 0.0), force), "smoothing_speed": (0.01, length)}
    for at, found in drives.items():
        wanted["torque_constant_error", at] = {"scale": (max(found["gain"], 0.1), "1")}
        wanted["torque_bias", at] = {"bias": (found["bias"], force)}
        least = 0.1 * stated[at]["rotor_inertia"]["value"]
        wanted["rotor_inertia", at] = {"inertia": (max(found["inertia"], least) - stated[at]["rotor_inertia"]["value"], inertia)}
    overlay(model, wanted, file)


def row(machine, data, out):
    """One machine through everything."""
    trials, folder = trials_of(machine, data), folder_of(machine, data)
    os.makedirs(out, exist_ok=True)
    result = {"name": machine["name"], "truth": machine["truth"], "notes": []}

    def keep(key, scores, why=""):
        result[key] = scores
        if scores is None and why:
            result["notes"].append(f"{key}: {why}")

    keep("given", *errors(trials, folder, "", out))
    ordinary = os.path.join(out, "least_squares.yaml")
    by_least_squares(machine, data, trials, ordinary)
    keep("least_squares", *errors(trials, folder, ordinary, out))
    file, best = os.path.join(out, "diagnosis.json"), os.path.join(out, "best.yaml")
    done, result["seconds"], result["processor"] = run(["diagnose", *trials, *told(folder), "--json", file, "--save", best])
    with open(os.path.join(out, "diagnosis.txt"), "w") as text:
        text.write(done.stdout + done.stderr)
    if done.returncode:
        result["notes"].append("diagnose: " + done.stderr.strip()[-200:])
        return result
    with open(file) as f:
        answer = json.load(f)
    standard = answer["standard"]
    result["standard"] = [standard["train"], standard["held_out"]] if standard else None
    result["named"] = [f"{e['effect']} at {e['at']}" for e in answer["accepted"]]
    result["verdict"] = answer["verdict"]
    keep("best", *errors(trials, folder, best, out))
    return result


HEAD = ["machine", "as given", "least squares by hand", "standard identification", "best model found", "named", "known of it", "s", "s of processor"]


def table(results):
    def both(scores):
        return "-" if not scores else " / ".join("-" if x is None else f"{x:.3g}" for x in scores)

    lines = ["| " + " | ".join(HEAD) + " |", "| " + " | ".join("---" for _ in HEAD) + " |"]
    for r in results:
        cells = [r["name"]] + [both(r.get(k)) for k in ("given", "least_squares", "standard", "best")]
        cells += [", ".join(r.get("named", [])) or r.get("verdict", "-").replace("_", " "), r["truth"], f"{r.get('seconds', 0):.0f}", f"{r.get('processor', 0):.0f}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def worse(results, before):
    """Rows whose best model's held-out error has risen by more than 5 %."""
    known = {r["name"]: r for r in before}
    for r in results:
        old = known.get(r["name"], {}).get("best")
        if old and (not r.get("best") or r["best"][1] > 1.05 * old[1]):
            yield f"{r['name']}: held-out {old[1]:.4g} before, {r['best'][1] if r.get('best') else 'nothing'} now"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", required=True, help="folder of the recordings")
    parser.add_argument("--only", default="", help="machines whose name has this in it")
    parser.add_argument("--out", default="out/gauntlet", help="where results and models are written")
    parser.add_argument("--against", default="", help="results.json of an earlier run")
    options = parser.parse_args()
    with open(os.path.join(HERE, "machines.json")) as file:
        known = json.load(file)
    machines = [m for m in known if options.only.lower() in m["name"].lower()]
    if not machines:
        sys.exit(f'--only: found "{options.only}", expected a part of one of: {", ".join(m["name"] for m in known)}')
    results = []
    for machine in machines:
        data = os.path.abspath(os.path.join(options.data, machine["data"]))
        if not os.path.isdir(data):
            print(f"{machine['name']}: no folder {data}, left out", file=sys.stderr)
            continue
        if machine.get("join"):
            join_columns(data)
        print(f"{machine['name']} ...", file=sys.stderr, flush=True)
        results.append(row(machine, data, os.path.join(options.out, machine["name"].replace(" ", "_").replace(",", ""))))
        with open(os.path.join(options.out, "results.json.new"), "w") as file:
            json.dump(results, file, indent=1)
        os.replace(os.path.join(options.out, "results.json.new"), os.path.join(options.out, "results.json"))
    print("Errors in floors, train / held-out:\n\n" + table(results))
    for r in results:
        for note in r["notes"]:
            print(f"\n{r['name']}: {note}")
    if options.against:
        with open(options.against) as file:
            fallen = list(worse(results, json.load(file)))
        print("".join("\nWORSE: " + line for line in fallen))
        return 1 if fallen else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
