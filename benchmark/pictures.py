"""Pictures of the benchmark's page as SVG text, and a page of HTML that needs no other file. Used by table.py."""

import html
import re

COLOURS = ("#1b6ca8", "#d1495b", "#3a7d44", "#e0a030", "#7a5ca8", "#6b7280")
WIDTH, HEIGHT, LEFT, BOTTOM, TOP = 640, 260, 62, 34, 14
STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:960px;margin:2em auto;padding:0 1em;color:#1a1a1a;background:#fff}
table{border-collapse:collapse;margin:.8em 0;font-size:13px}td,th{border:1px solid #ccc;padding:2px 7px;text-align:left;vertical-align:top}
th{background:#f2f4f7}svg{max-width:100%;height:auto}h2{margin-top:1.6em}figcaption{font-size:13px;color:#444}.wide{overflow-x:auto}"""


def text(x, y, words, anchor="middle", size=12):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" fill="#222">{html.escape(words)}</text>'


def frame(left_label):
    """Axis of shares from 0 to 1 with lines at quarters; returns the parts and the function share -> y."""
    def height(share):
        return TOP + (1.0 - share) * (HEIGHT - TOP - BOTTOM)
    parts = [f'<line x1="{LEFT}" x2="{WIDTH - 8}" y1="{height(s):.1f}" y2="{height(s):.1f}" stroke="#ddd"/>'
             + text(LEFT - 6, height(s) + 4, f"{s:.0%}", "end") for s in (0.0, 0.25, 0.5, 0.75, 1.0)]
    parts.append(f'<text x="12" y="{0.5 * HEIGHT:.0f}" font-size="12" text-anchor="middle" '
                 f'transform="rotate(-90 12 {0.5 * HEIGHT:.0f})">{html.escape(left_label)}</text>')
    return parts, height


def legend(names, colours):
    out, x = [], LEFT
    for name in names:
        out.append(f'<rect x="{x}" y="{HEIGHT + 4}" width="11" height="11" fill="{colours[name]}"/>' + text(x + 16, HEIGHT + 14, name, "start"))
        x += 30 + 7.2 * len(name)
    return out


def svg(parts, title):
    body = "".join(parts)
    return (f'<svg role="img" aria-label="{html.escape(title)}" viewBox="0 0 {WIDTH} {HEIGHT + 22}" width="{WIDTH}" '
            f'font-family="system-ui,sans-serif">{body}</svg>')


def bars(groups, names, colours, title):
    """groups: [(label, {entrant: share})]; a share of nothing draws nothing."""
    parts, height = frame("right at first place")
    step = (WIDTH - LEFT - 12) / max(1, len(groups))
    each = 0.8 * step / max(1, len(names))
    for i, (label, shares) in enumerate(groups):
        for k, name in enumerate(names):
            if name in shares:
                y = height(shares[name])
                parts.append(f'<rect x="{LEFT + i * step + 0.1 * step + k * each:.1f}" y="{y - 1.0:.1f}" width="{0.9 * each:.1f}" '
                             f'height="{height(0.0) - y + 1.0:.1f}" fill="{colours[name]}"><title>{html.escape(name)}: {shares[name]:.0%}</title></rect>')
        parts.append(text(LEFT + (i + 0.5) * step, HEIGHT - 16, label))
    return svg(parts + legend(names, colours), title)


def lines(points, names, colours, title, bottom_label, ticks):
    """points: {entrant: [(x from 0 to 1, share, count)]}; a dot's area grows with its count."""
    parts, height = frame("share that is right")

    def across(x):
        return LEFT + 10 + x * (WIDTH - LEFT - 30)
    parts += [text(across(x), HEIGHT - 18, words) for x, words in ticks] + [text(0.5 * (WIDTH + LEFT), HEIGHT - 3, bottom_label)]
    for name in names:
        here = [(across(x), height(y), n) for x, y, n in points.get(name, [])]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y, _ in here)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colours[name]}" stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{min(9.0, 2.5 + 0.6 * n ** 0.5):.1f}" fill="{colours[name]}" fill-opacity=".75">'
                  f'<title>{html.escape(name)}: {n}</title></circle>' for x, y, n in here]
    return svg(parts + legend(names, colours), title)


def reliability(stated, names, colours):
    """stated: {entrant: [bins of score.reliability]}; the diagonal is what an honest entrant draws."""
    points = {name: [(b["stated"], b["true"], b["count"]) for b in bins] for name, bins in stated.items()}
    picture = lines(points, names, colours, "Reliability", "confidence stated", [(x, f"{x:.0%}") for x in (0.0, 0.25, 0.5, 0.75, 1.0)])
    diagonal = f'<line x1="{LEFT + 10}" y1="{HEIGHT - BOTTOM}" x2="{WIDTH - 20}" y2="{TOP}" stroke="#999" stroke-dasharray="5 4"/>'
    return picture.replace("</svg>", diagonal + "</svg>")


def as_html(markdown):
    """The few forms that table.py writes: headings, tables, paragraphs; code and links are left as words."""
    out, rows, words = [], [], []

    def flush():
        if words:
            plain = re.sub(r"\[(.*?)\]\(.*?\)", r"\1", " ".join(words)).replace("`", "")
            out.append(f"<p>{html.escape(plain)}</p>")
            words.clear()
        if rows:
            head, *body = [[html.escape(c.strip()) for c in r.strip().strip("|").split("|")] for r in rows if not set(r) <= set("|- ")]
            out.append('<div class="wide"><table><tr>' + "".join(f"<th>{c}</th>" for c in head) + "</tr>"
                       + "".join("<tr>" + "".join(f"<td>{c}</td>" for c in r) + "</tr>" for r in body) + "</table></div>")
            rows.clear()
    for line in markdown:
        if line.startswith("|"):
            rows.append(line)
        elif line.startswith("#"):
            flush()
            level = len(line) - len(line.lstrip("#"))
            out.append(f"<h{level}>{html.escape(line.lstrip('# '))}</h{level}>")
        elif line:
            words.append(line)
        else:
            flush()
    flush()
    return out


def page(markdown, figures):
    """figures: {heading after which they stand: [(caption, svg)]}."""
    out = []
    for block in as_html(markdown):
        out.append(block)
        for heading, pictures in figures.items():
            if block.endswith(f">{html.escape(heading)}</h2>"):
                out += [f"<figure>{picture}<figcaption>{html.escape(caption)}</figcaption></figure>" for caption, picture in pictures]
    return ('<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
            f"<title>Naming a missing effect: the benchmark</title><style>{STYLE}</style>\n" + "\n".join(out) + "\n</html>\n")
