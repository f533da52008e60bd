"""The map of regimes names the phases of single impacts, and bad axes are refused."""

import numpy as np
import pytest

import carom
from carom.impacts.curves import borders, regime_map


def test_regime_map_agrees_with_single_impacts():
    """Codes name the phases of `solve`; the first phase follows from psi_1 < 1 alone."""
    rng = np.random.default_rng(1979)
    chi, psi = np.sort(rng.uniform(0.1, 4.0, 6)), np.sort(rng.uniform(0.05, 9.0, 7))
    regimes = regime_map(psi, chi)
    names = regimes.sequence_name.values[regimes.sequence.values]
    for (row, column), name in np.ndenumerate(names):
        phases = carom.solve(psi[column], chi[row]).phases
        assert [word.split(" ")[0] for word in name.split(", ")] == [
            phase.kind.split(" ")[0] for phase in phases
        ]
        assert name.startswith("stick") == (psi[column] < 1.0)
        assert (name == "gross slip +") == (psi[column] > borders(chi[row])[2])


def test_the_commonest_sequence_comes_first():
    regimes = regime_map(np.linspace(2.0, 9.0, 8), [0.5, 0.7, 3.0])
    counts = np.bincount(regimes.sequence.values.ravel())
    assert np.all(np.diff(counts) <= 0)
    assert counts.size == regimes.sizes["sequence_name"]


def test_progress_counts_the_rows():
    calls = []
    regime_map([5.0], [0.4, 0.6, 1.0], progress=lambda done, of: calls.append((done, of)))
    assert calls == [(1, 3), (2, 3), (3, 3)]


@pytest.mark.parametrize(
    ("psi", "chi", "named"),
    [
        *(([], [1.0], "psi_1"), ([np.nan], [1.0], "psi_1"), ([[1.0]], [1.0], "psi_1")),
        *(("fast", [1.0], "psi_1"), ([1.0], [], "chi"), ([1.0], [1.0, 0.0], "chi")),
    ],
)
def test_bad_axes_are_refused_by_name(psi, chi, named):
    with pytest.raises(carom.InputError, match=f"^{named}: ") as refused:
        regime_map(psi, chi)
    assert "\n" not in str(refused.value)


def test_what_holds_on_a_side_of_the_map_alone_is_no_region():
    """At psi_1 = 0 and at chi = 1/2 impacts stick throughout: two lines, which have no area."""
    chi = np.linspace(0.5, 3.0, 26)
    drawn = carom.regime_map(np.linspace(0.0, 6.0, 31), chi)
    assert drawn.sequence_name.values[drawn.sequence.values[0, 0]] == "stick"
    assert "stick" not in drawn.outline_sequence.values
    assert drawn.outline_psi.values.min() == pytest.approx(0.0, abs=1e-5)
