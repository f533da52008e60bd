"""How exact is Carom? The numbers of docs/accuracy.md, and its figure.

python studies/accuracy.py    a minute
"""

import csv
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from small_pictures import store_small

import carom
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
from carom.plots import style

ROOT = Path(__file__).parents[1]
FIGURE = ROOT / "docs" / "figures" / "accuracy.png"
IMPACTS = ROOT / "tests" / "high_precision" / "impacts.csv"
EPS = float(np.finfo(np.float64).eps)
SEED = 20261121
CHIS = (0.5, 1.44, 3.0, 10.0)
ANNULI, FINEST = (16, 32, 64, 125, 250, 500, 1000, 2000), 4000
TITLES = "rebound", "energy balance", "ReboundLaw, a table", "annuli and steps, the method of 1976"
Array = Any


def shown(error: Array) -> Array:
    """Return errors with those that are zero at half of the last place, where a log can show."""
    return np.maximum(np.abs(error), 0.5 * EPS)


def impacts() -> tuple[Array, Array, Array]:
    """Return psi_1, chi and psi_2 of the table of 30 digits."""
    rows = list(csv.DictReader(IMPACTS.read_text(encoding="utf-8").splitlines()))
    psi, chi, out = (np.array([float(r[k]) for r in rows]) for k in ("psi_1", "chi", "psi_out"))
    return psi, chi, out


def by_annuli(psi: float, chi: float, annuli: int) -> float:
    """Return psi_2 by the method of 1976, with four steps for each annulus."""
    return float(marched(psi, Inertia(chi), ELASTIC, annuli)[PSI_OUT])


def draw_table(axis: Axes) -> str:
    """Draw the errors of psi_2 in the table of 30 digits, and what is promised."""
    psi, chi, out = impacts()
    error = (carom.rebound(psi, chi) - out) / np.maximum(1.0, np.abs(psi))
    axis.loglog(chi, shown(error), "o", color=style.BLUE, mfc="none", label="47 impacts, 30 digits")
    promise = np.array([[0.05, 10.0, 10.0, 60.0], [1e-10, 1e-10, 1e-9, 1e-9]])
    axis.loglog(*promise, color="0.4", ls=style.DASHES[1], label="promised")
    axis.set(xlabel=r"$\chi$", ylim=(5e-17, 1e-7))
    axis.set_ylabel(r"error of $\psi_2$ over max(1, $|\psi_1|$)")
    return f"psi_2 against 30 digits: {np.max(np.abs(error)):.1e}"


def draw_energy(axis: Axes) -> str:
    """Draw how far energies at 200 times of random impacts are from adding up."""
    rng = np.random.default_rng(SEED)
    psi, chi = rng.uniform(0.01, 8.0, 300), rng.uniform(0.3, 4.0, 300)
    off = []
    for one, ratio in zip(psi, chi, strict=True):
        now = carom.solve(one, ratio).history(200)
        total = 0.5 * now.psi**2 + now.stored + now.dissipated
        off.append(np.max(np.abs(total / (0.5 * one**2) - 1.0)))
    axis.semilogy(psi, shown(off), "o", color=style.PURPLE, mfc="none", ms=2.5)
    axis.set(xlabel=r"$\psi_1$", ylim=(5e-17, 1e-7), xlim=(0.0, 8.0))
    axis.set_ylabel("relative error of the energy")
    return f"energy ledger of 300 impacts: {max(off):.1e}"


def draw_laws(axis: Axes) -> str:
    """Draw how far the tables are from the solver."""
    psi = np.linspace(0.0, 14.0, 20_001)
    worst = []
    for chi, color in zip(CHIS, style.LINES, strict=False):
        error = carom.laws.ReboundLaw(chi)(psi) - carom.rebound(psi, chi)
        crest = shown(error)[:-1].reshape(100, -1).max(axis=1)
        axis.semilogy(psi[100:-1:200], crest, color=color, label=rf"$\chi$ = {chi:g}")
        worst.append(np.max(np.abs(error)))
    axis.axhline(1e-9, color="0.4", ls=style.DASHES[1], label="promised")
    axis.set(xlabel=r"$\psi_1$", ylim=(5e-17, 1e-7), xlim=(0.0, 14.0))
    axis.set_ylabel(r"difference from rebound in $\psi_2$")
    return f"ReboundLaw at chi = {CHIS}: {max(worst):.1e}"


def draw_twin(axis: Axes) -> str:
    """Draw how far annuli and small steps are from the solver, and their limit."""
    rng = np.random.default_rng(SEED)
    psi, chi = rng.uniform(0.0, 6.0, 60), rng.uniform(1.1, 1.8, 60)
    exact, cases = carom.rebound(psi, chi), list(zip(psi, chi, strict=True))
    found = {n: np.array([by_annuli(*case, n) for case in cases]) for n in (*ANNULI, FINEST)}
    limit = found[FINEST] + (found[FINEST] - found[ANNULI[-1]]) / 3.0
    kinds = (("largest", "^", style.VERMILION, np.max), ("median", "o", style.BLUE, np.median))
    for name, mark, color, of in kinds:
        errors = [of(np.abs(found[n] - exact)) for n in ANNULI]
        label = f"{name} of 60 impacts"
        axis.loglog(ANNULI, errors, f"{mark}-", color=color, mfc="none", label=label)
        least = of(np.abs(limit - exact))
        axis.axhline(least, color=color, ls=style.DASHES[2])
        axis.annotate(
            f"{name}, extrapolated", (ANNULI[0], 1.3 * least), color=color, fontsize="small"
        )
    axis.set_xticks([16, 64, 250, 1000], ["16", "64", "250", "1000"])
    axis.minorticks_off()
    axis.set(xlabel="annuli, four time steps for each", ylim=(1e-10, 0.1))
    axis.set_ylabel(r"difference in $\psi_2$")
    return f"annuli, extrapolated: {np.max(np.abs(limit - exact)):.1e}"


def main() -> None:
    """Compute, print and draw."""
    with style.style():
        figure, axes = style.new_figure(2, 2, width=style.DOUBLE, height=120)
        for place, draw in enumerate((draw_table, draw_energy, draw_laws, draw_twin)):
            axis = axes.flat[place]
            print(draw(axis))
            axis.set_title(f"({'abcd'[place]}) {TITLES[place]}", loc="left")
            if axis.get_legend_handles_labels()[1]:
                axis.legend(loc="upper right", ncols=3 if place == 2 else 2)
        store_small(figure, FIGURE)


if __name__ == "__main__":
    main()
