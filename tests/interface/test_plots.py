"""Figures show what the datasets hold: places, numbers, units and phases; text stays legible."""

import subprocess
import sys
from itertools import product

import matplotlib
import numpy as np
import pytest
from PIL import Image
from tests.checks import is_legible

import carom
from carom import plots
from carom.impacts.curves import regime_map
from carom.io.files import save
from carom.plots.bands import BANDS, SIGNS
from carom.plots.style import label, prefixed
from carom.quantities.glossary import GLOSSARY

MM = 1.0 / 25.4
MICROSLIP = 21e-6  # an instant of the impact below with a slip ring


@pytest.fixture(scope="module")
def history(hit):
    return hit.history(101)


@pytest.fixture(scope="module")
def fields(hit):
    return hit.fields(MICROSLIP)


@pytest.fixture(scope="module")
def figures(hit, history, fields):
    """Every kind of figure, drawn once."""
    grid = np.linspace(0.1, 6.0, 12)
    return {
        "impact": plots.plot_impact(history),
        "forces": plots.plot_forces(history),
        "radii": plots.plot_radii(history),
        "cone": plots.plot_cone(history),
        "spectrum": plots.plot_spectrum(hit.spectrum()),
        "wear": plots.plot_wear(hit.wear()),
        "patch": plots.plot_patch(fields),
        "pressure": plots.plot_patch(fields, "pressure"),
        "line": plots.plot_profiles(fields),
        "memory": plots.plot_profiles(hit.radial(MICROSLIP)),
        "stress": plots.plot_stress(hit.stress(MICROSLIP)),
        "curve": plots.plot_curve(carom.curve(1.44, np.linspace(0.0, 6.0, 61))),
        "curves": plots.plot_curve(carom.curve([0.8, 1.44, 1.75, 3.0], np.linspace(-4, 8, 61))),
        "map": plots.plot_regime_map(regime_map(2.0 * grid, grid)),
    }


def lines(axis):
    """Return the lines of axes by label."""
    return {line.get_label(): line for line in axis.lines}


@pytest.mark.parametrize(
    ("largest", "unit", "expected"),
    [
        *((2.5e-5, "m", (1e6, "µm")), (1.0, "N", (1.0, "N")), (0.999, "N", (1e3, "mN"))),
        *((1000.0, "Pa", (1e-3, "kPa")), (3.1e-13, "s", (1e12, "ps")), (0.5, "1", (1.0, "1"))),
        *((0.0, "J", (1.0, "J")), (float("nan"), "m", (1.0, "m"))),
    ],
)
def test_prefix_makes_the_largest_number_1_to_1000(largest, unit, expected):
    scale, name = prefixed([0.0, -largest], unit)
    assert (scale, name) == (pytest.approx(expected[0], rel=1e-14), expected[1])


@pytest.mark.slow
def test_labels_are_those_of_the_glossary(figures):
    """Every axis names a quantity of the glossary by its symbol and its unit."""
    for name, figure in figures.items():
        for axis in figure.axes:
            for text in (axis.get_xlabel(), axis.get_ylabel()):
                plain = text.replace("\n", " ")
                names = [q for q in GLOSSARY.values() if q.symbol in plain]
                assert names or plain in ("", "share of energy"), (name, plain)
                assert (
                    not plain or plain == "share of energy" or any(_fits(q, plain) for q in names)
                )
    assert label("psi_in") == "$\\psi_1$"
    assert label("tangential_force", "mN") == "$F_x$\u00a0(mN)"


def _fits(quantity, text):
    has_unit = quantity.unit == "1" or text.replace("²", "^2").endswith(f"{quantity.unit})")
    symbols = text.rpartition("\u00a0(")[0] or text
    return has_unit and quantity.symbol in symbols.split(", ")


@pytest.mark.slow
def test_all_text_is_legible(figures):
    assert all(map(is_legible, figures.values()))


def test_widths_are_those_of_one_and_two_columns(figures, tmp_path):
    """86 mm and 178 mm, and 300 dots per inch once stored."""
    for name, figure in figures.items():
        width = 178.0 if name in ("impact", "map", "wear") else 86.0
        assert figure.get_figwidth() == pytest.approx(width * MM)
    stored = plots.save_figure(figures["cone"], tmp_path / "cone.png")
    with Image.open(stored) as picture:
        assert picture.width == int(86.0 * MM * 300)


def test_lines_are_the_history(figures, history):
    forces, velocities, radii, _ = figures["impact"].axes
    time = history.time.values * 1e6
    for axis, name, shown, scale in (
        (forces, "$F_x$", "tangential_force", 1.0),
        (velocities, "$V_x$, contact point", "contact_velocity", 1.0),
        (velocities, "$V_z$, approach", "normal_velocity", 1.0),
        (radii, "contact, $b$", "contact_radius", 1e6),
    ):
        line = lines(axis)[name]
        np.testing.assert_allclose(line.get_xdata(), time, rtol=1e-13)
        np.testing.assert_allclose(line.get_ydata(), scale * history[shown].values, rtol=1e-13)
    limit = lines(forces)[r"$\pm\mu F_z$"].get_ydata()
    np.testing.assert_allclose(limit, 0.2 * history.normal_force.values, rtol=1e-13)


def test_stick_radius_is_drawn_while_something_sticks(figures, history):
    """In gross slip there is no line, neither along zero nor up to the stick that follows."""
    drawn = lines(figures["radii"].axes[0])["stick zone, $a$"].get_ydata()
    stick, time = history.stick_radius.values, history.time.values
    start, *_, end = np.unique(history.phase_start)[1:]
    np.testing.assert_allclose(drawn[stick > 0.0], 1e6 * stick[stick > 0.0], rtol=1e-13)
    assert np.all(np.isnan(drawn[(time > 0.0) & (time < start)]))
    after = drawn[(time > end) & (time < time[-1])]
    assert after[0] == 0.0, "the line comes down to zero where the stick zone vanishes"
    assert np.all(np.isnan(after[1:]))


def test_energies_fill_the_whole(figures):
    """The stack of energies ends at 1 at all times: none is lost, none drawn twice."""
    top = figures["impact"].axes[3].collections[-1].get_paths()[0].vertices
    assert top[:, 1].max() == pytest.approx(1.0, abs=1e-9)
    assert len(figures["impact"].axes[3].collections) == 6


def test_normal_losses_are_drawn_where_there_are_any(hit, history):
    """Eight shares of energy that end at 1; a history stored without losses has six."""
    law = carom.KelvinVoigt(restitution=0.7)
    lossy = carom.impact(hit.pair, speed=2.0, angle="30 deg", losses=law).history(51)
    axis = plots.plot_impact(lossy).axes[3]
    edges = axis.collections[-1].get_paths()[0].vertices[:, 1]
    assert axis.collections[-1].get_label() == "losses in shear"
    assert edges.max() == pytest.approx(1.0, abs=1e-9)
    start = lossy.normal_kinetic_energy + lossy.tangential_kinetic_energy
    lost = float(lossy.shear_loss[-1] / start[0])
    assert 1.0 - edges.min() == pytest.approx(lost, abs=1e-9)
    assert len(axis.collections) == 8
    without = plots.plot_impact(history.drop_vars(["normal_loss", "shear_loss"]))
    assert len(without.axes[3].collections) == 6


def test_bands_are_the_phases(figures, history, hit):
    for axis in figures["impact"].axes[:3]:
        bands = [(patch.get_x(), patch.get_width()) for patch in axis.patches]
        expected = [(p.start * 1e6, (p.end - p.start) * 1e6) for p in hit.phases]
        np.testing.assert_allclose(bands, expected, rtol=1e-12)


def test_kinds_of_phases_differ_without_colour(figures):
    """Bands of different kind or sign differ in hatch."""
    entries = figures["impact"].legends[0].get_patches()
    hatches = [entry.get_hatch() for entry in entries]
    assert len(set(hatches)) == len(hatches) == 4


def test_cone_holds_the_whole_path(figures, history):
    axis = figures["cone"].axes[0]
    parts = [line.get_xydata() for line in axis.lines if line.get_zorder() == 2][2:]
    whole = np.column_stack([history.normal_force, history.tangential_force])
    drawn = np.concatenate(parts)
    assert np.isin(whole[:, 0], drawn[:, 0]).all()
    assert np.all(np.abs(drawn[:, 1]) <= 0.2 * drawn[:, 0] * (1.0 + 1e-12))
    assert {"stick", "slip", "gross slip"} <= set(lines(axis))


def test_cone_takes_a_load_path_without_phases(history):
    """The same forces along steps are one line, with a start and an end."""
    forces = history[["normal_force", "tangential_force", "friction"]].drop_vars("time")
    axis = plots.plot_cone(forces.rename(time="step")).axes[0]
    line = lines(axis)["load path"]
    np.testing.assert_allclose(line.get_ydata(), history.tangential_force, rtol=1e-13)
    assert {"start", "end"} <= set(lines(axis))


def test_cone_of_two_directions_is_a_circle(hit):
    """F/(mu F_z) along the contact, inside the circle of radius one; a straight path, too."""
    moved = [[1e-7, 0.0], [1e-7, 1e-7], [0.0, 1e-7]]
    path = carom.load_path(hit.pair, normal_force=[5.0, 10.0, 10.0], displacement=moved)
    axis = path.plot().axes[0]
    drawn = np.column_stack(lines(axis)["load path"].get_data())
    limit = hit.pair.friction * path.normal_force[:, None]
    np.testing.assert_allclose(drawn, path.tangential_force / limit, rtol=1e-13)
    circle = np.hypot(*lines(axis)[r"$\mu F_z$"].get_data())
    np.testing.assert_allclose(circle, 1.0, rtol=1e-13)
    assert {"start", "end"} <= set(lines(axis))


def test_arrows_of_a_path_that_is_retraced_do_not_coincide(hit):
    swing = 1.6 * np.sin(np.linspace(0.0, 4.0 * np.pi, 201))
    path = carom.load_path(hit.pair, normal_force=10.0, tangential_force=swing)
    axis = plots.plot_cone(path.to_dataset()).axes[0]
    heads = np.array([note.xy for note in axis.texts])[:, 1]
    assert np.diff(np.sort(heads)).min() > 0.2, "in N; a head is 0.1 N long"


def test_profiles_are_the_fields(figures, fields, hit):
    axis = figures["line"].axes[0]
    middle = fields.traction_x.values[50] * 1e-6
    np.testing.assert_allclose(lines(axis)["$f_x$"].get_ydata(), middle, rtol=1e-13)
    radial = hit.radial(MICROSLIP)
    memory, springs = figures["memory"].axes[1:]
    np.testing.assert_allclose(memory.lines[1].get_ydata(), radial.memory_g, rtol=1e-13)
    np.testing.assert_allclose(springs.lines[1].get_ydata(), radial.memory_q * 1e6, rtol=1e-13)
    ends = [patch.get_x() + patch.get_width() for patch in memory.patches]
    expected = [radial.stick_radius.item() * 1e6, radial.contact_radius.item() * 1e6]
    np.testing.assert_allclose(ends, expected, rtol=1e-12)


def test_cross_marks_the_largest_stress(figures, hit):
    stress = hit.stress(MICROSLIP)
    (cross,) = (line for line in figures["stress"].axes[0].lines if line.get_marker() == "+")
    place = [stress.max_von_mises_x.item() * 1e6, stress.max_von_mises_z.item() * 1e6]
    np.testing.assert_allclose(cross.get_xydata()[0], place, rtol=1e-12)


def test_regime_bands_end_at_1_2_chi_and_4_chi_minus_1(figures):
    patches = figures["curve"].axes[0].patches
    ends = [patch.get_x() + patch.get_width() for patch in patches]
    np.testing.assert_allclose(ends, [1.0, 2.88, 4.76, 6.0], rtol=1e-14)


@pytest.mark.slow
def test_drawing_needs_no_solver(history, tmp_path):
    """A stored history is read and drawn in a process that never loads the solution."""
    stored, picture = save(history, tmp_path / "hit.nc"), tmp_path / "hit.svg"
    code = (
        "import sys, carom.plots as plots; from carom import read\n"
        f"plots.save_figure(plots.plot_impact(read({str(stored)!r})), {str(picture)!r})\n"
        "assert 'carom.dimensionless.solution' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    assert f'width="{72.0 * 178.0 * MM:.6f}pt"' in picture.read_text(encoding="utf-8")


def test_the_users_settings_neither_matter_nor_change(history):
    with matplotlib.rc_context({"font.size": 30.0, "lines.linewidth": 9.0}):
        axis = plots.plot_cone(history).axes[0]
        assert matplotlib.rcParams["font.size"] == 30.0
    assert axis.xaxis.label.get_size() == 7.5


def test_every_phase_has_its_band():
    """Slip has no sign where bodies only spin about the normal."""
    assert {*BANDS} == {("stick", 0), *product(("slip", "gross slip"), SIGNS)}
