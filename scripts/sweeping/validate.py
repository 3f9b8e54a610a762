"""Asks `slagflow check` of points, several at a time."""

import subprocess
from concurrent.futures import ThreadPoolExecutor

from sweeping.plan import toml_text


def settings_of(overrides):
    return [f"--set={key}={toml_text(value)}" for key, value in overrides.items()]


def complaint(program, case, point):
    """Empty, or the first of what is wrong with the point."""
    done = subprocess.run([program, "check", case, *settings_of(point.overrides)], capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    lines = done.stderr.strip().splitlines() or [f"slagflow check ended with {done.returncode}"]
    return next((line for line in lines if line.startswith("error:")), lines[-1]).removeprefix("error: ")


def complaints(program, sweep, cores):
    """Point -> what is wrong with it, of those that are not valid."""
    with ThreadPoolExecutor(cores) as pool:
        said = pool.map(lambda point: complaint(program, sweep.case, point), sweep.points)
    return {point.name: what for point, what in zip(sweep.points, said) if what}
