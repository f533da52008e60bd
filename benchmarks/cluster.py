"""What a sweep costs on a dask cluster, and what is lost when parts of the cluster are killed.

python benchmarks/cluster.py            a million impacts, some ten minutes
python benchmarks/cluster.py --kills    only the second question, a minute
python benchmarks/cluster.py --smoke    a quick pass through the same code

Scheduler, workers and client are processes of this machine. Needs `.[cluster]`.
"""

import argparse
import re
import shutil
import socket
import subprocess
import sys
import time
from bisect import bisect
from collections import Counter
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import NamedTuple, Self

import carom
from carom.bodies.cases import read_case
from carom.many.sweeps.tables import plan

CASE = Path(__file__).parents[1] / "examples" / "million.toml"
SECONDS = 120.0  # that anything may take
LOGGING = """
import os
from carom.many.sweeps.problem import SweepProblem
block, log = SweepProblem.block, os.open({log!r}, os.O_WRONLY | os.O_APPEND | os.O_CREAT)

def dask_setup(worker):
    SweepProblem.block = logged

def logged(self, box, threads=1):
    os.write(log, f"{{box[0].start // self.chunks()[0]}}\\n".encode())
    return block(self, box, threads)
"""


def until(true: Callable[[], object]) -> float:
    """Wait until something is true; return how many seconds it took."""
    start = time.perf_counter()
    while not true():
        if time.perf_counter() > start + SECONDS:
            raise TimeoutError
        time.sleep(0.005)
    return time.perf_counter() - start


class Cluster:
    """A scheduler and workers of one thread: processes that can be killed and started again."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        with socket.create_server(("127.0.0.1", 0)) as free:
            self._port = str(free.getsockname()[1])
        self.address = f"tcp://127.0.0.1:{self._port}"
        self._log = folder / "begun.log"
        self._log.touch()
        (folder / "logging_blocks.py").write_text(LOGGING.format(log=str(self._log)))
        self._scheduler: subprocess.Popen[bytes] | None = None
        self._workers: list[subprocess.Popen[bytes]] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.kill_scheduler()
        self.kill_workers()

    def _started(self, *words: str) -> "subprocess.Popen[bytes]":
        command = [sys.executable, "-m", "dask", *words]
        with (self._folder / "dask.log").open("ab") as log:
            return subprocess.Popen(command, stdout=log, stderr=log, cwd=self._folder)

    def start(self, workers: int) -> None:
        self.start_scheduler()
        self.start_workers(workers)

    def start_scheduler(self) -> None:
        words = ("--host", "127.0.0.1", "--port", self._port, "--dashboard-address", ":0")
        self._scheduler = self._started("scheduler", *words)

    def start_workers(self, number: int) -> None:
        """Start workers, and wait until they can be used."""
        from distributed import Client

        words = (
            "--nthreads",
            "1",
            "--no-nanny",
            "--no-dashboard",
            "--preload",
            "logging_blocks.py",
        )
        self._workers += [self._started("worker", self.address, *words) for _ in range(number)]
        with Client(self.address, timeout=SECONDS, set_as_default=False) as client:
            client.wait_for_workers(number, timeout=SECONDS)

    def kill_workers(self, number: int | None = None) -> None:
        """Kill some workers or all, as if their machines were gone."""
        for worker in self._workers[:number]:
            worker.kill()
            worker.wait()
        del self._workers[:number]

    def kill_scheduler(self) -> None:
        if self._scheduler is not None:
            self._scheduler.kill()
            self._scheduler.wait()

    def begun(self) -> list[int]:
        """Return the numbers of the blocks that workers have begun, in this order."""
        return [int(line) for line in self._log.read_text().split()]

    def cpu(self) -> tuple[float, float]:
        """Return the CPU seconds of the scheduler and of the workers so far."""
        from psutil import Process

        assert self._scheduler is not None
        processes = (self._scheduler, *self._workers)
        first, *others = (sum(Process(each.pid).cpu_times()[:2]) for each in processes)
        return first, sum(others)


class Client:
    """`carom sweep --resume` on a cluster, in a process of its own."""

    def __init__(self, case: Path, store: Path, cluster: Cluster) -> None:
        words = ("sweep", case, "--store", store, "--resume", "--scheduler", cluster.address)
        self._command = [sys.executable, "-m", "carom", *map(str, words)]
        self._store, self._errors = store, store.with_suffix(".log")
        self.start()

    def start(self) -> None:
        with self._errors.open("wb") as errors:
            self._process = subprocess.Popen(
                self._command, stdout=subprocess.DEVNULL, stderr=errors
            )

    def stores(self, more: int) -> None:
        """Wait until more blocks are in the store, or it ends."""
        number = len(blocks(self._store)) + more
        until(lambda: self._process.poll() is not None or len(blocks(self._store)) >= number)

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def end(self) -> tuple[int, str]:
        """Wait for its end; return the exit code, and what it said."""
        return self._process.wait(SECONDS), self._errors.read_text()


def blocks(store: Path) -> dict[int, int]:
    """Return the finished blocks of a store, each with the instant at which it was written."""
    files = store.glob("status/c/*")
    return {int(each.name): each.stat().st_mtime_ns for each in files if each.name.isdecimal()}


def case_of(points: int, folder: Path) -> Path:
    """Write the case with another number of impacts."""
    text, found = re.subn(r"(?m)^samples = \S+", f"samples = {points}", CASE.read_text())
    assert found == 1
    path = folder / f"{points}.toml"
    path.write_text(text)
    return path


def same_files(one: Path, other: Path) -> bool:
    """Tell whether two stores have the same files with the same bytes."""
    first, second = (
        {path.relative_to(store): path.read_bytes() for path in store.rglob("*") if path.is_file()}
        for store in (one, other)
    )
    return first == second


class Kill(NamedTuple):
    """What was killed, after how many seconds there was a new block, how many were lost."""

    what: str
    seconds: float
    lost: int


def kill_all(case: Path, store: Path, cluster: Cluster, pause: int) -> list[Kill]:
    """Sweep, and kill each part of the cluster, some blocks apart; start again what is needed."""
    safe: dict[int, int] = {}
    seconds: dict[str, float] = {}
    marks: list[int] = []  # how many blocks had been begun at each kill
    cluster.start(2)
    client = Client(case, store, cluster)

    def killed(what: str, kill: Callable[[], None], *then: Callable[[], object]) -> None:
        client.stores(pause)
        safe.update(blocks(store))
        kill()
        start = time.perf_counter()
        marks.append(len(cluster.begun()))
        for step in then:
            step()
        client.stores(1)
        seconds[what] = time.perf_counter() - start

    def stopped() -> None:
        code, words = client.end()
        assert code == 1, words
        print(words, end="")
        cluster.kill_workers()

    anew = partial(cluster.start_workers, 2)
    killed("one worker of two", partial(cluster.kill_workers, 1))
    killed("all workers", cluster.kill_workers, anew)
    whole = (stopped, cluster.start_scheduler, anew, client.start)
    killed("the scheduler", cluster.kill_scheduler, *whole)
    killed("the client", client.kill, client.start)
    code, words = client.end()
    assert code == 0, words
    assert safe.items() <= blocks(store).items()  # none was written again
    log = cluster.begun()
    lost = Counter(bisect(marks, i) for i, block in enumerate(log) if block in log[i + 1 :])
    return [Kill(what, time, lost[i]) for i, (what, time) in enumerate(seconds.items())]


def report_kills(points: int, folder: Path) -> None:
    """Print what is lost when parts are killed; the result must be that of one thread."""
    case = case_of(points, folder)
    swept(case, folder / "here.zarr", workers=1)
    print(f"\nA sweep of {points} impacts, of which parts are killed:")
    with Cluster(folder) as cluster:
        for what, seconds, lost in kill_all(case, folder / "there.zarr", cluster, 5):
            print(f"{what:17s} a new block after {seconds:4.1f} s; {lost} blocks computed again")
        stored = len(blocks(folder / "there.zarr"))
        print(f"{len(cluster.begun())} blocks begun, {stored} stored; ", end="")
    assert same_files(folder / "here.zarr", folder / "there.zarr")
    print("every file has the bytes of that of one thread")


class Cost(NamedTuple):
    """Seconds of a sweep into a store, and CPU seconds of those who take part."""

    seconds: float
    client: float  # or threads here
    scheduler: float = 0.0
    workers: float = 0.0


def swept(case: Path, store: Path, **how: object) -> tuple[float, float]:
    """Sweep; return the seconds and the CPU seconds of this process."""
    content = read_case(str(case))
    design, outputs = plan(content, case)
    shutil.rmtree(store, ignore_errors=True)
    start, cpu = time.perf_counter(), time.process_time()
    carom.sweep(content, design, outputs=outputs, store=store, **how)
    return time.perf_counter() - start, time.process_time() - cpu


def by_threads(number: int, case: Path, store: Path) -> Cost:
    return Cost(*swept(case, store, workers=number))


def by_workers(number: int, case: Path, store: Path) -> Cost:
    with TemporaryDirectory() as folder, Cluster(Path(folder)) as cluster:
        cluster.start(number)
        few = case_of(5000 * number, Path(folder))  # loads the code
        swept(few, store, scheduler=cluster.address)
        before = cluster.cpu()
        own = swept(case, store, scheduler=cluster.address)
        return Cost(*own, *(b - a for a, b in zip(before, cluster.cpu(), strict=True)))


def report_costs(points: int, rounds: int, folder: Path) -> None:
    """Let threads and workers take turns; print the least times, and medians of CPU times."""
    ways = {f"{n} threads": partial(by_threads, n) for n in (1, 2)}
    ways |= {f"{n} workers": partial(by_workers, n) for n in (1, 2)}
    case, store = case_of(points, folder), folder / "sweep.zarr"
    swept(case_of(64, folder), store, workers=1)
    costs: dict[str, list[Cost]] = {name: [] for name in ways}
    for _ in range(rounds):
        for name, way in ways.items():
            costs[name].append(way(case, store))
    print(f"{points} impacts into a store, the best of {rounds} rounds; medians of CPU times")
    for name, rows in costs.items():
        least = min(row.seconds for row in rows)
        _, client, scheduler, workers = map(median, zip(*rows, strict=True))
        ratio = median(
            one.seconds / row.seconds for one, row in zip(costs["1 threads"], rows, strict=True)
        )
        print(
            f"{name}: {least:5.1f} s, {points / least:6.0f} a second, {ratio:.2f} times 1 thread;"
            f" CPU: client {client:4.1f} s, scheduler {scheduler:.1f} s, workers {workers:4.1f} s"
        )
    size = sum(path.stat().st_size for path in store.rglob("*") if path.is_file())
    print(f"{size / points:.0f} bytes an impact; a client stores at most {points / client:.0f} a")
    print("second, however many workers there are")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    parser.add_argument("--kills", action="store_true", help="only what is lost")
    given = parser.parse_args()
    if find_spec("distributed") is None:
        print("skipped: dask.distributed is not installed")
        return
    points, rounds = (20_000, 1) if given.smoke else (1_000_000, 3)
    with TemporaryDirectory() as folder:
        if not given.kills:
            report_costs(points, rounds, Path(folder))
        if not given.smoke:  # a test does it
            report_kills(points, Path(folder))


if __name__ == "__main__":
    main()
