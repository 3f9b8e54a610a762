"""A Newtonian block that spreads, against Huppert's front."""

import numpy as np

from verification.closed_forms import huppert, huppert_reach
from verification.suite import Run, length_row

NAME = "gravity_current"
TITLE = "plane gravity current, Huppert"
SIDE = 0.02  # [m] height, and width of one half


def runs(quick):
    if quick:
        return [Run("gravity_current_20", "gravity_current", "20 high", {"output.end_time": 3})]
    return [Run(f"gravity_current_{n}", "gravity_current", f"{n} high",
                {"resolution.spacing": SIDE / n, "output.end_time": 5}) for n in (20, 40)]


def reach(result, state):
    x = state.position[:, 0]
    return 0.5 * (np.max(x) - np.min(x)) + 0.5 * result.spacing


def exact(result, time):
    return huppert(time, SIDE**2, result.fluid()["dynamic_viscosity"] / result.fluid()["density"], 9.81)


def rows(results):
    table = []
    for result in results:
        state = result.state()
        table.append(length_row(result.resolution, f"front after {state.time:.0f} s [m]",
                                (reach(result, state), exact(result, state.time)), (0.05, result.spacing)))
        near = np.quantile(np.abs(state.position[:, 0]), 0.99) + 0.5 * result.spacing
        table.append(length_row(result.resolution, "the same, without the last hundredth [m]",
                                (near, huppert_reach(0.99) * exact(result, state.time)), (0.05, result.spacing)))
    return table


def draw(axes, results):
    for result in results:
        states = result.states()[1:]
        axes.loglog([s.time for s in states], [1e3 * reach(result, s) for s in states], ".", label=result.resolution)
    times = results[-1].times[1:]
    axes.loglog(times, 1e3 * exact(results[-1], times), color="#d1652a")
    axes.set(xlabel="t [s]", ylabel="front [mm]")
    axes.legend(fontsize="x-small")
