"""How far a contact law is from the exact impact: in psi_2, in its forces, in energy."""

from collections.abc import Callable, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.losses import KelvinVoigt, LossLaw
from carom.dem import FunctionLaw
from carom.dem.base import SOLID, ContactLaw, Law
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.rebounds import rebound
from carom.dimensionless.solution import solve
from carom.io.labels import labelled_dataset
from carom.quantities.arrays import Array, finite_line, positive_line
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import finite, positive

if TYPE_CHECKING:
    import xarray as xr


LawOrFunction = Law | Callable[..., Any]  # the latter as a `FunctionLaw` takes it
INCIDENCES = (0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0)
LARGEST, LARGEST_CHI = 1e9, 1e4  # psi_1, chi
INSTANTS = 400  # at which forces are compared
PLAIN = float | int | str | None  # parameters that a file can hold
MISSED = 1e-3  # of the restitution asked for, less than which is rounding


class ForceError(NamedTuple):
    """Error of the tangential force through an impact, in units of mu P_max."""

    largest: float
    rms: float


def is_function(given: object) -> bool:
    """Return whether something may be a contact law that is written as a Python function."""
    return callable(given) and not isinstance(given, type | Law)


def as_law(law: object) -> Law:
    """Return a law as it is, a function as a contact law, or raise InputError."""
    if isinstance(law, Law):
        return law
    if callable(law) and is_function(law):
        return FunctionLaw(law)
    raise refusal("law", law, "must be a contact law, e.g. carom.dem.LinearSpring()")


def laws_of(name: str, given: Any) -> Sequence[Any]:
    """Return what is given as laws, one or a sequence, not yet checked; InputError for none."""
    if isinstance(given, Law) or is_function(given):
        return [given]
    if isinstance(given, list | tuple) and given:
        return given
    raise refusal(name, given, "give at least one law, e.g. [carom.dem.LinearSpring()]")


class Impacts(NamedTuple):
    """Impacts at which laws are compared with the exact one; psi_1, chi, kappa broadcast."""

    psi: Array
    chi: Any
    kappa: Any

    @classmethod
    def of(cls, psi: ArrayLike, chi: Any, kappa: Any) -> "Impacts":
        """Return impacts of one chi as a user gives them, or raise InputError."""
        ratio = positive("chi", chi)
        if ratio > LARGEST_CHI:
            raise refusal("chi", chi, f"must be at most {LARGEST_CHI:g}; spheres have 0.5 to 3")
        values = psi_line(psi)
        if not np.any(values):
            raise refusal("psi", psi, "must not all be zero")
        return cls(values, ratio, kappa_or_solid(kappa, ratio))

    def rebound(self, law: Law, steps: int | None = None) -> Array:
        """Return psi_2 by a law, NaN where it leaves an impact unsolved, without a word of it."""
        given = {"kappa": self.kappa, "steps": steps, "return_status": True}
        return np.asarray(law.rebound(self.psi, self.chi, **given)[0])

    def refuse_failure(self, law: Law, found: Array) -> None:
        """Raise InputError for the first impact in which the function of a law failed."""
        where = np.flatnonzero(~np.isfinite(found))[:1]
        each = [np.broadcast_to(values, found.shape).flat[where] for values in self]
        if where.size and (words := law._why(*(float(value[0]) for value in each))):
            raise InputError(words)

    def restitution(self, law: Law) -> float:
        """Return e that a law leaves: what its damping is asked for, unless it misses that."""
        asked = float(getattr(law, "restitution", 1.0))
        if asked == 1.0 or not isinstance(law, ContactLaw):
            return asked
        chi, kappa = (float(np.ravel(values)[0]) for values in self[1:])
        left = -float(law.history(0.0, chi, kappa=kappa)["normal_velocity"][-1])
        return left if abs(left - asked) > MISSED else asked

    def exact(self, restitution: float) -> Array:
        """Return the exact psi_2, with losses that of Kelvin-Voigt solids, or raise InputError."""
        losses = losses_of(restitution)
        exact, status = rebound(self.psi, self.chi, losses=losses, return_status=True)
        if np.any(status):
            message = Status(int(np.max(status))).message
            raise refusal("chi", self.chi, f"the exact impact is {message}")
        return np.asarray(exact)


def kappa_or_solid(kappa: Any, chi: Any) -> Any:
    """Return kappa as given, else that of solid spheres with this chi."""
    return SOLID * chi if kappa is None else positive("kappa", kappa)


def psi_line(psi: ArrayLike) -> Array:
    """Return psi_1 as an array, or raise InputError beyond what errors can be told of."""
    values = finite_line("psi", psi)
    if np.max(np.abs(values)) > LARGEST:
        allowed = f"must be at most {LARGEST:g}; beyond it rounding hides the error"
        raise refusal("psi", float(np.max(np.abs(values))), allowed)
    return values


def in_words(psi: Sequence[float]) -> str:
    """Return how many incidences there are, and from where to where."""
    if len(psi) == 1:
        return f"at psi_1 = {psi[0]:g}"
    return f"at {len(psi)} incidences, psi_1 from {min(psi):g} to {max(psi):g}"


def damped(law: Law, restitution: float) -> Law:
    """Return a law with the damping for a restitution, or raise InputError if it has none."""
    if not hasattr(law, "restitution"):
        raise refusal("restitution", restitution, f"{law.name} has no damping; leave it out")
    return law._damped(restitution)


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


def error_map(
    law: LawOrFunction,
    psi: ArrayLike | None = None,
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
    psi, chi : array_like, optional
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
        If the law is not a law, a chi is not positive, or a psi is not finite.

    Examples
    --------
    >>> import carom
    >>> found = carom.verify.error_map(carom.dem.LinearSpring(), [1.0, 6.0], [1.4412])
    >>> found.error.values.round(3)
    array([[0.176, 0.   ]])
    """
    rule = as_law(law)
    chis = np.linspace(7.0 / 6.0, 7.0 / 4.0, 15) if chi is None else positive_line("chi", chi)
    top = 4.0 * float(chis.max())
    psis = np.linspace(0.0, top, 121) if psi is None else psi_line(psi)
    rows, wide = chis[:, np.newaxis], ("chi", "psi_in")
    met = Impacts(psis, rows, kappa_or_solid(kappa, rows))
    exact = rebound(psis, rows, losses=losses_of(met.restitution(rule)))
    given = met.rebound(rule, steps)
    if not np.any(np.isfinite(given)):
        met.refuse_failure(rule, given)
    error = given - exact
    names = {"law": rule.name, "law_source": rule.source, "law_parameters": parameters(rule)}
    return labelled_dataset(
        {
            "psi_out": (wide, given),
            "psi_out_exact": (wide, exact, pure("psi_2 of the exact impact")),
            "error": (wide, error, pure("error in psi_2")),
            "max_error": ("chi", np.abs(error).max(axis=1), pure("largest |error in psi_2|")),
            "rms_error": (
                "chi",
                np.sqrt(np.mean(error**2, axis=1)),
                pure("root mean square of the error in psi_2"),
            ),
        },
        {"chi": chis, "psi_in": psis},
        {"title": "error of a contact law", **names},
    )


def parameters(law: Law) -> dict[str, float | str | None]:
    """Return the parameters of a law by name, those that are numbers or texts, without its name."""
    given = {item.name: getattr(law, item.name) for item in fields(law) if item.name != "name"}
    return {name: given[name] for name in given if isinstance(given[name], PLAIN)}


def force_error(
    law: LawOrFunction, psi: float, chi: float, *, kappa: float | None = None
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
    psi : float
        Incidence psi_1.
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.
    kappa : float, optional
        Stiffness ratio G*/E*; by default that of solid spheres, 4 chi/7.

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
    >>> import carom
    >>> round(carom.verify.force_error(carom.dem.LammpsMindlin("mindlin"), 0.75, 1.4412).rms, 2)
    0.16
    """
    law = as_law(law)
    if not isinstance(law, ContactLaw):
        return ForceError(np.nan, np.nan)
    psi, chi = finite("psi", psi, "1"), positive("chi", chi)
    own = kappa_or_solid(kappa, chi)
    history = law.history(psi, chi, kappa=own)
    parts = np.linspace(0.0, 1.0, INSTANTS)
    elapsed = history["time"] / history["time"][-1]
    force = np.interp(parts, elapsed, history["tangential_force"])
    solution = solve(
        psi, chi, losses=losses_of(Impacts(np.array([psi]), chi, own).restitution(law))
    )
    exact = 1.5 * solution.at(parts * solution.duration).force
    return ForceError(largest(force - exact), root_mean_square(force - exact))


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


def dashed(value: float | None, width: int, form: str) -> str:
    """Return a number for a column of a table, a dash where there is none."""
    return (
        f"{'-':>{width}s}" if value is None or not np.isfinite(value) else f"{value:{width}{form}}"
    )


def pure(meaning: str) -> dict[str, str]:
    """Return the attributes of a pure number."""
    return {"units": "1", "long_name": meaning}
