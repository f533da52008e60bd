"""The exact contact law in steps: how near it is, its order, and what it refuses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import carom
from carom.dem import lattice
from carom.dem.coefficients import ELASTIC_PULL
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.hertz import DURATION

PSI, CHIS = np.linspace(0.0, 6.0, 64), (1.0, 1.75)


def worst(springs, steps, e=1.0):
    """Return the largest |psi_2 - exact|."""
    law = carom.dem.ExactContactLaw(springs, restitution=e)
    losses = None if e == 1.0 else carom.KelvinVoigt(e)
    return max(
        np.abs(law.rebound(PSI, chi, steps=steps) - carom.rebound(PSI, chi, losses=losses)).max()
        for chi in CHIS
    )


@pytest.mark.parametrize(
    ("springs", "steps", "e", "bound"),
    [
        *((16, 100, 1.0, 1.5e-3), (16, 200, 1.0, 1e-3), (16, 400, 1.0, 9e-4)),
        *((32, 50, 1.0, 2.5e-3), (32, 100, 1.0, 8e-4), (32, 400, 1.0, 2e-4)),
        *((64, 100, 1.0, 6.5e-4), (64, 400, 1.0, 1e-4), (32, 50, 0.9, 4e-3)),
        *((16, 100, 0.9, 1.5e-3), (32, 100, 0.7, 1e-3)),
    ],
)
def test_rebounds_are_as_near_as_promised(springs, steps, e, bound):
    assert 0.2 * bound < worst(springs, steps, e) <= bound


@pytest.mark.first_case
@pytest.mark.parametrize("springs", [16, 32, 64])
@pytest.mark.parametrize(("chis", "promised"), [((0.3, 2.5), 0.4), ((2.5, 10.0), 4.0)])
def test_errors_are_within_the_range_of_chi_that_is_stated(springs, chis, promised):
    """0.4/N^2 up to chi = 2.5, 4/N^2 up to 10, at both ends and at random in between."""
    rng = np.random.default_rng(springs)
    law, largest = carom.dem.ExactContactLaw(springs), 0.0
    for chi in (*chis, *np.exp(rng.uniform(*np.log(chis), 3))):
        psi = np.linspace(0.0, 4.0 * chi + 0.5, 61)
        largest = max(largest, np.abs(law.rebound(psi, chi) - carom.rebound(psi, chi)).max())
    assert 0.25 * promised < largest * springs**2 <= promised


@pytest.mark.first_case
@pytest.mark.parametrize("e", [1.0, 0.7])
def test_the_order_is_the_second_in_steps_and_springs(e):
    by_steps = [worst(512, steps, e) for steps in (25, 200)]
    assert np.log2(by_steps[0] / by_steps[1]) / 3.0 > 1.9
    by_springs = [worst(springs, 1000, e) for springs in (16, 64)]
    assert np.log2(by_springs[0] / by_springs[1]) / 2.0 > 1.8


def left_with(phase, steps, alpha, psi=3.0, chi=1.4412):
    """Return psi_2 of an impact by velocity Verlet, touched at this part of a step."""
    memory, load, dt = np.zeros(lattice.places(64)), np.zeros(3), DURATION / steps
    d, v = -phase * dt, 1.0
    for _ in range(4 * steps):
        v, psi = v - 0.5 * dt * ELASTIC_PULL * load[0], psi - dt * ELASTIC_PULL * chi * load[1]
        d += dt * v
        lattice.step(memory, 64, d, np.array([v, psi, 0.0]), dt, alpha, alpha, chi, load)
        if v < 0.0 and load[0] <= 0.0:
            break
        v, psi = v - 0.5 * dt * ELASTIC_PULL * load[0], psi - dt * ELASTIC_PULL * chi * load[1]
    return psi


@pytest.mark.parametrize("alpha", [0.0, 0.2])
def test_a_touch_just_before_the_end_of_a_step_is_one_at_its_end(alpha):
    """Dashpots bear their mean over a step, along as across: without it psi_2 is off by 0.002."""
    assert left_with(1.0 - 1e-9, 50, alpha) == pytest.approx(left_with(0.0, 50, alpha), abs=2e-5)


def turned(steps, springs=64):
    """Return the forces, x and y, of a contact pressed as by Hertz while its slip turns round."""
    memory, load = np.zeros(lattice.places(springs)), np.zeros(3)
    dt, depth, entries = DURATION / steps, 0.0, []
    for i in range(1, steps):
        middle, now = (i - 0.5) * dt, hertz.penetration_and_speed(i * dt)[0]
        motion = np.array([(now - depth) / dt, 1.2 * np.cos(2 * middle), 1.2 * np.sin(2 * middle)])
        lattice.step(memory, springs, now, motion, dt, 0.0, 0.0, 1.4, load)
        entries.append(load[1:].copy())
        depth = now
    return np.array(entries)


def test_the_order_is_the_second_where_the_direction_turns():
    """A cut alone leaves it the first: 0.010 at 100 steps instead of 0.0004."""
    fine = turned(6400)
    off = [np.hypot(*(turned(n) - fine[6400 // n - 1 :: 6400 // n]).T)[2:].max() for n in (50, 400)]
    assert np.log2(off[0] / off[1]) / 3.0 > 1.7
    assert off[0] < 2e-3


def test_without_steps_only_the_springs_are_left():
    law = carom.dem.ExactContactLaw(256)
    off = np.abs(law.rebound(PSI, 1.4412) - carom.rebound(PSI, 1.4412)).max()
    assert off < 2e-5


def test_sliding_throughout_is_exact_but_for_the_steps():
    """psi_2 = psi_1 - 2 chi (1 + e) (Barber 1979, (33)); e of the steps themselves."""
    history = carom.dem.ExactContactLaw(16).history(9.0, 1.2, steps=100)
    e = -history["normal_velocity"][-1]
    assert history["psi"][-1] == pytest.approx(9.0 - 2.4 * (1.0 + e), abs=2e-3)
    assert_allclose(history["tangential_force"], history["normal_force"], atol=1e-12)  # mu N


@pytest.mark.parametrize("e", [0.9, 0.5])
def test_it_leaves_the_restitution_it_is_made_for(e):
    law = carom.dem.ExactContactLaw(32, restitution=e)
    speed = law.history(0.0, 1.2, steps=400)["normal_velocity"]
    assert -speed[-1] == pytest.approx(e, abs=2e-4)


def test_losses_in_compression_alone_leave_shear_elastic():
    """Less springs back at the same e where shear is viscous, too."""
    both, one = (
        carom.dem.ExactContactLaw(64, restitution=0.7, viscous_shear=shear).rebound(
            0.9, 1.4412, steps=200
        )
        for shear in (True, False)
    )
    exact = carom.rebound(0.9, 1.4412, losses=carom.KelvinVoigt(0.7))
    assert both == pytest.approx(exact, abs=1e-3)
    assert abs(one - exact) > 0.02


@pytest.mark.parametrize("springs", [4, 4100, 33, 32.5, "many", None])
def test_numbers_of_springs_that_cannot_be_are_refused(springs):
    with pytest.raises(carom.InputError, match=r"^springs: ") as error:
        carom.dem.ExactContactLaw(springs)
    assert "\n" not in str(error.value)


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.7, 1.4412, 3.0])
@pytest.mark.parametrize("e", [1.0, 0.9, 0.5, 0.1, 0.01])
def test_steps_that_are_too_long_are_not_solved(e, chi):
    """What is solved has gained no energy, from the slowest on: |psi_2| <= |psi_1|."""
    psi, law = 10.0 ** np.linspace(-30.0, 1.0, 63), carom.dem.ExactContactLaw(32, restitution=e)
    solved = []
    for steps in (4, 8, 16, 32, 64, 128, 256, 512):
        out, status = law.rebound(psi, chi, steps=steps, return_status=True)
        assert np.all(status == status[0])
        solved.append(status[0] == carom.status.LawStatus.SOLVED)
        assert not solved[-1] or np.all(np.abs(out) <= 1.01 * psi)
    assert solved == sorted(solved)
    assert solved[-1]
    assert solved[0] == (e >= 0.9 and chi < 2.0)


def lost_in_a_cycle(springs, part, depth, steps=200):
    """Return what a pressed contact loses as the shear force goes to and fro by a part of mu P,
    over 8 int_0^u (1 - (1 - u)^(3/2) - part/2) du of Mindlin & Deresiewicz (1953), u of the part.
    """
    memory, load, rate = np.zeros(lattice.places(springs)), np.empty(3), depth / steps
    pressed = np.array([1.0, 0.0, 0.0])
    for i in range(steps):
        lattice.step(memory, springs, (i + 1) * rate, pressed, rate, 0.0, 0.0, 1.4, load)
    largest, lost = 1.0 - (1.0 - part) ** (2.0 / 3.0), 0.0
    for way in (0.5, -1.0, 1.0, -1.0, 1.0):
        if way < 0.0:
            lost = 0.0
        shear = np.array([0.0, 2.0 * way * depth * largest / steps, 0.0])
        for _ in range(steps):
            before = load[1]
            lattice.step(memory, springs, depth, shear, 1.0, 0.0, 0.0, 1.4, load)
            lost += 0.5 * (before + load[1]) * shear[1]
    exact = largest - 0.4 * (1.0 - (1.0 - largest) ** 2.5) - 0.5 * part * largest
    return lost / (8.0 * exact * depth**2.5)


@pytest.mark.first_case
@pytest.mark.parametrize("springs", [16, 64, 256])
def test_small_cycles_lose_energy_as_far_as_springs_resolve_them(springs):
    """Of mu P: at 1.5/N a contact may lose nothing; most is lost from 8/N on, all from 12/N on."""
    depths = np.random.default_rng(springs).uniform(0.5, 1.0, 8)
    parts = np.array([1.5, 8.0, 9.5, 12.0, 15.0])
    lost = np.array([[lost_in_a_cycle(springs, n / springs, d) for d in depths] for n in parts])
    assert lost[0].min() < 1e-9
    assert np.all((lost[1:] > 0.87) & (lost[1:] < 1.03))
    assert np.all(lost[3:] > 0.95)
