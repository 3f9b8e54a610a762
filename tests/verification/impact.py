"""Bodies of fluid that hit walls at a tenth to three tenths of the numerical sound speed: none deeper than 0.75 spacings."""

import numpy as np

from verification.suite import Run, bound_row

NAME = "impact"
TITLE = "impact on thin walls, deepest particle"
SPACING = 1e-3  # [m]
SOUND_SPEED = 15  # [m/s]
MACH = (0.1, 0.2, 0.3)
TILTS = {"floor": 0, "plane": np.radians(30), "stl": np.radians(20)}
BODIES = {"block": (8, 8), "column": (4, 24), "row": (12, 1), "particle": (1, 1)}  # wide and high [spacings]
THICKNESS = 3  # of the walls [spacings]


def normal(wall):
    return np.array([np.sin(TILTS[wall]), 0, np.cos(TILTS[wall])])


def impact(wall, body, mach, dimensions):
    wide, high = (count * SPACING for count in BODIES[body])
    bottom = 4 * SPACING + round(0.6 * wide * np.sin(TILTS[wall]) / SPACING) * SPACING  # free of the wall at first
    speed = mach * SOUND_SPEED
    return Run(f"impact_{wall}_{body}_{mach}_{dimensions}", f"impact_{wall}", f"{dimensions}-D, {wall}, Mach {mach}", {
        "resolution.dimensions": dimensions,
        "domain.exits": '["-x", "+x", "-y", "+y", "+z"]' if dimensions == 3 else '["-x", "+x", "+z"]',
        "region.0.shapes.0.min": [-wide / 2, -wide / 2, bottom],
        "region.0.shapes.0.max": [wide / 2, wide / 2, bottom + high],
        "region.0.velocity": [float(part) for part in -speed * normal(wall)],
        "output.end_time": 30 * SPACING / speed,
        "output.interval": 0.1 * SPACING / speed if dimensions == 2 else 0.5 * SPACING / speed,
        "output.history_interval": 0.1 * SPACING / speed,
    })


def runs(quick):
    chosen = [(wall, body, mach, dimensions) for dimensions in (2, 3) for wall in TILTS for mach in MACH for body in BODIES
              if not quick or (dimensions == 2 and mach in (0.1, 0.3) and body == "block")]
    return [impact(*choice) for choice in chosen] + [Run("jet_on_floor", "jet_on_floor", "2-D, jet on a floor")]


def is_jet(result):
    return result.run.name == "jet_on_floor"


def below(result, position):
    """How deep particles above and in the wall are [spacings]; those that stand beside its ends left out."""
    if is_jet(result):
        beside = (position[:, 0] < -1.1) | (position[:, 0] > 3)
        depth = -position[:, 2]
    else:
        wall = result.run.case.removeprefix("impact_")
        upward = normal(wall)
        beside = np.abs(position @ np.array([upward[2], 0, -upward[0]])) > 0.038
        depth = -position @ upward
    return np.where(beside, -np.inf, depth) / result.spacing


def deepest(result):
    """The larger of what the program says and what its snapshots show; what has passed a wall lies below it."""
    seen = max(np.max(below(result, state.position), initial=0) for state in result.states())
    return max(result.summary["in_walls"]["deepest_spacings"], seen)


def lost(result):
    """Particles that left where no exit is: the exits are where spray flies along a wall or up
    from its corners, and the end of the floor."""
    return result.summary["lost_through_other_faces"]


def rows(results):
    table = []
    for resolution in dict.fromkeys(result.resolution for result in results):
        depth = max(deepest(result) for result in results if result.resolution == resolution)
        table.append(bound_row(resolution, "deepest in the wall [Δx]", depth, (None, 0.75)))
    table.append(bound_row("all of these", "particles lost", sum(lost(result) for result in results), (None, 0)))
    return table


def draw(axes, results):
    for wall, colour in zip(TILTS, ("#31688e", "#35b779", "#d1652a")):
        (result,) = [r for r in results if r.run.name == f"impact_{wall}_block_0.3_2"]
        axes.plot(1e3 * result.times, [np.max(below(result, s.position)) for s in result.states()], color=colour, label=wall)
    axes.axhline(0.75, color="grey", linewidth=0.5)
    axes.set(xlabel="t [ms]", ylabel="deepest [Δx]", ylim=(-6, 1))
    axes.legend(fontsize="x-small")
