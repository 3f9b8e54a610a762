"""Tests of scripts/check: each makes a small project that breaks a rule. With a test's name as argument only that one is
run."""

import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent


def check(sources):
    """What the rules say of a project with these texts by path."""
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder)
        for script in ("scripts/check", "scripts/pages", "scripts/toolchain"):
            sources = {**sources, script: (PROJECT / script).read_text()}
        for name, text in sources.items():
            (top / name).parent.mkdir(parents=True, exist_ok=True)
            (top / name).write_text(text)
            (top / name).chmod(0o755)
        return subprocess.run(["bash", top / "scripts/check"], capture_output=True, text=True).stdout


class Check(unittest.TestCase):
    rooms = "includes run downwards, from room to room"

    def test_includes_downwards_pass(self):
        said = check({"cuda/pressure/a.hpp": '#include "fluid/b.hpp"\n#include "pressure/c.hpp"\n',
                      "host/run/a.hpp": '#include "fluid/b.hpp"\n#include "host/case/c.hpp"\n#include "version.hpp"\n'})
        self.assertIn(f"pass  {self.rooms}\n", said)

    def test_an_include_upwards_fails(self):
        said = check({"cuda/pressure/a.hpp": '#include "simulation/b.hpp"\n'})
        self.assertIn(f"FAIL  {self.rooms}\n        cuda/pressure/a.hpp:1:", said)
        said = check({"host/case/a.hpp": '#include "host/run/b.hpp"\n'})
        self.assertIn(f"FAIL  {self.rooms}\n        host/case/a.hpp:1:", said)

    def test_a_file_in_no_room_fails(self):
        said = check({"cuda/a.hpp": "int a();\n"})
        self.assertIn(f"FAIL  {self.rooms}\n        cuda/a.hpp (in no room)\n", said)

    def test_an_include_that_names_no_room_fails(self):
        said = check({"cuda/pressure/a.hpp": '#include "b.hpp"\n'})
        self.assertIn(f"FAIL  {self.rooms}\n        cuda/pressure/a.hpp:1:", said)

    arrays = "each particle array is declared once"

    def test_arrays_of_different_names_pass(self):
        said = check({"cuda/fluid/particles.hpp": """ParticleArray<Real> one{*this, {"one", "K", "first", Fate::saved}};
            ParticleArray<Vec3d> other{
                *this, {"other", "K", "second", Fate::saved}};\n"""})
        self.assertIn(f"pass  {self.arrays}\n", said)

    def test_an_array_declared_twice_fails(self):
        said = check({"cuda/fluid/particles.hpp": """ParticleArray<Real> one{*this, {"one", "K", "first", Fate::saved}};
            ParticleArray<Vec3d> other{
                *this,
                {"one", "K", "second", Fate::saved}};\n"""})
        self.assertIn(f'FAIL  {self.arrays}\n        "one" is declared more than once\n', said)

    def test_an_array_of_a_part_may_not_have_the_name_of_another(self):
        said = check({"cuda/fluid/particles.hpp": 'ParticleArray<Real> one{*this, {"one", "K", "", Fate::saved}};\n',
                      "cuda/walls/forces.hpp": 'v.array("one", impulse_);\n'})
        self.assertIn(f'FAIL  {self.arrays}\n        "one" is declared more than once\n', said)

    def test_a_page_that_names_a_file_that_is_not_there_fails(self):
        said = check({"cuda/README.md": "See `fluid/a.hpp` and `host/case/b.cpp`, `fluid/c.cu`.\n",
                      "cuda/fluid/a.hpp": "int a();\n", "host/case/b.cpp": "int b();\n"})
        self.assertIn("FAIL  cuda/README.md names files that are there\n        fluid/c.cu\npass", said)

    program = "build/cpu/slagflow"
    prints = """#!/bin/bash
case $* in
  "help --page") echo "the keys" ;;
  help) echo "error: the key 'a.b' is declared twice" >&2; exit 1 ;;
esac
"""
    page = "<!-- keys: written by scripts/pages -->\n%s\n<!-- end of keys -->\n"

    def test_a_key_declared_twice_fails(self):
        rule = "each key of a case is declared once"
        page = {"host/README.md": self.page % "the keys\n"}
        said = check({**page, self.program: self.prints})
        self.assertIn(f"FAIL  {rule}\n        error: the key 'a.b' is declared twice\n", said)
        said = check({**page, self.program: self.prints.replace("exit 1", "").replace("echo \"error", ": \"error")})
        self.assertIn(f"pass  {rule}\n", said)

    def test_a_page_out_of_date_fails(self):
        rule = "host/README.md holds the keys as slagflow help prints them"
        said = check({"host/README.md": self.page % "the keys\n", self.program: self.prints})
        self.assertIn(f"pass  {rule}\n", said)
        said = check({"host/README.md": self.page % "other keys\n", self.program: self.prints})
        self.assertIn(f"FAIL  {rule}\n        host/README.md is not what the program prints", said)


if __name__ == "__main__":
    unittest.main()
