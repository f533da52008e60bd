"""What engines are asked for: experiments, how they are set up, and how results are read."""

import sys
from math import pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from tests.checks import BALL, PAIR as WALL, experiment, refused

import carom
from carom.dimensionless.numerics.hertz import DURATION
from carom.verify.engines.arrangement import outcomes_of, placed, run_length, spring, touching
from carom.verify.engines.experiments import Outcomes, psi_out, results_csv
from carom.verify.scoring import score

sys.path.insert(0, str(Path(__file__).parents[2] / "studies"))

from lammps_unittest import exact

BEAD = carom.Sphere(radius=3e-3, material="aluminium")
FREE = carom.Pair(BEAD, BALL, friction=0.3)


@pytest.mark.parametrize("pair", [WALL, FREE])
def test_psi_out_and_reference_are_those_of_the_exact_impact(pair):
    """Velocities and spin of `impact` give psi_2 = rebound(psi_1), also of unequal spheres."""
    wanted = experiment(pair=pair, tangential_speed=(0.001, -0.004, 0.02), spin=(0.0, 2.0, -1.0))
    hits = [
        carom.impact(pair, normal_speed=0.01, tangential_speed=v, spin=w)
        for v, w in zip(wanted.tangential_speed, wanted.spin, strict=True)
    ]
    columns = [(1.0 * hit.normal_speed, hit.tangential_speed_out, hit.spin_out) for hit in hits]
    outcomes = Outcomes(*np.array(columns).T)
    psi = [hit.psi_out for hit in hits]
    assert wanted.psi_in == pytest.approx([hit.psi_in for hit in hits], rel=1e-12)
    assert psi_out(wanted, outcomes) == pytest.approx(psi, abs=1e-9)
    for mine, theirs in zip(exact(wanted), outcomes, strict=True):
        assert mine == pytest.approx(theirs, rel=1e-8, abs=1e-12)
    assert wanted.time_step * wanted.steps == pytest.approx(hits[0].duration, rel=1e-12)


@pytest.mark.parametrize("pair", [WALL, FREE])
def test_results_are_what_the_scorer_reads(pair, tmp_path):
    """Exact outcomes, written and read by the scorer, are without error; no digit is lost."""
    wanted = experiment(pair=pair, tangential_speed=(0.001, -0.004, 0.1 / 3), spin=(0.0, 2.0, -1.0))
    outcomes = exact(wanted)
    file = tmp_path / "results.csv"
    file.write_text(results_csv(wanted, outcomes))
    assert np.max(np.abs(score(file, case=pair).points.error)) < 1e-12
    table = np.loadtxt(file, delimiter=",", skiprows=1)
    assert np.array_equal(table[:, 0], np.full(3, wanted.normal_speed))
    assert np.array_equal(table[:, 1:3].T, [wanted.tangential_speed, wanted.spin])
    assert np.array_equal(table[:, 3:].T, outcomes)


@pytest.mark.parametrize("pair", [WALL, FREE])
@pytest.mark.parametrize("restitution", [1.0, 0.6])
def test_spring_takes_the_energy_of_the_impact(pair, restitution):
    """k_n d_max^2 = m_n V_1^2; the dashpot is the part of the critical one that leaves e."""
    wanted = experiment(pair=pair, law=carom.dem.LinearSpring(restitution=restitution))
    normal, tangential, dashpot = spring(wanted)
    energy = pair.normal_mass * wanted.normal_speed**2
    assert normal * wanted.scales.length**2 == pytest.approx(energy, rel=1e-12)
    assert tangential == pytest.approx(pair.kappa * normal, rel=1e-15)
    part = dashpot / (2.0 * sqrt(pair.normal_mass * normal))
    assert np.exp(-pi * part / sqrt(1.0 - part**2)) == pytest.approx(restitution, rel=1e-12)


LAWS = "LinearSpring HertzLinearHistory LammpsMindlin LiggghtsHertz YadeMindlin"


@pytest.mark.parametrize("law", [getattr(carom.dem, name) for name in LAWS.split()])
@pytest.mark.parametrize("restitution", [1.0, 0.9, 0.5, 0.1, 0.05, 0.01])
def test_all_have_parted_by_the_end_of_a_run(law, restitution):
    """A run is longer than any contact, by our own steps; at e = 0.05 the longest is 1.8 t_c."""
    wanted = experiment(law=law(restitution=restitution), steps=200)
    history = wanted.law.history(1.0, WALL.chi, steps=200)
    assert history["time"][-1] / DURATION < run_length(wanted) / 200


@pytest.mark.parametrize("pair", [WALL, FREE])
def test_bodies_start_a_hair_apart_and_meet_as_asked(pair):
    """Relative positions and velocities are those of the experiment, neighbours far away."""
    wanted = experiment(pair=pair)
    bodies = placed(wanted)
    first, second = bodies[:2], bodies[2:] or [bodies[0]._replace(z=0.0, vx=0.0, vz=0.0)] * 2
    for one, two, speed in zip(first, second, wanted.tangential_speed, strict=True):
        assert 0.0 < (one.z - two.z) / touching(pair) - 1.0 < 2e-15
        assert one.vz - two.vz == pytest.approx(-wanted.normal_speed, rel=1e-15)
        assert one.vx - two.vx == pytest.approx(speed, rel=1e-15)
    assert [one.spin for one in first] == list(wanted.spin)
    assert first[1].y - first[0].y >= 2.0 * touching(pair)


@pytest.mark.parametrize("pair", [WALL, FREE])
def test_outcomes_are_relative_and_whole(pair):
    """Velocities are those of the first to the second body; none may be missing or touch."""
    wanted, apart = experiment(pair=pair), 1.001 * touching(pair)
    first = np.array([[0.0, apart, 0.3, 0.2, -7.0], [0.0, apart, 0.4, 0.2, -8.0]])
    second = np.array([[0.0, 0.0, 0.1, -0.1, 5.0]] * 2)
    states = first if pair is WALL else np.vstack([first, second])
    actual = outcomes_of(wanted, states)
    still = np.zeros(5) if pair is WALL else second[0]
    assert actual.normal_speed == pytest.approx(first[:, 3] - still[3], rel=1e-15)
    assert actual.tangential_speed == pytest.approx(first[:, 2] - still[2], rel=1e-15)
    assert actual.spin.tolist() == [7.0, 8.0]
    with pytest.raises(ValueError, match=f"{len(states) - 1} by 5, not {len(states)} by 5"):
        outcomes_of(wanted, states[:-1])
    states[1, 1] = 0.999 * touching(pair)
    with pytest.raises(ValueError, match="still touch"):
        outcomes_of(wanted, states)
    if pair is FREE:  # lower than that, but aside
        states[1, :2] = 0.7 * touching(pair), 0.8 * touching(pair)
        assert outcomes_of(wanted, states).spin.size == 2


HOLLOW = carom.Sphere(radius=5e-3, material="steel", inner_radius=4e-3)
CUP = carom.Cup(radius=6e-3, material="steel")


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"spin": (1.0,)}, "spin: 1 values for 2 of tangential_speed"),
        ({"tangential_speed": (), "spin": ()}, "tangential_speed: "),
        ({"tangential_speed": 0.1}, "must be a sequence"),
        ({"tangential_speed": (0.1, float("nan"))}, "tangential_speed: nan"),
        ({"normal_speed": 0.0}, "normal_speed: 0.0"),
        ({"steps": 9}, "whole number of at least 10"),
        ({"law": "mindlin"}, "must be a contact law"),
        ({"pair": carom.Pair(BALL, BALL, friction=0.0)}, "friction: 0.0"),
        ({"pair": carom.Pair(HOLLOW, BALL, friction=0.2)}, "must be solid"),
        ({"pair": carom.Pair(BALL, CUP, friction=0.2)}, "must be a Sphere or HalfSpace"),
    ],
)
def test_experiments_refuse(changed, words):
    refused(words, experiment, **changed)
