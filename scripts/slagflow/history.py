"""Reads history.csv and knows the units of its columns."""

import csv
import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import RunError

UNITS = {"m3_s": "m^3/s", "m2_s": "m^2/s", "m_s": "m/s", "m3": "m^3", "m2": "m^2", "kg_m": "kg/m", "kg": "kg", "N_m": "N/m", "N": "N",
         "Nm_m": "N m/m", "Nm": "N m", "J_m": "J/m", "J": "J", "Pa": "Pa", "K": "K", "m": "m", "s": "s"}
ENDING = re.compile(rf"_({'|'.join(UNITS)})$")


def unit_of(column: str) -> str:
    """The unit that the name of a column ends with: m^3/s of `gate_flow_m3_s`; 1 without."""
    found = ENDING.search(column)
    return UNITS[found[1]] if found else "1"


def read_columns(path: Path) -> dict[str, NDArray[np.float64]]:
    """The columns by name, those of numbers; an empty field is not-a-number. Raises RunError."""
    if not path.is_file():
        raise RunError(f"{path} is missing")
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    except (UnicodeDecodeError, csv.Error) as error:
        raise RunError(f"{path} is not a table of text: {error}") from error
    if not rows:
        raise RunError(f"{path} is empty")
    names, lines = rows[0], [row for row in rows[1:] if len(row) == len(rows[0])]
    columns = {}
    for number, name in enumerate(names):
        try:
            columns[name.strip()] = np.array([float(row[number] or "nan") for row in lines])
        except ValueError:
            continue
    return columns
