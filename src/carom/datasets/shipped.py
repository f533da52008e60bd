"""The tables of measured rebounds, found by name and read as columns or datasets."""

from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.datasets.observables import OBSERVABLES
from carom.io.columns import ERROR, entry, in_units
from carom.io.labels import attributes, labelled_dataset
from carom.io.tables import read_table
from carom.io.user_table import UserTable
from carom.quantities.refusals import one_of

if TYPE_CHECKING:
    import xarray as xr


def names() -> tuple[str, ...]:
    """Return the names of the measured datasets.

    Returns
    -------
    tuple of str
        Names that `path`, `table` and `load` accept.

    Examples
    --------
    >>> import carom
    >>> carom.datasets.names()
    ('foerster1994', 'kharaz2001', 'kharaz2001_kratos', 'kharaz2001_mfix')
    """
    return tuple(sorted(file.stem for file in _folder().glob("*.csv")))


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
    >>> import carom
    >>> carom.datasets.path("kharaz2001").name
    'kharaz2001.csv'
    """
    return _folder() / f"{one_of('dataset', name, names())}.csv"


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
    >>> import carom
    >>> measured = carom.datasets.table("kharaz2001")
    >>> measured["spin_out"][8:10].round(1), measured["rebound_angle"][8:10]
    (array([-136.2, -265.7]), array([nan, nan]))
    """
    cells = _read(path(name).stem)
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
    >>> import carom
    >>> data = carom.datasets.load("kharaz2001")
    >>> data.spin_out.units, int(data.spin_out.notnull().sum()), data.doi
    ('rad/s', 7, '10.1016/S0032-5910(01)00283-2')
    """
    columns = table(name).columns
    variables = {key: ("point", values, column_attributes(key)) for key, values in columns.items()}
    told = dict(_read(name).comments)
    told["references"] = told.pop("source")  # "source" is the version of Carom, as everywhere
    return labelled_dataset(variables, {}, {"name": name, **told})


def column_attributes(name: str) -> dict[str, Any]:
    """Return unit and meaning of a column of values or of their errors.

    Examples
    --------
    >>> from carom.datasets.shipped import column_attributes
    >>> column_attributes("spin_out_error")["long_name"]
    'standard deviation of spin of the first body after'
    """
    known = attributes(entry(name))
    if not name.endswith(ERROR):
        return known
    return known | {
        "long_name": f"standard deviation of {known['long_name']}",
        "symbol": rf"$\sigma$ of {known['symbol']}",
    }


@lru_cache
def _read(name: str) -> UserTable:
    return read_table(path(name))


def _folder() -> Path:
    return Path(str(files("carom").joinpath("data/measured")))
