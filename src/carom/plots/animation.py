"""The patch through an impact, as a film: contact, zones, slip and traction beside the force."""

import shutil
import subprocess
from collections.abc import Callable, Iterable, Iterator, Sized
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any, Unpack

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from PIL import Image

from carom.io.files import ANIMATIONS
from carom.io.paths import checked_output, ending_of, replace_whole
from carom.io.progress import Advance, advancing
from carom.plots import style
from carom.plots.bands import BANDS
from carom.plots.drawing import draws
from carom.plots.impact import FORCES, HISTORY, RADII, force_at, forces_panel, phase_handles
from carom.plots.look import Look
from carom.plots.patch import patch_panel, patch_title
from carom.quantities.refusals import InputError, refusal, refuse

Progress = bool | Callable[[], object] | None

FRAME_RATE = 12  # a second
RESOLUTION = {".gif": 110, ".mp4": 200}  # in dots per inch
MARGIN = 1.08  # around the largest contact


@draws(HISTORY, *FORCES, *RADII, "max_pressure", along="time")
def animate(
    history: xr.Dataset,
    frames: Iterable[xr.Dataset],
    path: str | Path,
    progress: Progress = None,
    **look: Unpack[Look],
) -> Path:
    """Store a film of the contact patch beside the history of the tangential force.

    A file that is there is replaced whole or not at all.

    Parameters
    ----------
    history : xarray.Dataset
        The impact, what `Impact.history` returns.
    frames : iterable of xarray.Dataset
        The fields on a grid at the instants of the film, in order; they are drawn as they come.
    path : str or Path
        A name that ends in .gif, or in .mp4 where ffmpeg is installed.
    progress : bool or callable, optional
        As for `carom.sweep`; a function is called after every frame.

    Returns
    -------
    pathlib.Path
        The file that was written.

    Raises
    ------
    InputError
        If the name ends otherwise, ffmpeg is missing, there are no frames, or the file cannot be
        written.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     frames = (hit.fields(time) for time in (6e-6, 21e-6))
    ...     carom.plots.animate(hit.history(50), frames, folder + "/hit.gif").name
    'hit.gif'
    """
    target = checked_animation(path)
    ending = ending_of(target, ANIMATIONS)
    total = len(frames) if isinstance(frames, Sized) else None
    shown_progress = (lambda *_: progress()) if callable(progress) else progress
    with advancing("animation", total, shown_progress, unit="frames") as advance:
        film = _Film(history, RESOLUTION[ending], advance)
        pictures = map(film.picture, frames)
        first = next(pictures, None)
        if first is None:
            raise InputError("frames: an animation needs the fields of one instant or more")
        write = _write_gif if ending == ".gif" else _write_mp4
        return replace_whole(target, lambda where: write(where, chain([first], pictures)), ending)


def checked_animation(path: str | Path) -> Path:
    """Return the path of an animation, if it can be made.

    Parameters
    ----------
    path : str or Path
        A name that ends in .gif, or in .mp4.

    Returns
    -------
    pathlib.Path
        The path.

    Raises
    ------
    InputError
        If it ends otherwise, cannot be written, or ffmpeg is missing for .mp4.

    Examples
    --------
    >>> carom.plots.checked_animation("hit.gif").name
    'hit.gif'
    """
    target = checked_output(path, ANIMATIONS)
    if ending_of(target, ANIMATIONS) == ".mp4" and shutil.which("ffmpeg") is None:
        raise refusal("output file", str(path), "ffmpeg is not found; install it, or use .gif")
    return target


class _Film:
    """The figure of the film: the patch redrawn for every frame, the force drawn once."""

    def __init__(self, history: xr.Dataset, resolution: int, advance: Advance) -> None:
        self.history, self.advance = history, advance
        self.figure, axes = style.new_figure(
            1, 2, width=style.DOUBLE, height=74.0, width_ratios=(1.0, 1.15)
        )
        self.canvas: Any = FigureCanvasAgg(self.figure)
        self.figure.dpi = resolution
        self.patch, self.force = axes[0]
        forces_panel(self.force, history)
        self.figure.legend(handles=phase_handles(history), loc="outside lower center", ncols=5)
        self.line = self.force.axvline(0.0, color=style.BLACK, lw=0.8)
        (self.dot,) = self.force.plot([0.0], [0.0], "o", color=style.BLACK, ms=5.0, zorder=5)
        self.still: Any = None

    def picture(self, fields: xr.Dataset) -> Image.Image:
        style.check_grid(fields, "traction_x", "y", "x")
        self._draw_patch(fields)
        time, force = force_at(self.history, fields)
        self.line.set_xdata([time, time])
        self.dot.set_data([time], [force])
        moving = (self.patch, self.line, self.dot)
        if self.still is None:
            self.still = self._draw_still(moving)
        self.canvas.restore_region(self.still)
        for artist in moving:
            self.figure.draw_artist(artist)
        self.advance(1)
        return Image.fromarray(np.asarray(self.canvas.buffer_rgba())[..., :3].copy())

    def _draw_still(self, moving: tuple[Artist, ...]) -> Any:
        """Return what is the same in all frames, laid out with room for the rest."""
        layout: Any = self.figure.get_layout_engine()
        layout.execute(self.figure)
        self.figure.set_layout_engine("none")
        for artist in moving:
            artist.set_visible(False)
        self.canvas.draw()
        for artist in moving:
            artist.set_visible(True)
        return self.canvas.copy_from_bbox(self.figure.bbox)

    def _draw_patch(self, fields: xr.Dataset) -> None:
        history = self.history
        largest = float(history["friction"]) * float(history["max_pressure"])
        scale, unit = style.prefixed(largest, "Pa")
        reach = MARGIN * float(history["contact_radius"].max())
        self.patch.clear()
        colours = style.colours("traction_x", largest * scale)
        shading = patch_panel(self.patch, fields, "traction_x", scale, reach=reach, **colours)
        title = patch_title(fields, reach, like=history["time"].values)
        self.patch.set_title(title if "\n" in title else title + "\n ")
        if self.still is None:
            text = style.label("traction_x", unit)
            self.figure.colorbar(shading, ax=self.patch, label=text, pad=0.02, aspect=28)


def _write_gif(where: Path, pictures: Iterator[Image.Image]) -> None:
    palette = _palette()
    frames = (picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures)
    next(frames).save(
        where, save_all=True, append_images=frames, duration=round(1000 / FRAME_RATE), loop=0
    )


def _palette() -> Image.Image:
    """Return an image with the colours of a GIF: the same for all frames, so that none flickers."""
    shades = matplotlib.colormaps[style.SIGNED_MAP](np.linspace(0.0, 1.0, 112))[:, :3]
    hatched = 0.4 * shades[::4] + 0.6 * 0.5  # by lines of grey, see `patch_panel`
    tints = (color for band in BANDS.values() for color in (band.face, band.edge))
    mixed = [to_rgb(ink) for ink in dict.fromkeys([style.BLUE, style.BLACK, *tints])]
    faded = [0.5 * np.array(color) + 0.5 for color in mixed]
    greys = np.repeat(np.linspace(0.0, 1.0, 32)[:, np.newaxis], 3, axis=1)
    colors = np.vstack([shades, hatched, mixed, faded, greys])
    image = Image.new("P", (1, 1))
    image.putpalette(np.round(255.0 * colors).astype(np.uint8).tobytes())
    return image


def _write_mp4(where: Path, pictures: Iterator[Image.Image]) -> None:
    first = next(pictures)
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{first.width}x{first.height}", "-r", str(FRAME_RATE), "-i", "-"]
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p"]
    command.append(str(where))
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stderr=pipe) as encoder:
        into: Any = encoder.stdin
        with suppress(BrokenPipeError):  # ffmpeg has given up, and says why below
            for picture in chain([first], pictures):
                into.write(picture.tobytes())
        said = encoder.communicate()[1].decode(errors="replace").strip()
    refuse(encoder.returncode and f"output file: ffmpeg failed; {said}")
