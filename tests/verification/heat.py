"""Heat: slabs, steel, freezing, surfaces, and what temperature makes of a flow, against closed forms."""

import numpy as np

from verification import heat_forms as forms
from verification.suite import Run, bound_row, profile_row, relative_row

NAME = "heat"
TITLE = "heat"
MISSES = {
    "slab, 20 across, jitter: temperature": "disorder lowers the conductance (cuda/README.md, Heat): heat −0.8 %; "
                                            "sheared fluid is as a lattice within 0.3 %",
}

LAYER_STEP = 2e-3  # [s] of the finite volumes


def runs(quick):
    static = [Run("heat_slab", "heat_slab", "slab, 20 across"),
              Run("heat_slab_jitter", "heat_slab", "slab, 20 across, jitter", {"region.0.jitter": 0.25}),
              *(Run(f"heat_slab_{biot}", "heat_slab", f"slab, contact, Biot {biot}", contact(biot)) for biot in (1, 5, 50)),
              Run("heat_slab_alone", "heat_slab", "slab, nothing moves", {"thermal.flow_until": 0, "numerics.sound_speed": 1}),
              Run("heat_steel", "heat_steel", "steel, 1 mm"),
              Run("heat_flux", "heat_flux", "wall with a flux, 20 deep"),
              *(Run(f"heat_freezing_{width}", "heat_freezing", f"freezing over {width} K, 1 mm", freezing_over(width))
                for width in (0, 10, 50)),
              Run("heat_area", "heat_area", "sheets"), Run("heat_area_2d", "heat_area", "sheets, 2-D", FLAT),
              *(Run(f"heat_tilted_{name}", "heat_tilted", f"plate tilted {tilt}", {"region.0.shapes": plate(turn)})
                for name, tilt, turn in TILTS),
              Run("skull", "/skull", "skull, 40 across"),
              Run("heat_sheet", "heat_sheet", "sheet, 20 across"),
              Run("heat_sheet_radiation", "heat_sheet", "sheet, 20 across, radiation", RADIATION)]
    flows = [Run("heat_poiseuille", "heat_poiseuille", "channel, viscosities 1 : 10, 20 across"),
             Run("heat_poiseuille_1000", "heat_poiseuille", "channel, viscosities 1 : 1000, 20 across", channel(1000, 28)),
             *(Run(f"heat_poiseuille_{model}", "heat_poiseuille", f"channel, yield stress 0 to 100 Pa, {model}, 20 across",
                   {**PASTE, "numerics.yield": f'"{model}"'}) for model in ("regularised", "exact")),
             *(Run(f"heat_pool_{eta}", "heat_pool", f"pool after a dam break, {eta} Pa s", {"fluid.slag.dynamic_viscosity": eta})
               for eta in (0.1, 1)),
             Run("heat_crust", "heat_crust", "melt over crust, 20 across"), Run("ring_on_roll", "ring_on_roll", "crust on a roll"),
             Run("ring_on_surface", "ring_on_roll", "crust on a roll, by surface_angular_velocity", SURFACE)]
    if quick:
        return [run for run in static + flows if run.name not in SLOW]
    return [*static, Run("heat_sphere", "heat_sphere", "sphere, radius 10"), *flows,
            *(Run(f"heat_couette_{nahme}", "heat_couette", f"friction, Nahme {nahme}, 20 across", friction(nahme))
              for nahme in (1, 8, 40)), Run("heat_layer", "heat_layer", "layer on steel, 1 mm"),
            Run("heat_layer_alone", "heat_layer", "layer on steel, nothing moves", {"thermal.flow_until": 0})]


# Left out by --quick: half of its time.
SLOW = {"skull", "ring_on_surface", "heat_pool_1", "heat_slab_1", "heat_slab_50", "heat_freezing_0", "heat_freezing_50",
        "heat_tilted_10", "heat_tilted_110", "heat_tilted_111"}

RADIATION = {"resolution.spacing": 5e-4, "thermal.surface_heat_transfer": 10, "fluid.slag.emissivity": 0.9,
             "domain.max": "[0.0045, 0.001, 0.03]", "output.end_time": 10, "output.interval": 5,
             "region.0.shapes": '[{shape="box", min=[0, -1, 0.005], max=[0.0045, 1, 0.015]}]'}


FLAT = {"resolution.dimensions": 2, "domain.min": "[0, -0.001, 0]", "domain.max": "[0.012, 0.001, 0.05]", "domain.periodic": '["x"]'}
# Turned about an axis by its length [rad]: to a plane of the lattice, or by an angle.
TILTS = [("none", "by 0°", (0, 0, 0)), ("10", "by 10°", (0, 0.17453, 0)), ("20", "by 20°", (0, 0.34907, 0)),
         ("110", "to (110)", (0, 0.785398, 0)), ("111", "to (111)", (-0.675511, 0.675511, 0)),
         ("123", "to (123)", (-0.572577, 0.286289, 0))]


def plate(turn):
    return f'[{{shape="box", min=[-0.014, -0.014, -0.005], max=[0.014, 0.014, 0.005], rotate={list(turn)}}}]'


def channel(ratio, push):
    """Thinner by `ratio` at 1600 K than at 1400 K, where it has as many Pa s."""
    rows = [[t, round(ratio ** (1 - (t - 1400) / 200), 6)] for t in np.arange(1400, 1602, 2.5).tolist()]
    return {"fluid.oil.liquid_viscosity": rows, "body_force.acceleration": [push, 0, 0]}


# From 0 Pa on the hot wall to 100 Pa on the cold one.
PASTE = {"fluid.oil.rheology": '"bingham"', "fluid.oil.solid_fraction": [[1300, 1], [1700, 0]],
         "fluid.oil.yield_stress": [[0.25, 0], [0.75, 100], [0.99, 148]], "body_force.acceleration": [40, 0, 0]}


# The account of the energy of a solid of 1e6 Pa s drifts in fp32 by some hundredths of what it has in a turn of a radian.
SURFACE = {"limits.max_energy_growth": 0.5, "wall": '[{name="roll", shapes=[{shape="cylinder", start=[0, -1, 0], end=[0, 1, 0], radius=0.02}], '
                   'surface_angular_velocity=[0, 1.5, 0]}]'}


def friction(nahme):
    """By the conductivity; diffusivity as in the file, where the number is 8."""
    return {"fluid.oil.conductivity": 0.1 / nahme, "fluid.oil.heat_capacity": 1 / nahme}


def freezing_over(width):
    return {"fluid.slag.solid_fraction": [[1623.15 - width, 1], [1623.15, 0]]}


def contact(biot):
    transfer = biot / 0.01  # h = Biot k / L
    return {"wall.0.contact_heat_transfer": transfer, "wall.1.contact_heat_transfer": transfer, "output.end_time": 20,
            "output.interval": 10}


def rows(results):
    by_case = {"heat_slab": slab_rows, "heat_steel": steel_rows, "heat_freezing": freezing_rows,
               "heat_flux": flux_rows, "heat_area": area_rows, "heat_tilted": tilted_rows, "/skull": skull_rows, "heat_sheet": sheet_rows,
               "heat_sphere": sphere_rows, "heat_poiseuille": poiseuille_rows, "heat_crust": crust_rows, "ring_on_roll": ring_rows,
               "heat_pool": pool_rows,
               "heat_couette": couette_rows, "heat_layer": layer_rows}
    found = []
    for result in results:
        found += by_case[result.run.case](result)
        if result.run.case in ("heat_slab", "heat_poiseuille", "heat_couette"):
            found.append(inside_row(result))
        found.append(bound_row(result.resolution, "heat lost without a trace, of all that moved", untold(result), (None, 1e-6)))
    return found


def inside_row(result):
    """Where fluid fills all between walls."""
    return bound_row(result.resolution, "heat lost by a surface that is not there [J]", abs(result.summary["heat"]["by_surface"]), (None, 0))


def untold(result):
    heat = result.summary["heat"]
    moved = (abs(heat["by_surface"]) + sum(abs(q) for q in heat["to_walls"].values()) + abs(heat["by_friction"]))
    return abs(heat["error"]) / max(moved, 1e-3 * abs(heat["start"]))


def width_of(result):
    return result.case["domain"]["max"][0] - result.case["domain"]["min"][0]


def heat_to(result, wall):
    """[J/m²] since the start."""
    return result.summary["heat"]["to_walls"][wall] / width_of(result)


def heights(result):
    return result.state().position[:, 2]


def slab_rows(result):
    height, slag = 0.02, result.fluid()
    alpha = slag["conductivity"] / (slag["density"] * slag["heat_capacity"])
    time = float(result.times[-1])
    above = (result.last("Temperature") - 500) / 1000
    transfer = result.case["wall"][0]["contact_heat_transfer"]
    jitter = result.case["region"][0]["jitter"] > 0
    if transfer == "perfect":
        fourier = alpha * time / height**2
        exact, mean = forms.slab_between_walls(heights(result) / height, fourier), forms.slab_between_walls_mean(fourier)
    else:
        biot, fourier = transfer * 0.5 * height / slag["conductivity"], alpha * time / (0.5 * height) ** 2
        exact = forms.slab_with_convection(2 * heights(result) / height - 1, biot, fourier)
        mean = forms.slab_with_convection_mean(biot, fourier)
    lost = slag["density"] * slag["heat_capacity"] * 1000 * height * (1 - mean)
    heat = heat_to(result, "floor") + heat_to(result, "lid")
    return [profile_row(result.resolution, "temperature", above, exact, 0.015 if jitter else 0.005),
            relative_row(result.resolution, "heat to the walls [J/m²]", heat, lost, 0.02 if jitter else 0.01)]


def steel_rows(result):
    slag, steel = result.fluid(), result.case["wall"][0]
    own = np.sqrt(slag["conductivity"] * slag["density"] * slag["heat_capacity"])
    other = np.sqrt(steel["conductivity"] * steel["density"] * steel["heat_capacity"])
    touch = (own * 1773 + other * 298) / (own + other)
    time = float(result.times[-1])
    heat = 2 * other * (touch - 298) * np.sqrt(time / np.pi)
    walls = result.walls
    surface = walls.field("Temperature", len(result.times) - 1)
    return [relative_row(result.resolution, "surface of the steel [K]", float(np.nanmean(surface)), touch, 0.01),
            relative_row(result.resolution, "heat to the steel [J/m²]", heat_to(result, "steel"), heat, 0.02)]


def flux_rows(result):
    slag, time, flux = result.fluid(), float(result.times[-1]), result.case["wall"][0]["heat_flux"]
    alpha = slag["conductivity"] / (slag["density"] * slag["heat_capacity"])
    def warming(depth):
        return flux / slag["conductivity"] * forms.half_space_with_flux(depth, alpha, time)
    z, t = heights(result), result.last("Temperature") - 1500
    surface = float(np.nanmean(result.walls.field("Temperature", len(result.times) - 1))) - 1500
    first = z < result.spacing
    return [profile_row(result.resolution, "temperature, above that of the start", t, warming(z), 0.01),
            relative_row(result.resolution, "first layer, above the start [K]", float(np.mean(t[first])),
                         float(np.mean(warming(z[first]))), 0.01),
            relative_row(result.resolution, "surface of the wall, above the start [K]", surface, float(warming(0.0)), 0.01),
            relative_row(result.resolution, "heat to the wall [J/m²]", heat_to(result, "floor"), -flux * time, 1e-6)]


def freezing_rows(result):
    width = result.case["fluid"]["slag"]["solid_fraction"]
    width = width[1][0] - width[0][0]
    time, dx, melting, start, wall = float(result.times[-1]), result.spacing, 1623.15, 1723.15, 373.15
    if width == 0:
        exact = forms.Neumann((1.6, 1050, 2800), (0.8, 1300, 2800), (wall, melting, start), 2.1e5)
        place = exact.front(time)
    else:
        slag = result.case["fluid"]["slag"]
        exact = forms.Freezing(forms.Material(slag["heat_capacity"], slag["conductivity"], slag["solid_fraction"],
                                              slag["latent_heat"]), slag["density"], wall, start)
        place = exact.front(melting - 0.5 * width, time)
    front = result.summary["measures"]["crust"]["volume"] / width_of(result)
    return [bound_row(result.resolution, "front off its place [spacings]", abs(front - place) / dx, (None, 0.5)),
            relative_row(result.resolution, "heat to the wall [J/m²]", heat_to(result, "floor"), exact.heat(time), 0.005)]


def areas(result):
    """Of each particle [m²; m in two dimensions], by what it has lost: through half a cell and h."""
    slag, thermal, time = result.fluid(), result.case["thermal"], float(result.times[-1])
    start = result.case["region"][0]["temperature"]
    transfer = 1 / (1 / thermal["surface_heat_transfer"] + 0.5 * result.spacing / slag["conductivity"])
    heat = slag["density"] * result.spacing ** result.case["resolution"]["dimensions"] * slag["heat_capacity"]
    lost = heat * (start - result.last("Temperature"))
    mean = 0.5 * (start + result.last("Temperature")) - thermal["ambient_temperature"]
    return lost / (transfer * mean * time)


def area_rows(result):
    flat = result.case["resolution"]["dimensions"] == 2
    area, z, face = areas(result), heights(result), 0.012 if flat else 0.012**2
    found = []
    for sheet in result.case["region"][0]["shapes"]:
        low, high = (sheet[end][2] for end in ("min", "max"))
        inside = (z > low) & (z < high)
        found.append(relative_row(result.resolution, f"surface, {round((high - low) / result.spacing)} across [m²]",
                                  float(np.sum(area[inside])), 2 * face, 0.05))
    return found


def tilted_rows(result):
    """Of its middle, by a window that ends softly: cos² of the place along the faces."""
    turn = np.array(result.case["region"][0]["shapes"][0]["rotate"], dtype=float)
    place, reach = turned_back(result.state().position, turn), 0.010
    window = np.prod([np.where(abs(place[:, k]) < reach, np.cos(0.5 * np.pi * place[:, k] / reach) ** 2, 0) for k in (0, 1)], axis=0)
    area = areas(result)
    inside = (abs(place[:, 2]) < 0.0025) & (window > 0)
    return [relative_row(result.resolution, "surface of its middle [m²]", float(np.sum(area * window)), 2 * reach**2, 0.08),
            bound_row(result.resolution, "surface inside, of a spacing's square", float(np.max(np.abs(area[inside]))) / 1e-6, (None, 1e-3))]


def turned_back(position, turn):
    """Rodrigues' formula, by the opposite angle."""
    angle = float(np.linalg.norm(turn))
    if angle == 0:
        return position
    axis = turn / angle
    return (position * np.cos(angle) - np.cross(axis, position) * np.sin(angle)
            + np.outer(position @ axis, axis) * (1 - np.cos(angle)))


def skull_rows(result):
    """Steady: the potential is linear between the panel's contact and the bath."""
    case, across = result.case, 0.04
    slag = forms.Material(case["fluid"]["slag"]["heat_capacity"], case["fluid"]["slag"]["conductivity"])
    bath, panel, transfer = 1773, case["wall"][0]["temperature"], case["wall"][0]["contact_heat_transfer"]
    touch = forms.bisect(lambda t: transfer * (t - panel) - (slag.potential(bath) - slag.potential(t)) / across, panel, bath)
    flux = transfer * (touch - panel)
    thick = (slag.potential(1473) - slag.potential(touch)) / flux
    height = case["domain"]["max"][2] - case["domain"]["min"][2]
    measures = result.summary["measures"]
    return [relative_row(result.resolution, "heat to the panel [W/m²]", measures["to_panel"]["rate"] / height, float(flux), 0.01),
            bound_row(result.resolution, "thickness off [spacings]",
                      abs(measures["skull"]["volume"] / height - float(thick)) / result.spacing, (None, 1))]


def sheet_rows(result):
    slag, time = result.fluid(), float(result.times[-1])
    lost = result.summary["heat"]["by_surface"] / width_of(result)
    if slag["emissivity"] > 0:
        material = forms.Material([(300, 1300), (2000, 1300)], [(300, 1), (2000, 1)])
        loss = forms.surface_loss(material, slag["emissivity"], 10, 300)
        half = forms.Slab(0.005, 100, 2800, material).run(1673, time, 2e-3, lambda *_: 0.0, loss)
        return [relative_row(result.resolution, "heat lost [J/m²]", lost, 2 * half.lost_above, 0.03)]
    half, transfer = 0.01, result.case["thermal"]["surface_heat_transfer"]
    fourier = slag["conductivity"] / (slag["density"] * slag["heat_capacity"]) * time / half**2
    mean = forms.slab_with_convection_mean(transfer * half / slag["conductivity"], fourier)
    full = slag["density"] * slag["heat_capacity"] * 2 * half * (1673 - 300)
    return [relative_row(result.resolution, "heat lost [J/m²]", lost, full * (1 - mean), 0.02)]


def sphere_rows(result):
    slag, time, radius = result.fluid(), float(result.times[-1]), 0.01
    fourier = slag["conductivity"] / (slag["density"] * slag["heat_capacity"]) * time / radius**2
    full = slag["density"] * slag["heat_capacity"] * 4 / 3 * np.pi * radius**3 * 1000
    lost = full * (1 - forms.sphere_with_convection_mean(1.0, fourier))
    return [relative_row(result.resolution, "heat lost [J]", result.summary["heat"]["by_surface"], lost, 0.05)]


def poiseuille_rows(result):
    y = np.linspace(0, 0.01, 2001)
    _, eta = np.array(result.case["fluid"]["oil"]["liquid_viscosity"]).T
    viscosity = eta[0] * (eta[-1] / eta[0]) ** (y / 0.01)
    push = 1000 * result.case["body_force"]["acceleration"][0]
    u = (forms.poiseuille_with_yield(y, viscosity, 100 * (1 - y / 0.01), push) if result.fluid()["rheology"] == "bingham"
         else forms.poiseuille_with_viscosity(y, viscosity, push))
    state = result.state()
    flow = float(np.mean(state.velocity[:, 0])) * 0.01
    exact = float(np.sum(0.5 * (u[1:] + u[:-1]) * np.diff(y)))
    near = 0.02 if result.fluid()["rheology"] == "bingham" else 0.01 if eta[0] < 100 * eta[-1] else 0.025
    return [profile_row(result.resolution, "velocity", state.velocity[:, 0], np.interp(state.position[:, 2], y, u), near),
            relative_row(result.resolution, "flow rate [m²/s]", flow, exact, near)]


def pool_rows(result):
    """From 1 s on, when it is flat: h (T - T_a) over the width of the trough."""
    history, start = result.history, 1.0
    first = int(np.argmin(np.abs(np.asarray(history["time_s"]) - start)))
    span = float(history["time_s"][-1]) - float(history["time_s"][first])
    lost = (float(history["heat_by_surface_J"][-1]) - float(history["heat_by_surface_J"][first])) / span
    surface = 0.5 * (float(history["max_temperature_K"][-1]) + float(history["min_temperature_K"][-1]))
    return [relative_row(result.resolution, "heat lost by the surface [W/m]", lost, 100 * (surface - 300) * 0.056, 0.04)]


def crust_rows(result):
    state = result.state()
    melt = result.last("SolidFraction") < 0.5
    exact = forms.film_start(state.position[melt, 2] - 0.01, 0.02, 1, 2600, 3.3552176, result.velocity_time(state))
    u = state.velocity[melt, 0]
    crust = float(np.sqrt(np.mean(state.velocity[~melt, 0] ** 2)))
    return [profile_row(result.resolution, "velocity of the melt", u, exact, 0.02),
            relative_row(result.resolution, "flow of the melt [m/s]", float(np.mean(u)), float(np.mean(exact)), 0.02),
            bound_row(result.resolution, "crust, over the melt", crust / float(np.mean(u)), (None, 1e-4))]


def ring_rows(result):
    def around(time):
        places = result.ordered(time)
        return places[:, 0] + 1j * places[:, 2]
    end = float(result.times[-1])
    start, now = around(0), around(end)
    angle = abs(float(np.angle(np.sum(now * np.conj(start)))))
    return [relative_row(result.resolution, "angle of the crust [rad]", angle, 1.5 * end, 1e-3),
            bound_row(result.resolution, "largest compression", result.summary["max_compression"], (None, 1e-3)),
            bound_row(result.resolution, "change of radius [spacings]",
                      float(np.max(np.abs(np.abs(now) - np.abs(start)))) / result.spacing, (None, 0.02))]


def couette_rows(result):
    stress, warming = forms.couette_with_friction(0.1 / result.fluid()["conductivity"])
    measured = abs(result.summary["measures"]["drag"]["viscous_force"]["x"]) / width_of(result)
    warmest = float(np.max(result.last("Temperature"))) - 1400
    return [relative_row(result.resolution, "stress [Pa]", measured, stress * 10 * 1 / 0.01, 0.01),
            relative_row(result.resolution, "largest warming [K]", warmest, warming / 0.01, 0.015)]


def layer_rows(result):
    case, time, cells = result.case, float(result.times[-1]), 200
    slag = forms.Material(case["fluid"]["slag"]["heat_capacity"], case["fluid"]["slag"]["conductivity"],
                          case["fluid"]["slag"]["solid_fraction"], case["fluid"]["slag"]["latent_heat"])
    steel = case["wall"][0]
    wall = forms.ThickWall(steel["conductivity"], steel["density"], steel["heat_capacity"], steel["temperature"],
                           steel["contact_heat_transfer"])
    air = forms.surface_loss(slag, 0.85, 15, 298)
    exact = forms.Slab(0.02, cells, 2750, slag).run(1773, time, LAYER_STEP, wall.loss(slag), air)
    z, t = heights(result), result.last("Temperature")
    rms = float(np.sqrt(np.mean((t - np.interp(z, exact.height, exact.temperature)) ** 2)))
    solid = slag.solid(exact.temperature) >= 0.5
    crust = float(np.sum(solid & (exact.height < 0.01))) * 0.02 / cells
    measured = result.summary["measures"]["crust"]["volume"] / width_of(result)
    return [relative_row(result.resolution, "heat to the runner [J/m²]", heat_to(result, "runner"), exact.lost_below, 0.05),
            relative_row(result.resolution, "heat to the air [J/m²]", result.summary["heat"]["by_surface"] / width_of(result),
                         exact.lost_above, 0.05),
            bound_row(result.resolution, "temperature, rms off [K]", rms, (None, 10)),
            bound_row(result.resolution, "crust at the floor off [spacings]", abs(measured - crust) / result.spacing, (None, 1))]


def draw(axes, results):
    slabs = [r for r in results if r.run.name in ("heat_slab", "heat_slab_5")]
    for result in slabs:
        axes.plot(1e3 * heights(result), result.last("Temperature") - 273.15, ".", color="#31688e", markersize=2)
    z = np.linspace(0, 1, 200)
    axes.plot(20 * z, 500 + 1000 * forms.slab_between_walls(z, 0.1) - 273.15, color="#d1652a")
    axes.plot(20 * z, 500 + 1000 * forms.slab_with_convection(2 * z - 1, 5, 0.1) - 273.15, color="#d1652a")
    axes.set(xlabel="z [mm]", ylabel="T [°C]")
