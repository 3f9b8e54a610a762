"""The flow in three dimensions as an HTML page of its own that turns and plays: surface and walls over time, by k3d."""

import numpy as np

from plotting import surface
from plotting.quantity import shared

MOST_BYTES = 12e6  # of the meshes over time, before they are packed
MOST_TIMES = 24
COARSE = 1.0  # cubes of the meshes in particle radii


def arrays(mesh):
    return np.asarray(mesh.points, np.float32), np.asarray(mesh.faces.reshape(-1, 4)[:, 1:], np.uint32)


def spread(run, count):
    """At most so many steps, evenly over all, both ends included."""
    last = len(run.times) - 1
    return sorted(set(np.linspace(0, last, min(count, last + 1)).round().astype(int).tolist()))


def steps_that_fit(run, colour, box):
    """As many steps as MOST_BYTES of meshes hold, by the one with the most particles, but four in any case."""
    steps = spread(run, MOST_TIMES)
    fullest = max(steps, key=run.fluid.count)
    meshes = surface.Meshes(run, shared([run], [[fullest]], colour)[0], COARSE)
    made = [meshes.fluid(fullest)] + ([meshes.walls(fullest, box)] if any(map(surface.moves, run.case.get("wall", []))) else [])
    size = sum(a.nbytes for mesh in made if mesh is not None for a in arrays(mesh))
    return spread(run, max(4, min(MOST_TIMES, int(MOST_BYTES / max(size, 1)))))


def scene(run, colour, k3d):
    """The page of the view, how many times it holds, and what colours it. Raises KeyError where the run has not written what the colour needs."""
    box = surface.box_of([run], [spread(run, MOST_TIMES)])
    steps = steps_that_fit(run, colour, box)
    quantity = shared([run], [steps], colour)[0]
    meshes, fluid, walls = surface.Meshes(run, quantity, COARSE), {}, {}
    for step in steps:
        name = f"{run.times[step]:.5g}"
        if (mesh := meshes.fluid(step)) is not None:
            fluid[name] = (*arrays(mesh), np.asarray(mesh["value"], np.float32))
        if (mesh := meshes.walls(step, box)) is not None:
            walls[name] = mesh
    return compose(k3d, fluid, walls, quantity, run, box), len(steps), quantity.label


def compose(k3d, fluid, walls, quantity, run, box):
    plot = k3d.plot(background_color=0xFFFFFF, grid_visible=False, fps=8, camera_auto_fit=False, camera_fov=30, colorbar_object_id=0 if quantity.few else -1)
    parts = np.linspace(0, 1, 32)
    colours = np.array([[x, *quantity.map(x)[:3]] for x in parts], np.float32).ravel()
    if fluid:
        plot += k3d.mesh({t: f[0] for t, f in fluid.items()}, {t: f[1] for t, f in fluid.items()}, attribute={t: f[2] for t, f in fluid.items()},
                         color_map=colours, color_range=[float(x) for x in quantity.limits], flat_shading=False, name=quantity.label)
    if walls:
        still = len({id(mesh) for mesh in walls.values()}) == 1
        made = {t: arrays(mesh) for t, mesh in walls.items()}
        first = next(iter(made.values()))
        plot += k3d.mesh(first[0] if still else {t: w[0] for t, w in made.items()}, first[1] if still else {t: w[1] for t, w in made.items()},
                         color=0xB9BFC6, opacity=0.3, flat_shading=False, name="walls")
    middle, size = (box[0] + box[1]) / 2, float(np.linalg.norm(box[1] - box[0]))
    plot.time = float(list(fluid or walls or {"0": None})[len(fluid or walls) // 3])
    away = middle + 2.0 * size * surface.direction(run.dimensions == 2)
    plot.camera = [*map(float, away), *map(float, middle), 0.0, 0.0, 1.0]
    plot.snapshot_type = "full"
    return plot.get_snapshot(9)
