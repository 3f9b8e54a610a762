"""A Bingham film on an incline against the regularised profile."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, profile_row, relative_row

NAME = "film"
TITLE = "film down an incline, slag"
THICKNESS = 0.005  # [m]


def runs(quick):
    return [Run("film", "film", "20 across")]


def exact(result, z):
    gradient = result.case["gravity"]["acceleration"][0] * result.fluid()["density"]
    return Papanastasiou.of(result.fluid()).plane_velocity(THICKNESS - z, THICKNESS, gradient)


def mean_of_end(result):
    """Height and velocity of each layer, mean over the last third of the run: the layers of the lattice slide over
    each other, and what they resist varies with that by some percent."""
    states = [state for state in result.states() if state.time > 2 / 3 * result.times[-1]]
    z = np.concatenate([state.position[:, 2] for state in states])
    u = np.concatenate([state.velocity[:, 0] for state in states])
    layer = np.minimum((z / result.spacing).astype(int), round(THICKNESS / result.spacing) - 1)
    return tuple(np.bincount(layer, values) / np.bincount(layer) for values in (z, u))


def rows(results):
    (result,) = results
    z, u = mean_of_end(result)
    fine = np.linspace(0, THICKNESS, 2001)
    flow = np.mean(exact(result, fine)) * THICKNESS  # [m^2/s]
    return [
        profile_row(result.resolution, "velocity, mean over the last third", u, exact(result, z), 0.03),
        relative_row(result.resolution, "speed of the surface [m/s]", np.mean(u[z > THICKNESS - 2 * result.spacing]),
                     float(exact(result, np.array([THICKNESS]))[0]), 0.03),
        relative_row(result.resolution, "flow rate [m²/s]", np.mean(u) * THICKNESS, flow, 0.03),
    ]


def draw(axes, results):
    (result,) = results
    (height, u), z = mean_of_end(result), np.linspace(0, THICKNESS, 200)
    axes.plot(1e3 * u, 1e3 * height, ".", color="#31688e")
    axes.plot(1e3 * exact(result, z), 1e3 * z, color="#d1652a")
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
