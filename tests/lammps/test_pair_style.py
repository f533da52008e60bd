"""pair_style carom in LAMMPS itself."""

import numpy as np
import pytest

import carom
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics.hertz import DURATION

RADIUS, FRICTION, SHALLOW = 5e-3, 0.2, 1e-6  # d_max/R: the normal of a pair hardly turns
SOLID = {"young": 210e9, "poisson": 0.3, "friction": FRICTION}
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
BALL = carom.Sphere(radius=RADIUS, material=STEEL)
PAIR = carom.Pair(BALL, BALL, friction=FRICTION)
SPEED = 0.5 * (SHALLOW * RADIUS / PAIR.scales(0.5).length) ** 1.25
PSI = np.linspace(0.0, 6.0, 64)
HEAD = """units si
atom_style sphere
comm_modify vel yes
"""


def words(**keywords):
    return " ".join(f"{name} {value}" for name, value in keywords.items())


def impacts(steps, rng):
    """A data file of pairs that meet in random directions, and those directions."""
    normal = rng.normal(size=(PSI.size, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    aside = np.cross(normal, rng.normal(size=normal.shape))
    aside /= np.linalg.norm(aside, axis=1)[:, None]
    step = DURATION * PAIR.scales(SPEED).time / steps
    atoms, moves = [], []
    for k, psi in enumerate(PSI):
        gap = SPEED * step * (2.0 + (k % 4) / 4.0)
        velocity = -SPEED * normal[k] + psi * FRICTION * SPEED / PAIR.kappa * aside[k]
        for side in (1, -1):
            place = [0.1 * k, 0.0, 0.0] + side * (RADIUS + 0.5 * gap) * normal[k]
            atoms.append([1, 2.0 * RADIUS, 7850.0, *place])
            moves.append([*(0.5 * side * velocity), 0.0, 0.0, 0.0])
    text = f"pairs\n\n{2 * PSI.size} atoms\n1 atom types\n-0.1 {0.1 * PSI.size} xlo xhi\n"
    text += "-0.1 0.1 ylo yhi\n-0.1 0.1 zlo zhi\n"
    for title, rows in (("Atoms # sphere", atoms), ("Velocities", moves)):
        numbered = [[i + 1, *map(float, row)] for i, row in enumerate(rows)]
        text += f"\n{title}\n\n" + "\n".join(" ".join(map(repr, row)) for row in numbered) + "\n"
    return text.replace(" 1.0 0.01 ", " 1 0.01 "), normal, aside, step


def rebounds(lammps, steps=100, style="springs 16", newton="off", normal_force="", **losses):
    """Return psi_2 and the normal restitution of impacts from psi_1 = 0 to 6.

    With a `normal_force`, words of pair_style granular, carom gives the tangential part alone.
    """
    pair = f"pair_style carom {style}\npair_coeff * * "
    if normal_force:
        pair = (
            f"pair_style hybrid/overlay granular carom {style} part tangential\n"
            f"pair_coeff * * granular {normal_force}\npair_coeff * * carom "
        )
    data, normal, aside, step = impacts(steps, np.random.default_rng(3))
    (lammps.folder / "pairs.data").write_text(data)
    lammps(
        f"{HEAD}boundary s s s\nnewton {newton}\nneighbor 0.001 bin\nread_data pairs.data\n"
        f"{pair}{words(**SOLID, **losses)}\n"
        f"fix 1 all nve/sphere\ntimestep {step!r}\nrun {int(1.5 * steps) + 10}\n"
        "write_dump all custom out.txt id vx vy vz omegax omegay omegaz "
        "modify sort id format float %.17g\n"
    )
    out = lammps.dumped()
    velocity, spin = out[:, 1:4], out[:, 4:7]
    moved = velocity[::2] - velocity[1::2] - RADIUS * np.cross(spin[::2] + spin[1::2], normal)
    psi = np.sum(moved * aside, axis=1) * PAIR.kappa / (FRICTION * SPEED)
    return psi, np.sum(moved * normal, axis=1) / SPEED


@pytest.mark.parametrize(
    ("style", "steps", "bound"),
    [
        *(("precision single", 100, 2e-3), ("springs 16", 200, 1.2e-3)),
        *(("springs 32", 50, 2.5e-3), ("springs 32", 100, 1e-3), ("springs 64", 100, 6.5e-4)),
    ],
)
def test_spheres_leave_as_exactly_as_the_law_promises(lammps, style, steps, bound):
    psi, e = rebounds(lammps, steps, style)
    assert np.abs(psi - carom.rebound(PSI, PAIR.chi)).max() < bound
    np.testing.assert_allclose(e, 1.0, atol=1e-4)


def test_losses_by_restitution_at_a_speed_and_by_time(lammps):
    """Both ways to say it are one; psi_2 is that of the viscoelastic impact."""
    by_e, e = rebounds(lammps, restitution=0.8, speed=SPEED)
    np.testing.assert_allclose(e, 0.8, atol=1e-3)
    exact = carom.rebound(PSI, PAIR.chi, losses=carom.KelvinVoigt(0.8))
    assert np.abs(by_e - exact).max() < 1.5e-3
    loss = viscous_loss(0.8)
    by_time, _ = rebounds(lammps, retardation=loss * PAIR.scales(SPEED).time)
    np.testing.assert_allclose(by_time, by_e, atol=1e-6)


@pytest.mark.first_case
@pytest.mark.parametrize("asked", [False, True])
def test_energies_that_losses_leave_untold_are_warned_of_where_they_are_asked_for(lammps, asked):
    compute = "compute energies all pair carom\n" * asked
    printed = lammps(
        f"{HEAD}region box block -1 1 -1 1 -1 1\ncreate_box 1 box\ncreate_atoms 1 single 0 0 0\n"
        f"set group all diameter 0.01 density 1000\npair_style carom\npair_coeff * * "
        f"{words(**SOLID, restitution=0.8, speed=SPEED)}\n{compute}run 0\n"
    )
    assert ("told by ledger yes only" in printed) == asked
    assert ("WARNING: pair_style carom" in printed) == asked


GRANULAR = f"hertz/material 210e9 {{}} 0.3 tangential linear_nohistory 0.0 {FRICTION} damping "


@pytest.mark.parametrize(
    ("style", "steps", "bound"),
    [("springs 32", 50, 2.5e-3), ("springs 32", 100, 1.3e-3), ("springs 64", 100, 6.5e-4)],
)
def test_the_tangential_part_is_as_exact_beside_granular(lammps, style, steps, bound):
    psi, e = rebounds(lammps, steps, style, normal_force=f"{GRANULAR.format(0.0)} velocity")
    assert np.abs(psi - carom.rebound(PSI, PAIR.chi)).max() < bound
    np.testing.assert_allclose(e, 1.0, atol=1e-4)


@pytest.mark.parametrize("newton", ["off", "on"])
def test_the_tangential_part_damps_as_granular_does_along_the_normal(lammps, newton):
    """Granular's viscoelastic damping with eta = 2 E* tau/m is a Kelvin-Voigt solid's until the
    contact shrinks, which changes e by 0.006; it is of first order in the step."""
    loss = viscous_loss(0.8) * PAIR.scales(SPEED).time
    modulus, mass = 210e9 / (2.0 * (1.0 - 0.3**2)), 7850.0 * 2.0 / 3.0 * np.pi * RADIUS**3
    normal = f"{GRANULAR.format(2.0 * modulus * loss / mass)} viscoelastic limit_damping"
    psi, e = rebounds(lammps, 400, "springs 32", newton, normal, retardation=loss)
    np.testing.assert_allclose(e, 0.8, atol=7e-3)
    exact = carom.rebound(PSI, PAIR.chi, losses=carom.KelvinVoigt(0.8))
    assert np.abs(psi - exact).max() < 2.5e-3


UNLIKE = """boundary f f f
newton off
atom_modify map array
neighbor 0.001 bin
region b block -0.1 0.1 -0.1 0.1 -0.1 0.1
create_box 2 b
create_atoms {low} single 0 0 0
create_atoms {high} single 0 0 0.0100000001
set group all diameter 0.01
set group all density 7850
group ball id 2
velocity ball set 0.2 0 -1
pair_style carom precision double
pair_coeff 1 1 young 70e9 poisson 0.3 friction 0.1
pair_coeff 2 2 young 210e9 poisson 0.3 friction 0.1
fix 1 all nve/sphere
timestep 2e-8
run 4000
write_dump all custom out.txt id omegay modify sort id format float %.17g
"""


@pytest.mark.parametrize("first", [1, 2])
def test_the_softer_of_two_spheres_has_the_shorter_lever(lammps, first):
    """R - d_i, the flattening in proportion to (1 - nu^2)/E: 3/4 and 1/4 of d here. The spins of
    equal spheres are as their levers, of which the mean of d is between half and all of d_max."""
    other = 3 - first
    lammps(HEAD + UNLIKE.format(low=first, high=other))
    spins = dict(zip((first, other), lammps.dumped()[:, 1], strict=True))
    solids = [carom.Material(young=young, poisson=0.3, density=7850.0) for young in (70e9, 210e9)]
    balls = [carom.Sphere(radius=RADIUS, material=solid) for solid in solids]
    flat = carom.impact(carom.Pair(*balls, friction=0.1), speed=1.0, angle=0.0).max_penetration
    shorter = (1.0 - spins[1] / spins[2]) / (0.5 * flat / RADIUS)
    assert 0.5 < shorter < 1.0


def test_newton_and_precision_change_nothing_much(lammps):
    plain, _ = rebounds(lammps, style="precision double")
    other, _ = rebounds(lammps, style="precision double", newton="on")
    single, _ = rebounds(lammps)
    np.testing.assert_allclose(other, plain, atol=1e-10)
    np.testing.assert_allclose(single, plain, atol=5e-4)


GAS = """variable ux atom 0.4*sin(12.9*id)
variable uy atom 0.4*sin(78.2*id)
variable uz atom 0.4*sin(37.7*id)
velocity all set v_ux v_uy v_uz
"""


def gas(lammps, ranks=1, newton="off", style="precision double", then="run 3000", start=GAS):
    """Colliding spheres of two sizes and materials; returns the last state and what was printed."""
    made = (
        "lattice sc 0.01005\nregion box block 0 6 0 6 0 6\ncreate_box 2 box\n"
        "create_atoms 1 box\nset group all type/fraction 2 0.5 12345\n"
        "set type 1 diameter 0.01\nset type 2 diameter 0.008\nset group all density 2500\n"
    )
    printed = lammps(
        f"{HEAD}boundary p p p\nnewton {newton}\nneighbor 0.0004 bin\n"
        "neigh_modify every 1 delay 0 check yes one 400 page 40000\n"
        f"{made + start if start == GAS else start}"
        f"pair_style carom {style}\n"
        f"pair_coeff 1 1 {words(young=5e7, poisson=0.3, friction=0.3)}\n"
        f"pair_coeff 2 2 {words(young=8e7, poisson=0.25, friction=0.5)}\n"
        "fix 1 all nve/sphere\ntimestep 2e-6\ncompute lost all pair carom\n"
        "compute e1 all ke\ncompute e2 all erotate/sphere\n"
        "thermo_style custom step c_e1 c_e2 c_lost[1] c_lost[2] c_lost[3] nbuild\n"
        f"thermo_modify norm no format float %.15g\nthermo 20\n{then}\n"
        "write_dump all custom out.txt id vx vy vz omegax omegay omegaz "
        "modify sort id format float %.17g\n",
        ranks,
    )
    return lammps.dumped()[:, 1:], printed


@pytest.mark.slow
def test_ranks_and_newton_agree(lammps):
    """After many rebuilds with spheres that change their processor."""
    one, printed = gas(lammps, then="run 8000")
    assert int(printed.split("Neighbor list builds =")[1].split()[0]) >= 50
    assert "Dangerous builds = 0" in printed
    size = np.abs(one[:, :3]).max()
    for ranks, newton in ((2, "off"), (2, "on")):
        other, printed = gas(lammps, ranks, newton, then="run 8000")
        assert "by 2 MPI" in printed
        np.testing.assert_allclose(other, one, atol=1e-10 * size)


def rows(printed, columns=7):
    """The numbers that LAMMPS prints."""
    lines = [line.split() for line in printed.splitlines()]
    values = [line for line in lines if len(line) == columns and line[0].isdigit()]
    return np.array(values, dtype=float)


def test_the_ledger_holds_all_energy(lammps):
    """Kinetic, elastic and lost energy of a closed box: what is amiss falls as the step squared."""
    off = []
    style = "springs 64 precision double ledger yes"
    for step, runs in ((3.2e-5, 120), (8e-6, 480), (4e-6, 1000)):
        _, printed = gas(lammps, style=style, then=f"timestep {step}\nrun {runs}")
        actual = rows(printed)
        total = actual[:, 1:6].sum(axis=1)
        assert actual[-1, 4] > 0.02 * total[0]
        off.append(np.abs(total / total[0] - 1.0).max())
    assert off[2] < 3e-5
    assert off[0] / off[1] > 9.0


def test_contacts_that_are_there_at_the_start_bear_springs_and_dashpots(lammps):
    """Spheres that begin pressed and on the move: F = 4/3 E* R*^1/2 d^3/2 (1 + 3/2 tau d'/d)."""
    young, poisson, radius, depth, speed, step, tau = 1e7, 0.3, 5e-3, 1e-5, 1e-3, 1e-8, 3e-3
    printed = lammps(
        f"{HEAD}boundary s s s\natom_modify map array\nregion box block -1 1 -1 1 -1 1\n"
        f"create_box 1 box\ncreate_atoms 1 single 0 0 0\n"
        f"create_atoms 1 single 0 0 {2 * radius - depth}\n"
        f"set group all diameter {2 * radius} density 2500\nset atom 2 vz {-speed}\n"
        f"pair_style carom springs 64 precision double\npair_coeff * * young {young} "
        f"poisson {poisson} friction 0.3 retardation {tau}\nfix 1 all nve/sphere\n"
        f"timestep {step}\nvariable f equal fz[2]\nthermo_style custom step v_f\n"
        "thermo_modify format float %.12g\nthermo 1\nrun 3\n"
    )
    actual = rows(printed, columns=2)[:4, 1]
    modulus = young / (2.0 * (1.0 - poisson**2))
    depths = depth + speed * step * np.arange(len(actual))
    static = 4.0 / 3.0 * modulus * np.sqrt(0.5 * radius) * depths**1.5
    np.testing.assert_allclose(actual, static * (1.0 + 1.5 * tau * speed / depths), rtol=1e-3)


@pytest.mark.first_case
@pytest.mark.parametrize("ranks", [1, 2])
def test_a_run_from_a_restart_goes_on_to_the_bit(lammps, ranks):
    """Across periodic borders, too, if `noinit` is said."""
    on, printed = gas(lammps, ranks, then="run 1500\nwrite_restart x.rst noinit\nrun 500")
    assert "are forgotten now" not in printed
    again, _ = gas(lammps, ranks, then="run 500", start="read_restart x.rst\n")
    np.testing.assert_array_equal(again, on)


def test_a_restart_that_forgets_contacts_says_so(lammps):
    _, printed = gas(lammps, then="run 200\nwrite_restart x.rst")
    assert "contacts across periodic borders are forgotten now" in printed


def test_contacts_that_remember_another_kind_stop_the_run(lammps):
    """A restart read with other springs, and losses that begin between runs, are refused."""
    gas(lammps, then="run 400\nwrite_restart x.rst noinit")
    (lammps.folder / "out.txt").unlink()
    for style in ("springs 64 precision double", "springs 32 precision single"):
        with pytest.raises(AssertionError, match="contacts remember other springs"):
            gas(lammps, style=style, then="run 10", start="read_restart x.rst\n")
    lossy = words(young=5e7, poisson=0.3, friction=0.3, restitution=0.8, speed=1.0)
    with pytest.raises(AssertionError, match="losses cannot be switched on or off between runs"):
        gas(lammps, then=f"run 10\npair_coeff * * {lossy}\nrun 10")


BOX = "boundary f f f\nregion b block -1 1 -1 1 -1 1\ncreate_box 2 b\ncreate_atoms 1 single 0 0 0\n"


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("style", "coeff", "answer"),
    [
        ("springs 33", words(**SOLID), "springs 33 must be 16, 32 or 64"),
        ("precision half", words(**SOLID), "precision half is not known"),
        ("springs 32 springs 16", words(**SOLID), "springs is given twice"),
        ("precision single precision single", words(**SOLID), "precision is given twice"),
        ("", words(**SOLID) + " young 210e9", "young 210e9 is given twice"),
        ("", words(**SOLID) + " friction 0.3", "friction 0.3 is given twice"),
        ("", words(**SOLID) + " retardation 0 retardation 0", "retardation 0 is given twice"),
        ("", words(**SOLID | {"friction": -0.1}), "friction -0.1 must be from 0 to 1e6"),
        ("", words(**SOLID | {"friction": 1e100}), "friction 1e+100 must be from 0 to 1e6"),
        ("", words(**SOLID | {"young": 1e100}), "young 1e+100 must be from 1e-20 to 1e20"),
        ("", words(**SOLID | {"young": 1e-200}), "young 1e-200 must be from 1e-20 to 1e20"),
        ("", words(**SOLID, retardation=1e200), "retardation 1e+200 must be from 0 to 1e20"),
        ("", words(**SOLID, retardation=1e10), "too long for precision single"),
        ("", words(**SOLID, restitution=1e-3, speed=1), "restitution 0.001 must be from 0.01 to 1"),
        ("", words(**SOLID, restitution=0.8, speed=1e-200), "speed 1e-200 must be from 1e-20"),
        ("", words(**SOLID, restitution=0.8, speed=1e200), "speed 1e+200 must be from 1e-20"),
        ("", words(**SOLID | {"poisson": 0.7}), "poisson 0.7 must be above -1 and at most 0.5"),
        ("", words(**SOLID | {"young": 0.0}), "young 0.0 must be from 1e-20 to 1e20"),
        ("", words(young=1e7, poisson=0.3), "type 1 has no young, poisson or friction"),
        ("", words(**SOLID, restitution=0.8), "give restitution and the speed"),
        ("", words(stiff=5.0), "stiff 5.0 is not known; young, poisson"),
    ],
)
def test_bad_input_stops_lammps_with_one_line(lammps, style, coeff, answer):
    printed = lammps.fails(f"{HEAD}{BOX}pair_style carom {style}\npair_coeff * * {coeff}\nrun 1\n")
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    assert answer in line


def test_what_the_style_needs_of_lammps(lammps):
    rest = f"pair_style carom\npair_coeff * * {words(**SOLID)}\nrun 1\n"
    for head, answer in (
        ("units si\natom_style sphere\n", "needs velocities of ghosts"),
        ("units real\natom_style sphere\ncomm_modify vel yes\n", "needs units si"),
        ("units si\natom_style atomic\ncomm_modify vel yes\n", "needs spheres"),
    ):
        mass = "mass * 1.0\n" if "atomic" in head else ""
        assert answer in lammps.fails(f"{head}{BOX}{mass}{rest}")


ONE = f"{HEAD}{BOX}set group all diameter 0.01 density 2500\npair_style carom\n"
FULL = words(young=5e7, poisson=0.3, friction=0.3)
STEP = "fix 1 all nve/sphere\ntimestep 1e-6\nrun 1\n"


def test_a_line_of_pair_coeff_is_whole(lammps):
    """Nothing of a line before is left: losses end, and what is needed is asked for."""
    lossy = f"pair_coeff * * {FULL} restitution 0.5 speed 1\n"
    told = "with losses, energies of contacts are told by ledger yes only"
    end = f"compute c all pair carom\n{STEP}"
    assert told in lammps(f"{ONE}{lossy}{end}")
    assert told not in lammps(f"{ONE}{lossy}pair_coeff * * {FULL}\n{end}")
    printed = lammps.fails(f"{ONE}{lossy}pair_coeff * * friction 0.2\n{end}")
    assert "type 1 has no young, poisson or friction" in printed


PAGES = {"": 20000, "neigh_modify one 5000\n": 50000, "neigh_modify page 100000\n": 100000}


@pytest.mark.parametrize(("said", "page"), PAGES.items())
def test_pages_are_as_the_input_says_behind_the_style(lammps, said, page):
    printed = lammps(f"{ONE}pair_coeff * * {FULL}\n{said}{STEP}")
    assert f"page size: {page}" in printed
