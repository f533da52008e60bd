"""Cases on the command line: flags that override a file, and the files that are asked for."""

import sys
from collections.abc import Mapping
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from carom.bodies.cases import LOSSES, OUTPUT, Case, motion_of, normal_of, pair_of
from carom.quantities.units import refusal

if TYPE_CHECKING:
    from carom.impacts.boundary_elements import BoundaryElements
    from carom.impacts.result import Course

allowed = False  # in a process that runs one command


class Output(NamedTuple):
    """Files a case asks for."""

    plot: str | None
    animation: str | None
    data: str | None


def merged(case: Case, flags: Mapping[str, Any]) -> Case:
    """Return the case with what the flags give in place of what the file gives."""
    result = {key: dict(value) if isinstance(value, dict) else value for key, value in case.items()}
    given = {name for name, value in flags.items() if value is not None}
    if given & {"speed", "angle"}:
        result.pop("normal_speed", None), result.pop("tangential_speed", None)
    if given & {"normal_speed", "tangential_speed"}:
        result.pop("speed", None), result.pop("angle", None)
    for name in LOSSES if given & set(LOSSES) else ():
        result.pop(name, None)
    for name in given:
        table, _, key = name.rpartition(".")
        if table:
            result.setdefault(table, {})[key] = flags[name]
        else:
            result[name] = flags[name]
    return result


def solve_case(case: Case, method: "str | BoundaryElements" = "exact") -> "Course":
    """Solve the impact that a case describes."""
    from carom.impacts.solve import impact

    return impact(pair_of(case), **motion_of(case), normal=normal_of(case), method=method)


def outputs(case: Case) -> Output:
    """Return the files that a case asks for."""
    table = case.get("output", {})
    for name, value in table.items():
        if not isinstance(value, str):
            raise refusal(name, value, "must be the name of a file")
    return Output(*(table.get(name) for name in OUTPUT))


def refuse_same(files: Mapping[str, str | Path | None]) -> None:
    """Raise InputError if two of the files, by what they are for, are one."""
    given = {name: Path(file).resolve() for name, file in files.items() if file is not None}
    for (one, path), (other, same) in combinations(given.items(), 2):
        if path == same:
            raise refusal(other, str(files[other]), f"it is the file of {one}; give another name")


def interpret() -> None:
    """Let kernels run as they are written for the rest of this process, where that is allowed."""
    if allowed and "carom.dimensionless.numerics.jit" not in sys.modules:
        import numba
        import numpy as np

        numba.config.DISABLE_JIT = True  # type: ignore[attr-defined]
        np.seterr(all="ignore")  # as in compiled code
