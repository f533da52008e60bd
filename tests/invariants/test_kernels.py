"""Compiled kernels give what the same Python gives uncompiled."""

import json
import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from tests.checks import BALL, PAIR

import carom
from carom import dem
from carom.dimensionless.fields import peaks, subsurface
from carom.dimensionless.load_paths import turning
from carom.dimensionless.load_paths.paths import follow_path, slid
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs import march, motion
from carom.dimensionless.numerics import hertz
from carom.dimensionless.solution import solve_lossy
from carom.dimensionless.strength import cracking

IMPACTS = [(0.5, 1.44), (1.5, 1.44), (3.5, 1.44), (0.3, 1.75), (0.5, 4.0), (0.2, 0.3), (0.5, 40.0)]
VISCOUS = [(0.4, 1.44, 0.1), (3.5, 1.44, 0.4), (-6.0, 1.0, 0.2), (2.0, 4.5, 0.2115)]
MARCHED = [(1.0, 1.7, (Loss.PLASTIC, 0.3)), (-2.5, 0.8, (Loss.PLASTIC, 0.8))]
MARCHED += [(1.3, 1.4, (Loss.RELAXING, 0.5, 2.0)), (1.0, 1.7, (Loss.METAL, 0.3, 0.0, 0.004))]
SPRINGS = 24  # of marched impacts, few as Python is slow
TWO = carom.Pair(BALL, carom.Sphere(radius="3 mm", material="steel"), friction=0.2)
LAWS = [
    *(dem.LinearSpring(0.5, 0.9, 0.4), dem.LammpsMindlin("mindlin_rescale/force")),
    *(dem.LiggghtsHertz(0.7), dem.WaltonBraunLaw(restitution=0.8), dem.ThorntonLaw()),
    *(dem.ExactContactLaw(16), dem.ExactContactLaw(16, restitution=0.8)),
]


def parts(dataset, unit):
    """The numbers of a dataset without units."""
    return [(dataset[name] / unit[dataset[name].units]).values for name in dataset]


def elastic():
    """Rebounds, histories, memories, work of friction, angles of slip."""
    solutions = [carom.solve(*impact) for impact in IMPACTS]
    yield [carom.rebound(*impact) for impact in IMPACTS]
    for solution in solutions[:4]:
        yield solution.history(9).force
        yield solution.memory(2.0).q([0.01, 0.2, 0.5])
    for solution in (*solutions[:4], carom.solve(9.0, 1.44)):
        yield solution.friction_work([0.0, 0.3, 0.82, 0.97])
    yield solutions[0].pressed([0.0, 0.3, 0.82])
    yield [hertz.penetration_and_speed(t) for t in (0.1, 1.0, 1.47, 2.9)]


def contacts():
    """Fields and stresses of an impact and of load paths, in one direction and two."""
    hit = carom.impact(PAIR, speed=2.0, angle="18 deg")
    scale, time = hit.scales, hit.duration
    unit = {"Pa": scale.pressure, "m": scale.tangential_length, "m/s": 1.0, "N": scale.force}
    unit |= {"s": 1.0, "1": 1.0, "J": scale.force * scale.tangential_length}
    reach = np.array([[0.1, 0.2], [0.7, 0.5], [0.0, 1.0], [1.2, 0.3]])
    below = np.column_stack([reach, [0.0, 0.03, 0.4, 3.0]])
    reach *= hit.max_radius
    for share in (0.3, 0.6, 0.8):
        yield from parts(hit.fields(share * time, points=reach).drop_vars("zone"), unit)
    for share in (0.6, 0.8):
        profile = hit.contact(share * time).profile
        yield subsurface.stresses(below, profile, friction=0.2, poisson=0.3)
    yield [list(angle) for angle in hit.slip_angles]
    rng = np.random.default_rng(7)
    normal = rng.uniform(1.0, 9.0, 40)
    inputs = {"tangential_force": 0.2 * normal * rng.uniform(-1.0, 1.0, 40)}
    path = carom.load_path(PAIR, normal_force=normal, **inputs)
    yield from parts(path.to_dataset(), unit)
    yield from parts(path.fields(points=reach).drop_vars("zone"), unit)
    state = turning.apart(0.0, np.zeros(2), 0.0)
    for depth, moved in ((1.0, (0.5, 0.3)), (0.8, (0.1, 0.6))):
        state = turning.step(state, 1.0 / 12.0, depth, np.array(moved))
        yield from state[2:]
    d, u = rng.uniform(-0.1, 1.0, 60), rng.normal(0.0, 0.3, 60)
    moved = follow_path(d, u, np.zeros(60, dtype=bool)).results
    by_force = (d > 0.05) & (moved[:, 2] > 0.05) & (np.arange(60) % 2 == 0)
    yield moved
    yield follow_path(d, np.where(by_force, moved[:, 1], u), by_force).results
    yield slid(d, u, np.linspace(0.0, 0.8, 9))


def load():
    return subsurface.load_of(carom.solve(1.5, 1.44).memory(1.3).profile(), 0.3)


def scanned_stresses():
    places = np.array([[0.0, 0.4], [0.6, 0.0], [1.0, 0.0], [0.8, 0.2]])
    for measure in peaks.MEASURES:
        peaks.scan(measure, places, 0.4, load(), largest := np.zeros(peaks.PEAK_COLUMNS))
        yield largest


def largest_stresses():
    """The search for the largest stresses, and for the flaw that is pulled at hardest."""
    for measure in peaks.MEASURES:
        climb = measure, 0.4, load(), 0.0, np.inf, 0.1, 2e-2
        peaks.climb(*climb, largest := np.zeros(peaks.PEAK_COLUMNS))
        yield largest
    radii, top = cracking.RADII[::8], np.zeros(peaks.PEAK_COLUMNS)
    cracking.tensions(radii, 0.4, load(), along := np.zeros((radii.size, 2, cracking.TERMS)))
    cracking.hardest_among(radii, along, 0.05, hardest := np.zeros(peaks.PEAK_COLUMNS))
    cracking.climb_flaws(0.1, 2e-2, 0.05, 0.4, load(), along[0], top)
    yield from (along, hardest, top)


def lossy():
    """Impacts with losses: the work, and stick zones, which fronts decide, included."""
    for psi, chi, alpha in VISCOUS:
        solution = solve_lossy(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
        h = solution.history(7)
        yield [solution.psi_out, solution.restitution, solution.duration]
        yield [solution.max_force, solution.max_penetration]
        yield from (h.force, h.dissipated, h.normal_lost, h.stick_radius)
    for psi, chi, solid in MARCHED:
        kept, values = march.new_work(1000), (motion.Inertia(chi), motion.Solid(*solid))
        steps = march.trace(psi, 0.0, *values, SPRINGS, march.new_work(), kept)
        yield kept.rows[:steps]


def collisions(table):
    """By a table and by rules; a few pairs turn fast, or are no numbers."""
    rng = np.random.default_rng(1)
    *values, normal = rng.normal(size=(5, 600, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    motions = dict(zip(("velocity1", "spin1", "velocity2", "spin2"), values, strict=True))
    motions["spin1"][::7], motions["velocity1"][5, 0], normal[9] = 1e5, np.nan, 0.0
    for law in (
        carom.laws.ReboundLaw.from_dict(table),
        carom.laws.RoughLaw(restitution=0.8),
        carom.laws.WaltonLaw(friction=0.2, tangential_restitution=0.4),
    ):
        with np.errstate(all="ignore"), warnings.catch_warnings(action="ignore"):
            after = carom.collide(TWO, **motions, normal=normal, law=law)
        yield from map(np.nan_to_num, after)


def plate_collisions():
    """Slow and fast, with spin, and one that separates."""
    rng = np.random.default_rng(46)
    plate = carom.HalfSpace(material="steel", thickness="3 mm")
    velocity = rng.normal(size=(6, 3)) * [1.0, 1.0, 0.2] + [0.0, 0.0, 0.3]
    motions = {"velocity1": velocity, "spin1": 100.0 * rng.normal(size=(6, 3))}
    yield from carom.collide(carom.Pair(TWO.first, plate, 0.2), **motions, normal=[0.0, 0.0, 1.0])


def contact_laws():
    """Laws of DEM codes, in steps and without."""
    yield from (law.rebound([0.7, 2.5], 1.4, steps=80) for law in LAWS)
    yield from (law.rebound([0.7], 1.4) for law in (LAWS[2], LAWS[4]))


CLOSE = {elastic: 2e-13, contacts: 2e-13, scanned_stresses: 1e-13, largest_stresses: 1e-12}
CLOSE |= {lossy: 1e-12, collisions: 1e-13, plate_collisions: 1e-12, contact_laws: 1e-10}


def computed(table):
    """Return the numbers of all kinds of kernels, as lists."""
    return {
        kind.__name__: [
            np.asarray(each).tolist() for each in (kind(table) if kind is collisions else kind())
        ]
        for kind in CLOSE
    }


@pytest.mark.slow
def test_compiled_equals_uncompiled():
    """Relative, too, for collisions, whose spins are large."""
    table = carom.laws.ReboundLaw(TWO.chi).to_dict()
    program = "import json, sys; from tests.invariants.test_kernels import computed; "
    program += "json.dump(computed(json.load(sys.stdin)), sys.stdout)"
    done = subprocess.run(
        [sys.executable, "-c", program],
        input=json.dumps(table),
        env=os.environ | {"CAROM_KERNELS": "python"},
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    compiled, plain = computed(table), json.loads(done.stdout)
    for kind, close in CLOSE.items():
        relative = close if kind is collisions else 0.0
        for one, other in zip(compiled[kind.__name__], plain[kind.__name__], strict=True):
            assert np.all(np.isfinite(other)), kind
            np.testing.assert_allclose(one, other, rtol=relative, atol=close, err_msg=str(kind))
