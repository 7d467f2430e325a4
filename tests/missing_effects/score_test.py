"""The score against answers made by hand; every expected number is worked out in the test."""

import json
import math
import os
import tempfile
import unittest

import score

FRICTION, SPRING, LAG = (("coulomb_friction", "hip"), ("spring", "hip"), ("actuator_lag", "hip"))
FLOOR = math.hypot(0.003 / math.sqrt(12.0), 0.0005)
CASE = {"id": "c", "machine": "pendulum", "allowed": [{"kind": k, "place": p} for k, p in (FRICTION, SPRING, LAG)],
        "columns": {"u_hip": {"is": "command"}, "q_hip": {"is": "joint position", "resolution": 0.003, "noise": 0.0005}},
        "recordings": [{"file": "train_1.csv", "role": "train"}, {"file": "test_1.csv", "role": "test"}]}


def name(pair, confidence, **values):
    return {"kind": pair[0], "place": pair[1], "confidence": confidence, "values": values}


def answer(verdict, *slots, **more):
    return {"verdict": verdict, "found": [{"names": list(slot)} for slot in slots], **more}


def truth(group, *pairs):
    return {"group": group, "strength": "", "effects": [{"kind": k, "place": p, "values": {"level": 2.0}} for k, p in pairs]}


def names(given, hidden):
    group = hidden["group"]
    return score.names_score(given, score.true_names(hidden, CASE), group)


class Names(unittest.TestCase):
    def test_first_and_group(self):
        given = answer("found", [name(SPRING, 0.5), name(FRICTION, 0.4)])
        self.assertEqual(names(given, truth("single", SPRING)), {"first": True, "group": True, "invented": 0, "lead": True})
        self.assertEqual(names(given, truth("single", FRICTION)), {"first": False, "group": True, "invented": 0, "lead": False})
        self.assertEqual(names(given, truth("single", LAG)), {"first": False, "group": False, "invented": 1, "lead": False})

    def test_only_three_names_of_a_slot_count(self):
        given = answer("found", [name(SPRING, 0.5), name(("x", "y"), 0.1), name(("x", "z"), 0.1), name(FRICTION, 0.1)])
        self.assertFalse(names(given, truth("single", FRICTION))["group"])

    def test_pairs_need_both(self):
        one, both = answer("found", [name(SPRING, 0.9)]), answer("found", [name(LAG, 0.9)], [name(SPRING, 0.9)])
        hidden = truth("pair", SPRING, LAG)
        self.assertFalse(names(one, hidden)["first"])
        self.assertTrue(names(both, hidden)["first"])
        self.assertEqual(names(both, truth("single", LAG))["invented"], 1)

    def test_nothing_and_outside(self):
        for verdict, group in (("nothing", "nothing"), ("outside", "outside")):
            self.assertTrue(names(answer(verdict), truth(group))["first"])
            wrong = names(answer("found", [name(LAG, 0.9)]), truth(group))
            self.assertEqual((wrong["first"], wrong["invented"]), (False, 1))
        self.assertFalse(names(answer("nothing"), truth("outside"))["first"])

    def test_a_lead_is_no_name(self):
        given = names(answer("outside", [name(LAG, 0.4)]), truth("single", LAG))
        self.assertEqual(given, {"first": False, "group": False, "invented": 0, "lead": True})

    def test_what_says_the_same_is_right_too(self):
        hidden = truth("real", FRICTION)
        hidden["also_right"] = [truth("", SPRING, LAG)["effects"]]
        for given, met in ((answer("found", [name(SPRING, 0.9)], [name(LAG, 0.9)]), {SPRING, LAG}),
                           (answer("found", [name(FRICTION, 0.9)]), {FRICTION}), (answer("found", [name(SPRING, 0.9)]), {SPRING, LAG})):
            self.assertEqual(score.nearest_truth(given, hidden, CASE), met)
        self.assertEqual(names(answer("found", [name(SPRING, 0.9)]), hidden)["first"], False)

    def test_two_levels_of_friction_are_a_level_and_a_force(self):
        both = {("coulomb_friction", "hip"), ("constant_force", "hip")}
        one = {("asymmetric_friction", "hip")}
        self.assertEqual(score.two_levels(both | {LAG}), one | {LAG})
        self.assertEqual(score.two_levels(one | {LAG}), both | {LAG})
        self.assertEqual(score.two_levels({FRICTION, ("constant_force", "knee")}), {FRICTION, ("constant_force", "knee")})

    def test_effects_outside_the_list_have_no_name(self):
        self.assertEqual(score.true_names(truth("outside", ("latch", "hip")), CASE), set())


class Confidences(unittest.TestCase):
    def test_log_score(self):
        given = answer("found", [name(SPRING, 0.8)], others=[name(LAG, 0.3)], otherwise=0.1)
        expected = -(math.log(0.8) + math.log(1.0 - 0.3) + math.log(1.0 - 0.1))
        self.assertAlmostEqual(score.log_score(score.confidences(given, CASE), {SPRING}), expected)

    def test_certainty_is_cut(self):
        given = score.confidences(answer("found", [name(SPRING, 1.0)], otherwise=0.0), CASE)
        self.assertAlmostEqual(score.log_score(given, {LAG}), -2.0 * math.log(0.001) - math.log(0.999))

    def test_reliability(self):
        rows = [{"stated": [[0.8, True], [0.75, False], [0.05, False]]}, {"stated": [[0.85, True]]}]
        low, high = score.reliability(rows)
        self.assertEqual((low["count"], low["true"]), (1, 0.0))
        self.assertEqual(high["count"], 3)
        self.assertAlmostEqual(high["stated"], 0.8)
        self.assertAlmostEqual(high["true"], 2.0 / 3.0)


class WholeCase(unittest.TestCase):
    """One case in folders: predictions, intervals, a missing answer."""

    def setUp(self):
        self.root = tempfile.TemporaryDirectory()
        self.addCleanup(self.root.cleanup)
        for folder, files in (("cases/c", {"case.json": CASE}), ("truths/c", {"truth.json": truth("single", FRICTION)})):
            os.makedirs(self.path(folder))
            for file, content in files.items():
                self.write(folder + "/" + file, json.dumps(content))
        self.write("truths/c/test_1.csv", "t [s],q_hip [rad]\n0,1\n0.1,2\n")

    def path(self, name):
        return os.path.join(self.root.name, name)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def row(self):
        return score.score(self.path("answers"), self.path("cases"), self.path("truths"))[0]

    def test_no_answer(self):
        row = self.row()
        self.assertFalse(row["answered"] or row["first"])
        self.assertEqual(row["prediction"], 1.0e4)
        self.assertAlmostEqual(row["log_score"], -math.log(0.01) - 2.0 * math.log(0.99))

    def test_prediction_in_floors(self):
        self.write("answers/c/test_1.csv", f"t [s],q_hip [rad]\n0,{1 + 3 * FLOOR}\n0.1,{2 - 4 * FLOOR}\n")
        self.assertAlmostEqual(self.row()["prediction"], math.sqrt((9.0 + 16.0) / 2.0), places=6)
        judged = json.loads(json.dumps(CASE))
        judged["columns"]["q_hip"]["judged_in"] = 0.5
        self.write("cases/c/case.json", json.dumps(judged))
        self.assertAlmostEqual(self.row()["prediction"], FLOOR / 0.5 * math.sqrt((9.0 + 16.0) / 2.0), places=6)
        self.write("answers/c/test_1.csv", "t [s],q_hip [rad]\n0,1\n0.1,nan\n")
        self.assertEqual(self.row()["prediction"], 1.0e4)

    def test_intervals_of_right_first_names(self):
        slots = ([name(FRICTION, 0.9, level={"value": 2.1, "interval": [1.9, 2.3]})],
                 [name(SPRING, 0.9, level={"value": 2.1, "interval": [1.9, 2.3]})])
        self.write("answers/c/answer.json", json.dumps(answer("found", *slots)))
        self.write("answers/c/run.json", json.dumps({"processor_seconds": 7.5}))
        row = self.row()
        self.assertEqual((row["held"], row["intervals"], row["seconds"]), (1, 1, 7.5))
        summary = score.summary([row])
        self.assertEqual((summary["coverage"], summary["first"], summary["invented"]), (1.0, 1.0, 1.0))


if __name__ == "__main__":
    unittest.main()
