"""Oil and Bingham slurry at rest in a tank: pressure, and no motion. The slurry and one tank of oil have the sound speed
that is chosen by itself."""

import numpy as np

from verification.suite import Row, Run, bound_row, limit, percent, verdict

NAME = "hydrostatic"
TITLE = "tank at rest, pressure"
SPEEDS = {"newtonian": 1.2e-4, "bingham": 1e-6}  # rms, that are allowed [m/s]


def runs(quick):
    end = {"output.end_time": 0.2} if quick else {}
    auto = {"numerics.sound_speed": "auto"}
    return [Run("hydrostatic", "/hydrostatic_tank", "16 deep", end),
            Run("hydrostatic_auto", "/hydrostatic_tank", "16 deep, sound speed auto", {**end, **auto}),
            Run("hydrostatic_bingham", "/hydrostatic_bingham", "16 deep, Bingham", {**end, **auto})]


def pressure(result, state):
    """Measured and exact [Pa]; the surface lies where the volume says."""
    depth = np.max(result.state(0).position[:, 2]) + 0.5 * result.spacing
    return state.pressure, result.fluid()["density"] * 9.81 * (depth - state.position[:, 2]), depth


def rows(results):
    table = []
    for result in results:
        state = result.state()
        measured, exact, depth = pressure(result, state)
        error = np.sqrt(np.mean((measured - exact)**2)) / (result.fluid()["density"] * 9.81 * depth)
        speed = np.sqrt(np.mean(np.sum(state.velocity**2, axis=1)))
        rheology = result.fluid()["rheology"]
        target = 0.005 if rheology == "newtonian" else None
        table += [Row(result.resolution, "pressure, rms error / ρgH", "profile", "profile", percent(error), limit(target),
                      verdict(error, target)),
                  bound_row(result.resolution, "rms speed [m/s]", speed, (None, SPEEDS[rheology]))]
    return table


def draw(axes, results):
    result = results[0]
    state = result.state()
    measured, exact, _ = pressure(result, state)
    axes.plot(measured, 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(exact, 1e3 * state.position[:, 2], color="#d1652a", linewidth=0.7)
    axes.set(xlabel="p [Pa]", ylabel="z [mm]")
