"""Does what a page of the documentation says, in an empty folder.

Usage: run_page.py PAGE PROGRAM

A fenced block whose first line names a file (```yaml model.yaml) is written to it. Blocks of ```sh are run by one
shell, in the order of the page; every command must end with status 0. Each line of a ```text block must be among
what the commands said, numbers aside (another compiler rounds another way).
"""

import os
import re
import subprocess
import sys
import tempfile

NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")


def blocks(page):
    """(language, file or "", text, line) of each fenced block."""
    with open(page, encoding="utf-8") as file:
        lines = file.read().split("\n")
    found, start, words = [], None, []
    for number, line in enumerate(lines):
        if not line.startswith("```"):
            continue
        if start is None:
            start, words = number, line[3:].split()
        else:
            text = "".join(one + "\n" for one in lines[start + 1:number])
            found.append((words[0] if words else "", words[1] if len(words) > 1 else "", text, start + 1))
            start = None
    return found


def shape(text):
    """One line without its numbers."""
    return NUMBER.sub("#", " ".join(text.split()))


def main(page, program):
    script, expected = "set -euo pipefail\n", []
    for language, file, text, line in blocks(page):
        if file:
            script += f"cat > '{file}' <<'END_OF_FILE'\n{text}END_OF_FILE\n"
        elif language == "sh":
            script += text
        elif language == "text":
            expected += [(shape(one), line) for one in text.split("\n") if one.strip()]
    path = os.path.dirname(os.path.abspath(program)) + ":" + os.environ["PATH"]
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["bash", "-c", script], cwd=folder, env={**os.environ, "PATH": path}, text=True,
                              timeout=600, capture_output=True, check=False)
    sys.stdout.write(done.stdout)
    sys.stderr.write(done.stderr)
    if done.returncode != 0:
        sys.exit(f"{page}: a command ended with status {done.returncode}")
    said = shape(done.stdout)
    for wanted, line in expected:
        if wanted not in said:
            sys.exit(f'{page}:{line}: expected "{wanted}", which no command said')
    if not expected:
        sys.exit(f"{page}: found no block of text, expected what the commands say")


main(*sys.argv[1:])
