"""How far a contact law is from the exact impact: in psi_2, in its forces, by its time steps."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.losses import KelvinVoigt, LossLaw
from carom.dem.base import ContactLaw
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.law import Law, kappa_or_solid
from carom.dimensionless.rebounds import rebound
from carom.dimensionless.solution import solve
from carom.io.labels import labelled_dataset, pure
from carom.io.progress import advancing
from carom.quantities.arrays import POSITIVES, Array, finite_line, refuse_where
from carom.quantities.refusals import InputError, known_keywords, refusal, refuse
from carom.quantities.units import counted, finite, positive
from carom.verify.entries import LawOrFunction, as_law, parameters

if TYPE_CHECKING:
    import xarray as xr

INCIDENCES = (0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0)
SOLID_CHI = 1.4412  # of solid spheres with nu = 0.3
LARGEST_PSI, LARGEST_CHI = 1e9, 1e4
FORCE_INSTANTS = 400
RESTITUTION_MISSED = 1e-3  # less is rounding
FEWEST_STEPS, MOST_STEPS = 10, 2_000_000
LEAST_ALLOWED = 1e-8  # error of psi_2, to which a law without time steps is known
STEPS_GROW_BY = 2.0**0.5


class ForceError(NamedTuple):
    """Error of the tangential force through an impact, largest and rms, in units of mu P_max."""

    largest: float
    rms: float


class Impacts(NamedTuple):
    """Impacts at which laws are compared with the exact one; psi_1, chi, kappa broadcast."""

    psi: Array
    chi: Any
    kappa: Any

    @classmethod
    def of(cls, psi_1: ArrayLike, chi: Any, kappa: Any) -> "Impacts":
        """Return impacts of one chi as a user gives them, or raise InputError."""
        ratio = positive("chi", chi)
        allowed = f"must be at most {LARGEST_CHI:g}; spheres have 0.5 to 3"
        refuse(ratio > LARGEST_CHI and refusal("chi", chi, allowed))
        values = psi_line(psi_1)
        refuse(not np.any(values) and refusal("psi_1", psi_1, "must not all be zero"))
        return cls(values, ratio, kappa_or_solid(kappa, ratio))

    def rebound(self, law: Law, steps: int | None = None) -> Array:
        """Return psi_2 by a law, NaN where it leaves an impact unsolved, without a word of it."""
        psi_out = law.rebound(self.psi, self.chi, kappa=self.kappa, steps=steps, return_status=True)
        return np.asarray(psi_out[0])

    def refuse_failure(self, law: Law, psi_out: Array) -> None:
        """Raise InputError for the first impact in which the function of a law failed."""
        for place in np.flatnonzero(~np.isfinite(psi_out))[:1]:
            inputs = (np.broadcast_to(values, psi_out.shape).flat[place] for values in self)
            if words := law._why(*map(float, inputs)):
                raise InputError(words)

    def restitution(self, law: Law) -> float:
        """Return e that a law leaves: what its damping is asked for, unless it misses that."""
        asked = float(getattr(law, "restitution", 1.0))
        if asked == 1.0 or not isinstance(law, ContactLaw):
            return asked
        chi, kappa = (float(np.ravel(values)[0]) for values in self[1:])
        left = -float(law.history(0.0, chi, kappa=kappa)["normal_velocity"][-1])
        return left if abs(left - asked) > RESTITUTION_MISSED else asked

    def exact(self, restitution: float) -> Array:
        """Return the exact psi_2, with losses that of Kelvin-Voigt solids, or raise InputError."""
        losses = losses_of(restitution)
        exact, status = rebound(self.psi, self.chi, losses=losses, return_status=True)
        if np.any(status):
            message = Status(int(np.max(status))).message
            raise refusal("chi", self.chi, f"the exact impact is {message}")
        return np.asarray(exact)


def psi_line(psi_1: ArrayLike) -> Array:
    """Return psi_1 as an array, or raise InputError beyond which rounding hides errors."""
    values = finite_line("psi_1", psi_1)
    allowed = f"must be at most {LARGEST_PSI:g}; beyond it rounding hides the error"
    refuse_where("psi_1", values, np.abs(values) > LARGEST_PSI, allowed)
    return values


def in_words(psi: Sequence[float]) -> str:
    """Return how many incidences there are, and from where to where."""
    if len(psi) == 1:
        return f"at psi_1 = {psi[0]:g}"
    return f"at {len(psi)} incidences, psi_1 from {min(psi):g} to {max(psi):g}"


def losses_of(restitution: float) -> KelvinVoigt | None:
    """Return the exact impact's law of losses for a restitution."""
    return None if restitution == 1.0 else KelvinVoigt(restitution=restitution)


def constant_restitution(losses: LossLaw | None) -> float | None:
    """Return the restitution of losses, None without any; InputError if speeds change it."""
    if losses is None:
        return None
    if isinstance(losses, KelvinVoigt) and losses.restitution is not None:
        return float(losses.restitution)
    raise refusal("losses", losses, "give a restitution that is the same at all speeds")


def largest(error: Array) -> float:
    """Return the largest |error|."""
    return float(np.max(np.abs(error)))


def root_mean_square(error: Array) -> float:
    """Return the root of the mean square of errors."""
    return float(np.sqrt(np.mean(error**2)))


def energy_gain(psi: Array, psi_out: Array) -> float:
    """Return the largest |psi_2| - |psi_1|, zero if no impact gains energy; NaN counts as none."""
    gain = np.abs(psi_out) - np.abs(psi)
    return float(np.max(gain[np.isfinite(gain)], initial=0.0))


@known_keywords
def error_map(
    law: LawOrFunction,
    psi_1: ArrayLike | None = None,
    chi: ArrayLike | None = None,
    *,
    kappa: float | None = None,
    steps: int | None = None,
) -> "xr.Dataset":
    """Return the error of a contact law in psi_2 over psi_1 and chi, as a labelled dataset.

    The error is psi_2 of the law less the exact psi_2(psi_1, chi) of Maw, Barber & Fawcett (1976).
    A law with damping is compared with Kelvin-Voigt solids of the same e.

    Parameters
    ----------
    law : Law or callable
        A contact law, e.g. `carom.dem.LinearSpring()`, or a function as of `carom.dem.FunctionLaw`.
    psi_1, chi : array_like, optional
        Values along both axes, chi positive. By default chi goes over solid spheres, from 7/6
        (nu = 1/2) to 7/4 (nu = 0), and psi_1 up to where all of these slide throughout.
    kappa, steps : optional
        As for `law.rebound`.

    Returns
    -------
    xarray.Dataset
        psi_out, psi_out_exact, error `(chi, psi_in)`; max_error and rms_error `(chi)`, NaN where a
        law leaves a point unsolved.

    Raises
    ------
    InputError
        If the law is not a law, a chi is not positive, or a psi_1 is not finite.

    Examples
    --------
    >>> errors = carom.verify.error_map(carom.dem.LinearSpring(), [1.0, 6.0], [1.4412])
    >>> errors.error.values.round(3)
    array([[0.176, 0.   ]])
    """
    rule = as_law(law)
    chis = np.linspace(7.0 / 6.0, 7.0 / 4.0, 15)
    chis = chis if chi is None else finite_line("chi", chi, POSITIVES, above=0.0)
    top = 4.0 * float(chis.max())
    psis = np.linspace(0.0, top, 121) if psi_1 is None else psi_line(psi_1)
    rows, wide = chis[:, np.newaxis], ("chi", "psi_in")
    met = Impacts(psis, rows, kappa_or_solid(kappa, rows))
    with advancing("mapping the errors", None):
        exact = rebound(psis, rows, losses=losses_of(met.restitution(rule)))
        psi_out = met.rebound(rule, steps)
    if not np.any(np.isfinite(psi_out)):
        met.refuse_failure(rule, psi_out)
    error = psi_out - exact
    rms = np.sqrt(np.mean(error**2, axis=1))
    names = {"law": rule.name, "law_source": rule.source, "law_parameters": parameters(rule)}
    return labelled_dataset(
        {
            "psi_out": (wide, psi_out),
            "psi_out_exact": (wide, exact, pure("psi_2 of the exact impact")),
            "error": (wide, error, pure("error in psi_2")),
            "max_error": ("chi", np.abs(error).max(axis=1), pure("largest |error in psi_2|")),
            "rms_error": ("chi", rms, pure("root mean square of the error in psi_2")),
        },
        {"chi": chis, "psi_in": psis},
        {"title": "error of a contact law", **names},
    )


@known_keywords
def force_error(
    law: LawOrFunction, psi_1: float, chi: float, *, kappa: float | None = None
) -> ForceError:
    """Return the error of the tangential force through an impact, at equal parts of its duration.

    The error is (F_x - F_e)/(mu P_max), where F_e is the exact force. Both forces are taken at the
    same fraction of their own contact's duration, as a linear contact lasts longer than Hertz's.
    The error is NaN for a law without a duration. A law with damping is compared with viscoelastic
    bodies of the same e.

    Parameters
    ----------
    law : Law or callable
        A contact law, e.g. `carom.dem.LinearSpring()`, or a function as of `carom.dem.FunctionLaw`.
    psi_1 : float
        Incidence psi_1.
    chi, kappa : float
        As for `rank`.

    Returns
    -------
    ForceError
        `largest` and `rms` over the contact, in units of mu P_max.

    Raises
    ------
    InputError
        If the law is not a law, or its bodies do not part.

    Examples
    --------
    >>> round(carom.verify.force_error(carom.dem.LammpsMindlin("mindlin"), 0.75, 1.4412).rms, 2)
    0.16
    """
    law = as_law(law)
    if not isinstance(law, ContactLaw):
        return ForceError(np.nan, np.nan)
    psi, chi = finite("psi_1", psi_1, "1"), positive("chi", chi)
    kappa = kappa_or_solid(kappa, chi)
    history = law.history(psi, chi, kappa=kappa)
    parts = np.linspace(0.0, 1.0, FORCE_INSTANTS)
    elapsed = history["time"] / history["time"][-1]
    force = np.interp(parts, elapsed, history["tangential_force"])
    restitution = Impacts(np.array([psi]), chi, kappa).restitution(law)
    solution = solve(psi, chi, losses=losses_of(restitution))
    exact = 1.5 * solution.at(parts * solution.duration).force
    return ForceError(largest(force - exact), root_mean_square(force - exact))


class TimeSteps(NamedTuple):
    """Time steps per duration of the elastic contact, and the error in psi_2 that they cause."""

    steps: int
    error: float


def steps_record(step: TimeSteps | None) -> dict[str, Any]:
    """Return steps and their error for JSON, None for none."""
    steps, error = step or (None, None)
    return {"steps": steps, "step_error": error}


@known_keywords
def step_error(
    law: LawOrFunction,
    steps: int,
    psi_1: ArrayLike = INCIDENCES,
    chi: float = SOLID_CHI,
    *,
    kappa: float | None = None,
) -> float:
    """Return the largest |error in psi_2| that a number of time steps causes.

    This is the largest |psi_2(steps) - psi_2(converged)| over the incidences. The time step is
    t_c/steps, with the duration t_c of Hertz's contact.

    Parameters
    ----------
    law : Law or callable
        A contact law, as for `force_error`.
    steps : int
        Time steps per t_c, from 10 to two million.
    psi_1 : array_like
        Incidences psi_1.
    chi, kappa : float, optional
        As for `force_error`.

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
    >>> carom.verify.step_error(carom.dem.LammpsMindlin("mindlin"), 100) < 1e-3
    True
    """
    counted("steps", steps, FEWEST_STEPS, MOST_STEPS)
    law, met = as_law(law), Impacts.of(psi_1, chi, kappa)
    return largest(met.rebound(law, steps) - met.rebound(law))


@known_keywords
def advised_steps(
    law: LawOrFunction,
    allowed: float,
    psi_1: ArrayLike = INCIDENCES,
    chi: float = SOLID_CHI,
    *,
    kappa: float | None = None,
) -> TimeSteps | None:
    """Return the fewest time steps whose error in psi_2 stays within what is allowed.

    The error of twice as many steps must be within it, too; numbers are tried in steps of sqrt 2.
    None if two million do not suffice, 2000 for the exact law and one that is a Python function, or
    the law has no limit.

    Parameters
    ----------
    law : Law or callable
        A contact law, as for `force_error`.
    allowed : float
        Largest |error in psi_2| that the steps may cause, from 1e-8.
    psi_1, chi, kappa : optional
        As for `step_error`.

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
    >>> carom.verify.advised_steps(carom.dem.LinearSpring(), 0.01).steps
    28
    """
    bound = positive("allowed", allowed, "1")
    if bound < LEAST_ALLOWED:
        least = f"must be at least {LEAST_ALLOWED:g}, the error of psi_2 without time steps"
        raise refusal("allowed", allowed, least)
    law, met = as_law(law), Impacts.of(psi_1, chi, kappa)
    converged = met.rebound(law)
    if not np.all(np.isfinite(converged)):
        return None
    held: list[TimeSteps] = []
    wanted = float(FEWEST_STEPS)
    while wanted <= min(MOST_STEPS, law._most_steps):
        steps = round(wanted)
        error = largest(met.rebound(law, steps) - converged)
        held = [*held, TimeSteps(steps, error)] if error <= bound else []
        if len(held) == 3:
            return held[0]
        wanted *= STEPS_GROW_BY
    return None
