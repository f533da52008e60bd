"""Which impacts the study of the theory computes: chosen, and drawn at random over its domain."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

import carom
from carom.halfspace.solution import Resolution

GRIDS = {n: Resolution(n, round(4.6875 * n)) for n in (8, 16, 32, 48, 64)}
RATIOS = (0.0, 0.2, 0.3, 0.5)  # Poisson's, of both bodies
PAIRS = {  # ball, half-space, friction
    "steel on rubber": ("steel", "rubber", 1.0),  # typical of dry rubber
    "glass on steel": ("soda-lime-glass", "steel", 0.125),  # of glass on aluminium, second hand
    "alumina on glass": ("alumina", "soda-lime-glass", 0.092),  # Kharaz et al. 2001 as modelled
    "POM on steel": ("pom", "steel", 0.2),  # typical, dry
    "steel on concrete": ("steel", "concrete", 0.57),  # second hand
}
# Impacts drawn at random: label, seed, how many, of like or unlike materials
DRAWN = {
    "like": (20261124, 300, "like"),
    "unlike": (20261125, 300, "unlike"),
    "apart like": (20261126, 50, "like"),  # kept apart: no bound has seen them
    "apart unlike": (20261127, 50, "unlike"),
    "spin": (20261129, 200, "like"),
    "spin unlike": (20261130, 40, "unlike"),
    "spin again": (20261131, 40, "like"),  # kept apart until one was beyond the bound
    "spin again unlike": (20261132, 10, "unlike"),
    "apart spin": (20261133, 40, "like"),
    "apart spin unlike": (20261134, 10, "unlike"),
}
SPINS, LIGHTNESS = (0.02, 20.0), (0.0005, 0.03)  # a_max/R up to 0.1
LEAST_CHI, LARGEST_CHI, LARGEST_NU = 0.3, 8.0, 0.5
LARGEST_BETA, FRICTIONS, LARGEST_RATIO = 0.5, (0.02, 1.0), 10.0
SOLID = 1.75  # chi/kappa of a solid sphere on a half-space


class Impact(NamedTuple):
    """One impact to be computed."""

    label: str  # solid, pair, a key of DRAWN, judge; control: nu = 0, the same chi; still: no spin
    case: str
    kappa: float
    beta: float
    friction: float
    chi: float
    psi_1: float
    elements: int
    steps: int
    spin: float = 0.0  # about the normal, and what opposes it less: `NormalSpin`
    lightness: float = 0.0


def incidences(chi: float) -> list[float]:
    """Return 12 incidences: 4 that start in stick, 3 up to 2 chi, 4 up to 4 chi - 1, one beyond."""
    width = 2.0 * chi - 1.0
    fractions = np.array([1 / 3, 2 / 3, 1.0, 1.25, 1.5, 1.75, 2.0])
    return [0.2, 0.5, 0.8, 1.0, *np.round(1.0 + width * fractions, 4), round(4.0 * chi + 1.0, 4)]


def shared(poisson: float) -> float:
    """Return kappa of like materials."""
    return 2.0 * (1.0 - poisson) / (2.0 - poisson)


def solid(poisson: float, grid: int) -> Iterator[Impact]:
    """Yield the impacts of solid spheres of like materials."""
    kappa = shared(poisson)
    chi = round(SOLID * kappa, 6)
    for psi in incidences(chi):
        yield Impact("solid", f"nu {poisson:g}", kappa, 0.0, 1.0, chi, psi, *GRIDS[grid])


def pairs(grid: int) -> Iterator[Impact]:
    """Yield the impacts of unlike materials."""
    for name, (ball, plane, friction) in PAIRS.items():
        pair = carom.Pair(
            carom.Sphere(radius="5 mm", material=ball), carom.HalfSpace(material=plane), friction
        )
        kappa, beta = round(pair.kappa, 6), round(pair.dundurs_beta, 6)
        chi = round(pair.chi, 6)
        for psi in incidences(chi):
            yield Impact("pair", name, kappa, beta, friction, chi, psi, *GRIDS[grid])


def control(impacts: Iterable[Impact]) -> Iterator[Impact]:
    """Yield each impact and the one of nu = 0 at the same chi, on the same grid."""
    for impact in impacts:
        yield impact
        if impact.kappa != 1.0 or impact.beta:
            alone = {"kappa": 1.0, "beta": 0.0, "friction": 1.0}
            yield impact._replace(label="control", case="nu 0", **alone)


def drawn_chi(rng: np.random.Generator) -> float:
    """Return a chi, evenly in its logarithm."""
    return float(np.exp(rng.uniform(np.log(LEAST_CHI), np.log(LARGEST_CHI))))


def drawn_psi(rng: np.random.Generator, chi: float) -> float:
    """Return an incidence: below 1.2, near 1, up to 4 chi + 1, or beyond."""
    last = max(4.0 * chi - 1.0, 1.0)
    choices = (
        rng.uniform(0.02, 1.2),
        rng.uniform(0.9, 1.1),
        rng.uniform(1.0, last + 2.0),
        last + rng.exponential(2.0),
    )
    return float(choices[rng.choice(4, p=(0.3, 0.2, 0.4, 0.1))])


def drawn_kappa(rng: np.random.Generator) -> float:
    """Return kappa of a Poisson's ratio."""
    return shared(float(rng.uniform(-LARGEST_NU, LARGEST_NU)))


def drawn_strength(rng: np.random.Generator) -> tuple[float, float]:
    """Return Dundurs' beta and friction, of whose ratio little and much are as likely."""
    while True:
        friction = float(np.exp(rng.uniform(*np.log(FRICTIONS))))
        beta = float(rng.choice((-1, 1)) * np.exp(rng.uniform(np.log(0.01), np.log(LARGEST_BETA))))
        if abs(beta) <= LARGEST_RATIO * friction:
            return beta, friction


def drawn(label: str, grid: int) -> Iterator[Impact]:
    """Yield the impacts of a series that is drawn at random; the same at each call."""
    seed, count, kind = DRAWN[label]
    rng = np.random.default_rng(seed)
    for number in range(count):
        chi, kappa = drawn_chi(rng), drawn_kappa(rng)
        beta, friction = (0.0, 1.0) if kind == "like" else drawn_strength(rng)
        numbers = (round(n, 6) for n in (kappa, beta, friction, chi, drawn_psi(rng, chi)))
        impact = Impact(label, f"{number}", *numbers, *GRIDS[grid])
        yield impact._replace(**drawn_spin(rng)) if "spin" in label else impact


def drawn_spin(rng: np.random.Generator) -> dict[str, float]:
    """Return a spin about the normal, evenly in its logarithm."""
    spin = np.exp(rng.uniform(*np.log(SPINS)))
    return {"spin": round(float(spin), 6), "lightness": round(float(rng.uniform(*LIGHTNESS)), 6)}


def still(impacts: Iterable[Impact]) -> Iterator[Impact]:
    """Yield each impact and the one without spin about the normal."""
    for impact in impacts:
        yield impact
        yield impact._replace(label=f"still {impact.label}", spin=0.0, lightness=0.0)


JUDGED = {"nu 0": 80, "like": 80, "unlike": 40}  # impacts of the study of errors


def judge(kind: str, grid: int) -> Iterator[Impact]:
    """Yield the impacts on which estimates of errors are judged."""
    rng = np.random.default_rng([20261128, len(kind)])
    for number in range(JUDGED[kind]):
        chi, kappa = drawn_chi(rng), 1.0 if kind == "nu 0" else drawn_kappa(rng)
        beta, friction = drawn_strength(rng) if kind == "unlike" else (0.0, 1.0)
        numbers = (round(n, 6) for n in (kappa, beta, friction, chi, drawn_psi(rng, chi)))
        yield Impact("judge", f"{kind} {number}", *numbers, *GRIDS[grid])


def plan() -> list[Impact]:
    """Return all impacts of the study, the coarse ones first, none twice."""
    every = [i for grid in (8, 16, 32) for kind in JUDGED for i in judge(kind, grid)]
    every += [*judge("nu 0", 64), *control(judge("like", 64))]
    for label in ("like", "apart like"):
        every += [*control(drawn(label, 32)), *control(drawn(label, 48))]
    for label in ("unlike", "apart unlike"):
        every += [*control(drawn(label, 16)), *control(drawn(label, 32))]
    every += [*control(pairs(16)), *control(pairs(32))]
    every += [i for grid in (32, 64) for ratio in RATIOS for i in control(solid(ratio, grid))]
    for label in (name for name in DRAWN if "spin" in name):
        every += [*still(drawn(label, 16))]
    every += [*judge("unlike", 48), *judge("unlike", 64)]
    return list(dict.fromkeys(every))
