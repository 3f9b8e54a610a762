"""Tests of scripts/bench. With a test's name as argument only that one is run."""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(PROJECT / "scripts"))
from benching import device_model  # noqa: E402


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

    def test_several_gpus_are_modelled_from_what_ranks_told_each_other(self):
        done = subprocess.run([sys.executable, PROJECT / "scripts" / "bench", "--ranks"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertIn("Model", lines[0])
        shares = [[int(word[:-1]) for word in line.split() if word.endswith("%")] for line in lines[2:]]
        self.assertEqual(len(shares), 6)
        for eight, sixty_four in shares:  # in per cent of what as many times the speed would be
            self.assertTrue(0 < sixty_four < eight < 100, lines)

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


def bench(*arguments):
    return subprocess.run([sys.executable, PROJECT / "scripts" / "bench", *arguments], capture_output=True, text=True)


class Model(unittest.TestCase):
    def test_it_says_that_it_is_a_model_and_predicts_for_each_gpu(self):
        done = bench("--model")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.startswith("Model, not measured"))
        table = [line for line in done.stdout.splitlines() if line.startswith("|")]
        self.assertEqual(len(table), 2 + len(device_model.SIZES))
        for gpu in device_model.GPUS:
            self.assertIn(gpu, table[0])

    def test_a_launch_takes_its_slowest_part_and_a_wait_is_added(self):
        kernel = {"launches": 2, "warp_instructions": 0, "fp64": 0, "sectors": 0, "memory_sectors": 1000}
        counts = {"fluid": 100, "waits_per_step": 1, "graph_kernels_per_step": 0, "graph_recordings_per_step": 0, "kernels": [kernel]}
        memory = 1000 * 1000 * 32 / 900e9 / device_model.ATTAINED
        self.assertAlmostEqual(device_model.step_time("V100", 100000, counts), device_model.WAIT + memory)
        smallest = device_model.WAIT + 2 * device_model.LAUNCH
        self.assertAlmostEqual(device_model.step_time("V100", 100, counts), smallest)
        in_graph = device_model.WAIT + device_model.NODE + device_model.LAUNCH
        counts["graph_kernels_per_step"] = 1
        self.assertAlmostEqual(device_model.step_time("V100", 100, counts), in_graph)
        counts["graph_recordings_per_step"] = 0.5
        self.assertAlmostEqual(device_model.step_time("V100", 100, counts), in_graph + 0.5 * device_model.RECORDING)

    def test_measured_stands_beside_predicted(self):
        counts = device_model.read_counts()
        lines = device_model.compare_measured("NVIDIA A100-SXM4-40GB", {
            "step/spacing_um:1000/threads:1": {"seconds": [0.003, 0.002, 0.004], "particles": [100000]}}, counts)
        self.assertEqual(lines[1].split()[:2], ["100000", "3.000"])
        self.assertAlmostEqual(float(lines[1].split()[2]), 1e3 * device_model.step_time("A100", 100000, counts), 2)
        self.assertIn("no model of", device_model.compare_measured("NVIDIA T4", {}, counts)[0])

    def test_without_a_gpu_device_says_so(self):
        if shutil.which("nvidia-smi"):
            self.skipTest("there may be a GPU")
        done = bench("--device")
        self.assertEqual(done.returncode, 1)
        self.assertIn("nvidia-smi finds none", done.stderr)

    def test_profile_is_added_up_by_kernel(self):
        part = """
kernel _Zk
  launches 2  threads 64  instructions 640  fp32 ops 6  fp64 ops 7  host seconds 0.1
  global loads  9999 bytes, 30 warp requests, 300 sectors (67.0% of the sector bytes requested)
  global stores 64 bytes, 2 warp requests, 4 sectors (100.0%)
  warp instructions 20, 32.0 of 32 lanes active on average
        200 sectors, 17.61 per request,  66.0%  ld.global.v4.f32 {%f1, %f2, %f3, %f4}, [%rd1]  [a.hpp:1]
"""
        # Of 200 gathered sectors two arrays of 64 times 16 bytes come from memory.
        self.assertEqual(device_model.parse_profile(part + part)["_Zk"], [4, 128, 40, 14, 608, 336])
        # The density gathers the acceleration by pressure, too: 16 B a thread more.
        density = part.replace("_Zk", "_ZDensityAndShearE")
        self.assertEqual(device_model.parse_profile(density)["_ZDensityAndShearE"], [2, 64, 20, 7, 304, 200])


LOADER = """#!/bin/bash
# In place of the loader: --library-path PATH PROGRAM ARGUMENT...
shift 2
for word; do
  case $word in
    --benchmark_out=*) echo '{"benchmarks": [{"run_type": "iteration", "particles": 100000, "real_time": 2.5,
      "device_bytes_per_particle": 1500, "ms density": 0.75, "ms advance": 0.25}]}' >"${word#*=}" ;;
  esac
done
case ${1##*/} in
  agreement) exit "${AGREEMENT:-0}" ;;
  test_core) sleep "${TESTS_TAKE:-0}" ;;
esac
"""


class Pack(unittest.TestCase):
    """What measure.sh does with programs in place of the real ones."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "lib").mkdir()
        loader = self.folder / "lib" / "ld-linux-x86-64.so.2"
        loader.write_text(LOADER)
        loader.chmod(0o755)
        shutil.copy(PROJECT / "scripts" / "benching" / "measure.sh", self.folder)

    def measure(self, *arguments, **environment):
        done = subprocess.run([self.folder / "measure.sh", *arguments], capture_output=True, text=True,
                              env={"PATH": "/usr/bin:/bin", **environment}, timeout=60)
        return done, json.loads((self.folder / "results" / "parts.json").read_text())

    def test_each_part_leaves_its_file_and_measured_stands_beside_the_model(self):
        done, parts = self.measure()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({part["status"] for part in parts}, {0})
        self.assertIn("agreement_compare", [part["part"] for part in parts])
        said = bench("--read", self.folder / "results")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("100000        2.500       none          4e+07     1500", said.stdout)
        self.assertIn("density 0.750, advance 0.250", said.stdout)
        (self.folder / "results" / "device.csv").write_text("name\nNVIDIA H200, 143771 MiB\n")
        predicted = 1e3 * device_model.step_time("H200", 100000, device_model.read_counts())
        self.assertIn(f"2.500 {predicted:>10.3f}", bench("--read", self.folder / "results").stdout)

    def test_a_part_that_fails_leaves_the_others_alone(self):
        done, parts = self.measure(AGREEMENT="3")
        self.assertEqual(done.returncode, 1)
        self.assertEqual([part["status"] for part in parts if part["status"] != 0], [3, 3])

    def test_it_ends_in_time_whatever_hangs(self):
        done, parts = self.measure("--seconds", "7", TESTS_TAKE="1000")
        self.assertEqual(done.returncode, 1)
        self.assertEqual([part["status"] for part in parts if part["status"] != 0],
                         [124, "no time was left", "no time was left"])
        self.assertLess(sum(part["seconds"] for part in parts), 15)

    def test_a_folder_without_results_or_one_that_is_there_is_an_error(self):
        done = bench("--read", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("has no parts.json", done.stderr)
        done = bench("--device", "--pack", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("is there already", done.stderr)
        self.assertIn("--pack goes with --device", bench("--pack", self.folder).stderr)


if __name__ == "__main__":
    unittest.main()
