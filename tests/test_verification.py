"""Tests of the verification suite itself: closed forms against figures worked out elsewhere, verdicts, the table.
With a test's name as argument only that one is run."""

import sys
import tempfile
import unittest
from pathlib import Path

try:
    import matplotlib  # noqa: F401
    import numpy as np
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit(77)

PROJECT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(PROJECT / "tests"), str(PROJECT / "scripts")]
from verification import closed_forms, comparisons, heat_forms, report  # noqa: E402
from verification.suite import bound_row, length_row, profile_row, relative_row  # noqa: E402

SLAG = closed_forms.Papanastasiou(2.25, 2.3, 1e4)


class Verification(unittest.TestCase):
    def test_poiseuille_starts_up_as_tabulated(self):
        gap, drive, nu = 0.02, 0.5, 0.324 / 970  # oil B
        for unit, part in ((0.01, 0.079992), (0.05, 0.370386), (0.2, 0.856637), (1, 0.999947)):
            middle = closed_forms.poiseuille(gap / 2, unit * gap**2 / nu, gap, drive, nu)
            self.assertAlmostEqual(middle / 0.0748457, part, places=5)

    def test_couette_starts_at_rest_and_ends_straight(self):
        z = np.linspace(0.05, 0.85, 9)
        np.testing.assert_allclose(closed_forms.couette(z, 100, 1, 2, 1), 2 * z, rtol=1e-12)
        np.testing.assert_allclose(closed_forms.couette(z, 1e-4, 1, 2, 1), 0, atol=1e-9)

    def test_bingham_plug_moves_as_tabulated(self):
        y = np.linspace(-0.01, 0.01, 20001)
        u = SLAG.plane_velocity(y, 0.01, 1150)
        self.assertAlmostEqual(np.max(u), 0.0163557558, places=9)
        self.assertAlmostEqual(np.mean(u) * 0.02 / 2.398815e-4, 1, places=4)

    def test_pipe_carries_what_buckingham_and_reiner_say(self):
        r = np.linspace(0, 0.01, 20001)
        flow = np.trapz(2 * np.pi * r * SLAG.pipe_velocity(r, 0.01, 1150), r)
        self.assertAlmostEqual(flow / closed_forms.buckingham_reiner(0.01, 1150, 2.25, 2.3), 1, places=3)

    def test_cylinders_need_the_tabulated_torque(self):
        cylinders = (4.37e-3, 6.35e-3)
        speed = 0.596811726 / 2 * (1 - (cylinders[0] / cylinders[1])**2)
        paste = closed_forms.Papanastasiou(0.8, 5, 1e6)
        u, torque = paste.couette_velocity(np.array(cylinders), cylinders, speed)
        self.assertAlmostEqual(torque / 0.000810783284, 1, places=5)
        np.testing.assert_allclose(u, [speed * cylinders[0], 0], atol=1e-12)

    def test_cylinders_without_yield_stress_are_newtonian(self):
        r, cylinders = np.linspace(0.01, 0.02, 11), (0.01, 0.02)
        u = closed_forms.Papanastasiou(0.5, 0, 1000).couette_velocity(r, cylinders, 10)[0]
        np.testing.assert_allclose(u, closed_forms.newtonian_couette_velocity(r, cylinders, 10), atol=1e-9)

    def test_slump_at_rest_holds_its_area(self):
        run_out = closed_forms.arrested_slump(1, 0.1)
        self.assertAlmostEqual(run_out, 1.7964, places=4)
        x = np.linspace(0, run_out, 200001)
        height = closed_forms.slump_height(x, run_out, 0.1)
        self.assertAlmostEqual(np.trapz(height, x), 1, places=6)
        near = x <= closed_forms.slump_reach(0.99, run_out, 0.1)
        self.assertAlmostEqual(np.trapz(height[near], x[near]), 0.99, places=4)

    def test_current_without_its_last_hundredth(self):
        x = np.linspace(0, closed_forms.huppert_reach(0.99), 200001)
        self.assertAlmostEqual(np.trapz((1 - x**2)**(1 / 3), x) / 0.841309, 0.99, places=4)

    def test_surface_waves_are_lambs_and_creep_when_thick(self):
        k = 2 * np.pi / 0.1
        thin = closed_forms.surface_wave(1j * np.sqrt(9.81 * k), k, 10, 1e-8)
        self.assertAlmostEqual(thin.imag / np.sqrt(9.81 * k), 1, places=6)
        self.assertAlmostEqual(thin.real / (-2e-8 * k**2), 1, places=2)
        thick = closed_forms.creeping_wave_rate(k, 0.05, 10)
        self.assertAlmostEqual(closed_forms.surface_wave(-thick, k, 0.05, 10).real / -thick, 1, places=4)
        self.assertAlmostEqual(closed_forms.creeping_wave_rate(k, 1, 10) / (9.81 / (20 * k)), 1, places=9)

    def test_verdicts_follow_the_targets(self):
        wave = np.sin(np.arange(9.0))
        self.assertTrue(profile_row("", "", 1.01 * wave, wave, 0.0101).passed)
        self.assertFalse(profile_row("", "", 1.01 * wave, wave, 0.0099).passed)
        self.assertIsNone(profile_row("", "", wave, wave).passed)
        self.assertFalse(relative_row("", "", 0.97, 1.0, 0.02).passed)
        self.assertTrue(length_row("", "", (1.7, 1.6), (0.05, 0.021)).passed)
        self.assertFalse(length_row("", "", (1.7, 1.6), (0.05, 0.019)).passed)
        self.assertFalse(bound_row("", "", 1.8, (1.9, None)).passed)
        self.assertFalse(bound_row("", "", float("nan"), (None, 1)).passed)

    def test_every_flow_has_cases_that_are_there(self):
        for flow in comparisons():
            self.assertTrue(flow.TITLE)
            for quick in (True, False):
                for run in flow.runs(quick):
                    stem = run.case[1:] if run.case.startswith("/") else f"verification/{run.case}"
                    self.assertTrue((PROJECT / "cases" / f"{stem}.toml").is_file(), run.case)

    def test_page_has_the_marks_once_and_the_table_between_them(self):
        text = report.PAGE.read_text()
        self.assertEqual((text.count(report.BEGIN), text.count(report.END)), (1, 1))
        table = text.split(report.BEGIN)[1].split(report.END)[0]
        self.assertTrue(table.startswith("\n| flow | resolution |"))
        self.assertIn("| `poiseuille` |", table)

    def test_readme_takes_the_table_between_its_marks(self):
        class Outcome:
            name, causes = "flow", {"20: depth": "too coarse"}
            rows = [relative_row("20", "depth", 1.2, 1.0, 0.02), relative_row("20", "speed", 1.0, 1.0, 0.02)]

            def missed(self):
                return self.rows[:1]

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "README.md"
            path.write_text(f"before\n{report.BEGIN}\nold\n{report.END}\nafter\n")
            report.write_readme([Outcome()], path)
            text = path.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("after\n"))
        self.assertNotIn("old", text)
        self.assertIn("| `flow` | 20 | depth | 1.2 | 1 | 20.00 % | 2 % | **missed** |", text)
        self.assertIn("- flow: too coarse", text)


class HeatForms(unittest.TestCase):
    """Against figures worked out elsewhere: series of Carslaw and Jaeger (1959), finite volumes of 400 cells."""

    def test_slabs(self):
        self.assertAlmostEqual(float(heat_forms.slab_between_walls(np.array([0.2]), 0.05)[0]), 0.46164652, places=7)
        self.assertAlmostEqual(heat_forms.slab_with_convection_mean(1, 0.5), 0.68110457, places=7)
        self.assertAlmostEqual(float(heat_forms.slab_with_convection(np.array([1.0]), 1, 0.5)[0]), 0.50452193, places=6)

    def test_neumann(self):
        problem = heat_forms.Neumann((1.6, 1050, 2800), (0.8, 1300, 2800), (373.15, 1623.15, 1723.15), 2.1e5)
        self.assertAlmostEqual(problem.root, 0.96803218, places=6)
        # Latent heat over less and less is that at one temperature.
        material = heat_forms.Material([(1623.1, 1050), (1623.2, 1300)], [(1623.1, 1.6), (1623.2, 0.8)],
                                       [(1623.15 - 0.5, 1), (1623.15, 0)], 2.1e5)
        spread = heat_forms.Freezing(material, 2800, 373.15, 1723.15)
        self.assertAlmostEqual(spread.heat(100) / problem.heat(100), 1, places=4)
        self.assertAlmostEqual(spread.front(1622.9, 100) / problem.front(100), 1, places=3)

    def test_a_flux(self):
        # Carslaw and Jaeger 1959, 2.9: at the surface 2 sqrt(alpha t/pi); below, 2 sqrt(alpha t) ierfc(x/2 sqrt(alpha t)).
        self.assertAlmostEqual(float(heat_forms.half_space_with_flux(0.0, 4, 1)), 4 / np.sqrt(np.pi), places=12)
        self.assertAlmostEqual(float(heat_forms.half_space_with_flux(2.0, 1, 1)), 2 * 0.0502545, places=6)

    def test_a_channel_with_yield(self):
        y = np.linspace(0, 0.02, 4001)
        u = heat_forms.poiseuille_with_yield(y, np.full_like(y, 2.0), np.full_like(y, 10.0), 4000)
        self.assertAlmostEqual(float(u[2000]) / (4000 / (2 * 2.0) * (0.01 - 10 / 4000) ** 2), 1, places=5)

    def test_friction(self):
        stress, warming = heat_forms.couette_with_friction(8)
        self.assertAlmostEqual(stress, 0.62322524, places=7)
        self.assertAlmostEqual(warming, 0.69314718, places=7)

    def test_a_radiating_sheet(self):
        material = heat_forms.Material([(300, 1300), (2000, 1300)], [(300, 1), (2000, 1)])
        loss = heat_forms.surface_loss(material, 0.9, 10, 300)
        half = heat_forms.Slab(0.005, 100, 2800, material).run(1673, 5, 2e-3, lambda *_: 0.0, loss)
        self.assertAlmostEqual(half.lost_above / 1.19832e6, 1, places=2)


if __name__ == "__main__":
    unittest.main()
