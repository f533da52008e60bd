"""Spectra as users have them: what is asked for, refused, stored and drawn."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from tests.checks import refused

import carom
from carom import plots


def test_frequencies_are_those_asked_for(hit):
    assert_array_equal(hit.spectrum(["100 kHz", 0, 2.5e3]).frequency.values, [1e5, 0.0, 2.5e3])
    spectrum = hit.spectrum(max_frequency="1 MHz", n=5)
    assert_array_equal(spectrum.frequency.values, np.linspace(0.0, 1e6, 5))
    default = hit.spectrum().frequency.values
    assert (default.size, default[0]) == (601, 0.0)
    assert default[-1] * hit.duration == pytest.approx(6.0, rel=1e-14)


def test_variables_tell_unit_and_meaning(hit):
    spectrum = hit.spectrum(n=5)
    assert spectrum.normal_spectrum.units == spectrum.tangential_spectrum_imag.units == "N s"
    assert spectrum.moment_spectrum.units == "N m s"
    assert spectrum.normal_corner_frequency.units == spectrum.frequency.units == "Hz"
    assert "force" in spectrum.tangential_spectrum.long_name
    assert json.loads(spectrum.attrs["inputs"])["friction"] == 0.2
    radius = hit.pair.first.radius
    assert_allclose(spectrum.moment_spectrum, radius * spectrum.tangential_spectrum)


@pytest.mark.first_case
@pytest.mark.parametrize("law", [1e-3, 0.01, 0.3, 0.46, 0.48, 0.9, 1.0, "yields", "no friction"])
def test_corners_are_numbers_or_say_why_not(hit, law):
    """A spectrum without a minimum has no notch, and its figure no line for it."""
    losses, pair = None, hit.pair
    if law == "yields":
        losses = carom.ElasticPlastic(yield_velocity="1 mm/s")
    elif law == "no friction":
        pair = carom.Pair(pair.first, pair.second, friction=0.0)
    else:
        losses = carom.KelvinVoigt(restitution=law)
    spectrum = carom.impact(pair, speed=2.0, angle="30 deg", losses=losses).spectrum(n=1201)
    corners = [spectrum[name] for name in spectrum.data_vars if str(name).endswith("_frequency")]
    assert len(corners) == 6
    assert all(np.isfinite(corner) or corner.attrs["comment"] for corner in corners)
    falls = np.all(np.diff(spectrum.normal_spectrum.values) < 0.0)  # up to 6 over the duration
    notch = spectrum.normal_notch_frequency
    assert np.isnan(notch) == falls == (notch.attrs.get("comment", "").startswith("the amplitude"))
    _, names = plots.plot_spectrum(spectrum).axes[0].get_legend_handles_labels()
    assert ("first minimum" in names) == (not falls)
    if law == "no friction":
        assert not any(name.startswith("tangential") for name in names)
        assert spectrum.tangential_peak_frequency.comment == "there is no tangential force"


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"frequencies": [5.0, -1.0]}, "frequencies: -1.0 cannot be used; must be a list"),
        ({"frequencies": [float("nan")]}, "frequencies: nan cannot be used; must be a list"),
        ({"frequencies": [float("inf")]}, "frequencies: inf cannot be used; must be a list"),
        ({"frequencies": [1e9]}, "frequencies: 1000000000.0 .*spectra are known up to 32.3 MHz"),
        ({"frequencies": []}, r"frequencies: \[\] cannot be used"),
        ({"frequencies": [[1.0, 2.0]]}, r"frequencies: \[\[1.0, 2.0\]\] cannot be used"),
        ({"frequencies": "5 mm"}, "frequencies: '5 mm' cannot be used; that is not a value in Hz"),
        ({"frequencies": np.zeros(20_001)}, "frequencies: 20,001 are too many"),
        ({"frequencies": [1.0], "n": 5}, "frequencies: give them, or max_frequency and n"),
        ({"frequencies": [1.0], "max_frequency": 5.0}, "frequencies: give them, or max_frequency"),
        ({"max_frequency": 0.0}, "max_frequency: 0.0 cannot be used; must be positive"),
        ({"max_frequency": float("nan")}, "max_frequency: nan cannot be used; give a number in Hz"),
        ({"max_frequency": "1 GHz"}, "max_frequency: '1 GHz' .*spectra are known up to"),
        ({"n": 1}, "n: 1 cannot be used; must be a whole number of at least 2"),
        ({"n": 20_001}, "n: 20001 cannot be used; must be a whole number from 2 to 20000"),
    ],
)
def test_what_cannot_be_used_takes_one_line(hit, asked, said):
    refused(f"^{said}", hit.spectrum, **asked)


def test_stored_spectra_come_back_and_are_drawn(hit, tmp_path):
    spectrum = hit.spectrum(n=101)
    back = carom.read(carom.save(spectrum, tmp_path / "spectrum.nc"))
    assert back.identical(spectrum)
    stored = plots.save_figure(plots.plot_spectrum(back), tmp_path / "spectrum.png")
    assert stored.stat().st_size > 20_000


def test_marks_stand_at_the_corners(hit):
    """On the lines, in the unit of the axis, at 1/sqrt(2) and 1/2 of the largest amplitude."""
    spectrum = hit.spectrum(n=6001)
    axis = plots.plot_spectrum(spectrum).axes[0]
    marks = [line for line in axis.lines if line.get_marker() != "None" and line.get_xdata().size]
    places = {
        (str(line.get_marker()), line.get_color()): (line.get_xdata()[0], line.get_ydata()[0])
        for line in marks
    }
    assert len(places) == 4
    for name, color in (("normal", plots.style.BLUE), ("tangential", plots.style.VERMILION)):
        largest = 1e3 * float(spectrum[f"{name}_spectrum"].max())
        for mark, symbol, share in (("corner", "o", 0.5**0.5), ("half", "s", 0.5)):
            place, height = places[symbol, color]
            assert place == pytest.approx(1e-3 * float(spectrum[f"{name}_{mark}_frequency"]))
            assert height == pytest.approx(share * largest, rel=1e-4)


def test_spectra_that_are_odd_are_drawn_or_refused(hit):
    """In any order and with equal frequencies; not with one frequency."""
    plots.plot_spectrum(hit.spectrum([3e4, 1e3, 1e3, 0.0, 2e5]))
    refused("two frequencies above zero", plots.plot_spectrum, hit.spectrum([0.0, 1e4]))
