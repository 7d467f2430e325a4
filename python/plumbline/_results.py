"""What the work returns: attributes for programs, tables for people, curves as numpy arrays."""

from plumbline import _html
from plumbline._html import number


class _Result:
    """`data`: the whole result as `--json` writes it (docs/formats/json-results.md)."""

    def __init__(self, data):
        self.data = data

    def _parts(self):
        """(text, head, rows) of each table."""
        raise NotImplementedError

    def __repr__(self):
        blocks = []
        for text, head, rows in self._parts():
            blocks += [text] if text else []
            blocks += [_html.text_table(head, rows)] if rows else []
        return "\n\n".join(blocks)

    def _repr_html_(self):
        return "".join((_html.paragraph(text) if text else "") + (_html.table(head, rows) if rows else "")
                       for text, head, rows in self._parts())


class Comparison(_Result):
    """A model held against trials.

    train, held_out  errors in units of the floor (1: what the sensors alone leave)
    channels, windows, phases, horizons
                     lists of dicts; horizons: rms in deg, mm or N so long after the last known measurement
    curves           by trial: {"trial", "role", "time", "channels": {sensor: {"measured", "predicted", "unit",
                     "floor"}}}; arrays of the trial's samples, SI, NaN where no window predicts
    """

    def __init__(self, data, curves):
        super().__init__(data)
        self.curves = curves

    train = property(lambda self: self.data["train"])
    held_out = property(lambda self: self.data["held_out"])
    channels = property(lambda self: self.data["channels"])
    windows = property(lambda self: self.data["windows"])
    phases = property(lambda self: self.data["phases"])
    horizons = property(lambda self: self.data["horizons"])

    def curve(self, trial, channel):
        """(time, measured, predicted) of one channel; `trial` by name."""
        for one in self.curves:
            if one["trial"] == trial:
                found = one["channels"][channel]
                return one["time"], found["measured"], found["predicted"]
        raise KeyError(f"no trial {trial!r}; there are {[c['trial'] for c in self.curves]}")

    def _parts(self):
        yield (f"Error in units of the floor: train {self.train:.3f}, held-out {self.held_out:.3f}",
               ["trial", "role", "channel", "rms", "floor", "rms/floor"],
               [[c["trial"], c["role"], c["name"], f"{c['rms']:.4g} {c['unit']}",
                 f"{c['floor']:.3g} {c['unit']}", f"{c['ratio']:.2f}"] for c in self.channels])
        horizons = sorted({h["horizon"] for h in self.horizons})
        cells = {}
        for h in self.horizons:
            cells.setdefault((h["trial"], h["channel"], h["unit"]), {})[h["horizon"]] = number(h["rms"])
        yield ("Error over the prediction horizon, after the last known measurement:",
               ["trial", "channel", "unit", *[f"{h:g} s" for h in horizons]],
               [[*key, *[row.get(h, "-") for h in horizons]] for key, row in cells.items()])


class Fit(_Result):
    """Parameters with intervals.

    parameters  list of dicts: label, unit, before, after, standard_deviation, interval, partner, correlation,
                doubts
    before, after
                errors: dicts with train and held_out
    model       the Model with the fitted values
    """

    def __init__(self, data, model):
        super().__init__(data)
        self.model = model

    parameters = property(lambda self: self.data["parameters"])
    before = property(lambda self: self.data["before"])
    after = property(lambda self: self.data["after"])
    converged = property(lambda self: self.data["converged"])

    def __getitem__(self, label):
        """One parameter by its label, such as "viscous@mLA:damping"."""
        for one in self.parameters:
            if one["label"] == label:
                return one
        raise KeyError(f"no parameter {label!r}; there are {[p['label'] for p in self.parameters]}")

    def _parts(self):
        yield (f"Error in units of the floor: train {number(self.before['train'])} before, "
               f"{number(self.after['train'])} after; held-out {number(self.before['held_out'])} before, "
               f"{number(self.after['held_out'])} after",
               ["parameter", "unit", "before", "after", "interval", "doubts"],
               [[p["label"], p["unit"], number(p["before"]), number(p["after"]),
                 f"{number(p['interval'][0])} to {number(p['interval'][1])}",
                 "; ".join(d["text"] for d in p["doubts"])] for p in self.parameters])


class Diagnosis(_Result):
    """Which effect is missing, where, how sure.

    verdict      "missing", "nothing_missing" or "unexplained"
    summary      the answer in about two sentences
    found        accepted effects, list of dicts: effect, at, equation, parameters, rivals, selected_share, ...
    ladder       models in the order in which they were tried, with train and held-out errors
    ranking      best candidates of the first round
    interrupted  stopped before the end: the rest is what was finished
    model        the best Model found: what is named, and beside it what predicts better still (data["best_model"])
    """

    def __init__(self, data, model):
        super().__init__(data)
        self.model = model

    verdict = property(lambda self: self.data["verdict"])
    summary = property(lambda self: self.data["summary"])
    found = property(lambda self: self.data["accepted"])
    ladder = property(lambda self: self.data["ladder"])
    ranking = property(lambda self: self.data["ranking"])
    interrupted = property(lambda self: self.data["interrupted"])

    def _parts(self):
        yield (self.summary, ["effect", "at", "parameter", "value", "+-", "unit", "cannot be told from"],
               [[f["effect"], f["at"], p["name"], number(p["value"]),
                 "chosen" if p["chosen"] else number(p["standard_deviation"]), p["unit"],
                 "; ".join(f"{r['effect']}@{r['at']}" for r in f["rivals"])]
                for f in self.found for p in f["parameters"]])
        yield ("Ladder, errors in units of the floor:", ["model", "train", "held-out"],
               [[r["name"], f"{r['train']:.3f}", f"{r['held_out']:.3f}"] for r in self.ladder])


class Simulation(_Result):
    """A motion.

    time             s
    columns          by name: arrays, SI: q_SENSOR, u_MOTOR, x_NAME and v_NAME (positions and velocities),
                     F_FOOT_x, _y, _z
    units            by name
    data             duration, seconds (wall clock), method, steps, energy_error, energy_exchanged, channels
                     (rms of measured less simulated over the whole trial)
    """

    def __init__(self, data, columns):
        super().__init__(data)
        self.columns = {name: values for name, (values, _) in columns.items() if name != "t"}
        self.units = {name: unit for name, (_, unit) in columns.items() if name != "t"}
        self.time = columns["t"][0]

    def __getitem__(self, name):
        return self.columns[name]

    def _parts(self):
        d = self.data
        yield (f"Simulated {d['duration']:g} s with {d['method']} in {d['seconds']:.3g} s, {d['steps']} steps; "
               f"energy balance off by {d['energy_error']:.2e} J of {d['energy_exchanged']:.4g} J",
               ["channel", "rms", "floor"],
               [[c["name"], f"{c['rms']:.4g} {c['unit']}", f"{c['floor']:.3g} {c['unit']}"]
                for c in d["channels"]])
