"""Newtonian flow between plates, from rest and from disordered particles, against its series."""

import numpy as np

from verification.closed_forms import poiseuille
from verification.suite import Run, profile_row

NAME = "poiseuille"
TITLE = "plane Poiseuille, Newtonian, start-up"
GAP = 0.01  # [m]
TARGETS = {20: 0.02, 40: 0.01, 80: 0.005}
MISSES = dict.fromkeys(
    ("80 across: νt/H² = 1", "80 across: start-up, νt/H² = 0.05"),
    "what particles resist depends by 1 % on how they lie, which no refinement takes out: a jittered lattice at the "
    "start, sheared particles at the end")


def runs(quick):
    return [Run(f"poiseuille_{n}", "poiseuille_start_up", f"{n} across", {
        "resolution.spacing": GAP / n,
        "region.0.shapes.0.max": [8 * GAP / n, 8 * GAP / n, GAP],
        "domain.max": [8 * GAP / n, 8 * GAP / n, 1.2 * GAP],
    }) for n in ((20,) if quick else TARGETS)]


def series(result, state):
    nu = result.fluid()["dynamic_viscosity"] / result.fluid()["density"]
    return poiseuille(state.position[:, 2], result.velocity_time(state), GAP, result.case["body_force"]["acceleration"][0], nu)


def rows(results):
    table = []
    for result in results:
        target = TARGETS[round(GAP / result.spacing)]
        for part, time in (("start-up, νt/H² = 0.05", 0.01), ("start-up, νt/H² = 0.2", 0.04), ("νt/H² = 1", 0.2)):
            state = result.state(time)
            table.append(profile_row(result.resolution, part, state.velocity[:, 0], series(result, state), target))
    return table


def draw(axes, results):
    result = results[-1]
    for time in (0.01, 0.04, 0.2):
        state = result.state(time)
        order = np.argsort(state.position[:, 2])
        axes.plot(state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=0.6)
        axes.plot(series(result, state)[order], 1e3 * state.position[order, 2], color="#d1652a")
    axes.set(xlabel="u [m/s]", ylabel="z [mm]")
