"""What must a tangential solver master? Steps of impacts, and made-up problems, to measure it."""

from collections.abc import Iterator
from itertools import pairwise
from math import ceil
from typing import NamedTuple

import numpy as np
from rival_solvers import Problem, largest_eigenvalue

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.influence import Field
from carom.halfspace.motion import BodyMotion, move
from carom.halfspace.quasistatic import Patch, Tolerances
from carom.halfspace.traction import at_bound

SEED = 20261121


class Case(NamedTuple):
    """An impact: incidence, inertia, Poisson's ratio, direction in rad."""

    name: str
    psi: float
    chi: float
    nu: float
    angle: float = 0.0


CASES = (
    Case("gross slip to stick", 2.0, 1.44, 0.3),
    Case("ring reverses", 0.5, 2.2, 0.3),
    Case("nearly retraced", 0.3, 4.0, 0.0),
    Case("slip through maximum", 3.5, 1.44, 0.3),
    Case("incompressible", 1.5, 1.44, 0.5),
    Case("odd angle", 1.5, 2.2, 0.5, 0.4),
)
STARTS = ("warm", "zero", "wild")


class Task(NamedTuple):
    """A problem, what it stands for, its own name, and the traction before."""

    case: str
    name: str
    problem: Problem
    before: Field


def patch_of(grid: int, nu: float, tolerances: Tolerances) -> Patch:
    """Return the contact of like bodies, `grid` elements across it when it is largest."""
    materials = Materials(2.0 * (1.0 - nu) / (2.0 - nu))
    return Patch(Compliance(2 * ceil(0.53 * grid), 2.0 / grid, materials), tolerances)


def impact(grid: int, case: Case, tolerances: Tolerances) -> tuple[Patch, list[BodyMotion]]:
    """Return an impact, step by step, and its contact."""
    patch = patch_of(grid, case.nu, tolerances)
    psi = case.psi * np.array([np.cos(case.angle), np.sin(case.angle)])
    return patch, list(move(patch, psi, case.chi, 5 * grid))


def recorded(grid: int, case: Case, wanted: int) -> Iterator[Task]:
    """Yield steps of an impact, with the traction before: the first, the last, the busiest."""
    patch, motions = impact(grid, case, Tolerances(1e-8, 1e-8))
    found, changes = [], []
    for place, (before, after) in enumerate(pairwise(motions[:-1])):
        traction, bound = after.step.state.traction, after.step.state.bound
        if not bound.any():
            continue
        given = after.step.moved + patch.compliance.tangential(traction)
        start = before.step.state.traction
        eigenvalue = largest_eigenvalue(patch.compliance, bound)
        problem = Problem(patch.compliance, given, bound, eigenvalue)
        found.append(Task(case.name, f"{case.name} {place}", problem, start))
        slid = at_bound(start, before.step.state.pressure) != at_bound(traction, bound)
        changes.append(np.count_nonzero(slid & (bound > 0.0)))
    found[0] = found[0]._replace(case="first contact")
    found[-1] = found[-1]._replace(case="vanishing contact")
    busiest = 1 + np.argsort(changes[1:-1], kind="stable")[::-1][: wanted - 2]
    yield from (found[i] for i in sorted({0, *busiest.tolist(), len(found) - 1}))


def made_up(grid: int, sets: int) -> Iterator[Task]:
    """Yield problems that no impact poses, to see what breaks a solver."""
    patch = patch_of(grid, 0.3, Tolerances())
    compliance, gap = patch.compliance, patch.grid.apart
    hertz = np.sqrt(np.maximum(1.0 - 2.0 * gap, 0.0))
    for seed in range(sets):
        random = np.random.default_rng([SEED, seed])
        noise = random.normal(size=(2, *gap.shape))
        decades = (hertz > 0.0) * 10.0 ** random.uniform(-6.0, 0.0, gap.shape)
        islands = hertz * random.uniform(size=gap.shape) * (random.uniform(size=gap.shape) < 0.5)
        for case, given, bound in (
            ("made up: noise", noise, hertz),
            ("made up: bounds over six decades", noise, decades),
            ("made up: rough bodies", np.stack([gap, 1.0 - gap]) + 0.01 * noise, islands),
        ):
            problem = Problem(compliance, given, bound, largest_eigenvalue(compliance, bound))
            yield Task(case, f"{case} {seed}", problem, np.zeros_like(given))


def start_of(kind: str, task: Task) -> Field:
    """Return where solvers start: the traction before, nothing, or large ones in any direction."""
    if kind == "wild":
        angles = np.random.default_rng(SEED).uniform(0.0, 2.0 * np.pi, task.problem.bound.shape)
        return 1e3 * np.stack([np.cos(angles), np.sin(angles)])
    return task.before if kind == "warm" else np.zeros_like(task.before)
