"""The paper's Figs. 10, 11 and 12: views of runs side by side, to one scale and one colour bar."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from plotting import flow

GAP, HEAD, FOOT, LEFT = 0.45, 0.95, 0.5, 0.6  # inches
HEIGHT, WIDEST = 4.2, 5.0


class Picture:
    """One run at the time nearest to the wanted one."""

    def __init__(self, run, time, title, view=flow.SIDE, labels=("x", "z")):
        self.step = run.nearest_steps([time])[0]
        self.scene = flow.Scene(run, [self.step])
        self.panel = flow.Panel(self.scene, view, labels)
        self.title = f"{title}, t = {run.fluid.times[self.step]:.3g} s"


def add_colour_bar(figure, norm, width, height):
    axes = figure.add_axes([0.5 - 1.2 / width, 1 - 0.42 / height, 2.4 / width, 0.1 / height])
    bar = figure.colorbar(ScalarMappable(norm, flow.COLOURS), cax=axes, orientation="horizontal", extend="max")
    bar.ax.tick_params(labelsize=7, length=2, pad=1)
    bar.set_label("speed  [cm/s]", fontsize=8, labelpad=1)


def draw(pictures, heading, path):
    """Writes the pictures side by side. `heading`: above all of them."""
    scale = min(HEIGHT / max(p.panel.size[1] for p in pictures), WIDEST / max(p.panel.size[0] for p in pictures))
    width = max(4.2, LEFT + sum(scale * p.panel.size[0] + GAP for p in pictures))
    tallest = scale * max(p.panel.size[1] for p in pictures)
    height = HEAD + tallest + FOOT
    norm = Normalize(0, max(flow.speed_limit(p.scene.run, [p.step]) for p in pictures))
    figure = plt.figure(figsize=(width, height), facecolor="white")
    figure.text(0.5, 1 - 0.15 / height, heading, ha="center", va="center", fontsize=11)
    if any(p.scene.run.fluid.speeds(p.step).any() for p in pictures):
        add_colour_bar(figure, norm, width, height)
    left = LEFT
    for picture in pictures:
        across, tall = scale * picture.panel.size
        axes = figure.add_axes([left / width, (FOOT + tallest - tall) / height, across / width, tall / height])
        layers = flow.wall_layers(picture.panel, scale * flow.DPI, picture.scene, 0)
        colours = flow.COLOURS(norm(100 * picture.scene.run.fluid.speeds(picture.step)))[:, :3]
        for layer in layers + [flow.fluid_layer(picture.panel, scale * flow.DPI, picture.scene, picture.step, colours)]:
            axes.imshow(layer, origin="lower", extent=picture.panel.extent, interpolation="none")
        flow.dress(axes, picture.panel)
        axes.set_title(picture.title, loc="left", fontsize=8, pad=4)
        axes.set_xlabel(picture.panel.label(0), fontsize=8, labelpad=1)
        left += across + GAP
    figure.savefig(path, dpi=flow.DPI)
    plt.close(figure)
