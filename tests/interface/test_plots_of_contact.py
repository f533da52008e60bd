"""The contact: at instants of an impact, whose panels agree, and as a map with slip arrows."""

import numpy as np
import pytest
from matplotlib.quiver import Quiver
from tests.checks import refused

import carom
from carom import plots
from carom.plots.patch import arrows

MICROSLIP = 21e-6  # an instant of `hit` with a slip ring


@pytest.fixture(scope="module")
def steep(pair):
    return carom.impact(pair, speed=2.0, angle="25 deg")


def panels(figure, count):
    """Return the patches, the profiles below them, and the axes of the force."""
    axes = figure.axes
    return axes[:count], axes[count : 2 * count], axes[2 * count]


def test_every_phase_is_shown_and_instants_are_in_order(steep):
    patches, _, force = panels(plots.plot_contact(steep), 6)
    kinds = [axis.get_title().split(",")[0] for axis in patches]
    shown = "gross slip +; stick; slip \u2212; gross slip \u2212"
    assert list(dict.fromkeys(kinds)) == shown.split("; ")
    times = [line.get_xdata()[0] for line in force.lines if line.get_marker() == "o"]
    assert len(times) == 6
    assert times == sorted(times)
    assert [text.get_text() for text in force.texts] == list("abcdef")


def test_profiles_and_marks_are_the_tractions_and_forces_of_the_impact(steep):
    """A mark lies at F_x of its instant, and the profile below a patch is f_x along y = 0."""
    times = [0.3 * steep.duration, 0.7 * steep.duration]
    figure = plots.plot_contact(steep, [steep.fields(time) for time in times])
    _, profiles, force = panels(figure, 2)
    marks = [line for line in force.lines if line.get_marker() == "o"]
    for time, profile, mark in zip(times, profiles, marks, strict=True):
        line = profile.lines[1]
        x, f = 1e-6 * line.get_xdata(), 1e6 * line.get_ydata()
        fields = steep.fields(time, points=np.column_stack([x, 0.0 * x]))
        largest = np.abs(fields.traction_x.values).max()
        np.testing.assert_allclose(f, fields.traction_x.values, atol=1e-9 * largest)
        assert mark.get_xdata()[0] == pytest.approx(1e6 * time, rel=1e-12)
        expected = float(steep.history(2001)["tangential_force"].interp(time=time))
        assert mark.get_ydata()[0] == pytest.approx(expected, rel=1e-5)


def test_one_scale_of_colours_holds_for_all_patches(steep):
    """Its ends are the largest traction shown: here in the centre, while the ball sticks."""
    times = [0.2 * steep.duration, 0.4 * steep.duration, 0.9 * steep.duration]
    patches, _, _ = panels(plots.plot_contact(steep, [steep.fields(time) for time in times]), 3)
    most = max(float(steep.fields(t, points=[[0.0, 0.0]]).traction_x[0]) for t in times)
    for axis in patches:
        assert axis.collections[0].get_clim() == pytest.approx((-1e-6 * most, 1e-6 * most))


def test_tractions_without_bound_at_the_edge_do_not_set_the_scale(steep):
    """Of viscous bodies while loading; the key to the colours then says that there is more."""
    losses = carom.KelvinVoigt(restitution=0.3)
    viscous = carom.impact(steep.pair, speed=2.0, angle="60 deg", losses=losses)
    fields = viscous.fields(0.1 * viscous.duration)
    figure = plots.plot_contact(viscous, [fields])
    distance = np.hypot(fields.y.values[:, None], fields.x.values)
    inside = distance < 0.9 * float(fields.contact_radius)
    patch, key = figure.axes[0], figure.axes[-1]
    low, high = patch.collections[0].get_clim()
    assert high == -low
    assert key.get_ylabel() == "$f_x$\u00a0(GPa)"
    assert high >= 1e-9 * np.abs(fields.traction_x.values[inside]).max()
    assert high < 0.7e-9 * np.abs(fields.traction_x.values).max()
    assert key._colorbar.extend == "both"


def test_a_stored_impact_is_drawn_from_its_history_and_fields(steep, tmp_path):
    carom.save(steep.history(), tmp_path / "hit.nc")
    carom.save(steep.fields("12 us"), tmp_path / "fields.nc")
    history, fields = carom.read(tmp_path / "hit.nc"), carom.read(tmp_path / "fields.nc")
    assert len(plots.plot_contact(history, [fields], width=86.0).axes) == 4


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"count": 0}, "count: 0 cannot be used; must be a whole number"),
        ({"count": 2.5}, "count: 2.5 cannot be used"),
        ({"frames": []}, "frames: 0 cannot be used; must be the fields of 1 to 9 instants"),
        ({"frames": [3.0]}, "what was given is no dataset but of type float"),
        ({"frames": 3.0}, "frames: 3.0 cannot be used; must be the fields of 1 to 9 instants"),
        ({"fontsize": 9}, "fontsize: no keyword of plot_contact; did you mean"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_one_line(steep, options, said):
    refused(said, plots.plot_contact, steep, **options)


def test_arrows_are_slip_velocities_in_the_slip_zone(hit):
    fields = hit.fields(MICROSLIP)
    (quiver,) = plots.plot_patch(fields).axes[0].findobj(Quiver)
    radius = np.hypot(quiver.X, quiver.Y) * 1e-6
    assert radius.size >= 20
    assert np.all((radius >= fields.stick_radius.item()) & (radius <= fields.contact_radius.item()))
    at = fields.sel(x=quiver.X[3] * 1e-6, y=quiver.Y[3] * 1e-6, method="nearest")
    slope = (at.slip_velocity_y / at.slip_velocity_x).item()
    assert quiver.V[3] / quiver.U[3] == pytest.approx(slope, rel=1e-12)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.7, 0.9])
def test_arrows_stay_in_the_contact_and_clear_of_each_other(hit, share):
    """Arrows along x are shorter than the way to the border and to the next at the same height."""
    slip = next(phase for phase in hit.phases if phase.kind == "slip")
    actual = arrows(hit.fields(slip.start + share * (slip.end - slip.start)))
    contact = hit.contact(slip.start + share * (slip.end - slip.start)).radius
    x, y = np.abs(actual.x), actual.y
    assert np.all(np.hypot(x + 0.5 * actual.longest, y) <= contact * (1.0 + 1e-9))
    apart = np.hypot(actual.x[:, np.newaxis] - actual.x, y[:, np.newaxis] - y)
    np.fill_diagonal(apart, np.inf)
    assert actual.longest < 0.95 * apart.min(initial=np.inf)


def test_zero_traction_has_the_middle_colour(hit):
    """Limits of the signed traction are opposite; pressure starts at its own smallest value."""
    fields = hit.fields(MICROSLIP)
    low, high = plots.plot_patch(fields).axes[0].collections[0].get_clim()
    assert low == -high < 0.0
    assert plots.plot_patch(fields, "pressure").axes[0].collections[0].get_clim()[0] == 0.0


def test_a_contact_that_sticks_has_no_arrows(hit):
    stick = next(phase for phase in hit.phases if phase.kind == "stick")
    figure = plots.plot_patch(hit.fields(0.5 * (stick.start + stick.end)))
    assert not figure.axes[0].findobj(Quiver)


def test_the_middle_of_a_sliding_contact_has_its_arrow(hit):
    """On a map of this width the lattice is odd, with a place at the centre."""
    time = 0.5 * hit.phases[0].end
    actual = arrows(hit.fields(time), reach=1.28 * hit.contact(time).radius)
    assert np.hypot(actual.x, actual.y).min() == 0.0


LAWS = {
    "elastic": {},
    "viscous": {"losses": carom.KelvinVoigt(restitution=0.9)},
    "relaxing": {"losses": carom.StandardLinearSolid(modulus_ratio=2.0, relaxation_time="10 us")},
    "yielding": {"losses": carom.ElasticPlastic(yield_velocity="0.1 m/s")},
    "metal": {"losses": carom.Metal(flow_stress="1 GPa")},
    "plate": {"thickness": "5 mm"},
    "frictionless": {"friction": 0.0},
}
MAPS = {"fields": (plots.plot_patch, plots.plot_profiles), "radial": (plots.plot_profiles,)}


def struck(pair, losses=None, friction=0.2, **wall):
    """Return an impact on a wall, by one of the laws of losses."""
    struck = carom.HalfSpace(material=pair.second.material, **wall)
    pair = carom.Pair(pair.first, struck, friction)
    return carom.impact(pair, speed=2.0, angle="30 deg", losses=losses)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("share", [0.0, 1.0])
def test_at_first_touch_and_separation_nothing_is_pressed(pair, law, share):
    """Whatever the engine: the contact is a point, without pressure, traction or slipping."""
    hit = struck(pair, **LAWS[law])
    fields = hit.fields(share * hit.duration)
    assert float(fields.contact_radius) == float(fields.stick_radius) == 0.0
    for name in ("pressure", "traction_x", "slip_velocity_x", "slip_velocity_y", "zone"):
        assert not fields[name].any(), name


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("share", [0.0, 1.0])
def test_pictures_outside_the_contact_say_apart(pair, law, share):
    """No circle, arrows, speed or phase of a contact that is none; within it there are."""
    hit = struck(pair, **LAWS[law])
    time = share * hit.duration
    for method, functions in MAPS.items():
        for draw in functions:
            figure = draw(getattr(hit, method)(time))
            title = figure.axes[0].get_title() or figure.get_suptitle()
            assert title.startswith("apart, $t$ = ")
            assert "\n" not in title
            assert not [c for c in figure.axes[0].collections if isinstance(c, Quiver)]
    figure = plots.plot_patch(hit.fields(time), "pressure")
    assert [text.get_text() for text in figure.axes[0].texts] == ["apart"]
    assert plots.plot_patch(hit.fields(0.5 * hit.duration)).axes[0].get_title().count("apart") == 0


def test_the_stress_below_no_contact_has_no_largest(pair):
    hit = struck(pair)
    for time, marks in ((0.0, 0), (hit.duration, 0), (0.999 * hit.duration, 1)):
        figure = plots.plot_stress(hit.stress(time))
        assert sum(line.get_marker() == "+" for line in figure.axes[0].lines) == marks
        assert ("apart" in figure.axes[0].get_title()) == (marks == 0)


def test_a_film_and_a_row_of_patches_say_apart_at_their_ends(pair):
    hit = struck(pair, **LAWS["viscous"])
    frames = [hit.fields(share * hit.duration) for share in (0.0, 0.5, 1.0)]
    patches, _, _ = panels(plots.plot_contact(hit.history(), frames), 3)
    told = [axis.get_title().split(",")[0] for axis in patches]
    assert (told[0], told[2]) == ("apart", "apart")
    assert told[1] != "apart"


def test_just_inside_its_ends_a_contact_is_drawn(pair):
    for law in ("elastic", "viscous", "plate"):
        hit = struck(pair, **LAWS[law])
        for share in (1e-6, 1.0 - 1e-6):
            fields = hit.fields(share * hit.duration)
            assert float(fields.contact_radius) > 0.0
            assert not plots.plot_patch(fields).axes[0].get_title().startswith("apart")
