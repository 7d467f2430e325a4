"""What the module gives must be what the command line gives, and arrays must be arrays."""

import csv
import math
import os
import tempfile
import unittest

import numpy as np
import plumbline as pl

DEMO = "validation/trials/leg_bench_demo"
BENCH = "robots/mabel/leg_bench.yaml"
PENDULUM = "tests/robots/pendulum"


def demo_columns(trial):
    with open(f"{DEMO}/{trial}/data.csv", newline="") as file:
        rows = csv.reader(file)
        names = [name.split(" ")[0] for name in next(rows)]
        values = np.array([[float(cell) for cell in row] for row in rows])
    return dict(zip(names, values.T))


def demo_trial(model, **changes):
    data = demo_columns("siso_mLA")
    given = {
        "time": data["t"],
        "measured": {s: (data[f"q_{s}"], "rad") for s in ("mLA", "mLS", "thigh", "knee")},
        "commands": {"mLA": (data["u_mLA"], "N m")},
        "locked": {"mLS": (10.967649019531823, "rad")},
        "name": "siso",
    }
    return pl.Trial(model, **{**given, **changes})


class Models(unittest.TestCase):
    def test_a_model_says_what_it_is(self):
        model = pl.load_model(BENCH)
        self.assertEqual([m["name"] for m in model.motors], ["mLA", "mLS"])
        self.assertIn("viscous@mLA:damping", model.parameters)
        self.assertIn("<table>", model._repr_html_())
        self.assertIn("leg_angle", model.places["ratio"])

    def test_wrong_input_is_one_line(self):
        with self.assertRaises(pl.InputError) as caught:
            pl.load_model("no/such/model.yaml")
        self.assertIsInstance(caught.exception, ValueError)
        self.assertNotIn("\n", str(caught.exception))
        self.assertIn("no/such/model.yaml", str(caught.exception))

    def test_an_effect_is_added_and_written(self):
        model = pl.load_model(BENCH)
        more = model.with_effect("cable_stretch", "leg_angle", stiffness=3.5, damping=0.09)
        self.assertEqual(len(more.effects), len(model.effects) + 1)
        with tempfile.TemporaryDirectory() as folder:
            more.save(os.path.join(folder, "more.yaml"))
            again = pl.load_model(os.path.join(folder, "more.yaml"))
        self.assertEqual(again.effects[-1]["values"]["stiffness"]["value"], 3.5)
        with self.assertRaisesRegex(pl.InputError, "cable_stretch"):
            model.with_effect("cable_strech", "leg_angle")

    def test_the_catalogue(self):
        self.assertIn("coulomb", [e["name"] for e in pl.effects()])
        self.assertEqual(pl.effect("cable_stretch")["parameters"][0]["null_value"], math.inf)
        self.assertIn("<table>", pl.effects()._repr_html_())


class Trials(unittest.TestCase):
    def test_arrays_are_the_trial_that_the_files_are(self):
        model = pl.load_model(BENCH)
        made = demo_trial(model)
        read = pl.load_trial(f"{DEMO}/siso_mLA")
        np.testing.assert_array_equal(made.time, read.time)
        np.testing.assert_array_equal(made.measured["knee"], read.measured["knee"])
        np.testing.assert_array_equal(made.commands["mLA"], read.commands["mLA"])
        self.assertEqual(made.period, read.period)

    def test_units_are_converted(self):
        model = pl.load_model(BENCH)
        data = demo_columns("siso_mLA")
        degrees = demo_trial(model, measured={"knee": (np.degrees(data["q_knee"]), "deg")})
        np.testing.assert_allclose(degrees.measured["knee"], data["q_knee"], rtol=1e-14)

    def test_wrong_arrays_are_refused_in_one_line(self):
        model = pl.load_model(BENCH)
        t = demo_columns("siso_mLA")["t"]
        q = np.zeros_like(t)
        wrong = [
            ({"time": t[::-1]}, "time"),
            ({"measured": {"knee": (q[:-1], "rad")}}, "values"),
            ({"measured": {"kne": (q, "rad")}}, "knee"),
            ({"measured": {"knee": (q, "N m")}}, "N m"),
            ({"measured": {"knee": (np.full_like(t, np.nan), "rad")}}, "knee"),
            ({"measured": {}}, "no sensor"),
            ({"commands": {"mXX": (q, "N m")}}, "mXX"),
            ({"locked": {"nowhere": (0.0, "rad")}}, "nowhere"),
            ({"events": [99.0]}, "99"),
            ({"role": "test-data"}, "held-out"),
            ({"time": t[:5], "measured": {"knee": (q[:5], "rad")}, "commands": {}}, "5 samples"),
        ]
        for changes, words in wrong:
            with self.subTest(words), self.assertRaises(pl.InputError) as caught:
                demo_trial(model, **changes)
            self.assertIn(words, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))

    def test_a_trial_is_written_and_read(self):
        model = pl.load_model(BENCH)
        with tempfile.TemporaryDirectory() as folder:
            demo_trial(model).save(os.path.join(folder, "siso"))
            again = pl.load_trial(os.path.join(folder, "siso"))
        np.testing.assert_allclose(again.measured["knee"], demo_columns("siso_mLA")["q_knee"], rtol=1e-14)


class Work(unittest.TestCase):
    def test_arrays_and_files_give_one_comparison(self):
        model = pl.load_model(BENCH)
        held_out = pl.load_trial(f"{DEMO}/mimo")
        one = pl.compare([demo_trial(model, name="siso_mLA"), held_out], progress=False)
        other = pl.compare([pl.load_trial(f"{DEMO}/siso_mLA"), held_out], progress=False)
        self.assertEqual(one.train, other.train)
        self.assertEqual(one.held_out, other.held_out)
        self.assertGreater(one.train, 50.0)
        time, measured, predicted = one.curve("mimo", "knee")
        rms = math.sqrt(np.nanmean((measured - predicted) ** 2))
        stated = next(c["rms"] for c in one.channels if c["trial"] == "mimo" and c["name"] == "knee")
        self.assertAlmostEqual(rms, stated, delta=1e-3 * stated)
        self.assertEqual(len(time), len(predicted))
        self.assertIn("<table>", one._repr_html_())

    def test_the_horizon_is_measured_behind_the_windows(self):
        held_out = pl.load_trial(f"{DEMO}/mimo")
        true = held_out.model.with_effect("cable_stretch", "leg_angle", stiffness=3.5, damping=0.0889)
        wrong, right = (pl.compare(held_out, model=m, progress=False) for m in (held_out.model, true))

        def after(result, seconds):
            return next(h for h in result.horizons if h["channel"] == "knee" and h["horizon"] == seconds)
        self.assertEqual(after(wrong, 0.1)["unit"], "deg")
        self.assertGreater(after(wrong, 0.5)["rms"], 10.0 * after(right, 0.5)["rms"])
        self.assertGreater(after(wrong, 0.5)["windows"], 0)

    def test_a_fit_finds_what_was_hidden_and_its_model_carries_it(self):
        model = pl.load_model(f"{PENDULUM}/model.yaml")
        trial = pl.twin(model, f"{PENDULUM}/experiments/multisine.yaml",
                        hidden=["coulomb@drive:level=0.004"], seed=5)
        start = model.with_effect("coulomb", "drive", trial=trial)
        result = pl.fit(trial, "coulomb@drive:level", model=start, progress=False)
        value = result["coulomb@drive:level"]
        self.assertLessEqual(value["interval"][0], 0.004)
        self.assertGreaterEqual(value["interval"][1], 0.004)
        self.assertAlmostEqual(result.model.effects[-1]["values"]["level"]["value"], value["after"])
        with tempfile.TemporaryDirectory() as folder:
            result.model.save(os.path.join(folder, "fitted.yaml"))
            again = pl.load_model(os.path.join(folder, "fitted.yaml"))
        self.assertAlmostEqual(again.effects[-1]["values"]["level"]["value"], value["after"])
        with self.assertRaises(KeyError):
            result["no such parameter"]

    def test_a_simulation_has_columns(self):
        model = pl.load_model(f"{PENDULUM}/model.yaml")
        motion = pl.simulate(model, experiment=f"{PENDULUM}/experiments/steps.yaml", progress=False)
        self.assertEqual(motion["q_shoulder"].shape, motion.time.shape)
        self.assertEqual(motion.units["q_shoulder"], "rad")
        with self.assertRaises(pl.InputError):
            pl.simulate(model)
        with self.assertRaisesRegex(pl.InputError, "rosenbrock"):
            pl.simulate(model, experiment=f"{PENDULUM}/experiments/steps.yaml", method="rosenbrok")

    def test_progress_is_reported_and_its_errors_come_through(self):
        trials = [pl.load_trial(f"{DEMO}/{name}") for name in ("siso_mLA", "siso_mLS", "mimo")]

        def stop_here(what, fraction):
            self.assertIsInstance(what, str)
            raise RuntimeError("from the progress function")
        with self.assertRaisesRegex(RuntimeError, "from the progress function"):
            pl.diagnose(trials, progress=stop_here)

    def test_the_roles_are_kept_apart(self):
        trial = pl.load_trial(f"{DEMO}/siso_mLA")
        same = demo_trial(trial.model, role="held-out")
        with self.assertRaisesRegex(pl.InputError, "held out"):
            pl.compare([trial, same])


if __name__ == "__main__":
    unittest.main()
