"""fix wall/carom in LAMMPS itself: spheres against the surfaces of regions."""

import re

import numpy as np
import pytest

import carom
from carom.dimensionless.numerics.hertz import DURATION

pytestmark = pytest.mark.engine
RADIUS, FRICTION, SHALLOW = 5e-3, 0.2, 1e-6
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
BALL = carom.Sphere(radius=RADIUS, material=STEEL)
PAIR = carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=FRICTION)
SPEED = 0.5 * (SHALLOW * RADIUS / PAIR.scales(0.5).length) ** 1.25
SOLID = f"young 210e9 poisson 0.3 friction {FRICTION}"
PSI = np.linspace(0.0, 6.0, 64)
HEAD = "units si\natom_style sphere\ncomm_modify vel yes\nboundary f f f\nneighbor 0.001 bin\n"


def rebounds(
    lammps,
    region,
    bottom=0.0,
    steps=100,
    sliding=0.0,
    losses="",
    speed=SPEED,
    wall=SOLID,
    normal_force="",
):
    """Return psi_2 and e of spheres that fall on the bottom of a region, which slides along x.

    With a `normal_force`, words of granular, carom gives the tangential part alone.
    """
    pair, beside = f"pair_style carom\npair_coeff * * {SOLID} {losses}\n", ""
    if normal_force:
        pair = (
            "pair_style hybrid/overlay granular carom springs 32 part tangential\n"
            f"pair_coeff * * granular {normal_force}\npair_coeff * * carom {SOLID} {losses}\n"
        )
        beside = f"fix n all wall/gran/region granular {normal_force} region w\n"
    step = DURATION * PAIR.scales(speed).time / steps
    gap = speed * step * (2.0 + np.arange(PSI.size) % 4 / 4.0)
    along = PSI * FRICTION * speed / PAIR.kappa + sliding
    rows = range(PSI.size)
    atoms = [f"{k + 1} 1 0.01 7850 {0.1 * k} 0 {bottom + RADIUS + gap[k]!r}" for k in rows]
    moves = [f"{k + 1} {along[k]!r} 0 {-speed!r} 0 0 0" for k in rows]
    text = f"fall\n\n{PSI.size} atoms\n1 atom types\n-1 7 xlo xhi\n"
    text += "-0.1 0.1 ylo yhi\n-0.1 0.1 zlo zhi\n\nAtoms # sphere\n\n" + "\n".join(atoms)
    text += "\n\nVelocities\n\n" + "\n".join(moves)
    (lammps.folder / "fall.data").write_text(
        text.replace("np.float64(", "").replace(")", "") + "\n"
    )
    lammps(
        f"{HEAD}read_data fall.data\ntimestep {step!r}\n{pair}"
        f"variable way equal {sliding!r}*step*dt\n"
        f"region w {region}\nfix w all wall/carom {wall} {losses} region w\n{beside}"
        f"fix 1 all nve/sphere\nrun {int(1.5 * steps) + 10}\n"
        "write_dump all custom out.txt id vx vz omegay modify sort id format float %.17g\n"
    )
    _, x, z, spin = lammps.dumped().T
    psi = (x - RADIUS * spin - sliding) * PAIR.kappa / (FRICTION * speed)
    return psi, z / speed


@pytest.mark.parametrize(
    ("region", "bottom"),
    [("plane 0 0 0 0 0 1", 0.0), ("block -1 7 -1 1 0 1", 0.0), ("cylinder x 0 0 0.05 -1 7", -0.05)],
)
def test_spheres_leave_walls_as_exactly_as_the_law_promises(lammps, region, bottom):
    psi, e = rebounds(lammps, region, bottom)
    assert np.abs(psi - carom.rebound(PSI, PAIR.chi)).max() < 1.3e-3
    np.testing.assert_allclose(e, 1.0, atol=1e-4)


@pytest.mark.parametrize(("region", "sliding"), [("", 0.0), ("move v_way NULL NULL", 2.0 * SPEED)])
def test_the_tangential_part_at_walls_is_as_exact_beside_granular(lammps, region, sliding):
    normal = f"hertz/material 210e9 0.0 0.3 tangential linear_nohistory 0.0 {FRICTION}"
    plane = f"plane 0 0 0 0 0 1 {region}"
    psi, e = rebounds(lammps, plane, sliding=sliding, normal_force=f"{normal} damping velocity")
    assert np.abs(psi - carom.rebound(PSI, PAIR.chi)).max() < 1.3e-3
    np.testing.assert_allclose(e, 1.0, atol=1e-4)


def test_walls_that_slide_and_walls_that_lose_energy(lammps):
    psi, _ = rebounds(lammps, "plane 0 0 0 0 0 1 move v_way NULL NULL", sliding=2.0 * SPEED)
    assert np.abs(psi - carom.rebound(PSI, PAIR.chi)).max() < 1.3e-3
    psi, e = rebounds(lammps, "plane 0 0 0 0 0 1", losses=f"restitution 0.8 speed {SPEED!r}")
    exact = carom.rebound(PSI, PAIR.chi, losses=carom.KelvinVoigt(0.8))
    assert np.abs(psi - exact).max() < 1.5e-3
    np.testing.assert_allclose(e, 0.8, atol=1e-3)


def test_the_lever_at_a_wall_is_shorter_by_what_the_sphere_is_flattened(lammps):
    """d/2 on the same material, d on a wall that hardly gives way; psi_2 differs in proportion."""
    speed, off = 0.6, []
    for young, share in ((210e9, 0.5), (210e14, 1.0)):
        wall = f"young {young} poisson 0.3 friction {FRICTION}"
        slow, fast = (
            rebounds(lammps, "plane 0 0 0 0 0 1", speed=v, wall=wall)[0] for v in (SPEED, speed)
        )
        plane = carom.HalfSpace(material=carom.Material(young=young, poisson=0.3, density=1.0))
        pair = carom.Pair(BALL, plane, friction=FRICTION)
        off.append((fast - slow) / (share * pair.scales(speed).length / RADIUS))
    np.testing.assert_allclose(off[1], off[0], atol=0.4)
    assert np.abs(off[0]).max() > 3.0


LEVEL = "young 1e6 poisson 0.3 friction 0.3 retardation 1e-3"


def on_the_floor(
    lammps, then, floor="plane 0 0 0 0 0 1", speed=1.0, first=0, precision="double", start=None
):
    """A ball in balance on a level floor; returns rows of step, v_x, omega_y and the energy, which
    is that of the motion, of weight and of Hertz's contact."""
    radius, density, g, depth = 0.1, 1000.0, 9.81, 0.1 - 0.09684310469878493
    made = (
        "region b block 0 4 0 4 -0.2 1\ncreate_box 1 b\n"
        f"create_atoms 1 single 0.1 0.1 {radius - depth!r}\n"
        "set group all diameter 0.2 density 1000\n"
        f"velocity all set {speed} 0 0\nreset_timestep {first}\n"
    )
    printed = lammps(
        f"{HEAD.replace('f f f', 'p p f')}newton off\n{start or made}"
        f"pair_style carom precision {precision}\npair_coeff * * {LEVEL}\n"
        "variable along equal 0.2*step*dt\nvariable turn equal step*dt\n"
        f"region w {floor}\nfix w all wall/carom {LEVEL} region w\nfix 1 all nve/sphere\n"
        f"fix g all gravity {g} vector 0 0 -1\ntimestep 2e-5\n"
        "compute s all property/atom vx omegay vz z\n"
        "compute o all reduce sum c_s[1] c_s[2] c_s[3] c_s[4]\nthermo_style custom step c_o[*]\n"
        f"thermo_modify format float %.15g\nthermo 1\n{then}\n"
    )
    table = re.findall(r"^ *\d+(?: +[-\d.e]+){4} *$", printed, re.MULTILINE)
    step, x, spin, z, height = np.array([row.split() for row in table], dtype=float).T
    mass, modulus = 4.0 / 3.0 * np.pi * radius**3 * density, 1e6 / (2.0 * (1.0 - 0.3**2))
    hertz = 8.0 / 15.0 * modulus * np.sqrt(radius) * (radius - height) ** 2.5
    moves = 0.5 * mass * (x**2 + z**2 + 0.4 * (radius * spin) ** 2)
    return step, x, spin, moves + hertz + mass * g * (height - radius + depth)


@pytest.mark.parametrize("precision", ["single", "double"])
def test_a_ball_that_slides_on_a_level_floor_is_braked_until_it_rolls(lammps, precision):
    """To 5/7 of its speed, but for the arm R - d/2; no energy is gained in any step."""
    step, x, spin, energy = on_the_floor(lammps, "thermo 4\nrun 40000", precision=precision)
    arm = 0.5 * (0.1 + 0.09684310469878493)
    rolls = 1.0 / (1.0 + 0.4 * (0.1 / arm) ** 2)
    assert rolls == pytest.approx(5.0 / 7.0, abs=0.015)
    braked = step < 0.3 / (0.3 * 9.81 * 2e-5)
    np.testing.assert_allclose(x[braked], 1.0 - 0.3 * 9.81 * 2e-5 * step[braked], atol=2e-3)
    last = step > 35000
    assert np.mean(x[last]) == pytest.approx(rolls, abs=1e-3)
    assert np.mean(spin[last]) == pytest.approx(rolls / arm, rel=2e-3)
    assert energy.max() <= energy[0] * (1.0 + 1e-9)
    assert energy[-1] < 0.73 * energy[0]


def test_a_moving_floor_is_the_same_from_any_first_step(lammps):
    """LAMMPS finds its velocity from its way in a step, in a first step from that since step 0."""
    floor = "plane 0 0 0 0 0 1 move v_along NULL NULL"
    first = on_the_floor(lammps, "run 200", floor, 0.0)
    later = on_the_floor(lammps, "run 200", floor, 0.0, first=100_000)
    np.testing.assert_allclose(later[1:], first[1:], rtol=1e-6, atol=1e-12)
    assert np.all(np.diff(first[1]) >= 0.0)
    assert first[1][-1] > 1e-3
    rows = on_the_floor(lammps, "run 100\nwrite_restart x.rst\nrun 100", floor, 0.0, first=100_000)
    again = on_the_floor(lammps, "run 100", floor, start="read_restart x.rst\n")
    np.testing.assert_array_equal(np.array(again)[:, -100:], np.array(rows)[:, -100:])


HEAP = """lattice sc 0.0102
region box block -0.05 0.05 -0.05 0.05 0 0.2 units box
create_box 1 box
region fill block -0.03 0.03 -0.03 0.03 0.01 0.08 units box
create_atoms 1 region fill
set group all diameter 0.01
set group all density 2500
velocity all create 1 5 loop geom
variable ux atom 0.1*sin(12.9*id)
velocity all set v_ux v_ux -0.5
"""
SOFT = "young 5e7 poisson 0.3 friction 0.4 restitution 0.7 speed 0.5"


def heap(lammps, then, ranks=1, start=HEAP):
    """Spheres that fall into a box of walls; returns their last state and what was printed."""
    printed = lammps(
        f"{HEAD}newton off\nneigh_modify delay 0 one 400 page 40000\natom_modify map array\n{start}"
        f"pair_style carom precision double\npair_coeff * * {SOFT}\n"
        f"region walls block -0.04 0.04 -0.04 0.04 0 0.2 units box\n"
        f"fix w all wall/carom {SOFT} region walls\nfix 1 all nve/sphere\n"
        f"fix g all gravity 9.81 vector 0 0 -1\ntimestep 1e-5\nthermo_style custom step f_w[3]\n"
        f"{then}\nwrite_dump all custom out.txt id x y z vx vy vz omegax omegay omegaz "
        "modify sort id format float %.17g\n",
        ranks,
    )
    return lammps.dumped()[:, 1:], printed


@pytest.mark.slow
def test_ranks_and_restarts_keep_what_walls_remember(lammps):
    one, _ = heap(lammps, "run 4000\nwrite_restart x.rst\nrun 1000")
    again, _ = heap(lammps, "run 1000", start="read_restart x.rst\n")
    np.testing.assert_array_equal(again, one)
    assert one[:, 2].min() > 0.0045
    two, _ = heap(lammps, "run 1500", ranks=2)
    one, _ = heap(lammps, "run 1500")
    np.testing.assert_allclose(two[:, 3:6], one[:, 3:6], atol=1e-9)


STYLE = f"pair_style carom\npair_coeff * * {SOLID}"
MOVES = "no velocity of region moving, which joins others that move"
EXTREME = "young 210e9 poisson 0.3 friction 1e100 region w"


@pytest.mark.parametrize(
    ("pair", "wall", "answer"),
    [
        (STYLE, "young 1e9 region w", "needs young, poisson"),
        (STYLE, f"{SOLID} region x", "no region x"),
        (STYLE, f"{SOLID}", "at last region ID"),
        ("", f"{SOLID} region w", "needs pair_style carom before it"),
        (STYLE, f"{SOLID} restitution 0.8 speed 1.0 region w", "one has a restitution"),
        (STYLE, f"{SOLID} friction 0.3 region w", "friction 0.3 is given twice"),
        (STYLE, EXTREME, "friction 1e100 must be from 0 to 1e6"),
        (STYLE, f"{SOLID} region moving", MOVES),
        (f"{STYLE} retardation 1", f"{SOLID} retardation 1e9 region w", "too long for precision s"),
    ],
)
def test_bad_input_stops_lammps_with_one_line(lammps, pair, wall, answer):
    box = "region b block -1 1 -1 1 -1 1\ncreate_box 1 b\ncreate_atoms 1 single 0 0 0.5\n"
    box += "variable way equal step*dt\nregion moves plane 0 0 0 0 0 1 move v_way NULL NULL\n"
    box += "region still plane 0 0 -1 0 0 1\nregion moving intersect 2 moves still\n"
    printed = lammps.fails(
        f"{HEAD}{box}set group all diameter 0.01\n{pair}\nregion w plane 0 0 0 0 0 1\n"
        f"fix w all wall/carom {wall}\nrun 1\n"
    )
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    assert answer in line


JUMPS = "the wall begins or ends where it is pressed"


@pytest.mark.parametrize("rooms", [True, False], ids=["rooms", "tiles"])
@pytest.mark.parametrize(("half", "told"), [(0.0, 0), (0.0005, 1)], ids=["touch", "overlap"])
def test_a_ball_rolls_over_a_seam_of_parts_that_touch(lammps, half, told, rooms):
    """LAMMPS has no surface where parts overlap: a ball sinks in there and is thrown out with 1.3
    times its energy, which is told."""
    low, high, side, join = -0.04, 0.0, "side out", "intersect"
    if rooms:
        low, high, side, join = 0.0, 0.04, "", "union"
    solid = "young 5e6 poisson 0.25 friction 0.5"
    printed = lammps(
        f"""{HEAD}newton off
region box block -0.1 0.1 -0.1 0.1 -0.05 0.1 units box
create_box 1 box
create_atoms 1 single -0.002 0 0.0049834 units box
set group all diameter 0.01 density 2500
pair_style carom
pair_coeff * * {solid}
region a block -0.1 {half} -0.1 0.1 {low} {high} {side}
region b block {-half} 0.1 -0.1 0.1 {low} {high} {side}
region c {join} 2 a b
fix w all wall/carom {solid} region c
fix 1 all nve/sphere
fix g all gravity 9.81 vector 0 0 -1
velocity all set 0.2 0 0
set atom 1 omega 0 40.13 0
timestep 1e-5
compute z all reduce sum z
compute k all ke
compute r all erotate/sphere
variable e equal (c_k+c_r)/mass(all)+9.81*c_z
thermo_style custom step v_e
thermo 2500
run 2500
"""
    )
    first, last = (float(row) for row in re.findall(r"(?m)^ +\d+ +(0\.\d+)", printed))
    assert printed.count(JUMPS) == told
    assert (abs(last / first - 1.0) < 2e-3) == (not told)


def test_a_sphere_put_into_a_wall_is_told_and_one_that_falls_on_it_is_not(lammps):
    """Falling by 0.5 m/s it moves 5e-7 m in a step; poured in, it would be pressed by 1e-5 m."""
    start = f"""{HEAD}newton off
region b block -1 1 -1 1 -1 1
create_box 1 b
create_atoms 1 single 0 0 {{}}
set group all diameter {2 * RADIUS} density 2500
pair_style carom
pair_coeff * * {SOLID}
region w plane 0 0 0 0 0 1
fix w all wall/carom {SOLID} region w
fix 1 all nve/sphere
timestep 1e-6
"""
    falls, put = start.format(RADIUS + 1e-6), start.format(RADIUS - 1e-5)
    assert JUMPS not in lammps(f"{falls}velocity all set 0 0 -0.5\nrun 60\n")
    assert JUMPS not in lammps(f"{put}run 3\n")  # what a run begins with is as it is
    rises = "variable z equal 1e-5*(step>1)\nregion w plane 0 0 v_z 0 0 1\n"
    jumps = falls.replace("region w plane 0 0 0 0 0 1\n", rises)
    assert JUMPS in lammps(f"{jumps}run 5\n")
