"""Figures in the size, font and style that a user wants; of results and of several impacts."""

import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from tests.checks import refused

import carom
from carom import plots, verify
from carom.plots.legends import fitting_columns
from carom.plots.style import colours

MM = 1.0 / 25.4


@pytest.fixture(scope="module")
def drawers(pair, hit):
    """Every public function that draws, with what it draws."""
    path = carom.load_path(pair, normal_force=10.0, tangential_force=[0.0, 1.2, -1.2])
    psi = [0.5, 1.0, 3.0]
    law = carom.dem.LinearSpring()
    of_impacts = "impact forces radii patch profiles stress spectrum wear contact"
    inputs = {
        **{f"plot_{name}": hit for name in of_impacts.split()},
        "plot_cone": path,
        "plot_strength": carom.bearable_speeds(pair, angle=["0 deg", "60 deg"]),
        "plot_curve": carom.curve(1.44, [0.0, 0.5, 1.0, 6.0]),
        "plot_regime_map": carom.regime_map([0.5, 2.0, 6.0], [1.0, 1.44]),
        "plot_laws": verify.rank([law], psi_1=psi),
        "plot_error_map": verify.error_map(law, psi, [1.2, 1.4]),
        "plot_score": verify.score({"psi_1": psi, "psi_2": carom.rebound(psi, 1.44)}, chi=1.44),
    }
    assert set(inputs) == {name for name in plots.__all__ if name.startswith("plot_")}
    return inputs


@pytest.fixture(scope="module")
def usual(drawers):
    """What they draw, by their names."""
    return {name: getattr(plots, name)(values) for name, values in drawers.items()}


def texts(figure):
    """Return the texts that can be seen, once drawn."""
    figure.draw_without_rendering()
    return [text for text in figure.findobj(Text) if text.get_text() and text.get_visible()]


@pytest.mark.slow
def test_every_figure_has_the_width_and_the_font_that_were_asked_for(drawers, usual):
    """The larger font is that of labels; no text keeps the size of the usual one."""
    for name, values in drawers.items():
        small = {text.get_fontsize() for text in usual[name].findobj(Text)}
        figure = getattr(plots, name)(values, width=150.0, font_size=9.5)
        assert figure.get_figwidth() == pytest.approx(150.0 * MM, rel=1e-12), name
        sizes = {round(text.get_fontsize(), 3) for text in texts(figure)}
        assert max(sizes) == pytest.approx(9.5), name
        assert max(small) == pytest.approx(7.5), name
        assert min(sizes) > min(small), name


def test_a_style_of_matplotlib_goes_on_top_and_stays_with_the_figure(hit):
    """Ticks are made when the figure is drawn, long after the style was set."""
    before = dict(matplotlib.rcParams)
    figure = hit.plot(style={"font.family": "serif", "axes.linewidth": 2.0})
    assert {text.get_fontfamily()[0] for text in texts(figure)} == {"serif"}
    assert figure.axes[0].spines["left"].get_linewidth() == 2.0
    assert dict(matplotlib.rcParams) == before


@pytest.mark.parametrize(
    ("look", "said"),
    [
        ({"width": 5.0}, "width: 5.0 cannot be used; must be a number of mm from 20 to 1000"),
        ({"width": "wide"}, "width: 'wide' cannot be used; "),
        ({"font_size": float("nan")}, "font_size: nan cannot be used; "),
        ({"style": "no such style"}, "style: 'no such style' cannot be used; must be a style of"),
        ({"style": {"no.such": 1}}, "must be a style of matplotlib, a style file or"),
        ({"style": "dark_background"}, "its ground is dark, and Carom draws black lines"),
        ({"fontsize": 8.0}, "fontsize: no keyword of plot_forces; did you mean"),
    ],
)
def test_what_no_figure_can_look_like_is_refused_in_one_line(hit, look, said):
    assert said in refused("", plots.plot_forces, hit, **look)


def test_a_result_is_drawn_as_its_dataset_is(pair, hit):
    path = carom.load_path(pair, normal_force=10.0, tangential_force=[0.0, 1.2, -1.2])
    largest = 0.5 * hit.duration
    twins = [
        (plots.plot_impact(hit), plots.plot_impact(hit.to_dataset())),
        (plots.plot_cone(path), plots.plot_cone(path.to_dataset())),
        (plots.plot_profiles(hit, at="21 us"), plots.plot_profiles(hit.radial("21 us"))),
        (plots.plot_profiles(path), plots.plot_profiles(path.radial(-1))),
        (plots.plot_profiles(path, at=1), plots.plot_profiles(path.radial(1))),
        (plots.plot_spectrum(hit), plots.plot_spectrum(hit.spectrum())),
    ]
    for one, two in twins:
        for axis, other in zip(one.axes, two.axes, strict=True):
            for line, twin in zip(axis.lines, other.lines, strict=True):
                np.testing.assert_array_equal(line.get_ydata(), twin.get_ydata())
    title = plots.plot_patch(hit).axes[0].get_title()
    time = float(title.splitlines()[0].split("=")[1].split("\u00a0")[0].strip(" $"))
    assert time == pytest.approx(1e6 * largest, rel=0.02)  # three digits, one of 200 times


def test_several_impacts_are_laid_over_each_other(pair, hit):
    """Each has its colour, its name and its own values; friction's share ends at what is lost."""
    steeper = carom.impact(pair, speed=2.0, angle="10 deg")
    figure = plots.plot_impact({"10 deg": steeper, "30 deg": hit})
    forces, _, _, lost = figure.axes
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["10 deg", "30 deg"]
    for one, each in zip(forces.lines[1:3], (steeper, hit), strict=True):
        values = each.to_dataset()["tangential_force"].values
        np.testing.assert_allclose(one.get_ydata(), values, rtol=1e-12)
    for one, each in zip(lost.lines[1:], (steeper, hit), strict=True):
        energy = 0.5 * pair.normal_mass * 2.0**2
        assert one.get_ydata()[-1] == pytest.approx(each.dissipated_energy / energy, rel=1e-9)
    numbered = plots.plot_radii([hit.history(), steeper])
    assert [text.get_text() for text in numbered.legends[0].get_texts()] == ["1", "2"]
    refused("there is nothing to draw", plots.plot_radii, [])
    refused("plot_radii draws", plots.plot_radii, [hit, 3.0])


def test_zero_is_white_where_a_quantity_has_a_sign():
    """To the last bit of eight: matplotlib's map has 256 colours, none of them quite white."""
    for name in ("traction_x", "sigma_xz", "principal_1"):
        actual = colours(name, [-3.0, 1.0])
        shade = matplotlib.colormaps[actual["cmap"]](
            -actual["vmin"] / (actual["vmax"] - actual["vmin"])
        )
        assert actual["vmax"] == -actual["vmin"] == 3.0
        assert min(shade[:3]) > 0.96
    assert "vmin" not in colours("pressure", [0.0, 2.0])


def test_a_legend_has_as_many_columns_as_fit():
    """A legend drawn with so many is no wider than the room; one column more would be wider."""
    names = ("one", "two", "three", "a longer one", r"$\pm\mu F_z$")
    with plots.style.style():
        figure, axis = plots.style.single_axis(width=300.0)
        for text in names:
            axis.plot([], label=text)
        handles = axis.get_legend_handles_labels()[0]
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        wide = {}
        for columns in range(1, 6):
            legend = axis.legend(handles=handles, ncols=columns)
            width = legend.get_window_extent(canvas.get_renderer()).width
            wide[columns] = width * 72.0 / figure.dpi
        for columns in range(1, 5):
            assert fitting_columns(handles, 5, wide[columns] * 1.05) == columns
    assert fitting_columns(handles, 5, 10.0) == 1


def test_a_stored_pdf_has_the_text_of_the_figure_in_fonts_that_can_be_edited(hit, tmp_path):
    """TrueType (42), as journals ask, however it is stored; Type 3 would be garbled."""
    figure = plots.plot_forces(hit)
    figure.savefig(tmp_path / "direct.pdf")
    plots.save_figure(figure, tmp_path / "stored.pdf")
    for name in ("direct.pdf", "stored.pdf"):
        content = (tmp_path / name).read_bytes()
        assert b"/Type3" not in content
        assert b"/CIDFontType2" in content or b"/TrueType" in content


def test_a_named_style_leaves_the_sizes_of_fonts_as_they_are_wanted(hit):
    figure = plots.plot_forces(hit, style="ggplot")
    assert to_rgb(figure.axes[0].get_facecolor()) == to_rgb("#E5E5E5")
    assert {text.get_fontsize() for text in texts(figure)} == {7.5, 7.0}
    larger = plots.plot_forces(hit, style="ggplot", font_size=9.0)
    assert max(text.get_fontsize() for text in texts(larger)) == 9.0


def test_an_instant_is_refused_where_the_dataset_has_its_own(hit):
    words = "at: this dataset has its instant; leave it out"
    refused(words, plots.plot_patch, hit.fields("12 us"), at="20 us")


def test_boundary_elements_are_drawn_along_the_line_between_their_rows(pair):
    """Half-way between two rows of elements the traction is the mean of both."""
    coarse = carom.BoundaryElements(elements=16, steps=60)
    full = carom.impact(pair, speed=2.0, angle="30 deg", method=coarse)
    fields = full.fields(0.3 * full.duration)
    line = plots.plot_profiles(full, at=0.3 * full.duration).axes[0].lines[1]
    rows = np.abs(fields.y.values).argsort()[:2]
    expected = fields.traction_x.values[rows].mean(axis=0)
    np.testing.assert_allclose(1e6 * line.get_ydata(), expected, rtol=1e-9, atol=1.0)


def test_a_figure_is_a_picture_in_a_notebook(hit):
    assert plots.plot_forces(hit)._repr_png_().startswith(b"\x89PNG")


SEVERAL = {"plot_impact", "plot_wear", "plot_contact", "plot_laws", "plot_score", "plot_strength"}


@pytest.mark.slow
def test_what_is_one_panel_is_drawn_into_axes_of_a_user(drawers, usual):
    """As it is without; the rest of the figure, its size and a user's settings stay."""
    fields = drawers["plot_profiles"].fields("21 us")
    one = {"plot_profiles": (fields, plots.plot_profiles(fields))}
    one = {name: (values, usual[name]) for name, values in drawers.items()} | one
    for name, (values, same) in one.items():
        if name in SEVERAL:
            continue
        figure, (left, right) = pyplot.subplots(1, 2, figsize=(9.0, 4.0), layout="constrained")
        assert getattr(plots, name)(values, ax=right) is figure, name
        alone = same.axes[0]
        assert not left.has_data(), name
        for kind in ("lines", "patches", "collections", "texts"):
            kinds = [len(getattr(axis, kind)) for axis in (right, alone)]
            assert kinds[0] == kinds[1] or (name, kind) in OTHER_SIZE, (name, kind)
        assert right.get_ylabel() == alone.get_ylabel(), name
        assert right.get_xlim() == pytest.approx(alone.get_xlim()), name
        assert figure.get_size_inches() == pytest.approx([9.0, 4.0]), name
        texts(figure)
        pyplot.close(figure)


OTHER_SIZE = {("plot_regime_map", "lines"), ("plot_regime_map", "texts")}  # labels find other room


@pytest.mark.slow
def test_nothing_is_cut_in_a_plain_figure_of_a_user(drawers):
    """Legends have room above, in the last row below what stands there, names of borders aside."""
    for name, given in drawers.items():
        given = given.fields("21 us") if name == "plot_profiles" else given
        for rows in (1, 2) if name not in SEVERAL else ():
            figure, axes = pyplot.subplots(rows, 1, figsize=(6.4, 4.8 * rows), squeeze=False)
            getattr(plots, name)(given, ax=axes[-1, 0])
            figure.draw_without_rendering()
            box, top = axes[-1, 0].get_tightbbox(), figure.bbox.y1
            ceiling = axes[0, 0].get_tightbbox().y0 if rows > 1 else top
            assert box.y1 <= ceiling + 1.0, name
            assert box.y0 >= -1.0, name
            assert box.x1 <= figure.bbox.x1 + 1.0, name
            pyplot.close(figure)


def test_several_panels_take_no_axes(drawers, hit):
    axis = Figure().subplots()
    several = [(getattr(plots, name), drawers[name]) for name in sorted(SEVERAL)]
    for draw, values in [*several, (plots.plot_profiles, hit)]:
        refused(r"^ax: this figure has several panels, and", draw, values, ax=axis)
    assert not axis.has_data()
    refused(r"^ax: 5 cannot be used; must be Axes", plots.plot_forces, hit, ax=5)
    with pytest.raises(carom.InputError, match=r"^width: the figure that ax belongs to has its"):
        plots.plot_forces(hit, ax=axis, width=100.0)


def test_a_style_with_axes_is_that_of_what_is_drawn(hit):
    """Without one the user's settings hold."""
    with matplotlib.rc_context({"font.size": 13.0, "axes.labelsize": 13.0}):
        sizes = []
        for look in ({}, {"font_size": 9.5}):
            axis = Figure().subplots()
            plots.plot_forces(hit, ax=axis, **look)
            sizes.append(axis.yaxis.label.get_fontsize())
            sizes.append(axis.get_legend().get_texts()[0].get_fontsize())
    assert sizes[1] == 13.0
    assert sizes[3] == pytest.approx(9.0)


def test_every_docstring_says_what_all_figures_take(drawers):
    for name in (*drawers, "animate"):
        text = getattr(plots, name).__doc__
        parts = ["Parameters\n", "**look : width, font_size, style, ax\n", "Returns\n", "Raises\n"]
        places = [text.index(part) for part in (*parts, "Examples\n")]
        assert places == sorted(places), name
        assert text.count("**look") == 1, name
