"""Tests of scripts/movie. With a test's name as argument only that one is run."""

import importlib
import subprocess
import sys
import unittest
from unittest import mock

from test_plot import PROJECT, load_script
from test_surface import PYTHON, SurfaceCase

from plotting.movie import decimals, speed_in_words

MOVIE = load_script(PROJECT / "scripts/movie")
READ = """
import sys, imageio_ffmpeg as f, numpy as np
frames = f.read_frames(sys.argv[1])
about = next(frames)
width, height = about["size"]
shots = [np.frombuffer(shot, np.uint8).reshape(height, width, 3).astype(int) for shot in frames]
colour = [int((np.ptp(shot[150:-100], axis=2) > 60).sum()) for shot in shots]  # between scale and caption
print(about["codec"], about["pix_fmt"].split("(")[0], width % 2, height % 2, height, about["fps"], len(shots), *colour, int(np.abs(shots[0] - shots[1]).max()))
"""


class Movie(SurfaceCase):
    def movie(self, *arguments):
        return subprocess.run([PROJECT / "scripts/movie", *map(str, arguments)], capture_output=True, text=True, check=False)

    def test_is_one_that_slides_play_with_a_frame_for_each_time(self):
        self.need_tools()
        folder = self.make_run()
        done = self.movie(folder, "--rate", 10)
        made = folder / "pictures/movie.mp4"
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, "", f"{made}\n"))
        said = subprocess.run([PYTHON, "-c", READ, made], capture_output=True, text=True, check=True).stdout.split()
        self.assertEqual(said[:4], ["h264", "yuv420p", "0", "0"])
        self.assertLessEqual(int(said[4]), 1080)
        self.assertEqual((float(said[5]), said[6]), (10, "2"))
        for pixels in said[7:9]:  # the block is seen, at rest in the colour of the scale's end too
            self.assertGreater(int(pixels), 5000)
        self.assertGreater(int(said[9]), 100)  # the second differs from the first: time and colours

    def test_what_cannot_be_made_is_told(self):
        folder = self.make_run()
        done = self.movie(self.folder / "nothing")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nothing is no folder", done.stderr)
        self.assertIn("allowed: 1 to 60", self.movie(folder, "--rate", 0).stderr)
        with mock.patch.object(MOVIE, "TOP", self.folder), mock.patch.object(sys, "argv", ["movie", str(folder)]), mock.patch("sys.stderr") as errors:
            self.assertEqual(MOVIE.main(), 2)
        told = "".join(str(call.args[0]) for call in errors.write.call_args_list)
        self.assertIn("`scripts/install --pictures` brings what draws surfaces", told)

    def test_without_the_encoder_it_is_named(self):
        movie = importlib.import_module("plotting.movie")
        with mock.patch.dict(sys.modules, {"imageio_ffmpeg": None}), self.assertRaisesRegex(movie.surface.SurfaceError, "imageio_ffmpeg.*GIF without"):
            movie.encoder()

    def test_words_tell_time_and_speed(self):
        self.assertEqual([decimals([0, step, 2 * step]) for step in (5.0, 1.0, 0.1, 0.05, 0.001)], [0, 0, 1, 2, 3])
        self.assertEqual(speed_in_words([0, 0.01, 0.02], 10), "shown at 0.1 times its true speed")
        self.assertEqual(speed_in_words([0.5], 10), "")


if __name__ == "__main__":
    outcome = unittest.main(exit=False).result
    sys.exit(77 if outcome.skipped else not outcome.wasSuccessful())
