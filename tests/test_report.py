"""Tests of scripts/report. With a test's name as argument only that one is run."""

import subprocess
import unittest
from html.parser import HTMLParser

from test_plot import PROJECT
from test_surface import SurfaceCase

import numpy as np
from plotting import report
import slagflow

LOG = """warning: early one
end: 100.0 %  t 0.1 s
oil (front): arrived after 0.05 s
warning: a <b>bold</b> warning
no particle left the domain
results in runs/x
"""


class Loads(HTMLParser):
    """What a page would fetch, and the frames in it."""

    def __init__(self):
        super().__init__()
        self.fetched, self.frames, self.words = [], [], []

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.fetched += [given[name] for name in ("src", "href") if given.get(name) and not given[name].startswith(("data:", "#"))]
        if tag == "iframe":
            self.frames.append(given["srcdoc"])

    def handle_data(self, data):
        self.words.append(data)


class Report(SurfaceCase):
    def test_is_one_file_that_fetches_nothing(self):
        self.need_tools()
        folder = self.make_run()
        (folder / "log.txt").write_text(LOG)
        done = subprocess.run([PROJECT / "scripts/report", folder], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", f"{folder}/report.html\n"))
        text = (folder / "report.html").read_text()
        self.assertLess(len(text), 25e6)
        page = Loads()
        page.feed(text)
        self.assertEqual(page.fetched, [])
        self.assertEqual(len(page.frames), 1)
        self.assertIn("K3D", page.frames[0])
        self.assertIn("data:image/png;base64,", text)
        for words in ("block", "oil (front): arrived after 0.05 s", "a <b>bold</b> warning", "early one", "fluid oil", "newtonian, 900 kg/m³, 1 Pa s"):
            self.assertIn(words, "\n".join(page.words))
        self.assertNotIn("results in", "".join(page.words))

    def test_what_is_no_run_is_an_error(self):
        done = subprocess.run([PROJECT / "scripts/report", self.folder / "nothing"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is no folder", done.stderr)

    def test_lines_of_the_end_are_told_and_warnings_apart(self):
        folder = self.make_run()
        (folder / "log.txt").write_text(LOG)
        told, warnings = slagflow.open(folder).told()
        self.assertEqual(told, ["oil (front): arrived after 0.05 s", "no particle left the domain"])
        self.assertEqual(warnings, ["early one", "a <b>bold</b> warning"])

    def test_flow_curves_are_those_of_the_rheologies(self):
        rate = np.array([0.0, 4.0])
        for fluid, wanted in (({"rheology": "newtonian", "dynamic_viscosity": 2.0}, [0, 8]),
                              ({"rheology": "bingham", "plastic_viscosity": 2.0, "yield_stress": 3.0}, [3, 11]),
                              ({"rheology": "herschel-bulkley", "consistency": 2.0, "flow_index": 0.5, "yield_stress": 1.0}, [1, 5])):
            self.assertEqual(report.stress(fluid, rate).tolist(), wanted)
        self.assertIsNone(report.stress({"rheology": "casson"}, rate))


if __name__ == "__main__":
    unittest.main()
