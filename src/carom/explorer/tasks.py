"""What a process does that works for the page: lines of JSON in, lines of JSON out."""

import faulthandler
import json
import os
import sys
from base64 import b64encode
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from carom.explorer.limits import WORK_MEMORY, Busy
from carom.explorer.refused import Refused
from carom.explorer.worker import READY
from carom.quantities.refusals import InputError

try:
    import resource
except ImportError:  # not on Windows
    resource = None  # type: ignore[assignment]

PAGES = Path("/proc/self/statm")  # of memory; Linux has it
ORPHAN = 1.25  # times the limit: only where nobody is left to kill

Work = Callable[[dict[str, Any]], dict[str, Any]]


def answer_lines(task: str, seconds: float) -> None:
    """Do a kind of work, "fit" or "file", for each line on standard input until that ends."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # nobody else writes among the answers
    work = {"fit": _fitting, "file": _writing}[task]()
    _limit_memory()
    print(json.dumps(READY), file=answers, flush=True)
    for line in sys.stdin:
        faulthandler.dump_traceback_later(ORPHAN * seconds, exit=True)
        answer = json.dumps(_answer(work, json.loads(line)), allow_nan=False)
        faulthandler.cancel_dump_traceback_later()
        print(answer, file=answers, flush=True)


def _answer(work: Work, asked: dict[str, Any]) -> dict[str, Any]:
    try:
        return work(asked)
    except Refused as error:
        return {"refused": error.message, "field": error.field}
    except InputError as error:
        return {"refused": str(error)}
    except Busy:
        return {"busy": True}
    except MemoryError:
        return {"refused": f"file: it takes more than {WORK_MEMORY >> 20} MB of memory"}
    except Exception as error:
        return {"failed": f"{type(error).__name__}: {' '.join(str(error).split())}"}


def _fitting() -> Work:
    """Return what fits, once all that it needs is there."""
    from carom import datasets
    from carom.explorer import uploads

    uploads.answer({"data": datasets.names()[0]})
    return lambda asked: uploads.answer(asked)


def _writing() -> Work:
    """Return what writes files, once all that it needs is there."""
    from carom.explorer import files
    from carom.explorer.views import View

    def work(asked: dict[str, Any]) -> dict[str, Any]:
        view = View.of(asked["query"])
        file = files.write(asked["name"], view, asked["time"], Path.cwd())
        content = b64encode(file.read_bytes()).decode()
        file.unlink()
        return {"content": content}

    work({"name": "history.png", "query": "", "time": 0.5})
    return work


def _limit_memory() -> None:
    if resource is None or not PAGES.exists():
        return
    now = int(PAGES.read_text().split()[0]) * resource.getpagesize()
    with suppress(OSError, ValueError):  # a stricter limit may be there already
        resource.setrlimit(resource.RLIMIT_AS, (now + WORK_MEMORY, resource.RLIM_INFINITY))
