"""Results as records and as labelled datasets."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, isnan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.io.version import __version__
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import Printed

if TYPE_CHECKING:
    import xarray as xr

    from carom.dimensionless.states import Phase


CONVENTIONS = "CF-1.11"
AXES = {"x": {"axis": "X"}, "y": {"axis": "Y"}, "z": {"axis": "Z", "positive": "down"}}
MARKS = {True: "ok   ", False: "FAILS", None: "?    "}  # of an assumption
VERDICTS = {True: "holds", False: "fails", None: "not judged"}  # of all of them


class Finding(NamedTuple):
    """A number that tells if the theory holds: name, value, limit, verdict, what is missing."""

    name: str
    value: float
    limit: float
    holds: bool | None  # None: cannot be judged
    verdict: str
    missing: str = ""  # the argument that would let it be judged, and whose

    @property
    def label(self) -> str:
        """Name and value, the name alone where no value is known."""
        return self.name if isnan(self.value) else f"{self.name} = {self.value:.3g}"


@dataclass(frozen=True)
class Validity(Printed):
    """All `findings` on one impact: whether the assumptions of the theory hold; printed, a table.

    What a finding lacks to be judged is in its `missing` and its `verdict`, which tells where to
    put it.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="bearing steel")
    >>> wall = carom.HalfSpace(material="bearing steel")
    >>> pair = carom.Pair(ball, wall, friction=0.2, roughness="30 nm")
    >>> carom.impact(pair, speed=0.1, angle="30 deg").validity.holds
    True
    >>> carom.impact(pair, speed=5.0, angle="30 deg").validity.verdict
    'fails'
    """

    findings: tuple[Finding, ...]

    @property
    def holds(self) -> bool | None:
        """True if all assumptions hold, False if one fails, None if one of them is not judged."""
        holds = {finding.holds for finding in self.findings}
        return False if False in holds else (None if None in holds else True)

    @property
    def verdict(self) -> str:
        """What `holds` says in words, as holds, fails or not judged."""
        return VERDICTS[self.holds]

    def records(self) -> list[dict[str, Any]]:
        """Return the findings as what JSON can hold; a value that is not finite is None."""
        values = (each.value if isfinite(each.value) else None for each in self.findings)
        return [
            {**finding._asdict(), "value": value}
            for finding, value in zip(self.findings, values, strict=True)
        ]

    def __str__(self) -> str:
        lines = [f"{MARKS[f.holds]} {f.label}: {f.verdict}" for f in self.findings]
        return "\n".join([*lines, f"verdict: {self.verdict}"])


def flags(meanings: Sequence[str], first: int = 0) -> dict[str, Any]:
    """Return the CF attributes of an int8 variable whose values count through these meanings."""
    values = np.arange(first, first + len(meanings), dtype=np.int8)
    words = " ".join(meaning.replace(" ", "_") for meaning in meanings)
    return {"units": "1", "flag_values": values, "flag_meanings": words}


SIGNS = flags(("slip along -x", "stick", "slip along +x"), first=-1)
OF_PHASES = {
    "phase_kind": {"long_name": "kind of phase"},
    "phase_sign": SIGNS,
    "phase_cause": {"long_name": "what ended the phase"},
}


def labelled_dataset(
    variables: Mapping[str, Any], coords: Mapping[str, Any], attrs: Mapping[str, Any]
) -> "xr.Dataset":
    """Return a dataset whose variables carry unit and meaning, after the CF conventions 1.11.

    Parameters
    ----------
    variables, coords : mapping
        By name: a number, values along themselves, (dims, values), or (dims, values, attributes).
        What has no entry in the glossary brings its attributes along.
    attrs : mapping
        Attributes of the whole, a title among them; what is a mapping is stored as JSON.

    Examples
    --------
    >>> force = labelled_dataset({"normal_force": ("time", [0.0, 2.0])}, {"time": [0.0, 1e-6]}, {})
    >>> force.normal_force.units, force.time.long_name
    ('N', 'time since the first touch')
    """
    import xarray as xr

    nested = {n: json.dumps(dict(v)) for n, v in attrs.items() if isinstance(v, Mapping)}
    return xr.Dataset(
        {name: _variable(name, entry) for name, entry in variables.items()},
        coords={name: _variable(name, entry) for name, entry in coords.items()},
        attrs={"Conventions": CONVENTIONS, "source": f"carom {__version__}", **attrs, **nested},
    )


def labelled(
    columns: Mapping[str, ArrayLike],
    scalars: Mapping[str, float],
    phases: "Sequence[Phase]",
    inputs: Mapping[str, Any],
    phase_columns: Mapping[str, ArrayLike] | None = None,
) -> "xr.Dataset":
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


def _rows(phases: "Sequence[Phase]") -> dict[str, Any]:
    """Return kind, sign, start and end of phases, by column."""
    return {
        "phase_kind": np.array([phase.kind for phase in phases]),
        "phase_sign": np.array([phase.sign for phase in phases], dtype=np.int8),
        "phase_start": np.array([phase.start for phase in phases]),
        "phase_end": np.array([phase.end for phase in phases]),
    }


def phases_at(times: Any, phases: "Sequence[Phase]") -> dict[str, Any]:
    """Return the phase at each time, by column; an instant of change belongs to the later phase."""
    which = np.searchsorted([phase.start for phase in phases[1:]], times, side="right")
    return {name: values[which] for name, values in _rows(phases).items()}


def attributes(name: str) -> dict[str, str]:
    """Return the attributes of a variable: its unit, meaning and symbol."""
    entry = GLOSSARY[name]
    return {"units": entry.unit, "long_name": entry.meaning, "symbol": entry.symbol}


def pure(meaning: str) -> dict[str, str]:
    """Return the attributes of a pure number."""
    return {"units": "1", "long_name": meaning}


def _variable(name: str, entry: Any) -> tuple[Any, Any, dict[str, Any]]:
    if isinstance(entry, tuple):
        dims, values, *more = entry
    else:
        dims, values, more = (name,) if np.ndim(entry) else (), entry, []
    attrs: dict[str, Any] = attributes(name) if name in GLOSSARY or not more else {}
    if dims in (name, (name,)):
        attrs |= AXES.get(name, {})
    return dims, np.asarray(values), attrs | dict(*more)
