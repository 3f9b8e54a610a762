"""Films on mild slopes, where the pressure is many times the shear stress: what friction the particles have of their own
takes from their speed."""

import numpy as np

from verification.closed_forms import Papanastasiou
from verification.suite import Run, relative_row

NAME = "slopes"
TITLE = "films on mild slopes"
THICKNESS = 0.005  # [m]
GRAVITY = 9.81  # [m/s^2]
TERMS = 3  # of the parabola at the start
MISSES = {
    "20 across, oil, 1°, jitter 0.2: mean speed / exact, mean over the last half":
        "the film settles by 1.9 % of its depth as its particles spread, which takes as much of the speed; the rest is the "
        "viscosity of disordered particles, 2 to 5 % above nominal. Little of it is friction: 0.934 at 0.25°; 0.935 at 40 across, 0.987 with jitter 0.1",
    "20 across, slag, 1.5°: mean speed / exact, mean over the last half":
        "only the lowest 1.5 mm, six particles, are sheared: at 40 across 0.993"}


def down(degrees):
    """The setting that turns gravity."""
    angle = np.radians(degrees)
    return {"gravity.acceleration": [round(float(GRAVITY * np.sin(angle)), 8), 0, round(float(-GRAVITY * np.cos(angle)), 8)]}


def parabola(degrees):
    """The setting that starts the film with its parabola: odd quarter waves, 32 u_s/(pi^3 n^3) (Fourier)."""
    surface = 1000 * GRAVITY * np.sin(np.radians(degrees)) * THICKNESS**2 / (2 * 0.1)
    return {f"region.0.waves.{k}.amplitude": [round(float(32 * surface / (np.pi * (2 * k + 1))**3), 10), 0, 0]
            for k in range(TERMS)}


def oil(degrees, label="", **settings):
    label = f"{degrees}°{label}"
    return Run(f"slope_{label.replace('°', '').replace(', ', '_').replace(' ', '_')}", "slope", f"20 across, oil, {label}",
               {**down(degrees), **parabola(degrees), **settings})


def slag(degrees):
    return Run(f"slope_slag_{degrees}", "slope_slag", f"20 across, slag, {degrees}°", down(degrees))


def runs(quick):
    if quick:
        return [oil(0.25)]
    three = {"resolution.dimensions": 3, "domain.periodic": '["x", "y"]', "output.end_time": 0.5}
    return ([oil(degrees, **{"output.end_time": 2}) for degrees in (0.125, 0.25, 0.5, 1)] +
            [oil(0.125, ", from rest", **{"output.end_time": 2, "region.0.waves": "[]"}),
             oil(1, ", jitter 0.2", **{"output.end_time": 2, "region.0.jitter": 0.2}), oil(0.5, ", 3-D", **three)] +
            [slag(degrees) for degrees in (1.5, 2, 3)])


def exact(result, z):
    drive = result.case["gravity"]["acceleration"][0] * result.fluid()["density"]  # [Pa/m]
    if result.fluid()["rheology"] == "newtonian":
        return drive / result.fluid()["dynamic_viscosity"] * z * (THICKNESS - z / 2)
    return Papanastasiou.of(result.fluid()).plane_velocity(THICKNESS - z, THICKNESS, drive)


def share(result):
    """Mean velocity of all particles at each snapshot over the exact one."""
    flow = np.mean(exact(result, (np.arange(2000) + 0.5) / 2000 * THICKNESS))
    return np.array([np.mean(state.velocity[:, 0]) for state in result.states()]) / flow


def target(result):
    plain = result.fluid()["rheology"] == "newtonian" and result.case["resolution"]["dimensions"] == 2
    return 0.02 if plain and result.case["region"][0]["jitter"] == 0 else 0.03


def rows(results):
    return [relative_row(result.resolution, "mean speed / exact, mean over the last half",
                         np.mean(share(result)[result.times > 0.5 * result.times[-1]]), 1.0, target(result))
            for result in results]


def draw(axes, results):
    for result in results:
        axes.plot(result.times, share(result), label=result.resolution.removeprefix("20 across, "))
    axes.axhline(1, color="#d1652a")
    axes.set(xlabel="t [s]", ylabel="mean speed / exact", ylim=(0.9, 1.05))
    axes.legend(fontsize="x-small")
