"""Tests of scripts/kernels. With a test's name as argument only that one is run."""

import importlib.machinery
import importlib.util
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("kernels", str(PROJECT / "scripts" / "kernels"))
kernels = importlib.util.module_from_spec(importlib.util.spec_from_loader("kernels", LOADER))
LOADER.exec_module(kernels)


def row(**changes):
    figures = {"registers": 40, "stack": 0, "shared": 0, "occupancy": 75}
    result = {"source": "cuda/a.cu", "kernel": "Multiply", "threads": 128}
    for architecture in kernels.ARCHITECTURES:
        result.update({f"{architecture}_{key}": value for key, value in figures.items()})
    result.update(changes)
    return result


def recorded(*rows):
    return {(r["source"], r["kernel"]): {key: str(value) for key, value in r.items()} for r in rows}


class Kernels(unittest.TestCase):
    def test_growth_fails_with_kernel_and_both_figures(self):
        worse = kernels.compare([row(sm_90_registers=41)], recorded(row()))
        self.assertEqual(worse, ["cuda/a.cu Multiply sm_90: 41 registers, recorded are 40"])

    def test_lower_occupancy_fails(self):
        worse = kernels.compare([row(sm_80_occupancy=62)], recorded(row()))
        self.assertEqual(worse, ["cuda/a.cu Multiply sm_80: 62 % occupancy, recorded are 75"])

    def test_same_and_smaller_figures_pass(self):
        self.assertEqual(kernels.compare([row(sm_80_registers=32, sm_80_occupancy=100)], recorded(row())), [])

    def test_a_kernel_without_record_fails(self):
        worse = kernels.compare([row(kernel="New")], recorded(row()))
        self.assertEqual(len(worse), 1)
        self.assertIn("cuda/a.cu New: not recorded", worse[0])

    def test_occupancy_is_that_of_registers_and_shared_memory(self):
        self.assertEqual(kernels.occupancy(32, 0, 128), 100)
        self.assertEqual(kernels.occupancy(48, 0, 128), 62)  # 40 of 64 warps
        self.assertEqual(kernels.occupancy(255, 0, 128), 12)
        self.assertEqual(kernels.occupancy(32, 40 * 1024, 128), 25)  # four blocks

    def test_names_are_those_of_bodies(self):
        body = "void slagflow::run_body<slagflow::(anonymous namespace)::Sum<slagflow::Lucy> >(slagflow::Sum, int)"
        self.assertEqual(kernels.short(body), "Sum<Lucy>")
        self.assertEqual(kernels.short("void cub::V1::detail::reduce::DeviceReduceKernel<int>(int)"),
                         "cub DeviceReduceKernel")

    def test_the_record_can_be_read(self):
        version, rows = kernels.read_record()
        self.assertRegex(version, r"^\d+\.\d+$")
        self.assertIn(("cuda/viscosity/predictor.cu", "PredictAndAssemble<OpenBox>"), rows)


if __name__ == "__main__":
    unittest.main()
