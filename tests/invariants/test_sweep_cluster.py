"""A sweep on a dask cluster of processes has the bits of a sweep here, also if workers die."""

import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from carom.quantities.refusals import InputError
from carom.sweeps import schedulers, sweep
from carom.sweeps.designs import Grid

distributed = pytest.importorskip("distributed", reason="dask.distributed is not installed")
pytestmark = [pytest.mark.cluster, pytest.mark.slow]

CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "2 m/s"}
GRID = Grid({"angle": np.linspace(0.0, 1.2, 100), "friction": np.linspace(0.05, 0.6, 400)})


@pytest.fixture(scope="module")
def cluster():
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "host": "127.0.0.1"}
    with distributed.LocalCluster(**options, dashboard_address=":0", memory_limit=0) as cluster:
        yield cluster


@pytest.fixture(scope="module")
def here():
    """The sweep of one thread of this process."""
    return sweep(CASE, GRID, workers=1)


def killer(cluster, path: Path, answer: dict[str, int]) -> None:
    """Kill a worker once some blocks are finished."""
    while len(list(path.glob("status/c/*/*"))) < 5:
        time.sleep(0.001)
    answer["pid"] = next(iter(cluster.workers.values())).pid
    os.kill(answer["pid"], signal.SIGKILL)
    answer["finished"] = len(list(path.glob("status/c/*/*")))


def test_worker_killed_in_the_middle_is_survived_with_the_same_bits(cluster, here, tmp_path):
    path, answer = tmp_path / "sweep.zarr", {}
    thread = threading.Thread(target=killer, args=(cluster, path, answer), daemon=True)
    thread.start()
    result = sweep(CASE, GRID, store=path, scheduler=cluster.scheduler_address)
    thread.join(timeout=10)
    assert answer["finished"] < len(list(path.glob("status/c/*/*"))) == 34
    with pytest.raises(ProcessLookupError):
        os.kill(answer["pid"], 0)
    assert here.identical(result.load())
    for name, item in here.variables.items():
        assert result[name].values.tobytes() == item.values.tobytes()


def test_interrupted_here_it_goes_on_there(cluster, here, tmp_path, monkeypatch):
    path = tmp_path / "sweep.zarr"
    with monkeypatch.context() as patched:
        patched.setattr("carom.sweeps.stores.StoreRecord.write", written_then_interrupted())
        with pytest.raises(KeyboardInterrupt, match="3 of 34 blocks are safe"):
            sweep(CASE, GRID, store=path)
    result = sweep(CASE, GRID, store=path, resume=True, scheduler=cluster.scheduler_address)
    assert here.identical(result.load())


def written_then_interrupted():
    from carom.sweeps.stores import StoreRecord

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
