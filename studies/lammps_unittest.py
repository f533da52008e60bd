"""Impacts as a test of LAMMPS's own suite: a YAML file of unittest/force-styles, fix-timestep."""

from __future__ import annotations

from string import Template

import numpy as np

from carom.bodies.shapes import Sphere
from carom.dimensionless.rebounds import rebound
from carom.quantities.arrays import Array
from carom.quantities.refusals import refusal
from carom.quantities.units import positive
from carom.verify.engines import arrangement
from carom.verify.engines.arrangement import Placed
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps import coefficients

FLIGHT = 8  # steps that the driver runs after the commands
FASTER = 4.0  # drift over the largest tangential speed

PAGE = Template("""\
---
# $count oblique impacts, written by Carom. Reference: $reference.
# epsilon: an error of $tolerance in psi_2 = $kappa V_x/(mu V_1) of the contact point.
# The impacts run in pre_commands; the steps of the driver are free flight. Everything drifts along
# x, a wall too, so that epsilon, which is relative, means the same for every sphere.
lammps_version: 22 Jul 2025
tags: no_respa
date_generated:
epsilon: $epsilon
timestep: $time_step
skip_tests:
prerequisites: |
  atom sphere
  $style
  fix nve/sphere
pre_commands: |
$pre_commands
post_commands: |
$post_commands
input_file: in.empty
input_coeffs: coeffs.brownian
natoms: $natoms
run_pos: |2
$positions
run_vel: |2
$velocities
run_torque: |2
$torques
...
""")


def unit_test_yaml(
    experiment: Experiment, *, tolerance: float, outcomes: Outcomes | None = None
) -> str:
    """Return impacts as a file fix-timestep-*.yaml of LAMMPS's unittest/force-styles/tests.

    The driver compares positions and velocities of the centres, each to a relative epsilon; spins
    it does not know, they follow from the velocities. It takes such a file since its releases of
    2026, in which a test names its file of coefficients. The tolerance is the largest error in
    psi_2 that passes. The reference is the exact impact unless outcomes are given; the laws of
    LAMMPS miss it by 0.1 to 1.4. InputError for a law with damping, which the exact theory has not.
    """
    allowed = positive("psi_out", tolerance)
    reference = "as given"
    if outcomes is None:
        outcomes, reference = exact(experiment), "the exact elastic impact"
    before, pair = arrangement.placed(experiment), experiment.pair
    fastest = max(abs(speed) for body in before for speed in (body.vx, body.vz))
    x, drift = arrangement.spacing(pair), FASTER * fastest
    velocities = _speeds(experiment, outcomes) + np.array([drift, 0.0, 0.0])
    places = np.array([[x, body.y, body.z] for body in before])
    time = (arrangement.run_length(experiment) - experiment.steps + FLIGHT) * experiment.time_step
    moved = velocities * time + np.array([drift * experiment.duration, 0.0, 0.0])
    return PAGE.substitute(
        count=len(experiment),
        reference=reference,
        tolerance=f"{allowed:g}",
        kappa=f"{pair.kappa:.6g}",
        epsilon=f"{_epsilon(experiment, velocities[:, 0], allowed):.4g}",
        time_step=repr(experiment.time_step),
        style="pair granular" if isinstance(pair.second, Sphere) else "fix wall/gran",
        pre_commands=indented(_before(experiment, before, x, drift)),
        post_commands=indented(_contact(experiment, drift)),
        natoms=len(before),
        positions=rows(places + moved),
        velocities=rows(velocities),
        torques=rows(np.zeros((len(before), 3))),
    )


def exact(experiment: Experiment) -> Outcomes:
    """Return how the bodies leave by the exact theory of elastic spheres.

    The tangential impulse is J = m_t (V_x - V_x'); dv_t = -J/m_n, d spin = -J R/(M K^2).
    """
    if arrangement.restitution(experiment) != 1.0:
        raise refusal(
            "law", experiment.law, "it has damping, the exact theory has none; give outcomes"
        )
    pair, first = experiment.pair, experiment.pair.first
    outgoing = np.asarray(rebound(experiment.psi_in, pair.chi))
    lost = (experiment.psi_in - outgoing) * experiment.scales.tangential_speed
    impulse = pair.tangential_mass * lost
    turned = impulse / (first.mass * first.gyration_ratio * first.radius)
    return Outcomes(
        np.full(len(experiment), experiment.normal_speed),
        np.array(experiment.tangential_speed) - impulse / pair.normal_mass,
        np.array(experiment.spin) - turned,
    )


def _speeds(experiment: Experiment, outcomes: Outcomes) -> Array:
    """Return velocities of all spheres after, (natoms, 3), the centre of mass at rest."""
    pair = experiment.pair
    relative = np.column_stack(
        [outcomes.tangential_speed, np.zeros(len(experiment)), outcomes.normal_speed]
    )
    if not isinstance(pair.second, Sphere):
        return relative
    share = arrangement.share_of_first(pair)
    return np.concatenate([share * relative, (share - 1.0) * relative])


def _epsilon(experiment: Experiment, along: Array, tolerance: float) -> float:
    """Return the relative error of a velocity along x that is an error in psi_2, the largest."""
    pair = experiment.pair
    change = tolerance * experiment.scales.tangential_speed * pair.tangential_mass
    lightest = min(body.mass for body in pair.moving)
    return float(change / lightest / (np.min(np.abs(along)) - change / lightest))


def _before(experiment: Experiment, bodies: list[Placed], x: float, drift: float) -> list[str]:
    """Return the commands that make the spheres and run their impacts."""
    edge = arrangement.spacing(experiment.pair)
    region = f"0 {2.0 * edge!r} {-edge!r} {edge * len(experiment)!r} {-edge!r} {edge!r}"
    return [
        "variable newton_pair delete",
        "variable newton_pair index off",
        "variable newton_bond delete",
        "variable newton_bond index off",
        "units si",
        "atom_style sphere",
        "atom_modify map array sort 0 0.0",
        "boundary m m m",
        "newton off off",
        f"comm_modify vel yes cutoff {edge!r}",
        f"region box block {region}",
        "create_box 1 box",
        *(line for i, body in enumerate(bodies, 1) for line in sphere_commands(i, body, x, drift)),
        *_contact(experiment, drift),
        f"timestep {experiment.time_step!r}",
        f"run {arrangement.run_length(experiment)}",
        "unfix test",
        *(() if isinstance(experiment.pair.second, Sphere) else ("unfix move",)),
        "reset_timestep 0",
    ]


def sphere_commands(number: int, body: Placed, x: float, drift: float) -> list[str]:
    """Return the commands that make a sphere at x, with a drift along x added to its motion."""
    size, density = 2.0 * body.sphere.radius, body.sphere.material.density
    velocity = f"vx {drift + body.vx!r} vz {body.vz!r}"
    return [
        f"create_atoms 1 single {x!r} {body.y!r} {body.z!r} units box",
        f"set atom {number} diameter {size!r} density {density!r}",
        f"set atom {number} {velocity} omega 0.0 {0.0 - body.spin!r} 0.0",
    ]


def _contact(experiment: Experiment, drift: float) -> list[str]:
    """Return the commands of motion and contact; the driver asks for a fix called test."""
    law, pair = coefficients(experiment), experiment.pair
    # the driver's pair_style zero reaches farther than the box: no bins
    start = [f"neighbor {arrangement.SKIN * arrangement.spacing(pair)!r} nsq"]
    words = law.words(law.number)
    if isinstance(pair.second, Sphere):
        granular = ["pair_style granular", f"pair_coeff * * {words}"]
        return [*start, *granular, "fix test all nve/sphere"]
    wall = f"zplane 0.0 NULL shear x {drift!r}"
    contact = f"fix test all wall/gran granular {words} {wall}"
    return [*start, "fix move all nve/sphere", contact]


def indented(lines: list[str]) -> str:
    """Return lines as a block of YAML."""
    return "\n".join(f"  {line}" for line in lines)


def rows(values: Array, before: str = "") -> str:
    """Return vectors as the suites list them, by the number of the atom, after a word if given."""
    return "\n".join(
        f"{before}{number:5d} " + " ".join(f"{value:23.16e}" for value in row)
        for number, row in enumerate(values, 1)
    )
