"""A page of a run to share: one HTML file with what was asked, what came out, the flow in three dimensions, and numbers that tell how far to trust it.

plotly draws the measures, k3d the surface over time; both are inside of the file."""

import argparse
import base64
import html
import re
import sys
from pathlib import Path

import numpy as np

from plotting import history, surface
from plotting.quantity import QUANTITIES, Quantity
import slagflow

MOST_BYTES = 12e6  # of the meshes over time, before they are packed
MOST_TIMES = 24
COARSE = 1.0  # cubes of the meshes in particle radii
STYLE = """
:root { --ink: #22262b; --soft: #5f6873; --line: #e3e6ea; --accent: #2f6690; }
* { box-sizing: border-box; } body { margin: 0; color: var(--ink); background: #fff; font: 16px/1.55 system-ui, sans-serif; }
main { max-width: 1100px; margin: 0 auto; padding: 24px 18px 60px; } h1 { margin: 0; font-size: 1.9rem; } h2 { margin: 2.2rem 0 .6rem; font-size: 1.25rem; }
.lead { color: var(--soft); margin: .2rem 0 1rem; } table { border-collapse: collapse; width: 100%; font-size: .94rem; }
td, th { text-align: left; padding: .35rem .6rem .35rem 0; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
th { width: 13rem; color: var(--soft); font-weight: 500; } img { max-width: 100%; height: auto; } iframe { width: 100%; height: 560px; border: 1px solid var(--line); }
.warning { border-left: 4px solid #c8553d; padding: .3rem .8rem; background: #fdf3f0; margin: .5rem 0; } pre { overflow-x: auto; background: #f6f7f9; padding: .8rem; font-size: .85rem; }
.plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; } .plots > div { min-width: 0; }
ul { padding-left: 1.2rem; } @media (max-width: 800px) { .plots { grid-template-columns: minmax(0, 1fr); } } @media (max-width: 560px) { th { width: 7.5rem; } iframe { height: 380px; } }
"""


class ReportError(Exception):
    """The page cannot be made; the message says why."""


def tools():
    """k3d and plotly. Raises ReportError when one is missing."""
    try:
        import k3d
        import plotly.graph_objects as graph
    except ImportError as missing:
        raise ReportError(f"{missing}: `scripts/install --pictures` brings what makes reports") from missing
    return k3d, graph


def text(value):
    return html.escape(str(value))


def table(rows):
    return "<table>" + "".join(f"<tr><th>{text(name)}</th><td>{value}</td></tr>" for name, value in rows if value) + "</table>"


def number(value, digits=4):
    return f"{value:.{digits}g}" if isinstance(value, float) else f"{value:,}".replace(",", "\u202f")


def shapes_in_words(part):
    words = []
    for shape in part.get("shapes", []):
        words.append(Path(shape["file"]).name if shape.get("shape") == "stl" else str(shape.get("shape")))
    return ", ".join(f"{words.count(w)} x {w}" if words.count(w) > 1 else w for w in dict.fromkeys(words))


def asked(run):
    """Rows of what the case says."""
    case = run.case
    rows = [(f"fluid {name}", text(words)) for name, words in run.fluids_in_words().items()]
    for wall in case.get("wall", []):
        motion = wall.get("motion", {}).get("type", "rest")
        words = [shapes_in_words(wall), "" if motion == "rest" else f"moves: {motion}", "" if wall.get("slip", "no_slip") == "no_slip" else wall["slip"]]
        rows.append((f"wall {wall.get('name', '')}", text("; ".join(w for w in words if w))))
    for inlet in case.get("inlet", []):
        flow = next((f"{key} {inlet[key]}" for key in ("volume_flow", "mass_flow", "velocity") if key in inlet), "")
        rows.append((f"inlet {inlet.get('name', '')}", text(f"{inlet.get('face', '')}, {flow} in SI units")))
    rows += [(f"outlet {outlet.get('name', '')}", text(outlet.get("shape", ""))) for outlet in case.get("outlet", [])]
    domain = case.get("domain", {})
    gravity = case.get("gravity", {}).get("acceleration")
    rows.append(("domain", text(f"{domain.get('min')} to {domain.get('max')} m, {run.dimensions} dimensions")))
    rows.append(("gravity", text(f"{gravity} m/s²") if gravity else ""))
    rows.append(("end", text(f"{case.get('output', {}).get('end_time')} s")))
    return rows


def stress(fluid, rate):
    """Shear stress [Pa] of the rheologies that have a plain flow curve, or None."""
    law = fluid.get("rheology")
    yielding = fluid.get("yield_stress", 0.0)
    if not isinstance(yielding, (int, float)):
        return None
    if law == "newtonian" and "dynamic_viscosity" in fluid:
        return fluid["dynamic_viscosity"] * rate
    if law == "bingham" and "plastic_viscosity" in fluid:
        return yielding + fluid["plastic_viscosity"] * rate
    if law == "herschel-bulkley" and {"consistency", "flow_index"} <= fluid.keys():
        return yielding + fluid["consistency"] * rate ** fluid["flow_index"]
    return None


def trust(run):
    s = run.summary
    counts, solver, walls = s.get("particles", {}), s.get("viscous", {}), s.get("in_walls", {})
    rows = [("spacing", f"{1000 * run.spacing:.4g} mm"), ("particles", number(counts["fluid"]) + " of fluid" if counts.get("fluid") else ""),
            ("steps", number(s["steps"]) if "steps" in s else ""),
            ("mass", f"{s['mass_start']:.6g} kg at the start, {s['mass_in']:.6g} kg in the domain at the end, {s['mass_left']:.6g} kg left"
             if {"mass_start", "mass_in", "mass_left"} <= s.keys() else ""),
            ("largest compression", f"{100 * s['max_compression']:.3g} % at {s.get('max_compression_time', 0):.4g} s" if "max_compression" in s else ""),
            ("deepest in a wall", f"{walls['deepest_spacings']:.2g} spacings" if "deepest_spacings" in walls else ""),
            ("in thin sheets", f"{s['in_thin_sheets']['most']} particles at most" if "in_thin_sheets" in s else ""),
            ("viscous solver", text(f"{solver.get('solver')}, {number(solver.get('iterations_mean', 0.0), 3)} iterations a step") if solver else "")]
    return rows


def provenance(run):
    s = run.summary
    names = (("version", "version"), ("commit", "commit"), ("compiler", "compiler"), ("backend", "backend"), ("device", "device"), ("threads", "threads"),
             ("started", "started_utc"), ("ended", "ended_utc"), ("wall time [s]", "wall_time"), ("from", "from"))
    return [(name, text(number(s[key]) if isinstance(s[key], float) else s[key])) for name, key in names if s.get(key) not in (None, "")]


def figure_html(graph, traces, labels, first):
    layout = {"template": "plotly_white", "height": 330, "margin": {"l": 60, "r": 15, "t": 30, "b": 45}, "xaxis_title": labels[0], "yaxis_title": labels[1],
              "title": {"text": labels[2], "font": {"size": 14}}, "legend": {"orientation": "h", "y": -0.25}}
    figure = graph.Figure([graph.Scatter(x=x, y=y, name=name, mode="lines") for name, x, y in traces], layout)
    return figure.to_html(full_html=False, include_plotlyjs="inline" if first else False, config={"responsive": True, "displaylogo": False})


def plots(run, graph):
    """The measures and the balances over time, then the flow curves."""
    parts = []
    try:
        columns = run.columns()
    except slagflow.RunError:
        columns = {}
    time = columns.pop("time_s", None)
    for title, chosen, unit, size in history.panels_of(columns) if time is not None else []:
        if title == "Viscous solver":
            continue
        traces = [(label, time, values / size) for label, values in history.labelled(chosen).items()]
        parts.append(figure_html(graph, traces, ("time  [s]", unit, title), not parts))
    rate = np.geomspace(0.01, 100, 60)
    curves = [(name, rate, tau) for name, fluid in run.case.get("fluid", {}).items() if (tau := stress(fluid, rate)) is not None]
    if curves:
        parts.append(figure_html(graph, curves, ("shear rate  [1/s]", "shear stress  [Pa]", "Flow curves of the case"), not parts))
    return "<div class='plots'>" + "".join(f"<div>{part}</div>" for part in parts) + "</div>"


def arrays(mesh):
    return np.asarray(mesh.points, np.float32), np.asarray(mesh.faces.reshape(-1, 4)[:, 1:], np.uint32)


def scene(run, colour, k3d):
    """The view that turns and plays: an HTML page of its own, and its times."""
    last = len(run.fluid.times) - 1
    steps = sorted(set(np.linspace(0, last, min(MOST_TIMES, last + 1)).round().astype(int).tolist()))
    quantity = Quantity(run, steps, colour)
    quantity.share(quantity.limits)
    meshes, box = surface.Meshes(run, quantity, COARSE), surface.box_of([run], [steps])
    fluid, walls, size = {}, {}, 0
    while steps:
        full = next((s for s in steps if run.fluid.count(s) == max(run.fluid.count(k) for k in steps)))
        probe = meshes.fluid(full)
        size = 0 if probe is None else sum(a.nbytes for a in arrays(probe))
        if size * len(steps) <= MOST_BYTES or len(steps) <= 4:
            break
        steps = sorted(set(np.linspace(0, last, max(4, int(MOST_BYTES / size))).round().astype(int).tolist()))
        quantity = Quantity(run, steps, colour)
        quantity.share(quantity.limits)
        meshes.quantity = quantity
    for step in steps:
        name = f"{run.fluid.times[step]:.5g}"
        if (mesh := meshes.fluid(step)) is not None:
            fluid[name] = (*arrays(mesh), np.asarray(mesh["value"], np.float32))
        if (mesh := meshes.walls(step, box)) is not None:
            walls[name] = mesh
    return compose(k3d, fluid, walls, quantity, run, box), len(steps)


def compose(k3d, fluid, walls, quantity, run, box):
    plot = k3d.plot(background_color=0xFFFFFF, grid_visible=False, fps=8, camera_auto_fit=False, camera_fov=30, colorbar_object_id=0 if quantity.few else -1)
    parts = np.linspace(0, 1, 32)
    colours = np.array([[x, *quantity.map(x)[:3]] for x in parts], np.float32).ravel()
    if fluid:
        plot += k3d.mesh({t: f[0] for t, f in fluid.items()}, {t: f[1] for t, f in fluid.items()}, attribute={t: f[2] for t, f in fluid.items()},
                         color_map=colours, color_range=[float(x) for x in quantity.limits], flat_shading=False, name=quantity.label)
    if walls:
        still = len({id(mesh) for mesh in walls.values()}) == 1
        made = {t: arrays(mesh) for t, mesh in walls.items()}
        first = next(iter(made.values()))
        plot += k3d.mesh(first[0] if still else {t: w[0] for t, w in made.items()}, first[1] if still else {t: w[1] for t, w in made.items()},
                         color=0xB9BFC6, opacity=0.3, flat_shading=False, name="walls")
    middle, size = (box[0] + box[1]) / 2, float(np.linalg.norm(box[1] - box[0]))
    plot.time = float(list(fluid or walls or {"0": None})[len(fluid or walls) // 3])
    away = middle + (2.2 if run.dimensions == 2 else 1.5) * size * surface.direction(run.dimensions == 2)
    plot.camera = [*map(float, away), *map(float, middle), 0.0, 0.0, 1.0]
    plot.snapshot_type = "full"
    return plot.get_snapshot(9)


def page(run, colour, picture):
    """The whole file as text."""
    k3d, graph = tools()
    view, times = scene(run, colour, k3d)
    told, warnings = run.told()
    summary = run.summary
    status = "" if summary.get("status") in (None, "done") else f" ({summary['status']})"
    image = base64.b64encode(picture.read_bytes()).decode() if picture else ""
    parts = [f"<h1>{text(run.title.replace('_', ' '))}</h1><p class='lead'>{text(run.case.get('case', {}).get('description', ''))}{text(status)}</p>"]
    parts += [f"<p class='warning'>{text(line)}</p>" for line in warnings]
    if image:
        parts.append(f"<img alt='The free surface at some times' src='data:image/png;base64,{image}'>")
    parts.append(f"<h2>In three dimensions</h2><p class='lead'>Turn it with the mouse; <em>Controls</em>, <em>Play loop</em> in its corner plays its {times} times.</p>"
                 f"<iframe title='The flow in three dimensions' loading='eager' srcdoc=\"{html.escape(view)}\"></iframe>")
    if told:
        parts.append("<h2>What came out</h2><ul>" + "".join(f"<li>{text(line)}</li>" for line in told) + "</ul>")
    parts.append(plots(run, graph))
    parts.append("<h2>What was asked</h2>" + table(asked(run)))
    parts.append("<h2>How far to trust it</h2>" + table(trust(run)))
    parts.append("<h2>Where it comes from</h2>" + table(provenance(run)))
    parts.append(f"<details><summary>The case, every key with its value</summary><pre>{text((run.path / 'case.toml').read_text(encoding='utf-8-sig'))}</pre></details>")
    return (f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' content='width=device-width, initial-scale=1'>"
            f"<title>{text(run.title)}</title><style>{STYLE}</style></head><body><main>{''.join(parts)}</main></body></html>")


def main():
    """Called by scripts/report with the Python that has the tools."""
    parser = argparse.ArgumentParser(prog="plotting.report", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--colour", choices=QUANTITIES, default="speed")
    arguments = parser.parse_args()
    try:
        surface.tools(), tools()
        run = slagflow.open(arguments.folder)
        picture = arguments.folder / "pictures/surface.png"
        arguments.output.write_text(page(run, arguments.colour, picture if picture.is_file() else None), encoding="utf-8")
    except (ReportError, surface.SurfaceError, slagflow.RunError, OSError) as error:
        print(error)
        return 1
    except KeyError as error:
        print(f"the run has not written what {arguments.colour!r} needs: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
