"""Figures of odd datasets: drawn, or refused in one line; nothing of matplotlib on a terminal."""

import logging
import os
import subprocess
import sys
import warnings

import numpy as np
import pytest

import carom
from carom import plots
from carom.plots.style import save_figure

WORDS = "\u92fc $\\frac{ \U0001f600"  # no font has them all, and they are no formula


def impact():
    ball, wall = carom.Sphere(radius=0.005, material="steel"), carom.HalfSpace(material="steel")
    return carom.impact(carom.Pair(ball, wall, friction=0.2), speed=2.0, angle=0.5)


HIT = impact()
SIDE = np.linspace(-1.2, 1.2, 9) * HIT.max_radius
CURVE = {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.2, -0.8]}
DATASETS = {
    "history": (HIT.history(20), ("plot_impact", "plot_forces", "plot_radii", "plot_cone")),
    "fields": (HIT.fields(1.5e-5, x=SIDE, y=SIDE), ("plot_patch",)),
    "curve": (carom.curve([0.5, 1.44], np.linspace(0.0, 6.0, 9)), ("plot_curve",)),
    "score": (
        carom.verify.score(
            {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.2, -0.8]}, chi=1.44
        ).to_dataset(),
        ("plot_score",),
    ),
}
CHANGES = {
    "NaN": lambda values: values * np.nan,
    "some NaN": lambda values: np.where(np.arange(values.size) % 3, values.ravel(), np.nan),
    "infinity": lambda values: np.where(values > np.median(values), np.inf, values),
    "zero": lambda values: 0.0 * values,
    "huge": lambda values: 1e305 * values,
    "tiny": lambda values: 1e-305 * values,
}


def changed(dataset, change):
    dataset = dataset.copy(deep=True)
    for name, item in dataset.data_vars.items():
        if item.dtype.kind == "f":
            with np.errstate(all="ignore"):
                values = CHANGES[change](item.values).reshape(item.shape)
            dataset[name] = (item.dims, values, item.attrs)
    return dataset


CASES = [(kind, change) for kind in DATASETS for change in CHANGES]
CASES.remove(("fields", "huge"))  # at which matplotlib does not end


@pytest.mark.parametrize(("kind", "change"), CASES)
def test_odd_numbers_are_drawn_or_refused_in_silence(kind, change, tmp_path, capfd, caplog):
    dataset, names = DATASETS[kind]
    odd = changed(dataset, change)
    for name in names:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                save_figure(getattr(plots, name)(odd), tmp_path / "x.svg")
            except carom.InputError as error:
                told = str(error)
            else:
                told = name
        assert told.startswith(name)
        assert "\n" not in told
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


def test_words_that_no_font_has_are_drawn_in_silence(tmp_path, capfd, caplog):
    laws = carom.verify.rank(chi=1.44, psi=[0.5, 1.0]).to_dataset()
    names = [f"\u92fc {i}" for i in range(laws.sizes["law"])]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ending in (".png", ".pdf"):
            figure = plots.plot_laws(laws.assign_coords(law=names))
            assert save_figure(figure, tmp_path / f"x{ending}").stat().st_size > 1000
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


def test_words_for_phases_that_are_none_are_refused():
    dataset = HIT.history(20)
    kinds = np.full(dataset.phase_kind.shape, WORDS)
    with pytest.raises(carom.InputError, match=r"^plot_cone: this dataset cannot be drawn; "):
        plots.plot_cone(dataset.assign(phase_kind=(dataset.phase_kind.dims, kinds)))


def test_a_user_hears_matplotlib_again_afterwards():
    """Its loggers and the filters of warnings are as they were."""
    logger = logging.getLogger("matplotlib")
    level, filters = logger.level, list(warnings.filters)
    plots.plot_curve(DATASETS["curve"][0])
    assert logger.level == level
    assert warnings.filters == filters


def run(*arguments, **environment):
    program = "from carom.cli import run; run()"
    command = [sys.executable, "-c", program, *arguments]
    known = {**os.environ, **environment}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=known)
    return done.returncode, done.stderr


def test_commands_say_nothing_of_folders_that_matplotlib_lacks(tmp_path):
    path = str(tmp_path / "x.png")
    arguments = ["curve", "--chi", "1", "--points", "5", "--plot", path]
    nowhere = "/proc/none"
    assert run(*arguments, MPLCONFIGDIR=nowhere, HOME=nowhere) == (0, f"Carom has stored {path}.\n")


def test_commands_tell_warnings_of_this_package_in_one_line():
    """Of impacts that could not be solved; NumPy's, of the numbers in between, are not shown."""
    code, err = run("curve", "--chi", "1e6", "--points", "3")
    assert code == 0
    assert err.startswith("carom: 2 of 3 impacts give NaN (first at index")
    assert err.count("\n") == 1
    code, err = run("curve", "--chi", "1", "--from", "-1e308", "--to", "1e308", "--points", "5")
    assert code == 2
    assert err.startswith("carom: psi")
    assert err.count("\n") == 1
