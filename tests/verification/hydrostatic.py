"""Oil and Bingham slurry at rest in a tank: pressure, and no motion. The slurry and one tank of oil have the sound speed
that is chosen by itself. And what the two faces of a valley bear, by the forces between particles and by areas."""

import numpy as np

from verification.suite import Row, Run, bound_row, limit, percent, relative_row, verdict

NAME = "hydrostatic"
TITLE = "tank at rest, pressure"
SPEEDS = {"newtonian": 1.2e-4, "bingham": 1e-6}  # rms, that are allowed [m/s]


def runs(quick):
    end = {"output.end_time": 0.2} if quick else {}
    auto = {"numerics.sound_speed": "auto"}
    return [Run("hydrostatic", "/hydrostatic_tank", "16 deep", end),
            Run("hydrostatic_auto", "/hydrostatic_tank", "16 deep, sound speed auto", {**end, **auto}),
            Run("hydrostatic_bingham", "/hydrostatic_bingham", "16 deep, Bingham", {**end, **auto}),
            Run("valley", "valley", "valley, 25 deep", end)]


def pressure(result, state):
    """Measured and exact [Pa]; the surface lies where the volume says."""
    depth = np.max(result.state(0).position[:, 2]) + 0.5 * result.spacing
    return state.pressure, result.fluid()["density"] * 9.81 * (depth - state.position[:, 2]), depth


def valley(result):
    """The reaction to the pair forces is the weight, exactly; along a face's normal it and area times mean pressure are
    half rho g H^2 / sin(angle), with H of the volume."""
    volume = len(result.state(0).position) * result.spacing**2
    slopes = np.radians([20, 50])
    depth = np.sqrt(2 * volume / np.sum(1 / np.tan(slopes)))
    weight = result.fluid()["density"] * 9.81
    history = {name: column[-1] for name, column in result.history.items()}
    table = [relative_row(result.resolution, "weight on both faces [N/m]",
                          -sum(history[f"force{angle}_pressure_z_N_m"] + history[f"force{angle}_viscous_z_N_m"]
                               for angle in (20, 50)), weight * volume, 0.001)]
    for angle, slope, side in zip((20, 50), slopes, (-1, 1)):
        exact = 0.5 * weight * depth**2 / np.sin(slope)
        pairs = (side * np.sin(slope) * history[f"force{angle}_pressure_x_N_m"]
                 - np.cos(slope) * history[f"force{angle}_pressure_z_N_m"])
        areas = history[f"contact{angle}_wetted_m"] * history[f"contact{angle}_mean_pressure_Pa"]
        table += [relative_row(result.resolution, f"force on the face at {angle}° [N/m]", pairs, exact, 0.02),
                  relative_row(result.resolution, f"force on the face at {angle}°, by its area [N/m]", areas, exact, 0.02)]
    return table


def rows(results):
    table = valley(results[-1])
    for result in results[:-1]:
        state = result.state()
        measured, exact, depth = pressure(result, state)
        error = np.sqrt(np.mean((measured - exact)**2)) / (result.fluid()["density"] * 9.81 * depth)
        speed = np.sqrt(np.mean(np.sum(state.velocity**2, axis=1)))
        rheology = result.fluid()["rheology"]
        target = 0.005 if rheology == "newtonian" else None
        table += [Row(result.resolution, "pressure, rms error / ρgH", "profile", "profile", percent(error), limit(target),
                      verdict(error, target)),
                  bound_row(result.resolution, "rms speed [m/s]", speed, (None, SPEEDS[rheology]))]
    return table


def draw(axes, results):
    result = results[0]
    state = result.state()
    measured, exact, _ = pressure(result, state)
    axes.plot(measured, 1e3 * state.position[:, 2], ".", color="#31688e", markersize=1)
    axes.plot(exact, 1e3 * state.position[:, 2], color="#d1652a", linewidth=0.7)
    axes.set(xlabel="p [Pa]", ylabel="z [mm]")
