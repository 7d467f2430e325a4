"""The page of results from answers made by hand: what counts, what stands first, and an HTML page that needs no other file."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

BENCHMARK = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "benchmark")
ALLOWED = [{"kind": k, "place": "hip"} for k in ("coulomb_friction", "spring")]


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        for case, group, hidden in (("case_001", "single", "coulomb_friction"), ("case_002", "single", "spring"), ("real_x", "real", "spring")):
            self.write(f"cases/{case}/case.json", {"id": case, "machine": "pendulum", "allowed": ALLOWED,
                                                   "recordings": [{"file": "test_1.csv", "role": "test"}],
                                                   "columns": {"q_hip": {"is": "joint position", "resolution": 0.1, "noise": 0.0}}})
            self.write(f"truths/{case}/truth.json", {"group": group, "strength": "weak" if group == "single" else "", "shows": 3.0,
                                                     "effects": [{"kind": hidden, "place": "hip", "values": {}}]})
            with open(os.path.join(self.root, f"truths/{case}/test_1.csv"), "w", encoding="utf-8") as file:
                file.write("t [s],q_hip [rad]\n0,1\n0.1,2\n")
            for entrant, says in (("mine", "coulomb_friction"), ("rival", hidden)):
                self.answer(entrant, case, says)

    def write(self, name, content):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(content, file)

    def answer(self, entrant, case, kind, ending="ended"):
        name = {"kind": kind, "place": "hip", "confidence": 0.8}
        self.write(f"answers/{entrant}/{case}/answer.json", {"verdict": "found", "found": [{"names": [name]}]})
        self.write(f"answers/{entrant}/{case}/run.json", {"processor_seconds": 1.0, "ending": ending})

    def pages(self, *options):
        out, page = (os.path.join(self.root, name) for name in ("page.md", "page.html"))
        done = subprocess.run([sys.executable, os.path.join(BENCHMARK, "table.py"), self.root, "--out", out, "--html", page, "--own", "mine", *options],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        texts = []
        for path in (out, page):
            with open(path, encoding="utf-8") as file:
                texts.append(file.read())
        return texts

    def test_a_better_rival_stands_first_and_real_machines_for_themselves(self):
        page, _ = self.pages()
        self.assertLess(page.index("Where a rival is better"), page.index("All simulated cases"))
        self.assertIn("| right at first place | all | rival 100% | 50% |", page)
        self.assertIn("the same 2 of 2 simulated cases", page)
        real = page[page.index("## Real machines"):page.index("## By kind")]
        self.assertIn("| mine | 0% |", real)
        self.assertIn("| rival | 100% |", real)

    def test_a_run_that_the_wall_clock_ended_does_not_count(self):
        self.answer("mine", "case_002", "spring", "wall clock limit")
        page, _ = self.pages()
        self.assertIn("the same 1 of 2 simulated cases", page)

    def test_an_entrant_that_was_run_on_fewer_cases_has_a_table_of_its_own(self):
        self.answer("slow", "case_002", "spring")
        page, _ = self.pages("--fewer", "slow")
        self.assertIn("the same 2 of 2 simulated cases", page)
        part = page[page.index("## The 1 simulated cases that slow was run on, too"):page.index("## Real machines")]
        self.assertIn("| slow | 100% |", part)
        self.assertIn("| mine | 0% |", part)  # of the one; of both it has one

    def test_html_stands_alone(self):
        _, page = self.pages()
        self.assertEqual(page.count("<svg"), 4)
        for outside in ("<script", "src=", "href=", "http"):
            self.assertNotIn(outside, page)
        bars = [xml.fromstring(part[:part.index("</svg>") + 6]) for part in ("<svg" + p for p in page.split("<svg")[1:])]
        # The first picture: half of the single cases right for mine, all for the rival.
        titles = {bar.find("title").text for bar in bars[0].iter("rect") if bar.find("title") is not None}
        self.assertEqual(titles, {"mine: 50%", "rival: 100%"})


if __name__ == "__main__":
    unittest.main()
