"""The start, energy and time: fluid under pressure flows as fast as without, what spins keeps its energy, what falls falls
freely and lands, and walls hold water."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, bound_row, relative_row

NAME = "start"
TITLE = "channel under pressure"
GAP = 0.02  # [m]


def runs(quick):
    return [Run("start_channel", "start_channel", "40 across, 20 Pa"),
            Run("spinning_disc", "spinning_disc", "11 in the radius", {"output.end_time": 0.1} if quick else {}),
            Run("free_fall", "free_fall", "6 along an edge, exact"),
            Run("falling_drop", "falling_drop", "8 along an edge"),
            Run("falling_drop_exact", "falling_drop", "8 along an edge, exact", {"numerics.yield": "exact"}),
            Run("water_dam", "water_dam", "20 high"),
            Run("water_dam_free", "water_dam", "20 high, free slip", {"wall.0.slip": "free_slip"})]


def exact(result, z):
    drive = result.case["body_force"]["acceleration"][0] * result.fluid()["density"]  # [Pa/m]
    return Papanastasiou.of(result.fluid()).plane_velocity(z - GAP / 2, GAP / 2, drive)


def flow(result):
    """Mean velocity of the fluid at each snapshot of the second half of the run [m/s]: it comes and goes by some 1 % as
    the rows of the start shear past each other, with and without pressure."""
    return np.array([np.mean(result.state(time).velocity[:, 0]) for time in result.times if time > 0.5 * result.times[-1]])


def rows_of_flow(result):
    mean = np.mean(exact(result, np.linspace(0, GAP, 4001)))
    history = flow(result)
    return [relative_row(result.resolution, "mean velocity at 3.6 % compression [m/s]", np.mean(history), mean, 0.01),
            relative_row(result.resolution, "the same at its farthest from the mean [m/s]",
                         history[np.argmax(np.abs(history - mean))], mean)]


def dissipated(result):
    history = result.history
    return bound_row(result.resolution, f"dissipated in {result.times[-1]:.2g} s / kinetic energy",
                     history["dissipated_energy_J"][-1] / history["kinetic_energy_J"][0], (None, 0.01))


def fall(result):
    first, last = (np.mean(state.position[:, 2]) for state in (result.state(0), result.state()))
    return relative_row(result.resolution, f"way fallen in {1e3 * result.times[-1]:.3g} ms [m]", first - last,
                        0.5 * 9.81 * result.times[-1]**2, 0.005)


def landing(result):
    """The case stops where a particle leaves the domain or the watch finds something; so reaching the end is the test."""
    return bound_row(result.resolution, "time reached / end of the case", result.times[-1] / result.case["output"]["end_time"],
                     (0.999, None))


def front(result):
    return np.max(result.state().position[:, 0])


def hold(sticking, sliding):
    return bound_row(sticking.resolution, "front, free slip / no slip", front(sliding) / front(sticking), (1.01, None))


def rows(results):
    channel, disc, square, *drops, sticking, sliding = results
    return rows_of_flow(channel) + [dissipated(disc), fall(square), *map(landing, drops), hold(sticking, sliding)]


def draw(axes, results):
    state, z = results[0].state(), np.linspace(0, GAP, 400)
    axes.plot(1e3 * state.velocity[:, 0], 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(1e3 * exact(results[0], z), 1e3 * z, color="#d1652a")
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
