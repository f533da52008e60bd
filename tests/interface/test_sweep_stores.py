"""A store holds one sweep of one version, of one process, and nothing else is ever touched."""

import errno
import os
import subprocess
import sys
from itertools import count
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.checks import refused

import carom
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import Grid, LatinHypercube, boxes, chunk_shape, points_in
from carom.many.sweeps.points import PointStatus
from carom.many.sweeps.problem import SweepProblem
from carom.many.sweeps.records import SweepStopped
from carom.many.sweeps.tables import Table

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "friction": 0.2}
CASE |= {"speed": "2 m/s", "angle": "30 deg"}
GRID = Grid({"angle": np.linspace(0.0, 1.2, 7), "friction": [0.1, 0.2, 0.3]})
DESIGNS = {
    "grid": GRID,
    "materials": Grid({"first.material": ["steel", "nylon"], "angle": ["10 deg", "40 deg"]}),
    "hypercube": LatinHypercube({"angle": (0.0, 1.2), "first.radius": (1e-3, 9e-3)}, samples=9),
    "nothing solved": Table({"angle": [0.1, 0.2], "speed": [-1.0, -2.0]}),
    "table with faults": Table({"angle": [0.1, 0.2, np.nan], "speed": [1.0, -1.0, 2.0]}),
}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "sweep.zarr"


def files(folder: Path) -> dict[Path, bytes]:
    return {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}


@pytest.mark.first_case
@pytest.mark.parametrize("name", DESIGNS)
def test_store_and_memory_hold_the_same_dataset(path, name):
    kept = sweep(CASE, DESIGNS[name])
    stored = sweep(CASE, DESIGNS[name], store=path)
    assert kept.identical(stored.load())
    assert list(kept.data_vars) == list(stored.data_vars)
    plain = xr.open_zarr(path, chunks=None)
    for variable in kept.variables:
        assert plain[variable].values.tobytes() == kept[variable].values.tobytes()
        assert plain[variable].attrs.keys() == kept[variable].attrs.keys()
    assert plain.attrs == kept.attrs
    assert plain.attrs["Conventions"].startswith("CF-")


def test_values_of_a_store_are_read_when_they_are_used(path):
    stored = sweep(CASE, GRID, store=path)
    assert not stored["rebound_angle"].variable._in_memory
    assert np.isfinite(stored["rebound_angle"].values).all()


@pytest.mark.parametrize(
    "shape",
    [(1,), (1000,), (999_983,), (10_000_000,), (86, 5), (100, 400), (3, 7, 11, 13), (2, 10**6)],
)
def test_blocks_cover_every_point_once_and_stay_small(shape):
    chunk = chunk_shape(shape)
    whole = list(boxes(shape, chunk))
    assert sum(points_in(box) for box in whole) == np.prod(shape)
    assert len({tuple(part.start for part in box) for box in whole}) == len(whole)
    assert max(points_in(box) for box in whole) == np.prod(chunk) <= 2**14


def test_finished_sweep_is_continued_without_computing_anything(path, monkeypatch):
    first = sweep(CASE, GRID, store=path).load()
    before = files(path)
    monkeypatch.setattr(SweepProblem, "block", None)
    assert first.identical(sweep(CASE, GRID, store=path, resume=True).load())
    assert before == files(path)


def test_resume_begins_where_nothing_is(path):
    assert sweep(CASE, GRID, store=path, resume=True).status.max() == 0


class Killed(BaseException):
    """Stands for a kill: nothing handles it."""


def test_killed_before_or_after_any_of_its_files_it_ends_in_the_same_bits(tmp_path, monkeypatch):
    """A block counts as finished exactly when the last of its three files is in its place."""
    monkeypatch.setattr("carom.many.sweeps.designs.FEWEST", 12)
    outputs = ["rebound_angle", "spin_out"]
    truth = sweep(CASE, GRID, outputs=outputs)
    blocks, files_of_a_block = 2, 3
    for instant in range(2 * blocks * files_of_a_block):
        path = tmp_path / f"{instant}.zarr"
        with monkeypatch.context() as doomed:
            doomed.setattr("os.replace", killed_at(instant))
            with pytest.raises(Killed):
                sweep(CASE, GRID, outputs=outputs, store=path)
        with monkeypatch.context() as counted:
            counted.setattr(SweepProblem, "block", logged := Logged(SweepProblem.block))
            result = sweep(CASE, GRID, outputs=outputs, store=path, resume=True)
        assert len(logged.boxes) == blocks - (instant + 1) // 2 // files_of_a_block
        assert truth.identical(result.load())


def killed_at(instant: int):
    """Return a way to put files in their place that is killed before, or after, one of them."""
    replace, calls = os.replace, count()

    def doomed(partial, target):
        if Path(target).parent.parent.name != "c":  # not a chunk of a block
            return replace(partial, target)
        number = next(calls)
        if instant == 2 * number:
            raise Killed
        replace(partial, target)
        if instant == 2 * number + 1:
            raise Killed
        return None

    return doomed


@pytest.mark.parametrize("fails", range(6))
def test_a_write_that_fails_leaves_no_status_without_its_values(tmp_path, monkeypatch, fails):
    """Whichever file does not get on the disk: a reader is told of no point that is not there."""
    monkeypatch.setattr("carom.many.sweeps.designs.FEWEST", 12)
    outputs, path = ["rebound_angle", "spin_out"], tmp_path / "sweep.zarr"
    replace, calls = os.replace, count()

    def full(partial, target):
        if Path(target).parent.parent.name == "c" and next(calls) == fails:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return replace(partial, target)

    with monkeypatch.context() as doomed:
        doomed.setattr("os.replace", full)
        words = f"free some space; {fails // 3} of 2 blocks are safe"
        with pytest.raises(SweepStopped, match=words):
            sweep(CASE, GRID, outputs=outputs, store=path)
    there = carom.read(path)
    answer = there.status.values != PointStatus.NOT_RUN
    assert answer.any() == (fails >= 3)
    for name in outputs:
        assert np.all(np.isfinite(there[name].values[answer]))
    truth = sweep(CASE, GRID, outputs=outputs)
    assert truth.identical(sweep(CASE, GRID, outputs=outputs, store=path, resume=True).load())


class Logged:
    """A method that remembers for which blocks it was called."""

    def __init__(self, method) -> None:
        self.boxes = []
        self._method = method

    def __get__(self, problem, _):
        def block(box, threads=1):
            self.boxes.append(box)
            return self._method(problem, box, threads)

        return block


def test_store_is_refused_without_resume(path):
    sweep(CASE, GRID, store=path)
    words = r"it exists already; --resume \(resume=True\) continues it"
    refused(words, sweep, CASE, GRID, store=path)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("case", "design", "outputs", "words"),
    [
        ({**CASE, "speed": "3 m/s"}, GRID, None, "speed is 2.0 there and 3.0 here"),
        (CASE, Grid({"angle": [0.1, 0.2], "friction": [0.1]}), None, "angle"),
        (CASE, GRID, ["psi_out"], "outputs"),
        ({**CASE, "second": {"kind": "sphere"}}, GRID, None, "second"),
        (CASE, DESIGNS["hypercube"], None, "case.friction is not given there and 0.2 here"),
    ],
)
def test_store_of_another_sweep_is_refused_with_the_difference(path, case, design, outputs, words):
    sweep(CASE, GRID, store=path)
    before = files(path)
    line = refused(words, sweep, case, design, outputs=outputs, store=path, resume=True)
    assert "it holds another sweep: " in line
    assert before == files(path)


def test_long_axes_are_told_apart_without_being_written_twice(path):
    angles = np.linspace(0.0, 1.2, 2000)
    stored = sweep(CASE, Grid({"angle": angles}), outputs=["psi_out"], store=path)
    assert len(stored.attrs["inputs"]) < 2000
    angles[1000] = np.nextafter(angles[1000], 2.0)
    words, other = r"another sweep: design\.axes\.angle\.sha256 is ", Grid({"angle": angles})
    refused(words, sweep, CASE, other, outputs=["psi_out"], store=path, resume=True)


def test_store_of_another_version_is_refused(path, monkeypatch):
    sweep(CASE, GRID, store=path)
    monkeypatch.setattr("carom.many.sweeps.stores.__version__", "9.9")
    words = r"carom \S+ has written it, and this is carom 9\.9"
    refused(words, sweep, CASE, GRID, store=path, resume=True)


def folder(path: Path) -> None:
    path.mkdir()
    (path / "letter.txt").write_text("mine")


def foreign(path: Path) -> None:
    other = xr.Dataset({"status": ("x", [1, 2])}, attrs={"source": "another program"})
    other.to_zarr(path, zarr_format=2)


@pytest.mark.parametrize("resume", [False, True])
@pytest.mark.parametrize("make", [Path.mkdir, Path.touch, folder, foreign])
def test_what_is_not_a_store_of_carom_is_refused_and_left_as_it_is(path, make, resume):
    make(path)
    before = files(path.parent)
    refused("store: ", sweep, CASE, GRID, store=path, resume=resume)
    assert before == files(path.parent)
    assert path.exists()


def test_without_the_packages_of_the_extra_one_line_says_how_to_get_them(path, monkeypatch):
    for module in ("carom.io.stores", "carom.many.sweeps.stores"):
        monkeypatch.delitem(sys.modules, module, raising=False)
    monkeypatch.setitem(sys.modules, "zarr", None)
    monkeypatch.setitem(sys.modules, "distributed", None)
    words = r"needs the package zarr; pip install 'carom\[cluster\]'"
    refused(words, sweep, CASE, GRID, store=path)
    words = "needs the package distributed; pip install 'carom"
    refused(words, sweep, CASE, GRID, scheduler="tcp://127.0.0.1:1")
    assert not path.exists()


MEMORY = """
import sys
from pathlib import Path
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import LatinHypercube

# gross slip: points that cost little
case = {"first": {"radius": "5 mm", "material": "steel"}, "friction": 0.01, "speed": "2 m/s"}
for number, samples in enumerate((20_000, 300_000)):
    design = LatinHypercube({"angle": ("40 deg", "80 deg")}, samples=samples)
    sweep(case, design, store=f"{sys.argv[1]}/{number}.zarr")
    words = Path("/proc/self/status").read_text().split()
    print(int(words[words.index("VmHWM:") + 1]) / 1024)
"""


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="tells peak memory on Linux")
def test_memory_does_not_grow_with_the_points(tmp_path):
    """The results of the larger sweep take 41 MB, fifteen times those of the smaller."""
    command = [sys.executable, "-c", MEMORY, str(tmp_path)]
    out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    few, many = map(float, out.split())
    assert many - few < 25.0
    assert many < 500.0
