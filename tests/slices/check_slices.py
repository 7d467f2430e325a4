"""Holds scripts/slices.txt against what ctest knows: check_slices.py ROOT BUILD CTEST.

Every slow test stands in one line; what is left out says why; no slice may take more than its share of an hour.
"""

import json
import os
import subprocess
import sys

LONGEST = 1200  # s on two cores: the quick tests and a first build have the rest of the hour
ALL_CORES = ("sanitized", "lint")
LINT_HARD_END = 60  # s that scripts/slices.sh leaves for the file that it is at


def rows_of(root):
    with open(os.path.join(root, "scripts/slices.txt")) as file:
        return [line.split() for line in file if line.strip() and not line.startswith("#")]


def slow_tests(build, ctest):
    known = json.loads(subprocess.run([ctest, "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True).stdout)
    for test in known["tests"]:
        for entry in test.get("properties", []):
            if entry["name"] == "LABELS" and "slow" in entry["value"]:
                yield test["name"]


def faults(rows, slow):
    named = [row[2] for row in rows if row[1] == "slow"]
    for test in slow:
        if named.count(test) != 1:
            yield f"slow test {test}: found {named.count(test)} lines, expected one"
    for row in rows:
        if row[0] == "out" and len(row) < 8:
            yield f"{' '.join(row)}: found no reason why it is left out"
        if row[0] != "out" and (row[0] not in ("*", *"012345") or len(row) != 4):
            yield f"{' '.join(row)}: expected slice, kind, what and seconds"


def seconds(rows, number):
    """On two cores, were every budget used up."""
    total = 0
    for slice_, kind, _, budget in rows:
        if slice_ in ("*", str(number)):
            total += int(budget) + LINT_HARD_END * (kind == "lint") if kind in ALL_CORES else int(budget) / 2
    return total


def main():
    root, build, ctest = sys.argv[1:]
    rows = rows_of(root)
    wrong = list(faults(rows, slow_tests(build, ctest)))
    in_slices = [row for row in rows if row[0] != "out"]
    for number in range(6):
        longest = seconds(in_slices, number) if not wrong else 0
        print(f"slice {number}: at most {longest:.0f} s")
        if longest > LONGEST:
            wrong.append(f"slice {number}: found budgets of {longest:.0f} s, expected at most {LONGEST}")
    print("\n".join(wrong))
    return 1 if wrong else 0


sys.exit(main())
