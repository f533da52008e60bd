"""The phase machine against Barber's closed form, which shares no code with it, during stick."""

import numpy as np
import pytest
from tests.oracles.stick import Stick

import carom

RNG = np.random.default_rng(4)
TOUCH = [
    (p, c) for p, c in zip(RNG.uniform(0, 1, 10), 10 ** RNG.uniform(-1.3, 1.78, 10), strict=True)
]
SLIDES = [
    (1 + (2 * c - 1) * p, c)
    for p, c in zip(RNG.uniform(0, 1, 10), RNG.uniform(0.6, 10, 10), strict=True)
]


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "chi"), TOUCH + SLIDES)
def test_stick_phase(psi, chi):
    """Its start and end, and psi, Q and U within it, to 1e-10."""
    exact = Stick.from_touch(psi, chi) if psi <= 1.0 else Stick.after_gross_slip(psi, chi)
    solution = carom.solve(psi, chi)
    phase = next(phase for phase in solution.phases if phase.kind == "stick")
    start, end = solution.at([phase.start, phase.end]).speed
    assert start == pytest.approx(exact.start, abs=1e-10)
    assert end == pytest.approx(exact.end, abs=1e-10)
    now = solution.at(np.linspace(phase.start, phase.end, 9))
    assert np.allclose(now.psi, exact.psi(now.speed), rtol=0.0, atol=1e-10)
    assert np.allclose(now.force, exact.force(now.speed), rtol=0.0, atol=1e-10)
    assert np.allclose(now.displacement, exact.displacement(now.speed), rtol=0.0, atol=1e-10)
    assert np.sign(solution.at(phase.end).psi[0]) == exact.slip_sign
