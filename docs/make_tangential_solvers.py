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
from itertools import pairwise, product
from math import ceil
from pathlib import Path
from typing import NamedTuple

import numpy as np
import rival_solvers as rivals
from rival_solvers import Inverse, Iterates, Problem, Solver
from tqdm import tqdm

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.influence import Field
from carom.halfspace.motion import Motion, move
from carom.halfspace.projected import Operator, minimise
from carom.halfspace.quasistatic import Patch, Tolerances
from carom.halfspace.traction import Discs, at_bound

TABLE = Path(__file__).with_name("tangential_solvers.csv")
FIGURE = TABLE.parent / "figures" / "tangential_solvers.png"
TOLERANCES = TABLE.with_name("tangential_tolerances.csv")
TOLERANCE, BUDGET, SEED = 1e-7, 4000, 20261121
GRIDS = {16: 8, 32: 8, 64: 8}  # elements across: problems of each impact
FINEST, LOOSER = (1e-8, 1e-8), (1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
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
    problem: tuple[str, int]  # impact and step
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

    @property
    def cost(self) -> int:
        """Number of transforms, at most the budget."""
        return min(self.transforms, BUDGET)


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


def problems(grid: int, case: Case, wanted: int) -> Iterator[tuple[str, int, Problem, Field]]:
    """Yield steps of an impact, with the traction before: the first, the last, the busiest."""
    patch, motions = impact(grid, case, Tolerances(1e-8, 1e-8))
    found, changes = [], []
    for place, (before, after) in enumerate(pairwise(motions[:-1])):
        traction, bound = after.step.state.traction, after.step.gripped * after.step.state.pressure
        if not bound.any():
            continue
        given = after.step.moved + patch.compliance.tangential(traction)
        start = before.step.state.traction
        eigenvalue = rivals.largest_eigenvalue(patch.compliance, bound)
        problem = Problem(patch.compliance, given, bound, eigenvalue)
        found.append([case.name, place, problem, start])
        slid = at_bound(start, before.step.state.pressure) != at_bound(traction, bound)
        changes.append(np.count_nonzero(slid & (bound > 0.0)))
    found[0][0], found[-1][0] = "first contact", "vanishing contact"
    busiest = 1 + np.argsort(changes[1:-1], kind="stable")[::-1][: wanted - 2]
    yield from (tuple(found[i]) for i in sorted({0, *busiest.tolist(), len(found) - 1}))


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
            for label, step, problem, before in problems(grid, case, wanted):
                for kind in STARTS:
                    start = start_of(kind, problem, before)
                    for name in chosen:
                        done = measure(problem, start, SOLVERS[name])
                        yield Run(grid, label, (case.name, step), kind, name, *done)


def summary(all_runs: list[Run]) -> Iterator[dict[str, object]]:
    """Yield a row for each grid, case, start and solver."""
    best: dict[tuple[object, ...], float] = {}
    for run in all_runs:
        key = (run.grid, run.problem)
        if run.solved:
            best[key] = min(best.get(key, np.inf), run.energy)
    for key in dict.fromkeys((r.grid, r.case, r.start, r.solver) for r in all_runs):
        same = [r for r in all_runs if (r.grid, r.case, r.start, r.solver) == key]
        done = [r for r in same if r.solved]
        above = [1.0 - r.energy / best[r.grid, r.problem] for r in done]
        yield {
            **dict(zip(("grid", "case", "start", "solver"), key, strict=True)),
            "problems": len(same),
            "failures": len(same) - len(done),
            "median transforms": float(np.median([r.cost for r in same])),
            "most transforms": max(r.cost for r in same),
            "median time [ms]": f"{1e3 * np.median([r.seconds for r in same]):.2f}",
            "energy above best": f"{max(above, default=np.inf):.0e}",
        }


def tolerances(grid: int, cases: Iterable[Case]) -> Iterator[dict[str, object]]:
    """Yield how far psi_2 moves, and what an impact costs, as either tolerance is loosened."""

    def rebound(case: Case, normal: float, tangential: float) -> tuple[Field, int]:
        patch, motions = impact(grid, case, Tolerances(normal, tangential))
        kappa = patch.compliance.materials.kappa
        return kappa * motions[-1].velocity, patch.compliance.transforms

    for case in tqdm(cases, desc="tolerances", disable=not sys.stderr.isatty()):
        exact, _ = rebound(case, *FINEST)
        for which, tolerance in product((0, 1), LOOSER):
            given = [FINEST[0], FINEST[1]]
            given[which] = tolerance
            found, transforms = rebound(case, *given)
            yield {
                "grid": grid,
                "case": case.name,
                "tolerance": ("normal", "tangential")[which],
                "value": f"{tolerance:.0e}",
                "change of psi_2": f"{np.abs(found - exact).max():.1e}",
                "transforms": transforms,
            }


def write(path: Path, note: str, rows: list[dict[str, object]]) -> None:
    """Write a table under a line that says what it is."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# {note}; made by docs/make_tangential_solvers.py\n")
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def draw(all_runs: list[Run], moved: list[dict[str, object]]) -> None:
    """Draw the figure: who has solved what within a cost, cost against grid, and tolerances."""
    import matplotlib.pyplot as plt

    figure, ((warm, wild), (growth, change)) = plt.subplots(
        2, 2, figsize=(11, 8), layout="constrained"
    )
    finest = max(r.grid for r in all_runs)
    for place, name in enumerate(SOLVERS):
        style = {"color": f"C{place}", "lw": 2.5 if place == 0 else 1.3, "label": name}
        for axes, start in ((warm, "warm"), (wild, "wild")):
            kept = [r for r in all_runs if (r.start, r.solver) == (start, name)]
            costs = np.sort([r.cost if r.solved else np.inf for r in kept if r.grid == finest])
            if costs.size:
                axes.step(costs, (1.0 + np.arange(costs.size)) / costs.size, where="post", **style)
        costs = {
            grid: np.percentile([r.cost for r in all_runs if _is(r, grid, name)], 90)
            for grid in GRIDS
            if any(_is(r, grid, name) for r in all_runs)
        }
        growth.plot(list(costs), list(costs.values()), "o-", ms=4, **style)
    for axes, start in ((warm, "the step before"), (wild, "wild tractions")):
        axes.set(xscale="log", xlim=(10, BUDGET), xlabel="transforms", ylabel="part solved")
        axes.set_title(f"{finest} elements across, started from {start}")
    growth.set(xscale="log", yscale="log", xlabel="elements across", ylabel="transforms")
    growth.set_title("nine in ten problems cost less, started from the step before")
    growth.set_xticks(list(GRIDS), [str(g) for g in GRIDS])
    growth.minorticks_off()
    for which, mark in (("normal", "s:"), ("tangential", "o-")):
        rows = [m for m in moved if m["tolerance"] == which]
        for case in dict.fromkeys(m["case"] for m in rows):
            mine = [m for m in rows if m["case"] == case]
            values, changes = ([float(m[k]) for m in mine] for k in ("value", "change of psi_2"))
            colour = "C0" if which == "tangential" else "C1"
            change.loglog(values, changes, mark, ms=4, lw=1, color=colour, label=which)
            which = f"_{which}"
    change.set(
        xlabel="tolerance", ylabel="change of psi_2", title="what tolerances do to an impact"
    )
    change.legend()
    figure.legend(*growth.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    figure.savefig(FIGURE, dpi=110)


def _is(run: Run, grid: int, solver: str) -> bool:
    return (run.grid, run.start, run.solver) == (grid, "warm", solver)


def main() -> None:
    """Measure everything, and write the tables and the figure; or have a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="a few problems, nothing is stored")
    smoke = parser.parse_args().smoke
    all_runs = list(runs({16: 4}, CASES[:1]) if smoke else runs(GRIDS, CASES))
    rows = list(summary(all_runs))
    for row in rows:
        print(", ".join(str(value) for value in row.values()))
    if any(row["failures"] for row in rows if row["solver"] == next(iter(SOLVERS))):
        raise SystemExit("Carom's solver failed")
    if not smoke:
        moved = list(tolerances(32, CASES))
        write(TABLE, f"residual {TOLERANCE:g} within {BUDGET} transforms", rows)
        write(TOLERANCES, "psi_2 against the finest tolerances", moved)
        draw(all_runs, moved)


if __name__ == "__main__":
    main()
