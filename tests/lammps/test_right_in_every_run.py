"""What inputs do to spheres between and in runs: coarse steps, deep overlap, groups, moved walls."""

import numpy as np
import pytest

import carom
from carom.dimensionless.numerics.hertz import DURATION

from tests.lammps.test_walls import HEAD, on_the_floor

pytestmark = pytest.mark.engine
RADIUS, SPEED = 5e-3, 0.1
SOLID = "young 5e7 poisson 0.3 friction 0.3"
BALL = carom.Sphere(radius=RADIUS, material=carom.Material(young=5e7, poisson=0.3, density=2500.0))
PAIR = carom.Pair(BALL, BALL, friction=0.3)
WALL = carom.Pair(BALL, carom.HalfSpace(material=BALL.material), friction=0.3)
BOX = (
    f"{HEAD}newton off\natom_modify map array\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 1 b\n"
)
STYLE = f"pair_style carom precision double\npair_coeff * * {SOLID}\n"


def balls(*places):
    made = "".join(f"create_atoms 1 single {x!r} {y!r} {z!r}\n" for x, y, z in places)
    return f"{made}set group all diameter {2.0 * RADIUS} density 2500\n"


def step_of(pair, steps):
    """The time step of which so many are in a contact."""
    return float(DURATION * pair.scales(SPEED).time / steps)


def warnings(printed, words):
    lines = printed.splitlines()
    return [line for line in lines if line.startswith("WARNING") and words in line]


@pytest.mark.parametrize("ranks", [1, 2])
def test_steps_too_coarse_for_a_contact_are_told_once_a_run(lammps, ranks):
    """By 12 steps in a contact, not by 25; two pairs meet, both on the second processor."""
    places = [(0.07 + 0.0101 * k, y, 0.05) for y in (0.02, 0.08) for k in (0, 1)]
    moves = "variable v atom 0.05*(1-2*((id-1)%2))\nvelocity all set v_v 0 0\n"
    for steps, times in ((12, 1), (25, 0)):
        step = step_of(PAIR, steps)
        run = f"run {int(1e-4 / (SPEED * step)) + 3 * steps}\n"
        printed = lammps(
            f"{BOX}{balls(*places)}{moves}{STYLE}fix 1 all nve/sphere\ntimestep {step!r}\n{run}",
            ranks,
        )
        told = warnings(printed, "time steps")
        assert len(told) == times, printed
        if told:
            assert "pair_style carom" in told[0]
            assert f"lasts {steps}.0 time steps" in told[0]
            assert "at least 20" in told[0]


def test_steps_too_coarse_for_a_wall_are_told_once_a_run(lammps):
    places = [(x, 0.05, 0.0051) for x in (0.02, 0.05, 0.08)]
    for steps, times in ((12, 2), (25, 0)):
        step = step_of(WALL, steps)
        run = f"run {int(1e-4 / (SPEED * step)) + 3 * steps}\n"
        printed = lammps(
            f"{BOX}{balls(*places)}velocity all set 0 0 {-SPEED}\n{STYLE}"
            f"region w plane 0 0 0 0 0 1\nfix w all wall/carom {SOLID} region w\n"
            f"fix 1 all nve/sphere\ntimestep {step!r}\n{run}velocity all set 0 0 {-SPEED}\n{run}"
        )
        told = warnings(printed, "time steps")
        assert len(told) == times, printed
        assert all("fix wall/carom" in line and f"lasts {steps}.0" in line for line in told)


DEEP = balls((0.05, 0.05, 0.05), (0.0565, 0.05, 0.05))  # by 0.7 R, R* is R/2


def test_overlap_above_the_radius_stops_lammps_with_what_to_do(lammps):
    printed = lammps.fails(f"{BOX}{DEEP}{STYLE}fix 1 all nve/sphere\ntimestep 1e-6\nrun 10\n")
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    for words in ("atoms 1 and 2", "overlap 0.0035 ", "R* = 0.0025", "minimize", "fix nve/limit"):
        assert words in line


@pytest.mark.parametrize("coeff", ["", " retardation 1e-5", " restitution 0.8 speed 0.1"])
@pytest.mark.parametrize(
    "start",
    [
        "fix s all nve/limit 1e-5\nrun 2000\nunfix s\n",
        "minimize 0 1e-9 2000 20000\n",
        "min_style quickmin\nminimize 0 1e-9 2000 20000\n",
    ],
    ids=["limit", "cg", "quickmin"],
)
@pytest.mark.parametrize("apart", [0.0065, 0.0085])
def test_soft_starts_run_from_any_overlap(lammps, start, coeff, apart):
    places = balls((0.05, 0.05, 0.05), (0.05 + apart, 0.05, 0.05))
    printed = lammps(
        f"{BOX}{places}{STYLE.strip()}{coeff}\ntimestep 1e-6\n{start}velocity all set 0 0 0\n"
        "fix 1 all nve/sphere\nrun 1\nrun 1000\n"
        "write_dump all custom out.txt id x vx modify sort id format float %.17g\n"
    )
    (_, x, v), (_, other, w) = lammps.dumped()
    assert other - x > 0.00995
    assert abs(w - v) < 0.05
    assert len(warnings(printed, "R*")) == (apart < 0.0075)


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
    table = [[float(word) for word in line] for line in lines if len(line) == 3 and line[0].isdigit()]
    (_, along, _), (_, aside, force) = table[1], table[-1]
    assert abs(along) > 1e-4 * abs(force) > 0.0
    assert abs(aside) < 1e-9 * abs(force)


SLIDING = "plane 0 0 0 0 0 1 move v_along NULL NULL"
TURNING = "plane 0 0 0 0 0 1 rotate v_turn 2 2 0 0 0 1"


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
