"""Impacts as a test of LAMMPS's granular suite: a YAML file of unittest/granular, dem04."""

from __future__ import annotations

from collections.abc import Sequence
from string import Template

import numpy as np
from lammps_twin import State, outcomes_of, trajectory
from lammps_unittest import indented, rows, sphere_commands

from carom.bodies.shapes import Sphere
from carom.dimensionless.rebounds import rebound
from carom.quantities.arrays import Array
from carom.quantities.units import positive
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.lammps import NUMBERS, coefficients

SEGMENTS = (0.3, 0.4, 0.5)  # of the contact's duration: pressed, springing back, apart

PAGE = Template("""\
---
# $count oblique impacts of $bodies, one beside the other. Written by Carom.
# Reference: the law as the manual states it, computed without LAMMPS in the same steps.
# Beside it the exact rebound of elastic spheres (Maw, Barber & Fawcett 1976), which no law gives.
# psi = $kappa V_x/(mu V_1), V_x of the contact point along x, V_1 = $speed m/s, chi = $chi.
#    psi before   psi after     exact
$rebounds
lammps_version: 22 Jul 2025
tags: granular
date_generated:
epsilon: $epsilon
skip_tests:
prerequisites: |
  atom sphere
  pair granular
  fix nve/sphere
  fix wall/gran
pre_commands: |
$pre_commands
post_commands: |
$post_commands
input_file:
natoms: $natoms
variables: |
$variables
pair_style: granular
pair_coeff: |
  * * $words
run_segments: |-
  $segments
run_pos: |2
$positions
run_vel: |2
$velocities
run_torque: |2
$torques
run_omega: |2
$spins
...
""")


def dem_test_yaml(experiment: Experiment, *, epsilon: float) -> str:
    """Return impacts as a file dem04-*.yaml of LAMMPS's unittest/granular/tests.

    The driver compares positions, velocities, torques and spins, each to a relative epsilon: while
    the bodies approach, while they part, and when they have parted.

    Parameters
    ----------
    experiment : Experiment
        The impacts; LAMMPS has their law, which has no damping.
    epsilon : float
        Largest relative error of a component that passes.

    Raises
    ------
    InputError
        If the law has damping, or LAMMPS does not have it.

    """
    tolerance = positive("epsilon", epsilon, "1")
    pair, law = experiment.pair, coefficients(experiment)
    segments = [round(share * experiment.steps) for share in SEGMENTS]
    states = trajectory(experiment, segments)
    wall, words = not isinstance(pair.second, Sphere), law.words("${{{}}}".format)
    bodies = arrangement.placed(experiment)
    return PAGE.substitute(
        arrangement.shared_values(experiment),
        rebounds=_rebounds(experiment, states[-1]),
        kappa=f"{pair.kappa:.6g}",
        chi=f"{pair.chi:.6g}",
        speed=f"{experiment.normal_speed:g}",
        epsilon=f"{tolerance:g}",
        pre_commands=indented(_before(experiment, bodies)),
        post_commands=indented(_motion(words, wall)),
        natoms=len(bodies),
        variables=indented([f"{name} {law.number(name)}" for name in NUMBERS]),
        words=words,
        segments=" ".join(map(str, segments)),
        **_blocks(states, np.array([body.y for body in bodies])),
    )


def _rebounds(experiment: Experiment, last: State) -> str:
    """Return psi before and after of each impact, and the exact one after, as comments."""
    before = experiment.psi_in
    after = psi_out(experiment, outcomes_of(last))
    exact = np.asarray(rebound(before, experiment.pair.chi))
    lines = np.column_stack([before, after, exact])
    return "\n".join("#  " + " ".join(f"{value:11.4f}" for value in line) for line in lines)


def _before(experiment: Experiment, bodies: list[arrangement.Placed]) -> list[str]:
    """Return the commands that make the spheres."""
    edge = arrangement.spacing(experiment.pair)
    region = f"{-edge!r} {edge!r} {-edge!r} {edge * len(experiment)!r} {-edge!r} {edge!r}"
    return [
        "units si",
        "atom_style sphere",
        "boundary f f f",
        "comm_modify vel yes",
        f"region box block {region} units box",
        "create_box 1 box",
        *(line for i, body in enumerate(bodies, 1) for line in sphere_commands(i, body, 0.0, 0.0)),
        f"neighbor {arrangement.SKIN * edge!r} bin",
        f"timestep {experiment.time_step!r}",
    ]


def _motion(words: str, wall: bool) -> list[str]:
    contact = [f"fix wall all wall/gran granular {words} zplane 0.0 NULL"] if wall else []
    return ["fix move all nve/sphere", *contact]


def _blocks(states: Sequence[State], y: Array) -> dict[str, str]:
    """Return what the driver compares after each segment, by the names of the page."""
    found: dict[str, list[str]] = {}
    for segment, state in enumerate(states):
        still = np.zeros_like(y)
        vectors = {
            "positions": (state.x, y, state.z),
            "velocities": (state.vx, still, state.vz),
            "torques": (still, state.torque, still),
            "spins": (still, state.omega, still),
        }
        for name, components in vectors.items():
            table = np.column_stack([np.ravel(values) for values in components])
            found.setdefault(name, []).append(rows(table + 0.0, f"{segment:5d}"))
    return {name: "\n".join(texts) for name, texts in found.items()}
