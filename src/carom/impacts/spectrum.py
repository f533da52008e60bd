"""What an impact excites a body or a sensor with: the spectra of its forces, with corners."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.pairs import Scales
from carom.dimensionless.numerics.corners import corners, widest
from carom.dimensionless.numerics.fourier import Pulse, sampled
from carom.impacts.outcome import InTime
from carom.io.labels import attributes, labelled_dataset
from carom.quantities.arrays import Array, numbers
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import Value, counted, positive

if TYPE_CHECKING:
    import xarray as xr

COUNT, WIDTH = 601, 6.0  # frequencies where none are told, and up to how many over the duration
NO_NOTCH = f"the amplitude has no minimum up to {WIDTH:g} over the duration"
MOST, FARTHEST = 20_000, 1000.0  # the most that there may be, likewise


class Source(NamedTuple):
    """An impact as the source of spectra: solved, its scales, and the radius of the first body."""

    solution: InTime
    scales: Scales
    radius: float

    @property
    def duration(self) -> float:
        """Duration of the contact, in s."""
        return self.solution.duration * self.scales.time

    def forces(self, time: Array) -> Array:
        """Return normal and tangential force in N, a row each, at times in s."""
        found = self.solution.at(np.clip(time / self.scales.time, 0.0, self.solution.duration))
        scales = self.scales
        return np.stack([found.normal_force * scales.force, found.force * scales.tangential_force])

    def pulse(self, highest: float) -> Pulse:
        """Return both forces ready for their spectra up to a highest frequency in Hz."""
        ends = [instant for phase in self.solution.phases for instant in (phase.start, phase.end)]
        instants = np.unique([0.0, *ends, self.solution.duration]) * self.scales.time
        return sampled(self.forces, instants, highest)


def read_frequencies(
    given: ArrayLike | None, highest: Value | None, count: int | None, duration: float
) -> Array:
    """Return frequencies in Hz: those given, or evenly spaced from zero; or raise InputError."""
    most = FARTHEST / duration
    if given is None:
        top = WIDTH / duration if highest is None else positive("max_frequency", highest)
        number = COUNT if count is None else counted("n", count, 2, MOST)
        if top > most:
            raise refusal("max_frequency", highest, _too_high(most))
        return np.linspace(0.0, top, number)
    if highest is not None or count is not None:
        raise InputError("frequencies: give them, or max_frequency and n, not both")
    allowed = "must be a list of numbers in Hz, zero or positive and finite"
    values = np.atleast_1d(numbers("frequencies", given, allowed, "Hz"))
    if values.ndim != 1 or not values.size:
        raise refusal("frequencies", given, allowed)
    if values.size > MOST:
        raise InputError(f"frequencies: {values.size:,} are too many; give at most {MOST:,}")
    bad = ~((values >= 0.0) & (values < np.inf))
    if bad.any():
        raise refusal("frequencies", float(values[bad][0]), allowed)
    if values.max() > most:
        raise refusal("frequencies", float(values.max()), _too_high(most))
    return values


def _too_high(most: float) -> str:
    known = f"spectra are known up to {text(most, 'Hz', 4)}"
    return f"{known}, {FARTHEST:g} over the duration of the contact"


def spectrum_dataset(
    source: Source, frequencies: Array, more: Mapping[str, float], inputs: Mapping[str, Any]
) -> xr.Dataset:
    """Return the spectra of the forces along `frequency`, their corners, and more numbers."""
    pulse = source.pulse(float(frequencies.max()))
    normal, tangential = pulse.transform(frequencies)
    spectra = {"normal": normal, "tangential": tangential, "moment": source.radius * tangential}
    columns = {
        f"{name}_spectrum{part}": ("frequency", values)
        for name, spectrum in spectra.items()
        for part, values in (
            ("", np.abs(spectrum)),
            ("_real", spectrum.real),
            ("_imag", spectrum.imag),
        )
    }
    numbers = {"duration": source.duration, **more}
    found = {}
    for name, value in corner_frequencies(source).items():
        why = NO_NOTCH if name == "normal_notch_frequency" else "there is no tangential force"
        found[name] = (), value, attributes(name) | ({"comment": why} if isnan(value) else {})
    return labelled_dataset(
        {**columns, **numbers, **found},
        {"frequency": frequencies},
        {"title": "spectra of the forces of an oblique impact", "inputs": inputs},
    )


def corner_frequencies(source: Source) -> dict[str, float]:
    """Return the corner frequencies of both forces by name, in Hz."""
    duration = source.duration
    pulse = source.pulse(WIDTH / duration)
    reach = np.maximum(widest(pulse, duration, FARTHEST / duration), WIDTH / duration)
    if reach.max() > WIDTH / duration:
        pulse = source.pulse(float(reach.max()))
    normal, tangential = (corners(pulse, row, duration, float(reach[row])) for row in range(2))
    return {
        "normal_corner_frequency": normal.corner,
        "normal_half_frequency": normal.half,
        "normal_notch_frequency": normal.notch,
        "tangential_peak_frequency": tangential.peak,
        "tangential_corner_frequency": tangential.corner,
        "tangential_half_frequency": tangential.half,
    }
