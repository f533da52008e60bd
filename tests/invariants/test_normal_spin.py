"""Spin about the line of impact, by boundary elements with units: what is kept, what is lost."""

from functools import cache
from math import gamma, pi, sqrt

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.bodies.kinematics import normal_inertia
from carom.impacts.boundary_elements import spin_about_normal

GRID = carom.BoundaryElements(elements=14, steps=60)
STEEL, GLASS = carom.material("steel"), carom.material("soda-lime-glass")

BALL = carom.Sphere(radius="10 mm", material=STEEL)


@cache
def pair(second=STEEL):
    return carom.Pair(BALL, carom.HalfSpace(material=second), friction=0.2)


@cache
def hit(bodies, spin, angle="30 deg"):
    return carom.impact(bodies, speed=1.0, angle=angle, normal_spin=spin, method=GRID)


ENERGIES = (
    *("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy"),
    *("normal_spin_kinetic_energy", "normal_elastic_energy", "tangential_elastic_energy"),
    "frictional_work",
)


@pytest.mark.first_case
@pytest.mark.parametrize("second", [STEEL, GLASS])
def test_energy(second):
    """What friction takes is what the motions lose, that of the spin and across included."""
    actual = hit(pair(second=second), 400.0)
    history = actual.history(400)
    across = 0.5 * actual.pair.tangential_mass * history.contact_velocity_across.values**2
    total = sum(history[name].values for name in ENERGIES) + across
    moving = history.normal_kinetic_energy.values[0]
    assert np.abs(total - total[0]).max() <= 2e-3 * moving
    assert actual.dissipated_energy == pytest.approx(float(history.frictional_work[-1]), rel=5e-3)
    assert (abs(actual.contact_velocity_across) > 1e-4) == (second is GLASS)


def test_angular_momentum():
    """The moment over time is the inertia times the change of spin; two spheres share it."""
    for bodies in (pair(), carom.Pair(BALL, BALL, friction=0.2)):
        actual = hit(bodies, 400.0)
        history = actual.history(2000)
        taken = float(np.trapezoid(history.frictional_moment, history.time))
        change = normal_inertia(bodies) * (400.0 - actual.normal_spin_out)
        assert taken == pytest.approx(change, rel=2e-3)
    one = 0.4 * BALL.mass * BALL.radius**2
    assert normal_inertia(bodies) == pytest.approx(0.5 * one)


def test_fast_spin_slips_all_around():
    """M = (3 pi/16) mu P b throughout: taken are (15/16)(pi/4)(4/5) B(6/5, 1/2) lightnesses."""
    bodies = pair()
    actual = hit(bodies, 3e5, angle="0 deg")
    scaled = spin_about_normal(bodies, actual.scales, 3e5)
    taken = scaled.speed * (1.0 - actual.normal_spin_out / 3e5)
    path = 0.8 * gamma(1.2) * sqrt(pi) / gamma(1.7)
    assert scaled.speed > 50.0
    assert taken / scaled.lightness == pytest.approx(15.0 / 16.0 * pi / 4.0 * path, rel=5e-3)


def test_slow_spin_is_linear():
    """Far below mu V_1/a nothing slips around the normal: the same share of spin is kept."""
    kept = [hit(pair(), spin, angle="0 deg").normal_spin_out / spin for spin in (0.01, 1.0)]
    assert kept[0] == pytest.approx(kept[1], abs=1e-4)
    assert 0.9 < kept[0] < 1.0


def test_fast_spin_lets_the_ball_slide_freely():
    """Friction turns with the spin, and little of it is left along the motion."""
    still, fast = hit(pair(), 0.0), hit(pair(), 3e5)
    assert still.tangential_restitution < 0.7
    assert fast.tangential_restitution > 0.97


def test_no_spin_changes_nothing():
    """And the result tells of none."""
    plain = carom.impact(pair(), speed=1.0, angle="30 deg", method=GRID)
    assert hit(pair(), 0.0).psi_out == plain.psi_out
    assert "normal_spin" not in plain.inputs()
    assert "frictional_moment" not in plain.history(5)


def test_energies_of_the_figure_add_up():
    """Shares of the stored energy, of motion, and of friction: one all the time."""
    for second, spin in ((STEEL, 3e5), (GLASS, 400.0)):
        figure = hit(pair(second=second), spin).plot()
        (axis,) = (one for one in figure.axes if one.get_ylabel() == "share of energy")
        edges = axis.collections[-1].get_paths()[0].vertices[:, 1]
        assert edges.max() == pytest.approx(1.0, abs=3e-3)
        labels = [text.get_text() for text in axis.get_legend().get_texts()]
        assert "normal spin" in labels


def test_energy_error_does_not_hide_behind_the_spin():
    """A spin a thousand times faster has a million times the energy, and about the same error."""
    slow, fast = (hit(pair(), spin).energy_error for spin in (3e2, 3e5))
    assert 1e-6 < fast < 1e-2
    assert 0.05 < fast / slow < 20.0


def test_a_spin_beyond_numbers_is_refused():
    refused(r"^normal_spin: 1000000000000000.0 .*solve up to .* rad/s here", hit, pair(), 1e15)


def test_validity_names_the_spin():
    """A bound of its own; the other one says that it does not count spin; none with losses."""
    bodies, motion = pair(), {"speed": 1.0, "angle": "30 deg", "normal_spin": 400.0}
    *_, spinning, rebound = carom.impact(bodies, **motion).validity.findings
    assert spinning.name == "error of psi_2 by normal spin"
    assert spinning.value > rebound.value > 0.0
    assert "apart from the spin about the normal" in rebound.verdict
    lossy = carom.impact(bodies, **motion, losses=carom.KelvinVoigt(restitution=0.9))
    *_, spinning, rebound = lossy.validity.findings
    assert spinning.holds is rebound.holds is None
    assert all("not studied with losses" in one.verdict for one in (spinning, rebound))
    fast = carom.impact(bodies, **(motion | {"normal_spin": 1e6})).validity.findings[-2]
    assert fast.verdict.startswith("not studied: spin of ")
