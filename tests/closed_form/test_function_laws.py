"""Contact laws and rebound laws written as Python functions: twins, closed forms, failures."""

import warnings
from math import copysign, sqrt

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom import dem
from carom.dem import ContactStep
from carom.status import LawStatus

CHI = 1.4412
PSI = np.array([-3.0, 0.1, 0.75, 1.0, 1.5, 3.0, 4.6, 6.0, 9.0])
STEPS = 150


def limited(contact, force):
    """Return a force that friction bears: Coulomb's limit."""
    limit = contact.friction * abs(contact.normal_force)
    return copysign(min(abs(force), limit), force)


def spring(contact, stretch):
    """A spring of stored displacement with a slider: mindlin, or with linear springs theirs."""
    stretch = stretch + contact.tangential_velocity * contact.time_step
    force = limited(contact, -contact.tangential_stiffness * stretch)
    return force, -force / contact.tangential_stiffness


def mindlin_force(contact, force):
    """LAMMPS' mindlin/force: the force itself is stored."""
    change = contact.tangential_stiffness * contact.tangential_velocity * contact.time_step
    force = limited(contact, force - change)
    return force, force


def rescaled(contact, state):
    """LAMMPS' mindlin_rescale/force from E*, G* and R*: the force shrinks with the contact."""
    force, before = state
    radius = sqrt(contact.effective_radius * contact.overlap)
    shrinks = min(1.0, radius / before) if before else 1.0
    stiffness = 2.0 * contact.effective_shear_modulus * radius
    change = stiffness * contact.tangential_velocity * contact.time_step
    force = limited(contact, force * shrinks - change)
    return force, (force, radius)


def sliding(contact, state):
    sign = copysign(1.0, contact.tangential_velocity)
    return -contact.friction * contact.normal_force * sign, state


TWINS = {
    "mindlin": (dem.FunctionLaw(spring), dem.LammpsMindlin("mindlin")),
    "mindlin/force": (dem.FunctionLaw(mindlin_force), dem.LammpsMindlin("mindlin/force")),
    "mindlin_rescale/force": (
        dem.FunctionLaw(rescaled, initial_state=(0.0, 0.0)),
        dem.LammpsMindlin("mindlin_rescale/force"),
    ),
    "linear": (dem.FunctionLaw(spring, normal="linear"), dem.LinearSpring()),
    "damped": (
        dem.FunctionLaw(spring, restitution=0.7),
        dem.LammpsMindlin("mindlin", restitution=0.7),
    ),
    "linear, damped": (
        dem.FunctionLaw(spring, normal="linear", restitution=0.7),
        dem.LinearSpring(restitution=0.7),
    ),
}


@pytest.mark.parametrize("name", TWINS)
@pytest.mark.parametrize("kappa", [None, 0.5])
def test_a_law_as_a_function_is_the_law_step_by_step(name, kappa):
    """In SI units and in Python as in dimensionless ones and compiled, to rounding."""
    own, law = TWINS[name]
    psi_out = own.rebound(PSI, CHI, kappa=kappa, steps=STEPS)
    np.testing.assert_allclose(psi_out, law.rebound(PSI, CHI, kappa=kappa, steps=STEPS), atol=1e-12)
    for psi in (0.75, -1.5):
        mine = own.history(psi, CHI, kappa=kappa, steps=STEPS)
        theirs = law.history(psi, CHI, kappa=kappa, steps=STEPS)
        assert list(mine) == list(theirs)
        for column in mine:
            np.testing.assert_allclose(mine[column], theirs[column], atol=1e-12)


@pytest.mark.parametrize(("name", "error"), [("mindlin", 1e-5), ("mindlin_rescale/force", 2e-3)])
def test_without_steps_it_is_near_the_limit(name, error):
    own, law = TWINS[name]
    np.testing.assert_allclose(own.rebound(PSI, CHI), law.rebound(PSI, CHI), atol=error)


@pytest.mark.parametrize("chi", [0.3, CHI, 10.0])
def test_closed_forms_of_no_force_and_of_full_sliding(chi):
    """psi_2 = psi_1; psi_2 = psi_1 - 4 chi, with a restitution psi_1 - 2 chi (1 + e)."""
    psi = np.array([-50.0, 0.5, 45.0])
    nothing = dem.FunctionLaw(lambda contact, state: (0.0, state))
    np.testing.assert_allclose(nothing.rebound(psi, chi), psi, rtol=1e-14)
    far = np.array([-50.0, 45.0])
    slid = dem.FunctionLaw(sliding).rebound(far, chi)
    np.testing.assert_allclose(slid, far - np.copysign(4.0 * chi, far), atol=1e-4)
    damped = dem.FunctionLaw(sliding, normal="linear", restitution=0.6)
    expected = 45.0 - 3.2 * chi  # to which it comes in the first order of the step
    assert damped.rebound(45.0, chi) == pytest.approx(expected, abs=3e-4 * chi)
    assert damped.rebound(45.0, chi, steps=20_000) == pytest.approx(expected, abs=5e-5 * chi)


def test_the_bodies_do_not_matter_to_a_law_without_a_scale_of_its_own():
    """And do to one with a stiffness in N/m: as much as that is in units of the bodies'."""
    ball = carom.Sphere(radius="1 mm", material="soda-lime-glass")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.7)
    other = {"pair": pair, "normal_speed": "3 m/s"}
    psi = dem.FunctionLaw(spring).rebound(PSI, CHI, steps=STEPS)
    np.testing.assert_allclose(
        dem.FunctionLaw(spring, **other).rebound(PSI, CHI, steps=STEPS), psi, atol=1e-10
    )

    def stiff(contact, stretch):
        stretch = stretch + contact.tangential_velocity * contact.time_step
        return limited(contact, -1e6 * stretch), stretch

    speeds = [dem.FunctionLaw(stiff, normal_speed=v).rebound(0.5, CHI) for v in (0.01, 1.0)]
    assert abs(speeds[0] - speeds[1]) > 0.1


def test_what_a_function_is_given_are_the_numbers_of_the_pair():
    ball = carom.Sphere(radius="3 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.3)
    seen = []

    def watched(contact, state):
        seen.append(contact)
        return spring(contact, state)

    law = dem.FunctionLaw(watched, pair=pair, normal_speed=0.5)
    record = law.history(2.0, pair.chi, kappa=pair.kappa, steps=100)
    first, scales = seen[0], pair.scales(0.5)
    assert isinstance(first, ContactStep)
    assert first.friction == 0.3
    assert first.effective_radius == pair.effective_radius
    assert first.effective_modulus == pair.effective_modulus
    assert first.effective_shear_modulus == pytest.approx(pair.effective_shear_modulus)
    assert (first.normal_mass, first.tangential_mass) == pytest.approx(
        (pair.normal_mass, pair.tangential_mass)
    )
    assert first.tangential_velocity == pytest.approx(2.0 * scales.tangential_speed)
    assert first.overlap == pytest.approx(0.5 * first.time_step)
    assert first.contact_radius == pytest.approx(sqrt(pair.effective_radius * first.overlap))
    assert max(c.normal_force for c in seen) == pytest.approx(scales.force, rel=1e-3)
    assert first.tangential_stiffness == pytest.approx(pair.kappa * first.normal_stiffness)
    hertz = 4 / 3 * pair.effective_modulus * sqrt(pair.effective_radius) * first.overlap**1.5
    assert first.normal_force == pytest.approx(hertz)
    assert len(record["time"]) == len(seen) + 1


def test_a_state_is_new_in_every_impact():
    """Even one that the function changes in place."""

    def counting(contact, calls):
        calls.append(contact.overlap)
        return -1e-3 * contact.friction * contact.normal_force * (len(calls) > 2000), calls

    law = dem.FunctionLaw(counting, initial_state=[])
    first, second = law.rebound([1.0, 1.0], CHI, steps=1500)
    assert first == second == 1.0
    assert law.initial_state == []


def test_a_rebound_law_is_its_function():
    def hard(psi, chi):
        return psi - copysign(min(4.0 * chi, 1.4 * abs(psi)), psi)

    law = dem.FunctionRebound(hard, name="hard sphere")
    chi = np.array([[0.5], [2.0]])
    expected = dem.HardSphere(0.4).rebound(PSI, chi)
    np.testing.assert_allclose(law.rebound(PSI, chi), expected, rtol=1e-14)
    assert carom.verify.score(dem.FunctionRebound(carom.rebound)).max_error == 0.0
    assert carom.verify.rank(law).standings[0].max_error == pytest.approx(0.340, abs=1e-3)


FAILING = {
    "raises": (lambda c, s: (1.0 / 0.0, s), LawStatus.RAISED, "raised ZeroDivisionError"),
    "nan": (lambda c, s: (float("nan"), s), LawStatus.NOT_A_NUMBER, "returned nan as the force"),
    "inf": (lambda c, s: (-np.inf, s), LawStatus.NOT_A_NUMBER, "returned -inf as the force"),
    "no state": (lambda c, s: 0.0, LawStatus.NOT_A_NUMBER, "not a force and a state"),
    "three": (lambda c, s: (0.0, s, 1), LawStatus.NOT_A_NUMBER, "not a force and a state"),
    "none": (lambda c, s: None, LawStatus.NOT_A_NUMBER, "not a force and a state"),
    "array": (lambda c, s: ([1.0, 2.0], s), LawStatus.NOT_A_NUMBER, "as the force"),
    "complex": (lambda c, s: (1j, s), LawStatus.NOT_A_NUMBER, "as the force"),
}


@pytest.mark.parametrize("name", FAILING)
def test_a_function_that_fails_is_told_by_status_warning_and_refusal(name):
    function, status, words = FAILING[name]
    law = dem.FunctionLaw(function, name=name)
    psi_out, answer = law.rebound([0.5, 2.0], CHI, return_status=True)
    assert np.isnan(psi_out).all()
    assert set(answer) == {status}
    with pytest.warns(RuntimeWarning, match=f"2 of 2 impacts give NaN .*{words}"):
        law.rebound([0.5, 2.0], CHI)
    calls = (
        *(lambda: law.history(0.5, CHI), lambda: carom.verify.score(law)),
        lambda: carom.verify.rank([dem.LinearSpring(), law]),
        lambda: carom.verify.error_map(law, [0.5], [CHI]),
        *(lambda: carom.verify.tune(law, chi=CHI), lambda: carom.verify.score(function)),
    )
    for call in calls:
        refused(words, call)


def test_one_bad_impact_leaves_the_others():
    def rebound(psi, chi):
        return 1.0 / (psi - 1.0)

    law = dem.FunctionRebound(rebound)
    psi_out, status = law.rebound([2.0, 1.0, np.nan, 3.0], CHI, return_status=True)
    np.testing.assert_array_equal(psi_out, [1.0, np.nan, np.nan, 0.5])
    assert status.tolist() == [0, LawStatus.RAISED, LawStatus.PSI_NOT_FINITE, 0]
    errors = carom.verify.error_map(law, [1.0, 2.0], [CHI])
    assert np.isnan(errors.error.values).tolist() == [[True, False]]


@pytest.mark.parametrize("inputs", [None, 3, "mindlin", int, dem.LinearSpring, lambda c: 0.0])
@pytest.mark.parametrize("kind", [dem.FunctionLaw, dem.FunctionRebound])
def test_what_is_no_such_function_is_refused(kind, inputs):
    refused(r"^function: .* must", kind, inputs)


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        *(("normal", "herz"), ("restitution", 0.0), ("pair", "steel"), ("normal_speed", -1.0)),
        *(("name", 3), ("initial_state", (x for x in ()))),
    ],
)
def test_bad_parameters_are_refused(argument, value):
    refused(f"^{argument}: ", dem.FunctionLaw, spring, **{argument: value})


def test_functions_are_ranked_scored_and_mapped_as_laws_are():
    ranking = carom.verify.rank([spring, dem.LammpsMindlin("mindlin")])
    mine, theirs = ranking.standings
    assert {mine.entry.label, theirs.entry.label} == {"spring", "mindlin"}
    assert mine.max_error == pytest.approx(theirs.max_error, abs=1e-5)
    assert mine.rms_error == pytest.approx(theirs.rms_error, abs=1e-5)
    assert mine.force_error == pytest.approx(theirs.force_error, abs=1e-6)
    assert mine.fine_step.steps == theirs.fine_step.steps
    entry = carom.verify.Entry("my spring", spring, "")
    assert carom.verify.rank([entry], psi_1=[1.0]).standings[0].entry.label == "my spring"
    axes = [[0.5, 1.0, 3.0], [1.2, 1.4]]
    own = carom.verify.error_map(spring, *axes)
    expected = carom.verify.error_map(dem.LammpsMindlin("mindlin"), *axes)
    np.testing.assert_allclose(own.error, expected.error, atol=1e-5)
    assert own.attrs["law"] == "spring"
    force = [carom.verify.force_error(law, 0.75, CHI) for law in (spring, dem.LammpsMindlin())]
    np.testing.assert_allclose(*force, atol=1e-6)
    assert carom.verify.step_error(spring, 100) == pytest.approx(
        carom.verify.step_error(dem.LammpsMindlin(), 100), abs=1e-5
    )


def test_a_law_is_scored_against_bodies_that_lose_as_much():
    """Or against the restitution that is asked for; a case gives chi, kappa and the bodies."""
    damped = dem.FunctionLaw(spring, restitution=0.7)
    score = carom.verify.score(damped)
    assert score.restitution == pytest.approx(0.7, abs=1e-3)
    assert score.max_error == pytest.approx(0.268, abs=2e-3)
    assert carom.verify.score(damped, restitution=0.9).restitution == 0.9
    ball = carom.Sphere(radius="5 mm", inner_radius="4 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.3)
    of_pair = carom.verify.score(spring, case=pair)
    np.testing.assert_allclose(of_pair.points.chi, pair.chi)
    expected = dem.LammpsMindlin().rebound(of_pair.points.psi_in, pair.chi, kappa=pair.kappa)
    np.testing.assert_allclose(of_pair.points.psi_out, expected, atol=1e-5)
    refused("chi: it follows from the case", carom.verify.score, spring, case=pair, chi=1.0)


def test_a_force_of_the_wrong_sign_is_noticed():
    def wrong(contact, stretch):
        force, after = spring(contact, stretch)
        return -force, after

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        score = carom.verify.score(wrong)
    assert not score.passed
    assert any("opposite sign" in note for note in score.notes)
    assert carom.verify.score(spring).notes == ()
