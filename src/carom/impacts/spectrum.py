"""What an impact excites a body or a sensor with: the spectra of its forces, with corners."""

from __future__ import annotations

from functools import partial
from math import isnan
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.numerics.spectra import Pulse, corners, sampled, widest
from carom.impacts.outcome import InTime, Outcome
from carom.io.labels import attributes, labelled_dataset
from carom.quantities.arrays import Array, numbers, refuse_where
from carom.quantities.prefixes import text
from carom.quantities.refusals import refusal, refuse
from carom.quantities.units import Value, counted, positive

if TYPE_CHECKING:
    import xarray as xr

COUNT, WIDTH = 601, 6.0  # frequencies where none are told, and up to how many over the duration
NO_NOTCH = f"the amplitude has no minimum up to {WIDTH:g} over the duration"
PARTS: Any = {"": np.abs, "_real": np.real, "_imag": np.imag}
MOST, FARTHEST = 20_000, 1000.0  # the most that there may be, likewise


def forces(hit: Outcome, time: Array) -> Array:
    """Return normal and tangential force in N, a row each, at times in s."""
    scales, solution = hit.scales, cast(InTime, hit.solution)
    states = solution.at(np.clip(time / scales.time, 0.0, solution.duration))
    units = scales.force, scales.tangential_force
    return np.stack([states.normal_force * units[0], states.force * units[1]])


def pulse_of(hit: Outcome, highest: float) -> Pulse:
    """Return both forces ready for their spectra up to a highest frequency in Hz."""
    solution = cast(InTime, hit.solution)
    ends = [instant for phase in solution.phases for instant in (phase.start, phase.end)]
    instants = np.unique([0.0, *ends, solution.duration]) * hit.scales.time
    return sampled(partial(forces, hit), instants, highest)


def read_frequencies(
    frequencies: ArrayLike | None, highest: Value | None, count: int | None, duration: float
) -> Array:
    """Return frequencies in Hz: those given, or evenly spaced from zero; or raise InputError."""
    most = FARTHEST / duration
    if frequencies is None:
        top = WIDTH / duration if highest is None else positive("max_frequency", highest)
        number = COUNT if count is None else counted("n", count, 2, MOST)
        refuse(top > most and refusal("max_frequency", highest, _too_high(most)))
        return np.linspace(0.0, top, number)
    both = highest is not None or count is not None
    refuse(both and "frequencies: give them, or max_frequency and n, not both")
    allowed = "must be a list of numbers in Hz, zero or positive and finite"
    values = np.atleast_1d(numbers("frequencies", frequencies, allowed, "Hz"))
    line = values.ndim == 1 and values.size > 0
    many = f"frequencies: {values.size:,} are too many; give at most {MOST:,}"
    refuse(not line and refusal("frequencies", frequencies, allowed), values.size > MOST and many)
    refuse_where("frequencies", values, ~((values >= 0.0) & (values < np.inf)), allowed)
    refuse_where("frequencies", values, values > most, _too_high(most))
    return values


def _too_high(most: float) -> str:
    range_of_spectra = f"spectra are known up to {text(most, 'Hz', 4)}"
    return f"{range_of_spectra}, {FARTHEST:g} over the duration of the contact"


def spectrum_dataset(hit: Outcome, frequencies: Array) -> xr.Dataset:
    """Return the spectra of the forces along `frequency`, their corners, and what they are of."""
    normal, tangential = pulse_of(hit, float(frequencies.max())).transform(frequencies)
    moment = hit.pair.first.radius * tangential
    spectra = {"normal": normal, "tangential": tangential, "moment": moment}
    columns = {
        f"{name}_spectrum{part}": ("frequency", read(spectrum))
        for name, spectrum in spectra.items()
        for part, read in PARTS.items()
    }
    reversal = 1.0 + hit.normal_restitution
    numbers = {
        "duration": hit.duration,
        "max_force": hit.max_force,
        "normal_impulse": hit.pair.normal_mass * hit.normal_speed * reversal,
        "tangential_impulse": hit.tangential_impulse,
    }
    corner_variables = {}
    for name, value in corner_frequencies(hit).items():
        why = NO_NOTCH if name == "normal_notch_frequency" else "there is no tangential force"
        comment = {"comment": why} if isnan(value) else {}
        corner_variables[name] = (), value, attributes(name) | comment
    return labelled_dataset(
        {**columns, **numbers, **corner_variables},
        {"frequency": frequencies},
        {"title": "spectra of the forces of an oblique impact", "inputs": hit.inputs()},
    )


def corner_frequencies(hit: Outcome) -> dict[str, float]:
    """Return the corner frequencies of both forces by name, in Hz."""
    duration = hit.duration
    pulse = pulse_of(hit, WIDTH / duration)
    reach = np.maximum(widest(pulse, duration, FARTHEST / duration), WIDTH / duration)
    if reach.max() > WIDTH / duration:
        pulse = pulse_of(hit, float(reach.max()))
    normal, tangential = (corners(pulse, row, duration, float(reach[row])) for row in range(2))
    return {
        "normal_corner_frequency": normal.corner,
        "normal_half_frequency": normal.half,
        "normal_notch_frequency": normal.notch,
        "tangential_peak_frequency": tangential.peak,
        "tangential_corner_frequency": tangential.corner,
        "tangential_half_frequency": tangential.half,
    }
