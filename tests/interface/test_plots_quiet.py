"""Figures of odd datasets: drawn, or refused in one line; nothing of matplotlib on a terminal."""

import logging
import os
import subprocess
import sys
import warnings

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom import plots
from carom.plots.style import save_figure

WORDS = "\u92fc $\\frac{ \U0001f600"  # no font has them all, and they are no formula

DRAWN = {
    "history": ("plot_impact", "plot_cone"),  # all panels of forces and radii
    "fields": ("plot_patch",),
    "curve": ("plot_curve",),
    "score": ("plot_score",),
}
CHANGES = {
    "NaN": lambda values: values * np.nan,
    "some NaN": lambda values: np.where(np.arange(values.size) % 3, values.ravel(), np.nan),
    "infinity": lambda values: np.where(values > np.median(values), np.inf, values),
    "zero": lambda values: 0.0 * values,
    "huge": lambda values: 1e305 * values,
    "tiny": lambda values: 1e-305 * values,
}


@pytest.fixture(scope="module")
def datasets(hit):
    side = np.linspace(-1.2, 1.2, 9) * hit.max_radius
    results = {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.2, -0.8]}
    return {
        "history": hit.history(20),
        "fields": hit.fields(1.5e-5, x=side, y=side),
        "curve": carom.curve([0.5, 1.44], np.linspace(0.0, 6.0, 9)),
        "score": carom.verify.score(results, chi=1.44).to_dataset(),
    }


def changed(dataset, change):
    dataset = dataset.copy(deep=True)
    for name, item in dataset.data_vars.items():
        if item.dtype.kind == "f":
            with np.errstate(all="ignore"):
                values = CHANGES[change](item.values).reshape(item.shape)
            dataset[name] = (item.dims, values, item.attrs)
    return dataset


CASES = [(kind, change) for kind in DRAWN for change in CHANGES]
CASES.remove(("fields", "huge"))  # at which matplotlib does not end


@pytest.mark.first_case
@pytest.mark.parametrize(("kind", "change"), CASES)
def test_odd_numbers_are_drawn_or_refused_in_silence(
    kind, change, datasets, tmp_path, capfd, caplog
):
    odd = changed(datasets[kind], change)
    for name in DRAWN[kind]:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                save_figure(getattr(plots, name)(odd), tmp_path / "x.svg")
            except carom.InputError as error:
                text = str(error)
            else:
                text = name
        assert text.startswith(name)
        assert "\n" not in text
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


@pytest.mark.slow
def test_words_that_no_font_has_are_drawn_in_silence(tmp_path, capfd, caplog):
    laws = [carom.dem.LinearSpring(), carom.dem.HardSphere()]
    laws = carom.verify.rank(laws, psi_1=[0.5, 1.0]).to_dataset()
    names = [f"\u92fc {i}" for i in range(laws.sizes["law"])]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ending in (".png", ".pdf"):
            figure = plots.plot_laws(laws.assign_coords(law=names))
            assert save_figure(figure, tmp_path / f"x{ending}").stat().st_size > 1000
    assert capfd.readouterr() == ("", "")
    assert caplog.records == []


def test_words_for_phases_that_are_none_are_refused(hit):
    dataset = hit.history(20)
    kinds = np.full(dataset.phase_kind.shape, WORDS)
    odd = dataset.assign(phase_kind=(dataset.phase_kind.dims, kinds))
    refused(r"^plot_cone: this dataset cannot be drawn; ", plots.plot_cone, odd)


def test_a_user_hears_matplotlib_again_afterwards(datasets):
    """Its loggers and the filters of warnings are as they were."""
    logger = logging.getLogger("matplotlib")
    level, filters = logger.level, list(warnings.filters)
    plots.plot_curve(datasets["curve"])
    assert logger.level == level
    assert warnings.filters == filters


@pytest.mark.slow
def test_commands_say_nothing_of_folders_that_matplotlib_lacks(tmp_path):
    path = str(tmp_path / "x.png")
    words = ["curve", "--chi", "1", "--points", "5", "--plot", path]
    line = [sys.executable, "-c", "from carom.cli import run; run()", *words]
    nowhere = os.environ | {"MPLCONFIGDIR": "/proc/none", "HOME": "/proc/none"}
    done = subprocess.run(line, capture_output=True, text=True, timeout=120, env=nowhere)
    assert (done.returncode, done.stderr) == (0, f"Carom has stored {path}.\n")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "code", "begins"),
    [
        ("--chi 1e6 --points 3", 0, "2 of 3 impacts give NaN (first at index"),
        ("--chi 1 --from -1e308 --to 1e308 --points 5", 2, "psi"),
    ],
)
def test_commands_tell_warnings_of_this_package_in_one_line(words, code, begins, command, tmp_path):
    """Of impacts that could not be solved; NumPy's, of the numbers in between, are not shown."""
    ended, _, err = command(tmp_path, "curve", *words.split())
    assert (ended, err.count("\n")) == (code, 1)
    assert err.startswith(f"carom: {begins}")
