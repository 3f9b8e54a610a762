"""What history.csv holds, over time: the measures of the case first, then the flow as a whole."""

import re

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

import slagflow

# Units by steps in which an axis may be scaled, the largest first.
LENGTH = (("km", 1e3), ("m", 1), ("mm", 1e-3))
AREA = (("m²", 1), ("cm²", 1e-4), ("mm²", 1e-6))
VOLUME = (("m³", 1), ("l", 1e-3), ("ml", 1e-6), ("µl", 1e-9))
FORCE = (("MN", 1e6), ("kN", 1e3), ("N", 1), ("mN", 1e-3), ("µN", 1e-6))
ENERGY = (("MJ", 1e6), ("kJ", 1e3), ("J", 1), ("mJ", 1e-3), ("µJ", 1e-6))
MASS = (("t", 1e3), ("kg", 1), ("g", 1e-3), ("mg", 1e-6))
SHARE = (("%", 1e-2),)
COUNT = (("particles", 1),)
PRESSURE = (("MPa", 1e6), ("kPa", 1e3), ("Pa", 1))
DURATION = (("min", 60), ("s", 1), ("ms", 1e-3))
TEMPERATURE = (("°C", 1),)
INDEX = (("0 apart, 1 as at random", 1),)
BARE = (COUNT, INDEX)  # these stand without brackets
FREEZING = 273.15  # of water [K]
WINDOW = 60  # of the lines of the history: flow rates, which come by single particles, are means over so small a part

# Panels: title, the columns that belong there, what ends their unit, and its steps.
PANELS = (
    ("Front", r"_front_m$", "", LENGTH),
    ("Level", r"_(surface|highest)_m$", "", LENGTH),
    ("Thickness of the fluid", r"_thickness_m$", "", LENGTH),
    ("Passed share of the fluid", r"_passed$", "", SHARE),
    ("Flow rate", r"_m3_s$", "/s", VOLUME),
    ("Flow rate", r"_m2_s$", "/s", AREA),
    ("Volume", r"_m3$", "", VOLUME),
    ("Area", r"_m2$", "", AREA),
    ("Mass passed", r"_(forward|backward)_kg$", "", MASS),
    ("Mass passed per width", r"_(forward|backward)_kg_m$", "/m", MASS),
    ("Mass fed and taken", r"_mass_(fed|removed)_kg$", "", MASS),
    ("Touched or covered share", r"_(wetted|covered)_share$", "", SHARE),
    ("Touched length", r"_wetted_m$", "", LENGTH),
    ("Pressure on a wall", r"_(mean|largest)_pressure_Pa$", "", PRESSURE),
    ("Time since it came in", r"_(mean|p\d\d)_s$", "", DURATION),
    ("Mixing index", r"_index$", "", INDEX),
    ("Temperature", r"_K$", "", TEMPERATURE),
    ("Heat lost and gained", r"^heat_(by_|to_).*_J$", "", ENERGY),
    ("Heat of the fluid, fed and left", r"^heat_(content|fed|left)_J$", "", ENERGY),
    ("Heat taken by a wall", r"_taken_J$", "", ENERGY),
    ("Heat taken by a wall per width", r"_taken_J_m$", "/m", ENERGY),
    ("Force", r"_force_[xyz]_N$", "", FORCE),
    ("Force per width", r"_force_[xyz]_N_m$", "/m", FORCE),
    ("Torque", r"_torque_[xyz]_Nm$", " m", FORCE),
    ("Torque per width", r"_torque_[xyz]_Nm_m$", " m/m", FORCE),
    ("Work", r"_work_J$", "", ENERGY),
    ("Work per width", r"_work_J_m$", "/m", ENERGY),
    ("Energy", r"^(kinetic|potential|dissipated)_energy_J$", "", ENERGY),
    ("Mass in the domain, and left", r"^mass_(in|left)_kg$", "", MASS),
    ("Fluid", r"^particles_(in|out)$", "", COUNT),
)
ENDING = re.compile(r"(_front_m|_passed|_(surface|thickness|wetted)_m|_m[23]_s|_m[23]|_(N|Nm|J|kg)(_m)?|_pressure_Pa|_K|_s|_m|_(share|index))$")
LINES = ("#31688e", "#d1652a", "#3f8f4f", "#7a4fa3", "#8a6d3b", "#555555")  # tell apart in grey too
STYLES = ("-", "--", ":", "-.")
SMALL = 1e-3  # of the largest component: a force or torque below it is none


def label_of(name):
    """`kinetic_energy_J` reads as `kinetic energy`, `jet_front_m` as `jet`: the axis says the rest."""
    return re.sub(r"_flow$|_(force|torque)(?=_[xyz]$)", "", ENDING.sub("", name)).replace("_", " ")


def with_forces(columns):
    """Pressure and viscous parts of a force as their sum."""
    joined = {}
    for name, values in columns.items():
        part = re.search(r"_(pressure|viscous)_[xyz]_N(_m)?$", name)
        target = name if part is None else name.replace(f"_{part[1]}_", "_force_")
        joined[target] = joined[target] + values if part and target in joined else values
    return joined


def in_celsius(columns):
    """Temperatures [K] in °C."""
    return {name: values - FREEZING if name.endswith("_K") else values for name, values in columns.items()}


def evened(values, lines):
    """Running means over so many lines, of what is there; shorter at the ends."""
    there = np.isfinite(values)
    window = np.ones(lines)
    count = np.convolve(there, window, "same")
    return np.where(there & (count > 0), np.convolve(np.where(there, values, 0), window, "same") / np.maximum(count, 1), np.nan)


def evened_flows(title, columns, time):
    """A panel of flow rates as running means, and its title with the time [s] that they go over; others as they are."""
    lines = 2 * (len(time) // WINDOW // 2) + 1 if time is not None else 1
    if title != "Flow rate" or lines < 3:
        return title, columns
    span = (time[-1] - time[0]) / (len(time) - 1) * lines
    return f"{title}, mean over {span:.2g} s", {name: evened(values, lines) for name, values in columns.items()}


def without_zeros(chosen):
    """Without vectors' components that are nothing beside the largest one."""
    vectors = [name for name in chosen if re.search(r"_(force|torque)_[xyz]_", name)]
    if not vectors:
        return chosen
    sizes = {name: np.nanmax(np.abs(chosen[name]), initial=0) for name in vectors}
    return {name: values for name, values in chosen.items() if sizes[name] > SMALL * max(sizes.values())}


def labelled(columns):
    """Curves by label; columns of the same values, as measures of one front give, are one curve."""
    curves = {}
    for name, values in columns.items():
        same = next((label for label, other in curves.items() if np.array_equal(other, values, True)), None)
        label = label_of(name) if same is None else f"{same}, {label_of(name)}"
        curves.pop(same, None)
        curves[label] = values
    return curves


def scale(columns, steps):
    """The unit, and its size, in which the largest value is at least one."""
    largest = max((np.nanmax(np.abs(values), initial=0) for values in columns.values()), default=0)
    return next(((name, size) for name, size in steps if largest >= size), steps[-1] if largest > 0 else steps[0])


def panels_of(columns, time=None):
    """Title, curves' columns, unit and its size of each panel; without those in which nothing is. With the `time` [s] of the lines flow
    rates are evened out."""
    columns, panels = in_celsius(with_forces(columns)), []
    for title, pattern, ending, steps in PANELS:
        chosen = without_zeros({name: values for name, values in columns.items() if re.search(pattern, name)})
        empty = not any(np.any(np.nan_to_num(values)) for values in chosen.values())
        if not chosen or (empty and steps is not COUNT):
            continue
        title, chosen = evened_flows(title, chosen, time)
        unit, size = scale(chosen, steps)
        panels.append((title, chosen, unit if steps in BARE else f"[{unit}{ending}]", size))
    return panels


def draw_panel(axes, time, title, columns, unit, size):
    for number, (label, values) in enumerate(labelled(columns).items()):
        style = STYLES[number // len(LINES) % len(STYLES)]
        axes.plot(time, values / size, color=LINES[number % len(LINES)], linestyle=style, linewidth=1.5, label=label)
    axes.set_title(title, loc="left", fontsize=10)
    axes.set_xlabel("time  [s]", fontsize=9)
    axes.set_ylabel(unit, fontsize=9)
    if unit == COUNT[0][0]:
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.tick_params(labelsize=8)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.legend(fontsize=8, frameon=False)


def draw(run, path):
    """Writes the picture: a panel for each kind of quantity that the history has. Throws slagflow.RunError."""
    columns = run.columns()
    if "time_s" not in columns:
        raise slagflow.RunError(f"{run.path / 'history.csv'} has no column time_s")
    time = columns.pop("time_s")
    panels = panels_of(columns, time)
    lines = max(1, (len(panels) + 1) // 2)
    figure, grid = plt.subplots(lines, 2, figsize=(9, 0.4 + 2.7 * lines), squeeze=False, dpi=150)
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, time, *panel)
    for axes in list(grid.flat)[len(panels):]:
        axes.set_visible(False)
    height = figure.get_figheight()
    figure.suptitle(run.title.replace("_", " "), fontsize=11, y=1 - 0.15 / height, va="center")
    figure.tight_layout(rect=(0, 0, 1, 1 - 0.3 / height))
    figure.savefig(path)
    plt.close(figure)
