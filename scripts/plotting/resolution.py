"""Travelling time and tan theta over the spacing, from the table of a sweep over N and spacing: observed orders and
extrapolated values."""

import csv
import math
from collections import defaultdict

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

QUANTITIES = (("jet.travelling_time", "travelling time [s]"), ("jet.tan_theta", r"tan $\theta$"))


def read_series(path):
    """{quantity: {N: [(spacing, value), coarse to fine]}}. Throws OSError, and ValueError where the table is another one."""
    with open(path, newline="") as file:
        lines = [line for line in csv.DictReader(file) if line.get("status") == "done"]
    if not lines or not {"N", "spacing", "jet.tan_theta"} <= set(lines[0]):
        raise ValueError(f"{path} holds no finished points of a sweep over N and spacing")
    series = {name: defaultdict(list) for name, _ in QUANTITIES}
    for line in sorted(lines, key=lambda line: -float(line["spacing"])):
        for name, _ in QUANTITIES:
            series[name][line["N"]].append((float(line["spacing"]), float(line[name])))
    return series


def extrapolate(points):
    """Order and limit of value = limit + C spacing^order, Richardson's way, from the three finest of (spacing, value).

    None, None where the spacings are not in one ratio, or the values do not approach a limit one way."""
    if len(points) < 3:
        return None, None
    (coarse, first), (middle, second), (fine, third) = points[-3:]
    ratio = middle / fine
    if abs(coarse / middle - ratio) > 1e-6 * ratio or (first - second) * (second - third) <= 0:
        return None, None
    order = math.log((first - second) / (second - third)) / math.log(ratio)
    if order <= 0:
        return None, None
    return order, third + (third - second) / (ratio**order - 1)


def table(series):
    """Lines of a table: quantity, N, values coarse to fine, order, limit."""
    for name, _ in QUANTITIES:
        for number, points in series[name].items():
            order, limit = extrapolate(points)
            values = ", ".join(f"{value:.4g} ({1e3 * spacing:.3g} mm)" for spacing, value in points)
            found = "no single order" if order is None else f"order {order:.2f}, extrapolated {limit:.4g}"
            yield f"{name}, N = {number}: {values}; {found}"


def draw(series, path):
    figure, panels = plt.subplots(1, 2, figsize=(8, 3.6), dpi=150)
    for axes, (name, label) in zip(panels, QUANTITIES):
        for number, points in series[name].items():
            line, = axes.plot([1e3 * s for s, _ in points], [v for _, v in points], "o-", label=f"N = {number}")
            limit = extrapolate(points)[1]
            if limit is not None:
                axes.plot([0], [limit], "x", color=line.get_color(), clip_on=False)
        axes.set(xlabel=r"spacing $\Delta x$ [mm]", ylabel=label)
        axes.set_xlim(left=0)
        axes.grid(color="0.92", linewidth=0.7)
        axes.legend(fontsize=8, frameon=False)
    figure.suptitle("Resolution (crosses: extrapolated)", fontsize=10, x=0.02, ha="left")
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)
