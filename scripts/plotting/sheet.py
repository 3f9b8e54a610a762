"""Pictures of free surfaces on a sheet: times of one run, or several runs side by side, with a title, a scale of colours and a caption."""

import argparse
import sys
import textwrap
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

import slagflow
from plotting.quantity import QUANTITIES, shared
from plotting.surface import LONGEST, Camera, Meshes, SurfaceError, box_of, cropped, frame_of, tools

DPI = 200
HEAD, FOOT, ROW_GAP, TALLEST, NARROWEST = 0.75, 0.5, 0.3, 6.0, 4.6  # inches
SEVERAL = 900  # pixels along the longer side of each of several pictures
ROWS = 3  # times of runs side by side


def dam_number(run):
    """N = rho L sqrt(g H)/eta of a single fluid as it starts, H its extent along gravity and L the smaller one across; None where
    there is no fluid at the start, no gravity, or not one viscosity."""
    fluids = list(run.case.get("fluid", {}).values())
    gravity = np.array(run.case.get("gravity", {}).get("acceleration", [0, 0, -9.81]), dtype=float)
    eta = next((f[key] for f in fluids for key in ("dynamic_viscosity", "plastic_viscosity", "casson_viscosity") if key in f), None)
    density = fluids[0].get("density") if fluids else None
    if len(fluids) != 1 or eta is None or density is None or not gravity.any() or run.fluid.count(0) == 0:
        return None
    extent = np.ptp(run.fluid.positions(0), axis=0) + run.spacing
    down = int(np.argmax(np.abs(gravity)))
    across = [extent[k] for k in range(3) if k != down and not (k == 1 and run.dimensions == 2)]
    return float(density * min(across) * np.sqrt(np.linalg.norm(gravity) * extent[down]) / eta)


def caption(run):
    counts = run.summary.get("particles", {})
    parts = [f"{name}: {words}" for name, words in run.fluids_in_words().items()]
    number = dam_number(run)
    if number is not None:
        parts.append(f"N = {number:.3g}")
    parts.append(f"spacing {1000 * run.spacing:.3g} mm")
    if counts.get("fluid"):
        parts.append(f"{counts['fluid']:,} particles".replace(",", "\u202f"))
    return "; ".join(parts)


def caption_of(runs):
    """Of all runs, where it is the same; else what of it is."""
    captions = {caption(run) for run in runs}
    if len(captions) == 1:
        return captions.pop()
    spacings = {f"spacing {1000 * run.spacing:.3g} mm" for run in runs}
    fluids = {repr(run.fluids_in_words()) for run in runs}
    return "; ".join([caption(runs[0]).split("; N = ")[0].split("; spacing")[0] if len(fluids) == 1 else "fluids differ", spacings.pop() if len(spacings) == 1 else "spacings differ"])


def times_of_all(runs):
    """Times [s] that all runs have: of the one that ends first."""
    first = min(runs, key=lambda run: run.times[-1])
    return first.times[first.typical_steps(ROWS)]


def draw(runs, times, colour, path, titles=None):
    """Writes the picture: for one run its times in a grid, for several a column each, at the same times. `times`: in seconds, or None;
    `titles`: of the runs, by default what tells them apart. Raises SurfaceError, RunError, KeyError (a field was not written)."""
    if len({run.dimensions for run in runs}) > 1:
        raise SurfaceError("some runs have two dimensions, some three: allowed: runs of one kind")
    if not times and len(runs) > 1:
        times = times_of_all(runs)
    steps = [run.nearest_steps(times) if times is not None and len(times) else run.typical_steps() for run in runs]
    rows = min(len(s) for s in steps)
    steps = [s[:rows] for s in steps]
    quantities = shared(runs, steps, colour)
    box = box_of(runs, steps)
    frame = frame_of(runs, steps, box)
    longest = LONGEST if rows * len(runs) == 1 else SEVERAL
    cameras = [Camera(Meshes(run, quantity), box, frame, longest) for run, quantity in zip(runs, quantities)]
    pictures = [[camera.picture(step) for step in s] for camera, s in zip(cameras, steps)]
    flat = cropped([picture for column in pictures for picture in column])
    pictures = [flat[k * rows:(k + 1) * rows] for k in range(len(runs))]
    figure_of(runs, steps, pictures, quantities[0], path, titles or titles_of(runs))


def grid(runs, rows, picture):
    """Rows and columns of the figure, and the place of the picture of a run and row."""
    if len(runs) > 1:
        return rows, len(runs), lambda run, row: (row, run)
    shape = picture.shape[1] / picture.shape[0]
    columns = min(rows, 4 if shape < 0.8 else 2 if shape < 2.2 else 1)
    return -(-rows // columns), columns, lambda run, row: divmod(row, columns)


def figure_of(runs, steps, pictures, quantity, path, titles):
    tall, wide = pictures[0][0].shape[:2]
    rows, columns, place = grid(runs, len(pictures[0]), pictures[0][0])
    across = min(4.6 if columns > 1 else 7.0, 11.0 / columns, TALLEST * wide / tall)  # inches
    height = across * tall / wide
    total = (max(columns * across, NARROWEST), HEAD + rows * (height + ROW_GAP) + FOOT)
    figure = plt.figure(figsize=total, facecolor="white")
    for k, run in enumerate(runs):
        for row, picture in enumerate(pictures[k]):
            down, right = place(k, row)
            top = total[1] - HEAD - down * (height + ROW_GAP) - ROW_GAP
            left = 0.5 + (right - columns / 2) * across / total[0]
            axes = figure.add_axes([left, (top - height) / total[1], across / total[0], height / total[1]])
            axes.imshow(picture, interpolation="antialiased")
            axes.axis("off")
            time = f"t = {run.fluid.times[steps[k][row]]:.3g} s"
            axes.set_title(f"{titles[k]}, {time}" if len(runs) > 1 else time, loc="left", x=0.02, fontsize=9, pad=2)
    names = list(dict.fromkeys(run.title for run in runs))
    title = textwrap.shorten(", ".join(names).replace("_", " "), int(9 * total[0]), placeholder=" and more")
    figure.suptitle(title, fontsize=12, y=1 - 0.18 / total[1], va="center")
    colour_key(figure, runs, quantity, total)
    words = textwrap.fill(caption_of(runs), int(17 * total[0]))
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
    parser = argparse.ArgumentParser(prog="plotting.sheet", description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--picture", type=Path, required=True)
    parser.add_argument("--colour", choices=QUANTITIES, default="speed")
    parser.add_argument("--times", type=float, nargs="*")
    parser.add_argument("--titles", nargs="*")
    arguments = parser.parse_args()
    try:
        tools()
        draw([slagflow.open(folder) for folder in arguments.folders], arguments.times, arguments.colour, arguments.picture, arguments.titles)
    except (SurfaceError, slagflow.RunError, OSError) as error:
        print(error)
        return 1
    except KeyError as error:
        print(f"the run has not written what {arguments.colour!r} needs: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
