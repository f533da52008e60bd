"""Figures of contact laws show what ranking and error map hold; their page tells the truth."""

import itertools
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from tests.checks import is_legible, refused

from carom import dem
from carom.plots.laws import plot_error_map, plot_laws
from carom.plots.regimes import draw_borders
from carom.verify import error_map, rank
from carom.verify.entries import CATALOGUE

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "studies"))
MM = 1.0 / 25.4
SAME = {  # elastic: those on the right are the law on the left
    "linear spring, k_t/k_n = kappa": ("Stronge, bilinear",),
    "mindlin": ("LIGGGHTS hertz, history",),
}
OTHERS = ("linear spring, k_t/k_n = 2/7", "mindlin/force", "mindlin_rescale")
NAMES = {*SAME, *sum(SAME.values(), ()), *OTHERS, "Hertz, linear history", "rigid Coulomb"}
LAWS = tuple(entry for entry in CATALOGUE if entry.label in NAMES)


@pytest.fixture(scope="module")
def ranking():
    return rank(LAWS, psi_1=[3.0, 0.5, 1.0, 1.5, 5.0]).to_dataset()


@pytest.fixture(scope="module")
def laws(ranking):
    return plot_laws(ranking)


@pytest.fixture(scope="module")
def errors():
    return error_map(dem.LammpsMindlin("mindlin"), np.linspace(0.0, 7.0, 36), [1.2, 1.4, 1.75])


def rows(figure):
    """Return the axes of rebounds and of bars, row by row."""
    return list(zip(figure.axes[::2], figure.axes[1::2], strict=True))


def bars(axis):
    """Return names, largest errors and root mean squares of the bars of a row."""
    labels = [text.get_text().replace("\n", " ") for text in axis.get_yticklabels()]
    names = [label.replace("$", "").replace("\\kappa", "kappa") for label in labels]
    largest, rms = ([patch.get_width() for patch in group] for group in axis.containers)
    return list(zip(names, largest, rms, strict=True))


def test_bars_are_the_errors_best_first(laws, ranking):
    drawn = [bar for _, axis in rows(laws) for bar in bars(axis)]
    columns = (ranking.law, ranking.max_error, ranking.rms_error)
    wanted = zip(*(column.values for column in columns), strict=True)
    assert drawn == [(name, pytest.approx(m), pytest.approx(r)) for name, m, r in wanted]
    assert drawn[0][0] in ("Stronge, bilinear", "linear spring, k_t/k_n = kappa")
    assert sorted(drawn, key=lambda bar: bar[1]) == drawn


def test_numbers_at_the_bars_are_the_errors(laws, ranking):
    entries = [text.get_text() for _, axis in rows(laws) for text in axis.texts]
    assert entries == [f"{value:.3f}" for value in ranking.max_error.values]


def test_lines_are_the_rebounds_in_the_colours_of_the_bars(laws, ranking):
    """Incidences in rising order; the first line with points is the exact one."""
    order, row = np.argsort(ranking.psi_in.values), 0
    for left, right in rows(laws):
        _, exact, *lines = left.lines
        np.testing.assert_array_equal(exact.get_xdata(), [0.5, 1.0, 1.5, 3.0, 5.0])
        np.testing.assert_array_equal(exact.get_ydata(), ranking.psi_out_exact.values[order])
        for line, bar, sample in zip(lines, right.containers[1], right.lines, strict=True):
            np.testing.assert_array_equal(line.get_ydata(), ranking.psi_out.values[row][order])
            assert to_rgb(line.get_color()) == bar.get_facecolor()[:3]
            assert sample.get_linestyle() == line.get_linestyle()
            row += 1
    assert row == ranking.sizes["law"]


def test_laws_share_a_line_if_and_only_if_they_are_the_same(laws, ranking):
    """Within a row colour and dash tell rebounds apart; equal laws stand in one row."""
    for left, right in rows(laws):
        names = [name for name, _, _ in bars(right)]
        out = [ranking.psi_out.sel(law=name).values for name in names]
        looks = [(line.get_color(), line.get_linestyle()) for line in left.lines[2:]]
        for i, j in itertools.combinations(range(len(names)), 2):
            assert (looks[i] == looks[j]) == np.allclose(out[i], out[j], rtol=0.0, atol=1e-6)
    places = {name: i for i, (_, a) in enumerate(rows(laws)) for name, _, _ in bars(a)}
    assert places["mindlin"] == places["LIGGGHTS hertz, history"]


def test_map_is_the_error_with_white_at_zero(errors):
    figure = plot_error_map(errors)
    mesh = figure.axes[0].collections[0]
    np.testing.assert_array_equal(np.ravel(mesh.get_array()), errors.error.values.ravel())
    most = float(np.abs(errors.error).max())
    assert mesh.get_clim() == (-most, most)
    assert min(mesh.cmap(mesh.norm(0.0))[:3]) > 0.95
    assert figure.legends[0].get_title().get_text() == "LAMMPS, mindlin"


def test_map_outlines_an_error_of_a_tenth(errors):
    """Every vertex of the outline lies between neighbours on either side of +-0.1."""
    contour = plot_error_map(errors).axes[0].collections[1]
    np.testing.assert_array_equal(contour.levels, [-0.1, 0.1])
    vertices = np.concatenate([path.vertices for path in contour.get_paths()])
    assert len(vertices) > 5
    actual = errors.error.interp(chi=("p", vertices[:, 1]), psi_in=("p", vertices[:, 0]))
    np.testing.assert_allclose(np.abs(actual), 0.1, atol=0.02)


def test_map_draws_the_borders_of_the_regimes(errors):
    lines = plot_error_map(errors).axes[0].lines
    for line, border in zip(
        lines, (lambda c: 0 * c + 1, lambda c: 2 * c, lambda c: 4 * c - 1), strict=True
    ):
        np.testing.assert_allclose(line.get_xdata(), border(line.get_ydata()), rtol=1e-14)


@pytest.mark.parametrize(
    ("limits", "named"),
    [
        ((0.0, 7.0), [r"1", r"2\chi", r"4\chi-1"]),
        ((0.0, 2.0), [r"1"]),
        ((1.5, 7.0), [r"2\chi", r"4\chi-1"]),
    ],
)
def test_borders_are_named_where_they_are_seen(limits, named):
    axis = Figure().add_subplot(xlim=limits, ylim=(1.2, 1.75))
    draw_borders(axis)
    assert [text.get_text() for text in axis.texts] == [rf"$\psi_1 = $${name}$" for name in named]


def test_map_where_a_law_has_no_answer_is_grey(errors):
    holed = errors.copy(deep=True)
    holed.error.values[1, 10:12] = np.nan
    figure = plot_error_map(holed, limit=0.3)
    mesh = figure.axes[0].collections[0]
    assert np.ma.getmaskarray(np.ma.masked_invalid(mesh.get_array())).sum() == 2
    assert mesh.get_clim() == (-0.3, 0.3)
    assert to_rgb(figure.axes[0].get_facecolor()) == to_rgb("0.8")


def test_all_text_is_legible(laws, errors):
    for figure, width in ((laws, 178.0), (plot_error_map(errors), 86.0)):
        assert figure.get_figwidth() == pytest.approx(width * MM)
        assert is_legible(figure, 16)


def test_other_grids_and_limits_are_refused(errors):
    refused("rising psi_in and chi", plot_error_map, errors.isel(chi=[0]))
    for limit in (0.0, -1.0, np.nan):
        refused(r"limit.*must be positive", plot_error_map, errors, limit=limit)


@pytest.mark.slow
def test_page_says_what_the_laws_do(monkeypatch, tmp_path):
    """The ranking and the best law as the pages of laws have them; a changed number is noticed."""
    import law_ranking as script

    named = ("steel_ball", "ranking", "softer", "tsuji")
    assert script.stale(named) == []
    page = (ROOT / "docs/laws_study.md").read_text(encoding="utf-8")
    assert "| 0.427 | 0.364 |" in page
    changed = page.replace("| 0.427 | 0.364 |", "| 0.437 | 0.364 |")
    (tmp_path / "laws_study.md").write_text(changed, encoding="utf-8")
    monkeypatch.setattr(script, "PAGES", (script.PAGES[0], tmp_path / "laws_study.md"))
    assert script.stale(("ranking",)) == ["ranking"]
