"""Histories of impacts as datasets: columns along time, and the phases beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.states import Phase
from carom.io.labels import flags, labelled_dataset

if TYPE_CHECKING:
    import xarray as xr

SIGNS = flags(("slip along -x", "stick", "slip along +x"), first=-1)
OF_PHASES = {
    "phase_kind": {"long_name": "kind of phase"},
    "phase_sign": SIGNS,
    "phase_cause": {"long_name": "what ended the phase"},
}


def labelled(
    columns: Mapping[str, ArrayLike],
    scalars: Mapping[str, float],
    phases: Sequence[Phase],
    inputs: Mapping[str, Any],
    phase_columns: Mapping[str, ArrayLike] | None = None,
) -> xr.Dataset:
    """Return a history as a dataset: columns along time, more of them along phase, and numbers."""
    along_time = {name: _along("time", name, values) for name, values in columns.items()}
    by_phase = _rows(phases) | {"phase_cause": [phase.cause for phase in phases]} if phases else {}
    by_phase |= phase_columns or {}
    along_phase = {name: _along("phase", name, values) for name, values in by_phase.items()}
    time = along_time.pop("time")
    return labelled_dataset(
        along_time | dict(scalars) | along_phase,
        {"time": time},
        {"title": f"oblique impact of {spheres('losses' in inputs)}", "inputs": inputs},
    )


def spheres(loses: bool) -> str:
    """Return what titles call the bodies."""
    return "spheres with losses" if loses else "elastic spheres"


def _along(dim: str, name: str, values: Any) -> tuple[Any, ...]:
    return (dim, values, OF_PHASES[name]) if name in OF_PHASES else (dim, values)


def _rows(phases: Sequence[Phase]) -> dict[str, Any]:
    """Return kind, sign, start and end of phases, by column."""
    return {
        "phase_kind": np.array([phase.kind for phase in phases]),
        "phase_sign": np.array([phase.sign for phase in phases], dtype=np.int8),
        "phase_start": np.array([phase.start for phase in phases]),
        "phase_end": np.array([phase.end for phase in phases]),
    }


def phases_at(times: Any, phases: Sequence[Phase]) -> dict[str, Any]:
    """Return the phase at each time, by column; an instant of change belongs to the later phase."""
    which = np.searchsorted([phase.start for phase in phases[1:]], times, side="right")
    return {name: values[which] for name, values in _rows(phases).items()}
