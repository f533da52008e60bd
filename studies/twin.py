"""Does the method of 1976, annuli and small steps, converge to the exact solution?

python studies/twin.py    prints the numbers of docs/twin.md and draws docs/figures/twin.png
"""

import time
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from carom.dimensionless.rebounds import rebound
from carom.dimensionless.twins.marching import extrapolated, march

Array = NDArray[np.float64]

CHIS = {0.8: "#009E73", 1.44: "#0072B2", 2.5: "#D55E00"}
MARKERS = {0.8: "s", 1.44: "o", 2.5: "^"}
SPRINGS = np.array([16, 32, 64, 125, 250, 500, 1000, 2000])
TARGET = Path(__file__).parents[1] / "docs" / "figures" / "twin.png"


def marched(psi: Array, chi: Array, springs: int) -> Array:
    """Return psi_2 of every impact, with four steps a spring."""
    impacts = zip(psi, chi, strict=True)
    return np.array([march(p, c, springs, 4 * springs) for p, c in impacts])


def random_differences() -> tuple[Array, Array, Array]:
    """Return |marching - exact| of every impact, a row for each of SPRINGS, the extrapolated
    ones, and psi_1 / (4 chi - 1).

    300 impacts of chi in [1.1, 1.8], which solid spheres span, and psi_1 in [0, 6].
    """
    rng = np.random.default_rng(1976)
    psi, chi = rng.uniform(0.0, 6.0, 300), rng.uniform(1.1, 1.8, 300)
    exact = rebound(psi, chi)
    found = np.array([np.abs(marched(psi, chi, n) - exact) for n in SPRINGS])
    limit = [extrapolated(p, c) for p, c in zip(psi, chi, strict=True)]
    return found, np.abs(limit - exact), psi / (4.0 * chi - 1.0)


def widely_extrapolated() -> Array:
    """Return |extrapolated - exact| of 300 impacts, chi in [0.1, 5] and psi_1 in [-6, 6]."""
    rng = np.random.default_rng(38)
    psi, chi = rng.uniform(-6.0, 6.0, 300), rng.uniform(0.1, 5.0, 300)
    found = [extrapolated(p, c) for p, c in zip(psi, chi, strict=True)]
    return np.asarray(np.abs(found - rebound(psi, chi)))


def draw_rebounds(axis: Axes) -> None:
    """Draw psi_2 against psi_1, exact as lines, marching as points."""
    psi = np.linspace(0.0, 10.0, 1001)
    points = np.linspace(0.0, 10.0, 31)
    for chi, color in CHIS.items():
        axis.plot(psi, rebound(psi, chi), color=color, linewidth=1.4)
        out = marched(points, np.full(points.size, chi), 500)
        label = rf"$\chi$ = {chi:g}"
        axis.plot(points, out, MARKERS[chi], color=color, ms=4.5, mfc="white", label=label)
    axis.axhline(0.0, color="0.6", linewidth=0.6)
    axis.plot([], [], "-", color="0.3", linewidth=1.4, label="exact")
    axis.set_xlim(-0.25, 10.25)
    axis.set_xlabel(r"$\psi_1 = \kappa V_x/(\mu V_1)$ before the impact (dimensionless)")
    axis.set_ylabel(r"$\psi_2$ after the impact (dimensionless)")
    axis.legend(frameon=False, title="points: 500 springs", alignment="left")
    axis.set_title("(a)", loc="left")


def draw_differences(axis: Axes, found: Array, limit: Array) -> None:
    """Draw |difference| against the number of springs, and the level of extrapolation."""
    middle, most = np.median(found, axis=1), np.max(found, axis=1)
    axis.loglog(SPRINGS, most, "^-", color="#D55E00", markersize=5, label="greatest of 300 impacts")
    axis.loglog(SPRINGS, middle, "o-", color="#0072B2", markersize=5, label="median")
    guide = 0.3 * middle[0] * (SPRINGS[0] / SPRINGS) ** 2.0
    axis.loglog(SPRINGS, guide, "--", color="0.4", linewidth=1.0, label="slope $-2$")
    for level, style, name in ((np.max(limit), "^", "greatest"), (np.median(limit), "o", "median")):
        color = "#D55E00" if style == "^" else "#0072B2"
        axis.axhline(level, color=color, linewidth=1.0, linestyle=":")
        axis.text(SPRINGS[0], level * 1.25, f"extrapolated, {name}", color=color, fontsize=9)
    axis.set_xlabel("springs (four time steps for each)")
    axis.set_ylabel(r"|marching $-$ exact| in $\psi_2$ (dimensionless)")
    axis.set_xticks([16, 64, 250, 1000], ["16", "64", "250", "1000"])
    axis.minorticks_off()
    axis.legend(frameon=False, title=r"$\chi$ from 1.1 to 1.8", alignment="left")
    axis.set_title("(b)", loc="left")


def quantiles(values: Array) -> str:
    """Return median, 90 % and greatest in words."""
    return "median {:.1e}, 90 % {:.1e}, max {:.1e}".format(*np.quantile(values, [0.5, 0.9, 1.0]))


def print_numbers(found: Array, limit: Array, slipping: Array) -> None:
    """Print errors, observed orders and times."""
    for n in (125, 500):
        row = found[list(SPRINGS).index(n)]
        print(f"{n} springs, {4 * n} steps: {quantiles(row)}")
    print(f"extrapolated: {quantiles(limit)}")
    print(f"extrapolated, chi 0.1 to 5: {quantiles(widely_extrapolated())}")
    fitted = SPRINGS >= 125
    logs = np.log(found[fitted][:, slipping < 1.0])  # gross slip throughout has no error
    orders = -np.polyfit(np.log(SPRINGS[fitted]), logs, 1)[0]
    low, middle, high = np.quantile(orders, [0.05, 0.5, 0.95])
    print(f"observed order: median {middle:.3f}, 5 % {low:.3f}, 95 % {high:.3f}")
    for name, function in (("march", march), ("extrapolated", extrapolated)):
        start = time.perf_counter()
        for _ in range(20):
            function(0.5, 1.44)
        print(f"{name}: {(time.perf_counter() - start) / 20 * 1e3:.2g} ms an impact")


def main() -> None:
    """Compute, print and draw."""
    found, limit, slipping = random_differences()
    print_numbers(found, limit, slipping)
    figure = Figure(figsize=(10.0, 4.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_rebounds(left)
    draw_differences(right, found, limit)
    figure.savefig(TARGET, dpi=160)
    print(f"wrote {TARGET.name}")


if __name__ == "__main__":
    main()
