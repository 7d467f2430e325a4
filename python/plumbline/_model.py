"""Models: read from a file, changed in memory, written as overlays."""

import os

from plumbline import _html, _plumbline


class Model:
    """A robot's model. It is never changed: `with_effect`, `fit` and `diagnose` give new ones.

    file         the model file that it was read from
    robot        its title
    coordinates, motors, sensors, contact_switches, effects
                 lists of dicts, as `plumbline check --json` writes them (docs/formats/json.md)
    places       names of the places where effects may sit, by kind of place
    parameters   labels of what a fit can free, such as "viscous@mLA:damping"
    """

    def __init__(self, handle):
        self._handle = handle
        self._facts = None

    def _fact(self, name):
        if self._facts is None:
            self._facts = _plumbline.describe_model(self._handle)
        return self._facts[name]

    file = property(lambda self: self._handle.file)
    robot = property(lambda self: self._fact("robot"))
    coordinates = property(lambda self: self._fact("coordinates"))
    motors = property(lambda self: self._fact("motors"))
    sensors = property(lambda self: self._fact("sensors"))
    contact_switches = property(lambda self: self._fact("contact_switches"))
    effects = property(lambda self: self._fact("effects"))
    places = property(lambda self: self._fact("places"))
    parameters = property(lambda self: _plumbline.parameter_labels(self._handle))

    def with_effect(self, effect, at, trial=None, **values):
        """The model with one effect more. Values are SI; those not given are the law's start, by the scales of
        a train trial's motion where `trial` is one. Raises InputError on unknown names and values out of bounds.
        """
        texts = [f"{name}={value!r}" for name, value in values.items()]
        return Model(_plumbline.add_effect(self._handle, effect, at, texts, trial._handle if trial else None))

    def save(self, file, note="written from Python"):
        """Writes what is new against `file` of the model as an overlay (docs/formats/model.md)."""
        _plumbline.save_model(self._handle, os.fspath(file), note)

    def __repr__(self):
        named = ", ".join(f"{e['effect']}@{e['at']}" for e in self.effects) or "none"
        return f"<Model {self.robot!r} of {self.file}; effects: {named}>"

    def _repr_html_(self):
        rows = []
        for e in self.effects:
            for name, q in e["values"].items():
                origin = ("assumed: " if q["assumed"] else "") + q["source"]
                rows.append([f"{e['effect']}@{e['at']}", name, _html.number(q["value"]),
                             _html.number(q["standard_deviation"] or None), q["unit"], origin])
        return _html.paragraph(f"{self.robot} ({self.file})") + _html.table(
            ["effect", "parameter", "value", "+-", "unit", "source"], rows)


def load_model(file):
    """Reads a model file (docs/formats/model.md). Raises InputError with file, line and key."""
    return Model(_plumbline.read_model(os.fspath(file)))


class _Effects(list):
    """The catalogue, as a list of dicts (docs/formats/json.md, `effects`)."""

    def _repr_html_(self):
        return _html.table(["effect", "sits at", "equation", "parameters"],
                           [[e["name"], ", ".join(e["places"]), e["equation"],
                             ", ".join(p["name"] for p in e["parameters"])] for e in self])


def effects():
    """All effects that the program knows: name, places, equation, source, parameters."""
    return _Effects(_plumbline.effects("")["effects"])


def effect(name):
    """One effect of the catalogue. Raises InputError with the nearest names."""
    return _plumbline.effects(name)["effects"][0]
