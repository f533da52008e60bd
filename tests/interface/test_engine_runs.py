"""Runs of engines: what is asked for, what comes out, and nothing left behind by a failing one."""

import os
import shutil
import sys
import time
from ctypes.util import find_library
from dataclasses import dataclass, field
from importlib.metadata import PackagePath
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from tests.checks import experiment, refused

import carom
from carom.verify.engines.experiments import Outcomes
from carom.verify.engines.lammps import Lammps
from carom.verify.engines.running import EngineError, run

GOOD = "printf '0.01 0.002 1\\n0.01 0.003 2\\n' > results"


@dataclass(frozen=True)
class Shell:
    """An engine that is a shell script; it notes its process in a file of its own."""

    script: str
    note: Path
    present: bool = True
    name: str = "Shell"
    versions: str = "1"
    remedy: str = "not found; install it"
    advice: str = "install it"
    folders: list = field(default_factory=list)

    def executable(self):
        return Path("/bin/sh") if self.present else None

    def supports(self, law):
        return isinstance(law, carom.dem.LinearSpring)

    def files(self, wanted):
        return {"script": f"echo $$ > {self.note}\n{self.script}\n"}

    def command(self, folder):
        self.folders.append(folder)
        return ["/bin/sh", "script"]

    def outcomes(self, folder, wanted):
        return Outcomes(*np.loadtxt(folder / "results", usecols=(0, 1, 2), ndmin=2).T)

    def version(self, printed):
        return printed.strip() or "none"


def alive(group):
    """Return the processes of a group that still run."""
    entries = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, own = status.read_text().rpartition(")")[2].split()[:3]
        except OSError:
            continue
        if int(own) == group and state != "Z":
            entries.append(status.parent.name)
    return entries


def nothing_left(engine):
    """Wait shortly for the kernel to bury what was killed; then no process, no folder is left."""
    group = int(engine.note.read_text())
    until = time.monotonic() + 5.0
    while alive(group) and time.monotonic() < until:
        time.sleep(0.02)
    return not alive(group) and not engine.folders[0].exists()


def failure(engine, **options):
    """Return the message of a failing run, one line."""
    with pytest.raises(EngineError) as caught:
        run(engine, experiment(), **options)
    assert "\n" not in str(caught.value)
    assert nothing_left(engine)
    return str(caught.value)


def test_results_and_version(tmp_path):
    engine = Shell(f"echo 2.7\n{GOOD}", tmp_path / "note")
    outcomes = run(engine, experiment())
    assert outcomes.version == "2.7"
    assert outcomes.outcomes.spin.tolist() == [1.0, 2.0]
    assert 0.0 < outcomes.seconds < 30.0
    assert nothing_left(engine)


def test_crash_shows_the_last_words(tmp_path):
    script = "seq 8\necho 'ERROR:  Unknown command' >&2\nexit 3"
    message = failure(Shell(script, tmp_path / "note"))
    words = "it printed last: 7 | 8 | ERROR: Unknown command"
    assert message == f"Shell has crashed (exit code 3); {words}"


def test_long_last_words_are_cut(tmp_path):
    assert len(failure(Shell("seq -s, 100000\nexit 1", tmp_path / "note"))) < 400


def test_signal_has_its_name(tmp_path):
    assert "signal SIGSEGV" in failure(Shell("kill -SEGV $$", tmp_path / "note"))


def test_missing_library_is_named(tmp_path):
    """What the loader of Linux or macOS says becomes what to do."""
    words = "lmp: error while loading shared libraries: libmpi.so.12: cannot open"
    message = failure(Shell(f"echo '{words}' >&2\nexit 127", tmp_path / "note"))
    assert message == "Shell does not start: libmpi.so.12 is missing; install it"
    words = "dyld[7]: Library not loaded: @rpath/libmpi.12.dylib\n  Referenced from: lmp"
    message = failure(Shell(f"echo '{words}' >&2\nkill -ABRT $$", tmp_path / "note"))
    assert message == "Shell does not start: @rpath/libmpi.12.dylib is missing; install it"


def test_hanging_engine_is_killed_with_its_children(tmp_path):
    script = "echo step 5\nsleep 1000 &\n(trap '' TERM; sleep 1000) &\nwhile :; do sleep 0.1; done"
    start = time.monotonic()
    message = failure(Shell(script, tmp_path / "note"), time_limit=0.4)
    assert message == "Shell was killed at its time limit of 0.4 s; it printed last: step 5"
    assert 0.4 <= time.monotonic() - start < 1000.0  # nobody waits for those who sleep


def test_flood_of_words_is_stopped(tmp_path):
    """Long before its time limit, and what cannot be shown is not."""
    script = r"while :; do head -c 1000000 /dev/zero; printf '\nERROR \033[2J\n'; done"
    message = failure(Shell(script, tmp_path / "note"), time_limit=60.0)
    assert "was killed as it printed more than 64 MB" in message
    assert message.isprintable()


def test_children_of_a_finished_engine_are_killed(tmp_path):
    engine = Shell(f"{GOOD}\nsleep 1000 &", tmp_path / "note")
    run(engine, experiment())
    assert nothing_left(engine)


@pytest.mark.parametrize(
    ("script", "words"),
    [
        ("echo done", "has left no results; it printed last: done"),
        ("echo so it is > results", "has left no results (could not convert"),
        ("echo 1 2 > results", "has left no results (invalid column"),
        (": > results", "has left 0 of 2 results; it printed last: nothing"),
        ("echo 1 2 3 > results; echo done", "has left 1 of 2 results; it printed last: done"),
        ("printf '1 2 nan\\n1 2 3\\n' > results", "results that are not finite"),
        ("printf '1 -inf 3\\n1 2 3\\n' > results", "results that are not finite"),
    ],
)
def test_missing_or_broken_results(script, words, tmp_path):
    assert words in failure(Shell(script, tmp_path / "note"))


def test_absent_engine_says_what_to_do(tmp_path):
    engine = Shell(GOOD, tmp_path / "note", present=False)
    refused("Shell: not found; install it", run, engine, experiment())
    assert not engine.folders


def test_law_that_the_engine_does_not_have(tmp_path):
    engine = Shell(GOOD, tmp_path / "note")
    law = carom.dem.ThorntonLaw()
    refused("Shell does not have it", run, engine, experiment(law=law))
    assert not engine.folders


@pytest.mark.parametrize("limit", [0.0, -1.0, float("inf"), "soon"])
def test_time_limit_is_read(limit, tmp_path):
    refused("time", run, Shell(GOOD, tmp_path / "note"), experiment(), time_limit=limit)


def test_engine_that_cannot_start(tmp_path):
    broken = tmp_path / "lmp"
    broken.write_text("#!/nowhere/interpreter\n")
    broken.chmod(0o755)
    with pytest.raises(EngineError, match="LAMMPS does not start: No such file"):
        run(Lammps(broken), experiment())


def test_absent_lammps(tmp_path, monkeypatch):
    words = "is not an executable; give another path"
    refused(words, run, Lammps(tmp_path / "lmp"), experiment())
    monkeypatch.setattr("sysconfig.get_path", lambda name: str(tmp_path))
    monkeypatch.setenv("PATH", str(tmp_path))
    refused(r"pip install 'carom\[verify\]'", run, Lammps(), experiment())


@pytest.fixture
def two_lammps(tmp_path, monkeypatch):
    """An executable of a wheel, first on the PATH, and another one."""
    for name in ("scripts", "other"):
        (tmp_path / name).mkdir()
        shutil.copy("/bin/true", tmp_path / name / "lmp")
    monkeypatch.setattr("sysconfig.get_path", lambda name: str(tmp_path / "scripts"))
    monkeypatch.setenv("PATH", f"{tmp_path / 'scripts'}{os.pathsep}{tmp_path / 'other'}")
    return tmp_path


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the wheel finds MPI by itself")
def test_wheel_without_its_mpi_is_passed_over(two_lammps, monkeypatch):
    """The executable of the wheel does not start without MPICH: another LAMMPS is taken."""
    library = two_lammps / "libmpi.so.12"
    distribution = SimpleNamespace(locate_file=two_lammps.joinpath)
    listed = PackagePath(library.name)
    listed.dist = distribution
    monkeypatch.setattr("importlib.metadata.files", lambda name: [listed])
    assert Lammps().executable() == two_lammps / "other" / "lmp"
    library.touch()
    assert Lammps().executable() == two_lammps / "scripts" / "lmp"
    monkeypatch.setattr("importlib.metadata.files", lambda name: [PackagePath("mpich/LICENSE")])
    assert Lammps().executable() == two_lammps / "other" / "lmp"
    (two_lammps / "other" / "lmp").unlink()
    message = r"LAMMPS: its wheel finds no libmpi.so.12; pip install 'carom\[verify\]'"
    refused(message, run, Lammps(), experiment())


@pytest.mark.engine
@pytest.mark.skipif(find_library("mpi") == "libmpi.so.12", reason="MPI is there for all to find")
def test_real_lammps_without_its_mpi(monkeypatch):
    """The executable of the wheel without the script that shows it its MPI."""
    package = find_spec("lammps")
    executable = package and package.origin and Path(package.origin).parent / "lmp"
    if not executable or not executable.exists():
        pytest.skip("the wheel of LAMMPS is not installed")
    monkeypatch.delenv("LD_LIBRARY_PATH", raising=False)
    message = r"LAMMPS does not start: libmpi.so.12 is missing; pip install 'carom\[verify\]'"
    with pytest.raises(EngineError, match=message):
        run(Lammps(executable), experiment())


@dataclass(frozen=True)
class Spoilt(Lammps):
    """LAMMPS with something replaced in its script."""

    old: str = ""
    new: str = ""

    def files(self, wanted):
        files = super().files(wanted)
        return {name: text.replace(self.old, self.new) for name, text in files.items()}


@pytest.mark.first_case
@pytest.mark.engine
@pytest.mark.skipif(Lammps().executable() is None, reason="LAMMPS is not installed")
@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("nve/sphere", "nve/spere", "exit code .*nve/spere"),
        ("run             1152", "run 600", "the bodies still touch"),
        ("run             1152", "run 2000000000", "time limit of 0.4 s"),
        ("write_dump", "# write_dump", "has left no results; it printed last: .*Total wall time"),
    ],
)
def test_real_lammps_fails(old, new, words):
    with pytest.raises(EngineError, match=words):
        run(Spoilt(old=old, new=new), experiment(), time_limit=0.4 if "limit" in words else 60.0)


def test_no_stray_files(tmp_path, monkeypatch):
    """A run leaves nothing in the folder from which it is started."""
    monkeypatch.chdir(tmp_path)
    run(Shell(GOOD, tmp_path / "note"), experiment())
    assert os.listdir(tmp_path) == ["note"]
