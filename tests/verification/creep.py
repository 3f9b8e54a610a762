"""Below its yield stress a regularised fluid creeps and one with an exact yield stress rests: Bingham slag between
plates."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, bound_row, relative_row

NAME = "creep"
TITLE = "creep below yield, slag"
HALF_GAP, ACROSS = 0.01, 20


def runs(quick):
    n, gap = ACROSS, 2 * HALF_GAP
    side = 8 * gap / n
    keys = {"resolution.spacing": gap / n, "region.0.shapes.0.max": [side, side, gap],
            "domain.max": [side, side, 1.2 * gap], "domain.min": [0, 0, -0.2 * gap],
            "body_force.acceleration": [0.8 * 2.3 / 2600 / HALF_GAP, 0, 0], "output.end_time": 0.1, "output.interval": 0.1}
    regularised = [Run(f"creep_{m:g}", "bingham_poiseuille", f"{n} across, m {m:g} s",
                       {**keys, "fluid.slag.growth_exponent": m}) for m in ((1000,) if quick else (100, 1000, 10000))]
    return [*regularised, Run("creep_exact", "bingham_poiseuille", f"{n} across, yield exact",
                              # What is left is the error that the solve may make: it scales with the tolerance.
                              {**keys, "numerics.yield": "exact", "numerics.tolerance": 0.001})]


def exact(result, z):
    drive = result.case["body_force"]["acceleration"][0] * result.fluid()["density"]
    return Papanastasiou.of(result.fluid()).plane_velocity(z - HALF_GAP, HALF_GAP, drive)


def rows(results):
    *regularised, rigid = results
    fastest = lambda result: np.max(np.abs(result.state().velocity[:, 0]))
    return [*(relative_row(result.resolution, "fastest creep, wall stress 0.8 τ_B [m/s]", fastest(result),
                           float(exact(result, np.array([HALF_GAP]))[0]), 0.1) for result in regularised),
            bound_row(rigid.resolution, "fastest creep, wall stress 0.8 τ_B [m/s]", fastest(rigid), (None, 1e-9))]


def draw(axes, results):
    z = np.linspace(0, 2 * HALF_GAP, 200)
    for result in results[:-1]:
        state = result.state()
        axes.semilogx(state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
        axes.semilogx(exact(result, z)[1:-1], 1e3 * z[1:-1], color="#d1652a")
    axes.set(xlabel="u [m/s]", ylabel="z [mm]")
