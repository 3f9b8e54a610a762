"""The surface of a liquid at vertical walls under gravity."""

import numpy as np

from verification.drops import SUPPORT, filled
from verification.suite import Run, bound_row, number, relative_row

NAME = "meniscus"
TITLE = "silicone oil between walls of 60° and 120°"
WIDTH = 0.03  # [m]
ANGLES = (60, 120)  # [degrees]
ON_A_DROP = {60: 61.5, 120: 125.5}  # what a drop makes of them at 20 in its radius [degrees]


def runs(quick):
    settings = {"resolution.spacing": 1e-3, "numerics.tension_limit": 20, "output.end_time": 1.5} if quick else {}
    scale = "7.5" if quick else "15"
    return [Run(f"meniscus_{angle}", "meniscus", f"{scale} in a capillary length", {"wall.0.contact_angle": angle, **settings})
            for angle in ANGLES]


def surface_between_walls(angle, length):
    """x from the middle and height of the surface over its middle, up to the wall [m]. The slope psi turns by the height
    over the level of no pressure difference, d psi/ds = zeta/length^2, so zeta^2 = zeta_0^2 + 2 length^2 (1 - cos psi)
    (Landau, Lifshitz, Fluid Mechanics, section 61); zeta_0 is found from the distance of the walls."""
    psi = np.linspace(0, abs(np.pi / 2 - np.radians(angle)), 2001)

    def heights(start):
        return np.sqrt(start**2 + 2 * length**2 * (1 - np.cos(psi)))

    def places(start):
        slope = np.cos(psi) * length**2 / heights(start)
        return np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(psi))])

    low, high = 1e-9 * length, 1e3 * length
    for _ in range(100):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if places(middle)[-1] > WIDTH / 2 else (low, middle)
    return places(low), np.sign(90 - angle) * (heights(low) - low)


def rise(angle, length):
    """Of the surface at the wall over its middle [m]."""
    return surface_between_walls(angle, length)[1][-1] if angle != 90 else 0.0


def surface(state, spacing):
    """Heights where the smoothed fluid falls to one half, farther than the support radius from the walls."""
    x, h = state.position[:, [0, 2]], SUPPORT * spacing
    columns = np.arange(h, WIDTH - h, spacing)
    found = []
    for column in columns:
        near = x[np.abs(x[:, 0] - column) < h]
        heights = np.max(near[:, 1]) + np.arange(-2, 1, 0.05) * spacing
        inside = np.nonzero(filled(np.c_[np.full(len(heights), column), heights], near, spacing) > 0.5)[0]
        found.append(heights[inside[-1]])
    return columns - WIDTH / 2, np.array(found)


def fitted_angle(x, z, length):
    """Contact angle of the closed form nearest to heights z, up to a shift [degrees]."""
    def misfit(angle):
        exact = np.interp(np.abs(x), *surface_between_walls(angle, length))
        return np.std(z - exact)

    angles = np.arange(20, 160.05, 0.1)
    return angles[np.argmin([misfit(angle) for angle in angles])]


def late_surface(result):
    """Mean over the last half of the run."""
    surfaces = [surface(state, result.spacing) for state in [result.state(t) for t in result.times[len(result.times) // 2::5]]]
    return surfaces[0][0], np.mean([z for _, z in surfaces], axis=0)


def capillary_length(result):
    fluid = result.fluid()
    return np.sqrt(fluid["surface_tension"] / fluid["density"] / abs(result.case["gravity"]["acceleration"][2]))


def rows(results):
    table = []
    for angle, result in zip(ANGLES, results):
        length = capillary_length(result)
        found = fitted_angle(*late_surface(result), length)
        table += [relative_row(result.resolution, f"rise at a wall of {angle}° [m]", rise(found, length),
                               rise(angle, length), 0.05),
                  relative_row(result.resolution, f"the same, against the {ON_A_DROP[angle]}° of a drop [m]",
                               rise(found, length), rise(ON_A_DROP[angle], length)),
                  bound_row(result.resolution, f"contact angle that fits it, wall of {angle}° [°]", found,
                            (angle - 5, angle + 5))]
    return table


def draw(axes, results):
    for angle, result in zip(ANGLES, results):
        x, z = late_surface(result)
        exact_x, exact_z = surface_between_walls(angle, capillary_length(result))
        shift = np.mean(z - np.interp(np.abs(x), exact_x, exact_z))
        axes.plot(1e3 * x, 1e3 * z, ".", label=f"{number(angle)}°")
        axes.plot(1e3 * np.r_[-exact_x[::-1], exact_x], 1e3 * (np.r_[exact_z[::-1], exact_z] + shift), "k-", lw=0.8)
    axes.set(xlabel="x [mm]", ylabel="z [mm]")
    axes.legend(fontsize=6)


CAUSE = "contact lines stick to a wall without slip: with it 64.5° and 118.4°; 1° of the angle is 3 % of the rise"
MISSES = {f"{scale} in a capillary length: {quantity.format(angle)}": CAUSE
          for scale, quantities in (("7.5", ("rise at a wall of {}° [m]", "contact angle that fits it, wall of {}° [°]")),
                                    ("15", ("rise at a wall of {}° [m]",)))
          for angle in ANGLES for quantity in quantities}
MISSES["15 in a capillary length: contact angle that fits it, wall of 60° [°]"] = CAUSE
