"""What three grids tell of the error: sequences whose limits are known."""

import pytest

from carom.halfspace.solution import Resolution, refinement_error


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0, 3.0])
def test_an_error_of_known_order_is_covered(order):
    """1 + h^p on grids of 4 h, 2 h and h: covered, by the last change or part of the first."""
    quarter, half, whole = (1.0 + (0.01 * n) ** order for n in (4.0, 2.0, 1.0))
    error = whole - 1.0
    assert error <= refinement_error(quarter, half, whole) * (1.0 + 1e-9)
    last = 2.0**order - 1.0
    allowed = max(last, 0.3 * 2.0**order * last) * 1.001 * error
    assert refinement_error(quarter, half, whole) <= allowed


def test_slow_convergence_is_recognised():
    """Of order 1/2 changes fall by 0.71 only: their geometric series is the error."""
    quarter, half, whole = (1.0 + (0.01 * n) ** 0.5 for n in (4.0, 2.0, 1.0))
    actual = refinement_error(quarter, half, whole)
    assert actual == pytest.approx(whole - 1.0, rel=1e-9)
    assert actual > 2.0 * abs(whole - half)


def test_no_convergence_is_told():
    """Changes that grow: three times the last, at least."""
    assert refinement_error(0.0, 0.1, 0.3) == pytest.approx(0.6)


def test_errors_of_both_signs_do_not_hide():
    """The last two agree by chance: three tenths of the change before are still told."""
    assert refinement_error(0.5, 0.0, 0.0) == pytest.approx(0.15)


def test_half_as_fine():
    assert Resolution(64, 300).half.half == (16, 75)
    assert Resolution(3, 3).half == (2, 2)
