"""What history.csv holds, over time."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

from plotting.run_folder import RunFolderError

# Panels: title, axis, factor from the column's SI unit, and which columns belong there.
PANELS = (
    ("Energy", "[mJ]", 1e3, lambda name: "energy" in name),
    ("Front", "[mm]", 1e3, lambda name: name.endswith("_m")),
    ("Fluid", "particles", 1, lambda name: "particles" in name),
    ("Viscous solver", "iterations", 1, lambda name: "iterations" in name),
)
LINES = ("#31688e", "#d1652a", "#3f8f4f", "#7a4fa3", "#8a6d3b", "#555555")  # tell apart in grey too


def label_of(name):
    """`kinetic_energy_J` reads as `kinetic energy`, `jet_front_m` as `jet`: the axis says the rest."""
    for ending in ("_front_m", "_J", "_m"):
        name = name.removesuffix(ending)
    return name.replace("_", " ")


def labelled(columns):
    """Curves by label; columns of the same values, as measures of one front give, are one curve."""
    curves = {}
    for name, values in columns.items():
        same = next((label for label, other in curves.items() if np.array_equal(other, values, True)), None)
        label = label_of(name) if same is None else f"{same}, {label_of(name)}"
        curves.pop(same, None)
        curves[label] = values
    return curves


def draw_panel(axes, time, columns, title, unit, factor):
    for colour, (label, values) in zip(LINES, labelled(columns).items()):
        axes.plot(time, factor * values, color=colour, linewidth=1.5, label=label)
    axes.set_title(title, loc="left", fontsize=10)
    axes.set_xlabel("time  [s]", fontsize=9)
    axes.set_ylabel(unit, fontsize=9)
    if factor == 1:  # counts
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.tick_params(labelsize=8)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(fontsize=8, frameon=False)


def draw(run, path):
    """Writes the picture: a panel for each kind of quantity that the history has. Throws RunFolderError."""
    columns = run.history()
    if "time_s" not in columns:
        raise RunFolderError(f"{run.path / 'history.csv'} has no column time_s")
    time = columns.pop("time_s")
    panels = []
    for title, axis, factor, belongs in PANELS:
        chosen = {name: values for name, values in columns.items() if belongs(name)}
        if chosen:
            panels.append((chosen, title, axis, factor))
    lines = max(1, (len(panels) + 1) // 2)
    figure, grid = plt.subplots(lines, 2, figsize=(9, 0.4 + 2.7 * lines), squeeze=False, dpi=150)
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, time, *panel)
    for axes in list(grid.flat)[len(panels):]:
        axes.set_visible(False)
    figure.suptitle(run.title.replace("_", " "), fontsize=11)
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
