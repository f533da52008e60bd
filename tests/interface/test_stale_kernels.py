"""What numba has compiled and kept is of these very sources, whatever of them was edited."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import carom
from carom.dimensionless.elastic import phases
from carom.dimensionless.numerics.jit import ABOVE, EDITED, KEPT
from carom.folder import PACKAGE

CALLS = """
from carom.dimensionless.numerics.called import FACTOR, shifted
from carom.dimensionless.numerics.kernels import kernel

@kernel
def answer(x: float) -> float:
    return FACTOR * shifted(x)
"""
CALLED = """
from carom.dimensionless.numerics.kernels import kernel

FACTOR = 2.0

@kernel
def shifted(x: float) -> float:
    return x + 1.0
"""
ASK = "from carom.dimensionless.numerics.calls import answer; print(answer(4.0))"


@pytest.fixture
def copy(tmp_path):
    """A copy of the package with two modules more, of which one has a kernel that calls another."""
    leave = shutil.ignore_patterns("__pycache__", "lib")
    package = shutil.copytree(PACKAGE, tmp_path / "src/carom", ignore=leave)
    folder = package / "dimensionless/numerics"
    (folder / "calls.py").write_text(CALLS)
    (folder / "called.py").write_text(CALLED)
    return package


def asked(package, program=ASK, **more):
    """What numba's kernels of a package print, with caches where they usually are."""
    environment = {**os.environ, "PYTHONPATH": str(package.parent), "CAROM_KERNELS": "numba"}
    environment.pop("NUMBA_CACHE_DIR", None)
    entries = {"env": environment | more, "capture_output": True, "text": True, "check": True}
    return subprocess.run([sys.executable, "-c", program], **entries).stdout.strip()


def edit(package, before, after):
    """Replace a text by one of another length: Python's own bytecode knows a second and a size."""
    assert len(before) != len(after)
    file = package / "dimensionless/numerics/called.py"
    assert before in file.read_text()
    file.write_text(file.read_text().replace(before, after))


def kept(folder):
    return {path.parent.parent.name for path in folder.rglob("*.nbc")}


@pytest.mark.slow
@pytest.mark.parametrize("told", [False, True])
def test_an_edit_of_what_a_kernel_uses_gives_new_numbers(copy, tmp_path, told):
    """A constant in another module, and a kernel that is called; and back to what was before."""
    place = tmp_path / "told" if told else copy / "__pycache__"
    where = {"NUMBA_CACHE_DIR": str(place)} if told else {}
    assert asked(copy, **where) == "10.0"
    (first,) = kept(place)
    edit(copy, "FACTOR = 2.0", "FACTOR = 3.00")
    assert asked(copy, **where) == "15.0"
    edit(copy, "x + 1.0", "x + 2.00")
    assert asked(copy, **where) == "18.0"
    edit(copy, "FACTOR = 3.00", "FACTOR = 2.0")
    edit(copy, "x + 2.00", "x + 1.0")
    assert asked(copy, **where) == "10.0"
    assert first in kept(place)
    assert all(name.startswith(KEPT) for name in kept(place))
    assert told or len(kept(place)) == 1  # what is of other sources is removed there


@pytest.mark.slow
def test_what_was_loaded_before_an_edit_is_not_kept(copy):
    """As where `git pull` meets a notebook: its process goes on, the next one has new numbers."""
    program = """
from carom.dimensionless.numerics.calls import answer
from carom.dimensionless.numerics import jit, kernels
file = kernels.__file__.replace("kernels.py", "called.py")
text = open(file).read()
open(file, "w").write(text.replace("FACTOR = 2.0", "FACTOR = 3.00"))
print(answer(4.0), jit.waiting.unkept)
"""
    assert asked(copy, program) == f"10.0 {EDITED}"
    assert asked(copy) == "15.0"


@pytest.mark.slow
def test_without_a_folder_to_write_to_kernels_are_compiled_all_the_same(copy):
    """A file stands where the folders would be."""
    more = {"NUMBA_CACHE_DIR": str(copy / "names.py"), "PYTHONDONTWRITEBYTECODE": "1"}
    assert asked(copy, **more) == "10.0"
    assert not list(copy.rglob("*.nbc"))


def test_no_kernel_is_in_the_folders_that_are_not_looked_at():
    """Nor do kernels know them: import-linter holds them above all folders that have some."""
    with_kernels = {
        path.relative_to(PACKAGE).parts[0]
        for path in PACKAGE.rglob("*.py")
        if {"@kernel", "@entry_point()"} & set(path.read_text().splitlines())
    }
    assert with_kernels == {"dem", "dimensionless", "many"}
    contract = Path(__file__).parents[2].joinpath("pyproject.toml").read_text()
    floors = contract.partition('containers = ["carom"]')[2].partition("]\n")[0].splitlines()
    heights = {
        folder: floor for floor, line in enumerate(floors) for folder in line.split('"')[1::2]
    }
    height = {each: n for line, n in heights.items() for each in re.split(r" [:|] ", line)}
    (wings,) = (line for line in heights if " | " in line)  # which do not know each other
    for folder in with_kernels:
        beside = set(wings.split(" | ")) if folder in wings else set()
        assert all(height[each] < height[folder] for each in ABOVE - beside), folder


@pytest.fixture
def unchecked():
    phases.check_kernels.cache_clear()
    yield
    phases.check_kernels.cache_clear()


@pytest.mark.parametrize("call", [carom.rebound, carom.solve])
def test_a_known_impact_that_comes_out_otherwise_is_told_once(call, unchecked, monkeypatch):
    call(0.5, 1.44)  # as it should
    phases.check_kernels.cache_clear()
    monkeypatch.setattr(phases, "KNOWN_PSI_OUT", phases.KNOWN_PSI_OUT + 2e-12)
    told = r"the solver is wrong: it gives psi_2 = 0\.0471310837788 .* install carom again$"
    with pytest.warns(RuntimeWarning, match=told) as warned:
        assert [call(psi, 1.44) for psi in (0.5, 2.5)]
    assert len(warned) == 1
