"""Friction of particles under pressure: what plates that shear a box of them feel beyond viscosity, over the pressure."""

import numpy as np

from verification.suite import Run, bound_row

NAME = "sheared_box"
TITLE = "sheared box, stress beyond viscosity / p"
WIDTH, HEIGHT, SPEED = 0.016, 0.016, 0.016  # [m], [m], [m/s]
STROKE = 8.6e-5  # of the plate above jittered particles [m]


def runs(quick):
    lattice = Run("shear_box", "shear_box", "16 across", {"output.end_time": 0.5} if quick else {})
    jitter = Run("shear_box_jitter", "shear_box", "16 across, jitter 0.2", {
        "region.0.jitter": 0.2, "output.end_time": 2.5,
        "wall.1.motion": f'{{type="constant", velocity=[0, 0, {-STROKE / 0.1:g}], stop=0.1}}'})
    return [lattice] if quick else [lattice, jitter]


def shear_rate(result):
    return SPEED / (HEIGHT - (STROKE if result.case["region"][0]["jitter"] > 0 else 0))


def stresses(result):
    """Shear and the stress on the plates, mean of both, at each line of the history; their mean pressure [Pa]."""
    history = {name: np.asarray(values)[1:] for name, values in result.history.items()}
    force = {axis: [history[f"{plate}_pressure_{axis}_N_m"] + history[f"{plate}_viscous_{axis}_N_m"] for plate in ("lower", "upper")]
             for axis in "xz"}
    stress, pressure = ((sign[0] * low + sign[1] * up) / (2 * WIDTH)
                        for sign, (low, up) in (((1, -1), force["x"]), ((-1, 1), force["z"])))
    return shear_rate(result) * history["time_s"], stress, pressure


def friction(result):
    """At each shear: (stress - eta rate)/p."""
    shear, stress, pressure = stresses(result)
    return shear, (stress - result.fluid()["dynamic_viscosity"] * shear_rate(result)) / pressure


def rows(results):
    table = []
    for result in results:
        shear, own = friction(result)
        jittered = result.case["region"][0]["jitter"] > 0
        chosen = shear > (2 if jittered else 0.2)
        text = "from a shear of 2 on" if jittered else "from a shear of 0.2 on"
        table.append(bound_row(result.resolution, f"largest stress beyond viscosity / p, {text}", np.max(np.abs(own[chosen])),
                               (None, 1e-3 if jittered else 5e-4)))
        table.append(bound_row(result.resolution, f"pressure, {text} [Pa]", np.mean(stresses(result)[2][chosen]), (800, 1200)))
    return table


def draw(axes, results):
    for result in results:
        shear, own = friction(result)
        axes.plot(shear[shear > 0.2], 1e4 * own[shear > 0.2], linewidth=0.7, label=result.resolution)
    axes.axhline(0, color="#d1652a")
    axes.set(xlabel="shear", ylabel="(τ − ηγ̇)/p [1e-4]")
    axes.legend(fontsize="x-small")
