"""The flow at some times in three views, coloured by speed or another quantity."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from PIL import Image
from matplotlib.cm import ScalarMappable
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.ticker import MaxNLocator

from plotting.quantity import Quantity
from plotting.splat import Canvas, View

DPI = 200
ROW_HEIGHT, WIDEST, MARGIN, GAP = 2.9, 4.5, 0.6, 0.3  # inches
HEAD, ROW_GAP, LOWEST = 0.65, 0.42, 0.32  # inches: above the first row, above each row, below the last one
WALL_SECTION, WALL_BEHIND, WALL_SOLID = 0.72, 0.93, 0.97  # grey levels
# Without its darkest end, on which no shading shows.
COLOURS = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.12, 1, 256)))

SIDE = View((1, 0, 0), (0, 0, 1))
FRONT = View((0, 1, 0), (0, 0, 1))
OBLIQUE = View.oblique(-38, 24)


class Scene:
    """What is shown of a run: the fluid at the start and at some steps, and the walls around it; all walls while there is no
    fluid yet."""

    def __init__(self, run, steps):
        self.run, self.steps, self.spacing = run, steps, run.spacing
        fluid = [run.fluid.positions(step) for step in sorted({0, *steps})]
        empty = run.walls.positions(0) if run.walls else np.zeros((1, 3))
        self.fluid = np.concatenate([p for p in fluid if len(p)] or [empty])
        self.middle = (self.fluid[:, 1].min() + self.fluid[:, 1].max()) / 2
        self.walls = [self._walls_at(step) for step in steps]

    def _walls_at(self, step):
        walls = self.run.walls.positions(min(step, len(self.run.walls.times) - 1)) if self.run.walls else np.zeros((0, 3))
        margin = 4 * self.spacing
        near = (walls > self.fluid.min(axis=0) - margin) & (walls < self.fluid.max(axis=0) + margin)
        return walls[near.all(axis=1)]


class Panel:
    """One column of the figure: a view, the axes' names, and the rectangle of the view that is shown."""

    def __init__(self, scene, view, labels):
        self.view, self.labels = view, labels
        flat = view.project(np.concatenate([scene.fluid, *scene.walls]))[:, :2]
        self.lower, self.upper = flat.min(axis=0) - 2 * scene.spacing, flat.max(axis=0) + 2 * scene.spacing
        self.unit, self.factor = ("m", 1) if np.ptp(scene.fluid, axis=0).max() > 2 else ("mm", 1e3)

    @property
    def box(self):
        return self.lower[0], self.upper[0], self.lower[1], self.upper[1]

    @property
    def size(self):
        return self.upper - self.lower

    @property
    def extent(self):
        """The rectangle in the unit of the axes."""
        return [self.factor * edge for edge in self.box]

    def label(self, which):
        return f"{self.labels[which]}  [{self.unit}]" if self.labels[which] else ""


def speed_limit(run, steps):
    """The top of the colour bar in cm/s: a round number that all but a few particles keep below."""
    speeds = np.concatenate([run.fluid.speeds(step) for step in steps])
    top = 100 * float(np.quantile(speeds, 0.998)) if len(speeds) else 0
    if top <= 0:
        return 1.0
    unit = 10 ** np.floor(np.log10(top))
    return float(unit * next(m for m in (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10) if m * unit >= top * 0.999))


class Colouring:
    """What colours the particles at some steps, on one scale. Raises KeyError where the run has not written what it needs."""

    def __init__(self, run, steps, name):
        if name == "speed":
            self.map, self.label, self.norm = COLOURS, "speed  [cm/s]", Normalize(0, speed_limit(run, steps))
            self._values = lambda step: 100 * run.fluid.speeds(step)
            return
        quantity = Quantity(run, steps, name)
        quantity.share(quantity.limits)
        self.map, self.label, self.norm = quantity.map, quantity.label, Normalize(*quantity.limits)
        self._values = lambda step: quantity.factor * quantity.values[step]

    def colours(self, step):
        return self.map(self.norm(self._values(step)))[:, :3]


def flat_layer(panel, scale, scene, walls, grey):
    canvas = Canvas(panel.box, scale)
    canvas.splat(panel.view.project(walls), 0.72 * scene.spacing)  # just closes the gaps of the lattice
    return canvas.picture(np.full((len(walls), 3), grey), None, rim=0)


def solid_layer(panel, scale, scene, walls):
    canvas = Canvas(panel.box, scale)
    canvas.splat(panel.view.project(walls), 0.9 * scene.spacing)
    return canvas.picture(np.full((len(walls), 3), WALL_SOLID), 6 * scene.spacing, rim=0.28)


def wall_layers(panel, scale, scene, row):
    """Pictures of the walls, to stand behind the fluid: their extent, and in the side view the section along
    the middle of the fluid."""
    walls = scene.walls[row]
    if panel.view is OBLIQUE:
        return [solid_layer(panel, scale, scene, walls)]
    layers = [flat_layer(panel, scale, scene, walls, WALL_BEHIND)]
    if panel.view is SIDE:
        section = walls[np.abs(walls[:, 1] - scene.middle) < 0.8 * scene.spacing]
        layers.append(flat_layer(panel, scale, scene, section, WALL_SECTION))
    return layers


def fluid_layer(panel, scale, scene, step, colours):
    canvas = Canvas(panel.box, scale)
    canvas.splat(panel.view.project(scene.run.fluid.positions(step)), 0.5 * scene.spacing)
    return canvas.picture(colours, 4 * scene.spacing, rim=0.3)


def dress(axes, panel):
    """Axes with their names; for the oblique view a bar of a round length instead."""
    axes.set_aspect("equal")
    axes.tick_params(labelsize=7, length=2.5, color="0.5", labelcolor="0.25")
    for spine in axes.spines.values():
        spine.set(color="0.6", linewidth=0.6)
    axes.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    axes.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    if panel.labels[1]:
        axes.set_ylabel(panel.label(1), fontsize=8, labelpad=1)
    else:
        axes.tick_params(labelleft=False)
    if panel.view is not OBLIQUE:
        return
    axes.set(xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set_visible(False)
    left, right, bottom, _ = panel.extent
    unit = 10 ** np.floor(np.log10((right - left) / 3))
    length = unit * max(m for m in (1, 2, 5) if m * unit <= (right - left) / 3)
    axes.plot([left, left + length], [bottom, bottom], color="0.2", linewidth=1.6, solid_capstyle="butt",
              clip_on=False)
    axes.annotate(f"{length:g} {panel.unit}", (left + length / 2, bottom), (0, 3), textcoords="offset points",
                  ha="center", va="bottom", fontsize=7, color="0.2")


def panels_of(scene):
    side = Panel(scene, SIDE, ("x", "z"))
    if scene.run.dimensions == 2:
        return [side]
    return [side, Panel(scene, FRONT, ("y", "")), Panel(scene, OBLIQUE, ("", ""))]


def add_colour_bar(figure, colouring, layout):
    length = min(3.2, 0.6 * layout.width) / layout.width
    axes = figure.add_axes([0.5 - length / 2, 1 - 0.5 / layout.height, length, 0.1 / layout.height])
    bar = figure.colorbar(ScalarMappable(colouring.norm, colouring.map), cax=axes, orientation="horizontal", extend="max")
    bar.outline.set_linewidth(0.4)
    bar.ax.tick_params(labelsize=7, length=2, pad=1)
    bar.set_label(colouring.label, fontsize=8, labelpad=1)


class Layout:
    """Where the panels stand in the figure, in inches: a row for each step, all to one scale."""

    def __init__(self, panels, rows):
        tallest = max(panel.size[1] for panel in panels)
        self.scale = min(ROW_HEIGHT / tallest, WIDEST / max(panel.size[0] for panel in panels))  # inches a metre
        self.row = self.scale * tallest
        self.width = max(4.2, MARGIN + sum(self.scale * p.size[0] + GAP for p in panels) - GAP + 0.2)
        self.height = HEAD + rows * (self.row + ROW_GAP) + LOWEST

    def axes(self, figure, panel, left, row):
        across, tall = self.scale * panel.size
        top = self.height - HEAD - row * (self.row + ROW_GAP) - ROW_GAP
        return figure.add_axes([left / self.width, (top - tall) / self.height, across / self.width,
                                tall / self.height])


def draw_row(figure, layout, scene, panels, row, colouring):
    left, step = MARGIN, scene.steps[row]
    for panel in panels:
        behind = wall_layers(panel, layout.scale * DPI, scene, row)
        axes = layout.axes(figure, panel, left, row)
        for layer in behind + [fluid_layer(panel, layout.scale * DPI, scene, step, colouring.colours(step))]:
            axes.imshow(layer, origin="lower", extent=panel.extent, interpolation="none")
        dress(axes, panel)
        if left == MARGIN:
            time = scene.run.fluid.times[step]
            axes.set_title(f"t = {time:.3g} s", loc="left", fontsize=9, pad=4)
        if row == len(scene.steps) - 1:
            axes.set_xlabel(panel.label(0), fontsize=8, labelpad=1)
        left += layout.scale * panel.size[0] + GAP


def draw(run, steps, path, colour="speed"):
    """Writes the picture: a row for each step, a column for each view."""
    scene = Scene(run, steps)
    panels = panels_of(scene)
    figure = figure_of(scene, panels, Layout(panels, len(steps)), Colouring(run, steps, colour))
    figure.savefig(path, dpi=DPI)
    plt.close(figure)


def figure_of(scene, panels, layout, colouring):
    figure = plt.figure(figsize=(layout.width, layout.height), facecolor="white")
    figure.text(0.5, 1 - 0.2 / layout.height, scene.run.title.replace("_", " "), ha="center", va="center", fontsize=11)
    add_colour_bar(figure, colouring, layout)
    for row in range(len(scene.steps)):
        draw_row(figure, layout, scene, panels, row, colouring)
    return figure


def draw_movie(run, path, colour="speed", milliseconds=100):
    """Writes a GIF of all steps, one a frame, to one scale and one map of colours."""
    steps = list(range(len(run.fluid.times)))
    panels = panels_of(Scene(run, steps))
    layout, colouring = Layout(panels, 1), Colouring(run, steps, colour)
    frames = []
    for step in steps:
        figure = figure_of(Scene(run, [step]), panels, layout, colouring)
        figure.set_dpi(DPI / 2)
        figure.canvas.draw()
        frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        plt.close(figure)
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=milliseconds, loop=0)
