"""A disk that is full: one line and exit code 1, whatever is written, and no half of it is left."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.checks import PAIR
from tests.command_line.test_endings import FIT, IMPACT

import carom
from carom.io.paths import Unwritten

ROOT = Path(__file__).parents[2]
SWEEP = ["sweep", "case.toml"]
CASE = """
friction = 0.2
speed = 2.0
[first]
radius = "5 mm"
material = "steel"
[sweep.axes]
angle = {from = 0.1, to = 0.9, points = 60}
"""
ROOM = 900  # bytes that a file may have
WRITES = {  # commands, and the names of what they write
    "picture": [*IMPACT, "--plot", "hit.png"],
    "table": [*IMPACT, "--output", "hit.csv"],
    "dataset": [*IMPACT, "--output", "hit.nc"],
    "film": [*IMPACT, "--animate", "hit.gif"],
    "curve": ["curve", "--chi", "1.44", "--output", "curve.csv"],
    "picture as PDF": [*IMPACT, "--plot", "hit.pdf"],
    "picture of a curve": ["curve", "--chi", "1.44", "--plot", "curve.svg"],
    "sweep": [*SWEEP, "--output", "sweep.csv"],
    "store of a sweep": [*SWEEP, "--store", "sweep.zarr"],
    "document of a fit": [*FIT, "--report", "fit.html"],
    "printed document": [*FIT, "--report", "fit.pdf"],
    "copy of the page": ["explore", "--export", "page"],
    "pack": ["verify", "pack", "pack"],
    "examples": ["lammps", "examples", "inputs"],
}
MAIN = f"""import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, ({ROOM}, {ROOM}))
from carom.cli import run
sys.argv[1:1] = []
run()
"""


def full(folder, *arguments, **more):
    """Run a command whose files may have no more than so many bytes."""
    environment = {**os.environ, "MPLCONFIGDIR": str(folder.parent), "PYTHONDONTWRITEBYTECODE": "1"}
    environment |= more
    command = [sys.executable, "-c", MAIN, *arguments]
    entries = {"cwd": folder, "env": environment, "capture_output": True, "text": True}
    return subprocess.run(command, timeout=120, **entries)


@pytest.mark.slow
@pytest.mark.parametrize("what", WRITES)
def test_nothing_half_written_and_one_exit_code(what, tmp_path):
    folder = tmp_path / "work"
    folder.mkdir()
    (folder / "case.toml").write_text(CASE)
    ran = full(folder, *WRITES[what])
    told = [line for line in ran.stderr.splitlines() if line.startswith("carom: ")]
    assert ran.returncode == 1, ran.stderr
    assert len(told) == 1, ran.stderr
    assert "File too large" in told[0]
    left = {path.name for path in folder.iterdir()} - {"case.toml"}
    assert left <= {"sweep.zarr"}, left  # whose whole blocks are safe


COMPILERS = {  # what is asked for is the last word
    "that finds no room": "echo 'ld: final link failed: No space left on device'; exit 1",
    "whose work finds none": 'for last; do :; done; ln -s /bin/sh "$last"',
}


@pytest.mark.parametrize("compiler", COMPILERS)
def test_a_build_on_a_full_disk(compiler, tmp_path):
    for folder, file, text in (
        ("bin", "c++", f"#!/bin/sh\n{COMPILERS[compiler]}"),
        ("src", "version.h", '#define LAMMPS_VERSION "22 Jul 2025"'),
        ("src", "mpi.h", ""),
    ):
        tmp_path.joinpath(folder).mkdir(exist_ok=True)
        tmp_path.joinpath(folder, file).write_text(text)
    tmp_path.joinpath("bin/c++").chmod(0o755)
    path = f"{tmp_path / 'bin'}:{os.environ['PATH']}"

    build = ["lammps", "build", "--include", "src", "--folder", "built"]
    ran = full(tmp_path, *build, PATH=path)
    assert ran.returncode == 1, ran.stderr
    assert ran.stderr.startswith("carom: ")
    assert "No space left" in ran.stderr or "'built' cannot be written; File too l" in ran.stderr
    assert ran.stderr.count("\n") == 1
    assert not list(tmp_path.rglob("*.so*"))


def test_a_full_device_is_a_failure_and_no_bad_input(refusal):
    for name in ("/dev/full", "x.csv"):
        if name == "x.csv":
            os.symlink("/dev/full", name)
        line = refusal("curve", "--chi", "1", "--points", "3", "--output", name, code=1)
        assert line == f"carom: output file: {name!r} cannot be written; No space left on device\n"
    assert "cannot be written" in refusal("curve", "--chi", "1", "--output", "/proc/x.csv", code=2)


def test_in_python_it_is_an_error_of_the_system(tmp_path):
    hit = carom.impact(PAIR, speed=2.0, angle="30 deg")
    with pytest.raises(Unwritten, match="'/dev/full' cannot be written; No space left") as error:
        carom.save(hit, "/dev/full")
    assert isinstance(error.value, OSError)
    assert not isinstance(error.value, carom.InputError)
