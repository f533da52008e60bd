"""Contacts with walls one by one: what is shown of each; which ranks and restart files keep."""

import re
import struct

import numpy as np
import pytest
from tests.lammps.test_walls import HEAD, heap

pytestmark = pytest.mark.engine
RADIUS, WALL = 5e-3, 0.02
SOLID = "young 5e7 poisson 0.3 friction 0.3"
CORNER = f"""{HEAD}newton off
region b block -0.1 0.1 -0.1 0.1 -0.1 0.1
create_box 1 b
create_atoms 1 single 0.0152 0.001 0.0151
create_atoms 1 single 0.002 0.001 -0.0152
create_atoms 1 single 0.001 0.012 0.002
set group all diameter {2 * RADIUS} density 2500
velocity all set 0.03 0.02 0.01
region w block -{WALL} {WALL} -{WALL} {WALL} -{WALL} {WALL}
"""
SPHERES = "id x y z fx fy fz radius f_w[*]"
CONTACTS = " ".join(f"f_w[{k}]" for k in range(1, 13))
EXACT = "modify sort id format float %.17g"


@pytest.mark.first_case
@pytest.mark.parametrize("ranks", [1, 2])
@pytest.mark.parametrize("losses", ["", "restitution 0.8 speed 0.1"])
def test_each_contact_is_shown_and_adds_up_to_force_and_energies(lammps, losses, ranks):
    """Of a sphere in an edge, one on the floor, and one that touches nothing."""
    printed = lammps(
        f"{CORNER}pair_style carom ledger yes precision double\npair_coeff * * {SOLID} {losses}\n"
        "fix lost all property/atom d_lost_friction d_lost_viscosity\n"
        f"fix w all wall/carom {SOLID} {losses} region w contacts\nfix 1 all nve/sphere\n"
        "timestep 1e-6\nthermo_style custom step f_w[*]\nthermo_modify format float %.17g\nrun 60\n"
        f"write_dump all custom out.txt {SPHERES} d_lost_friction d_lost_viscosity {EXACT}\n"
        f"write_dump all local met.txt {CONTACTS} modify format float %.17g\n",
        ranks,
    )
    spheres, met = lammps.dumped(), np.loadtxt(lammps.folder / "met.txt", skiprows=9)
    atoms, wall, overlap = met[:, 0].astype(int), met[:, 1].astype(int), met[:, 8]
    place, force = spheres[:, 1:4], spheres[:, 4:7]
    np.testing.assert_array_equal(sorted(zip(atoms, wall, strict=True)), [(1, 2), (1, 6), (2, 5)])
    np.testing.assert_array_equal(spheres[:, 8], [2.0, 1.0, 0.0])
    np.testing.assert_array_equal(spheres[:, 15], [RADIUS, RADIUS, 0.0])
    np.testing.assert_allclose(spheres[:, 9:12], force, rtol=1e-12)
    for k, (axis, side) in enumerate(zip((wall - 1) // 2, 2 * ((wall - 1) % 2) - 1, strict=True)):
        point = place[atoms[k] - 1].copy()
        point[axis] = side * WALL
        np.testing.assert_allclose(met[k, 5:8], point, atol=1e-12)
        apart = abs(place[atoms[k] - 1][axis] - point[axis])
        assert overlap[k] == pytest.approx(RADIUS - apart, abs=1e-12)
        assert side * met[k, 2 + axis] < 0.0
    for number in (1, 2):
        rows = met[atoms == number]
        np.testing.assert_allclose(rows[:, 2:5].sum(0), force[number - 1], rtol=1e-12)
        np.testing.assert_allclose(rows[:, 5:8].mean(0), spheres[number - 1, 12:15], rtol=1e-12)
        np.testing.assert_allclose(rows[:, 10:].sum(0), spheres[number - 1, 16:], rtol=1e-12)
    assert not spheres[2, 8:].any()
    lines = re.findall(r"^ *60 +(.+)$", printed, re.MULTILINE)
    sums = np.array(lines[-1].split(), dtype=float)
    np.testing.assert_allclose(sums[:3], -force.sum(0), rtol=1e-12)
    np.testing.assert_allclose(sums[3:], met[:, 9:].sum(0), rtol=1e-9, atol=1e-20)
    assert sums[3] > 0.0
    assert sums[4] > 0.0
    assert (sums[5] > 0.0) == bool(losses)


REGIONS = {
    "block": ("block -0.05 0.05 -0.05 0.05 -0.05 0.05", 0.0),
    "outside": ("block -0.05 0.05 -0.05 0.05 -0.05 0.04 side out", 0.08),
    "sphere": ("sphere 0 0 0 0.07", 0.0),
    "cylinder": ("cylinder z 0 0 0.06 -0.05 0.05", 0.0),
    "cone": ("cone z 0 0 0.08 0.06 -0.05 0.05", 0.0),
    "plane": ("plane 0 0 -0.05 0.1 0.2 1", 0.0),
    "prism": ("prism -0.05 0.05 -0.05 0.05 -0.05 0.05 0.01 0 0", 0.0),
    "open": ("block -0.05 0.05 -0.05 0.05 -0.05 0.05 open 6", 0.0),
    "moving": ("block -0.05 0.05 -0.05 0.05 -0.05 0.05 move v_way NULL NULL", 0.0),
}


@pytest.mark.first_case
@pytest.mark.parametrize("region", REGIONS.values(), ids=REGIONS)
def test_spheres_meet_walls_in_the_same_step_however_rarely_neighbors_are_listed(lammps, region):
    """With a long delay every sphere is looked at in every step."""
    shape, lift = region
    ends = []
    for listing in ("every 1 delay 0", "delay 1000000"):
        lammps(
            f"{HEAD}newton off\nneigh_modify {listing} exclude group all all\nlattice sc 0.024\n"
            "region b block -0.2 0.2 -0.2 0.2 -0.2 0.2 units box\ncreate_box 1 b\n"
            "region fill block -0.04 0.04 -0.04 0.04 -0.04 0.04 units box\n"
            "create_atoms 1 region fill\nset group all diameter 0.01 density 2500\n"
            f"variable way equal 0.001*sin(200*step*dt)\nvariable z atom z+{lift}\n"
            "set group all z v_z\nvariable u atom sin(12.9*id)\nvariable v atom sin(78.2*id)\n"
            "variable s atom sin(37.1*id)\nvelocity all set v_u v_v v_s\n"
            f"pair_style carom\npair_coeff * * {SOLID}\nregion w {shape} units box\n"
            f"fix w all wall/carom {SOLID} region w\nfix 1 all nve/sphere\ntimestep 5e-6\n"
            f"run 12000\nwrite_dump all custom out.txt id x y z vx vy vz omegax {EXACT}\n"
        )
        ends.append(lammps.dumped())
    np.testing.assert_array_equal(ends[0], ends[1])
    assert np.count_nonzero(ends[0][:, 7]) > 3


@pytest.mark.first_case
@pytest.mark.parametrize("losses", ["", "restitution 0.8 speed 0.1"])
def test_contacts_go_along_to_another_processor(lammps, losses):
    """Spheres that slide, then roll, over a floor: through the middle of the box, and round it."""
    ends = []
    for ranks in (1, 2):
        lammps(
            f"{HEAD.replace('f f f', 'p p f')}newton off\nprocessors {ranks} 1 1\n"
            "region b block 0 0.4 0 0.1 -0.1 0.1\ncreate_box 1 b\nlattice sc 0.02\n"
            "region row block 0 0.399 0.05 0.051 0 0.001 units box\n"
            "lattice sc 0.02 origin 0 0.5 0\ncreate_atoms 1 region row\n"
            f"set group all diameter {2 * RADIUS} density 2500\n"
            f"set group all z {RADIUS - 4e-6!r}\nvelocity all set 0.3 0.1 0 units box\n"
            f"pair_style carom\npair_coeff * * {SOLID} {losses}\nregion w plane 0 0 0 0 0 1\n"
            f"fix w all wall/carom {SOLID} {losses} region w\nfix 1 all nve/sphere\n"
            "fix g all gravity 9.81 vector 0 0 -1\ntimestep 1e-5\nrun 15000\n"
            f"write_dump all custom out.txt id x y z vx vy vz omegax omegay {EXACT}\n",
            ranks,
        )
        ends.append(lammps.dumped())
    np.testing.assert_array_equal(ends[0], ends[1])
    assert ends[0].shape[0] == 20
    assert np.all(ends[0][:, 8] > 10.0)


@pytest.mark.slow
def test_a_restart_is_read_on_another_number_of_ranks(lammps):
    one, printed = heap(lammps, "run 4000\nwrite_restart x.rst\nrun 300")
    assert float(re.findall(r"^ *4000 +(\S+)", printed, re.MULTILINE)[-1]) < 0.0
    two, _ = heap(lammps, "run 300\nwrite_restart y.rst", 2, start="read_restart x.rst\n")
    np.testing.assert_allclose(two[:, 3:], one[:, 3:], atol=1e-9)
    again, _ = heap(lammps, "run 300", start="read_restart y.rst\n")
    reference, _ = heap(lammps, "run 300", 2, start="read_restart y.rst\n")
    np.testing.assert_allclose(again[:, 3:], reference[:, 3:], atol=1e-9)


LAYERS, GAP = 12, 1.0001e-2  # half of the spheres touch walls, none another sphere
FULL = f"""{HEAD}newton off
lattice sc {GAP}
region b block -1 {LAYERS} -1 {LAYERS} -1 {LAYERS}
create_box 1 b
region fill block -0.1 {LAYERS - 0.9} -0.1 {LAYERS - 0.9} -0.1 {LAYERS - 0.9}
create_atoms 1 region fill
set group all diameter 0.01 density 2500
"""
LO, HI = -0.499 * GAP, (LAYERS - 1 + 0.499) * GAP
WALLS = f"region w block {LO!r} {HI!r} {LO!r} {HI!r} {LO!r} {HI!r} units box\n"
GRANULAR = "hertz/material 5e7 0.0 0.3 tangential mindlin_rescale/force NULL 0.0 0.3"


@pytest.mark.parametrize("losses", ["", "restitution 0.9 speed 1.0"])
def test_restart_files_hold_little_more_than_those_of_granular(lammps, losses):
    def size(pair, coeff, wall):
        lammps(
            f"{FULL}pair_style {pair}\npair_coeff * * {coeff}\n{WALLS}fix w all {wall} region w\n"
            "fix 1 all nve/sphere\ntimestep 1e-6\nrun 1\nwrite_restart x.rst\n"
        )
        return (lammps.folder / "x.rst").stat().st_size

    ours = size("carom", f"{SOLID} {losses}", f"wall/carom {SOLID} {losses}")
    granular = size("granular", GRANULAR, f"wall/gran/region granular {GRANULAR}")
    assert 50 < (ours - granular) / LAYERS**3 < 150


def on_a_wall(lammps, style, losses, start, then):
    return lammps.fails(
        f"{start}pair_style carom {style}\npair_coeff * * {SOLID} {losses}\n"
        f"region w block -{WALL} {WALL} -{WALL} {WALL} -{WALL} {WALL}\n"
        f"fix w all wall/carom {SOLID} {losses} region w\nfix 1 all nve/sphere\n"
        f"timestep 1e-6\n{then}",
        2,
    )


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("style", "losses"),
    [
        ("springs 32", ""),
        ("precision double", ""),
        ("ledger yes", ""),
        ("", "restitution 0.8 speed 0.1"),
        ("of 0.2", ""),
    ],
)
def test_restart_files_of_other_contacts_are_refused_in_one_line(lammps, style, losses):
    """Of other springs, precision, ledger or losses, or where spheres have slots for walls."""
    start = CORNER.partition("region w")[0]
    written = on_a_wall(lammps, "", "", start, "run 10\nwrite_restart x.rst\n")
    assert "ERROR" not in written
    path, answer = lammps.folder / "x.rst", "other springs, another precision, ledger or losses"
    if style == "of 0.2":
        style, answer = "", "of another version of Carom"
        numbers, slots = struct.pack("d", 2000001.0), struct.pack("d", 1.0)
        assert path.read_bytes().count(numbers) == 2
        path.write_bytes(path.read_bytes().replace(numbers, slots))
    again = f"{HEAD}newton off\nread_restart x.rst\n"
    printed = on_a_wall(lammps, style, losses, again, "run 1\n")
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    assert "fix wall/carom" in line
    assert answer in line
