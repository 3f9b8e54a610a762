"""Reads the folder of a run: VTKHDF snapshots, the case and the history."""

import csv
import json
import math
import tomllib

import h5py
import numpy as np


UNITS = {"density": "kg/m³", "dynamic_viscosity": "Pa s", "plastic_viscosity": "Pa s", "consistency": "Pa sⁿ", "yield_stress": "Pa"}


class RunFolderError(Exception):
    """The folder does not hold what a run leaves; the message says what is wrong."""


class Snapshots:
    """One VTKHDF PolyData file of particles with time steps."""

    def __init__(self, path):
        if not path.is_file():
            raise RunFolderError(f"{path} is missing: is {path.parent} the folder of a run?")
        try:
            self._root = h5py.File(path, "r")["VTKHDF"]
            steps = self._root["Steps"]
            written = int(steps.attrs["NSteps"])  # after a crash there may be the beginning of one more
            self.times = steps["Values"][:written]
            self._starts = steps["PointOffsets"][:written]
            self._counts = self._root["NumberOfPoints"][:written]
        except (OSError, KeyError) as error:
            raise RunFolderError(f"{path} is not a VTKHDF file with time steps: {error}") from error
        if len(self.times) == 0:
            raise RunFolderError(f"{path} holds no time step")

    def count(self, step):
        return int(self._counts[step])

    def positions(self, step):
        """Positions in metres, shape (particles, 3)."""
        return self._part(self._root["Points"], self._starts, step).astype(float)

    def speeds(self, step):
        """Speeds in m/s, shape (particles,)."""
        return np.linalg.norm(self.field("Velocity", step), axis=1)

    def field(self, name, step):
        """A field of the particles, such as Velocity, one row a particle."""
        return self._part(self._root[f"PointData/{name}"], self._offsets(name), step).astype(float)

    def _offsets(self, name):
        path = f"Steps/PointDataOffsets/{name}"
        return self._root[path][:] if path in self._root else self._starts

    def _part(self, data, starts, step):
        start = int(starts[step])
        return data[start:start + self.count(step)]


class RunFolder:
    """What a run left: `fluid` and `walls` (None where the case wrote no walls), the spacing, the history."""

    def __init__(self, path):
        if not path.is_dir():
            raise RunFolderError(f"{path} is no folder")
        self.path = path
        self.fluid = Snapshots(path / "particles.vtkhdf")
        walls = path / "walls.vtkhdf"
        self.walls = Snapshots(walls) if walls.is_file() else None
        self.case = self._read_case()
        self.spacing = self.case["resolution"]["spacing"]

    @property
    def title(self):
        return str(self.case.get("case", {}).get("name", self.path.name))

    @property
    def dimensions(self):
        return int(self.case["resolution"].get("dimensions", 3))

    def summary(self):
        """What summary.json holds; empty where the run has not ended."""
        try:
            return json.loads((self.path / "summary.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}

    def fluids_in_words(self):
        """By name: density, rheology and its parameters as the case gives them, in SI units."""
        words = {}
        for name, fluid in self.case.get("fluid", {}).items():
            numbers = [f"{value:.4g} {UNITS[key]}" for key, value in fluid.items() if key in UNITS]
            words[name] = ", ".join([str(fluid.get("rheology", "")), *numbers]).strip(", ")
        return words

    def keys(self):
        """The values of the case by their dotted keys."""
        flat = {}

        def add(value, key):
            table = isinstance(value, dict)
            if table or (isinstance(value, list) and any(isinstance(part, (dict, list)) for part in value)):
                for name, part in value.items() if table else enumerate(value):
                    add(part, f"{key}.{name}" if key else str(name))
            else:
                flat[key] = value

        add(self.case, "")
        return flat

    def nearest_steps(self, times):
        """Numbers of the steps written nearest to the times, in order, each once."""
        return sorted({int(np.argmin(np.abs(self.fluid.times - time))) for time in times})

    def typical_steps(self, wanted=4):
        """Evenly spread over the time in which at least a tenth of the fluid is there, the end of it included."""
        counts = np.array([self.fluid.count(step) for step in range(len(self.fluid.times))])
        last = int(np.flatnonzero(counts >= 0.1 * counts.max())[-1])
        begin, end = self.fluid.times[0], self.fluid.times[last]
        return self.nearest_steps(begin + (end - begin) * np.arange(1, wanted + 1) / wanted)

    def history(self):
        """The columns of history.csv by name, those of numbers; an empty field is not-a-number."""
        path = self.path / "history.csv"
        if not path.is_file():
            raise RunFolderError(f"{path} is missing")
        try:
            with open(path, newline="", encoding="utf-8-sig") as file:
                rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
        except (UnicodeDecodeError, csv.Error) as error:
            raise RunFolderError(f"{path} is not a table of text: {error}") from error
        if not rows:
            raise RunFolderError(f"{path} is empty")
        names, lines = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
        columns = {}
        for number, name in enumerate(names):
            try:
                columns[name.strip()] = np.array([float(row[number] or "nan") for row in lines])
            except ValueError:
                continue
        return columns

    def _read_case(self):
        path = self.path / "case.toml"
        try:
            case = tomllib.loads(path.read_text(encoding="utf-8-sig"))
            spacing = case["resolution"]["spacing"]
        except FileNotFoundError:
            raise RunFolderError(f"{path} is missing: is {self.path} the folder of a run?") from None
        except (tomllib.TOMLDecodeError, UnicodeDecodeError, KeyError, TypeError) as error:
            raise RunFolderError(f"{path}: {error}") from error
        if type(spacing) not in (int, float) or not 0 < spacing < math.inf:
            raise RunFolderError(f"{path}: key 'resolution.spacing': value {spacing!r}: allowed: a number > 0 [m]")
        return case
