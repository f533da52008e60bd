"""Does the bound on what the theory leaves out hold? The tables and figure of its page.

python studies/halfspace_tables.py

Prints the tables of docs/halfspace_study.md and draws docs/figures/halfspace_study.png from
halfspace_study.csv. A difference from the theory is that from nu = 0 on the same grid, where the
theory is exact: most of the error of the grid is common to both. It is extrapolated from the two
finest grids.
"""

from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from halfspace_study import PAIRS, RATIOS, TABLE, Impact, Row, load
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import carom
from carom.impacts.validity import rebound_error

TARGET = TABLE.parents[1] / "docs" / "figures" / "halfspace_study.png"
ORDER = 1.5  # of the error of the grid: the newest elements at the edge take no traction
COARSE = 5e-4  # what a coarse grid alone tells of coupling
SERIES = {
    "like": "like materials",
    "shell": "like materials, thin shells",
    "pair": "unlike pairs",
    "sweep": "beta and friction varied",
}
COLORS = ("#0072B2", "#009E73", "#D55E00", "#CC79A7", "#56B4E9")
MARKERS = "os^Dv"

Case = tuple[str, str, float]  # label, case, psi_1


class Known(NamedTuple):
    """A number and how far it may be off; not a number where one grid alone is known."""

    value: float
    error: float


def bound(impact: Impact) -> float:
    """Return how far the theory's psi_2 may be off."""
    return rebound_error(impact.kappa, impact.beta, impact.friction, impact.chi, impact.psi_1)


@cache
def grids() -> dict[Case, dict[int, tuple[Impact, Row]]]:
    """Return the table by impact, then by elements across."""
    found: dict[Case, dict[int, tuple[Impact, Row]]] = defaultdict(dict)
    for impact, row in load(TABLE).items():
        found[impact.label, impact.case, impact.psi_1][impact.elements] = impact, row
    return dict(found)


def finest(case: Case) -> tuple[Impact, Row]:
    """Return an impact on the finest grid there is."""
    return grids()[case][max(grids()[case])]


def cases(label: str, name: str | None = None) -> list[Case]:
    """Return the impacts of a series in the order of incidence."""
    return sorted(case for case in grids() if case[0] == label and name in (None, case[1]))


def extrapolated(values: dict[int, float]) -> Known:
    """Return a value for infinitely many elements.

    Its error is the step from the finest grid, or the change of the limit with that grid if larger.
    """
    n = sorted(values)
    steps = [(values[b] - values[a]) / ((b / a) ** ORDER - 1.0) for a, b in pairwise(n)]
    limits = [values[b] + step for b, step in zip(n[1:], steps, strict=True)]
    if not limits:
        return Known(values[n[-1]], float("nan"))
    return Known(limits[-1], max(abs(steps[-1]), *(abs(limits[-1] - one) for one in limits[-2:])))


def exactness(case: Case) -> Known:
    """Return psi_2 of the full solution at nu = 0 less the theory's."""
    (impact, _), there = finest(case), grids()[case]
    exact = float(carom.rebound(impact.psi_1, impact.chi))
    return extrapolated({n: row.psi_2 - exact for n, (_, row) in there.items()})


def difference(case: Case) -> Known:
    """Return psi_2 of the full solution less the theory's."""
    label, name, psi = case
    if label == "control" or case[:2] == ("like", "nu 0"):
        return exactness(case)
    same = ("sweep", NO_COUPLING, psi) if label == "sweep" else ("control", name, psi)
    there, control = grids()[case], grids().get(same, {})
    both = {n: there[n][1].psi_2 - control[n][1].psi_2 for n in there if n in control}
    if not both:
        return Known(float("nan"), float("nan"))
    known = extrapolated(both)
    return known._replace(value=known.value + uncoupled(psi)) if label == "sweep" else known


NO_COUPLING = "beta 0 friction 1"


@cache
def uncoupled(psi: float) -> float:
    """Return the difference at nu = 0.3 without coupling, between incidences that are known."""
    known = cases("like", "nu 0.3")
    return float(np.interp(psi, [case[2] for case in known], [difference(c).value for c in known]))


def shown(known: Known, unit: float = 1e-3) -> str:
    """Return a difference with its error in this unit."""
    value, error = known.value / unit, known.error / unit
    digits = 2 if abs(value) < 9.995 else 1
    text = f"{value:+.{digits}f}"
    return text if np.isnan(error) else f"{text} ± {error:.{digits}f}"


def table(label: str, names: list[str]) -> Iterator[str]:
    """Yield the differences of some series in 1e-3; incidences differ with chi."""
    yield "| " + " | ".join(f"{name}: psi_1 | 1000 x difference" for name in names) + " |"
    yield "|" + "---|" * 2 * len(names)
    for row in zip(*(cases(label, name) for name in names), strict=True):
        parts = [part for case in row for part in (f"{case[2]:.2f}", shown(difference(case)))]
        yield "| " + " | ".join(parts) + " |"


def normal_table() -> Iterator[str]:
    """Yield what coupling does to the normal motion."""
    yield "| pair | kappa | beta | friction | restitution | duration/Hertz | mean angle of slip |"
    yield "|---|---|---|---|---|---|---|"
    for name in PAIRS:
        rows = [finest(case) for case in cases("pair", name)]
        one = rows[0][0]
        low = min(row.restitution for _, row in rows)
        times, angles = [r.duration for _, r in rows], [r.angle for _, r in rows]
        yield (
            f"| {name} | {one.kappa:.3f} | {one.beta:+.4f} | {one.friction:g} | {low:.4f} to 1 | "
            f"{min(times):.4f} to {max(times):.4f} | {max(angles):.0f}° to {min(angles):.1f}° |"
        )


def slip_table() -> Iterator[str]:
    """Yield the angles of microslip by both solutions, and how much of the slip is across."""
    yield "| nu | psi_1 | mean (theory) | largest (theory) | across/along | work across |"
    yield "|---|---|---|---|---|---|"
    for nu in RATIOS[1:]:
        for case in cases("like", f"nu {nu:g}")[1:10:2]:
            impact, row = finest(case)
            phases = carom.solve(impact.psi_1, impact.chi).slip_angles(nu / (2.0 - nu))
            ring = np.degrees(next(angle for angle in phases if angle.largest > 0.0))
            yield (
                f"| {nu:g} | {case[2]:.2f} | {row.micro_angle:.1f}° ({ring[1]:.1f}°) | "
                f"{row.micro_angle_max:.1f}° ({ring[0]:.1f}°) | {100 * row.slip_across:.1f} % | "
                f"{100 * row.work_across:.2f} % |"
            )


def regime(impact: Impact) -> str:
    """Return how an impact starts and ends."""
    psi, chi = impact.psi_1, impact.chi
    limits = ((1.0, "up to 1"), (2.0 * chi, "up to 2 chi"), (4.0 * chi - 1.001, "to 4 chi - 1"))
    return next((name for limit, name in limits if psi <= limit), "from 4 chi - 1")


class Judged(NamedTuple):
    """A difference and its bound."""

    case: Case
    regime: str
    size: float  # with its error
    bound: float


@cache
def judged(label: str) -> tuple[Judged, ...]:
    """Return the differences of a series that are known well enough."""
    found = []
    for case in cases(label):
        impact, (value, error) = finest(case)[0], difference(case)
        unsure = np.isnan(error) and impact.beta != 0.0 and abs(value) < COARSE
        if impact.kappa < 1.0 and np.isfinite(value) and not unsure:
            size = abs(value) + float(np.nan_to_num(error))
            found.append(Judged(case, regime(impact), size, bound(impact)))
    return tuple(found)


def bound_table() -> Iterator[str]:
    """Yield the largest shares of the bound by series and regime."""
    yield "| series | psi_1 | impacts | largest share of the bound | in |"
    yield "|---|---|---|---|---|"
    for label, series in SERIES.items():
        for where in dict.fromkeys(one.regime for one in judged(label)):
            there = [one for one in judged(label) if one.regime == where]
            worst = max(there, key=lambda one: one.size / one.bound)
            name = f"{worst.case[1]}, psi_1 = {worst.case[2]:.2f}"
            share = worst.size / worst.bound
            yield f"| {series} | {where} | {len(there)} | {share:.2f} | {name} |"


def draw_series(axis: Axes, label: str, names: list[str]) -> None:
    """Draw differences against incidence, with their errors."""
    axis.axhline(0.0, color="0.6", linewidth=0.6)
    for name, shade, marker in zip(names, COLORS, MARKERS, strict=False):
        color = "0.65" if name == "nu 0" else shade
        known = [(case[2], *difference(case)) for case in cases(label, name)]
        psi, value, error = np.array(known).T
        text = name.replace("nu", r"$\nu$ =") if label == "like" else name
        axis.errorbar(
            psi, value, np.nan_to_num(error), None, marker + "-", color=color, ms=4, lw=1.0,
            mfc="white", capsize=2, label=text,
        )  # fmt: skip
    axis.set_xlabel(r"$\psi_1$ before the impact (dimensionless)")
    axis.set_ylabel(r"$\psi_2$, three-dimensional $-$ theory")
    axis.legend(frameon=False, fontsize=9)


def draw_bound(axis: Axes) -> None:
    """Draw differences against the bound."""
    for (label, series), color, marker in zip(SERIES.items(), COLORS, MARKERS, strict=False):
        bounds, sizes = [one.bound for one in judged(label)], [one.size for one in judged(label)]
        axis.loglog(bounds, sizes, marker, color=color, ms=4, mfc="none", label=series)
    line = np.array([1e-5, 2.0])
    axis.loglog(line, line, color="0.3", linewidth=1.0)
    axis.set_xlim(1e-5, 2.0)
    axis.set_ylim(1e-6, 2.0)
    axis.set_xlabel(r"bound on the error of the theory's $\psi_2$")
    axis.set_ylabel(r"|three-dimensional $-$ theory|, with its error")
    axis.legend(frameon=False, fontsize=9)


def main() -> None:
    """Print and draw."""
    like = [f"nu {nu:g}" for nu in RATIOS]
    for title, lines in (
        ("Like materials", table("like", like)),
        ("nu = 0 less the theory, at the chi of the others", table("control", like[1:])),
        ("Unlike pairs", table("pair", list(PAIRS))),
        ("Normal motion", normal_table()),
        ("Slip", slip_table()),
        ("Bound", bound_table()),
    ):
        print(f"\n{title}\n", *lines, sep="\n")
    figure = Figure(figsize=(13.0, 4.4), layout="constrained")
    axes = figure.subplots(1, 3)
    draw_series(axes[0], "like", like)
    draw_series(axes[1], "pair", list(PAIRS))
    draw_bound(axes[2])
    for axis, letter in zip(axes, "abc", strict=True):
        axis.set_title(f"({letter})", loc="left")
    figure.savefig(TARGET, dpi=150)
    print(f"\nwrote {TARGET.name}")


if __name__ == "__main__":
    main()
