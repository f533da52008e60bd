"""What data cannot tell is said, with the reason, instead of an interval."""

import numpy as np
import pytest

import carom
from carom.lab.fitting import fit

MU = 0.12
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=MU)


def impacts(angles, *names, noise=0.01, seed=0):
    """Return what `impact` gives at these angles in degrees, with a little noise."""
    random = np.random.default_rng(seed)
    hits = [carom.impact(PAIR, speed=3.9, angle=f"{angle} deg") for angle in angles]
    data = {"angle": np.radians(angles)}
    for name in names:
        exact = np.array([getattr(hit, name) for hit in hits])
        data[name] = exact + random.normal(0.0, noise, len(angles))
        data[f"{name}_error"] = np.full(len(angles), noise)
    return data


def test_stiffness_where_all_rows_slip_throughout():
    """psi_2 = psi_1 - 2 chi (1 + e): V_x' = V_x - mu (1 + e)(m_n/m_t) V_n knows no stiffness."""
    data = impacts(range(48, 76, 3), "contact_restitution", "normal_restitution")
    result = fit(data, pair=PAIR)
    assert not result.kappa.determined
    assert np.isnan(result.kappa.low)
    assert "slips throughout" in result.kappa.reason
    assert "slips throughout" in result.chi.reason
    assert result.friction.low < MU < result.friction.high
    assert result.regimes["gross slip throughout"] == 10


def test_only_a_product_of_friction_and_restitution():
    """Sliding without a normal speed after: mu (1 + e) alone, and its value is told."""
    data = impacts(range(48, 76, 3), "contact_restitution")
    result = fit(data, pair=PAIR)
    for name in ("friction", "restitution"):
        assert not result[name].determined
        assert "friction (1 + restitution)" in result[name].reason
    value = float(result.friction.reason.split("that product is ")[1].split(" ")[0])
    assert value == pytest.approx(2.0 * MU, rel=0.02)
    assert fit(data, pair=PAIR, fixed={"restitution": 1.0}).friction.determined


def test_friction_where_nothing_slips_in_gross():
    """Small psi_1 is a linear problem: psi_2/psi_1 depends on chi alone, so friction is open."""
    data = impacts([0.2, 0.3, 0.4, 0.5, 0.6, 0.7], "contact_restitution", noise=0.02)
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0})
    assert result.regimes["stick from the first touch"] == 6
    assert result.friction.high == np.inf
    assert not result.friction.determined or "at least" in str(result.friction)
    assert result.kappa.determined


def test_an_end_that_is_open_is_said_so():
    """Rows that stick from the first touch bound the friction from below only."""
    data = impacts([1.0, 1.5, 2.0, 2.5, 3.0], "contact_restitution", noise=0.1)
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0, "kappa": PAIR.kappa})
    assert result.friction.open
    assert str(result.friction).endswith(f"at least {result.friction.low:.4g}")
    assert result.friction.low < MU
    assert result.to_dict()["parameters"]["friction"]["high"] is None


def test_restitution_where_nothing_depends_on_it():
    """J_t/J_n of rows that slide is mu, whatever e is."""
    data = impacts([50.0, 60.0, 70.0], "tangential_restitution")
    data = {"angle": data["angle"], "impulse_ratio": np.array([0.119, 0.121, 0.12])}
    result = fit(data, pair=PAIR, vary=["friction", "restitution"])
    assert "normal_restitution" in result.restitution.reason
    assert result.friction.value == pytest.approx(0.12, abs=0.002)


def test_sliding_data_cannot_tell_the_laws_apart():
    """All laws are one where everything slides; with stick among the rows they are not."""
    data = impacts(range(48, 76, 3), "contact_restitution")
    sliding = fit(data, pair=PAIR, fixed={"restitution": 1.0}).comparison
    assert "cannot tell Walton" in sliding.verdict
    assert sliding["Walton"].weight == pytest.approx(1.0 / 3.0, abs=1e-6)
    whole = impacts(range(3, 76, 3), "contact_restitution")
    apart = fit(whole, pair=PAIR, fixed={"restitution": 1.0}).comparison
    assert apart["exact"].weight > 0.999
    assert "the data rule out Walton" in apart.verdict


def test_advice_for_the_stiffness_leads_away_from_sliding():
    """What slides throughout tells nothing of kappa, so none of the incidences lies there."""
    data = impacts(range(48, 76, 3), "contact_restitution")
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0})
    advice = result.advice(3, "kappa")
    assert all(place.regime != "gross slip throughout" for place in advice.places)
    assert advice.shorter < 0.1


def test_rows_whose_regime_is_not_certain_are_named():
    """psi_1 = 1 within the interval of friction: row 3 may stick from the first touch or not."""
    border = np.degrees(np.arctan(MU / PAIR.kappa))
    data = impacts([2.0, 4.0, border, 25.0, 40.0, 60.0], "contact_restitution", noise=0.02)
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0})
    assert any("may differ" in note and "3" in note for note in result.notes)
