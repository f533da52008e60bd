"""The progress of long work, as a bar on a terminal or in a notebook, or for a function."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from enum import Enum
from functools import partial
from threading import Event, Lock, Thread
from typing import TYPE_CHECKING

from carom.quantities.refusals import refusal

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

Listener = Callable[[int, int], object]  # takes how many are done, and of how many
Progress = bool | Listener | None  # what functions take: whether a bar is shown, or who listens
Advance = Callable[[int], object]  # what work calls with how many more are done

SECONDS_BEFORE_BAR = 2.0
_shown = Lock()  # one bar at a time: what is part of other work has none


class Place(Enum):
    """Where a bar is shown, and after how many seconds it is drawn again."""

    NOTEBOOK = 0.5
    TERMINAL = 0.1
    TEXT = 10.0
    NOWHERE = None


@dataclass
class _Work:
    """What takes long: how much of it there is, if that is known, and how much is done."""

    what: str
    unit: str
    total: int | None
    done: int

    def advance(self, more: int) -> None:
        self.done += more


def advancing(
    what: str, total: int | None, progress: Progress = None, *, unit: str = "", done: int = 0
) -> AbstractContextManager[Advance]:
    """Return a context for long work; its value is a function to call with each progress.

    After two seconds a bar on stderr shows the finished part and the time left. By default it is
    shown in a notebook and on a terminal, with True anywhere, with False nowhere. A function is
    called with the finished and the total number instead.

    Examples
    --------
    >>> with advancing("impacts", 3, lambda done, total: print(done, "of", total)) as advance:
    ...     advance(2)
    ...     advance(1)
    2 of 3
    3 of 3
    """
    work = _Work(what, unit, total, done)
    if callable(progress):
        return nullcontext(partial(_tell, progress, work))
    if progress is not None and not isinstance(progress, bool):
        allowed = "must be True, False, or a function of the finished and the total number"
        raise refusal("progress", progress, allowed)
    where = place(progress)
    return nullcontext(work.advance) if where is Place.NOWHERE else _showing(where, work)


def place(progress: bool | None) -> Place:
    """Return where a bar is shown; by default only on a terminal or in a notebook."""
    if progress is False:
        return Place.NOWHERE
    ipython = sys.modules.get("IPython")  # which is not imported for it
    if hasattr(ipython and ipython.get_ipython(), "kernel"):
        return Place.NOTEBOOK
    if sys.stderr is not None and sys.stderr.isatty():
        return Place.TEXT if os.environ.get("TERM") == "dumb" else Place.TERMINAL
    return Place.TEXT if progress else Place.NOWHERE


def _tell(listener: Listener, work: _Work, more: int) -> None:
    work.advance(more)
    listener(work.done, work.total or 0)


@contextmanager
def _showing(where: Place, work: _Work) -> Iterator[Advance]:
    """Let a thread show the work, so that work of few steps is seen, too."""
    if not _shown.acquire(blocking=False):
        yield work.advance
        return
    over = Event()
    painter = Thread(target=_paint, args=(where, work, over), daemon=True)
    painter.start()
    try:
        yield work.advance
    except BaseException:
        work.what += ", stopped"
        raise
    finally:
        over.set()
        painter.join()
        _shown.release()


def _paint(where: Place, work: _Work, over: Event) -> None:
    """Draw the bar again and again, from when the patience ends until the work is over."""
    if over.wait(SECONDS_BEFORE_BAR):
        return
    bar = _bar(where, work)
    task = bar.add_task(work.what, total=work.total, completed=work.done)
    draw = _drawing(where, bar)
    while not over.wait(where.value):
        bar.update(task, completed=work.done)
        draw()
    bar.update(task, completed=work.done, description=work.what)
    draw()
    if where is Place.TERMINAL:
        bar.stop()


def _drawing(where: Place, bar: "Bar") -> Callable[[], object]:
    """Draw the bar for the first time; return what draws it again."""
    if where is Place.TERMINAL:  # the cursor stays, so that a process that is killed leaves it
        bar.start()
        bar.console.show_cursor(True)
        return bar.refresh
    if where is Place.TEXT:
        bar.console.print(bar)
        return partial(bar.console.print, bar)
    from IPython.display import display

    shown = display(bar, display_id=True)  # type: ignore[no-untyped-call]
    return partial(shown.update, bar)


def _bar(where: Place, work: _Work) -> "Bar":
    """Return a bar on stderr; what is printed to a redirected stdout stays there."""
    from rich import progress as columns
    from rich.console import Console

    count, unit = "{task.completed:,}", f" {work.unit}" * bool(work.unit)
    name = columns.TextColumn("{task.description}", markup=False)
    if work.total is None:
        shown: list[columns.ProgressColumn] = [columns.SpinnerColumn(), name]
        shown += [columns.TextColumn(f"{count}{unit}"), columns.TimeElapsedColumn()]
    else:
        shown = [name, columns.BarColumn(24), columns.TextColumn(f"{count}/{{task.total:,}}{unit}")]
        shown += [columns.TimeRemainingColumn(), columns.TextColumn("left")]
    return columns.Progress(
        *shown,
        console=Console(file=sys.stderr, force_terminal=where is Place.TERMINAL),
        auto_refresh=False,
        transient=True,
        redirect_stdout=sys.stdout is not None and sys.stdout.isatty(),
    )
