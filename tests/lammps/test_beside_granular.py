"""pair_style carom part tangential: friction by springs, beside the normal force of granular."""

import re
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.engine
YOUNG, POISSON, FRICTION, RADIUS = 5e7, 0.3, 0.3, 5e-3
MODULUS, REDUCED = YOUNG / (2.0 * (1.0 - POISSON**2)), 0.5 * RADIUS
SOLID = f"young {YOUNG} poisson {POISSON} friction {FRICTION}"
NONE = f"tangential linear_nohistory 0.0 {FRICTION}"
HEAD = (
    "units si\natom_style sphere\ncomm_modify vel yes\nboundary f f f\nneighbor 0.001 bin\n"
    "newton off\natom_modify map array\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 2 b\n"
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


def check_account(printed, losses):
    """Nothing stays stored, friction and viscosity take their parts, and the sum stays the same."""
    first, last = rows(printed, 6)
    assert last[3] == 0.0
    assert last[4] > 0.01 * first[1]
    assert (last[5] > 0.003 * first[1]) == (losses != "")
    assert last[1:].sum() == pytest.approx(first[1:].sum(), rel=2e-4)


@pytest.mark.parametrize(("losses", "precision"), [("", "double"), ("retardation 2e-5", "single")])
def test_energy_that_leaves_the_motion_is_what_shear_took(lammps, losses, precision):
    """Along the normal granular is elastic; friction and, with losses, viscosity act in shear."""
    start = TWO.format(0.060001) + "velocity one set 0.1 0.05 0.02\n"
    style = f"springs 64 ledger yes precision {precision}"
    printed = lammps(
        f"{HEAD}{start}{pair(hertz(), losses, style)}"
        "fix 1 all nve/sphere\ntimestep 1e-6\ncompute k all ke\ncompute r all erotate/sphere\n"
        "compute p all pair carom\nthermo_style custom step c_k c_r c_p[1] c_p[2] c_p[3]\n"
        "thermo_modify norm no format float %.15g\nrun 1500\n"
    )
    check_account(printed, losses)


@pytest.mark.parametrize("losses", ["", "retardation 2e-5"])
def test_energy_that_a_wall_takes_is_what_shear_took(lammps, losses):
    start = f"create_atoms 1 single 0.05 0.05 0.005001\n{BALLS}velocity all set 0.05 0.02 -0.1\n"
    printed = lammps(
        f"{HEAD}{start}{pair(hertz(), losses, 'springs 64 ledger yes')}"
        f"region w plane 0 0 0 0 0 1\nfix n all wall/gran/region granular {hertz()} region w\n"
        f"fix t all wall/carom {SOLID} {losses} region w\nfix 1 all nve/sphere\ntimestep 1e-6\n"
        "compute k all ke\ncompute r all erotate/sphere\n"
        "thermo_style custom step c_k c_r f_t[4] f_t[5] f_t[6]\n"
        "thermo_modify norm no format float %.15g\nrun 2000\n"
    )
    check_account(printed, losses)


@pytest.mark.parametrize("rebuilds", ["check yes", "check no"])
@pytest.mark.parametrize(("theory", "factor"), [("jkr", 3.0), ("dmt", 4.0)])
def test_friction_of_coherent_spheres_is_mu_times_normal_force_and_two_pulloff_forces(
    lammps, theory, factor, rebuilds
):
    """One slides past the other, first pressed, then drawn off: F_n as granular has it."""
    gamma = 2.0
    granular = f"{theory} {YOUNG} 0.0 {POISSON} {gamma} {NONE} damping velocity"
    lammps(
        f"{HEAD}{TWO.format(0.06 + 1e-6)}{pair(granular, f'{theory} {gamma}')}"
        f"neigh_modify every 1 delay 0 {rebuilds}\n"
        "fix 1 one move linear 0 0 0\n"
        "fix 3 other move linear -0.03 0.1 0\ntimestep 1e-6\nrun 1000\nunfix 3\n"
        "fix 3 other move linear 0.03 0.1 0\n"
        "dump d other custom 25 out.txt x y z fx fy fz\ndump_modify d format float %.17g\n"
        "run 2000\n"
    )
    blocks = (lammps.folder / "out.txt").read_text().split("ITEM: ATOMS")[1:]
    seen = np.array([block.splitlines()[1].split() for block in blocks], dtype=float)
    apart, force = seen[:, :3] - 0.05, seen[:, 3:]
    distance = np.linalg.norm(apart, axis=1)
    normal = np.sum(force * apart, axis=1) / distance
    aside = np.linalg.norm(force - (normal / distance)[:, None] * apart, axis=1)
    pulloff = factor * np.pi * gamma * REDUCED
    touch = aside > 0.0
    np.testing.assert_allclose(aside[touch], FRICTION * (normal + 2.0 * pulloff)[touch], rtol=2e-4)
    assert normal.max() > 0.3 * pulloff
    assert normal[touch].min() < -0.9 * pulloff
    np.testing.assert_array_equal(touch, normal != 0.0)
    assert not touch[-1]
    assert (distance[touch].max() > 0.01) == (theory == "jkr")


def test_coherent_spheres_stay_together(lammps):
    """By JKR: they strike with less energy than it takes to pull them off."""
    granular = f"jkr {YOUNG} 2e5 {POISSON} 0.2 {NONE} damping viscoelastic"
    printed = lammps(
        f"{HEAD}{TWO.format(0.060001)}{pair(granular, 'jkr 0.2')}velocity one set 0.0025 0.002 0\n"
        "fix 1 all nve/sphere\ntimestep 1e-6\nvariable gap equal "
        "sqrt((x[1]-x[2])^2+(y[1]-y[2])^2+(z[1]-z[2])^2)-0.01\nvariable v equal vx[1]-vx[2]\n"
        "thermo_style custom step v_gap v_v\nthermo 100\nthermo_modify format float %.15g\n"
        "run 20000\n"
    )
    gap = rows(printed, 3)[:, 1]
    neck = (0.75 * 3.0 * np.pi * 0.2 * np.sqrt(REDUCED) / MODULUS) ** (2.0 / 3.0) / 3.0
    assert gap[5:].max() < neck
    assert gap.min() < -2.0 * neck


def on_a_floor(lammps, pair_lines, wall_lines, steps=30000):
    """A ball that rolls on a floor; returns rows of step, speed and spin."""
    printed = lammps(
        f"{HEAD}create_atoms 1 single 0.01 0.05 0.0049975\n{BALLS}{pair_lines}"
        "velocity all set 0.03 0 0\nset atom 1 omega 0 6 0\nregion w plane 0 0 0 0 0 1\n"
        f"{wall_lines}fix 1 all nve/sphere\nfix g all gravity 9.81 vector 0 0 -1\n"
        "timestep 2e-6\ncompute s all property/atom vx omegay\n"
        "compute o all reduce sum c_s[1] c_s[2]\nthermo_style custom step c_o[*]\n"
        f"thermo_modify format float %.15g\nthermo 200\nrun {steps}\n"
    )
    return rows(printed, 3)


ROLLING = "rolling sds 1e3 0.01 0.1"


def test_rolling_stops_a_ball_as_granular_alone_does(lammps):
    """The pair's rolling resistance is not for walls; that of the wall is, and friction ours."""
    mindlin = f"tangential mindlin_rescale/force NULL 0.0 {FRICTION}"
    wall = "fix n all wall/gran/region granular {} region w\n"
    alone = f"pair_style granular\npair_coeff * * {hertz(0.2, 'damping tsuji', mindlin)}\n"
    more = f"damping tsuji {ROLLING}"
    granular = on_a_floor(lammps, alone, wall.format(hertz(0.2, more, mindlin)))
    ours = wall.format(hertz(0.2, more))
    ours += f"fix t all wall/carom part tangential {SOLID} region w\n"
    carom = on_a_floor(lammps, pair(hertz(0.2, "damping tsuji")), ours)
    np.testing.assert_allclose(carom[:, 1], granular[:, 1], atol=1e-3)
    np.testing.assert_allclose(RADIUS * carom[:, 2], RADIUS * granular[:, 2], atol=1e-3)
    time = 2e-6 * carom[:, 0]
    rolls = time < 0.035
    np.testing.assert_allclose(
        carom[rolls, 1], 0.03 - 5.0 / 7.0 * 0.1 * 9.81 * time[rolls], atol=1e-3
    )
    assert np.abs(carom[-1, 1]) < 5e-4


@pytest.mark.parametrize(("part", "stays"), [(1.8, True), (2.2, False)])
def test_a_ball_sticks_to_an_upright_wall_up_to_mu_times_two_pulloff_forces(lammps, part, stays):
    """F_n is zero there; its weight is this part of mu F_c. It does not turn, or it would roll."""
    gamma = 0.5
    mass, pulloff = 2500.0 * 4.0 / 3.0 * np.pi * RADIUS**3, 3.0 * np.pi * gamma * RADIUS
    jkr = f"jkr {YOUNG} 1e6 {POISSON} {gamma} {NONE} damping viscoelastic"
    printed = lammps(
        f"{HEAD}create_atoms 1 single 0.0049963 0.05 0.05\n{BALLS}{pair(jkr, f'jkr {gamma}')}"
        "region w plane 0 0 0 1 0 0\nfix n all wall/gran/region granular "
        f"{jkr} region w\nfix t all wall/carom {SOLID} jkr {gamma} part tangential region w\n"
        f"fix 1 all nve\n"
        f"variable g equal {part * FRICTION * pulloff / mass}*(1-exp(-step/2000.0))\n"
        "fix g all gravity v_g vector 0 0 -1\ntimestep 1e-6\nvariable z equal z[1]-0.05\n"
        "variable x equal x[1]-0.005\nthermo_style custom step v_z v_x f_t[3]\nthermo 100\n"
        "thermo_modify format float %.15g\nrun 20000\n"
    )
    _, down, _, force = rows(printed, 4)[100:].T
    down = down[-1]
    assert (abs(down) < 1e-3 * RADIUS) == stays
    assert (abs(down) > 1e-2 * RADIUS) == (not stays)
    limit = 2.0 * FRICTION * pulloff
    assert -np.mean(force) == pytest.approx(min(0.5 * part * limit, limit), rel=2e-2)


PILE = "".join(
    f"create_atoms 1 single {0.05 + 0.01 * x!r} {0.05 + 0.01 * y!r} {0.00499 + 0.01 * z!r}\n"
    for x, y, z in [
        *((i, j, 0.0) for i in (-1, 0, 1) for j in (-1, 0, 1)),
        *((i, j, 0.5**0.5) for i in (-0.5, 0.5) for j in (-0.5, 0.5)),
        (0.0, 0.0, 2.0 * 0.5**0.5),
    ]
)


@pytest.mark.first_case
@pytest.mark.parametrize("cohesion", [0.0, 0.05])
def test_a_small_heap_keeps_its_shape(lammps, cohesion):
    """Fourteen spheres in a pyramid on a floor, which friction alone keeps from sliding apart."""
    more = f"rolling sds 1e3 0.01 0.2 damping {'viscoelastic' if cohesion else 'tsuji'}"
    damping = 1e6 if cohesion else 0.2
    normal, carom = hertz(damping, more), SOLID
    if cohesion:
        normal = normal.replace("hertz/material", "jkr").replace(NONE, f"{cohesion} {NONE}")
        carom += f" jkr {cohesion}"
    granular = f"fix n all wall/gran/region granular {normal} region w\n"

    def moved(pair_lines, wall):
        lammps(
            f"{HEAD}{PILE}{BALLS}{pair_lines}region w plane 0 0 0 0 0 1\n{granular}{wall}"
            "fix 1 all nve/sphere\nfix g all gravity 9.81 vector 0 0 -1\ntimestep 5e-6\n"
            "write_dump all custom first.txt x y z modify sort id format float %.17g\nrun 40000\n"
            "write_dump all custom out.txt x y z modify sort id format float %.17g\n"
        )
        first = np.loadtxt(lammps.folder / "first.txt", skiprows=9)
        return np.abs(lammps.dumped() - first).max() / RADIUS

    assert (
        moved(pair(normal, style="", solid=carom), f"fix t all wall/carom {carom} region w\n")
        < 0.02
    )
    assert moved(f"pair_style granular\npair_coeff * * {normal}\n", "") > 0.5  # without ours


def cluster(lammps, then, ranks=1, start=""):
    """Coherent spheres that strike each other and stick; returns their last state."""
    made = (
        "lattice sc 0.01005\nregion box block 0 5 0 5 0 5\ncreate_box 1 box\ncreate_atoms 1 box\n"
        f"{BALLS}variable u atom 0.1*sin(12.9*id)\nvariable v atom 0.1*sin(78.2*id)\n"
        "velocity all set v_u v_v v_u\n"
    )
    head = HEAD[: HEAD.index("region")].replace("boundary f f f", "boundary p p p")
    jkr = f"jkr {YOUNG} 1e5 {POISSON} 0.5 {NONE} damping viscoelastic rolling sds 1e3 0.01 0.1"
    lammps(
        f"{head}{start or made}{pair(jkr, 'jkr 0.5 retardation 1e-6')}"
        f"fix 1 all nve/sphere\ntimestep 4e-6\n{then}\n"
        "write_dump all custom out.txt x y z vx vy vz omegax omegay omegaz modify sort id "
        "format float %.17g\n",
        ranks,
    )
    return lammps.dumped()


@pytest.mark.slow
def test_ranks_and_restarts_keep_what_coherent_contacts_remember(lammps):
    one = cluster(lammps, "run 1500\nwrite_restart x.rst noinit\nrun 500")
    again = cluster(lammps, "run 500", start="read_restart x.rst\n")
    np.testing.assert_array_equal(again, one)
    one, two = (cluster(lammps, "run 2000", ranks=ranks) for ranks in (1, 2))
    np.testing.assert_allclose(two[:, 3:6], one[:, 3:6], atol=1e-11)


def test_constants_of_unlike_types_are_compared(lammps):
    """Two materials: granular's line of both has one E* for them, ours may have two moduli."""
    lines = OVERLAY.format("").replace("granular carom", "granular 0.012 carom")
    for kinds, young, poisson, gamma in (("1 1", 5e7, 0.2, 0.1), ("2 2", 9e7, 0.3, 0.05)):
        lines += f"pair_coeff {kinds} granular jkr {young} 0.0 {poisson} {gamma} {NONE} "
        lines += f"damping velocity\npair_coeff {kinds} carom young {young} poisson {poisson} "
        lines += f"jkr {gamma} friction {FRICTION}\n"
    modulus = 1.0 / ((1.0 - 0.2**2) / 5e7 + (1.0 - 0.3**2) / 9e7)
    gamma = float(np.sqrt(0.1 * 0.05))
    both = f"pair_coeff 1 2 granular jkr {{:.5g}} 0.0 0.0 {gamma:.5f} {NONE} damping velocity\n"
    rest = "fix 1 all nve/sphere\ntimestep 1e-6\nrun 1\nrun 1\n"
    start = f"{HEAD}{TWO.format(0.0599)}set atom 2 type 2\n"
    ours = f"pair_coeff 1 2 carom friction {FRICTION}\n"
    lammps(f"{start}{lines}{both.format(2.0 * modulus)}{ours}{rest}")
    printed = lammps.fails(f"{start}{lines}{both.format(6e7)}{ours}{rest}")
    assert "types 1 and 2: E*, of young and poisson, is 34" in printed


def test_a_restart_file_of_another_version_is_refused(lammps):
    start = f"{HEAD}{TWO.format(0.0599)}"
    rest = f"pair_style carom\npair_coeff * * {SOLID}\nfix 1 all nve/sphere\ntimestep 1e-6\nrun 1\n"
    lammps(f"{start}{rest}write_restart x.rst\n")
    file = lammps.folder / "x.rst"
    now = (1000004).to_bytes(4, "little")
    assert file.read_bytes().count(now) == 1
    file.write_bytes(file.read_bytes().replace(now, (32).to_bytes(4, "little")))
    printed = lammps.fails(HEAD[: HEAD.index("region")] + "read_restart x.rst\n")
    assert "the restart file is of another version of Carom" in printed


def test_what_the_tangential_part_remembers_is_not_taken_for_the_whole(lammps):
    """Its last force has no normal part, and would be that of the first step."""
    rest = "fix 1 all nve/sphere\ntimestep 1e-6\nrun 5\n"
    start = f"{HEAD}{TWO.format(0.0599)}"
    lammps(f"{start}{pair(hertz())}{rest}write_restart x.rst noinit\n")
    whole = "pair_style hybrid/overlay zero 0.012 nocoeff carom precision double\n"
    whole += f"pair_coeff * * zero\npair_coeff * * carom {SOLID}\n"
    printed = lammps.fails(f"{HEAD[: HEAD.index('region')]}read_restart x.rst\n{whole}{rest}")
    assert "other springs, another precision, part, ledger or losses" in printed, printed[-900:]


HEAP = """
units si
atom_style sphere
comm_modify vel yes
boundary f f f
newton off
lattice sc 0.0102
region box block 0 0.1 0 0.1 0 0.1 units box
create_box 1 box
region pile block 0.03 0.07 0.03 0.07 0.005 0.05 units box
create_atoms 1 region pile
set group all diameter 0.01 density 2500
{lines}
fix 3 all nve/sphere
fix 4 all gravity 9.81 vector 0 0 -1
timestep 5e-6
run 2000
write_dump all custom out.txt x y z modify format float %.17g
"""


def test_the_input_of_the_manual_runs(lammps):
    page = Path(__file__).parents[2] / "docs" / "how-to" / "lammps.md"
    section = page.read_text(encoding="utf-8").split("## Beside granular")[1]
    lammps(HEAP.format(lines=section.split("```none\n")[1].split("```")[0]))
    heap = lammps.dumped()
    assert len(heap) > 30
    assert heap[:, 2].min() > 0.0049
    assert np.ptp(heap[:, 0]) < 0.05


JKR = f"jkr {YOUNG} 0.0 {POISSON} 0.05 {NONE} damping velocity"
OVERLAY = "pair_style hybrid/overlay granular carom {} part tangential\n"
PLAIN = f"{OVERLAY.format('')}pair_coeff * * granular {hertz()}\n"
ON_WALL = "region w plane 0 0 0 0 0 1\nfix w all wall/carom {} region w\n"
STIFF = hertz(friction="tangential mindlin NULL 0.0 0.3")


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("lines", "answer"),
    [
        (f"pair_style carom part half\npair_coeff * * {SOLID}\n", "part all or tangential"),
        (f"pair_style carom part tangential\npair_coeff * * {SOLID}\n", "has no normal force"),
        (
            pair(hertz(), solid=SOLID.replace("5", "6", 1)),
            "young is 60000000 here and 50000000 in pair_coeff of granular",
        ),
        (pair(hertz(), solid=SOLID.replace("poisson 0.3", "poisson 0.2")), "poisson is 0.2 here"),
        (
            pair(hertz(), solid=SOLID.replace("friction 0.3", "friction 0.2")),
            "friction is 0.2 here",
        ),
        (pair(hertz(), "jkr 0.05"), "cohesion is jkr here and none in pair_coeff of granular"),
        (pair(JKR), "cohesion is none here and jkr in pair_coeff of granular"),
        (pair(JKR, "dmt 0.05"), "cohesion is dmt here and jkr in pair_coeff of granular"),
        (pair(JKR, "jkr 0.06"), "jkr is 0.06 here and 0.05 in pair_coeff of granular"),
        (pair(JKR, "jkr 0.05 pulloff 1"), "give one of jkr, dmt and pulloff"),
        (pair(JKR, "jkr -0.05"), "jkr -0.05 must be from 0 to 1e20"),
        (pair(STIFF), "granular has a friction of its own, mindlin"),
        (pair(f"{hertz()} twisting marshall"), "granular's twisting marshall has no stiffness"),
        (
            pair(f"hooke 1e4 0.0 {NONE} damping velocity"),
            "normal force is hooke, which has no depth",
        ),
        (
            pair(f"hertz 1e7 0.0 {NONE} damping velocity"),
            "E*, of young and poisson, is 27472527.47",
        ),
        (
            f"{PLAIN}pair_coeff * * carom {SOLID}\npair_coeff 1 2 carom young 6e7\n",
            "types 1 and 2: E*, of young and poisson, is 32967032.97 here and 27472527.47",
        ),
        (
            f"{OVERLAY.format('')}pair_coeff 1 1 granular {hertz()}\npair_coeff 1 1 carom {SOLID}\n"
            f"pair_coeff 2 2 carom {SOLID}\npair_coeff 1 2 carom {SOLID}\n",
            "types 1 and 2: granular has no pair_coeff for them",
        ),
        (
            f"pair_style hybrid/overlay zero 0.01 carom part tangential\npair_coeff * * zero\n"
            f"pair_coeff * * carom {SOLID}\n",
            "no other style gives a normal force",
        ),
        (
            f"pair_style carom\npair_coeff * * {SOLID} jkr 0.05\n",
            "jkr, dmt and pulloff go with part tangential",
        ),
        (pair(hertz()) + ON_WALL.format(SOLID), "fix wall/carom part tangential has no normal"),
        (pair(hertz()) + ON_WALL.format(f"{SOLID} part half"), "part half must be all or tang"),
        (
            "pair_style hybrid carom zero 0.01\npair_coeff * * zero\n"
            f"pair_coeff 1 2 carom {SOLID}\n"
            + ON_WALL.format(SOLID).replace("0 0 0 0", "0 0 .0451 0"),
            "spheres of type 1 have no young, poisson or friction",
        ),
        (
            f"{PLAIN}pair_coeff * * carom {SOLID}\npair_coeff 2 2 carom jkr 0.1\n",
            "of types 1 and 2 the cohesion is not of one kind; say by pair_coeff 1 2",
        ),
        (
            "pair_style hybrid/overlay zero 0.01 carom\npair_coeff * * zero\n"
            "pair_coeff 1 2 carom young 5e7 poisson 0.3\n",
            "type 1 has no young, poisson or friction",
        ),
        (pair(hertz()) + ON_WALL.format(f"part all {SOLID} part all"), "part all is given twice"),
    ],
)
def test_bad_input_stops_lammps_with_one_line(lammps, lines, answer):
    start = TWO.format(0.07)
    printed = lammps.fails(f"{HEAD}{start}{lines}fix 1 all nve/sphere\ntimestep 1e-6\nrun 1\n")
    errors = [line for line in printed.splitlines() if line.startswith("ERROR")]
    assert len(errors) == 1, printed[-600:]
    assert answer in errors[0]
