"""Fill docs/tangential_solvers.csv and its figure: what solving the tangential problem costs.

python docs/make_tangential_solvers.py            all, about half an hour on one core
python docs/make_tangential_solvers.py --smoke    a few problems, seconds, nothing is stored

Problems are steps of impacts as they occur, those first where most elements change between stick
and slip. Every solver has the same problems, starts, accuracy and budget. Cost is counted in real
two-dimensional transforms of padded fields: a product with T is four.
"""

import argparse
import csv
import sys
import time
from collections.abc import Iterable, Iterator
from itertools import pairwise
from math import ceil
from pathlib import Path
from typing import NamedTuple

import numpy as np
import rival_solvers as rivals
from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.influence import Field
from carom.halfspace.motion import Motion, move
from carom.halfspace.projected import Operator, minimise
from carom.halfspace.quasistatic import Patch, Tolerances
from carom.halfspace.traction import Discs, at_bound
from rival_solvers import Inverse, Iterates, Problem, Solver
from tqdm import tqdm

TABLE = Path(__file__).with_name("tangential_solvers.csv")
FIGURE = TABLE.parent / "figures" / "tangential_solvers.png"
TOLERANCE, BUDGET, SEED = 1e-7, 4000, 20261121
GRIDS = {16: 10, 32: 8, 64: 4}  # elements across: problems of each impact
DENSE = 16  # elements across up to which the matrix is stored


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


class Run(NamedTuple):
    """How a solver did on a problem."""

    grid: int
    case: str
    step: int
    start: str
    solver: str
    transforms: int
    seconds: float
    residual: float
    energy: float

    @property
    def solved(self) -> bool:
        """Whether it was accurate within the budget."""
        return self.residual <= TOLERANCE and self.transforms <= BUDGET


def newton(problem: Problem, start: Field) -> Iterates:
    """Carom's solver."""
    return _newton(problem, start, problem.inverse)


def newton_diagonal(problem: Problem, start: Field) -> Iterates:
    """Carom's solver without its circulant."""
    return _newton(problem, start, lambda pull: pull / problem.compliance.tangential_diagonal)


def _newton(problem: Problem, start: Field, inverse: Inverse) -> Iterates:
    compliance = problem.compliance
    operator = Operator(compliance.tangential, inverse, compliance.tangential_diagonal)
    yield minimise(operator, problem.given, Discs(problem.bound), start, TOLERANCE)


SOLVERS: dict[str, Solver] = {
    "Newton on faces, circulant (Carom)": newton,
    "Newton on faces, diagonal": newton_diagonal,
    "CG along discs, circulant": rivals.face_gradients_fft,
    "CG along discs, diagonal (TangCG)": rivals.face_gradients,
    "proportioned CG (MPGP)": rivals.proportioned,
    "spectral gradient (SPG)": rivals.spectral_gradient,
    "fast gradient (FISTA)": rivals.fast_gradient,
    "splitting (ADMM), circulant": rivals.splitting,
    "block Gauss-Seidel, dense": rivals.gauss_seidel,
}


def measure(problem: Problem, start: Field, solver: Solver) -> tuple[int, float, float, float]:
    """Return transforms, seconds, residual and energy when a solver has done or lost."""
    compliance, residual, energy = problem.compliance, np.inf, np.inf
    compliance.transforms, began = 0, time.perf_counter()
    try:
        for iterate in solver(problem, start):
            if iterate is not None:
                traction, moved = iterate
                pull = problem.slip(moved) / compliance.tangential_diagonal
                left = np.abs(problem.project(traction + pull) - traction).max()
                residual = float(left / problem.bound.max())
                energy = float(np.sum(traction * (0.5 * moved - problem.given)))
            if residual <= TOLERANCE or compliance.transforms > BUDGET:
                break
    except RuntimeError:
        residual = np.inf
    return compliance.transforms, time.perf_counter() - began, residual, energy


def patch_of(grid: int, nu: float, tolerances: Tolerances) -> Patch:
    """Return the contact of like bodies, `grid` elements across it when it is largest."""
    materials = Materials(2.0 * (1.0 - nu) / (2.0 - nu))
    return Patch(Compliance(2 * ceil(0.53 * grid), 2.0 / grid, materials), tolerances)


def impact(grid: int, case: Case, tolerances: Tolerances) -> tuple[Patch, list[Motion]]:
    """Return an impact, step by step, and its contact."""
    patch = patch_of(grid, case.nu, tolerances)
    psi = case.psi * np.array([np.cos(case.angle), np.sin(case.angle)])
    return patch, list(move(patch, psi, case.chi, 5 * grid))


def problems(grid: int, case: Case, wanted: int) -> Iterator[tuple[int, Problem, Field]]:
    """Yield steps of an impact, with the traction before: the first, the last, the busiest."""
    patch, motions = impact(grid, case, Tolerances(1e-9, 1e-9, 1e-9))
    found, changes = [], []
    for place, (before, after) in enumerate(pairwise(motions[:-1])):
        state, step = after.step.state, after.step
        bound = np.where(step.gripped, state.pressure, 0.0)
        if not bound.any():
            continue
        given = step.moved + patch.compliance.tangential(state.traction)
        found.append((place, Problem(patch.compliance, given, bound), before.step.state.traction))
        slid = at_bound(before.step.state.traction, before.step.state.pressure)
        changes.append(np.mean(slid[bound > 0.0] != at_bound(state.traction, bound)[bound > 0.0]))
    busiest = 1 + np.argsort(changes[1:-1], kind="stable")[::-1][: wanted - 2]
    yield from (found[i] for i in sorted({0, *busiest.tolist(), len(found) - 1}))


def start_of(kind: str, problem: Problem, before: Field) -> Field:
    """Return where solvers start: the traction before, nothing, or large ones in any direction."""
    if kind == "wild":
        angles = np.random.default_rng(SEED).uniform(0.0, 2.0 * np.pi, problem.bound.shape)
        return 1e3 * np.stack([np.cos(angles), np.sin(angles)])
    return before if kind == "warm" else np.zeros_like(before)


def runs(grids: dict[int, int], cases: Iterable[Case]) -> Iterator[Run]:
    """Yield what each solver does on each problem from each start."""
    for grid, wanted in grids.items():
        chosen = [s for s in SOLVERS if grid <= DENSE or "dense" not in s]
        for case in tqdm(cases, desc=f"{grid} across", disable=not sys.stderr.isatty()):
            for step, problem, before in problems(grid, case, wanted):
                for kind in STARTS:
                    start = start_of(kind, problem, before)
                    for name in chosen:
                        done = measure(problem, start, SOLVERS[name])
                        yield Run(grid, case.name, step, kind, name, *done)


def summary(all_runs: list[Run]) -> Iterator[dict[str, object]]:
    """Yield a row for each grid, case, start and solver."""
    best: dict[tuple[object, ...], float] = {}
    for run in all_runs:
        key = (run.grid, run.case, run.step)
        if run.solved:
            best[key] = min(best.get(key, np.inf), run.energy)
    for key in dict.fromkeys((r.grid, r.case, r.start, r.solver) for r in all_runs):
        same = [r for r in all_runs if (r.grid, r.case, r.start, r.solver) == key]
        done = [r for r in same if r.solved]
        above = [r.energy / best[r.grid, r.case, r.step] for r in done]
        yield {
            **dict(zip(("grid", "case", "start", "solver"), key, strict=True)),
            "problems": len(same),
            "failures": len(same) - len(done),
            "median transforms": float(np.median([min(r.transforms, BUDGET) for r in same])),
            "most transforms": max(min(r.transforms, BUDGET) for r in same),
            "median time [ms]": round(1e3 * float(np.median([r.seconds for r in same])), 2),
            "energy above best": f"{max((1.0 - a for a in above), default=0.0):.0e}",
        }
