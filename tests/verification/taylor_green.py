"""Taylor and Green's vortices: decay of the kinetic energy."""

import numpy as np

from verification.suite import Run, profile_row, relative_row

NAME = "taylor_green"
TITLE = "Taylor–Green vortices"
WAVE_NUMBER = 2 * np.pi * 50  # [1/m]
SPEED = 0.05  # [m/s]


def runs(quick):
    return [Run(f"taylor_green_{n}", "taylor_green", f"{n} a wavelength", {"resolution.spacing": 0.02 / n})
            for n in ((40,) if quick else (20, 40, 80))]


def decay(result):
    """Rate at which speeds fall [1/s]."""
    return 2 * result.fluid()["dynamic_viscosity"] / result.fluid()["density"] * WAVE_NUMBER**2


def energies(result):
    return np.array([0.5 * np.mean(np.sum(state.velocity**2, axis=1)) for state in result.states()])


def rows(results):
    table = []
    for result in results:
        energy = energies(result)
        measured = -np.polyfit(result.times, np.log(energy), 1)[0] / 2
        table.append(relative_row(result.resolution, "rate of decay [1/s]", measured, decay(result), None))
        state = result.state()
        k = WAVE_NUMBER * state.position
        speed = SPEED * np.exp(-decay(result) * state.time)
        exact = speed * np.stack([np.sin(k[:, 0]) * np.cos(k[:, 2]), -np.cos(k[:, 0]) * np.sin(k[:, 2])])
        table.append(profile_row(result.resolution, f"velocity at e^(−{decay(result) * state.time:.1f})",
                                 state.velocity[:, [0, 2]].T, exact))
    return table


def draw(axes, results):
    for result in results:
        energy = energies(result)
        axes.semilogy(1e3 * result.times, energy / energy[0], "o", markersize=2, label=result.resolution)
    times = results[-1].times
    axes.semilogy(1e3 * times, np.exp(-2 * decay(results[-1]) * times), color="#d1652a")
    axes.set(xlabel="t [ms]", ylabel="energy")
    axes.legend(fontsize="x-small")
