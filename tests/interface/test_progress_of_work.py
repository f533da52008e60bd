"""All that takes long tells how far it is, in the same way."""

from functools import cache

import numpy as np
import pytest
from tests.checks import PAIR

import carom
from carom.io.progress import Place
from carom.plots import animate

MOTION = {"speed": 2.0, "angle": "30 deg"}
HIT = carom.impact(PAIR, **MOTION)
CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "2 m/s"}
GRID = carom.Grid({"angle": [0.1, 0.2], "friction": [0.1, 0.2, 0.3]})
LAWS = [carom.dem.LinearSpring(), carom.dem.WaltonBraunLaw()]


def by_elements(folder, progress):
    coarse = carom.BoundaryElements(elements=8, steps=20)
    carom.impact(PAIR, **MOTION, method=coarse, progress=progress)


@cache
def fitted():
    return carom.fit(carom.datasets.load("kharaz2001"))


def posterior(folder, progress):
    fitted().posterior(120, seed=1, progress=progress)


def mapped(folder, progress):
    carom.regime_map([0.5, 2.0], [1.0, 1.44, 2.0], progress=progress)


def drawn(folder, progress):
    frames = [HIT.fields(part * HIT.duration) for part in (0.2, 0.5)]
    animate(HIT.history(40), frames, folder / "hit.gif", progress=progress)


LONG = [
    (by_elements, "solving by boundary elements", 35),
    (posterior, "sampling the posterior", 120),
    (lambda _, p: carom.sweep(CASE, GRID, progress=p), "solving the sweep", 6),
    (lambda _, p: carom.verify.rank(LAWS, psi_1=[1.0], progress=p), "ranking the laws", 2),
    (lambda _, p: carom.verify.tune(LAWS, chi=1.44, psi_1=[1.0], progress=p), "tuning the laws", 2),
    (mapped, "computing the map of regimes", 3),
    (lambda folder, p: HIT.animate(folder / "hit.gif", frames=3, progress=p), "animation", 3),
    (drawn, "animation", 2),
]


@pytest.fixture
def _at_once(monkeypatch):
    monkeypatch.setattr("carom.io.progress.PATIENCE", dict.fromkeys(Place, 0.0))


@pytest.mark.first_case
@pytest.mark.usefixtures("_at_once")
@pytest.mark.parametrize(("work", "name", "total"), LONG)
def test_a_bar_is_shown_on_request_only(work, name, total, tmp_path, capsys):
    work(tmp_path, None)
    assert capsys.readouterr().err == ""
    work(tmp_path, True)
    shown = capsys.readouterr()
    assert name in shown.err
    assert f"{total}/{total}" in shown.err
    assert shown.out == ""


@pytest.mark.first_case
@pytest.mark.parametrize(("work", "name", "total"), LONG[:6])
def test_a_callable_is_told_what_is_done_and_of_how_many(work, name, total, tmp_path):
    entries = []
    work(tmp_path, lambda done, whole: entries.append((done, whole)))
    done = [count for count, _ in entries]
    assert done == sorted(done)
    assert entries[-1] == (total, total)
    assert {whole for _, whole in entries} == {total}


@pytest.mark.first_case
@pytest.mark.parametrize(("work", "name", "total"), LONG[6:])
def test_a_callable_is_called_for_every_frame(work, name, total, tmp_path):
    entries = []
    work(tmp_path, lambda: entries.append(1))
    assert len(entries) == total


@pytest.mark.usefixtures("_at_once")
def test_a_sweep_that_goes_on_counts_from_what_is_stored(tmp_path, capsys):
    carom.sweep(CASE, GRID, store=tmp_path / "sweep.zarr", progress=False)
    carom.sweep(CASE, GRID, store=tmp_path / "sweep.zarr", resume=True, progress=True)
    assert "6/6" in capsys.readouterr().err


@pytest.mark.usefixtures("_at_once")
def test_a_table_with_losses_counts_its_impacts(monkeypatch, capsys):
    """How many there will be is not known; what is shown is what `rebound` got."""
    from carom.dimensionless import rebound_tables as tables

    solved = []
    genuine = tables.lossy_rebounds

    def counted(psi, *inputs, **options):
        solved.append(np.size(psi))
        return genuine(psi, *inputs, **options)

    monkeypatch.setattr(tables, "lossy_rebounds", counted)
    monkeypatch.setattr("carom.io.progress.place", lambda progress: Place.TEXT)
    carom.laws.ReboundLaw(1.0, losses=carom.KelvinVoigt(restitution=0.8))
    shown = capsys.readouterr().err
    assert "tabulating the rebounds" in shown
    assert f"{sum(solved)} impacts" in shown
