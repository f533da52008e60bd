"""What measured rebounds say of the coupling: misfits, the share of beta they want, the tables."""

from itertools import product
from typing import NamedTuple

import numpy as np
from coupling_laws import Array
from coupling_plan import (
    ANGLES,
    BETA,
    CHECKS,
    ELEMENTS,
    FRICTION,
    FULL,
    KAPPA,
    KAPPAS,
    LIKE,
    OTHERS,
    PAIR,
    RADIUS,
    RATIOS,
    SHARP,
    SLIPS,
    SOLID,
    SPEED,
    STEEL,
    XS,
    Rows,
    Variant,
)
from scipy.interpolate import RectBivariateSpline
from scipy.optimize import minimize
from scipy.stats import f as fisher, linregress

import carom

SHOWN = (1.84, 3.703, 9.496, 20.012, 30.127)
DATA = "kharaz2001", "kharaz2001_mfix", "kharaz2001_kratos"
SHARES = np.linspace(0.0, 1.1, 23)  # of beta
SETS = {"e": "restitutions", "s": "spins", "es": "both"}


def restored(psi_2: Array | float, psi_1: Array | float) -> Array:
    """Return the tangential restitution of the centre of a solid sphere."""
    return np.asarray(1.0 - (1.0 - psi_2 / psi_1) / 3.5)


def spun(angle: Array, restitution: Array) -> Array:
    """Return the spin after impact in rad/s; angles in degrees."""
    return (1.0 - restitution) * SPEED * np.sin(np.radians(angle)) * 2.5 / RADIUS


def measured(name: str) -> list[Array]:
    """Return angles and restitutions, angles and spins of one digitisation."""
    data, columns = carom.datasets.load(name), []
    for column in ("tangential_restitution", "spin_out"):
        values = np.abs(data[column].values)
        known = np.isfinite(values)
        columns += [np.degrees(data["angle"].values[known]), values[known]]
    return columns


def found(rows: Rows, variant: Variant) -> Array:
    """Return the tangential restitution at ANGLES."""
    impacts = [variant.at(angle) for angle in ANGLES]
    return np.array([restored(rows[i].psi_2, i.kappa * i.x) for i in impacts])


def misfits(e_t: Array) -> tuple[float, float]:
    """Return how far restitutions at ANGLES are off the measured ones, and spins, in rad/s: rms."""
    _, restitution, _, spin = measured("kharaz2001")
    e = np.array([angle in SHOWN for angle in ANGLES])
    off = e_t[e] - restitution[:5], spun(np.array(ANGLES), e_t)[~e] - spin[:4]
    return float(np.sqrt(np.mean(off[0] ** 2))), float(np.sqrt(np.mean(off[1] ** 2)))


def line(name: str, e_t: Array, *more: str) -> str:
    """Return a line of the table of variants."""
    cells = [f"{e_t[ANGLES.index(angle)]:.3f}" for angle in SHOWN]
    one, other = misfits(e_t)
    return " | ".join([name, *cells, f"{one:.3f}", f"{other:.0f}", *more])


class Coulomb:
    """The full solution with Coulomb's law for any friction, kappa and beta."""

    def __init__(self, rows: Rows) -> None:
        self.splines = []
        for kappa in KAPPAS:
            theory, table = carom.rebound(kappa * np.array(XS), SOLID * kappa), [np.zeros(len(XS))]
            for ratio in RATIOS:
                psi = [
                    r.psi_2
                    for i, r in rows.items()
                    if (i.case, i.kappa) == (f"ratio {ratio:g}", kappa)
                ]
                table.append(psi - theory)
            self.splines.append(RectBivariateSpline((0.0, *RATIOS), XS, np.array(table)))

    def at(self, angle: Array, friction: float, kappa: float, beta: float) -> Array:
        """Return the tangential restitution at angles in degrees."""
        x = np.tan(np.radians(angle)) / friction
        part = (kappa - KAPPAS[0]) / (KAPPAS[1] - KAPPAS[0])
        one, other = (spline(abs(beta) / friction, x, grid=False) for spline in self.splines)
        coupling = np.where(x > XS[-1], 0.0, one + part * (other - one))
        return restored(carom.rebound(kappa * x, SOLID * kappa) + coupling, kappa * x)


class Profile(NamedTuple):
    """F statistic of each of SHARES of beta against the best one; friction, and kappa if free."""

    excess: Array
    fitted: Array
    freedom: int

    @property
    def left(self) -> Array:
        """Shares that 95 % confidence leaves."""
        return SHARES[self.excess < fisher.ppf(0.95, 1, self.freedom)]

    def likely(self, share: float) -> float:
        """Return how probable it is to find a share fit so badly that is the right one."""
        return float(fisher.sf(np.interp(share, SHARES, self.excess), 1, self.freedom))


def profiled(full: Coulomb, data: list[Array], sets: str, free_kappa: bool) -> Profile:
    """Return how each share of beta fits the sets e, s: restitutions, spins, of unknown scatter."""
    start = np.log([FRICTION, KAPPA][: 1 + free_kappa])

    def misfit(p: Array, share: float) -> float:
        numbers = np.exp(p[0]), np.exp(p[1]) if free_kappa else KAPPA, share * BETA
        off = {
            "e": full.at(data[0], *numbers) - data[1],
            "s": spun(data[2], full.at(data[2], *numbers)) - data[3],
        }
        return float(sum(off[s].size * np.log(np.sum(off[s] ** 2)) for s in sets))

    options = {"xatol": 1e-5, "fatol": 1e-5}
    best = [minimize(misfit, start, s, "Nelder-Mead", options=options) for s in SHARES]
    score = np.array([each.fun for each in best])
    points = sum(data[1 if s == "e" else 3].size for s in sets)
    freedom = points - 2 - free_kappa
    excess = freedom * np.expm1((score - score.min()) / points)
    return Profile(excess, np.exp([each.x for each in best]), freedom)


def elements(rows: Rows) -> Array:
    """Return x, V_x'/(mu V_1') of finite elements, of the full solution and of the theory."""
    kappa = STEEL[0]
    impacts = [(i, r) for i, r in rows.items() if i.series == "steel"]
    x, theirs = np.array(ELEMENTS.split(), dtype=float).reshape(-1, 2).T
    ours = [row.psi_2 / (kappa * row.restitution) for _, row in impacts]
    return np.array([x, theirs, ours, carom.rebound(kappa * x, SOLID * kappa) / kappa])


def print_data(full: Coulomb) -> None:
    """Print what else was measured: rebound angles, and the tilt that would deceive."""
    print("\nincidence | rebound angle of the centre | full, e = 1 | full, e = 0.98 | theory, both")
    for name in DATA[:2]:
        data = carom.datasets.load(name)
        known = np.isfinite(data["rebound_angle"].values)
        columns = [np.degrees(data[column].values[known]) for column in ("angle", "rebound_angle")]
        for angle, rebound in zip(*(column[1:4] for column in columns), strict=True):
            out = [
                np.degrees(np.arctan(e_t * np.tan(np.radians(angle)) / e))
                for e_t in full.at(angle, FRICTION, KAPPA, np.array([BETA, 0.0]))
                for e in (1.0, 0.98)
            ]
            print(f"{angle:.2f} | {rebound:.2f} |", " | ".join(f"{each:.2f}" for each in out))
    angle, e_t, *_ = measured(DATA[0])
    ours = full.at(angle, FRICTION, KAPPA, BETA)
    print(
        "tilt of the plate that would do, degrees:",
        ((e_t - ours) * angle / (1 + ours))[:4].round(2),
    )


def tables(rows: Rows, full: Coulomb) -> None:
    """Print the tables of the page."""
    print(
        "variant |", " | ".join(f"{angle:g}°" for angle in SHOWN), "| rms e_t | rms spin | slipping"
    )
    angles = np.radians(ANGLES)
    psi = KAPPA * np.tan(angles) / FRICTION
    print(line("theory", restored(carom.rebound(psi, PAIR.chi), psi)))
    viscous = carom.KelvinVoigt(restitution=0.98)
    lossy = [carom.impact(PAIR, speed=SPEED, angle=a, losses=viscous).psi_out for a in angles]
    print(line("theory, e = 0.98", restored(np.array(lossy), psi)))
    for variant in (FULL, LIKE, *OTHERS, *SLIPS, *CHECKS):
        share = f"{100 * rows[variant.at(ANGLES[1])].slipping:.0f} %"
        print(line(variant.name, found(rows, variant), share))
    print("\nsharp fall of friction, 3.7°: scale, elements, e_t, share that slips")
    for variant in SHARP:
        row, impact = rows[variant.at(ANGLES[1])], variant.at(ANGLES[1])
        e_t = restored(row.psi_2, impact.kappa * impact.x)
        print(f"{variant.scale:.0e} | {variant.elements} | {e_t:.3f} | {100 * row.slipping:.0f} %")
    print("\ndata | sets | kappa free | share, mu, kappa | 95 % | p of none | p of all")
    for name, sets, free in product(DATA, SETS, (False, True)):
        fit = profiled(full, measured(name), sets, free)
        at = int(fit.excess.argmin())
        best = " ".join(f"{number:.4g}" for number in (SHARES[at], *fit.fitted[at]))
        whole = fit.fitted[SHARES.searchsorted(1.0 - 1e-9)].round(3)
        chances = f"{fit.likely(0.0):.2g} | {fit.likely(1.0):.2g} at {whole}"
        print(f"{name} | {sets} | {free} | {best} | {fit.left[[0, -1]]} | {chances}")
    data = measured(DATA[0])
    for free in (False, True):
        kept = [[np.delete(each, n) for each in data[:2]] + data[2:] for n in range(data[0].size)]
        worst = max(profiled(full, each, "e", free).likely(1.0) for each in kept)
        print(f"p of all, one restitution left out, kappa free {free}: at most {worst:.2g}")
    print("\nfriction in sliding, its power of pressure with its error")
    for name in DATA:
        *_, angle, spin = measured(name)
        normal = SPEED * np.cos(np.radians(angle))
        friction = spin * RADIUS / (2.5 * 1.98 * normal)
        fit = linregress(np.log(normal[angle > 35.0]), np.log(friction[angle > 35.0]))
        power = f"{2.5 * fit.slope:.2f} ± {2.5 * fit.stderr:.2f}"
        print(name, friction[angle > 35.0].round(4), power)
    extremes(full)
    print_data(full)
    _, theirs, ours, theory = elements(rows)
    for name, each in (("full", ours), ("theory", theory)):
        off = each - theirs
        print(f"finite elements less {name}: rms {np.sqrt(np.mean(off**2)):.3f}", np.round(-off, 3))


def extremes(full: Coulomb) -> None:
    """Print what the full solution reaches at 3.7 degrees with other constants of handbooks."""
    reached = []
    constants = (360e9, 400e9), (63e9, 75e9), (0.21, 0.25), (0.2, 0.25), (0.085, 0.1)
    for ball, plane, nu, other, friction in product(*constants):
        alumina = carom.Material(young=ball, poisson=nu, density=4000.0)
        glass = carom.Material(young=plane, poisson=other, density=2500.0)
        sphere = carom.Sphere(radius=RADIUS, material=alumina)
        pair = carom.Pair(sphere, carom.HalfSpace(material=glass), friction)
        numbers = pair.friction, pair.kappa, pair.dundurs_beta
        reached.append((float(full.at(np.array(ANGLES[1]), *numbers)), *numbers))
    names = "e_t at 3.7°", "friction", "kappa", "beta"
    for name, values in zip(names, np.transpose(reached), strict=True):
        print(f"{name}: {min(values):.3f} to {max(values):.3f}")
