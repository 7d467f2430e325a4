#!/usr/bin/env python3
"""Errors of a running robot, step by step, from traces of `plumbline simulate --scenario FILE -o TRACE`.

    scripts/running_errors.py TRACE... [--settle 20] [--com-up 0.08] [--steps]

Each trace gives one line: means over the stances or flights behind the first --settle steps, from the true positions and ground
forces of the trace and from what the controller logs of its plan (x_planned, z_planned, force_x_wanted, ...). With --steps, each
step's speed, instead. The centre of mass is taken as fixed in the trunk, --com-up above the hip.
"""
import argparse
import csv
import math
import sys


def read(path):
    with open(path, newline="") as file:
        rows = csv.reader(line for line in file if not line.startswith("#"))
        names = [name.split(" [")[0].strip() for name in next(rows)]
        columns = list(zip(*[[float(value) for value in row] for row in rows]))
    return dict(zip(names, columns))


def stances(trace, feet, shortest=0.02):
    """Index ranges in which some foot is loaded, split where none is for `shortest` s."""
    force = [sum(trace[f"F_{foot}_z"][k] for foot in feet) for k in range(len(trace["t"]))]
    ranges, begin, last = [], None, None
    for k, value in enumerate(force):
        if value > 0.0:
            if begin is None:
                begin = k
            elif trace["t"][k] - trace["t"][last] > shortest:
                ranges.append((begin, last + 1))
                begin = k
            last = k
    return ranges


def steps_of(trace, com_up, feet):
    """One entry for each flight that follows a stance: what was wanted and what came out."""
    t = trace["t"]
    x = [h - com_up * math.sin(a) for h, a in zip(trace["q_hip_x"], trace["q_trunk"])]
    z = [h + com_up * math.cos(a) for h, a in zip(trace["q_hip_z"], trace["q_trunk"])]
    ranges = stances(trace, feet)
    steps = []
    for (begin, end), (after, _) in zip(ranges, ranges[1:]):
        if after - end < 10:
            continue
        inside = [k for k in range(begin, end) if trace["phase"][k] == 1.0]
        mean = lambda values: sum(values) / max(1, len(values))
        loaded = lambda axis, k: sum(trace[f"F_{foot}_{axis}"][k] for foot in feet)
        steps.append({
            "t": t[end],
            "wanted": trace["speed_wanted"][(begin + end) // 2],
            "speed": (x[after] - x[end]) / (t[after] - t[end]),
            "foretold": trace["flight_speed"][after],
            "apex": max(z[end:after]),
            "x": mean([abs(trace["x"][k] - trace["x_planned"][k]) for k in inside]),
            "z": mean([abs(trace["z"][k] - trace["z_planned"][k]) for k in inside]),
            "lean": mean([abs(trace["q_trunk"][k]) for k in inside]),
            "force_change": trace["mean_force_change"][after],
            "torque": trace["mean_torque_error"][after],
            "force": mean([math.hypot(loaded("x", k) - trace["force_x_wanted"][k],
                                      loaded("z", k) - trace["force_z_wanted"][k]) for k in inside]),
            "impact": max(abs(loaded("x", k)) for k in range(begin, min(begin + 30, end))),
            "stance": t[end] - t[begin],
            "flight": t[after] - t[end],
        })
    return steps


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("traces", nargs="+")
    parser.add_argument("--settle", type=int, default=20)
    parser.add_argument("--com-up", type=float, default=0.08)
    parser.add_argument("--apex", type=float, default=1.01, help="wanted height of the centre of mass, m")
    parser.add_argument("--feet", default="left,right")
    parser.add_argument("--steps", action="store_true")
    options = parser.parse_args()
    head = ("trace", "steps", "speed error m/s", "estimated m/s", "apex error cm", "x cm", "z cm", "lean deg", "feedback N",
            "force error N", "spring torque N m", "impact N", "flight ms", "stance ms")
    if not options.steps:
        print(" | ".join(head))
    for path in options.traces:
        steps = steps_of(read(path), options.com_up, options.feet.split(","))
        if options.steps:
            for number, one in enumerate(steps, 1):
                print(f"{number:4d} {one['t']:7.3f} s  wanted {one['wanted']:5.2f}  speed {one['speed']:6.3f} m/s  "
                      f"error  {one['speed'] - one['wanted']:+.3f}  apex {one['apex']:.3f} m  lean "
                      f"{math.degrees(one['lean']):4.1f} deg  flight {1e3 * one['flight']:3.0f} ms")
            continue
        kept = steps[options.settle:] or steps
        mean = lambda of: sum(of(one) for one in kept) / max(1, len(kept))
        values = (mean(lambda s: abs(s["speed"] - s["wanted"])), mean(lambda s: abs(s["foretold"] - s["wanted"])),
                  100 * mean(lambda s: abs(s["apex"] - options.apex)), 100 * mean(lambda s: s["x"]),
                  100 * mean(lambda s: s["z"]), math.degrees(mean(lambda s: s["lean"])),
                  mean(lambda s: s["force_change"]), mean(lambda s: s["force"]), mean(lambda s: s["torque"]),
                  mean(lambda s: s["impact"]), 1e3 * mean(lambda s: s["flight"]), 1e3 * mean(lambda s: s["stance"]))
        print(" | ".join([path, str(len(steps))] + [f"{value:.3g}" for value in values]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
