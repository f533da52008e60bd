"""What `collide` and its laws take and refuse: a refusal is one line that names the argument."""

import numpy as np
import pytest
from tests import checks
from tests.checks import BALL, PAIR as WALL

import carom

SHELL = carom.Sphere(radius="8 mm", material="soda-lime-glass", inner_radius="7 mm")
PAIR = carom.Pair(BALL, SHELL, friction=0.2)
NAMES = ("velocity1", "spin1", "velocity2", "spin2")
ONE = {"velocity1": [1.0, 0.0, 1.0], "normal": [0.0, 0.0, 1.0]}


def motion(*shape):
    rng = np.random.default_rng(1)
    values = {name: rng.normal(size=(*shape, 3)) for name in NAMES}
    normal = rng.normal(size=(*shape, 3))
    return values | {"normal": normal / np.linalg.norm(normal, axis=-1, keepdims=True)}


def refused(name, pair=PAIR, **keywords):
    checks.refused(f"^{name}: ", carom.collide, pair, **(ONE | keywords))


@pytest.mark.parametrize("name", ["velocity1", "spin1", "velocity2", "spin2", "normal"])
@pytest.mark.parametrize(
    "values",
    [1.0, [], [1.0, 2.0], np.zeros((3, 1)), "fast", [["a", "b", "c"]], [[1j, 0.0, 0.0]],
     [[True, False, True]], [[1.0, 2.0, 3.0], [1.0, 2.0]], [[None, 1.0, 2.0]], {"x": 1.0}],
)  # fmt: skip
def test_refuses_what_are_no_vectors(name, values):
    """Not of shape (..., 3), not real, ragged."""
    refused(name, **{name: values})


def test_refuses_what_does_not_fit_together():
    """Missing arguments, shapes that do not broadcast, the spin of a wall, another pair's law."""
    refused("velocity1", velocity1=None)
    refused("normal", normal=None)
    refused("shapes", velocity1=np.zeros((4, 3)), spin2=np.zeros((2, 3)))
    refused("spin2", pair=WALL, spin2=[0.0, 0.0, 1.0])
    refused("pair", pair="balls")
    refused("law", law=carom.laws.ReboundLaw(1.0))
    refused("law", pair=WALL, law=carom.laws.ReboundLaw(PAIR.chi))


@pytest.mark.parametrize("law", ["rough", 0.5, carom.laws.RoughLaw, np.array([1.0, 2.0])])
def test_refuses_what_is_no_law(law):
    """A name, a number, a class that was not called."""
    refused("law", law=law)


@pytest.mark.parametrize("threads", [0, -1, 1.5, "two"])
def test_refuses_bad_threads(threads):
    """As `rebound` does: a whole number from 1 on."""
    refused("threads", threads=threads)


@pytest.mark.parametrize(
    "make",
    [
        *(lambda v: v.tolist(), lambda v: np.round(v).astype(int), lambda v: v.astype(np.float32)),
        *(lambda v: v.astype(">f8"), np.asfortranarray, lambda v: np.repeat(v, 2, axis=0)[::2]),
        *(lambda v: v[:1], lambda v: np.broadcast_to(v[0], v.shape)),
    ],
    ids=["list", "int", "float32", "big-endian", "fortran", "strided", "row", "broadcast"],
)
@pytest.mark.parametrize("name", NAMES)
def test_takes_any_array_but_writes_only_where_it_can(make, name):
    """The values of a copy out of place; in place a refusal, and nothing is written anywhere."""
    inputs = motion(5)
    inputs[name] = make(inputs[name])
    plain = {key: np.array(np.broadcast_to(each, (5, 3)), float) for key, each in inputs.items()}
    after, wanted = carom.collide(PAIR, **inputs), carom.collide(PAIR, **plain)
    for key in NAMES:
        assert np.array_equal(getattr(after, key), getattr(wanted, key))
        assert getattr(after, key).dtype == np.float64
    assert np.any(after.status == 0)
    before = {key: np.array(each) for key, each in inputs.items()}
    refused(name, **inputs, inplace=True)
    for key, values in before.items():
        assert np.array_equal(values, inputs[key])


def test_in_place_refuses_what_may_not_be_written():
    """Read-only arrays, and arrays that lie in one another's memory."""
    inputs = motion(5)
    inputs["spin1"].setflags(write=False)
    refused("spin1", **inputs, inplace=True)
    inputs = motion(5)
    for one, other in (("velocity1", "spin1"), ("velocity1", "velocity2"), ("spin2", "normal")):
        refused(r"\w+", **(inputs | {other: inputs[one]}), inplace=True)
    room = np.zeros((6, 3))
    refused(r"\w+", **(inputs | {"velocity1": room[:5], "spin1": room[1:]}), inplace=True)


def test_in_place_of_neighbours_in_one_block_of_memory():
    """Arrays that lie side by side in one allocation are written like any others."""
    inputs = motion(5)
    room = np.stack([inputs[name] for name in NAMES])
    wanted = carom.collide(PAIR, **inputs)
    views = dict(zip(NAMES, room, strict=True))
    carom.collide(PAIR, **views, normal=inputs["normal"], inplace=True)
    for name, values in views.items():
        assert np.array_equal(values, getattr(wanted, name))


@pytest.mark.parametrize("shape", [(), (1,), (4,), (2, 5), (2, 1, 3), (0,), (3, 0)])
def test_keeps_the_shape(shape):
    """(3,), (N, 3), (2, 5, 3), empty: results in the same shape, status without the last axis."""
    inputs = motion(*shape)
    after = carom.collide(PAIR, **inputs)
    assert np.shape(after.status) == shape
    assert np.asarray(after.status).dtype == np.int8
    flat = carom.collide(PAIR, **{name: each.reshape(-1, 3) for name, each in inputs.items()})
    for name in NAMES:
        assert getattr(after, name).shape == (*shape, 3)
        assert np.array_equal(getattr(after, name).reshape(-1, 3), getattr(flat, name))


def test_broadcasts_and_fills_in_zeros():
    """One normal for all, one velocity against many, spins left out: as if written in full."""
    values = motion(2, 5)
    few = {"velocity1": values["velocity1"], "velocity2": values["velocity2"][0, 0]}
    few["normal"] = values["normal"][:, :1]
    full = {name: np.array(np.broadcast_to(each, (2, 5, 3))) for name, each in few.items()}
    full |= {"spin1": np.zeros((2, 5, 3)), "spin2": np.zeros((2, 5, 3))}
    after, wanted = carom.collide(PAIR, **few), carom.collide(PAIR, **full)
    assert np.any(wanted.spin2 != 0.0)
    for name in (*NAMES, "status"):
        assert np.array_equal(getattr(after, name), getattr(wanted, name))


@pytest.mark.parametrize("pair", [PAIR, WALL], ids=["spheres", "wall"])
def test_out_of_place_touches_nothing(pair):
    """Inputs keep their bits, stay writable, and results are memory of their own."""
    inputs = motion(50)
    if pair is WALL:
        del inputs["spin2"]
    before = {name: each.copy() for name, each in inputs.items()}
    after = carom.collide(pair, **inputs)
    for name, values in inputs.items():
        assert values.tobytes() == before[name].tobytes()
        assert values.flags.writeable
    for name in NAMES:
        assert not any(np.shares_memory(getattr(after, name), each) for each in inputs.values())
        assert getattr(after, name).flags.writeable


def test_says_what_became_of_a_pair():
    """Each status has its words."""
    words = {status: status.message for status in carom.status.CollisionStatus}
    assert [int(status) for status in words] == [0, 1, 2, 3, 4, 5]
    assert len(set(words.values())) == 6
    with pytest.warns(UserWarning, match="of 1 pair .* 1 with a number .* too large"):
        fast = carom.collide(PAIR, velocity1=[1e200, 0.0, 1e200], normal=[0.0, 0.0, 1.0])
    assert carom.status.CollisionStatus(int(fast.status)).name == "NOT_FINITE"
    assert "too large" in words[carom.status.CollisionStatus.NOT_FINITE]


OUT_OF_RANGE = [
    *((carom.laws.SmoothLaw, "restitution", {"restitution": e}) for e in (1.1,)),
    *((carom.laws.RoughLaw, "restitution", {"restitution": e}) for e in (-0.1, float("nan"))),
    *((carom.laws.WaltonLaw, "friction", {"friction": mu}) for mu in (-0.1, np.inf)),
    (carom.laws.WaltonLaw, "restitution", {"restitution": 2.0}),
    *(
        (carom.laws.WaltonLaw, "tangential_restitution", {"tangential_restitution": beta})
        for beta in (1.01, -1.01, "most")
    ),
]


@pytest.mark.parametrize(("law", "name", "values"), OUT_OF_RANGE)
def test_laws_refuse_values_out_of_range(law, name, values):
    """One line that names the parameter."""
    others = {"friction": 0.1, "tangential_restitution": 0.0} if "Walton" in str(law) else {}
    checks.refused(f"^{name}: ", law, **(others | values))


def test_lists_take_the_type_of_the_arrays():
    """float32 velocities and a normal as a list: float32, in place, too."""
    velocity = np.array([[0.3, 0.0, 1.0]], dtype=np.float32)
    after = carom.collide(PAIR, velocity1=velocity, normal=[0.0, 0.0, 1.0])
    assert after.velocity1.dtype == np.float32
    same = carom.collide(PAIR, velocity1=velocity, normal=[0.0, 0.0, 1.0], inplace=True)
    assert same.velocity1 is velocity
    assert carom.collide(PAIR, velocity1=[[0, 0, 1]], normal=[0, 0, 1]).velocity1.dtype == float


def test_what_broadcasts_is_not_written_in_place():
    """One vector for a batch of one: the shape differs, though the memory would do."""
    with pytest.raises(carom.InputError, match=r"velocity1: .*array of shape \(1, 3\)"):
        carom.collide(
            PAIR, velocity1=np.array([0.3, 0, 1.0]), normal=np.array([[0, 0, 1.0]]), inplace=True
        )


def test_a_mask_is_not_passed_over():
    words, normal = "velocity1: .*masked arrays are not supported", [0.0, 0.0, 1.0]
    checks.refused(words, carom.collide, PAIR, velocity1=np.ma.ones((2, 3)), normal=normal)
