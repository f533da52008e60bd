"""A slender rod on its end, against rules for rigid bodies: Newton's, Poisson's, Stronge's.

And against Stronge's bilinear contact (2000, chapter 5). The exact answer needs none of them.
"""

import csv
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))

import rigid_rules
from rigid_rules import RULES, struck


def energy(tangential, mixed, normal, along):
    """Return the kinetic energy of the contact, of m_n V_n^2/2."""
    inverse = np.linalg.inv([[1.0, mixed], [mixed, tangential]])
    return np.array([normal, along]) @ inverse @ [normal, along]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize(("mu", "sliding"), [(0.0, 0.3), (0.3, 5.0), (0.3, -5.0), (0.1, 1.5)])
def test_sliding_throughout_is_what_all_rules_say(rule, mu, sliding):
    """And so is no friction at all: there rules for elastic bodies are exact."""
    hit, tangential, mixed = struck(35.0, mu, sliding)
    e, along = rigid_rules.routh(tangential, mixed, mu, sliding, rule)
    assert hit.normal_restitution == pytest.approx(e, abs=2e-6)
    assert hit.contact_velocity_out == pytest.approx(along, abs=2e-5)


def test_rules_of_a_sphere_are_known():
    """Friction does not change e: it sticks, or slides by 2 mu b_tt."""
    for rule in RULES:
        assert rigid_rules.routh(3.5, 0.0, 0.2, 5.0, rule) == pytest.approx((1.0, 5.0 - 1.4))
        assert rigid_rules.routh(3.5, 0.0, 0.2, 1.0, rule) == pytest.approx((1.0, 0.0))


def test_only_newtons_rule_gains_energy():
    """Where slip turns round; Stronge's e = 1 loses what friction takes, and no more."""
    random, gains = np.random.default_rng(1991), {rule: [] for rule in RULES}
    for _ in range(300):
        tangential, mu, sliding = random.uniform(1.0, 4.0), random.uniform(0.05, 1), random.normal()
        mixed = random.uniform(-0.9, 0.9)
        before = energy(tangential, mixed, 1.0, sliding)
        for rule in RULES:
            after = rigid_rules.routh(tangential, mixed, mu, sliding, rule)
            if after is not None:
                gains[rule].append(energy(tangential, mixed, -after[0], after[1]) - before)
    assert max(gains["newton"]) > 0.05
    assert max(gains["poisson"]) < 1e-9
    assert max(gains["stronge"]) < 1e-9


@pytest.mark.parametrize(
    ("degrees", "mu", "rigid", "exact", "springs"),
    [
        (20.0, 0.5, (1.0, 0.0), (0.8437, -0.1621), (0.8346, -0.1741)),
        (40.0, 0.5, (1.0, 0.1292), (0.8482, 0.6415), (0.8437, 0.6490)),
        (60.0, 1.0, (1.0, 0.0), (0.8600, 0.4776), (0.8568, 0.4845)),
    ],
)
def test_a_rod_dropped_on_its_end(degrees, mu, rigid, exact, springs):
    """Rigid rules agree with each other there, and are far off; two springs are near."""
    hit, tangential, mixed = struck(degrees, mu)
    for rule in RULES:
        answer = rigid_rules.routh(tangential, mixed, mu, 0.0, rule)
        assert answer == pytest.approx(rigid, abs=1e-4)
    came = hit.normal_restitution, hit.contact_velocity_out
    assert came == pytest.approx(exact, abs=1e-4)
    two = rigid_rules.bilinear(tangential, mixed, mu, 0.0, hit.pair.kappa)
    assert two == pytest.approx(springs, abs=2e-4)


def test_two_springs_are_near_and_rigid_rules_are_not():
    near, far = [], []
    for degrees in range(10, 90, 10):
        for mu in (0.1, 0.3, 0.5, 1.0):
            hit, tangential, mixed = struck(float(degrees), mu)
            here = hit.normal_restitution
            near.append(
                rigid_rules.bilinear(tangential, mixed, mu, 0.0, hit.pair.kappa, 4000)[0] - here
            )
            far.append(rigid_rules.routh(tangential, mixed, mu, 0.0, "stronge")[0] - here)
    assert np.max(np.abs(near)) < 0.05
    assert np.median(np.abs(near)) < 0.004
    assert min(far) > 0.005
    assert max(far) > 0.3


def test_the_table_is_current():
    with rigid_rules.TABLE.open(encoding="utf-8") as file:
        stored = list(csv.DictReader(file))
    assert len(stored) == 108
    for row in stored[::9]:
        hit, *inertia = struck(
            float(row["angle"]), mu := float(row["friction"]), float(row["sliding"])
        )
        assert float(row["e_exact"]) == pytest.approx(hit.normal_restitution, abs=1e-4)
        assert float(row["slip_exact"]) == pytest.approx(hit.contact_velocity_out, abs=1e-4)
        for rule in RULES:
            answer = rigid_rules.routh(*inertia, mu, float(row["sliding"]), rule)
            assert (float(row[f"e_{rule}"]), float(row[f"slip_{rule}"])) == pytest.approx(
                answer, abs=1e-4
            )
