"""Published restitution, friction and beta_0 of pairs of bodies, with their sources."""

from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from carom.datasets.shipped import column_attributes
from carom.io.columns import in_units, with_errors
from carom.io.labels import labelled_dataset
from carom.io.tables import read_table
from carom.io.user_table import UserTable

if TYPE_CHECKING:
    import xarray as xr

NUMBERS = ("diameter", "density", *with_errors(("normal_restitution", "friction", "beta_0")))
WORDS = {  # columns of text
    "body": "sphere that strikes",
    "other": "what it strikes",
    "shape": "sphere, of the same size, or plane",
    "reference": "where it was published",
}


def parameters() -> "xr.Dataset":
    """Return published values of restitution e, friction mu and beta_0 for pairs of bodies.

    These are the three parameters of Walton's law. The exact law has the same mu, but there beta_0,
    which is -V_x'/V_x of a contact point that sticks, follows from the elastic constants. All
    values depend on surfaces, size and speed, so use them as first estimates.

    Returns
    -------
    xarray.Dataset
        Along `pair`: `normal_restitution`, `friction` and `beta_0`, each also with `_error` as the
        authors state it; `diameter` in m and `density` in kg/m^3 of the sphere, NaN if not stated;
        and the texts `body`, `other`, `shape` (sphere or plane) and `reference`.

    Examples
    --------
    >>> import carom
    >>> known = carom.datasets.parameters()
    >>> glass = known.isel(pair=(known.body == "soda-lime glass") & (known.other == "aluminium"))
    >>> glass.friction.item(), glass.friction_error.item(), glass.reference.item()[:16]
    (0.125, 0.007, 'Louge, M. Y. (19')
    """
    cells = _read()
    numbers = in_units(cells, NUMBERS, gaps=("diameter", "density")).columns
    found = {name: ("pair", numbers[name], column_attributes(name)) for name in NUMBERS}
    words = {
        name: ("pair", [str(cell) for cell in cells.column(name).cells], {"long_name": meaning})
        for name, meaning in WORDS.items()
    }
    return labelled_dataset(found, words, {"name": "parameters", **cells.comments})


@lru_cache
def _read() -> UserTable:
    return read_table(Path(str(files("carom").joinpath("data/parameters.csv"))))
