"""Parts of pages to share: one HTML file each, with all that it needs inside of it."""

import base64
import html

STYLE = """
:root { --ink: #22262b; --soft: #5f6873; --line: #e3e6ea; --accent: #2f6690; }
* { box-sizing: border-box; } body { margin: 0; color: var(--ink); background: #fff; font: 16px/1.55 system-ui, sans-serif; }
main { max-width: 1100px; margin: 0 auto; padding: 24px 18px 60px; } h1 { margin: 0; font-size: 1.9rem; } h2 { margin: 2.2rem 0 .6rem; font-size: 1.25rem; }
.lead { color: var(--soft); margin: .2rem 0 1rem; } table { border-collapse: collapse; width: 100%; font-size: .94rem; }
td, th { text-align: left; padding: .35rem .6rem .35rem 0; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
th { width: 13rem; color: var(--soft); font-weight: 500; } img { max-width: 100%; height: auto; } iframe { width: 100%; height: 560px; border: 1px solid var(--line); }
.warning { border-left: 4px solid #c8553d; padding: .3rem .8rem; background: #fdf3f0; margin: .5rem 0; } pre { overflow-x: auto; background: #f6f7f9; padding: .8rem; font-size: .85rem; }
.plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 10px; } .plots > div { min-width: 0; }
video { width: 100%; max-height: 720px; background: #fff; } .scroll { overflow-x: auto; } .wide th { width: auto; } .wide td, .wide th { white-space: nowrap; padding-right: 1rem; }
ul { padding-left: 1.2rem; } @media (max-width: 800px) { .plots { grid-template-columns: minmax(0, 1fr); } } @media (max-width: 560px) { th { width: 7.5rem; } iframe { height: 380px; } }
@media print { .live { display: none; } main { max-width: none; padding: 0; } h2 { break-after: avoid; } .plots > div, img, tr { break-inside: avoid; } }
"""
MOST_PAGE = 25e6  # bytes; a movie that would make it larger is left out


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



def figure_html(graph, traces, labels, first, mode="lines"):
    """A plot that answers to the mouse. `traces`: name, x, y of each; `labels`: of the axes, and the title; `first`: it brings plotly along."""
    layout = {"template": "plotly_white", "height": 330, "margin": {"l": 60, "r": 15, "t": 30, "b": 45}, "xaxis_title": labels[0], "yaxis_title": labels[1],
              "title": {"text": labels[2], "font": {"size": 14}}, "legend": {"orientation": "h", "y": -0.25}}
    figure = graph.Figure([graph.Scatter(x=x, y=y, name=name, mode=mode) for name, x, y in traces], layout)
    return figure.to_html(full_html=False, include_plotlyjs="inline" if first else False, config={"responsive": True, "displayModeBar": False})


def plots_html(figures):
    return "<div class='plots'>" + "".join(f"<div>{figure}</div>" for figure in figures) + "</div>"


def picture_html(path, words):
    """A PNG file inside of the page; nothing when it is not there."""
    if not path.is_file():
        return ""
    return f"<img alt='{text(words)}' src='data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}'>"


def movie_html(path, room):
    """An MP4 file inside of the page when there is one and `room` bytes hold it."""
    if not path.is_file():
        return ""
    if path.stat().st_size * 4 / 3 > room:
        return f"<p class='lead'>{text(path.name)}, {path.stat().st_size / 1e6:.0f} MB, is too large for this page.</p>"
    return ("<video class='live' controls loop muted playsinline preload='auto' "
            f"src='data:video/mp4;base64,{base64.b64encode(path.read_bytes()).decode()}'></video>")


def whole(title, parts):
    """The file as text."""
    return (f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' content='width=device-width, initial-scale=1'>"
            f"<link rel='icon' href='data:,'><title>{text(title)}</title><style>{STYLE}</style></head><body><main>{''.join(parts)}</main></body></html>")
