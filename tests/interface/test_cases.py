"""Cases as mappings: what they say is what the bodies and speeds then are."""

import math
import time

import pytest
from tests.checks import refused

import carom
from carom.bodies import cases
from carom.bodies.case_materials import material_values, read_material
from carom.bodies.cases import check_case, pair_of, read_case

POINTS = (
    "^material: '3' cannot be used; write e.g. young=210 GPa, poisson=0.3, density=7850 with "
    "decimal points$"
)
TOML = """
friction = 0.3
speed = "2 m/s"
angle = "30 deg"
[first]
radius = "5 mm"
inner_radius = "1 mm"
material = {young = "210 GPa", poisson = 0.3, density = 7850}
[second]
kind = "sphere"
material = "glass"
"""


@pytest.mark.parametrize("young", ["inf", "1e999", "nan", "-inf"])
def test_a_number_of_a_file_is_finite(tmp_path, young):
    """It would be a rigid body; that is said by the name of its material."""
    path = tmp_path / "case.toml"
    path.write_text(TOML.replace('"210 GPa"', young))
    refused(f"young: '{young}' cannot be used", lambda: pair_of(read_case(path)))


def test_a_file_makes_the_pair_that_it_describes(tmp_path):
    """Against the same pair made by hand; the second sphere takes the radius of the first."""
    path = tmp_path / "case.toml"
    path.write_text(TOML)
    case = read_case(path)
    stuff = carom.Material(young=210e9, poisson=0.3, density=7850)
    first = carom.Sphere(radius=0.005, inner_radius=0.001, material=stuff)
    second = carom.Sphere(radius=0.005, material="glass")
    assert pair_of(case) == carom.Pair(first, second, 0.3)
    hit = carom.impact(pair_of(case), **cases.motion_of(case))
    assert hit.tangential_speed == pytest.approx(1.0)


def test_a_sphere_may_have_a_hole_of_no_size():
    hollow = carom.Sphere(radius=1, material="steel", inner_radius=0)
    solid = carom.Sphere(radius=1, material="steel")
    assert hollow.mass == pytest.approx(solid.mass, rel=1e-15)


def test_values_of_materials_with_and_without_gaps():
    """A name has all its values, a table those it gives, in SI units."""
    assert material_values("steel")["young"] == carom.material("steel").young
    assert material_values({"young": "1 GPa"}) == {"young": 1e9}
    values = material_values("poisson=0.25, density=2 g/cm^3")
    assert values == {"poisson": 0.25, "density": pytest.approx(2000.0)}
    assert material_values("rigid") == {"young": math.inf, "poisson": 0.0}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: check_case({"frction": 1}), "frction: unknown key; did you mean 'friction'"),
        (lambda: check_case({"first": {"radios": 1}}), "radios: unknown key; .*'radius'"),
        (lambda: check_case({"first": "steel"}), r"first: 'steel' .*\[first\]"),
        (lambda: check_case({"second": {"material": {"yung": 1}}}), "yung: .*'young'"),
        (lambda: check_case([1]), "case: .*mapping"),
        (lambda: material_values({"poisson": 0.6}), "poisson: 0.6"),
        (
            lambda: material_values({"xyz": 1}),
            "^xyz: unknown in a material; known names are young, poisson, density, yield_strength, "
            "tensile_strength, fracture_toughness, flaw_size, hardness, surface_energy, "
            "loss_factor, name$",
        ),
        (lambda: material_values({"modulus": 1}), "modulus: unknown in a material"),
        (lambda: read_material("young=210 GPa, poisson=0,3, density=7850"), POINTS),
        (lambda: read_material({"young": 1e9}), "poisson: missing"),
        (lambda: pair_of({"first": {}}), "friction: missing"),
    ],
)
def test_what_is_no_case_is_refused(make, message):
    refused(message, make)


def test_all_unknown_keys_are_counted_and_the_first_are_told(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("".join(f"k{i} = 1\n" for i in range(30)), encoding="utf-8")
    message = refused("", carom.read, path)
    assert message.startswith("30 faults: (1) k0: unknown key in ")
    assert message.endswith("; and 18 more")
    assert message.count("unknown key") == 12


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (" " * 150_000 + "\nfriktion = 0.2\n", "friktion: unknown key in .*, line 2; did you mean"),
        ("\t" * 150_000 + "[first]\nradios = 1\n", "radios: unknown key in .*, line 2; did you"),
        ("k" * 150_000 + " = 1\n", "kkk[.]{3}: unknown key in .*, line 1; known names are"),
    ],
    ids=["blanks", "tabs", "key"],
)
def test_long_lines_are_read_at_once(text, answer, tmp_path):
    """In time that grows as they do, with an error that does not."""
    path = tmp_path / "case.toml"
    path.write_text(text)
    begin = time.process_time()
    assert len(refused(answer, carom.read, path)) < 600
    assert time.process_time() - begin < 5.0


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        (",".join(f"{i}=1" for i in range(120_000)), "0: unknown in a material"),
        (f"{'young=1,' * 100_000}young=2", "young: .* it is given twice"),
    ],
    ids=["unknown", "twice"],
)
def test_a_long_material_is_read_at_once(text, answer):
    begin = time.process_time()
    refused(answer, read_material, text)
    assert time.process_time() - begin < 5.0
