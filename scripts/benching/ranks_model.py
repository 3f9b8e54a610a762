"""What several GPUs would need for a step, from counted traffic: messages, bytes and sums of a run on two ranks, and the model of
one GPU. All of it is a model that a first run on a cluster can refute: its figures stand in summary.json, as `ranks`."""

import json
import subprocess
import tempfile
from pathlib import Path

from benching import device_model

TOP = Path(__file__).resolve().parent.parent.parent
COUNTS = TOP / "tests" / "rank_counts.json"
CASE, END = "dam_discharge_2mm.toml", 0.05
GPU = "H100"

# Assumed, without a source: what an exchange and a sum over all ranks take beside their bytes [s].
EXCHANGE, SUM, SUM_BY_DOUBLING = 20e-6, 15e-6, 3e-6
LINKS = (("NVLink 200 GB/s", 200e9), ("40 GB/s a GPU", 40e9), ("12 GB/s a GPU", 12e9))
HALO_PLANES, SPACINGS_OF_PLANE = 2, 3  # planes of cells about three particles wide


def count(program):
    """Runs the case on two ranks and keeps what they told each other."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "run"
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "2", program, "run", TOP / "cases" / CASE, "-o",
                   target, "--quiet", "--set", f"output.end_time={END}"]
        subprocess.run([str(word) for word in command], check=True, capture_output=True)
        summary = json.loads((target / "summary.json").read_text())
    ranks = summary["ranks"]
    record = {"case": CASE, "end_time_s": END, "steps": summary["steps"], "particles": summary["particles"],
              "exchanges_per_step": ranks["exchanges_per_step"], "reductions_per_step": ranks["reductions_per_step"],
              "bytes_per_copy_and_step": ranks["bytes_per_step"] / ranks["copies"]}
    COUNTS.write_text(json.dumps(record, indent=1) + "\n")
    return record


def step_time(particles, length, ranks, bandwidth, counts, device):
    """[s] of a step on so many GPUs, of fluid `length` particles long along the slabs; and the efficiency."""
    alone = device_model.step_time(GPU, particles, device)
    planes = length / SPACINGS_OF_PLANE
    own = -(-planes // ranks) / planes  # whole planes
    copies = 2 * HALO_PLANES / planes * particles
    moved = copies * counts["bytes_per_copy_and_step"] / bandwidth
    doublings = max(ranks - 1, 0).bit_length()
    waits = counts["exchanges_per_step"] * EXCHANGE + counts["reductions_per_step"] * (SUM + SUM_BY_DOUBLING * doublings)
    together = alone * own + (moved + waits if ranks > 1 else 0)
    return together, alone / (ranks * together)


def print_table():
    counts, device = json.loads(COUNTS.read_text()), device_model.read_counts()
    print(f"Model, {GPU}: {counts['exchanges_per_step']:.1f} exchanges and {counts['reductions_per_step']:.1f} sums a step, "
          f"{counts['bytes_per_copy_and_step']:.0f} B a copy and step")
    print(f"{'particles':>10} {'link':<17} {'8 GPUs':>18} {'64 GPUs':>18}")
    for particles, length in ((1e7, 464), (1e8, 1000)):
        for name, bandwidth in LINKS:
            cells = [step_time(particles, length, ranks, bandwidth, counts, device) for ranks in (8, 64)]
            print(f"{particles:>10.0e} {name:<17} " + " ".join(f"{1e3 * t:>8.1f} ms, {e:>4.0%}" for t, e in cells))
