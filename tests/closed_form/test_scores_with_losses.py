"""Scores of damped results against viscoelastic impacts of the same restitution."""

import json

import numpy as np
import pytest
from tests.checks import PAIR, refused
from tests.closed_form.test_scores import forces, velocities, viscous

import carom
from carom.impacts.curves import REGIMES
from carom.verify import score

CHI = 1.4412
BODIES = {
    "friction": 0.2,
    "first": {"radius": "5 mm", "material": "steel"},
    "second": {"kind": "half-space", "material": "steel"},
}
MOTION = {"speed": 2.0, "angle": "35 deg", "spin": 50.0}


def curve(psi, e):
    return {"psi_1": psi, "psi_2": carom.rebound(psi, CHI, losses=viscous(e))}


def test_sliding_throughout_is_known_in_closed_form():
    """psi_1 - psi_2 = 2 (1 + e) chi from psi_1 = 2 chi (1 + e) - e on."""
    e = 0.6
    border = 2.0 * CHI * (1.0 + e) - e
    psi = border + np.array([1e-6, 3.0, 6.0])
    inputs = {"psi_1": psi, "psi_2": psi - 2.0 * (1.0 + e) * CHI}
    result = score(inputs, chi=CHI, restitution=e)
    assert result.max_error < 1e-12
    assert [group.name for group in result.groups] == [REGIMES[3]]
    note = score(inputs, chi=1.1 * CHI, restitution=e).notes[0]
    assert note == (
        "in gross slip psi_1 - psi_2 is 0.9091 times 3.2 chi: is chi 0.9091 times as large?"
    )


def test_groups_are_the_regimes():
    psi = [0.5, 1.5, 2.5, 3.2, 4.0, 6.0]  # borders at 1, 2.88 and 3.82 for e = 1/2
    result = score(curve(psi, 0.5), chi=CHI, restitution=0.5)
    assert [(group.name, group.points) for group in result.groups] == list(
        zip(REGIMES, (1, 2, 1, 2), strict=True)
    )
    assert result.to_dataset().restitution == 0.5
    assert "with e = 0.5" in str(result)
    drawn = result.to_dataset()
    exact = carom.rebound(drawn.curve_psi_in.values, CHI, losses=viscous(0.5))
    np.testing.assert_allclose(drawn.curve_psi_out.values, exact, atol=1e-12)
    np.testing.assert_allclose(drawn.border.values, [1.0, 2.0 * CHI, 3.0 * CHI - 0.5], rtol=1e-12)


def test_a_damped_law_has_the_error_of_the_ranking():
    law = carom.dem.LammpsMindlin("mindlin_rescale/force", restitution=0.7)
    psi = np.array(carom.verify.rank([law], chi=CHI).psi_in)
    result = score({"psi_1": psi, "psi_2": law.rebound(psi, CHI)}, chi=CHI, restitution=0.7)
    expected = carom.verify.rank([law], chi=CHI).standings[0].max_error
    assert result.max_error == pytest.approx(expected, abs=1e-9)
    assert not result.passed


def test_another_restitution_is_named():
    values = velocities(PAIR, 0.7)
    result = score(values, case=PAIR, restitution=0.8)
    (audit,) = (f for f in result.audit if f.name == "restitution error")
    assert audit.value == pytest.approx(0.1, abs=1e-12)
    assert "e = 0.7, not 0.8" in audit.verdict
    assert "change the damping" in audit.verdict
    assert "restitution error" in score(values, case=PAIR).failures
    del values["normal_speed_out"]
    assert score(values, case=PAIR, restitution=0.7).notes == (
        "normal_speed_out is not given; it was taken as 0.7 normal_speed, e = 0.7",
    )


def test_the_case_tells_the_restitution_as_well():
    hit = carom.impact(PAIR, **MOTION, losses=viscous(0.8))
    case = BODIES | MOTION | {"restitution": 0.8}
    values = forces(hit)
    for one in (score(values, case=case), score(values, case=BODIES | MOTION, restitution="80 %")):
        assert one.restitution == 0.8
        assert one.max_error <= 1e-8


def test_the_results_tell_the_restitution_as_well(tmp_path):
    """In their comment, also where chi or other bodies are given; two that differ are refused."""
    own, file = BODIES | {"restitution": 0.8}, tmp_path / "own.csv"
    rows = zip(*curve(np.array([0.5, 1.5, 3.0, 5.0]), 0.8).values(), strict=True)
    lines = ["psi_1,psi_2", *(f"{float(psi)!r},{float(out)!r}" for psi, out in rows)]
    file.write_text(f"# case: {json.dumps(own)}\n" + "\n".join(lines))
    for inputs in ({}, {"chi": PAIR.chi}, {"case": BODIES}, {"case": own}, {"case": PAIR}):
        assert score(file, **inputs).restitution == 0.8
    for case in (BODIES | {"restitution": 0.9}, carom.impact(PAIR, **MOTION)):
        refused(r"^restitution: the case and the results have 0\.8 and", score, file, case=case)


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"case": PAIR, "restitution": 0.0}, "restitution: 0"),
        ({"case": PAIR, "restitution": 1.1}, "restitution: 1.1"),
        ({"case": PAIR, "restitution": "high"}, "restitution: 'high'"),
        ({"case": BODIES | {"restitution": 0.9}, "restitution": 0.9}, "leave one of them out"),
        ({"case": carom.impact(PAIR, **MOTION), "restitution": 0.9}, "leave one of them out"),
        ({"case": BODIES | {"loss_time": "1 us"}}, "a restitution that is the same at all speeds"),
        (
            {"case": BODIES | {"yield_velocity": "1 m/s"}},
            "give a restitution that is the same at all speeds",
        ),
    ],
)
def test_what_cannot_be_compared_is_refused(inputs, message):
    with pytest.raises(carom.InputError) as error:
        score(velocities(PAIR, 0.9, number=3), **inputs)
    assert message in str(error.value)
