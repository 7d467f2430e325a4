#!/usr/bin/env python3
"""Runs an entrant on all cases, each within the case's limit of processor time, and keeps answers and times.

Usage: run_entrants.py CASES_FOLDER ANSWERS_FOLDER --entrant FOLDER [--until HH:MM] [--match TEXT ...] [--wall FACTOR] [-- OPTIONS OF THE ENTRANT]

ENTRANT/run.py is called with the case's folder and a folder for the answer. ANSWERS_FOLDER/NAME/CASE/run.json says how long it took and
how it ended. What an entrant had written when its time ended counts. A case that was run before is not run again, unless the wall clock ended
it: that says how busy the machine was, and table.py leaves it out.
"""

import argparse
import json
import os
import resource
import signal
import subprocess
import sys
import time

WALL_FACTOR = 5  # of the processor time: ends an entrant that waits; a machine that is busy with other work needs more


def limited(seconds):
    def prepare():
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
    return prepare


def wait_for(process, longest):
    """Polls a process group for so many seconds of wall time; returns how it ended."""
    begin = time.monotonic()
    while process.poll() is None:
        if time.monotonic() - begin > longest:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return "wall clock limit"
        time.sleep(0.02)
    return "ended" if process.returncode == 0 else f"exit {process.returncode}"


def run_case(entrant, case, out, wall, options):
    with open(os.path.join(case, "case.json"), encoding="utf-8") as file:
        seconds = int(json.load(file)["seconds_allowed"])
    os.makedirs(out, exist_ok=True)
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    with open(os.path.join(out, "log.txt"), "w", encoding="utf-8") as log:
        process = subprocess.Popen([sys.executable, os.path.join(entrant, "run.py"), case, out, *options],
                                   preexec_fn=limited(seconds), stdout=log, stderr=log)
        ending = wait_for(process, wall * seconds)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = {"processor_seconds": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
              "wall_seconds": time.monotonic() - begin, "ending": ending}
    with open(os.path.join(out, "run.json"), "w", encoding="utf-8") as file:
        json.dump(report, file)
    return report


def was_run(out):
    path = os.path.join(out, "run.json")
    if not os.path.exists(path):
        return False
    with open(path, encoding="utf-8") as file:
        return json.load(file)["ending"] != "wall clock limit"


def main():
    own, rest = sys.argv[1:], []
    if "--" in own:
        own, rest = own[:own.index("--")], own[own.index("--") + 1:]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases")
    parser.add_argument("answers")
    parser.add_argument("--entrant", required=True, help="a folder with run.py")
    parser.add_argument("--until", default="", help="begin no case after this time of day (UTC)")
    parser.add_argument("--match", nargs="+", default=[""], help="only cases whose names contain one of these")
    parser.add_argument("--wall", type=float, default=WALL_FACTOR, help="longest wall time of a case, in units of its processor time")
    options = parser.parse_args(own)
    name = os.path.basename(os.path.normpath(options.entrant))
    for case in sorted(os.listdir(options.cases)):
        out = os.path.join(options.answers, name, case)
        if not any(text in case for text in options.match) or was_run(out):
            continue
        if options.until and time.strftime("%H:%M", time.gmtime()) >= options.until:
            break
        report = run_case(options.entrant, os.path.join(options.cases, case), out, options.wall, rest)
        print(f"{case} {report['ending']} {report['processor_seconds']:.1f} s", flush=True)


if __name__ == "__main__":
    main()
