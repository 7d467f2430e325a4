#!/usr/bin/env python3
"""Makes the cases of the benchmark from a seed: OUT/cases/ID for entrants, OUT/truths/ID for the score.

Usage: make_cases.py --out DIR [--seed N | --secret-file FILE] [--set first|all] [--only TEXT] [--count N] [--prefix NAME] [--hashes FILE]
       make_cases.py --reveal SECRET [--out DIR] [--hashes FILE] [--case ID ...]

first: each single effect at one strength; all: each at three. --only: machines or groups that contain the text. The quadruped's cases need
MuJoCo and a C compiler; without them one line says so, and the others are made.

Sealed cases come from one secret of 32 hexadecimal digits (128 bits). The seed is HMAC-SHA256(secret, "seed"), the salt of a case
HMAC-SHA256(secret, "salt ID"), which can be shown for one case alone. --hashes writes SHA-256(salt + truth.json) of every case, by which
a truth is held to once it is shown. --reveal makes the cases of the hashes file (of benchmark/sealed, if no other is given) once more
and says of each truth whether it has the hash; status 1 where one has not.
"""

import argparse
import hashlib
import hmac
import json
import os
import re
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from generator import files, motion, plan, quadruped, quadruped_case  # noqa: E402
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
    """(identifier, entry, seed) of the cases; identifiers say nothing of what is hidden. A public seed draws the order machine by machine as
    they came to the benchmark, so that numbers stay; a secret draws one order of all."""
    rng = np.random.default_rng(options.seed)
    blocks = plan.BLOCKS if not options.secret else [options.machines]
    number = first = 0
    for machines in blocks:
        entries = list(plan.entries(options.set == "all", machines))
        # The first block's order is the one that it had alone.
        for index in rng.permutation(len(entries)):
            number, entry = number + 1, entries[index]
            if (not options.count or number <= options.count) and (options.only in entry[0] or options.only in entry[1]):
                yield f"{options.prefix}{number:03d}", entry, [options.seed, first + int(index)]
        first += len(entries)


def derived(secret, of):
    """A number's hexadecimal digits that say nothing of the secret."""
    return hmac.new(secret.encode(), of.encode(), hashlib.sha256).hexdigest()


def hash_of(path, salt):
    with open(path, "rb") as file:
        return hashlib.sha256(salt.encode() + file.read()).hexdigest()


def checked_secret(text, where):
    if not re.fullmatch("[0-9a-f]{32}", text):
        sys.exit(f"{where}: expected 32 hexadecimal digits (0-9, a-f), found {len(text)} characters that are not these")
    return text


def sources_hash():
    """Of the sources that decide over the cases: another generator makes other truths of the same secret."""
    whole, here = hashlib.sha256(), os.path.dirname(os.path.abspath(__file__))
    for name in sorted(os.listdir(os.path.join(here, "generator"))):
        if name.endswith((".py", ".c")):
            with open(os.path.join(here, "generator", name), "rb") as file:
                whole.update(file.read())
    return whole.hexdigest()


class Foreign:
    """The quadruped's world, made when it is asked for. Where MuJoCo is missing, one line says so and its cases are left out."""

    def __init__(self):
        self.world, self.missing = None, False

    def make(self, out, identifier, entry, seed):
        try:
            self.world = self.world or (None if self.missing else quadruped.World())
        except quadruped.Missing as error:
            self.missing = True
            print(f"The cases of the quadruped, from {identifier} on, are left out: {error} (Debian: libmujoco-dev, gcc).", file=sys.stderr)
        return quadruped_case.make(self.world, out, identifier, entry, seed) if self.world else None

    def close(self):
        if self.world:
            self.world.close()


def make_all(options):
    """Makes the cases; returns the hashes of the truths."""
    hashes, foreign = {}, Foreign()
    for identifier, entry, seed in chosen(options):
        if options.case and identifier not in options.case:
            continue
        truth = make(options.out, identifier, entry, seed) if entry[0] in MACHINES else foreign.make(options.out, identifier, entry, seed)
        if truth is None:
            continue
        salt = derived(options.secret, f"salt {identifier}") if options.secret else ""
        hashes[identifier] = hash_of(os.path.join(options.out, "truths", identifier, "truth.json"), salt)
        # What a secret hides is not for the screen.
        about = "sealed" if options.secret else f"{entry[0]} {entry[1]} shows {truth['shows']:.1f}"
        print(identifier, about, flush=True)
    foreign.close()
    return hashes


def reveal(options):
    """Status: 0 where every truth has the hash that it was sealed with."""
    with open(options.hashes, encoding="utf-8") as file:
        sealed = json.load(file)
    for key in ("set", "count", "prefix"):
        setattr(options, key, sealed["made"][key])
    options.only = sealed["made"].get("only", "")
    options.machines = tuple(sealed["made"]["machines"])  # those that the benchmark had then
    if sealed["generator"] != sources_hash():
        print(f"The generator is another one than that of {options.hashes}: take the sources of release {sealed['release']}.")
    hashes, wrong = make_all(options), 0
    for identifier, found in hashes.items():
        right = found == sealed["hashes"][identifier]
        wrong += not right
        print(f"{identifier} {'has' if right else 'DOES NOT HAVE'} its hash; salt {derived(options.secret, f'salt {identifier}')}")
    print(f"{len(hashes) - wrong} of {len(hashes)} truths have their hashes; they are in {options.out}/truths")
    return 1 if wrong else 0


def arguments():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--set", choices=("first", "all"), default="first")
    parser.add_argument("--only", default="")
    parser.add_argument("--count", type=int, help="only the first so many of the drawn order")
    parser.add_argument("--case", nargs="+", help="only these identifiers")
    parser.add_argument("--prefix", default="case_")
    parser.add_argument("--hashes", help="file of hashes, to write or with --reveal to read")
    parser.add_argument("--release", type=int, default=1, help="of the sealed cases, for the file of hashes")
    parser.add_argument("--secret-file")
    parser.add_argument("--reveal", metavar="SECRET")
    options = parser.parse_args()
    if not options.out and not options.reveal:
        parser.error("--out is needed")
    options.out = options.out or tempfile.mkdtemp(prefix="revealed_")
    options.secret = options.reveal and checked_secret(options.reveal, "--reveal")
    if options.reveal:
        options.hashes = options.hashes or os.path.join(here, "sealed", "hashes.json")
    elif options.secret_file:
        with open(options.secret_file, encoding="utf-8") as file:
            options.secret = checked_secret(file.read().strip(), options.secret_file)
    # Of a secret only machines whose truths are the same letter by letter wherever they are made.
    options.machines = tuple(machine for machine in sum(plan.BLOCKS, ()) if machine in MACHINES)
    if options.secret:
        options.seed = int(derived(options.secret, "seed"), 16)
    return options


def main():
    options = arguments()
    if options.reveal:
        sys.exit(reveal(options))
    hashes = make_all(options)
    if options.hashes:
        made = {"set": options.set, "count": options.count, "prefix": options.prefix, "only": options.only, "machines": options.machines}
        files.write_json(options.hashes, {"release": options.release, "made": made, "generator": sources_hash(), "hashes": hashes})


if __name__ == "__main__":
    main()
