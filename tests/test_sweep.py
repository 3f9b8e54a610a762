"""Tests of scripts/sweep and of the charts of scripts/figures. With a test's name as argument only that one is run."""

import csv
import json
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "scripts"))
from sweeping import gather, plan  # noqa: E402

SWEEP = """
[sweep]
case = "base.toml"
[set]
output.end_time = 0.5
[[axis]]
name = "oil"
points = [{name = "A", set = {fluid.oil.viscosity = 0.05}}, {name = "B", set = {"fluid.oil.viscosity" = 0.3}}]
[[axis]]
key = "fluid.oil.fraction"
values = [0.0, 0.5]
[[when]]
match = {oil = "B", fraction = 0.5}
set = {fluid.oil.stress = [[0.4, 0], [0.5, 3]]}
[[exclude]]
oil = "A"
fraction = 0.5
"""

# A program that stands for slagflow: refuses a fraction of 0.9, fails for oil B, else leaves what a run leaves.
PROGRAM = """#!/usr/bin/python3
import json, pathlib, sys
if sys.argv[1] == "check":
    sys.exit("error: base.toml: value 0.9 is out of range" * ("--set=fluid.oil.fraction=0.9" in sys.argv) or 0)
folder = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
with open(folder.parent.parent.parent / "calls", "a") as calls:
    calls.write(" ".join(sys.argv[1:]) + "\\n")
if "--set=fluid.oil.viscosity=0.3" in sys.argv:
    sys.exit("error: too thick")
folder.mkdir(parents=True, exist_ok=True)
(folder / "case.toml").write_text("[fluid.oil]\\ndensity = 900.0\\n")
(folder / "summary.json").write_text(json.dumps({"status": "done", "steps": 7, "measures": {"jet": {"tan_theta": 0.25}}}))
"""


class Sweep(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
        self.file = self.folder / "fall.toml"
        self.file.write_text(SWEEP)
        (self.folder / "base.toml").write_text("[case]\n")

    def error(self, old, new):
        self.file.write_text(SWEEP.replace(old, new))
        with self.assertRaises(plan.SweepError) as caught:
            plan.read_sweep(self.file)
        return str(caught.exception)

    def test_points_are_the_combinations_of_the_axes(self):
        sweep = plan.read_sweep(self.file, ["resolution.spacing=2e-3", "case.name=x y"])
        self.assertEqual(sweep.name, "fall")
        self.assertEqual([p.name for p in sweep.points],
                         ["oil=A_fraction=0", "oil=B_fraction=0", "oil=B_fraction=0.5"])
        last = sweep.points[2]
        self.assertEqual(last.axes, {"oil": "B", "fraction": 0.5})
        self.assertEqual(last.overrides, {"output.end_time": 0.5, "fluid.oil.viscosity": 0.3, "fluid.oil.fraction": 0.5,
                                          "fluid.oil.stress": [[0.4, 0], [0.5, 3]], "resolution.spacing": 0.002,
                                          "case.name": "x y"})

    def test_mistakes_are_named(self):
        self.assertIn("key 'sweep.kase': unknown", self.error("case =", "kase ="))
        self.assertIn("is not there", self.error("base.toml", "none.toml"))
        self.assertIn("allowed: either", self.error("values = [0.0, 0.5]", ""))
        self.assertIn("each once", self.error("[0.0, 0.5]", "[0.5, 0.5]"))
        self.assertIn("key 'when.match.fraction': value 0.7: allowed: 0.0, 0.5", self.error("fraction = 0.5}", "fraction = 0.7}"))
        self.assertIn("key 'exclude.water': unknown: allowed: oil, fraction", self.error('oil = "A"\nfraction', 'water = "A"\nfraction'))
        self.assertIn("fall.toml", self.error("[sweep]", "[sweep"))
        for wrong in ("0.5", '"0.5"', "{low = 0.5}"):
            self.assertIn("key 'axis.1.values': value", self.error("[0.0, 0.5]", wrong))
        self.assertIn("allowed: finite numbers, texts", self.error("[0.0, 0.5]", "[2020-01-01]"))
        self.assertIn("allowed: finite numbers", self.error("0.0, 0.5]", "nan]"))
        self.assertIn("`points`, each with a name", self.error("[0.0, 0.5]", '["a/b"]'))
        self.assertIn("values none: allowed: at least one", self.error("[0.0, 0.5]", "[]"))
        self.assertIn("axes 'oil' and 'viscosity' both set", self.error('"fluid.oil.fraction"', '"fluid.oil.viscosity"'))
        self.assertIn("key 'sweep.threads': value True", self.error("[set]", "threads = true\n[set]"))
        self.assertIn("key 'sweep.case': value 3: allowed: a case file", self.error('"base.toml"', "3"))
        self.assertIn("key 'axis.1.key': value 3: allowed: a dotted key", self.error('"fluid.oil.fraction"', "3"))
        self.assertIn("key 'exclude': value", self.error("[[exclude]]", "[exclude]"))
        self.assertIn("a decimal point, not a comma: write 0.9", self.error("[0.0, 0.5]", "[0,9; 1,8]"))
        self.assertIn("a decimal point, not a comma: write 0.5", self.error("end_time = 0.5", "end_time = 0,5"))
        self.assertIn("straight quotes", self.error('"B", set', "\u201cB\u201d, set"))
        self.assertIn("a minus sign from the keyboard", self.error("[0.0, 0.5]", "[\u22121.0, 0.5]"))
        for path in (r'"C:\Users\base.toml"', r'"..\rinne.toml"'):
            self.assertIn("write / in paths, or single quotes", self.error('"base.toml"', path))
        self.file.write_bytes(b"\xff" + SWEEP.encode())
        with self.assertRaisesRegex(plan.SweepError, "fall.toml: not UTF-8"):
            plan.read_sweep(self.file)

    def test_gathers_measures_and_failures(self):
        self.file.write_text(SWEEP)
        for name, status in (("p1", "done"), ("p2", "failed")):
            point = self.folder / "points" / name
            (point / "run").mkdir(parents=True)
            (point / "result.json").write_text(json.dumps({"axes": {"oil": name}, "status": status, "reason": "x" * (status == "failed")}))
        run = self.folder / "points/p1/run"
        (run / "summary.json").write_text(json.dumps({"steps": 7, "measures": {"jet": {"class": "free-jet", "tan_theta": None, "torque": [1, 2, 3.5]}}}))
        (run / "case.toml").write_text("[fluid.oil]\ndensity = 900.0\n")
        gather.gather({"points": {name: {"axes": {"oil": name}} for name in ("p1", "p2", "p3")}}, self.folder)
        with open(self.folder / "results.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(lines[0]["fluid.oil.density"], "900.0")
        self.assertEqual((lines[0]["jet.class"], lines[0]["jet.tan_theta"]), ("free-jet", ""))
        self.assertEqual((lines[0]["jet.torque.x"], lines[0]["jet.torque.z"]), ("1", "3.5"))
        self.assertEqual(lines[2]["oil"], "p3")
        self.assertEqual((lines[1]["status"], lines[1]["reason"]), ("failed", "x"))
        self.assertEqual(lines[2]["status"], "missing")

    def sweep(self, *arguments, where=None):
        self.program = self.folder / "slagflow"
        self.program.write_text(PROGRAM)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)
        return subprocess.run([PROJECT / "scripts/sweep", self.file, "--program", self.program, "--cores", "2", *arguments],
                              capture_output=True, text=True, cwd=where)

    def run_sweep(self, *arguments):
        return self.sweep("--output", self.folder / "out", *arguments)

    def calls(self):
        return (self.folder / "out/calls").read_text().splitlines()

    def run_each_point_once(self, *engine):
        done = self.run_sweep(*engine)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("1 of 3 points done", done.stdout)
        self.assertIn("failed: oil=B_fraction=0: error: too thick", done.stderr)
        self.assertEqual(len(self.calls()), 3)
        self.assertTrue(all("--set=output.end_time=0.5" in call for call in self.calls()))
        with open(self.folder / "out/results.csv", newline="") as file:
            self.assertEqual([line["jet.tan_theta"] for line in csv.DictReader(file)], ["0.25", "", ""])
        self.run_sweep(*engine)
        self.assertEqual(len(self.calls()), 3)  # nothing is run again
        self.assertEqual(self.run_sweep("--retry", *engine).returncode, 1)
        self.assertEqual(len(self.calls()), 5)  # but for the failed ones when asked for
        self.run_sweep("--set", "output.end_time=0.7", *engine)
        self.assertEqual(len(self.calls()), 8)  # another sweep of the same name

    def test_runs_each_point_once_and_outlives_failures(self):
        self.run_each_point_once()

    def test_runs_each_point_once_through_snakemake(self):
        if not (PROJECT / ".venv/bin/snakemake").is_file():
            self.skipTest("no Snakemake; scripts/install --sweep brings it")
        self.run_each_point_once("--", "--latency-wait", "5")

    def test_prints_a_table_of_results(self):
        lines = self.run_sweep().stdout.splitlines()
        head = next(k for k, line in enumerate(lines) if "status" in line)
        self.assertEqual([line.split() for line in lines[head:head + 4]],
                         [["oil", "fraction", "status", "jet.tan_theta"], ["A", "0", "done", "0.25"], ["B", "0", "failed", "-"],
                          ["B", "0.5", "failed", "-"]])

    def test_results_go_to_the_folder_it_is_started_in(self):
        self.file.write_text(SWEEP.replace("viscosity\" = 0.3", "viscosity\" = 0.2"))
        done = self.sweep(where=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"results go to {(self.folder / 'runs/sweeps/fall').resolve()}", done.stdout)
        self.assertTrue((self.folder / "runs/sweeps/fall/results.csv").is_file())

    def test_points_are_validated_before_any_runs(self):
        self.file.write_text(SWEEP.replace("[0.0, 0.5]", "[0.0, 0.5, 0.9]"))
        for arguments in (["--list"], ["--output", self.folder / "out"]):
            done = self.sweep(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn("2 of 5 points are not valid:\npoint oil=A_fraction=0.9: base.toml: value 0.9", done.stderr)
        self.assertFalse((self.folder / "out").exists())
        self.file.write_text(SWEEP)
        self.assertIn("3 points, all valid", self.sweep("--list").stdout)

    def test_installs_nothing_unasked(self):
        if (PROJECT / ".venv/bin/snakemake").is_file():
            self.skipTest("Snakemake is there")
        done = self.run_sweep("--", "--jobs", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--install puts it there", done.stderr)
        self.assertFalse((PROJECT / ".venv/bin/snakemake").exists())

    def test_bad_arguments_are_errors(self):
        for arguments, said in ((["--cores", "0"], "whole number >= 1"), (["--name", "../x"], "as a name"),
                                (["--set", "fluid.oil.fraction=1"], "an axis of"), (["--set", "x"], "allowed: key=value"),
                                (["--output", self.file], "cannot be written to")):
            done = self.sweep(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(said, done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_takes_negative_values_vectors_and_flags(self):
        self.file.write_text(SWEEP.replace("[0.0, 0.5]", "[-1.5, [0, 0, -9.81], true]").replace("fraction = 0.5", "fraction = -1.5"))
        self.assertEqual([p.name for p in plan.read_sweep(self.file).points if p.axes["oil"] == "B"],
                         ["oil=B_fraction=-1.5", "oil=B_fraction=0,0,-9.81", "oil=B_fraction=true"])

    def test_counts_before_it_makes_points(self):
        axes = "".join(f'[[axis]]\nkey = "fluid.k{k}"\nvalues = {list(range(1000))}\n' for k in range(3))
        self.file.write_text(f'[sweep]\ncase = "base.toml"\n{axes}')
        with self.assertRaisesRegex(plan.SweepError, r"1000000000 points \(1000 x 1000 x 1000\): allowed: up to 10000"):
            plan.read_sweep(self.file)


class Figures(unittest.TestCase):
    def points(self):
        try:
            from plotting import paper_charts
        except ImportError as missing:
            self.skipTest(str(missing))
        columns = ["status", "oil", "phi", "yield", "fluid.slurry.plastic_viscosity", "fluid.slurry.density",
                   "fluid.slurry.yield_stress", "spacing", "jet.tan_theta", "jet.travelling_time", "jet.class"]
        rows = [["done", "A", 0, "slag", 0.0482, 965, 0, 0.002, 0.3, 0.18, "free-jet"],
                ["done", "B", 0, "slag", 0.324, 970, 0, 0.002, 0.14, 0.19, "free-jet"],
                ["done", "B", 0.5, "slag", 3.08, 945, 3.1, 0.002, 0.02, 0.7, "wall-flow"],
                ["done", "B", 0.55, "slag", 4.9, 942, 5.0, 0.002, "", "", ""],
                ["failed", "B", 0.4, "slag", "", "", "", "", "", "", ""]]
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.table = Path(scratch.name) / "results.csv"
        with open(self.table, "w", newline="") as file:
            csv.writer(file).writerows([columns, *rows])
        return paper_charts, paper_charts.read_points(self.table)

    def test_n_is_that_of_equation_9(self):
        charts, points = self.points()
        self.assertEqual(len(points), 4)  # those that ended well
        self.assertAlmostEqual(points[1].n, 66.3, 1)  # oil B without beads, width 50 mm, depth 20 mm
        self.assertEqual([p.bingham for p in points], [False, False, True, True])

    def test_critical_n_lies_between_the_classes(self):
        charts, points = self.points()
        wall, jet = charts.critical_n(points)
        self.assertAlmostEqual(wall, points[2].n)
        self.assertAlmostEqual(jet, points[1].n)

    def test_draws_the_charts(self):
        charts, points = self.points()
        for draw in (charts.draw_viscosity, charts.draw_jets, charts.draw_times):
            draw(points, self.table.parent / "x.png")
            self.assertGreater((self.table.parent / "x.png").stat().st_size, 10000)


class Resolution(unittest.TestCase):
    def study(self):
        try:
            from plotting import resolution
        except ImportError as missing:
            self.skipTest(str(missing))
        return resolution

    def test_finds_order_and_limit(self):
        order, limit = self.study().extrapolate([(h, 0.2 + 3 * h**1.5) for h in (4e-3, 2e-3, 1e-3)])
        self.assertAlmostEqual(order, 1.5, 9)
        self.assertAlmostEqual(limit, 0.2, 9)

    def test_says_where_there_is_none(self):
        extrapolate = self.study().extrapolate
        self.assertEqual(extrapolate([(4, 1.0), (2, 1.2), (1, 1.1)]), (None, None))  # to and fro
        self.assertEqual(extrapolate([(4, 1.0), (2, 1.1), (1, 1.3)]), (None, None))  # away
        self.assertEqual(extrapolate([(4, 1.0), (2, 1.2)]), (None, None))

    def test_reads_and_draws_a_sweep(self):
        study = self.study()
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "results.csv"
            rows = [["done", n, h, 0.18 + 2 * h, 0.3 - 5 * h] for n in (443, 49) for h in (0.001, 0.004, 0.002)]
            with open(table, "w", newline="") as file:
                csv.writer(file).writerows([["status", "N", "spacing", "jet.travelling_time", "jet.tan_theta"], *rows])
            series = study.read_series(table)
            self.assertIn("N = 443: 0.188 (4 mm), 0.184 (2 mm), 0.182 (1 mm); order 1.00, extrapolated 0.18",
                          next(study.table(series)))
            study.draw(series, Path(folder) / "x.png")
            self.assertGreater((Path(folder) / "x.png").stat().st_size, 10000)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
