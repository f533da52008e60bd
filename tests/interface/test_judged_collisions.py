"""Collisions that are judged: how far psi_2 may be off by what the theory leaves out."""

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.dimensionless.neglected import rebound_error, spin_error

STEEL = carom.Sphere(radius="10 mm", material="steel")
LIKE = carom.Pair(STEEL, STEEL, friction=0.2)
UNLIKE = carom.Pair(STEEL, carom.HalfSpace(material="soda-lime-glass"), friction=0.2)
UP = [0.0, 0.0, 1.0]
RANDOM = np.random.default_rng(20261124)


def judged(pair, **keywords):
    return carom.collide(pair, **keywords, judge=True)


@pytest.mark.parametrize("pair", [LIKE, UNLIKE])
def test_a_judged_collision_is_the_same_collision(pair):
    velocity, spin = RANDOM.normal(size=(2, 50, 3))
    motion = {"velocity1": velocity + np.array(UP), "spin1": 50.0 * spin, "normal": UP}
    actual, plain = judged(pair, **motion), carom.collide(pair, **motion)
    for name in plain._fields:
        assert np.array_equal(getattr(actual, name), getattr(plain, name)), name
    collided = plain.status == 0
    assert 5 < collided.sum() < 50
    assert np.all((actual.judgement == 2) == ~collided)
    assert np.all(np.isnan(actual.psi_out_error) == (actual.judgement != 0))


def test_the_error_is_that_of_the_impact():
    """Motion along x and spin about the normal, as `impact` takes and judges them."""
    for pair in (LIKE, UNLIKE):
        spins = {"spin": 20.0, "normal_spin": 300.0}
        hit = carom.impact(pair, normal_speed=1.0, tangential_speed=0.4, **spins)
        collisions = judged(pair, velocity1=[0.4, 0.0, 1.0], spin1=[0.0, 20.0, 300.0], normal=UP)
        parts = [f.value for f in hit.validity.findings if f.name.startswith("error of psi_2")]
        assert len(parts) == 2
        assert float(collisions.psi_out_error) == pytest.approx(sum(parts), rel=1e-12)
        assert min(parts) > 0.0


def test_direction_does_not_matter():
    """A frame turned at random sees the same error."""
    turned, _ = np.linalg.qr(RANDOM.normal(size=(3, 3)))
    turned *= np.sign(np.linalg.det(turned))
    velocity, spin = np.array([0.4, 0.1, 1.0]), np.array([5.0, -20.0, 100.0])
    motion = {"velocity1": velocity, "spin1": spin, "normal": np.array(UP)}
    one = judged(LIKE, **motion)
    other = judged(LIKE, **{name: turned @ vector for name, vector in motion.items()})
    assert float(other.psi_out_error) == pytest.approx(float(one.psi_out_error), rel=1e-9)


def test_spins_that_roll_on_each_other_do_not_count():
    """Two spheres that spin alike about the normal: nothing turns between them."""
    both = {"spin1": [0.0, 0.0, 300.0], "spin2": [0.0, 0.0, 300.0]}
    collisions = judged(LIKE, velocity1=[0.4, 0.0, 1.0], **both, normal=UP)
    still = judged(LIKE, velocity1=[0.4, 0.0, 1.0], normal=UP)
    apart = judged(LIKE, velocity1=[0.4, 0.0, 1.0], spin1=both["spin1"], normal=UP)
    assert float(collisions.psi_out_error) == float(still.psi_out_error)
    assert float(apart.psi_out_error) > 5.0 * float(still.psi_out_error)


def test_outside_the_domain_there_is_no_number():
    slow = {"velocity1": [0.0, 0.0, 1e-3], "normal": UP}
    fast = judged(LIKE, **slow, spin1=[0.0, 0.0, 1e4])
    assert (int(fast.judgement), np.isnan(fast.psi_out_error)) == (1, True)
    assert carom.status.Judgement(1).message.startswith("not studied")
    slippery = carom.Pair(STEEL, carom.HalfSpace(material="soda-lime-glass"), friction=0.001)
    assert int(judged(slippery, **slow).judgement) == 1
    for friction in (0.0, 1e-310):  # so little that psi_1 is infinite, as `impact` has it
        bodies = carom.Pair(STEEL, carom.HalfSpace(material="glass"), friction=friction)
        smooth = judged(bodies, velocity1=[1.0, 0.0, 1.0], normal=UP)
        assert (int(smooth.judgement), float(smooth.psi_out_error)) == (0, 0.0)


def test_written_in_place_it_is_judged_as_it_was():
    velocity, spin = np.array([[0.4, 0.0, 1.0]]), np.array([[0.0, 0.0, 300.0]])
    others = {"velocity2": np.zeros((1, 3)), "spin2": np.zeros((1, 3)), "normal": UP}
    before = judged(LIKE, velocity1=velocity, spin1=spin, **others)
    after = judged(LIKE, velocity1=velocity, spin1=spin, **others, inplace=True)
    assert after.velocity1 is velocity
    assert np.array_equal(after.psi_out_error, before.psi_out_error)


def test_what_cannot_be_judged_is_refused():
    inputs = {"velocity1": UP, "normal": UP}
    words = r"^law: .*judge=True judges the exact law"
    refused(words, carom.collide, LIKE, **inputs, judge=True, law=carom.laws.SmoothLaw())
    refused("^judge: ", carom.collide, LIKE, **inputs, judge="yes")


def test_errors_take_arrays():
    """Nothing without tangential motion, at most a reversal, less far above sliding."""
    psi = np.array([0.0, 1e-3, 1.0, 30.0])
    radial = rebound_error(0.8, 0.3, 0.1, 1.4, psi)
    assert radial[0] == 0.0
    assert np.all(radial <= 2.0 * psi)
    assert radial[3] < 0.01 * radial[2]
    assert spin_error(1.4, psi, 1.0).shape == psi.shape
    assert np.all(spin_error(1.4, psi, 0.0) == 0.0)


def test_contacts_too_large_for_hertz_are_not_judged():
    rubber = carom.Sphere(radius="10 mm", material="rubber")
    bodies = carom.Pair(rubber, carom.HalfSpace(material="rubber"), friction=0.5)
    collisions = judged(bodies, velocity1=[[0.1, 0.0, v] for v in (0.01, 30.0)], normal=UP)
    assert collisions.judgement.tolist() == [0, 1]


def test_it_is_printed_and_compared_as_collisions_are():
    motion = {"velocity1": [[0.4, 0.0, 1.0], [0.4, 0.0, -1.0]], "normal": UP}
    one, other = judged(LIKE, **motion), judged(LIKE, **motion)
    assert one == other, "NaN and NaN, too"
    assert one != judged(LIKE, **motion, spin1=[0.0, 0.0, 100.0])
    assert one != carom.collide(LIKE, **motion)
    lines = repr(one).splitlines()
    assert lines[0].startswith("2 collisions")
    assert any("bounded: psi_2" in line and line.endswith(": 1") for line in lines)
    assert "bounded" in one._repr_html_()
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)
