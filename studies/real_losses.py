"""Which solid do measured rebounds prefer? AICc of Kharaz's balls, and published e and beta_0.

python studies/real_losses.py    a minute, prints three tables for docs/choosing.md

Kharaz et al. (2001): friction, kappa and the loss are fitted to all angles, spins and restitutions
for bodies without loss, viscoelastic ones and yielding spheres. beta_0, the largest -psi_2/psi_1,
of each solid at some e, and at the e of published pairs: those of M. Y. Louge's laboratory at
Cornell, "Fall 1999 Impact Parameter Chart" (glass and acetate: Foerster et al. 1994, Phys. Fluids
6:1108), and of Joseph & Hunt (2004), J. Fluid Mech. 510:71, p. 78. Both were read in a public copy
of the numbers, github.com/svenviktorjonsson/rigid-body-collisions. Elastic constants are not
theirs: chi follows from Poisson's ratios of handbooks.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, least_squares

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.panels.stages import viscous_loss
from carom.dimensionless.lossy.rebounds import is_elastic, lossy_rebounds

CHI, RADIUS = 1.44, 2.5e-3
PSI = np.linspace(0.8, 4.5, 149)
GIGA = 1e9
MEASURED = ("tangential_restitution", "spin_out", "rebound_angle")
STIFFER = 6.0  # E_0/E of the solid that relaxes slowly

Array = NDArray[np.float64]


class Published(NamedTuple):
    """Two bodies, and e and beta_0 with their errors, as published."""

    bodies: str
    materials: tuple[carom.Material, carom.Material]
    e: float
    e_error: float
    beta: float
    beta_error: float

    @property
    def chi(self) -> float:
        """(kappa/2)(m_n/m_t) of a solid sphere."""
        ball = carom.Sphere(radius=1e-3, material=self.materials[0])
        return float(carom.Pair(ball, carom.HalfSpace(material=self.materials[1]), 0.1).chi)


def polymer(young: float, poisson: float) -> carom.Material:
    """Return a material; of like ones only Poisson's ratio matters here."""
    return carom.Material(young=young * GIGA, poisson=poisson, density=1200.0)


GLASS, STEEL = carom.material("soda-lime-glass"), carom.material("bearing-steel")
ALUMINIUM, POM = carom.material("aluminium"), carom.material("pom")
ACETATE, URETHANE, ZERODUR = polymer(2.0, 0.4), polymer(0.01, 0.49), polymer(90.3, 0.24)
PUBLISHED = (
    Published("glass, glass", (GLASS, GLASS), 0.97, 0.01, 0.44, 0.07),
    Published("fresh glass, like", (GLASS, GLASS), 0.922, 0.021, 0.37, 0.07),
    Published("spent glass, like", (GLASS, GLASS), 0.972, 0.015, 0.25, 0.08),
    Published("chrome steel, like", (STEEL, STEEL), 1.0, 0.01, 0.54, 0.05),
    Published("steel, Zerodur", (STEEL, ZERODUR), 0.97, 0.02, 0.34, 0.07),
    Published("glass, Zerodur", (GLASS, ZERODUR), 0.97, 0.02, 0.39, 0.06),
    Published("glass, aluminium", (GLASS, ALUMINIUM), 0.831, 0.009, 0.31, 0.06),
    Published("acetate, like", (ACETATE, ACETATE), 0.87, 0.02, 0.43, 0.06),
    Published("acetate, aluminium", (ACETATE, ALUMINIUM), 0.891, 0.003, 0.39, 0.07),
    Published("Delrin, like", (POM, POM), 0.97, 0.01, 0.54, 0.1),
    Published("polyurethane, like", (URETHANE, URETHANE), 0.6, 0.05, 0.3, 0.02),
)


def restitution(losses: LossNumbers) -> float:
    """Return e."""
    return float(lossy_rebounds(np.ones(1), np.ones(1), losses).restitution[0])


def viscous(e: float) -> LossNumbers:
    """Return Kelvin & Voigt's solid of this e."""
    return LossNumbers(Loss.VISCOUS, viscous_loss(e))


def yielding(e: float) -> LossNumbers:
    """Return the yielding sphere of this e."""

    def excess(y: float) -> float:
        return restitution(LossNumbers(Loss.PLASTIC, y)) - e

    return LossNumbers(Loss.PLASTIC, float(brentq(excess, 0.01, 0.99998)))


def relaxing(e: float) -> LossNumbers:
    """Return the standard linear solid of this e that relaxes slowly."""

    def excess(time: float) -> float:
        return restitution(LossNumbers(Loss.RELAXING, time, STIFFER - 1.0)) - e

    return LossNumbers(Loss.RELAXING, float(brentq(excess, 0.6, 100.0, xtol=1e-6)), STIFFER - 1.0)


SOLIDS = {"viscous": viscous, "yields": yielding, "relaxes slowly": relaxing}


def spring_back(losses: LossNumbers | None, chi: float = CHI) -> float:
    """Return the largest -psi_2/psi_1."""
    if losses is None:
        return float(np.max(-carom.rebound(PSI, chi) / PSI))
    found = lossy_rebounds(PSI, np.full(PSI.size, chi), losses)
    return float(np.max(-found.psi_out / PSI))


def at_restitution(e: float, chi: float = CHI) -> Array:
    """Return the largest -psi_2/psi_1 without a loss in shear or anywhere, and of each solid."""
    solids = [solid(e) if e < 1.0 else None for solid in SOLIDS.values()]
    return np.array([spring_back(losses, chi) for losses in (None, *solids)])


def predicted(parameters: Array, solid: str, data: dict[str, Array]) -> dict[str, Array]:
    """Return what would be measured; parameters are ln mu, ln kappa and, with losses, ln(1 - e)."""
    friction, kappa = np.exp(parameters[:2])
    e = 1.0 if solid == "none" else 1.0 - np.exp(parameters[2])
    slope = np.tan(data["angle"])
    psi, chi = kappa * slope / friction, np.full(slope.size, 1.75 * kappa)
    losses = LossNumbers(Loss.VISCOUS, 0.0) if solid == "none" else SOLIDS[solid](e)
    if np.all(is_elastic(losses.loss, np.asarray(losses.parameter), np.asarray(losses.extra))):
        out = carom.rebound(psi, chi)
    else:
        out = lossy_rebounds(psi, chi, losses).psi_out
    tangential = data["speed"] * np.sin(data["angle"])
    after = tangential * (1.0 - 2.0 / 7.0 * (1.0 - out / psi))
    normal = data["speed"] * np.cos(data["angle"]) * e
    spin = (out / psi * tangential - after) / RADIUS
    return {
        "tangential_restitution": after / tangential,
        "spin_out": spin,
        "rebound_angle": np.arctan2(after, normal),
    }


def misfits(parameters: Array, solid: str, data: dict[str, Array]) -> Array:
    """Return (predicted - measured)/error of all that was measured."""
    model, rows = predicted(parameters, solid, data), []
    for name in MEASURED:
        known = np.isfinite(data[name])
        error = data[f"{name}_error"][known]
        rows.append((model[name][known] - data[name][known]) / error)
    return np.concatenate(rows)


def corrected(chi_square: float, points: int, parameters: int) -> float:
    """Return AICc, errors Gaussian of a common unknown size (Burnham & Anderson 2002, (2.4))."""
    k = parameters + 1
    return points * np.log(chi_square / points) + 2 * k + 2 * k * (k + 1) / (points - k - 1)


def main() -> None:
    """Print both tables."""
    loaded = carom.datasets.load("kharaz2001")
    data = {name: np.asarray(loaded[name], dtype=float) for name in loaded}
    print("solid            friction  kappa   1 - e     AICc")
    for solid in ("none", *SOLIDS):
        start = [np.log(0.1), np.log(0.85), np.log(0.01)][: 2 if solid == "none" else 3]
        best = least_squares(misfits, start, args=(solid, data), x_scale=0.05, diff_step=1e-4)
        friction, kappa = np.exp(best.x[:2])
        lost = 0.0 if solid == "none" else float(np.exp(best.x[2]))
        aicc = corrected(2.0 * best.cost, best.fun.size, len(start))
        print(f"{solid:16s} {friction:8.4f} {kappa:7.3f} {lost:8.4f} {aicc:8.1f}")
    print("\nlargest -psi_2/psi_1   " + "  ".join(SOLIDS))
    for e in (0.97, 0.95, 0.9, 0.87, 0.8, 0.7):
        print(f"e = {e:<5g}              {'  '.join(f'{v:.3f}' for v in at_restitution(e)[1:])}")
    print("\npublished               chi     e       beta_0      elastic  " + "  ".join(SOLIDS))
    off = []
    for each in PUBLISHED:
        found = at_restitution(each.e, each.chi)
        off.append(((found - each.beta) / each.beta_error) ** 2)
        row = "    ".join(f"{value:.3f}" for value in found)
        measured = f"{each.beta:.2f} +- {each.beta_error:.2f}"
        print(f"{each.bodies:20s} {each.chi:6.3f}  {each.e:5.3f}  {measured}   {row}")
    for part, name in ((off, "all"), (off[:-1], "without polyurethane")):
        row = "    ".join(f"{value:.1f}" for value in np.sum(part, axis=0))
        print(f"sum of ((beta_0 - published)/error)^2, {len(part)} pairs, {name}: {row}")


if __name__ == "__main__":
    main()
