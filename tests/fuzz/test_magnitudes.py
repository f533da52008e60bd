"""Inputs of every size: each impact is right, or it has a status, or it is refused; never NaN.

The truth for elastic bodies is the closed form of the impact in arithmetic whose exponents have no
end, with psi_2 where psi_1 is of order one. With losses it is the same impact in other units.
"""

import random

import mpmath as mp
import numpy as np
import pytest
from tests.checks import refused
from tests.oracles.large_numbers import truth

import carom

MAGNITUDES = (-300, -200, -155, -150, -120, -100, -80, -50, -30, -20, -10)
MAGNITUDES += tuple(-each for each in MAGNITUDES)
BALL = {"friction": 0.2, "normal_speed": 1.0, "tangential_speed": 0.5, "spin": 2.0}
BALL |= {"first.radius": 0.005, "first.material.young": 2.1e11, "first.material.poisson": 0.3}
BALL |= {"first.material.density": 7850.0}
BALL |= {"second.material.young": 7e10, "second.material.poisson": 0.25}
KINDS = {
    "half-space": BALL,
    "cup": BALL | {"second.radius": 0.02},
    "sphere": BALL | {"second.radius": 0.01, "second.material.density": 2500.0, "spin2": 3.0},
    "shell": BALL | {"first.inner_radius": 0.003},
    "inertia": BALL | {"first.gyration_radius": 0.003},
}
TINIEST = 1e-300  # below, floating point loses digits
SCALES = (-1000, -600, -400, -60, 60, 400, 500, 1000)  # powers of two


def points(nominal, seed, count):
    """Each input at each magnitude by itself, and so many combinations."""
    rng = random.Random(seed)
    names = [name for name in nominal if "poisson" not in name and name != "modulus_ratio"]
    for name in names:
        for power in MAGNITUDES:
            yield nominal | {name: nominal[name] * 10.0**power}
    for _ in range(count):
        chosen = rng.sample(names, rng.choice([2, 2, 3, 4]))
        yield nominal | {name: nominal[name] * 10.0 ** rng.choice(MAGNITUDES) for name in chosen}


def swept(inputs, kind="half-space"):
    columns = {name: np.array([point[name] for point in inputs]) for name in inputs[0]}
    return carom.sweep({"second": {"kind": kind}}, carom.Table(columns), progress=False)


def is_close(actual, expected, size, tolerance):
    return np.isfinite(actual) and abs(actual - expected) <= tolerance * abs(size) + TINIEST


@pytest.mark.parametrize("name", KINDS)
def test_an_impact_is_right_or_not_solved(calls, name):
    nominal, kind = KINDS[name], name if name in ("cup", "sphere") else "half-space"
    values = list(points(nominal, 1, calls // 10))
    dataset = swept(values, kind)
    status = dataset.status.values
    for place in np.flatnonzero(status == carom.status.PointStatus.SOLVED):
        point = values[place]
        changed = {key: value for key, value in point.items() if value != nominal[key]}
        with mp.workdps(40):
            for key, (expected, size) in truth(point, kind, carom.rebound).items():
                if key in dataset:
                    value = float(dataset[key].values[place])
                    assert is_close(value, expected, size, 1e-8), (changed, key, value, expected)
    assert 60 < (status == carom.status.PointStatus.SOLVED).sum() < len(values)


DIMENSIONS = {  # powers of length, time and mass
    **dict.fromkeys(("normal_speed", "tangential_speed", "rebound_speed"), (1, -1, 0)),
    **dict.fromkeys(("tangential_speed_out", "yield_velocity"), (1, -1, 0)),
    **dict.fromkeys(("spin", "spin_out"), (0, -1, 0)),
    **dict.fromkeys(("loss_time", "relaxation_time", "duration"), (0, 1, 0)),
    **dict.fromkeys(("first.radius", "max_penetration", "max_radius"), (1, 0, 0)),
    **dict.fromkeys(("first.material.young", "second.material.young", "max_pressure"), (-1, -2, 1)),
    "flow_stress": (-1, -2, 1),
    "first.material.density": (-3, 0, 1),
    "max_force": (1, -2, 1),
    **dict.fromkeys(("lost_energy", "shear_lost_energy"), (2, -2, 1)),
    **dict.fromkeys(("psi_in", "psi_out", "normal_restitution", "rebound_angle"), (0, 0, 0)),
}
LOSSES = {
    "restitution": {"restitution": 0.8},
    "loss_time": {"loss_time": 1e-6},
    "yield_velocity": {"yield_velocity": 0.1},
    "flow_stress": {"flow_stress": 4e8},
    "relaxation_time": {"relaxation_time": 1e-5, "modulus_ratio": 1.5},
}


def units_of(point):
    """Powers of two near the radius, the time in which it is passed, and the mass."""
    length, speed = np.log2(point["first.radius"]), np.log2(point["normal_speed"])
    return np.round([length, length - speed, np.log2(point["first.material.density"]) + 3 * length])


def scaled(name, value, units, sign):
    return np.ldexp(value, int(sign * np.dot(DIMENSIONS.get(name, (0, 0, 0)), units)))


@pytest.mark.parametrize("loss", LOSSES)
def test_an_impact_with_losses_is_the_same_in_other_units(calls, loss):
    count = calls // 100 if loss == "relaxation_time" else calls // 20
    source = [
        point
        for point in points(BALL | LOSSES[loss], 2, count)
        if loss != "relaxation_time" or point["modulus_ratio"] == 1.5
    ]
    units = [units_of(point) for point in source]
    with np.errstate(all="ignore"):
        other = [
            {name: float(scaled(name, value, unit, -1)) for name, value in point.items()}
            for point, unit in zip(source, units, strict=True)
        ]
    actual, twin = swept(source), swept(other)
    solved = actual.status.values == carom.status.PointStatus.SOLVED
    both = solved & (twin.status.values == carom.status.PointStatus.SOLVED)
    assert both.sum() > 60
    for name in set(DIMENSIONS) & set(actual):
        values, others = actual[name].values, twin[name].values
        assert np.isfinite(values[solved]).all(), name
        for place in np.flatnonzero(both):
            expected = scaled(name, others[place], units[place], 1)
            close = is_close(values[place], expected, expected, 1e-6)
            assert close, (name, source[place], values[place], expected)


def struck(point):
    """The same impact by itself."""
    first, second = (
        {name: point[f"{body}.material.{name}"] for name in ("young", "poisson", "density")[:count]}
        for body, count in (("first", 3), ("second", 2))
    )
    ball = carom.Sphere(radius=point["first.radius"], material=carom.Material(**first))
    wall = carom.HalfSpace(material=carom.Material(**second))
    motion = {name: point[name] for name in ("normal_speed", "tangential_speed", "spin")}
    return carom.impact(carom.Pair(ball, wall, point["friction"]), **motion)


def test_one_impact_is_that_of_the_sweep_or_refused(calls):
    """The same numbers where the sweep solves; elsewhere one line."""
    source = list(points(BALL, 3, calls // 50))
    dataset = swept(source)
    for place, point in enumerate(source):
        if dataset.status.values[place] != carom.status.PointStatus.SOLVED:
            refused("^(speed|pair|radius|material): ", struck, point)
            continue
        hit = struck(point)
        history = hit.history(5)
        turned = hit.tangential_impulse / hit.pair.first.mass / 0.4 / point["first.radius"]
        size = abs(point["spin"]) + abs(turned)
        for spin in (dataset.spin_out.values[place], float(history.spin[-1])):
            assert abs(spin - hit.spin_out) <= 1e-8 * size, point
        numbers = [item.values for item in history.data_vars.values() if item.dtype.kind == "f"]
        assert all(np.isfinite(values).all() for values in numbers), point


@pytest.mark.parametrize("friction", [0.2, 1e-90, 1e-30, 1e-12, 1e30, 1e90])
def test_collisions_scale_with_the_velocities(friction, steel_ball):
    """Twice the velocities and spins before are twice those after, down to what is denormal."""
    rng = np.random.default_rng(4)
    bead = carom.Sphere(radius="8 mm", material="glass")
    pair = carom.Pair(steel_ball, bead, friction)
    normal, velocity = rng.normal(size=(2, 50, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, np.newaxis]
    spin = 100.0 * rng.normal(size=(50, 3))
    walton = carom.laws.WaltonLaw(friction=friction, restitution=0.9, tangential_restitution=0.4)
    for law in (None, walton):
        one = carom.collide(pair, velocity1=velocity, spin1=spin, normal=normal, law=law)
        for power in SCALES:
            fast, turning = (np.ldexp(values, power) for values in (velocity, spin))
            inputs = {"velocity1": fast, "spin1": turning, "normal": normal, "law": law}
            with np.errstate(all="ignore"):
                try:
                    many = carom.collide(pair, **inputs)
                except UserWarning:  # that some are left alone
                    assert power > 500
                    continue
            assert np.array_equal(many.status, one.status)
            for before, after in zip(one[:4], many[:4], strict=True):
                size = np.abs(before).max()
                expected = np.ldexp(before, power)
                allowed = np.ldexp(1e-9 * size, power) + TINIEST
                assert np.all(np.abs(after - expected) <= allowed)


def test_ends_of_a_range_may_be_too_far_apart():
    for ends in ({"from": 1e-200, "to": 1e200, "spacing": "log"}, {"from": -1e308, "to": 1e308}):
        words = "^spin: .* too far apart"
        refused(words, carom.Grid, {"spin": {**ends, "points": 3}})
        refused(words, carom.LatinHypercube, {"spin": ends}, samples=3)
