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
    found = []
    grid = np.linspace(low, high, count)
    seen = [phases(psi, chi) for psi in grid]
    for i in range(count - 1):
        if seen[i] == seen[i + 1]:
            continue
        left, right = grid[i], grid[i + 1]
        while left < (middle := 0.5 * (left + right)) < right:
            left, right = (middle, right) if phases(middle, chi) == seen[i] else (left, middle)
        found += [left, right]
    return np.array(found)


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
    """Within 1e-9 of `rebound` at 16 chi from 0.05 to 10, half of them in 2 to 3."""
    rng = np.random.default_rng(11)
    for chi in [*np.exp(rng.uniform(np.log(0.05), np.log(10.0), 8)), *rng.uniform(2.0, 3.0, 8)]:
        law = carom.laws.ReboundLaw(chi)
        psi = np.concatenate([rng.uniform(0.0, 4.0 * chi + 1.0, 400), law.edges])
        assert error(law, psi) <= ACCURACY, chi


@pytest.mark.parametrize("chi", [0.8, 1.44, 2.95, 6.0, 10.0])
def test_equals_the_solver_around_every_kink(chi):
    """Within 1e-9 of `rebound` where the sequence of phases changes, found by bisection here."""
    places = kinks(chi, 1e-3, 4.0 * chi - 0.5)
    assert places.size >= 4
    assert error(carom.laws.ReboundLaw(chi), around(places)) <= ACCURACY


@pytest.mark.parametrize("chi", [0.3, 1.44, 2.75, 5.0])
def test_never_gains_energy_is_odd_and_keeps_coulombs_bound(chi):
    """psi_2(-psi_1) = -psi_2(psi_1) to the bit, |psi_2| <= |psi_1| exactly, impulse within +-1."""
    law = carom.laws.ReboundLaw(chi)
    rng = np.random.default_rng(3)
    psi = np.concatenate([10.0 ** rng.uniform(-12, 6, 20000), rng.uniform(0, 4 * chi + 1, 20000)])
    psi = np.concatenate([psi, law.edges, np.nextafter(law.edges, 0.0)])
    out, impulse, loss = law(psi), law.impulse(psi), law.dissipation(psi)
    assert np.array_equal(law(-psi), -out)
    assert np.array_equal(law.impulse(-psi), -impulse)
    assert np.array_equal(law.dissipation(-psi), loss)
    assert np.all(np.abs(out) <= psi)
    assert np.all(loss >= 0.0)
    assert np.all(np.abs(impulse) <= 1.0 + 4e-16)
    assert np.allclose(loss, (psi - out) * (psi + out), rtol=1e-9, atol=1e-12)
    sliding = psi >= max(4.0 * chi - 1.0, 1.0)
    assert np.all(np.abs(impulse[sliding] - 1.0) <= 4e-16 if chi > 0.5 else impulse[sliding] > 0.99)
    assert np.allclose(out[sliding], psi[sliding] - 4.0 * chi, rtol=1e-15, atol=4e-15 * chi)


@pytest.mark.parametrize("slope", [-3.0, -0.4, 0.02, 0.3, 0.9, 2.0])
def test_equals_an_impact_with_units(slope):
    """Rebound, tangential impulse, dissipation and duration are those of `impact`, rescaled."""
    ball = carom.Sphere(radius="4 mm", material="soda-lime-glass", inner_radius="2.5 mm")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    law = carom.laws.ReboundLaw(pair.chi)
    hit = carom.impact(pair, normal_speed=1.3, tangential_speed=1.3 * slope)
    psi, largest = hit.psi_in, pair.friction * 2.0 * pair.normal_mass * 1.3
    energy = 0.5 * pair.tangential_mass * hit.scales.tangential_speed**2
    assert law(psi) == pytest.approx(hit.psi_out, abs=ACCURACY)
    # an error of psi_2 below 1e-9 is one of 1e-9/(4 chi) in the impulse, of 2e-9 psi_2 in the loss
    assert largest * law.impulse(psi) == pytest.approx(hit.tangential_impulse, abs=1e-9 * largest)
    assert energy * law.dissipation(psi) == pytest.approx(
        hit.dissipated_energy, abs=2e-9 * energy * max(1.0, abs(psi))
    )
    assert law.duration * hit.max_penetration / 1.3 == pytest.approx(hit.duration, rel=1e-14)


@pytest.mark.parametrize("chi", [0.2, 1.44, 2.9])
def test_is_small_and_survives_storage_to_the_bit(chi):
    """A few kilobytes; JSON and pickle give the same bits back, and cannot be written to."""
    law = carom.laws.ReboundLaw(chi)
    assert law.nbytes == law.edges.nbytes + law.coefficients.nbytes
    assert law.nbytes < 8e3
    psi = np.random.default_rng(1).uniform(-15.0, 15.0, 2000)
    stored = json.loads(json.dumps(law.to_dict()))
    for again in (carom.laws.ReboundLaw.from_dict(stored), pickle.loads(pickle.dumps(law))):
        assert again.chi == law.chi
        assert np.array_equal(again.edges, law.edges)
        assert np.array_equal(again.coefficients, law.coefficients)
        assert np.array_equal(again(psi), law(psi))
    with pytest.raises(ValueError, match="read-only"):
        law.coefficients[0, 0] = 1.0


def test_keeps_shapes_and_single_precision():
    """Scalars, lists, integers and any shape are taken; float32 stays float32 and as exact."""
    law = carom.laws.ReboundLaw(1.44)
    psi = np.linspace(-7.0, 7.0, 24)
    assert law(psi.reshape(2, 3, 4)).shape == (2, 3, 4)
    assert np.array_equal(law(psi.reshape(2, 3, 4)).ravel(), law(psi))
    assert np.array_equal(law(list(psi)), law(psi))
    assert law(2) == law(2.0) == law([2.0])[0] == law(np.array([2]))[0]
    assert law(np.empty((0, 3))).shape == (0, 3)
    single = law(psi.astype(np.float32))
    assert single.dtype == np.float32
    exact = law(psi.astype(np.float32).astype(np.float64))
    assert np.all(np.abs(single - exact) <= 4e-6)


@pytest.mark.parametrize("chi", [0.0, -1.0, np.nan, np.inf, "two", None, [1.0]])
def test_refuses_a_bad_chi(chi):
    """One line that names chi."""
    with pytest.raises(carom.InputError, match=r"^chi: [^\n]+$"):
        carom.laws.ReboundLaw(chi)


GOOD = carom.laws.ReboundLaw(1.44).to_dict()
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
    ],
)
def test_refuses_a_damaged_table(table):
    """One line, never an answer from half a table."""
    with pytest.raises(carom.InputError, match=r"^table: [^\n]+$"):
        carom.laws.ReboundLaw.from_dict(table)
