"""A Bingham film on an incline against the regularised profile."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, profile_row, relative_row

NAME = "film"
TITLE = "film down an incline, slag"
THICKNESS = 0.005  # [m]


def runs(quick):
    return [Run("film", "film", "20 across", {"output.end_time": 0.15 if quick else 0.3})]


def exact(result, z):
    gradient = result.case["gravity"]["acceleration"][0] * result.fluid()["density"]
    return Papanastasiou.of(result.fluid()).plane_velocity(THICKNESS - z, THICKNESS, gradient)


def rows(results):
    (result,) = results
    state = result.state()
    z, u = state.position[:, 2], state.velocity[:, 0]
    fine = np.linspace(0, THICKNESS, 2001)
    flow = np.mean(exact(result, fine)) * THICKNESS  # [m^2/s]
    area = np.prod([result.case["domain"]["max"][k] - result.case["domain"]["min"][k] for k in (0, 1)])
    return [
        profile_row(result.resolution, "velocity", u, exact(result, z), 0.03),
        relative_row(result.resolution, "speed of the surface [m/s]", np.mean(u[z > THICKNESS - 2 * result.spacing]),
                     float(exact(result, np.array([THICKNESS]))[0]), 0.03),
        relative_row(result.resolution, "flow rate [m²/s]", np.sum(u) * result.spacing**3 / area, flow, 0.03),
    ]


def draw(axes, results):
    (result,) = results
    state, z = result.state(), np.linspace(0, THICKNESS, 200)
    axes.plot(1e3 * state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(1e3 * exact(result, z), 1e3 * z, color="#d1652a")
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
