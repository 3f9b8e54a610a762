"""Runs one point of a sweep: `point.py PLAN NAME THREADS`. Writes points/NAME/result.json whatever comes of it, so that
a failed point ends no sweep; only an interrupted one leaves none and is gone on with the next time."""

import hashlib
import json
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from sweeping.plan import toml_text  # noqa: E402

INTERRUPTED = 130


def identity(plan, point):
    """Tells whether a run that is there is one of this point."""
    case = Path(plan["case"]).read_bytes()
    return hashlib.sha256(json.dumps(point["overrides"], sort_keys=True).encode() + case).hexdigest()


def command(plan, point, folder, threads):
    mark = folder / "identity"
    present = mark.is_file() and mark.read_text() == identity(plan, point)
    common = ["--quiet", "--threads", str(threads)]
    if present and (folder / "run/checkpoint.h5").is_file():
        return [plan["program"], "resume", str(folder / "run"), *common]
    mark.write_text(identity(plan, point))
    settings = [f"--set={key}={toml_text(value)}" for key, value in point["overrides"].items()]
    return [plan["program"], "run", plan["case"], "-o", str(folder / "run"), "--overwrite", *settings, *common]


def finished(summary):
    return summary.is_file() and json.loads(summary.read_text()).get("status") == "done"


def reason_of(said, status):
    lines = said.strip().splitlines() or [f"ended with {status}"]
    return next((line for line in lines if line.startswith("error:")), lines[-1])


def run_to_end(arguments):
    """Ctrl-C in a terminal is for slagflow, which leaves a checkpoint; this waits for that."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        return subprocess.run(arguments, capture_output=True, text=True,
                              preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    finally:
        signal.signal(signal.SIGINT, before)


def run_point(plan, name, threads):
    point = plan["points"][name]
    folder = Path("points") / name
    folder.mkdir(parents=True, exist_ok=True)
    done = run_to_end(command(plan, point, folder, threads))
    if done.returncode == INTERRUPTED:
        return INTERRUPTED
    ok = done.returncode == 0 or finished(folder / "run/summary.json")  # resuming a run that had ended says so
    result = {"point": name, "axes": point["axes"], "identity": identity(plan, point), "status": "done" if ok else "failed",
              "reason": "" if ok else reason_of(done.stderr, done.returncode)}
    (folder / "result.json").write_text(json.dumps(result, indent=2))
    if not ok:
        print(f"failed: {name}: {result['reason']}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(run_point(json.loads(Path(sys.argv[1]).read_text()), sys.argv[2], int(sys.argv[3])))
