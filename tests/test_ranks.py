#!/usr/bin/python3
"""Several processes share a run: all that they write is, to the bit, what one writes. The programs come from the
environment: SLAGFLOW_RANKS_PROGRAM has MPI, SLAGFLOW_PROGRAM has not."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

try:
    import h5py  # noqa: F401, compare.py needs it
except ImportError:
    sys.exit(77)
sys.path.insert(0, str(Path(__file__).parent / "ranks"))
import compare

PROGRAM = os.environ.get("SLAGFLOW_RANKS_PROGRAM", "")
ALONE = os.environ.get("SLAGFLOW_PROGRAM", "")
if not shutil.which("mpirun") or not Path(PROGRAM).is_file():
    sys.exit(77)
CASES = Path(__file__).parent.parent / "cases"

SLAG = """
[resolution]
spacing = 2e-3
[fluid.slag]
density = 2600
rheology = "bingham"
plastic_viscosity = {viscosity}
yield_stress = 12
"""

# Falls off a table: measures of all kinds that ranks have to agree on, and particles that leave.
TABLE = SLAG.format(viscosity=0.8) + """
[case]
name = "table"
[[region]]
shapes = [{shape = "box", min = [0, 0, 0], max = [0.04, 0.016, 0.03]}]
[[wall]]
name = "table"
shapes = [{shape = "box", min = [-0.02, -1, -0.02], max = [0.06, 1, 0]},
          {shape = "box", min = [-0.02, -1, 0], max = [0, 1, 0.05]}]
[domain]
min = [-0.02, 0, -0.06]
max = [0.2, 0.016, 0.05]
periodic = ["y"]
[output]
end_time = 0.06
interval = 0.03
history_interval = 0.01
checkpoint_interval = 0
[[measure]]
name = "front"
type = "front"
direction = "+x"
position = 0.05
[[measure]]
name = "on"
type = "volume"
min = [0, 0, 0]
max = [0.06, 0.016, 0.05]
[[measure]]
name = "along"
type = "profile"
start = [-0.01, 0.008, 0.005]
end = [0.1, 0.008, 0.005]
points = 30
[[measure]]
name = "load"
type = "force"
wall = "table"
"""

# A plate pushes stiff slag along a trough: walls that move, forces, work, multigrid.
PLATE = SLAG.format(viscosity=40) + """
[case]
name = "plate"
[[region]]
shapes = [{shape = "box", min = [0.01, 0, 0], max = [0.08, 0.016, 0.02]}]
[[wall]]
name = "floor"
shapes = [{shape = "box", min = [-0.02, -1, -0.02], max = [0.12, 1, 0]}]
[[wall]]
name = "plate"
shapes = [{shape = "box", min = [0, -1, 0], max = [0.01, 1, 0.04]}]
motion = {type = "constant", velocity = [0.3, 0, 0]}
[domain]
min = [-0.02, 0, -0.02]
max = [0.12, 0.016, 0.05]
periodic = ["y"]
[output]
end_time = 0.03
interval = 0.015
history_interval = 0.005
checkpoint_interval = 0
[[measure]]
name = "push"
type = "force"
wall = "plate"
"""


def arguments(program, ranks):
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle",
            "1", "-n", str(ranks), program] if ranks > 1 else [program]


class Ranks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def program(self, ranks, *words, cuts=None, program=PROGRAM, poison=False):
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        if cuts is not None:
            environment["SLAGFLOW_RANDOM_CUTS"] = str(cuts)
        if poison:
            environment["SLAGFLOW_POISON_HALOS"] = "1"
        return subprocess.run([*arguments(program, ranks), *map(str, words)], env=environment, text=True,
                              capture_output=True, timeout=250, check=False)

    def case(self, text):
        path = self.folder / "case.toml"
        path.write_text(text)
        return path

    def runs(self, ranks, case, *words, **how):
        out = self.folder / f"{len(list(self.folder.iterdir()))}"
        done = self.program(ranks, "run", case, "-o", out, "--quiet", *words, **how)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def assert_same(self, one, other):
        found = [line for line in compare.differences(one, other) if "run/resumes" not in line]
        self.assertEqual(found, [])

    def assert_same_on(self, numbers, case, *words, **how):
        alone = self.runs(1, case, *words)
        for ranks in numbers:
            self.assert_same(alone, self.runs(ranks, case, *words, **how))
        return alone

    def test_a_jet_that_leaves(self):
        self.assert_same_on((2, 4), CASES / "dam_discharge_quick.toml", "--set", "output.end_time=0.25")

    def test_all_measures(self):
        alone = self.assert_same_on((2, 3), self.case(TABLE))
        summary = json.loads((alone / "summary.json").read_text())
        self.assertGreater(summary["measures"]["front"]["passed_fraction"], 0)
        self.assertNotIn("ranks", summary)

    def test_walls_that_move(self):
        self.assert_same_on((3,), self.case(PLATE))

    def test_cuts_at_random(self):
        self.assert_same_on((3,), self.case(PLATE), cuts=1)
        self.assert_same_on((2, 4), self.case(TABLE), "--set", "output.end_time=0.03", cuts=7)

    def test_copies_that_are_old_are_not_read(self):
        self.assert_same_on((3,), self.case(PLATE), "--set", "output.end_time=0.01", cuts=2, poison=True)
        case = CASES / "verification" / "drop.toml"
        self.assert_same_on((2,), case, "--set", "output.end_time=0.002", poison=True)

    def test_inlets_and_outlets(self):
        alone = self.assert_same_on((2, 3), CASES / "verification" / "fed_channel.toml", "--set", "output.end_time=0.03",
                                    cuts=4)
        self.assertGreater(json.loads((alone / "summary.json").read_text())["mass_fed"], 0)

    def test_surface_tension(self):
        self.assert_same_on((2,), CASES / "verification" / "drop.toml", "--set", "output.end_time=0.005")

    def test_a_cut_across_a_period(self):
        case = CASES / "verification" / "taylor_green.toml"
        self.assert_same_on((2, 3), case, "--set", "output.end_time=0.02", cuts=3)

    def test_other_solvers(self):
        for solver in ("jacobi", "conjugate_gradient"):
            self.assert_same_on((3,), self.case(TABLE), "--set", f"numerics.solver={solver}", "--set",
                                "output.end_time=0.02", "--set", "numerics.theta=0.5")

    def test_resumed_on_other_numbers(self):
        case = self.case(PLATE)
        whole = self.runs(1, case)
        parts = self.runs(1, case, "--until", "0.01")
        for ranks, until in ((3, 0.02), (2, 0.03)):
            done = self.program(ranks, "resume", parts, "--until", until, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(whole, parts)

    def test_the_summary_tells_of_them(self):
        out = self.runs(2, self.case(TABLE), "--set", "output.end_time=0.02")
        ranks = json.loads((out / "summary.json").read_text())["ranks"]
        self.assertEqual(ranks["count"], 2)
        self.assertGreater(ranks["messages_per_step"], 4)
        self.assertGreater(ranks["bytes_per_step"], 1e4)
        self.assertLess(ranks["largest_over_mean_particles"], 1.5)

    def assert_refused(self, done, *words):
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("error:"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_what_does_not_go_is_refused_once(self):
        out = self.folder / "out"
        for key, value in (("numerics.yield", "exact"), ("numerics.solver", "sor")):
            done = self.program(2, "run", self.case(TABLE), "-o", out, "--set", f"{key}={value}")
            self.assert_refused(done, key, value, "several ranks", "allowed")
        done = self.program(12, "run", self.case(PLATE), "-o", out, "--set", "domain.max=[0.1, 0.016, 0.05]")
        self.assert_refused(done, "ranks", "at most")
        self.assertFalse(out.exists())

    def test_a_program_without_mpi_says_so(self):
        done = self.program(2, "run", self.case(TABLE), "-o", self.folder / "out", program=ALONE)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("without MPI", done.stderr)

    def test_a_rank_that_is_killed_ends_the_run(self):
        out = self.folder / "out"
        command = [*arguments(PROGRAM, 2), "run", str(self.case(TABLE)), "-o", str(out), "--quiet", "--set",
                   "output.end_time=100", "--set", "output.checkpoint_interval=0.2"]
        with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                              env=dict(os.environ, OMP_NUM_THREADS="1")) as run:
            deadline = time.monotonic() + 60
            while not (out / "checkpoint.h5").exists() and time.monotonic() < deadline:
                time.sleep(0.1)
            children = subprocess.run(["pgrep", "-P", str(run.pid)], text=True, capture_output=True, check=False)
            os.kill(int(children.stdout.split()[-1]), signal.SIGKILL)
            run.communicate(timeout=60)
        self.assertNotEqual(run.returncode, 0)
        done = self.program(3, "resume", out, "--set", "output.end_time=0.01", "--quiet")
        self.assertIn(done.returncode, (0, 2), done.stderr)

    def test_a_full_disk_ends_all(self):
        out = self.folder / "out"
        mpirun = arguments(PROGRAM, 2)  # by TCP: shared memory of the ranks is a file, too
        limited = f"trap '' XFSZ; ulimit -f 200; exec {PROGRAM} run {self.case(TABLE)} -o {out} --quiet"
        done = subprocess.run([*mpirun[:-1], "--mca", "btl", "self,tcp", "sh", "-c", limited], text=True,
                              capture_output=True, timeout=120, check=False, env=dict(os.environ, OMP_NUM_THREADS="1"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cannot write to", done.stderr)
        self.assertEqual(json.loads((out / "summary.json").read_text())["status"], "failed")


if __name__ == "__main__":
    unittest.main()
