"""A model of a step on a GPU, from counts: what the kernels of a step load, store and execute, and what GPUs are published
to give. It has never been compared with a GPU; scripts/bench --device prints measured beside predicted.

A kernel takes as long as the slowest of four things, but no less than one after another takes to begin: bytes from
memory (all that is read one after another, and each gathered array once), sectors through the first cache, warp
instructions (of PTX, not of machine code), and double precision. A step is the sum over its launches, and for each wait
of the host the time until the device has work again."""

import json
import re
import subprocess
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent.parent
COUNTS = TOP / "tests" / "device_counts.json"
RUNTIME = TOP / ".." / "shared" / "cuda-on-cpu" / "run"
CASE = "dam_discharge_quick.toml"
FIRST, LAST = 0.02, 0.04  # [s] the steps between are counted

# Published: memory [B/s], multiprocessors, clock [Hz], first cache [sectors of 32 B per clock and multiprocessor],
# double precision [flop/s]. A K40 loads through its second cache.
GPUS = {
    "K40": (288e9, 15, 0.745e9, 2, 1.43e12),
    "V100": (900e9, 80, 1.53e9, 4, 7.8e12),
    "A100": (1555e9, 108, 1.41e9, 4, 9.7e12),
    "H100": (3350e9, 132, 1.98e9, 4, 34e12),
    "H200": (4800e9, 132, 1.98e9, 4, 34e12),
}
# Assumed, without a source: the share of the published rates that a kernel gets, the time from one launch to the next,
# from one kernel of a graph to the next, that of a wait, the launch that follows it included, and that of recording a
# step anew.
ATTAINED = 0.75
LAUNCH, NODE, WAIT, RECORDING = 2.5e-6, 1.5e-6, 15e-6, 100e-6  # [s]
GATHERED_ARRAYS = 2           # of 16-byte elements, in a kernel that gathers
MORE_GATHERED_ARRAYS = {"DensityAndShear": 1}  # by a part of the kernel's name
SIZES = (12500, 102000, 1000000, 10000000)


def parse_profile(text):
    """Totals by kernel since the start: launches, threads, warp instructions, fp64, sectors, streamed sectors."""
    kernels = {}
    for part in text.split("\nkernel ")[1:]:
        def number(pattern):
            found = re.search(pattern, part)
            return int(found[1]) if found else 0
        loads, stores = number(r"global loads .* (\d+) sectors"), number(r"global stores .* (\d+) sectors")
        wide = sum(int(n) for n in re.findall(r"(\d+) sectors,[^\n]*ld\.global\S*\.v4\.f32", part))
        threads = number(r"threads (\d+)")
        name = part.splitlines()[0].strip()
        arrays = GATHERED_ARRAYS + sum(n for kernel, n in MORE_GATHERED_ARRAYS.items() if kernel in name)
        gathered = min(wide, arrays * threads * 16 // 32)
        totals = (number(r"launches (\d+)"), threads, number(r"warp instructions (\d+)"), number(r"fp64 ops (\d+)"),
                  loads + stores, loads - wide + gathered + stores)
        kernels[name] = [a + b for a, b in zip(kernels.get(name, [0] * 6), totals)]
    return kernels


def profiled_run(program, until, folder):
    profile = Path(folder) / f"profile_{until}.txt"
    target = Path(folder) / f"run_{until}"
    command = ["env", f"CUDA_ON_CPU_PROFILE={profile}", RUNTIME, program, "run", TOP / "cases" / CASE, "-o", target,
               "--until", until, "--quiet", "--set", "output.history_interval=1", "--set", "output.interval=1"]
    subprocess.run([str(word) for word in command], check=True, capture_output=True)
    return parse_profile("\n" + profile.read_text()), json.loads((target / "summary.json").read_text())


def count(program):
    """Runs the case twice and writes what the steps between did, per step, to COUNTS."""
    with tempfile.TemporaryDirectory() as folder:
        (before, first), (after, last) = (profiled_run(program, until, folder) for until in (FIRST, LAST))
    steps = last["steps"] - first["steps"]
    names = ("launches", "threads", "warp_instructions", "fp64", "sectors", "memory_sectors")
    kernels = []
    for name, totals in after.items():
        done = [(b - a) / steps for a, b in zip(before.get(name, [0] * 6), totals)]
        if done[0] > 0:
            kernels.append({"kernel": name, **{key: round(value, 3) for key, value in zip(names, done)}})
    readable = subprocess.run(["c++filt"], input="\n".join(k["kernel"] for k in kernels), capture_output=True, text=True,
                              check=True).stdout.splitlines()
    for kernel, name in zip(kernels, readable):
        name = re.sub(r"slagflow::|\(anonymous namespace\)::|void |cub::\w+::(\w+::)*", "", name)
        kernel["kernel"] = name.replace(" >", ">").split("(")[0][:100]
    iterations = [s["viscous"]["iterations_mean"] * s["steps"] for s in (first, last)]
    result = {"case": CASE, "commit": last["commit"], "steps": [first["steps"], last["steps"]],
              "fluid": last["particles"]["fluid"], "wall": last["particles"]["wall"],
              "iterations_per_step": round((iterations[1] - iterations[0]) / steps, 3),
              "rebuilds_per_step": round((last["list_builds"] - first["list_builds"]) / steps, 4),
              **{f"{key}_per_step": round((last[f"device_{key}"] - first[f"device_{key}"]) / steps, 3)
                 for key in ("waits", "graph_launches", "graph_kernels", "graph_recordings")},
              "kernels": sorted(kernels, key=lambda k: -k["sectors"])}
    COUNTS.write_text(json.dumps(result, indent=1) + "\n")


def read_counts():
    return json.loads(COUNTS.read_text())


def step_time(gpu, particles, counts):
    """Predicted [s]; counts grow with the particles, launches and waits do not. Which kernels are in graphs is not
    counted, only how many."""
    bandwidth, processors, clock, sectors, double = GPUS[gpu]
    scale = particles / counts["fluid"]
    launches = sum(kernel["launches"] for kernel in counts["kernels"])
    in_graphs = counts["graph_kernels_per_step"] / launches
    begin = in_graphs * NODE + (1 - in_graphs) * LAUNCH
    time = counts["waits_per_step"] * WAIT + counts["graph_recordings_per_step"] * RECORDING
    for kernel in counts["kernels"]:
        busy = max(32 * kernel["memory_sectors"] / bandwidth, kernel["sectors"] / (sectors * processors * clock),
                   kernel["warp_instructions"] / (4 * processors * clock), kernel["fp64"] / double) * scale / ATTAINED
        time += max(busy, kernel["launches"] * begin)
    return time


def totals(counts):
    """Per step: kernels, waits; per fluid particle and step: bytes loaded and stored, warp instructions."""
    kernels = counts["kernels"]
    return (sum(k["launches"] for k in kernels), counts["waits_per_step"],
            sum(32 * k["sectors"] for k in kernels) / counts["fluid"],
            sum(32 * k["memory_sectors"] for k in kernels) / counts["fluid"],
            sum(32 * k["warp_instructions"] for k in kernels) / counts["fluid"])


def print_table(counts):
    launches, waits, through, memory, instructions = totals(counts)
    print(f"Model, not measured. Counted in steps {counts['steps'][0]} to {counts['steps'][1]} of {counts['case']}: "
          f"{launches:.1f} kernels, {counts['graph_kernels_per_step']:.1f} of them in {counts['graph_launches_per_step']:.2f} "
          f"graphs, {counts['graph_recordings_per_step']:.3f} recordings, {counts['rebuilds_per_step']:.3f} builds of the "
          f"lists and {waits:.2f} waits a step,\n{through:.0f} B through the first cache, "
          f"{memory:.0f} B from memory and {instructions:.0f} thread instructions a fluid particle and step, "
          f"{counts['iterations_per_step']:.1f} iterations.\n")
    print("| fluid particles | " + " | ".join(GPUS) + " |\n|---|" + "---|" * len(GPUS))
    for size in SIZES:
        cells = [f"{1e3 * (t := step_time(gpu, size, counts)):.3g} ms, {size / t:.2g} /s" for gpu in GPUS]
        print(f"| {size} | " + " | ".join(cells) + " |")


def compare_measured(device, benchmarks, counts):
    """Lines of measured beside predicted times of whole steps; `device`: the GPU's name."""
    gpu = next((name for name in GPUS if name in device), None)
    if gpu is None:
        return [f"no model of {device}; there is one of {', '.join(GPUS)}"]
    lines = [f"{device}: {'fluid particles':>16} {'measured ms':>12} {'predicted ms':>13}"]
    for name, record in benchmarks.items():
        if name.startswith("step/") and "particles" in record:
            particles, seconds = record["particles"][0], sorted(record["seconds"])[len(record["seconds"]) // 2]
            lines.append(f"{'':{len(device)}}  {particles:>16.0f} {1e3 * seconds:>12.3f} "
                         f"{1e3 * step_time(gpu, particles, counts):>13.3f}")
    return lines
