"""Rebound curves of a view, the exact one and those of contact laws; remembered by bodies."""

from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.blocks import available_cores
from carom.dimensionless.hertz import DURATION
from carom.dimensionless.rebounds import rebound
from carom.explorer.scenes import Scene
from carom.laws.dem.base import ContactLaw, Law
from carom.verify.catalogue import named

Array = NDArray[np.float64]

POINTS, POINTS_OF_LAWS = 241, 41
BEYOND = 1.15  # of the present psi_1, that is shown
STEPS = 800  # of a law: its curve to half a hundredth of its height, far quicker than to 1e-8
EVERY = 4  # of these steps that is drawn
KEPT = 256  # curves that are remembered
DIGITS = 12  # of what a curve is remembered by


@dataclass(frozen=True, eq=False)
class LawCurve:
    """What a contact law gives: its rebounds, and its force in time, both as they are drawn."""

    label: str
    psi_in: Array
    psi_out: Array
    at: float  # psi_2 at the present psi_1
    share: Array
    force: Array


def exact_curve(scene: Scene) -> tuple[Array, Array]:
    """Return psi_1 and psi_2 of the exact curve, over the present point and all regimes."""
    return _exact(round(scene.chi, DIGITS), *_span(scene))


@lru_cache(maxsize=KEPT)
def _exact(chi: float, low: float, high: float) -> tuple[Array, Array]:
    psi = np.linspace(low, high, POINTS)
    return psi, rebound(psi, chi)


def law_curves(scene: Scene, labels: Iterable[str]) -> list[LawCurve]:
    """Return what the contact laws of these names give in the place of the exact one."""
    with ThreadPoolExecutor(available_cores()) as pool:
        return list(pool.map(lambda label: _of_law(scene, label), labels))


def _of_law(scene: Scene, label: str) -> LawCurve:
    law = named(label)[0].law
    low, high = _span(scene)
    grid = np.linspace(0.0, _regimes(scene.chi), POINTS_OF_LAWS)
    half = _half(label, round(scene.chi, DIGITS), round(scene.kappa, DIGITS))
    psi, out = np.concatenate([-grid[:0:-1], grid]), np.concatenate([-half[:0:-1], half])
    shown = (psi >= low) & (psi <= high)
    at, share, force = float("nan"), np.array([]), np.array([])
    if np.isfinite(scene.psi_in):
        at = float(law.rebound(scene.psi_in, scene.chi, kappa=scene.kappa, threads=1))
        share, force = _in_time(law, scene)
    return LawCurve(label, psi[shown], out[shown], at, share, force)


def _in_time(law: Law, scene: Scene) -> tuple[Array, Array]:
    """Return times as shares of the exact duration, and the force in the unit of the scene."""
    if not isinstance(law, ContactLaw):
        return np.array([]), np.array([])  # a hard sphere has no contact to follow
    told = law.history(scene.psi_in, scene.chi, kappa=scene.kappa, steps=STEPS)
    force = told["tangential_force"] * float(scene.limit.max())
    return told["time"][::EVERY] / DURATION, force[::EVERY]


@lru_cache(maxsize=KEPT)
def _half(label: str, chi: float, kappa: float) -> Array:
    """Return psi_2 of a law over the regimes; beyond them every law slides."""
    grid = np.linspace(0.0, _regimes(chi), POINTS_OF_LAWS)
    law = named(label)[0].law
    return np.asarray(law.rebound(grid, chi, kappa=kappa, steps=STEPS, threads=1))


def _regimes(chi: float) -> float:
    """Return a psi_1 beyond all regimes."""
    return float(np.ceil(2.0 * max(4.0 * chi, 1.5)) / 2.0)


def _span(scene: Scene) -> tuple[float, float]:
    """Return the psi_1 between which curves are drawn: all regimes, and the present point."""
    regimes = _regimes(scene.chi)
    point = scene.psi_in if np.isfinite(scene.psi_in) else 0.0
    reach = np.ceil(BEYOND * abs(point)) if abs(point) > regimes / BEYOND else regimes
    return (-reach if point < 0.0 else 0.0), max(reach, regimes)
