"""What may colour the fluid: its values, label, unit and colours."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

SEQUENTIAL = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.08, 1, 256)))
HOT = ListedColormap(plt.get_cmap("inferno")(np.linspace(0.12, 0.95, 256)))
FEW = ListedColormap(["#c8553d", "#2f6690", "#8d99ae", "#e9c46a", "#588157", "#6d597a"])
FREEZING = 273.15  # of water [K], 0 °C

UNITS = {  # label, factor from SI units, and the largest value [SI] of which it is taken
    "speed": [("speed  [cm/s]", 100.0, 0.5), ("speed  [m/s]", 1.0, np.inf)],
    "depth": [("depth below the highest place  [mm]", 1000.0, 2.0), ("depth below the highest place  [m]", 1.0, np.inf)],
    "pressure": [("pressure  [Pa]", 1.0, 5e3), ("pressure  [kPa]", 1e-3, np.inf)],
    "viscosity": [("apparent viscosity  [Pa s]", 1.0, np.inf)],
    "fluid": [("fluid", 1.0, np.inf)],
    "yielded": [("yielded", 1.0, np.inf)],
    "residence": [("time since it came in  [s]", 1.0, 600.0), ("time since it came in  [min]", 1 / 60, np.inf)],
    "temperature": [("temperature  [°C]", 1.0, np.inf)],
    "solid": [("solid fraction  [%]", 100.0, np.inf)],
}
QUANTITIES = tuple(UNITS)
FIELDS = {"fluid": "Fluid", "viscosity": "Viscosity", "yielded": "Yielded", "pressure": "Pressure", "temperature": "Temperature",
          "solid": "SolidFraction"}
LOWEST_FROM_DATA = ("viscosity", "temperature")


class Quantity:
    """What colours the surface: values of the particles in SI units (temperatures in °C), by step; a label, a factor and limits in its unit.
    Raises KeyError where the run has not written what it needs."""

    def __init__(self, run, steps, name):
        self.name, self.few = name, name in ("fluid", "yielded")
        self._newest = newest_ids(run.fluid) if name == "residence" else None
        self.values = {step: self._of(run.fluid, step) for step in steps}
        self.map = FEW if self.few else HOT if name == "temperature" else SEQUENTIAL
        every = np.concatenate([v for v in self.values.values() if len(v)] or [np.zeros(1)])
        top = float(np.quantile(every, 0.998))
        low = float(every.min()) if name in LOWEST_FROM_DATA else 0.0
        self.limits = (-0.5, FEW.N - 0.5) if self.few else (low, max(top, low + 1e-12))
        self.label, self.factor = UNITS[name][0][:2]

    def _of(self, fluid, step):
        if self.name == "speed":
            return fluid.speeds(step)
        if self.name == "depth":
            z = fluid.positions(step)[:, 2]
            return z.max(initial=-np.inf) - z
        if self.name == "residence":
            return ages(fluid.field("ParticleId", step), fluid.times, self._newest, step)
        values = fluid.field(FIELDS[self.name], step)
        return values - FREEZING if self.name == "temperature" else values

    def share(self, limits):
        """Takes limits [SI units] that hold for all runs shown, and the unit that fits them."""
        self.label, self.factor = next(u[:2] for u in UNITS[self.name] if limits[1] <= u[2])
        self.limits = tuple(self.factor * value for value in limits)


def newest_ids(fluid):
    """The largest identity that has come in by each snapshot; identities rise with the time of entry."""
    return np.maximum.accumulate([fluid.field("ParticleId", step).max(initial=-1) for step in range(len(fluid.times))])


def ages(identities, times, newest, step):
    """Time [s] since each particle came in, or since the start, at a step: entry is spread evenly between the snapshots."""
    entered = np.interp(identities, newest, times)
    return times[step] - np.where(identities <= newest[0], times[0], entered)


def shared(runs, steps, name):
    """The quantity of each run, on one scale."""
    quantities = [Quantity(run, chosen, name) for run, chosen in zip(runs, steps)]
    limits = (min(q.limits[0] for q in quantities), max(q.limits[1] for q in quantities))
    for quantity in quantities:
        quantity.share(limits)
    return quantities
