"""Collisions of JAX, torch and array-api-strict arrays are those of the compiled NumPy path."""

import warnings
from typing import Any, NamedTuple

import numpy as np
import pytest

import carom

RADIUS = 0.005
NAMES = ("velocity1", "spin1", "velocity2", "spin2")
COUNT = 2000


class Library(NamedTuple):
    """How arrays of a library are made, become NumPy's, and how a function is compiled, if so."""

    make: Any
    back: Any
    compiled: Any


def plainly(function):
    return function


NUMPY = Library(np.asarray, np.asarray, plainly)


def strict():
    return Library(pytest.importorskip("array_api_strict").asarray, np.asarray, plainly)


def torch():
    return Library(pytest.importorskip("torch").tensor, lambda array: array.numpy(), plainly)


def jax():
    whole = pytest.importorskip("jax")
    return Library(whole.numpy.asarray, np.asarray, whole.jit)


@pytest.fixture(scope="module")
def double_jax():
    """JAX with float64, for the tests of this module."""
    config = pytest.importorskip("jax").config
    before = config.jax_enable_x64
    config.update("jax_enable_x64", True)
    yield
    config.update("jax_enable_x64", before)


@pytest.fixture(params=[strict, torch, jax], ids=lambda library: library.__name__)
def library(request):
    """A library whose arrays `collide` takes."""
    if request.param is jax:
        request.getfixturevalue("double_jax")
    return request.param()


def ball():
    return carom.Sphere(radius=RADIUS, material="steel")


def against_sphere(friction=0.3):
    large = carom.Sphere(radius=2 * RADIUS, material="steel")
    return carom.Pair(ball(), large, friction=friction)


def against_half_space(friction=0.3):
    return carom.Pair(ball(), carom.HalfSpace(material="steel"), friction=friction)


def motions(pair):
    """Random collisions of every regime, a few of them of a kind of its own."""
    draw = np.random.default_rng(20).normal
    normal = draw(size=(COUNT, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    inputs = {
        "velocity1": draw(size=(COUNT, 3)) + normal,
        "spin1": draw(size=(COUNT, 3)) / RADIUS,
        "velocity2": draw(size=(COUNT, 3)),
        "spin2": draw(size=(COUNT, 3)) / RADIUS,
        "normal": normal,
    }
    for name in NAMES:  # head-on, spins along the normal: V_t is rounding
        inputs[name][:20] = normal[:20] * (1.0 if name == "velocity1" else -0.5)
    inputs["normal"][20], inputs["velocity1"][20] = [0.0, 0.0, 1.0], [0.0, 0.0, 3.0]
    for name in ("spin1", "velocity2", "spin2"):  # V_t = 0 exactly
        inputs[name][20] = 0.0
    inputs["normal"][21:40] *= 1.0 + 3e-6  # made up for
    for name in NAMES:  # grazing: V_t/V_n is beyond any number
        inputs[name][49] = [100.0, 0.0, 1e-307] if name == "velocity1" else 0.0
    inputs["normal"][49] = [0.0, 0.0, 1.0]
    if not isinstance(pair.second, carom.Sphere):
        del inputs["spin2"]
    return inputs


def spoiled(inputs):
    """The same, some of them beyond use: not finite, with a normal that is none, apart."""
    inputs = {name: values.copy() for name, values in inputs.items()}
    inputs["velocity1"][40, 1] = np.nan
    inputs["spin1"][41, 2] = -np.inf
    inputs["velocity2"][42, 0] = np.inf
    inputs["normal"][43, 0] = np.nan
    inputs["normal"][44] = 0.0
    inputs["normal"][45] *= 2.0
    inputs["velocity1"][46] = inputs["velocity2"][46]  # V_n = 0
    inputs["velocity1"][47] = inputs["velocity2"][47] = [-0.0, 0.0, -0.0]
    inputs["velocity1"][48] *= 1e30  # beyond float32
    return inputs


def collided(library, pair, inputs, law=None, **rest):
    """Collisions of arrays of a library, each result as NumPy array."""

    def run(arrays):
        after = carom.collide(pair, **arrays, **rest, law=law)
        return {name: getattr(after, name) for name in (*NAMES, "status")}

    after = library.compiled(run)({name: library.make(each) for name, each in inputs.items()})
    return {name: library.back(each) for name, each in after.items()}


def errors(after, before, inputs):
    """Differences of motions, relative to the fastest motion of the same pair."""
    size = 1.0 + sum(
        np.abs(inputs[name]).max(axis=1, keepdims=True) * (RADIUS if "spin" in name else 1.0)
        for name in NAMES
        if name in inputs
    )
    return [
        np.max(np.abs(after[name] - before[name]) / size * (RADIUS if "spin" in name else 1.0))
        for name in NAMES
    ]


LAWS = {
    "exact": None,
    "walton": carom.laws.WaltonLaw(friction=0.3, restitution=0.9, tangential_restitution=0.4),
    "rough": carom.laws.RoughLaw(restitution=0.95),
    "smooth": carom.laws.SmoothLaw(restitution=0.8),
}

CASES = [(against_sphere(), law) for law in LAWS]
CASES += [(against_half_space(), "exact"), (against_sphere(friction=0.0), "exact")]


@pytest.mark.parametrize(("pair", "law"), CASES)
def test_equals_the_compiled_path(library, pair, law):
    """To 16 eps of the fastest motion of each pair, in every regime and for every law."""
    values = motions(pair)
    want = collided(NUMPY, pair, values, LAWS[law])
    got = collided(library, pair, values, LAWS[law])
    np.testing.assert_array_equal(got["status"], want["status"])
    assert np.count_nonzero(want["status"] == 0) > COUNT // 2
    assert np.count_nonzero(want["status"] == 1) > COUNT // 20
    assert got["velocity1"].dtype == np.float64
    assert max(errors(got, want, values)) < 16 * np.finfo(float).eps


def test_single_precision_stays_single(library):
    """float32 gives float32, within 1e-5 of the double-precision result of the same numbers."""
    pair = against_sphere()
    single = {name: each.astype(np.float32) for name, each in motions(pair).items()}
    double = {name: each.astype(np.float64) for name, each in single.items()}
    got = collided(library, pair, single)
    want = collided(NUMPY, pair, double)
    assert {got[name].dtype for name in NAMES} == {np.dtype(np.float32)}
    sure = np.arange(COUNT) > 20  # head-on ones aside: their V_t is rounding
    np.testing.assert_array_equal(got["status"], want["status"])
    parts = [{name: each[sure] for name, each in one.items()} for one in (got, want, double)]
    assert max(errors(*parts)) < 1e-5


@pytest.mark.parametrize("slow", [1e-12, 1e-30])
def test_slow_motion_in_single_precision(library, slow):
    """Collisions know no scale of speed, though the squares of such speeds vanish in float32."""
    pair = against_sphere()
    fast = {name: each[50:].astype(np.float32) for name, each in motions(pair).items()}
    scaled = {name: each * np.float32(slow if name in NAMES else 1) for name, each in fast.items()}
    want = collided(NUMPY, pair, {name: each.astype(np.float64) for name, each in fast.items()})
    got = collided(library, pair, scaled)
    np.testing.assert_array_equal(got["status"], want["status"])
    up = {name: got[name].astype(np.float64) / slow for name in NAMES}
    assert max(errors(up, want, fast)) < 1e-5


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_pairs_beyond_use_are_left_alone(library, kind):
    """They get the status of the compiled path and keep every bit; the others never notice."""
    pair = against_sphere()
    values = {name: each.astype(kind) for name, each in spoiled(motions(pair)).items()}
    good = {name: each.astype(kind) for name, each in motions(pair).items()}
    both = {name: np.concatenate([values[name], good[name]]) for name in values}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # array-api-strict computes with NumPy, which warns of NaN
        got = collided(library, pair, both)
    if kind is np.float64:
        with pytest.warns(UserWarning, match="2 whose normal .* 4 with a number"):
            want = collided(NUMPY, pair, both)
        np.testing.assert_array_equal(got["status"], want["status"])
    assert got["status"].dtype == np.int8
    assert got["status"][40:48].tolist() == [2, 2, 2, 2, 3, 3, 1, 1]
    alone = got["status"] != 0
    others = (np.arange(COUNT) < 40) | (np.arange(COUNT) > 48)
    for name in NAMES:
        assert got[name][alone].tobytes() == both[name][alone].tobytes()
        np.testing.assert_array_equal(got[name][:COUNT][others], got[name][COUNT:][others])


def test_shapes_broadcast_and_what_is_left_out_is_zero(library):
    """One normal for all, no spins: as with full arrays of zeros; bodies that stand stay still."""
    pair, normal = against_half_space(), [0.0, 0.0, 1.0]
    velocity = np.array([[[1.0, 0.5, 2.0]], [[0.1, 0.0, 1.0]]])
    after = collided(library, pair, {"velocity1": velocity}, normal=normal)
    want = collided(NUMPY, pair, {"velocity1": velocity}, normal=np.array(normal))
    assert after["status"].shape == (2, 1)
    for name in NAMES:
        np.testing.assert_allclose(after[name], want[name], rtol=1e-14, atol=1e-13)
    assert not np.any(after["velocity2"])
    single = collided(library, pair, {"velocity1": velocity[0, 0]}, normal=normal)
    assert single["velocity1"].shape == (3,)
    assert single["status"].shape == ()
    np.testing.assert_allclose(single["spin1"], want["spin1"][0, 0], rtol=1e-14)


def test_lists_and_numpy_arrays_take_the_kind_of_the_others(library):
    """Whole numbers become the library's own floating-point type; the rest follows it."""
    pair, normal = against_half_space(), np.array([0.0, 0.0, 1.0])
    speeds = {"velocity1": np.float32([1, 0, 2])}
    single = collided(library, pair, speeds, normal=normal, spin1=[0, 50, 0])
    assert single["velocity1"].dtype == single["spin1"].dtype == np.float32
    whole = collided(library, pair, {"velocity1": np.array([1, 0, 2])}, normal=normal)
    assert whole["velocity1"].dtype == library.back(library.make([1.0])).dtype
    want = carom.collide(pair, velocity1=[1, 0, 2], normal=normal)
    np.testing.assert_allclose(whole["velocity1"], want.velocity1, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        (
            {"velocity1": np.zeros((5, 3)), "normal": np.zeros((4, 3))},
            r"velocity1 \(5, 3\), normal",
        ),
        ({"velocity1": np.zeros((5, 2)), "normal": np.zeros(3)}, r"velocity1: .*shape \(..., 3\)"),
        ({"velocity1": np.zeros(3) > 1, "normal": np.zeros(3)}, "velocity1: .* real number"),
        ({"velocity1": np.zeros(3), "normal": None}, "normal: missing"),
    ],
)
def test_refusals_are_those_of_numpy(library, inputs, message):
    """One line that names the argument, whatever the library; nothing is broadcast by chance."""
    for each in (library.make, np.asarray):
        arrays = {name: None if values is None else each(values) for name, values in inputs.items()}
        with pytest.raises(carom.InputError, match=message) as error:
            carom.collide(against_half_space(), **arrays)
        assert "\n" not in str(error.value)


def test_no_pairs_at_all():
    """Nothing in, nothing out, of the right shape."""
    make = strict().make
    none = carom.collide(against_half_space(), velocity1=make(np.zeros((0, 3))), normal=[0, 0, 1])
    assert none.spin2.shape == (0, 3)
    assert none.status.shape == (0,)


def test_two_libraries_at_once_are_refused(double_jax):
    """Neither is taken silently for the other; NumPy arrays beside one are."""
    velocity, normal = torch().make([1.0, 0.0, 2.0]), jax().make([0.0, 0.0, 1.0])
    with pytest.raises(carom.InputError, match="arrays: those of jaxlib and torch cannot be mixed"):
        carom.collide(against_half_space(), velocity1=velocity, normal=normal)


def test_the_oldest_standard_is_enough():
    """array-api-strict as of 2023.12, without boolean indexing and shapes that depend on data."""
    xp = pytest.importorskip("array_api_strict")
    pair, values = against_sphere(), motions(against_sphere())
    with xp.ArrayAPIStrictFlags(
        api_version="2023.12", boolean_indexing=False, data_dependent_shapes=False
    ):
        got = collided(strict(), pair, values)
        law = np.asarray(carom.laws.ReboundLaw(1.44)(xp.asarray([0.5, -6.0])))
    want = collided(NUMPY, pair, values)
    assert max(errors(got, want, values)) < 16 * np.finfo(float).eps
    np.testing.assert_array_equal(law, carom.laws.ReboundLaw(1.44)([0.5, -6.0]))
