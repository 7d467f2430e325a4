"""The work itself: compare, fit, diagnose, simulate."""

import os
import sys
import time

from plumbline import _plumbline
from plumbline._model import Model
from plumbline._results import Comparison, Diagnosis, Fit, Simulation
from plumbline._trial import Trial


class Interrupted(KeyboardInterrupt):
    """Ctrl-C. `result`: what a diagnosis had finished; otherwise None."""

    def __init__(self, result=None):
        super().__init__("stopped by the user")
        self.result = result


class _Line:
    """One line on standard error that shows what goes on, where a person looks at it."""

    def __init__(self, wanted):
        seen = sys.stderr is not None and (sys.stderr.isatty() or "ipykernel" in sys.modules)
        self._call = wanted if callable(wanted) else self._show if (wanted is None and seen) or wanted else None
        self._start = time.monotonic()
        self._width = 0

    def _show(self, what, fraction):
        text = f"[{time.monotonic() - self._start:.0f} s] {what} {100 * fraction:.0f} %"
        print("\r" + text.ljust(self._width), end="", file=sys.stderr, flush=True)
        self._width = len(text)

    def __enter__(self):
        return self._call

    def __exit__(self, *_):
        if self._width:
            print("\r" + " " * self._width + "\r", end="", file=sys.stderr, flush=True)


def _asked(trials, model):
    trials = [trials] if isinstance(trials, Trial) else list(trials)
    if model is None:
        if not trials:
            raise _plumbline.InputError("trials: found none, expected at least one trial")
        model = trials[0].model
    if not isinstance(model, Model):
        raise TypeError("model: expected what load_model gives")
    return model, [t._handle for t in trials]


def compare(trials, model=None, window=0.5, progress=None):
    """Predicts the trials in windows with the model as it is.

    trials    a Trial or several; model: in place of that of the first trial; window: s
    progress  None: a line on standard error where a person looks at it; False: nothing; True: always; or a
              function of (what, fraction)

    Returns a Comparison. Raises InputError, Interrupted.
    """
    model, handles = _asked(trials, model)
    with _Line(progress) as line:
        interrupted, data, curves = _plumbline.compare(model._handle, handles, window, line)
    if interrupted:
        raise Interrupted()
    return Comparison(data, curves)


def fit(trials, free, model=None, window=0.5, iterations=40, confidence=0.95, progress=None):
    """Fits parameters on the train trials and predicts the held-out ones.

    free  labels of Model.parameters, or patterns of them: "viscous@*:damping"

    Returns a Fit. Raises InputError, Interrupted.
    """
    model, handles = _asked(trials, model)
    free = [free] if isinstance(free, str) else list(free)
    with _Line(progress) as line:
        interrupted, data, fitted = _plumbline.fit(model._handle, handles, window, free, iterations, confidence,
                                                   line)
    if interrupted:
        raise Interrupted()
    return Fit(data, Model(fitted))


def diagnose(trials, model=None, window=0.5, without=(), most=4, seed=1, progress=None):
    """Which effect is missing, where, how sure (docs/method.md).

    without  effects to leave out of the catalogue; most: most effects to accept; seed: of the resampling

    Returns a Diagnosis. Raises InputError, Interrupted (with what was finished as its result).
    """
    model, handles = _asked(trials, model)
    with _Line(progress) as line:
        interrupted, data, found = _plumbline.diagnose(model._handle, handles, window, list(without), most, seed,
                                                       line)
    result = Diagnosis(data, Model(found)) if data is not None else None
    if interrupted:
        raise Interrupted(result)
    return result


def simulate(model, trial=None, experiment=None, method="explicit_rk", tolerance=1e-8, closed_loop=False,
             progress=None):
    """Runs a trial's recorded commands, or an experiment file, on the model in one piece.

    method       explicit_rk, or for stiff models rosenbrock, implicit_rk or bdf
    tolerance    relative tolerance of the integrator
    closed_loop  let the trial's controllers command the motors, not the recording

    Returns a Simulation. Raises InputError, RuntimeError where the integrator fails, Interrupted.
    """
    if (trial is None) == (experiment is None):
        raise _plumbline.InputError("simulate: found neither or both, expected a trial or an experiment")
    with _Line(progress) as line:
        interrupted, facts, columns = _plumbline.simulate(
            model._handle, trial._handle if trial else None, os.fspath(experiment or ""), method, tolerance,
            closed_loop, line)
    if interrupted:
        raise Interrupted()
    return Simulation(facts, columns)
