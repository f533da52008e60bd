"""What does spin about the line of impact do? The figure of docs/normal_spin.md.

python studies/normal_spin.py          some minutes; draws docs/figures/normal_spin.png
python studies/normal_spin.py --smoke  the same on a very coarse grid, not stored

Steel on steel by boundary elements; spin in friction V_1/a_max.
"""

import argparse
import multiprocessing
import os
from functools import partial
from itertools import product
from math import gamma, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from rich.progress import track

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin
from carom.halfspace.refinement import Resolution
from carom.halfspace.solution import solve

Array = NDArray[np.float64]

TARGET = Path(__file__).parents[1] / "docs" / "figures" / "normal_spin.png"
KAPPA, CHI = 0.8235294117647058, 1.4411764705882353
LIGHTNESS = 0.01  # m_n a_max^2/I: a_max/R = 0.063 of a solid sphere on a half-space
PSIS = np.array([0.1, 0.3, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 4.8, 5.2, 6.0])
SPINS = (0.0, 0.1, 0.25, 0.5, 1.0, 2.0)
TURNS = np.geomspace(0.02, 20.0, 13)
ALONE = 1e-3  # psi_1 of an impact that has next to no tangential motion
COLORS = ("0.15", "#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00")
FINE, COARSE = Resolution(24, 112), Resolution(8, 20)


class Found(NamedTuple):
    """What an impact comes to: psi_2, and the spin that friction takes."""

    psi_out: float
    taken: float


def found(grid: Resolution, impact: tuple[float, float]) -> Found:
    """Return what an incidence with spin comes to."""
    psi, spin = impact
    hit = solve(psi, CHI, Materials(KAPPA), grid, spin=NormalSpin(spin, LIGHTNESS))
    return Found(hit.psi_out, spin - hit.spin_out)


def most_taken() -> float:
    """Return the spin that friction takes if all slips around the normal, over the lightness.

    The moment is (3 pi/16) mu P b: (15/16)(3 pi/16)(4/3) times the integral of d^2 over time, which
    is (4/5) B(6/5, 1/2).
    """
    path = 0.8 * gamma(1.2) * sqrt(pi) / gamma(1.7)
    return 15.0 / 16.0 * 3.0 * pi / 16.0 * 4.0 / 3.0 * path


def draw_rebound(axis: Axes, psi_out: Array) -> None:
    """Draw psi_2 against psi_1 for some spins, and the theory, which has none."""
    line = np.linspace(0.0, PSIS[-1], 400)
    axis.plot(line, carom.rebound(line, CHI), color="0.6", lw=3.0, label="theory, no spin")
    for spin, values, color in zip(SPINS, psi_out.T, COLORS, strict=True):
        label = rf"$\tau_1$ = {spin:g}"
        axis.plot(PSIS, values, "o-", color=color, ms=3.5, lw=1.2, mfc="white", label=label)
    axis.axhline(0.0, color="0.8", lw=0.6, zorder=0)
    axis.set_xlabel(r"$\psi_1$ before the impact")
    axis.set_ylabel(r"$\psi_2$ after the impact")
    axis.legend(frameon=False, fontsize=9)


def draw_taken(axis: Axes, taken: Array) -> None:
    """Draw the spin that friction takes against the spin, and what it takes at most."""
    axis.axhline(most_taken(), color="0.6", lw=3.0, label="all slips around the normal")
    axis.semilogx(TURNS, taken / LIGHTNESS, "o-", color=COLORS[1], ms=4, mfc="white")
    axis.set_ylim(0.0, 1.2)
    axis.set_xlabel(r"spin $\tau_1 = \omega_n a_{max}/(\mu V_1)$")
    axis.set_ylabel(r"$(\tau_1 - \tau_2)\, I/(m_n a_{max}^2)$")
    axis.legend(frameon=False, fontsize=9, loc="lower right")


def main() -> None:
    """Compute, draw and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="very coarse, nothing is stored")
    parser.add_argument("--workers", type=int, default=2, help="processes")
    asked = parser.parse_args()
    os.environ["OMP_NUM_THREADS"] = "1"
    impacts = [*product(PSIS, SPINS), *((ALONE, spin) for spin in TURNS)]
    with multiprocessing.get_context("spawn").Pool(asked.workers) as pool:
        solved = pool.imap(partial(found, COARSE if asked.smoke else FINE), impacts)
        values = list(track(solved, "impacts", len(impacts)))
    psi_out = np.array([one.psi_out for one in values[: -TURNS.size]])
    psi_out = psi_out.reshape(PSIS.size, len(SPINS))
    taken = np.array([one.taken for one in values[-TURNS.size :]])
    for spin, column in zip(SPINS, psi_out.T, strict=True):
        print(f"spin {spin:g}:", np.round(column, 3))
    print(f"taken, at most {most_taken():.4f}:", np.round(taken / LIGHTNESS, 3))
    figure = Figure(figsize=(10.5, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_rebound(left, psi_out)
    draw_taken(right, taken)
    left.set_title("(a)", loc="left")
    right.set_title("(b)", loc="left")
    if not asked.smoke:
        figure.savefig(TARGET, dpi=150)
        print(f"wrote {TARGET.name}")


if __name__ == "__main__":
    main()
