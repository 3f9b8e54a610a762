"""Tests of scripts/report. With a test's name as argument only that one is run."""

import json
import os
import subprocess
import sys
import unittest
from html.parser import HTMLParser
from unittest import mock

from test_plot import PROJECT
from test_surface import SurfaceCase

import numpy as np
from plotting import page, printing, report, sweep_report
from sweeping import compare
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


def blind():
    """An environment without a browser."""
    return os.environ | {"PATH": "/nowhere"}


class Report(SurfaceCase):
    def report(self, folder):
        return subprocess.run([PROJECT / "scripts/report", folder], env=blind(), capture_output=True, text=True, check=False)

    def test_a_browser_that_prints_makes_the_pdf_and_one_that_fails_is_told(self):
        program, target = self.folder / "chromium", self.folder / "page.pdf"
        program.write_text('#!/bin/sh\nfor word; do case "$word" in --print-to-pdf=*) echo "%PDF" > "${word#*=}";; esac; done\n')
        program.chmod(0o755)
        with mock.patch.dict(os.environ, {"PATH": f"{self.folder}:/bin:/usr/bin"}):
            printing.write_pdf(self.folder / "page.html", target)
            self.assertEqual(target.read_text(), "%PDF\n")
            program.write_text("#!/bin/sh\necho no display >&2\nexit 3\n")
            with self.assertRaisesRegex(printing.PrintError, "no display"):
                printing.write_pdf(self.folder / "page.html", target)

    def test_a_movie_is_inside_of_the_page_where_there_is_room(self):
        movie = self.folder / "movie.mp4"
        self.assertEqual(page.movie_html(movie, 1e9), "")
        movie.write_bytes(b"x" * 3000)
        self.assertIn("src='data:video/mp4;base64,eHh4", page.movie_html(movie, 4100))
        self.assertIn("is too large for this page", page.movie_html(movie, 3900))

    def test_is_one_file_that_fetches_nothing(self):
        self.need_tools()
        folder = self.make_run()
        (folder / "log.txt").write_text(LOG)
        done = self.report(folder)
        self.assertEqual((done.returncode, done.stderr, done.stdout),
                         (0, "", f"{folder}/report.html\nno PDF of it: no Chromium or Chrome in PATH, which would print it\n"))
        text = (folder / "report.html").read_text()
        self.assertLess(len(text), 25e6)
        seen = Loads()
        seen.feed(text)
        self.assertEqual(seen.fetched, [])
        self.assertEqual(len(seen.frames), 1)
        self.assertIn("K3D", seen.frames[0])
        self.assertIn("data:image/png;base64,", text)
        for words in ("block", "oil (front): arrived after 0.05 s", "a <b>bold</b> warning", "early one", "fluid oil", "newtonian, 900 kg/m³, 1 Pa s"):
            self.assertIn(words, "\n".join(seen.words))
        self.assertRegex("\n".join(seen.words), r"of \d{3} comparisons with closed forms and experiments \d{3} reach their target, \d+ miss it")
        self.assertNotIn("results in", "".join(seen.words))

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


class SweepReport(SurfaceCase):
    AXES = ("oil", "stress")

    def make_sweep(self, runs):
        """Points over a word and a number, done but for the last, with results; their runs where asked."""
        points, lines = {}, ["point,oil,stress,status,reason,fluid.oil.density,wall_time,version,jet.travelling_time,jet.class,gate.passed_volume"]
        for k, (oil, stress) in enumerate((o, s) for o in "AB" for s in (0.5, 0, 2)):
            name, status = f"oil={oil}_stress={stress}", "failed" if k == 5 else "done"
            (self.folder / "points" / name).mkdir(parents=True)
            if runs and k < 2:
                self.make_run(f"points/{name}/run", viscosity=k + 1.0)
            (self.folder / "points" / name / "result.json").write_text("{}")
            points[name] = {"axes": {"oil": oil, "stress": stress}, "overrides": {"output.end_time": 1.0, "fluid.oil.yield_stress": stress}}
            lines.append(f"{name},{oil},{stress},{status},{'too thick' if k == 5 else ''},900,2.5,0.1.0,{'' if k == 5 else 0.1 * (k + 1)},free-jet,3")
        (self.folder / "results.csv").write_text("\n".join(lines) + "\n")
        plan = {"case": "/somewhere/base.toml", "points": points}
        (self.folder / "plan.json").write_text(json.dumps(plan))
        return plan, sweep_report.read(self.folder)[1]

    def test_curves_are_over_the_number_one_for_each_word(self):
        _, lines = self.make_sweep(False)
        done = [line for line in lines if line["status"] == "done"]
        self.assertEqual(sweep_report.results_of(done, self.AXES), ["jet.travelling_time"])  # the volume is the same in all
        over, curves = sweep_report.traces(done, self.AXES, "jet.travelling_time")
        self.assertEqual(over, "stress")
        self.assertEqual([(name, x) for name, x, _ in curves], [("oil = A", [0, 0.5, 2]), ("oil = B", [0, 0.5])])
        np.testing.assert_allclose(curves[0][2], [0.2, 0.1, 0.3])

    def test_page_holds_table_curves_and_runs_side_by_side(self):
        self.need_tools()
        plan, lines = self.make_sweep(True)
        with mock.patch("sys.stdout"):
            compare.compare(PROJECT, plan, self.folder, [line for line in lines if line["point"] in list(plan["points"])[:2]])
        self.assertTrue((self.folder / "compare.png").is_file())
        done = subprocess.run([PROJECT / "scripts/report", self.folder], env=blind(), capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr, done.stdout.splitlines()[0]), (0, "", f"{self.folder}/report.html"))
        seen = Loads()
        seen.feed((self.folder / "report.html").read_text())
        self.assertEqual(seen.fetched, [])
        for words in ("5 of 6 points of base.toml, over oil, stress", "oil=B_stress=2: too thick", "jet.travelling_time", "output.end_time"):
            self.assertIn(words, "\n".join(seen.words))
        self.assertIn("data:image/png;base64,", (self.folder / "report.html").read_text())
        self.assertNotIn("fluid.oil.yield_stress", "".join(seen.words).split("Where it comes from")[0])

    def test_runs_that_are_shown_are_spread_and_have_their_axes_as_titles(self):
        lines = [{"status": "done" if k != 3 else "failed", "point": str(k), "phi": k / 10, "oil": "A"} for k in range(20)]
        some = compare.chosen(lines)
        self.assertEqual([line["point"] for line in some], ["0", "5", "8", "12", "15", "19"])
        self.assertEqual(compare.titles(some[:2], ("phi", "oil")), ["phi = 0", "phi = 0.5"])
        self.assertEqual(compare.chosen(lines[:2]), lines[:2])

    def test_what_cannot_be_drawn_is_told_and_ends_nothing(self):
        plan, lines = self.make_sweep(False)
        with mock.patch("sys.stderr") as errors:
            compare.compare(self.folder, plan, self.folder, lines)  # no .venv there
        self.assertIn("the runs are not drawn side by side: `scripts/install --pictures`", "".join(str(c.args[0]) for c in errors.write.call_args_list))

    def test_a_sweep_that_has_no_results_is_an_error(self):
        self.make_sweep(False)
        (self.folder / "results.csv").unlink()
        with self.assertRaisesRegex(page.ReportError, "is not the folder of a sweep that has ended"):
            sweep_report.read(self.folder)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
