"""Uploaded tables of measured rebounds, fitted in a process of their own: what it does there."""

import faulthandler
import json
import os
import sys
from base64 import b64decode
from binascii import Error as NotBase64
from contextlib import suppress
from pathlib import Path
from typing import Any

from carom import datasets
from carom.explorer.fits import fit_of, shown_fit
from carom.explorer.limits import FIT_MEMORY, FIT_SECONDS, LARGEST_UPLOAD, MOST_ROWS
from carom.explorer.views import View
from carom.explorer.worker import READY
from carom.fitting import Fit, fit
from carom.io.tables import read_table
from carom.quantities.refusals import InputError, refusal

try:
    import resource
except ImportError:  # not on Windows
    resource = None  # type: ignore[assignment]

LONGEST_NAME = 80
PAGES = Path("/proc/self/statm")  # of memory; Linux has it
ORPHAN = 1.25  # times the limit: only where nobody is left to kill


def answer_lines() -> None:
    """Answer uploads, each a line of JSON on standard input, until that ends."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # nobody else writes among the answers
    fit_of(datasets.names()[0])
    _limit_memory()
    print(json.dumps(READY), file=answers, flush=True)
    for line in sys.stdin:
        faulthandler.dump_traceback_later(ORPHAN * FIT_SECONDS, exit=True)
        answer = json.dumps(_answer(json.loads(line)))
        faulthandler.cancel_dump_traceback_later()
        print(answer, file=answers, flush=True)


def _limit_memory() -> None:
    if resource is None or not PAGES.exists():
        return
    now = int(PAGES.read_text().split()[0]) * resource.getpagesize()
    with suppress(OSError, ValueError):  # a stricter limit may be there already
        resource.setrlimit(resource.RLIMIT_AS, (now + FIT_MEMORY, resource.RLIM_INFINITY))


def _answer(asked: dict[str, str]) -> dict[str, Any]:
    try:
        return fit_of_upload(View.of(asked["query"]), asked["contents"], asked["name"])
    except InputError as error:
        return {"refused": str(error)}
    except MemoryError:
        return {"refused": f"file: fitting it takes more than {FIT_MEMORY >> 20} MB; use carom fit"}
    except Exception as error:
        return {"failed": f"{type(error).__name__}: {' '.join(str(error).split())}"}


def fit_of_upload(view: View, contents: str, name: str) -> dict[str, Any]:
    """Return the fit of a file as the browser sends it; bodies of the view unless it tells them.

    It is written into the working directory meanwhile, which `Worker` has made for it. Raises
    InputError if it is too large, no table, or cannot be fitted.
    """
    file = Path.cwd() / "upload.csv"
    file.write_bytes(_decoded(contents))
    try:
        return shown_fit(_fitted(view, file))
    except InputError as error:
        raise InputError(str(error).replace(str(file), shown_name(name))) from None
    finally:
        file.unlink()


def shown_name(name: str) -> str:
    """Return the name of a user's file, fit to be shown."""
    last = str(name).replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable())[:LONGEST_NAME] or "file"


def _decoded(contents: str) -> bytes:
    try:
        found = b64decode(contents.partition(",")[2], validate=True)
    except (NotBase64, ValueError):  # ValueError: characters beyond ASCII
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
