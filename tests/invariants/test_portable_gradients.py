"""Derivatives of rebounds and collisions by JAX and torch are those of the compiled path.

The truth is a central difference of the NumPy path, in every regime and at its ends.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tests.invariants.test_portable_collisions import LAWS

import carom

RADIUS, STEP = 0.005, 2e-7
NAMES = ("velocity1", "spin1", "velocity2", "spin2")
UNIT = dict(zip(NAMES, (1.0, RADIUS, 1.0, RADIUS), strict=True))  # all are speeds, in m/s
SLOPES = [0.0, 1e-9, 0.3, 0.97, 1.1, 1.7, 2.3, 2.95, 3.4, 4.1, 4.7, 4.9, 8.0, 300.0]
NAN, INF = float("nan"), float("inf")


def jax_gradient(function, arguments):
    jax = pytest.importorskip("jax")
    with jax.enable_x64(True):
        arrays = {name: jax.numpy.asarray(each) for name, each in arguments.items()}
        return {n: np.asarray(each) for n, each in jax.jit(jax.grad(function))(arrays).items()}


def torch_gradient(function, arguments):
    torch = pytest.importorskip("torch")
    arrays = {name: torch.tensor(each, requires_grad=True) for name, each in arguments.items()}
    function(arrays).backward()
    return {name: each.grad.numpy() for name, each in arrays.items()}


@pytest.fixture(params=[jax_gradient, torch_gradient], ids=["jax", "torch"])
def gradient(request):
    """The gradient of a number with respect to arrays by name."""
    return request.param


def pair(friction=0.3):
    ball = carom.Sphere(radius=RADIUS, material="steel")
    return carom.Pair(ball, carom.Sphere(radius=2 * RADIUS, material="steel"), friction=friction)


def motions():
    """Pairs that touch at each of the slopes psi_1, in random directions and frames."""
    draw = np.random.default_rng(5).normal
    rotations = np.linalg.qr(draw(size=(len(SLOPES), 3, 3)))[0]
    tangent, across, normal = rotations.transpose(2, 0, 1)
    spin1, spin2, frame = draw(size=(3, len(SLOPES), 3))
    spin1 -= np.sum(spin1 * normal, axis=1, keepdims=True) * normal
    speed = np.array(SLOPES)[:, np.newaxis] * 0.3 / pair().kappa * 2.0
    spun = np.cross(spin1 + 2.0 * spin2, normal)
    relative = 2.0 * normal + speed * (0.6 * tangent + 0.8 * across) - spun
    data = {
        "velocity1": frame + relative,
        "spin1": spin1 / RADIUS,
        "velocity2": frame,
        "spin2": spin2 / RADIUS,
    }
    for name in NAMES:
        data[name][0] = 0.0  # V_t = 0 to the last bit
    data["velocity1"][0], normal[0] = [0.0, 0.0, 2.0], [0.0, 0.0, 1.0]
    return data, normal


def weighted(after):
    """A number for each pair that every component of its motions enters."""
    weights = np.random.default_rng(6).normal(size=(4, 3)).tolist()
    return sum(
        weight * UNIT[name] * getattr(after, name)[:, k]
        for name, row in zip(NAMES, weights, strict=True)
        for k, weight in enumerate(row)
    )


def differences(data, normal, law):
    """Central differences, component by component; the pairs do not know of each other."""
    result = {name: np.empty_like(each) for name, each in data.items()}
    for name in NAMES:
        step = STEP / UNIT[name]
        for k in range(3):
            shift = step * np.eye(3)[k]
            ends = (data | {name: data[name] + shift}, data | {name: data[name] - shift})
            high, low = (weighted(carom.collide(pair(), **e, normal=normal, law=law)) for e in ends)
            result[name][:, k] = (high - low) / (2.0 * step)
    return result


@pytest.mark.parametrize("law", LAWS)
def test_of_collisions(gradient, law):
    """Of the motions after, with respect to those before: to 1e-6, head-on collisions included."""
    data, normal = motions()

    def number(arrays):
        return weighted(carom.collide(pair(), **arrays, normal=normal, law=LAWS[law])).sum()

    got, want = gradient(number, data), differences(data, normal, LAWS[law])
    for name in NAMES:
        assert_allclose(got[name] / UNIT[name], want[name] / UNIT[name], rtol=0, atol=1e-6)


@pytest.mark.filterwarnings("ignore:of 9 pairs these were left alone")  # torch has values to tell
def test_of_pairs_that_are_left_alone(gradient):
    """Identity for them, and never NaN, whatever is wrong with them; the others do not notice."""
    data, normal = motions()
    rows = 8
    data = {name: np.concatenate([each[3 : 3 + rows], each[3:4]]) for name, each in data.items()}
    normal = np.concatenate([normal[3 : 3 + rows], normal[3:4]])
    data["velocity1"][0] = data["velocity2"][0] - normal[0]
    data["velocity1"][1, 0] = NAN
    data["spin1"][2, 0] = INF
    data["velocity2"][3, 0] = 1e200
    normal[4] = 0.0
    normal[5, 1] = NAN
    normal[6] *= 2.0
    data["velocity1"][7] = data["velocity2"][7]
    data["spin1"][7] = data["spin2"][7] = 0.0

    def number(arrays):
        after = carom.collide(pair(), **arrays, normal=normal)
        return sum((getattr(after, name)[:rows] * 3.0).sum() for name in NAMES)

    got = gradient(number, data)
    for name in NAMES:
        assert_array_equal(got[name][:rows], 3.0)
        assert_array_equal(got[name][rows], 0.0)


def test_of_the_law(gradient):
    """d(psi_2)/d(psi_1), impulse and dissipation: as central differences, finite at psi_1 = 0."""
    law = carom.laws.ReboundLaw(1.44)
    psi = np.array([*SLOPES, *(-each for each in SLOPES)])
    for function, size in ((law, 1.0), (law.impulse, 1.0), (law.dissipation, 300.0)):
        got = gradient(lambda arrays, f=function: f(arrays["psi"]).sum(), {"psi": psi})["psi"]
        want = (function(psi + STEP) - function(psi - STEP)) / (2.0 * STEP)
        assert_allclose(got, want, rtol=0, atol=1e-6 * size)


def test_of_the_law_is_that_of_the_exact_rebound(gradient):
    """d(psi_2)/d(psi_1) to 2e-5: a table 1e-9 exact, less so in its derivative."""
    psi, step = np.array(SLOPES[2:]), 1e-3
    law = carom.laws.ReboundLaw(1.44)
    got = gradient(lambda arrays: law(arrays["psi"]).sum(), {"psi": psi})["psi"]
    ends = carom.rebound(psi[:, np.newaxis] + step * np.array([1.0, -1.0, 2.0, -2.0]), 1.44)
    one, two = ends[:, 0] - ends[:, 1], ends[:, 2] - ends[:, 3]
    assert_allclose(got, (8.0 * one - two) / (12.0 * step), rtol=0, atol=2e-5)


@pytest.mark.slow
def test_jit_and_vmap():
    """A compiled collision, and one of a single pair mapped over many, are those of NumPy."""
    jax = pytest.importorskip("jax")
    data, normal = motions()

    def collided(normal, arrays):
        after = carom.collide(pair(), **arrays, normal=normal)
        return {name: getattr(after, name) for name in (*NAMES, "status")}

    want = collided(normal, data)
    with jax.enable_x64(True):
        arrays = {name: jax.numpy.asarray(each) for name, each in data.items()}
        for way in (collided, jax.vmap(collided)):
            for name, got in jax.jit(way)(jax.numpy.asarray(normal), arrays).items():
                assert got.dtype == want[name].dtype
                assert_allclose(got, want[name], rtol=1e-12, atol=1e-12)
