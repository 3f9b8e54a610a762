"""Reads snapshots of particles: VTKHDF PolyData with time steps."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from .errors import RunError

POSITION = "Position"


class Snapshot(Mapping[str, NDArray[Any]]):
    """The particles at one time: arrays by the name of the field, one row a particle, in the order of the file.

    `Position` [m] and `Velocity` [m/s] have shape (particles, 3), all others (particles,)."""

    def __init__(self, snapshots: "Snapshots", step: int) -> None:
        self._snapshots, self.step = snapshots, step
        self.time = float(snapshots.times[step])

    @property
    def positions(self) -> NDArray[np.float64]:
        """[m], shape (particles, 3)."""
        return self._snapshots.positions(self.step)

    @property
    def count(self) -> int:
        """Particles at this time."""
        return self._snapshots.count(self.step)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._snapshots.names:
            raise KeyError(f"{name!r}: allowed: {', '.join(self._snapshots.names)}")
        return self._snapshots.positions(self.step) if name == POSITION else self._snapshots.raw(name, self.step)

    def __iter__(self) -> Iterator[str]:
        return iter(self._snapshots.names)

    def __len__(self) -> int:
        return len(self._snapshots.names)

    def __repr__(self) -> str:
        return f"<snapshot at {self.time:.6g} s: {self.count} particles; {', '.join(self)}>"


class Snapshots(Sequence[Snapshot]):
    """One file of particles with time steps: a sequence of snapshots. Raises RunError when it is none."""

    def __init__(self, path: Path) -> None:
        if not path.is_file():
            raise RunError(f"{path} is missing: is {path.parent} the folder of a run?")
        try:
            self._root = h5py.File(path, "r")["VTKHDF"]
            steps = self._root["Steps"]
            written = int(steps.attrs["NSteps"])  # after a crash there may be the beginning of one more
            self.times: NDArray[np.float64] = steps["Values"][:written]
            self._starts = steps["PointOffsets"][:written]
            self._counts = self._root["NumberOfPoints"][:written]
        except (OSError, KeyError) as error:
            raise RunError(f"{path} is not a VTKHDF file with time steps: {error}") from error
        if len(self.times) == 0:
            raise RunError(f"{path} holds no time step")

    @property
    def names(self) -> list[str]:
        """Of the fields, that of the positions first."""
        return [POSITION, *self._root["PointData"]]

    @property
    def units(self) -> dict[str, str]:
        """Of the fields by name, as the file says; 1 where it does not."""
        said = {name: field.attrs.get("units", "1") for name, field in self._root["PointData"].items()}
        return {POSITION: "m"} | {name: unit.decode() if isinstance(unit, bytes) else str(unit) for name, unit in said.items()}

    def __len__(self) -> int:
        return len(self.times)

    def __getitem__(self, step: Any) -> Any:
        """A snapshot by its number, negative ones from the end, or a list of them by a slice."""
        if isinstance(step, slice):
            return [Snapshot(self, k) for k in range(*step.indices(len(self)))]
        if not -len(self) <= step < len(self):
            raise IndexError(f"snapshot {step}: allowed: {-len(self)} to {len(self) - 1}")
        return Snapshot(self, int(step) % len(self))

    def nearest(self, time: float) -> int:
        """Number of the step written nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - time)))

    def count(self, step: int) -> int:
        """Particles at a step."""
        return int(self._counts[step])

    def positions(self, step: int) -> NDArray[np.float64]:
        """[m], shape (particles, 3)."""
        return self._part(self._root["Points"], self._starts, step).astype(float)

    def speeds(self, step: int) -> NDArray[np.float64]:
        """[m/s], shape (particles,)."""
        return np.linalg.norm(self.field("Velocity", step), axis=1)

    def field(self, name: str, step: int) -> NDArray[np.float64]:
        """A field such as Velocity as floating point numbers, one row a particle. Raises KeyError when it was not written."""
        return self.raw(name, step).astype(float)

    def raw(self, name: str, step: int) -> NDArray[Any]:
        """The same in the type of the file: identities stay whole numbers."""
        return self._part(self._root[f"PointData/{name}"], self._offsets(name), step)

    def _offsets(self, name: str) -> NDArray[np.int64]:
        path = f"Steps/PointDataOffsets/{name}"
        return np.asarray(self._root[path][:] if path in self._root else self._starts)

    def _part(self, data: Any, starts: NDArray[np.int64], step: int) -> NDArray[Any]:
        start = int(starts[step])
        return np.asarray(data[start:start + self.count(step)])
