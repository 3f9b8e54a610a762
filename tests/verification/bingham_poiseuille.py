"""Bingham slag between plates at three widths of the plug, against the regularised profile; and below yield."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Row, Run, number, profile_row, relative_row

NAME = "bingham_poiseuille"
TITLE = "plane Poiseuille, slag"
HALF_GAP = 0.01  # [m]
ACROSS = 40
PLUGS = (0.2, 0.5, 0.8)  # half width of the plug / half gap


def runs(quick):
    return [Run(f"bingham_poiseuille_{s}", "bingham_poiseuille", f"{ACROSS} across, y_p/a {s}",
                {"body_force.acceleration": [2.3 / (2600 * s * HALF_GAP), 0, 0]}) for s in (PLUGS[:1] if quick else PLUGS)]


def drive(result):
    return result.case["body_force"]["acceleration"][0] * result.fluid()["density"]  # [Pa/m]


def exact(result, z):
    return Papanastasiou.of(result.fluid()).plane_velocity(z - HALF_GAP, HALF_GAP, drive(result))


def layers(result, state):
    """Mean velocity of the particles in slices one spacing wide: their middles and the means."""
    z, u = state.position[:, 2], state.velocity[:, 0]
    slices = np.clip((z / result.spacing).astype(int), 0, ACROSS - 1)
    counts = np.bincount(slices, minlength=ACROSS)
    return np.bincount(slices, z, ACROSS) / counts, np.bincount(slices, u, ACROSS) / counts


def plug_edge(result, state):
    """Distance from the middle to where the shear begins [m]: beyond it the square root of what the velocity lacks
    to that of the plug grows in proportion."""
    z, u = layers(result, state)
    lack = 1 - u / np.max(u)
    sheared = (lack > 0.05) & (lack < 0.6)
    slope, start = np.polyfit(np.abs(z - HALF_GAP)[sheared], np.sqrt(lack[sheared]), 1)
    return -start / slope


def unyielded_edge(state):
    """Half the width of what the program marks as not yielded [m]."""
    return (1 - np.mean(state.yielded > 0.5)) * HALF_GAP


def rows(results):
    table = []
    for result in results:
        state, target = result.state(), result.run.name.endswith("0.2")
        z, u = state.position[:, 2], state.velocity[:, 0]
        table.append(profile_row(result.resolution, "velocity", u, exact(result, z), 0.02 if target else None))
        middle = np.abs(z - HALF_GAP) < result.spacing
        table.append(relative_row(result.resolution, "speed of the plug [m/s]", np.mean(u[middle]),
                                  float(exact(result, np.array([HALF_GAP]))[0]), 0.02 if target else None))
        expected = result.fluid()["yield_stress"] / drive(result)
        for name, edge in (("edge of the plug, by the velocity [m]", plug_edge(result, state)),
                           ("edge of the plug, by Yielded [m]", unyielded_edge(state))):
            error = abs(edge - expected) / result.spacing
            table.append(Row(result.resolution, name, number(edge), number(expected), f"{error:.2f} Δx",
                             "1 Δx" if target else "–", bool(error <= 1) if target else None))
    return table


def draw(axes, results):
    for result in results:
        state = result.state()
        z = np.linspace(0, 2 * HALF_GAP, 400)
        axes.plot(1e3 * state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e",
                  markersize=1)
        axes.plot(1e3 * exact(result, z), 1e3 * z, color="#d1652a")
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
