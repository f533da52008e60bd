"""Clumps in LAMMPS, by `fix rigid`, that are struck off their centre, against carom.impact."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import carom
from carom.dimensionless.numerics.hertz import DURATION

pytestmark = pytest.mark.engine
RADIUS, SHALLOW, STEPS = 5e-3, 1e-6, 400  # d_max/R; steps in the shortest contact
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
WALL = carom.HalfSpace(material=STEEL)
BALL = carom.Body(curvature_radius=0.02, material=STEEL)
TWO = np.array([(0.0, 0.0, 0.0), (0.0, 0.0, 6e-3)])
ROW = np.array([(0.0, 0.0, -8e-3), (0.0, 0.0, 0.0), (0.0, 0.0, 8e-3)])
CORNER = np.array([(0.0, 0.0, 0.0), (7e-3, 0.0, 0.0), (0.0, 6e-3, 2e-3)])
MARGIN = 1.04  # of the depth that springs are laid for, that of the whole mass struck centrally
MATERIAL = "young 210e9 poisson 0.3 friction"
ON_WALL = f"region w plane 0 0 0 0 0 1\nfix w all wall/carom {MATERIAL} {{}} region w\n"


def strikes(centres, friction, second):
    """Return pairs, places of spheres from the centre of mass, V_n, velocities and spins before.

    In a plane, at five angles: from psi_1 = -6 to 6; in space in random directions. V_n is such
    that d_max/R is the same in all.
    """
    rng, psi, pairs, places = np.random.default_rng(3), np.linspace(-6.0, 6.0, 13), [], []
    if centres is CORNER:
        turns, psi = Rotation.random(24, rng), rng.uniform(-4.0, 4.0, (24, 2))
        given = [{"centres": centres, "orientation": turn} for turn in turns]
    else:
        angles, psi = (each.ravel() for each in np.meshgrid(np.radians([10, 25, 40, 55, 80]), psi))
        turns, psi = Rotation.from_euler("y", angles[:, np.newaxis]), np.outer(psi, (1.0, 0.0))
        given = [{"centres": centres[:, [0, 2]], "angle": angle} for angle in angles]
    for turn, of_clump in zip(turns, given, strict=True):
        clump = carom.shapes.clump(**of_clump, radii=RADIUS, material=STEEL)
        pairs.append(carom.Pair(clump, second, friction))
        places.append(turn.apply(centres - centres.mean(axis=0)))
    depths = np.array([pair.scales(0.5).length for pair in pairs])
    speed = 0.5 * (SHALLOW * RADIUS / depths) ** 1.25
    spin = rng.uniform(-0.5, 0.5, (len(pairs), 3)) * (speed / RADIUS)[:, np.newaxis]
    spin[:, ::2] *= centres is CORNER
    along = psi * (friction * speed / pairs[0].kappa)[:, np.newaxis]
    velocity = np.column_stack((along, -speed)) - np.cross(spin, contacts(pairs))
    return pairs, np.array(places), speed, velocity, spin


def contacts(pairs):
    return np.array([pair.first.place for pair in pairs])


def simulated(lammps, struck, springs):
    """Return velocities of the centres and spins after impacts in LAMMPS, on a wall or a ball."""
    pairs, places, speed, velocity, spin = struck
    times = DURATION * np.array([p.scales(v).time for p, v in zip(pairs, speed, strict=True)])
    step, count, friction = float(times.min() / STEPS), len(places[0]), pairs[0].friction
    atoms, moves, clumps = [], [], []
    for k, lowest in enumerate(contacts(pairs)):
        above = [0.1 * k, 0.0, speed[k] * step * (2.0 + (k % 4) / 4.0)]
        for place in places[k]:
            atoms.append([1, 2.0 * RADIUS, 7850.0, *(above + place - lowest)])
            moves.append([*(velocity[k] + np.cross(spin[k], place)), *spin[k]])
            clumps.append([k + 1])
        if pairs[0].second is BALL:  # too heavy to be moved
            atoms.append([2, 0.04, 1e15, 0.1 * k, 0.0, -0.02])
            moves.append([0.0] * 6)
            clumps.append([0])
    text = f"clumps\n\n{len(atoms)} atoms\n2 atom types\n-0.1 {0.1 * len(pairs)} xlo xhi\n"
    text += "-0.1 0.1 ylo yhi\n-0.1 0.1 zlo zhi\n"
    for title, rows in (("Atoms # sphere", atoms), ("Velocities", moves), ("Molecules", clumps)):
        lines = (f"{i + 1} " + " ".join(f"{x:.17g}" for x in row) for i, row in enumerate(rows))
        text += f"\n{title}\n\n" + "\n".join(lines) + "\n"
    (lammps.folder / "clumps.data").write_text(text)
    lammps(
        "units si\natom_style sphere\ncomm_modify vel yes\nboundary f f f\nneighbor 0.001 bin\n"
        "fix m all property/atom mol ghost yes\nread_data clumps.data fix m NULL Molecules\n"
        f"group clumps type 1\npair_style carom springs {springs} precision double\n"
        f"pair_coeff * * {MATERIAL} {friction}\nneigh_modify exclude molecule/intra clumps\n"
        f"{ON_WALL.format(friction) * (pairs[0].second is WALL)}"
        f"fix 1 clumps rigid molecule\ntimestep {step!r}\nthermo_style custom step\n"
        f"run {int(2.0 * times.max() / step)}\nwrite_dump clumps custom out.txt id vx vy vz omegax "
        "omegay omegaz modify sort id format float %.17g\n"
    )
    out = lammps.dumped()[:, 1:].reshape(len(pairs), count, 6)
    return out[..., :3].mean(axis=1), out[:, 0, 3:]


def exact(pair, velocity, spin):
    """Return velocity and spin after the impact, and its largest penetration."""
    *along, normal = velocity
    if pair.is_planar:
        along, spin = along[0], -spin[1]
    hit = carom.impact(pair, normal_speed=-normal, tangential_speed=along, spin=spin)
    along, spin = hit.tangential_speed_out, hit.spin_out
    if pair.is_planar:
        along, spin = (along, 0.0), (0.0, -spin, 0.0)
    return [*along, hit.normal_speed_out], spin, hit.max_penetration


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("centres", "friction", "second", "most"),
    [
        *((TWO, 0.3, WALL, 1.05), (TWO, 0.5, BALL, 1.16), (ROW, 0.2, WALL, 1.02)),
        *((ROW, 1.5, WALL, 4.33), (CORNER, 0.3, WALL, 1.06)),
    ],
    ids=["two", "two on a ball", "row", "row that jams", "corner in space"],
)
def test_a_clump_leaves_as_exactly_as_the_law_promises(lammps, centres, friction, second, most):
    """psi_2, e, velocity and spin to 0.4/n^2 with n springs: all of them, or half of them where
    friction presses the contact deeper than they were laid for. It feeds e, to `most` here."""
    struck = pairs, _, speed, *before = strikes(centres, friction, second)
    after = zip(*map(exact, pairs, *before), strict=True)
    velocity, spin, depth = (np.array(each) for each in after)
    contact, unit = contacts(pairs), speed[:, np.newaxis]
    e = (velocity + np.cross(spin, contact))[:, 2] / speed
    assert e.max() == pytest.approx(most, rel=0.01)
    whole = [pair.first.mass / pair.normal_mass for pair in pairs]
    laid = MARGIN * SHALLOW * RADIUS * np.array(whole) ** 0.4
    worst = []
    for springs in (16, 32, 64):
        moved, turned = simulated(lammps, struck, springs)
        off = np.hstack([moved - velocity, RADIUS * (turned - spin)]) / unit
        at_contact = off[:, :3] + np.cross(off[:, 3:], contact / RADIUS)
        psi = at_contact[:, :2] * pairs[0].kappa / friction
        motion = np.column_stack((off, at_contact[:, 2])) / np.maximum(e, 1.0)[:, np.newaxis]
        error = np.abs(np.hstack((psi, motion))).max(axis=1)
        assert np.all(error < 0.4 / np.where(depth > laid, springs / 2, springs) ** 2)
        worst.append(error.max())
    assert worst[0] > 8.0 * worst[2]
