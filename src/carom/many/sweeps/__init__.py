"""Many impacts: any inputs as axes or as samples in, one labelled dataset out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, closing, nullcontext
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from carom.io.extras import extra
from carom.io.progress import Progress, advancing
from carom.many.sweeps.any_shape import problem_of
from carom.many.sweeps.designs import Design, points_in
from carom.many.sweeps.records import MemoryRecord, SweepStopped
from carom.many.sweeps.schedulers import team
from carom.quantities.refusals import flag, known_keywords, refuse

if TYPE_CHECKING:
    import xarray as xr

    from carom.many.sweeps.problem import SweepProblem
    from carom.many.sweeps.stores import StoreRecord

    BlockRecord: TypeAlias = MemoryRecord | StoreRecord  # where the blocks of a sweep are kept


@known_keywords
def sweep(
    case: Mapping[str, Any],
    design: Design,
    *,
    outputs: Sequence[str] | None = None,
    store: str | Path | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Return the impacts of a design as one dataset, each with a status.

    Every point is the impact of `carom.impact`, solved exactly (Maw, Barber & Fawcett 1976). The
    result is the same to the last bit, whether threads or a dask cluster have computed it.

    Parameters
    ----------
    case : mapping
        What all impacts have in common, as in a case file: friction, speed, angle, first, second.
    design : Grid, LatinHypercube or Table
        What varies between the impacts.
    outputs : sequence of str, optional
        Names of the results to compute, by default all.
    store : str or Path, optional
        A folder, ending in .zarr, in which results are stored block by block while they are
        computed. The returned dataset then reads them when they are used.
    resume : bool
        Continue the sweep that is in the store: what is finished is not computed again.
    scheduler : str, optional
        Address of the scheduler of a dask.distributed cluster, tcp://host:8786, whose workers have
        the same versions of carom and numpy, and a solver that the same numba has compiled.
    workers : int, optional
        Number of threads of this process, by default one for each core.
    progress : bool or callable, optional
        Whether a progress bar is shown after two seconds, by default in a notebook and on a
        terminal; or a function that is called with the number of points done and their total.

    Returns
    -------
    xarray.Dataset
        Along the dimensions of the design: the outputs, NaN where there is none, and `status`.

    Raises
    ------
    InputError
        If something cannot be used: the case, the design, a store of another sweep or version, or
        one that another process is writing, a scheduler that does not answer.
    SweepStopped
        If the sweep cannot go on, for instance because the disk is full; what is stored is safe.

    Examples
    --------
    >>> case = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "2 m/s"}
    >>> grid = carom.Grid({"angle": ["20 deg", "60 deg"], "friction": [0.1, 0.2, 0.3]})
    >>> result = carom.sweep(case, grid)
    >>> dict(result.sizes), int(result.status.max())
    ({'angle': 2, 'friction': 3}, 0)
    """
    resume, problem = flag("resume", resume), problem_of(case, design, outputs)
    with team(scheduler, workers, problem) as those, _record(problem, store, resume) as record:
        total = prod(design.shape)
        done = total - sum(points_in(box) for box in record.todo)
        showing = advancing("solving the sweep", total, progress, unit="points", done=done)
        try:
            with closing(those.results(record.todo)) as blocks, showing as advance:
                for box, values in blocks:
                    record.write(box, values)
                    advance(points_in(box))
        except SweepStopped as error:
            raise SweepStopped(f"{error}; {record.safe()}") from None
        except KeyboardInterrupt:
            raise KeyboardInterrupt(record.safe()) from None
        return record.dataset()


def _record(
    problem: SweepProblem, store: str | Path | None, resume: bool
) -> AbstractContextManager[BlockRecord]:
    """Return what keeps the results: a store, or memory."""
    if store is not None:
        stores = extra("carom.many.sweeps.stores", "a store")
        record: AbstractContextManager[StoreRecord] = stores.opened(store, problem, resume)
        return record
    refuse(resume and "resume: there is no store to continue; give the store, too")
    return nullcontext(MemoryRecord(problem))
