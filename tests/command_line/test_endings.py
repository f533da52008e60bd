"""How commands end: in one line and with an exit code, whatever signal or full disk ends them.

Signals come where they do most harm: at an import, where C code makes other errors of them, and
while temporary files are written. Each runs in a process of its own, from the first line of `run`;
what is imported late is imported by a child of one that has loaded all, and has forgotten that.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tests.command_line.test_options import COMMANDS

BALL = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
IMPACT = ["impact", *BALL, "--speed", "2", "--angle", "30 deg"]
FIT = ["fit", "--dataset", "kharaz2001"]
SWEEP_COMMAND = ["sweep", "sweep.toml"]
SWEEP = """
friction = 0.2
speed = 2.0
[first]
radius = "5 mm"
material = "steel"
[sweep.axes]
angle = {from = "1 deg", to = "85 deg", points = 400}
spin = {from = -10.0, to = 10.0, points = 200}
"""
SMALL = SWEEP.replace("400", "40").replace("200", "20")
RUN = "from carom.cli import run; run()"
AT_IMPORT = """
import os, signal, sys
from carom.cli import run
for name in [name for name in sys.modules if name.startswith({late!r})]:
    del sys.modules[name]
def hook(event, given):
    if event == "import" and given[0] == {module!r}:
        os.kill(os.getpid(), signal.{number})
sys.addaudithook(hook)
"""
WRITTEN = """
import os, signal, sys
def hook(event, given):  # the temporary file that is put in its place has been written
    if event == "os.rename" and ".carom-" in os.fspath(given[0]):
        os.kill(os.getpid(), signal.{number})
sys.addaudithook(hook)
"""
STOPPED = "carom: the command was interrupted\n"
CODES = {"SIGINT": 130, "SIGTERM": 143, "SIGHUP": 129}


@pytest.fixture
def there(tmp_path):
    (tmp_path / "sweep.toml").write_text(SMALL)
    return tmp_path


def ended(folder, program, arguments):
    """Return exit code, what is printed and told, of a Python that has loaded nothing and parses
    all sources, as the first one of an installation does."""
    plain = os.environ | {"PYTHONPYCACHEPREFIX": "/nowhere", "PYTHONDONTWRITEBYTECODE": "1"}
    values = {"cwd": folder, "capture_output": True, "text": True, "timeout": 120, "env": plain}
    done = subprocess.run([sys.executable, "-c", program, *arguments], check=False, **values)
    return done.returncode, done.stdout, done.stderr


def left(folder):
    return sorted(path.name for path in folder.iterdir())


MODULES = {
    "typer": IMPACT,
    # while the parser of Python needs it, which makes a SyntaxError of it
    "unicodedata": [*IMPACT, "--output", "hit.nc"],
    "carom.bodies.cases": IMPACT,
    "numpy": IMPACT,
    "numpy._core._multiarray_umath": IMPACT,
    "xarray": [*IMPACT, "--output", "hit.nc"],
    "h5py": [*IMPACT, "--output", "hit.nc"],
    "matplotlib": [*IMPACT, "--plot", "hit.png"],
    "matplotlib.backends._backend_agg": [*IMPACT, "--plot", "hit.png"],
    "pandas": [*IMPACT, "--output", "hit.csv"],
    "emcee": [*FIT, "--posterior", "chain.csv", "--steps", "100"],
    "zarr.core.array": [*SWEEP_COMMAND, "--store", "sweep.zarr"],
}
LATE = {  # what has to be forgotten for a module to be imported
    "xarray": ("xarray",),
    "pandas": ("pandas",),
    "matplotlib": ("matplotlib", "carom.plots"),
    "h5py": ("h5py", "h5netcdf"),
    "matplotlib.backends._backend_agg": ("matplotlib.backends",),
    "emcee": ("emcee", "lmfit"),  # which imports it if it is there
    "zarr.core.array": ("zarr", "carom.io.stores", "carom.many.sweeps.stores"),
}

AT_MODULES = [("SIGTERM", "unicodedata"), ("SIGTERM", "h5py")]
AT_MODULES += [("SIGINT", module) for module in MODULES]


@pytest.mark.first_case
@pytest.mark.parametrize(("number", "module"), AT_MODULES)
def test_a_signal_at_an_import_ends_in_one_line(number, module, there, command):
    program = AT_IMPORT.format(module=module, number=number, late=LATE.get(module, ()))
    if module in LATE:
        code, out, err = command(there, *MODULES[module], before=program)
    else:
        code, out, err = ended(there, f"{program}run()", MODULES[module])
    assert (code, out) == (CODES[number], "")
    if number == "SIGINT" and module == "zarr.core.array":
        assert re.fullmatch("carom: the sweep was stopped(; .*)?\n", err)
    else:
        assert err in ({"SIGINT": [STOPPED], "SIGTERM": ["", STOPPED]}[number])
    assert left(there) == ["sweep.toml"]


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("number", "arguments"),
    [
        ("SIGINT", [*IMPACT, "--output", "hit.nc"]),
        ("SIGHUP", [*IMPACT, "--output", "hit.nc"]),
        ("SIGTERM", [*IMPACT, "--output", "hit.csv"]),
        ("SIGTERM", [*IMPACT, "--plot", "hit.png"]),
        ("SIGTERM", ["curve", "--chi", "1.44", "--export", "c", "--output", "rebound.h"]),
        ("SIGTERM", ["verify", "pack", "bench"]),
    ],
    ids=str,
)
def test_a_signal_leaves_no_temporary_file(number, arguments, there, command):
    """What was there before is there as it was."""
    if arguments[-1] != "bench":
        (there / arguments[-1]).write_text("older")
    before = left(there)
    code, _, err = command(there, *arguments, before=WRITTEN.format(number=number))
    assert code == CODES[number]
    assert err == (STOPPED if number == "SIGINT" else "")
    assert left(there) == before
    assert all((there / name).read_text() in ("older", SMALL) for name in before)


def test_a_signal_while_a_store_is_made_leaves_nothing(there, command):
    """A thread that makes it would go on after the folder has been removed."""
    program = """
import os, signal, sys, threading, time
def hook(event, given):
    if event == "os.mkdir" and "/.carom-" in os.fspath(given[0]):
        signal.pthread_kill(threading.main_thread().ident, signal.SIGTERM)
        time.sleep(0.5)
sys.addaudithook(hook)
"""
    arguments = [*SWEEP_COMMAND, "--store", "sweep.zarr"]
    assert command(there, *arguments, before=program) == (143, "", "")
    assert left(there) == ["sweep.toml"]


def test_a_signal_while_a_task_is_awaited_says_nothing_of_the_task(there, command):
    """zarr writes by tasks of asyncio, which tells of each that does not come to its end."""
    program = """
import asyncio, os, signal
from carom.cli.options import Once
def interrupted(*given):
    loop = asyncio.new_event_loop()
    loop.create_task(asyncio.sleep(9.0))
    loop.call_soon(os.kill, os.getpid(), signal.SIGTERM)
    loop.run_forever()
Once._parsed = interrupted
"""
    assert command(there, "materials", before=program) == (143, "", "")


@pytest.mark.slow
def test_ctrl_c_in_sampling_is_told_in_one_line(there, command):
    """The sampler would print what was interrupted, with a traceback, among the results."""
    program = """
import signal
import carom.lab.fitting.model as laws
from carom.lab.fitting import datasets
sampled, read = datasets.sample, laws.stored
def interrupted():
    signal.raise_signal(signal.SIGINT)
    return read()
def sample(*given):
    laws.stored = interrupted
    return sampled(*given)
import carom.lab.fitting.result
carom.lab.fitting.result.sample = sample
"""
    arguments = [*FIT, "--posterior", "chain.csv", "--json"]
    assert command(there, *arguments, before=program) == (130, "", STOPPED)
    assert left(there) == ["sweep.toml"]


@pytest.mark.slow
@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize(
    "arguments",
    [
        [*IMPACT, "--plot", "hit.png", "--output", "hit.nc"],
        [*SWEEP_COMMAND, "--store", "sweep.zarr", "--resume"],
        [*FIT, "--posterior", "chain.csv", "--steps", "5000"],
    ],
    ids=lambda words: words[0],
)
def test_a_signal_at_any_time_ends_in_one_line(arguments, number, there):
    """From when Python runs `run`, which is told, through the first seconds, the two by turns."""
    (there / "sweep.toml").write_text(SWEEP)
    delays = (0.0, 0.01, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8, 1.2, 1.7, 2.3, 3.0)
    program = "import carom.cli as c; print('ready', flush=True); c.run()"
    for delay in delays[number == "SIGTERM" :: 2]:
        process = subprocess.Popen(
            [sys.executable, "-c", program, *arguments],
            cwd=there,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.005 + delay)
        process.send_signal(getattr(signal, number))
        _, err = process.communicate(timeout=60)
        stored = [line for line in err.splitlines() if line.startswith("Carom has stored")]
        if process.returncode == 0:  # it was quicker
            break
        if process.returncode == -getattr(signal, number):  # Python itself was shutting down
            assert len(stored) == (2 if arguments[0] == "impact" else 1), (delay, err)
            break
        assert process.returncode == CODES[number], (delay, err)
        answer = err.splitlines()[len(stored) :]
        assert len(answer) == 1 or (number == "SIGTERM" and not answer), (delay, err)
        assert "Traceback" not in err
        assert not [name for name in left(there) if name.startswith(".carom-")]
        assert not list(there.rglob("*.partial"))


ANY = {  # an argument of each command, which is not read before the signal comes
    ("sweep",): ["sweep.toml"],
    ("track",): ["track.csv"],
    ("curve",): ["--chi", "1"],
    ("verify", "pack"): ["bench"],
    ("verify", "score"): ["scored.csv"],
    ("lammps", "examples"): ["inputs"],
    ("liggghts", "build"): ["--source", "there"],
}
PARSED = """
import os, signal
from carom.cli.options import Once
parsed = Once._parsed
def interrupted(*given):
    os.kill(os.getpid(), signal.{number})
    return parsed(*given)
Once._parsed = interrupted
"""
CHECKED = """
import os, signal
from carom.quantities.refusals import Faults
def interrupted(self):
    os.kill(os.getpid(), signal.{number})
    return self
Faults.__enter__ = interrupted
Faults.settle = interrupted
"""


@pytest.mark.first_case
@pytest.mark.parametrize("number", CODES)
@pytest.mark.parametrize("moment", [PARSED, CHECKED], ids=["parsed", "checked"])
@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_every_command_ends_with_one_exit_code(words, moment, number, there, command):
    """While its words are parsed, and while it looks at what they mean."""
    arguments = [*words, *ANY.get(words, [])]
    code, out, err = command(there, *arguments, before=moment.format(number=number))
    assert (code, out) == (CODES[number], "")
    assert err == (STOPPED if number == "SIGINT" else "")
    assert left(there) == ["sweep.toml"]


@pytest.mark.slow
@pytest.mark.parametrize("number", CODES)
@pytest.mark.parametrize("asked", ["lammps", "standard input"])
def test_a_signal_while_others_are_awaited(asked, number, there):
    """A compiler, which ends as well, with what it has started; somebody who types."""
    compiler = there / "bin" / "c++"
    compiler.parent.mkdir()
    compiler.write_text('#!/bin/sh\nsleep 60 & echo $! > "$CHILD"\nwait\n')
    compiler.chmod(0o755)
    (there / "src").mkdir()
    (there / "src" / "version.h").write_text('#define LAMMPS_VERSION "22 Jul 2025"')
    (there / "src" / "mpi.h").touch()
    child, before = there / "child", left(there)
    path = f"{compiler.parent}:{os.environ['PATH']}"
    build = ["lammps", "build", "--include", "src", "--folder", "built"]
    arguments = build if asked == "lammps" else ["impact", "-"]
    process = subprocess.Popen(
        [sys.executable, "-c", RUN, *arguments],
        cwd=there,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PATH": path, "CHILD": str(child)},
    )
    late = time.monotonic() + 60.0
    if asked == "lammps":
        while not (child.exists() and child.read_text().strip()) and time.monotonic() < late:
            time.sleep(0.1)
    time.sleep(3.0)  # until the command waits, too
    process.send_signal(getattr(signal, number))
    assert process.wait(timeout=20) == CODES[number]
    assert process.communicate() == ("", STOPPED if number == "SIGINT" else "")
    if asked == "lammps":
        state = Path(f"/proc/{int(child.read_text())}/stat")
        late = time.monotonic() + 10.0
        while state.exists() and state.read_text().split()[2] != "Z":
            assert time.monotonic() < late
            time.sleep(0.1)
    assert left(there) in (before, sorted([*before, "child"]))


TRACKED = Path(__file__).parents[2] / "examples" / "data" / "track_deeplabcut.csv"
TRACK = ["track", str(TRACKED), "--frame-rate", "1 kHz", "--pixels-per-mm", "10"]
PRINTING = {
    "impact": IMPACT,
    "json": [*IMPACT, "--json"],
    "curve": ["curve", "--chi", "1.44"],
    "header": ["curve", "--chi", "1.44", "--export", "c"],
    "sweep": SWEEP_COMMAND,
    "fit": FIT,
    "template": ["fit", "--template"],
    "track": TRACK,
    "materials": ["materials"],
    "laws": ["verify", "laws", "--law", "mindlin", "--json"],
    "explore": ["explore", "--no-open", "--port", "0"],
    "help": ["--help"],
    "help of a command": ["fit", "--help"],
    "help of a group": ["verify"],
    "version": ["--version"],
}


@pytest.mark.first_case
@pytest.mark.parametrize("what", PRINTING)
def test_output_that_cannot_be_written_is_told_in_one_line(what, there, command):
    """A full disk; a reader that has gone, of which nothing is said."""
    reader, gone = os.pipe()
    os.close(reader)
    answer = ["carom: the output cannot be written; No space left on device"]
    for stream, words in ((os.open("/dev/full", os.O_WRONLY), answer), (gone, [])):
        code, _, err = command(there, *PRINTING[what], stdout=stream)
        os.close(stream)
        assert (code, [line for line in err.splitlines() if line != UNSTORED]) == (1, words)


UNSTORED = (
    "Carom has not stored the results; add --output sweep.nc or --store sweep.zarr to keep them."
)


@pytest.mark.slow
def test_streams_that_are_closed_take_no_place_of_a_file(there):
    """What is told goes nowhere; the file that takes the number of stderr is not written into."""
    line = f"{sys.executable} -c '{RUN}' curve --chi 1 --output curve.csv 2>&- >/dev/null <&-"
    assert subprocess.run(["bash", "-c", line], cwd=there, timeout=120).returncode == 0
    assert (there / "curve.csv").read_text().startswith("chi,psi_in,psi_out,")
    line = f"{sys.executable} -c '{RUN}' curve --chi nothing 2>&- >&- <&-"
    assert subprocess.run(["bash", "-c", line], cwd=there, timeout=120).returncode == 2
    line = f"{sys.executable} -c '{RUN}' --version >&-"
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, timeout=120)
    answer = "carom: the output cannot be written; Bad file descriptor\n"
    assert (done.returncode, done.stderr) == (1, answer)


LIMITED = {
    "hit.nc": [*IMPACT, "--output"],
    "hit.csv": [*IMPACT, "--output"],
    "hit.png": [*IMPACT, "--plot"],
    "hit.pdf": [*IMPACT, "--plot"],
    "hit.svg": [*IMPACT, "--plot"],
    "hit.gif": [*IMPACT, "--animate"],
    "hit.mp4": [*IMPACT, "--animate"],
    "spectrum.nc": [*IMPACT, "--spectrum"],
    "rebound.h": ["curve", "--chi", "1.44", "--export", "c", "--output"],
    "chain.nc": [*FIT, "--steps", "300", "--posterior"],
    "sweep.nc": [*SWEEP_COMMAND, "--output"],
    "sweep.zarr": [*SWEEP_COMMAND, "--store"],
    "bench": ["verify", "pack"],
    "page": ["explore", "--export"],
}

SLOW = ("hit.gif", "page")
FILES = [pytest.param(name, marks=pytest.mark.slow) if name in SLOW else name for name in LIMITED]


@pytest.mark.first_case
@pytest.mark.parametrize("name", FILES)
def test_a_file_that_may_not_grow_leaves_nothing_behind(name, there, command):
    """One line, no temporary file, an older file as it was; HDF5 would take the process down."""
    if name.endswith(".mp4") and shutil.which("ffmpeg") is None:
        pytest.skip("there is no ffmpeg")
    if "." in name and name != "sweep.zarr":
        (there / name).write_text("older")
    before = left(there)
    code, _, err = command(there, *LIMITED[name], name, largest=4096)
    assert code in (1, 2), err
    (text,) = [line for line in err.splitlines() if "The chain is short" not in line]
    assert re.match(r"carom: .*File too large", text), err
    assert left(there) == before
    assert name not in before or (there / name).read_text() == "older"


@pytest.mark.slow
def test_a_store_that_may_not_grow_stays_whole(there, command):
    """Its first chunks are too large for the limit; nothing of them is left."""
    (there / "sweep.toml").write_text(SWEEP.replace("400", "2000"))
    arguments = [*SWEEP_COMMAND, "--store", "sweep.zarr", "--resume"]
    arguments += ["--quantities", "psi_out"]
    code, _, err = command(there, *arguments, largest=40 * 1024)
    assert code == 1
    assert re.fullmatch("carom: sweep.zarr: File too large; .* are safe in .*\n", err)
    assert not list(there.rglob("*.partial"))
    assert "status/zarr.json" in (there / "sweep.zarr/status/.sha256sums").read_text()
