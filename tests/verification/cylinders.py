"""Flow between concentric cylinders, the inner one turning: Newtonian, and Bingham as in a viscometer."""

import numpy as np

from verification.closed_forms import Papanastasiou, newtonian_couette_velocity
from verification.suite import Run, profile_row, relative_row

NAME = "cylinders"
TITLE = "concentric cylinders"


def runs(quick):
    """The torques at two speeds besides, of a viscometer's readings."""
    return [Run("cylinders", "/cylinders", "20 across, Newtonian", {"output.end_time": 0.25}),
            Run("viscometer", "viscometer", "20 across, Bingham"), torque_run("0.2"), torque_run("5")][:1 if quick else 4]


def torque_run(speed):
    return Run(f"torque_{speed}", "/cylinders", f"20 across, {speed} rad/s",
               {"wall.0.surface_angular_velocity": f"[0, {speed}, 0]", "output.end_time": 0.6, "output.history_interval": 0.1,
                "measure": '[{name="torque", type="force", wall="inner"}]'})


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
        if result.run.name.startswith("torque"):
            table.append(torque_row(result))
    return table


def torque_row(result):
    """4 pi eta omega / (1/R1² - 1/R2²) for a metre of length."""
    inner, outer = radii(result)
    omega = result.case["wall"][0]["surface_angular_velocity"][1]
    exact_torque = 4 * np.pi * result.fluid()["dynamic_viscosity"] * omega / (1 / inner**2 - 1 / outer**2)
    measured_torque = abs(float(result.history["torque_torque_y_Nm_m"][-1]))
    return relative_row(result.resolution, "torque [N m/m]", measured_torque, exact_torque, 0.015)


def draw(axes, results):
    for result, mark in zip(results, (".", "x")):
        (r, u), (inner, outer) = measured(result.state()), radii(result)
        fine, top = np.linspace(inner, outer, 200), exact(result, np.array([inner]))[0]
        axes.plot((r - inner) / (outer - inner), u / top, ",", color="#31688e")
        axes.plot((fine - inner) / (outer - inner), exact(result, fine) / top, color="#d1652a")
    axes.set(xlabel="distance from the inner one / gap", ylabel="u / u(inner)")
