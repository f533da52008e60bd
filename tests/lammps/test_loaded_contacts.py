"""Contacts with losses under load: packings keep still wherever LAMMPS does not warn.

Pressures are those of Hertz's force on every sphere, energies those of the ledger.
"""

import importlib
import math
import re

import numpy as np
import pytest
from tests.lammps.test_walls import HEAD

from carom.dimensionless.numerics.hertz import DURATION

pytestmark = pytest.mark.engine
study = importlib.import_module("studies.losses_under_load")
GLASS = study.Solid(0.25, 0.3, 0.5)
STIFF = "too stiff for the timestep"


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("restitution", "load", "steps"),
    [(0.5, 6.0, 25), (0.01, 6.0, 20), (0.3, 4.0, 20), (0.05, 14.0, 25), (0.9, 6.0, 20)],
)
def test_packings_are_pressed_as_by_hertz_and_do_not_turn(plugin, restitution, load, steps):
    """Explicit dashpots end at 1.44 times the pressure, with 1e-2 J of rotation (the first one)."""
    row = study.measure_pressure(restitution, load, steps, plugin)
    assert float(row["pressure"]) == pytest.approx(1.0, abs=1e-3)
    assert float(row["rotation"]) < 1e-14
    assert not row["told"]


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, 24, 6))
def test_no_packing_gains_energy(plugin, first):
    """Of sizes 1 to 3, in single and double precision, by the longest steps that are allowed."""
    rows = [study.measure_packing(seed, plugin) for seed in range(first, first + 6)]
    pressed = [row for row in rows if "loose" not in row["what"]]
    assert len(pressed) >= 4
    for row in pressed:
        assert float(row["gained"]) < 0.02, row
        # a sphere that rolls off strikes deeper than any that rests
        assert not row["told"] or row["what"] != "fcc", row


def in_a_press(restitution):
    """Return an input with a sphere between two plates, the upper one at rest in the end."""
    solid = f"young 5e6 poisson 0.25 friction 0.5 restitution {restitution} speed 0.01"
    moves = "-5.6631555e-05*(step-2000)*dt*(step>2000)*(step<62000)-5.3379e-4*(step>=62000)"
    return f"""{HEAD}newton off
region box block -0.05 0.05 -0.05 0.05 -0.01 0.02 units box
create_box 1 box
create_atoms 1 single 0 0 0.005000001
set group all diameter 0.01 density 2500
pair_style carom ledger yes
pair_coeff * * {solid}
variable z equal {moves}
region low plane 0 0 0 0 0 1
region top plane 0 0 0.010000002 0 0 -1 move NULL NULL v_z
fix w1 all wall/carom {solid} region low
fix w2 all wall/carom {solid} region top
fix 1 all nve/sphere
timestep 1.571e-4
compute k all ke
compute r all erotate/sphere
variable e equal c_k+c_r
compute z all reduce sum z
thermo_style custom step v_e c_z
thermo_modify norm no
thermo 1000
run 70000
"""


@pytest.mark.parametrize("restitution", [0.3, 0.01])
def test_a_sphere_in_a_press_stays_in_its_middle(lammps, restitution):
    """Explicit dashpots throw it out."""
    rows = study.last_rows(lammps(in_a_press(restitution)))
    assert rows[-1][1] < 1e-25
    assert rows[-1][2] == pytest.approx(0.5 * (0.010000002 - 5.3379e-4), abs=1e-9)


def resting(step, depth, between):
    """Return an input with two spheres, or a sphere on a wall, pressed so far for three steps."""
    other = "create_atoms 1 single 0 0 -0.005" if between else ""
    return f"""{HEAD}newton off
region box block -0.05 0.05 -0.05 0.05 -0.05 0.05 units box
create_box 1 box
create_atoms 1 single 0 0 {0.005 - depth!r}
{other}
set group all diameter 0.01 density 2500
pair_style carom
pair_coeff * * {GLASS.words}
region low plane 0 0 0 0 0 1
fix w all {"viscous 0" if between else f"wall/carom {GLASS.words} region low"}
fix 1 all nve/sphere
timestep {step!r}
run 3
"""


@pytest.mark.parametrize("between", [True, False], ids=["spheres", "wall"])
@pytest.mark.parametrize("depth", [1e-6, 1e-4])
def test_it_warns_where_steps_are_too_long_for_the_load_and_nowhere_else(lammps, between, depth):
    """k dt^2/m* = 0.1, k = 2 E* a, of the pair and of the sphere; said once a run."""
    radius, mass = (0.0025, study.MASS) if between else (0.005, 2.0 * study.MASS)
    longest = math.sqrt(0.1 * mass / (2.0 * GLASS.modulus * math.sqrt(radius * depth)))
    assert STIFF not in lammps(resting(0.99 * longest, depth, between))
    printed = lammps(resting(1.01 * longest, depth, between))
    assert printed.count(STIFF) == 1
    said = re.search(r"give timestep (\S+) or", printed)[1]
    assert 0.98 * longest < float(said) < longest
    assert re.search("atoms (1 and 2|2 and 1):" if between else "atom 1 and the wall:", printed)


@pytest.mark.slow
def test_ranks_and_restarts_go_on_with_what_dashpots_took(lammps):
    """Pressed, then held: two ranks to rounding, and a run from a restart to the bit."""
    pressed = study.pressed(GLASS, 4.0, 25).replace("carom ledger", "carom precision double ledger")
    pressed = re.sub("displace_atoms.*\n", "", pressed)  # it is another on two ranks
    dump = "dump 1 all custom 1 out.txt x y z vx vy vz omegax omegay omegaz\n"
    dump += "dump_modify 1 sort id format float %.17g\nrun 0\n"
    kick = "variable u atom 3e-3*sin(2*PI*(2*x/lx+y/ly+3*z/lz))\nvelocity all set v_u v_u v_u\n"
    hold = f"{pressed}unfix 2\n{kick}run 20\nwrite_restart half noinit\nrun 20\n{dump}"
    lammps(hold)
    whole = lammps.dumped()
    assert np.abs(whole[:, 3:6]).max() > 1e-6
    rest = pressed[pressed.index("pair_style") :].splitlines()
    rest = "\n".join(line for line in rest if not line.startswith(("fix 2", "run")))
    lammps(f"comm_modify vel yes\nnewton off\nread_restart half\n{rest}\nrun 20\n{dump}")
    np.testing.assert_array_equal(lammps.dumped(), whole)

    lammps(hold, 2)
    both = (np.sort(state[:, 3:6], axis=0) for state in (lammps.dumped(), whole))  # other IDs
    np.testing.assert_allclose(*both, atol=1e-8)  # of a kick of 3e-3


def test_a_duration_of_steps_is_what_the_page_says():
    """docs/how-to/lammps.md: 20 steps to 6 d_max, 25 to 15, 50 to 237."""
    for steps, load in ((20, 6.0), (25, 15.0), (50, 237.0)):
        depth = GLASS.depth(study.SPEED)
        step = DURATION * depth / study.SPEED / steps
        stiffness = 2.0 * GLASS.modulus * np.sqrt(study.RADIUS * load * depth)
        assert stiffness * step**2 / study.MASS == pytest.approx(0.1, rel=0.01)
