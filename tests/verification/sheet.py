"""What hangs and stretches: a sheet resists with 4 eta, a thread with 3 eta (Trouton), which takes tension.

Slender and without inertia, material at the height X above the tip has become longer by 1/(1 - a X t), a = rho g/4 eta or
rho g/3 eta. The wall costs some of that: finite elements (Taylor and Hood's, quadrilaterals, two meshes 0.01 % apart) for
Stokes flow of the shapes at the start give 0.01934 m/s for the mean speed of the tip of the sheet and 0.006407 m/s for
that of the thread, where the slender forms rho g L^2/(8 eta) and rho g L^2/(6 eta) give 0.01962 and 0.00654 m/s. These
are taken to the time of the comparison by the slender form."""

import numpy as np

from verification.suite import Run, bound_row, relative_row

NAME = "sheet"
TITLE = "hanging sheet and thread, speed of the tip"
SHEET, THREAD = 0.01934, 0.006407  # at the start [m/s]
PIECE = (0.070, 0.075)  # above the tip, of which the stretch is measured [m]
STRETCHES = (1.5, 2.0)
TIME = 0.03  # [s]
ROWS = ("rows of particles that are pulled apart resist too much (lattice sums of a prototype: 1.2 to 1.5 times where they are "
        "1.25 to 1.8 times as far apart); with jitter 0.2 the sheet 5 across has 1.76 for 1.8, and tears then")
MISSES = {
    "5 across: speed of the tip at 0.03 s [m/s]":
        "too few particles for its edges: −11 % at 4 across, −4.8 % at 5, −1.7 % at 6, +0.7 % at 8, +1.3 % at 10 and 20",
    "5 in the radius, thread: speed of the tip at 0.03 s [m/s]":
        "the viscous weight at a free surface: with viscous_weight = \"value\" −1.1 % (but the sheet 10 across −4 %); a tolerance "
        "of 0.0005 gives the same; with 4 and 7 in the radius 8 and 6 %, with 10 (20 mm long, 0.04 s) still 6 %",
    "5 across, pulled twofold: stretch below the wall where the closed form has 2": ROWS,
    "10 across, pulled twofold: stretch below the wall where the closed form has 2": ROWS + "; this one tears after 0.9 s, at 1.59, with jitter after 0.75 s",
}


def sheet(across, **settings):
    return {"resolution.spacing": 0.005 / across, **settings}


def pulled(across):
    """With the watch on energy wide open."""
    return Run(f"sheet_{across}_twofold", "sheet", f"{across} across, pulled twofold",
               sheet(across, **{"output.end_time": end_time(), "output.interval": end_time() / 75,
                                "limits.max_energy_growth": 10,
                                "domain.min": [-0.01, -1, -0.3]}))


def runs(quick):
    quasi_static = [Run(f"sheet_{n}", "sheet", f"{n} across", sheet(n)) for n in ((5,) if quick else (5, 10, 20))]
    return quasi_static if quick else [*quasi_static, pulled(5), pulled(10), Run("thread", "thread", "5 in the radius, thread")]


def slender_rate(trouton):
    """a [1/(m s)]"""
    return 1000 * 9.81 / (trouton * 400)


def time_of(stretch):
    """When the piece has this stretch, by the closed form."""
    return (1 - 1 / stretch) / (slender_rate(4) * np.mean(PIECE))


def end_time():
    return round(float(time_of(STRETCHES[-1])), 4)


def tip_speed(result, times):
    """By finite elements and the slender form: the integral of a X/(1 - a X t)^2 over the length."""
    thread = result.run.case == "thread"
    length, start, a = (0.04, THREAD, slender_rate(3)) if thread else (0.08, SHEET, slender_rate(4))
    part = np.maximum(a * length * times, 1e-3)
    return start * 2 / part**2 * (np.log1p(-part) + part / (1 - part))


def lowest(result, state):
    """Mean speed of the lowest layer of particles: as many as it had [m/s]."""
    height = result.state(0).position[:, 2]
    layer = np.sum(height < np.min(height) + 0.5 * result.spacing)
    return -np.mean(state.velocity[np.argsort(state.position[:, 2])[:layer], 2])


def stretch(result, wanted):
    """Of the piece at the time at which the closed form has `wanted`: measured and exact."""
    time = result.times[np.argmin(np.abs(result.times - time_of(wanted)))]
    start, now = result.ordered(0), result.ordered(time)
    above = start[:, 2] + 0.08
    low, high = (np.abs(above - edge) < 0.51 * result.spacing for edge in PIECE)
    x = np.array([np.mean(above[low]), np.mean(above[high])])
    closed = -np.diff(np.log(1 - slender_rate(4) * x * time))[0] / (slender_rate(4) * time)
    return (np.mean(now[high, 2]) - np.mean(now[low, 2])) / np.diff(x)[0], closed / np.diff(x)[0]


def growth(result):
    """Largest, as the watch on energy has it, up to where the closed form has the first stretch."""
    history = result.history
    kinetic, potential, dissipated = (np.asarray(history[f"{kind}_energy_J"]) for kind in ("kinetic", "potential", "dissipated"))
    gained = kinetic + potential - potential[0] + dissipated
    time = np.asarray(history["time_s"])
    chosen = (time > TIME) & (time < time_of(STRETCHES[0]))
    return np.max(gained[chosen] / (kinetic + dissipated)[chosen])


def rows(results):
    table = []
    for result in results:
        if "twofold" in result.run.name:
            table += [relative_row(result.resolution, f"stretch below the wall where the closed form has {wanted:g}",
                                   *stretch(result, wanted), 0.1) for wanted in STRETCHES]
            table.append(bound_row(result.resolution, "energy without a source / dissipated, largest", growth(result), (None, 0.05)))
        else:
            table.append(relative_row(result.resolution, "speed of the tip at 0.03 s [m/s]", lowest(result, result.state(TIME)),
                                      float(tip_speed(result, TIME)), 0.03))
    return table


def draw(axes, results):
    for result in results:
        if "twofold" not in result.run.name:
            speeds = np.array([lowest(result, state) for state in result.states()])
            axes.plot(1e3 * result.times, speeds / tip_speed(result, result.times), "o-", markersize=2, label=result.resolution)
    axes.axhline(1, color="#d1652a")
    axes.set(xlabel="t [ms]", ylabel="speed of the tip / exact", ylim=(0.8, 1.2))
    axes.legend(fontsize="x-small")
