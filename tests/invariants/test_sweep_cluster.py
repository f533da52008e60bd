"""A sweep on a dask cluster of processes has the bits of a sweep here, whatever dies meanwhile."""

import re
import sys
from collections import Counter
from concurrent.futures import CancelledError, Future
from pathlib import Path
from threading import Timer
from types import SimpleNamespace

import numpy as np
import pytest

from carom.many.sweeps import schedulers, sweep
from carom.many.sweeps.designs import Grid
from carom.quantities.refusals import InputError

distributed = pytest.importorskip("distributed", reason="dask.distributed is not installed")
sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

import cluster as parts_of_cluster  # noqa: E402

pytestmark = [pytest.mark.cluster, pytest.mark.slow]

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "2 m/s"}
GRID = Grid({"angle": np.linspace(0.0, 1.2, 100), "friction": np.linspace(0.05, 0.6, 400)})


OPTIONS = {
    **{"n_workers": 2, "threads_per_worker": 1, "processes": True, "host": "127.0.0.1"},
    **{"dashboard_address": ":0", "memory_limit": 0},
}


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(**OPTIONS) as cluster:
        yield cluster


@pytest.fixture(scope="module")
def here():
    """The sweep of one thread of this process."""
    return sweep(CASE, GRID, workers=1)


def test_every_part_killed_once_loses_blocks_in_flight_only(tmp_path, capsys):
    """A worker, all workers, the scheduler, the client; the files are those of one thread."""
    case, store = parts_of_cluster.case_of(100_000, tmp_path), tmp_path / "sweep.zarr"
    with parts_of_cluster.Cluster(tmp_path) as parts:
        kills = parts_of_cluster.kill_all(case, store, parts, pause=2)
        begun = Counter(parts.begun())
    assert [kill.lost <= schedulers.BLOCKS_AHEAD * 2 for kill in kills] == [True] * 4
    assert sorted(begun) == sorted(parts_of_cluster.blocks(store)) == [*range(32)]
    assert 0 < begun.total() - 32 == sum(kill.lost for kill in kills)
    *before, last = capsys.readouterr().out.splitlines()
    assert [line for line in before if "has no workers left; the sweep waits" not in line] == []
    gone = r"carom: the scheduler tcp://\S+ no longer answers; \d+ of 32 blocks are safe in \S+; "
    assert re.fullmatch(rf"{gone}--resume .*", last)
    parts_of_cluster.swept(case, tmp_path / "here.zarr", workers=1)
    assert parts_of_cluster.same_files(store, tmp_path / "here.zarr")


def test_all_workers_lost_is_told_in_one_line_and_new_ones_finish(here, tmp_path, monkeypatch):
    monkeypatch.setattr(schedulers, "SECONDS_WITHOUT_WORKERS", 0.1)
    warn, anyway = schedulers._WorkerThreads._warn, []
    with distributed.LocalCluster(**OPTIONS | {"n_workers": 1}) as few:

        def lose_workers(done, total):
            if not anyway:
                anyway.append(Timer(60.0, few.scale, (2,)))  # if nothing is told
                anyway[0].start()
                few.scale(0)

        def warn_and_start_workers(self):
            warn(self)
            few.scale(2)

        monkeypatch.setattr(schedulers._WorkerThreads, "_warn", warn_and_start_workers)
        options = {"scheduler": few.scheduler_address, "progress": lose_workers}
        with pytest.warns(UserWarning, match=r"no workers left; the sweep waits .*\d$") as told:
            result = sweep(CASE, GRID, store=tmp_path / "sweep.zarr", **options)
    anyway[0].cancel()
    assert len(told) == 1
    assert "\n" not in str(told[0].message)
    assert here.identical(result.load())


def team_of(sizes, finished):
    """A team of which so many work, in turn; of what is submitted these numbers finish at once."""
    futures = []

    def submit(box):
        futures.append(Future())
        if len(futures) - 1 in finished:
            futures[-1].set_result({})
        return futures[-1]

    return schedulers.Team(submit, iter(sizes).__next__, {}), futures


def test_workers_that_come_later_have_work_at_once():
    team, futures = team_of([1, 5, 0, 2, 2], range(100))
    submitted = [len(futures) for _ in team.results([(slice(n),) for n in range(17)])]
    assert submitted == [2] * 2 + [12] * 10 + [14] * 2 + [17] * 3


def test_fewer_workers_have_fewer_blocks_ahead():
    team, futures = team_of([5, 1, 1], {0})
    results = team.results([(slice(n),) for n in range(17)])
    next(results)
    futures[1].set_result({})
    next(results)
    assert len(futures) == 10


@pytest.mark.parametrize("status", ["connecting", "running"])
def test_scheduler_lost_while_workers_are_counted_stops_the_sweep(status):
    def nthreads():
        raise OSError("the scheduler is gone")

    client = SimpleNamespace(status=status, nthreads=nthreads)
    count = schedulers._WorkerThreads(client, "tcp://127.0.0.1:1")
    with pytest.raises(CancelledError):
        count()


def test_interrupted_here_it_goes_on_there(cluster, here, tmp_path, monkeypatch):
    path = tmp_path / "sweep.zarr"
    with monkeypatch.context() as patched:
        patched.setattr("carom.many.sweeps.stores.StoreRecord.write", written_then_interrupted())
        with pytest.raises(KeyboardInterrupt, match="3 of 34 blocks are safe"):
            sweep(CASE, GRID, store=path)
    result = sweep(CASE, GRID, store=path, resume=True, scheduler=cluster.scheduler_address)
    assert here.identical(result.load())


def written_then_interrupted():
    from carom.many.sweeps.stores import StoreRecord

    write, written = StoreRecord.write, []

    def patched(self, box, values):
        if len(written) == 3:
            raise KeyboardInterrupt
        written.append(box)
        write(self, box, values)

    return patched


def test_workers_of_another_version_are_refused_in_one_line(cluster, monkeypatch):
    monkeypatch.setattr(schedulers, "__version__", "9.9")
    schedulers.versions.cache_clear()
    with pytest.raises(
        InputError, match=r"worker tcp://\S+ has carom \S+, not 9.9 as here"
    ) as answer:
        sweep(CASE, GRID, scheduler=cluster.scheduler_address)
    schedulers.versions.cache_clear()
    assert "\n" not in str(answer.value)


def test_scheduler_that_does_not_answer_is_refused_soon(monkeypatch):
    """It has the seconds that it is given, and no more."""
    assert schedulers.ANSWER_SECONDS < 10.0
    monkeypatch.setattr(schedulers, "ANSWER_SECONDS", 0.7)
    client, values = distributed.Client, []

    def called(*address, timeout, **options):
        values.append(timeout)
        return client(*address, timeout=timeout, **options)

    monkeypatch.setattr(distributed, "Client", called)
    with pytest.raises(InputError, match="does not answer; start one with 'dask scheduler'"):
        sweep(CASE, GRID, scheduler="tcp://127.0.0.1:1")
    assert values == [0.7]


def test_scheduler_without_workers_is_refused(monkeypatch):
    monkeypatch.setattr(schedulers, "ANSWER_SECONDS", 0.5)
    options = {"n_workers": 0, "processes": True, "host": "127.0.0.1", "dashboard_address": ":0"}
    with (
        distributed.LocalCluster(**options) as empty,
        pytest.raises(InputError, match="it has no workers; start one with: dask worker"),
    ):
        sweep(CASE, GRID, scheduler=empty.scheduler_address)
