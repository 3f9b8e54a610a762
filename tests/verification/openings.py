"""What inlets feed: the flow it becomes, its count, its level where it comes to rest, and how steady it comes."""

import numpy as np

from verification.suite import Row, Run, bound_row, profile_row, relative_row

NAME = "openings"
TITLE = "channel fed through an inlet"
HEIGHT, MEAN, SECTION = 0.02, 0.05, 0.04  # of the channel [m], its speed [m/s], the place of the profile [m]
PLUG = 0.5  # of the half height, of the Bingham fluid
YIELD = 3 * PLUG * MEAN / (0.5 * HEIGHT * (1 - 1.5 * PLUG + 0.5 * PLUG**3))  # [Pa], at a plastic viscosity of 1 Pa s
POT = 0.12  # width [m]

MISSES = {"10 deep, 3-D: mean height at the end [m]":
          "voids of which ΣVW shows less than 4 % count as closed, so a pool of torn fluid may keep that much; with 0.97 for 0.96 "
          "it would be nearer, with 1.00 a pot 5 deep was 3.4 % too low. 1.5 % in one of 0.2 m at 5 mm"}

BINGHAM = {"fluid.oil.yield_stress": YIELD, "numerics.sound_speed": 12}


def runs(quick):
    flows = [Run("fed_channel", "fed_channel", "20 across, oil"),
             Run("fed_channel_developed", "fed_channel", "20 across, oil, developed", {"inlet.0.profile": "developed"}),
             Run("fed_channel_bingham", "fed_channel", f"20 across, Bingham, y_p/a {PLUG}", BINGHAM)]
    stream = [Run("fed_stream", "fed_stream", "20 deep, 0.3 m/s")]
    return flows[1:2] + stream if quick else flows + stream + [Run("poured_pot", "poured_pot", "10 deep, 3-D")]


def exact(result, z):
    """Between plates, of a Bingham fluid with its plug (E. C. Bingham 1922)."""
    y = np.abs(z - 0.5 * HEIGHT) / (0.5 * HEIGHT)
    stress = result.fluid()["yield_stress"]
    if stress == 0:
        return 1.5 * MEAN * (1 - y**2)
    top = stress / PLUG * 0.25 * HEIGHT * (1 - PLUG)**2
    return top * (1 - np.clip((y - PLUG) / (1 - PLUG), 0, None)**2)


def section(result):
    """Means over slices a spacing wide, half a height to either side of the section, and over the last half of the time:
    of the height, the velocity and the exact velocity of the same particles."""
    layers = round(HEIGHT / result.spacing)
    counts, sums = np.zeros(layers), np.zeros((3, layers))
    for state in result.states():
        near = np.abs(state.position[:, 0] - SECTION) < 0.5 * HEIGHT
        if state.time < 0.5 * result.times[-1]:
            continue
        z = state.position[near, 2]
        slices = np.clip((z / result.spacing).astype(int), 0, layers - 1)
        counts += np.bincount(slices, minlength=layers)
        for total, values in zip(sums, (z, state.velocity[near, 0], exact(result, z))):
            total += np.bincount(slices, values, layers)
    return sums / counts


def balance(result):
    """In particles: of the start and fed, less those that are there and those that were taken."""
    summary = result.summary
    fed = sum(inlet["particles"] for inlet in summary["inlets"].values())
    taken = sum(outlet["particles"] for outlet in summary["outlets"].values()) + sum(summary["departed"].values())
    return summary["particles"]["fluid"] + fed - summary["particles_in"] - taken


def floor_pressure(result):
    """Root mean square [Pa] of what the pressure of the wall a depth downstream is off its mean, after 0.1 s."""
    walls = result.walls
    values = []
    for step, time in enumerate(walls.times):
        if time < 0.1:
            continue
        place = walls.positions(step)
        at = np.argmin(np.abs(place[:, 0] - 0.041) + 10 * np.abs(place[:, 2] + 0.5 * result.spacing))
        values.append(walls.field("Pressure", step)[at])
    return float(np.std(values))


def rows(results):
    table = []
    for result in results:
        name = result.case["case"]["name"]
        if name == "fed_channel":
            _, u, closed = section(result)
            table.append(profile_row(result.resolution, "velocity two heights downstream", u, closed, 0.02))
        elif name == "fed_stream":
            table.append(bound_row(result.resolution, "pressure of the floor a depth downstream, rms [Pa]",
                                   floor_pressure(result), (None, 4.5)))  # 5 % of rho U^2
        else:
            state = result.state()
            level = len(state.position) * result.spacing**3 / POT**2
            table.append(relative_row(result.resolution, "mean height at the end [m]", np.mean(state.position[:, 2]),
                                      0.5 * level, 0.02))
        table.append(Row(result.resolution, "particles fed less those in and taken", str(balance(result)), "0", "–",
                         "0", balance(result) == 0))
    return table


def draw(axes, results):
    result = next(r for r in results if r.case["case"]["name"] == "fed_channel")
    z, u, closed = section(result)
    axes.plot(1e3 * closed, 1e3 * z, color="#d1652a", linewidth=0.7, label="closed form")
    axes.plot(1e3 * u, 1e3 * z, ".", color="#31688e", label=result.resolution)
    axes.set(xlabel="u [mm/s]", ylabel="z [mm]")
    axes.legend(fontsize=6)
