"""Finds the program and runs cases with it."""

import json
import os
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .errors import ProgramError
from .run_folder import Run, open_run

VARIABLE = "SLAGFLOW_PROGRAM"


def checkouts() -> Iterator[Path]:
    """Folders that may be the checkout: the one that holds this package, and those that the working folder is in."""
    yield Path(__file__).resolve().parent.parent.parent
    yield from [Path.cwd(), *Path.cwd().parents]


def find_program(program: str | os.PathLike[str] | None = None) -> Path:
    """The program: as given, in the environment's SLAGFLOW_PROGRAM, in PATH, or build/cuda or build/cpu of the checkout. Raises ProgramError."""
    given = program or os.environ.get(VARIABLE)
    if given:
        found = shutil.which(given)
        if not found:
            raise ProgramError(f"{os.fspath(given)} is no program" + ("" if program else f", which {VARIABLE} names"))
        return Path(found).resolve()
    if found := shutil.which("slagflow"):
        return Path(found).resolve()
    for top in checkouts():
        for build in ("cuda", "cpu"):
            path = top / "build" / build / "slagflow"
            if path.is_file() and os.access(path, os.X_OK):
                return path
    raise ProgramError(f"the program slagflow is not found: allowed: the argument `program`, {VARIABLE}, a folder of PATH, build/cpu of a checkout, "
                       "where scripts/run builds it")


def message_of(said: str, status: int) -> str:
    """The error that the program told on stderr, with the lines that belong to it; else the last line."""
    lines = [line for line in said.strip().splitlines() if not line.startswith("warning: ")]
    first = next((k for k, line in enumerate(lines) if line.startswith("error:")), len(lines) - 1)
    told = "\n".join(lines[max(first, 0):]).removeprefix("error:").strip()
    return told or f"slagflow ended with {status}"


def run(case: str | os.PathLike[str], *, output: str | os.PathLike[str] | None = None, set: Mapping[str, Any] | None = None,
        program: str | os.PathLike[str] | None = None, threads: int | None = None, overwrite: bool = False) -> Run:
    """Runs a case to its end and opens what it left.

    `output`: the folder (default: runs/NAME, here). `set`: values in SI units in place of those in the file, by dotted key: numbers, words,
    true and false, lists. `program`: see find_program. `threads`: of a build for CPUs (default: all). `overwrite`: replaces an earlier run.
    Raises ProgramError with the program's own message: `status` is 2 for a case that is not valid, 1 for a run that failed."""
    command = [str(find_program(program)), "run", os.fspath(case), "--quiet"]
    command += [f"--set={key}={json.dumps(value)}" for key, value in (set or {}).items()]  # TOML and JSON agree on what a case holds
    command += ["-o", os.fspath(output)] if output is not None else []
    command += ["--threads", str(threads)] if threads is not None else []
    command += ["--overwrite"] if overwrite else []
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise ProgramError(message_of(ended.stderr, ended.returncode), ended.returncode)
    folder = next((line.removeprefix("results in ") for line in ended.stdout.splitlines() if line.startswith("results in ")), None)
    if folder is None:
        raise ProgramError(f"{command[0]} did not say where its results are", 0)
    return open_run(folder)
