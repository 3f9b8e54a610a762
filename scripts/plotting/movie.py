"""A movie of the free surface: MP4 (H.264, yuv420p), one camera and one scale of colours at all times, the time in the picture.

imageio-ffmpeg brings the encoder."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import slagflow
from plotting import sheet, surface
from plotting.quantity import QUANTITIES, shared

DPI, HEAD, FOOT, TALL, NARROWEST, WIDEST = 150, 0.8, 0.5, 5.9, 5.6, 12.8  # inches: 1080 pixels high at most
PIXELS = int(DPI * TALL)  # along the longer side of the view
QUALITY = "20"  # constant rate factor of H.264: 18 is taken for free of loss, 23 is usual


def encoder():
    """imageio_ffmpeg. Raises SurfaceError when it, or the ffmpeg in it, is missing."""
    try:
        import imageio_ffmpeg
        imageio_ffmpeg.get_ffmpeg_exe()
    except (ImportError, RuntimeError) as missing:
        raise surface.SurfaceError(f"{missing}: `scripts/install --pictures` brings what encodes movies; scripts/plot DIR --movie makes a GIF without") from missing
    return imageio_ffmpeg


class Frames:
    """The frames of a run's movie, all drawn on one figure."""

    def __init__(self, run, steps, colour, rate):
        quantity = shared([run], [steps], colour)[0]
        box = surface.box_of([run], [steps])
        self._run, self._steps = run, steps
        self._camera = surface.Camera(surface.Meshes(run, quantity), box, surface.frame_of([run], [steps], box), PIXELS)
        picture = self._camera.picture(steps[0])
        shape = picture.shape[1] / picture.shape[0]
        tall = min(TALL, WIDEST / shape)
        wide = max(NARROWEST, tall * shape)
        total = tuple(2 * round(DPI / 2 * length) / DPI for length in (wide, HEAD + tall + FOOT))  # an even number of pixels
        self.figure = plt.figure(figsize=total, dpi=DPI, facecolor="white")
        axes = self.figure.add_axes([0, FOOT / total[1], 1, tall / total[1]])
        axes.axis("off")
        self._image = axes.imshow(picture, interpolation="antialiased")
        self._time = self.figure.text(0.02, 1 - 0.2 / total[1], "", fontsize=13, va="center", weight="bold")
        self.figure.text(0.5, 1 - 0.2 / total[1], run.title.replace("_", " "), fontsize=12, ha="center", va="center")
        sheet.colour_key(self.figure, [run], quantity, total)
        words = "\n".join([sheet.caption(run), speed_in_words(run.times[steps], rate)]).strip()
        self.figure.text(0.5, 0.5 * FOOT / total[1], words, ha="center", va="center", fontsize=7.5, color="0.35", linespacing=1.4)

    @property
    def size(self):
        """Pixels across and down."""
        return self.figure.canvas.get_width_height()

    def __iter__(self):
        """Each frame as bytes, shape (down, across, 3)."""
        digits = decimals(self._run.times[self._steps])
        for step in self._steps:
            self._image.set_data(self._camera.picture(step))
            self._time.set_text(f"t = {self._run.times[step]:.{digits}f} s")
            self.figure.canvas.draw()
            yield np.ascontiguousarray(np.asarray(self.figure.canvas.buffer_rgba())[:, :, :3])


def decimals(times):
    """Of times [s], that tell one from the next."""
    interval = np.diff(times).min() if len(times) > 1 else 1.0
    return int(np.clip(np.ceil(-np.log10(interval) - 1e-3), 0, 6))


def speed_in_words(times, rate):
    """How fast a movie of frames at these times [s] runs, `rate` of them a second."""
    if len(times) < 2:
        return ""
    return f"shown at {(times[-1] - times[0]) / (len(times) - 1) * rate:.2g} times its true speed"


def write(run, colour, path, rate):
    """Writes the movie, a frame for each snapshot, `rate` a second. Raises SurfaceError, OSError, KeyError (a field was not written)."""
    ffmpeg = encoder()
    frames = Frames(run, list(range(len(run.times))), colour, rate)
    made = ffmpeg.write_frames(str(path), frames.size, fps=rate, codec="libx264", pix_fmt_out="yuv420p", quality=None, macro_block_size=2,
                               output_params=["-crf", QUALITY, "-movflags", "+faststart"], ffmpeg_log_level="error")
    made.send(None)
    for frame in frames:
        made.send(frame)
    made.close()
    plt.close(frames.figure)


def main():
    """Called by scripts/movie with the Python that has the tools."""
    parser = argparse.ArgumentParser(prog="plotting.movie", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--colour", choices=QUANTITIES, default="speed")
    parser.add_argument("--rate", type=float, default=12.0)
    arguments = parser.parse_args()
    try:
        surface.tools(), encoder()
        write(slagflow.open(arguments.folder), arguments.colour, arguments.output, arguments.rate)
    except (surface.SurfaceError, slagflow.RunError, OSError) as error:
        print(error)
        return 1
    except KeyError as error:
        print(f"the run has not written what {arguments.colour!r} needs: {error}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
