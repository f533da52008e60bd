"""An impact in the course of time: what every way of solving it has in common."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.bodies import Value
from carom.dimensionless.states import Phase, SlipAngle
from carom.glossary import GLOSSARY
from carom.histories import InTime, history_columns
from carom.outcomes import Outcome
from carom.quantities import counted, number, refusal
from carom.results import Validity, labelled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


SHOWN = (  # in a notebook
    "psi_in",
    "psi_out",
    "rebound_speed",
    "rebound_angle",
    "spin_out",
    "contact_restitution",
    "normal_restitution",
    "dissipated_energy",
    "duration",
    "max_force",
    "max_radius",
)


@dataclass(frozen=True, eq=False)
class Course(Outcome):
    """How two bodies leave an impact, and the way there: phases, history, validity."""

    solution: InTime = field(repr=False)

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """The phases in order, times in s."""
        if not isfinite(self.psi_in):
            sign = 1 if self.psi_in > 0.0 else -1
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
        """How far the assumptions hold, as numbers with a verdict."""

    def history(self, n: int = 200) -> xr.Dataset:
        """Return the impact at n times: a dataset with forces, velocities, radii, energies.

        The times are evenly spaced from the first touch to the last; maximum compression of elastic
        bodies is in the middle, at half of `duration`.
        """
        columns = self._columns(counted("n", n, 2))
        return labelled(columns, self.scalars(), self.phases, self.inputs(), self._phase_columns())

    def _columns(self, n: int) -> dict[str, Any]:
        return history_columns(self.pair, self.normal_speed, self._before, self.solution, n)

    def _phase_columns(self) -> dict[str, list[float]]:
        angles = self.slip_angles
        return {
            "phase_slip_angle_max": [angle.largest for angle in angles],
            "phase_slip_angle_mean": [angle.mean for angle in angles],
        }

    def _instant(self, time: Value) -> float:
        """Return a time within the contact in s, or raise InputError."""
        instant = number("time", time)
        if not 0.0 <= instant <= self.duration:
            allowed = f"must lie within the contact, from 0 to {self.duration:.6g} s"
            raise refusal("time", time, allowed)
        return instant

    @abstractmethod
    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX."""

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        from carom.notebooks import card

        numbers = self.scalars()
        rows = {GLOSSARY[name].meaning: GLOSSARY[name].text(numbers[name]) for name in SHOWN}
        phases = (f"{p.start:10.3e} to {p.end:.3e} s  {p.kind}" for p in self.phases)
        notes = "\n".join([*phases, "", str(self.validity)])
        return card("Oblique impact", rows, self.plot(), notes)

    def to_dataset(self) -> xr.Dataset:
        """Return all of the result as one dataset, with a history of 400 times."""
        return self.history(400)

    def plot(self, path: str | Path | None = None) -> Figure:
        """Draw the impact; with a path, store the figure there."""
        from carom.plots import plot_impact, save_figure

        figure = plot_impact(self.to_dataset())
        if path is not None:
            save_figure(figure, path)
        return figure

    def animate(
        self, path: str | Path, frames: int = 60, progress: Callable[[], None] | None = None
    ) -> Path:
        """Store an animation of the contact through the impact as .gif, or .mp4 with ffmpeg.

        `progress` is called after every frame. Raises InputError if the file cannot be written.
        """
        from carom.plots import animate

        count = counted("frames", frames, 1)
        times = (np.arange(count) + 0.5) / count * self.duration
        return animate(self.history(), map(self._picture, times), path, progress=progress)

    @abstractmethod
    def _picture(self, time: float) -> xr.Dataset:
        """Return the fields on a grid over the whole contact at a time."""
