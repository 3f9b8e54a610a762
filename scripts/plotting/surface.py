"""The free surface as a smooth mesh, shaded, among the walls: one view, a row for each time.

The mesh is that of pysplashsurf (weighted smoothing: F. Loeschner et al., Eurographics 2023); VTK draws it off screen."""

import argparse
import sys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize

import slagflow

WIDTH, DPI = 1600, 200  # pixels of a view; of the figure an inch
HEAD, FOOT, ROW_GAP, TALLEST, NARROWEST = 0.75, 0.5, 0.3, 6.0, 4.6  # inches
RADIUS, SMOOTHING, CUBE, THRESHOLD = 0.5, 2.0, 0.6, 0.6  # of a particle in spacings; the others in radii
SMOOTHINGS, WALL_SMOOTHINGS, NORMALS = 15, 25, 8
SEQUENTIAL = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.08, 1, 256)))
FEW = ListedColormap(["#c8553d", "#2f6690", "#8d99ae", "#e9c46a", "#588157", "#6d597a"])
WALL, LIGHT = "#b9bfc6", "#ffffff"


class SurfaceError(Exception):
    """There is nothing to draw a surface with, or of; the message says what."""


def tools():
    """pysplashsurf and pyvista. Raises SurfaceError when one is missing."""
    try:
        import pysplashsurf
        import pyvista
    except ImportError as missing:
        raise SurfaceError(f"{missing}: `scripts/install --surface` brings what draws surfaces") from missing
    return pysplashsurf, pyvista


UNITS = {  # label, factor from SI units, and the largest value [SI] of which it is taken
    "speed": [("speed  [cm/s]", 100.0, 0.5), ("speed  [m/s]", 1.0, np.inf)],
    "depth": [("depth below the highest place  [mm]", 1000.0, 2.0), ("depth below the highest place  [m]", 1.0, np.inf)],
    "pressure": [("pressure  [Pa]", 1.0, 5e3), ("pressure  [kPa]", 1e-3, np.inf)],
    "viscosity": [("apparent viscosity  [Pa s]", 1.0, np.inf)],
    "fluid": [("fluid", 1.0, np.inf)],
    "yielded": [("yielded", 1.0, np.inf)],
}
FIELDS = {"fluid": "Fluid", "viscosity": "Viscosity", "yielded": "Yielded", "pressure": "Pressure"}


class Quantity:
    """What colours the surface: values of the particles in SI units, by step; a label, a factor and limits in its unit."""

    def __init__(self, run, steps, name):
        self.name, self.few = name, name in ("fluid", "yielded")
        self.values = {step: self._of(run.fluid, step) for step in steps}
        self.map = FEW if self.few else SEQUENTIAL
        every = np.concatenate([v for v in self.values.values() if len(v)] or [np.zeros(1)])
        top = float(np.quantile(every, 0.998))
        low = float(every.min()) if name == "viscosity" else 0.0
        self.limits = (-0.5, FEW.N - 0.5) if self.few else (low, max(top, low + 1e-12))
        self.label, self.factor = UNITS[name][0][:2]

    def _of(self, fluid, step):
        if self.name == "speed":
            return fluid.speeds(step)
        if self.name == "depth":
            z = fluid.positions(step)[:, 2]
            return z.max(initial=-np.inf) - z
        return fluid.field(FIELDS[self.name], step)

    def share(self, limits):
        """Takes limits [SI units] that hold for all runs shown, and the unit that fits them."""
        self.label, self.factor = next(u[:2] for u in UNITS[self.name] if limits[1] <= u[2])
        self.limits = tuple(self.factor * value for value in limits)


QUANTITIES = tuple(UNITS)


class Meshes:
    """Surfaces of a run's fluid and walls, in metres. Walls that do not change are meshed once."""

    def __init__(self, run, quantity, cube=CUBE):
        self._splash, self.pyvista = tools()
        self.run, self.quantity, self._cube = run, quantity, cube
        self._walls = (None, None)

    def _surface(self, positions, values, smoothings):
        origin = positions.mean(axis=0)  # single precision is used inside
        made, _ = self._splash.reconstruction_pipeline(
            np.ascontiguousarray(positions - origin), attributes_to_interpolate={"value": np.ascontiguousarray(values, float)},
            particle_radius=RADIUS * self.run.spacing, smoothing_length=SMOOTHING, cube_size=self._cube,
            iso_surface_threshold=THRESHOLD, mesh_cleanup=True, decimate_barnacles=True, mesh_smoothing_iters=smoothings,
            compute_normals=True, normals_smoothing_iters=NORMALS)
        faces = np.asarray(made.mesh.triangles).astype(np.int64)
        mesh = self.pyvista.PolyData(np.asarray(made.mesh.vertices) + origin,
                                     np.column_stack([np.full(len(faces), 3), faces]).ravel())
        mesh.point_data["value"] = np.asarray(made.point_attributes["value"])
        return mesh

    def fluid(self, step):
        positions = self.run.fluid.positions(step)
        if len(positions) == 0:
            return None
        return self._surface(positions, self.quantity.factor * self.quantity.values[step], SMOOTHINGS)

    def walls(self, step, box):
        """Of the wall particles in a box, lower and upper corner."""
        if self.run.walls is None:
            return None
        positions = self.run.walls.positions(min(step, len(self.run.walls.times) - 1))
        positions = positions[((positions > box[0]) & (positions < box[1])).all(axis=1)]
        if len(positions) == 0:
            return None
        known, mesh = self._walls
        if known is None or known.shape != positions.shape or not np.array_equal(known, positions):
            mesh = self._surface(positions, np.zeros(len(positions)), WALL_SMOOTHINGS)
            self._walls = (positions, mesh)
        return mesh


def direction(flat):
    """To the viewer: as in the oblique view of the particles; along y in two dimensions."""
    if flat:
        return np.array([0.0, -1.0, 0.0])
    azimuth, elevation = np.radians([-38, 24])
    return np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])


def render(meshes, steps, box):
    """One picture a step, all with the same camera: arrays of WIDTH pixels across, a white ground."""
    pyvista = meshes.pyvista
    flat = meshes.run.dimensions == 2
    middle, size = (box[0] + box[1]) / 2, np.linalg.norm(box[1] - box[0])
    pictures = []
    for step in steps:
        plotter = pyvista.Plotter(off_screen=True, window_size=(WIDTH, WIDTH))
        plotter.set_background(LIGHT)
        fluid, walls = meshes.fluid(step), meshes.walls(step, box)
        if fluid is not None:
            plotter.add_mesh(fluid, scalars="value", cmap=meshes.quantity.map, clim=meshes.quantity.limits, smooth_shading=True,
                             specular=0.3, specular_power=15, ambient=0.25, show_scalar_bar=False)
        if walls is not None:
            plotter.add_mesh(walls, color=WALL, opacity=1.0 if flat else 0.3, smooth_shading=True, ambient=0.3)
        plotter.camera_position = [middle + 3 * size * direction(flat), middle, (0, 0, 1)]
        plotter.enable_parallel_projection()
        plotter.parallel_scale = 0.55 * size
        plotter.camera.clipping_range = (0.1 * size, 8 * size)
        plotter.enable_anti_aliasing("ssaa")
        pictures.append(plotter.screenshot(None, return_img=True))
        plotter.close()
    return pictures


def box_of(runs, steps):
    """Lower and upper corner of what is shown: the fluid at all steps of all runs, and some spacings of walls around it."""
    every, margin = [], 0.0
    for run, its_steps in zip(runs, steps):
        every += [run.fluid.positions(step) for step in its_steps]
        margin = max(margin, 4.5 * run.spacing)
    every = np.concatenate([p for p in every if len(p)] or [np.zeros((1, 3))])
    low, high = np.quantile(every, [0.001, 0.999], axis=0)  # single drops may be far away
    return np.array([low - margin, high + margin])


def cropped(pictures):
    """Cuts the same white edges off all."""
    used = np.any([np.any(p < 250, axis=2) for p in pictures], axis=0)
    rows, columns = np.flatnonzero(used.any(axis=1)), np.flatnonzero(used.any(axis=0))
    if len(rows) == 0:
        return pictures
    edge = WIDTH // 80
    top, left = max(rows[0] - edge, 0), max(columns[0] - edge, 0)
    return [p[top:rows[-1] + edge, left:columns[-1] + edge] for p in pictures]


def caption(run):
    counts = run.summary.get("particles", {})
    parts = [f"{name}: {words}" for name, words in run.fluids_in_words().items()]
    parts.append(f"spacing {1000 * run.spacing:.3g} mm")
    if counts.get("fluid"):
        parts.append(f"{counts['fluid']:,} particles".replace(",", "\u202f"))
    return "; ".join(parts)


def draw(runs, times, colour, path):
    """Writes the picture: for one run its times in a grid, for several a column each. `times`: in seconds, or None."""
    if len({run.dimensions for run in runs}) > 1:
        raise SurfaceError("some runs have two dimensions, some three: allowed: runs of one kind")
    steps = [run.nearest_steps(times) if times else run.typical_steps() for run in runs]
    rows = min(len(s) for s in steps)
    steps = [s[:rows] for s in steps]
    quantities = [Quantity(run, s, colour) for run, s in zip(runs, steps)]
    limits = (min(q.limits[0] for q in quantities), max(q.limits[1] for q in quantities))
    for quantity in quantities:
        quantity.share(limits)
    box = box_of(runs, steps)
    pictures = [render(Meshes(run, quantity), s, box) for run, quantity, s in zip(runs, quantities, steps)]
    flat = cropped([picture for column in pictures for picture in column])
    pictures = [flat[k * rows:(k + 1) * rows] for k in range(len(runs))]
    figure_of(runs, steps, pictures, quantities[0], path)


def grid(runs, rows, picture):
    """Rows and columns of the figure, and the place of the picture of a run and row."""
    if len(runs) > 1:
        return rows, len(runs), lambda run, row: (row, run)
    shape = picture.shape[1] / picture.shape[0]
    columns = min(rows, 4 if shape < 0.8 else 2 if shape < 2.2 else 1)
    return -(-rows // columns), columns, lambda run, row: divmod(row, columns)


def figure_of(runs, steps, pictures, quantity, path):
    tall, wide = pictures[0][0].shape[:2]
    rows, columns, place = grid(runs, len(pictures[0]), pictures[0][0])
    across = min(4.6 if columns > 1 else 7.0, 11.0 / columns, TALLEST * wide / tall)  # inches
    height = across * tall / wide
    total = (max(columns * across, NARROWEST), HEAD + rows * (height + ROW_GAP) + FOOT)
    figure = plt.figure(figsize=total, facecolor="white")
    titles = titles_of(runs)
    for k, run in enumerate(runs):
        for row, picture in enumerate(pictures[k]):
            down, right = place(k, row)
            top = total[1] - HEAD - down * (height + ROW_GAP) - ROW_GAP
            left = 0.5 + (right - columns / 2) * across / total[0]
            axes = figure.add_axes([left, (top - height) / total[1], across / total[0], height / total[1]])
            axes.imshow(picture, interpolation="antialiased")
            axes.axis("off")
            time = f"t = {run.fluid.times[steps[k][row]]:.3g} s"
            axes.set_title(f"{titles[k]}, {time}" if len(runs) > 1 else time, loc="left", fontsize=9, pad=2)
    names = list(dict.fromkeys(run.title for run in runs))
    title = textwrap.shorten(", ".join(names).replace("_", " "), int(9 * total[0]), placeholder=" and more")
    figure.suptitle(title, fontsize=12, y=1 - 0.18 / total[1], va="center")
    colour_key(figure, runs, quantity, total)
    captions = [caption(run) for run in runs]
    words = textwrap.fill(captions[0] if len(set(captions)) == 1 else "fluids and spacings differ", int(17 * total[0]))
    figure.text(0.5, 0.5 * FOOT / total[1], words, ha="center", va="center", fontsize=7.5, color="0.35", linespacing=1.4)
    figure.savefig(path, dpi=DPI)
    plt.close(figure)


def titles_of(runs):
    """What tells runs apart: the keys that differ, else their folders."""
    if len(runs) == 1:
        return [""]
    flat = [run.keys() for run in runs]
    given = [name for name in flat[0] if not name.startswith(("case.", "output.", "limits.", "numerics.sound_speed"))]
    names = [name for name in given if len({repr(f.get(name)) for f in flat}) > 1]
    if not names or len(names) > 3:
        several = len({run.path.name for run in runs}) < len(runs)
        return [f"{run.path.parent.name}/{run.path.name}" if several else run.path.name for run in runs]
    return [textwrap.shorten(", ".join(f"{name.split('.')[-1]} = {f.get(name)}" for name in names), 60) for f in flat]


def fluid_names(runs):
    """By number; where runs call it otherwise, all names."""
    lists = [list(run.fluids_in_words()) for run in runs]
    return ["/".join(dict.fromkeys(names[k] for names in lists if k < len(names))) for k in range(max(map(len, lists)))]


def colour_key(figure, runs, quantity, total):
    """A colour bar, or the names of what there are few of."""
    if quantity.few:
        names = fluid_names(runs) if quantity.name == "fluid" else ["rigid", "flowing"]
        marks = [plt.Line2D([], [], marker="s", linestyle="", color=quantity.map(k % quantity.map.N), label=name, markersize=7)
                 for k, name in enumerate(names)]
        figure.legend(handles=marks, loc="center", bbox_to_anchor=(0.5, 1 - 0.5 / total[1]), ncol=len(marks), frameon=False, fontsize=8)
        return
    length = min(3.2, 0.6 * total[0]) / total[0]
    axes = figure.add_axes([0.5 - length / 2, 1 - 0.5 / total[1], length, 0.1 / total[1]])
    bar = figure.colorbar(ScalarMappable(Normalize(*quantity.limits), quantity.map), cax=axes, orientation="horizontal", extend="max")
    bar.outline.set_linewidth(0.4)
    bar.ax.tick_params(labelsize=7, length=2, pad=1)
    bar.set_label(quantity.label, fontsize=8, labelpad=1)


def main():
    """Called by scripts/plot with the Python that has the tools."""
    parser = argparse.ArgumentParser(prog="plotting.surface", description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--picture", type=Path, required=True)
    parser.add_argument("--colour", choices=QUANTITIES, default="speed")
    parser.add_argument("--times", type=float, nargs="*")
    arguments = parser.parse_args()
    try:
        tools()
        draw([slagflow.open(folder) for folder in arguments.folders], arguments.times, arguments.colour, arguments.picture)
    except (SurfaceError, slagflow.RunError, OSError) as error:
        print(error)
        return 1
    except KeyError as error:
        print(f"the run has not written what {arguments.colour!r} needs: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
