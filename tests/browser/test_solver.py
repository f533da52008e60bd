"""Impacts in plain numbers, solved in the browser, against the library."""

import json

import numpy as np
import pytest
from tests.browser.scripts import script

import carom
from carom.bodies.losses import ZENER

pytestmark = pytest.mark.browser

KINDS = ("elastic", "plate", "viscous")
DRAWN = 15  # of a kind, besides those of special psi_1
SPECIAL = (0.0, 1e-8, 1e-4, 1.0, 2e5)
NUMBERS = {
    **{"restitution": "restitution", "duration": "duration", "deepest": "max_penetration"},
    **{"strongest": "max_force", "widest": "max_radius"},
}
COLUMNS = {
    **{"force": "force", "limit": "normal_force", "stored": "stored", "shear": "shear_lost"},
    **{"contact": "contact_radius", "stick": "stick_radius", "normalStored": "normal_stored"},
    **{"depth": "penetration", "speed": "centre_speed", "normalLost": "normal_lost"},
}
EXACT = 1e-12
EDGE = 1e-6  # of the duration, of ends of phases
CLOSE = {"elastic": 1e-9, "plate": 1e-9, "viscous": 1e-6}  # of histories
FRONT = 1e-4  # of the stick radius of viscous bodies
HIGHEST = 9.0  # of the page's tractions, which may be infinite at an edge
TRACTIONS = {0.5: 1e-4, 0.99: 2e-2, 1.0: 6e-2}  # errors that so many of them stay below


def cases(kind):
    """Return impacts of [psi_1, chi, restitution, lambda]."""
    random = np.random.default_rng(KINDS.index(kind))
    psi = [*random.uniform(-8.0, 8.0, DRAWN), *SPECIAL]
    chi = np.exp(random.uniform(*np.log([0.05, 10.0]), len(psi)))
    e = random.uniform(0.3, 1.0, len(psi)) if kind == "viscous" else np.ones(len(psi))
    give = random.uniform(0.0, 1.5, len(psi)) * (kind == "plate")
    return np.column_stack([psi, chi, e, give]).tolist()


def losses(e, give):
    """Return what the library takes as losses."""
    if give:
        return carom.ZenerPlate(inelasticity=ZENER * give)
    return carom.KelvinVoigt(restitution=e) if e < 1.0 else None


@pytest.fixture(params=KINDS)
def both(request, page):
    """A kind of impact, and what the browser and the library make of each."""
    drawn = cases(request.param)
    texts = page.evaluate(script("solve"), drawn)
    solved = [carom.solve(psi, chi, losses=losses(*lost)) for psi, chi, *lost in drawn]
    return request.param, list(zip(map(json.loads, texts), solved, strict=True))


def off(data, exact, scale=1.0):
    """Return the largest difference, as a part of a scale."""
    return np.max(np.abs(np.subtract(data, exact))) / scale


def test_numbers_and_histories(both):
    kind, impacts = both
    for data, exact in impacts:
        history, state = exact.history(201), (exact.psi_in, exact.chi)
        large = max(1.0, abs(exact.psi_in))
        assert off(data["out"], exact.psi_out, large) <= EXACT, state
        for name, same in NUMBERS.items():
            assert off(data[name], getattr(exact, same)) <= EXACT, (name, state)
        assert off(data["psi"], history.psi, large) <= CLOSE[kind], state
        assert off(data["dissipated"], history.dissipated, large**2) <= CLOSE[kind], state
        for name, same in COLUMNS.items():
            allowed = FRONT if (kind, name) == ("viscous", "stick") else CLOSE[kind]
            assert off(data[name], getattr(history, same)) <= allowed, (name, state)


def test_phases(both):
    for data, exact in both[1]:
        told = [(each["kind"], each["sign"]) for each in data["phases"]]
        assert told == [(each.kind, each.sign) for each in exact.phases], (exact.psi_in, exact.chi)
        edges = [0.0, *(each.end / exact.duration for each in exact.phases)]
        assert off([each["start"] for each in data["phases"]], edges[:-1]) <= EDGE
        assert off([each["end"] for each in data["phases"]], edges[1:]) <= EDGE


def test_tractions_where_it_sticks(both):
    """Where it slips the page draws mu times the pressure; at a viscous rim it is infinite."""
    errors = []
    for data, exact in both[1]:
        if not 0.0 < abs(exact.psi_in) < 1e4:
            continue
        lines = np.array(data["tractions"])
        times = np.linspace(0.0, exact.duration, len(lines))
        now = exact.at(times)
        line = np.linspace(0.0, 1.0, lines.shape[1])[:-1]
        for row in range(1, len(lines) - 1, 3):
            edge, front = now.contact_radius[row], now.stick_radius[row]
            radii = edge * line
            sticks = radii < (0.999 * front if front < edge else edge)
            wanted = exact.traction(times[row], radii[sticks]) / exact.max_radius
            errors.append(np.abs(np.clip(wanted, -HIGHEST, HIGHEST) - lines[row, :-1][sticks]))
    errors = np.concatenate(errors)
    for share, most in TRACTIONS.items():
        assert np.quantile(errors, share) <= most
