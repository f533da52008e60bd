"""What a time step costs: how far a law in fixed steps is from the law itself."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.quantities.units import counted, positive
from carom.verify.errors import INCIDENCES, Impacts, LawOrFunction, as_law, largest

FEWEST, MOST = 10, 2_000_000
GROWTH = 2.0**0.5


class TimeSteps(NamedTuple):
    """Steps per duration of the elastic contact, and the error in psi_2 that they cause."""

    steps: int
    error: float


def told_steps(given: TimeSteps | None) -> dict[str, Any]:
    """Return steps and their error for a record, None for none."""
    steps, error = given or (None, None)
    return {"steps": steps, "step_error": error}


def step_error(
    law: LawOrFunction,
    steps: int,
    psi: ArrayLike = INCIDENCES,
    chi: float = 1.4412,
    *,
    kappa: float | None = None,
) -> float:
    """Return the largest |error in psi_2| that a number of time steps causes.

    This is the largest |psi_2(steps) - psi_2(converged)| over the incidences. The time step is
    t_c/steps, with the duration t_c of Hertz's contact.

    Parameters
    ----------
    law : Law or callable
        A contact law, e.g. `carom.dem.LinearSpring()`, or a function as of `carom.dem.FunctionLaw`.
    steps : int
        Time steps per t_c, from 10 to two million.
    psi : array_like
        Incidences psi_1.
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.
    kappa : float, optional
        Stiffness ratio G*/E*; by default that of solid spheres, 4 chi/7.

    Returns
    -------
    float
        In units of psi; NaN if the law has no limit.

    Raises
    ------
    InputError
        If the law is not a law, or a value is out of range.

    Examples
    --------
    >>> import carom
    >>> carom.verify.step_error(carom.dem.LammpsMindlin("mindlin"), 100) < 1e-3
    True
    """
    counted("steps", steps, FEWEST, MOST)
    law, met = as_law(law), Impacts.of(psi, chi, kappa)
    return largest(met.rebound(law, steps) - met.rebound(law))


def advised_steps(
    law: LawOrFunction,
    allowed: float,
    psi: ArrayLike = INCIDENCES,
    chi: float = 1.4412,
    *,
    kappa: float | None = None,
) -> TimeSteps | None:
    """Return the fewest time steps whose error in psi_2 stays within what is allowed.

    The error of twice as many steps must be within it, too; numbers are tried in steps of sqrt 2.
    None if two million do not suffice, 2000 for a law that is a Python function, or the law has no
    limit.

    Parameters
    ----------
    law : Law or callable
        A contact law, e.g. `carom.dem.LinearSpring()`, or a function as of `carom.dem.FunctionLaw`.
    allowed : float
        Largest |error in psi_2| that the steps may cause.
    psi : array_like
        Incidences psi_1.
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.
    kappa : float, optional
        Stiffness ratio G*/E*; by default that of solid spheres, 4 chi/7.

    Returns
    -------
    TimeSteps or None
        `steps` per duration of Hertz's contact, and their `error` in psi_2.

    Raises
    ------
    InputError
        If the law is not a law, or a value is out of range.

    Examples
    --------
    >>> import carom
    >>> carom.verify.advised_steps(carom.dem.LinearSpring(), 0.01).steps
    28
    """
    bound = positive("allowed", allowed, "1")
    law, met = as_law(law), Impacts.of(psi, chi, kappa)
    converged = met.rebound(law)
    if not np.all(np.isfinite(converged)):
        return None
    held: list[TimeSteps] = []
    wanted = float(FEWEST)
    while wanted <= min(MOST, law.most_steps):
        steps = round(wanted)
        error = largest(met.rebound(law, steps) - converged)
        held = [*held, TimeSteps(steps, error)] if error <= bound else []
        if len(held) == 3:
            return held[0]
        wanted *= GROWTH
    return None
