"""`carom lammps build`: what it tells, what it refuses, and what is found afterwards."""

import json
import shutil
from pathlib import Path

import pytest

from carom.cli import main
from carom.lammps import building
from carom.quantities.refusals import InputError

pytestmark = pytest.mark.engine


def test_the_command_tells_what_it_built(plugin, tmp_path, capsys):
    assert main(["lammps", "build", "--folder", str(tmp_path / "here"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert Path(told["file"]).is_file()
    assert told["version"] == building.wheel_version()


def test_a_plugin_for_another_lammps_is_passed_over(plugin, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(building, "home", lambda: tmp_path)
    assert building.search_path() == str(tmp_path / str(building.wheel_version()))
    assert capsys.readouterr().err == ""
    (tmp_path / "20200101").mkdir()
    shutil.copy(plugin / building.NAME, tmp_path / "20200101")
    building.search_path()
    line = capsys.readouterr().err
    assert "built for LAMMPS 20200101" in line
    assert "carom lammps build" in line


def test_building_refuses(plugin, tmp_path, monkeypatch):
    with pytest.raises(InputError, match="must be the folder src of LAMMPS"):
        building.from_sources(tmp_path)
    (tmp_path / "version.h").write_text('#define LAMMPS_VERSION "22 Jul 2025"\n')
    found = building.from_sources(tmp_path)
    assert found.version == 20250722
    with pytest.raises(InputError, match="the compiler failed"):
        building.build(found, tmp_path / "out")
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(building, "COMPILERS", ())
    with pytest.raises(InputError, match="no C\\+\\+ compiler"):
        building.build(found, tmp_path / "out")
