"""Collisions conserve what physics conserves, in every frame, for any batch and thread."""

from itertools import product

import numpy as np
import pytest
from tests.closed_form.test_collisions import BALL, NAMES, PAIRS, SHELL, STEEL

import carom

PAIR, WALL = PAIRS["unequal"], PAIRS["half-space"]
WALTON = carom.laws.WaltonLaw(friction=0.3, restitution=0.9, tangential_restitution=0.4)
LOSSY = carom.laws.ReboundLaw(PAIR.chi, losses=carom.KelvinVoigt(restitution=0.8))
LAWS = [None, carom.laws.SmoothLaw(), carom.laws.RoughLaw(), WALTON, LOSSY]
EPS = np.finfo(float).eps


def random_motion(count, seed, decades=0.5):
    """Return velocities and R spins alike, over some decades, with random unit normals."""
    rng = np.random.default_rng(seed)
    size = 10.0 ** rng.uniform(-decades, decades, (4, count, 1))
    motion = dict(zip(NAMES, size * rng.normal(size=(4, count, 3)), strict=True))
    motion["spin1"] /= BALL.radius
    motion["spin2"] /= SHELL.radius
    normal = rng.normal(size=(count, 3))
    return motion | {"normal": normal / np.linalg.norm(normal, axis=1, keepdims=True)}


def all_of(after):
    return np.concatenate([getattr(after, name) for name in NAMES], axis=-1)


def same_bits(one, other):
    return all(
        getattr(one, name).tobytes() == getattr(other, name).tobytes()
        for name in (*NAMES, "status")
    )


def inertia(body):
    return body.mass, body.mass * body.gyration_ratio * body.radius**2


def energy(bodies, motion):
    total = 0.0
    for body, (v, w) in zip(bodies, (motion[:2], motion[2:]), strict=False):
        mass, moment = inertia(body)
        total = total + 0.5 * mass * np.sum(v * v, axis=1) + 0.5 * moment * np.sum(w * w, axis=1)
    return total


def size(values):
    return np.linalg.norm(values, axis=1)


def parts(after):
    return [getattr(after, name) for name in NAMES]


@pytest.mark.parametrize("law", LAWS)
def test_momentum_and_angular_momentum(law):
    """Both, about the contact and about a far origin, to 4 eps of the magnitudes that enter."""
    motion = random_motion(50_000, 1)
    v1, w1, v2, w2 = (motion[name] for name in NAMES)
    after = carom.collide(PAIR, law=law, **motion)
    (mass1, moment1), (mass2, moment2) = inertia(BALL), inertia(SHELL)
    dp1, dp2 = mass1 * (after.velocity1 - v1), mass2 * (after.velocity2 - v2)
    p1, p2 = mass1 * (size(v1) + size(after.velocity1)), mass2 * (size(v2) + size(after.velocity2))
    assert np.all(size(dp1 + dp2) <= 4 * EPS * (p1 + p2))
    turned = moment1 * (after.spin1 - w1) + moment2 * (after.spin2 - w2)
    spun = moment1 * (size(w1) + size(after.spin1)) + moment2 * (size(w2) + size(after.spin2))
    for origin in (np.zeros(3), np.array([0.3, -0.2, 0.1])):
        r1, r2 = origin - BALL.radius * motion["normal"], origin + SHELL.radius * motion["normal"]
        change = np.cross(r1, dp1) + np.cross(r2, dp2) + turned
        assert np.all(size(change) <= 4 * EPS * (size(r1) * p1 + size(r2) * p2 + spun))


@pytest.mark.parametrize(
    ("pair", "law"), [*product([PAIR], LAWS), *product([WALL], LAWS[:-1])], ids=str
)
def test_energy_never_grows(law, pair):
    """By no more than 1e-12 of itself, in 1e6 collisions, normals rounded to float32."""
    motion = random_motion(125_000, 2, decades=6)
    motion["normal"] = motion["normal"].astype(np.float32)
    bodies = [body for body in (pair.first, pair.second) if isinstance(body, carom.Sphere)]
    if len(bodies) == 1:
        motion |= {"velocity2": np.zeros(3)}
        del motion["spin2"]
    before = energy(bodies, [motion.get(name) for name in NAMES])
    after = energy(bodies, parts(carom.collide(pair, law=law, **motion)))
    assert np.all(after <= before * (1.0 + 1e-12))
    if isinstance(law, carom.laws.SmoothLaw | carom.laws.RoughLaw):
        assert np.all(after >= before * (1.0 - 1e-12))


@pytest.mark.parametrize("chi", [0.5, 4.0])
def test_energy_never_grows_where_none_is_lost(chi):
    """In stick throughout psi_2 = -psi_1; a table off by what it may be makes no energy of it."""
    wall = carom.HalfSpace(material=STEEL)
    kappa = carom.Pair(BALL, wall, friction=50.0).kappa
    radius = BALL.radius / np.sqrt(2.0 * chi / kappa - 1.0)
    ball = carom.Sphere(radius=BALL.radius, material=STEEL, gyration_radius=radius)
    pair = carom.Pair(ball, wall, friction=50.0)
    table = carom.laws.ReboundLaw(chi).to_dict()
    stick = sum(edge <= 1.0 for edge in table["edges"][1:])
    for row in table["coefficients"][:stick]:
        row[0] -= 4e-9
    law = carom.laws.ReboundLaw.from_dict(table)
    motion = {name: random_motion(20_000, 10)[name] for name in ("velocity1", "spin1", "normal")}
    after = carom.collide(pair, law=law, **motion)
    zero = np.zeros((20_000, 3))
    before = energy([ball], [motion["velocity1"], motion["spin1"], zero, zero])
    assert np.all(energy([ball], parts(after)) <= before * (1.0 + 1e-12))
    out = law(0.3 * np.array([-1.0, 1.0]))
    assert np.all(np.abs(out) <= 0.3)
    assert out == pytest.approx([0.3, -0.3], abs=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_every_frame_and_mirror_is_alike(law):
    """Rotated, boosted, mirrored, with the bodies exchanged: the same collision, to 1e-12."""
    motion = random_motion(20_000, 3)
    plain = carom.collide(PAIR, law=law, **motion)
    scale = 1e-12 * sum(size(motion[n]) * r for n, r in zip(NAMES, (1, 5e-3, 1, 8e-3), strict=True))
    units = (1.0, BALL.radius, 1.0, SHELL.radius)

    def agree(other, wanted):
        for r, one, two in zip(units, parts(other), wanted, strict=True):
            assert np.all(r * size(one - two) <= scale)

    rng = np.random.default_rng(4)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    rotated = {name: values @ turn.T for name, values in motion.items()}
    agree(carom.collide(PAIR, law=law, **rotated), [each @ turn.T for each in parts(plain)])

    boost = np.array([0.7, -0.4, 1.1])
    boosted = motion | {n: motion[n] + boost for n in ("velocity1", "velocity2")}
    moved = [each + boost * (i % 2 == 0) for i, each in enumerate(parts(plain))]
    scale = scale + 1e-12 * np.linalg.norm(boost)
    clear = np.abs(np.sum((motion["velocity1"] - motion["velocity2"]) * motion["normal"], 1)) > 1e-9
    assert np.mean(clear) > 0.999
    after = carom.collide(PAIR, law=law, **boosted)
    assert np.array_equal(after.status[clear], plain.status[clear])
    agree(after, moved)

    flip = np.array([-1.0, 1.0, 1.0])  # of vectors; of spins, which are axial, the opposite
    signs = dict.fromkeys(motion, flip) | {"spin1": -flip, "spin2": -flip}
    mirrored = {name: values * signs[name] for name, values in motion.items()}
    agree(carom.collide(PAIR, law=law, **mirrored), [getattr(plain, n) * signs[n] for n in NAMES])

    v1, w1, v2, w2, normal = motion.values()
    swapped = {"velocity1": v2, "spin1": w2, "velocity2": v1, "spin2": w1, "normal": -normal}
    back = carom.collide(carom.Pair(SHELL, BALL, friction=0.2), law=law, **swapped)
    exchanged = parts(back)[2:] + parts(back)[:2]
    for r, one, two in zip(units, exchanged, parts(plain), strict=True):
        assert np.all(r * size(one - two) <= 1e-2 * scale)


def test_separating_pairs_are_left_alone_to_the_bit():
    """Flagged, and not a bit of them changes, the signs of zeros included."""
    motion = random_motion(20_000, 5)
    motion["velocity1"][:50], motion["velocity2"][:50], motion["spin1"][:50] = -0.0, -0.0, -0.0
    motion["spin2"][:50] = -0.0
    closing = np.sum((motion["velocity1"] - motion["velocity2"]) * motion["normal"], axis=1)
    after = carom.collide(PAIR, **motion)
    apart = closing <= 0.0
    assert np.mean(apart) == pytest.approx(0.5, abs=0.05)
    assert np.array_equal(after.status == carom.status.CollisionStatus.SEPARATING, apart)
    assert np.all(after.status[~apart] == carom.status.CollisionStatus.COLLIDED)
    for name in NAMES:
        assert getattr(after, name)[apart].tobytes() == motion[name][apart].tobytes(), name
    assert np.all(np.any(after.velocity1[~apart] != motion["velocity1"][~apart], axis=1))


@pytest.mark.parametrize("law", [None, WALTON])
def test_few_bad_rows_among_many(law):
    """NaN, inf and bad normals in a few rows: those are flagged and kept, the rest is as ever."""
    clean = random_motion(300_000, 6)
    dirty = {name: values.copy() for name, values in clean.items()}
    rows = np.random.default_rng(7).choice(300_000, 400, replace=False)
    kinds = [(n, bad) for n in (*NAMES, "normal") for bad in (np.nan, np.inf, -np.inf)]
    for i, row in enumerate(rows[:300]):
        name, bad = kinds[i % len(kinds)]
        dirty[name][row, i % 3] = bad
    for i, row in enumerate(rows[300:]):
        dirty["normal"][row] *= (0.0, 1.0 + 1e-4, 1.0 - 1e-4, -2.0)[i % 4]
    wanted = carom.collide(PAIR, law=law, **clean)
    with pytest.warns(UserWarning, match="of 300,000 pairs .* 100 whose normal .* 300 with"):
        after = carom.collide(PAIR, law=law, **dirty)
    assert np.all(after.status[rows[:300]] == carom.status.CollisionStatus.NOT_FINITE)
    assert np.all(after.status[rows[300:]] == carom.status.CollisionStatus.NORMAL_NOT_UNIT)
    good = np.delete(np.arange(300_000), rows)
    assert np.array_equal(after.status[good], wanted.status[good])
    for name in NAMES:
        assert getattr(after, name)[rows].tobytes() == dirty[name][rows].tobytes()
        assert getattr(after, name)[good].tobytes() == getattr(wanted, name)[good].tobytes()


@pytest.mark.parametrize("law", [None, WALTON])
def test_threads_cuts_and_place_do_not_matter(law):
    """One, two or five threads, any cut of the batch, in place or not: the same bits."""
    motion = random_motion(200_001, 8)
    whole = carom.collide(PAIR, law=law, threads=1, **motion)
    for threads in (2, 5, None):
        assert same_bits(whole, carom.collide(PAIR, law=law, threads=threads, **motion))
    cuts = [slice(0, 1), slice(1, 258), slice(258, 70_000), slice(70_000, None)]
    parts = [{name: values[cut] for name, values in motion.items()} for cut in cuts]
    pieces = [carom.collide(PAIR, law=law, **part) for part in parts]
    assert np.concatenate([all_of(piece) for piece in pieces]).tobytes() == all_of(whole).tobytes()
    mine = {name: values.copy() for name, values in motion.items()}
    after = carom.collide(PAIR, law=law, inplace=True, **mine)
    assert same_bits(whole, after)
    for name in NAMES:
        assert np.shares_memory(getattr(after, name), mine[name])
        assert mine[name].tobytes() == getattr(whole, name).tobytes()
    assert np.array_equal(mine["normal"], motion["normal"])


def test_single_precision():
    """float32 in, float32 out: the double-precision collision of the same numbers, rounded."""
    motion = {name: v.astype(np.float32) for name, v in random_motion(50_000, 9).items()}
    single = carom.collide(PAIR, **motion)
    double = carom.collide(PAIR, **{name: v.astype(np.float64) for name, v in motion.items()})
    entered = sum(size(motion[n]) * r for n, r in zip(NAMES, (1, 5e-3, 1, 8e-3), strict=True))
    closing = np.sum((motion["velocity1"] - motion["velocity2"]) * motion["normal"], axis=1)
    clear = np.abs(closing) > 1e-6 * entered
    assert np.mean(clear) > 0.999
    assert np.array_equal(single.status[clear], double.status[clear])
    for name, radius in zip(NAMES, (1, 5e-3, 1, 8e-3), strict=True):
        one, other = getattr(single, name), getattr(double, name)
        assert one.dtype == np.float32
        assert other.dtype == np.float64
        assert np.all(radius * np.abs(one - other)[clear].max(axis=1) <= 4e-7 * entered[clear])


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("friction", [0.0, 1e-9, 0.3, 1e6])
@pytest.mark.parametrize("how", ["slides", "rolls", "grazes", "all slow"])
def test_slow_rates_make_no_energy(how, friction, kind):
    """Of sliding beside the approach, of approach beside the sliding, of all: from 1e-30 to 1."""
    rng, count = np.random.default_rng(30), 5000
    pair = carom.Pair(BALL, SHELL, friction=friction)
    normal = rng.normal(size=(count, 3))
    normal /= size(normal)[:, None]
    across = np.cross(normal, rng.normal(size=(count, 3)))
    slow = 10.0 ** rng.uniform(-30.0, 0.0, (count, 1))
    velocity, spin = normal + across, np.zeros((count, 3))
    if how == "slides":
        velocity = normal + slow * across
    elif how == "rolls":  # V_t is what is left: rounding, or slow
        spin = np.cross(across, normal) / BALL.radius * (1.0 + slow)
    elif how == "grazes":
        velocity = slow * normal + across
    else:
        velocity, spin = slow * velocity, slow * across / BALL.radius
    names = ("velocity1", "spin1", "normal")
    motion = dict(zip(names, (each.astype(kind) for each in (velocity, spin, normal)), strict=True))
    after = [each.astype(float) for each in parts(carom.collide(pair, **motion))]
    zero = np.zeros((count, 3))
    before = energy(
        (BALL, SHELL), [*(motion[name].astype(float) for name in names[:2]), zero, zero]
    )
    assert np.all(np.isfinite(after))
    assert np.all(energy((BALL, SHELL), after) <= before * (1.0 + 8.0 * np.finfo(kind).eps))
