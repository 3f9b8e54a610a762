"""Equation (7) as printed: its explicit half acts on u*, which shifts the steady state by -f dt/2."""

import numpy as np

from verification.closed_forms import poiseuille
from verification.suite import Run, relative_row

NAME = "as_printed"
TITLE = "explicit part of (7): from v, from u*"
GAP, VISCOSITY, STEP = 0.01, 20, 2e-4  # [m], [Pa s], [s]


def runs(quick):
    return [Run(f"as_printed_{part}", "poiseuille_start_up", "20 across, Δt 0.2 ms", {
        "fluid.oil.dynamic_viscosity": VISCOSITY, "region.0.jitter": 0, "region.0.pressure": 0,
        "numerics.theta": 0.5,
        "numerics.explicit_part": part, "numerics.max_time_step": STEP, "numerics.tolerance": 1e-4,
        "output.end_time": 0.02, "output.interval": 0.01}) for part in ("old_velocity", "predicted")]


def exact(result, z):
    drive = result.case["body_force"]["acceleration"][0]
    return poiseuille(z, np.inf, GAP, drive, VISCOSITY / result.fluid()["density"])


def rows(results):
    # Not at the end: the last steps are shorter.
    old, printed = (np.mean(result.state(0.01).velocity[:, 0]) for result in results)
    drive = results[0].case["body_force"]["acceleration"][0]
    state = results[0].state(0.01)
    return [
        relative_row(results[0].resolution, "mean velocity, from v [m/s]", old,
                     np.mean(exact(results[0], state.position[:, 2]))),
        relative_row(results[0].resolution, "what u* instead of v adds, −fΔt/2 [m/s]", printed - old,
                     -drive * STEP / 2, 0.02),
    ]


def draw(axes, results):
    z = np.linspace(0, GAP, 100)
    for result, colour in zip(results, ("#31688e", "#3f8f4f")):
        state = result.state()
        axes.plot(1e3 * state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color=colour, markersize=1)
    curve, shift = exact(results[0], z), results[0].case["body_force"]["acceleration"][0] * STEP / 2
    axes.plot(1e3 * curve, 1e3 * z, color="#d1652a")
    axes.plot(1e3 * (curve - shift), 1e3 * z, ":", color="#d1652a")
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
