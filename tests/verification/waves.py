"""Surface waves of small height: a standing gravity wave, and a wave of very viscous fluid that sinks into level.
The standing wave starts without the layer of vorticity below its surface, so it decays a little faster at first."""

import numpy as np

from verification.closed_forms import creeping_wave_rate, surface_wave
from verification.suite import Run, relative_row

NAME = "waves"
TITLE = "waves, height"


def runs(quick):
    if quick:
        return [Run("levelling_40", "levelling", "40 a wavelength", {"resolution.spacing": 1e-3, "output.end_time": 0.1})]
    return [Run("standing_wave", "standing_wave", "100 a wavelength"), Run("levelling", "levelling", "80 a wavelength"),
            Run("levelling_jitter", "levelling", "80 a wavelength, jitter 0.2", {"region.0.jitter": 0.2})]


def length(result):
    return result.case["domain"]["max"][0] - result.case["domain"]["min"][0]


def wave_number(result):
    return 2 * np.pi / length(result)


def height(result):
    """Of the surface d + a cos(kx) at each snapshot: integral of cos(kx) over the fluid is a L/2 [m]."""
    k = wave_number(result)
    return np.array([2 * result.spacing**2 / length(result) * np.sum(np.cos(k * state.position[:, 0]))
                     for state in result.states()])


def layer(result):
    """Wave number, depth and kinematic viscosity."""
    boxes = result.case["region"][0]["shapes"]
    return wave_number(result), 0.5 * (boxes[0]["max"][2] + boxes[-1]["max"][2]), \
        result.fluid()["dynamic_viscosity"] / result.fluid()["density"]


def exact(result):
    """e^(st)"""
    k, depth, nu = layer(result)
    wave = "wave" in result.run.case
    return surface_wave(1j * np.sqrt(9.81 * k) - 2 * nu * k**2 if wave else -creeping_wave_rate(k, depth, nu), k, depth, nu)


def fit(result):
    """Height = Re C e^(st): s and C by Gauss and Newton from the exact s."""
    times, a, s = result.times, height(result), exact(result)
    for _ in range(20):
        factor = np.exp(s * times)
        parts = np.stack([factor.real, -factor.imag, times * factor.real, -times * factor.imag], axis=1)
        c = np.linalg.lstsq(parts, a, rcond=None)[0]
        s = s + complex(c[2], c[3]) / complex(c[0], c[1])
    return s, complex(c[0], c[1])


def level_rate(result):
    """After the start, in which the rows of the crest become a surface and jittered particles settle."""
    late = result.times > 0.2 * result.times[-1]
    return -np.polyfit(result.times[late], np.log(height(result)[late]), 1)[0]


def rows(results):
    table = []
    for result in results:
        s = exact(result)
        if abs(s.imag) > 0:
            found = fit(result)[0]
            table += [relative_row(result.resolution, "frequency of a standing wave [rad/s]", found.imag, s.imag, 0.02),
                      relative_row(result.resolution, "its rate of decay [1/s]", -found.real, -s.real, 0.2)]
        else:
            table.append(relative_row(result.resolution, "rate of levelling [1/s]", level_rate(result), -s.real, 0.04))
    return table


def draw(axes, results):
    for result in results:
        a, s = height(result), exact(result)
        scale = np.max(np.abs(a))
        axes.plot(result.times / result.times[-1], a / scale, "o", markersize=2, label=result.resolution)
        fine = np.linspace(0, result.times[-1], 300)
        wave = abs(s.imag) > 0
        start = fit(result)[1] if wave else a[0]
        axes.plot(fine / fine[-1], (start * np.exp((s if wave else s.real) * fine)).real / scale, color="#d1652a", linewidth=0.7)
    axes.set(xlabel="t / end", ylabel="height / greatest")
    axes.legend(fontsize="x-small")
