"""Tuned parameters of contact laws: minima indeed, against own integrals and scans."""

from dataclasses import replace

import numpy as np
import pytest
from tests.oracles.springs import linear_springs

import carom
from carom import dem
from carom.verify import step_error, tune
from carom.verify.tuning import FREE, called

CHI = 1.4412
KAPPA = 4 * CHI / 7
PSI = np.linspace(0.0, 4 * CHI, 61)[1:]  # as by default
SOME, FEW = PSI[3::4], PSI[3::6]
ONE_EACH = (
    *(dem.LinearSpring(), dem.HertzLinearHistory(), dem.LammpsMindlin("mindlin")),
    *(dem.LammpsMindlin("mindlin/force"), dem.LammpsMindlin("mindlin_rescale")),
    *(dem.LammpsMindlin("mindlin_rescale/force"), dem.HardSphere(0.4)),
)
FIXED = (dem.ThorntonLaw(), dem.LiggghtsHertz(), dem.EdemHertzMindlin())


def error_of(law, psi=SOME, chi=CHI):
    return law.rebound(psi, chi) - carom.rebound(psi, chi)


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


MEASURE = {"max": lambda wrong: np.abs(wrong).max(), "rms": rms}


@pytest.fixture(scope="module", params=["max", "rms"])
def tuned(request):
    """Return the measure and the advice for laws with a free parameter, best first."""
    return request.param, tune(ONE_EACH, chi=CHI, psi_1=SOME, measure=request.param)


def test_linear_spring_against_an_own_scan():
    """k_t/k_n from 1/50 to 5 by an own integral: the least of all maxima is 0.070, at 0.777."""
    coarse = np.geomspace(0.02, 5.0, 60)
    fine = np.linspace(0.76, 0.80, 41)
    exact = carom.rebound(PSI, CHI)
    worst = [np.abs(linear_springs(r / KAPPA, PSI, CHI) - exact).max(1) for r in (coarse, fine)]
    assert 0.7 < coarse[worst[0].argmin()] < 0.85
    best = fine[worst[1].argmin()]
    assert best == pytest.approx(0.777, abs=2e-3)
    assert worst[1].min() == pytest.approx(0.070, abs=1e-3)
    (actual,) = tune([dem.LinearSpring()], chi=CHI).advice
    assert actual.parameter == "stiffness_ratio"
    assert actual.value == pytest.approx(best, abs=2e-3)
    assert actual.max_error == pytest.approx(worst[1].min(), abs=1e-3)
    as_given = np.abs(linear_springs([1.0], PSI, CHI) - exact).max()
    assert actual.before == pytest.approx(as_given, abs=1e-3)


@pytest.mark.first_case
def test_neighbours_are_worse(tuned):
    """2 % to either side, 0.02 for beta_0, and as it was given: none comes closer."""
    measure, tuning = tuned
    cost = MEASURE[measure]
    for one in tuning.advice:
        least = cost(error_of(one.law))
        assert least == pytest.approx(getattr(one, f"{measure}_error"), rel=1e-12)
        for factor in (0.98, 1.02):
            other = replace(one.law, **{one.parameter: factor * one.value})
            assert cost(error_of(other)) > least, other
        (values,) = (law for law in ONE_EACH if called(law) == called(one.law))
        assert one.before == pytest.approx(np.abs(error_of(values)).max(), rel=1e-12)
        assert cost(error_of(values)) > least


@pytest.mark.first_case
@pytest.mark.parametrize("measure", MEASURE)
@pytest.mark.parametrize("law", [ONE_EACH[0], ONE_EACH[1], ONE_EACH[5], ONE_EACH[6]], ids=str)
def test_minima_are_those_of_the_whole_range(law, measure):
    """A finer scan of the whole range, which knows nothing of refinement, finds no better one."""
    (one,) = tune([law], chi=CHI, psi_1=FEW, measure=measure).advice
    _, low, high = FREE[type(law)]
    scan = np.geomspace(low, high, 50) if low > 0.0 else np.linspace(low, high, 50)
    laws = [replace(law, **{one.parameter: value}) for value in scan]
    least = min(MEASURE[measure](error_of(law, FEW)) for law in laws)
    assert getattr(one, f"{measure}_error") <= least + 1e-9


def test_both_errors_are_told_and_the_best_comes_first(tuned):
    measure, tuning = tuned
    for one in tuning.advice:
        wrong = error_of(one.law)
        assert one.max_error == pytest.approx(np.abs(wrong).max(), rel=1e-12)
        assert one.rms_error == pytest.approx(rms(wrong), rel=1e-12)
    order = [getattr(one, f"{measure}_error") for one in tuning.advice]
    assert order == sorted(order)
    assert {type(one.law) for one in tuning.advice} == {type(law) for law in ONE_EACH}


def test_walton_and_braun():
    """Few impacts, as this law is stiff: neighbours are worse, and as given it is, too."""
    psi = np.array([1.0, 2.0, 3.0])
    (one,) = tune([dem.WaltonBraunLaw()], chi=CHI, psi_1=psi).advice
    least = np.abs(error_of(one.law, psi)).max()
    for factor in (0.98, 1.02):
        other = replace(one.law, stiffness_ratio=factor * one.value)
        assert np.abs(error_of(other, psi)).max() > least == one.max_error
    assert one.max_error < 0.8 * one.before


@pytest.mark.parametrize("law", FIXED, ids=str)
def test_laws_without_a_parameter_stay_as_they_are(law):
    (one,) = tune([law], chi=CHI, psi_1=FEW).advice
    assert (one.law, one.parameter, one.value) == (law, None, None)
    assert one.before == one.max_error == pytest.approx(np.abs(error_of(law, FEW)).max())
    assert one.rms_error == pytest.approx(rms(error_of(law, FEW)))


def test_hard_spheres_by_hand():
    """Where all impacts leave at -beta_0 psi_1, the best beta_0 by least squares is a quotient."""
    psi = np.linspace(0.5, 2.5, 9)
    exact = carom.rebound(psi, CHI)
    beta = -np.sum(psi * exact) / np.sum(psi**2)
    (one,) = tune([dem.HardSphere()], chi=CHI, psi_1=psi, measure="rms").advice
    assert one.value == pytest.approx(beta, abs=1e-4)
    assert one.before == pytest.approx(np.abs(exact).max(), rel=1e-12)
    assert one.step is None


def test_other_parameters_are_kept():
    """A damping, a variant: only the tuned one moves, and its error is that of the damped law."""
    law = dem.LammpsMindlin("mindlin/force", restitution=0.9, damping="tsuji")
    (one,) = tune([law], chi=CHI, psi_1=FEW).advice
    assert replace(one.law, stiffness=1.0) == law
    assert one.value != 1.0


def test_kappa_and_chi_reach_the_laws():
    """At twice kappa a spring of the same k_t/k_n is half as stiff for psi: the best is twice."""
    one, two = (
        tune([dem.LinearSpring()], chi=CHI, kappa=k, psi_1=FEW).advice[0]
        for k in (KAPPA, 2 * KAPPA)
    )
    assert two.value == pytest.approx(2 * one.value, rel=1e-3)
    assert two.max_error == pytest.approx(one.max_error, abs=1e-4)
    other = tune([dem.LinearSpring()], chi=1.2, psi_1=FEW)
    assert (other.chi, other.kappa) == (1.2, pytest.approx(4.8 / 7))
    advice = other.advice[0]
    assert advice.max_error == pytest.approx(np.abs(error_of(advice.law, FEW, 1.2)).max())


def test_steps_cost_a_tenth_of_what_is_left(tuned):
    """The advised steps, and twice as many, err by a tenth of the remaining error at most."""
    for one in tuned[1].advice:
        if one.step is not None:
            for steps in (one.step.steps, 2 * one.step.steps):
                assert step_error(one.law, steps, SOME, CHI) <= 0.1 * one.max_error
    assert sum(one.step is None for one in tuned[1].advice) == 1


def test_record_and_table_hold_the_advice():
    tuning = tune([dem.LinearSpring(), dem.ThorntonLaw()], chi=CHI, psi_1=FEW)
    record = tuning.to_dict()
    assert record["psi_in"] == [FEW.min(), FEW.max()]
    for row, one in zip(record["laws"], tuning.advice, strict=True):
        assert row["value"] == one.value
        assert (row["max_error"], row["max_error_before"]) == (one.max_error, one.before)
        assert (row["steps"], row["step_error"]) == one.step
    table = str(tuning).splitlines()
    (spring,) = (line.split() for line in table if line.strip().startswith("linear spring"))
    assert float(spring[3]) == pytest.approx(tuning.advice[0].value, abs=5e-5)
    assert float(spring[4]) == pytest.approx(tuning.advice[0].max_error, abs=5e-4)


def test_progress_is_told():
    entries = []
    laws = [dem.HardSphere(), dem.HardSphere(0.2), dem.HardSphere(0.4)]
    tune(laws, chi=CHI, psi_1=[1.0], progress=lambda done, whole: entries.append((done, whole)))
    assert entries == [(1, 3), (2, 3), (3, 3)]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"laws": ["mindlin"]}, "law: 'mindlin' .*must be a contact law"),
        ({"chi": 0.0}, "chi: 0.0 .*positive"),
        ({"kappa": -1.0}, "kappa: -1.0 .*positive"),
        ({"psi_1": [1.0, np.nan]}, "psi_1: .*finite"),
        ({"measure": "mean"}, "measure: 'mean' .*must be max or rms"),
    ],
)
def test_refused(options, message):
    inputs = {"laws": [dem.HardSphere()], "chi": CHI} | options
    with pytest.raises(carom.InputError, match=message):
        tune(**inputs)


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.4, 6.0])
def test_tuning_never_makes_a_law_worse(chi):
    """At any chi: k_t/k_n is sought around that of the bodies, 4 chi/7."""
    laws = [dem.LinearSpring(), dem.StrongeLaw(), dem.HertzLinearHistory(), dem.HardSphere()]
    for one in tune(laws, chi=chi, psi_1=np.linspace(0.0, 4.0 * chi, 16)[1:]).advice:
        assert one.max_error <= one.before
