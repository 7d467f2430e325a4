#!/usr/bin/env python3
"""Draws the project's folders and who includes whom, out of the #includes themselves: docs/images/folders.svg.

Usage: draw_folders.py [--check]    --check: writes nothing; exit status 1 if the picture is not up to date.
An arrow that follows from others (a includes b, b includes c, so a may include c) is left out.
"""

import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PICTURE = os.path.join(ROOT, "docs", "images", "folders.svg")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)

# Where a part stands: left, right edge (columns of 0 to 12) and what it is for. Rows from above.
PARTS = [
    [("python", 0, 1.7, ""), ("validation/cli", 1.7, 12, "the command line")],
    [("validation/batch", 1.7, 5, "tables of models and trials"), ("validation/studies", 5, 12, "what belongs to one paper")],
    [("validation/api", 0, 5, "what command line and Python share"), ("validation/control", 5, 12, "controllers and gaits, certified and tuned")],
    [("validation/report", 0, 5, "the page, results as JSON")],
    [("validation/identify", 0, 12, "a model beside measurements")],
    [("simulator", 0, 8.4, "and contact: the equations of motion"), ("controllers", 8.4, 10.4, ""), ("work", 10.4, 12, "")],
]
DRAWN_IN = {"contact": "simulator"}  # simulator includes it, and it includes simulator/effects
WITH_FOLDERS = ("validation/studies", "validation/control", "validation/identify", "simulator")
TOP = ("simulator", "contact", "controllers", "work", "validation", "python")
WIDTH, BOX, STEP, PAD, GAP = 1000, 24, 50, 12, 30
COLOURS = {"validation/studies": "#fdf1dc", "validation/control": "#e7f3e4", "validation/identify": "#e3edf8"}


def part_of(path):
    if path.split("/")[0] in DRAWN_IN:
        return DRAWN_IN[path.split("/")[0]]
    for row in PARTS:
        for name, *_ in row:
            if path.startswith(name + "/"):
                return name
    return None


def folder_of(path):
    part = part_of(path)
    if part not in WITH_FOLDERS:
        return part
    if not path.startswith(part + "/"):
        return path.split("/")[0]
    rest = path[len(part) + 1:].split("/")
    return f"{part}/{rest[0]}" if len(rest) > 1 else part


def read_edges():
    """(folders, edges between folders) of all C++ files."""
    folders, edges = set(), set()
    for top in TOP:
        for here, below, files in os.walk(os.path.join(ROOT, top)):
            below.sort()
            for name in files:
                if not name.endswith((".h", ".cpp")):
                    continue
                path = os.path.relpath(os.path.join(here, name), ROOT)
                own = folder_of(path)
                if own is None:
                    sys.exit(f"{path}: found a folder that this drawing does not know, expected one of PARTS")
                folders.add(own)
                with open(os.path.join(here, name), encoding="utf-8") as file:
                    for included in INCLUDE.findall(file.read()):
                        other = folder_of(included)
                        if other and other != own:
                            edges.add((own, other))
    return folders, edges


def below(edges, start):
    """All that can be reached from `start` by one arrow or more."""
    seen, ahead = set(), [start]
    while ahead:
        here = ahead.pop()
        for a, b in edges:
            if a == here and b not in seen:
                seen.add(b)
                ahead.append(b)
    return seen


def reduced(edges):
    """Without the arrows that follow from others."""
    for a, b in edges:
        if a in below(edges, b):
            sys.exit(f"{a} and {b} include each other")
    return {(a, b) for a, b in edges if not any(b in below(edges, c) for x, c in edges if x == a and c != b)}


def levels(names, edges):
    """Rows from above by the longest way down, and the ways of the arrows: an arrow over several rows has a
    place of its own, None in name, in each row between."""
    level = {}

    def of(name):
        if name not in level:
            level[name] = 1 + max((of(b) for a, b in edges if a == name), default=-1)
        return level[name]

    for name in names:
        of(name)
    ways = []
    for a, b in sorted(edges):
        between = [(a, b, i) for i in range(level[a] - 1, level[b], -1)]
        level.update({node: node[2] for node in between})
        ways.append([a, *between, b])
    steps = [(x, y) for way in ways for x, y in zip(way, way[1:])]
    rows = [sorted((n for n in level if level[n] == i), key=str) for i in range(max(level.values()) + 1)]
    best = min((in_order(rows, steps, turn) for turn in range(24)), key=lambda order: crossings(order, steps))
    return best[::-1], ways


def in_order(rows, steps, turn):
    """Each over the middle of what it includes, and under what includes it, from a beginning of its own for each turn."""
    rows = [row[turn % len(row):] + row[:turn % len(row)] for row in rows]
    if turn % 2:
        rows = [row[::-1] if i % 2 else row for i, row in enumerate(rows)]
    place = {n: (i + 0.5) / len(row) for row in rows for i, n in enumerate(row)}
    for _ in range(6):
        for row in [*rows, *reversed(rows)]:
            near = {n: [place[y if x == n else x] for x, y in steps if n in (x, y)] for n in row}
            row.sort(key=lambda n: sum(near[n]) / len(near[n]) if near[n] else place[n])
            place.update({n: (i + 0.5) / len(row) for i, n in enumerate(row)})
    return rows


def crossings(rows, steps):
    place = {n: (i + 0.5) / len(row) for row in rows for i, n in enumerate(row)}
    row_of = {n: i for i, row in enumerate(rows) for n in row}
    crossed = sum(row_of[a] == row_of[c] and (place[a] - place[c]) * (place[b] - place[d]) < 0
                  for i, (a, b) in enumerate(steps) for c, d in steps[:i])
    return crossed, sum(abs(place[a] - place[b]) for a, b in steps)


class Drawing:
    def __init__(self):
        self.shapes, self.arrows, self.boxes = [], [], {}

    def box(self, name, label, x, y, width, height, fill, about="", bold=False):
        self.boxes[name] = (x, y, width, height)
        self.shapes.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="4" fill="{fill}" stroke="#8a93a0"/>')
        if bold:
            self.shapes.append(f'<text x="{x + 8:.1f}" y="{y + 17:.1f}"><tspan font-weight="bold">{label}</tspan>'
                               + (f'<tspan fill="#5a6270" dx="7">{about}</tspan>' if about else "") + "</text>")
        else:
            self.shapes.append(f'<text x="{x + width / 2:.1f}" y="{y + 16:.1f}" text-anchor="middle">{label}</text>')

    def curve(self, points):
        """Through points, upright at each."""
        (x, y), path = points[0], ""
        for xn, yn in points[1:]:
            bend = (yn - y) * 0.5
            path += f" C{x:.1f},{y + bend:.1f} {xn:.1f},{yn - bend:.1f} {xn:.1f},{yn:.1f}"
            x, y = xn, yn
        self.arrows.append(f'<path d="M{points[0][0]:.1f},{points[0][1]:.1f}{path}"/>')

    def inner_arrow(self, way):
        (xa, ya, wa, ha), (xb, yb, wb, _) = self.boxes[way[0]], self.boxes[way[-1]]
        between = [self.boxes[node] for node in way[1:-1]]
        start, end = xa + wa / 2, xb + wb / 2
        start += max(-0.3 * wa, min(0.3 * wa, 0.12 * ((between[0][0] if between else end) - start)))
        end += max(-0.3 * wb, min(0.3 * wb, 0.12 * ((between[-1][0] if between else start) - end)))
        middle = [point for x, y, _, _ in between for point in ((x, y), (x, y + BOX))]
        self.curve([(start, ya + ha), *middle, (end, yb - 1)])

    def arrow(self, a, b):
        """Between parts: straight down where they are over each other, else to the side, else around."""
        (xa, ya, wa, ha), (xb, yb, wb, hb) = self.boxes[a], self.boxes[b]
        left, right = max(xa, xb), min(xa + wa, xb + wb)
        if left < right:
            self.curve([((left + right) / 2, ya + ha), ((left + right) / 2, yb - 1)])
        elif ya < yb + hb and yb < ya + ha:
            y = (max(ya, yb) + min(ya + ha, yb + hb)) / 2
            x, xn = (xa + wa, xb - 1) if xa < xb else (xa, xb + wb + 1)
            self.arrows.append(f'<path d="M{x:.1f},{y:.1f} L{xn:.1f},{y:.1f}"/>')
        else:
            self.curve([(xa + wa / 2, ya + ha), (xb + wb / 2, yb - 1)])


def draw(folders, edges):
    drawing = Drawing()
    inner = {}
    for part in WITH_FOLDERS:
        names = sorted(f for f in folders if f != part and part_of(f + "/") == part)
        own = reduced({(a, b) for a, b in edges if a in names and b in names})
        inner[part] = levels(names, own)

    def height(part):
        return 2 * PAD + 18 + STEP * (len(inner[part][0]) - 1) + BOX if part in inner else 26

    y = 10
    bottoms = {}
    for row in PARTS:
        # A part stands below whatever is above its columns.
        for part, left, right, about in row:
            x, width = WIDTH / 12 * left + 6, WIDTH / 12 * (right - left) - 12
            top = max([y] + [bottom + GAP for (l, r), bottom in bottoms.items() if l < right and left < r])
            drawing.box(part, os.path.basename(part) if part.count("/") else part, x, top, width, height(part),
                        COLOURS.get(part, "#f1f2f4"), about, bold=True)
            bottoms[(left, right)] = top + height(part)
            if part in inner:
                rows, _ = inner[part]
                for i, names in enumerate(rows):
                    wide = [0 if isinstance(n, tuple) else max(54, 7.2 * len(os.path.basename(n)) + 14) for n in names]
                    space = (width - sum(wide)) / (len(names) + 1)
                    for k, name in enumerate(names):
                        at = x + space * (k + 1) + sum(wide[:k]), top + PAD + 18 + STEP * i, wide[k], BOX
                        if wide[k]:
                            drawing.box(name, os.path.basename(name), *at, "#ffffff")
                        else:
                            drawing.boxes[name] = at
    for _, ways in inner.values():
        for way in ways:
            drawing.inner_arrow(way)

    def whole(name):
        return part_of(name + "/") or name

    for a, b in sorted(reduced({(whole(a), whole(b)) for a, b in edges if whole(a) != whole(b)})):
        drawing.arrow(a, b)
    tall = max(bottoms.values()) + 10
    style = 'font-family="sans-serif" font-size="12.5" fill="#1c2430"'
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {tall:.0f}" width="{WIDTH}" height="{tall:.0f}" {style}>',
        "<!-- Written by scripts/draw_folders.py. -->",
        '<defs><marker id="tip" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
        '<path d="M0,0.5 L8,4 L0,7.5 z" fill="#4a5868"/></marker></defs>',
        f'<rect width="{WIDTH}" height="{tall:.0f}" fill="#ffffff"/>', *drawing.shapes,
        '<g fill="none" stroke="#4a5868" stroke-width="1.2" marker-end="url(#tip)">', *drawing.arrows, "</g>", "</svg>", ""])


def main(arguments):
    if arguments not in ([], ["--check"]):
        sys.exit(__doc__)
    picture = draw(*read_edges())
    if arguments:
        with open(PICTURE, encoding="utf-8") as file:
            if file.read() != picture:
                sys.exit("docs/images/folders.svg: found another picture, expected that of these includes; run scripts/draw_folders.py")
        return
    with open(PICTURE, "w", encoding="utf-8") as file:
        file.write(picture)


main(sys.argv[1:])
