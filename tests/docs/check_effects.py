"""docs/effects.md and docs/images/effects are what the program prints and draws.

Usage: check_effects.py DOCS PLUMBLINE. Exit status 1 says what differs, and how to make it anew.
"""

import pathlib
import re
import subprocess
import sys
import tempfile


def main():
    docs, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    page = subprocess.run([program, "effects", "--page"], check=True, capture_output=True, text=True).stdout
    wrong = []
    if page != (docs / "effects.md").read_text():
        wrong.append("docs/effects.md")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "effects", "--pictures", folder], check=True)
        drawn = {file.name: file.read_text() for file in pathlib.Path(folder).glob("*.svg")}
    kept = {file.name: file.read_text() for file in (docs / "images" / "effects").glob("*")}
    wrong += sorted(name for name in drawn.keys() | kept.keys() if drawn.get(name) != kept.get(name))
    wrong += sorted(name for name, text in drawn.items() if re.search("nan|inf", text))
    shown = set(re.findall(r"images/effects/(\w+\.svg)", page))
    wrong += sorted(shown ^ drawn.keys())
    # Every effect has its row, and every row says with what it is confused and what tells it apart.
    listed = subprocess.run([program, "effects"], check=True, capture_output=True, text=True).stdout
    names = re.findall(r"^(\w+) \(at:", listed, re.MULTILINE)
    for name in names:
        rows = [line for line in page.splitlines() if f"**{name}**" in line]
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", rows[0])] if len(rows) == 1 else []
        if len(cells) != 6 or not cells[3] or not cells[4]:
            wrong.append(f"{name}: found {len(rows)} rows, expected one with all its cells")
    if not names or wrong:
        print("not what the program makes:", *wrong, sep="\n  ")
        print("run: plumbline effects --page > docs/effects.md; plumbline effects --pictures docs/images/effects")
        return 1
    print(f"{len(names)} effects, {len(drawn)} pictures")
    return 0


if __name__ == "__main__":
    sys.exit(main())
