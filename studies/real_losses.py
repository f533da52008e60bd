"""Which solid do measured rebounds prefer? AICc of Kharaz's balls, and published e and beta_0.

python studies/real_losses.py    half a minute, prints two tables for docs/choosing.md

Kharaz et al. (2001): friction, kappa and the loss are fitted to all angles, spins and restitutions
for bodies without loss, viscoelastic ones and yielding spheres. beta_0, the largest -psi_2/psi_1 of
solid spheres (chi = 1.44), of each solid at the e of Foerster et al. (1994), Phys. Fluids 6:1108.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, least_squares

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.panels.stages import viscous_loss
from carom.dimensionless.lossy.rebounds import is_elastic, lossy_rebounds

CHI, RADIUS = 1.44, 2.5e-3
PSI = np.linspace(0.8, 4.5, 149)
MEASURED = ("tangential_restitution", "spin_out", "rebound_angle")
PUBLISHED = {"glass": (0.97, 0.44), "cellulose acetate": (0.87, 0.43)}
STIFFER = 6.0  # E_0/E of the solid that relaxes slowly

Array = NDArray[np.float64]


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


def spring_back(losses: LossNumbers) -> float:
    """Return the largest -psi_2/psi_1."""
    found = lossy_rebounds(PSI, np.full(PSI.size, CHI), losses)
    return float(np.max(-found.psi_out / PSI))


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
        row = "  ".join(f"{spring_back(solid(e)):.3f}" for solid in SOLIDS.values())
        told = ", ".join(
            f"{name} {beta}" for name, (known, beta) in PUBLISHED.items() if known == e
        )
        print(f"e = {e:<5g}              {row}   {told}")


if __name__ == "__main__":
    main()
