"""The paper's Figs. 2, 8 and 9 from the table of a sweep over oils and solid fractions."""

import csv
import math

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

GRAVITY, WIDTH, DEPTH = 9.81, 0.05, 0.02  # of the dam, as in the paper's equation (9)
PAPER_CRITICAL = 65
COLOURS = {"A": "#31688e", "B": "#d1652a"}
MARKS = {"slag": "o", "tenfold": "^"}
ASSUMED = {"slag": r"$\tau_B = 1.02\,\mathrm{s}^{-1}\,\eta$ (as the slag)", "tenfold": r"$\tau_B = 10.2\,\mathrm{s}^{-1}\,\eta$"}
LAWS = (
    ("Einstein–Roscoe, n = 2.0", "-", lambda phi: (1 - phi / 0.74) ** -2.0),
    ("Einstein–Roscoe, n = 2.5", ":", lambda phi: (1 - phi / 0.74) ** -2.5),
    ("Krieger–Dougherty, 0.64", "--", lambda phi: (1 - phi / 0.64) ** (-2.5 * 0.64)),
    ("Maron–Pierce, 0.64", "-.", lambda phi: (1 - phi / 0.64) ** -2.0),
    ("Thomas", (0, (5, 1, 1, 1, 1, 1)), lambda phi: 1 + 2.5 * phi + 10.05 * phi**2 + 0.00273 * np.exp(16.6 * phi)),
)


class Point:
    """One run of the sweep."""

    def __init__(self, line):
        self.oil, self.phi, self.assumption = line["oil"], float(line["phi"]), line["yield"]
        number = lambda name: float(line.get(name) or "nan")
        self.viscosity, self.density = number("fluid.slurry.plastic_viscosity"), number("fluid.slurry.density")
        self.yield_stress, self.spacing = number("fluid.slurry.yield_stress"), number("spacing")
        self.end = number("simulated_time")
        self.tan, self.time = number("jet.tan_theta"), number("jet.travelling_time")
        self.front, self.flow_class = number("jet.front_position"), line.get("jet.class", "")

    @property
    def n(self):
        """Equation (9)."""
        return self.density * WIDTH * math.sqrt(GRAVITY * DEPTH) / self.viscosity

    @property
    def bingham(self):
        return self.yield_stress > 0


def read_points(path):
    """The points that have ended well. Throws OSError, and ValueError where the table is another one."""
    with open(path, newline="") as file:
        lines = [line for line in csv.DictReader(file) if line.get("status") == "done"]
    if not lines or not {"oil", "phi", "yield", "jet.tan_theta"} <= set(lines[0]):
        raise ValueError(f"{path} holds no finished points of a sweep over oil, phi and yield")
    return [Point(line) for line in lines]


def critical_n(points):
    """Largest N of a wall flow and smallest N of a free jet, by the class of each run; None where there is none."""
    walls = [p.n for p in points if p.flow_class == "wall-flow"]
    jets = [p.n for p in points if p.flow_class == "free-jet"]
    return (max(walls) if walls else None), (min(jets) if jets else None)


def new_chart(title):
    figure, axes = plt.subplots(figsize=(6, 4.2), dpi=150)
    axes.set_title(title, loc="left", fontsize=10)
    axes.grid(color="0.92", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return figure, axes


def save(figure, axes, path, **legend):
    axes.legend(fontsize=7.5, frameon=False, **legend)
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)


def label_of(point):
    kind = ASSUMED[point.assumption] if point.bingham else "Newtonian"
    return f"oil {point.oil}, {kind}"


def mark(axes, point, x, y, seen, **style):
    """A mark as in the paper: open for Newtonian, solid for Bingham fluids."""
    colour, label = COLOURS[point.oil], label_of(point)
    shape = MARKS[point.assumption] if point.bingham else "o"
    axes.plot(x, y, shape, color=colour, markersize=6, markerfacecolor=colour if point.bingham else "white",
              label=None if label in seen else label, **style)
    seen.add(label)


def draw_viscosity(points, path):
    """Fig. 2: the laws, and the viscosities that the runs had."""
    figure, axes = new_chart("Relative viscosity of a suspension (Fig. 2)")
    phi = np.linspace(0, 0.6, 200)
    for name, line, law in LAWS:
        axes.plot(phi, law(phi), linestyle=line, color="0.25", linewidth=1.3, label=name)
    base = {p.oil: p.viscosity for p in points if p.phi == 0}
    for oil in sorted(base):
        chosen = sorted({(p.phi, p.viscosity / base[oil]) for p in points if p.oil == oil})
        axes.plot(*zip(*chosen), "o" if oil == "A" else "x", color=COLOURS[oil], markersize=6, markerfacecolor="none",
                  label=f"runs with oil {oil}")
    axes.set(xlabel=r"solid fraction $\varphi$", ylabel=r"$\eta/\eta_0$", yscale="log", xlim=(0, 0.6), ylim=(0.9, 100))
    save(figure, axes, path)


def draw_jets(points, path):
    """Fig. 8: tan theta over N."""
    spacing = 1e3 * points[0].spacing
    figure, axes = new_chart(f"Jet angle at the bottom (Fig. 8), {spacing:.3g} mm")
    wall, jet = critical_n(points)
    if wall and jet:
        axes.axvspan(*sorted((wall, jet)), color="0.88", label=f"wall flows up to N = {wall:.0f}, free jets from {jet:.0f} on")
    axes.axvline(PAPER_CRITICAL, color="0.4", linestyle="--", linewidth=1, label=f"the paper's critical N = {PAPER_CRITICAL}")
    seen = set()
    for p in points:
        if math.isfinite(p.tan):
            mark(axes, p, p.n, p.tan, seen)
            axes.annotate(f"{p.phi:g}", (p.n, p.tan), (4, -8 if p.assumption == "tenfold" else 4), textcoords="offset points",
                          fontsize=6, color="0.4")
    axes.set(xlabel=r"$N = \rho L \sqrt{gH}/\eta$", ylabel=r"$\tan\theta$", xscale="log", ylim=(0, None))
    save(figure, axes, path, loc="upper left")


def draw_times(points, path):
    """Fig. 9: travelling time over the solid fraction; points that did not arrive stand at the upper edge."""
    spacing = 1e3 * points[0].spacing
    figure, axes = new_chart(f"Travelling time (Fig. 9), {spacing:.3g} mm")
    seen = set()
    for oil, assumption in sorted({(p.oil, p.assumption) for p in points}):
        series = [p for p in points if p.oil == oil and (p.assumption == assumption or not p.bingham)]
        series = sorted((p.phi, p.time) for p in series if math.isfinite(p.time))
        if series:
            axes.plot(*zip(*series), color=COLOURS[oil], linewidth=0.8, alpha=0.5)
    for p in points:
        if math.isfinite(p.time):
            mark(axes, p, p.phi, p.time, seen)
    axes.set(xlabel=r"solid fraction $\varphi$", ylabel="travelling time  [s]", yscale="log")
    lost = [p for p in points if not math.isfinite(p.time)]
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * (1.9 if lost else 1))
    for p in lost:
        axes.annotate(f"not after {p.end:.3g} s", (p.phi, axes.get_ylim()[1]), (0, -3), textcoords="offset points", fontsize=6,
                      color=COLOURS[p.oil], ha="center", va="top", rotation=90)
    axes.yaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes.yaxis.set_minor_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes.tick_params(axis="y", which="minor", labelsize=7)
    save(figure, axes, path, loc="upper left")
