"""How far long work is: tqdm in a notebook, rich in a terminal, nothing where nobody watches."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from enum import Enum, auto
from importlib.util import find_spec
from threading import Lock, Timer
from types import TracebackType
from typing import TYPE_CHECKING, NamedTuple

from carom.quantities.units import refusal

if TYPE_CHECKING:
    from rich.progress import Progress as RichProgress

Told = Callable[[int, int], object]  # is told how many are done, and of how many
Progress = bool | Told | None  # what functions take: whether a bar is shown, or who is told
Advance = Callable[[int], object]  # what work calls with how many more are done

PATIENCE = 2.0  # seconds before a bar appears
_shown = Lock()  # one bar at a time: what is part of other work has none


class Place(Enum):
    """Where a bar is shown."""

    NOTEBOOK = auto()
    TERMINAL = auto()
    TEXT = auto()
    NOWHERE = auto()


class Work(NamedTuple):
    """What takes long: how much of it there is, if that is known, and was done before."""

    what: str
    unit: str
    total: int | None
    done: int


def advancing(
    what: str, total: int | None, progress: Progress = None, *, unit: str = "", done: int = 0
) -> AbstractContextManager[Advance]:
    """Return the context of long work, which gives what is to be called with how many more.

    After two seconds a bar shows what is done and the time left: by default in a notebook and on
    a terminal, on stderr; True shows it anywhere, False nowhere; a callable is told instead.

    Examples
    --------
    >>> from carom.io.progress import advancing
    >>> with advancing("impacts", 3, lambda done, total: print(done, "of", total)) as advance:
    ...     advance(2)
    ...     advance(1)
    2 of 3
    3 of 3
    """
    work = Work(what, unit, total, done)
    if progress is None or isinstance(progress, bool):
        where = place(progress)
        return nullcontext(_unseen) if where is Place.NOWHERE else _bar(where, work)
    if not callable(progress):
        allowed = "must be True, False, or what is called with how many are done and their number"
        raise refusal("progress", progress, allowed)
    return nullcontext(_telling(progress, work))


def place(progress: bool | None) -> Place:
    """Return where a bar is shown; without a wish, only where somebody watches."""
    if progress is False:
        return Place.NOWHERE
    if _in_notebook():
        return Place.NOTEBOOK if find_spec("ipywidgets") else Place.TEXT
    if sys.stderr is not None and sys.stderr.isatty():
        plain = os.environ.get("TERM") == "dumb"
        return Place.TEXT if plain else Place.TERMINAL
    return Place.TEXT if progress else Place.NOWHERE


def _in_notebook() -> bool:
    """Tell whether this runs in a Jupyter kernel; IPython is not imported for it."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return hasattr(shell, "kernel")


def _unseen(_: int) -> None:
    pass


def _telling(told: Told, work: Work) -> Advance:
    done = work.done

    def advance(more: int) -> None:
        nonlocal done
        done += more
        told(done, work.total or 0)

    return advance


@contextmanager
def _bar(where: Place, work: Work) -> Iterator[Advance]:
    if not _shown.acquire(blocking=False):
        yield _unseen
        return
    try:
        with _on_terminal(work) if where is Place.TERMINAL else _by_tqdm(where, work) as advance:
            yield advance
    finally:
        _shown.release()


@contextmanager
def _by_tqdm(where: Place, work: Work) -> Iterator[Advance]:
    if where is Place.NOTEBOOK:
        from tqdm.notebook import tqdm
    else:
        from tqdm import tqdm
    with tqdm(
        desc=work.what,
        total=work.total,
        initial=work.done,
        unit=f" {work.unit}",
        unit_scale=True,
        delay=PATIENCE,
        file=sys.stderr,
        dynamic_ncols=True,
    ) as bar:
        yield bar.update


@contextmanager
def _on_terminal(work: Work) -> Iterator[Advance]:
    with TerminalBar(work) as bar:
        yield bar.advance


class TerminalBar:
    """A bar of rich that a timer shows, so that work with few steps is seen, too.

    It vanishes at the end. The cursor stays, so that a process that is killed leaves it there.
    """

    def __init__(self, work: Work) -> None:
        self.work, self.done = work, work.done
        self.bar: RichProgress | None = None
        self.timer = Timer(PATIENCE, self._show)
        self.timer.daemon = True

    def __enter__(self) -> "TerminalBar":
        self.timer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.timer.cancel()
        self.timer.join()
        if self.bar is not None:
            self.bar.stop()

    def advance(self, more: int) -> None:
        """Show that more is done."""
        self.done += more
        if self.bar is not None:
            self.bar.update(self.bar.task_ids[0], completed=self.done)

    def _show(self) -> None:
        bar = _rich_bar(self.work)
        bar.add_task(self.work.what, total=self.work.total, completed=self.done)
        bar.start()
        bar.console.show_cursor(True)
        self.bar = bar


def _rich_bar(work: Work) -> "RichProgress":
    """Return a bar on stderr; what is printed to a redirected stdout stays there."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        Progress,
        ProgressColumn,
        SpinnerColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    name, unit = TextColumn("{task.description}", markup=False), f" {work.unit}" * bool(work.unit)
    if work.total is None:
        count = TextColumn(f"{{task.completed:,}}{unit}")
        columns: tuple[ProgressColumn, ...] = SpinnerColumn(), name, count, TimeElapsedColumn()
    else:
        count = TextColumn(f"{{task.completed:,}}/{{task.total:,}}{unit}")
        columns = name, BarColumn(24), count, TimeRemainingColumn(), TextColumn("left")
    return Progress(
        *columns,
        console=Console(file=sys.stderr, force_terminal=True),
        transient=True,
        redirect_stdout=sys.stdout is not None and sys.stdout.isatty(),
    )
