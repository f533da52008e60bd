"""What users import: each public name once, in the stub of its package, and nothing else shown."""

import re
import subprocess
import sys
from importlib import import_module

import pytest
from tests.checks import PAIR

import carom
from carom.quantities.shown import INNER

BESIDE = {"carom": ["__version__"], "carom.plots": ["style"]}  # known to dir() alone
STUBBED = (
    *("carom", "carom.plots", "carom.verify", "carom.dem"),
    *("carom.laws", "carom.results", "carom.status"),
)
PACKAGES = (*STUBBED, "carom.datasets", "carom.classical")


@pytest.mark.parametrize("package", PACKAGES)
def test_dir_shows_the_public_names_and_nothing_else(package):
    module = import_module(package)
    assert sorted(dir(module)) == sorted([*module.__all__, *BESIDE.get(package, [])])
    assert all(getattr(module, name) is not None for name in dir(module))


@pytest.mark.parametrize(
    "thing",
    [
        carom.impact(PAIR, speed=2.0),
        *(carom.load_path(PAIR, normal_force=1.0, tangential_force=0.0), carom.KelvinVoigt(0.9)),
        *(carom.Grid({"angle": [0.1]}), carom.dem.LinearSpring(), carom.verify.Lammps()),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_completion_offers_what_users_call(thing):
    names = [name for name in dir(thing) if not name.startswith("__")]
    assert not [name for name in names if name.startswith("_") or name in INNER]
    assert all(hasattr(thing, name) for name in names)


@pytest.mark.parametrize("package", STUBBED)
def test_editors_see_each_name_as_it_is_called(package):
    stub = import_module(package).__file__ + "i"
    with open(stub, encoding="utf-8") as file:
        pairs = re.findall(r"(\w+) as (\w+)", file.read())
    names = [name for name, _ in pairs]
    assert all(name == shown for name, shown in pairs)
    assert sorted(names) == sorted(dir(import_module(package)))


LINES = [
    "from carom.datasets import load; load('kharaz2001')",
    "import carom.classical; carom.classical.Obliquity(0.1, 0.2)",
    "from carom.verify import bench; assert callable(bench)",
    "import carom.verify.benchmark; assert callable(carom.verify.bench)",
    "from carom import plots; assert callable(plots.plot_curve)",
    "import carom; carom.plots.style.style()",
]
FORKS = """
import os, sys
import matplotlib.figure, numpy, pandas, pint, scipy.optimize, xarray
for line in sys.argv[1:]:
    if os.fork() == 0:
        exec(line)
        break
    assert os.wait()[1] == 0, line
"""


def test_names_are_where_users_import_them():
    """Each in a process of its own: what was imported of Carom before must not matter."""
    subprocess.run([sys.executable, "-c", FORKS, *LINES], check=True)


def test_a_name_that_is_none_is_refused():
    with pytest.raises(AttributeError, match="nothing"):
        carom.nothing  # noqa: B018
