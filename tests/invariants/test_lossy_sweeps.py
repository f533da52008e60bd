"""Sweeps of impacts that lose energy: each point is what `carom.impact` solves."""

import json
import math
from itertools import product

import numpy as np
import pytest
from tests.invariants.test_sweep_points import solved_alone, whole

import carom
from carom import InputError
from carom.many.sweeps.designs import Grid, LatinHypercube
from carom.many.sweeps.points import PointStatus
from carom.many.sweeps.problem import OUTPUTS, SweepProblem
from carom.many.sweeps.records import identity
from carom.many.sweeps.tables import Table

STEEL = {"young": "210 GPa", "poisson": 0.3, "density": 7850}
BALL = {"friction": 0.2, "speed": 2.0, "first": {"radius": "5 mm", "material": STEEL}}
SECONDS = {
    "half-space": {"material": "glass"},
    "sphere": {"kind": "sphere", "radius": "9 mm", "material": "aluminium"},
    "cup": {"kind": "cup", "radius": "30 mm", "material": "rigid"},
}
RANGES = {
    "friction": (0.02, 0.6),
    "speed": (0.1, 5.0),
    "angle": (-1.5, 1.5),
    "spin": (-300.0, 300.0),
    "first.material.young": (1e9, 3e11),
}
LOSSES = {"restitution": (0.3, 1.0), "loss_time": (0.0, 2e-6), "yield_velocity": (0.01, 3.0)}
LOSSES |= {"flow_stress": (5e6, 4e7)}
POINTS = 24
SOLVER = 1e-8  # what an impact with losses is solved to
ULP = 1e-10  # what the solver makes of a last bit, of powers of arrays and of numbers, at most


def require_same(problem, actual, case, at, point):
    """Every output of a point is that of `impact`, against the largest of the block."""
    hit = solved_alone(case, point).scalars()
    assert actual["status"].flat[at] == PointStatus.SOLVED
    for name in problem.outputs:
        scale = np.nanmax(np.abs(actual[name]))
        value, wanted = actual[name].flat[at], hit[name]
        assert value == pytest.approx(wanted, rel=ULP, abs=ULP * scale, nan_ok=True), name


@pytest.mark.first_case
@pytest.mark.parametrize(("loss", "kind"), list(zip(LOSSES, (*SECONDS, *SECONDS), strict=False)))
def test_a_swept_loss_gives_what_single_impacts_give(loss, kind):
    """Hypercubes and tables over five inputs and the loss, against the scalar code."""
    rng = np.random.default_rng(len(loss))
    ranges, case = RANGES | {loss: LOSSES[loss]}, BALL | {"second": SECONDS[kind]}
    cube = LatinHypercube(ranges, samples=POINTS, seed=5)
    table = Table({name: rng.uniform(*ends, POINTS) for name, ends in ranges.items()})
    for design in (cube, table):
        problem = SweepProblem(case, design)
        actual, source = problem.block(whole(design)), design.inputs(whole(design))
        assert set(problem.outputs) >= {*OUTPUTS[:3], "normal_restitution", "lost_energy"}
        for at in range(POINTS):
            point = {name: float(values[at]) for name, values in source.items()}
            require_same(problem, actual, case, at, point)


@pytest.mark.parametrize(
    "loss",
    ["restitution = 0.8", "loss_time = 1 us", "yield_velocity = 1 m/s", "flow_stress = 300 MPa"],
)
def test_a_fixed_loss_holds_at_every_point(loss):
    name, text = loss.split(" = ")
    case = BALL | {name: text}
    grid = Grid({"angle": [0.0, 0.4], "speed": ["50 cm/s", 2.0], "friction": [0.0, 0.3]})
    outputs = ["normal_restitution", "psi_out", "duration", "max_force", "chi"]
    problem = SweepProblem(case, grid, outputs)
    actual, values = problem.block(whole(grid)), grid.inputs(whole(grid))
    for at in range(8):
        require_same(problem, actual, case, at, {key: float(v[at]) for key, v in values.items()})
    if name == "restitution":
        assert np.max(np.abs(actual["normal_restitution"] - 0.8)) < SOLVER


BAD = {
    "restitution": {1.001: 2, 0.0009: 2, -0.5: 2, math.nan: 1, math.inf: 1},
    "loss_time": {-1e-9: 2, math.nan: 1, math.inf: 1, 1.0: 6},
    "yield_velocity": {0.0: 2, -1.0: 2, math.nan: 1, math.inf: 1},
    "flow_stress": {0.0: 2, -1.0: 2, math.nan: 1, math.inf: 1},
}


@pytest.mark.parametrize("loss", LOSSES)
def test_bad_rows_have_a_status_and_spoil_nothing(loss):
    """2 out of range, 1 not a number, 6 not resolved; the scalar code refuses the same."""
    rng = np.random.default_rng(4)
    good = {name: rng.uniform(*ends, 20) for name, ends in (RANGES | {loss: LOSSES[loss]}).items()}
    expected = SweepProblem(BALL, Table(good)).block((slice(0, 20),))
    bad = {name: values.copy() for name, values in good.items()}
    rows = rng.permutation(20)[: len(BAD[loss])]
    bad[loss][rows] = list(BAD[loss])
    problem = SweepProblem(BALL, Table(bad))
    actual, others = problem.block((slice(0, 20),)), np.setdiff1d(np.arange(20), rows)
    for name in (*problem.outputs, "status"):
        assert actual[name][others].tobytes() == expected[name][others].tobytes(), name
    assert actual["status"][rows].tolist() == list(BAD[loss].values())
    for row in rows:
        assert all(np.isnan(actual[name][row]) for name in problem.outputs)
        with pytest.raises(InputError):
            solved_alone(BALL, {name: float(values[row]) for name, values in bad.items()})


@pytest.mark.parametrize("loss", ["yield_velocity", "flow_stress"])
def test_the_yield_strengths_of_the_materials(loss):
    """By name and by number, the softer of two yielding first; NaN where no strength is known."""
    case = {"friction": 0.2, "speed": 3.0, "angle": 0.5, loss: "material"}
    names = ["aluminium-6061", "bearing-steel", "glass"]
    grid = Grid({"first.material": names, "second.material": names, "first.radius": [0.001, 0.02]})
    problem = SweepProblem(case, grid, ["normal_restitution", "psi_out"])
    actual, values = problem.block(whole(grid)), grid.inputs(whole(grid))
    assert carom.material("glass").yield_strength is None
    for at in range(18):
        first, second = (names[values[f"{body}.material"][at]] for body in ("first", "second"))
        if (first, second) == ("glass", "glass"):
            assert actual["status"].flat[at] == PointStatus.NOT_A_NUMBER
            continue
        point = {"first.material": first, "second.material": second}
        point["first.radius"] = float(values["first.radius"][at])
        require_same(problem, actual, case, at, point)
    soft = {"young": 7e10, "poisson": 0.3, "density": 2700, "yield_strength": "200 MPa"}
    case |= {"first": {"radius": "5 mm", "material": soft}}
    grid = Grid({"first.material.poisson": [0.2, 0.4]})
    for at, poisson in enumerate((0.2, 0.4)):
        one = SweepProblem(case, grid)
        point = {"first.material": soft | {"poisson": poisson}}
        require_same(one, one.block((slice(0, 2),)), case, at, point)


def test_descriptions_tell_losses_apart_and_leave_elastic_sweeps_as_they_were():
    """That of an elastic sweep is, word for word, what stores had before there were losses."""
    grid = Grid({"angle": [0.5], "first.material": ["steel"]})
    case = {"friction": 0.2, "speed": 2.0, "first": {"radius": 0.005}}
    elastic = SweepProblem(case, grid, ["psi_out"])
    steel = {"label": "steel", "young": 210e9, "poisson": 0.3, "density": 7850.0}
    plain = {"first.radius": 0.005, "friction": 0.2, "speed": 2.0}
    axes = {"angle": [0.5], "first.material": [steel]}
    assert identity(elastic) == {
        "case": dict.fromkeys(("spin", "spin2", "tangential_speed"), 0.0) | plain,
        "second": ["half-space"],
        "design": {"kind": "grid", "order": [*axes], "axes": axes},
        "outputs": ["psi_out"],
    }
    losses = ({}, {"restitution": 0.9}, {"restitution": 0.8}, {"loss_time": 1e-6})
    losses += ({"yield_velocity": 0.1}, {"yield_velocity": "material"})
    problems = [SweepProblem(case | loss, grid, ["psi_out"]) for loss in losses]
    entries = [json.dumps(problem.description()) for problem in problems]
    assert len(set(entries)) == len(losses)
    assert str(carom.material("steel").yield_strength) in entries[-1]


ANGLE = Grid({"angle": [0.1, 0.2]})


@pytest.mark.parametrize(
    ("case", "design", "message"),
    [
        ({"restitution": 0.9, "loss_time": 1e-6}, ANGLE, "not both; each of them sets the loss"),
        ({"restitution": 0.9}, Grid({"yield_velocity": [1.0]}), "not both"),
        ({"yield_velocity": "material"}, Grid({"loss_time": [1e-6]}), "not both"),
        ({"restitution": 1.1}, ANGLE, r"restitution: 1\.1 .* from 0\.001 to 1"),
        ({"loss_time": "2 mm"}, ANGLE, "loss_time: '2 mm' .* a value in s"),
        ({"yield_velocity": "materials"}, ANGLE, "yield_velocity: 'materials' .*'material'"),
        ({"yield_velocity": "material"}, ANGLE, "yield_velocity: missing; give it, or a yield"),
        ({"restitution": [0.9]}, ANGLE, r"restitution: \[0\.9\]"),
    ],
)
def test_what_is_no_sweep_with_losses_is_refused_in_a_line(case, design, message):
    assert not SweepProblem(BALL, ANGLE).loses  # the case is otherwise whole
    with pytest.raises(InputError, match=message) as refused:
        SweepProblem(BALL | case, design)
    assert "\n" not in str(refused.value)


def test_a_design_of_two_losses_is_refused():
    with pytest.raises(InputError, match=r"restitution: give it or loss_time, not both"):
        Grid({"loss_time": [0.0], "restitution": [1.0]})


def test_standard_linear_solids_are_those_of_impact():
    """Relaxation time and ratio of moduli as inputs or values of the case, and speeds."""
    case = {**BALL, "angle": "20 deg", "relaxation_time": "20 us"}
    ratios, speeds = [1.0, 1.5, 4.0, 0.5], [0.2, 3.0]
    design = Grid({"modulus_ratio": ratios, "speed": speeds})
    problem = SweepProblem(case, design)
    block = problem.block(whole(design))
    for at, (ratio, speed) in enumerate(product(ratios[:3], speeds)):
        require_same(problem, block, case, at, {"modulus_ratio": ratio, "speed": speed})
    assert block["status"][3].tolist() == [PointStatus.OUT_OF_RANGE] * 2
    assert block["normal_restitution"][0] == pytest.approx([1.0, 1.0])
    for half in ({"relaxation_time": 1e-5}, {"modulus_ratio": 2.0}):
        with pytest.raises(InputError, match="missing; give it together with"):
            SweepProblem({**BALL, **half}, Grid({"angle": [0.1]}))
