"""Impacts of Kelvin-Voigt solids, whatever their numbers: solved, mirrored, converged, compiled."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.rebounds import lossy_rebounds

LOSSES = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999, 0.9999)
PROGRAM = """
import json, sys
import numpy as np
from carom.dimensionless.lossy.law import LossNumbers
from carom.dimensionless.rebounds import lossy_rebounds
psi, chi, alpha = np.array(json.load(sys.stdin))
print(json.dumps(lossy_rebounds(psi, chi, LossNumbers(1, alpha)).psi_out.tolist()))
"""


def viscoelastic_rebounds(psi, chi, alpha, **more):
    """Return psi_2 and status."""
    found = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha), **more)
    return found.psi_out, found.status


def impacts(count, seed):
    """Return psi, chi, alpha and e with chi from 0.1 to 5, e from 0.05 to 0.9999."""
    rng = np.random.default_rng(seed)
    e = rng.choice(LOSSES, count)
    alphas = {each: viscous_loss(each) for each in LOSSES}
    chi = 0.1 * 50.0 ** rng.uniform(0.0, 1.0, count)
    psi = rng.uniform(1e-3, 1.0, count) * (2.0 * chi * (1.0 + e) + 1.0)
    return psi, chi, np.array([alphas[each] for each in e]), e


def test_impacts_are_solved_to_what_is_promised():
    """1e-8 max(1, psi_1): smaller panels change them by less; 5e-10 was the largest of 4000."""
    psi, chi, alpha, _ = impacts(1500, 1)
    found, status = viscoelastic_rebounds(psi, chi, alpha)
    assert np.all(status == Status.SOLVED)
    finer, status = viscoelastic_rebounds(psi, chi, alpha, tolerance=1e-10)
    assert np.all(status == Status.SOLVED)
    assert np.max(np.abs(found - finer) / np.maximum(1.0, psi)) < 1e-8


@pytest.mark.parametrize(
    ("psi", "chi"),
    [(1.545093648994644, 1.146545076114865), (0.518235231650099, 1.1852816945556663)],
)
def test_panels_that_end_with_the_loading(psi, chi):
    """To rounding, by chance."""
    given = np.array([psi * (1.0 - 1e-9), psi, psi * (1.0 + 1e-9)]), np.full(3, chi)
    found, status = viscoelastic_rebounds(*given, np.full(3, viscous_loss(0.3)))
    assert np.all(status == Status.SOLVED)
    assert np.ptp(found) < 1e-8


@pytest.mark.parametrize(
    ("psi", "chi", "e"),
    [
        (2.879973361496, 1.44, 0.9),  # slip stops just before the largest compression
        (9.747349253848784, 5.0, 0.99),  # and here just before the bodies part
        (9.747349253921556, 5.0, 0.99),
        (2.60465849294749, 5.0, 0.99),
        (1.0, 5.0, 0.05),  # where it neither begins nor does not, and losses are heavy
    ],
)
def test_events_beside_the_end_of_something(psi, chi, e):
    """Each once was missed, or told again and again; a smooth curve has no steps."""
    beside = psi * (1.0 + np.array([-2e-9, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 2e-9]))
    given = beside, np.full(7, chi), np.full(7, viscous_loss(e))
    found, status = viscoelastic_rebounds(*given)
    assert np.all(status == Status.SOLVED)
    assert np.ptp(found) < 1e-7


def test_no_energy_is_made_and_all_is_accounted_for():
    """Shear loses at least nothing, friction as well."""
    psi, chi, alpha, _ = impacts(1500, 4)
    found = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
    friction = 0.5 * (psi**2 - found.psi_out**2) - found.shear_lost
    assert np.all(found.shear_lost >= 0.0)
    assert np.min(friction / (1.0 + psi**2)) > -1e-9


def test_mirror_images():
    psi, chi, alpha, _ = impacts(200, 2)
    found, mirrored = (viscoelastic_rebounds(s * psi, chi, alpha)[0] for s in (1.0, -1.0))
    np.testing.assert_array_equal(mirrored, -found)


def test_no_impact_gains_energy():
    """|psi_2| <= |psi_1|, and Coulomb's impulse is not exceeded: psi_1 - psi_2 <= 2 chi (1 + e)."""
    psi, chi, alpha, e = impacts(1500, 3)
    found, _ = viscoelastic_rebounds(psi, chi, alpha)
    assert np.all(np.abs(found) <= psi)
    assert np.all(psi - found <= 2.0 * chi * (1.0 + e) + 1e-8)


def test_numbers_that_cannot_be_have_a_status():
    psi, chi = np.array([np.nan, 1.0, 1.0, 1.0]), np.array([1.0, 0.0, np.inf, 1e4])
    found, status = viscoelastic_rebounds(psi, chi, np.full(4, 0.1))
    assert np.all(np.isnan(found))
    named = [Status(code).name for code in status]
    assert named == ["PSI_NOT_FINITE", "CHI_NOT_POSITIVE", "CHI_NOT_POSITIVE", "TOO_MANY_PHASES"]


def test_compiled_kernels_do_what_python_does():
    """Fronts that come back, and reversals, included."""
    psi, chi = [0.5, 3.0, 2.0, 6.93, 1.06], [1.44, 1.44, 4.5, 4.14, 4.68]
    given = [psi, chi, [0.0576, 0.5, 0.2115, 0.02756, 0.0576]]
    found = [
        subprocess.run(
            [sys.executable, "-c", PROGRAM],
            input=json.dumps(given),
            env=os.environ | environment,
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for environment in ({}, {"CAROM_KERNELS": "python"})
    ]
    compiled, plain = map(np.array, map(json.loads, found))
    assert np.max(np.abs(compiled - plain)) < 1e-11
