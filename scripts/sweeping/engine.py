"""Hands out the points of a sweep: on this machine itself, on a cluster through Snakemake."""

import json
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from sweeping.point import INTERRUPTED, identity

HERE = Path(__file__).resolve().parent
SNAKEMAKE = HERE.parent.parent / ".venv/bin/snakemake"


def is_there(plan, folder, name):
    """Whether the point has ended, as the plan has it now."""
    result = folder / "points" / name / "result.json"
    return result.is_file() and json.loads(result.read_text()).get("identity") == identity(plan, plan["points"][name])


def forget(plan, folder, retry):
    """Takes away results of other keys or another case; with `retry` those of failed points too."""
    for name in plan["points"]:
        result = folder / "points" / name / "result.json"
        if result.is_file() and (not is_there(plan, folder, name) or
                                 (retry and json.loads(result.read_text())["status"] != "done")):
            result.unlink()


def run_here(plan, folder, cores):
    """Runs what is not there, as many at a time as the cores hold; one on a GPU. Returns the exit status."""
    threads = plan["threads"]
    environment = os.environ | {"OMP_NUM_THREADS": str(threads)}
    names = [name for name in plan["points"] if not is_there(plan, folder, name)]
    ended = []

    def run(name):
        command = [plan["python"], HERE / "point.py", "plan.json", name, str(threads)]
        status = subprocess.run(command, cwd=folder, env=environment).returncode
        if status == INTERRUPTED:
            return status
        ended.append(name)
        print(f"{len(ended)} of {len(names)}: {name}", flush=True)
        return status

    pool = ThreadPoolExecutor(1 if plan["gpu"] else max(1, cores // threads))
    try:
        statuses = list(pool.map(run, names))
    except KeyboardInterrupt:
        print("stopping; the same command goes on", flush=True)
        statuses = [INTERRUPTED]
    pool.shutdown(wait=True, cancel_futures=True)
    return max(statuses, default=0)


def run_on_cluster(plan, folder, cores, options):
    """Snakemake's exit status. The folder is locked by scripts/sweep itself, which a kill cannot leave behind."""
    command = [SNAKEMAKE, "--snakefile", HERE / "Snakefile", "--directory", folder, "--cores", cores, "--nolock",
               "--keep-going", "--rerun-incomplete", "--quiet", "rules", "progress"]
    if plan["gpu"] and "--executor" not in options:
        command += ["--resources", "gpu=1"]
    environment = os.environ | {"OMP_NUM_THREADS": str(plan["threads"])}
    return subprocess.run([str(part) for part in command] + options, env=environment).returncode
