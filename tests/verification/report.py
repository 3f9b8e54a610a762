"""The table and the pictures."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

COLUMNS = (("flow", 22), ("resolution", 22), ("quantity", 42), ("computed", 11), ("closed form", 11), ("error", 9),
           ("target", 12), ("", 4))
PAGE = Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- table of scripts/verify -->", "<!-- end of table -->"


def cells(name, row):
    verdict = {True: "pass", False: "MISS", None: ""}[row.passed]
    return (name, row.resolution, row.quantity, row.measured, row.expected, row.error, row.target, verdict)


def heading():
    return "  ".join(title.ljust(width) for title, width in COLUMNS).rstrip()


def lines(outcome):
    return "\n".join("  ".join(cell.ljust(width) for cell, (_, width) in zip(cells(outcome.name, row), COLUMNS)).rstrip()
                     for row in outcome.rows)


def causes(outcomes):
    """One line for each known cause of a miss."""
    text = []
    for outcome in outcomes:
        found = dict.fromkeys(outcome.causes[row.key] for row in outcome.missed() if row.key in outcome.causes)
        text += [f"MISS {outcome.name}: {cause}" for cause in found]
    return "\n".join(text)


def draw_one(comparison, results, path):
    figure, axes = plt.subplots(figsize=(5, 4), layout="constrained")
    comparison.draw(axes, results)
    axes.set_title(comparison.TITLE, fontsize=10)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def draw_all(comparisons, outcomes, path):
    """One small picture with a panel a flow."""
    columns = 4
    rows = -(-len(comparisons) // columns)
    with plt.rc_context({"font.size": 6.5, "axes.linewidth": 0.5, "lines.linewidth": 0.9, "lines.markersize": 2}):
        figure, panels = plt.subplots(rows, columns, figsize=(9.6, 2.2 * rows), layout="constrained", squeeze=False)
        for axes in panels.flat[len(comparisons):]:
            axes.set_visible(False)
        for axes, comparison, outcome in zip(panels.flat, comparisons, outcomes):
            comparison.draw(axes, outcome.results)
            axes.set_title(comparison.TITLE, fontsize=7.5)
        figure.savefig(path, dpi=110, pil_kwargs={"optimize": True})
        plt.close(figure)


def write_readme(outcomes, path):
    """Replaces what stands between the two marks."""
    text = path.read_text()
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    path.write_text(f"{head}{BEGIN}\n{markdown(outcomes)}\n{END}{tail}")


def markdown(outcomes):
    text = ["| flow | resolution | quantity | computed | closed form | error | target | |",
            "|---|---|---|---|---|---|---|---|"]
    for outcome in outcomes:
        for k, row in enumerate(outcome.rows):
            name, *others, verdict = cells(outcome.name if k == 0 else "", row)
            if verdict == "MISS":
                verdict = "**missed**"
            text.append("| " + " | ".join([f"`{name}`" if name else "", *others, verdict]) + " |")
    missed = causes(outcomes).replace("MISS ", "- ")
    return "\n".join(text) + (f"\n\nMissed, and why:\n\n{missed}" if missed else "")
