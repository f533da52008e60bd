"""Collisions with plates are impacts on plates, each with the lambda of its own speed."""

import warnings

import array_api_strict
import numpy as np
import pytest
from tests.invariants.test_collisions import same_bits

import carom

STUFF = ("steel", "soda-lime-glass", "aluminium 7075", "nylon", "granite")
BALL = carom.Sphere(radius="5 mm", material="steel")
PLATE = carom.HalfSpace(material="steel", thickness="3 mm")
PAIR = carom.Pair(BALL, PLATE, friction=0.2)
THIN = carom.Pair(BALL, carom.HalfSpace(material="steel", thickness="1.4 mm"), friction=0.2)
UP = np.array([0.0, 0.0, 1.0])
Status = carom.status.CollisionStatus


def random_pair(rng):
    one, other = rng.choice(STUFF, 2)
    radius = 10.0 ** rng.uniform(-4.0, -1.0)
    thickness = radius * 10.0 ** rng.uniform(-1.3, 1.0)
    friction = rng.choice([0.0, 0.05, 0.2, 0.7])
    hollow = rng.uniform(0.0, 0.95) * radius
    ball = carom.Sphere(radius=radius, material=one, inner_radius=hollow)
    return carom.Pair(ball, carom.HalfSpace(other, thickness=thickness), friction=friction)


def motion(count, seed, pair=PAIR, speeds=(-3.0, 1.0), kind=float):
    """Return balls that come from all sides, slow and fast, with spins that match."""
    rng = np.random.default_rng(seed)
    speed = 10.0 ** rng.uniform(*speeds, (count, 1))
    velocity, normal = rng.normal(size=(2, count, 3))
    spin = speed * rng.normal(size=(count, 3)) * 10.0 ** rng.uniform(-1, 1, (count, 1))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    velocity *= speed * np.sign(np.sum(velocity * normal, axis=1, keepdims=True))
    moving = {"velocity1": velocity, "spin1": spin / pair.first.radius, "normal": normal}
    return {name: values.astype(kind) for name, values in moving.items()}


def meeting(pair, velocity, spin, normal):
    """Return V_n, V_t and the unit vector along V_t, which is 0 where V_t is."""
    closing = velocity @ normal
    sliding = velocity - closing * normal + pair.first.radius * np.cross(spin, normal)
    size = np.linalg.norm(sliding)
    return closing, size, sliding / (size or 1.0)


def quietly(pair, **inputs):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return carom.collide(pair, **inputs)


def test_they_are_impacts_with_units():
    """Every component of 300 collisions of as many pairs, to 1e-9 of the speeds that enter."""
    rng, statuses = np.random.default_rng(46), []
    for seed in range(300):
        pair = random_pair(rng)
        v, w, n = (values[0] for values in motion(1, seed, pair).values())
        after = quietly(pair, velocity1=v, spin1=w, normal=n)
        closing, _, along = meeting(pair, v, w, n)
        across = np.cross(n, along)
        inputs = {"tangential_speed": v @ along, "spin": np.cross(w, n) @ along}
        statuses.append(int(after.status))
        if after.status:
            assert after.status == Status.PLATE_TOO_THIN
            assert after.velocity1.tobytes() == v.tobytes()
            with pytest.raises(carom.InputError, match="thickness: "):
                carom.impact(pair, normal_speed=closing, **inputs)
            continue
        hit = carom.impact(pair, normal_speed=closing, **inputs)
        wanted = v - (v @ n) * n - (v @ along) * along  # across friction nothing changes
        wanted += hit.tangential_speed_out * along - hit.normal_restitution * closing * n
        close = 1e-9 * (np.linalg.norm(v) + pair.first.radius * np.linalg.norm(w))
        assert after.velocity1 == pytest.approx(wanted, abs=close)
        turned = np.cross(n, along)
        spun = w + (hit.spin_out - inputs["spin"]) * turned
        assert after.spin1 == pytest.approx(spun, abs=close / pair.first.radius)
        assert abs(after.velocity1 @ across - v @ across) < close
    assert 10 < np.count_nonzero(statuses) < 150


@pytest.mark.first_case
@pytest.mark.parametrize("chi", [0.45, 0.5, 1.44, 4.0])
def test_they_are_rebounds_of_the_lambda_of_each(chi):
    """e and psi_2 to 1e-9; the inertia of the ball is what gives it this chi."""
    radius = BALL.radius / np.sqrt(2.0 * chi / PAIR.kappa - 1.0)
    ball = carom.Sphere(radius=BALL.radius, material="steel", gyration_radius=radius)
    pair = carom.Pair(ball, PLATE, friction=0.2)
    assert pair.chi == pytest.approx(chi, rel=1e-12)
    moving = motion(60, 7, pair, speeds=(-4.0, 0.0))
    after = quietly(pair, **moving)
    solved = np.flatnonzero(after.status == 0)
    assert solved.size > 50
    for i in solved:
        closing, size, along = meeting(pair, *(values[i] for values in moving.values()))
        leaving = meeting(pair, after.velocity1[i], after.spin1[i], moving["normal"][i])
        give = pair.plate_give(closing)
        psi, plate = pair.psi(size, closing), carom.ZenerPlate(inelasticity=1.25**0.4 * give)
        head_on = carom.laws.ReboundLaw(0.3, losses=plate)
        assert -leaving[0] / closing == pytest.approx(head_on.restitution, abs=1e-9)
        out = pair.psi(leaving[1] * (leaving[2] @ along), closing)
        assert out == pytest.approx(carom.rebound(psi, chi, losses=plate), abs=1e-9 * max(1, psi))


@pytest.mark.parametrize("friction", [0.0, 1e-9, 0.2, 50.0])
def test_energy_never_grows(friction):
    pair = carom.Pair(BALL, PLATE, friction=friction)
    moving = motion(3000, 3, pair, speeds=(-12.0, 0.5))
    after = quietly(pair, **moving)
    mass, inertia = BALL.mass, BALL.mass * BALL.gyration_ratio * BALL.radius**2

    def energy(velocity, spin):
        return 0.5 * (mass * np.sum(velocity**2, axis=1) + inertia * np.sum(spin**2, axis=1))

    before, left = energy(*list(moving.values())[:2]), energy(after.velocity1, after.spin1)
    assert np.all(left <= before * (1.0 + 1e-12))
    closing = np.sum(moving["velocity1"] * moving["normal"], axis=1)
    e = -np.sum(after.velocity1 * moving["normal"], axis=1) / closing
    waves = 0.5 * mass * closing**2 * (1.0 - e**2)
    assert np.all(before - left >= waves - 1e-12 * before)
    if friction == 0.0:
        assert after.spin1.tobytes() == moving["spin1"].tobytes()


def test_faster_balls_lose_more():
    speed = np.geomspace(1e-6, 3.0, 50)
    after = carom.collide(PAIR, velocity1=speed[:, np.newaxis] * UP, normal=UP)
    e = -after.velocity1[:, 2] / speed
    assert np.all(np.diff(e) < 0.0)
    assert e[[0, -1]] == pytest.approx(
        [carom.impact(PAIR, speed=each).normal_restitution for each in speed[[0, -1]]], abs=1e-9
    )


def test_a_plate_without_end_is_a_thick_wall():
    """At a thickness of 1e4 radii lambda is 5e-9, and the rest is that of a wall to 1e-7."""
    plate, wall = (carom.HalfSpace(material="steel", thickness=h) for h in ("50 m", None))
    moving = motion(2000, 4, speeds=(-2.0, 0.0))
    one, other = (carom.collide(carom.Pair(BALL, body, 0.2), **moving) for body in (plate, wall))
    size = np.linalg.norm(moving["velocity1"], axis=1)[:, np.newaxis]
    size = size + BALL.radius * np.linalg.norm(moving["spin1"], axis=1)[:, np.newaxis]
    assert np.all(np.abs(one.velocity1 - other.velocity1) < 1e-7 * size)
    assert np.all(np.abs(one.spin1 - other.spin1) * BALL.radius < 1e-7 * size)


def test_each_status_leaves_bodies_as_they_are():
    velocity = np.array([UP, -UP, [np.nan, 0, 1], UP, 2.0 * UP, [-0.0, 2.0, 1e9]])
    normal = np.array([UP, UP, UP, 2.0 * UP, UP, UP])
    with pytest.warns(UserWarning, match="of 6 pairs .* 2 too fast for so thin a plate"):
        after = carom.collide(THIN, velocity1=velocity, normal=normal)
    thin = Status.PLATE_TOO_THIN
    wanted = [Status.COLLIDED, Status.SEPARATING, Status.NOT_FINITE, Status.NORMAL_NOT_UNIT]
    assert after.status.tolist() == [*wanted, thin, thin]
    assert after.velocity1[1:].tobytes() == velocity[1:].tobytes()
    assert f"{thin.message}: 2" in str(after)


def test_a_sheet_that_is_thinner_than_the_penetration():
    """A soft ball on a sheet of steel: lambda is small, but the ball goes deeper than the sheet."""
    soft = carom.Sphere(
        radius="20 mm", material=carom.Material(young=1e6, poisson=0.49, density=1000.0)
    )
    sheet = carom.HalfSpace(material="steel", thickness="0.5 mm")
    pair = carom.Pair(soft, sheet, friction=0.3)
    depths = np.array([0.9, 1.1]) * pair.thickness
    speeds = (depths / pair.scales(1.0).length) ** 1.25
    assert pair.plate_give(speeds[1]) < 2.0
    after = quietly(pair, velocity1=speeds[:, np.newaxis] * UP, normal=UP)
    assert after.status.tolist() == [Status.COLLIDED, Status.PLATE_TOO_THIN]


def test_what_is_not_solved_says_so():
    """chi of 3e5, which no ball of this world has."""
    ball = carom.Sphere(radius="5 mm", material="steel", gyration_radius="6 um")
    with pytest.warns(UserWarning, match="1 that are not solved"):
        after = carom.collide(
            carom.Pair(ball, PLATE, friction=1.0), velocity1=[1e-3, 0.0, 0.5], normal=UP
        )
    assert after.status == Status.NOT_SOLVED
    assert after.velocity1.tolist() == [1e-3, 0.0, 0.5]


def test_threads_cuts_and_place_do_not_matter():
    moving = motion(5001, 8, speeds=(-2.0, 1.0))
    whole = quietly(THIN, threads=1, **moving)
    assert 0 < np.count_nonzero(whole.status) < 4000
    for threads in (2, 5, None):
        assert same_bits(whole, quietly(THIN, threads=threads, **moving))
    first, last = ({n: v[cut] for n, v in moving.items()} for cut in (slice(257), slice(257, None)))
    parts = [quietly(THIN, **part).spin1.tobytes() for part in (first, last)]
    assert b"".join(parts) == whole.spin1.tobytes()
    mine = {name: values.copy() for name, values in moving.items()}
    assert same_bits(whole, quietly(THIN, inplace=True, **mine))
    assert mine["velocity1"].tobytes() == whole.velocity1.tobytes()


def test_single_precision():
    single = motion(2000, 9, speeds=(-2.0, 0.0), kind=np.float32)
    double = {name: values.astype(float) for name, values in single.items()}
    one, other = carom.collide(PAIR, **single), carom.collide(PAIR, **double)
    assert one.velocity1.dtype == one.spin1.dtype == np.float32
    assert np.array_equal(one.status, other.status)
    assert one.velocity1 == pytest.approx(other.velocity1, rel=1e-6, abs=1e-6)
    assert one.spin1 == pytest.approx(other.spin1, rel=1e-6, abs=1e-4)


def test_a_law_of_one_lambda_is_the_users_word():
    """On the plate and on a thick wall, in NumPy and in other arrays; to 1e-9 at its own speed."""
    plate = carom.ZenerPlate(inelasticity=1.25**0.4 * PAIR.plate_give(0.5))
    law = carom.laws.ReboundLaw(PAIR.chi, losses=plate)
    motion = {"velocity1": [[0.4, -0.1, 0.5]], "spin1": [[3.0, 0.0, 40.0]], "normal": UP.tolist()}
    solved, by_law = (carom.collide(PAIR, law=each, **motion) for each in (None, law))
    for one, other in zip(solved, by_law, strict=True):
        assert one == pytest.approx(other, abs=1e-9, rel=1e-9)
    wall = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
    assert carom.collide(wall, law=law, **motion) == by_law
    arrays = {name: array_api_strict.asarray(values) for name, values in motion.items()}
    foreign = carom.collide(PAIR, law=law, **arrays)
    assert np.asarray(foreign.velocity1) == pytest.approx(by_law.velocity1, abs=1e-14)
    fast = carom.collide(PAIR, law=law, velocity1=2.0 * UP, normal=UP)
    assert fast.velocity1[2] == pytest.approx(-2.0 * law.restitution, rel=1e-14)


@pytest.mark.parametrize(
    ("inputs", "words"),
    [
        ({"judge": True}, "judge: True .*leave judge or thickness out"),
        *(
            ({"law": law}, "law: .*the plate gives way; leave it or the thickness out")
            for law in (
                carom.laws.ReboundLaw(PAIR.chi),
                carom.laws.ReboundLaw(PAIR.chi, losses=carom.KelvinVoigt(restitution=0.9)),
                carom.laws.SmoothLaw(),
                carom.laws.WaltonLaw(friction=0.2, tangential_restitution=0.4),
            )
        ),
        ({"velocity1": array_api_strict.asarray(UP)}, "thickness: 0.003 .*a plate takes NumPy"),
    ],
)
def test_what_knows_of_no_plate_is_refused(inputs, words):
    with pytest.raises(carom.InputError, match=words) as caught:
        carom.collide(PAIR, **{"velocity1": UP, "normal": UP, **inputs})
    assert "\n" not in str(caught.value)
