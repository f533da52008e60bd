"""Tables of measured rebounds as they arrive: read, checked, fitted; or the bodies asked for."""

from base64 import b64decode
from binascii import Error as NotBase64
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from carom import datasets
from carom.bodies.pairs import Pair
from carom.datasets.observables import BEFORE, OBSERVABLES
from carom.explorer.fitted import plain_words, shown_fit
from carom.explorer.limits import LARGEST_UPLOAD, MOST_ROWS, Refused
from carom.explorer.results import in_words
from carom.explorer.views import View
from carom.fitting import Fit, fit
from carom.fitting.reading import HEIGHTS, read_measurements, read_problem
from carom.io.columns import entry
from carom.io.tables import read_table
from carom.io.user_table import Column
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, refusal

KINDS = {
    **dict.fromkeys(BEFORE, "before the impact"),
    **dict.fromkeys(OBSERVABLES, "after the impact"),
    **dict.fromkeys(HEIGHTS, "drop and rebound"),
}
LONGEST_NAME = 80
ASKED = (
    "{name} does not say which bodies struck each other. The fit needs their radius, their "
    "density and their elastic constants."
)
WORDS = {"data": "file", "results": "file", "pair": "bodies"}  # of Python, and of the page


def answer(asked: dict[str, str]) -> dict[str, Any]:
    """Return the fit of a data set that comes along, by its name, or of a file that was sent.

    A file is written into the working directory meanwhile, which `worker.Desk` has made for it.
    Raises InputError if it is too large, no table, or cannot be fitted.
    """
    if "data" in asked:
        file = datasets.path(asked["data"])
        return _fitted(file, asked["data"], None)
    file, name = Path.cwd() / "upload.csv", shown_name(asked["name"])
    file.write_bytes(_decoded(asked["contents"]))
    try:
        return _fitted(file, name, View.of(asked["bodies"]) if asked["bodies"] else None)
    except Refused:  # of the bodies that the page sent
        raise
    except InputError as error:
        raise InputError(_in_words_of_the_page(str(error), str(file), name)) from None
    finally:
        file.unlink()


def shown_name(name: str) -> str:
    """Return the name of a user's file, fit to be shown."""
    last = str(name).replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable())[:LONGEST_NAME] or "file"


def _in_words_of_the_page(message: str, path: str, name: str) -> str:
    subject, colon, rest = message.replace(path, name).partition(": ")
    rest = rest.replace(", or fix some, e.g. fixed={'restitution': 0.98}", "")
    return in_words(WORDS.get(subject, subject) + colon + rest)


def _decoded(contents: str) -> bytes:
    try:
        found = b64decode(contents.partition(",")[2], validate=True)
    except (NotBase64, ValueError):  # ValueError: characters beyond ASCII
        raise InputError("file: it did not arrive whole; choose it again") from None
    if len(found) > LARGEST_UPLOAD:
        allowed = f"must be at most {LARGEST_UPLOAD} bytes; leave out what is not needed"
        raise refusal("file", f"{len(found)} bytes", allowed)
    return found


def _fitted(file: Path, name: str, view: View | None) -> dict[str, Any]:
    table = read_table(file, what="file")
    if len(table) > MOST_ROWS:
        allowed = f"must be at most {MOST_ROWS} rows; use carom fit for more"
        raise refusal("file", f"{len(table)} rows", allowed)
    if table.case is None and (view is None or view.in_numbers):
        read_measurements(table)  # what no bodies make right is said before they are asked for
        if not {*table.names} & {*OBSERVABLES, *HEIGHTS}:
            read_problem(table, View().pair)
        asked = ASKED.format(name=name)
        return {"asks": "bodies", "name": name, "message": asked, "columns": taken(table.cells)}
    pair: Pair | None = view.pair if table.case is None and view is not None else None
    found = fit(table, pair=pair)
    return shown_fit(found, name, "page" if pair else "file", taken(table.cells, found))


def taken(columns: Mapping[str, Column], found: Fit | None = None) -> list[dict[str, str]]:
    """Return for each column its head, what it was taken for, and the unit it was read in."""
    ignored = () if found is None else found.best.model.problem.ignored
    empty = [name.partition(" ")[0] for name in ignored if "(" in name]
    return [_taken(name, columns[name], entry(name) in empty) for name in columns]


def _taken(name: str, column: Column, empty: bool) -> dict[str, str]:
    quantity = entry(name)
    if quantity not in KINDS:
        return {"head": column.head, "kind": "not used", "meaning": "", "unit": ""}
    si, kind, meaning = GLOSSARY[quantity].unit, KINDS[quantity], plain_words(quantity)
    if name != quantity:
        kind, meaning = "standard deviation", f"of {meaning}"
    if empty:
        kind = "not used: no value in it"
    unit = str(column.unit) or ("" if si == "1" else f"{si} (the head names no unit)")
    return {"head": column.head, "kind": kind, "meaning": meaning, "unit": unit}
