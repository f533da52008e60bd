"""Where the blocks of a sweep are computed: in threads of this process, or on a dask cluster."""

import logging
import warnings
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from concurrent import futures
from contextlib import contextmanager
from functools import lru_cache
from importlib.metadata import version
from itertools import islice
from math import inf
from time import monotonic
from typing import Any, NamedTuple

from carom.dimensionless.numerics.kernels import compiled_by
from carom.dimensionless.numerics.threads import available_cores
from carom.io.extras import extra
from carom.io.version import __version__
from carom.many.sweeps.designs import Box, Values
from carom.many.sweeps.problem import SweepProblem
from carom.many.sweeps.records import SweepStopped
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import MOST_THREADS, counted

ANSWER_SECONDS = 5.0  # that a scheduler, and its first worker, have to answer
CLUSTER = "a scheduler"
LOGS = ("distributed", "distributed.client", "tornado.application")  # one line here tells more
FIRST = futures.FIRST_COMPLETED
BLOCKS_AHEAD = 2  # in flight for each thread
SECONDS_BETWEEN_COUNTS = 1.0  # of the workers of a cluster, which come and go
SECONDS_WITHOUT_WORKERS = 10.0  # until the user is told; a killed one is back after three


class Team(NamedTuple):
    """Those who compute blocks: how one is submitted, how many work now, how they are lost."""

    submit: Callable[[Box], futures.Future[Values]]
    size: Callable[[], int]
    losses: Mapping[type[BaseException], str]

    def results(self, blocks: Sequence[Box]) -> Generator[tuple[Box, Values], None, None]:
        """Yield blocks with their values in the order in which they are finished."""
        queue = iter(blocks)
        flying: dict[futures.Future[Values], Box] = {}
        try:
            while True:
                room = BLOCKS_AHEAD * max(1, self.size()) - len(flying)
                for box in islice(queue, max(0, room)):
                    flying[self.submit(box)] = box
                if not flying:
                    return
                for future in futures.wait(flying, SECONDS_BETWEEN_COUNTS, FIRST).done:
                    yield flying.pop(future), future.result()
        except tuple(self.losses) as error:
            raise SweepStopped(self.losses[type(error)]) from None
        finally:
            for future in flying:
                future.cancel()


@contextmanager
def team(scheduler: str | None, workers: int | None, problem: SweepProblem) -> Iterator[Team]:
    """Hold those who compute a problem: threads here, or the workers of a dask scheduler."""
    if scheduler is None:
        own = available_cores() if workers is None else counted("workers", workers, 1, MOST_THREADS)
        with futures.ThreadPoolExecutor(own, "sweep") as pool:
            yield Team(lambda box: pool.submit(problem.block, box), lambda: own, {})
    elif workers is not None:
        allowed = "a cluster has its own workers; leave it out with a scheduler"
        raise refusal("workers", workers, allowed)
    else:
        with _cluster(scheduler, problem) as there:
            yield there


@contextmanager
def _cluster(address: str, problem: SweepProblem) -> Iterator[Team]:
    with _client(address) as client:
        _check_workers(client, address)
        executor: futures.Executor = client.get_executor(pure=False)
        shared = client.submit(_itself, problem, pure=False)  # a task, made anew if it is lost
        killed = extra("distributed", CLUSTER).KilledWorker
        losses = {
            futures.CancelledError: f"the scheduler {address} no longer answers",
            killed: "the workers of the cluster died, one after another",
        }
        call = executor.submit
        count = _WorkerThreads(client, address)
        yield Team(lambda box: call(_remote_block, shared, box, versions()), count, losses)


@contextmanager
def _client(address: str) -> Iterator[Any]:
    distributed = extra("distributed", CLUSTER)
    try:
        extra("distributed.comm.addressing", CLUSTER).parse_address(address, strict=True)
        client = distributed.Client(address, timeout=ANSWER_SECONDS, set_as_default=False)
    except OSError:
        raise InputError(
            f"scheduler: {address!r} does not answer; start one with 'dask scheduler', and workers "
            "with 'dask worker ADDRESS'"
        ) from None
    except (ValueError, TypeError):
        raise refusal("scheduler", address, "must be an address such as tcp://host:8786") from None
    with _quiet(*LOGS), client:
        yield client


@contextmanager
def _quiet(*names: str) -> Iterator[None]:
    logs = [logging.getLogger(name) for name in names]
    levels = [log.level for log in logs]
    try:
        for log in logs:
            log.setLevel(logging.CRITICAL)
        yield
    finally:
        for log, level in zip(logs, levels, strict=True):
            log.setLevel(level)


class _WorkerThreads:
    """Counts the threads of a cluster, whose workers come and go."""

    def __init__(self, client: Any, address: str) -> None:
        self._client, self._address = client, address
        self._number, self._counted, self._seen = 0, -inf, monotonic()

    def __call__(self) -> int:
        """Return their number, counted again after a second; CancelledError if it is not known."""
        if self._client.status != "running":
            raise futures.CancelledError
        now = monotonic()
        if now > self._counted + SECONDS_BETWEEN_COUNTS:
            self._counted, self._number = now, self._count()
            self._seen = now if self._number else self._seen
            if now > self._seen + SECONDS_WITHOUT_WORKERS:
                self._warn()
        return self._number

    def _count(self) -> int:
        try:
            return sum(self._client.nthreads().values())
        except OSError:
            raise futures.CancelledError from None

    def _warn(self) -> None:
        self._seen = inf  # once, until there are some again
        words = "has no workers left; the sweep waits for new ones: dask worker"
        warnings.warn(f"the scheduler {self._address} {words} {self._address}", stacklevel=1)


def _check_workers(client: Any, address: str) -> None:
    """Raise InputError if a cluster has no workers, or some that cannot be used."""
    try:
        client.wait_for_workers(1, timeout=ANSWER_SECONDS)
    except TimeoutError:
        allowed = f"it has no workers; start one with: dask worker {address}"
        raise refusal("scheduler", address, allowed) from None
    for worker, there in client.run(versions, on_error="return").items():
        _require_same(worker, there, versions())


@lru_cache(maxsize=1)
def versions() -> dict[str, str]:
    """Return the versions of what decides the last bit of a result."""
    own = {"carom": __version__, "numpy": version("numpy")}
    return own | {"a solver compiled by": compiled_by()}


def _require_same(worker: str, there: Any, expected: dict[str, str]) -> None:
    """Raise InputError if a worker does not have the versions of this process."""
    if not isinstance(there, dict):
        raise InputError(f"scheduler: worker {worker} cannot load this version of carom ({there})")
    for name, wanted in expected.items():
        if there.get(name) != wanted:
            raise InputError(
                f"scheduler: worker {worker} has {name} {there.get(name)}, not {wanted} as here; "
                "install the same"
            )


def _itself(problem: SweepProblem) -> SweepProblem:
    return problem


def _remote_block(problem: SweepProblem, box: Box, expected: dict[str, str]) -> Values:
    """Compute a block in a worker, also in one that has joined late."""
    _require_same("that joined", versions(), expected)
    return problem.block(box)
