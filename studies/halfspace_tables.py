"""Does the bound on what the theory leaves out hold? The tables and figures of its page.

python studies/halfspace_tables.py

Prints the tables of docs/halfspace_study.md and draws docs/figures/halfspace_study.png and
halfspace_errors.png from halfspace_study.csv.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from halfspace_differences import Estimated, cases, difference, estimates, finest, judged
from halfspace_plan import JUDGED, PAIRS, RATIOS
from matplotlib.axes import Axes
from small_pictures import store_small

import carom
from carom.plots import style

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
APART = {"apart like": "kept apart, like", "apart unlike": "kept apart, unlike"}
APART_SPIN = {
    "apart spin": "kept apart, like, spin",
    "apart spin unlike": "kept apart, unlike, spin",
}
GROUPS = {  # of the figure, by what bodies are: colour and mark
    "like materials": (style.BLUE, "o"),
    "unlike materials": (style.VERMILION, "s"),
    "like materials, spin": (style.GREEN, "^"),
    "unlike materials, spin": (style.PURPLE, "D"),
}
MARKERS = "os^Dv"


def extreme(label: str, name: str, of: Callable[..., float]) -> str:
    """Return the least or the largest difference of a series in 1e-3, with its error and place."""
    value, error, psi = of((*difference(case), case[2]) for case in cases(label, name))
    digits = 2 if abs(value) < 9.995e-3 else 1
    text = f"{1e3 * value:+.{digits}f} ± {1e3 * error:.{digits}f}"
    return f"{text} at {psi:.2f}" if abs(value) > 1e-6 else "0"


def formula(name: str) -> str:
    """Return the name of a series of impacts, with nu as a formula."""
    return f"$\\nu = {name[3:]}$" if name.startswith("nu ") else name


def like_table() -> Iterator[str]:
    """Yield the largest differences of solid spheres of like materials."""
    yield r"| solid spheres | largest $10^3 \, \Delta\psi_2$, at $\psi_1$ |"
    yield "|---|---|"
    for nu in RATIOS[1:]:
        yield f"| {formula(f'nu {nu:g}')} | {extreme('solid', f'nu {nu:g}', max)} |"


def pair_table() -> Iterator[str]:
    """Yield what coupling does: to psi_2 in 1e-3, to the normal motion, to the way of slip."""
    heads = (
        r"| pair | $\kappa$ | $\beta$ | $\mu$ | least $10^3 \, \Delta\psi_2$, at $\psi_1$ | largest"
    )
    yield heads + " | least $e$ | duration/Hertz | mean angle of slip |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for name in PAIRS:
        rows = [finest(case) for case in cases("pair", name)]
        one = rows[0][0]
        low = min(row.restitution for _, row in rows)
        times, angles = [r.duration for _, r in rows], [r.angle for _, r in rows]
        ends = f"{extreme('pair', name, min)} | {extreme('pair', name, max)}"
        slips = f"{max(angles):.0f}° to {min(angles):.1f}°"
        yield (
            f"| {name} | {one.kappa:.3f} | {one.beta:+.4f} | {one.friction:g} | {ends} | "
            f"{low:.4f} | {min(times):.4f} to {max(times):.4f} | {slips} |"
        )


def slip_table() -> Iterator[str]:
    """Yield the angles of microslip by both solutions, and how much of the slip is across."""
    yield r"| $\nu$ | $\psi_1$ | mean (theory) | largest (theory) | across/along | work across |"
    yield "|---|---|---|---|---|---|"
    for nu in RATIOS[1:]:
        for case in cases("solid", f"nu {nu:g}")[1:2]:
            impact, row = finest(case)
            phases = carom.solve(impact.psi_1, impact.chi).slip_angles(nu / (2.0 - nu))
            ring = np.degrees(next(angle for angle in phases if angle.largest > 0.0))
            yield (
                f"| {nu:g} | {case[2]:.2f} | {row.micro_angle:.1f}° ({ring[1]:.1f}°) | "
                f"{row.micro_angle_max:.1f}° ({ring[0]:.1f}°) | {100 * row.slip_across:.1f} % | "
                f"{100 * row.work_across:.2f} % |"
            )


def bound_table(series: dict[str, str]) -> Iterator[str]:
    """Yield the shares of the bound by series."""
    yield "| series | impacts | median share | largest share |"
    yield "|---|---|---|---|"
    for label, words in series.items():
        shares = [one.size / one.bound for one in judged(label)]
        yield f"| {words} | {len(shares)} | {np.median(shares):.2f} | {max(shares):.2f} |"


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


def draw_series(axis: Axes, label: str, names: list[str], unit: float) -> None:
    """Draw differences against incidence, with their errors."""
    style.zero_line(axis)
    lines = zip(names, style.LINES, style.DASHES, MARKERS, strict=False)
    for name, color, dash, marker in lines:
        known = [(case[2], *difference(case)) for case in cases(label, name)]
        psi, value, error = np.array(known).T
        text = name.replace("nu", r"$\nu$ =") if label == "solid" else name
        axis.errorbar(
            psi, value / unit, np.nan_to_num(error) / unit, None, marker, ls=dash, color=color,
            lw=0.9, mfc="white", capsize=1.5, label=text,
        )  # fmt: skip
    axis.set_xlabel(r"$\psi_1$")
    axis.set_ylabel(r"$\psi_2$, full contact $-$ theory" + (r" ($10^{-3}$)" if unit < 1.0 else ""))
    axis.legend()


def draw_bound(axis: Axes, series: dict[str, str]) -> None:
    """Draw differences against the bound; kinds of bodies share a mark."""
    for words, (color, marker) in GROUPS.items():
        there = [one for label in series for one in judged(label) if words == kind(label)]
        sizes = [one.size for one in there]
        axis.loglog(
            [one.bound for one in there], sizes, marker, color=color, ms=2.0, mew=0.5, mfc="none",
            label=f"{words} ({len(there)})",
        )  # fmt: skip
    line = np.array([1e-6, 10.0])
    axis.loglog(line, line, color=style.BLACK, lw=0.8, label="the bound")
    axis.set(xlim=(1e-6, 10.0), ylim=(1e-7, 10.0), xlabel=r"bound on the difference of $\psi_2$")
    axis.set_ylabel("|difference| and its error")
    axis.legend(loc="upper left", markerscale=1.8)


def kind(label: str) -> str:
    """Return which of GROUPS a series belongs to."""
    unlike = "unlike" in label or label == "pair"
    spin = ", spin" if "spin" in label else ""
    return f"{'unlike' if unlike else 'like'} materials{spin}"


def draw_errors(axis: Axes, elements: int) -> None:
    """Draw the errors of grids against their estimates."""
    words = {"nu 0": r"$\nu$ = 0", "like": "like materials", "unlike": "unlike materials"}
    for name, color, marker in zip(JUDGED, style.LINES, MARKERS, strict=False):
        found = np.array(estimates(name, elements))
        axis.loglog(*found.T[::-1], marker, color=color, ms=3, mfc="none", label=words[name])
    line = np.array([1e-8, 1.0])
    axis.loglog(line, line, color=style.BLACK, lw=0.8, label="error = estimate")
    axis.set(xlim=(1e-7, 0.1), ylim=(1e-9, 0.1), xlabel="estimate psi_out_error")
    axis.set_ylabel(r"error of $\psi_2$")
    axis.legend(loc="upper left")


def draw(name: str, drawings: dict[str, Callable[[Axes], None]]) -> None:
    """Draw and store pictures with their titles, two in a row."""
    rows = len(drawings) // 2
    with style.style():
        figure, axes = style.new_figure(rows, 2, width=style.DOUBLE, height=70.0 * rows)
        for axis, letter, (title, drawing) in zip(
            axes.flat, "abcd", drawings.items(), strict=False
        ):
            drawing(axis)
            axis.set_title(f"({letter}) {title}", loc="left")
        store_small(figure, FIGURES / name)
    print(f"wrote {name}")


def main() -> None:
    """Print and draw."""
    like = [f"nu {nu:g}" for nu in RATIOS[1:]]
    for title, lines in (
        ("Errors of grids", error_table()),
        ("Bound", bound_table(SERIES | APART | APART_SPIN)),
        ("Like materials", like_table()),
        ("Unlike pairs", pair_table()),
        ("Slip", slip_table()),
    ):
        print(f"\n{title}\n", *lines, sep="\n")
    pictures = {
        "solid spheres, like materials": lambda axis: draw_series(axis, "solid", like, 1e-3),
        "real pairs of unlike materials": lambda axis: draw_series(axis, "pair", list(PAIRS), 1.0),
        "impacts that the bounds were fitted to": lambda axis: draw_bound(axis, SERIES),
        "impacts kept apart": lambda axis: draw_bound(axis, APART | APART_SPIN),
    }
    draw("halfspace_study.png", pictures)
    grids = {f"{n} elements across": lambda axis, n=n: draw_errors(axis, n) for n in (32, 64)}
    draw("halfspace_errors.png", grids)


if __name__ == "__main__":
    main()
