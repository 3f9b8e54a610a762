"""Walls that turn with their fluid: a full drum, and a pot in which the surface becomes a paraboloid."""

import numpy as np

from verification.suite import Row, Run, bound_row, number, relative_row

NAME = "turning"
TITLE = "pot that turns, surface"
RATE = 31.3209  # of the pot [rad/s]
RINGS = (1, 3, 5, 7, 9)  # radii [mm]


def runs(quick):
    coarse = {"resolution.spacing": 1.25e-3, "domain.min": [-0.01375, -0.01375, -0.005], "domain.max": [0.01375, 0.01375, 0.0225],
              "output.end_time": 0.25}
    return [Run("turning_drum", "turning_drum", "18 in the radius, drum", {"output.end_time": 0.25} if quick else {}),
            Run("turning_pot", "turning_pot", f"{8 if quick else 10} in the radius, pot", coarse if quick else {})]


def wall_radius(result):
    return result.case["wall"][0]["shapes"][0]["radius"]


def nearest(position):
    """Distance of each particle to its nearest neighbour, a block of particles at a time."""
    distances = np.empty(len(position))
    for start in range(0, len(position), 500):
        block = position[start:start + 500]
        apart = np.linalg.norm(block[:, None] - position[None], axis=2)
        apart[np.arange(len(block)), start + np.arange(len(block))] = np.inf
        distances[start:start + 500] = np.min(apart, axis=1)
    return distances


def beyond(result, axes):
    """The most particles past the wall in any snapshot."""
    return max(int(np.sum(np.linalg.norm(state.position[:, axes], axis=1) > wall_radius(result))) for state in result.states())


def rows_of_drum(result):
    first, last = (np.sqrt(np.mean(np.sum(state.position**2, axis=1))) for state in (result.state(0), result.state()))
    close = np.percentile(nearest(result.state().position), 5) / result.spacing
    return [relative_row(result.resolution, f"rms radius after {result.times[-1]:.2g} s / at the start", last / first, 1.0, 0.01),
            bound_row(result.resolution, "particles beyond the wall", beyond(result, [0, 2]), (None, 0)),
            bound_row(result.resolution, "nearest neighbour, 5th percentile [Δx]", close, (0.7, None))]


def paraboloid(result, radius):
    """Height of the surface [m]; the volume is that at the start."""
    depth = result.case["region"][0]["shapes"][0]["end"][2]
    return depth + RATE**2 / (2 * 9.81) * (radius**2 - wall_radius(result)**2 / 2)


def surface(result, radius):
    """The highest particle within a spacing of a ring, and half a spacing [m]."""
    position = result.state().position
    near = np.abs(np.hypot(position[:, 0], position[:, 1]) - radius) < result.spacing
    return np.max(position[near, 2]) + 0.5 * result.spacing


def rows_of_pot(result):
    table = [bound_row(result.resolution, "particles beyond the wall", beyond(result, [0, 1]), (None, 0))]
    for ring in RINGS:
        measured, exact = surface(result, 1e-3 * ring), paraboloid(result, 1e-3 * ring)
        error = abs(measured - exact) / result.spacing
        table.append(Row(result.resolution, f"height of the surface at {ring} mm [m]", number(measured), number(exact),
                         f"{error:.2f} Δx", "1 Δx", bool(error <= 1)))
    return table


def rows(results):
    drum, pot = results
    return rows_of_drum(drum) + rows_of_pot(pot)


def draw(axes, results):
    pot = results[1]
    position, r = pot.state().position, np.linspace(0, wall_radius(pot), 100)
    axes.plot(1e3 * np.hypot(position[:, 0], position[:, 1]), 1e3 * position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(1e3 * r, 1e3 * paraboloid(pot, r), color="#d1652a")
    axes.set(xlabel="r [mm]", ylabel="z [mm]")
