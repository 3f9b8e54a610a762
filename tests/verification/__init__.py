"""Runs of the program against closed forms: one module a flow.

A module has NAME, TITLE, runs(quick), rows(results) and draw(axes, results); see suite.py."""

import importlib

FLOWS = ("poiseuille", "bingham_poiseuille", "creep", "film", "pipe", "shear_wave", "as_printed", "taylor_green",
         "rigid_rotation", "hydrostatic", "slump", "vertical_face", "gravity_current")


def comparisons():
    """The modules of all flows, in the order of the table."""
    return [importlib.import_module(f"verification.{name}") for name in FLOWS]
