"""Tests of the pictures of free surfaces. With a test's name as argument only that one is run."""

import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path
from unittest import mock

from test_plot import HISTORY, PLOT, PROJECT, SPACING, write_vtkhdf

import h5py
import matplotlib.image
import numpy as np
from plotting import sheet, walls
from plotting.quantity import Quantity, ages
import slagflow

PYTHON = PROJECT / ".venv/bin/python"
SIDE = 8  # particles along the edge of the block


def tools_are_there():
    command = [PYTHON, "-c", "import pysplashsurf, pyvista, imageio_ffmpeg"]
    return PYTHON.exists() and subprocess.run(command, capture_output=True, check=False).returncode == 0


class SurfaceCase(unittest.TestCase):
    """Runs to draw, for the tests of surfaces and of reports."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def make_run(self, name="run", viscosity=1.0, speed=1.0):
        """A block on a floor, faster the higher: up to `speed` m/s; two times."""
        folder = self.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        along = (np.arange(SIDE) + 0.5) * SPACING
        block = np.stack(np.meshgrid(along, along, along), axis=-1).reshape(-1, 3)
        velocity = np.zeros_like(block)
        velocity[:, 0] = speed * block[:, 2] / block[:, 2].max()
        write_vtkhdf(folder / "particles.vtkhdf", [0, 0.1], [block, block], [0 * velocity, velocity])
        with h5py.File(folder / "particles.vtkhdf", "a") as file:
            file["VTKHDF/PointData/Fluid"] = np.tile((block[:, 0] > 0.04).astype(np.uint8), 2)
        floor = block[block[:, 2] < 4 * SPACING] - [0, 0, 4 * SPACING]
        write_vtkhdf(folder / "walls.vtkhdf", [0], [floor], [0 * floor])
        (folder / "case.toml").write_text(
            f'[case]\nname = "block"\n[resolution]\nspacing = {SPACING}\n[fluid.oil]\ndensity = 900\nrheology = "newtonian"\n'
            f'dynamic_viscosity = {viscosity}\n[fluid.slag]\ndensity = 2700\n[[wall]]\nshapes = [{{shape = "box", min = [0, 0, 0]}}]\n')
        (folder / "history.csv").write_text(HISTORY)
        return folder

    def plot(self, *arguments):
        return subprocess.run([PROJECT / "scripts/plot", *map(str, arguments)], capture_output=True, text=True, check=False)

    def need_tools(self):
        if not tools_are_there():
            self.skipTest("pysplashsurf and PyVista are not installed")

    def colours(self, picture):
        """Pixels that are neither grey nor white, shape (pixels, 3)."""
        pixels = matplotlib.image.imread(picture)[:, :, :3]
        return pixels[np.ptp(pixels, axis=2) > 0.25]


class Surface(SurfaceCase):
    def test_is_drawn_first_and_has_the_colours_of_the_scale(self):
        self.need_tools()
        folder = self.make_run()
        done = self.plot(folder, "--times", "0.1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual([Path(p).name for p in done.stdout.split()], ["surface.png", "flow.png", "history.png"])
        seen = self.colours(folder / "pictures/surface.png")
        self.assertGreater(len(seen), 20000)
        yellow, violet = np.array([0.99, 0.91, 0.14]), np.array([0.28, 0.12, 0.44])  # the ends of the scale
        for end in (yellow, violet):
            self.assertLess(np.abs(seen - end).sum(axis=1).min(), 0.35)

    def test_encloses_the_volume_of_the_particles(self):
        self.need_tools()
        folder = self.make_run()
        code = (f"from pathlib import Path; from plotting import quantity, surface; import slagflow; "
                f"r = slagflow.open(Path({str(folder)!r})); m = surface.Meshes(r, quantity.Quantity(r, [1], 'speed')).fluid(1); "
                f"print(m.volume, *m.bounds, m.is_all_triangles, m['value'].max())")
        made = subprocess.run([PYTHON, "-c", code], cwd=PROJECT / "scripts", capture_output=True, text=True, check=True)
        words = made.stdout.split()
        edge = SIDE * SPACING
        self.assertAlmostEqual(float(words[0]) / edge**3, 1, delta=0.12)
        for k, wanted in enumerate((0, edge) * 3):
            self.assertAlmostEqual(float(words[1 + k]), wanted, delta=0.6 * SPACING)
        self.assertAlmostEqual(float(words[-1]), 100, delta=8)  # cm/s

    def test_runs_stand_side_by_side_on_one_scale(self):
        self.need_tools()
        slow, fast = self.make_run("slow", 2.0, 0.2), self.make_run("fast", 1.0, 1.0)
        done = self.plot(slow, fast, "--compare", "--times", "0.1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        picture = slow / "pictures/compare.png"
        self.assertEqual(done.stdout.split(), [str(picture)])
        pixels = matplotlib.image.imread(picture)[200:, :, :3]
        yellow = (pixels[:, :, 0] > 0.6) & (pixels[:, :, 2] < 0.35)
        half = pixels.shape[1] // 2
        self.assertEqual(yellow[:, :half].sum(), 0)
        self.assertGreater(yellow[:, half:].sum(), 500)

    def test_fluids_have_their_names(self):
        self.need_tools()
        folder = self.make_run()
        done = self.plot(folder, "--colour", "fluid", "--times", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        seen = self.colours(folder / "pictures/surface.png")
        self.assertGreater(((seen[:, 0] > seen[:, 2] + 0.2).sum()), 2000)  # red
        self.assertGreater(((seen[:, 2] > seen[:, 0] + 0.2).sum()), 2000)  # blue

    def test_a_quantity_that_was_not_written_is_an_error(self):
        self.need_tools()
        done = self.plot(self.make_run(), "--colour", "viscosity")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the run has not written what 'viscosity' needs", done.stderr)

    def test_without_the_tools_particles_are_drawn_and_it_is_told(self):
        folder = self.make_run()
        with mock.patch.object(PLOT, "TOP", self.folder), mock.patch.object(sys, "argv", ["plot", str(folder)]), \
                mock.patch("sys.stderr") as errors:
            self.assertEqual(PLOT.main(), 0)
        told = "".join(str(call.args[0]) for call in errors.write.call_args_list)
        self.assertIn("surface.png is not drawn: `scripts/install --pictures` brings what draws surfaces and makes reports", told)
        self.assertTrue((folder / "pictures/flow.png").is_file())

    def test_compare_needs_two_runs(self):
        folder = self.make_run()
        self.assertIn("--compare: allowed: two runs and more", self.plot(folder, "--compare").stderr)
        self.assertIn("several folders: allowed: with --compare", self.plot(folder, folder).stderr)

    def test_titles_are_the_keys_that_differ(self):
        runs = [slagflow.open(self.make_run(f"run{k}", viscosity=k + 1.0)) for k in range(2)]
        self.assertEqual(sheet.titles_of(runs), ["dynamic_viscosity = 1.0", "dynamic_viscosity = 2.0"])
        self.assertEqual([Path(t).name for t in sheet.titles_of([runs[0], runs[0]])], ["run0", "run0"])

    def test_without_times_runs_are_shown_at_those_of_the_first_to_end(self):
        runs = [types.SimpleNamespace(times=np.arange(n) / 10, typical_steps=lambda wanted, n=n: list(range(n - wanted, n))) for n in (9, 5)]
        np.testing.assert_allclose(sheet.times_of_all(runs), [0.2, 0.3, 0.4])

    def test_fluids_that_runs_call_otherwise_have_all_names(self):
        one, other = (slagflow.open(self.make_run(name)) for name in ("one", "other"))
        del one.case["fluid"]["slag"]
        other.case["fluid"] = {"metal": {}, "slag": {}}
        self.assertEqual(sheet.fluid_names([one, other]), ["oil/metal", "slag"])

    def test_slow_speeds_are_in_centimetres_and_the_caption_tells_the_fluids(self):
        run = slagflow.open(self.make_run(speed=0.2))
        quantity = Quantity(run, [1], "speed")
        self.assertAlmostEqual(quantity.limits[1], 0.2, delta=0.01)
        quantity.share((0, 0.2))
        self.assertEqual((quantity.label, quantity.factor, quantity.limits), ("speed  [cm/s]", 100, (0, 20)))
        quantity.share((0, 2.0))
        self.assertEqual((quantity.label, quantity.limits), ("speed  [m/s]", (0, 2.0)))
        self.assertEqual(sheet.caption(run), "oil: newtonian, 900 kg/m³, 1 Pa s; slag: 2700 kg/m³; spacing 10 mm")


class Walls(SurfaceCase):
    def test_distances_are_those_of_the_shapes(self):
        at = np.array([[0.0, 0, 0], [3, 0, 0], [0, 0, 3], [3, 0, 5]])
        box = {"shape": "box", "min": [-1, -1, -1], "max": [1, 1, 1]}
        cylinder = {"shape": "cylinder", "start": [0, 0, -2], "end": [0, 0, 2], "radius": 1}
        cone = {"shape": "frustum", "start": [0, 0, 0], "end": [0, 0, 4], "start_radius": 1, "end_radius": 0}
        prism = {"shape": "prism", "along": "y", "points": [[-1, -1], [1, -1], [1, 1], [0, 0.5], [-1, 1]], "from": -4, "to": 4}
        for shape, wanted in ((box, [-1, 2, 2, np.hypot(2, 4)]), (cylinder, [-1, 2, 1, 3]),
                              ({"shape": "sphere", "center": [0, 0, 0], "radius": 2}, [-2, 1, 1, np.sqrt(34) - 2]),
                              ({"shape": "plane", "point": [0, 0, 1], "normal": [0, 0, 2]}, [-1, -1, 2, 4])):
            np.testing.assert_allclose(walls.distance({"shapes": [shape]}, at), wanted, atol=1e-12)
        edge = np.array([[0.5, 0, 2.0], [0.25, 0.0, 3.0], [0.5, 0, 1]])
        np.testing.assert_allclose(walls.distance({"shapes": [cone]}, edge)[:2], 0, atol=1e-12)
        np.testing.assert_allclose(walls.distance({"shapes": [prism]}, np.array([[0, 0, 0.5], [1, 1, 0], [0, 0, 0]])), [0, 0, -0.5], atol=1e-12)

    def test_shapes_are_turned_taken_away_and_turned_inside_out(self):
        beam = {"shape": "box", "min": [0, -1, -1], "max": [10, 1, 1], "translate": [1, 0, 0], "rotate": [0, 0, np.pi / 2]}
        at = np.array([[0.0, 5, 0], [0, 0, 0], [5, 0, 0]])
        np.testing.assert_allclose(walls.distance({"shapes": [beam]}, at), [-1, 1, np.hypot(4, 1)], atol=1e-12)
        hole = {"shape": "sphere", "center": [0, 5, 0], "radius": 0.5}
        np.testing.assert_allclose(walls.distance({"shapes": [beam], "subtract": [hole]}, at)[:1], 0.5, atol=1e-12)
        np.testing.assert_allclose(walls.distance({"shapes": [beam | {"outside": True}]}, at), [1, -1, -np.hypot(4, 1)], atol=1e-12)
        with self.assertRaises(walls.UnknownShape):
            walls.distance({"shapes": [{"shape": "torus"}]}, at)

    def test_the_pose_is_that_of_the_particles(self):
        start = np.random.default_rng(1).random((20, 3))
        turn, shift = walls.rotation([0.3, -1.2, 2.0]), np.array([1, 2, 3.0])
        found = walls.pose(start, start @ turn.T + shift)
        np.testing.assert_allclose(found[0], turn, atol=1e-12)
        np.testing.assert_allclose(found[1], shift, atol=1e-12)

    def test_meshes_have_the_size_of_the_shapes(self):
        self.need_tools()
        code = """
import numpy as np, pyvista
from plotting import walls
view = np.array([[-1, -1, -1], [1.0, 1, 1]])
two = [{"shape": "box", "min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0.25]}, {"shape": "box", "min": [-0.5, -0.5, -3], "max": [0.5, 0.5, 0]}]
made = walls.contoured({"shapes": two}, view, 0.1, pyvista)
print(made.volume, *made.bounds)
sheet = pyvista.Plane(center=(0, 0, 0), direction=(0, 0, 1), i_size=2, j_size=1, i_resolution=4, j_resolution=2).triangulate()
for side in ("back", "front", "middle"):
    made = walls.plate(sheet, 0.2, side, pyvista)
    print(made.is_manifold, abs(made.compute_normals(auto_orient_normals=True).volume), *made.bounds[4:])
"""
        said = subprocess.run([PYTHON, "-c", code], cwd=PROJECT / "scripts", capture_output=True, text=True, check=True).stdout.splitlines()
        volume, *bounds = map(float, said[0].split())
        self.assertAlmostEqual(volume, 1.25, delta=0.003)  # cut at the view's edge, one piece of two that touch
        np.testing.assert_allclose(bounds, [-0.5, 0.5, -0.5, 0.5, -1, 0.25], atol=1e-5)
        for line, bounds in zip(said[1:], ([-0.2, 0], [0, 0.2], [-0.1, 0.1])):
            closed, volume, *found = line.split()
            self.assertEqual(closed, "True")
            self.assertAlmostEqual(float(volume), 0.4, delta=1e-5)
            np.testing.assert_allclose(np.array(found, float), bounds, atol=1e-6)

    def test_a_wall_before_the_fluid_is_a_veil_and_one_behind_hides_nothing(self):
        self.need_tools()
        folder = self.make_run()
        case = (folder / "case.toml").read_text()
        edge = SIDE * SPACING
        with h5py.File(folder / "walls.vtkhdf", "a") as file:
            file["VTKHDF/PointData/Wall"] = np.zeros(file["VTKHDF/NumberOfPoints"][0], np.uint8)
        seen = {}
        for name, low, high in (("before", [edge + 0.01, -1, -1], [1, 1, 1]), ("behind", [-1, -1, -1], [-0.01, 1, 1])):
            (folder / "case.toml").write_text(case.replace("min = [0, 0, 0]", f"min = {low}, max = {high}"))
            self.assertEqual(self.plot(folder, "--times", "0.1").returncode, 0)
            pixels = matplotlib.image.imread(folder / "pictures/surface.png")[200:, :, :3]
            spread = np.ptp(pixels, axis=2)
            seen[name] = [int((spread > limit).sum()) for limit in (0.12, 0.6)]  # coloured at all, and fully
        self.assertGreater(seen["before"][0], 0.8 * seen["behind"][0])
        self.assertGreater(seen["behind"][1], 5 * max(seen["before"][1], 500))


class Colours(SurfaceCase):
    def test_residence_is_the_time_since_a_number_was_new(self):
        times, newest = np.array([0.0, 1.0, 2.0]), np.array([9, 19, 39])
        np.testing.assert_allclose(ages(np.array([0, 9, 19, 29, 39]), times, newest, 2), [2, 2, 1, 0.5, 0])

    def test_temperature_is_in_degrees_celsius(self):
        folder = self.make_run()
        with h5py.File(folder / "particles.vtkhdf", "a") as file:
            file["VTKHDF/PointData/Temperature"] = np.linspace(1573.15, 1673.15, 2 * SIDE**3)
        quantity = Quantity(slagflow.open(folder), [0, 1], "temperature")
        quantity.share(quantity.limits)
        self.assertEqual(quantity.label, "temperature  [°C]")
        np.testing.assert_allclose(quantity.limits, [1300, 1400], atol=0.5)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
