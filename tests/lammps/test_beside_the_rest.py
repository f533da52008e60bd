"""pair_style carom beside the rest of LAMMPS: exclusions, rigid bodies, hybrids, units, stress."""

import re

import numpy as np
import pytest

pytestmark = pytest.mark.engine
HEAD = "units si\natom_style sphere\ncomm_modify vel yes\nneighbor 0.001 bin\n"
SOLID = "young 5e7 poisson 0.3 friction 0.3"
CAROM = f"pair_style carom springs 32 precision double\npair_coeff * * {SOLID}\n"
OVERLAY = "pair_style hybrid/overlay carom precision double zero 0.01\n"
BESIDE = "pair_style hybrid carom precision double "
OF_ONE, OF_TWO = (f"pair_coeff {kind} {kind} carom {SOLID}\n" for kind in (1, 2))
ROW = "".join(
    f"create_atoms {kind} single {x} 0.05 0.05\n"
    for kind, x in ((1, 0.03), (1, 0.0395), (2, 0.049))
)  # three in a row, pressed by 0.5 mm
ROW += "set group all diameter 0.01\nset group all density 2500\n"
PLAIN = f"region b block 0 0.1 0 0.1 0 0.1\ncreate_box 2 b\n{ROW}"
TELL = (
    "fix 1 all nve/sphere\ntimestep 1e-6\ncompute p all pair carom\n"
    "thermo_style custom step pe c_p[1] pxx pyy\nthermo_modify norm no format float %.15g\nrun 0\n"
)
MODULUS, REDUCED, DEPTH = 5e7 / (2.0 * (1.0 - 0.3**2)), 2.5e-3, 5e-4
ENERGY = 8.0 / 15.0 * MODULUS * np.sqrt(REDUCED) * DEPTH**2.5  # of one contact, by Hertz
FORCE = 2.5 * ENERGY / DEPTH


def rows(printed, width):
    """The numbers that LAMMPS prints in so many columns."""
    lines = [line.split() for line in printed.splitlines() if not re.search("[a-df-z]", line)]
    values = [line for line in lines if len(line) == width and line[0].isdigit()]
    return np.array(values, dtype=float)


@pytest.mark.first_case
@pytest.mark.parametrize("newton", ["off", "on"])
@pytest.mark.parametrize(
    ("start", "contacts"),
    [
        (PLAIN + CAROM, 2),
        (PLAIN + CAROM + "neigh_modify exclude type 1 1\n", 1),
        (PLAIN + CAROM + "neigh_modify exclude type 1 2 exclude type 1 1\n", 0),
        (f"{PLAIN}{OVERLAY}pair_coeff * * carom {SOLID}\npair_coeff * * zero\n", 2),
        (f"{PLAIN}{BESIDE}lj/cut 1e-6\n{OF_ONE}pair_coeff * 2 lj/cut 0.0 1e-6\n", 1),
        (f"{PLAIN}{BESIDE}zero 0.01\n{OF_ONE}{OF_TWO}pair_coeff 1 2 zero\n", 1),
        (f"{PLAIN}{BESIDE}zero 0.01\npair_coeff * * zero\npair_coeff 1 2 carom {SOLID}\n", 1),
    ],
    ids=["plain", "some excluded", "all excluded", "overlay", "other types", "hybrid", "unlike"],
)
def test_who_meets_whom(lammps, newton, start, contacts):
    """Elastic energy and pressure are those of so many Hertzian contacts."""
    ((_, pe, elastic, pxx, pyy),) = rows(lammps(HEAD + f"newton {newton}\n" + start + TELL), 5)
    np.testing.assert_allclose([pe, elastic], contacts * ENERGY, rtol=1e-9)
    np.testing.assert_allclose([pxx, pyy], [contacts * FORCE * 0.0095 / 1e-3, 0.0], rtol=1e-9)


SEVERAL = (
    "pair_style hybrid carom springs 16 precision double carom springs 64 precision double\n"
    f"pair_coeff 1 1 carom 1 {SOLID}\npair_coeff 2 2 carom 2 {SOLID}\n"
    f"pair_coeff 1 2 carom 2 {SOLID}\n"
)
TELL_FIRST = TELL.replace("pair carom", "pair carom 1")  # of two
MOVES = "velocity all set 0 0.1 0.05\ngroup two type 2\nvelocity two set 0 -0.1 0\nrun 60\n"
DUMP = "write_dump all custom out.txt id x y z vx vy vz omegax omegay omegaz modify sort id "
DUMP += "format float %.17g\n"


def test_two_of_them_in_one_hybrid_are_each_as_if_alone(lammps):
    """Types 1 and 2 meet by 64 springs, alike spheres of type 1 by 16; and by 16 and 16 alone."""
    floor = f"region w plane 0 0 0.0453 0 0 1\nfix w all wall/carom {SOLID} region w\n"
    seen = {}
    for name, style in (
        ("both", SEVERAL),
        ("same", SEVERAL.replace("64", "16")),
        ("alone", CAROM.replace("32", "16")),
    ):
        tell = TELL if name == "alone" else TELL_FIRST
        lammps(f"{HEAD}newton off\n{PLAIN}{style}{floor}{tell}{MOVES}{DUMP}")
        seen[name] = lammps.dumped()
    np.testing.assert_allclose(seen["same"], seen["alone"], rtol=1e-9, atol=1e-15)
    off = np.abs(seen["both"] - seen["alone"])[:, 7:].max()
    assert 1e-4 < off / np.abs(seen["alone"][:, 7:]).max() < 0.05


def test_two_of_them_go_on_from_a_restart_to_the_bit(lammps):
    started = f"{HEAD}newton off\n{PLAIN}{SEVERAL}{TELL_FIRST}"
    lammps(f"{started}{MOVES}write_restart x.rst noinit\nrun 60\n{DUMP}")
    once = lammps.dumped()
    again = f"{SEVERAL}fix 1 all nve/sphere\ntimestep 1e-6\nrun 60\n{DUMP}"
    lammps(f"{HEAD}newton off\nread_restart x.rst\n{again}")
    np.testing.assert_array_equal(lammps.dumped(), once)


def test_bonded_spheres_meet_only_if_special_bonds_says_so(lammps):
    box = "create_box 2 b bond/types 1 extra/bond/per/atom 2 extra/special/per/atom 4"
    start = HEAD.replace("sphere", "hybrid sphere bond") + PLAIN.replace("create_box 2 b", box)
    bonded = "bond_style zero\nbond_coeff 1\nspecial_bonds lj {} 1 1\n"
    bonded += "create_bonds single/bond 1 1 2 special yes\n"
    for weight, contacts in ((0, 1), (1, 2)):
        actual = rows(lammps(start + CAROM + bonded.format(weight) + TELL), 5)
        np.testing.assert_allclose(actual[0, 2], contacts * ENERGY, rtol=1e-9)


def test_what_is_moved_between_runs_has_its_force_at_once(lammps):
    """Not the force of the contact as it was."""
    moved = "group one id 1\ndisplace_atoms one move 1e-4 0 0\nrun 0\n"
    actual = rows(lammps(HEAD + PLAIN + CAROM + TELL + moved), 5)
    energy = 8.0 / 15.0 * MODULUS * np.sqrt(REDUCED) * (DEPTH + 1e-4) ** 2.5
    np.testing.assert_allclose(actual[:, 1], [2.0 * ENERGY, ENERGY + energy], rtol=1e-9)
    virial = FORCE * 0.0095 + 2.5 * energy / (DEPTH + 1e-4) * 0.0094
    np.testing.assert_allclose(actual[1, 3], virial / 1e-3, rtol=1e-9)


@pytest.mark.parametrize("rebuilds", ["check yes", "check no"])
def test_the_ledger_closes_if_spheres_part_when_lists_are_made(lammps, rebuilds):
    printed = lammps(
        f"{HEAD}boundary f f f\nneigh_modify every 1 delay 0 {rebuilds}\n"
        "region b block 0 0.1 0 0.1 0 0.1\ncreate_box 1 b\n"
        "create_atoms 1 single 0.05 0.05 0.05\ncreate_atoms 1 single 0.060001 0.05 0.05\n"
        "set group all diameter 0.01\nset group all density 2500\ngroup one id 1\n"
        "velocity one set 0.1 0.05 0\npair_style carom springs 64 precision double ledger yes\n"
        f"pair_coeff * * {SOLID} restitution 0.5 speed 0.1\nfix 1 all nve/sphere\n"
        "timestep 1e-6\ncompute k all ke\ncompute r all erotate/sphere\ncompute p all pair carom\n"
        "thermo_style custom step c_k c_r c_p[1] c_p[2] c_p[3]\n"
        "thermo_modify norm no format float %.15g\nrun 1500\n"
    )
    first, last = rows(printed, 6)
    assert last[3] == 0.0
    assert last[5] > 0.1 * first[1]
    assert last[1:].sum() == pytest.approx(first[1:].sum(), rel=2e-4)


def test_walls_see_whole_bodies(lammps):
    """A light sphere with a heavy one on it, one body: the mass that e is said for, on a wall."""
    lossy = f"{SOLID} restitution 0.5 speed 0.1"
    printed = lammps(
        f"{HEAD}boundary f f f\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 1 b\n"
        "create_atoms 1 single 0.05 0.05 0.005001\ncreate_atoms 1 single 0.05 0.05 0.013\n"
        "set group all diameter 0.01\nset atom 1 density 2500\nset atom 2 density 25000\n"
        f"velocity all set 0 0 -0.1\npair_style carom\npair_coeff * * {lossy}\n"
        "neigh_modify exclude group all all\nregion w plane 0 0 0 0 0 1\n"
        f"fix w all wall/carom {lossy} region w\nfix 1 all rigid single\ntimestep 1e-6\n"
        "variable v equal vcm(all,z)\nthermo_style custom step v_v\nrun 4000\n"
    )
    assert rows(printed, 2)[-1, 1] == pytest.approx(0.05, rel=2e-3)


def test_rigid_bodies(lammps):
    """A sphere strikes a dumbbell that is rigid: what energy is amiss falls as the step squared."""
    start = (
        f"{HEAD}newton off\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 2 b\n"
        "create_atoms 1 single 0.05 0.046 0.05\ncreate_atoms 1 single 0.05 0.053 0.05\n"
        "create_atoms 2 single 0.0594 0.05 0.05\nset group all diameter 0.01\n"
        "set group all density 2500\ngroup clump type 1\ngroup ball type 2\n"
        "velocity ball set -0.1 0.02 0.03\npair_style carom springs 64 precision double "
        "ledger yes\n"
        f"pair_coeff * * {SOLID}\nneigh_modify exclude group clump clump\n"
        "fix 1 clump rigid single\nfix 2 ball nve/sphere\ncompute k1 all ke/rigid 1\n"
        "compute k2 all erotate/rigid 1\ncompute k3 ball ke\ncompute k4 ball erotate/sphere\n"
        "compute p all pair carom\n"
        "thermo_style custom step c_k1 c_k2 c_k3 c_k4 c_p[1] c_p[2] c_p[3]\n"
        "thermo_modify norm no format float %.15g\n"
    )
    off = []
    for step in (8e-6, 4e-6):
        actual = rows(lammps(f"{start}timestep {step}\nrun {round(8e-3 / step)}\n"), 8)
        total = actual[:, 1:7].sum(axis=1)
        assert actual[-1, 5] == 0.0  # parted
        assert actual[-1, 6] > 0.005 * total[0]  # rubbed
        off.append(abs(total[-1] / total[0] - 1.0))
    assert off[1] < 2e-4
    assert off[0] / off[1] > 3.0


@pytest.mark.parametrize("ranks", [1, 2])
def test_restitution_is_that_of_whole_bodies(lammps, ranks):
    """A sphere strikes three that are one body along their line: the mass that e is said for."""
    printed = lammps(
        f"{HEAD}boundary f f f\nregion b block 0 0.1 0 0.1 0 0.1\n"
        "create_box 2 b\ncreate_atoms 1 single 0.03 0.05 0.05\n"
        "create_atoms 1 single 0.035 0.05 0.05\ncreate_atoms 1 single 0.04 0.05 0.05\n"
        "create_atoms 2 single 0.050001 0.05 0.05\nset group all diameter 0.01\n"
        "set group all density 2500\ngroup clump type 1\ngroup ball type 2\n"
        f"velocity ball set -0.1 0 0\n{CAROM.rstrip()} restitution 0.8 speed 0.1\n"
        "neigh_modify exclude group clump clump\nfix 1 clump rigid single\n"
        "fix 2 ball nve/sphere\ntimestep 1e-6\nvariable v equal vcm(ball,x)\n"
        "variable w equal vcm(clump,x)\nthermo_style custom step v_v v_w\n"
        "thermo_modify format float %.15g\nrun 2000\n",
        ranks,
    )
    _, ball, clump = rows(printed, 3)[-1]
    assert ball - clump == pytest.approx(0.08, rel=1e-3)
    assert ball == pytest.approx(-3.0 * clump - 0.1, rel=1e-9)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("units", "length", "time", "mass"),
    [
        ("cgs", 1e2, 1.0, 1e3),
        ("lj", 1.0, 1.0, 1.0),
        ("micro", 1e6, 1e6, 1e15),
        ("nano", 1e9, 1e9, 1e21),
    ],
)
def test_units_are_only_units(lammps, units, length, time, mass):
    """The same oblique impact, with losses, in other units: the same angle and spin."""

    def left(units, length, time, mass):
        speed, young, density = length / time, mass / (length * time**2), mass / length**3
        lammps(
            f"units {units}\natom_style sphere\ncomm_modify vel yes\nboundary f f f\n"
            f"neighbor {1e-3 * length} bin\nregion b block 0 {0.1 * length} 0 {0.1 * length} 0 "
            f"{0.1 * length} units box\ncreate_box 1 b\n"
            f"create_atoms 1 single {0.05 * length} {0.05 * length} {0.05 * length} units box\n"
            f"create_atoms 1 single {0.060001 * length} {0.05 * length} {0.05 * length} units box\n"
            f"set group all diameter {0.01 * length}\nset group all density {2500 * density}\n"
            f"group one id 1\nvelocity one set {0.1 * speed} {0.06 * speed} 0 units box\n"
            f"pair_style carom\npair_coeff * * young {5e7 * young!r} poisson 0.3 friction 0.3 "
            f"restitution 0.9 speed {0.1 * speed!r}\nfix 1 all nve/sphere\n"
            f"timestep {1e-6 * time!r}\nrun 1500\n"
            "write_dump all custom out.txt vx vy omegaz modify sort id format float %.17g\n"
        )
        return lammps.dumped() / np.array([speed, speed, 1.0 / time])

    plain = left("si", 1.0, 1.0, 1.0)
    assert plain[1, 0] - plain[0, 0] == pytest.approx(0.09, rel=1e-2)
    np.testing.assert_allclose(left(units, length, time, mass), plain, rtol=1e-5, atol=1e-8)


def test_a_ball_on_a_turntable_goes_round_at_two_sevenths(lammps):
    """A ball that rolls on a plane turning with Omega goes round at 2/7 Omega, wherever it is."""
    turn, place, speed = 20.0, 0.03, 0.1
    lossy = "young 5e6 poisson 0.3 friction 0.5 restitution 0.5 speed 0.01"
    printed = lammps(
        f"{HEAD}boundary f f f\nregion b block -0.1 0.1 -0.1 0.1 -0.01 0.05\ncreate_box 1 b\n"
        f"create_atoms 1 single {place} 0 0.004999\nset group all diameter 0.01\n"
        f"set group all density 2500\nvelocity all set 0 {speed} 0\n"
        f"set atom 1 omega {(turn * place - speed) / 0.005} 0 0\n"
        f"variable theta equal {turn}*step*dt\nregion table plane 0 0 0 0 0 1 "
        f"rotate v_theta 0 0 0 0 0 1\npair_style carom\npair_coeff * * {lossy}\n"
        f"fix w all wall/carom {lossy} region table\nfix 1 all nve/sphere\n"
        "fix g all gravity 9.81 vector 0 0 -1\ntimestep 1e-5\nvariable vx equal vcm(all,x)\n"
        "variable vy equal vcm(all,y)\nthermo_style custom step v_vx v_vy\nthermo 5000\nrun 50000\n"
    )
    step, vx, vy = rows(printed, 3).T
    angle = 2.0 / 7.0 * turn * 1e-5 * step
    np.testing.assert_allclose(vx, -speed * np.sin(angle), atol=0.015 * speed)
    np.testing.assert_allclose(vy, speed * np.cos(angle), atol=0.015 * speed)
