"""slagflow from Python: runs cases and opens what runs leave, all in SI units.

    import slagflow
    run = slagflow.run("cases/dam_discharge_quick.toml", set={"fluid.slurry.yield_stress": 20})
    run = slagflow.open("runs/dam_discharge_quick")
    run.times, run.snapshots[-1]["Velocity"], run.history, run.measures, run.units
"""

from .errors import ProgramError, RunError, SlagflowError
from .program import find_program, run
from .run_folder import Run, open_run as open
from .snapshots import Snapshot, Snapshots

__version__ = "0.1.0"
__all__ = ["ProgramError", "Run", "RunError", "SlagflowError", "Snapshot", "Snapshots", "find_program", "open", "run"]
