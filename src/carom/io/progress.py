"""The progress of long work: a bar on a terminal or in a notebook, lines elsewhere, or a function.

Where there is no terminal the commands print a line every ten seconds; a call of the library does
so only if it is asked to, as it may be one of many that run at once.
"""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from contextvars import ContextVar
from dataclasses import dataclass, field
from datetime import timedelta
from enum import Enum
from functools import partial
from threading import Event, Lock, Thread
from time import monotonic
from typing import TYPE_CHECKING

from carom.quantities.refusals import refusal

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

Listener = Callable[[int, int], object]  # takes how many are done, and of how many
Progress = bool | Listener | None  # what functions take: whether a bar is shown, or who listens
Advance = Callable[[int], object]  # what work calls with how many more are done

_shown = Lock()  # one bar at a time: what is part of other work has none


class Place(Enum):
    """Where progress is shown, and after how many seconds again."""

    NOTEBOOK = 0.5
    TERMINAL = 0.1
    TEXT = 10.0
    NOWHERE = None


PATIENCE = {Place.NOTEBOOK: 2.0, Place.TERMINAL: 2.0, Place.TEXT: 10.0}  # seconds before the first
UNWATCHED: ContextVar[Place] = ContextVar("unwatched", default=Place.NOWHERE)  # without a terminal


@dataclass
class _Work:
    """What takes long: how much of it there is, if that is known, and how much is done."""

    what: str
    unit: str
    total: int | None
    done: int
    begun: float = field(default_factory=monotonic)

    def __post_init__(self) -> None:
        self._before = self.done

    def advance(self, more: int) -> None:
        self.done += more

    def line(self) -> str:
        """Return what is done, of how much, and the time that is left or has passed."""
        passed, more = monotonic() - self.begun, self.done - self._before
        counts = [f"{n:,}" for n in (self.done, self.total) if n is not None]
        time = f"{timedelta(seconds=round(passed))} passed"
        if self.total and more:
            left = passed * max(self.total - self.done, 0) / more
            time = f"{timedelta(seconds=round(left))} left"
        told = "/".join(counts) + f" {self.unit}" * bool(self.unit)
        return ", ".join([f"{self.what}: {told}" if self.total or self.unit else self.what, time])


def advancing(
    what: str, total: int | None, progress: Progress = None, *, unit: str = "", done: int = 0
) -> AbstractContextManager[Advance]:
    """Return a context for long work; its value is a function to call with each progress.

    After two seconds a bar on stderr shows the finished part and the time left, where there is no
    terminal a line every ten seconds. By default it is shown in a notebook and on a terminal, with
    True anywhere, with False nowhere. A function is called with the finished and the total number
    instead.

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


@contextmanager
def telling() -> Iterator[None]:
    """Let work inside of this context print lines where there is no terminal."""
    token = UNWATCHED.set(Place.TEXT)
    try:
        yield
    finally:
        UNWATCHED.reset(token)


def place(progress: bool | None) -> Place:
    """Return where progress is shown; by default on a terminal, in a notebook, and by commands."""
    if progress is False:
        return Place.NOWHERE
    ipython = sys.modules.get("IPython")  # which is not imported for it
    if hasattr(ipython and ipython.get_ipython(), "kernel"):
        return Place.NOTEBOOK
    if sys.stderr is not None and sys.stderr.isatty():
        return Place.TEXT if os.environ.get("TERM") == "dumb" else Place.TERMINAL
    return Place.TEXT if progress else UNWATCHED.get()


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
    if over.wait(PATIENCE[where]):
        return
    if where is Place.TEXT:
        _print(work)
        while not over.wait(where.value):
            _print(work)
        _print(work)
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


def _print(work: _Work) -> None:
    with suppress(OSError, ValueError):  # who has read it has gone; the work goes on
        print(work.line(), file=sys.stderr, flush=True)


def _drawing(where: Place, bar: "Bar") -> Callable[[], object]:
    """Draw the bar for the first time; return what draws it again."""
    if where is Place.TERMINAL:  # the cursor stays, so that a process that is killed leaves it
        bar.start()
        bar.console.show_cursor(True)
        return bar.refresh
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
