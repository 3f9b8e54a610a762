"""What `slagflow rheometry -o X.toml` leaves in X.csv: a flow curve, or viscosity or solid fraction over temperature."""

import csv

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import slagflow

AXES = {"shear_rate_1/s": "shear rate  [1/s]", "rotation_rad/s": "rotation  [rad/s]", "temperature_K": "temperature  [K]"}
MEASURED = {"measured_Pa": "shear stress  [Pa]", "measured_Pas": "viscosity  [Pa s]",
            "measured_solid_fraction": "solid fraction"}
STYLES = {"newtonian": ("#7a4fa3", ":"), "bingham": ("#31688e", "-"), "herschel-bulkley": ("#d1652a", "--"),
          "arrhenius": ("#7a4fa3", ":"), "weymann": ("#31688e", "-"), "vft": ("#d1652a", "--"),
          "urbain": ("#31688e", "-"), "riboud": ("#d1652a", "--"), "rows": ("#31688e", "-")}
ZERO = 273.15  # degrees Celsius in kelvin


def read(path):
    """Column names and rows; an empty field is not-a-number. Throws slagflow.RunError."""
    try:
        with open(path, newline="") as file:
            names, *rows = csv.reader(file)
            data = np.array([[float(field or "nan") for field in row] for row in rows])
    except (OSError, ValueError) as error:
        raise slagflow.RunError(f"{path} is not a table of curves: {error}") from error
    if names[0] not in AXES or not set(names[1:2]) & set(MEASURED) or data.ndim != 2:
        raise slagflow.RunError(f"{path} is not what slagflow rheometry -o leaves beside its table")
    return names, data


def draw_panel(axes, names, data):
    points = np.isfinite(data[:, 1])
    for column, name in enumerate(names[2:], start=2):
        model = name.removesuffix(names[1].removeprefix("measured"))
        colour, line = STYLES.get(model, ("0.4", "-."))
        best = column == 2  # the program puts the best fit first
        axes.plot(data[~points, 0], data[~points, column], line, color=colour, linewidth=2 if best else 1.2,
                  label=model + (" (best)" if best and points.any() and len(names) > 3 else ""))
    if points.any():
        axes.plot(data[points, 0], data[points, 1], "o", color="0.1", markersize=4.5, markerfacecolor="white",
                  label="file" if names[1] == "measured_solid_fraction" else "measured")
    axes.set_xlabel(AXES[names[0]], fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def draw_over_temperature(names, data):
    """Viscosities, their logarithm over T and over 1/T, where Arrhenius laws are straight; fractions on plain axes."""
    viscosities = names[1] == "measured_Pas"
    figure, panels = plt.subplots(1, 2 if viscosities else 1, figsize=(9 if viscosities else 5, 3.8), dpi=150,
                                  squeeze=False)
    plain = panels[0, 0]
    for axes in panels[0]:
        draw_panel(axes, names, data)
        axes.set_yscale("log" if viscosities else "linear")
    celsius = plain.secondary_xaxis("top", functions=(lambda t: t - ZERO, lambda t: t + ZERO))
    celsius.set_xlabel("[°C]", fontsize=8)
    celsius.tick_params(labelsize=8)
    plain.set_ylabel(MEASURED[names[1]], fontsize=9)
    plain.legend(fontsize=8, frameon=False)
    if viscosities:
        inverse = panels[0, 1]
        inverse.set_xscale("function", functions=(lambda t: -1 / np.maximum(t, 1), lambda x: -1 / np.minimum(x, -1e-9)))
        inverse.set_xlabel("temperature  [K], as 1/T", fontsize=9)
    return figure


def draw(path, target):
    """Writes the picture: the curve on plain axes from 0, and on logarithmic ones."""
    names, data = read(path)
    if names[0] == "temperature_K":
        save(draw_over_temperature(names, data), path, target)
        return
    figure, (plain, logarithmic) = plt.subplots(1, 2, figsize=(9, 3.8), dpi=150)
    for axes in (plain, logarithmic):
        draw_panel(axes, names, data)
    stress = "stress at the bob  [Pa]" if names[0].startswith("rotation") else MEASURED[names[1]]
    plain.set_ylabel(stress, fontsize=9)
    plain.set(xlim=(0, None), ylim=(0, None))
    plain.legend(fontsize=8, frameon=False)
    logarithmic.set(xscale="log", yscale="log")
    save(figure, path, target)


def save(figure, path, target):
    figure.suptitle(path.stem.replace("_", " "), fontsize=11)
    figure.tight_layout()
    figure.savefig(target)
    plt.close(figure)
