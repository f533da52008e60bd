"""Animations: one picture for every instant, stored whole or not at all."""

import os
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from PIL.ImageSequence import Iterator
from tests.checks import refused

from carom.plots import animate


@pytest.fixture(scope="module")
def history(hit):
    return hit.history(60)


@pytest.fixture(scope="module")
def frames(hit):
    return [hit.fields(time) for time in (5e-6, 14e-6, 21e-6, 28e-6)]


def fake_ffmpeg(folder, monkeypatch, script):
    """Put a program called ffmpeg first on the path."""
    program = folder / "ffmpeg"
    program.write_text("#!/bin/sh\n" + script)
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


@pytest.mark.slow
def test_gif_has_a_picture_for_every_instant(history, frames, tmp_path):
    calls = []
    path = animate(history, iter(frames), tmp_path / "hit.gif", progress=lambda: calls.append(1))
    assert len(calls) == 4
    with Image.open(path) as film:
        assert film.n_frames == 4
        assert film.width == pytest.approx(178.0 / 25.4 * 110, abs=1.0)
        pictures = [np.asarray(frame.convert("RGB"), dtype=float) for frame in Iterator(film)]
    assert np.all(pictures[0][:3, :3] == 255.0)
    half = pictures[0].shape[1] // 2
    for one, other in pairwise(pictures):
        changed = np.any(one != other, axis=2)
        assert changed[:, :half].mean() > 0.05  # the patch changes
        assert 0.0 < changed[:, half:].mean() < 0.05  # the force stays, but for the marker


def test_mp4_without_ffmpeg_says_what_to_do(history, frames, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    words = r"ffmpeg is not found; install it, or use \.gif"
    refused(words, animate, history, frames, tmp_path / "hit.mp4")
    assert not list(tmp_path.iterdir())


def test_mp4_gives_ffmpeg_every_pixel(history, frames, tmp_path, monkeypatch):
    """The encoder is told the size and gets width x height x 3 bytes for every instant."""
    fake_ffmpeg(tmp_path, monkeypatch, 'for last; do :; done\necho "$@" > args\ncat > "$last"\n')
    monkeypatch.chdir(tmp_path)
    path = animate(history, frames, tmp_path / "hit.mp4")
    words = (tmp_path / "args").read_text().split()
    width, height = map(int, words[words.index("-s") + 1].split("x"))
    assert path.stat().st_size == 4 * width * height * 3


def test_a_file_survives_when_ffmpeg_fails(history, frames, tmp_path, monkeypatch):
    fake_ffmpeg(tmp_path, monkeypatch, "echo no such codec >&2\nexit 1\n")
    target = tmp_path / "hit.mp4"
    target.write_bytes(b"before")
    refused("ffmpeg failed; no such codec", animate, history, frames, target)
    assert target.read_bytes() == b"before"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ffmpeg", "hit.mp4"]


def test_a_file_survives_when_an_instant_fails(hit, history, frames, tmp_path):
    """The error of an instant outside the contact comes through; the old file stays."""
    target = tmp_path / "hit.gif"
    target.write_bytes(b"before")
    instants = (fields if fields is not None else hit.fields(1.0) for fields in [frames[0], None])
    refused("at", animate, history, instants, target)
    assert target.read_bytes() == b"before"
    assert [path.name for path in tmp_path.iterdir()] == ["hit.gif"]


@pytest.mark.parametrize("name", ["hit.avi", "hit", "no/hit.gif"])
def test_names_that_cannot_be_are_refused_before_drawing(history, tmp_path, name):
    def undrawn():
        raise AssertionError("drawn")
        yield

    refused("output file", animate, history, undrawn(), tmp_path / name)


def test_no_frames_is_refused(history, tmp_path):
    refused("frames", animate, history, [], tmp_path / "hit.gif")
