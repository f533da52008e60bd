"""What CSV and NetCDF both hold: whatever would not come back as it was is refused beforehand."""

import re
from collections.abc import Hashable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.quantities.refusals import refusal
from carom.quantities.units import REAL

if TYPE_CHECKING:
    import xarray as xr

HELD = "Carom stores only numbers, texts and truth values"
ATTRIBUTE = "an attribute must be a text, a number, or a list of two or more texts or numbers"
UNFIT = re.compile("[\0\ud800-\udfff]")  # in texts: NUL, halves of a character
UNFIT_NAME = re.compile("#|[.]$|.*[\0-\x1f\x7f/\ud800-\udfff]")
NUMBERS = (int, float, np.integer, np.floating)
WIDEST = 8  # bytes of a number
RESERVED = (  # attributes by which xarray and HDF5 say how something is stored
    *("_FillValue", "coordinates", "dtype", "_Encoding", "CLASS", "NAME", "REFERENCE_LIST"),
    *("DIMENSION_LIST", "_Netcdf4Dimid", "_Netcdf4Coordinates", "_nc3_strict", "_NCProperties"),
)


def storable(dataset: "xr.Dataset") -> "xr.Dataset":
    """Return a dataset with plain attributes, or raise InputError if it would come back changed.

    Examples
    --------
    >>> import xarray as xr
    >>> from carom.io.storable import storable
    >>> storable(xr.Dataset({"speed": ("row", [1.0, 2.0], {"digits": None})}))
    Traceback (most recent call last):
    carom.InputError: digits: None cannot be used; an attribute must be a text, a number, or a \
list of two or more texts or numbers
    """
    found = dataset.copy()
    found.attrs = _attributes(dataset.attrs)
    for name in {**dataset.sizes, **dataset.variables}:
        _check_name(name)
        if name in dataset.coords and name not in dataset.dims and str(name).split() != [name]:
            raise refusal("name", name, "the name of such a coordinate must not have blanks")
    for name, item in found.variables.items():
        _check_values(str(name), item)
        item.attrs = _attributes(item.attrs)
    return found


def _check_name(name: Hashable) -> None:
    if not isinstance(name, str) or not name or UNFIT_NAME.match(name):
        raise refusal("name", name, "a name must be a text without /, line ends and # in front")


def _check_values(name: str, item: "xr.Variable") -> None:
    if hasattr(item.data, "to_root_units"):
        allowed = "files hold plain numbers; write the unit into the attribute 'units'"
        raise refusal(name, item.data, allowed)
    dtype = item.dtype
    if isinstance(dtype, np.dtype) and dtype.kind in f"b{REAL}" and dtype.itemsize <= WIDEST:
        return
    if not isinstance(dtype, np.dtype) or dtype.kind not in "OTU":
        raise refusal(name, str(dtype), HELD)
    for word in item.values.ravel().tolist():
        if not isinstance(word, str):
            raise refusal(name, word, HELD)
        _check_text(name, word)


def _check_text(name: str, text: str) -> None:
    if UNFIT.search(text):
        raise refusal(name, text, "a text must not have NUL or half of a character")


def _attributes(given: Mapping[Any, Any]) -> dict[Any, Any]:
    for name in given:
        _check_name(name)
        if name in RESERVED:
            allowed = "this name is reserved for the storage of values; use another"
            raise refusal("attribute", name, allowed)
    return {name: _attribute(name, value) for name, value in given.items()}


def _attribute(name: str, value: Any) -> Any:
    """Return an attribute as a text, a number, a list of texts, or an array of numbers."""
    listed = value.tolist() if isinstance(value, np.ndarray) else value
    several = isinstance(listed, list | tuple)
    each = listed if several else [listed]
    if several and len(each) == 1:  # which NetCDF takes for the value itself
        raise refusal(name, value, ATTRIBUTE)
    if each and all(isinstance(one, str) for one in each):
        for one in each:
            _check_text(name, one)
        return [str(one) for one in each] if several else str(listed)
    plain = all(isinstance(one, NUMBERS) and not isinstance(one, bool) for one in each)
    values = np.asarray(value if plain else None)
    if values.dtype.kind not in REAL or values.dtype.itemsize > WIDEST:
        raise refusal(name, value, ATTRIBUTE)
    return values[()]
