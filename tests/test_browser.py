"""Tests of reports in a headless Chromium; skipped without one. With a test's name as argument only that one is run."""

import io
import subprocess
import sys
import time
import unittest

from browser import Browser
from test_plot import PROJECT
from test_surface import SurfaceCase

import numpy as np
from PIL import Image
from plotting.printing import browser

VIEW = "document.querySelector('iframe').contentDocument"
PLAY = f"[...{VIEW}.querySelectorAll('.lil-name')].find(e => e.textContent == 'Play loop').closest('.lil-controller').querySelector('button').click()"


class ReportInABrowser(SurfaceCase):
    def setUp(self):
        super().setUp()
        if browser() is None:
            self.skipTest("no Chromium or Chrome in PATH: reports are not looked at in a browser")
        self.need_tools()
        self.run_folder = self.make_run()
        done = subprocess.run([PROJECT / "scripts/report", self.run_folder], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def view(self, page):
        return np.asarray(Image.open(io.BytesIO(page.picture("iframe"))).convert("RGB")).astype(int)

    def look(self, page, width):
        """Opens the report at a width and plays it."""
        page.open((self.run_folder / "report.html").as_uri(), width, 900)
        page.wait_for(f"{VIEW} && {VIEW}.querySelector('canvas') && {VIEW}.querySelector('.lil-name') != null")
        deadline, seen = time.monotonic() + 60, np.zeros((1, 1, 3))
        while (np.ptp(seen, axis=2) > 60).sum() < 2000 and time.monotonic() < deadline:
            seen = self.view(page)
        self.assertGreater((np.ptp(seen, axis=2) > 60).sum(), 2000, "the view is blank")
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width, "the page is wider than the window")
        self.assertGreater(page.evaluate("document.querySelectorAll('.plots svg.main-svg').length"), 0)
        seen = self.view(page)
        time.sleep(1)
        self.assertLess((np.abs(self.view(page) - seen).max(axis=2) > 40).sum(), 1000, "it moves before it is told to")
        page.evaluate(PLAY)
        deadline, change = time.monotonic() + 60, 0
        while change < 1000 and time.monotonic() < deadline:
            change = (np.abs(self.view(page) - seen).max(axis=2) > 40).sum()
        self.assertGreater(change, 1000, "it does not play")
        self.assertEqual(page.errors, [])

    def test_view_is_seen_and_plays_on_a_telephone(self):
        with Browser(browser()) as page:
            self.look(page, 400)

    def test_view_is_seen_and_plays_on_a_large_screen(self):
        with Browser(browser()) as page:
            self.look(page, 1600)

    def test_what_a_page_complains_of_is_heard(self):
        with Browser(browser()) as page:
            page.open("data:text/html,<script>console.error('told'); setTimeout(() => { throw new Error('thrown') })</script>", 400, 300)
            page.wait_for("true")
            self.assertEqual((len(page.errors), "told" in page.errors[0], "thrown" in page.errors[1]), (2, True, True), page.errors)

    def test_pdf_has_pages(self):
        data = (self.run_folder / "report.pdf").read_bytes()
        self.assertEqual(data[:5], b"%PDF-")
        self.assertGreater(len(data), 30000)


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
