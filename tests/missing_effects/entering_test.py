"""A case is made, the example of benchmark/ENTERING.md and two entrants run on it, and their answers are scored."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

import score

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BENCHMARK = os.path.join(ROOT, "benchmark")


def run(*command):
    subprocess.run([sys.executable, *command], check=True, stdout=subprocess.DEVNULL)


def example():
    with open(os.path.join(BENCHMARK, "ENTERING.md"), encoding="utf-8") as file:
        return re.search(r"^```python\n(.*?)^```", file.read(), re.M | re.S).group(1)


class Entering(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.root = cls.folder.name
        with open(os.path.join(cls.root, "run.py"), "w", encoding="utf-8") as file:
            file.write(example())
        # The first of the pendulum's cases that the seed draws.
        run(os.path.join(BENCHMARK, "make_cases.py"), "--out", cls.root, "--seed", "3", "--only", "pendulum", "--count", "3")
        cls.cases = sorted(os.listdir(os.path.join(cls.root, "cases")))[:1]

    def score(self, entrant):
        """An entrant's row after its run, with the time limit of the benchmark."""
        run(os.path.join(BENCHMARK, "run_entrants.py"), os.path.join(self.root, "cases"), os.path.join(self.root, "answers"),
            "--entrant", entrant, "--match", self.cases[0])
        name = os.path.basename(entrant)
        rows = score.score(os.path.join(self.root, "answers", name), os.path.join(self.root, "cases"),
                           os.path.join(self.root, "truths"), self.cases)
        self.assertEqual(len(rows), 1)
        self.assertTrue(rows[0]["answered"])
        return rows[0]

    def test_cases_say_nothing_of_the_truth(self):
        case = os.path.join(self.root, "cases", self.cases[0])
        self.assertNotIn("truth.json", os.listdir(case))
        with open(os.path.join(case, "test_1.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip(), "t [s],u_shoulder [N m]")
        for file in os.listdir(case):
            self.assertLess(os.path.getsize(os.path.join(case, file)), 200_000)

    def test_the_example_runs(self):
        self.assertLessEqual(example().count("\n"), 45)
        folder = os.path.join(self.root, "example")
        os.makedirs(folder)
        os.replace(os.path.join(self.root, "run.py"), os.path.join(folder, "run.py"))
        self.assertLess(self.score(folder)["prediction"], score.WORST)

    def test_least_squares_predict_better_than_rest(self):
        rest = self.score(os.path.join(BENCHMARK, "entrants", "says_nothing"))
        fitted = self.score(os.path.join(BENCHMARK, "entrants", "least_squares"))
        self.assertLess(fitted["prediction"], 0.1 * rest["prediction"])


if __name__ == "__main__":
    unittest.main()
