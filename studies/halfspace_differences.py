"""What the table of full solutions says: differences from the theory, and errors of grids.

A difference from the theory is, of like materials, that from nu = 0 on the same grid, where the
theory is exact: most of the error of the grid is common to both. Of spin it is that from none. It
is extrapolated from the two finest grids.
"""

from collections import defaultdict
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from halfspace_plan import Impact
from halfspace_study import TABLE, Row, load

import carom
from carom.dimensionless.neglected import rebound_error, spin_error
from carom.halfspace.solution import refinement_error

ORDER = 1.5  # of the error of the grid
TOLERANCE = 1e-6  # of the solvers: what is less tells nothing

Case = tuple[str, str, float]  # label, case, psi_1


class Known(NamedTuple):
    """A number and how far it may be off; not a number where one grid alone is known."""

    value: float
    error: float


def bound(impact: Impact) -> float:
    """Return how far the theory's psi_2 may be off; of an impact with spin, by the spin."""
    if impact.spin:
        return float(spin_error(impact.chi, impact.psi_1, impact.spin))
    numbers = impact.kappa, impact.beta, impact.friction, impact.chi
    return float(rebound_error(*numbers, impact.psi_1))


def exact(impact: Impact) -> float:
    """Return psi_2 of the theory."""
    return float(carom.rebound(impact.psi_1, impact.chi))


@cache
def grids() -> dict[Case, dict[int, tuple[Impact, Row]]]:
    """Return the table by impact, then by elements across."""
    found: dict[Case, dict[int, tuple[Impact, Row]]] = defaultdict(dict)
    for impact, row in load(TABLE).items():
        found[impact.label, impact.case, impact.psi_1][impact.elements] = impact, row
    return dict(found)


@cache
def plain() -> dict[tuple[float, float, int], float]:
    """Return psi_2 of nu = 0 by chi, psi_1 and elements across."""
    return {
        (impact.chi, impact.psi_1, impact.elements): row.psi_2
        for impact, row in load(TABLE).items()
        if impact.kappa == 1.0 and impact.beta == 0.0 and impact.spin == 0.0
    }


def finest(case: Case) -> tuple[Impact, Row]:
    """Return an impact on the finest grid there is."""
    return grids()[case][max(grids()[case])]


def cases(label: str, name: str | None = None) -> list[Case]:
    """Return the impacts of a series in the order of incidence."""
    return sorted(case for case in grids() if case[0] == label and name in (None, case[1]))


def extrapolated(values: dict[int, float]) -> Known:
    """Return a value for infinitely many elements, its error the step from the finest grid."""
    n = sorted(values)
    steps = [(values[b] - values[a]) / ((b / a) ** ORDER - 1.0) for a, b in pairwise(n)]
    if not steps:
        return Known(values[n[-1]], float("nan"))
    return Known(values[n[-1]] + steps[-1], abs(steps[-1]))


def differences(case: Case) -> dict[int, float]:
    """Return psi_2 of the full solution less that of what it is compared with, by grid."""
    there = grids()[case]
    impact = finest(case)[0]
    if impact.spin:
        still = grids()["still " + case[0], *case[1:]]
        return {n: row.psi_2 - still[n][1].psi_2 for n, (_, row) in there.items()}
    if impact.kappa == 1.0 and not impact.beta:
        return {n: row.psi_2 - exact(impact) for n, (_, row) in there.items()}
    keys = {n: (impact.chi, impact.psi_1, n) for n in there}
    return {n: there[n][1].psi_2 - plain()[key] for n, key in keys.items() if key in plain()}


@cache
def difference(case: Case) -> Known:
    """Return psi_2 of the full solution less the theory's; with spin, less that without."""
    return extrapolated(differences(case))


class Judged(NamedTuple):
    """A difference and its bound."""

    case: Case
    size: float  # with its error, less the tolerance of the solvers
    bound: float


@cache
def judged(label: str) -> tuple[Judged, ...]:
    """Return the differences of a series with their bounds, those of nu = 0 left out."""
    found = []
    for case in cases(label):
        impact, (value, error) = finest(case)[0], difference(case)
        if impact.kappa != 1.0 or impact.beta or impact.spin:
            size = max(abs(value) + float(np.nan_to_num(error)) - TOLERANCE, 0.0)
            found.append(Judged(case, size, bound(impact)))
    return tuple(found)


class Estimated(NamedTuple):
    """An error of a grid, and its estimate from coarser ones."""

    error: float
    estimate: float


def truth(case: Case) -> float:
    """Return psi_2 without the error of a grid: by the theory, or from finer grids."""
    impact = finest(case)[0]
    if impact.beta:
        fine = {n: row.psi_2 for n, (_, row) in grids()[case].items() if n >= 48}
        return extrapolated(fine).value
    if impact.kappa == 1.0:
        return exact(impact)
    return exact(impact) + differences(case)[64]


def estimates(kind: str, elements: int) -> list[Estimated]:
    """Return the errors of the study of errors, and what the grids say of them."""
    found = []
    for case in cases("judge"):
        there = grids()[case]
        coarser = [n for n in (elements // 4, elements // 2, elements) if n in there]
        if not case[1].startswith(f"{kind} ") or len(coarser) < 3:
            continue
        values = [there[n][1].psi_2 for n in coarser]
        found.append(Estimated(abs(values[-1] - truth(case)), refinement_error(*values)))
    return found
