"""The map of a contact: where its slip arrows lie and how long they are, and its colours."""

import numpy as np
import pytest
from matplotlib.quiver import Quiver

import carom
from carom import plots
from carom.plots.patch import arrows

MICROSLIP = 21e-6  # an instant of the impact below with a slip ring


@pytest.fixture(scope="module")
def hit():
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    return carom.impact(pair, speed=2.0, angle="30 deg")


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
    found = arrows(hit.fields(slip.start + share * (slip.end - slip.start)))
    contact = hit.contact(slip.start + share * (slip.end - slip.start)).radius
    x, y = np.abs(found.x), found.y
    assert np.all(np.hypot(x + 0.5 * found.longest, y) <= contact * (1.0 + 1e-9))
    apart = np.hypot(found.x[:, np.newaxis] - found.x, y[:, np.newaxis] - y)
    np.fill_diagonal(apart, np.inf)
    assert found.longest < 0.95 * apart.min(initial=np.inf)


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
    found = arrows(hit.fields(time), reach=1.28 * hit.contact(time).radius)
    assert np.hypot(found.x, found.y).min() == 0.0
