"""The picture at the top of the README: a measured arm with an unknown payload, before and after it was named.

    ./plumb python scripts/arm_picture.py --data DIR --found found.yaml -o docs/images/arm_payload.svg

DIR has the recording loaded.csv (docs/results/ur10e.md); found.yaml is what `plumbline diagnose --save` wrote.
"""

import argparse

import numpy as np

import plumbline as pl

JOINT, TRIAL = "shoulder_lift", "validation/trials/ur10e/loaded_held-out"
WIDTH, HEIGHT, LEFT, TOP, BOTTOM = 860, 320, 62, 44, 44
COLOURS = {"as given": "#b3541e", "with the payload that was named, and the drives identified": "#1f6f8b"}


def residual(trial, model):
    time, measured, predicted = pl.compare([trial], model=model, progress=False).curve(trial.name, JOINT)
    return time, np.degrees(measured - predicted)


def path(x, y):
    pieces, pen = [], "M"
    for a, b in zip(x, y):
        if np.isnan(b):
            pen = "M"
            continue
        pieces.append(f"{pen}{a:.1f} {b:.1f}")
        pen = "L"
    return "".join(pieces)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", required=True)
    parser.add_argument("--found", required=True)
    parser.add_argument("-o", "--out", required=True)
    options = parser.parse_args()
    trial = pl.load_trial(TRIAL, data=options.data)
    lines = dict(zip(COLOURS, (residual(trial, trial.model), residual(trial, pl.load_model(options.found)))))
    low = min(np.nanmin(r) for _, r in lines.values())
    high = max(np.nanmax(r) for _, r in lines.values())
    start, end = trial.time[0], trial.time[-1]

    def across(t):
        return LEFT + (t - start) / (end - start) * (WIDTH - LEFT - 20)

    def down(r):
        return TOP + (high - r) / (high - low) * (HEIGHT - TOP - BOTTOM)

    step = max(1.0, round((high - low) / 5.0))
    ticks = [t for t in np.arange(np.ceil(low / step) * step, high, step)]
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="14">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="22" fill="#222">Shoulder lift of a UR10e, measured less predicted, degrees; each half second from its own start</text>']
    for t in ticks:
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - 20}" y1="{down(t):.1f}" y2="{down(t):.1f}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 8}" y="{down(t) + 5:.1f}" text-anchor="end" fill="#555">{t:g}</text>')
    for second in range(int(np.ceil(start)), int(end) + 1, 2):
        out.append(f'<text x="{across(second):.1f}" y="{HEIGHT - 22}" text-anchor="middle" fill="#555">{second} s</text>')
    for i, (name, (time, r)) in enumerate(lines.items()):
        out.append(f'<path d="{path(across(time), down(r))}" fill="none" stroke="{COLOURS[name]}" stroke-width="1.6"/>'
                   f'<text x="{LEFT + 10 + 130 * i}" y="{HEIGHT - 4}" fill="{COLOURS[name]}">{name}</text>')
    with open(options.out, "w") as file:
        file.write("\n".join(out) + "\n</svg>\n")


if __name__ == "__main__":
    main()
