"""Tests of the Python package in scripts/slagflow and of its page. With a test's name as argument only that one is run."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from test_plot import HISTORY, PROJECT, write_vtkhdf

import h5py
import numpy as np
import slagflow
from slagflow import program

SUMMARY = '{"status": "done", "steps": 5, "measures": {"gate": {"type": "flow_rate", "passed_volume": 0.5}}}'
PAGE = PROJECT / "cases/howto/python.md"
# A program that stands for slagflow: copies a run to where it is told, and writes down what it was asked.
PROGRAM = """#!/bin/sh
printf '%s\\n' "$@" > {asked}
case "$*" in *yield=*) echo 'warning: first' >&2; echo "error: --set yield: unknown" >&2; echo 'allowed: density' >&2; exit 2;; esac
case "$*" in *fails*) echo 'error: no memory' >&2; exit 1;; esac
cp -r {run} {made}
echo "results in {made}"
"""


class PythonPackage(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.scratch = Path(scratch.name)
        self.folder = self.make_run()

    def make_run(self):
        folder = self.scratch / "run"
        folder.mkdir()
        rows = [np.array([[0.01 * i, 0, 0] for i in range(n)]) for n in (2, 3)]
        write_vtkhdf(folder / "particles.vtkhdf", [0, 0.1], rows, [100 * p for p in rows])
        with h5py.File(folder / "particles.vtkhdf", "a") as file:
            fields = file["VTKHDF/PointData"]
            fields["Velocity"].attrs["units"] = "m/s"
            fields["ParticleId"] = np.array([0, 1, 0, 1, 2**60])
        (folder / "case.toml").write_text('[case]\nname = "row"\n[resolution]\nspacing = 0.01\n[fluid.oil]\ndensity = 900\n')
        (folder / "history.csv").write_text(HISTORY)
        (folder / "summary.json").write_text(SUMMARY)
        return folder

    def make_program(self):
        path = self.scratch / "slagflow"
        path.write_text(PROGRAM.format(run=self.folder, made=self.scratch / "made", asked=self.scratch / "asked"))
        path.chmod(0o755)
        return path

    def test_snapshots_are_arrays_by_field(self):
        run = slagflow.open(str(self.folder))
        np.testing.assert_array_equal(run.times, [0, 0.1])
        self.assertEqual([len(s["Position"]) for s in run.snapshots], [2, 3])
        last = run.snapshots[-1]
        self.assertEqual((last.time, last.step, last.count, set(last)), (0.1, 1, 3, {"Position", "Velocity", "ParticleId"}))
        np.testing.assert_allclose(last["Velocity"], 100 * last["Position"])
        self.assertEqual(last["ParticleId"][-1], 2**60)  # exact: no floating point number in between
        self.assertEqual(run.snapshot(0.07).time, 0.1)
        self.assertEqual([s.step for s in run.snapshots[::-1]], [1, 0])
        with self.assertRaisesRegex(KeyError, "'Colour': allowed: Position, ParticleId, Velocity"):
            last["Colour"]
        with self.assertRaisesRegex(IndexError, "snapshot 2: allowed: -2 to 1"):
            run.snapshots[2]

    def test_units_of_fields_and_columns_are_known(self):
        units = slagflow.open(self.folder).units
        self.assertEqual([units[n] for n in ("Position", "Velocity", "ParticleId", "time_s", "kinetic_energy_J", "iterations")],
                         ["m", "m/s", "1", "s", "J", "1"])
        for column, unit in (("gate_flow_m3_s", "m^3/s"), ("lid_torque_x_Nm_m", "N m/m"), ("a_force_x_N_m", "N/m"), ("front_100mm_passed", "1"),
                             ("max_speed_m_s", "m/s"), ("wall_mean_pressure_Pa", "Pa"), ("tap_p05_s", "s"), ("weir_forward_kg", "kg")):
            self.assertEqual(slagflow.history.unit_of(column), unit, column)

    def test_history_is_a_frame_with_units(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            with self.assertRaisesRegex(slagflow.RunError, "`pip install pandas` brings it"):
                slagflow.open(self.folder).history
            return
        history = slagflow.open(self.folder).history
        self.assertEqual(list(history.columns), HISTORY.split("\n", 1)[0].split(","))
        self.assertEqual((history.kinetic_energy_J.max(), history.attrs["units"]["kinetic_energy_J"]), (0.02, "J"))

    def test_summary_measures_and_case_are_tables(self):
        run = slagflow.open(self.folder)
        self.assertEqual((run.summary["steps"], run.measures["gate"]["passed_volume"], run.case["fluid"]["oil"]["density"]), (5, 0.5, 900))
        (self.folder / "summary.json").unlink()
        self.assertEqual((run.summary, run.measures), ({}, {}))

    def test_what_is_no_run_is_one_message(self):
        with self.assertRaisesRegex(slagflow.RunError, "nothing is no folder"):
            slagflow.open(self.scratch / "nothing")
        with self.assertRaisesRegex(slagflow.RunError, "particles.vtkhdf is missing: is .* the folder of a run"):
            slagflow.open(self.scratch)

    def test_runs_a_case_with_other_values(self):
        run = slagflow.run("case.toml", output=self.scratch / "out", set={"fluid.oil.density": 800, "case.name": "x y", "gravity": [0, 0, -1.5]},
                           program=self.make_program(), threads=2, overwrite=True)
        self.assertEqual(run.path, self.scratch / "made")
        self.assertEqual((self.scratch / "asked").read_text().splitlines(),
                         ["run", "case.toml", "--quiet", "--set=fluid.oil.density=800", '--set=case.name="x y"', "--set=gravity=[0, 0, -1.5]",
                          "-o", str(self.scratch / "out"), "--threads", "2", "--overwrite"])

    def test_an_error_of_the_program_is_an_exception_with_its_words(self):
        for case, settings, status, words in (("case.toml", {"yield": 3}, 2, "--set yield: unknown\nallowed: density"), ("fails.toml", {}, 1, "no memory")):
            with self.assertRaises(slagflow.ProgramError) as caught:
                slagflow.run(case, set=settings, program=self.make_program())
            self.assertEqual((caught.exception.status, str(caught.exception)), (status, words))

    def test_finds_the_program_by_argument_environment_path_and_checkout(self):
        made = self.make_program()
        path = f"{self.scratch / 'bin'}:/usr/bin:/bin"
        with mock.patch.dict(os.environ, {"PATH": path}), mock.patch.object(program, "checkouts", lambda: [self.scratch]):
            os.environ.pop("SLAGFLOW_PROGRAM", None)
            with self.assertRaisesRegex(slagflow.ProgramError, "the program slagflow is not found: allowed: the argument `program`, SLAGFLOW_PROGRAM"):
                slagflow.find_program()
            build, binaries, other = (self.scratch / p for p in ("build/cpu/slagflow", "bin/slagflow", "other"))
            for target in (build, binaries, other):
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(made, target)
                if target == other:
                    os.environ["SLAGFLOW_PROGRAM"] = str(other)
                self.assertEqual(slagflow.find_program(), target)
            self.assertEqual(slagflow.find_program(made), made)
            os.environ["SLAGFLOW_PROGRAM"] = "/nowhere"
            with self.assertRaisesRegex(slagflow.ProgramError, "/nowhere is no program, which SLAGFLOW_PROGRAM names"):
                slagflow.find_program()

    def test_is_installed_by_pip_with_its_types(self):
        source, target = self.scratch / "scripts", self.scratch / "venv"
        shutil.copytree(PROJECT / "scripts", source, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", target], check=True)
        done = subprocess.run([target / "bin/pip", "install", "--quiet", "--disable-pip-version-check", "--no-build-isolation", "--no-deps", source],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        code = "import slagflow, pathlib; p = pathlib.Path(slagflow.__file__).parent; print(p, (p / 'py.typed').exists(), len(slagflow.open('run').times))"
        said = subprocess.run([target / "bin/python", "-c", code], cwd=self.scratch, capture_output=True, text=True, check=True).stdout.split()
        self.assertTrue(said[0].startswith(str(target)), said)
        self.assertEqual(said[1:], ["True", "2"])

    def test_versions_are_those_of_the_program(self):
        wanted = re.search(r"project\(slagflow VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1]
        self.assertIn(f'version = "{wanted}"', (PROJECT / "scripts/pyproject.toml").read_text())
        self.assertEqual(slagflow.__version__, wanted)


NUMBER = re.compile(r"-?\d+\.?\d*(?:e-?\d+)?")


class PythonPage(unittest.TestCase):
    """The code of the page, block by block as in a notebook; blocks of text after them are what they print."""

    PYTHON = PROJECT / ".venv/bin/python"
    SLAGFLOW = PROJECT / "build/cpu/slagflow"

    def need(self):
        if not self.SLAGFLOW.is_file():
            self.skipTest("build/cpu/slagflow is not built")
        if subprocess.run([self.PYTHON, "-c", "import pandas"], capture_output=True, check=False).returncode if self.PYTHON.is_file() else True:
            self.skipTest("pandas is not in .venv: scripts/install --tests")

    def test_code_runs_and_prints_what_the_page_says(self):
        self.need()
        text = PAGE.read_text()
        blocks = re.findall(r"^```(python)?\n(.*?)^```\n(?:\n```\n(.*?)^```)?", text, re.M | re.S)
        code = [(body, said) for kind, body, said in blocks if kind == "python"]
        self.assertGreater(len(code), 5)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "cases").symlink_to(PROJECT / "cases")
            program = "".join(f"{body}\nprint('---')\n" for body, _ in code)
            environment = os.environ | {"PYTHONPATH": str(PROJECT / "scripts"), "SLAGFLOW_PROGRAM": str(self.SLAGFLOW)}
            done = subprocess.run([self.PYTHON, "-c", program], cwd=folder, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for (body, wanted), said in zip(code, done.stdout.split("---\n")):
            if wanted:
                self.assertEqual(NUMBER.sub("#", said), NUMBER.sub("#", wanted), body)
                for found, number in zip(NUMBER.findall(said), NUMBER.findall(wanted)):
                    self.assertLess(abs(float(found) - float(number)), 0.05 * max(1, abs(float(number))), body)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
