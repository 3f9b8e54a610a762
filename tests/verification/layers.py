"""Fluids of unequal density: at rest with the light one above, and turned over where the heavy one is not below."""

import numpy as np

from verification.suite import Row, Run, bound_row, percent

NAME = "layers"
TITLE = "light fluid on a heavy one, pressure"
RATIOS = (1.1, 2.7, 10)
YIELD_STRESS = 5  # [Pa]
PRESSURE = "pressure, rms error / pressure at the bottom"


def settings(ratio, stress, dimensions):
    keys = {"fluid.heavy.density": 1000 * ratio, "resolution.dimensions": dimensions,
            "fluid.light.yield_stress": stress, "fluid.heavy.yield_stress": stress}
    return keys | ({"domain.periodic": '["y"]'} if dimensions == 3 else {})


def at_rest(ratio, stress, dimensions=2):
    return Run(f"layers_{ratio}_{stress}_{dimensions}", "layers",
               f"{dimensions}-D, 1 : {ratio:g}, " + ("Bingham" if stress else "Newtonian"), settings(ratio, stress, dimensions))


def runs(quick):
    ratios = (2.7,) if quick else RATIOS
    table = [at_rest(ratio, stress) for stress in (0, YIELD_STRESS) for ratio in ratios]
    if not quick:
        table += [at_rest(2.7, stress, 3) for stress in (0, YIELD_STRESS)]
    table.append(Run("slag_on_metal", "slag_on_metal", "slag on metal"))
    table.append(Run("overturn", "overturn", "heavy beside light", {"output.end_time": 1 if quick else 2}))
    return table if quick else table + [heavy_above()]


def heavy_above():
    """Jittered, for evenly spaced rows would stay as they are for long."""
    return Run("layers_overturn", "layers", "heavy above light", {
        "region.0.fluid": "light", "region.1.fluid": "heavy", "region.0.jitter": 0.3, "region.1.jitter": 0.3,
        "fluid.light.plastic_viscosity": 0.02, "fluid.heavy.plastic_viscosity": 0.02, "output.end_time": 2})


def turns_over(result):
    return result.run.name.endswith("overturn")


def is_light(result):
    densities = [fluid["density"] for fluid in result.case["fluid"].values()]
    return result.last("Fluid") == int(np.argmin(densities))


def boxes(result):
    """Density, bottom and top [m] of the regions, the lower one first."""
    parts = [(result.case["fluid"][region["fluid"]]["density"], region["shapes"][0]["min"][2], region["shapes"][0]["max"][2])
             for region in result.case["region"]]
    return sorted(parts, key=lambda part: part[1])


def weight(result, z):
    """Of what lies above [Pa]."""
    return sum(9.81 * density * np.clip(top - z, 0, top - bottom) for density, bottom, top in boxes(result))


def gap(result):
    """From the highest row of the heavy fluid to the lowest of the light one, in the middle 40 % of the tank [spacings]:
    means of as many particles as a row has there."""
    x, z = result.state().position[:, 0], result.state().position[:, 2]
    middle = np.abs(x / result.case["region"][0]["shapes"][0]["max"][0] - 0.5) < 0.2
    light = is_light(result)
    depth = (boxes(result)[0][2] - boxes(result)[0][1]) / result.spacing
    row = max(1, round(np.sum(middle & ~light) / depth))
    return (np.mean(np.sort(z[middle & light])[:row]) - np.mean(np.sort(z[middle & ~light])[-row:])) / result.spacing


def rows_at_rest(result):
    state = result.state()
    speed = np.sqrt(np.mean(np.sum(state.velocity**2, axis=1)))
    z = state.position[:, 2]
    error = np.sqrt(np.mean((state.pressure - weight(result, z))**2)) / float(weight(result, np.zeros(1))[0])
    return [bound_row(result.resolution, "rms speed [m/s]", speed, (None, 2e-4)),
            Row(result.resolution, PRESSURE, "profile", "profile", percent(error),
                "0.5 %", bool(error <= 0.005)),
            bound_row(result.resolution, "gap between the fluids [Δx]", gap(result), (0.85, 1.15))]


def rows_of_levels(result):
    """Mean heights of both fluids against those of level layers; 3 % of the depth."""
    z, light = result.state().position[:, 2], is_light(result)
    depth = max(top for _, _, top in boxes(result))
    share = np.mean(~light)  # of the depth that the heavy fluid takes
    table = []
    for name, heights, exact in (("heavy", z[~light], share * depth / 2), ("light", z[light], (1 + share) * depth / 2)):
        error = abs(np.mean(heights) - exact) / depth
        table.append(Row(result.resolution, f"mean height, {name} fluid [m]", f"{np.mean(heights):.4g}", f"{exact:.4g}",
                         percent(error), "3 % of depth", bool(error <= 0.03)))
    return table


def rows(results):
    return [row for result in results for row in (rows_of_levels if turns_over(result) else rows_at_rest)(result)]


def draw(axes, results):
    result = results[0]
    state = result.state()
    z = np.linspace(0, boxes(result)[1][2], 100)
    axes.plot(state.pressure, 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(weight(result, z), 1e3 * z, color="#d1652a", linewidth=0.7)
    axes.set(xlabel="p [Pa]", ylabel="z [mm]")
