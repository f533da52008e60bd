"""The numbers of the benchmark pack: frozen, within their error bars, and true."""

import compileall
import hashlib
import json
import math
import shutil
import sys
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from carom import HalfSpace, Material, Pair, Sphere
from carom.bodies.cases import pair_of
from carom.bodies.kinematics import inertia
from carom.verify.pack import VERSION
from carom.verify.pack.frozen import DecimalTable, _texts, case_of, frozen_files, read_table
from carom.verify.scoring import score

STUDIES = Path(__file__).parents[2] / "studies"
sys.path.insert(0, str(STUDIES))

from pack_references import ERROR, references, uncertain, unit_tests  # noqa: E402

SETS = (
    *("wall", "wall_spin", "wall_mixed", "rigid_wall", "equal_spheres", "unequal_sizes"),
    *("unequal_materials", "chung_ooi/test4_aluminium_oxide", "chung_ooi/test4_aluminium_alloy"),
)
HISTORIES = ("normal", "stick_first", "slip_then_stick", "slip_back", "gross_slip")
NUMBERS = ("reference.csv", "results.csv", "case.toml")
DIGESTS = {"1": "779e70d5676c3fe238efa871ab6f371b1da69c3ed07638c87d5383ff87faaa88"}
# psi_1, chi, psi_2: computed with 52 digits by tests/oracles/impact_solver.py
DIGITS = [
    *((0.5, 0.875, "-0.35191335345597793398"), (0.95, 1.0, "-0.59316152455702849548")),
    *((1.5, 1.0, "-1.0557824966308223059"), (0.25, 1.16666666667, "-0.049191965785213556643")),
    *((1.5, 1.2069, "-0.79440053291112514329"), (0.1, 1.4412, "0.020592955562262594601")),
    *((0.25, 1.4412, "0.041617490968917233567"), (0.75, 1.4412, "0.014171291088085559129")),
    *((1.25, 1.4412, "-0.21879254872330970225"), (2.5, 1.4412, "-1.1622621888640976908")),
    *((3.5, 1.4412, "-1.4773283001491401831"), (4.5, 1.4412, "-1.2176802613236448658")),
    *((0.3, 1.75, "0.10978333041146198054"), (0.9, 1.75, "0.27237120389064960665")),
    *((3.25, 1.75, "-1.1765310933593513679"), (6.0, 1.75, "-1.0000000000000000000")),
]
# row, F_n/P_max, F_t/(mu P_max), V_z/V_1, psi: from the Taylor series of the same solver
STATES = {
    "stick_first": [
        (10, 0.158077734411347, 0.0768171275570212, 0.976619084046175, 0.46109322577618),
        (35, 0.828046845809164, 0.263324172427905, 0.51945024232304, -0.0704440702561568),
        (65, 0.828046845809163, -0.1125576454019, -0.51945024232304, -0.365550462695267),
        (80, 0.426569212530342, -0.150294421331442, -0.870791700505253, -0.12972167728915),
        (95, 0.0563544316124082, -0.0470455275661838, -0.995849641267848, 0.0368768234371179),
    ],
    "slip_then_stick": [
        (35, 0.828046845809164, 0.828046845809164, 0.51945024232304, 0.673709521989939),
        (50, 1.0, 0.795480809038933, 0.0, -0.732864675939887),
        (80, 0.426569212530342, -0.328175148720819, -0.870791700505253, -1.2346809917795),
    ],
    "slip_back": [
        (65, 0.828046845809163, 0.784062081107198, -0.51945024232304, -0.870190515300709),
        (80, 0.426569212530342, 0.110812523741251, -0.870791700505253, -1.59312531263868),
    ],
}


def test_what_an_installer_compiles_is_not_part_of_it(tmp_path):
    """Scripts of the pack lie in a package, whose scripts pip compiles."""
    copy = tmp_path / "pack"
    shutil.copytree(str(files("carom").joinpath("data/benchmarks/pack")), copy)
    assert compileall.compile_dir(copy, quiet=2)
    assert list(copy.rglob("*.pyc"))
    assert _texts(copy, "") == frozen_files()


def reference(folder: str) -> DecimalTable:
    return read_table(frozen_files()[f"{folder}/reference.csv"])


def test_numbers_of_a_version_are_frozen():
    """Whoever changes a number, an input or a case makes a new version of the pack."""
    numbers = {name: text for name, text in frozen_files().items() if name.endswith(NUMBERS)}
    digest = hashlib.sha256(json.dumps(numbers).encode()).hexdigest()
    assert digest == DIGESTS[VERSION]


def test_frozen_numbers_are_those_computed():
    """Each within its error bar, and in fact within a tenth of it and a unit of its last digit."""
    computed = references()
    for path, table in computed.items():
        frozen = read_table(frozen_files()[path])
        assert list(frozen.columns) == list(table.columns), path
        assert frozen.notes == table.notes, path
        for name in (name for name in frozen.columns if not name.endswith(ERROR)):
            error = frozen.numbers(name + ERROR) if name + ERROR in frozen.columns else 0.0
            off = np.abs(frozen.numbers(name) - table.numbers(name))
            assert np.all(off <= error), (path, name)
            assert np.all(off <= 0.1 * error + 1e-11 * np.abs(frozen.numbers(name))), (path, name)
        for name in (name for name in frozen.columns if name.endswith(ERROR)):
            wide = frozen.numbers(name) - table.numbers(name)  # two digits, rounded up
            assert np.all(np.abs(wide) <= 0.1 * table.numbers(name)), (path, name)
    assert len(computed) == 18


def test_frozen_tests_of_lammps_are_those_computed():
    """Word by word, and numbers to a few units of their last digits: powers differ by machine."""
    computed = unit_tests()
    assert len(computed) == 7
    for path, text in computed.items():
        for word, frozen in zip(text.split(), frozen_files()[path].split(), strict=True):
            try:
                assert float(frozen) == pytest.approx(float(word), rel=1e-13, abs=1e-25), path
            except ValueError:
                assert frozen == word, path


@pytest.mark.parametrize(("psi", "chi", "digits"), DIGITS)
def test_psi_against_thirty_digits(psi, chi, digits):
    """The error bar holds the true value, and is no wider than what is promised."""
    table = reference("dimensionless")
    at = (table.numbers("psi_1") == psi) & (table.numbers("chi") == chi)
    (value,), (error,) = table.numbers("psi_2")[at], table.numbers("psi_2_error")[at]
    assert abs(value - float(digits)) <= error
    assert abs(value - float(digits)) <= 0.1 * error + 5.1e-12
    assert error <= 1.2e-10 * max(1.0, psi)


@pytest.mark.parametrize("folder", SETS)
def test_sliding_in_closed_form(folder):
    """From psi_1 = 4 chi - 1 on: V_x' = V_x - 2 mu V_1 m_n/m_t, and v_t' = v_t - 2 mu V_1."""
    table, pair = reference(folder), pair_of(case_of(folder))
    psi = table.numbers("psi_in")
    slides = np.abs(psi) >= 4.0 * pair.chi - 1.0
    lost = 2.0 * pair.friction * table.numbers("normal_speed") * np.sign(psi)
    expected = table.numbers("tangential_speed") - lost
    off = np.abs(table.numbers("tangential_speed_out") - expected)
    assert slides.sum() >= 5
    assert np.all(off[slides] <= table.numbers("tangential_speed_out_error")[slides])
    expected_psi = psi - np.sign(psi) * 4.0 * pair.chi
    off_psi = np.abs(table.numbers("psi_out") - expected_psi)
    assert np.all(off_psi[slides] <= table.numbers("psi_out_error")[slides])


@pytest.mark.parametrize("folder", SETS)
def test_momentum_and_energy(folder):
    """One impulse changes speed and spins, m_n dv = I dw/R; and no impact gains energy."""
    table, pair = reference(folder), pair_of(case_of(folder))
    before = [table.numbers(name) for name in ("tangential_speed", "spin")]
    after = [table.numbers(f"{name}_out") for name in ("tangential_speed", "spin")]
    impulse = pair.normal_mass * (before[0] - after[0])
    lever = inertia(pair.first) / pair.first.radius
    room = pair.normal_mass * table.numbers("tangential_speed_out" + ERROR)
    room += lever * table.numbers("spin_out" + ERROR)
    assert np.all(np.abs(impulse - lever * (before[1] - after[1])) <= room)
    if len(pair.moving) == 2:
        second = inertia(pair.second) / pair.second.radius * table.numbers("spin2_out")
        assert np.all(np.abs(impulse + second) <= 2.0 * room)
    assert np.all(np.abs(table.numbers("psi_out")) <= np.abs(table.numbers("psi_in")) + 1e-12)


@pytest.mark.parametrize("folder", SETS)
def test_errors_are_those_of_psi_in_other_units(folder):
    """d v_t' = (m_t/m_n) d V_x', d spin' = (m_t R/I) d V_x'; at most twice that, with rounding."""
    table, pair = reference(folder), pair_of(case_of(folder))
    unit = pair.scales(table.numbers("normal_speed")).tangential_speed * pair.tangential_mass
    impulse = 1e-10 * np.maximum(1.0, np.abs(table.numbers("psi_in"))) * unit
    lever = pair.first.radius / inertia(pair.first)
    for name, share in (("tangential_speed", 1.0 / pair.normal_mass), ("spin", lever)):
        error, value = (table.numbers(f"{name}_out{end}") for end in (ERROR, ""))
        assert np.all(error >= 0.999 * share * impulse)
        assert np.all(error <= 1.2 * share * impulse + 6e-12 * np.abs(value) + 1e-14)


def test_spin_alone_rebounds_as_speed_alone():
    """psi_2 depends on V_x = v_t + R spin only; both sets have the same V_x, every 5 degrees."""
    speeds, spins = reference("wall"), reference("wall_spin")
    off = speeds.numbers("psi_out")[::2] - spins.numbers("psi_out")
    assert np.all(np.abs(off) <= 2.0 * spins.numbers("psi_out_error"))
    assert np.all(spins.numbers("tangential_speed") == 0.0)


def test_pure_rolling_is_not_disturbed():
    """With v_t + R spin = 0 before, nothing changes."""
    table = reference("wall_mixed")
    (row,) = np.flatnonzero(table.numbers("spin") == -20.0)
    assert table.numbers("tangential_speed_out")[row] == 0.1
    assert table.numbers("spin_out")[row] == -20.0


def test_hertz_in_closed_form():
    """P_max and the duration of `wall`: Johnson (1985), (11.23) and (11.24)."""
    table = reference("wall")
    modulus, mass = 210e9 / (2 * (1 - 0.3**2)), 4 / 3 * math.pi * 0.005**3 * 7850.0
    depth = (15 * mass * 0.1**2 / (16 * modulus * math.sqrt(0.005))) ** 0.4
    force = 4 / 3 * modulus * math.sqrt(0.005) * depth**1.5
    time = 2 / 2.5 * math.gamma(0.4) * math.gamma(0.5) / math.gamma(0.9) * depth / 0.1
    for name, value in (("max_penetration", depth), ("max_force", force), ("duration", time)):
        assert np.all(np.abs(table.numbers(name) - value) <= table.numbers(name + ERROR))


@pytest.mark.parametrize("name", STATES)
def test_histories_against_thirty_digits(name):
    """Forces and velocities at a few instants; times are exact fractions of the duration."""
    table, case = reference(f"histories/{name}"), case_of(f"histories/{name}")
    pair = pair_of(case)
    scales = pair.scales(case["normal_speed"])
    units = {
        "normal_force": scales.force,
        "tangential_force": pair.friction * scales.force,
        "normal_velocity": case["normal_speed"],
        "contact_velocity": scales.tangential_speed,
    }
    for row, *state in STATES[name]:
        time = table.numbers("time")
        assert time[row] == pytest.approx(row / 100 * time[-1], rel=1e-11)
        for (column, unit), value in zip(units.items(), state, strict=True):
            off = abs(table.numbers(column)[row] - value * unit)
            assert off <= table.numbers(column + ERROR)[row], (row, column)


def test_normal_history_has_no_tangential_force():
    """And gross slip has mu times the normal one throughout."""
    assert np.all(reference("histories/normal").numbers("tangential_force") == 0.0)
    table = reference("histories/gross_slip")
    off = table.numbers("tangential_force") - 0.2 * table.numbers("normal_force")
    assert np.all(np.abs(off) <= table.numbers("tangential_force_error"))


@pytest.mark.parametrize("folder", [*SETS, "chung_ooi/test7"])
def test_the_exact_answer_passes_the_scorer(folder):
    """With a tolerance of 1e-8; turned spins fail at the usual one, but where nothing turns."""
    table, pair = reference(folder), pair_of(case_of(folder))
    names = ("normal_speed", "tangential_speed", "spin", "spin2")
    columns = [name for base in names for name in (base, f"{base}_out")]
    results = {name: table.numbers(name) for name in columns if name in table.columns}
    assert score(results, case=pair, tolerance=1e-8).passed
    turned = results | {"spin_out": -results["spin_out"]}
    assert not score(turned, case=pair).passed


def test_dimensionless_answers_pass_the_scorer():
    """psi_2 as it is, not its opposite."""
    table = reference("dimensionless")
    results = {name: table.numbers(name) for name in ("psi_1", "psi_2", "chi")}
    assert score(results, tolerance=1e-9).passed
    assert not score(results | {"psi_2": -results["psi_2"]}).passed


@pytest.mark.parametrize("name", HISTORIES)
def test_histories_pass_the_scorer(name):
    """With a tolerance of 1e-5, which in energy is 1e-10; with the opposite sign they fail."""
    table, case = reference(f"histories/{name}"), case_of(f"histories/{name}")
    names = ("time", "normal_force", "tangential_force", "contact_velocity")
    results = {column: table.numbers(column) for column in names}
    assert score(results, case=case, tolerance=1e-5).passed
    turned = results | {"tangential_force": -results["tangential_force"]}
    assert score(turned, case=case).passed == (name == "normal")


def test_errors_are_rounded_up():
    """Half a unit of the twelfth digit is part of the error, and two digits of it are shown."""
    cells = uncertain("psi_out", [123.456789012345, 0.0], 1.01e-10)
    assert cells["psi_out"] == ["123.456789012", "0"]
    assert cells["psi_out_error"] == ["6.1e-10", "1.1e-10"]


def test_solid_spheres_of_one_material_have_the_chi_that_the_pack_says():
    """nu = 0.5, 0.3 and 0: chi = (7/2)(1 - nu)/(2 - nu)."""
    for poisson, chi in ((0.5, 1.1667), (0.3, 1.4412), (0.0, 1.75)):
        stuff = Material(young=1e9, poisson=poisson, density=1000.0)
        pair = Pair(Sphere(radius=0.01, material=stuff), HalfSpace(material=stuff), 0.2)
        assert pair.chi == pytest.approx(chi, abs=5e-5)
        assert f"{chi:g}" in frozen_files()["README.md"]
