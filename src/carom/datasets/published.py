"""Published parameters of pairs of bodies: restitution, friction, beta_0, with their sources."""

from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from carom.datasets.shipped import column_attributes
from carom.io.columns import in_units, with_errors
from carom.io.labels import labelled_dataset
from carom.io.tables import Cells, read_table

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
    """Return published restitution e, friction mu and beta_0 of pairs of bodies.

    They are the three parameters of Walton's law; mu is that of the exact law, too, while beta_0,
    -V_x'/V_x of the contact point where it sticks, follows there from the elastic constants. All
    depend on surfaces, size and speed: they are values to begin with.

    Returns
    -------
    xarray.Dataset
        Along `pair`: normal_restitution, friction, beta_0, and each with _error as its authors
        state it; diameter (m) and density (kg/m^3) of the sphere, NaN where not told; and as text
        body, other, shape (sphere or plane) and reference.

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
        name: ("pair", [str(cell) for cell in cells.column(name)[1]], {"long_name": meaning})
        for name, meaning in WORDS.items()
    }
    return labelled_dataset(found, words, {"name": "parameters", **cells.comments})


@lru_cache
def _read() -> Cells:
    return read_table(Path(str(files("carom").joinpath("data/parameters.csv"))))
