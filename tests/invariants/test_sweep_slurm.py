"""The scripts of the manual for SLURM, with a stand-in for sbatch that starts each job at once."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import carom

pytestmark = [pytest.mark.cluster, pytest.mark.slow]
PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "cluster.md"
STAND_INS = {
    "sbatch": 'cp "$1" job$$.sh; bash job$$.sh >>jobs.log 2>&1 & echo "Submitted batch job $!"',
    "scancel": 'kill "$@"',
}


def script(name):
    """A script that the page shows."""
    return re.search(rf"```python\n# {name}\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)[1]


def run(name, folder, *words, **changes):
    """Run a script of the page in a folder, with some texts in it changed."""
    text = script(name)
    for old, new in changes.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    (folder / name).write_text(text)
    for command, line in STAND_INS.items():
        path = folder / "bin" / command
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"#!/bin/bash\n{line}\n")
        path.chmod(0o755)
    where = os.environ | {"PATH": f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"}
    command = [sys.executable, name, *words]
    subprocess.run(command, cwd=folder, env=where, check=True, timeout=300)


def test_script_for_slurm_asks_for_what_it_says_and_sweeps(tmp_path):
    pytest.importorskip("dask_jobqueue", reason="dask-jobqueue is not installed")
    run("on_slurm.py", tmp_path, **{"1_000_000": "400", "jobs=4": "jobs=2"})
    first, *lines = next(tmp_path.glob("job*.sh")).read_text().splitlines()
    assert first.startswith("#!")
    asked = dict(shlex.split(line)[1:3] for line in lines if re.match("#SBATCH -[a-zA-Z] ", line))
    assert asked == {"-J": "dask-worker", "-p": "compute", "-n": "1", "-t": "01:00:00"}
    assert {"#SBATCH --cpus-per-task=16", "#SBATCH --mem=15G"} <= set(lines)
    worker = shlex.split(lines[-1])
    assert worker[:3] == [sys.executable, "-m", "distributed.cli.dask_worker"]
    assert worker[worker.index("--nthreads") + 1] == "16"
    ranges = {"angle": ("0 deg", "55 deg"), "spin": ("-50 rad/s", "50 rad/s")}
    pmma = {"first": {"radius": "5 mm", "material": "pmma"}, "friction": 0.2, "speed": "2 m/s"}
    relaxing = {**pmma, "relaxation_time": "20 us", "modulus_ratio": 1.5}
    here = carom.sweep(relaxing, carom.LatinHypercube(ranges, samples=400, seed=1))
    assert here.identical(carom.read(tmp_path / "million.zarr").load())


def test_parts_of_a_job_array_are_together_one_sweep(tmp_path):
    for part in range(2):
        run("part.py", tmp_path, str(part), "2", **{"0.6, 400": "0.6, 5"})
    parts = [carom.read(tmp_path / f"part{part}.zarr") for part in range(2)]
    axes = {"friction": np.linspace(0.05, 0.6, 5), "angle": np.radians(np.linspace(0, 85, 86))}
    case = {"first": {"radius": "5 mm", "material": "steel"}, "speed": "2 m/s"}
    assert xr.concat(parts, "friction").equals(carom.sweep(case, carom.Grid(axes)))
