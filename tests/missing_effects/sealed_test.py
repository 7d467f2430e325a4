"""A sealed set of a toy secret: made, held against its hashes, and refused where secret, truth or generator is another."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

BENCHMARK = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "benchmark")
SECRET = "00112233445566778899aabbccddeeff"  # a toy: the secret of the sealed cases is in no file of the repository


def make(*arguments):
    return subprocess.run([sys.executable, os.path.join(BENCHMARK, "make_cases.py"), *arguments], capture_output=True, text=True)


class Sealed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = folder.name
        cls.hashes = cls.path("hashes.json")
        with open(cls.path("secret"), "w", encoding="utf-8") as file:
            file.write(SECRET + "\n")
        cls.made = make("--out", cls.path("made"), "--secret-file", cls.path("secret"), "--only", "cube", "--count", "16",
                        "--prefix", "sealed_", "--hashes", cls.hashes)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.root, name)

    def test_nothing_is_said_of_what_is_hidden(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        self.assertTrue(all(re.fullmatch("sealed_[0-9]{3} sealed", line) for line in self.made.stdout.splitlines()))
        with open(self.hashes, encoding="utf-8") as file:
            text = file.read()
        self.assertNotIn(SECRET, text)

    def test_the_secret_alone_brings_the_truths_back(self):
        done = make("--reveal", SECRET, "--out", self.path("revealed"), "--hashes", self.hashes)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for case in os.listdir(self.path("made/truths")):
            with open(self.path(f"made/truths/{case}/truth.json"), "rb") as one, open(self.path(f"revealed/truths/{case}/truth.json"), "rb") as other:
                truth = one.read()
                self.assertEqual(truth, other.read())
            # As sealed/README.md says, without this program.
            salt = re.search(f"{case} has its hash; salt ([0-9a-f]{{64}})", done.stdout).group(1)
            summed = subprocess.run(["sha256sum"], input=salt.encode() + truth, capture_output=True).stdout.decode().split()[0]
            with open(self.hashes, encoding="utf-8") as file:
                self.assertEqual(summed, json.load(file)["hashes"][case])

    def test_another_secret_is_found_out(self):
        other = "f" + SECRET[1:]
        with open(self.path("other"), "w", encoding="utf-8") as file:
            file.write(other)
        with open(self.hashes, encoding="utf-8") as file:
            sealed = json.load(file)
        # Its own order has other cubes; one with the same number is what the hash is held against.
        sealed["made"].update(count=1, only="")
        sealed["hashes"] = {"sealed_001": "0" * 64}
        with open(self.path("one.json"), "w", encoding="utf-8") as file:
            json.dump(sealed, file)
        done = make("--reveal", other, "--out", self.path("wrong"), "--hashes", self.path("one.json"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("DOES NOT HAVE", done.stdout)

    def test_what_is_no_secret_is_refused(self):
        done = make("--reveal", "0123", "--hashes", self.hashes)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("expected 32 hexadecimal digits", done.stderr)


if __name__ == "__main__":
    unittest.main()
