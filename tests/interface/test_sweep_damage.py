"""Stores that lack something, or are of a sweep that only looks alike."""

import json
import pickle
import shutil
import subprocess

import numpy as np
import pytest
import xarray as xr
from tests.checks import refused

import carom
from carom.io.stores import FROZEN, freeze

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 1.0, "angle": 0.4}
AXES = {
    "friction": {"from": 0.05, "to": 0.5, "points": 6},
    "spin": {"from": -300.0, "to": 300.0, "points": 1200},
}
GRID = carom.Grid(AXES)
OUTPUTS = ["chi", "psi_out", "rebound_speed"]


def swept(path, design=GRID, resume=True):
    return carom.sweep(CASE, design, outputs=OUTPUTS, store=path, resume=resume)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A finished store of six blocks, and its values."""
    path = tmp_path_factory.mktemp("stores") / "whole.zarr"
    return path, swept(path, resume=False).load()


@pytest.fixture
def copy(whole, tmp_path):
    path = tmp_path / "copy.zarr"
    shutil.copytree(whole[0], path)
    return path


def chunks(path, name):
    return sorted(file for file in (path / name / "c").rglob("*") if file.is_file())


def test_a_store_is_read_like_any_other_file(whole):
    """`carom.read` gives what the sweep returned."""
    assert carom.read(whole[0]).load().identical(whole[1])
    refused(r"must end in \.nc, or be the store", carom.read, whole[0].with_name("none.zarr"))


def flipped(content, place):
    """The bytes with one bit of one of them turned."""
    content = bytearray(content)
    content[int(place * (len(content) - 1))] ^= 8
    return bytes(content)


DAMAGE = {
    "deleted": lambda content: None,
    "empty": lambda content: b"",
    "cut": lambda content: content[:20],
    "one byte short": lambda content: content[:-1],
    "zeros": lambda content: bytes(len(content)),
    "twice": lambda content: 2 * content,
    "first bit": lambda content: flipped(content, 0.0),
    "bit within": lambda content: flipped(content, 0.6),
    "last bit": lambda content: flipped(content, 1.0),
}


def damage(file, how):
    content = DAMAGE[how](file.read_bytes())
    if content is None:
        file.unlink()
    else:
        file.write_bytes(content)


@pytest.mark.first_case
@pytest.mark.parametrize("how", DAMAGE)
@pytest.mark.parametrize("name", ["status", "psi_out"])
def test_damaged_chunk_is_found_and_computed_again(name, how, whole, copy):
    """Only that block is written anew, and the result is the same to the last bit."""
    files = chunks(copy, "chi")
    assert len(files) > 2
    before = [file.stat().st_mtime_ns for file in files]
    damage(chunks(copy, name)[1], how)
    assert swept(copy).load().identical(whole[1])
    after = [file.stat().st_mtime_ns for file in files]
    written = [a != b for a, b in zip(after, before, strict=True)]
    assert written == [False, True, *[False] * (len(files) - 2)]


@pytest.mark.parametrize("how", DAMAGE)
def test_damaged_chunk_is_never_read_as_numbers(how, whole, copy):
    """The file is named when its values are used, and only then."""
    from carom.many.sweeps.records import summary

    file = chunks(copy, "rebound_speed")[1]
    damage(file, how)
    assert carom.read(copy).psi_out.identical(whole[1].psi_out)
    key = str(file.relative_to(copy))
    for use in (xr.Dataset.load, summary, lambda x: x.rebound_speed.values):
        refused(f"{key} is damaged; --resume", use, carom.read(copy))


@pytest.mark.parametrize("use", [xr.Dataset.load, lambda x: x.status.values])
def test_a_missing_status_of_a_block_that_is_there_is_told(use, whole, copy):
    """The status is written last: alone, it does not lack because the block has not been run."""
    file = chunks(copy, "status")[0]
    file.unlink()
    key = file.relative_to(copy)
    refused(f"{key} is damaged; --resume", use, carom.read(copy))
    assert swept(copy).load().identical(whole[1])


@pytest.mark.parametrize("also", ["psi_out", "chi"])
def test_a_block_without_status_and_something_else_counts_as_not_run(also, whole, copy):
    """As where the process was killed as it wrote: NOT_RUN there, and everything else as it was."""
    for name in ("status", also):
        chunks(copy, name)[0].unlink()
    dataset = carom.read(copy).load()
    again = dataset.status != carom.status.PointStatus.NOT_RUN
    assert 0 < int((~again).sum()) < again.size
    assert dataset.where(again, drop=False).identical(whole[1].where(again, drop=False))
    assert swept(copy).load().identical(whole[1])


@pytest.mark.first_case
@pytest.mark.parametrize("how", DAMAGE)
@pytest.mark.parametrize("resume", [False, True], ids=["read", "resumed"])
def test_everything_else_that_is_damaged_is_refused(how, resume, copy):
    """Descriptions and coordinates: one line that names the file, and nothing is written."""
    frozen = [f for f in copy.rglob("*") if f.is_file() and f.name != ".lock"]
    frozen = [f for f in frozen if "c" not in f.relative_to(copy).parts[1:2] or is_axis(copy, f)]
    assert len(frozen) > len(AXES) + len(OUTPUTS)
    for file in frozen:
        kept = file.read_bytes()
        if file.name == ".sha256sums" and how in ("deleted", "one byte short", "twice"):
            continue  # it says the same, or the store is older, see below
        damage(file, how)
        refused(r"^store: .* cannot be used; ", swept if resume else carom.read, copy)
        file.write_bytes(kept)
    carom.read(copy).load()


def is_axis(store, file):
    return file.relative_to(store).parts[0] in AXES


def test_checksums_are_those_that_the_shell_computes(copy):
    """`sha256sum -c` in the folder of the store agrees."""
    done = subprocess.run(["sha256sum", "-c", FROZEN], cwd=copy, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "zarr.json: OK" in done.stdout


def test_what_is_read_when_it_is_used_can_be_pickled(whole, copy):
    """Before its values are read, and checked there, too."""
    assert pickle.loads(pickle.dumps(carom.read(copy))).load().identical(whole[1])
    lazy = pickle.dumps(carom.read(copy).psi_out)
    damage(chunks(copy, "psi_out")[0], "cut")
    refused("psi_out/c/0/0 is damaged", pickle.loads(lazy).load)


@pytest.mark.parametrize(
    "design",
    [
        carom.Grid({name: AXES[name] for name in reversed(AXES)}),
        carom.Grid(AXES | {"friction": {"from": 0.05, "to": 0.5, "points": 6, "spacing": "log"}}),
    ],
)
def test_other_order_of_axes_is_another_sweep(copy, design):
    """Otherwise blocks would be filled with the values of other points."""
    refused("another sweep", swept, copy, design)


def test_other_order_of_ranges_is_another_sweep(tmp_path):
    """The permutation of a range goes by its place."""
    ranges = {"friction": (0.1, 0.5), "spin": (-1.0, 1.0)}
    path = tmp_path / "samples.zarr"
    carom.sweep(CASE, carom.LatinHypercube(ranges, samples=9, seed=1), store=path)
    turned = carom.LatinHypercube(dict(reversed(ranges.items())), samples=9, seed=1)
    refused("another sweep", carom.sweep, CASE, turned, store=path, resume=True)


def test_folder_of_something_else_is_never_touched(tmp_path):
    other = tmp_path / "other.zarr"
    other.mkdir()
    (other / "mine.txt").write_text("mine")
    for resume in (False, True):
        refused("not a store of Carom", swept, other, resume=resume)
    assert [file.name for file in other.iterdir()] == ["mine.txt"]
    assert np.all([file.read_text() == "mine" for file in other.iterdir()])


MISPLACED = {
    "from another block": ("psi_out", 2),
    "from another variable": ("rebound_speed", 1),
    "from another sweep": None,
}


@pytest.mark.first_case
@pytest.mark.parametrize("how", MISPLACED)
@pytest.mark.parametrize("name", ["status", "psi_out", "chi"])
def test_chunk_of_another_place_is_found(name, how, whole, copy, tmp_path):
    """Each is sound in itself; it belongs elsewhere, and is never read as numbers."""
    target = chunks(copy, name)[1]
    if MISPLACED[how] is None:
        other = carom.Grid(AXES | {"friction": {"from": 0.06, "to": 0.5, "points": 6}})
        swept(tmp_path / "other.zarr", other, resume=False)
        source = tmp_path / "other.zarr" / target.relative_to(copy)
    else:
        array, block = MISPLACED[how]
        source = chunks(copy, array if "variable" in how else name)[block]
    shutil.copyfile(source, target)
    key = str(target.relative_to(copy))
    refused(f"{key} is damaged; --resume", lambda: carom.read(copy).load())
    assert swept(copy).load().identical(whole[1])


def test_programs_that_know_no_seals_read_a_store(whole, copy):
    """They pass over them, as they do over any frame that zstd skips."""
    assert xr.open_zarr(copy, chunks=None).psi_out.equals(whole[1].psi_out)


class Touched:
    """What makes a file when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return open, (str(self.path), "w")


PICKLE = {"id": "pickle", "protocol": 5}
OLD_FORMAT = {"zarr_format": 2, "chunks": [6], "dtype": "|O", "order": "C", "fill_value": ""}
FOREIGN = {  # what a node of the metadata is changed to
    "a filter that unpickles": OLD_FORMAT
    | {"compressor": None, "filters": [{"id": "vlen-utf8"}, PICKLE]},
    "a compressor that unpickles": OLD_FORMAT | {"compressor": PICKLE, "filters": None},
    "a codec of another package": {"codecs": [{"name": "bytes"}, {"name": "numcodecs.pickle"}]},
    "codecs within a codec": {"codecs": [{"name": "sharding_indexed", "configuration": {}}]},
    "codecs that are none": {"codecs": 5},
}


@pytest.mark.parametrize("kind", FOREIGN)
@pytest.mark.parametrize("resume", [False, True], ids=["read", "resumed"])
def test_a_store_made_to_run_code_is_refused(kind, resume, copy, tmp_path):
    """Checksums are no protection from those who write them anew."""
    whole = json.loads((copy / "zarr.json").read_bytes())
    nodes = whole["consolidated_metadata"]["metadata"]
    nodes["friction"] = {**nodes["friction"], **FOREIGN[kind]}
    nodes["friction"].setdefault("attributes", {})["_ARRAY_DIMENSIONS"] = ["friction"]
    (copy / "zarr.json").write_text(json.dumps(whole))
    (copy / "friction/0").write_bytes(pickle.dumps([Touched(tmp_path / "run")] * 6))
    (copy / FROZEN).unlink()
    freeze(copy)
    refused("it is not a store of Carom", swept if resume else carom.read, copy)
    assert not (tmp_path / "run").exists()
