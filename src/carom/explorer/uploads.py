"""Measured rebounds from a user's file or from those that come along, and their fit."""

from base64 import b64decode
from binascii import Error as NotBase64
from pathlib import Path
from tempfile import TemporaryDirectory

from carom import datasets
from carom.explorer.views import View
from carom.fitting import Fit, fit
from carom.quantities import InputError, refusal
from carom.sheets import read_table

LARGEST_UPLOAD = 1_000_000  # bytes
MOST_ROWS = 2000
LONGEST_NAME = 80


def fit_of(name: str) -> Fit:
    """Return the fit of measured rebounds that come along."""
    return fit(datasets.path(name))


def fit_of_upload(view: View, contents: str, name: str) -> Fit:
    """Return the fit of a file as the browser sends it; bodies of the view unless it tells them.

    Raises InputError if it is too large, no table, or cannot be fitted.
    """
    text = _decoded(contents)
    with TemporaryDirectory() as folder:
        file = Path(folder) / "upload.csv"
        file.write_bytes(text)
        try:
            return _fitted(view, file)
        except InputError as error:
            raise InputError(str(error).replace(str(file), shown_name(name))) from None


def shown_name(name: str) -> str:
    """Return the name of a user's file, fit to be shown."""
    last = str(name).replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable())[:LONGEST_NAME] or "file"


def _decoded(contents: str) -> bytes:
    if not isinstance(contents, str):
        raise InputError("file: it did not arrive; choose it again")
    try:
        found = b64decode(contents.partition(",")[2], validate=True)
    except NotBase64:
        raise InputError("file: it did not arrive whole; choose it again") from None
    if len(found) > LARGEST_UPLOAD:
        allowed = f"must be at most {LARGEST_UPLOAD} bytes; leave out what is not needed"
        raise refusal("file", f"{len(found)} bytes", allowed)
    return found


def _fitted(view: View, file: Path) -> Fit:
    table = read_table(file)
    if len(table.rows) > MOST_ROWS:
        allowed = f"must be at most {MOST_ROWS} rows; use carom fit for more"
        raise refusal("file", f"{len(table.rows)} rows", allowed)
    if table.case is None and view.in_numbers:
        raise InputError("bodies: the file does not tell them; choose bodies on the left")
    return fit(file, pair=view.pair if table.case is None else None)
