"""Reads the samples of test_vtkhdf.cpp and test_run.cpp, or the files of any run, with VTK's own reader.

Usage: read_vtkhdf.py TEST_HOST     the test executable, which writes the samples to a temporary folder
       read_vtkhdf.py --run DIR     a run that has ended
"""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

PARTICLE_ARRAYS = ("Velocity", "Pressure", "Density", "Viscosity", "ShearRate", "ShearStress", "SheetThickness", "Yielded", "Fluid", "ParticleId")


class File:
    """A .vtkhdf file as VTK sees it."""

    def __init__(self, path):
        self.reader = vtkHDFReader()
        assert self.reader.CanReadFile(path), f"{path}: not readable"
        self.reader.SetFileName(path)
        self.reader.UpdateInformation()
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        self.times = list(self.reader.GetOutputInformation(0).Get(key) or [])

    def at(self, time):
        self.reader.UpdateTimeStep(time)
        output = self.reader.GetOutputDataObject(0)
        assert output.IsA("vtkPolyData"), f"got a {output.GetClassName()}"
        return output


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.zeros((0, 3))


def array(data, name):
    found = data.GetPointData().GetArray(name)
    assert found is not None, f"no array {name}"
    return vtk_to_numpy(found)


def check_cells(data):
    """One vertex for each point, in order, and no other cell."""
    count = data.GetNumberOfPoints()
    assert data.GetNumberOfVerts() == count == data.GetNumberOfCells()
    numbers = vtk_to_numpy(data.GetVerts().GetConnectivityArray())
    offsets = vtk_to_numpy(data.GetVerts().GetOffsetsArray())
    np.testing.assert_array_equal(numbers, np.arange(count))
    np.testing.assert_array_equal(offsets, np.arange(count + 1))


def check_sample(path, counts):
    """The formulas are those of `Sample` in test_vtkhdf.cpp."""
    file = File(path)
    times = [0.5 * s for s in range(len(counts))]
    if len(counts) > 1:  # VTK takes a file of one step for one without time
        assert file.times == times, f"{path}: times {file.times}"
    # Backwards too: the reader keeps what it read of other steps.
    for s in list(range(len(counts))) + list(reversed(range(len(counts)))):
        data = file.at(times[s])
        i = np.arange(counts[s])
        assert data.GetNumberOfPoints() == counts[s], f"{path}: step {s}: {data.GetNumberOfPoints()} points"
        check_cells(data)
        if counts[s] == 0:  # VTK 9.3 then reads no arrays at all
            continue
        np.testing.assert_array_equal(points(data), np.stack([3e6 + 1e-3 * i, 0 * i + s, -i], axis=1))
        assert points(data).dtype == np.float64
        np.testing.assert_array_equal(array(data, "Velocity"), np.stack([0 * i + s, i, s + i], axis=1))
        np.testing.assert_array_equal(array(data, "Pressure"), 1000 * s + i)
        np.testing.assert_array_equal(array(data, "Fluid"), i % 3)
        np.testing.assert_array_equal(array(data, "ParticleId"), 10**10 + i)
        assert array(data, "Velocity").dtype == np.float32
        assert array(data, "Fluid").dtype == np.uint8
        assert array(data, "ParticleId").dtype == np.int64


def check_fixed(path):
    """Points that are stored once, with data of their own in each step."""
    file = File(path)
    assert file.times == [0, 0.5, 1]
    i = np.arange(4)
    for s, time in enumerate(file.times):
        data = file.at(time)
        np.testing.assert_array_equal(points(data), np.stack([3e6 + 1e-3 * i, 0 * i, -i], axis=1))
        np.testing.assert_array_equal(array(data, "Pressure"), 1000 * s + i)
        check_cells(data)


def check_run(folder):
    """Files of a finished run: particle counts and times agree with the history."""
    with open(os.path.join(folder, "history.csv"), newline="") as lines:
        history = {float(row["time_s"]): row for row in csv.DictReader(lines)}
    file = File(os.path.join(folder, "particles.vtkhdf"))
    assert len(file.times) >= 2
    for time in file.times:
        data = file.at(time)
        line = min(history, key=lambda t: abs(t - time))
        if abs(line - time) < 1e-9:
            assert data.GetNumberOfPoints() == int(history[line]["particles_in"])
        for name in PARTICLE_ARRAYS if data.GetNumberOfPoints() else ():
            assert len(array(data, name)) == data.GetNumberOfPoints(), name
            assert np.all(np.isfinite(array(data, name))), name
        check_cells(data)
    if os.path.exists(os.path.join(folder, "walls.vtkhdf")):  # not written without wall particles
        walls = File(os.path.join(folder, "walls.vtkhdf"))
        data = walls.at(file.times[-1])
        assert data.GetNumberOfPoints() == len(array(data, "Pressure")) == len(array(data, "Wall")) > 0
        check_cells(data)


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--run":
        check_run(sys.argv[2])
        return
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], "--gtest_filter=*ForOtherReaders"], check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "SLAGFLOW_VTK_SAMPLES": folder})
        check_sample(os.path.join(folder, "small.vtkhdf"), [5, 3, 0, 7, 1])
        check_sample(os.path.join(folder, "empty_start.vtkhdf"), [0, 2])
        check_sample(os.path.join(folder, "one_step.vtkhdf"), [3])
        check_sample(os.path.join(folder, "large.vtkhdf"), [100000, 99990, 100000])
        check_sample(os.path.join(folder, "stopped.vtkhdf"), [5, 3])
        check_sample(os.path.join(folder, "stopped_early.vtkhdf"), [5])
        check_fixed(os.path.join(folder, "fixed.vtkhdf"))
        check_run(os.path.join(folder, "run"))
        check_run(os.path.join(folder, "run_with_walls"))
    print("all samples read as written")


if __name__ == "__main__":
    main()
