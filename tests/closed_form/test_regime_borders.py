"""The borders on a map of regimes: closed forms, the sequences beside them, and inside regions."""

from itertools import pairwise

import numpy as np
import pytest

import carom
from carom.impacts.map_borders import ELASTIC, Image, bisected
from carom.plots.outlines import lattice, outlines
from carom.plots.regions import area, limits, regions

PSI, CHI = np.linspace(0.02, 6.02, 61), np.linspace(0.103, 5.003, 50)


@pytest.fixture(scope="module")
def regimes():
    return carom.regime_map(PSI, CHI)


@pytest.fixture(scope="module")
def coarse():
    """A map of few points, most of whose regimes are smaller than its cells."""
    return carom.regime_map(np.linspace(0.1, 6.0, 9), np.linspace(0.2, 4.8, 9))


def curves(regimes):
    """Yield the sequences on both sides of every border, and its points."""
    points = np.column_stack([regimes.border_psi, regimes.border_chi])
    for number in range(regimes.sizes["border_curve"]):
        sides = {str(regimes[name].values[number]) for name in ("border_left", "border_right")}
        yield sides, points[regimes.border_number.values == number]


def frame_of(regimes):
    """Return the limits of a map: the least psi_1 and chi, the largest."""
    return np.transpose([limits(regimes, name) for name in ("psi_in", "chi")])


def inner(regimes, line):
    """Return the points of a border but for its ends, where these meet others inside the map."""
    ends = [np.any(np.isin(point, frame_of(regimes))) for point in (line[0], line[-1])]
    return line[0 if ends[0] else 1 : len(line) if ends[1] else -1]


def sequence(psi, chi, losses=None):
    """Return the phases of one impact as `solve` tells them."""
    signs = {0: "", 1: " +", -1: " -"}
    solution = carom.solve(psi, chi, losses=losses)
    return ", ".join(f"{phase.kind}{signs[phase.sign]}" for phase in solution.phases)


def distances(points, regimes):
    """Return how far points are from the next border, in shares of the axes."""
    unit = np.ptp(frame_of(regimes), axis=0)
    nearest = np.full(len(points), np.inf)
    for _, line in curves(regimes):
        for start, end in pairwise(line / unit):
            along, out = end - start, points / unit - start
            share = np.clip(out @ along / max(along @ along, 1e-300), 0.0, 1.0)
            nearest = np.minimum(nearest, np.hypot(*(out - share[:, np.newaxis] * along).T))
    return nearest


def begins(words):
    return lambda regime: regime.startswith(words)


BORDERS = {
    "1": (begins("stick"), begins("gross slip +"), 1.0, 0.0),
    "2 chi": (begins("gross slip +, stick"), begins("gross slip +, slip -"), 0.0, 2.0),
    "4 chi - 1": (lambda regime: regime == "gross slip +", begins("gross slip +, "), -1.0, 4.0),
}


@pytest.mark.first_case
@pytest.mark.parametrize("name", BORDERS)
def test_borders_are_those_in_closed_form(regimes, name):
    """Between the ends of curves, where several borders meet, to the tolerance, and all along."""
    one, other, start, slope = BORDERS[name]
    points = [
        inner(regimes, line)
        for sides, line in curves(regimes)
        for a, b in (sorted(sides), sorted(sides, reverse=True))
        if one(a) and other(b)
    ]
    psi, chi = np.concatenate(points).T
    error = np.abs(psi - (start + slope * chi))
    tolerance = float(regimes.border_tolerance)
    assert np.all(error <= max(1.0, slope) * tolerance * np.maximum(1.0, psi))
    seen = np.sort(chi)
    last = min(CHI[-1], (PSI[-1] - start) / slope) if slope else CHI[-1]
    first = 0.5 if slope else CHI[0]
    assert seen[0] == pytest.approx(first, abs=0.15)
    assert seen[-1] == pytest.approx(last, abs=1e-6)
    assert np.diff(seen).max() < 0.2


def test_the_rebound_sticks_on_both_sides_of_chi_one_half(regimes):
    """Below psi_1 = 1 the first slip changes its sign at chi = 1/2, where nothing slips."""
    wanted = {"stick, slip +, gross slip +", "stick, slip -, gross slip -"}
    (line,) = [points for sides, points in curves(regimes) if sides == wanted]
    assert np.abs(inner(regimes, line)[:, 1] - 0.5).max() <= float(regimes.border_tolerance)


@pytest.mark.first_case
@pytest.mark.parametrize("which", ["regimes", "coarse"])
def test_sequences_beside_borders_are_those_of_single_impacts(which, request):
    """A step of at most two tolerances, along psi_1 or chi, leads from one side to the other."""
    values = request.getfixturevalue(which)
    steps = np.array([-2.0, -1.0, -0.5, 0.5, 1.0, 2.0]) * float(values.border_tolerance)
    rng, checked = np.random.default_rng(5), 0
    for sides, line in curves(values):
        for psi, chi in rng.permutation(inner(values, line))[:4]:
            beside = {sequence(psi + x, chi) for x in steps * max(1.0, psi)}
            beside |= {sequence(psi, chi + y) for y in steps * max(1.0, chi)}
            assert sides <= beside, (psi, chi)
            checked += 1
    assert checked > 40


@pytest.mark.parametrize("which", ["regimes", "coarse"])
def test_points_have_the_sequence_of_the_region_that_holds_them(which, request):
    """Away from borders; every point is in one region, by the rule of even and odd crossings."""
    values = request.getfixturevalue(which)
    points = np.random.default_rng(77).uniform(*frame_of(values), (500, 2))
    points = points[distances(points, values) > 1e-3]
    assert len(points) > 450
    shapes = regions(values)
    inside = np.array([region.holds(points) for region in shapes])
    np.testing.assert_array_equal(inside.sum(axis=0), 1)
    for (psi, chi), number in zip(points, inside.argmax(axis=0), strict=True):
        assert sequence(psi, chi) == shapes[number].name, (psi, chi)


@pytest.mark.parametrize("which", ["regimes", "coarse"])
def test_regions_fill_the_map(which, request):
    values = request.getfixturevalue(which)
    whole = np.prod(np.ptp(frame_of(values), axis=0))
    filled = sum(area(ring) for region in regions(values) for ring in region.rings)
    assert filled == pytest.approx(whole, rel=1e-12)


def test_regimes_between_points_are_found(coarse):
    """Borders know more sequences than the points of the map."""
    values = set(coarse.sequence_name.values.tolist())
    met = {name for sides, _ in curves(coarse) for name in sides}
    assert len(met - values) > 3
    assert values <= met


@pytest.mark.slow
def test_what_is_too_narrow_for_an_outline_is_met():
    """At chi = 4 the last slip reverses in less than a thousandth of psi_1 beyond 0.4."""
    regimes = carom.regime_map(np.linspace(0.05, 18.0, 80), np.linspace(3.0, 5.0, 41))
    met = set(regimes.sequence_met.values.tolist())
    assert {"stick, slip -, slip +, slip -", "stick, slip -, slip +, slip -, slip +"} <= met
    assert {name for sides, _ in curves(regimes) for name in sides} <= met
    assert set(regimes.sequence_name.values.tolist()) <= met
    assert sequence(0.4002, 4.0) in met


def test_curves_are_the_same_whatever_the_order_of_the_points():
    points = np.linspace(0.5, 4.5, 9), np.linspace(0.6, 1.8, 7)
    one, other = carom.regime_map(*points), carom.regime_map(*(values[::-1] for values in points))
    for name in ("border_psi", "border_chi"):
        np.testing.assert_array_equal(np.sort(one[name]), np.sort(other[name]))
    assert [r.name for r in regions(one)] == [r.name for r in regions(other)]


def test_a_map_without_cells_has_no_borders():
    row = carom.regime_map(PSI, [1.44])
    assert row.sizes["border_point"] == row.sizes["border_curve"] == 0
    assert [region.name for region in regions(row)]


@pytest.mark.slow
def test_borders_are_stored_and_read(regimes, tmp_path):
    stored = carom.read(carom.save(regimes, tmp_path / "map.nc"))
    for name in (name for name in regimes.variables if name.startswith("border_")):
        np.testing.assert_array_equal(stored[name], regimes[name])
        assert stored[name].attrs["long_name"]
    empty = carom.read(carom.save(carom.regime_map([1.0], [1.0]), tmp_path / "one.nc"))
    assert empty.sizes["border_point"] == 0


def test_with_losses_sliding_begins_at_2_chi_1_plus_e_less_e():
    """And stick after gross slip ends at 2 chi; to the coarser tolerance of maps with losses."""
    losses, e = carom.KelvinVoigt(restitution=0.8), 0.8
    regimes = carom.regime_map(np.linspace(1.2, 3.4, 6), [0.7, 1.0, 1.4], losses=losses)
    slides = [inner(regimes, line) for sides, line in curves(regimes) if "gross slip +" in sides]
    grips = [
        inner(regimes, line)
        for sides, line in curves(regimes)
        if {name.split(", ")[1][:5] for name in sides if ", " in name} == {"stick", "slip "}
    ]
    tolerance = float(regimes.border_tolerance)
    for lines, start, slope in ((slides, -e, 2.0 * (1.0 + e)), (grips, 0.0, 2.0)):
        psi, chi = np.concatenate(lines).T
        assert len(psi) > 3
        assert np.abs(psi - (start + slope * chi)).max() <= slope * tolerance * psi.max()


@pytest.mark.parametrize("above", [3, 0])
def test_discs_and_strips_are_found_whole(above):
    """A disc, a strip narrower than a cell that a point has met, and sides that are straight.

    A strip between two regions is followed to its end; one inside a region is if lines of the image
    are closer than it is wide.
    """

    def tell(x, y):
        disc, height = np.hypot(x - 3.0, y - 2.0) < 1.5, y - 0.4 * x - 2.9
        beside = np.where(height > 0.0, above, 0)
        return np.where(disc, 1, np.where(np.abs(height) < 0.02, 2, beside)).astype(np.int64)

    x, y = np.linspace(0.0, 6.0, 16), np.linspace(0.0, 6.0, 17)
    labels = tell(*np.meshgrid(x, y))
    assert 0 < np.sum(labels == 2) < 6
    fineness = ELASTIC if above else ELASTIC._replace(lines=(240, 240))
    image = Image(x, y, labels, tell)
    image.refine(fineness)
    rings = [*outlines(image.labels, *bisected(image, fineness.tolerance))]
    near = 6.0 * fineness.closest
    (ring,) = [ring for ring in rings if ring.label == 1]
    disc = ring.points
    error = np.abs(np.hypot(*(disc - (3.0, 2.0)).T) - 1.5)
    assert error[ring.beyond >= 0].max() < 1e-6
    assert error.max() < near, "where three regions meet, too"
    assert area(disc) == pytest.approx(np.pi * 1.5**2, rel=2e-3)
    (ring,) = [ring for ring in rings if ring.label == 2]
    strip = ring.points[ring.beyond >= 0]
    assert np.abs(np.abs(strip[:, 1] - 0.4 * strip[:, 0] - 2.9) - 0.02).max() < 1e-6
    assert np.ptp(strip[:, 0]) > 5.9


def test_outlines_meet_where_three_regions_do():
    """Whichever way corners differ, regions fill their image without a gap."""
    labels = np.random.default_rng(8).integers(0, 4, (12, 15))
    rings = [*outlines(labels, lattice(np.arange(15.0), np.arange(12.0)))]
    assert sum(area(ring.points) for ring in rings) == pytest.approx(14.0 * 11.0, rel=1e-12)
