"""Hold a robot's model against its measurements and learn which physical effect is missing.

    import plumbline as pl

    model = pl.load_model("robots/mabel/leg_bench.yaml")
    trial = pl.Trial(model, time=t, measured={"mLA": (q, "rad")}, commands={"mLA": (u, "N m")})
    answer = pl.diagnose([trial, other], model=model)

Arrays are numpy arrays. What goes in carries its unit; what comes out is SI and rad unless a unit stands
beside it. Wrong input raises InputError (a ValueError) with one line that says what was found and what was
expected. Ctrl-C ends long work cleanly and raises Interrupted (a KeyboardInterrupt); that of a diagnosis has
what was finished as its `result`.
"""

from plumbline._model import Model, effect, effects, load_model
from plumbline._plumbline import InputError, version as __version__
from plumbline._results import Comparison, Diagnosis, Fit, Simulation
from plumbline._trial import Trial, load_trial, twin
from plumbline._work import Interrupted, compare, diagnose, fit, simulate

__all__ = [
    "Comparison", "Diagnosis", "Fit", "InputError", "Interrupted", "Model", "Simulation", "Trial",
    "__version__", "compare", "diagnose", "effect", "effects", "fit", "load_model", "load_trial", "simulate",
    "twin",
]
