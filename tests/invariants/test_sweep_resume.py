"""A sweep killed at any instant goes on where it stopped, and ends in the same bits."""

import json
import random
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.io.stores import read_store
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import Grid

SEED = 20261121
CASE = {
    "first": {"radius": "5 mm", "material": "steel"},
    "friction": 0.2,
    "speed": "2 m/s",
    "angle": "30 deg",
}
AXES = {"angle": np.linspace(0.0, 1.2, 100), "friction": np.linspace(0.05, 0.6, 400)}
IN_FLIGHT = 4  # blocks, of two workers

# what the process that is killed runs: it logs every block that it begins
SCRIPT = """
import json, os, sys
import numpy as np
import carom
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import Grid
from carom.io.stores import read_store
from carom.many.sweeps.problem import SweepProblem

path, case, axes = sys.argv[1], *map(json.loads, sys.argv[2:4])
log = os.open(path + ".log", os.O_WRONLY | os.O_APPEND | os.O_CREAT)
block = SweepProblem.block

def logged(self, box, threads=1):
    os.write(log, (json.dumps([[part.start, part.stop] for part in box]) + chr(10)).encode())
    return block(self, box, threads)

SweepProblem.block = logged
sweep(case, Grid(axes), store=path, resume=True, workers=2)
"""


def start(path: Path) -> subprocess.Popen[bytes]:
    axes = json.dumps({name: list(values) for name, values in AXES.items()})
    return subprocess.Popen([sys.executable, "-c", SCRIPT, str(path), json.dumps(CASE), axes])


def begun(path: Path) -> Counter[str]:
    log = Path(f"{path}.log")
    return Counter(log.read_text().splitlines() if log.exists() else [])


def finished(path: Path) -> dict[str, tuple[int, ...]]:
    """Return the blocks that have a status, with the instants at which their files were written."""
    folder = path / "status"
    keys = [
        str(file.relative_to(folder))
        for file in folder.glob("c/**/*")
        if file.is_file() and file.suffix != ".partial"
    ]
    return {
        key: tuple(file.stat().st_mtime_ns for file in sorted(path.glob(f"*/{key}")))
        for key in keys
    }


def wait_for(path: Path, blocks: int, process: subprocess.Popen[bytes]) -> None:
    while len(finished(path)) < blocks:
        assert process.poll() is None
        time.sleep(0.002)


@pytest.fixture(scope="module")
def truth():
    """The sweep as it is without a store and without an interruption."""
    return sweep(CASE, Grid(AXES), progress=False)


def same_bits(one, other) -> bool:
    return set(one.variables) == set(other.variables) and all(
        one[name].dtype == other[name].dtype and one[name].values.tobytes() == item.values.tobytes()
        for name, item in other.variables.items()
    )


def runs(log: Counter[str], chunks: tuple[int, ...]) -> Counter[str]:
    """Return how often each block was begun, by the name of its files."""
    counts = Counter()
    for line, number in log.items():
        starts = (first for first, _ in json.loads(line))
        corner = (first // chunk for first, chunk in zip(starts, chunks, strict=True))
        counts["/".join(["c", *map(str, corner)])] += number
    return counts


@pytest.mark.slow
def test_killed_at_random_instants_it_repeats_nothing_and_ends_in_the_same_bits(tmp_path, truth):
    rng = random.Random(SEED)
    path = tmp_path / "sweep.zarr"
    done, ran, settled = {}, Counter(), {}
    for attempt in range(2):
        process = start(path)
        try:
            wait_for(path, len(done) + rng.randint(2, 12), process)
            if attempt == 0:  # meanwhile the store is taken
                with pytest.raises(carom.InputError, match="another process"):
                    sweep(CASE, Grid(AXES), store=path, resume=True)
            time.sleep(rng.uniform(0.0, 0.05))
        finally:
            process.kill()
            assert process.wait() == -signal.SIGKILL
        before, done, ran_before, ran = done, finished(path), ran, begun(path)
        assert before.items() <= done.items()  # none was written again
        new_runs, new_blocks = (ran - ran_before).total(), len(done) - len(before)
        assert 0 <= new_runs - new_blocks <= IN_FLIGHT  # what was lost
        chunks = read_store(path).status.encoding["chunks"]
        settled = {key: runs(ran, chunks)[key] for key in done}
    assert start(path).wait(timeout=60) == 0
    assert done.items() <= finished(path).items()
    assert settled.items() <= runs(begun(path), chunks).items()  # none was computed again
    assert len(done) < len(begun(path)) == len(finished(path))
    assert not list(path.rglob("*.partial"))
    result = read_store(path)
    assert same_bits(truth, result)
    assert truth.identical(result.load())
