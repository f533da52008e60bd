"""What inputs do in and between runs: steps, deep overlap, memory, groups, displaced walls."""

import re

import numpy as np
import pytest
from tests.lammps.test_walls import HEAD, on_the_floor

import carom

pytestmark = pytest.mark.engine
RADIUS, SPEED = 5e-3, 0.1
SOLID = "young 5e7 poisson 0.3 friction 0.3"
BALL = carom.Sphere(radius=RADIUS, material=carom.Material(young=5e7, poisson=0.3, density=2500.0))
BOX = f"{HEAD}newton off\natom_modify map array\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 1 b\n"
STYLE = f"pair_style carom precision double\npair_coeff * * {SOLID}\n"


def balls(*places):
    made = "".join(f"create_atoms 1 single {x!r} {y!r} {z!r}\n" for x, y, z in places)
    return f"{made}set group all diameter {2.0 * RADIUS} density 2500\n"


def warnings(printed, words):
    lines = printed.splitlines()
    return [line for line in lines if line.startswith("WARNING") and words in line]


DEEP = balls((0.05, 0.05, 0.05), (0.0565, 0.05, 0.05))  # by 0.7 R, R* is R/2


def test_overlap_above_the_radius_stops_lammps_with_what_to_do(lammps):
    printed = lammps.fails(f"{BOX}{DEEP}{STYLE}fix 1 all nve/sphere\ntimestep 1e-6\nrun 10\n")
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    for words in (
        "atoms 1 and 2",
        "overlap 0.0035 ",
        "R* = 0.0025",
        "minimize",
        "fix nve/limit",
        "exclude molecule/intra",
    ):
        assert words in line


@pytest.mark.parametrize(
    ("modify", "least", "most"),
    [("", 5, 15), ("one 5000", 20, 30), ("one 10000", 35, 45), ("one 400 page 8000", 5, 10)],
)
def test_a_few_spheres_take_little_memory_however_many_neighbours_are_allowed(
    lammps, modify, least, most
):
    """In MB, as LAMMPS counts: histories for ten times `one`, which stays 2000."""
    told = f"neigh_modify {modify}\n" if modify else ""
    for before, after in ((told, ""), ("", told)):
        printed = lammps(
            f"{BOX}{balls((0.05, 0.05, 0.05))}{before}pair_style carom\npair_coeff * * {SOLID}\n"
            f"{after}fix 1 all nve/sphere\ntimestep 1e-6\nrun 1\n"
        )
        (taken,) = re.findall(r"Per MPI rank memory allocation .* = ([\d.]+) ", printed)
        assert least < float(taken.split()[0]) < most


MINIMIZE = "min_modify dmax 1e-4 line backtrack\nminimize 0 1e-9 2000 20000\n"


@pytest.mark.first_case
@pytest.mark.parametrize("coeff", ["", " retardation 1e-5", " restitution 0.8 speed 0.1"])
@pytest.mark.parametrize(
    ("start", "times"),
    [
        ("fix s all nve/limit 1e-5\nrun 2000\nunfix s\n", 1),
        (MINIMIZE, 0),
        (f"min_style fire\n{MINIMIZE}", 0),
    ],
    ids=["limit", "cg", "fire"],
)
@pytest.mark.parametrize("apart", [0.0065, 0.0085])
def test_soft_starts_part_spheres_from_any_overlap(lammps, start, times, coeff, apart):
    """Without a speed; the next run is without a force that minimize or nve/limit has left."""
    places = balls((0.05, 0.05, 0.05), (0.05 + apart, 0.05, 0.05))
    printed = lammps(
        f"{BOX}{places}{STYLE.strip()}{coeff}\ntimestep 1e-6\n{start}velocity all set 0 0 0\n"
        "fix 1 all nve/sphere\nrun 1000\n"
        "write_dump all custom out.txt id x vx modify sort id format float %.17g\n"
    )
    (_, x, v), (_, other, w) = lammps.dumped()
    assert other - x > 0.00999
    assert abs(w - v) < 5e-3
    assert len(warnings(printed, "R* = 0.0025")) == times * (apart < 0.0075)


@pytest.mark.parametrize("coeff", ["", " retardation 1e-5"])
def test_minimize_finds_the_balance_and_the_next_run_begins_anew(lammps, coeff):
    """A row between two fixed spheres ends with equal overlaps, energy and force of Hertz."""
    places = [(0.02 + x, 0.05, 0.05) for x in (0.0, 0.0092, 0.0188, 0.0285)]
    lammps(
        f"{BOX}{balls(*places)}{STYLE.strip()}{coeff}\ngroup ends id 1 4\n"
        f"fix e ends setforce 0 0 0\nmin_style fire\nmin_modify dmax 1e-5\n"
        "timestep 1e-6\nminimize 0 1e-7 20000 200000\n"
        "variable e equal pe\nprint $e file pe.txt\nvelocity all set 0 0 0\nunfix e\nrun 0\n"
        "write_dump all custom out.txt id x fx modify sort id format float %.17g\n"
    )
    _, x, force = lammps.dumped().T
    np.testing.assert_allclose(np.diff(x), 0.0095, atol=1e-9)
    modulus, depth = 5e7 / (2.0 * (1.0 - 0.3**2)), 5e-4
    energy = 8.0 / 15.0 * modulus * np.sqrt(0.5 * RADIUS) * depth**2.5
    np.testing.assert_allclose(
        force[[0, 3]], [-2.5 * energy / depth, 2.5 * energy / depth], rtol=1e-5
    )
    printed = float((lammps.folder / "pe.txt").read_text())
    assert printed == pytest.approx(3.0 * energy, rel=1e-4)


def test_a_sphere_that_leaves_the_group_of_a_wall_forgets_it(lammps):
    """It comes back elsewhere, as deep as it was, with no force along the wall."""
    printed = lammps(
        f"{BOX}{balls((0.05, 0.05, 0.00499))}{STYLE}group in id 1\n"
        "variable way equal 0.01*step*dt\nregion w plane 0 0 0 0 0 1 move v_way NULL NULL\n"
        f"fix w in wall/carom {SOLID} region w\nfix 1 all nve/sphere\ntimestep 1e-6\n"
        "thermo_style custom step f_w[1] f_w[3]\nthermo_modify format float %.15g\nrun 50\n"
        "group in clear\nrun 1\ndisplace_atoms all move 0.02 0 0\nset group all z 0.00499\n"
        "velocity all set 0 0 0\nset group all omega 0 0 0\ngroup in id 1\nrun 0\n"
    )
    lines = [line.split() for line in printed.splitlines()]
    table = [
        [float(word) for word in line] for line in lines if len(line) == 3 and line[0].isdigit()
    ]
    (_, along, _), (_, aside, force) = table[1], table[-1]
    assert abs(along) > 1e-4 * abs(force) > 0.0
    assert abs(aside) < 1e-9 * abs(force)


SLIDING = "plane 0 0 0 0 0 1 move v_along NULL NULL"
TURNING = "plane 0 0 0 0 0 1 rotate v_turn 2 2 0 0 0 1"


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("floor", "between"),
    [
        (SLIDING, "reset_timestep 5"),
        (SLIDING, "variable along equal 0.3+0.2*step*dt"),
        (SLIDING, f"region w delete\nregion w {SLIDING}"),
        (SLIDING, "timestep 4e-5\ntimestep 2e-5"),
        (TURNING, "variable turn equal 1+step*dt"),
        (TURNING, "reset_timestep 5"),
    ],
    ids=["reset", "variable", "region", "timestep", "turned", "turned, reset"],
)
@pytest.mark.parametrize("moved", ["", "displace_atoms all move 0 0 -1e-4\n"])
@pytest.mark.parametrize("first", [0, 100_000])
def test_a_wall_that_was_displaced_between_runs_did_not_move_in_a_step(
    lammps, floor, between, moved, first
):
    """The ball goes on as on a wall that was not, pressed deeper at the start of the run or not."""
    displaced = on_the_floor(lammps, f"run 50\n{moved}{between}\nrun 50", floor, 0.0, first=first)
    reference = on_the_floor(lammps, f"run 50\n{moved}run 50", floor, 0.0, first=first)
    np.testing.assert_allclose(displaced[1:], reference[1:], rtol=1e-9, atol=1e-12)
    assert np.abs(reference[1]).max() > 1e-4
