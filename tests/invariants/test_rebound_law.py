"""The table of a `ReboundLaw` is the solver's psi_2(psi_1) to 1e-9, everywhere."""

import json
import pickle

import numpy as np
import pytest

import carom

ACCURACY = 1e-9
BORDERS = [0.5, 1.0, 1.5, 1.75, 2.0, 3.0, 4.0, 65 / 6]  # where F is a polynomial, regimes meet
SPECIAL = [
    *(np.nextafter(chi, 0.0) for chi in (0.5, 1.0, 2.0)),
    *BORDERS,
    *(np.nextafter(chi, 99.0) for chi in (0.5, 1.0, 2.0)),
    *(0.05, 1.44, 2.7536299862332037, 2.9562673873633676, 4.999995, 7.654832082708992, 10.0),
]


def phases(psi, chi):
    return [(phase.kind, phase.sign) for phase in carom.solve(psi, chi).phases]


def kinks(chi, low, high, count=24):
    """Return where the sequence of phases changes, each to rounding."""
    actual = []
    grid = np.linspace(low, high, count)
    seen = [phases(psi, chi) for psi in grid]
    for i in range(count - 1):
        if seen[i] == seen[i + 1]:
            continue
        left, right = grid[i], grid[i + 1]
        while left < (middle := 0.5 * (left + right)) < right:
            left, right = (middle, right) if phases(middle, chi) == seen[i] else (left, middle)
        actual += [left, right]
    return np.array(actual)


def around(places):
    """Return places, their neighbours to the last bit, and points closer and closer to them."""
    steps = 10.0 ** np.arange(-13.0, -1.0)
    near = places[:, np.newaxis] * (1.0 + np.concatenate([-steps, steps]))
    return np.concatenate(
        [places, np.nextafter(places, 0.0), np.nextafter(places, np.inf), near.ravel()]
    )


def error(law, psi):
    psi = np.concatenate([psi, -psi])
    return np.max(np.abs(law(psi) - carom.rebound(psi, law.chi)))


@pytest.mark.first_case
@pytest.mark.parametrize("chi", SPECIAL)
def test_equals_the_solver_at_special_chi(chi):
    """Within 1e-9 of `rebound`: in every panel, at every edge to the last bit, in the tails."""
    law = carom.laws.ReboundLaw(chi)
    rng = np.random.default_rng(5)
    edges = law.edges
    inside = edges[:-1, np.newaxis] + np.diff(edges)[:, np.newaxis] * rng.random(
        (edges.size - 1, 9)
    )
    whole = np.concatenate([rng.uniform(0.0, 4.0 * chi + 2.0, 200), 10.0 ** rng.uniform(-9, 4, 50)])
    assert error(law, np.concatenate([inside.ravel(), around(edges), whole])) <= ACCURACY


def test_equals_the_solver_at_random_chi():
    """Within 1e-9 of `rebound` at 8 chi from 0.05 to 10, half of them in 2 to 3."""
    rng = np.random.default_rng(11)
    for chi in [*np.exp(rng.uniform(np.log(0.05), np.log(10.0), 4)), *rng.uniform(2.0, 3.0, 4)]:
        law = carom.laws.ReboundLaw(chi)
        psi = np.concatenate([rng.uniform(0.0, 4.0 * chi + 1.0, 400), law.edges])
        assert error(law, psi) <= ACCURACY, chi


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.8, 1.44, 2.95, 6.0, 10.0])
def test_equals_the_solver_around_every_kink(chi):
    """Within 1e-9 of `rebound` where the sequence of phases changes, found by bisection here."""
    places = kinks(chi, 1e-3, 4.0 * chi - 0.5)
    assert places.size >= 4
    assert error(carom.laws.ReboundLaw(chi), around(places)) <= ACCURACY


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.3, 0.5, 1.44, 4.0])
@pytest.mark.parametrize("inelasticity", [1e-8, 1e-3, 0.1, 0.4, 1.2, 2.18])
def test_equals_the_solver_on_plates(chi, inelasticity):
    """Within 1e-9 of `rebound` on a plate, as on a thick wall, at every edge and beside it."""
    losses = carom.ZenerPlate(inelasticity=inelasticity)
    law, rng = carom.laws.ReboundLaw(chi, losses=losses), np.random.default_rng(1941)
    psi = np.concatenate([rng.uniform(0.0, 1.1 * law.edges[-1], 400), around(law.edges)])
    psi = np.concatenate([psi, -psi, 10.0 ** rng.uniform(-9.0, 2.0, 30)])
    assert np.max(np.abs(law(psi) - carom.rebound(psi, chi, losses=losses))) <= ACCURACY


PLATE = carom.ZenerPlate(inelasticity=0.4)


def law_of(chi, losses):
    """The law of elastic bodies, of viscous ones with an e, of a plate."""
    if isinstance(losses, float):
        losses = None if losses == 1.0 else carom.KelvinVoigt(restitution=losses)
    return carom.laws.ReboundLaw(chi, losses=losses)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("chi", "losses"),
    [
        *((0.3, 1.0), (1.44, 1.0), (2.75, 1.0), (5.0, 1.0), (1.44, 0.8), (2.2, 0.3)),
        *((0.3, PLATE), (1.44, PLATE), (2.75, carom.ZenerPlate(inelasticity=2.0))),
    ],
)
def test_never_gains_energy_is_odd_and_keeps_coulombs_bound(chi, losses):
    """psi_2(-psi_1) = -psi_2(psi_1) to the bit, |psi_2| <= |psi_1| exactly, impulse within +-1.

    psi_2 = psi_1 - S from psi_1 = S - e on, S = 2 chi (1 + e), to infinity; before, less is lost.
    """
    law = law_of(chi, losses)
    e, slid = law.restitution, 2.0 * chi * (1.0 + law.restitution)
    rng = np.random.default_rng(3)
    psi = np.concatenate([10.0 ** rng.uniform(-12, 15, 2000), rng.uniform(0, 4 * chi + 1, 2000)])
    psi = np.concatenate([psi, law.edges, np.nextafter(law.edges, 0.0)])
    out, impulse, loss = law(psi), law.impulse(psi), law.dissipation(psi)
    assert np.array_equal(law(-psi), -out)
    assert np.array_equal(law.impulse(-psi), -impulse)
    assert np.array_equal(law.dissipation(-psi), loss)
    assert np.all(np.abs(out) <= psi)
    assert np.all(loss >= 0.0)
    assert np.all(np.abs(impulse) <= 1.0 + 4e-16)
    small = psi < 1e6
    exact = (psi - out) * (psi + out)
    assert np.allclose(loss[small], exact[small], rtol=1e-9, atol=1e-12)
    sliding, border = psi >= max(slid - e, 1.0), max(slid - e, 1.0)
    assert np.all(np.abs(impulse[sliding] - 1.0) <= 4e-16 if chi > 0.5 else impulse[sliding] > 0.99)
    assert np.allclose(out[sliding], psi[sliding] - slid, rtol=1e-15, atol=4e-15 * chi)
    assert law(border - 1e-3) > border - 1e-3 - slid + 1e-9
    assert law(np.inf) == np.inf
    assert np.isnan(law(np.nan))


@pytest.mark.parametrize("e", [1.0, 0.8])
def test_equals_an_impact_with_units(e):
    """Rebound, tangential impulse, dissipation and duration are those of `impact`, rescaled."""
    ball = carom.Sphere(radius="4 mm", material="soda-lime-glass", inner_radius="2.5 mm")
    other = carom.Sphere(radius="7 mm", material="steel")
    pair = carom.Pair(ball, other, friction=0.2)
    law, close = law_of(pair.chi, e), ACCURACY if e == 1.0 else 3e-8
    largest = pair.friction * (1.0 + e) * pair.normal_mass * 1.3
    for slope in (-3.0, -0.4, 0.02, 0.3, 0.9, 20.0):
        motion = {"normal_speed": 1.3, "tangential_speed": 1.3 * slope}
        hit = carom.impact(pair, **motion, losses=None if e == 1.0 else carom.KelvinVoigt(e))
        psi, size = hit.psi_in, max(1.0, abs(hit.psi_in))
        near = close if e == 1.0 else close * size
        energy = 0.5 * pair.tangential_mass * hit.scales.tangential_speed**2
        assert law(psi) == pytest.approx(hit.psi_out, abs=near)
        pulled = largest * law.impulse(psi)
        assert pulled == pytest.approx(hit.tangential_impulse, abs=near * largest)
        lost = hit.dissipated_energy + hit.shear_lost_energy
        assert energy * law.dissipation(psi) == pytest.approx(
            lost, abs=2.0 * near * energy * size, rel=1e-15
        )
        rel = 1e-14 if e == 1.0 else 1e-8
        assert law.duration * hit.scales.time == pytest.approx(hit.duration, rel=rel)


@pytest.mark.parametrize(
    ("chi", "losses"), [(0.2, 1.0), (1.44, 1.0), (2.9, 1.0), (1.44, 0.8), (1.44, PLATE)]
)
def test_is_small_and_survives_storage_to_the_bit(chi, losses):
    """A few kilobytes; JSON and pickle give the same bits back, and cannot be written to.

    A table without restitution is one of elastic bodies.
    """
    law = law_of(chi, losses)
    assert law.nbytes == law.edges.nbytes + law.coefficients.nbytes
    assert law.nbytes < 8e3
    psi = np.random.default_rng(1).uniform(-15.0, 15.0, 2000)
    stored = json.loads(json.dumps(law.to_dict()))
    for again in (carom.laws.ReboundLaw.from_dict(stored), pickle.loads(pickle.dumps(law))):
        assert (again.chi, again.restitution) == (law.chi, law.restitution)
        assert (again.duration, repr(again)) == (law.duration, repr(law))
        assert np.array_equal(again.edges, law.edges)
        assert np.array_equal(again.coefficients, law.coefficients)
        assert np.array_equal(again(psi), law(psi))
    if losses == 1.0:
        assert stored.pop("restitution") == 1.0
        assert np.array_equal(carom.laws.ReboundLaw.from_dict(stored)(psi), law(psi))
    with pytest.raises(ValueError, match="read-only"):
        law.coefficients[0, 0] = 1.0


@pytest.mark.parametrize("chi", [0.0, -1.0, np.nan, np.inf, "two", None, [1.0]])
def test_refuses_a_bad_chi(chi):
    """One line that names chi."""
    with pytest.raises(carom.InputError, match=r"^chi: [^\n]+$"):
        carom.laws.ReboundLaw(chi)


GOOD = carom.laws.ReboundLaw(1.44).to_dict()
OF_PLATE = law_of(1.44, PLATE).to_dict()
EDGES, ROWS = GOOD["edges"], GOOD["coefficients"]


@pytest.mark.parametrize(
    "table",
    [
        None,
        [1.0],
        "text",
        {"chi": 1.44, "edges": EDGES},
        GOOD | {"chi": -1.0},
        GOOD | {"chi": 2.0},
        GOOD | {"edges": EDGES[::-1]},
        GOOD | {"edges": [np.nan, *EDGES[1:]]},
        GOOD | {"edges": [*EDGES[:-1], np.inf]},
        GOOD | {"edges": EDGES[:-1]},
        GOOD | {"edges": [EDGES]},
        GOOD | {"edges": EDGES[:-1], "coefficients": ROWS[:-1]},
        GOOD | {"edges": EDGES[1:], "coefficients": ROWS[1:]},
        GOOD | {"coefficients": ROWS[1:]},
        GOOD | {"coefficients": [*ROWS[:-1], [1.0]]},
        GOOD | {"coefficients": [[] for _ in ROWS]},
        GOOD | {"coefficients": [[np.nan] * 11, *ROWS[1:]]},
        GOOD | {"edges": EDGES[:1], "coefficients": []},
        *(GOOD | {"restitution": wrong} for wrong in (0.7, 2.0, "x", None)),
        *(OF_PLATE | {"inelasticity": wrong} for wrong in (0.0, 0.41, 3.0, "x", None)),
        OF_PLATE | {"restitution": 0.5},
    ],
)
def test_refuses_a_damaged_table(table):
    """One line, never an answer from half a table."""
    with pytest.raises(carom.InputError, match=r"^table: [^\n]+$"):
        carom.laws.ReboundLaw.from_dict(table)
