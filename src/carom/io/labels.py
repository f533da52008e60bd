"""Datasets whose variables carry unit and meaning."""

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.io.version import __version__
from carom.quantities.glossary import GLOSSARY

if TYPE_CHECKING:
    import xarray as xr


CONVENTIONS = "CF-1.11"
AXES = {"x": {"axis": "X"}, "y": {"axis": "Y"}, "z": {"axis": "Z", "positive": "down"}}


def flags(meanings: Sequence[str], first: int = 0) -> dict[str, Any]:
    """Return the CF attributes of an int8 variable whose values count through these meanings."""
    values = np.arange(first, first + len(meanings), dtype=np.int8)
    words = " ".join(meaning.replace(" ", "_") for meaning in meanings)
    return {"units": "1", "flag_values": values, "flag_meanings": words}


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
