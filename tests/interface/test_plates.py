"""A plate in bodies, case files, sweeps and at the command line; whatever takes none says so."""

import inspect
import json
from importlib import import_module

import numpy as np
import pytest
from typer.testing import CliRunner

import carom
from carom.bodies.cases import case_of, pair_of, read_case
from carom.cli.commands import app
from carom.many.sweeps.records import summary
from carom.names import GROUPS

BALL = carom.Sphere(radius="5 mm", material="steel")
PLATE = carom.HalfSpace("steel", thickness="3 mm")
PAIR = carom.Pair(BALL, PLATE, friction=0.2)
CASE = {
    "friction": 0.2,
    "first": {"radius": "5 mm", "material": "steel"},
    "second": {"thickness": "3 mm", "width": "20 cm"},
    "speed": 0.5,
    "angle": "30 deg",
}
OPTIONS = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2", "--speed", "0.5"]


def test_a_bearing_ball_on_a_plate_of_3_mm() -> None:
    """Zener (1941): e = 0.534 at 0.5 m/s, lambda = 0.345, and 0.18 on 3 mm of glass at 1 m/s."""
    hit = carom.impact(PAIR, speed=0.5)
    assert PAIR.plate_give(hit.normal_speed) == pytest.approx(0.345, abs=5e-4)
    assert hit.normal_restitution == pytest.approx(0.534, abs=1e-3)
    glass = carom.Pair(BALL, carom.HalfSpace("soda-lime-glass", thickness="3 mm"), 0.2)
    assert carom.impact(glass, speed=1.0).normal_restitution == pytest.approx(0.18, abs=0.02)


def test_a_plate_is_told_apart_from_a_thick_wall() -> None:
    assert str(PLATE) == "plate (steel, h = 3 mm)"
    assert str(carom.HalfSpace("steel")) == "half-space (steel)"
    assert carom.HalfSpace("steel").impedance == np.inf
    assert carom.Pair(BALL, carom.HalfSpace("steel"), 0.2) != PAIR


def test_energies_of_the_history_add_up() -> None:
    rows = carom.impact(PAIR, speed=0.5, angle="30 deg", spin="100 rad/s").history(60)
    names = [name for name in rows if name.endswith(("_energy", "_loss", "_work"))]
    parts = set(names) - {"contact_kinetic_energy"}
    total = sum(rows[name].values for name in parts)
    assert total == pytest.approx(total[0], rel=1e-9)
    waves = rows["normal_loss"].values
    assert np.all(np.diff(waves) >= 0.0)
    assert waves[-1] > 0.5 * rows["normal_kinetic_energy"].values[0]


def test_a_case_file_holds_a_plate(tmp_path) -> None:
    file = tmp_path / "plate.toml"
    file.write_text(
        'friction = 0.2\nspeed = 0.5\n[first]\nradius = "5 mm"\nmaterial = "steel"\n'
        '[second]\nthickness = "3 mm"\nwidth = "20 cm"\n'
    )
    pair = pair_of(read_case(file))
    assert (pair.second.thickness, pair.second.width) == (0.003, 0.2)
    assert pair_of(case_of(pair)) == pair


def test_the_command_takes_a_plate() -> None:
    run = CliRunner().invoke(app, ["impact", *OPTIONS, "--thickness", "3 mm", "--json"])
    assert run.exit_code == 0, run.output
    printed = json.loads(run.output)["result"]
    assert printed["normal_restitution"] == carom.impact(PAIR, speed=0.5).normal_restitution


def test_a_sweep_over_thickness_is_that_of_single_impacts() -> None:
    thicknesses, angles = [2e-3, 3e-3, 1e-2], [0.1, 0.5, 1.2]
    swept = carom.sweep(CASE, carom.Grid({"second.thickness": thicknesses, "angle": angles}))
    for i, thickness in enumerate(thicknesses):
        pair = carom.Pair(BALL, carom.HalfSpace("steel", thickness=thickness), 0.2)
        for j, angle in enumerate(angles):
            hit = carom.impact(pair, speed=0.5, angle=angle)
            for name in ("psi_out", "normal_restitution", "rebound_angle", "max_force", "duration"):
                value = float(swept[name][i, j])
                assert value == pytest.approx(getattr(hit, name), rel=1e-12, abs=1e-15), name


@pytest.mark.parametrize("axis", ["second.width", "second.thickness"])
def test_a_sweep_says_where_the_rim_answers(axis) -> None:
    """As `hit.validity` does, with the results kept; width is an axis like others."""
    values = {"second.width": [0.02, 0.08, 0.09, 0.1, 0.5], "second.thickness": [2e-3, 3e-3, 0.1]}
    bodies = {"second": {"thickness": "3 mm", "width": "90 mm"}}
    swept = carom.sweep(CASE | bodies, carom.Grid({axis: values[axis], "angle": [0.0, 0.5]}))
    quiet = []
    for value in values[axis]:
        sizes = {"thickness": "3 mm", "width": "90 mm", axis.partition(".")[2]: value}
        hit = carom.impact(carom.Pair(BALL, carom.HalfSpace("steel", **sizes), 0.2), speed=0.5)
        quiet.append(next(f.holds for f in hit.validity.findings if f.name == "width"))
    assert len(set(quiet)) == 2
    assert np.all((swept.status.values.T == carom.status.PointStatus.SOLVED) == quiet)
    assert np.all((swept.status.values.T == carom.status.PointStatus.RIM_ANSWERS) != quiet)
    assert np.all(np.isfinite(swept.psi_out.values))
    assert summary(swept).solved == swept.status.size


def test_points_of_a_sweep_have_a_status() -> None:
    swept = carom.sweep(CASE, carom.Grid({"second.thickness": [-1.0, 1e-9, 1e-3, 3e-3]}))
    status = carom.status.PointStatus
    bad = status.OUT_OF_RANGE
    assert swept.status.values.tolist() == [bad, bad, status.PLATE_GIVES_WAY, status.SOLVED]


@pytest.mark.parametrize(
    ("thickness", "speed", "name", "holds"),
    [
        ("3 mm", 0.5, "bending wave/h", True),
        ("30 mm", 0.5, "bending wave/h", None),
        ("3 mm", 20.0, "a_max/h", False),
        ("3 mm", 0.01, "a_max/h", True),
    ],
)
def test_where_the_theory_of_plates_ends(thickness, speed, name, holds) -> None:
    pair = carom.Pair(BALL, carom.HalfSpace("steel", thickness=thickness), 0.2)
    findings = {each.name: each for each in carom.impact(pair, speed=speed).validity.findings}
    assert findings[name].holds is holds


def fields(hit):
    """Return what a result holds, as numbers."""
    return np.array([value for value in hit.scalars().values() if np.isfinite(value)])


@pytest.mark.parametrize("thickness", ["150 mm", 1e80, 1e101, 1e120, 1e154, 1e200, 1e308])
def test_a_thick_wall_that_is_told_is_a_thick_wall(thickness) -> None:
    """By one impact, in a sweep and among collisions: as without a thickness, to the last digit."""
    wall = carom.HalfSpace("steel")
    walls = carom.HalfSpace("steel", thickness=thickness), wall
    told, plain = (
        carom.impact(carom.Pair(BALL, each, 0.2), speed=0.5, angle=0.3) for each in walls
    )
    assert np.array_equal(fields(told), fields(plain))
    assert told.validity.holds is plain.validity.holds
    waves = next(f for f in told.validity.findings if f.name == "energy of waves in the wall")
    assert "solved as a thick wall" in waves.verdict
    assert "zener1941" not in told.cite()
    case = {**CASE, "angle": 0.3, "second": {}}
    swept = carom.sweep(case, carom.Grid({"second.thickness": [told.pair.thickness]}))
    assert swept.status.values.tolist() == [carom.status.PointStatus.SOLVED]
    assert float(swept.psi_out[0]) == pytest.approx(plain.psi_out, rel=1e-10)
    motion = {"velocity1": [0.1, 0.0, -0.5], "normal": [0.0, 0.0, -1.0]}
    one, other = (carom.collide(carom.Pair(BALL, each, 0.2), **motion) for each in walls)
    np.testing.assert_allclose(one.velocity1, other.velocity1, rtol=1e-9)


@pytest.mark.parametrize("width", [1e-300, 1e-3, 1e101, 1e200, 1e308])
@pytest.mark.parametrize("thickness", [1e-308, 1e-200, 1e-9, 3e-3, 1e101, 1e308])
def test_sizes_of_any_magnitude_are_solved_or_refused_in_one_line(thickness, width) -> None:
    plate = carom.HalfSpace("steel", thickness=thickness, width=width)
    pair = carom.Pair(BALL, plate, 0.2, roughness=width)
    solved = thickness > 1e-3
    if solved:
        hit = carom.impact(pair, speed=0.5, angle=0.3)
        assert hit.validity.holds is False  # so rough, or so narrow
        assert str(hit)
    else:
        with pytest.raises(carom.InputError, match=r"^thickness: [^\n]*$"):
            carom.impact(pair, speed=0.5, angle=0.3)
    assert pair.plate_give(0.5) >= 0.0
    swept = carom.sweep(CASE, carom.Grid({"second.thickness": [thickness]}))
    assert (swept.status.values[0] in (0, 9)) == solved
    motion = {"velocity1": [0.1, 0.0, -0.5], "normal": [0.0, 0.0, -1.0]}
    if solved:
        assert carom.collide(pair, **motion).status == 0
    else:
        with pytest.warns(Warning, match="thin"):
            carom.collide(pair, **motion)


def test_the_rim_of_a_plate_answers() -> None:
    for width, holds in (("5 cm", False), ("20 cm", True), (None, True)):
        pair = carom.Pair(BALL, carom.HalfSpace("steel", thickness="3 mm", width=width), 0.2)
        findings = {each.name: each for each in carom.impact(pair, speed=0.5).validity.findings}
        assert findings["width"].holds is holds


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: carom.HalfSpace("steel", thickness=-1.0), "thickness: -1.0 .*positive"),
        (lambda: carom.HalfSpace("steel", thickness="3 kg"), "thickness: '3 kg'"),
        (lambda: carom.HalfSpace("steel", width="1 m"), "width: '1 m' .*give its thickness"),
        (
            lambda: carom.HalfSpace(carom.Material(young=1e9, poisson=0.3), thickness=1e-3),
            "density: None .*leave thickness out for a thick wall",
        ),
        (
            lambda: pair_of({**CASE, "second": {"kind": "cup", "radius": 1.0, "thickness": 1.0}}),
            "thickness: 1.0 .*a cup has none",
        ),
        (
            lambda: carom.impact(
                carom.Pair(BALL, carom.HalfSpace("steel", thickness="1 um"), 0.2), speed=1.0
            ),
            "thickness: 1e-06 .*above the penetration",
        ),
        (
            lambda: carom.impact(
                carom.Pair(BALL, carom.HalfSpace("steel", thickness="1 mm"), 0.2), speed=1.0
            ),
            "thickness: 0.001 .*gives way like a foil",
        ),
        (
            lambda: carom.impact(PAIR, speed=1.0, losses=carom.KelvinVoigt(restitution=0.9)),
            "losses: .*leave losses or thickness out",
        ),
        (lambda: carom.impact(PAIR, speed=1.0, method="halfspace"), "thickness: 0.003"),
        (
            lambda: carom.verify.rank(
                [carom.laws.ReboundLaw(1.0, losses=carom.ZenerPlate(inelasticity=0.4))]
            ),
            "law: .*take a ReboundLaw without ZenerPlate",
        ),
        (
            lambda: carom.sweep(
                {**CASE, "second": {"width": 0.1}}, carom.Grid({"first.radius": [0.01]})
            ),
            "second.width: .*give second.thickness, too",
        ),
        (
            lambda: carom.sweep({**CASE, "restitution": 0.9}, carom.Grid({"angle": [0.1]})),
            "restitution: .*elastic so far",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(call, words) -> None:
    with pytest.raises(carom.InputError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


LAW = carom.dem.LinearSpring()
TAKING = {"impact", "collide", "fit", "joint_fit", "convert_observables"}
OTHERS = {  # all else that takes a pair, but for what `bench` returns
    "bearable_speeds": lambda: carom.bearable_speeds(PAIR),
    "bench": lambda: carom.verify.bench(carom.verify.Lammps(), [LAW], pair=PAIR),
    "cattaneo_mindlin": lambda: carom.classical.cattaneo_mindlin(PAIR, 1.0, 0.1),
    "critical_obliquity": lambda: carom.classical.critical_obliquity(PAIR),
    "Experiment": lambda: carom.verify.Experiment(
        pair=PAIR, law=LAW, normal_speed=1.0, tangential_speed=(0.1,), steps=100
    ),
    "fit_walton": lambda: carom.laws.fit_walton(PAIR),
    "FunctionLaw": lambda: carom.dem.FunctionLaw(lambda contact, state: (0.0, state), pair=PAIR),
    "load_path": lambda: carom.load_path(PAIR, normal_force=[0.0, 1.0], displacement=[0.0, 0.0]),
    "loop_energy": lambda: carom.classical.loop_energy(PAIR, 1.0, 0.1),
    "recipes": lambda: carom.verify.recipes(PAIR, 1.0),
    "stiffnesses": lambda: carom.verify.stiffnesses(PAIR, 1.0),
    "adhesive_impact": lambda: carom.classical.adhesive_impact(PAIR, normal_speed=1.0),
    "wear_of_many": lambda: carom.wear_of_many(PAIR, speed=[1.0], angle=[0.2]),
}


@pytest.mark.parametrize("name", OTHERS)
def test_what_takes_no_plate_says_so(name: str) -> None:
    with pytest.raises(carom.InputError, match=r"thickness: 0\.003"):
        OTHERS[name]()


ROD = carom.Body(
    mass="10 g", inertia=8e-6, contact=(0.03, -0.04), curvature_radius="3 mm", material="steel"
)
TURNED = carom.Pair(ROD, carom.HalfSpace("steel"), friction=0.2)
REFUSING = {  # what takes a plate, but spheres alone
    "collide": lambda: carom.collide(TURNED, velocity1=[[0.0, 0.0, -1.0]], normal=[0.0, 0.0, 1.0]),
    "fit": lambda: carom.fit({"angle": [0.1], "rebound_angle": [0.1]}, pair=TURNED),
    "convert_observables": lambda: carom.convert_observables(
        TURNED, known={"speed": 1.0, "angle": 0.3, "spin_out": 1.0}, wanted="psi_in"
    ),
    "ReboundLaw": lambda: carom.collide(
        TURNED, velocity1=[[0.0, 0.0, -1.0]], normal=[0.0, 0.0, 1.0]
    ),
}


@pytest.mark.parametrize("name", [*OTHERS, *REFUSING])
def test_what_takes_spheres_alone_says_so(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.interface.test_plates.PAIR", TURNED)
    with pytest.raises(carom.InputError, match=r"pair: .* only carom\.impact takes such bodies"):
        (REFUSING.get(name) or OTHERS[name])()


def test_observables_of_a_rebound_do_not_depend_on_the_plate() -> None:
    """The restitution is among what is known."""
    known = {"speed": 1.0, "angle": 0.3, "normal_restitution": 0.5, "spin_out": -20.0}
    wall = carom.Pair(BALL, carom.HalfSpace("steel"), friction=0.2)
    for wanted in ("psi_in", "psi_out", "rebound_angle"):
        one, other = (
            carom.convert_observables(p, known=known, wanted=wanted) for p in (PAIR, wall)
        )
        assert one == other


def test_all_that_takes_a_pair_is_tried() -> None:
    taking = set()
    for group in GROUPS:
        module = import_module(group)
        for name in module.__all__:
            value = getattr(module, name)
            error = isinstance(value, type) and issubclass(value, BaseException)
            if callable(value) and group != "carom.results" and not error:
                taking |= {name} if "pair" in inspect.signature(value).parameters else set()
    assert taking - {*TAKING, "Bench"} == set(OTHERS)


def test_what_to_cite() -> None:
    assert "@article{zener1941," in carom.impact(PAIR, speed=0.5).cite()
    assert "zener1941" not in carom.impact(carom.Pair(BALL, BALL, 0.2), speed=0.5).cite()
