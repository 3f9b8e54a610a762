"""Runs modules of this folder with the Python in .venv, which has the packages from PyPI."""

import subprocess

import slagflow


def run_module(top, name, arguments):
    """`python -m plotting.NAME`, of the project at `top`. Raises slagflow.RunError with the reason it gives, or when .venv is not there."""
    command = [top / ".venv/bin/python", "-m", f"plotting.{name}", *arguments]
    try:
        made = subprocess.run([str(part) for part in command], cwd=top / "scripts", capture_output=True, text=True, check=False)
    except OSError:
        raise slagflow.RunError("`scripts/install --pictures` brings what draws surfaces and makes reports") from None
    if made.returncode != 0:
        raise slagflow.RunError(made.stdout.strip() or (made.stderr.strip().splitlines() or [f"status {made.returncode}"])[-1])
