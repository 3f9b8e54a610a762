"""A page of a sweep to share: what varies, the results over it as plots that answer to the mouse, runs side by side, and a table."""

import argparse
import csv
import json
import sys
from pathlib import Path

from plotting.page import ReportError, figure_html, picture_html, plots_html, table, text, tools, whole
from sweeping.gather import MAIN, shown

BOOKKEEPING = ("point", "status", "reason", "steps", "wall_time", "particle_steps_per_second", "version", "commit", "backend", "precision")


def read(folder):
    """The plan and the lines of results.csv. Raises ReportError."""
    try:
        plan = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
        with open(folder / "results.csv", newline="", encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
    except (OSError, ValueError) as error:
        raise ReportError(f"{folder} is not the folder of a sweep that has ended: {error}") from error
    return plan, lines


def value_of(word):
    """A field as a number where it is one, else as it stands; None where it is empty."""
    try:
        return float(word)
    except (TypeError, ValueError):
        return word or None


def varying(lines, columns):
    """Those of the columns that hold numbers, not the same in all lines."""
    found = []
    for column in columns:
        values = [value for line in lines if (value := value_of(line.get(column))) is not None]
        if len(set(values)) > 1 and all(isinstance(value, float) for value in values):
            found.append(column)
    return found


def results_of(lines, axes):
    """Columns of the measures that tell something: those a reader asks for first, then the rest."""
    measures = [c for c in lines[0] if "." in c and not c.startswith("fluid.") and c not in axes]
    found = varying(lines, measures)
    return sorted(found, key=lambda c: (c.rsplit(".", 1)[1] not in MAIN, measures.index(c)))


def traces(lines, axes, result):
    """Name, x and y of each curve: over the first axis that has numbers, one for each combination of the others."""
    over = next(iter(varying(lines, axes)), axes[0])
    curves = {}
    for line in lines:
        y = value_of(line.get(result))
        if isinstance(y, float):
            name = ", ".join(f"{axis} = {shown(value_of(line[axis]))}" for axis in axes if axis != over)
            curves.setdefault(name, []).append((value_of(line[over]), y))
    if all(isinstance(x, float) for points in curves.values() for x, _ in points):
        curves = {name: sorted(points) for name, points in curves.items()}
    return over, [(name or result, [x for x, _ in points], [y for _, y in points]) for name, points in curves.items()]


def figures(lines, axes, graph):
    found = []
    for result in results_of(lines, axes):
        over, curves = traces(lines, axes, result)
        if sum(len(x) for _, x, _ in curves) > 1:
            measure, _, what = result.partition(".")
            found.append(figure_html(graph, curves, (over, "SI units", f"{measure}: {what.replace('_', ' ')}"), not found, "lines+markers"))
    return found


def table_of(lines, columns):
    """All points, a line each."""
    head = "".join(f"<th>{text(column)}</th>" for column in columns)
    rows = "".join("<tr>" + "".join(f"<td>{text(shown(value_of(line.get(column))))}</td>" for column in columns) + "</tr>" for line in lines)
    return f"<div class='scroll'><table class='wide'><tr>{head}</tr>{rows}</table></div>"


def common(plan):
    """Keys that all points set alike."""
    every = [point["overrides"] for point in plan["points"].values()]
    return {key: value for key, value in every[0].items() if all(key in other and other[key] == value for other in every)}


def page(folder):
    """The whole file as text. Raises ReportError."""
    _, graph = tools()
    plan, lines = read(folder)
    axes = list(next(iter(plan["points"].values()))["axes"])
    done = [line for line in lines if line["status"] == "done"]
    parts = [f"<h1>{text(folder.name.replace('_', ' '))}</h1><p class='lead'>{len(done)} of {len(lines)} points of {text(Path(plan['case']).name)}, "
             f"over {text(', '.join(axes))}</p>"]
    parts += [f"<p class='warning'>{text(line['point'])}: {text(line['reason'] or line['status'])}</p>" for line in lines if line["status"] != "done"]
    parts.append(picture_html(folder / "compare.png", "Runs side by side at the same times, on one scale"))
    if done:
        columns = [c for c in results_of(done, axes) if c.rsplit(".", 1)[1] in MAIN]
        words = [c for c in done[0] if c.endswith(".class")]
        parts.append("<h2>What came out</h2>" + table_of(lines, [*axes, "status", *words, *columns]))
        parts.append(plots_html(figures(done, axes, graph)))
    parts.append("<h2>What was asked</h2>" + table([("case", text(plan["case"]))] + [(key, text(value)) for key, value in common(plan).items()]))
    about = [(name, text(", ".join(dict.fromkeys(filter(None, (line.get(name) for line in done)))))) for name in ("version", "commit", "backend", "precision")]
    time = sum(value for line in done if isinstance(value := value_of(line.get("wall_time")), float))
    parts.append("<h2>Where it comes from</h2>" + table([*about, ("wall time of all [s]", f"{time:.0f}")]))
    rest = [c for c in lines[0] if c not in BOOKKEEPING]
    parts.append(f"<details class='live'><summary>All results, as in results.csv</summary>{table_of(lines, ['point', 'status', *rest])}</details>")
    return whole(folder.name, parts)


def main():
    """Called by scripts/report with the Python that has the tools."""
    parser = argparse.ArgumentParser(prog="plotting.sweep_report", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    arguments = parser.parse_args()
    try:
        arguments.output.write_text(page(arguments.folder), encoding="utf-8")
    except (ReportError, OSError) as error:
        print(error)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
