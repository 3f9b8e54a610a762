"""A free block of Bingham fluid that spins keeps its angular momentum."""

import numpy as np

from verification.suite import Run, relative_row

NAME = "rigid_rotation"
TITLE = "free block that spins"


def runs(quick):
    return [Run("rigid_rotation", "/spinning_block", "10 along an edge")]


def momentum(state):
    """Angular momentum about the centre of mass, per mass of a particle [m^2/s]."""
    x = state.position - np.mean(state.position, axis=0)
    return np.sum(np.cross(x, state.velocity), axis=0)


def rows(results):
    (result,) = results
    first, last = momentum(result.state(0)), momentum(result.state())
    return [relative_row(result.resolution, f"angular momentum after {1e3 * result.times[-1]:.0f} ms / before",
                         np.linalg.norm(last) / np.linalg.norm(first), 1.0, 0.001)]


def draw(axes, results):
    (result,) = results
    start = np.linalg.norm(momentum(result.state(0)))
    axes.plot(1e3 * result.times, [np.linalg.norm(momentum(s)) / start for s in result.states()], ".-")
    axes.axhline(1, color="#d1652a")
    axes.set(xlabel="t [ms]", ylabel="angular momentum", ylim=(0.99, 1.01))
