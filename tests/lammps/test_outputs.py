"""What LAMMPS tells of contacts of pair_style carom, against sums over them that are made here."""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

pytestmark = pytest.mark.engine
FRICTION, EDGE = 0.3, 4 * 0.0051
SOLID = f"young 5e6 poisson 0.3 friction {FRICTION}"
PACKING = """units si
atom_style sphere
comm_modify vel yes
newton {newton}
boundary p p p
neighbor 0.0004 bin
neigh_modify one 400 page 40000
lattice sc 0.0051
region b block 0 4 0 4 0 4
create_box 2 b
create_atoms 1 box
set group all type/fraction 2 0.5 12345
set type 1 diameter 0.0052
set type 2 diameter 0.0053
set group all density 2500
variable a atom {speed}*sin(12.9*id)
variable b atom {speed}*sin(78.2*id)
variable c atom {speed}*sin(37.7*id)
velocity all set v_a v_b v_c
{pair}
fix 1 all nve/sphere
timestep 1e-5
compute ids all property/local patom1 patom2 cutoff radius
compute met all pair/local dx dy dz dist eng force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 cutoff radius
compute pair all pair carom
compute stress all stress/atom NULL pair
compute pressure all pressure NULL pair
{more}
thermo_style custom step c_pair[*] c_pressure[*] {names}
thermo_modify norm no format float %.15g
run {steps}
write_dump all local met.txt c_ids[*] c_met[*] modify format float %.17g
write_dump all custom out.txt id x y z fx fy fz tqx tqy tqz c_stress[*] {losses} &
    modify sort id format float %.17g
"""
OURS = {
    "more": "compute fabric all fabric radius contact branch force/normal\n"
    "fix lost all property/atom d_lost_friction d_lost_viscosity\n"
    "compute of all property/atom d_lost_friction d_lost_viscosity\n"
    "compute sums all reduce sum c_of[*]",
    "names": "c_fabric[*] c_sums[*]",
    "losses": "c_of[*]",
}
BARE = {"more": "", "names": "", "losses": ""}
ALONE = f"pair_style carom ledger yes precision double\npair_coeff * * {SOLID} retardation 1e-5"
HOW = [("off", 1), ("on", 1), ("off", 2), ("on", 2)]


class Packing(NamedTuple):
    """What is printed at the end by name, rows of contacts and of atoms."""

    printed: dict
    contacts: np.ndarray
    atoms: np.ndarray

    def forces(self):
        """The whole force on the first sphere of each contact."""
        normal = self.contacts[:, 2:5] / self.contacts[:, 5:6]
        return self.contacts[:, 7:8] * normal + self.contacts[:, 8:11]


def packing(lammps, newton="off", ranks=1, steps=60, pair=ALONE, speed=0.04, more=OURS):
    asked = more | {"newton": newton, "pair": pair, "steps": steps, "speed": speed}
    text = lammps(PACKING.format(**asked), ranks)
    lines = text.splitlines()
    titles = next(line for line in lines if "c_pair[1]" in line or "PairStep" in line).split()
    values = [line.split() for line in lines if len(line.split()) == len(titles)]
    last = [row for row in values if row[0].isdigit()][-1]
    contacts = np.loadtxt(lammps.folder / "met.txt", skiprows=9, ndmin=2)
    printed = dict(zip(titles, map(float, last), strict=True))
    printed["builds"] = int(text.split("Neighbor list builds =")[1].split()[0])
    return Packing(printed, contacts, lammps.dumped())


def vector(printed, name, count):
    return np.array([printed[f"c_{name}[{k}]"] for k in range(1, count + 1)])


def near(apart):
    return apart - EDGE * np.round(apart / EDGE)


@pytest.mark.parametrize(("newton", "ranks"), HOW)
def test_forces_of_contacts_make_those_of_spheres(lammps, newton, ranks):
    """Force and, at the point where they touch, torque; the points lie between the spheres."""
    packed = packing(lammps, newton, ranks)
    force, torque = np.zeros((2, len(packed.atoms), 3))
    for row, each in zip(packed.contacts, packed.forces(), strict=True):
        for k, side in ((0, 1.0), (1, -1.0)):
            i = int(row[k]) - 1
            force[i] += side * each
            arm = near(row[16:19] - packed.atoms[i, 1:4])
            torque[i] += np.cross(arm, side * each)
    scale = np.abs(packed.forces()).max()
    np.testing.assert_allclose(force, packed.atoms[:, 4:7], atol=1e-9 * scale)
    np.testing.assert_allclose(torque, packed.atoms[:, 7:10], atol=1e-9 * scale * 0.0026)
    aside = packed.contacts[:, 8:11]
    np.testing.assert_allclose(packed.contacts[:, 11], np.linalg.norm(aside, axis=1), rtol=1e-12)
    assert packed.contacts[:, 11].max() > 0.1 * scale
    assert len(packed.contacts) == 192


@pytest.mark.parametrize(("newton", "ranks"), HOW)
def test_stress_is_the_sum_of_force_times_branch(lammps, newton, ranks):
    """Of the box, and of each sphere half of its contacts."""
    packed = packing(lammps, newton, ranks)
    virial = np.zeros((len(packed.atoms), 6))
    for row, force in zip(packed.contacts, packed.forces(), strict=True):
        dyad = np.outer(row[2:5], force)
        dyad = [dyad[i, k] for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
        for k in (0, 1):
            virial[int(row[k]) - 1] += 0.5 * np.array(dyad)
    scale = np.abs(virial).max()
    np.testing.assert_allclose(-packed.atoms[:, 10:16], virial, atol=1e-9 * scale)
    pressure = vector(packed.printed, "pressure", 6)
    np.testing.assert_allclose(pressure * EDGE**3, virial.sum(axis=0), atol=1e-8 * scale)


@pytest.mark.parametrize(("newton", "ranks"), HOW)
def test_energies_of_contacts_make_those_of_the_style(lammps, newton, ranks):
    """What is stored, and lost since they touched; no contact has ended."""
    packed = packing(lammps, newton, ranks)
    elastic, friction, viscosity = vector(packed.printed, "pair", 3)
    sums = packed.contacts[:, [6, 14, 15]].sum(axis=0)
    np.testing.assert_allclose(sums, [elastic, friction, viscosity], rtol=1e-12)
    assert min(friction, viscosity) > 1e-3 * elastic


@pytest.mark.first_case
@pytest.mark.parametrize(("newton", "ranks"), HOW)
def test_losses_of_spheres_make_those_of_the_style(lammps, newton, ranks):
    """Also of contacts that have ended, and with spheres that go to another processor."""
    packed = packing(lammps, newton, ranks, steps=3000, speed=1.0)
    losses = vector(packed.printed, "pair", 3)[1:]
    np.testing.assert_allclose(vector(packed.printed, "sums", 2), losses, rtol=1e-12)
    np.testing.assert_allclose(packed.atoms[:, 16:].sum(axis=0), losses, rtol=1e-12)
    assert packed.contacts[:, 14].sum() < 0.5 * losses[0]
    assert packed.printed["builds"] > 20
    assert packed.atoms[:, 16].min() > 0.0


def anisotropy(weights, normals, all_weights):
    """15/2 (and 5/2 of the mean) of the deviator of a fabric tensor."""
    tensor = np.einsum("n,ni,nk->ik", weights, normals, normals)
    deviator = tensor - np.trace(tensor) / 3.0 * np.eye(3)
    return [
        deviator[i, k] / all_weights for i, k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    ]


@pytest.mark.first_case
@pytest.mark.parametrize(("newton", "ranks"), HOW)
def test_fabric_is_that_of_the_contacts(lammps, newton, ranks):
    """As LAMMPS' manual defines it: contacts, branches and normal forces."""
    packed = packing(lammps, newton, ranks, steps=3000, speed=1.0)
    branch, normal = packed.contacts[:, 5], packed.contacts[:, 2:5] / packed.contacts[:, 5:6]
    fabric = vector(packed.printed, "fabric", 18)
    contacts = 7.5 * np.array(anisotropy(np.full(len(normal), 1.0 / len(normal)), normal, 1.0))
    np.testing.assert_allclose(fabric[:6], contacts, atol=1e-10)
    a = np.array(contacts)[[[0, 3, 4], [3, 1, 5], [4, 5, 2]]]
    share = 1.0 / (1.0 + np.einsum("ni,ik,nk->n", normal, a, normal)) / len(normal)
    for of, place in ((branch, 6), (packed.contacts[:, 7], 12)):
        weights = share * of
        expected = 2.5 * np.array(anisotropy(weights, normal, weights.sum() / 3.0))
        np.testing.assert_allclose(fabric[place : place + 6], expected, atol=1e-9)
    assert np.abs(contacts).max() > 0.01


def test_a_contact_sticks_until_its_friction_is_used_up(lammps):
    """p6 goes up to 1 with the displacement along the surface (Cattaneo), then all slides."""
    lammps(
        "units si\natom_style sphere\ncomm_modify vel yes\nboundary f f f\nnewton off\n"
        "neighbor 0.001 bin\nregion b block 0 0.1 0 0.1 0 0.1\ncreate_box 1 b\n"
        "create_atoms 1 single 0.05 0.05 0.05\ncreate_atoms 1 single 0.0599 0.05 0.05\n"
        "set group all diameter 0.01\nset group all density 2500\ngroup one id 1\n"
        "velocity one set 0 0.05 0\npair_style carom springs 64 precision double\n"
        f"pair_coeff * * {SOLID}\nfix 1 all nve/noforce\ntimestep 1e-6\n"
        "compute met all pair/local p4 p5 p6 cutoff radius\n"
        "dump d all local 20 met.txt c_met[*]\ndump_modify d format float %.17g\nrun 1200\n"
    )
    blocks = (lammps.folder / "met.txt").read_text().split("ITEM: ENTRIES")[1:]
    size, overlap, used = np.array(
        [block.splitlines()[1].split() for block in blocks], dtype=float
    ).T
    modulus, kappa = 5e6 / (2.0 * (1.0 - 0.3**2)), 2.0 * 0.7 / 1.7
    limit = FRICTION * 4.0 / 3.0 * modulus * np.sqrt(2.5e-3) * overlap**1.5
    np.testing.assert_allclose(used[1:], (size / limit)[1:], atol=1e-12)
    moved = np.arange(len(used)) * 1e-6
    sticks = moved < 0.9 * FRICTION * overlap / kappa
    cattaneo = 1.0 - (1.0 - kappa * moved / (FRICTION * overlap))[sticks] ** 1.5
    np.testing.assert_allclose(used[sticks], cattaneo, atol=2e-3)
    assert used[-1] == pytest.approx(1.0, abs=1e-12)


BESIDE = (
    "pair_style hybrid/overlay carom part tangential precision double granular\n"
    "pair_coeff * * granular {} 5e6 0.0 0.3 {} tangential linear_nohistory 0.0 0.3 "
    "damping velocity\n"
    f"pair_coeff * * carom {SOLID} {{}}"
)


@pytest.mark.parametrize(
    ("theory", "gamma", "factor"),
    [("hertz/material", "", 0.0), ("jkr", "1", 3.0), ("dmt", "1", 4.0)],
)
def test_beside_granular_contacts_have_the_forces_of_both(lammps, theory, gamma, factor):
    """Its normal force and our friction; p6 is the friction over mu (F_n + 2 F_c)."""
    pair = BESIDE.format(theory, gamma, f"{theory} {gamma}" if gamma else "")
    packed = packing(lammps, pair=pair, more=BARE)
    force = np.zeros((len(packed.atoms), 3))
    for row, each in zip(packed.contacts, packed.forces(), strict=True):
        force[int(row[0]) - 1] += each
        force[int(row[1]) - 1] -= each
    np.testing.assert_allclose(force, packed.atoms[:, 4:7], atol=1e-9 * np.abs(force).max())
    distance, normal, aside, overlap, used = packed.contacts[:, [5, 7, 11, 12, 13]].T
    pulloff = factor * np.pi * (distance + overlap) / 4.0
    np.testing.assert_allclose(aside / used, FRICTION * (normal + 2.0 * pulloff), rtol=2e-4)
    assert 0.1 < used.max() < 1.0 + 1e-12


@pytest.mark.parametrize(
    ("fix", "ledger", "answer"),
    [
        ("d_lost_friction", "no", "is known by ledger yes only"),
        ("i_lost_viscosity", "yes", "must be a vector, d_lost_viscosity of fix property/atom"),
        ("d2_lost_friction 3", "yes", "must be a vector, d_lost_friction of fix property/atom"),
    ],
)
def test_losses_that_cannot_be_kept_are_refused(lammps, fix, ledger, answer):
    printed = lammps.fails(
        "units si\natom_style sphere\ncomm_modify vel yes\nregion b block -1 1 -1 1 -1 1\n"
        "create_box 1 b\ncreate_atoms 1 single 0 0 0\nset group all diameter 0.01 density 1000\n"
        f"fix lost all property/atom {fix}\npair_style carom ledger {ledger}\n"
        f"pair_coeff * * {SOLID}\nfix 1 all nve/sphere\nrun 1\n"
    )
    (line,) = [line for line in printed.splitlines() if line.startswith("ERROR")]
    assert answer in line


GOES_ON = """units si
atom_style sphere
comm_modify vel yes
newton off
read_restart x.rst
{pair}
fix lost all property/atom d_lost_friction d_lost_viscosity
fix 1 all nve/sphere
timestep 1e-5
compute of all property/atom d_lost_friction d_lost_viscosity
compute sums all reduce sum c_of[*]
thermo_style custom step c_sums[*]
run {steps}
write_dump all custom out.txt x y z c_of[*] modify sort id format float %.17g
"""


@pytest.mark.first_case
@pytest.mark.parametrize("ranks", [1, 2])
def test_losses_of_spheres_go_on_from_a_restart(lammps, ranks):
    once = packing(lammps, ranks=ranks, speed=1.0, steps="300\nwrite_restart x.rst noinit\nrun 300")
    lammps(GOES_ON.format(pair=ALONE, steps=300), ranks)
    np.testing.assert_allclose(lammps.dumped()[:, 3:], once.atoms[:, 16:], rtol=1e-10)


def test_the_lines_of_the_manual_run(lammps):
    """Each contact has a line, each sphere what it has lost."""
    page = Path(__file__).parents[2] / "docs" / "how-to" / "lammps.md"
    section = page.read_text(encoding="utf-8").split("## Output")[1].split("\n## ")[0]
    contacts, spheres = (part.split("```")[0] for part in section.split("```none\n")[1:])
    more = spheres.split("\n", 1)[1] + contacts
    packed = packing(lammps, steps=1000, more=BARE | {"more": more})
    listed = np.loadtxt(lammps.folder / "contacts.1000.txt", skiprows=9)
    np.testing.assert_allclose(listed[:, 1:3], packed.contacts[:, :2])
    np.testing.assert_allclose(listed[:, 6], packed.contacts[:, 7], rtol=1e-4)
    lost = np.loadtxt(lammps.folder / "spheres.1000.txt", skiprows=9)[:, 5]
    assert lost.sum() == pytest.approx(vector(packed.printed, "pair", 2)[1], rel=1e-4)


@pytest.mark.parametrize("losses", ["", "restitution 0.6 speed 0.5"])
def test_losses_at_walls_are_those_of_their_spheres(lammps, losses):
    """Of spheres that fall into a box and bounce: pairs and walls together."""
    solid = f"young 5e6 poisson 0.25 friction 0.4 {losses}"
    printed = lammps(
        "units si\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
        "neighbor 0.0005 bin\nregion box block 0 0.025 0 0.025 0 0.08 units box\ncreate_box 1 box\n"
        "region above block 0.003 0.022 0.003 0.022 0.003 0.077 units box\n"
        "create_atoms 1 random 60 1234 above overlap 0.005 maxtry 200 units box\n"
        "set group all diameter 0.005 density 2500\nvelocity all set 0.3 0.1 -0.3\n"
        "fix lost all property/atom d_lost_friction d_lost_viscosity\n"
        f"pair_style carom ledger yes\npair_coeff * * {solid}\nfix w all wall/carom {solid} "
        "region box\nfix 1 all nve/sphere\nfix g all gravity 9.81 vector 0 0 -1\n"
        "timestep 1e-5\ncompute of all property/atom d_lost_friction d_lost_viscosity\n"
        "compute sums all reduce sum c_of[*]\ncompute p all pair carom\n"
        "thermo_style custom step c_sums[*] c_p[2] c_p[3] f_w[5] f_w[6]\n"
        "thermo_modify norm no format float %.15g\nrun 6000\n"
    )
    rows = [line.split() for line in printed.splitlines()]
    last = next(row for row in rows if len(row) == 7 and row[0] == "6000")
    spheres, pairs, walls = np.array(last[1:], dtype=float).reshape(3, 2)
    np.testing.assert_allclose(spheres, pairs + walls, rtol=1e-12)
    assert walls[0] > 1e-2 * pairs[0] > 0.0
