"""Flow from rest between a plate at rest and one that moves, against its series."""

import numpy as np

from verification.closed_forms import couette
from verification.suite import Run, profile_row

NAME = "couette"
TITLE = "plane Couette, start-up"
GAP = 0.01  # [m]


def runs(quick):
    return [Run(f"couette_{n}", "/couette", f"{n} across", {
        "resolution.spacing": GAP / n,
        "region.0.shapes.0.max": [8 * GAP / n, 8 * GAP / n, GAP],
        "domain.max": [8 * GAP / n, 8 * GAP / n, 1.2 * GAP],
        "output.end_time": 0.2, "output.interval": 0.01,
    }) for n in ((20,) if quick else (20, 40))]


def series(result, z, time):
    speed = result.case["wall"][1]["surface_velocity"][0]
    return couette(z, time, GAP, speed, result.fluid()["dynamic_viscosity"] / result.fluid()["density"])


def rows(results):
    table = []
    for result in results:
        for time in (0.01, 0.04, 0.2):
            state = result.state(time)
            table.append(profile_row(result.resolution, f"νt/H² = {time / 0.2:g}", state.velocity[:, 0],
                                     series(result, state.position[:, 2], state.time), {20: 0.02, 40: 0.01}[
                                         round(GAP / result.spacing)] if time == 0.2 else None))
    return table


def draw(axes, results):
    z = np.linspace(0, GAP, 200)
    for time in (0.01, 0.04, 0.2):
        state = results[-1].state(time)
        axes.plot(state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
        axes.plot(series(results[-1], z, state.time), 1e3 * z, color="#d1652a")
    axes.set(xlabel="u [m/s]", ylabel="z [mm]")
