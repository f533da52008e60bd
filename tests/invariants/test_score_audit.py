"""The audit of a score names what breaks a law of mechanics: which rows, and by how much."""

import numpy as np
import pytest
from tests.checks import BALL, PAIR, refused

import carom
from carom.verify.scoring import score

CHI = 1.4412
HIT = carom.impact(PAIR, speed=2.0, angle="35 deg")


def finding(result, name):
    return next(item for item in result.audit if item.name == name)


@pytest.fixture
def columns():
    """Exact impacts as SI velocities, from 5 to 75 degrees, spins of either sign."""
    hits = [
        carom.impact(PAIR, speed=2.0, angle=angle, spin=spin)
        for angle, spin in zip(
            np.radians(np.arange(5.0, 80.0, 10.0)), [0, 80, -90, 0, 30, -200, 100, 0], strict=True
        )
    ]
    names = ("normal_speed", "tangential_speed", "spin", "tangential_speed_out", "spin_out")
    table = {name: np.array([getattr(hit, name) for hit in hits]) for name in names}
    return table | {"normal_speed_out": table["normal_speed"].copy()}


@pytest.fixture
def forces():
    history = HIT.history(101)
    return {n: history[n].values.copy() for n in ("time", "normal_force", "tangential_force")}


def test_gain_of_a_point_is_named_with_its_size():
    """psi_2^2 - psi_1^2 of two rows; that the others lose energy does not hide it."""
    psi = np.linspace(0.3, 6.0, 10)
    out = carom.rebound(psi, CHI)
    out[2], out[7] = -psi[2] - 0.5, psi[7] + 0.01
    result = score({"psi_1": psi, "psi_2": out}, chi=CHI)
    gain = finding(result, "energy gain")
    assert not gain.holds
    assert gain.value == pytest.approx(0.5, rel=1e-12), "of |psi_2|"
    sizes = [(psi[2] + 0.5) ** 2 - psi[2] ** 2, (psi[7] + 0.01) ** 2 - psi[7] ** 2]
    np.testing.assert_allclose(result.points.energy_change[[2, 7]], sizes, rtol=1e-12)
    expected = f"energy is gained in row 3: {sizes[0]:.6g} in psi^2; row 8: {sizes[1]:.6g} in psi^2"
    assert gain.verdict == expected


@pytest.mark.parametrize(("extra", "holds"), [(0.005, True), (0.02, False)])
def test_small_gains_are_named_but_pass(extra, holds):
    """A gain below the tolerance passes; the energy is that of |psi_2|."""
    psi = np.array([1.0, 5.0, 20.0])
    chi = 0.02  # so little is lost that the exact |psi_2| is nearly |psi_1|
    out = np.abs(psi) + extra
    gain = finding(score({"psi_1": psi, "psi_2": out}, chi=chi), "energy gain")
    assert (gain.holds, gain.value) == (holds, pytest.approx(extra, rel=1e-9))
    assert gain.verdict.count("row") == 3


def test_gain_of_velocities_is_that_of_the_kinetic_energy(columns):
    """Crafted: a row leaves with 0.01 J more, added to its normal speed."""
    mass, added = BALL.mass, 0.01
    columns["normal_speed_out"][4] = np.sqrt(columns["normal_speed"][4] ** 2 + 2.0 * added / mass)
    result = score(columns, case=PAIR)
    lost = (
        result.points.energy_change
        - score(
            columns | {"normal_speed_out": columns["normal_speed"]}, case=PAIR
        ).points.energy_change
    )
    np.testing.assert_allclose(lost, np.where(np.arange(8) == 4, added, 0.0), atol=1e-12)
    assert finding(result, "energy gain").verdict.startswith("energy is gained in row 5: ")
    assert {"energy gain", "restitution error"} <= set(result.failures)


def test_loss_does_not_hide_a_gain(columns):
    """A contact point that leaves faster has gained, even if the normal motion lost more."""
    out = columns | {"normal_speed_out": 0.5 * columns["normal_speed"]}
    out["tangential_speed_out"] = columns["tangential_speed"].copy()
    out["spin_out"] = columns["spin"].copy()
    jump = 0.3  # m/s of the contact point in row 2, by one impulse
    out["tangential_speed_out"][1] += jump * 2.0 / 7.0
    out["spin_out"][1] += jump * 5.0 / 7.0 / BALL.radius
    result = score(out, case=PAIR)
    assert finding(result, "angular momentum").value <= 1e-12
    assert result.points.energy_change[1] < 0.0
    psi = jump * PAIR.kappa / (PAIR.friction * columns["normal_speed"][1])
    gain = finding(result, "energy gain")
    assert gain.value == pytest.approx(psi, rel=1e-9)
    assert gain.verdict.startswith("energy is gained in row 2: ")


def test_too_much_friction_is_named():
    """|psi_1 - psi_2| above 4 chi cannot be: full reversal at psi_1 = 4."""
    psi = np.array([0.5, 2.0, 4.0])
    result = score({"psi_1": psi, "psi_2": -psi}, chi=CHI)
    excess = finding(result, "friction impulse")
    assert excess.value == pytest.approx(8.0 - 4.0 * CHI)
    assert excess.verdict.endswith("in row 3, most in row 3")


def test_row_with_another_spin_is_named(columns):
    """One impulse changes speed and spin: R m (v - v') = I (w - w')."""
    columns["spin_out"][2] += 1.0
    columns["spin_out"][6] -= 20.0
    result = score(columns, case=PAIR)
    broken = finding(result, "angular momentum")
    psi = 20.0 * 0.4 * BALL.radius * PAIR.normal_mass / PAIR.tangential_mass
    psi *= PAIR.kappa / (PAIR.friction * columns["normal_speed"][6])
    assert broken.value == pytest.approx(psi, rel=1e-9)
    assert "in rows 3 and 7, most in row 7" in broken.verdict
    assert "factor" not in broken.verdict
    assert "angular momentum" in result.failures


def test_second_spin_belongs_to_the_balance():
    """Of two spheres both spins change by the impulse that changes the speed."""
    pair = carom.Pair(BALL, carom.Sphere(radius="8 mm", material="steel"), friction=0.2)
    hits = [carom.impact(pair, speed=1.0, angle=angle, spin=40.0) for angle in (0.2, 0.7, 1.2)]
    names = ("normal_speed", "tangential_speed", "spin")
    columns = {name: [getattr(hit, name) for hit in hits] for name in names}
    columns |= {f"{n}_out": [getattr(hit, f"{n}_out") for hit in hits] for n in names[1:]}
    columns["spin2_out"] = np.array([hit.spin2_out for hit in hits])
    assert finding(score(columns, case=pair), "angular momentum").value <= 1e-12
    columns["spin2_out"][1] *= 1.1
    broken = finding(score(columns, case=pair), "angular momentum")
    assert not broken.holds
    assert "in row 2" in broken.verdict


def test_turned_spins_are_suspected(columns):
    for name in ("spin", "spin_out"):
        columns[name] = -columns[name]
    verdict = finding(score(columns, case=PAIR), "angular momentum").verdict
    assert "by the same factor -1; does spin have the opposite sign?" in verdict


def test_factors_that_differ_are_no_matter_of_units(columns):
    grown = 1.0 + 0.1 * np.arange(len(columns["spin"]))
    for name in ("spin", "spin_out"):
        columns[name] = -grown * columns[name]
    verdict = finding(score(columns, case=PAIR), "angular momentum").verdict
    assert "different impulses" in verdict
    assert "factor" not in verdict


@pytest.mark.parametrize(
    ("kind", "factor", "unit"),
    [
        *(("spin", 30.0 / np.pi, "rpm"), ("spin", 180.0 / np.pi, "deg/s")),
        *(("spin", -30.0 / np.pi, "rpm"), ("spin", 0.5 / np.pi, "turn/s")),
        *(("speed", 1000.0, "mm/s"), ("speed", 100.0, "cm/s"), ("speed", 3.6, "km/h")),
    ],
)
def test_wrong_units_are_refused_by_name(columns, kind, factor, unit):
    """They make the balance of momentum fail by their factor; in the head they are right."""
    wrong = {name: v * factor if kind in name else v for name, v in columns.items()}
    ratio = abs(factor) if kind == "spin" else 1.0 / factor
    message = rf"{kind}s: .* {ratio:.4g} times as much as .*{kind} \[{unit}\]'"
    refused(message, score, wrong, case=PAIR)
    headed = {f"{name} [{unit}]" if kind in name else name: v for name, v in wrong.items()}
    assert score(headed, case=PAIR).passed == (factor > 0.0)


def test_damped_results_are_named(columns):
    columns["normal_speed_out"][3] *= 0.9
    damped = finding(score(columns, case=PAIR), "restitution error")
    assert damped.value == pytest.approx(0.1)
    assert damped.verdict.startswith("e = 0.9, not 1, in row 4")


def test_force_outside_the_cone_is_named(forces):
    """Two rows above mu F_n, one of them by 0.1 mu P_max."""
    limit, peak = 0.2 * forces["normal_force"], 0.2 * HIT.max_force
    forces["tangential_force"][60] = limit[60] + 0.1 * peak
    forces["tangential_force"][70] = -limit[70] - 0.02 * peak
    cone = finding(score(forces, case=HIT), "friction cone")
    assert cone.value == pytest.approx(0.1, rel=1e-9)
    assert cone.verdict.startswith("|F_t| > mu F_n in rows 61 and 71; most in row 61")


def test_force_that_pushes_is_named(forces):
    """A tangential force along the motion has added to it before it takes anything."""
    forces["tangential_force"] = -forces["tangential_force"]
    result = score(forces, case=HIT)
    assert {"work", "energy gain", "tangential force"} <= set(result.failures)
    gained = 2.0 * HIT.psi_in - HIT.psi_out - HIT.psi_in  # psi_1 + (psi_1 - psi_2) - psi_1
    assert finding(result, "energy gain").value == pytest.approx(gained, rel=1e-3)
    assert result.notes == (
        "does tangential_force have the opposite sign? It is positive against V_x > 0",
    )


def test_velocity_that_no_force_explains_is_named(forces):
    forces["contact_velocity"] = HIT.history(101).contact_velocity.values.copy()
    assert finding(score(forces, case=HIT), "contact velocity").value <= 1e-12
    forces["contact_velocity"][40] += 0.05 * HIT.scales.tangential_speed
    off = finding(score(forces, case=HIT), "contact velocity")
    assert (off.holds, off.value) == (False, pytest.approx(0.05, rel=1e-9))
    assert off.verdict.endswith("in row 41")


def test_turned_psi_and_wrong_chi_are_suspected():
    psi = np.linspace(0.2, 8.0, 20)
    exact = carom.rebound(psi, CHI)
    turned = score({"psi_1": psi, "psi_2": -exact}, chi=CHI)
    assert turned.notes[0].startswith("does psi_2 have the opposite sign?")
    other = score({"psi_1": psi, "psi_2": carom.rebound(psi, 0.9 * CHI)}, chi=CHI)
    assert "is chi 0.9 times as large?" in other.notes[0]
    assert score({"psi_1": psi, "psi_2": exact}, chi=CHI).notes == ()


@pytest.mark.parametrize(
    ("results", "words"),
    [
        ({"psi_1": [0.1, 1.0, 2.0], "psi_2": [0.0, 1e300, -0.8]}, "psi. is above 1e.09 in row 2"),
        ({"tangential_speed_out": [1e300, 1.0, 1.0]}, "psi. is above 1e.09 in row 1"),
        ({"spin_out": [1.0, -1e200, 1.0]}, "psi. is above 1e.09 in row 2"),
        ({"normal_speed": [1.0, 1.0, 1e300]}, "normal_speed: 1e.300 in row 3.*check its unit"),
        ({"normal_speed": [1.0, 1e-300, 1.0]}, "normal_speed: 1e-300 in row 2.*check its unit"),
        ({"normal_force": [1e300] * 30}, "normal_force: 1e.300 in every row.*check its unit"),
    ],
)
def test_numbers_that_cannot_be_meant_are_refused(results, words):
    """No overflow on the way to an error: the row and what to check are named."""
    rows = len(next(iter(results.values())))
    names = ("normal_speed", "tangential_speed", "spin", "tangential_speed_out", "spin_out")
    inputs, bodies = {"chi": 1.44}, {}
    if "normal_force" in results:
        bodies = {"time": np.linspace(0.0, 1e-5, rows), "tangential_force": np.zeros(rows)}
        inputs = {"case": carom.impact(PAIR, speed=1.0, angle=0.3)}
    elif "psi_1" not in results:
        bodies, inputs = dict.fromkeys(names, [1.0] * rows), {"case": PAIR}
    refused(words, score, bodies | results, **inputs)


def test_forces_without_friction_cannot_be_scored():
    """Even at normal incidence, where psi_1 is zero and not infinite."""
    pair = carom.Pair(PAIR.first, PAIR.second, friction=0.0)
    hit = carom.impact(pair, speed=1.0, angle=0.0)
    table = {name: hit.to_dataset()[name].values for name in ("time", "normal_force")}
    table["tangential_force"] = np.zeros(len(table["time"]))
    refused("without friction psi is infinite", score, table, case=hit)
