"""Stored files that are damaged: what is read is what was stored, or one line says that it is not.

Whatever happens to the bytes of a file, `carom.read` gives a dataset that is equal to the stored
one to the last bit, or raises InputError; no other error, no warning, nothing printed.
"""

import gc
import os
import random
import shutil
import sys
import warnings

import numpy as np
import pytest

import carom
from carom.io.labels import flags, labelled_dataset
from carom.io.stores import FROZEN

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 1.0, "friction": 0.1}
GRID = carom.Grid({"angle": np.linspace(0.0, 1.2, 40), "spin": np.linspace(-300.0, 300.0, 60)})


def history():
    """An impact: numbers along time, scalars, words."""
    ball, wall = carom.Sphere(radius=0.005, material="steel"), carom.HalfSpace(material="glass")
    hit = carom.impact(carom.Pair(ball, wall, friction=0.2), speed=2.0, angle=0.5)
    return hit.history(9)


def table():
    """A grid with NaN, words to quote, truth values, flags, and numbers of several types."""
    rng = np.random.default_rng(3)
    wide = ("y", "x")
    numbers = rng.normal(size=(3, 4))
    numbers[0, :3] = np.nan, np.inf, -0.0
    return labelled_dataset(
        {
            "pressure": (wide, numbers),
            "zone": (wide, rng.integers(0, 2, (3, 4)).astype(np.int8), flags(("out", "in"))),
            "sticks": (wide, numbers > 0.0, {"long_name": "whether it sticks"}),
            "note": (wide, np.full((3, 4), 'a, "b"\r\nµ; #1'), {"long_name": "words"}),
        },
        {"x": [0.0, 0.1, 0.2, 0.3], "y": [-1.0, 0.0, 1.0]},
        {"title": "fields", "limits": np.array([0.1, np.inf]), "phase_sign": -1},
    )


def turned(content, rng):
    """Some bytes changed, one bit or all of them."""
    content = bytearray(content)
    for _ in range(rng.choice([1, 1, 1, 2, 5])):
        place = rng.randrange(len(content))
        content[place] = rng.choice([content[place] ^ 1 << rng.randrange(8), rng.randrange(256)])
    return bytes(content)


def cut(content, rng):
    return content[: rng.randrange(len(content))]


def blanked(content, rng):
    """A stretch of zeros, as a lost block of a disk leaves it."""
    start = rng.randrange(len(content))
    stop = min(len(content), start + rng.choice([1, 16, 512, 4096]))
    return content[:start] + bytes(stop - start) + content[stop:]


def lost(content, rng):
    start = rng.randrange(len(content))
    return content[:start] + content[start + rng.choice([1, 2, 8, 100]) :]


def doubled(content, rng):
    start = rng.randrange(len(content))
    stop = start + rng.choice([1, 2, 8, 100])
    return content[:stop] + content[start:stop] + content[stop:]


def swapped(content, rng):
    """Two stretches in each other's place."""
    a, b, c, d = sorted(rng.randrange(len(content)) for _ in range(4))
    return content[:a] + content[c:d] + content[b:c] + content[a:b] + content[d:]


def lengthened(content, rng):
    return content + rng.choice([b"\n", b"\0", b"1,2,3\n", content, rng.randbytes(50)])


def replaced(content, rng):
    """Something else with the beginning of such a file."""
    return content[: rng.choice([0, 8, 16, 100])] + rng.randbytes(rng.choice([0, 10, 3000]))


MUTATIONS = [turned, turned, turned, cut, blanked, lost, doubled, swapped, lengthened, replaced]


class Silence:
    """Whatever a process would show: warnings, what is printed, errors in destructors."""

    def __init__(self, capfd, monkeypatch):
        self.heard = []
        self._capfd = capfd
        monkeypatch.setattr(sys, "unraisablehook", lambda answer: self.heard.append(str(answer)))

    def check(self, what):
        out, err = self._capfd.readouterr()
        assert (out, err, self.heard) == ("", "", []), what


@pytest.fixture
def silence(capfd, monkeypatch):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield Silence(capfd, monkeypatch)


def same(one, other):
    """Whether two datasets are the same to the last bit, with all that is told of them."""
    return one.identical(other) and all(
        one[name].dtype == item.dtype
        and (item.dtype.kind not in "fiub" or one[name].values.tobytes() == item.values.tobytes())
        for name, item in other.variables.items()
    )


def read_or_refused(path):
    """Return the dataset, or None if it is refused in one line."""
    try:
        return carom.read(path).load()
    except carom.InputError as error:
        text = str(error)
    assert "\n" not in text
    assert text.startswith(("file: ", "store: "))
    return None


@pytest.mark.parametrize("make", [history, table])
def test_a_damaged_file_is_read_as_it_was_or_refused(make, calls, tmp_path, silence):
    stored, path = make(), tmp_path / "file.nc"
    content = carom.save(stored, path).read_bytes()
    rng, refused = random.Random(0), 0
    count = calls // 8
    for number in range(count):
        mutation = rng.choice(MUTATIONS)
        damaged = mutation(content, rng)
        if damaged == content:  # zeros where there were zeros
            continue
        path.write_bytes(damaged)
        actual = read_or_refused(path)
        refused += actual is None
        assert actual is None or same(actual, stored), (number, mutation.__name__)
    gc.collect()
    silence.check(make.__name__)
    assert refused > 0.8 * count


def test_a_damaged_store_is_read_as_it_was_or_refused(calls, tmp_path, silence):
    """Any file of it; a block whose status is lost counts as not run, the others are whole."""
    path, kept = tmp_path / "sweep.zarr", tmp_path / "kept.zarr"
    with warnings.catch_warnings():
        warnings.simplefilter("default")
        stored = carom.sweep(CASE, GRID, store=kept, progress=False).load()
    shutil.copytree(kept, path)
    names = sorted(str(x.relative_to(kept)) for x in kept.rglob("*") if x.is_file())
    names.remove("status/.lock")
    rng, refused = random.Random(2), 0
    count = calls // 40
    for number in range(count):
        name = rng.choice(names)
        content = (kept / name).read_bytes()
        mutation = rng.choice([*MUTATIONS, None])
        if mutation is None:
            os.remove(path / name)
        else:
            (path / name).write_bytes(mutation(content, rng))
        actual = read_or_refused(path)
        refused += actual is None
        if mutation is None and name.startswith("status/c/"):
            run = actual.status != carom.status.PointStatus.NOT_RUN
            assert not run.all()
            assert actual.where(run).identical(stored.where(run))
        else:
            assert actual is None or same(actual, stored), (number, name)
        (path / name).write_bytes(content)
    gc.collect()
    silence.check("zarr")
    assert refused > 0.6 * count
    assert FROZEN in names
