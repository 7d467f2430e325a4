#!/usr/bin/env python3
"""What long work would take on more ranks than this machine has: recorded durations of tasks, replayed.

    scripts/scaling.py --work NAME=FILE... [--service 2e-4] [--turn 4e-4] [--ranks 1,16,64] [--svg OUT.svg]

A FILE is what PLUMBLINE_WORK_TIMES wrote (its column `processor`, or `seconds` where that is missing), a results file of the battery
(.jsonl, `processor_seconds`), or the durations.csv of a batch. `NAME=FILE*20` replays the tasks twenty times over, as a batch of twenty
times as many would have them. The rule is that of work/: a rank that is free gets the next task, the longest first where --longest says
that durations are known, else in the order of the file; the next run of tasks begins when all of one are done.

    --service  s that the first rank needs to hand out one task and to take its result: it does so one at a time
    --turn     s from the end of a task to the beginning of the next one on the same rank, beside the wait for the first rank
    --serial   NAME=S: processor time outside tasks, which every rank spends alike

Standard library only.
"""
import argparse
import csv
import heapq
import json


def read(path):
    """Runs of tasks: lists of seconds."""
    if path.endswith(".jsonl"):
        with open(path) as file:
            return [[case["processor_seconds"] for case in map(json.loads, list(file)[1:])]]
    runs = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row.get("task") == "all":
                continue
            seconds = row.get("processor") or row["seconds"]
            runs.setdefault(row.get("run"), []).append(float(seconds))
    return list(runs.values())


def one_run(tasks, ranks, service, turn):
    """Wall time of one run of tasks, handed out one at a time by the first rank."""
    free = [0.0] * ranks  # when each rank can take a task
    heapq.heapify(free)
    dispatcher = end = 0.0  # until when the first rank is busy with messages
    for task in tasks:
        at = heapq.heappop(free)
        dispatcher = max(dispatcher, at) + service
        done = dispatcher + task
        end = max(end, done + service)
        heapq.heappush(free, done + turn)
    return end


def replay(runs, ranks, options, serial):
    order = (lambda tasks: sorted(tasks, reverse=True)) if options.longest else list
    return serial + sum(one_run(order(tasks), ranks, options.service, options.turn) for tasks in runs)


def draw(curves, ranks, path):
    """Efficiency over ranks, as SVG."""
    width, height, left, top, bottom, right = 640, 360, 56, 16, 44, 200
    steps = {n: i for i, n in enumerate(ranks)}
    across = lambda n: left + steps[n] * (width - left - right) / max(len(ranks) - 1, 1)
    up = lambda share: top + (1.0 - share) * (height - top - bottom)
    colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for share in (0.0, 0.25, 0.5, 0.75, 0.9, 1.0):
        y = up(share)
        out.append(f'<line x1="{left}" y1="{y:.1f}" x2="{width - right}" y2="{y:.1f}" stroke="{"#999" if share == 0.9 else "#ddd"}"/>')
        out.append(f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{share:.0%}</text>')
    for n in ranks:
        out.append(f'<text x="{across(n):.1f}" y="{height - bottom + 18}" text-anchor="middle">{n}</text>')
    out.append(f'<text x="{(left + width - right) / 2}" y="{height - 8}" text-anchor="middle">ranks</text>')
    for i, (name, efficiency) in enumerate(curves.items()):
        colour = colours[i % len(colours)]
        points = " ".join(f"{across(n):.1f},{up(share):.1f}" for n, share in efficiency.items())
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        y = top + 16 + 20 * i
        out.append(f'<line x1="{width - right + 14}" y1="{y - 4}" x2="{width - right + 34}" y2="{y - 4}" stroke="{colour}" stroke-width="2"/>')
        out.append(f'<text x="{width - right + 40}" y="{y}">{name}</text>')
    with open(path, "w") as file:
        file.write("\n".join(out) + "\n</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", action="append", required=True, metavar="NAME=FILE[*TIMES]")
    parser.add_argument("--serial", action="append", default=[], metavar="NAME=S")
    parser.add_argument("--service", type=float, default=2e-4)
    parser.add_argument("--turn", type=float, default=4e-4)
    parser.add_argument("--longest", action="store_true")
    parser.add_argument("--ranks", default="1,2,4,8,16,32,64,128,256,512,1024")
    parser.add_argument("--svg")
    options = parser.parse_args()
    ranks = [int(n) for n in options.ranks.split(",")]
    serial = {name: float(value) for name, value in (one.split("=") for one in options.serial)}
    curves = {}
    print("| work | tasks | processor s | longest s | serial s | " + " | ".join(map(str, ranks)) + " |")
    print("| --- " * (5 + len(ranks)) + "|")
    for one in options.work:
        name, path = one.split("=", 1)
        path, _, times = path.partition("*")
        runs = [tasks * int(times or 1) for tasks in read(path)]
        alone = serial.get(name, 0.0)
        first = sum(map(sum, runs)) + alone
        took = {n: replay(runs, n, options, alone) for n in ranks}
        curves[name] = {n: first / (n * took[n]) for n in ranks}
        cells = [f"{took[n]:.3g} s, {curves[name][n]:.0%}" for n in ranks]
        longest = max(max(tasks) for tasks in runs)
        print(f"| {name} | {sum(map(len, runs))} | {first:.4g} | {longest:.3g} | {alone:.3g} | " + " | ".join(cells) + " |")
    if options.svg:
        draw(curves, ranks, options.svg)


if __name__ == "__main__":
    main()
