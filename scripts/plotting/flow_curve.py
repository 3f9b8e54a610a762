"""Measured flow curve and the fitted models, from the CSV file that `slagflow rheometry -o X.toml` leaves."""

import csv

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import slagflow

AXES = {"shear_rate_1/s": "shear rate  [1/s]", "rotation_rad/s": "rotation  [rad/s]"}
STYLES = {"newtonian_Pa": ("#7a4fa3", ":"), "bingham_Pa": ("#31688e", "-"), "herschel-bulkley_Pa": ("#d1652a", "--")}


def read(path):
    """Column names and rows; an empty field is not-a-number. Throws slagflow.RunError."""
    try:
        with open(path, newline="") as file:
            names, *rows = csv.reader(file)
            data = np.array([[float(field or "nan") for field in row] for row in rows])
    except (OSError, ValueError) as error:
        raise slagflow.RunError(f"{path} is not a table of curves: {error}") from error
    if names[0] not in AXES or names[1:2] != ["measured_Pa"] or data.ndim != 2:
        raise slagflow.RunError(f"{path} is not what slagflow rheometry -o leaves beside its table")
    return names, data


def draw_panel(axes, names, data):
    points = np.isfinite(data[:, 1])
    for column, name in enumerate(names[2:], start=2):
        colour, line = STYLES.get(name, ("0.4", "-."))
        best = column == 2  # the program puts the best fit first
        axes.plot(data[~points, 0], data[~points, column], line, color=colour, linewidth=2 if best else 1.2,
                  label=name.removesuffix("_Pa") + (" (best)" if best else ""))
    axes.plot(data[points, 0], data[points, 1], "o", color="0.1", markersize=4.5, markerfacecolor="white",
              label="measured")
    axes.set_xlabel(AXES[names[0]], fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def draw(path, target):
    """Writes the picture: the curve on plain axes from 0, and on logarithmic ones."""
    names, data = read(path)
    figure, (plain, logarithmic) = plt.subplots(1, 2, figsize=(9, 3.8), dpi=150)
    for axes in (plain, logarithmic):
        draw_panel(axes, names, data)
    stress = "stress at the bob  [Pa]" if names[0].startswith("rotation") else "shear stress  [Pa]"
    plain.set_ylabel(stress, fontsize=9)
    plain.set(xlim=(0, None), ylim=(0, None))
    plain.legend(fontsize=8, frameon=False)
    logarithmic.set(xscale="log", yscale="log")
    figure.suptitle(path.stem.replace("_", " "), fontsize=11)
    figure.tight_layout()
    figure.savefig(target)
    plt.close(figure)
