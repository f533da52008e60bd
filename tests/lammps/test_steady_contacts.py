"""Contacts in LAMMPS whose depth is constant to rounding, at any inclination and of any size.

Balls are led along planes and beside each other, sliding or rolling; others move freely. Two of
the planes move along themselves.
"""

from itertools import product

import numpy as np
import pytest
from tests.lammps.test_walls import HEAD

from carom.adapters import lammps as adapter

pytestmark = pytest.mark.engine
YOUNG, FRICTION, DENSITY, GRAVITY = 1e6, 0.3, 1e3, 9.81
MODULUS = YOUNG / (2.0 * (1.0 - 0.3**2))
SOLID = f"young {YOUNG} poisson 0.3 friction {FRICTION}"
HERTZ = (
    f"hertz/material {YOUNG} 0.0 0.3 tangential linear_nohistory 0.0 {FRICTION} damping velocity"
)
SLOPES = np.radians([0, 0, 0, 0, 0, 0, 10, 20])[:, None]  # of planes against gravity
ON_EACH, PAIRS = 12, 24
LED = np.tile(np.arange(ON_EACH) < 8, len(SLOPES))[:, None]
ROLLS = np.tile(np.arange(ON_EACH) % 2 == 1, len(SLOPES))[:, None]


def size(vectors):
    return np.linalg.norm(vectors, axis=-1, keepdims=True)


def units(rng, count):
    directions = rng.normal(size=(count, 3))
    return directions / size(directions)


def aside(rng, normal):
    """Return vectors of length 0.3 to 1 at right angles to others."""
    across = np.cross(normal, units(rng, len(normal)))
    return across / size(across) * rng.uniform(0.3, 1.0, (len(normal), 1))


def anything(rng, least, most, *shape):
    return np.exp(rng.uniform(np.log(least), np.log(most), (*shape, 1)))


class Balls:
    """Those on planes, then both of each pair; `slide` is that of their contact points."""

    def __init__(self, rng):
        self.origins = 10.0 * np.argwhere(np.ones((2, 2, 2)))
        self.normals = units(rng, len(SLOPES))
        falls = np.cross(self.normals, [0.0, 0.0, 1.0])
        falls /= size(falls)
        self.pulls = GRAVITY * (np.sin(SLOPES) * falls - np.cos(SLOPES) * self.normals)
        beside = 0.8 * aside(rng, self.normals)[:, None] * np.arange(ON_EACH)[:, None]
        n = self.normals.repeat(ON_EACH, axis=0)
        radius = np.where(LED, *(anything(rng, least, 0.1, len(n)) for least in (1e-3, 1e-2)))
        pressure = np.pi * DENSITY * GRAVITY * np.cos(SLOPES).repeat(ON_EACH, axis=0)
        rests = (pressure * radius**2.5 / MODULUS) ** (2.0 / 3.0)
        depth = np.where(LED, radius * anything(rng, 1e-5, 1e-2, len(n)), rests)
        place = (self.origins[:, None] + beside).reshape(-1, 3) + (radius - depth) * n
        self.drift = np.where(np.arange(len(SLOPES)) < 2, aside(rng, self.normals).T, 0.0).T
        velocity = aside(rng, n)
        slide = np.where(LED, aside(rng, n), velocity) * ~ROLLS
        spin = np.cross(n, velocity - slide) / (radius - 0.5 * depth)
        moved = velocity + self.drift.repeat(ON_EACH, axis=0)
        on_planes = radius, place, moved, spin, n, slide

        n, place = units(rng, PAIRS), np.arange(PAIRS)[:, None] * [1.0, 0.0, 0.0] + [0.0, 5.0, 5.0]
        radius, other = anything(rng, 1e-3, 0.1, 2, PAIRS)
        depth = np.minimum(radius, other) * anything(rng, 1e-5, 1e-2, PAIRS)
        slide, by_one = aside(rng, n) * (np.arange(PAIRS) % 2)[:, None], aside(rng, n)
        spin, turn = np.cross(n, by_one), np.cross(n, -slide - by_one)
        spin, turn = spin / (radius - 0.5 * depth), turn / (other - 0.5 * depth)
        velocity, across = np.ones_like(n), place - (radius + other - depth) * n
        one = radius, place, velocity, spin, n, slide
        two = other, across, velocity, turn, -n, -slide
        self.radius, self.place, self.velocity, self.spin, self.normal, self.slide = map(
            np.concatenate, zip(on_planes, one, two, strict=True)
        )
        self.free = np.pad(~LED[:, 0], (0, 2 * PAIRS))

    def data(self):
        """Return them as a data file of LAMMPS."""
        text = f"balls\n\n{len(self.radius)} atoms\n1 atom types\n"
        text += "".join(f"-20 40 {axis}lo {axis}hi\n" for axis in "xyz")
        made = np.hstack([2.0 * self.radius, np.full_like(self.radius, DENSITY), self.place])
        for head, table in (
            ("Atoms # sphere", np.insert(made, 0, 1.0, axis=1)),
            ("Velocities", np.hstack([self.velocity, self.spin])),
        ):
            rows = (" ".join(f"{each:.17g}" for each in row) for row in table)
            text += f"\n{head}\n\n" + "".join(f"{k} {row}\n" for k, row in enumerate(rows, 1))
        return text

    def input(self, precision, losses, part):
        """Return what LAMMPS is to do with them."""
        free = " ".join(str(k + 1) for k in np.flatnonzero(self.free))
        text = f"{HEAD}newton off\nneighbor 0.001 nsq\natom_modify sort 0 0\n"
        text += f"read_data balls.data\ngroup free id {free}\ngroup led subtract all free\n"
        style, wall = f"carom part {part} precision {precision}", ""
        if part == "all":
            text += f"pair_style {style}\npair_coeff * * {SOLID}{losses}\n"
        else:
            text += f"pair_style hybrid/overlay granular {style}\npair_coeff * * granular {HERTZ}\n"
            text += f"pair_coeff * * carom {SOLID}{losses}\n"
            wall = f"wall/gran/region granular {HERTZ} region r"
        for k, row in enumerate(np.hstack([self.origins, self.normals, self.pulls])):
            *plane, x, y, z = row.tolist()
            for axis, speed in zip("xyz", self.drift[k].tolist(), strict=True):
                text += f"variable {axis}{k} equal {speed!r}*step*dt\n"
            moves = f"move v_x{k} v_y{k} v_z{k}" if np.any(self.drift[k]) else ""
            text += f"region r{k} plane {' '.join(map(repr, plane))} {moves}\n"
            text += f"group on{k} id {ON_EACH * k + 1}:{ON_EACH * (k + 1)}\n"
            text += f"group free{k} intersect on{k} free\n"
            text += f"fix w{k} on{k} wall/carom {SOLID}{losses} region r{k}\n"
            text += f"fix n{k} on{k} {wall}{k}\n" if wall else ""
            text += f"fix g{k} free{k} gravity {GRAVITY} vector {x!r} {y!r} {z!r}\n"
        text += "fix 1 free nve/sphere\nfix 2 led move variable NULL NULL NULL v_x v_y v_z\n"
        text += "".join(f"variable {axis} atom v{axis}\n" for axis in "xyz")
        text += "dump 1 all custom 10 out.txt x y z vx vy vz omegax omegay omegaz fx fy fz\n"
        return text + "dump_modify 1 sort id format float %.17g\ntimestep 2e-5\nrun 300\n"

    def frictions(self, forces):
        """Return friction against the slide, and aside from it, as parts of its limit."""
        way = self.slide / np.maximum(size(self.slide), 1e-300)
        normal = np.sum(forces * self.normal, axis=-1, keepdims=True)
        friction = (forces - normal * self.normal) / (FRICTION * normal)
        brakes = -np.sum(friction * way, axis=-1)
        return brakes, size(friction + brakes[..., None] * way)[..., 0]

    def energies(self, places, velocities, spins):
        """Return that of each free ball, seen from its plane, but not what shear stores."""
        free, plane = self.free, np.flatnonzero(self.free) // ON_EACH
        above = np.sum((places - self.origins[plane]) * self.normals[plane], axis=-1)
        falls = np.sum((places - places[0]) * self.pulls[plane], axis=-1)
        radius = self.radius[free, 0]
        velocities = velocities - self.drift[plane]
        twice = np.sum(velocities**2 + 0.4 * radius[:, None] ** 2 * spins**2, axis=-1)
        hertz = 8.0 / 15.0 * MODULUS * np.sqrt(radius) * (radius - above) ** 2.5
        return 4.0 / 3.0 * np.pi * DENSITY * radius**3 * (0.5 * twice - falls) + hertz


def dumped(folder, count):
    """Return places, velocities, spins and forces, one in ten steps."""
    lines = (folder / "out.txt").read_text().splitlines()
    rows = " ".join(line for line in lines if line.count(" ") == 11).split()
    return np.array(rows, dtype=float).reshape(-1, count, 4, 3).transpose(2, 0, 1, 3)


@pytest.fixture(scope="module", params=["fused", "separate"])
def folder(request, plugin, tmp_path_factory):
    """The plugin for this processor, and one whose products and sums are rounded each."""
    if request.param == "fused":
        return plugin
    plain = ("-O0", "-ffp-contract=off")
    return adapter.build(adapter.installed(), tmp_path_factory.mktemp("plain"), plain).path.parent


@pytest.mark.slow
def test_friction_brakes_and_nothing_gains_energy(lammps, folder):
    """In single and double precision, elastic or not, whole or beside granular."""
    balls = Balls(np.random.default_rng(47))
    free, slides = balls.free, np.any(balls.slide, axis=-1)
    level = (SLOPES[:, 0] == 0.0).repeat(ON_EACH)[~LED[:, 0]]
    still = ~np.pad(np.any(balls.drift, axis=-1).repeat(ON_EACH), (0, 2 * PAIRS))
    (lammps.folder / "balls.data").write_text(balls.data())
    for kind in product(("single", "double"), ("", " retardation 1e-3"), ("all", "tangential")):
        printed = lammps.fails(balls.input(*kind), LAMMPS_PLUGIN_PATH=str(folder))
        assert "ERROR" not in printed, printed[-800:]
        *motion, forces = dumped(lammps.folder, len(free))
        brakes, aside = balls.frictions(forces[1:])  # walls begin to move in the first step
        assert brakes[:, slides & ~free].min() > 0.0, kind
        np.testing.assert_allclose(brakes[-1, slides & ~free], 1.0, atol=2e-7, err_msg=kind)
        late = 15 if kind[1] else 0  # velocities of dashpots lag, of walls that begin to move, too
        assert aside[late:, (still | slides) & ~free].max() < 5e-5, kind  # all of it if balls roll
        energy = balls.energies(*(each[1:, free] for each in motion))
        assert np.all(energy <= energy[0] * (1.0 + 1e-9)), kind
        gained = np.diff(energy, axis=0) / energy[0]  # not by what shear had stored
        assert gained[:, level].max() < 1e-9, kind
