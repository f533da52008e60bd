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
