"""The contact through one impact: which instants are shown, and that all panels agree."""

import numpy as np
import pytest

import carom
from carom import plots


@pytest.fixture(scope="module")
def hit():
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    return carom.impact(pair, speed=2.0, angle="25 deg")


def panels(figure, count):
    """Return the patches, the profiles below them, and the axes of the force."""
    axes = figure.axes
    return axes[:count], axes[count : 2 * count], axes[2 * count]


def test_every_phase_is_shown_and_instants_are_in_order(hit):
    patches, _, force = panels(plots.plot_contact(hit), 6)
    kinds = [axis.get_title().split(",")[0] for axis in patches]
    assert list(dict.fromkeys(kinds)) == [
        "gross slip +",
        "stick",
        "slip \u2212",
        "gross slip \u2212",
    ]
    times = [line.get_xdata()[0] for line in force.lines if line.get_marker() == "o"]
    assert len(times) == 6
    assert times == sorted(times)
    assert [text.get_text() for text in force.texts] == list("abcdef")


def test_profiles_and_marks_are_the_tractions_and_forces_of_the_impact(hit):
    """A mark lies at F_x of its instant, and the profile below a patch is f_x along y = 0."""
    times = [0.3 * hit.duration, 0.7 * hit.duration]
    _, profiles, force = panels(plots.plot_contact(hit, [hit.fields(time) for time in times]), 2)
    marks = [line for line in force.lines if line.get_marker() == "o"]
    for time, profile, mark in zip(times, profiles, marks, strict=True):
        line = profile.lines[1]
        x, f = 1e-6 * line.get_xdata(), 1e6 * line.get_ydata()
        fields = hit.fields(time, points=np.column_stack([x, 0.0 * x]))
        largest = np.abs(fields.traction_x.values).max()
        np.testing.assert_allclose(f, fields.traction_x.values, atol=1e-9 * largest)
        assert mark.get_xdata()[0] == pytest.approx(1e6 * time, rel=1e-12)
        expected = float(hit.history(2001)["tangential_force"].interp(time=time))
        assert mark.get_ydata()[0] == pytest.approx(expected, rel=1e-5)


def test_one_scale_of_colours_holds_for_all_patches(hit):
    """Its ends are the largest traction shown: here in the centre, while the ball sticks."""
    times = [0.2 * hit.duration, 0.4 * hit.duration, 0.9 * hit.duration]
    patches, _, _ = panels(plots.plot_contact(hit, [hit.fields(time) for time in times]), 3)
    most = max(float(hit.fields(t, points=[[0.0, 0.0]]).traction_x[0]) for t in times)
    for axis in patches:
        assert axis.collections[0].get_clim() == pytest.approx((-1e-6 * most, 1e-6 * most))


def test_tractions_without_bound_at_the_edge_do_not_set_the_scale(hit):
    """Of viscous bodies while loading; the key to the colours then says that there is more."""
    losses = carom.KelvinVoigt(restitution=0.3)
    viscous = carom.impact(hit.pair, speed=2.0, angle="60 deg", losses=losses)
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


def test_a_stored_impact_is_drawn_from_its_history_and_fields(hit, tmp_path):
    carom.save(hit.history(), tmp_path / "hit.nc")
    carom.save(hit.fields("12 us"), tmp_path / "fields.nc")
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
def test_what_cannot_be_shown_is_refused_in_one_line(hit, options, said):
    with pytest.raises(carom.InputError) as refused:
        plots.plot_contact(hit, **options)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)
