"""Tests of scripts/smoothing. With a test's name as argument only that one is run."""

import importlib.machinery
import importlib.util
import math
import subprocess
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
try:
    import numpy as np
    LOADER = importlib.machinery.SourceFileLoader("smoothing", str(PROJECT / "scripts" / "smoothing"))
    smoothing = importlib.util.module_from_spec(importlib.util.spec_from_loader("smoothing", LOADER))
    LOADER.exec_module(smoothing)
except ImportError:
    np = None

LEVEL = {3: 0.0149, 5: 0.1973, 7: 0.3938, 9: 0.3312, 12: 0.0627}
WEIGHT = {2: 0.0155, 4: 0.1471, 5: 0.2673, 7: 0.0897, 8: 0.4804}


def transform_of_power(n, x, dimensions):
    """Closed form for t^n, x = k h: the series of Gamma(v + 1) (2/x)^v J_v(x), v = n + d/2."""
    order, total, term = n + dimensions / 2, 0.0, 1.0
    for m in range(1, 80):
        total += term
        term *= -(x / 2)**2 / (m * (m + order))
    return total


@unittest.skipIf(np is None, "no NumPy; scripts/install brings it")
class Smoothing(unittest.TestCase):
    def functions(self):
        return [*smoothing.named_functions(), smoothing.level(LEVEL)]

    def lucy(self):
        return smoothing.named_functions()[0]

    def sums(self, function, lattice, ratio=2.6):
        return smoothing.Sums(function, ratio, lattice.points(ratio))

    def test_normalisations_are_those_of_the_literature(self):
        lucy, c2, c4, quintic = smoothing.named_functions()
        pi = math.pi
        for function, plane, space in ((lucy, 5 / pi, 105 / (16 * pi)), (c2, 7 / pi, 21 / (2 * pi)),
                                       (c4, 3 / pi, 165 / (32 * pi)), (quintic, 63 / (478 * pi), 27 / (120 * pi))):
            self.assertAlmostEqual(function.normalisation(2) / plane, 1, 12, function.name)
            self.assertAlmostEqual(function.normalisation(3) / space, 1, 12, function.name)

    def test_the_integral_of_each_is_one(self):
        radius = (np.arange(4000) + 0.5) / 4000  # midpoints: the error is below 1e-7
        for function in self.functions():
            for d, measure in ((2, 2 * math.pi * radius), (3, 4 * math.pi * radius**2)):
                integral = function.normalisation(d) * (function.value(radius) * measure).mean()
                self.assertAlmostEqual(integral, 1, 6, function.name)

    def test_gradients_are_the_slopes_of_the_values(self):
        q, step = np.linspace(0.05, 0.95, 37), 1e-4
        for function in self.functions():
            size = function.value(np.zeros(1))[0]
            slope = (function.value(q + step) - function.value(q - step)) / (2 * step)
            np.testing.assert_allclose(function.gradient(q) * q, slope, atol=1e-5 * size)
            slope = (function.gradient(q + step) - function.gradient(q - step)) / (2 * step)
            np.testing.assert_allclose(function.gradient_slope(q) * q, slope, atol=1e-4 * size)

    def test_transform_is_the_closed_form(self):
        for n in (3, 6, 12):
            function = smoothing.level({n: 2.0})
            for d in (2, 3):
                for k in (0.5, math.pi, 6.0, 12.0):
                    self.assertAlmostEqual(float(function.transform([k], 2.6, d)[0]),
                                           transform_of_power(n, 2.6 * k, d), 8)

    def test_the_table_of_lucy(self):
        lucy = self.lucy()
        square, diagonal, hexagonal, cubic, cube_diagonal = smoothing.stiffnesses(lucy, 2.6)
        for found, known in ((square, 0.0526), (diagonal, 0.1475), (hexagonal, 0.0091), (cubic, 0.0727),
                             (cube_diagonal, 0.1824)):
            self.assertAlmostEqual(found, known, 4)
        for lattice, known in zip(smoothing.LATTICES, (0.00755, 0.00214, 0.00667, 0.00464, 0.00540)):
            self.assertLess(abs(smoothing.friction(lucy, 2.6, lattice) - known), 2.5e-5, lattice.name)
        self.assertAlmostEqual(float(lucy.transform([math.pi], 2.6, 2)[0]), 0.018, 3)
        self.assertAlmostEqual(smoothing.most_negative(lucy, 2.6), -0.0017, 4)
        for found, known in zip(smoothing.viscosity_ratios(lucy, 2.6, "gradient"),
                                (0.905, 1.107, 1.023, 0.927, 1.080, 0.977)):
            self.assertAlmostEqual(found, known, 3)

    def test_stress_is_the_slope_of_the_filling(self):
        points, step = smoothing.SQUARE.points(8), 1e-5

        def filling(gamma):
            return smoothing.Sums(self.lucy(), 2.6, points @ smoothing.SQUARE.shear(gamma).T).filling()

        sheared = smoothing.Sums(self.lucy(), 2.6, points @ smoothing.SQUARE.shear(0.2).T)
        stress = sheared.stress(smoothing.SQUARE.row, smoothing.SQUARE.normal)
        self.assertAlmostEqual(stress, (filling(0.2 + step) - filling(0.2 - step)) / (2 * step), 7)

    def test_a_lattice_is_itself_again_after_a_period(self):
        for lattice in smoothing.LATTICES:
            points = lattice.points(8)
            at_rest = smoothing.Sums(self.lucy(), 2.6, points).filling()
            sheared = smoothing.Sums(self.lucy(), 2.6, points @ lattice.shear(lattice.period).T).filling()
            self.assertAlmostEqual(sheared, at_rest, 10, lattice.name)

    def test_non_negative_least_squares_meets_its_conditions(self):
        numbers, x = np.random.default_rng(1), np.linspace(0, 1, 40)
        matrix = np.stack([x**k for k in range(9)], axis=1)  # nearly dependent: what enters has to leave again
        for _ in range(20):
            target = matrix @ numbers.normal(size=9) + numbers.normal(size=40)
            found = smoothing.non_negative_least_squares(matrix, target)
            pull = matrix.T @ (target - matrix @ found)
            self.assertTrue((found >= 0).all())
            np.testing.assert_allclose(pull[found > 0], 0, atol=1e-8)
            self.assertLess(pull[found == 0].max(), 1e-8)

    def test_the_fit_has_next_to_no_friction_and_a_right_pressure(self):
        for ratio in (2.6, 3.0):  # one set of coefficients for both
            function = smoothing.level(LEVEL)
            for lattice in smoothing.LATTICES:
                self.assertLess(smoothing.friction(function, ratio, lattice), 5e-4, lattice.name)  # Lucy: 0.002 to 0.008
                self.assertAlmostEqual(self.sums(function, lattice, ratio).gradient(lattice.row), 1, delta=1.5e-3)
            self.assertGreater(smoothing.most_negative(function, ratio), -3e-5)  # no pairs; Lucy: -0.002

    def test_lattices_of_the_start_stay_put_and_have_the_right_viscosity(self):
        square, diagonal, hexagonal, cube, cube_diagonal = smoothing.stiffnesses(smoothing.level(LEVEL), 2.6)
        self.assertGreater(min(square, diagonal, cube, cube_diagonal), 0)
        self.assertGreater(hexagonal, -1e-3)  # does not stay put, but hardly moves
        for weight in (WEIGHT, smoothing.fit_weight(2.6)):
            for ratio in smoothing.viscosity_ratios(smoothing.level(weight), 2.6, "value"):
                self.assertAlmostEqual(ratio, 1, delta=0.003)  # weight -F/r^2: 0.79 to 1.23

    def test_the_fit_gives_the_coefficients_in_use(self):
        fitted = smoothing.fit(2.6)
        self.assertEqual(list(fitted), list(LEVEL))
        for k, a in LEVEL.items():
            self.assertAlmostEqual(fitted[k], a, delta=6e-4)  # those in use were fitted without the stiffness

    def test_no_coefficients_nearby_do_better(self):
        k, best = np.linspace(smoothing.BAND, 16, 121), smoothing.fit(2.6)

        def misfit(coefficients):
            function = smoothing.level(coefficients)
            return sum((k**3 * function.transform(k, 2.6, d)**2).sum() for d in (2, 3))

        for power in best:
            for change in (-0.01, 0.01):
                other = {**best, power: best[power] + change}
                stiffness = smoothing.stiffnesses(smoothing.level(other), 2.6)[1]
                self.assertTrue(misfit(other) > misfit(best) or stiffness < smoothing.LEAST_STIFFNESS, power)

    def test_prints_coefficients_and_refuses_other_ratios(self):
        script = [sys.executable, PROJECT / "scripts" / "smoothing", "--fit-only"]
        done = subprocess.run(script, capture_output=True, text=True)
        for k, a in smoothing.fit(2.6).items():
            self.assertIn(f"a{k} = {a:.4f}", done.stdout)
        refused = subprocess.run([*script, "--ratio", "5"], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--ratio must lie between 1.5 and 4", refused.stderr)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
