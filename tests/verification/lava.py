"""Basalt that runs down a slope from a slot at a constant rate, isothermal: cases/lava.toml with one viscosity."""

import numpy as np

from verification.suite import Run, profile_row, relative_row

NAME = "lava"
TITLE = "isothermal lava on a slope"
VISCOSITY = 125  # [Pa s], of the case at 1473 K
START = 30  # [s] from which on the front is far from the slot


def runs(quick):
    settings = {"fluid.lava.liquid_viscosity": VISCOSITY}
    return [Run("lava", "/lava", "10 deep", {**settings, "output.end_time": 40} if quick else settings)]


def front(state, spacing):
    return float(np.max(state.position[:, 0])) + 0.5 * spacing


def law(result):
    """Thickness and speed of the steady film that carries the flow, at whose speed the front goes (Huppert 1982)."""
    density, flow = result.fluid()["density"], result.case["inlet"][0]["volume_flow"]
    push = result.case["gravity"]["acceleration"][0]
    thickness = (3 * VISCOSITY / density * flow / push) ** (1 / 3)
    return thickness, flow / thickness, push * density / VISCOSITY


def rows(results):
    (result,) = results
    thickness, speed, curve = law(result)
    first, last = result.state(START), result.state()
    advance = (front(last, result.spacing) - front(first, result.spacing)) / (last.time - first.time)
    x, z = last.position[:, 0], last.position[:, 2]
    middle = (x > 0.05) & (x < 0.15)
    depth = np.sum(middle) * result.spacing**2 / 0.1
    exact = curve * (thickness * z[middle] - 0.5 * z[middle] ** 2)
    return [relative_row(result.resolution, f"speed of the front from {START} s on [m/s]", advance, speed, 0.03),
            relative_row(result.resolution, "thickness behind it [m]", depth, thickness, 0.05),
            profile_row(result.resolution, "velocity there", last.velocity[middle, 0], exact, 0.05)]


def draw(axes, results):
    (result,) = results
    states = [s for s in result.states() if len(s.position)]
    axes.plot([s.time for s in states], [front(s, result.spacing) for s in states], ".")
    thickness, speed, _ = law(result)
    times, end = result.times, states[-1]
    axes.plot(times, front(end, result.spacing) + speed * (times - end.time), color="#d1652a")
    axes.set(xlabel="t [s]", ylabel="front [m]")
