"""Points of sweeps: each is the impact that `carom.impact` solves, whatever is around it."""

import json
import math
import pickle

import numpy as np
import pytest

import carom
from carom import InputError
from carom.bodies.cases import losses_of, motion_of, pair_of
from carom.io.labels import labelled_dataset
from carom.many.sweeps.designs import Grid, LatinHypercube
from carom.many.sweeps.points import PointStatus
from carom.many.sweeps.problem import SweepProblem
from carom.many.sweeps.tables import Table

STUFF = {"young": 2e11, "poisson": 0.3, "density": 7800}
PAIRS = {  # the second body, and the inputs that belong to it
    "half-space": ({"material": dict(STUFF)}, ("second.material.young",)),
    "rigid": ({"material": "rigid"}, ("first.gyration_radius",)),
    "cup": ({"kind": "cup"}, ("second.radius",)),
    "sphere": (
        {"kind": "sphere", "material": dict(STUFF)},
        ("second.radius", "second.material.density", "spin2"),
    ),
    "hollow": ({"kind": "sphere"}, ("first.inner_radius", "second.gyration_radius", "spin2")),
}
RANGES = {
    "friction": (0.01, 0.6),
    "speed": (0.1, 5.0),
    "angle": (-1.5, 1.5),
    "spin": (-300.0, 300.0),
    "spin2": (-100.0, 100.0),
    "first.radius": (0.005, 0.01),
    "first.inner_radius": (0.0, 0.004),
    "first.gyration_radius": (0.001, 0.005),
    "first.material.young": (1e9, 3e11),
    "first.material.poisson": (-0.5, 0.5),
    "second.radius": (0.02, 0.05),
    "second.gyration_radius": (0.004, 0.02),
    "second.material.young": (1e9, 3e11),
    "second.material.density": (1e3, 9e3),
}
ALWAYS = ("friction", "speed", "angle", "spin", "first.radius", "first.material.young")
BALL = {"friction": 0.2, "speed": 2.0, "first": {"radius": "5 mm", "material": "steel"}}


def whole(design):
    return tuple(slice(0, n) for n in design.shape)


def solved_alone(case, point):
    """Solve a case with the inputs of a point in their places, as one impact."""
    full = json.loads(json.dumps(case))
    for name, value in point.items():
        *path, last = name.split(".")
        table = full
        for key in path:
            table = table.setdefault(key, {})
        table[last] = value
    return carom.impact(pair_of(full), **motion_of(full), losses=losses_of(full))


def designs(names, rng):
    ranges = {name: RANGES[name] for name in names}
    yield Grid({name: rng.uniform(*ranges[name], 2) for name in names})
    yield LatinHypercube(ranges, samples=40, seed=3)
    yield Table({name: rng.uniform(*ranges[name], 40) for name in names})


@pytest.mark.first_case
@pytest.mark.parametrize("kind", PAIRS)
def test_a_block_is_what_single_impacts_are(kind):
    """Every field of random points against `impact`, to rounding; the truth is the scalar code."""
    rng = np.random.default_rng(len(kind))
    second, own = PAIRS[kind]
    case = {"first": {"material": dict(STUFF)}, "second": second}
    for design in designs((*ALWAYS, "first.material.poisson", *own), rng):
        problem = SweepProblem(case, design)
        actual, inputs = problem.block(whole(design)), design.inputs(whole(design))
        assert np.all(actual["status"] == PointStatus.SOLVED)
        assert ("spin2_out" in actual) == (second.get("kind") == "sphere")
        for i in rng.permutation(actual["status"].size)[:40]:
            hit = solved_alone(case, {name: float(inputs[name][i]) for name in inputs}).scalars()
            for name in problem.outputs:
                value, scale = actual[name].flat[i], np.nanmax(np.abs(actual[name]))
                assert value == pytest.approx(hit[name], rel=1e-14, abs=1e-14 * scale), name


def test_everything_that_can_be_asked_for():
    """All results and quantities of the pair, of points given by components of the velocity."""
    from carom.impacts.outcome import PAIR, RESULTS

    axes = {"normal_speed": [0.5, 2.0], "tangential_speed": [-1.0, 0.0], "friction": [0.0, 0.3]}
    case = {"spin": 10.0, "first": BALL["first"], "second": {"material": "glass"}}
    outputs = tuple(name for name in (*RESULTS, *PAIR) if name != "friction")
    problem = SweepProblem(case, Grid(axes), outputs)
    block = problem.block((slice(0, 2),) * 3)
    for at in np.ndindex(2, 2, 2):
        point = {name: axes[name][i] for name, i in zip(axes, at, strict=True)}
        hit = solved_alone(case, point).scalars()
        for name in outputs:
            assert block[name][at] == pytest.approx(hit[name], rel=1e-14, nan_ok=True)
    assert np.isinf(block["psi_out"][..., 0]).all()  # without friction
    ratio = block["tangential_speed_out"][:, 0] / -1.0
    np.testing.assert_array_equal(block["tangential_restitution"][:, 0], ratio)
    assert np.isnan(block["tangential_restitution"][:, 1]).all()  # without tangential speed


def test_materials_and_kinds_by_name():
    """Names of materials and kinds as inputs give what the same names in a case give."""
    bodies = {"first.material": ["steel", "nylon"], "second.kind": ["cup", "sphere"]}
    grid = Grid({**bodies, "angle": [1]})
    case = {"friction": 0.1, "speed": 1, "first": {"radius": 0.01}, "second": {"radius": 0.03}}
    block = SweepProblem(case, grid).block(whole(grid))
    for i, stuff in enumerate(("steel", "nylon")):
        for j, kind in enumerate(("cup", "sphere")):
            point = {"first.material": stuff, "second.kind": kind, "angle": 1.0}
            hit = solved_alone(case, point).scalars()
            for name in ("chi", "psi_out", "max_force", "spin2_out"):
                assert block[name][i, j, 0] == pytest.approx(hit[name], rel=1e-14)


def test_the_second_body_is_as_the_first_unless_it_is_told():
    """A second sphere without radius and material follows the first one through the sweep."""
    axes = {"first.radius": ["2 mm", "7 mm"], "first.material.poisson": [0.1, 0.45]}
    case = BALL | {"angle": 0.6, "second": {"kind": "sphere"}}
    block = SweepProblem(case, Grid(axes)).block((slice(0, 2), slice(0, 2)))
    for i, radius in enumerate((0.002, 0.007)):
        for j, poisson in enumerate((0.1, 0.45)):
            steel = carom.material("steel")
            stuff = carom.Material(young=steel.young, poisson=poisson, density=steel.density)
            ball = carom.Sphere(radius=radius, material=stuff)
            hit = carom.impact(carom.Pair(ball, ball, 0.2), speed=2.0, angle=0.6)
            assert block["chi"][i, j] == pytest.approx(hit.pair.chi, rel=1e-14)
            assert block["max_force"][i, j] == pytest.approx(hit.max_force, rel=1e-14)


BAD = {  # a row with this in it -> its status
    "friction": {math.nan: "NOT_A_NUMBER", math.inf: "NOT_A_NUMBER", -0.1: "OUT_OF_RANGE"},
    "speed": {0.0: "NOT_APPROACHING", -1.0: "NOT_APPROACHING", 1e300: "BEYOND_FLOATING_POINT"},
    "angle": {math.pi / 2: "NOT_APPROACHING", -2.0: "NOT_APPROACHING", math.inf: "NOT_A_NUMBER"},
    "spin": {math.nan: "NOT_A_NUMBER", -math.inf: "NOT_A_NUMBER"},
    "first.radius": {0.0: "OUT_OF_RANGE", 0.02: "OUT_OF_RANGE", 0.001: "OUT_OF_RANGE"},
    "second.radius": {-1.0: "OUT_OF_RANGE", 1e-3: "OUT_OF_RANGE", math.nan: "NOT_A_NUMBER"},
    "first.inner_radius": {-1e-9: "OUT_OF_RANGE", 0.02: "OUT_OF_RANGE"},
    "first.material.young": {0.0: "OUT_OF_RANGE", math.nan: "NOT_A_NUMBER"},
    "first.material.poisson": {-1.0: "OUT_OF_RANGE", 0.51: "OUT_OF_RANGE"},
    "first.material.density": {0.0: "OUT_OF_RANGE", -math.inf: "NOT_A_NUMBER"},
}


def test_bad_rows_have_a_status_and_spoil_nothing():
    """A fault of each kind among a thousand rows: all others keep their bits."""
    rng = np.random.default_rng(8)
    ranges = {**RANGES, "first.inner_radius": (0.001, 0.004), "second.radius": (0.011, 0.019)}
    ranges["first.material.density"] = (1e3, 9e3)
    good = {name: rng.uniform(*ranges[name], 1000) for name in BAD}
    case = {"second": {"kind": "cup", "material": "steel"}}
    expected = SweepProblem(case, Table(good)).block((slice(0, 1000),))
    assert np.all(expected["status"] == PointStatus.SOLVED)
    faults = [(name, value, status) for name in BAD for value, status in BAD[name].items()]
    rows = rng.permutation(1000)[: len(faults)]
    bad = {name: values.copy() for name, values in good.items()}
    for row, (name, value, _) in zip(rows, faults, strict=True):
        bad[name][row] = value
    problem = SweepProblem(case, Table(bad))
    block = problem.block((slice(0, 1000),))
    others = np.setdiff1d(np.arange(1000), rows)
    for name in (*problem.outputs, "status"):
        assert np.array_equal(block[name][others], expected[name][others], equal_nan=True)
    for row, (name, value, status) in zip(rows, faults, strict=True):
        assert block["status"][row] == PointStatus[status], (name, value)
        assert all(np.isnan(block[output][row]) for output in problem.outputs)
        point = {key: float(column[row]) for key, column in bad.items()}
        with pytest.raises(InputError):  # the scalar code refuses the same
            solved_alone(case, point)


def test_two_rigid_bodies_and_names_that_are_not_known():
    table = Table(
        {"first.material": ["steel", "tseel", "rigid"], "second.kind": ["cup", "x", "cup"]}
    )
    case = {**BALL, "second": {"material": "rigid", "radius": 1.0}}
    status = SweepProblem(case, table).block((slice(0, 3),))["status"]
    bad = PointStatus.NOT_A_NUMBER  # what is rigid has no density, with which it could move
    assert status.tolist() == [PointStatus.SOLVED, bad, bad]
    table = Table({"first.material.young": [1e9, math.inf], "angle": [0.1, 0.1]})
    problem = SweepProblem({**BALL, "second": {"material": "rigid"}}, table)
    status = problem.block((slice(0, 2),))["status"]
    assert status.tolist() == [PointStatus.SOLVED, PointStatus.OUT_OF_RANGE]


@pytest.mark.slow
def test_blocks_do_not_depend_on_how_they_are_cut():
    """Any box gives the same bits, down to a single point, from a record that was pickled."""
    rng = np.random.default_rng(6)
    names = (*ALWAYS, "first.inner_radius", "spin2")
    grid = Grid({name: rng.uniform(*RANGES[name], 2 + i % 2) for i, name in enumerate(names)})
    cube = LatinHypercube({name: RANGES[name] for name in names}, samples=101)
    case = {"first": {"material": dict(STUFF)}, "second": {"kind": "sphere"}}
    losses = ({}, {"restitution": 0.8}, {"loss_time": 1e-6}, {"yield_velocity": 0.1})
    for design, loss in ((grid, {}), *((cube, loss) for loss in losses)):
        problem = SweepProblem(case | loss, design)
        together = problem.block(whole(design))
        problem = pickle.loads(pickle.dumps(problem))
        for _ in range(5):
            ends = [sorted(rng.choice(n + 1, 2, replace=False)) for n in design.shape]
            box = tuple(slice(int(a), int(b)) for a, b in ends)
            for name, values in problem.block(box, threads=2).items():
                assert np.array_equal(values, together[name][box], equal_nan=True), name


def test_variables_are_what_a_block_returns():
    """Names, types and a dataset with units; the status counts through its meanings."""
    design = Table({"first.radius": [0.001, 0.002], "first.material": ["steel", "glass"]})
    problem = SweepProblem({**BALL, "angle": 0.3}, design, ["rebound_angle"])
    block, by_name = problem.block((slice(0, 2),)), problem.variables()
    assert {name: values.dtype for name, values in block.items()} == {
        name: np.dtype(info.dtype) for name, info in by_name.items()
    }
    entries = {name: (design.dims, block[name], by_name[name].attributes) for name in block}
    dataset = labelled_dataset(entries, design._coords(), {})
    assert dataset["first_radius"].units == "m"
    assert dataset["first_material"].flag_meanings == "unreadable steel glass"
    assert list(dataset["status"].flag_values) == [int(status) for status in PointStatus]
    assert (PointStatus.NOT_RUN, PointStatus.SOLVED.message) == (-1, "solved")


def test_descriptions_are_equal_for_equal_sweeps_only():
    grid = {"angle": ["30 deg"]}
    same = {**BALL, "speed": "2 m/s", "spin": 0, "angle": 1.0}
    one = SweepProblem(BALL, Grid(grid))
    two = SweepProblem(same, Grid({"angle": [math.radians(30.0)]}))
    assert json.dumps(one.description(), allow_nan=False) == json.dumps(two.description())
    for case, axes, outputs in (
        *(({**BALL, "spin": 1.0}, grid, None), (BALL, {"angle": ["31 deg"]}, None)),
        *((BALL, grid, ["psi_out"]), ({**BALL, "second": {"kind": "sphere"}}, grid, one.outputs)),
        ({**BALL, "second": {"material": "rigid"}}, grid, None),
    ):
        assert SweepProblem(case, Grid(axes), outputs).description() != one.description()


ANGLE = Grid({"angle": [0.1, 0.2]})


@pytest.mark.parametrize(
    ("case", "design", "outputs", "message"),
    [
        ({}, ANGLE, None, "friction: missing"),
        ({**BALL, "first": {"radius": 1}}, ANGLE, None, "first.material.young: missing"),
        ({**BALL, "speed": None}, ANGLE, None, "speed: missing"),
        ({**BALL, "speeed": 1}, ANGLE, None, "speeed: unknown key; did you mean 'speed'"),
        ({**BALL, "normal_speed": 1}, ANGLE, None, "not both"),
        (BALL, Grid({"normal_speed": [1]}), None, "not both"),
        ({**BALL, "friction": -1}, ANGLE, None, "friction: -1"),
        ({**BALL, "second": {"kind": "cup"}}, ANGLE, None, "second.radius: missing"),
        ({**BALL, "second": {"kind": "cup", "radius": 1e-3}}, ANGLE, None, "cannot take"),
        (BALL, Grid({"second.radius": [1]}), None, "second.radius: a half-space has none"),
        (BALL, Grid({"spin2": [1]}), None, "spin2: a half-space has none"),
        ({**BALL, "spin2": 3.0}, ANGLE, None, "spin2: a half-space has none"),
        (BALL, ANGLE, ["max_forc"], "outputs: 'max_forc' .*did you mean 'max_force'"),
        (BALL, ANGLE, "psi_out", "outputs: 'psi_out' .*list"),
        (BALL, ANGLE, ["psi_out", "psi_out"], "there already"),
        (BALL, {"angle": [1]}, None, "design: .*Grid"),
        ([], ANGLE, None, "case: "),
    ],
)
def test_what_is_no_sweep_is_refused_in_a_line(case, design, outputs, message):
    with pytest.raises(InputError, match=message):
        SweepProblem(case, design, outputs)
