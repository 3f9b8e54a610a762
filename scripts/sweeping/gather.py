"""Gathers the points of a sweep in one table. A line a point: its axes, how it ended, the fluids, the cost, and every
number and word of its measures."""

import csv
import json
import tomllib

# What a reader asks first, in the printed table; results.csv has all.
MAIN = ("travelling_time", "class", "tan_theta", "passed_volume", "volume", "flow_rate", "largest_force")
SUMMARY = ("spacing", "steps", "simulated_time", "wall_time", "particle_steps_per_second", "max_compression", "mass_start",
           "mass_in", "mass_left", "version", "commit", "backend", "precision")


def scalars(value, prefix):
    """Dotted key -> value of the numbers and words in nested tables; vectors by x, y, z."""
    if isinstance(value, list) and len(value) == 3 and not any(isinstance(entry, (list, dict)) for entry in value):
        value = dict(zip("xyz", value))
    if isinstance(value, dict):
        for key, entry in value.items():
            yield from scalars(entry, f"{prefix}.{key}" if prefix else key)
    elif not isinstance(value, list):
        yield prefix, value


def read_json(path):
    return json.loads(path.read_text()) if path.is_file() else {}


def line_of(folder, axes):
    result = read_json(folder / "result.json")
    line = {"point": folder.name, **result.get("axes", axes), "status": result.get("status", "missing"),
            "reason": result.get("reason", "")}
    summary = read_json(folder / "run/summary.json")
    case = folder / "run/case.toml"
    if case.is_file():
        line |= dict(scalars(tomllib.loads(case.read_text()).get("fluid", {}), "fluid"))
    line |= {key: summary[key] for key in SUMMARY if key in summary}
    return line | dict(scalars(summary.get("measures", {}), ""))


def gather(plan, folder):
    """Writes results.csv in the sweep's folder. Returns its lines."""
    lines = [line_of(folder / "points" / name, point["axes"]) for name, point in plan["points"].items()]
    columns = list(dict.fromkeys(column for line in lines for column in line))
    with open(folder / "results.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: "" if value is None else value for key, value in line.items()} for line in lines)
    return lines


def shown(value):
    if value is None or value == "":
        return "-"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def table(plan, lines):
    """Of text: the axes of each point, how it ended, and the main results of its measures."""
    axes = list(next(iter(plan["points"].values()))["axes"])
    results = [column for column in dict.fromkeys(column for line in lines for column in line)
               if "." in column and column.rsplit(".", 1)[1] in MAIN and not column.startswith("fluid.")]
    columns = axes + ["status"] + results
    rows = [columns] + [[shown(line.get(column)) for column in columns] for line in lines]
    widths = [max(len(row[k]) for row in rows) for k in range(len(columns))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
