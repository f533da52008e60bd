"""Figures of extreme impacts can be drawn; what cannot be drawn is refused in one line."""

import numpy as np
import pytest
from matplotlib.quiver import Quiver
from tests.checks import refused

import carom
from carom import plots
from carom.impacts.curves import regime_map

MICROSLIP = 21e-6  # an instant of the impact below with a slip ring
KINDS = {  # what makes them, and the ends of the names of what draws them
    "history": (lambda hit: hit.history(51), "impact forces radii cone"),
    "fields": (lambda hit: hit.fields(MICROSLIP), "patch profiles"),
    "radial": (lambda hit: hit.radial(MICROSLIP), "profiles"),
    "stress": (lambda hit: hit.stress(MICROSLIP), "stress"),
    "curve": (lambda _: carom.curve(1.44, [0.0, 1.0]), "curve"),
    "map": (lambda _: regime_map([0.5, 2.0], [1.0, 1.44]), "regime_map"),
    "spectrum": (lambda hit: hit.spectrum(n=51), "spectrum"),
    "wear": (lambda hit: hit.wear(), "wear"),
    "pair": (lambda hit: hit.pair, ""),
}


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda hit: plots.plot_patch(hit.fields(MICROSLIP), "zone"), "traction_x or pressure"),
        (lambda hit: plots.plot_patch(hit.fields(MICROSLIP, points=[[0, 0]])), "grid of rising x"),
        (lambda hit: plots.plot_profiles(hit.fields(MICROSLIP, [0, 1e-4], [1e-4])), "y = 0"),
        (lambda hit: plots.plot_stress(hit.stress(MICROSLIP), "stress"), "von_mises"),
        (lambda hit: plots.plot_stress(hit.fields(MICROSLIP)), "grid of z and x"),
        (lambda hit: plots.plot_stress(hit.stress(MICROSLIP, points=[[0, 0, 1e-5]])), "of z and x"),
    ],
)
def test_what_cannot_be_drawn_is_refused_in_one_line(hit, draw, said):
    refused(said, draw, hit)


@pytest.mark.first_case
@pytest.mark.parametrize(("make", "drawn"), KINDS.values(), ids=KINDS)
def test_datasets_of_another_kind_are_refused_in_one_line(hit, make, drawn):
    """The line tells what the function draws and what makes such a dataset; no KeyError."""
    values, drawn = make(hit), {f"plot_{name}" for name in drawn.split()}
    for name in (name for name in plots.__all__ if name.startswith("plot_")):
        if name in drawn:
            getattr(plots, name)(values)
        else:
            refused(rf"^{name} draws .*, what .* returns; ", getattr(plots, name), values)


def test_the_first_touch_and_an_impact_without_friction_can_be_drawn(hit):
    plots.plot_patch(hit.fields(0.0))
    smooth = carom.Pair(hit.pair.first, hit.pair.second, friction=0.0)
    free = carom.impact(smooth, speed=2.0, angle="30 deg")
    for draw in (plots.plot_impact, plots.plot_cone):
        draw(free.history(20))
    plots.plot_patch(free.fields(MICROSLIP))


SMALL = {  # of a touching contact, or of a single value
    "stress at touch": (plots.plot_stress, lambda hit: hit.stress(0.0)),
    "profiles at touch": (plots.plot_profiles, lambda hit: hit.radial(0.0)),
    "two times": (plots.plot_impact, lambda hit: hit.history(2)),
    "one psi": (plots.plot_curve, lambda _: carom.curve(1.44, [1.0])),
    "one cell": (plots.plot_regime_map, lambda _: carom.regime_map([1.5], [1.44])),
}


@pytest.mark.parametrize(("draw", "make"), SMALL.values(), ids=SMALL)
def test_small_datasets_are_drawn_without_a_warning(hit, draw, make):
    assert draw(make(hit)).axes


def test_what_is_no_map_or_line_is_refused(hit):
    refused("on a grid of rising", plots.plot_stress, hit.stress(1e-5, z=[0.0]))
    refused("on a grid of rising", plots.plot_patch, hit.fields(1e-5, x=[0.0], y=[0.0]))
    refused("no line through", plots.plot_profiles, hit.fields(1e-5, x=[0.0, 0.0], y=[0.0, 0.0]))


def test_arrows_of_a_load_path_are_slips(pair):
    """Where there is no time, arrows show how far the surfaces have slid, against the traction."""
    pushed = carom.load_path(pair, normal_force=[10.0, 10.0], tangential_force=[0.0, -1.5])
    figure = plots.plot_patch(pushed.fields())
    (arrows,) = [item for item in figure.axes[0].collections if isinstance(item, Quiver)]
    assert np.all(arrows.U < 0.0)
    assert figure.axes[0].get_title().startswith("slip \N{MINUS SIGN}\nlongest arrow: 2")
