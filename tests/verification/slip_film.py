"""A Bingham film that slips on its slope: the friction of the slip is no shear of the fluid, whose viscosity it would lower.
The error is of first order: targets of 20 % and 10 % with six and twelve rows that are sheared."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, relative_row

NAME = "slip_film"
TITLE = "film that slips, Bingham"
THICKNESS = 0.02  # [m]


def runs(quick):
    coarse = Run("slip_film", "slip_film", "20 deep, slip length 5")
    return [coarse] if quick else [coarse, Run("slip_film_fine", "slip_film", "40 deep, slip length 10",
                                               {"resolution.spacing": 5e-4, "numerics.courant": 1.0})]


def exact(result, z):
    """The plug's profile on top of the slip velocity, the slip length times the shear rate at the wall."""
    gradient = result.case["gravity"]["acceleration"][0] * result.fluid()["density"]
    fluid = Papanastasiou.of(result.fluid())
    slip = result.case["wall"][0]["slip_length"] * fluid.rate(gradient * THICKNESS)
    return fluid.plane_velocity(THICKNESS - z, THICKNESS, gradient) + slip


def mean_speed(result, top):
    state = result.state()
    height = state.position[:, 2]
    return np.mean(state.velocity[height > THICKNESS - 2 * result.spacing if top else height < result.spacing, 0])


def rows(results):
    return [relative_row(result.resolution, quantity, mean_speed(result, top), float(exact(result, z)),
                         200 * result.spacing)
            for result in results
            for quantity, top, z in (("speed of the surface [m/s]", True, THICKNESS),
                                     ("speed of the lowest row [m/s]", False, 0.5 * result.spacing))]


def draw(axes, results):
    result = results[-1]
    state, z = result.state(), np.linspace(0, THICKNESS, 200)
    axes.plot(state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot([float(exact(result, height)) for height in z], 1e3 * z, color="#d1652a", linewidth=0.7)
    axes.set(xlabel="u [m/s]", ylabel="z [mm]")
