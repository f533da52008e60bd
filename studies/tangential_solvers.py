"""Which solver of the tangential problem is the cheapest that never fails?

python studies/tangential_solvers.py            all, a quarter of an hour on one core
python studies/tangential_solvers.py --smoke    a few problems, seconds, nothing is stored

Tables: tangential_solvers.csv, tangential_tolerances.csv. Problems are steps of impacts as they
occur, those first where most elements change between stick and slip, and some made up to break
solvers. Every solver has the same problems, starts, accuracy and budget. Cost is counted in real
two-dimensional transforms of padded fields: a product with T is four, the circulant
preconditioner, without padding, is one.
"""

import argparse
import csv
import time
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import rival_solvers as rivals
from rich.progress import track
from rival_solvers import Iterates, Problem, Solver
from tangential_problems import CASES, STARTS, Case, Task, impact, made_up, recorded, start_of

from carom.halfspace.compliance import Compliance
from carom.halfspace.influence import Field
from carom.halfspace.projected import Operator, minimise
from carom.halfspace.quasistatic import Tolerances
from carom.halfspace.traction import Discs

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TABLE = Path(__file__).with_name("tangential_solvers.csv")
FIGURE = TABLE.parents[1] / "docs" / "figures" / "tangential_solvers.png"
TOLERANCES = TABLE.with_name("tangential_tolerances.csv")
TOLERANCE, BUDGET = 1e-7, 4000
GRIDS = {16: 8, 32: 8, 64: 6}  # elements across: problems of each impact
FINEST, LOOSER = (1e-8, 1e-8), (1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
COSTS = (50, 100, 200, 500, 1000, 2000)  # marked in the figure
DENSE = 16  # elements across up to which the matrix is stored


class Run(NamedTuple):
    """How a solver did on a problem."""

    grid: int
    case: str
    problem: str
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


def cost_of(compliance: Compliance) -> int:
    """Return the number of transforms of padded fields, others counted by their size."""
    return compliance.padded.count + compliance.rough.count // 4


def newton(problem: Problem, start: Field, circulant: bool) -> Iterates:
    """Carom's solver, and itself without its preconditioner."""
    inverse = problem.inverse if circulant else problem.scaled
    compliance = problem.compliance
    operator = Operator(compliance.tangential, inverse, compliance.tangential_diagonal)
    yield minimise(
        operator, problem.given, Discs(problem.bound, float(problem.bound.max())), start, TOLERANCE
    )


SOLVERS: dict[str, Solver] = {
    "Newton on faces, circulant (Carom)": partial(newton, circulant=True),
    "Newton on faces, diagonal": partial(newton, circulant=False),
    "CG along discs, circulant": partial(rivals.face_gradients, circulant=True),
    "CG along discs, diagonal (TangCG)": partial(rivals.face_gradients, circulant=False),
    "proportioned CG (MPGP)": rivals.proportioned,
    "spectral gradient (SPG)": rivals.spectral_gradient,
    "fast gradient (FISTA)": rivals.fast_gradient,
    "splitting (ADMM), circulant": rivals.splitting,
    "block Gauss-Seidel, dense": rivals.gauss_seidel,
}
STYLES = {
    name: {"color": f"C{place}", "lw": 1.3 if place else 2.8, "zorder": 2 if place else 3}
    for place, name in enumerate(SOLVERS)
}


def measure(problem: Problem, start: Field, solver: Solver) -> tuple[int, float, float, float]:
    """Return transforms, seconds, residual and energy when a solver has done or lost."""
    compliance, residual, energy = problem.compliance, np.inf, np.inf
    compliance.transforms = compliance.rough_transforms = 0
    began = time.perf_counter()
    try:
        for iterate in solver(problem, start):
            if iterate is not None:
                traction, moved = iterate
                pull = problem.slip(moved) / compliance.tangential_diagonal
                left = np.abs(problem.project(traction + pull) - traction).max()
                residual = float(left / problem.bound.max())
                energy = float(np.sum(traction * (0.5 * moved - problem.given)))
            if residual <= TOLERANCE or cost_of(compliance) > BUDGET:
                break
    except RuntimeError:
        residual = np.inf
    return cost_of(compliance), time.perf_counter() - began, residual, energy


def tasks(grid: int, wanted: int, cases: Iterable[Case]) -> Iterator[Task]:
    """Yield all problems on a grid."""
    for case in cases:
        yield from recorded(grid, case, wanted)
    yield from made_up(grid, wanted // 2)


def runs(grids: dict[int, int], cases: Sequence[Case]) -> Iterator[Run]:
    """Yield what each solver does on each problem from each start."""
    for grid, wanted in grids.items():
        chosen = [s for s in SOLVERS if grid <= DENSE or "dense" not in s]
        total = len(cases) * wanted + 3 * (wanted // 2)
        for task in track(tasks(grid, wanted, cases), f"{grid} across", total):
            for kind in STARTS:
                start = start_of(kind, task)
                for name in chosen:
                    done = measure(task.problem, start, SOLVERS[name])
                    yield Run(grid, task.case, task.name, kind, name, *done)


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
        return kappa * motions[-1].velocity, cost_of(patch.compliance)

    for case in track(cases, "tolerances"):
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
        file.write(f"# {note}; made by studies/tangential_solvers.py\n")
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def draw(all_runs: list[Run], moved: list[dict[str, object]]) -> None:
    """Draw the figure: what is solved within a cost, cost against grid, and tolerances."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 2, figsize=(11, 8.5), layout="constrained")
    real = [r for r in all_runs if "made up" not in r.case and r.start == "warm"]
    finest = [r for r in real if r.grid == max(GRIDS)]
    draw_solved(axes[0, 0], finest, f"steps of impacts, {max(GRIDS)} elements across")
    odd = [r for r in all_runs if "made up" in r.case or r.start == "wild"]
    odd = [r for r in odd if r.grid > DENSE]
    draw_solved(axes[0, 1], odd, "made-up problems and wild starts")
    for name, style in STYLES.items():
        groups = {g: [r.cost for r in real if (r.grid, r.solver) == (g, name)] for g in GRIDS}
        costs = {grid: np.percentile(group, 90) for grid, group in groups.items() if group}
        axes[1, 0].loglog(list(costs), list(costs.values()), "o-", ms=4, label=name, **style)
    axes[1, 0].set(xlabel="elements across", ylabel="transforms")
    axes[1, 0].set_title("steps of impacts: nine in ten cost less")
    axes[1, 0].set_xticks(list(GRIDS), [str(grid) for grid in GRIDS])
    axes[1, 0].set_yticks(COSTS, [str(cost) for cost in COSTS])
    axes[1, 0].minorticks_off()
    draw_tolerances(axes[1, 1], moved)
    figure.legend(*axes[1, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    figure.savefig(FIGURE, dpi=110)


def draw_solved(axes: "Axes", some_runs: list[Run], title: str) -> None:
    """Draw which part of the problems is solved within a number of transforms."""
    for name, style in STYLES.items():
        own = [r for r in some_runs if r.solver == name]
        costs = sorted(r.cost for r in own if r.solved)
        parts = [(1.0 + place) / len(own) for place in range(len(costs))]
        if own:
            known = [0.0, *parts, len(costs) / len(own)]
            axes.step([1, *costs, BUDGET], known, where="post", **style)
    axes.set(xscale="log", xlim=(10, BUDGET), ylim=(0.0, 1.03), xlabel="transforms")
    axes.set_ylabel("part solved")
    axes.set_title(title)


def draw_tolerances(axes: "Axes", moved: list[dict[str, object]]) -> None:
    """Draw how far psi_2 moves when one of the tolerances is loosened."""
    marks = {"tangential": ("C0", "o-"), "normal": ("C1", "s:")}
    for (which, (colour, mark)), case in product(marks.items(), {m["case"]: 0 for m in moved}):
        rows = [m for m in moved if (m["tolerance"], m["case"]) == (which, case)]
        x, y = ([float(m[key]) for m in rows] for key in ("value", "change of psi_2"))
        label = which if case == moved[0]["case"] else None
        axes.loglog(x, y, mark, color=colour, ms=4, lw=1, label=label)
    axes.set(xlabel="tolerance", ylabel=r"change of $\psi_2$", title="tolerances of whole impacts")
    axes.legend()


def main() -> None:
    """Measure everything, and write the tables and the figure; or have a quick look."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="a few problems, nothing is stored")
    smoke = parser.parse_args().smoke
    all_runs = list(runs({8: 4}, CASES[:1]) if smoke else runs(GRIDS, CASES))
    rows = list(summary(all_runs))
    for row in rows:
        print(", ".join(str(value) for value in row.values()))
    if any(row["failures"] for row in rows if row["solver"] == next(iter(SOLVERS))):
        raise SystemExit("Carom's solver failed")
    if not smoke:
        moved = list(tolerances(32, (CASES[0], CASES[1], CASES[-1])))
        write(TABLE, f"residual {TOLERANCE:g} within {BUDGET} transforms", rows)
        write(TOLERANCES, "psi_2 against the finest tolerances", moved)
        draw(all_runs, moved)


if __name__ == "__main__":
    main()
