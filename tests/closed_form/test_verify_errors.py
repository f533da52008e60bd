"""Errors of contact laws, and what their steps cost, against closed forms and own integrals."""

import json

import numpy as np
import pytest
import xarray as xr
from tests.oracles.springs import spring_force

import carom
from carom.dem.base import ContactLaw
from carom.verify import advised_steps, error_map, force_error, step_error

CHI = 1.4412
KAPPA = 4 * CHI / 7


STEPPED = (
    carom.dem.LinearSpring(),
    carom.dem.LammpsMindlin("mindlin/force"),
    carom.dem.ThorntonLaw(),
)


@pytest.fixture(scope="module")
def spring_map():
    return error_map(carom.dem.LinearSpring(2 / 7), [0.0, 0.5, 1.0, 3.0, 5.0, 7.0], [1.2, 1.5])


@pytest.mark.parametrize(("beta", "wrong"), [(0.0, 4), (0.1, 2), (0.4, 0)])
def test_error_of_hard_spheres_by_hand(beta, wrong):
    """psi_2 of the law is -beta psi_1 until it slides; the exact one is psi_1 - 4 chi from
    psi_1 = 4 chi - 1 on, where the impact slides throughout. No other law is asked."""
    chi = np.array([[1.2], [1.5]])
    psi = np.array([3.8, 4.6, 5.1, 5.9, 6.5, 8.0])
    errors = error_map(carom.dem.HardSphere(beta), psi, chi.ravel())
    law = np.where((1.0 + beta) * psi > 4.0 * chi, psi - 4.0 * chi, -beta * psi)
    slides = psi >= 4.0 * chi - 1.0
    assert slides.sum() == 10
    assert errors.psi_out.values == pytest.approx(law, abs=1e-12)
    by_hand = np.where(slides, law - (psi - 4.0 * chi), 0.0)
    assert np.where(slides, errors.error, 0.0) == pytest.approx(by_hand, abs=1e-12)
    assert (np.abs(by_hand) > 0.05).sum() == wrong


def test_summaries_of_a_map(spring_map):
    """Largest and rms error of each chi, as their names say; error is law minus exact."""
    error = spring_map.psi_out - spring_map.psi_out_exact
    xr.testing.assert_allclose(spring_map.error.drop_attrs(), error.drop_attrs())
    largest = [max(abs(e) for e in row) for row in error.values]
    rms = [(sum(e * e for e in row) / 6) ** 0.5 for row in error.values]
    assert spring_map.max_error.values == pytest.approx(largest)
    assert spring_map.rms_error.values == pytest.approx(rms)
    assert largest[1] > 1.0
    exact = [[carom.rebound(p, c) for p in (0.0, 0.5, 1.0, 3.0, 5.0, 7.0)] for c in (1.2, 1.5)]
    assert spring_map.psi_out_exact.values == pytest.approx(np.array(exact), abs=1e-13)


def test_a_map_tells_what_it_holds(spring_map):
    for name in (*spring_map.data_vars, *spring_map.coords):
        assert spring_map[name].attrs["units"] == "1", name
        assert spring_map[name].attrs["long_name"], name
    assert spring_map.attrs["Conventions"].startswith("CF-")
    assert spring_map.attrs["law"] == "linear spring"
    assert "Cundall" in spring_map.attrs["law_source"]
    assert json.loads(spring_map.attrs["law_parameters"]) == {
        "stiffness_ratio": 2 / 7,
        "restitution": 1.0,
        "tangential_damping": 0.0,
    }


def test_a_map_is_stored_and_read_to_the_last_bit(spring_map, tmp_path):
    stored = carom.save(spring_map, tmp_path / "map.nc")
    xr.testing.assert_identical(carom.read(stored), spring_map)


def test_map_by_default_spans_solid_spheres():
    """chi from nu = 1/2 to nu = 0, 2 (1 - nu)/(2 - nu) 7/4, and psi_1 to where all slide."""
    errors = error_map(carom.dem.HardSphere(0.4))
    nu = np.array([0.5, 0.0])
    ends = 7 / 4 * 2 * (1 - nu) / (2 - nu)
    assert errors.chi.values[[0, -1]] == pytest.approx(ends)
    assert (errors.psi_in.values[0], errors.psi_in.values[-1]) == (0.0, pytest.approx(7.0))
    assert (errors.error.values[:, -1] == 0.0).all()


def test_steps_and_kappa_reach_the_law():
    """A coarse step moves psi_2; with kappa = 1 a spring of k_t/k_n = 1 is that of kappa."""
    law, psi = carom.dem.LinearSpring(1.0), [0.75]
    fine, coarse = (error_map(law, psi, [CHI], steps=n).error.item() for n in (None, 20))
    assert 1e-3 < abs(fine - coarse) < 0.1
    there = {k: error_map(law, psi, [CHI], kappa=k).psi_out.item() for k in (0.5, 1.0)}
    assert there[1.0] == pytest.approx(carom.dem.LinearSpring().rebound(0.75, CHI), abs=1e-12)
    assert abs(there[1.0] - there[0.5]) > 0.2


def exact_force(psi, chi_wanted):
    """Return parts of the duration and T/(mu P_max) of a steel ball on steel, through SI units."""
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    assert pair.chi == pytest.approx(chi_wanted, abs=1e-4)
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=psi * 0.2 / pair.kappa)
    history = hit.history(2001)
    force = history.tangential_force.values / (0.2 * history.normal_force.values.max())
    return history.time.values / history.time.values[-1], np.abs(force) * np.sign(force)


@pytest.mark.parametrize("psi", [0.5, 2.0, 4.0])
def test_force_error_of_a_linear_spring(psi):
    """Both forces by other means: an own integral, and the history of a steel ball in newtons."""
    parts, force = spring_force(psi, CHI)
    other, exact = exact_force(psi, CHI)
    sign = np.sign(force[1]) * np.sign(exact[1])
    wrong = force - sign * np.interp(parts, other, exact)
    actual = force_error(carom.dem.LinearSpring(), psi, CHI)
    assert actual.largest == pytest.approx(np.abs(wrong).max(), abs=2e-3)
    assert actual.rms == pytest.approx(np.sqrt(np.mean(wrong**2)), abs=1e-3)
    assert actual.rms > 0.02


def test_force_error_is_that_of_either_direction_and_nothing_for_a_rigid_law():
    law = carom.dem.LammpsMindlin("mindlin_rescale")
    assert force_error(law, -0.75, CHI) == pytest.approx(force_error(law, 0.75, CHI), rel=1e-9)
    assert np.isnan(force_error(carom.dem.HardSphere(0.4), 1.0, CHI)).all()


def test_a_step_error_is_that_of_the_history():
    """psi_2 in steps, as the record of the impact ends, against the converged law."""
    law = carom.dem.LammpsMindlin("mindlin/force")
    ends = [law.history(psi, CHI, steps=50)["psi"][-1] for psi in (0.5, 1.0)]
    away = np.abs(np.array(ends) - law.rebound([0.5, 1.0], CHI)).max()
    assert step_error(law, 50, [0.5, 1.0], CHI) == pytest.approx(away, abs=5e-3)
    assert away > 0.02


@pytest.mark.parametrize("allowed", [0.1, 0.01, 0.001])
@pytest.mark.parametrize("law", STEPPED, ids=str)
def test_advised_steps_suffice_and_fewer_do_not(law, allowed):
    """The advised number and twice as many stay within what is allowed; a factor sqrt 2 fewer
    does not, unless it is the fewest that is tried."""
    advice = advised_steps(law, allowed)
    assert advice.error == step_error(law, advice.steps)
    assert step_error(law, advice.steps) <= allowed
    assert step_error(law, 2 * advice.steps) <= allowed
    if advice.steps == 10:
        assert (law, allowed) == (carom.dem.LinearSpring(), 0.1)
    else:
        assert step_error(law, round(advice.steps / 2**0.5)) > allowed


def test_the_finest_error_that_is_advised_for():
    """That of psi_2 without time steps: with ten times the steps the error stays below it."""
    advice = advised_steps(carom.dem.LinearSpring(), 1e-8)
    assert advice.error == pytest.approx(step_error(carom.dem.LinearSpring(), advice.steps))
    assert step_error(carom.dem.LinearSpring(), 10 * advice.steps) < 1e-8
    assert advised_steps(carom.dem.ExactContactLaw(), 1e-8) is None  # 2000 steps are all it has


class Lucky(ContactLaw):
    """A law that errs by 1 in fewer than 100 steps, but for 20 of them."""

    def _rebound(self, psi, chi, kappa, steps):
        return np.full(psi.size, 0.0 if steps in (None, 20) or steps >= 100 else 1.0)


def test_a_lucky_number_of_steps_is_not_advised():
    """10 sqrt(2)^7 = 113 is the first number from which on all are within what is allowed."""
    assert advised_steps(Lucky(), 0.1) == (113, 0.0)


class Sticky(ContactLaw):
    """Bodies that never part."""

    def _rebound(self, psi, chi, kappa, steps):
        return np.full(psi.size, np.nan)


def test_no_number_of_steps_where_there_is_none():
    """Two million steps are too few for 1e-7 of a law of first order; bodies that do not part have
    no psi_2; a rigid law has no steps to err by."""
    assert advised_steps(carom.dem.ThorntonLaw(), 1e-7, [1.0]) is None
    assert advised_steps(Sticky(), 0.1) is None
    assert advised_steps(carom.dem.HardSphere(), 1e-3).error == 0.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: error_map("mindlin"), "law: 'mindlin' .*must be a contact law"),
        (lambda: error_map(carom.dem.LinearSpring(), chi=[1.0, 0.0]), "chi: 0.0 .*positive"),
        (lambda: error_map(carom.dem.LinearSpring(), chi=-1.0), "chi: -1.0 .*positive"),
        (lambda: error_map(carom.dem.LinearSpring(), psi_1=[np.nan]), "psi_1: .*finite"),
        (lambda: error_map(carom.dem.LinearSpring(), psi_1=[]), "psi_1: .*finite"),
        (lambda: error_map(carom.dem.LinearSpring(), steps=2), "steps: 2 .*at least 4"),
        (lambda: force_error(None, 1.0, CHI), "law: None"),
        (lambda: step_error(carom.dem.LinearSpring(), 9), "steps: 9 .*at least 10"),
        (lambda: step_error(carom.dem.LinearSpring(), 20.5), "steps: 20.5 .*whole"),
        (lambda: step_error(carom.dem.LinearSpring, 20), "law: .*must be a contact law"),
        (lambda: advised_steps(carom.dem.LinearSpring(), 0.0), "allowed: 0.0 .*positive"),
        (lambda: advised_steps(carom.dem.LinearSpring(), 9.9e-9), "allowed: 9.9e-09 .*least 1e-08"),
        (lambda: advised_steps(carom.dem.LinearSpring(), 0.1, [np.inf]), "psi_1: .*finite"),
    ],
)
def test_refused(call, message):
    with pytest.raises(carom.InputError, match=message):
        call()
