#!/usr/bin/env python3
"""Says where the outputs of two runs differ: all data sets of checkpoint.h5, particles.vtkhdf and walls.vtkhdf, byte by
byte, and the lines of history.csv and of profiles. Exit code 1 where any does.

    compare.py DIR OTHER
"""
import pathlib
import sys

import h5py

TIMES = {"run/wall_time", "run/setup_time"}  # how long it took


def data_sets(path):
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = item[()]

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def differences_of_files(one, other):
    a, b = data_sets(one), data_sets(other)
    for name in sorted(set(a) ^ set(b)):
        yield f"{one.name}: {name} is in one only"
    for name in sorted(set(a) & set(b) - TIMES):
        x, y = a[name], b[name]
        if getattr(x, "shape", None) != getattr(y, "shape", None):
            yield f"{one.name}: {name}: {x.shape} and {y.shape} values"
        elif hasattr(x, "tobytes") and x.dtype.kind != "O" and x.tobytes() != y.tobytes():
            differ = (x != y).sum() if x.dtype.names is None else "some"
            yield f"{one.name}: {name}: {differ} of {x.size} values differ"


def differences(one, other):
    for name in ("checkpoint.h5", "particles.vtkhdf", "walls.vtkhdf"):
        if (one / name).exists() or (other / name).exists():
            yield from differences_of_files(one / name, other / name)
    tables = {path.name for run in (one, other) for path in run.glob("*.csv")}
    for name in sorted(tables):
        lines = [(run / name).read_text().splitlines() for run in (one, other)]
        for number, (x, y) in enumerate(zip(*lines)):
            if x != y:
                yield f"{name}: line {number + 1} differs:\n  {x}\n  {y}"
                break
        if len(lines[0]) != len(lines[1]):
            yield f"{name}: {len(lines[0])} and {len(lines[1])} lines"


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    found = list(differences(*map(pathlib.Path, arguments)))
    print("\n".join(found) if found else "the same bits")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
