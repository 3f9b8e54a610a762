"""Plane Bingham dam break, creeping: Valette's run-out over time, and the slope of a slump at rest."""

import numpy as np

from verification.closed_forms import arrested_slump, slump_height, slump_reach
from verification.suite import Run, length_row, relative_row

NAME = "slump"
TITLE = "slump, τ_B = 0.1 ρgH"
SIDE = 0.02  # [m] height, and width of one half
RUN_OUT = {28: 1.57, 51: 1.65, 94: 1.69, 179: 1.74}  # Valette et al. 2021: t (rho g H - tau)/eta -> x/H


def runs(quick):
    if quick:
        return [Run("slump_20", "slump", "20 high", {"output.end_time": 5.4})]
    # The steps are small and the iterations few, so that the plainer solver takes half the time; near rest, 40
    # high, it once asked for more than its 200.
    return [Run(f"slump_{n}", "slump", f"{n} high", {"resolution.spacing": SIDE / n,
                                                     "numerics.solver": "conjugate_gradient",
                                                     "numerics.max_iterations": 2000}) for n in (20, 40)]


def unit_of_time(result):
    fluid = result.fluid()
    return fluid["plastic_viscosity"] / (fluid["density"] * 9.81 * SIDE - fluid["yield_stress"])


def reach(result, state):
    """Of the outermost particle and its half spacing, mean of both sides [m]."""
    x = state.position[:, 0]
    return 0.5 * (np.max(x) - np.min(x)) + 0.5 * result.spacing


def rows(results):
    table = []
    for result in results:
        end = result.times[-1] / unit_of_time(result)
        for time, run_out in RUN_OUT.items():
            if time > 1.02 * end:
                continue
            state = result.state(time * unit_of_time(result))
            table.append(length_row(result.resolution, f"run-out after {time} η/(ρgH − τ_B) [H]",
                                    (reach(result, state) / SIDE, run_out), (0.05, result.spacing / SIDE)))
        if end < 170:
            continue
        state, stress_length = result.state(), result.fluid()["yield_stress"] / (result.fluid()["density"] * 9.81)
        exact = arrested_slump(SIDE**2, stress_length)
        table.append(length_row(result.resolution, "run-out of the slump at rest [H]",
                                (reach(result, state) / SIDE, exact / SIDE), (0.05, result.spacing / SIDE)))
        reach_99 = np.quantile(np.abs(state.position[:, 0]), 0.99) + 0.5 * result.spacing
        table.append(length_row(result.resolution, "the same, without the last hundredth [H]",
                                (reach_99 / SIDE, slump_reach(0.99, exact, stress_length) / SIDE),
                                (0.05, result.spacing / SIDE)))
        table.append(relative_row(result.resolution, "thickness in the middle, at rest [m]",
                                  np.max(state.position[:, 2]) + 0.5 * result.spacing,
                                  float(slump_height(0, exact, stress_length)), 0.05))
    return table


def draw(axes, results):
    result = results[-1]
    state = result.state()
    axes.plot(1e3 * state.position[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=0.6)
    stress_length = result.fluid()["yield_stress"] / (result.fluid()["density"] * 9.81)
    run_out = arrested_slump(SIDE**2, stress_length)
    x = np.linspace(-run_out, run_out, 400)
    axes.plot(1e3 * x, 1e3 * slump_height(np.abs(x), run_out, stress_length), color="#d1652a")
    axes.set(xlabel="x [mm]", ylabel="z [mm]")
