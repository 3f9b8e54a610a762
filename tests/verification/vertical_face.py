"""A vertical face stands while the yield stress exceeds 0.265 rho g H (Kammoun et al. 2010)."""

import numpy as np

from verification.suite import Run, bound_row

NAME = "vertical_face"
TITLE = "vertical face, moved after 0.3 s"
HEIGHT = 0.02  # [m]
WEIGHT = 1000 * 9.81 * HEIGHT  # [Pa]
STANDING, FAILING = 0.30, 0.23
TIME = 0.3  # [s]


def runs(quick):
    return [Run(f"vertical_face_{ratio}_{n}", "vertical_face", f"{n} high, τ_B {ratio} ρgH",
                {"fluid.paste.yield_stress": ratio * WEIGHT, "output.end_time": TIME, "resolution.spacing": HEIGHT / n})
            for n in ((20,) if quick else (20, 40)) for ratio in (STANDING, FAILING)]


def face(result, state):
    """How far the face stands from its place, for each two layers of particles: their heights [m], the way
    [spacings]."""
    height, x = state.position[:, 2], state.position[:, 0]
    layer = np.minimum(height // (2 * result.spacing), HEIGHT // (2 * result.spacing) - 1).astype(int)
    front = np.full(layer.max() + 1, -np.inf)
    np.maximum.at(front, layer, x)
    return (2 * np.arange(len(front)) + 1) * result.spacing, front / result.spacing + 0.5


def rows(results):
    table = []
    for standing, failing in zip(results[::2], results[1::2]):
        for result, bounds in ((standing, (None, 0.1)), (failing, (0.5, None))):
            moved = np.mean(face(result, result.state())[1])
            table.append(bound_row(result.resolution, "the face moves in 0.3 s, mean of its height [Δx]", moved, bounds))
        slow, fast = (np.sqrt(np.mean(np.sum(r.state(0.05).velocity**2, axis=1))) for r in (standing, failing))
        table.append(bound_row(standing.resolution.split(",")[0], "rms speed after 50 ms, failing / standing", fast / slow,
                               (10, None)))
    return table


def draw(axes, results):
    for result, colour in zip(results[-2:], ("#31688e", "#d1652a")):
        height, moved = face(result, result.state())
        axes.plot(moved, 1e3 * height, ".-", color=colour, label=result.resolution.split(", ")[1])
    axes.axvline(0, color="grey", linewidth=0.5)
    axes.set(xlabel="moved [Δx]", ylabel="z [mm]")
    axes.legend(fontsize="x-small")
