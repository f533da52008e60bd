"""An impact in the course of time: what every way of solving it has in common."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import degrees, isnan
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.states import Phase, SlipAngle
from carom.impacts.histories import labelled, phases_at
from carom.impacts.outcome import PAIR, InTime, Outcome, history_columns
from carom.impacts.sequences import SIGNS
from carom.impacts.spectrum import read_frequencies, spectrum_dataset
from carom.plots.result import Result, card
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY, listed
from carom.quantities.prefixes import column, text
from carom.quantities.refusals import refusal, refuse
from carom.quantities.units import Value, counted, number, or_none
from carom.quantities.verdicts import MARKS, Finding, Validity

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


MOST_FRAMES = 10_000
NOTES = {
    "exact": "  * angle between the slip and x in degrees, which the theory neglects",
    "lossy": "  * angle between the slip and x, which is known only without losses",
    "halfspace": "  * angle between the slip and x in degrees",
    "bodies": "  * not known; what another part of a body strikes later is another impact",
}
SHOWN = (  # in a notebook
    *("psi_in", "psi_out", "rebound_speed", "rebound_angle", "spin_out", "contact_restitution"),
    *("normal_restitution", "dissipated_energy", "duration", "max_force", "max_radius"),
)


@dataclass(frozen=True)
class Film:
    """Pictures of the contact at times, each solved when it is drawn."""

    picture: Callable[[float], xr.Dataset]
    times: Array

    def __len__(self) -> int:
        return self.times.size

    def __iter__(self) -> Iterator[xr.Dataset]:
        return map(self.picture, self.times)


@dataclass(frozen=True, eq=False)
class ImpactResult(Outcome, Result):
    """How two bodies leave an impact, and the way there: phases, history, validity."""

    solution: InTime = field(repr=False)
    normal_spin: float = field(default=0.0, kw_only=True)

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """The phases in order, times in s."""
        if not np.all(np.isfinite(self.psi_in)):
            sign = 1 if np.ravel(self.psi_in)[0] > 0.0 else -1
            return (Phase("gross slip", sign, 0.0, self.duration, "separation"),)
        unit = self.scales.time
        return tuple(
            Phase(p.kind, p.sign, p.start * unit, p.end * unit, p.cause)
            for p in self.solution.phases
        )

    @property
    @abstractmethod
    def slip_angles(self) -> tuple[SlipAngle, ...]:
        """Angle of slip against the direction of motion in each phase, in rad."""

    @property
    @abstractmethod
    def validity(self) -> Validity:
        """Whether the assumptions hold: numbers with their limits and verdicts."""

    @property
    @abstractmethod
    def _strength(self) -> tuple[Finding, ...]:
        """The findings on what the bodies bear."""

    @property
    def _size_ratio(self) -> float:
        """How large the contact is against the bodies."""
        return self.max_radius / self.pair.effective_radius

    def history(self, n: int = 200) -> xr.Dataset:
        """Return the impact at n times: a table of forces, velocities, radii, energies, phases.

        The times are evenly spaced from the first touch to the last; maximum compression of elastic
        bodies is in the middle, at half of `duration`. Phases and numbers of the whole impact are
        in `to_dataset`.

        Parameters
        ----------
        n : int
            How many times, from 2 to a million.

        Returns
        -------
        xarray.Dataset
            All along `time` in s, so that `to_dataframe()` has a row for each instant: what the
            bodies do, and the phase then, phase_kind, phase_sign, phase_start and phase_end in s.
            Only friction and max_pressure are single numbers, as figures need them. The attributes
            of each variable tell its unit and meaning.

        Raises
        ------
        InputError
            If there are fewer or more.

        Examples
        --------
        >>> history = hit.history(5)
        >>> history.normal_force.units, history.normal_force.shape
        ('N', (5,))
        >>> history.to_dataframe().phase_kind.tolist()
        ['gross slip', 'gross slip', 'slip', 'slip', 'gross slip']
        """
        columns = self._columns(self.solution.history(counted("n", n, 2)))
        columns |= phases_at(columns["time"], self.phases)
        numbers = {"friction": self.pair.friction, "max_pressure": self.max_pressure}
        return labelled(columns, numbers, (), self.inputs())

    def spectrum(
        self,
        frequencies: ArrayLike | None = None,
        *,
        max_frequency: Value | None = None,
        n: int | None = None,
    ) -> xr.Dataset:
        """Return the spectra of the forces, int F(t) exp(-2 pi i f t) dt, and their corners.

        They describe the impact as a source of acoustic emission and of the signals of impact
        sensors (McLaskey & Glaser 2010). At f = 0 the spectra are the impulses. The moment is R F_x
        about the centre of the first body, against its spin. At a corner the amplitude has first
        fallen by 3 dB, to 1/sqrt(2) of its largest value, or by 6 dB, to 1/2. That of the normal
        force is at f = 0, of the tangential force at `tangential_peak_frequency`.

        Parameters
        ----------
        frequencies : array_like, optional
            Frequencies in Hz, zero or positive, each at most 1000 over `duration`; up to 20,000.
        max_frequency : float or str, optional
            Highest frequency in Hz if none are given; by default 6 over `duration`.
        n : int, optional
            Number of frequencies if none are given, evenly spaced from zero on; by default 601.

        Returns
        -------
        xarray.Dataset
            Along `frequency` in Hz: the amplitudes normal_spectrum and tangential_spectrum in N s,
            and moment_spectrum in N m s, each also in parts, such as normal_spectrum_real and
            normal_spectrum_imag. As numbers: duration in s, max_force in N, the impulses in N s,
            and the corner frequencies in Hz, NaN where there is none, with a `comment` among the
            attributes that says why: without a tangential force, or where the normal spectrum falls
            without a minimum up to 6 over `duration`, as with a viscous e below 0.47. Errors are
            below 1e-9 of the impulse of |F|; for metals, `StandardLinearSolid` and
            boundary elements they are those of the history, 1e-5 to 1e-3.

        Raises
        ------
        InputError
            If a frequency is negative, no number or too high, there are too many, or they are given
            in two ways.

        Examples
        --------
        >>> spectrum = hit.spectrum(max_frequency="100 kHz")
        >>> round(float(spectrum.normal_notch_frequency) * hit.duration, 4)  # sin^1.5: 1.75
        1.804
        """
        spheres = "spectra are those of spheres; history has the forces"
        refuse(not self.pair.is_round and refusal("pair", str(self.pair), spheres))
        asked = read_frequencies(frequencies, max_frequency, n, self.duration)
        return spectrum_dataset(self, asked)

    def _columns(self, h: Any) -> dict[str, Any]:
        return history_columns(self, h)

    def _phase_columns(self) -> dict[str, list[float]]:
        angles = self.slip_angles
        return {
            "phase_slip_angle_max": [angle.largest for angle in angles],
            "phase_slip_angle_mean": [angle.mean for angle in angles],
        }

    def _instant(self, time: Value) -> float:
        """Return a time within the contact in s, or raise InputError."""
        instant = number("at", time, "s")
        if not 0.0 <= instant <= self.duration:
            allowed = f"must lie within the contact, from 0 to {text(self.duration, 's')}"
            raise refusal("at", time, allowed)
        return instant

    def __str__(self) -> str:
        scalars, method = self.scalars(), self.inputs().get("method", "exact")
        round_ones = self.pair.is_round
        note = NOTES["bodies" if not round_ones else "lossy" if self.losses is not None else method]
        coupled = method != "exact" and self.pair.dundurs_beta != 0.0
        loses = self.losses is not None or self.pair.gives_way(self.scales) or coupled
        hidden = set() if loses else {"lost_energy", "shear_lost_energy"}
        hidden |= set() if loses or not round_ones else {"normal_restitution"}
        if not scalars["shear_lost_energy"]:  # as of spheres that yield
            hidden.add("shear_lost_energy")
        shown = ["chi", *(n for n in scalars if n not in (*PAIR, *hidden))]
        if len(self.pair.moving) == 1:
            shown = [name for name in shown if not name.startswith("spin2")]
        lines = listed({name: scalars[name] for name in shown}, width=58)
        times, unit = _phase_times(self.phases)
        phases = [
            f"  {p.kind + SIGNS[p.sign]:14s}{start:>12s} {end:>12s}"
            f" {_in_degrees(angle.mean)} {_in_degrees(angle.largest)}   {p.cause}"
            for p, (start, end), angle in zip(self.phases, times, self.slip_angles, strict=True)
        ]
        columns = f"{f'from ({unit})':>12s} {f'to ({unit})':>12s} {'mean*':>9s} {'max*':>9s}"
        head = f"  {'':14s}{columns}   ended by"
        validity = self.validity
        findings = [f"  {MARKS[f.holds]} {f.label:38s} {f.verdict}" for f in validity.findings]
        theory = f"Validity: {validity.verdict}"
        parts = ("Rebound", *lines, "Phases", head, *phases, note, theory, *findings)
        return "\n".join(parts)

    def _repr_html_(self) -> str:
        numbers = self.scalars()
        there = [name for name in SHOWN if name in numbers]  # in space there is no angle
        rows = {GLOSSARY[name].meaning: GLOSSARY[name].text(numbers[name]) for name in there}
        times, unit = _phase_times(self.phases)
        phases = (
            f"{start:>10s} to {end:>8s} {unit}  {p.kind}"
            for p, (start, end) in zip(self.phases, times, strict=True)
        )
        notes = "\n".join([*phases, "", str(self.validity)])
        return card("Oblique impact", rows, self.plot(), notes)

    def to_dataset(self) -> xr.Dataset:
        """Return all of the result as one dataset, with a history of 400 times.

        Along `time` in s the course of the impact, as `history` has it; along `phase` kind, sign,
        start and end in s; the numbers of the result without a dimension.
        """
        columns, angles = self._columns(self.solution.history(400)), self._phase_columns()
        return labelled(columns, self.scalars(), self.phases, self.inputs(), angles)

    def _draw(self, dataset: xr.Dataset, **look: Any) -> Figure:
        from carom.plots.impact import plot_impact

        return plot_impact(dataset, **look)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers, texts and lists, for JSON; NaN becomes None.

        It has inputs, result (all numbers by name, SI units), phases, verdict (holds, fails or not
        judged) and validity, the findings behind it.
        """
        names, validity = ("slip_angle_max", "slip_angle_mean"), self.validity
        phases = [
            phase._asdict() | dict(zip(names, map(or_none, angle), strict=True))
            for phase, angle in zip(self.phases, self.slip_angles, strict=True)
        ]
        return {
            "inputs": self.inputs(),
            "result": {name: or_none(value) for name, value in self.scalars().items()},
            "phases": phases,
            "verdict": validity.verdict,
            "validity": validity.records(),
        }

    def animate(
        self,
        path: str | Path,
        frames: int = 60,
        progress: bool | Callable[[], object] | None = None,
    ) -> Path:
        """Store an animation of the contact through the impact as .gif, or .mp4 with ffmpeg.

        Parameters
        ----------
        path : str or Path
            The file, which is replaced whole or not at all.
        frames : int
            Number of instants, evenly spaced, up to 10,000; 12 are shown per second.
        progress : bool or callable, optional
            As for `carom.sweep`; a function is called after every frame.

        Returns
        -------
        pathlib.Path
            The file that was written.

        Raises
        ------
        InputError
            If the name ends otherwise, ffmpeg is missing, or the file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     hit.animate(f"{folder}/hit.gif", frames=2).name
        'hit.gif'
        """
        from carom.plots.animation import animate

        count = counted("frames", frames, 1, MOST_FRAMES)
        times = (np.arange(count) + 0.5) / count * self.duration
        return animate(self.history(), Film(self._picture, times), path, progress)

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        about_normal = {"normal_spin": self.normal_spin} if self.normal_spin else {}
        return super().inputs() | about_normal

    @abstractmethod
    def _picture(self, time: float) -> xr.Dataset:
        """Return the fields on a grid over the whole contact at a time."""


def _phase_times(phases: Sequence[Phase]) -> tuple[list[tuple[str, str]], str]:
    """Return start and end of each phase, as cells of two columns, and their unit."""
    cells, unit = column([time for p in phases for time in (p.start, p.end)], "s")
    return list(zip(cells[::2], cells[1::2], strict=True)), unit


def _in_degrees(angle: float) -> str:
    return "-".rjust(9) if isnan(angle) else f"{degrees(angle):9.2f}"
