"""The folder that a machine with a GPU measures with, where no package can be installed and nothing compiled: programs, the
libraries that they load, cases, and one script. And what comes back."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

from benching import device_model

TOP = Path(__file__).resolve().parent.parent.parent
PROGRAMS = ("slagflow", "tests/test_core", "tests/agreement", "tests/bench_step")
CASES = ("dam_discharge.toml", "dam_discharge_2mm.toml", "dam_discharge_quick.toml")
MOST_BYTES = 50 * 2**20


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"scripts/bench: {' '.join(str(word) for word in command)} failed\n{(done.stdout + done.stderr)[-3000:]}")
    return done.stdout


def build(preset, *targets):
    run(["bash", "-c", f"source scripts/toolchain && build {preset} {' '.join(targets)}"], cwd=TOP)
    return TOP / "build" / preset


def libraries(program):
    """Path by name of all that it loads, the loader among them."""
    found = {}
    for line in run(["ldd", program]).splitlines():
        if match := re.match(r"\s*(\S+) => (/\S+) ", line) or re.match(r"\s*(/\S+/(ld-linux\S+)) ", line):
            name, path = (match[1], match[2]) if "=>" in line else (match[2], match[1])
            found[name] = Path(path)
    return found


def pack(target):
    """Fills the folder, which must not be there yet."""
    if target.exists():
        sys.exit(f"scripts/bench: {target} is there already: name a folder that is not")
    cuda = build("cuda-pack", *(Path(name).name for name in PROGRAMS))
    cpu = build("cpu", "agreement")
    for folder in ("bin", "lib", "cases"):
        (target / folder).mkdir(parents=True)
    for name in PROGRAMS:
        program = target / "bin" / Path(name).name
        shutil.copy(cuda / name, program)
        for library, path in libraries(cuda / name).items():
            shutil.copy(path, target / "lib" / library)
    for file in [*(target / "bin").iterdir(), target / "lib" / "libslagflow_core.so"]:
        run(["strip", file])
    for case in CASES:
        shutil.copy(TOP / "cases" / case, target / "cases" / case)
    shutil.copy(Path(__file__).with_name("measure.sh"), target / "measure.sh")
    run([cpu / "tests" / "agreement", "write", target / "agreement.cpu"])
    size = sum(path.stat().st_size for path in target.rglob("*") if path.is_file())
    print(f"{target}: {size / 2**20:.1f} MiB. On the machine with the GPU: {target.name}/measure.sh; its results are read with "
          "scripts/bench --read FOLDER")
    if size > MOST_BYTES:
        sys.exit(f"scripts/bench: that is more than {MOST_BYTES / 2**20:.0f} MiB")


def read_json(path):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


def steps_of(folder):
    """The benchmarks of whole steps, by particles."""
    found = []
    for path in sorted(folder.glob("steps*.json")):
        for entry in (read_json(path) or {}).get("benchmarks", []):
            if entry.get("run_type") == "iteration" and "particles" in entry:
                found.append(entry)
    return sorted(found, key=lambda entry: entry["particles"])


def step_lines(entry, gpu, counts):
    """Of one size: the step beside the model's, and its parts."""
    particles, measured = entry["particles"], entry["real_time"]
    model = f"{1e3 * device_model.step_time(gpu, particles, counts):.3f}" if gpu else "none"
    parts = {key[3:]: value for key, value in entry.items() if key.startswith("ms ") and value > 0}
    yield (f"{particles:>12.0f} {measured:>12.3f} {model:>10} {particles / measured * 1e3:>14.3g} "
           f"{entry['device_bytes_per_particle']:>8.0f}")
    yield "             " + ", ".join(f"{name} {value:.3f}" for name, value in sorted(parts.items(), key=lambda p: -p[1]))


def read(folder):
    """Prints what measure.sh has left, measured beside the model."""
    parts = read_json(folder / "parts.json")
    if parts is None:
        sys.exit(f"scripts/bench: {folder} has no parts.json, which measure.sh leaves")
    device = (folder / "device.csv").read_text().strip().splitlines()[-1]
    gpu = next((name for name in device_model.GPUS if name in device), None)
    counts = device_model.read_counts()
    print(device)
    for part in parts:
        print(f"  {part['part']}: {'good' if part['status'] == 0 else part['status']}, {part['seconds']} s")
    tests = read_json(folder / "tests.json")
    if tests:
        print(f"tests: {tests['tests']}, failed: {tests['failures'] + tests['errors']}")
    print(f"{'particles':>12} {'measured ms':>12} {'model ms':>10} {'part.steps/s':>14} {'B/part.':>8}; below: parts, launched one by one [ms]")
    for entry in steps_of(folder):
        print("\n".join(step_lines(entry, gpu, counts)))
    for name in ("discharge", "discharge_conditional"):
        if summary := read_json(folder / f"{name}.json"):
            print(f"{name}: {summary['simulated_time']:.4g} s of flow, {summary['steps']} steps in {summary['wall_time']:.2f} s, "
                  f"{summary['particle_steps_per_second']:.3g} fluid particle-steps/s, {summary['device_waits'] / summary['steps']:.2f} "
                  "waits of the host a step")
