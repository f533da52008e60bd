"""The sequence of phases, and the borders at which it changes."""

from itertools import pairwise

import numpy as np
import pytest

import carom
from carom.dimensionless.elastic.phases import TRANSITIONS, Kind
from carom.dimensionless.states import KIND_NAMES
from carom.quantities.statuses import Cause

STICK, PLUS, MINUS = ("stick", 0), ("slip", 1), ("slip", -1)
GROSS_PLUS, GROSS_MINUS = ("gross slip", 1), ("gross slip", -1)


def sequence(psi, chi):
    return [(phase.kind, phase.sign) for phase in carom.solve(psi, chi).phases]


@pytest.mark.parametrize(
    ("psi", "expected"),
    [
        *((0.5, [STICK, MINUS, GROSS_MINUS]), (1.0, [STICK, MINUS, GROSS_MINUS])),
        (1.001, [GROSS_PLUS, STICK, MINUS, GROSS_MINUS]),
        (2.87, [GROSS_PLUS, STICK, MINUS, GROSS_MINUS]),
        *((2.88, [GROSS_PLUS, MINUS, GROSS_MINUS]), (4.7, [GROSS_PLUS, MINUS, GROSS_MINUS])),
        (4.77, [GROSS_PLUS]),
    ],
)
def test_regimes_of_a_solid_sphere(psi, expected):
    assert sequence(psi, 1.44) == expected
    assert sequence(-psi, 1.44) == [(kind, -sign) for kind, sign in expected]


@pytest.mark.parametrize(
    ("psi", "chi", "expected"),
    [
        (0.3, 1.75, [STICK, MINUS, PLUS, GROSS_PLUS]),  # the ring closes
        (0.5, 0.3, [STICK, PLUS, GROSS_PLUS]),  # first microslip forward
        (1.0, 0.3, [GROSS_PLUS]),  # the tie slips below chi = 1/2
        (0.2, 6.0, [STICK, PLUS]),  # forward again between 4 and 65/6
    ],
)
def test_other_bodies(psi, chi, expected):
    assert sequence(psi, chi)[: len(expected)] == expected


@pytest.mark.parametrize("chi", [0.05, 0.4, 0.5, 0.6, 1.44, 1.75, 3.0, 4.0, 9.0, 30.0])
@pytest.mark.parametrize("shift", [-1e-9, -1e-13, 0.0, 1e-13, 1e-9])
def test_continuous_across_the_borders(chi, shift):
    """psi_2 changes by no more than a multiple of the step across 0, 1, 2 chi and 4 chi - 1."""
    for border in (0.0, 1.0, 2.0 * chi, 4.0 * chi - 1.0):
        step = carom.rebound(border + shift, chi) - carom.rebound(border, chi)
        assert abs(step) <= 50.0 * abs(shift) + 1e-11


@pytest.mark.first_case
@pytest.mark.parametrize(
    "border", [lambda c: 1.0 + 0.0 * c, lambda c: 2.0 * c, lambda c: 4.0 * c - 1.0]
)
def test_solved_to_the_last_bit_of_the_borders(border):
    """Within 1e-13 of a border every impact is solved, and differs by no more than 1e-11."""
    chi = np.random.default_rng(6).uniform(0.05, 10.0, 1000)
    at = np.abs(border(chi))
    there = carom.rebound(at, chi)
    for shift in (1e-16, 1e-15, 3e-15, 1e-14, 1e-13, 1e-12):
        for psi in (at * (1.0 - shift), at * (1.0 + shift)):
            out, status = carom.rebound(psi, chi, return_status=True)
            assert not status.any()
            assert np.all(np.abs(out - there) <= 2e-11 * np.maximum(1.0, at))


@pytest.mark.parametrize("psi", [0.2, 1.3, 2.0, 3.5])
def test_transition_to_stick_and_start_of_slip(psi):
    """Gross slip gives way to stick at V_z/V_1 = (psi_1 - 2 chi)/(1 - 2 chi), (34); slip starts
    where |psi| = |v|."""
    chi = 1.44
    solution = carom.solve(psi, chi)
    for before, after in pairwise(solution.phases):
        now = solution.at(before.end)
        if before.kind == "gross slip":
            assert now.speed[0] == pytest.approx((psi - 2 * chi) / (1 - 2 * chi), abs=1e-13)
        if after.kind == "slip":
            assert abs(now.psi[0]) == pytest.approx(abs(now.speed[0]), abs=1e-12)


def test_phases_follow_each_other_without_gaps_and_by_the_table():
    kinds = {name: kind for kind, name in KIND_NAMES.items()}
    causes = {cause.message: cause for cause in Cause}
    rng = np.random.default_rng(3)
    for psi, chi in zip(rng.uniform(-8, 8, 200), 10 ** rng.uniform(-1, 1.7, 200), strict=True):
        solution = carom.solve(psi, chi)
        phases = solution.phases
        assert phases[0].start == 0.0
        assert phases[-1].end == pytest.approx(solution.duration, abs=1e-12)
        assert phases[-1].cause == "separation"
        for before, after in pairwise(phases):
            assert before.end == after.start
            assert (before.kind, before.sign) != (after.kind, after.sign)
            key = (kinds[before.kind], causes[before.cause], before.end > 0.5 * solution.duration)
            after_kind, _ = TRANSITIONS[key]
            # slip that starts on memory of its own sign is gross slip at once
            assert kinds[after.kind] in (after_kind, Kind.GROSS_SLIP)


def test_long_sequences_at_large_chi():
    """The faster the tangential motion, the more reversals: but never more than the bound."""
    counts = [len(carom.solve(0.5, chi).phases) for chi in (1.44, 10.0, 60.0, 2000.0)]
    assert counts == sorted(counts)
    assert counts[-1] > 20
