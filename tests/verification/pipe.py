"""A Bingham fluid through a pipe, against the regularised profile and Buckingham and Reiner's flow rate."""

import numpy as np

from verification.closed_forms import Papanastasiou, buckingham_reiner
from verification.suite import Run, profile_row, relative_row

NAME = "pipe"
TITLE = "pipe, slag"
RADIUS = 0.01  # [m]
MISSES = {
    "20 across, Bingham: velocity": "resolution: fluid lies on its sites from 0.02 spacings off the round wall on; 0.8 % at 40 across",
    "20 across, Bingham: speed in the middle [m/s]": "the same: 0.9 % at 40 across",
}


def runs(quick):
    return [Run("pipe_newtonian", "pipe", "20 across, Newtonian", {"fluid.slag.yield_stress": 0}),
            Run("pipe", "pipe", "20 across, Bingham")]


def gradient(result):
    return result.case["body_force"]["acceleration"][0] * result.fluid()["density"]  # [Pa/m]


def radius(state):
    return np.hypot(state.position[:, 1], state.position[:, 2])


def exact(result, r):
    return Papanastasiou.of(result.fluid()).pipe_velocity(r, RADIUS, gradient(result))


def rows(results):
    return [row for result in results for row in rows_of(result)]


def rows_of(result):
    state, fluid = result.state(), result.fluid()
    r, u = radius(state), state.velocity[:, 0]
    length = result.case["domain"]["max"][0] - result.case["domain"]["min"][0]
    mean = np.sum(u) * result.spacing**3 / length
    return [
        profile_row(result.resolution, "velocity", u, exact(result, r), 0.03),
        relative_row(result.resolution, "speed in the middle [m/s]", np.mean(u[r < 0.2 * RADIUS]),
                     float(exact(result, np.zeros(1))[0]), 0.03),
        relative_row(result.resolution, "flow rate [m³/s]", mean,
                     buckingham_reiner(RADIUS, gradient(result), fluid["plastic_viscosity"], fluid["yield_stress"]), 0.03),
    ]


def draw(axes, results):
    result = results[-1]
    state, r = result.state(), np.linspace(0, RADIUS, 200)
    axes.plot(1e3 * radius(state), 1e3 * state.velocity[:, 0], ".", color="#31688e", markersize=1)
    axes.plot(1e3 * r, 1e3 * exact(result, r), color="#d1652a")
    axes.set(xlabel="r [mm]", ylabel="u [mm/s]")
