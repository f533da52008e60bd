"""The study of bulk: its page shows its table, laws are what they are called, its circle closes."""

import sys
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.verify.engines.experiments import Experiment
from carom.verify.engines.lammps import coefficients

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))

import bulk_study as study
import bulk_tables as tables
from bulk import contact_laws, events, gas, simulations
from bulk.cells import both_ways
from page_blocks import blocks

YOUNG = 1e9  # Pa, so that nothing is out of the ordinary; masses of 1 kg, diameters of 1 m
STUFF = carom.Material(young=YOUNG, poisson=0.3, density=6.0 / np.pi)
BALL = carom.Sphere(radius=0.5, material=STUFF)
PAIR = carom.Pair(BALL, BALL, friction=0.3)


def test_page_shows_what_the_table_says():
    assert blocks(tables.PAGE) == tables.tables()


def test_table_holds_every_simulation_and_no_other():
    assert list(simulations.read()) == study.everything()


def test_laws_are_given_the_contact_that_they_are_named_after():
    """E*, kappa, overlap and duration of an impact, and F_t = k_t a U, as Carom has them."""
    assert pytest.approx(PAIR.effective_modulus / YOUNG, rel=1e-12) == contact_laws.MODULUS
    assert pytest.approx(PAIR.kappa, rel=1e-12) == contact_laws.KAPPA
    assert pytest.approx(2.0 * PAIR.effective_shear_modulus / YOUNG) == contact_laws.SHEAR
    speed = 0.01
    scales, unit = PAIR.scales(speed), 1.0 / np.sqrt(YOUNG)  # of time, in s
    assert contact_laws.overlap(speed * unit) == pytest.approx(scales.length, rel=1e-9)
    lasted = contact_laws.duration(speed * unit) * unit
    assert lasted == pytest.approx(2.943275184 * scales.time, rel=1e-9)
    setting = contact_laws.Setting(0.3, 0.9, 1e-3, contact_laws.secant(1e-3))
    force = 4.0 / 3.0 * PAIR.effective_modulus / YOUNG * np.sqrt(0.25) * 1e-3**1.5
    assert setting.spring * 1e-3 == pytest.approx(force, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "variant", "stiffness"),
    [
        ("mindlin", "mindlin", 1.0),
        ("mindlin_rescale/force", "mindlin_rescale/force", 1.0),
        ("0.78 k_t", "mindlin_rescale/force", 0.78),
    ],
)
def test_lammps_is_told_what_the_bench_tells_it(name, variant, stiffness):
    """The words of `pair_coeff` are those of the bench, which runs LAMMPS against its own laws."""
    law = carom.dem.LammpsMindlin(
        variant, stiffness=stiffness, restitution=0.9, tangential_damping=1.0
    )
    experiment = Experiment(
        pair=PAIR, law=law, normal_speed=0.01, tangential_speed=(0.0,), steps=100
    )
    answer = coefficients(experiment)
    expected = answer.words(answer.number).split()
    setting = contact_laws.Setting(0.3, 0.9, 0.01, 1.0)
    words = contact_laws.pairs(contact_laws.named(name), setting).split("* * ")[1].split()
    assert len(words) == len(expected)
    for word, other in zip(words, expected, strict=True):
        scale = YOUNG if other in (repr(answer.kn), repr(answer.kt)) else 1.0
        try:
            assert float(word) * scale == pytest.approx(float(other), rel=1e-9)
        except ValueError:
            assert word == other


def test_circle_of_the_gas_closes():
    """Time stepping and events: no energy is off by more than 3.5 bars, all together as by chance.

    Energies of one gas at several times go together: the mean square is held against a wide band.
    """
    offs = []
    for friction in gas.SEEDS:
        for quantity in ("translational", "rotational"):
            for time in gas.TIMES:
                one, other = both_ways(friction, quantity, float(time))
                offs.append((one.value - other.value) / np.hypot(one.bar, other.bar))
    assert np.abs(offs).max() < 3.5
    assert 0.3 < np.mean(np.square(offs)) < 1.8


def test_other_laws_do_not_close_the_circle():
    """Springs with 2/7 spin the gas by 40 % more: what the circle would not hide."""
    _, hard = both_ways(0.3, "rotational", 20.0)
    soft = tables.mean(tables.cooled("linear 2/7", 0.3, "rotational", 20.0))
    assert soft.value / hard.value > 1.3
    assert (soft.value - hard.value) / np.hypot(soft.bar, hard.bar) > 10.0


@pytest.fixture(scope="module")
def start():
    """A gas of 216 spheres that do not touch: places, velocities, side of the box."""
    random, side = np.random.default_rng(5), 9.0
    line = (np.arange(6) + 0.5) * side / 6
    places = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
    velocities = random.standard_normal(places.shape)
    return places + 0.2 * random.random(places.shape), velocities - velocities.mean(0), side


@pytest.mark.slow
def test_spheres_without_friction_keep_their_energy(start):
    moving, turning = events.cool(*start, 0.0, np.array([0.5, 2.0]))
    assert moving == pytest.approx(np.full(2, 0.5 * (start[1] ** 2).sum(1).mean()), rel=1e-12)
    assert not turning.any()


@pytest.mark.slow
def test_spheres_never_overlap_and_keep_their_momentum(start):
    """In every event exactly two touch, all others are apart."""
    place, velocity, side = (np.copy(part) for part in start)
    when, whom = np.full(len(place), np.inf), np.full(len(place), -1)
    met, now, count = np.array([-1, -1]), 0.0, 0
    spin, pair = np.zeros_like(velocity), carom.Pair(BALL, BALL, friction=0.3)
    while now < 0.3:
        now, one = events.next_event(place, velocity, side, when, whom, now, 0.3, met)
        gaps = place[:, np.newaxis] - place
        gaps -= side * np.round(gaps / side)
        distances = np.sqrt((gaps**2).sum(2))[np.triu_indices(len(place), 1)]
        touching = np.sort(distances)[:2]
        assert touching[1] > 1.0 - 1e-9
        if one >= 0:
            assert touching[0] == pytest.approx(1.0, abs=1e-9)
            met, count = np.array([one, whom[one]]), count + 1
            events.collide(pair, place, velocity, spin, side, met)
    assert count > 30
    assert velocity.sum(0) == pytest.approx(np.zeros(3), abs=1e-11)
