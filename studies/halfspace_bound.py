"""Which coefficients of the bound on the theory's psi_2 are the smallest that cover the study?

python studies/halfspace_bound.py

A linear program for each part of the bound: all differences of the series that it may see are
covered, and the mean of the bound over the difference is least. What is kept apart is not read. The
coefficients of carom.dimensionless.neglected are these, rounded up by a tenth or two.
"""

import numpy as np
from halfspace_differences import TOLERANCE, Case, cases, difference, finest
from numpy.typing import NDArray
from scipy.optimize import linprog

from carom.dimensionless.neglected import LATERAL, TURNED, beyond_sliding, poisson, spin_error

Array = NDArray[np.float64]

LEAST = 0.02  # differences of unlike materials below this count as much as this


def known(labels: tuple[str, ...]) -> tuple[Array, Array]:
    """Return kappa, |beta|, friction, chi, psi_1 in rows, and the differences with their errors."""
    seen: list[Case] = [case for label in labels for case in cases(label)]
    seen = [case for case in seen if finest(case)[0].kappa != 1.0]
    numbers = [finest(case)[0][2:7] for case in seen]
    sizes = [abs(difference(case).value) + difference(case).error - TOLERANCE for case in seen]
    return np.abs(np.array(numbers, dtype=float)).T, np.maximum(np.nan_to_num(sizes), 0.0)


def smallest(terms: Array, sizes: Array, least: float) -> Array:
    """Return the coefficients of the terms, in columns, that cover the sizes."""
    weight = 1.0 / np.maximum(sizes, least)
    found = linprog(terms.T @ weight, A_ub=-terms, b_ub=-sizes, bounds=(0.0, None))
    return np.asarray(found.x)


def spun() -> float:
    """Return the smallest coefficient of the bound by spin."""
    ratios = []
    for label in ("spin", "spin unlike", "spin again", "spin again unlike"):
        for case in cases(label):
            impact, size = finest(case)[0], abs(difference(case).value)
            whole = float(spin_error(impact.chi, impact.psi_1, impact.spin))
            if size > 0.0 and whole < 2.0 * impact.psi_1:
                ratios.append(TURNED * size / whole)
    return max(ratios)


def window(chi: Array, psi: Array) -> Array:
    """Return the factor of psi_1 in the bound."""
    return np.minimum(1.0, 2.0 * psi) / (1.0 + beyond_sliding(chi, psi)) ** 2


def main() -> None:
    """Print the coefficients."""
    (kappa, _, _, chi, psi), sizes = known(("solid", "like"))
    nu = np.array([poisson(k) for k in kappa])
    lateral = (chi * nu**2 * window(chi, psi))[:, None]
    print("like materials: lateral", smallest(lateral, sizes, 1e-5).round(4))
    (kappa, beta, friction, chi, psi), sizes = known(("pair", "unlike"))
    nu = np.array([poisson(k) for k in kappa])
    ratio = beta / friction
    held, root = ratio / (1.0 + ratio), np.sqrt(chi) * window(chi, psi)
    tie = np.exp(1.0 - 2.0 * chi) * np.maximum(1.0 - 2.0 * np.abs(psi - 1.0), 0.0)
    terms = np.stack([root * ratio * held, root * beta**2, tie * held], axis=1)
    left = np.maximum(sizes - LATERAL * chi * nu**2 * window(chi, psi), 0.0)
    print("unlike: radial, coupled, tied", smallest(terms, left, LEAST).round(4))
    print("spin: turned", round(spun(), 4))


if __name__ == "__main__":
    main()
