"""A page of a run to share: one HTML file with what was asked, what came out, the flow in three dimensions, and numbers that tell how far to trust it.

plotly draws the measures, k3d the surface over time; both are inside of the file."""

import argparse
import html
import sys
from pathlib import Path

import numpy as np

import slagflow
from plotting import history, sheet, surface
from plotting.page import MOST_PAGE, ReportError, figure_html, movie_html, number, picture_html, plots_html, table, text, tools, whole
from plotting.quantity import QUANTITIES
from plotting.scene import scene


def shapes_in_words(part):
    words = []
    for shape in part.get("shapes", []):
        words.append(Path(shape["file"]).name if shape.get("shape") == "stl" else str(shape.get("shape")))
    return ", ".join(f"{words.count(w)} x {w}" if words.count(w) > 1 else w for w in dict.fromkeys(words))


def celsius(kelvin):
    return f"{kelvin - 273.15:.4g} °C"


def heat_of_wall(wall):
    kind = wall.get("thermal", "adiabatic")
    if kind in ("temperature", "semi_infinite"):
        return f"{'held at' if kind == 'temperature' else 'thick, at first at'} {celsius(wall['temperature'])}"
    return f"gives {wall['heat_flux']:.4g} W/m²" if kind == "flux" else ""


def heat_asked(case):
    """Rows of what a case says of heat; none without [thermal]."""
    if "thermal" not in case:
        return []
    thermal = case["thermal"]
    starts = sorted({r["temperature"] for r in [*case.get("region", []), *case.get("inlet", [])] if "temperature" in r})
    rows = [("heat", text(f"fluid starts or comes in at {' and '.join(map(celsius, starts))}; surroundings at "
                          f"{celsius(thermal['ambient_temperature'])}, {thermal['surface_heat_transfer']:.4g} W/m²K"))]
    for name, fluid in case.get("fluid", {}).items():
        solids = fluid.get("solid_fraction") or []
        freezes = f"freezes from {celsius(solids[-1][0])} to {celsius(solids[0][0])}, {fluid.get('latent_heat', 0):.4g} J/kg" if solids else ""
        shines = f"emissivity {fluid['emissivity']:.3g}" if fluid.get("emissivity") and thermal.get("radiation", True) else ""
        rows.append((f"heat of {name}", text("; ".join(w for w in (freezes, shines) if w))))
    return rows


def heat_trusted(summary):
    heat = summary.get("heat")
    if not heat:
        return ""
    walls = sum(heat["to_walls"].values())
    return f"{heat['by_surface']:.4g} J lost by surfaces, {walls:.4g} J to walls; the balance is off by {heat['error']:.2g} J"


def asked(run):
    """Rows of what the case says."""
    case = run.case
    rows = [(f"fluid {name}", text(words)) for name, words in run.fluids_in_words().items()]
    for wall in case.get("wall", []):
        motion = wall.get("motion", {}).get("type", "rest")
        words = [shapes_in_words(wall), "" if motion == "rest" else f"moves: {motion}", "" if wall.get("slip", "no_slip") == "no_slip" else wall["slip"]]
        rows.append((f"wall {wall.get('name', '')}", text("; ".join(w for w in [*words, heat_of_wall(wall)] if w))))
    for inlet in case.get("inlet", []):
        flow = next((f"{key} {inlet[key]}" for key in ("volume_flow", "mass_flow", "velocity") if key in inlet), "")
        rows.append((f"inlet {inlet.get('name', '')}", text(f"{inlet.get('face', '')}, {flow} in SI units")))
    rows += [(f"outlet {outlet.get('name', '')}", text(outlet.get("shape", ""))) for outlet in case.get("outlet", [])]
    rows += heat_asked(case)
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
            ("energy at the end", f"{s['kinetic_energy']:.3g} J kinetic, {s['potential_energy']:.3g} J potential, {s['dissipated_energy']:.3g} J dissipated so far"
             if {"kinetic_energy", "potential_energy", "dissipated_energy"} <= s.keys() else ""),
            ("heat", heat_trusted(s)),
            ("largest compression", f"{100 * s['max_compression']:.3g} % at {s.get('max_compression_time', 0):.4g} s" if "max_compression" in s else ""),
            ("deepest in a wall", f"{walls['deepest_spacings']:.2g} spacings" if "deepest_spacings" in walls else ""),
            ("in thin sheets", f"{s['in_thin_sheets']['most']} particles at most" if "in_thin_sheets" in s else ""),
            ("viscous solver", text(f"{solver.get('solver')}, {number(solver.get('iterations_mean', 0.0), 3)} iterations a step") if solver else ""),
            ("verification", verification())]
    return rows


def verification():
    """How the source that these scripts are of stands against closed forms and experiments, by its page."""
    page = Path(__file__).resolve().parents[2] / "tests" / "verification" / "README.md"
    try:
        made = page.read_text(encoding="utf-8").split("<!-- table of scripts/verify -->", 1)[1].split("<!-- end of table -->", 1)[0]
    except (OSError, IndexError):
        return "against closed forms and experiments: tests/verification/README.md beside the source"
    ends = [line.rstrip().rstrip("|").rsplit("|", 1)[-1].strip() for line in made.splitlines()]
    passed, missed = ends.count("pass"), ends.count("**missed**")
    return (f"of {passed + missed} comparisons with closed forms and experiments {passed} reach their target, "
            f"{missed} miss it, with their causes: tests/verification/README.md beside the source")


def provenance(run):
    s = run.summary
    names = (("version", "version"), ("commit", "commit"), ("compiler", "compiler"), ("backend", "backend"), ("device", "device"), ("threads", "threads"),
             ("started", "started_utc"), ("ended", "ended_utc"), ("wall time [s]", "wall_time"), ("from", "from"))
    return [(name, text(number(s[key]) if isinstance(s[key], float) else s[key])) for name, key in names if s.get(key) not in (None, "")]


def plots(run, graph):
    """The measures and the balances over time, then the flow curves."""
    parts = []
    try:
        columns = run.columns()
    except slagflow.RunError:
        columns = {}
    time = columns.pop("time_s", None)
    for title, chosen, unit, size in history.panels_of(columns, time) if time is not None else []:
        traces = [(label, time, values / size) for label, values in history.labelled(chosen).items()]
        parts.append(figure_html(graph, traces, ("time  [s]", unit, title), not parts))
    rate = np.geomspace(0.01, 100, 60)
    curves = [(name, rate, tau) for name, fluid in run.case.get("fluid", {}).items() if (tau := stress(fluid, rate)) is not None]
    if curves:
        parts.append(figure_html(graph, curves, ("shear rate  [1/s]", "shear stress  [Pa]", "Flow curves of the case"), not parts))
    return plots_html(parts)


def page(run, colour):
    """The whole file as text."""
    k3d, graph = tools()
    view, times, label = scene(run, colour, k3d)
    told, warnings = run.told()
    status = "" if run.summary.get("status") in (None, "done") else f" ({run.summary['status']})"
    parts = [f"<h1>{text(run.title.replace('_', ' '))}</h1><p class='lead'>{text(run.case.get('case', {}).get('description', ''))}{text(status)}</p>"]
    parts += [f"<p class='warning'>{text(line)}</p>" for line in warnings]
    picture = run.path / "pictures/surface.png"
    if not picture.exists():
        picture.parent.mkdir(exist_ok=True)
        sheet.draw([run], None, colour, picture)
    parts.append(picture_html(picture, "The free surface at some times"))
    parts.append(f"<section class='live'><h2>In three dimensions</h2><p class='lead'>Turn it with the mouse; <em>Controls</em>, <em>Play loop</em> in its corner plays its "
                 f"{times} times. Colours: {text(' '.join(label.split()))}.</p><iframe title='The flow in three dimensions' loading='eager' srcdoc=\"{html.escape(view)}\"></iframe></section>")
    place = len(parts)  # of the movie, which takes what room is left
    if told:
        parts.append("<h2>What came out</h2><ul>" + "".join(f"<li>{text(line)}</li>" for line in told) + "</ul>")
    parts.append(plots(run, graph))
    parts.append("<h2>What was asked</h2>" + table(asked(run)))
    parts.append("<h2>How far to trust it</h2>" + table(trust(run)))
    parts.append("<h2>Where it comes from</h2>" + table(provenance(run)))
    case = text((run.path / "case.toml").read_text(encoding="utf-8-sig"))
    parts.append(f"<details class='live'><summary>The case, every key with its value</summary><pre>{case}</pre></details>")
    parts.insert(place, movie_html(run.path / "pictures/movie.mp4", MOST_PAGE - sum(map(len, parts))))
    return whole(run.title, parts)


def main():
    """Called by scripts/report with the Python that has the tools."""
    parser = argparse.ArgumentParser(prog="plotting.report", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--colour", choices=QUANTITIES, default="speed")
    arguments = parser.parse_args()
    try:
        surface.tools(), tools()
        arguments.output.write_text(page(slagflow.open(arguments.folder), arguments.colour), encoding="utf-8")
    except (ReportError, surface.SurfaceError, slagflow.RunError, OSError) as error:
        print(error)
        return 1
    except KeyError as error:
        print(f"the run has not written what {arguments.colour!r} needs: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
