"""Two models beside one measurement: a channel as measured and as both predict it, and the error of another.

    ./plumb python scripts/draw_models.py --trials TRIAL... --models PUBLISHED FITTED --shown bsp_left --error mLA_right -o out.png

Trials are drawn one after the other, angles in degrees.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import plumbline as pl

COLOURS = ["#d1495b", "#2e86ab"]


def curves(result, trials, channel):
    return [np.concatenate(parts) for parts in zip(*[result.curve(t.name, channel) for t in trials])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", nargs="+", required=True)
    parser.add_argument("--models", nargs=2, required=True)
    parser.add_argument("--names", nargs=2, default=["published model", "model parameters fitted"])
    parser.add_argument("--window", type=float, default=0.05)
    parser.add_argument("--shown", required=True)
    parser.add_argument("--error", required=True)
    parser.add_argument("-o", "--out", required=True)
    asked = parser.parse_args()
    trials = [pl.load_trial(one) for one in asked.trials]

    plt.rcParams.update({"font.size": 11, "axes.spines.top": False, "axes.spines.right": False})
    figure, (above, below) = plt.subplots(2, 1, figsize=(9, 5.2), sharex=True)
    below.axhline(0, color="k", lw=0.8)
    for number, (model, name) in enumerate(zip(asked.models, asked.names)):
        result = pl.compare(trials, model=pl.load_model(model), window=asked.window)
        time, measured, predicted = curves(result, trials, asked.shown)
        if number == 0:
            above.plot(time, np.degrees(measured), "k", lw=1.6, label="measured")
        above.plot(time, np.degrees(predicted), color=COLOURS[number], lw=1.2, label=name)
        time, measured, predicted = curves(result, trials, asked.error)
        below.plot(time, np.degrees(predicted - measured), color=COLOURS[number], lw=1.2)
    above.set_ylabel(f"{asked.shown}, deg")
    above.legend(frameon=False, ncol=3, loc="upper center", bbox_to_anchor=(0.5, 1.2))
    below.set_ylabel(f"error of\n{asked.error}, deg")
    below.set_xlabel("time, s")
    figure.tight_layout()
    figure.savefig(asked.out, dpi=110)


if __name__ == "__main__":
    main()
