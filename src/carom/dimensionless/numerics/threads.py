"""Many impacts in threads: blocks of them, as the kernels release the GIL."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor


def available_cores() -> int:
    """Return the number of cores this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not on every system
        return os.cpu_count() or 1


def in_blocks(
    task: Callable[[slice], None], count: int, largest: int, smallest: int, threads: int | None
) -> None:
    """Do a task for every block of so many items, in threads, all cores by default."""
    threads = threads or available_cores()
    size = min(largest, max(smallest, -(-count // (2 * threads))))
    parts = [slice(start, start + size) for start in range(0, count, size)]
    workers = min(threads, len(parts) - 1)
    if workers <= 1:
        for part in parts:
            task(part)
        return
    task(parts[0])  # compiles, if need be, in one thread
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(task, parts[1:]))
