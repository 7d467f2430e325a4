"""Ctrl-C ends a diagnosis within a moment and keeps what was finished."""

import os
import signal
import threading
import time
import unittest

import plumbline as pl

DEMO = "validation/trials/leg_bench_demo"


class Interrupt(unittest.TestCase):
    def test_ctrl_c_ends_a_diagnosis(self):
        trials = [pl.load_trial(f"{DEMO}/{name}") for name in ("siso_mLA", "siso_mLS", "mimo")]
        timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
        begin = time.monotonic()
        timer.start()
        with self.assertRaises(pl.Interrupted) as caught:
            pl.diagnose(trials, progress=False)
        self.assertLess(time.monotonic() - begin, 60.0)
        self.assertIsInstance(caught.exception, KeyboardInterrupt)
        result = caught.exception.result
        self.assertTrue(result is None or result.interrupted)


if __name__ == "__main__":
    unittest.main()
