"""pair_style carom part tangential: friction by springs, beside the normal force of granular."""

import re

import numpy as np
import pytest

pytestmark = pytest.mark.engine
YOUNG, POISSON, FRICTION, RADIUS = 5e7, 0.3, 0.3, 5e-3
MODULUS, REDUCED = YOUNG / (2.0 * (1.0 - POISSON**2)), 0.5 * RADIUS
SOLID = f"young {YOUNG} poisson {POISSON} friction {FRICTION}"
NONE = f"tangential linear_nohistory 0.0 {FRICTION}"
HEAD = (
    "units si\natom_style sphere\ncomm_modify vel yes\nboundary f f f\nneighbor 0.001 bin\n"
    "newton off\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 2 b\n"
)
BALLS = "set group all diameter 0.01\nset group all density 2500\n"
TWO = (
    "create_atoms 1 single 0.05 0.05 0.05\ncreate_atoms 1 single {} 0.05 0.05\n"
    f"{BALLS}group one id 1\ngroup other id 2\n"
)


def pair(normal, more="", style="precision double", solid=SOLID):
    """Granular and, beside it, the tangential part of carom."""
    return (
        f"pair_style hybrid/overlay granular carom {style} part tangential\n"
        f"pair_coeff * * granular {normal}\npair_coeff * * carom {solid} {more}\n"
    )


def hertz(damping=0.0, more="damping velocity", friction=NONE):
    return f"hertz/material {YOUNG} {damping} {POISSON} {friction} {more}"


def rows(printed, width):
    """The numbers that LAMMPS prints in so many columns."""
    number = r" +-?[\d.]+(?:e[-+]\d+)?"
    table = re.findall(rf"^ *\d+(?:{number}){{{width - 1}}} *$", printed, re.MULTILINE)
    return np.array([line.split() for line in table], dtype=float)


def test_energy_that_leaves_the_motion_is_what_friction_took(lammps):
    start = TWO.format(0.060001) + "velocity one set 0.1 0.05 0.02\n"
    printed = lammps(
        f"{HEAD}{start}{pair(hertz(), style='springs 64 precision double ledger yes')}"
        "fix 1 all nve/sphere\ntimestep 1e-6\ncompute k all ke\ncompute r all erotate/sphere\n"
        "compute p all pair carom\nthermo_style custom step c_k c_r c_p[1] c_p[2] c_p[3]\n"
        "thermo_modify norm no format float %.15g\nrun 1500\n"
    )
    first, last = rows(printed, 6)
    assert last[3] == last[5] == 0.0
    assert last[4] > 0.02 * first[1]
    assert last[1:].sum() == pytest.approx(first[1:].sum(), rel=2e-4)


@pytest.mark.parametrize(("theory", "factor"), [("jkr", 3.0), ("dmt", 4.0)])
def test_friction_of_coherent_spheres_is_mu_times_normal_force_and_two_pulloff_forces(
    lammps, theory, factor
):
    """One slides past the other, first pressed, then drawn off: F_n as granular has it."""
    gamma = 2.0
    granular = f"{theory} {YOUNG} 0.0 {POISSON} {gamma} {NONE} damping velocity"
    lammps(
        f"{HEAD}{TWO.format(0.06 + 1e-6)}{pair(granular, f'{theory} {gamma}')}"
        "fix 1 one move linear 0 0 0\n"
        "fix 3 other move linear -0.03 0.1 0\ntimestep 1e-6\nrun 1000\nunfix 3\n"
        "fix 3 other move linear 0.03 0.1 0\n"
        "dump d other custom 25 out.txt x y z fx fy fz\ndump_modify d format float %.17g\nrun 2000\n"
    )
    blocks = (lammps.folder / "out.txt").read_text().split("ITEM: ATOMS")[1:]
    seen = np.array([block.splitlines()[1].split() for block in blocks], dtype=float)
    apart, force = seen[:, :3] - 0.05, seen[:, 3:]
    distance = np.linalg.norm(apart, axis=1)
    normal = np.sum(force * apart, axis=1) / distance
    aside = np.linalg.norm(force - (normal / distance)[:, None] * apart, axis=1)
    pulloff = factor * np.pi * gamma * REDUCED
    touch = aside > 0.0
    np.testing.assert_allclose(
        aside[touch], FRICTION * (normal + 2.0 * pulloff)[touch], rtol=2e-4
    )
    assert normal.max() > 0.3 * pulloff
    assert normal[touch].min() < -0.9 * pulloff
    np.testing.assert_array_equal(touch, normal != 0.0)
    assert not touch[-1]
    assert (distance[touch].max() > 0.01) == (theory == "jkr")
