"""Beds of some hundreds of spheres: their account of energies, whether they stay, heat in them."""

import numpy as np
import pytest

pytestmark = pytest.mark.engine
YOUNG, POISSON, FRICTION, GAMMA = 1e6, 0.25, 0.5, 0.05
RADIUS, DENSITY, GRAVITY, COUNT = 2.5e-3, 2500.0, 9.81, 150
MASS = DENSITY * 4.0 / 3.0 * np.pi * RADIUS**3
MODULUS = YOUNG / (2.0 * (1.0 - POISSON**2))
SOLID = f"young {YOUNG} poisson {POISSON} friction {FRICTION}"
HEAD = f"""units si
atom_style sphere
comm_modify vel yes
boundary p p f
newton off
neighbor 0.0005 bin
region b block 0 0.025 0 0.025 -0.001 0.1
create_box 1 b
region loose block 0 0.025 0 0.025 0.003 0.08
create_atoms 1 random {COUNT} 1234 loose overlap 0.005 maxtry 10000
set group all diameter {2 * RADIUS} density {DENSITY}
region floor plane 0 0 0 0 0 1
"""
MOTION = f"""fix 1 all nve/sphere
fix g all gravity {GRAVITY} vector 0 0 -1
timestep 1e-5
compute k all ke
compute r all erotate/sphere
compute p all pair carom
compute met all pair/local p5 cutoff radius
variable h equal {COUNT * MASS * GRAVITY}*xcm(all,z)
thermo_style custom step c_k c_r v_h c_p[*] f_w[4] f_w[5] f_w[6]
thermo_modify norm no format float %.15g
thermo 1000
"""
DUMPS = """write_dump all local met.txt c_met modify format float %.17g
write_dump all custom out.txt x y z modify sort id format float %.17g
"""


def beside(theory, damping, more=""):
    """Lines of granular and carom, for pairs and for the floor."""
    normal = f"{theory} {YOUNG} {damping} {POISSON} {GAMMA} tangential linear_nohistory 0.0 "
    normal += f"{FRICTION} damping viscoelastic {more}"
    ours = f"{SOLID} {theory} {GAMMA} retardation 1e-5"
    return (
        "pair_style hybrid/overlay carom part tangential precision double ledger yes granular\n"
        f"pair_coeff * * granular {normal}\npair_coeff * * carom {ours}\n"
        f"fix n all wall/gran/region granular {normal} region floor\n"
        f"fix w all wall/carom {ours} region floor\n"
    )


def rows(printed):
    """The numbers that LAMMPS prints: step, energies of motion and height, ours, the floor's."""
    lines = [line.split() for line in printed.splitlines()]
    return np.array([line for line in lines if len(line) == 10 and line[0].isdigit()], dtype=float)


@pytest.mark.slow
def test_a_bed_loses_what_the_ledgers_of_contacts_and_walls_say(lammps):
    """It falls on the floor and comes nearly to rest; two thirds of its energy go."""
    lossy = f"{SOLID} restitution 0.6 speed 0.5"
    style = f"pair_style carom precision double ledger yes\npair_coeff * * {lossy}\n"
    wall = f"fix w all wall/carom {lossy} region floor\n"
    energies = rows(lammps(f"{HEAD}{style}{wall}{MOTION}run 16000\n"))[:, 1:]
    fallen = energies[0, 2] - energies[-1, 2]
    lost = energies[-1, [4, 5, 7, 8]]
    np.testing.assert_allclose(energies.sum(axis=1), energies[0].sum(), atol=1e-3 * fallen)
    assert lost.sum() > 0.9 * fallen
    assert lost[:2].min() > 0.1 * fallen


def test_a_cohesive_bed_loses_what_the_ledgers_say(lammps):
    """Granular's DMT without damping keeps energy, 8/15 E* R*^1/2 d^5/2 - F_c d a contact, which
    is added here; the rest is in motion, in height, in shear, or lost there."""
    printed = lammps(f"{HEAD}{beside('dmt', 0.0)}{MOTION}run 10000\n{DUMPS}")
    energies = rows(printed)[:, 1:]
    depths = np.loadtxt(lammps.folder / "met.txt", skiprows=9)
    floor = RADIUS - lammps.dumped()[:, 2]
    pressed = 0.0
    for depth, radius in ((depths, RADIUS / 2.0), (floor[floor > 0.0], RADIUS)):
        hertz = 8.0 / 15.0 * MODULUS * np.sqrt(radius) * depth**2.5
        pressed += np.sum(hertz - 4.0 * np.pi * GAMMA * radius * depth)
    lost = energies[-1, [4, 5, 7, 8]].sum()
    assert energies[-1].sum() + pressed == pytest.approx(energies[0].sum(), abs=1e-4 * lost)
    assert lost > 0.3 * energies[0, 2]


@pytest.mark.slow
def test_a_cohesive_bed_keeps_its_shape(lammps):
    """By JKR: it comes to rest, and nothing creeps."""
    first = DUMPS.replace("out.txt", "first.txt")
    printed = lammps(
        f"{HEAD}{beside('jkr', 5e6, 'rolling sds 200 0.1 0.3')}{MOTION}timestep 2e-5\n"
        f"run 9000\nfix d all viscous 0.02\nrun 4000\nunfix d\n{first}run 3000\n{DUMPS}"
    )
    moving = rows(printed)[:, 1:3].sum(axis=1)
    assert moving[-3:].max() < 1e-6 * moving.max()
    moved = lammps.dumped() - np.loadtxt(lammps.folder / "first.txt", skiprows=9)
    moved -= np.array([0.025, 0.025, 0.0]) * np.round(moved / 0.025)
    assert np.abs(moved).max() < 1e-3 * RADIUS


CONDUCTIVITY, CAPACITY = 3e4, 1e3
HOT = "fix t all property/atom temperature heatflow\n"
PRESSED = f"""units si
atom_style sphere
comm_modify vel yes
boundary p p p
newton off
neighbor 0.0005 bin
lattice sc 0.0049
region b block 0 4 0 4 0 4
create_box 1 b
{HOT}create_atoms 1 box
set group all diameter {2 * RADIUS} density {DENSITY} temperature 300
region half block 0 2 INF INF INF INF
set region half temperature 400
variable u atom 0.3*sin(78.2*id)
variable w atom 0.3*sin(12.9*id)
velocity all set v_u v_w v_u
"""


def heated(lammps, then, start=PRESSED):
    """Temperatures at the end, beside places and velocities."""
    granular = f"hertz/material {YOUNG} 1e6 {POISSON} tangential linear_nohistory 0.0 {FRICTION} "
    lammps(
        f"{start}pair_style hybrid/overlay carom part tangential granular\n"
        f"pair_coeff * * granular {granular} damping viscoelastic heat radius {CONDUCTIVITY}\n"
        f"pair_coeff * * carom {SOLID}\nfix f all heat/flow constant {CAPACITY}\n"
        "fix 1 all nve/sphere\ntimestep 1e-5\ncompute t all property/atom temperature\n"
        f"{then}\nwrite_dump all custom out.txt x y z vx vy vz c_t modify sort id "
        "format float %.17g\n"
    )
    return lammps.dumped()


def test_heat_flows_beside_friction_in_all_runs_and_after_a_restart(lammps):
    """As much as in one run; none is lost."""
    first, one = (heated(lammps, f"run {steps}") for steps in (0, 400))
    two = heated(lammps, "run 200\nrun 200")
    heated(lammps, "run 200\nwrite_restart x.rst noinit")
    head = PRESSED[: PRESSED.index("lattice")]
    again = heated(lammps, "run 200", f"{head}read_restart x.rst\n{HOT}")
    np.testing.assert_allclose(two[:, 6], one[:, 6], rtol=1e-6)
    np.testing.assert_array_equal(again, two)
    assert one[:, 6].sum() == pytest.approx(first[:, 6].sum(), rel=1e-12)
    assert np.ptp(one[:, 6]) < 0.8 * np.ptp(first[:, 6])
    assert np.abs(one[:, :3] - first[:, :3]).max() > 1e-5


def test_heat_between_two_spheres_that_slide(lammps):
    """The difference falls at the rate 4 k a/(m c), a^2 = R* d, in Euler's steps, over two runs."""
    depth, steps, step = 1e-4, 500, 1e-5
    start = PRESSED[: PRESSED.index("lattice")] + (
        f"region b block 0 0.02 0 0.02 0 0.02\ncreate_box 1 b\n{HOT}"
        f"create_atoms 1 single 0.005 0.01 0.01\n"
        f"create_atoms 1 single {0.005 + 2 * RADIUS - depth!r} 0.01 0.01\n"
        f"set group all diameter {2 * RADIUS} density {DENSITY} temperature 300\n"
        "set atom 1 temperature 400\nset group all omega 0 5 0\n"
    )
    last = heated(lammps, f"unfix 1\nrun {steps}\nrun {steps}", start)[:, 6]
    rate = 4.0 * CONDUCTIVITY * np.sqrt(RADIUS / 2.0 * depth) / (MASS * CAPACITY)
    left = 100.0 * (1.0 - rate * step) ** (2 * steps)
    assert last[0] - last[1] == pytest.approx(left, rel=1e-9)
    assert left < 50.0
