"""Runs of a sweep side by side, at the same times and on one scale, each with its axes as title."""

import sys

from sweeping.gather import shown

MOST = 6  # runs in a picture


def chosen(lines):
    """Of the points that are done, at most MOST, evenly over their order, both ends included."""
    done = [line for line in lines if line["status"] == "done"]
    if len(done) <= MOST:
        return done
    return [done[round(k * (len(done) - 1) / (MOST - 1))] for k in range(MOST)]


def titles(lines, axes):
    """Of the axes that vary among some points, their values."""
    varied = [axis for axis in axes if len({shown(line[axis]) for line in lines}) > 1] or list(axes)
    return [", ".join(f"{axis} = {shown(line[axis])}" for axis in varied) for line in lines]


def compare(top, plan, folder, lines):
    """Draws DIR/compare.png of a sweep of the project at `top`, and says so, or why not. Nothing is drawn where fewer than two points are done,
    or all runs are older than the picture."""
    picture, some = folder / "compare.png", chosen(lines)
    results = [folder / "points" / line["point"] / "result.json" for line in some]
    if len(some) < 2 or (picture.is_file() and all(result.stat().st_mtime < picture.stat().st_mtime for result in results)):
        return
    try:
        import slagflow
        from plotting.venv import run_module
    except ImportError as missing:
        print(f"scripts/sweep: the runs are not drawn side by side: {missing}; run scripts/install", file=sys.stderr)
        return
    axes = list(next(iter(plan["points"].values()))["axes"])
    runs = [folder / "points" / line["point"] / "run" for line in some]
    try:
        run_module(top, "sheet", [*runs, "--picture", picture, "--titles", *titles(some, axes)])
    except slagflow.RunError as reason:
        print(f"scripts/sweep: the runs are not drawn side by side: {reason}", file=sys.stderr)
        return
    done = sum(line["status"] == "done" for line in lines)
    print(picture if len(some) == done else f"{picture}, {len(some)} of {done} runs")
