"""The published tests of Chung & Ooi (2011), Granular Matter 13:643, as the pack has them.

Figures are digitised: 1 % of the range of an axis is allowed for.
"""

import math

import numpy as np
import pytest

from carom.bodies.cases import pair_of
from carom.verify.pack.frozen import DecimalTable, case_of, frozen_files, read_table

SERIES = {
    "chung_ooi/test4_aluminium_oxide": "DEM aluminium oxide",
    "chung_ooi/test4_aluminium_alloy": "DEM aluminium alloy",
}
RANGE = {"restitution": 0.6, "spin": 800.0}  # of the axes of test 4
COLUMN = {"restitution": "tangential_restitution", "spin": "spin_out"}


def table(path: str) -> DecimalTable:
    return read_table(frozen_files()[f"chung_ooi/{path}.csv"])


def picked(published: DecimalTable, column: str, **wanted: str) -> tuple[np.ndarray, np.ndarray]:
    """Return abscissa and value of the points of a series and a kind."""
    columns = [np.array(published.columns[name]) == value for name, value in wanted.items()]
    chosen = np.all(columns, axis=0)
    abscissa = "x" if "x" in published.columns else "incidence_deg"
    return published.numbers(abscissa)[chosen], published.numbers(column)[chosen]


def exact_curve(folder: str, what: str) -> tuple[np.ndarray, np.ndarray]:
    reference = read_table(frozen_files()[f"{folder}/reference.csv"])
    speeds = [reference.numbers(name) for name in ("tangential_speed", "normal_speed")]
    after = reference.numbers("tangential_speed_out") / speeds[0]
    spin = reference.numbers("spin_out")
    return np.degrees(np.arctan2(*speeds)), after if what == "restitution" else spin


@pytest.mark.parametrize(("test", "row"), [("test1", 0), ("test2", 1)])
def test_peak_forces(test, row):
    """Tests 1 and 2: 7108 N and 7233 N, to the digits published, of the bodies published."""
    published = table("published/test1_2_peak_force")
    peak = table(f"{test}/reference").numbers("max_force")[0]
    assert peak == pytest.approx(published.numbers("peak_force")[row], abs=0.5)
    case = case_of(f"chung_ooi/{test}")
    stuff = case["first"]["material"]
    assert case["first"]["radius"] == published.numbers("radius")[row]
    for name in ("young", "poisson", "density"):
        assert stuff[name] == published.numbers(name)[row]


def test_durations():
    """Tests 1 and 2: 2.868 (m^2/(R E*^2 V))^(1/5), Johnson (1985), (11.24)."""
    for test in ("test1", "test2"):
        pair, reference = pair_of(case_of(f"chung_ooi/{test}")), table(f"{test}/reference")
        speed = reference.numbers("normal_speed")[0]
        squares = pair.normal_mass**2 / (pair.effective_radius * pair.effective_modulus**2 * speed)
        assert reference.numbers("duration")[0] == pytest.approx(2.8683 * squares**0.2, rel=1e-4)


@pytest.mark.parametrize("folder", SERIES)
@pytest.mark.parametrize("what", RANGE)
def test_sliding_points_of_test_4(folder, what):
    """v_t'/v_t = 1 - mu (1 + e)/tan(incidence), spin = -2.5 mu (1 + e) V_n/R, e = 0.98."""
    published = table(f"published/test4_{what}")
    angle, value = picked(published, COLUMN[what], series=SERIES[folder], kind="sliding")
    assert angle.size == 7
    lost = 0.092 * 1.98
    expected = {
        "restitution": 1.0 - lost / np.tan(np.radians(angle)),
        "spin": -2.5 * lost * 3.9 * np.cos(np.radians(angle)) / 0.0025,
    }
    assert np.all(np.abs(value - expected[what]) <= 0.01 * RANGE[what])


@pytest.mark.parametrize("folder", SERIES)
@pytest.mark.parametrize("what", RANGE)
def test_approximate_laws_of_test_4_are_not_exact(folder, what):
    """At least four of the six published points miss the exact curve by 3 % of the axis and more.

    e = 0.98 rather than 1 explains 1 % at most.
    """
    published = table(f"published/test4_{what}")
    angle, value = picked(published, COLUMN[what], series=SERIES[folder], kind="approximate law")
    assert angle.size == 6
    off = np.abs(value - np.interp(angle, *exact_curve(folder, what)))
    assert np.sum(off > 0.03 * RANGE[what]) >= 4
    slow = value[0] if what == "spin" else 1.0 - value[0]
    exact = exact_curve(folder, what)[1][0]
    assert abs(slow) < 0.6 * abs(exact if what == "spin" else 1.0 - exact)  # too little at 5 deg


def test_experiment_is_nearer_to_the_exact_curve_than_the_laws_are():
    """Restitution below 20 degrees: measured points (on glass) against both DEM series."""
    published = table("published/test4_restitution")
    curve = exact_curve("chung_ooi/test4_aluminium_oxide", "restitution")

    def largest(series: str) -> float:
        angle, value = picked(published, "tangential_restitution", series=series)
        near = (angle > 4.0) & (angle < 20.0)
        return float(np.max(np.abs(value - np.interp(angle, *curve))[near]))

    assert largest("Kharaz et al. 2001") < 0.05
    assert largest("DEM aluminium oxide") > 0.15


@pytest.mark.parametrize(("what", "line", "span"), [("restitution", 0, 1.0), ("recoil", 1, 8.0)])
def test_sliding_points_of_test_6(what, line, span):
    """e = 0.5, mu = 0.4: V_t' = V_t - 3.5 mu (1 + e) V_n, as lines in both figures.

    2 % of the ordinate, for the abscissa is digitised, too. What sticks is 4 % and more off.
    """
    published = table(f"published/test6_{what}")
    lines = (lambda x: x - 1.0, lambda x: (x - 3.5 * 0.4 * 1.5) / 0.5)
    for series in ("DEM aluminium alloy", "DEM nylon"):
        x, y = picked(published, "y", series=series, kind="sliding")
        assert x.size == 5
        assert np.all(np.abs(y - lines[line](x)) <= 0.02 * span)
        x, y = picked(published, "y", series=series, kind="approximate law")
        assert x.size == 12
        assert np.all(np.abs(y - lines[line](x)) >= 0.04 * span)


def test_opposite_spins():
    """Test 7: v_t' = 0 and both spins as before, to the last digit."""
    reference = table("test7/reference")
    assert np.all(reference.numbers("tangential_speed_out") == 0.0)
    for name in ("spin", "spin2"):
        assert reference.columns[f"{name}_out"] == reference.columns[name]
    assert np.all(reference.numbers("spin") == -reference.numbers("spin2"))


def test_motion_of_test_4():
    """3.9 m/s at 5, 10, ..., 85 degrees, no spin."""
    for folder in SERIES:
        inputs = read_table(frozen_files()[f"{folder}/results.csv"])
        normal, tangential = inputs.numbers("normal_speed"), inputs.numbers("tangential_speed")
        assert np.hypot(normal, tangential) == pytest.approx(3.9, rel=1e-11)
        angles = [math.degrees(math.atan2(t, n)) for t, n in zip(tangential, normal, strict=True)]
        assert angles == pytest.approx(range(5, 90, 5), abs=1e-9)
        assert np.all(inputs.numbers("spin") == 0.0)


def test_tests_of_the_pack_say_what_is_truth():
    """Every published point of a DEM code is called sliding or an approximate law."""
    for name, text in frozen_files().items():
        if "published/test4" in name or "published/test6" in name:
            published = read_table(text)
            kinds = zip(published.columns["series"], published.columns["kind"], strict=True)
            for series, kind in kinds:
                allowed = {"sliding", "approximate law"} if "DEM" in series else {"experiment"}
                assert kind in allowed, name
            assert any("not truth" in note for note in published.notes)
