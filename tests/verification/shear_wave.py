"""Decay of a wave of shear: rate against the sum over the lattice, order in time from it, order in space."""

import itertools

import numpy as np

from verification.suite import Run, bound_row, relative_row

NAME = "shear_wave"
TITLE = "shear wave, error at 8 ms"
HEIGHT, TIME = 0.01, 0.008  # [m], [s]
WAVE_NUMBER = 2 * np.pi / HEIGHT
SCHEMES = {"Crank–Nicolson": 0.5, "backward Euler": 1.0}
STEPS = (1e-3, 5e-4, 2.5e-4)  # [s]


def run_of(across, theta, step):
    return Run(f"shear_wave_{across}_{theta}_{step}", "shear_wave", f"{across} a wave", {
        "resolution.spacing": HEIGHT / across,
        "domain.max": [8 * HEIGHT / across, 8 * HEIGHT / across, HEIGHT],
        "numerics.theta": theta,
        "numerics.max_time_step": step,
    })


def runs(quick):
    steps = STEPS[:2] if quick else STEPS
    waves = () if quick else (10, 40)
    return ([run_of(20, theta, step) for theta, step in itertools.product(SCHEMES.values(), steps)] +
            [run_of(across, 0.5, STEPS[-1]) for across in waves])


def viscous_weight(q):
    """The weight of velocity differences for a support of 1 in three dimensions: 5 int w x^2 y^2 = 1."""
    def shape(t):
        return 0.0155 * t**2 + 0.1471 * t**4 + 0.2673 * t**5 + 0.0897 * t**7 + 0.4804 * t**8

    shells = (np.arange(4000) + 0.5) / 4000
    fourth = np.mean(4 * np.pi * shells**6 * shape(1 - shells**2))
    return 3 / fourth * shape(1 - q**2)


def lattice_rate(result):
    """Rate at which the scheme damps the wave on its lattice, before time is discrete [1/s]: the sum in (7) for a
    velocity along x that varies along z."""
    h = result.case["resolution"]["support_ratio"]
    reach = np.arange(-np.ceil(h), np.ceil(h) + 1)
    x, y, z = (part.ravel() for part in np.meshgrid(reach, reach, reach))
    r = np.sqrt(x**2 + y**2 + z**2)
    near = (r > 0) & (r < h)
    x, z, r = x[near], z[near], r[near]
    damping = 1 - np.cos(WAVE_NUMBER * result.spacing * z)
    total = 10 * np.sum(viscous_weight(r / h) / h**7 * x**2 * damping) / result.spacing**2  # lengths in spacings
    return result.case["numerics"]["viscosity_correction"] * viscosity(result) * total


def viscosity(result):
    return result.fluid()["dynamic_viscosity"] / result.fluid()["density"]


def amplitude(result):
    state = result.state()
    wave = np.sin(WAVE_NUMBER * state.position[:, 2])
    return np.sum(state.velocity[:, 0] * wave) / np.sum(wave**2) / 1e-3, result.velocity_time(state)


def error_in_time(result):
    left, time = amplitude(result)
    return abs(left - np.exp(-lattice_rate(result) * time))


def keys(result):
    return result.case["numerics"]["theta"], result.case["numerics"]["max_time_step"]


def rate_of(result):
    """The rate that one step's factor (1 - z/2)/(1 + z/2), z = rate dt, says."""
    left, time = amplitude(result)
    step = keys(result)[1]
    factor = left**(step / time)
    return 2 * (1 - factor) / (1 + factor) / step


def rows(results):
    table = []
    middle = [r for r in results if round(HEIGHT / r.spacing) == 20]
    for name, theta in SCHEMES.items():
        series = sorted((r for r in middle if keys(r)[0] == theta), key=lambda r: -keys(r)[1])
        fine, coarse = series[-1], series[-2]
        order = np.log2(error_in_time(coarse) / error_in_time(fine))
        table.append(bound_row(fine.resolution, f"order in time, {name}", order, (1.9 if theta == 0.5 else 0.9, None)))
    finest = min(keys(r)[1] for r in results)
    space = sorted((r for r in results if keys(r) == (0.5, finest)), key=lambda r: -r.spacing)
    for result in space:
        table.append(relative_row(result.resolution, "rate of decay on the lattice, its sum [1/s]", rate_of(result),
                                  lattice_rate(result), 1e-3))
    if len(space) == 3:
        rates = [rate_of(result) for result in space]
        order = np.log2((rates[1] - rates[0]) / (rates[2] - rates[1]))
        table.append(bound_row("10, 20, 40 a wave", "order in space, of the rate to its limit", order, (1.9, None)))
    for result in space:
        table.append(relative_row(result.resolution, "rate of decay, νk² [1/s]", rate_of(result),
                                  viscosity(result) * WAVE_NUMBER**2))
    return table


def draw(axes, results):
    for (name, theta), mark in zip(SCHEMES.items(), "os"):
        chosen = [r for r in results if keys(r)[0] == theta and round(HEIGHT / r.spacing) == 20]
        steps = np.array(sorted(keys(r)[1] for r in chosen))
        errors = [error_in_time(next(r for r in chosen if keys(r)[1] == step)) for step in steps]
        axes.loglog(1e3 * steps, errors, mark + "-", label=name)
        slope = 2 if theta == 0.5 else 1
        axes.loglog(1e3 * steps, errors[0] * (steps / steps[0])**slope, ":", color="grey")
    axes.set_xticks(1e3 * np.array(STEPS), [f"{1e3 * step:g}" for step in STEPS])
    axes.minorticks_off()
    axes.set(xlabel="Δt [ms]", ylabel="error of the amplitude")
    axes.legend(fontsize="x-small")
