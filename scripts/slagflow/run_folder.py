"""The folder of a run: its case, snapshots, history and summary."""

import json
import math
import os
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .errors import RunError
from .history import read_columns, unit_of
from .snapshots import Snapshot, Snapshots

if TYPE_CHECKING:
    import pandas

UNITS = {"density": "kg/m³", "dynamic_viscosity": "Pa s", "plastic_viscosity": "Pa s", "consistency": "Pa sⁿ", "yield_stress": "Pa"}


def open_run(path: str | os.PathLike[str]) -> "Run":
    """The run in a folder. Raises RunError where there is none, with what is missing."""
    return Run(Path(path))


class Run:
    """What a run left in its folder `path`: `case`, every key with its value; `fluid` and `walls`, snapshots of particles (`walls` is None
    where the case wrote none); `spacing` [m]. A run that goes on is seen as it was when it was opened; history and summary are read anew."""

    def __init__(self, path: Path) -> None:
        if not path.is_dir():
            raise RunError(f"{path} is no folder")
        self.path = path
        self.fluid = Snapshots(path / "particles.vtkhdf")
        walls = path / "walls.vtkhdf"
        self.walls = Snapshots(walls) if walls.is_file() else None
        self.case = self._read_case()
        self.spacing = float(self.case["resolution"]["spacing"])

    def __repr__(self) -> str:
        return f"<run {self.title!r} in {self.path}: {len(self.times)} snapshots to {self.times[-1]:.6g} s>"

    @property
    def title(self) -> str:
        """The name of the case, else that of the folder."""
        return str(self.case.get("case", {}).get("name", self.path.name))

    @property
    def dimensions(self) -> int:
        """2 or 3."""
        return int(self.case["resolution"].get("dimensions", 3))

    @property
    def times(self) -> NDArray[np.float64]:
        """Of the snapshots [s], shape (snapshots,)."""
        return self.fluid.times

    @property
    def snapshots(self) -> Snapshots:
        """Of the fluid, by number."""
        return self.fluid

    def snapshot(self, time: float) -> Snapshot:
        """Of the fluid, the one nearest to a time [s]."""
        return Snapshot(self.fluid, self.fluid.nearest(time))

    @property
    def history(self) -> "pandas.DataFrame":
        """history.csv: a row a line, columns by the names in the file, numbers alone; `attrs["units"]` has their units. Raises RunError."""
        try:
            import pandas
        except ImportError as missing:
            raise RunError(f"{missing}: `pip install pandas` brings it; columns() does without") from missing
        frame = pandas.DataFrame(self.columns())
        frame.attrs["units"] = {str(name): unit_of(str(name)) for name in frame}
        return frame

    def columns(self) -> dict[str, NDArray[np.float64]]:
        """history.csv without pandas: arrays by the name of the column; an empty field is not-a-number. Raises RunError."""
        return read_columns(self.path / "history.csv")

    @property
    def units(self) -> dict[str, str]:
        """Of the fields of snapshots and the columns of the history, by name; 1 of what has none."""
        history = self.path / "history.csv"
        return self.fluid.units | ({name: unit_of(name) for name in self.columns()} if history.is_file() else {})

    @property
    def summary(self) -> dict[str, Any]:
        """What summary.json holds; empty where the run has not ended."""
        try:
            return dict(json.loads((self.path / "summary.json").read_text(encoding="utf-8")))
        except (OSError, ValueError):
            return {}

    @property
    def measures(self) -> dict[str, dict[str, Any]]:
        """Results of the measures by name, in SI units; empty where the run has not ended."""
        return dict(self.summary.get("measures", {}))

    def told(self) -> tuple[list[str], list[str]]:
        """What the run said at its end, and its warnings, from log.txt: lines of text."""
        log = self.path / "log.txt"
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.is_file() else []
        ends = [k for k, line in enumerate(lines) if line.startswith("end:")]
        said = lines[ends[-1] + 1:] if ends else []
        warnings = list(dict.fromkeys(line.removeprefix("warning: ") for line in lines if line.startswith("warning: ")))
        return [line for line in said if line and not line.startswith(("warning: ", "results in"))], warnings

    def fluids_in_words(self) -> dict[str, str]:
        """By name: density, rheology and its parameters as the case gives them, in SI units."""
        words = {}
        for name, fluid in self.case.get("fluid", {}).items():
            numbers = [f"{value:.4g} {UNITS[key]}" for key, value in fluid.items() if key in UNITS and isinstance(value, (int, float))]
            words[name] = ", ".join([str(fluid.get("rheology", "")), *numbers]).strip(", ")
        return words

    def keys(self) -> dict[str, Any]:
        """The values of the case by their dotted keys."""
        flat: dict[str, Any] = {}

        def add(value: Any, key: str) -> None:
            table = isinstance(value, dict)
            if table or (isinstance(value, list) and any(isinstance(part, (dict, list)) for part in value)):
                for name, part in value.items() if table else enumerate(value):
                    add(part, f"{key}.{name}" if key else str(name))
            else:
                flat[key] = value

        add(self.case, "")
        return flat

    def nearest_steps(self, times: Iterable[float]) -> list[int]:
        """Numbers of the steps written nearest to the times [s], in order, each once."""
        return sorted({self.fluid.nearest(time) for time in times})

    def typical_steps(self, wanted: int = 4) -> list[int]:
        """Evenly spread over the time in which at least a tenth of the fluid is there, the end of it included."""
        counts = np.array([self.fluid.count(step) for step in range(len(self.times))])
        last = int(np.flatnonzero(counts >= 0.1 * counts.max())[-1])
        begin, end = self.times[0], self.times[last]
        return self.nearest_steps(begin + (end - begin) * np.arange(1, wanted + 1) / wanted)

    def _read_case(self) -> dict[str, Any]:
        path = self.path / "case.toml"
        try:
            case = tomllib.loads(path.read_text(encoding="utf-8-sig"))
            spacing = case["resolution"]["spacing"]
        except FileNotFoundError:
            raise RunError(f"{path} is missing: is {self.path} the folder of a run?") from None
        except (tomllib.TOMLDecodeError, UnicodeDecodeError, KeyError, TypeError) as error:
            raise RunError(f"{path}: {error}") from error
        if type(spacing) not in (int, float) or not 0 < spacing < math.inf:
            raise RunError(f"{path}: key 'resolution.spacing': value {spacing!r}: allowed: a number > 0 [m]")
        return case
