"""Does the bound on what the theory leaves out hold? The tables and figures of its page.

python studies/halfspace_tables.py

Prints the tables of docs/halfspace_study.md and draws docs/figures/halfspace_study.png and
halfspace_errors.png from halfspace_study.csv.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from halfspace_differences import (
    REGIMES,
    Estimated,
    Known,
    cases,
    difference,
    estimates,
    finest,
    judged,
)
from halfspace_plan import JUDGED, PAIRS, RATIOS, Impact
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import carom

FIGURES = Path(__file__).parents[1] / "docs" / "figures"
SERIES = {
    "solid": "solid spheres, like materials",
    "like": "like materials",
    "pair": "real unlike pairs",
    "unlike": "unlike materials",
    "spin": "like materials, spin",
    "spin unlike": "unlike materials, spin",
    "spin again": "like materials, spin, again",
    "spin again unlike": "unlike materials, spin, again",
}
APART = {"apart like": "like materials", "apart unlike": "unlike materials"}
APART_SPIN = {"apart spin": "like materials, spin", "apart spin unlike": "unlike materials, spin"}
COLORS = ("#0072B2", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#E69F00", "#56B4E9", "#E69F00")
MARKERS = "os^DvPvP"


def shown(known: Known, unit: float = 1e-3) -> str:
    """Return a difference with its error in this unit."""
    value, error = known.value / unit, known.error / unit
    digits = 2 if abs(value) < 9.995 else 1
    text = f"{value:+.{digits}f}"
    return text if np.isnan(error) else f"{text} ± {error:.{digits}f}"


def table(label: str, names: list[str]) -> Iterator[str]:
    """Yield the differences of some series in 1e-3; incidences differ with chi."""
    heads = (rf"{formula(name)}: $\psi_1$ | $10^3 \, \Delta\psi_2$" for name in names)
    yield f"| {' | '.join(heads)} |"
    yield "|" + "---|" * 2 * len(names)
    for row in zip(*(cases(label, name) for name in names), strict=True):
        parts = [part for case in row for part in (f"{case[2]:.2f}", shown(difference(case)))]
        yield "| " + " | ".join(parts) + " |"


def formula(name: str) -> str:
    """Return the name of a series of impacts, with nu as a formula."""
    return f"$\\nu = {name[3:]}$" if name.startswith("nu ") else name


def normal_table() -> Iterator[str]:
    """Yield what coupling does to the normal motion."""
    yield r"| pair | $\kappa$ | $\beta$ | $\mu$ | $e$ | duration/Hertz | mean angle of slip |"
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
    yield r"| $\nu$ | $\psi_1$ | mean (theory) | largest (theory) | across/along | work across |"
    yield "|---|---|---|---|---|---|"
    for nu in RATIOS[1:]:
        for case in cases("solid", f"nu {nu:g}")[1:10:2]:
            impact, row = finest(case)
            phases = carom.solve(impact.psi_1, impact.chi).slip_angles(nu / (2.0 - nu))
            ring = np.degrees(next(angle for angle in phases if angle.largest > 0.0))
            yield (
                f"| {nu:g} | {case[2]:.2f} | {row.micro_angle:.1f}° ({ring[1]:.1f}°) | "
                f"{row.micro_angle_max:.1f}° ({ring[0]:.1f}°) | {100 * row.slip_across:.1f} % | "
                f"{100 * row.work_across:.2f} % |"
            )


def told(impact: Impact) -> str:
    """Return an impact in a few numbers."""
    nu = 2.0 * (1.0 - impact.kappa) / (2.0 - impact.kappa)
    numbers = {r"\nu": f"{nu:.2f}"}
    if impact.beta:
        numbers = {r"\beta": f"{impact.beta:.2g}", r"\mu": f"{impact.friction:.2g}"}
    numbers |= {r"\chi": f"{impact.chi:.2f}", r"\psi_1": f"{impact.psi_1:.2f}"}
    if impact.spin:
        numbers[r"\tau_1"] = f"{impact.spin:.2g}"
    return ", ".join(f"${symbol} = {number}$" for symbol, number in numbers.items())


def bound_table(series: dict[str, str]) -> Iterator[str]:
    """Yield the shares of the bound by series and regime."""
    yield r"| series | $\psi_1$ | impacts | median share | largest share | largest for |"
    yield "|---|---|---|---|---|---|"
    for label, words in series.items():
        for where in ("all",) if "spin" in label else REGIMES:
            there = [one for one in judged(label) if where in (one.regime, "all")]
            shares = [one.size / one.bound for one in there]
            worst = there[int(np.argmax(shares))]
            half, most = np.median(shares), max(shares)
            place = told(finest(worst.case)[0])
            yield f"| {words} | {where} | {len(there)} | {half:.2f} | {most:.2f} | {place} |"


def error_table() -> Iterator[str]:
    """Yield how often the estimate of the error of a grid holds, and how large both are."""
    heads = "materials", "elements", "impacts", "median error", "95 % of errors below"
    heads += "estimate holds in", "median of estimate/error"
    yield f"| {' | '.join(heads)} |"
    yield "|---|---|---|---|---|---|---|"
    for kind in JUDGED:
        for elements in (32, 64) if kind != "unlike" else (32,):
            yield error_line(kind, elements, estimates(kind, elements))
    yield error_line("all", 32, [one for kind in JUDGED for one in estimates(kind, 32)])


def error_line(kind: str, elements: int, found: list[Estimated]) -> str:
    """Return a line of that table."""
    error, estimate = np.array(found).T
    half, most = np.quantile(error, [0.5, 0.95])
    holds, ratio = 100.0 * np.mean(error <= estimate), np.median(estimate / error)
    counts = f"{elements} | {len(found)}"
    return f"| {formula(kind)} | {counts} | {half:.1e} | {most:.1e} | {holds:.0f} % | {ratio:.0f} |"


def draw_series(axis: Axes, label: str, names: list[str]) -> None:
    """Draw differences against incidence, with their errors."""
    axis.axhline(0.0, color="0.6", linewidth=0.6)
    for name, color, marker in zip(names, COLORS, MARKERS, strict=False):
        known = [(case[2], *difference(case)) for case in cases(label, name)]
        psi, value, error = np.array(known).T
        text = name.replace("nu", r"$\nu$ =") if label == "solid" else name
        axis.errorbar(
            psi, value, np.nan_to_num(error), None, marker + "-", color=color, ms=4, lw=1.0,
            mfc="white", capsize=2, label=text,
        )  # fmt: skip
    axis.set_xlabel(r"$\psi_1$ before the impact")
    axis.set_ylabel(r"$\psi_2$, three-dimensional $-$ theory")
    axis.legend(frameon=False, fontsize=9)


def draw_bound(axis: Axes, series: dict[str, str]) -> None:
    """Draw differences against the bound."""
    for (label, words), color, marker in zip(series.items(), COLORS, MARKERS, strict=False):
        bounds, sizes = [one.bound for one in judged(label)], [one.size for one in judged(label)]
        name = words if "again" not in words else None
        axis.loglog(bounds, sizes, marker, color=color, ms=3.5, mfc="none", label=name)
    line = np.array([1e-6, 10.0])
    axis.loglog(line, line, color="0.3", linewidth=1.0)
    axis.set_xlim(1e-6, 10.0)
    axis.set_ylim(1e-7, 10.0)
    axis.set_xlabel(r"bound on the difference of $\psi_2$")
    axis.set_ylabel(r"|difference|, with its error")
    axis.legend(frameon=False, fontsize=9, loc="upper left")


def draw_errors(axis: Axes, elements: int) -> None:
    """Draw the errors of grids against their estimates."""
    for kind, color, marker in zip(JUDGED, COLORS, MARKERS, strict=False):
        found = np.array(estimates(kind, elements))
        if found.size:
            words = {"nu 0": r"$\nu$ = 0"}.get(kind, kind)
            axis.loglog(*found.T[::-1], marker, color=color, ms=4, mfc="none", label=words)
    line = np.array([1e-8, 1.0])
    axis.loglog(line, line, color="0.3", linewidth=1.0)
    axis.set_xlim(1e-7, 0.1)
    axis.set_ylim(1e-9, 0.1)
    axis.set_xlabel(r"what psi_out_error says")
    axis.set_ylabel(r"error of $\psi_2$")
    axis.set_title(f"{elements} elements across", fontsize=10)
    axis.legend(frameon=False, fontsize=9)


def draw(name: str, *drawings: Callable[[Axes], None]) -> None:
    """Draw and store pictures, two in a row."""
    rows = len(drawings) // 2
    figure = Figure(figsize=(10.0, 4.2 * rows), layout="constrained")
    axes = np.ravel(figure.subplots(rows, 2))
    for axis, drawing, letter in zip(axes, drawings, "abcd", strict=False):
        drawing(axis)
        axis.set_title(f"({letter})", loc="left")
    figure.savefig(FIGURES / name, dpi=150)
    print(f"wrote {name}")


def main() -> None:
    """Print and draw."""
    like = [f"nu {nu:g}" for nu in RATIOS[1:]]
    for title, lines in (
        ("Errors of grids", error_table()),
        ("Bound", bound_table(SERIES)),
        ("Kept apart", bound_table(APART | APART_SPIN)),
        ("Like materials", table("solid", like)),
        ("Unlike pairs", table("pair", list(PAIRS))),
        ("Normal motion", normal_table()),
        ("Slip", slip_table()),
    ):
        print(f"\n{title}\n", *lines, sep="\n")
    draw(
        "halfspace_study.png",
        lambda axis: draw_series(axis, "solid", like),
        lambda axis: draw_series(axis, "pair", list(PAIRS)),
        lambda axis: draw_bound(axis, SERIES),
        lambda axis: draw_bound(axis, APART | APART_SPIN),
    )
    draw(
        "halfspace_errors.png",
        lambda axis: draw_errors(axis, 32),
        lambda axis: draw_errors(axis, 64),
    )


if __name__ == "__main__":
    main()
