"""What the comparisons are made of: runs of the program, their results, and rows of the table."""

import json
import tomllib
from dataclasses import dataclass, field

import numpy as np

import slagflow


@dataclass(frozen=True)
class Run:
    """One run: a file of cases/verification (or cases, with a slash before it) with some keys replaced."""

    name: str
    case: str
    resolution: str  # as the table says it
    settings: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Row:
    """One line of the table; `passed` is None where there is nothing to reach."""

    resolution: str
    quantity: str
    measured: str
    expected: str
    error: str
    target: str
    passed: bool | None

    @property
    def key(self):
        """Names it in the MISSES of a module, which hold the causes of known misses."""
        return f"{self.resolution}: {self.quantity}"


def number(value):
    """1.2346, 3.01e-06"""
    return f"{value:.4g}"


def percent(fraction):
    return f"{100 * fraction:.2f} %"


def profile_row(resolution, quantity, measured, exact, target=None):
    """The relative L2 difference of two arrays."""
    error = relative_l2(measured, exact)
    return Row(resolution, quantity, "profile", "profile", percent(error), limit(target), verdict(error, target))


def relative_row(resolution, quantity, measured, exact, target=None):
    error = abs(measured / exact - 1)
    return Row(resolution, quantity, number(measured), number(exact), percent(error), limit(target),
               verdict(error, target))


def bound_row(resolution, quantity, measured, bounds):
    """A number that must lie between bounds, either of which may be None."""
    low, high = bounds
    text = " and ".join(sign + number(bound) for sign, bound in (("≥ ", low), ("≤ ", high)) if bound is not None)
    good = (low is None or measured >= low) and (high is None or measured <= high)
    return Row(resolution, quantity, number(measured), "–", "–", text, bool(good))


def length_row(resolution, quantity, lengths, allowed):
    """Measured and exact length; `allowed`: the relative part of the target and the absolute one."""
    measured, exact = lengths
    relative, absolute = allowed
    error = abs(measured - exact)
    text = f"{100 * relative:g} % + {number(absolute)}"
    return Row(resolution, quantity, number(measured), number(exact), percent(error / exact), text,
               bool(error <= relative * abs(exact) + absolute))


def limit(target):
    return "–" if target is None else f"{100 * target:g} %"


def verdict(error, target):
    return None if target is None else bool(error <= target)


def relative_l2(measured, exact):
    return float(np.sqrt(np.sum((measured - exact) ** 2) / np.sum(exact ** 2)))


@dataclass(frozen=True)
class State:
    """The fluid at one time; one row a particle."""

    time: float
    position: np.ndarray
    velocity: np.ndarray
    pressure: np.ndarray
    yielded: np.ndarray


class Result:
    """What a run left."""

    def __init__(self, run, folder):
        self.run = run
        self._folder = slagflow.open(folder)
        self.case = tomllib.loads((folder / "case.toml").read_text())
        self.spacing = self._folder.spacing
        self.times = np.array(self._folder.fluid.times)

    @property
    def resolution(self):
        return self.run.resolution

    @property
    def history(self):
        return self._folder.columns()

    def state(self, time=None):
        """The snapshot nearest to a time; the last without one."""
        step = len(self.times) - 1 if time is None else int(np.argmin(np.abs(self.times - time)))
        fluid = self._folder.fluid
        return State(float(self.times[step]), fluid.positions(step), fluid.field("Velocity", step),
                     fluid.field("Pressure", step), fluid.field("Yielded", step))

    def velocity_time(self, state):
        """The time [s] that the velocities of a state belong to: half a step before the places."""
        times, steps = self.history["time_s"], self.history["dt_s"]
        return state.time - 0.5 * float(steps[int(np.argmin(np.abs(np.asarray(times) - state.time)))])

    def states(self):
        return [self.state(time) for time in self.times]

    def last(self, name):
        """A field of the last snapshot, such as Fluid: the place of each particle's fluid in the case."""
        return self._folder.fluid.field(name, len(self.times) - 1)

    @property
    def walls(self):
        """Snapshots of the wall particles."""
        return self._folder.walls

    def ordered(self, time):
        """Positions in the snapshot nearest to a time, in the order of the particles at the start."""
        step = int(np.argmin(np.abs(self.times - time)))
        fluid = self._folder.fluid
        return fluid.positions(step)[np.argsort(fluid.field("ParticleId", step))]

    @property
    def summary(self):
        return json.loads((self._folder.path / "summary.json").read_text())

    def fluid(self):
        """The keys of the only fluid."""
        (fluid,) = self.case["fluid"].values()
        return fluid
