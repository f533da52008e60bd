"""What `collide` gives: a record that unpacks, prints a few lines, compares, and warns."""

import pickle
import warnings
from itertools import product

import array_api_strict
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from tests.checks import BALL, PAIR as WALL

import carom
from carom.many.collisions.records import Collisions

TWO = carom.Pair(BALL, carom.Sphere(radius="8 mm", material="steel"), friction=0.2)
NAMES = ("velocity1", "spin1", "velocity2", "spin2")
UP = [0.0, 0.0, 1.0]
BAD = {"velocity1": np.ones((4, 3)), "normal": [UP, [0, 0, 2.0], [0, 0, -1.0], [0, 0, np.nan]]}
LIBRARIES = {"numpy": np, "jax": jnp, "strict": array_api_strict}
ROWS = 4  # as in BAD: jax compiles anew for every shape


def collided(library=np, rows=ROWS, **more):
    values = np.random.default_rng(2).normal(size=(rows, 3))
    inputs = {"velocity1": library.asarray(values), "normal": library.asarray(UP)}
    return carom.collide(TWO, **inputs | more)


def test_it_unpacks_as_it_always_has():
    after = collided()
    velocity1, spin1, velocity2, spin2, status = after
    unpacked = velocity1, spin1, velocity2, spin2, status
    assert all(getattr(after, n) is v for n, v in zip((*NAMES, "status"), unpacked, strict=True))
    assert after[0] is velocity1
    assert isinstance(after, tuple)
    assert len(after) == 5
    assert after._replace(status=None).status is None


@pytest.mark.filterwarnings("ignore:of .* pairs:UserWarning")
@pytest.mark.parametrize("library", LIBRARIES)
def test_it_prints_how_many_and_what_became_of_them(library):
    make = LIBRARIES[library].asarray
    inputs = {name: make(np.asarray(values, dtype=np.float32)) for name, values in BAD.items()}
    with np.errstate(invalid="ignore"):  # array-api-strict computes with NumPy
        after = carom.collide(WALL, **inputs)
    first, *rest = str(after).splitlines()
    assert first.startswith("4 collisions; velocities and spins of shape (4, 3), ")
    assert "float32" in first
    assert rest == [
        "  collided: 1",
        "  left alone: the bodies do not approach: 1",
        "  left alone: a number is not finite, or too large: 1",
        "  left alone: the normal is not a unit vector: 1",
    ]
    assert repr(after) == str(after)


def test_a_million_print_no_longer_than_one():
    many = collided(rows=1_000_000)
    assert str(many).startswith("1,000,000 collisions; ")
    assert len(str(many)) < 200
    assert str(collided(rows=1)).startswith("1 collision; ")
    assert str(collided(rows=0)) == ("0 collisions; velocities and spins of shape (0, 3), float64")


@pytest.mark.filterwarnings("ignore:of .* pairs:UserWarning")
@pytest.mark.parametrize("library", LIBRARIES)
def test_two_are_equal_if_all_their_numbers_are(library):
    """NaN equals NaN; a bit in any of the five arrays, a row more, or a shape make a difference."""
    make = LIBRARIES[library]
    one, same = collided(make), collided(make)
    assert (one == same) is True
    assert (one != same) is False
    if library != "strict":
        assert one == pickle.loads(pickle.dumps(one))
    for name in (*NAMES, "status"):
        other = np.array(np.asarray(getattr(one, name)))
        other[0] += 1
        changed = one._replace(**{name: make.asarray(other)})
        assert (one == changed) is False, name
        assert (one != changed) is True, name
    assert one != Collisions(*(make.asarray(each) for each in collided(rows=ROWS + 1)))
    assert one != one._replace(status=one.status[:1])
    if library != "strict":
        nan = one._replace(spin1=one.spin1 * np.nan)
        assert nan == nan._replace(spin1=nan.spin1 + 1.0)
        assert nan != one


@pytest.mark.parametrize("other", [None, 3, "one", (1, 2, 3, 4, 5), np.zeros(5)], ids=repr)
def test_it_equals_nothing_else(other):
    assert (collided() == other) is False
    assert (collided() != other) is True
    assert collided(np) != collided(jnp)


def test_it_has_no_hash():
    with pytest.raises(TypeError, match="unhashable"):
        hash(collided())


@pytest.mark.slow
def test_it_passes_through_jax():
    """A tree of arrays: jit, vmap and grad give it back, and what is traced can be printed."""
    printed = []

    def run(velocity):
        after = carom.collide(WALL, velocity1=velocity, normal=jnp.asarray(UP))
        printed.append(repr(after))
        assert len(after._repr_html_()) < 1000
        return after

    values = jnp.asarray(np.random.default_rng(3).normal(size=(ROWS, 3)))
    plain = run(values)
    axes = Collisions(0, 0, 0, 0, 0)
    for mapped in (run, jax.vmap(run), jax.vmap(run, out_axes=axes)):
        found = jax.jit(mapped)(values)
        assert isinstance(found, Collisions)
        assert found.status.shape == (ROWS,)
        np.testing.assert_allclose(found.velocity1, plain.velocity1, rtol=1e-6)
    slope = jax.jit(jax.grad(lambda velocity: run(velocity).velocity1.sum()))(values)
    assert slope.shape == (ROWS, 3)
    assert repr(axes) == "(0, 0, 0, 0, 0)"
    assert axes == Collisions(0, 0, 0, 0, 0)
    assert axes != Collisions(0, 0, 0, 0, 1)
    assert any("Tracer" in text for text in printed)


@pytest.mark.parametrize("library", ["numpy", "jax"])
def test_it_warns_once_of_numbers_that_cannot_be_used(library):
    """How many there are, what to do, and at the line of the caller; the others are as ever."""
    make = LIBRARIES[library].asarray
    with pytest.warns(UserWarning, match="these were left alone") as caught:
        carom.collide(WALL, **{name: make(np.asarray(values)) for name, values in BAD.items()})
    (answer,) = caught
    assert str(answer.message) == (
        "of 4 pairs these were left alone: "
        "1 whose normal is not of length one (divide it by its length); "
        "1 with a number that is not finite or too large (look for NaN); `status` says which"
    )
    assert answer.filename == __file__


def test_normals_of_another_length_are_told_with_their_number():
    """The mistake of a user who forgets to divide: all rows are left alone."""
    normal = np.random.default_rng(4).normal(size=(1000, 3))
    with pytest.warns(UserWarning, match="of 1,000 pairs .* 1,000 whose normal is not of length"):
        after = carom.collide(WALL, velocity1=np.ones((1000, 3)), normal=normal)
    assert np.all(after.status == carom.status.CollisionStatus.NORMAL_NOT_UNIT)


@pytest.mark.parametrize("library", LIBRARIES)
def test_pairs_that_separate_are_no_reason_to_warn(library):
    make = LIBRARIES[library].asarray
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        apart_and_not = np.tile([[0.0, 0.0, -1.0], [0.1, 0.0, 1.0]], (ROWS // 2, 1))
        others = () if library == "jax" else (np.zeros((0, 3)), np.array([0.1, 0.0, 1.0]))
        for velocity in (apart_and_not, *others):
            carom.collide(TWO, velocity1=make(velocity), normal=make(np.asarray(UP)))


SHAPES = [(), (1,), (2,), (0,), (2, 3), (1, 1), (3, 0)]


def read_only(values):
    values.setflags(write=False)
    return values


SECOND = {
    "none": lambda shape, dtype: None,
    "list": lambda shape, dtype: [0.25, 0.25, 0.25],
    "vector": lambda shape, dtype: np.full(3, 0.25, dtype),
    "whole": lambda shape, dtype: np.full((*shape, 3), 0.25, dtype),
    "spread": lambda shape, dtype: np.broadcast_to(dtype(0.25), (*shape, 3)),
    "read-only": lambda shape, dtype: read_only(np.full((*shape, 3), 0.25, dtype)),
}


@pytest.mark.parametrize("kind", SECOND)
@pytest.mark.parametrize(("shape", "dtype"), list(product(SHAPES, [np.float32, np.float64])))
def test_in_place_with_a_fixed_second_body(shape, dtype, kind):
    """Whatever the velocity of the wall is given as: what comes is what comes out of place."""
    velocity, spin = np.random.default_rng(5).normal(size=(2, *shape, 3)).astype(dtype)
    velocity[..., 2] = np.abs(velocity[..., 2]) + 1
    second = SECOND[kind](shape, dtype)
    more = {"velocity2": second, "normal": np.array(UP, dtype)}
    wanted = carom.collide(WALL, velocity1=velocity.copy(), spin1=spin.copy(), **more)
    mine, turning = velocity.copy(), spin.copy()
    after = carom.collide(WALL, velocity1=mine, spin1=turning, **more, inplace=True)
    assert after == wanted
    assert np.all(after.status == 0)
    assert after.velocity1.dtype == dtype
    assert after.velocity1 is mine
    assert after.spin1 is turning
    assert np.all(np.any(mine != velocity, axis=-1))
    assert second is None or np.all(np.asarray(second) == dtype(0.25))
