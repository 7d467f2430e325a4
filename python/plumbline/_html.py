"""Tables for notebooks and for print."""

import html


def table(head, rows):
    """HTML of a table; cells are escaped."""
    def line(cells, tag):
        return "<tr>" + "".join(
            f'<{tag} style="text-align:left">{html.escape(str(c))}</{tag}>' for c in cells) + "</tr>"
    return "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"


def paragraph(text):
    return f"<p>{html.escape(text)}</p>"


def number(value):
    """Four digits, as the command line prints them; a dash for nothing."""
    return "-" if value is None else f"{value:.4g}"


def text_table(head, rows):
    """The same as plain text."""
    cells = [[str(c) for c in row] for row in [head, *rows]]
    widths = [max(len(row[i]) for row in cells) for i in range(len(head))]
    lines = ["  ".join(c.ljust(w) for c, w in zip(row, widths)).rstrip() for row in cells]
    return "\n".join([lines[0], "  ".join("-" * w for w in widths), *lines[1:]])
