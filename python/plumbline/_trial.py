"""Trials: from arrays, from a folder, or from a simulated twin."""

import os

import numpy as np

from plumbline import _html, _plumbline
from plumbline._model import Model, load_model


def _channels(channels):
    return [(name, unit, np.ascontiguousarray(values, dtype=float)) for name, (values, unit) in channels.items()]


class Trial:
    """One recorded experiment.

    Trial(model, time=t, measured={"knee": (q, "deg")}, commands={"motor": (u, "N m")}, role="train")

    model     the Model whose sensors and motors the channels are named after
    time      1-d array, s, rising in equal steps
    measured  by sensor or contact switch: (array, unit); a contact switch has unit "1" and holds 0 and 1
    commands  by motor: (array, unit), held from each sample to the next
    role      "train" (may be fitted) or "held-out" (may only be predicted; another kind of motion)
    locked    by coordinate or motor that was held still: (value, unit)
    events    times at which something struck, s; predictions do not run across them
    name      for messages and tables

    Raises InputError on unknown names, wrong units, NaN, arrays of different length and unequal steps.
    Attributes `time`, `measured` and `commands` hold what is used: SI, by name.
    """

    def __init__(self, model, time, measured, commands=None, role="train", locked=None, events=(), name="trial",
                 title=""):
        self.model = model
        self._handle = _plumbline.trial_from_arrays(
            model._handle, name, title, role, np.ascontiguousarray(time, dtype=float), _channels(measured),
            _channels(commands or {}), [(at, unit, float(v)) for at, (v, unit) in (locked or {}).items()],
            [float(e) for e in events])

    @classmethod
    def _of(cls, handle, model):
        trial = cls.__new__(cls)
        trial.model = model
        trial._handle = handle
        return trial

    name = property(lambda self: self._handle.name)
    title = property(lambda self: self._handle.title)
    role = property(lambda self: self._handle.role)
    period = property(lambda self: self._handle.period)
    time = property(lambda self: self._handle.time)
    measured = property(lambda self: self._handle.measured)
    commands = property(lambda self: self._handle.commands)

    def describe(self):
        """What `plumbline check --json` says of it (docs/formats/json.md)."""
        return _plumbline.describe_trial(self._handle, self.model._handle)

    def save(self, folder):
        """Writes a trial folder (trial.yaml and data.csv) that the command line reads."""
        _plumbline.write_trial(self._handle, self.model._handle, os.fspath(folder))

    def __repr__(self):
        return f"<Trial {self.name!r}, {self.role}, {len(self.time)} samples of {self.period:g} s>"

    def _repr_html_(self):
        facts = self.describe()
        rows = [[m["sensor"], "measured", f"{m['rms']:.4g} {m['unit']}", f"{m['floor']:.3g} {m['unit']}"]
                for m in facts["measured"]]
        rows += [[c["motor"], "commanded", f"{c['rms']:.4g} {c['unit']}", ""] for c in facts["commands"]]
        return _html.paragraph(repr(self)[1:-1]) + _html.table(["channel", "", "rms", "floor"], rows)


def load_trial(path, model=None, data=""):
    """Reads a trial folder or its trial.yaml (docs/formats/trial.md). `model`: in place of the one that it
    names; `data`: the folder of its data file."""
    path = os.fspath(path)
    model = model or load_model(_plumbline.model_of_trial(path))
    return Trial._of(_plumbline.read_trial(path, model._handle, os.fspath(data)), model)


def twin(model, experiment, hidden=(), seed=1):
    """What the sensors of a simulated robot record: `model` with the `hidden` effects
    ("cable_stretch@knee:stiffness=3,damping=0.1"), playing an experiment file (docs/formats/experiment.md)."""
    assert isinstance(model, Model)
    return Trial._of(_plumbline.twin(model._handle, os.fspath(experiment), list(hidden), seed), model)
