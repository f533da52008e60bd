"""Measured rebounds and published parameters, found by name and read as columns or datasets."""

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies.observables import OBSERVABLES
from carom.folder import DATA
from carom.io.labels import attributes, labelled_dataset
from carom.io.tables import read_table
from carom.io.user_table import ERROR, UserTable, entry, in_units, with_errors
from carom.quantities.refusals import one_of

if TYPE_CHECKING:
    import xarray as xr


def names() -> tuple[str, ...]:
    """Return the names of the measured datasets, which `path`, `table` and `load` accept.

    Examples
    --------
    >>> carom.datasets.names()
    ('foerster1994', 'kharaz2001', 'kharaz2001_kratos', 'kharaz2001_mfix')
    """
    return tuple(sorted(file.stem for file in _data("measured").glob("*.csv")))


def path(name: str) -> Path:
    """Return the file of a dataset, for `carom fit` and for any program that reads CSV.

    Parameters
    ----------
    name : str
        A name that `names` lists.

    Returns
    -------
    pathlib.Path
        The CSV file.

    Raises
    ------
    InputError
        If there is no dataset of that name; the message suggests the nearest.

    Examples
    --------
    >>> carom.datasets.path("kharaz2001").name
    'kharaz2001.csv'
    """
    return _data("measured") / f"{one_of('dataset', name, names())}.csv"


def table(name: str) -> UserTable:
    """Return the columns of a dataset in SI units, NaN where nothing was measured.

    Parameters
    ----------
    name : str
        A name that `names` lists.

    Returns
    -------
    UserTable
        Arrays of shape (n,) by name in `columns`, also as `table[name]`, and the line numbers of
        the file in `rows`.

    Raises
    ------
    InputError
        If there is no dataset of that name; the message suggests the nearest.

    Examples
    --------
    >>> measured = carom.datasets.table("kharaz2001")
    >>> measured["spin_out"][8:10].round(1), measured["rebound_angle"][8:10]
    (array([-136.2, -265.7]), array([nan, nan]))
    """
    cells = _read(path(name))
    return in_units(cells, cells.names, gaps=OBSERVABLES)


def load(name: str) -> "xr.Dataset":
    """Return a dataset along `point`, in SI units, NaN where nothing was measured.

    Columns that end in `_error` are standard deviations. The attributes hold the source
    (`references`, `doi`), the person who digitised it, definitions, signs and the meaning of the
    errors. The attribute `case` holds the bodies as JSON, and
    `carom.bodies.cases.pair_of(json.loads(data.case))` is their pair.

    Parameters
    ----------
    name : str
        A name that `names` lists.

    Returns
    -------
    xarray.Dataset
        One variable along `point` for each column, with its unit and meaning as attributes.

    Raises
    ------
    InputError
        If there is no dataset of that name; the message suggests the nearest.

    Examples
    --------
    >>> data = carom.datasets.load("kharaz2001")
    >>> data.spin_out.units, int(data.spin_out.notnull().sum()), data.doi
    ('rad/s', 7, '10.1016/S0032-5910(01)00283-2')
    """
    columns = table(name).columns
    variables = {key: ("point", values, _attributes(key)) for key, values in columns.items()}
    comments = dict(_read(path(name)).comments)
    comments["references"] = comments.pop("source")  # "source" is the version of Carom
    return labelled_dataset(variables, {}, {"name": name, **comments})


def _attributes(name: str) -> dict[str, Any]:
    """Return unit and meaning of a column of values or of their errors."""
    words = attributes(entry(name))
    if name.endswith(ERROR):
        words["long_name"] = f"standard deviation of {words['long_name']}"
        words["symbol"] = rf"$\sigma$ of {words['symbol']}"
    return words


@lru_cache
def _read(file: Path) -> UserTable:
    return read_table(file)


def _data(name: str) -> Path:
    return DATA / name


NUMBERS = ("diameter", "density", *with_errors(("normal_restitution", "friction", "beta_0")))
TEXT_COLUMNS = {
    "body": "sphere that strikes",
    "other": "what it strikes",
    "shape": "sphere, of the same size, or plane",
    "reference": "where it was published",
}


def parameters() -> "xr.Dataset":
    """Return published values of restitution e, friction mu and beta_0 for pairs of bodies.

    These are the three parameters of Walton's law. The exact law has the same mu, but there beta_0,
    which is -V_x'/V_x of a contact point that sticks, follows from the elastic constants. All
    values depend on surfaces, size and speed, so use them as first estimates. Along `pair` the
    dataset has `normal_restitution`, `friction` and `beta_0`, each also with `_error` as the
    authors state it; `diameter` in m and `density` in kg/m^3 of the sphere, NaN if not stated; and
    the texts `body`, `other`, `shape` (sphere or plane) and `reference`.

    Examples
    --------
    >>> data = carom.datasets.parameters()
    >>> glass = data.isel(pair=(data.body == "soda-lime glass") & (data.other == "aluminium"))
    >>> glass.friction.item(), glass.friction_error.item(), glass.reference.item()[:16]
    (0.125, 0.007, 'Louge, M. Y. (19')
    """
    cells = _read(_data("parameters.csv"))
    numbers = in_units(cells, NUMBERS, gaps=("diameter", "density")).columns
    values = {name: ("pair", numbers[name], _attributes(name)) for name in NUMBERS}
    words = {
        name: ("pair", [str(cell) for cell in cells.column(name).cells], {"long_name": meaning})
        for name, meaning in TEXT_COLUMNS.items()
    }
    return labelled_dataset(values, words, {"name": "parameters", **cells.comments})
