"""Every link of the documentation leads to a file (and a heading) that is there, and every page is short.

Usage: check_links.py ROOT
"""

import os
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)|<img src=\"([^\"]+)\"")
LONGEST = 300  # lines


def anchor(heading):
    return re.sub(r"[^a-z0-9 _-]", "", heading.strip().lower()).replace(" ", "-")


def pages(root):
    yield from (os.path.join(root, name) for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"))
    for folder, _, names in os.walk(os.path.join(root, "docs")):
        yield from (os.path.join(folder, name) for name in names if name.endswith(".md"))


def text_of(page):
    """Without code: what looks like a link there is none."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)), text.count("\n")


def main(root):
    wrong = []
    reached = {os.path.join(root, "README.md")}
    for page in pages(root):
        text, lines = text_of(page)
        limit = 150 if page == os.path.join(root, "README.md") else LONGEST
        if lines > limit:
            wrong.append(f"{page}: {lines} lines, expected at most {limit}")
        for found in LINK.finditer(text):
            target = found.group(1) or found.group(2)
            if "://" in target or target.startswith("mailto:"):
                continue
            path, _, heading = target.partition("#")
            file = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            reached.add(file)
            if not os.path.exists(file):
                wrong.append(f"{page}: {target}: no such file")
            elif heading and heading not in {anchor(h) for h in re.findall(r"^#+ (.*)$", text_of(file)[0], re.M)}:
                wrong.append(f"{page}: {target}: no such heading")
    for page in pages(root):
        if page not in reached:
            wrong.append(f"{page}: no page leads here")
    sys.exit("\n".join(wrong) or 0)


main(*sys.argv[1:])
