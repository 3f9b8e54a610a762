"""Runs of the program against closed forms: one module a flow.

A module has NAME, TITLE, runs(quick), rows(results), draw(axes, results) and, where a target is missed, MISSES: the
causes, by Row.key."""

import importlib

FLOWS = ("poiseuille", "couette", "bingham_poiseuille", "creep", "film", "pipe", "cylinders", "shear_wave",
         "as_printed", "taylor_green", "rigid_rotation", "hydrostatic", "slump", "vertical_face", "gravity_current",
         "drops", "meniscus", "layers", "impact", "turning", "two_fluids", "start", "slopes", "waves", "sheet", "sheared_box",
         "splash", "slip_film", "openings", "heat", "lava")


def comparisons():
    """The modules of all flows, in the order of the table."""
    return [importlib.import_module(f"verification.{name}") for name in FLOWS]
