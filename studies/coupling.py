"""Why do measured rebounds of alumina on glass not show the coupling of unlike materials?

python studies/coupling.py    prints the tables of docs/coupling.md and draws its figure, a minute

From coupling.csv: impacts by boundary elements with other laws of friction or soft surfaces, which
were computed at version 0.2; and from the rebounds of Kharaz, Gorham & Salman (2001).
"""

from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from scipy.interpolate import PchipInterpolator, RectBivariateSpline
from scipy.optimize import minimize
from scipy.stats import f as fisher
from small_pictures import store_small

import carom
from carom.plots import style

TABLE = Path(__file__).with_name("coupling.csv")
FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "coupling.png"
SOLID, SPEED, RADIUS = 1.75, 3.9, 2.5e-3  # chi/kappa of a solid sphere on a half-space
BALL = carom.Sphere(radius=RADIUS, material="alumina")
GLASS = carom.material("soda-lime-glass", poisson=0.25)  # as the data sets have it
PAIR = carom.Pair(BALL, carom.HalfSpace(material=GLASS), 0.092)
KAPPA, BETA, FRICTION = PAIR.kappa, PAIR.dundurs_beta, PAIR.friction
SHOWN, SPINS = (1.84, 3.703, 9.496, 20.012, 30.127), (6.143, 10.991, 21.251, 31.157)
ANGLES = np.array(sorted((*SHOWN, *SPINS)))
DATA = "kharaz2001", "kharaz2001_mfix", "kharaz2001_kratos"
KAPPAS, RATIOS = (0.83, 0.91), (0.6, 1.2, 1.8, 2.46, 3.1)  # of the map, |beta|/friction
XS = (0.15, 0.4, 0.8, 1.15, 1.5, 1.9, 2.4, 3.0, 3.6, 4.2, 4.8, 5.3, 5.8, 6.3, 7.0, 8.2)
SHARES = np.linspace(0.0, 1.1, 23)  # of beta
SETS = {"e": "restitutions", "s": "spins", "es": "both"}
# finite elements: V_x'/(mu V_1') of test 5 of Chung & Ooi (2011), as digitised for Kratos
ELEMENTS = (-0.0267, -0.0267, -0.08, -0.2133, -0.3733, -0.6267, -0.9467, -1.2533, -1.52, -1.72)
ELEMENTS += (-1.7067, -1.2, 0.1333, 2.1467, 5.4267)
Array = Any


class Variant(NamedTuple):
    """A law of friction, or a soft surface, at a strength and a scale in SI units."""

    name: str
    law: str = "coulomb"
    strength: float = 0.0
    scale: float = 0.0
    friction: float = FRICTION
    beta: float = BETA


BEST = Variant("from 3 times, over 0.3 µm", "slip", 3.0, 3e-7)
PRESSURE = Variant("friction falls with pressure as $p^{-1/3}$", "pressure", 1 / 3)
LAYER = Variant(r"a layer that shears, $0.3 \, a_{\max}/G^*$", "layer", 0.0, 0.3)
VARIANTS = (
    Variant("theory, no coupling", beta=0.0),
    Variant("full solution"),
    Variant("friction always twice as high", friction=2.0 * FRICTION),
    Variant("friction falls from 2.5 times, over 0.5 µm of slip", "slip", 2.5, 5e-7),
    BEST,
    Variant("from 4 times, over 0.2 µm", "slip", 4.0, 2e-7),
    BEST._replace(name="from 3 times, over 0.3 µm, no coupling", beta=0.0),
    Variant("friction falls with the speed of slip, from 3 times, 0.1 m/s", "speed", 3.0, 0.1),
    PRESSURE,
    Variant("as $p^{-2/3}$", "pressure", 2 / 3),
    LAYER,
    Variant("asperities, stiffness $p/(0.1$ µm$)$", "asperities", 0.0, 1e-7),
)


@cache
def rows() -> pd.DataFrame:
    """Return what is stored."""
    return pd.read_csv(TABLE, comment="#")


def found(variant: Variant) -> tuple[Array, float]:
    """Return tangential restitutions at ANGLES, and the share that slips at 3.7 degrees."""
    table, out = rows(), []
    fine = (table.series == "alumina") & (table.elements == 32) & (table.law == variant.law)
    fine &= np.isclose(table.friction, variant.friction) & np.isclose(
        table.strength, variant.strength
    )
    fine &= np.isclose(table.beta, variant.beta, rtol=1e-6)
    for angle in ANGLES:
        scales = PAIR.scales(SPEED * np.cos(np.radians(angle)))
        units = {"slip": FRICTION * scales.length, "asperities": scales.length, "layer": KAPPA}
        units["speed"] = FRICTION * SPEED * np.cos(np.radians(angle))
        scale = variant.scale / units.get(variant.law, 1.0)
        one = table[fine & (table.case == f"{angle:g} deg") & np.isclose(table.scale, scale)].iloc[
            0
        ]
        out.append((restored(one.psi_2, one.kappa * one.x), one.slipping))
    return np.array([e_t for e_t, _ in out]), out[1][1]


def restored(psi_2: Array, psi_1: Array) -> Array:
    """Return the tangential restitution of the centre of a solid sphere."""
    return 1.0 - (1.0 - psi_2 / psi_1) / 3.5


def spun(angle: Array, restitution: Array) -> Array:
    """Return the spin after impact in rad/s; angles in degrees."""
    return (1.0 - restitution) * SPEED * np.sin(np.radians(angle)) * 2.5 / RADIUS


@cache
def measured(name: str) -> list[Array]:
    """Return angles and restitutions, angles and spins of one digitisation."""
    data, columns = carom.datasets.load(name), []
    for column in ("tangential_restitution", "spin_out"):
        values = np.abs(data[column].values)
        known = np.isfinite(values)
        columns += [np.degrees(data["angle"].values[known]), values[known]]
    return columns


def misfits(e_t: Array) -> tuple[float, float]:
    """Return how far restitutions at ANGLES are from the measured ones, and spins, rms."""
    _, restitution, _, spin = measured(DATA[0])
    e = np.isin(ANGLES, SHOWN)
    off = e_t[e] - restitution[:5], spun(ANGLES, e_t)[~e] - spin[:4]
    return float(np.sqrt(np.mean(off[0] ** 2))), float(np.sqrt(np.mean(off[1] ** 2)))


@cache
def splines() -> list[RectBivariateSpline]:
    """Return what coupling adds to psi_2, over |beta|/friction and V_x/(friction V_1)."""
    table, out = rows(), []
    for kappa in KAPPAS:
        theory, lines = carom.rebound(kappa * np.array(XS), SOLID * kappa), [np.zeros(len(XS))]
        for ratio in RATIOS:
            of = (table.case == f"ratio {ratio:g}") & (table.kappa == kappa)
            lines.append(table[of].psi_2.to_numpy() - theory)
        out.append(RectBivariateSpline((0.0, *RATIOS), XS, np.array(lines)))
    return out


def full(angle: Array, friction: float, kappa: float, beta: float) -> Array:
    """Return the tangential restitution by Coulomb's law at angles in degrees."""
    x = np.tan(np.radians(angle)) / friction
    part = (kappa - KAPPAS[0]) / (KAPPAS[1] - KAPPAS[0])
    one, other = (spline(abs(beta) / friction, x, grid=False) for spline in splines())
    coupling = np.where(x > XS[-1], 0.0, one + part * (other - one))
    return restored(carom.rebound(kappa * x, SOLID * kappa) + coupling, kappa * x)


def likely(sets: str, free_kappa: bool) -> Array:
    """Return the probability of a misfit as large as that of each share of beta, were it right."""
    data = measured(DATA[0])
    start = np.log([FRICTION, KAPPA][: 1 + free_kappa])

    def misfit(p: Array, share: float) -> float:
        numbers = np.exp(p[0]), np.exp(p[1]) if free_kappa else KAPPA, share * BETA
        off = {"e": full(data[0], *numbers) - data[1]}
        off["s"] = spun(data[2], full(data[2], *numbers)) - data[3]
        return float(sum(off[s].size * np.log(np.sum(off[s] ** 2)) for s in sets))

    options = {"xatol": 1e-5, "fatol": 1e-5}
    runs = [minimize(misfit, start, s, "Nelder-Mead", options=options) for s in SHARES]
    score = np.array([run.fun for run in runs])
    points = sum(data[1 if s == "e" else 3].size for s in sets)
    freedom = points - 2 - free_kappa
    return fisher.sf(freedom * np.expm1((score - score.min()) / points), 1, freedom)


def variant_table() -> Iterator[str]:
    """Yield restitutions at the measured angles with every surface, and their misfits."""
    yield "| | 1.8° | 3.7° | 9.5° | 20.0° | 30.1° | misfit | misfit of spins | slips |"
    yield "|---|---|---|---|---|---|---|---|---|"
    values = " | ".join(f"{value:.3f}" for value in measured(DATA[0])[1][:5])
    yield f"| **measured** | {values} | | | |"
    for variant in VARIANTS:
        e_t, slips = found(variant)
        cells = " | ".join(f"{value:.3f}" for value in e_t[np.isin(ANGLES, SHOWN)])
        one, other = misfits(e_t)
        yield f"| {variant.name} | {cells} | {one:.3f} | {other:.0f} rad/s | {100 * slips:.0f} % |"


def share_table() -> Iterator[str]:
    """Yield which share of the coupling fits best, and how probable none and all of it are."""
    yield r"| fitted to | $\kappa$ | best share | 95 % interval | $P$ of none | $P$ of all |"
    yield "|---|---|---|---|---|---|"
    for (sets, name), free in product(SETS.items(), (False, True)):
        p = likely(sets, free)
        left, none, all_ = SHARES[p > 0.05], p[0], np.interp(1.0, SHARES, p)
        ends = f"{left[0]:.2f} to {left[-1]:.2f}"
        yield (
            f"| {name} | {'free' if free else f'{KAPPA:.3f}'} | {SHARES[p.argmax()]:.2f} | {ends} "
            f"| {none:.1g} | {all_:.1g} |"
        )


def draw_restitutions(axis: Axes) -> None:
    """Draw what was measured, both solutions, and the full one with other surfaces."""
    angles = np.linspace(1.0, 33.0, 200)
    lines = {
        "theory": full(angles, FRICTION, KAPPA, 0.0),
        "full solution": full(angles, FRICTION, KAPPA, BETA),
    }
    changed = {
        "3 times the friction at small slip": BEST,
        "friction falls as $p^{-1/3}$": PRESSURE,
        "a layer that shears": LAYER,
    }
    for name, variant in changed.items():
        lines[name] = PchipInterpolator(ANGLES, found(variant)[0], extrapolate=False)(angles)
    for (name, e_t), color, dash in zip(lines.items(), style.LINES, style.DASHES, strict=True):
        axis.plot(angles, e_t, color=color, ls=dash, label=name)
    for data, marker in zip(DATA, "osD", strict=True):
        angle, e_t, at, spin = measured(data)
        points = {"ms": 3.0, "ls": "", "marker": marker, "zorder": 5}
        first = data == DATA[0]
        axis.plot(angle, e_t, color="k", mfc="w", label="measured" if first else None, **points)
        from_spin = 1.0 - spin / spun(at, np.zeros(1))
        label = "measured, from the spin" if first else None
        axis.plot(at, from_spin, color="0.5", label=label, **points)
    axis.set(xlim=(0.0, 33.0), ylim=(0.56, 0.9), xlabel="angle of incidence (°)")
    axis.set_ylabel("tangential restitution of the centre")
    axis.legend(loc="upper right")


def draw_slips(axis: Axes) -> None:
    """Draw how well a friction fits that falls with slip."""
    marks = zip((1.5, 2.0, 2.5, 3.0, 4.0), style.LINES, style.DASHES, "os^Dv", strict=True)
    for ratio, color, dash, marker in marks:
        scales = (2e-7, 3e-7, 5e-7, 1e-6)
        off = [misfits(found(Variant("", "slip", ratio, scale))[0])[0] for scale in scales]
        label = f"{ratio:g} times"
        axis.plot(1e6 * np.array(scales), off, marker, color=color, ls=dash, label=label)
    for name, beta in (("full solution", BETA), ("theory", 0.0)):
        off = misfits(full(ANGLES, FRICTION, KAPPA, beta))[0]
        axis.axhline(off, color="0.5", lw=0.6)
        side = {"va": "bottom"} if beta else {"va": "top"}
        axis.annotate(name, (1.0, off), (0, 0), textcoords="offset points", ha="right", **side)
    axis.set(xscale="log", ylim=(0.0, 0.125), xlabel="slip over which friction falls, $s_0$ (µm)")
    axis.set_ylabel("rms misfit of restitutions")
    axis.set_xticks([0.2, 0.3, 0.5, 1.0], ["0.2", "0.3", "0.5", "1"])
    axis.minorticks_off()
    axis.legend(loc="upper left", ncols=3, title="friction at first over that in sliding")


def draw_shares(axis: Axes) -> None:
    """Draw how probable each share of the coupling is, kappa as in handbooks or free."""
    for (sets, name), color in zip(SETS.items(), style.LINES, strict=False):
        for free, dash in ((False, "-"), (True, style.DASHES[1])):
            label = name + (r", $\kappa$ free" if free else "")
            axis.semilogy(SHARES, likely(sets, free), color=color, ls=dash, label=label)
    axis.axhline(0.05, color="0.5", lw=0.6)
    axis.annotate("5 %", (1.09, 0.05), (0, 1), textcoords="offset points", ha="right")
    axis.set(xlim=(0.0, 1.1), ylim=(1e-6, 30.0), xlabel=r"share of the coupling, of $\beta$")
    axis.set_ylabel("$P$ of a misfit as large")
    axis.legend(loc="lower left")


def elements() -> tuple[Array, Array, Array, Array]:
    """Return x, V_x'/(mu V_1') by finite elements, by the full solution and by the theory."""
    steel = rows()[rows().series == "steel"]
    x, kappa = steel.x.to_numpy(), steel.kappa.iloc[0]
    theory = carom.rebound(kappa * x, SOLID * kappa) / kappa
    return x, np.array(ELEMENTS), (steel.psi_2 / (kappa * steel.restitution)).to_numpy(), theory


def draw_elements(axis: Axes) -> None:
    """Draw finite elements and the full solution, less the theory."""
    x, theirs, ours, theory = elements()
    axis.plot(x, ours - theory, color=style.VERMILION, ls=style.DASHES[1], label="full solution")
    axis.plot(x, theirs - theory, "o", color="k", mfc="w", ms=3.0, label="finite elements")
    style.zero_line(axis)
    axis.set(ylim=(-0.2, 0.2), xlabel=r"$V_x/(\mu V_1)$ before the impact")
    axis.set_ylabel(r"$V_x'/(\mu V_1')$ less the theory's")
    axis.legend()


DRAWINGS = {
    "alumina on glass": draw_restitutions,
    "friction that falls with slip": draw_slips,
    "a share of the coupling": draw_shares,
    "steel on a rigid plane": draw_elements,
}


def main() -> None:
    """Print and draw."""
    print(*variant_table(), "", *share_table(), sep="\n")
    _, theirs, *others = elements()
    print("finite elements: rms", [f"{np.sqrt(np.mean((o - theirs) ** 2)):.3f}" for o in others])
    with style.style():
        figure, axes = style.new_figure(2, 2, width=style.DOUBLE, height=150.0)
        for axis, letter, (title, drawing) in zip(axes.flat, "abcd", DRAWINGS.items(), strict=True):
            drawing(axis)
            axis.set_title(f"({letter}) {title}", loc="left")
        store_small(figure, FIGURE)


if __name__ == "__main__":
    main()
