"""Fluid that has been thrown about fills no more than its volume when it is at rest, no lip throws any, and walls off the
lattice move none."""

import numpy as np

from verification.suite import Run, bound_row, relative_row

NAME = "splash"
TITLE = "slag at rest after its fall"
WIDTH = {"splash": 0.12, "sloshing": 0.06}  # of the boxes [m]

MISSES = {"water, dam in a box: mean height at the end [m]":
          "the water still moves, and small changes grow: between 4.4 and 6.9 % as courant, 0.25, or the treatment of voids change a little"}


def runs(quick):
    return [Run("splash", "splash", "0.8 Pa s, falls 100 mm"),
            Run("pour", "pour", "ladle, 12 deep"),
            Run("off_lattice", "off_lattice", "30 deep, walls off the lattice",
                {"output.end_time": 0.1} if quick else {})] + ([] if quick else
                                                               [Run("sloshing", "sloshing", "water, dam in a box")])


def depth(result):
    """Mean height of the fluid over half of its depth at rest in the box."""
    state = result.state()
    area = len(result.state(0).position) * result.spacing**2
    return [relative_row(result.resolution, "mean height at the end [m]", np.mean(state.position[:, 2]),
                         0.5 * area / WIDTH[result.case["case"]["name"]], 0.06)]


def thrown(result):
    """Of the times after the ladle has come to rest, above its lip."""
    most = 0
    for time in result.times:
        state = result.state(time)
        above = state.position[:, 2] > 0.08
        if time > 2.1 and np.any(above):
            most = max(most, np.max(state.velocity[above, 2]))
    return [bound_row(result.resolution, "fastest rise at the lip at rest [m/s]", most, (None, 0.2))]


def moved(result):
    """A fluid too stiff to move, pushed by walls that lie between its rows."""
    first, last = result.ordered(0), result.ordered(result.times[-1])
    return [bound_row(result.resolution, "time reached / end of the case",
                      result.times[-1] / result.case["output"]["end_time"], (0.999, None)),
            bound_row(result.resolution, "farthest that any particle has come [m]",
                      np.max(np.linalg.norm(last - first, axis=1)), (None, 0.3 * result.spacing))]


def rows(results):
    rows_of = {"pour": thrown, "off_lattice": moved}
    return [row for result in results for row in rows_of.get(result.case["case"]["name"], depth)(result)]


def draw(axes, results):
    result = results[0]
    state = result.state()
    axes.plot(1e3 * state.position[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    area = len(result.state(0).position) * result.spacing**2
    axes.axhline(1e3 * area / WIDTH["splash"], color="#d1652a", linewidth=0.7)
    axes.set(xlabel="x [mm]", ylabel="z [mm]", aspect="equal")
