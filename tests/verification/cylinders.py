"""Flow between concentric cylinders, the inner one turning: Newtonian, and Bingham as in a viscometer."""

import numpy as np

from verification.closed_forms import Papanastasiou, newtonian_couette_velocity
from verification.suite import Run, profile_row

NAME = "cylinders"
TITLE = "concentric cylinders"


def runs(quick):
    return [Run("cylinders", "/cylinders", "20 across, Newtonian", {"output.end_time": 0.25}),
            Run("viscometer", "viscometer", "20 across, Bingham")][:1 if quick else 2]


def radii(result):
    inner, outer = (wall["shapes"][0]["radius"] for wall in result.case["wall"])
    return inner, outer


def exact(result, r):
    speed = result.case["wall"][0]["surface_angular_velocity"][1]
    if result.fluid()["rheology"] == "newtonian":
        return newtonian_couette_velocity(r, radii(result), speed)
    return Papanastasiou.of(result.fluid()).couette_velocity(r, radii(result), speed)[0]


def measured(state):
    """Radius and azimuthal velocity, in the sense of a rotation about y."""
    x, z = state.position[:, 0], state.position[:, 2]
    r = np.hypot(x, z)
    return r, (state.velocity[:, 0] * z - state.velocity[:, 2] * x) / r


def rows(results):
    table = []
    for result in results:
        r, u = measured(result.state())
        table.append(profile_row(result.resolution, "azimuthal velocity", u, exact(result, r), 0.03))
    return table


def draw(axes, results):
    for result, mark in zip(results, (".", "x")):
        (r, u), (inner, outer) = measured(result.state()), radii(result)
        fine, top = np.linspace(inner, outer, 200), exact(result, np.array([inner]))[0]
        axes.plot((r - inner) / (outer - inner), u / top, ",", color="#31688e")
        axes.plot((fine - inner) / (outer - inner), exact(result, fine) / top, color="#d1652a")
    axes.set(xlabel="distance from the inner one / gap", ylabel="u / u(inner)")
