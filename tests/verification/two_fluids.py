"""Two fluids between plates, the upper of which moves: a thin oil on a thick one, and an oil on a paste that does not
yield."""

import numpy as np

from verification.suite import Row, Run, bound_row, percent, profile_row, relative_row

NAME = "two_fluids"
TITLE = "two oils, and oil on paste, between plates"
GAP, SPEED = 0.01, 0.1  # [m, m/s]


def runs(quick):
    end = {"output.end_time": 0.4} if quick else {}  # the slowest mode falls by e in 0.05 s
    return [Run("two_oils", "two_oils", "20 across, thin on thick", end),
            Run("paste_under_oil", "paste_under_oil", "20 across, oil on paste, exact", end)]


def viscosities(result):
    lower, upper = (result.case["fluid"][region["fluid"]] for region in result.case["region"])
    return lower.get("dynamic_viscosity", np.inf), upper["dynamic_viscosity"]


def exact(result, z):
    """Velocity: one stress throughout, each fluid fills half of the gap."""
    lower, upper = viscosities(result)
    stress = SPEED / (GAP / 2 / lower + GAP / 2 / upper)
    return stress * (np.minimum(z, GAP / 2) / lower + np.maximum(z - GAP / 2, 0) / upper), stress


def wall_stress(result):
    """On the moving plate, mean of the last tenth of the run [Pa]."""
    history = result.history
    late = history["time_s"] > 0.9 * history["time_s"][-1]
    width = result.case["domain"]["max"][0] - result.case["domain"]["min"][0]
    return -np.mean(history["upper_viscous_x_N_m"][late]) / width


def energy_rows(result):
    summary = result.summary
    work, moving, lost = summary["measures"]["upper"]["work"], summary["kinetic_energy"], summary["dissipated_energy"]
    return [bound_row(result.resolution, "dissipated / work of the plate", lost / work, (None, 1)),
            bound_row(result.resolution, "dissipated / (work less kinetic energy)", lost / (work - moving), (0.95, None))]


def rows_of_oils(result):
    state = result.state()
    z, u = state.position[:, 2], state.velocity[:, 0]
    expected, stress = exact(result, z)
    thick = np.abs(z - GAP / 4) < GAP / 8
    return [profile_row(result.resolution, "velocity", u, expected, 0.01),
            relative_row(result.resolution, "shear rate, middle of the thick oil [1/s]",
                         np.mean(result.last("ShearRate")[thick]), stress / viscosities(result)[0], 0.03),
            *energy_rows(result)]


def rows_of_paste(result):
    state = result.state()
    z, u = state.position[:, 2], state.velocity[:, 0]
    expected, stress = exact(result, z)
    oil = z > GAP / 2
    still = np.max(np.abs(u[~oil])) / SPEED
    return [profile_row(result.resolution, "velocity of the oil", u[oil], expected[oil], 0.01),
            Row(result.resolution, "fastest of the paste / speed of the plate", f"{still:.3g}", "0", percent(still), "0.1 %",
                bool(still <= 1e-3)),
            relative_row(result.resolution, "shear stress on the plate [Pa]", wall_stress(result), stress, 0.02)]


def rows(results):
    oils, paste = results
    return rows_of_oils(oils) + rows_of_paste(paste)


def draw(axes, results):
    z = np.linspace(0, GAP, 201)
    for result, colour in zip(results, ("#31688e", "#35b779")):
        state = result.state()
        axes.plot(state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color=colour, markersize=2)
        axes.plot(exact(result, z)[0], 1e3 * z, color="#d1652a", linewidth=0.7)
    axes.set(xlabel="u [m/s]", ylabel="z [mm]")
