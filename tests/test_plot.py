"""Tests of scripts/plot on synthetic runs. With a test's name as argument only that one is run."""

import contextlib
import importlib.machinery
import importlib.util
import io
import struct
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

try:
    import h5py
    import matplotlib.image
    import numpy as np
    from PIL import Image
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

PROJECT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "scripts"))
from plotting import flow, history, paper_views  # noqa: E402
import slagflow  # noqa: E402
from plotting.splat import OVERSAMPLING, Canvas, View  # noqa: E402


def load_script(path):
    """The program as a module: pictures are drawn without a process of their own."""
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True  # beside a script without a suffix
PLOT = load_script(PROJECT / "scripts/plot")
SPACING = 0.01
HISTORY = "time_s,step,kinetic_energy_J,particles_in,iterations\n0,0,0,2,1\n0.1,5,0.02,2,3\n"


def write_vtkhdf(path, times, positions, velocities):
    """The parts of a VTKHDF PolyData file that hold points; `positions`, `velocities`: an array for each time."""
    counts = np.array([len(p) for p in positions])
    starts = np.cumsum(counts) - counts
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root["NumberOfPoints"] = counts
        root["Points"] = np.concatenate(positions)
        root["PointData/Velocity"] = np.concatenate(velocities)
        root["Steps/Values"] = np.asarray(times, float)
        root["Steps/PointOffsets"] = starts
        root["Steps"].attrs["NSteps"] = len(times)


class Plot(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "run"

    def make_run(self, times, counts, dimensions=3):
        """A run in which the `counts` particles stand in a row along x, at speed 1, 2, 3 .. m/s in z."""
        self.folder.mkdir()
        positions = [np.array([[SPACING * i, 0, 0] for i in range(n)]).reshape(-1, 3) for n in counts]
        velocities = [np.array([[0, 0, 1.0 + i] for i in range(n)]).reshape(-1, 3) for n in counts]
        write_vtkhdf(self.folder / "particles.vtkhdf", times, positions, velocities)
        floor = np.array([[SPACING * i, 0, -SPACING] for i in range(9)])
        write_vtkhdf(self.folder / "walls.vtkhdf", [0], [floor], [0 * floor])
        (self.folder / "case.toml").write_text(
            f'[case]\nname = "row"\n[resolution]\nspacing = {SPACING}\ndimensions = {dimensions}\n')
        (self.folder / "history.csv").write_text(HISTORY)

    def run_script(self, *arguments):
        return subprocess.run([PROJECT / "scripts/plot", "--no-surface", *map(str, arguments)], capture_output=True, text=True)

    def plot(self, *arguments):
        """The same in this process, and the flow at a quarter of the resolution."""
        out, errors = io.StringIO(), io.StringIO()
        with (mock.patch.object(flow, "DPI", flow.DPI / 4), mock.patch.object(sys, "argv", ["plot", "--no-surface", *map(str, arguments)]),
              contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors)):
            status = PLOT.main()
        return types.SimpleNamespace(returncode=status, stdout=out.getvalue(), stderr=errors.getvalue())

    def picture_size(self, name):
        head = (self.folder / "pictures" / name).read_bytes()[:24]
        self.assertEqual(head[:8], b"\x89PNG\r\n\x1a\n")
        return struct.unpack(">II", head[16:])

    def test_draws_both_pictures_and_names_them(self):
        self.make_run([0, 0.1], [5, 5])
        done = self.run_script(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.split(), [str(self.folder / "pictures" / n) for n in ("flow.png", "history.png")])
        self.assertGreater(self.picture_size("flow.png")[0], 600)
        self.assertGreater(self.picture_size("history.png")[0], 600)

    def test_draws_a_flow_curve_beside_its_table(self):
        self.folder.mkdir()
        curves = self.folder / "oil.csv"
        curves.write_text("shear_rate_1/s,measured_Pa,newtonian_Pa\n1,1.1,1\n5,4.9,5\n0.8,,0.8\n6,,6\n")
        done = self.plot(curves)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout.strip(), str(self.folder / "oil.png"))
        self.assertEqual((self.folder / "oil.png").read_bytes()[:4], b"\x89PNG")

    def test_draws_what_is_over_temperature(self):
        self.folder.mkdir()
        for name, text in (
            ("melt", "temperature_K,measured_Pas,weymann_Pas,vft_Pas\n1600,1,1.1,1\n1800,0.2,0.2,0.2\n1590,,1.2,1.1\n1810,,0.2,0.2\n"),
            ("slag", "temperature_K,measured_Pas,urbain_Pas,riboud_Pas\n1600,,1.1,1\n1800,,0.2,0.3\n"),
            ("phases", "temperature_K,measured_solid_fraction,rows_solid_fraction\n1400,1,1\n1600,0,0\n1400,,1\n1600,,0\n"),
        ):
            curves = self.folder / f"{name}.csv"
            curves.write_text(text)
            done = self.plot(curves)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual((self.folder / f"{name}.png").read_bytes()[:4], b"\x89PNG")

    def test_draws_a_case_before_it_is_run(self):
        made = self.folder.parent / "made"
        made.mkdir()
        self.make_run([0], [4])
        case = self.folder.parent / "tank.toml"
        case.write_text("")
        program = self.folder.parent / "program"  # leaves the synthetic run where it is told to
        program.write_text(f"#!/bin/sh\n[ \"$1\" = run ] || exit 2\ncp -r {self.folder} \"$4\"\n")
        program.chmod(0o755)
        done = self.run_script(case, "--program", program, "--output", made)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, str(made / "tank_start.png")), done.stderr)
        self.assertTrue((made / "tank_start.png").is_file())
        program.write_text("#!/bin/sh\necho 'error: tank.toml:1: wrong' >&2\nexit 2\n")
        done = self.run_script(case, "--program", program, "--output", made)
        self.assertEqual(done.returncode, 2)
        self.assertIn("tank.toml:1: wrong", done.stderr)

    def test_a_run_without_fluid_shows_its_walls(self):
        self.make_run([0], [0])
        scene = flow.Scene(slagflow.open(self.folder), [0])
        self.assertEqual(len(scene.walls[0]), 9)

    def test_refuses_another_table_than_a_flow_curve(self):
        self.folder.mkdir()
        (self.folder / "oil.csv").write_text("time_s,step\n0,1\n")
        done = self.plot(self.folder / "oil.csv")
        self.assertEqual(done.returncode, 2)
        self.assertIn("oil.csv is not what slagflow rheometry -o leaves", done.stderr)

    def test_the_fastest_particle_has_the_colour_of_the_maps_end(self):
        self.make_run([0], [5])
        self.assertEqual(self.plot(self.folder).returncode, 0)
        picture = matplotlib.image.imread(self.folder / "pictures/flow.png")[..., :3]
        yellow = np.all(np.abs(picture - (0.99, 0.91, 0.14)) < 0.1, axis=-1)  # viridis' upper end: the fastest
        self.assertGreater(yellow.sum(), 100)

    def test_the_particles_have_the_colour_asked_for(self):
        self.make_run([0], [5])
        self.assertEqual(self.plot(self.folder, "--no-surface", "--colour", "speed").returncode, 0)
        by_speed = matplotlib.image.imread(self.folder / "pictures/flow.png")
        done = self.plot(self.folder, "--no-surface", "--colour", "depth")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(np.array_equal(matplotlib.image.imread(self.folder / "pictures/flow.png"), by_speed))
        done = self.plot(self.folder, "--no-surface", "--colour", "temperature")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the run has not written what 'temperature' needs", done.stderr)

    def test_each_time_asked_for_adds_a_row(self):
        self.make_run([0, 0.1, 0.2, 0.3], [5, 5, 5, 5])
        self.assertEqual(self.plot(self.folder, "--times", "0.1").returncode, 0)
        one = self.picture_size("flow.png")[1]
        self.assertEqual(self.plot(self.folder, "--times", "0,0.1,0.31").returncode, 0)
        three = self.picture_size("flow.png")[1]
        self.assertGreater(three, 1.5 * one)

    def test_movie_has_a_frame_for_each_time(self):
        self.make_run([0, 0.1, 0.2], [5, 5, 2])
        done = self.plot(self.folder, "--movie")
        self.assertIn("flow.gif", done.stdout)
        with Image.open(self.folder / "pictures/flow.gif") as movie:
            self.assertEqual(movie.n_frames, 3)

    def test_two_dimensions_have_the_side_view_only(self):
        self.make_run([0, 0.1], [50, 50])
        self.assertEqual(self.plot(self.folder).returncode, 0)
        three = self.picture_size("flow.png")[0]
        (self.folder / "case.toml").write_text(
            f"[resolution]\nspacing = {SPACING}\ndimensions = 2\n")
        self.assertEqual(self.plot(self.folder).returncode, 0)
        self.assertLess(self.picture_size("flow.png")[0], three)

    def test_views_of_the_papers_figures_are_drawn_side_by_side(self):
        self.make_run([0, 0.1], [50, 50])
        run, target = slagflow.open(self.folder), self.folder / "views.png"
        views = [paper_views.Picture(run, 0.1, "side"), paper_views.Picture(run, 0.1, "oblique", flow.OBLIQUE, ("", ""))]
        paper_views.draw(views, "two views", target)
        self.assertGreater(matplotlib.image.imread(target).shape[1], 600)

    def test_run_without_particles_is_drawn(self):
        self.make_run([0], [0])
        done = self.plot(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_pictures_go_where_asked(self):
        self.make_run([0], [3])
        target = self.folder.parent / "elsewhere"
        self.assertEqual(self.plot(self.folder, "--output", target).returncode, 0)
        self.assertTrue((target / "flow.png").is_file())
        self.assertFalse((self.folder / "pictures").exists())

    def test_wrong_folder_is_one_clear_error(self):
        self.folder.mkdir()
        for folder in (self.folder, self.folder / "none"):
            done = self.plot(folder)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(str(folder), done.stderr)
            self.assertFalse((folder / "pictures").exists())

    def test_file_of_another_kind_is_one_clear_error(self):
        self.make_run([0], [3])
        (self.folder / "particles.vtkhdf").write_text("no HDF5")
        done = self.plot(self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("particles.vtkhdf is not a VTKHDF file", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_nearest_steps_are_taken_once_each(self):
        self.make_run([0, 0.1, 0.2], [1, 1, 1])
        self.assertEqual(slagflow.open(self.folder).nearest_steps([0.19, 0.06, 0.11, 7]), [1, 2])

    def test_typical_steps_end_while_fluid_is_left(self):
        self.make_run([0, 0.1, 0.2, 0.3, 0.4, 0.5], [40, 40, 40, 20, 3, 0])
        self.assertEqual(slagflow.open(self.folder).typical_steps(3), [1, 2, 3])

    def test_reader_takes_each_steps_own_particles(self):
        self.make_run([0, 0.1], [2, 3])
        fluid = slagflow.open(self.folder).fluid
        np.testing.assert_allclose(fluid.positions(1)[:, 0], [0, SPACING, 2 * SPACING])
        np.testing.assert_allclose(fluid.speeds(1), [1, 2, 3])

    def test_step_that_a_crash_cut_short_is_left_out(self):
        self.make_run([0, 0.1, 0.2], [2, 2, 2])
        with h5py.File(self.folder / "particles.vtkhdf", "a") as file:
            file["VTKHDF/Steps"].attrs["NSteps"] = 2
        self.assertEqual(slagflow.open(self.folder).nearest_steps([0.2]), [1])

    def test_history_takes_numbers_and_leaves_out_text(self):
        self.make_run([0], [1])
        (self.folder / "history.csv").write_text("time_s,front_m,class\n0,,wall-flow\n0.1,-0.5,free-jet\n")
        columns = slagflow.open(self.folder).columns()
        self.assertEqual(list(columns), ["time_s", "front_m"])
        np.testing.assert_array_equal(columns["front_m"], [np.nan, -0.5])

    def test_columns_of_the_same_front_are_one_curve(self):
        front, other = np.array([0, np.nan, -1]), np.array([0, 2, 3])
        curves = history.labelled({"a_front_m": front, "b_front_m": other, "jet_front_m": front.copy()})
        self.assertEqual(set(curves), {"a, jet", "b"})
        np.testing.assert_array_equal(curves["a, jet"], front)

    def test_measures_have_panels_and_the_solver_has_none(self):
        time, nothing = np.array([0.0, 1.0]), np.array([0.0, 0.0])
        panels = history.panels_of({
            "iterations": np.array([1.0, 2.0]), "a_front_m": 0.05 * time, "a_passed": 0.5 * time, "gate_flow_m3_s": 2e-3 * time,
            "gate_passed_m3": 5 * time, "leg_m2": nothing, "lid_pressure_x_N": 3e3 * time, "lid_viscous_x_N": 1e3 * time,
            "lid_pressure_y_N": 1e-3 * time, "lid_torque_z_Nm_m": 2e-5 * time, "kinetic_energy_J": 0.02 * time})
        self.assertEqual([(title, unit) for title, _, unit, _ in panels],
                         [("Front", "[mm]"), ("Passed share of the fluid", "[%]"), ("Flow rate", "[l/s]"), ("Volume", "[m³]"),
                          ("Force", "[kN]"), ("Torque per width", "[µN m/m]"), ("Energy", "[mJ]")])
        force = dict((title, columns) for title, columns, _, _ in panels)["Force"]
        self.assertEqual(list(force), ["lid_force_x_N"])  # y is nothing beside x
        np.testing.assert_allclose(force["lid_force_x_N"], 4e3 * time)
        self.assertEqual(history.label_of("lid_force_x_N"), "lid x")

    def test_every_kind_of_measure_has_a_panel(self):
        names = {"gate_flow_m3_s": "Flow rate", "held_m3": "Volume", "top_surface_m": "Level", "top_thickness_m": "Thickness of the fluid",
                 "pool_highest_m": "Level", "pool_mean_thickness_m": "Thickness of the fluid", "pool_covered_share": "Touched or covered share",
                 "weir_forward_kg": "Mass passed", "tap_mass_fed_kg": "Mass fed and taken", "lining_wetted_share": "Touched or covered share",
                 "lining_largest_pressure_Pa": "Pressure on a wall", "out_p50_s": "Time since it came in", "out_inside_mean_s": "Time since it came in",
                 "stir_index": "Mixing index", "max_temperature_K": "Temperature", "heat_to_pot_J": "Heat lost and gained",
                 "heat_content_J": "Heat of the fluid, fed and left", "rim_taken_J": "Heat taken by a wall", "lid_pressure_x_N": "Force"}
        for name, title in names.items():
            found = history.panels_of({name: np.array([1.0, 2.0])})
            self.assertEqual([panel[0] for panel in found], [title], name)
        self.assertEqual(history.panels_of({"iterations": np.ones(2), "dt_s": np.ones(2), "max_speed_m_s": np.ones(2)}), [])
        np.testing.assert_allclose(history.panels_of({"a_K": np.array([1573.15])})[0][1]["a_K"], [1300])
        self.assertEqual([history.label_of(n) for n in ("top_surface_m", "left_forward_kg_m", "lining_mean_pressure_Pa", "tap_mass_fed_kg")],
                         ["top", "left forward", "lining mean", "tap mass fed"])

    def test_flow_rates_are_means_over_a_short_time_and_keep_what_passed(self):
        time, flow_rate = np.linspace(0, 1, 241), np.zeros(241)
        flow_rate[100:140:4] = 1e-3
        title, columns, _, _ = history.panels_of({"gate_flow_m3_s": flow_rate}, time)[0]
        self.assertEqual(title, "Flow rate, mean over 0.021 s")
        self.assertAlmostEqual(columns["gate_flow_m3_s"].sum(), flow_rate.sum())
        self.assertLess(columns["gate_flow_m3_s"].max(), 0.5e-3)

    def test_history_of_measures_is_drawn(self):
        self.make_run([0, 0.1], [5, 5])
        few = self.plot(self.folder) and self.picture_size("history.png")[1]
        (self.folder / "history.csv").write_text(
            "time_s,step,kinetic_energy_J,iterations,a_front_m,gate_flow_m3_s,gate_passed_m3,lid_pressure_x_N\n"
            "0,0,0,1,0.1,,0,\n0.1,5,0.02,3,0.2,1e-3,1e-4,5\n")
        done = self.plot(self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater(self.picture_size("history.png")[1], 1.3 * few)

    def test_times_that_are_none_are_refused(self):
        self.make_run([0, 0.1], [5, 5])
        for times in ("nan", "inf", "-1", "-0.1,0.2", "soon", "", "0.1,,0.2", "1e400"):
            done = self.run_script(self.folder, "--times", times)
            self.assertEqual(done.returncode, 2)
            self.assertIn("allowed: times in seconds >= 0, commas between them", done.stderr)
        self.assertFalse((self.folder / "pictures").exists())

    def test_times_that_do_not_ascend_are_told(self):
        self.make_run([0, 0.1, 0.9], [5, 5, 5])
        self.assertIn("the times 0, 5, 1 do not ascend", self.plot(self.folder, "--times", "0,5,1").stderr)
        self.assertEqual(self.plot(self.folder, "--times", "0,0.1,0.1").stderr, "")

    def test_a_time_after_the_last_one_is_told(self):
        self.make_run([0, 0.1], [5, 5])
        done = self.plot(self.folder, "--times", "0.05,7")
        self.assertEqual(done.returncode, 0)
        self.assertIn("the last time written is 0.1 s", done.stderr)

    def test_case_file_without_spacing_is_an_error(self):
        self.make_run([0], [1])
        (self.folder / "case.toml").write_text("[resolution]\n")
        with self.assertRaisesRegex(slagflow.RunError, "spacing"):
            slagflow.open(self.folder)

    def test_files_that_are_no_text_or_no_case_are_errors(self):
        self.make_run([0], [1])
        case = (self.folder / "case.toml").read_text()
        for wrong in (b"\xff\xfe", b"resolution = 3\n", b'[resolution]\nspacing = "x"\n', b"[resolution]\nspacing = 0\n",
                      b"[resolution]\nspacing = nan\n"):
            (self.folder / "case.toml").write_bytes(wrong)
            with self.assertRaisesRegex(slagflow.RunError, "case.toml: "):
                slagflow.open(self.folder)
        (self.folder / "case.toml").write_text("\ufeff" + case)
        (self.folder / "history.csv").write_bytes(b"\xff\xfe\x00")
        with self.assertRaisesRegex(slagflow.RunError, "history.csv is not a table of text"):
            slagflow.open(self.folder).columns()
        (self.folder / "history.csv").write_text("\ufeff" + HISTORY)
        self.assertIn("time_s", slagflow.open(self.folder).columns())

    def test_ball_has_its_true_size(self):
        canvas = Canvas((-1, 1, -1, 1), 100)
        canvas.splat(np.array([[0.0, 0, 0]]), 0.5)
        area = (canvas.owner >= 0).sum() / (100 * OVERSAMPLING) ** 2
        self.assertAlmostEqual(area, np.pi * 0.25, delta=0.01 * np.pi * 0.25)  # 1 %: pixels along the rim

    def test_nearer_ball_hides_the_one_behind(self):
        for order in ([0, 1], [1, 0]):
            points = np.array([[0.0, 0, 1], [0.1, 0, 0]])[order]
            canvas = Canvas((-1, 1, -1, 1), 50)
            canvas.splat(points, 0.3)
            row = column = 50 * OVERSAMPLING
            self.assertEqual(canvas.owner[row, column + 2], order.index(0))

    def test_oblique_view_is_a_rotation_with_z_up(self):
        view = View.oblique(30, 20)
        axes = np.stack([view.right, view.up, view.towards])
        np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        np.testing.assert_allclose(np.linalg.det(axes), 1)
        self.assertGreater(view.up[2], 0)
        np.testing.assert_allclose(view.towards[2], np.sin(np.radians(20)))


if __name__ == "__main__":
    unittest.main()
