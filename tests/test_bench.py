"""Tests of scripts/bench. With a test's name as argument only that one is run."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent


def compare(before, after):
    """`before` and `after`: the seconds of each repetition, by benchmark."""
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for name, times in (("before", before), ("after", after)):
            paths.append(Path(folder) / f"{name}.json")
            records = {benchmark: {"seconds": seconds} for benchmark, seconds in times.items()}
            paths[-1].write_text(json.dumps({"benchmarks": records}))
        return subprocess.run([sys.executable, PROJECT / "scripts" / "bench", "--compare", *paths],
                              capture_output=True, text=True)


class Bench(unittest.TestCase):
    def test_comparison_prints_ratio_and_spread(self):
        done = compare({"density": [0.009, 0.010, 0.011], "gone": [1]}, {"density": [0.005], "new": [1]})
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertEqual(lines[0].split(), ["benchmark", "before", "ms", "after", "ms", "ratio", "spread"])
        self.assertEqual(lines[1].split(), ["density", "10.000", "5.000", "2.00", "10%"])

    def test_results_without_anything_in_common_are_an_error(self):
        done = compare({"density": [1]}, {"viscous": [1]})
        self.assertEqual(done.returncode, 1)
        self.assertIn("have no benchmark in common", done.stderr)

    def test_a_file_that_is_missing_or_no_result_is_an_error_that_names_it(self):
        with tempfile.TemporaryDirectory() as folder:
            bad = Path(folder) / "bad.json"
            for content in (None, "no JSON", "{}", '{"benchmarks": {"density": {"seconds": []}}}'):
                if content is not None:
                    bad.write_text(content)
                done = subprocess.run([sys.executable, PROJECT / "scripts" / "bench", "--compare", bad, bad],
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 1)
                self.assertIn("bad.json", done.stderr)
                self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
