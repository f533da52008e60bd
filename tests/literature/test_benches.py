"""Verdicts on sixty benches: what is struck with what, how fast, and what is known of the outcome.

None says "holds" where e is known to be below 0.99; none says "fails" where the theory is good to
that; and where it is good, and the catalogue has what the verdict needs, it says "holds". What is
known is a measurement, or that no loss of energy reaches a hundredth: stresses below first yield
(Johnson 1985, 6.1), waves in a thick wall (Hunter 1957), adhesion (Johnson, Kendall & Roberts).
"""

import pytest

import carom

PHENOLIC = carom.Material(young="5.8 GPa", poisson=0.34, density=1740, name="phenolic resin")
CELLULOID = carom.Material(young="2.2 GPa", poisson=0.35, density=1400, name="celluloid")
FELT = carom.Material(young="20 MPa", poisson=0.45, density=1000, name="rubber and felt")
SUPERBALL = carom.Material(young="10 MPa", poisson=0.5, density=910, name="superball")
POLYURETHANE = carom.Material(young="20 MPa", poisson=0.48, density=1200, name="polyurethane")
UNKNOWN_LOSS = "a polymer: e is below 0.99, but its loss factor is in no handbook at hand"
BEARING, MILD, STAINLESS = "bearing-steel", "steel", "stainless-steel"
GLASS, FLOAT = "soda-lime-glass", "float-glass"

ELASTIC = [  # ball, diameter, what it strikes (None: its like), speed in m/s, angle, friction
    (BEARING, "3.18 mm", None, 0.3, 0, 0.12),  # e = 1.00 (0.01), Louge 1999
    (BEARING, "3.18 mm", None, 0.3, 20, 0.12),
    (BEARING, "3.18 mm", BEARING, 0.1, 0, 0.12),
    (BEARING, "3.18 mm", BEARING, 0.3, 30, 0.12),
    (BEARING, "10 mm", BEARING, 0.02, 0, 0.15),
    (BEARING, "10 mm", BEARING, 0.1, 0, 0.15),
    (BEARING, "10 mm", BEARING, 0.3, 10, 0.15),
    (BEARING, "10 mm", BEARING, 0.5, 0, 0.15),
    (BEARING, "10 mm", BEARING, 0.5, 45, 0.1),
    (BEARING, "25.4 mm", None, 0.1, 0, 0.15),  # Newton's cradle
    (BEARING, "25.4 mm", None, 0.4, 0, 0.15),
    (BEARING, "25.4 mm", BEARING, 0.4, 30, 0.15),
    (BEARING, "50 mm", BEARING, 0.5, 0, 0.15),
    (BEARING, "1 mm", BEARING, 0.5, 0, 0.15),
    (BEARING, "10 mm", "titanium-alloy", 0.05, 0, 0.3),
    (BEARING, "10 mm", "aluminium-7075", 0.01, 0, 0.3),
    ("titanium-alloy", "10 mm", None, 0.1, 0, 0.3),
    ("titanium-alloy", "10 mm", "titanium-alloy", 0.1, 20, 0.3),
    ("aluminium-7075", "10 mm", None, 0.05, 0, 0.3),
    ("aluminium-7075", "20 mm", "aluminium-7075", 0.1, 10, 0.3),
    ("aluminium-6061", "20 mm", None, 0.01, 0, 0.3),
    ("magnesium-az31b", "40 mm", None, 0.02, 0, 0.3),
    (MILD, "50 mm", MILD, 0.003, 0, 0.3),
    (STAINLESS, "50 mm", None, 0.0015, 0, 0.3),
]

LOSSY = [  # as above, and e as far as it is known
    (BEARING, "10 mm", BEARING, 5.0, 0, 0.15, "yields at 0.9 m/s; e is 0.7 to 0.9"),
    (BEARING, "10 mm", BEARING, 20.0, 20, 0.15, "yields at 0.9 m/s"),
    (MILD, "10 mm", MILD, 2.0, 0, 0.3, "mild steel dents: e about 0.6"),
    (STAINLESS, "10 mm", STAINLESS, 3.0, 0, 0.3, "annealed steel dents"),
    ("lead", "10 mm", "lead", 0.5, 0, 0.3, "lead dents: e about 0.2"),
    ("lead", "20 mm", BEARING, 1.0, 0, 0.3, "lead dents"),
    ("lead", "20 mm", None, 0.01, 0, 0.3, "lead dents at 0.1 mm/s"),
    ("aluminium", "10 mm", "aluminium", 2.0, 0, 0.3, "pure aluminium dents"),
    ("copper", "10 mm", "copper", 1.0, 0, 0.3, "copper dents"),
    ("brass", "10 mm", BEARING, 1.0, 0, 0.3, "annealed brass dents"),
    ("aluminium-6061", "10 mm", None, 1.0, 0, 0.3, "yields at some cm/s"),
    ("aluminium-7075", "10 mm", BEARING, 3.0, 0, 0.3, "yields at 0.1 m/s"),
    ("titanium-alloy", "10 mm", None, 5.0, 0, 0.3, "yields at 0.5 m/s"),
    ("tungsten", "5 mm", None, 2.0, 0, 0.3, "yields at some cm/s"),
    (GLASS, "3.18 mm", "aluminium", 1.2, 0, 0.125, "e = 0.831 (0.009), Louge 1999"),
    (GLASS, "3.18 mm", None, 1.2, 0, 0.092, "e = 0.97 (0.01), Foerster et al. 1994"),
    (GLASS, "3.18 mm", None, 1.2, 20, 0.092, "e = 0.97 (0.01), Foerster et al. 1994"),
    ("alumina", "5 mm", GLASS, 3.9, 0, 0.092, "e = 0.98, Kharaz, Gorham & Salman 2001"),
    ("alumina", "5 mm", GLASS, 3.9, 30, 0.092, "e = 0.98, Kharaz, Gorham & Salman 2001"),
    ("pom", "6.35 mm", None, 0.5, 0, 0.14, "e = 0.97 (0.01), Louge 1999"),
    ("cellulose-acetate", "5.99 mm", None, 0.5, 0, 0.25, "e = 0.87 (0.02), Louge 1999"),
    (POLYURETHANE, "4 mm", None, 0.5, 0, 0.8, "e = 0.60 (0.05), Louge 1999"),
    ("nylon", "6 mm", None, 1.0, 0, 0.2, "yields at 0.8 m/s"),
    ("pmma", "10 mm", BEARING, 0.1, 0, 0.3, UNKNOWN_LOSS),
    ("polycarbonate", "10 mm", "polycarbonate", 0.1, 0, 0.3, UNKNOWN_LOSS),
    ("rubber", "20 mm", MILD, 0.03, 0, 0.8, UNKNOWN_LOSS),
    ("rubber", "20 mm", "concrete", 1.0, 0, 0.8, "pressed too flat"),
    ("ice", "55 mm", "ice", 0.05, 0, 0.1, "loses: e = 0.22, Bridges, Hatzes & Lin 1984"),
    (SUPERBALL, "46 mm", "granite", 2.69, 54, 0.7, "e = 0.91, Cross 2002"),
    (PHENOLIC, "57.15 mm", None, 1.0, 30, 0.06, "e = 0.92 to 0.98, Alciatore"),
    (BEARING, "10 mm", "lead", 0.1, 0, 0.3, "lead dents"),
    (BEARING, "10 mm", "concrete", 1.0, 0, 0.3, "concrete loses"),
    (GLASS, "20 um", GLASS, 0.01, 0, 0.2, "sticks: below some cm/s"),
    (GLASS, "5 um", BEARING, 0.05, 0, 0.2, "sticks: below some dm/s"),
    ("polystyrene", "1.27 um", "fused-silica", 0.3, 0, 0.2, "sticks, Dahneke 1975"),
    (BEARING, "10 um", BEARING, 0.01, 0, 0.2, "sticks: below some cm/s"),
]

SHELLS = [  # ball, outer diameter, wall thickness in mm, what it strikes, speed
    (CELLULOID, 40.0, 0.4, MILD, 1.0),  # table tennis
    (FELT, 66.0, 6.5, "concrete", 2.0),  # tennis
    (MILD, 40.0, 0.4, MILD, 0.1),
    (BEARING, 40.0, 0.4, BEARING, 0.1),
    (BEARING, 100.0, 2.0, BEARING, 0.3),
]

FINEST = "5 nm"  # of the balls of grade 3 and of polished plates
OPEN = [  # the theory is good, or nobody knows; what a verdict would need is not in the catalogue
    (BEARING, "10 mm", FLOAT, 0.05, 0, 0.15, "loss_factor of float-glass"),
    (BEARING, "10 mm", FLOAT, 0.3, 30, 0.15, "flaw_size of float-glass"),
    (GLASS, "5 mm", None, 0.05, 0, 0.1, "loss_factor of soda-lime-glass"),
    ("silicon-nitride", "10 mm", BEARING, 0.1, 0, 0.1, "loss_factor of silicon-nitride"),
    ("zirconia", "10 mm", BEARING, 0.1, 0, 0.1, "loss_factor of zirconia"),
    (BEARING, "10 mm", "bk7", 0.1, 0, 0.1, "fracture_toughness of bk7"),
    ("tungsten", "10 mm", None, 0.005, 0, 0.3, "loss_factor of tungsten"),
    ("alumina", "5 mm", None, 0.1, 0, 0.1, "loss_factor of alumina"),
    ("alumina", "5 mm", "alumina", 0.1, 0, 0.1, "loss_factor of alumina"),
    ("alumina", "5 mm", BEARING, 0.2, 0, 0.1, "loss_factor of alumina"),
    (
        "sintered-alumina",
        "10 mm",
        "sintered-alumina",
        0.1,
        0,
        0.1,
        "loss_factor of sintered-alumina",
    ),
    ("tungsten-carbide", "10 mm", None, 0.1, 0, 0.1, "loss_factor of tungsten-carbide"),
    ("granite", "50 mm", None, 0.1, 0, 0.5, "yield_strength of granite"),
    ("cast-iron", "20 mm", None, 0.1, 0, 0.3, "yield_strength of cast-iron"),
]

PLATES = [  # ball, what it strikes, speed, thickness in mm, e: Zener (1941)
    (BEARING, "10 mm", BEARING, 0.5, 3.0, 0.534),
    (BEARING, "10 mm", FLOAT, 1.0, 3.0, 0.183),
]


def verdict_of(ball, diameter, second, speed, angle=0, friction=0.2, **shape):
    size, unit = diameter.split()
    body = carom.Sphere(radius=f"{float(size) / 2.0!r} {unit}", material=ball, **shape)
    wall = body if second is None else carom.HalfSpace(second)
    pair = carom.Pair(body, wall, friction, roughness=FINEST)  # slow contacts are shallow
    return carom.impact(pair, speed=speed, angle=f"{angle} deg").validity


def test_there_are_sixty():
    benches = [*ELASTIC, *LOSSY, *SHELLS, *OPEN]
    assert len(benches) >= 60
    assert len({repr(bench) for bench in benches}) == len(benches)
    assert len(ELASTIC) >= 20


@pytest.mark.parametrize("bench", ELASTIC)
def test_where_the_theory_is_good_the_verdict_holds(bench):
    validity = verdict_of(*bench)
    assert validity.holds is True, f"{validity}"
    assert all(finding.missing == "" for finding in validity.findings)


@pytest.mark.parametrize("bench", LOSSY)
def test_where_energy_is_lost_no_verdict_holds(bench):
    validity = verdict_of(*bench[:6])
    assert validity.holds is not True, f"{validity}"
    if "yields" in bench[6] or "dents" in bench[6] or "sticks" in bench[6] or "lose" in bench[6]:
        assert validity.holds is False, f"{validity}"


@pytest.mark.parametrize(("ball", "diameter", "wall", "second", "speed"), SHELLS)
def test_shells_fail_and_the_text_says_what_to_measure(ball, diameter, wall, second, speed):
    inner = f"{diameter / 2.0 - wall} mm"
    validity = verdict_of(ball, f"{diameter} mm", second, speed, inner_radius=inner)
    dent = next(each for each in validity.findings if each.name.startswith("dent"))
    assert (dent.holds, validity.holds) == (False, False)
    assert "measure e and the rebound" in dent.verdict


@pytest.mark.parametrize("bench", OPEN)
def test_what_is_missing_is_named(bench):
    validity = verdict_of(*bench[:6])
    assert validity.holds is None, f"{validity}"
    assert bench[6] in [finding.missing for finding in validity.findings]
    key = bench[6].split()[0]
    assert f"Material({key}=...)" in str(validity)


@pytest.mark.parametrize(("ball", "diameter", "second", "speed", "thickness", "e"), PLATES)
def test_a_wall_is_thick_by_word_and_a_plate_by_its_thickness(
    ball, diameter, second, speed, thickness, e
):
    text = str(verdict_of(ball, diameter, second, speed))
    assert text.count("taken to be thick") == 1
    plate = carom.HalfSpace(second, thickness=f"{thickness} mm")
    sphere = carom.Sphere(radius="5 mm", material=ball)
    hit = carom.impact(carom.Pair(sphere, plate, 0.2), speed=speed)
    assert hit.normal_restitution == pytest.approx(e, abs=2e-3)
    assert "taken to be thick" not in str(hit.validity)
    assert next(each for each in hit.validity.findings if "bending" in each.name).holds is True
