"""The parameters with which Walton's law comes closest to the exact one."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from scipy.optimize import least_squares

from carom.bodies.checks import with_friction
from carom.bodies.pairs import Pair
from carom.many.laws.exact import law_of
from carom.many.laws.rigid import WaltonLaw
from carom.quantities.arrays import Array
from carom.quantities.units import within

POINTS = 2001
SHORTEST, LONGEST = 1e-6, 1e9  # spans


@dataclass(frozen=True)
class WaltonFit:
    """Walton's law fitted to the exact one, and the remaining error of psi_2; made by `fit_walton`.

    `law` is the fitted `WaltonLaw`, `rms_error` and `max_error` are the errors of its psi_2, and
    `span` is the largest psi_1 of the fit.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> fit = carom.laws.fit_walton(pair)
    >>> round(fit.law.friction, 3), round(fit.max_error, 2), round(fit.span, 2)
    (0.199, 0.35, 5.76)
    """

    law: WaltonLaw
    rms_error: float
    max_error: float
    span: float


def fit_walton(pair: Pair, span: float | None = None) -> WaltonFit:
    """Return Walton's friction and beta_0 that come closest to the exact rebound of a pair.

        psi_2 = psi_1 - min((1 + beta_0) psi_1, 4 chi mu_W/mu)

    This psi_2 (Walton 1993) is fitted by least squares to the exact one (Maw, Barber & Fawcett
    1976), at incidences psi_1 evenly spaced from 0 to the span.

    Parameters
    ----------
    pair : Pair
        The bodies; their friction must not be zero.
    span : float, optional
        Largest psi_1, by default 4 chi, slightly beyond the border of gross slip throughout.

    Returns
    -------
    WaltonFit
        The `law`, a WaltonLaw with e = 1, the `rms_error` and `max_error` of its psi_2 over the
        span, and the `span`.

    Raises
    ------
    InputError
        If the pair has no friction, or the span is not positive, or beyond 1e9.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> fit = carom.laws.fit_walton(pair)
    >>> round(fit.law.tangential_restitution, 2), round(fit.rms_error, 2)
    (0.41, 0.16)
    """
    with_friction(pair, "without friction there is nothing to fit")
    reach = within("span", 4.0 * pair.chi if span is None else span, SHORTEST, LONGEST, "1")
    psi = np.linspace(0.0, reach, POINTS)
    exact, limit = law_of(pair.chi)(psi), 4.0 * pair.chi

    def residual(parameters: Array) -> Array:
        one_plus_beta, ratio = parameters
        return np.asarray(psi - np.minimum(one_plus_beta * psi, limit * ratio) - exact)

    minimum = least_squares(residual, (1.3, 1.0), bounds=((0.0, 0.0), (2.0, inf)), x_scale=0.1)
    beta, ratio = float(minimum.x[0]) - 1.0, float(minimum.x[1])
    law = WaltonLaw(friction=ratio * pair.friction, tangential_restitution=beta)
    error = residual(minimum.x)
    return WaltonFit(law, float(np.sqrt(np.mean(error**2))), float(np.max(np.abs(error))), reach)
