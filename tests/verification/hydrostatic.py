"""An oil at rest in a tank: pressure, and no motion."""

import numpy as np

from verification.suite import Row, Run, bound_row, percent

NAME = "hydrostatic"
TITLE = "tank at rest, pressure"


def runs(quick):
    return [Run("hydrostatic", "/hydrostatic_tank", "16 deep", {"output.end_time": 0.2 if quick else 1})]


def pressure(result, state):
    """Measured and exact [Pa]; the surface lies where the volume says."""
    depth = np.max(result.state(0).position[:, 2]) + 0.5 * result.spacing
    return state.pressure, result.fluid()["density"] * 9.81 * (depth - state.position[:, 2]), depth


def rows(results):
    (result,) = results
    state = result.state()
    measured, exact, depth = pressure(result, state)
    error = np.sqrt(np.mean((measured - exact)**2)) / (result.fluid()["density"] * 9.81 * depth)
    speed = np.sqrt(np.mean(np.sum(state.velocity**2, axis=1)))
    return [Row(result.resolution, "pressure, rms error / ρgH", "profile", "profile", percent(error), "3 %", bool(error < 0.03)),
            bound_row(result.resolution, "rms speed [m/s]", speed, (None, 6e-4))]


def draw(axes, results):
    (result,) = results
    state = result.state()
    measured, exact, _ = pressure(result, state)
    axes.plot(measured, 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(exact, 1e3 * state.position[:, 2], color="#d1652a", linewidth=0.7)
    axes.set(xlabel="p [Pa]", ylabel="z [mm]")
