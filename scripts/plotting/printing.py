"""Pages as PDF files, by a Chromium that is there."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
LONGEST, DRAWING = 180, 15000  # s, for the browser; ms of its clock, for the plots


class PrintError(Exception):
    """There is no PDF; the message says why."""


def browser():
    """Path of a Chromium or Chrome in PATH, or None."""
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)


def write_pdf(page, path):
    """Prints an HTML file. Raises PrintError."""
    program = browser()
    if program is None:
        raise PrintError("no Chromium or Chrome in PATH, which would print it")
    with tempfile.TemporaryDirectory() as profile:
        command = [program, "--headless", "--disable-gpu", "--no-first-run", f"--user-data-dir={profile}", "--no-pdf-header-footer",
                   f"--virtual-time-budget={DRAWING}", f"--print-to-pdf={path.resolve()}", page.resolve().as_uri()]
        command += ["--no-sandbox"] if os.geteuid() == 0 else []
        try:
            made = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
        except subprocess.TimeoutExpired:
            raise PrintError(f"{Path(program).name} was not done after {LONGEST} s") from None
    if made.returncode != 0 or not path.is_file():
        raise PrintError((made.stderr.strip().splitlines() or [f"{Path(program).name} ended with {made.returncode}"])[-1])
