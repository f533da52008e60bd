"""The map of regimes names every sequence, by labels that are clear of each other."""

import re
from functools import cache

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.text import Text
from tests.checks import is_legible

import carom
from carom.plots import plot_regime_map, save_figure
from carom.plots.legends import wrapped
from carom.plots.regime_map import group_of
from carom.plots.regimes import REGIMES, regime_of
from carom.plots.region_labels import SMALLEST_LABEL, find_labels, in_letters
from carom.plots.regions import limits, regions

SPACES = str.maketrans({"\n": " ", "\u00a0": " "})


@pytest.fixture(scope="module")
def maps():
    """Many regimes, few, ends in stick or slip on a line, mirror images; no outlines, borders."""
    line = np.linspace
    many = carom.regime_map(line(0.02, 6.02, 61), line(0.103, 5.003, 50))
    few = carom.regime_map(line(0.05, 3.0, 20), line(0.05, 3.0, 20))
    fine = [name for name in few.variables if name.startswith(("border_", "outline_"))]
    return {
        "many": many,
        "few": few,
        "points": few.drop_vars(fine),
        "half": carom.regime_map(line(0.0, 2.0, 21), line(0.3, 0.6, 13)),
        "mirrored": carom.regime_map(line(-6.0, 6.0, 40), line(0.1, 4.0, 30)),
        "row": carom.regime_map(line(0.0, 6.0, 25), [1.44]),
    }


@pytest.fixture(scope="module")
def regions_of(maps):
    return cache(lambda name: regions(maps[name]))


@pytest.fixture(scope="module")
def drawn(maps):
    return cache(lambda name, width: plot_regime_map(maps[name], width=width))


NAMES = ("many", "few", "half", "mirrored", "row", "points")


@pytest.mark.slow
@pytest.mark.parametrize("width", [178.0, pytest.param(120.0, marks=pytest.mark.slow), 86.0])
@pytest.mark.parametrize("name", NAMES)
def test_every_sequence_is_named_and_all_text_is_legible(drawn, regions_of, name, width):
    """In a label or below the map, those that only outlines know too; and numbers are explained."""
    figure = drawn(name, width)
    labels = {text.get_text().translate(SPACES) for text in figure.axes[0].texts}
    below = figure.get_supxlabel().translate(SPACES)
    listed = set(re.sub(r"Not marked, [^:]*: ", "; ", below).split("; "))
    listed = {entry.split(" = ")[-1].split(" (")[0].strip("; ") for entry in listed}
    for region in regions_of(name):
        assert " ".join(in_letters(region.name)) in labels | listed, region.name
    numbers = sorted({int(label) for label in labels if label.isdigit()})
    assert numbers == list(range(1, len(numbers) + 1))
    for number in numbers:
        assert f"{number} = " in below
    assert is_legible(figure)
    axis = figure.axes[0]
    for line in (line for line in axis.lines if line.get_marker() == "o"):
        end = axis.transAxes.transform(line.get_xydata()[1])
        ends_in = [text for text in axis.texts if text.get_window_extent().contains(*end)]
        assert len(ends_in) == 1, "a leader line ends at its label"


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_leader_lines_run_clear_of_labels_and_begin_in_their_region(maps, regions_of, name):
    """Labels without a line lie in their region; to a tenth of a millimetre."""
    actual = regions_of(name)
    low, high = np.transpose([limits(maps[name], axis) for axis in ("psi_in", "chi")])
    factor = np.array([120.0, 70.0]) / (high - low)
    placed = find_labels(actual, [], np.array([factor, -low * factor]), (120.0, 70.0)).placed
    assert placed
    for number, label in placed.items():
        half = 0.5 * np.array([label.block.width, label.block.height])
        if label.start is None:
            corners = [label.at + half * (x, y) for x in (-1, 1) for y in (-1, 1)]
            assert np.all(actual[number].holds(np.array(corners) / factor + low)), number
        else:
            assert actual[number].holds(label.start[np.newaxis] / factor + low)[0], number
        for other in (label for n, label in placed.items() if n != number):
            other_half = 0.5 * np.array([other.block.width, other.block.height])
            apart = np.abs(label.at - other.at) - half - other_half
            assert apart.max() > -0.1
            if label.start is not None:
                end = np.clip(label.start, label.at - half, label.at + half)
                points = np.linspace(label.start, end, 400)
                near = np.abs(points - other.at) - other_half
                assert near.max(axis=1).min() > -0.1


@pytest.mark.parametrize(
    ("sequence", "regime", "reversals"),
    [
        ("gross slip +", "gross slip only", 0),
        ("stick", "stick", 0),
        ("stick, slip -, gross slip -", "stick", 0),
        ("gross slip +, stick, slip -, gross slip -", "gross slip, stick", 1),
        ("gross slip +, slip -, gross slip -", "gross slip, slip", 1),
        ("stick, slip -, stick, slip +, slip -, gross slip -", "stick", 2),
        ("gross slip -, stick, slip +, slip -, slip +", "gross slip, stick", 3),
    ],
)
def test_impacts_are_grouped_by_their_regime_and_the_reversals_of_slip(sequence, regime, reversals):
    assert group_of(sequence) == (regime, reversals)


def test_colours_tell_groups_apart(drawn, regions_of):
    """One colour a group: that of the regime in all figures, darker where slip reverses."""
    figure, faces = drawn("many", 178.0), {}
    for region, patch in zip(regions_of("many"), figure.axes[0].patches, strict=True):
        faces.setdefault(group_of(region.name), set()).add(to_rgb(patch.get_facecolor()))
    assert all(len(colours) == 1 for colours in faces.values())
    assert len(set.union(*faces.values())) == len(faces) >= 9
    assert {key.regime for key in faces} == set(REGIMES)
    for regime, band in REGIMES.items():
        row = {
            key.reversals: next(iter(faces[key])) for key in sorted(faces) if key.regime == regime
        }
        assert row.get(0, to_rgb(band.face)) == to_rgb(band.face)
        greens = [green for _, green, _ in row.values()]
        assert greens == sorted(greens, reverse=True)
    shown = {to_rgb(patch.get_facecolor()) for patch in figure.legends[0].get_patches()}
    assert set.union(*faces.values()) <= shown


def test_the_borders_part_the_regimes(maps):
    """The lines 1, 2 chi and 4 chi - 1, between which the curve and the score are shaded."""
    for region in regions(maps["many"]):
        psi, chi = np.mean(region.rings[0], axis=0)
        if region.holds([(psi, chi)])[0]:
            ends = np.maximum(1.0, [1.0, 2.0 * chi, 4.0 * chi - 1.0])
            assert regime_of(region.name) == [*REGIMES][np.sum(psi > ends)], region.name


@pytest.mark.slow
def test_edges_are_curves_and_not_pixels(maps, drawn, regions_of, tmp_path):
    """There is no picture in a vector file; and steps only where a dataset has no outlines.

    Steps are horizontal or vertical, but for corners that are cut by at most half a cell.
    """
    stored = save_figure(drawn("many", 178.0), tmp_path / "map.svg")
    assert "<image" not in stored.read_text(encoding="utf-8")
    slopes, cells = {}, np.diff(maps["points"].psi_in.values[:2])  # as high as they are wide
    for name in ("many", "points"):
        rings = [ring for region in regions_of(name) for ring in region.rings]
        steps = np.concatenate([np.diff(ring, axis=0) for ring in rings])
        slopes[name] = len(np.unique(np.round(np.arctan2(steps[:, 1], steps[:, 0]), 6)))
    assert slopes["many"] > 200
    slanted = np.abs(steps[np.all(np.abs(steps) > 1e-9, axis=1)] / cells)
    assert slanted.size
    assert slanted.max() < 0.5 + 1e-9


def test_what_is_not_resolved_is_said_to_be(maps):
    """A region of its own with a hatch, a name, and no colour in the legend."""
    holed = maps["points"].copy(deep=True)
    holed.sequence.values[2:8, 10:17] = -1
    figure = plot_regime_map(holed, width=86.0)
    (hatched,) = [patch for patch in figure.axes[0].patches if patch.get_hatch()]
    assert to_rgb(hatched.get_facecolor()) == (1.0, 1.0, 1.0)
    assert "not resolved" in [t.get_text().translate(SPACES) for t in figure.findobj(Text)]


def test_long_lines_are_broken_where_there_is_room():
    text = "one two three four five six seven"
    lines = wrapped(text, 60.0).split("\n")
    assert len(lines) > 1
    assert " ".join(lines) == text
    assert SMALLEST_LABEL == 0.2, "as the docstring of plot_regime_map and the tests have it"
