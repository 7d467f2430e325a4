#!/usr/bin/env python3
"""Makes the cases of the benchmark from a seed: OUT/cases/ID for entrants, OUT/truths/ID for the score.

Usage: make_cases.py --out DIR [--seed N] [--set first|all] [--only TEXT] [--count N] [--prefix NAME]
                     [--hashes FILE --salt-file FILE] [--seed-file FILE]

first: each single effect at one strength (63 cases); all: each at three (150). --only: machines or groups that contain the text.
--hashes writes SHA-256(salt + truth.json) of every case, by which a sealed truth is held to once it is shown. A case's salt is
SHA-256(text of --salt-file + identifier), in hexadecimal: it can be shown for one case alone. --seed-file: a seed that is not to be seen.
"""

import argparse
import hashlib
import os
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from generator import files, motion, plan  # noqa: E402
from generator.machines import MACHINES  # noqa: E402
from generator.world import PERIOD, World  # noqa: E402

WINDOW = 125  # samples over which it is asked how far the hidden effects show


def tables_of(machine, world, records, rng):
    """Readings by file and column, and the true states of the first recording."""
    tables, first = {}, None
    scale = next((e["values"]["gain"] for e in world.effects if e["kind"] == "sensor_gain"), 1.0)
    for name, _, commands, start in records:
        held = commands / np.array([ratio or 1.0 for ratio in world.ratio])
        held = np.round(held, 6)
        states = world.run(world.start([round(float(x), 6) for x in start]), held.tolist())
        first = (states, held) if first is None else first
        joints, motors = world.positions(states)
        table = {f"u_{j}": held[:, machine.joints.index(j)] for j in machine.stated["drives"]}
        for column, about in files.columns(machine).items():
            if about["is"] == "joint position":
                table[column] = motion.read(scale * joints[about["joint"]], motion.sensor_kind(machine, about["joint"]), rng)
            elif about["is"] == "motor position":
                table[column] = motion.read(motors[about["joint"]], motion.SENSORS["motor"], rng)
            elif about["is"] == "contact switch":
                n = len(machine.joints)
                table[column] = np.array([float(world.machine.ground_force(y[:n], y[n:2 * n]) > 0.0) for y in states])
        tables[f"{name}.csv"] = table
    return tables, first


def shows(machine, world, numbers, first):
    """By how many floors windows of the first recording differ without what is hidden: root mean square over joint positions."""
    states, held = first
    n = len(machine.joints)
    bare = World(machine.name, numbers, [])
    squares = []
    for begin in range(0, len(states) - WINDOW, WINDOW):
        mine = bare.run(states[begin, :2 * n].tolist(), held[begin:begin + WINDOW].tolist(), begin)
        for j, joint in enumerate(machine.joints):
            difference = mine[:, j] - states[begin:begin + WINDOW, j]
            squares.append(np.mean((difference / motion.floor(motion.sensor_kind(machine, joint))) ** 2))
    return float(np.sqrt(np.mean(squares)))


def make(out, identifier, entry, seed):
    machine_name, group, strength, maker = entry
    rng = np.random.default_rng(seed)
    machine = MACHINES[machine_name]
    effects = maker(rng)
    numbers = motion.true_numbers(machine, rng)
    records = motion.recordings(machine, rng)
    world = World(machine_name, numbers, effects)
    tables, first = tables_of(machine, world, records, rng)
    truth = {"id": identifier, "group": group, "strength": strength, "effects": effects, "numbers": numbers,
             "shows": shows(machine, world, numbers, first) if effects else 0.0, "period": PERIOD}
    case = files.describe(identifier, machine, records)
    files.write_case(out, case, machine, tables, truth)
    return truth


def chosen(options):
    """(identifier, entry, seed) of the cases; identifiers say nothing of what is hidden."""
    entries = list(plan.entries(options.set == "all"))
    order = np.random.default_rng(options.seed).permutation(len(entries))
    for number, index in enumerate(order[:options.count]):
        entry = entries[index]
        if options.only in entry[0] or options.only in entry[1]:
            yield f"{options.prefix}{number + 1:03d}", entry, [options.seed, int(index)]


def hash_of(path, salt):
    with open(path, "rb") as file:
        return hashlib.sha256(salt.encode() + file.read()).hexdigest()


def text_of(path):
    if not path:
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read().strip()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--set", choices=("first", "all"), default="first")
    parser.add_argument("--only", default="")
    parser.add_argument("--count", type=int, help="only the first so many of the drawn order")
    parser.add_argument("--prefix", default="case_")
    parser.add_argument("--hashes")
    parser.add_argument("--salt-file")
    parser.add_argument("--seed-file")
    options = parser.parse_args()
    options.seed = int(text_of(options.seed_file)) if options.seed_file else options.seed
    secret, hashes = text_of(options.salt_file), {}
    for identifier, entry, seed in chosen(options):
        truth = make(options.out, identifier, entry, seed)
        hashes[identifier] = hash_of(os.path.join(options.out, "truths", identifier, "truth.json"),
                                     hashlib.sha256((secret + identifier).encode()).hexdigest())
        print(f"{identifier} {entry[0]} {entry[1]}", f"shows {truth['shows']:.1f}", flush=True)
    if options.hashes:
        files.write_json(options.hashes, hashes)


if __name__ == "__main__":
    main()
