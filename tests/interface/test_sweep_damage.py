"""Stores that lack something, or are of a sweep that only looks alike."""

import shutil

import numpy as np
import pytest

import carom

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 1.0, "angle": 0.4}
AXES = {
    "friction": {"from": 0.05, "to": 0.5, "points": 50},
    "spin": {"from": -300.0, "to": 300.0, "points": 1200},
}
GRID = carom.Grid(AXES)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A finished store of 60,000 points, and its values."""
    path = tmp_path_factory.mktemp("stores") / "whole.zarr"
    dataset = carom.sweep(CASE, GRID, store=path)
    return path, dataset.load()


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
    with pytest.raises(carom.InputError, match=r"must end in \.nc or \.csv, or be the store"):
        carom.read(whole[0].with_name("none.zarr"))


@pytest.mark.parametrize("name", ["status", "psi_out"])
def test_chunk_that_is_missing_is_computed_again(whole, copy, name):
    """Only that block is written anew, and the result is the same to the last bit."""
    files = chunks(copy, "chi")
    assert len(files) > 2
    gone = chunks(copy, name)[1]
    before = [file.stat().st_mtime_ns for file in files]
    gone.unlink()
    again = carom.sweep(CASE, GRID, store=copy, resume=True)
    assert again.load().identical(whole[1])
    after = [file.stat().st_mtime_ns for file in files]
    assert [a != b for a, b in zip(after, before, strict=True)] == [False, True] + [False] * (
        len(files) - 2
    )


def test_half_a_status_file_is_computed_again(whole, copy):
    file = chunks(copy, "status")[0]
    file.write_bytes(file.read_bytes()[:20])
    assert carom.sweep(CASE, GRID, store=copy, resume=True).load().identical(whole[1])


def test_half_a_file_of_results_is_named_when_it_is_read(copy):
    from carom.sweeps.summaries import summary

    file = chunks(copy, "rebound_speed")[0]
    file.write_bytes(file.read_bytes()[:20])
    dataset = carom.sweep(CASE, GRID, store=copy, resume=True)
    with pytest.raises(carom.InputError, match=r"rebound_speed: .*damaged; remove it"):
        summary(dataset)


def test_array_that_is_missing_is_refused(copy):
    shutil.rmtree(copy / "psi_out")
    with pytest.raises(carom.InputError, match="damaged: psi_out is missing"):
        carom.sweep(CASE, GRID, store=copy, resume=True)


@pytest.mark.parametrize(
    "design",
    [
        carom.Grid({name: AXES[name] for name in reversed(AXES)}),
        carom.Grid(AXES | {"friction": {"from": 0.05, "to": 0.5, "points": 50, "spacing": "log"}}),
    ],
)
def test_other_order_of_axes_is_another_sweep(copy, design):
    """Otherwise blocks would be filled with the values of other points."""
    with pytest.raises(carom.InputError, match="another sweep"):
        carom.sweep(CASE, design, store=copy, resume=True)


def test_other_order_of_ranges_is_another_sweep(tmp_path):
    """The permutation of a range goes by its place."""
    ranges = {"friction": (0.1, 0.5), "spin": (-1.0, 1.0)}
    path = tmp_path / "samples.zarr"
    carom.sweep(CASE, carom.LatinHypercube(ranges, samples=9, seed=1), store=path)
    turned = carom.LatinHypercube(dict(reversed(ranges.items())), samples=9, seed=1)
    with pytest.raises(carom.InputError, match="another sweep"):
        carom.sweep(CASE, turned, store=path, resume=True)


def test_folder_of_something_else_is_never_touched(tmp_path):
    other = tmp_path / "other.zarr"
    other.mkdir()
    (other / "mine.txt").write_text("mine")
    for resume in (False, True):
        with pytest.raises(carom.InputError, match="not a Zarr store"):
            carom.sweep(CASE, GRID, store=other, resume=resume)
    assert [file.name for file in other.iterdir()] == ["mine.txt"]
    assert np.all([file.read_text() == "mine" for file in other.iterdir()])
