#!/usr/bin/python3
"""Breaks a run with two threads and an exact yield stress at random times, resumes it while other processes take
the machine's time, and compares bits with a run that was not broken:
    tests/resume_under_load.py PROGRAM [--times 100] [--load 2] [--waiting active]
Prints how many resumes gave other bits; exit status 1 unless it is none."""

import argparse
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
except ImportError:
    sys.exit(77)

CASE = """
[case]
name = "load"
[resolution]
spacing = 1e-3
[fluid.slag]
density = 2600
rheology = "bingham"
plastic_viscosity = 1.5
yield_stress = 12
[[region]]
shapes = [{shape="box", min=[0, 0, 0], max=[0.012, 0.008, 0.011]}]
[[wall]]
name = "tank"
shapes = [{shape="box", min=[0, -1, 0], max=[0.03, 1, 1], outside=true}]
motion = {type="sine", angular_amplitude=[0, 0.05, 0], frequency=5, center=[0.015, 0, 0]}
[domain]
min = [-0.006, 0, -0.006]
max = [0.036, 0.008, 0.02]
periodic = ["y"]
[numerics]
yield = "exact"
[limits]
max_energy_growth = 10
[output]
end_time = 0.006
interval = 1e-3
history_interval = 5e-4
"""
END = 0.006  # s


def bits(folder):
    """The history and all data sets of the snapshots."""
    content = {"history.csv": (folder / "history.csv").read_bytes()}
    with h5py.File(folder / "particles.vtkhdf") as file:
        file.visititems(lambda name, item: content.update({name: item[()].tobytes()})
                        if isinstance(item, h5py.Dataset) else None)
    return content


def differences(arguments, top):
    (top / "load.toml").write_text(CASE)
    environment = dict(os.environ, OMP_WAIT_POLICY=arguments.waiting)

    def call(*words):
        subprocess.run([arguments.program, *words, "--threads", "2", "--quiet"], check=True, env=environment,
                       stdout=subprocess.DEVNULL)

    call("run", top / "load.toml", "-o", top / "whole")
    whole, shares, different = bits(top / "whole"), random.Random(1), 0
    for number in range(arguments.times):
        until = shares.uniform(0.05, 0.9) * END
        call("run", top / "load.toml", "-o", top / "broken", "--overwrite", "--until", str(until))
        call("resume", top / "broken", "--until", str(END))
        if bits(top / "broken") != whole:
            different += 1
            print(f"resume {number + 1}, broken at {until:.6g} s, gave other bits", flush=True)
    return different


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--times", type=int, default=100, help="resumes")
    parser.add_argument("--load", type=int, default=2, help="processes that take the machine's time")
    parser.add_argument("--waiting", choices=["active", "passive"], default="passive", help="how threads wait")
    arguments = parser.parse_args()
    load = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(arguments.load)]
    try:
        with tempfile.TemporaryDirectory() as top:
            different = differences(arguments, Path(top))
    finally:
        for process in load:
            process.kill()
    print(f"{different} of {arguments.times} resumes gave other bits")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
