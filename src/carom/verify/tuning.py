"""The parameters with which a contact law comes closest to the exact rebound."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import tan
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.cases import Case, losses_of, motion_of, pair_of
from carom.bodies.checks import with_friction
from carom.bodies.kinematics import approach, slope
from carom.bodies.pairs import Pair
from carom.dem.base import ContactLaw
from carom.dem.damping import damped_restitution
from carom.dem.hard import HardSphere
from carom.dem.springs import (
    HertzLinearHistory,
    LammpsMindlin,
    LinearSpring,
    StrongeLaw,
    WaltonBraunLaw,
)
from carom.dimensionless.law import Law
from carom.dimensionless.numerics.hertz import DURATION
from carom.io.progress import Progress, advancing
from carom.plots.result import card
from carom.quantities.arrays import Array
from carom.quantities.refusals import Faults, known_keywords, one_of, refusal, refuse
from carom.quantities.units import finite, positive
from carom.verify import errors
from carom.verify.entries import CATALOGUE, LawOrFunction, as_law, called, listed
from carom.verify.errors import Impacts, TimeSteps
from carom.verify.tables import text_table

AnyLaw = TypeVar("AnyLaw", bound=Law)

FREE = {  # the parameter that can be chosen, and its range; of a stiffness_ratio in units of kappa
    LinearSpring: ("stiffness_ratio", 0.05, 2.5),
    StrongeLaw: ("stiffness_ratio", 0.05, 2.5),
    HertzLinearHistory: ("stiffness", 0.05, 2.5),
    LammpsMindlin: ("stiffness", 0.05, 2.5),
    WaltonBraunLaw: ("stiffness_ratio", 0.05, 2.5),
    HardSphere: ("tangential_restitution", -1.0, 1.0),
}
TUNED: tuple[Law, ...] = tuple(  # of each kind the first in the catalogue
    entry.law
    for place, entry in enumerate(CATALOGUE)
    if called(entry.law) not in [called(other.law) for other in CATALOGUE[:place]]
)
SCAN_POINTS = 17  # before the best is refined
INCIDENCES = 61
SPEEDS = ("speed", "angle", "normal_speed", "tangential_speed")
DEFAULT_SPEED = 1.0  # m/s: k_n of linear springs depends on it
MEASURES = {"max": errors.largest, "rms": errors.root_mean_square}
COLUMNS = ":<32s parameter:>24s value:8.4f max:7.3f rms:7.3f as~given:9.3f steps:6d cost:7.4f"


class TunedLaw(NamedTuple):
    """A law with the value of its parameter that comes closest, and its largest error, `max_error`.

    `rms_error` is the root mean square; `before` is the largest error of the law as it was given;
    `step` the fewest steps per contact that cost less than a tenth of what remains.
    """

    law: Law
    parameter: str | None
    value: float | None
    max_error: float
    rms_error: float
    before: float
    step: TimeSteps | None

    def to_dict(self) -> dict[str, Any]:
        """Return the law and its errors as what JSON can hold."""
        return {
            "law": called(self.law),
            "parameter": self.parameter,
            "value": self.value,
            "max_error": self.max_error,
            "rms_error": self.rms_error,
            "max_error_before": self.before,
            **errors.steps_record(self.step),
        }


@dataclass(frozen=True)
class Tuning:
    """Laws tuned to come closest to the exact rebound, the best first; made by `tune`.

    `span` holds the first and the last psi_1. Each of `advice` is a law with its tuned parameter,
    the errors in psi_2 before and after, and a time step.

    Examples
    --------
    >>> tuning = carom.verify.tune([carom.dem.HardSphere(), carom.dem.LinearSpring()], chi=1.4412)
    >>> [round(one.max_error, 2) for one in tuning.advice]
    [0.07, 0.3]
    """

    chi: float
    kappa: float
    span: tuple[float, float]
    advice: tuple[TunedLaw, ...]

    def best(self, kind: type[AnyLaw]) -> AnyLaw | None:
        """Return the law of a kind that comes closest, or None if there is none of that kind.

        Parameters
        ----------
        kind : type
            A class of laws, e.g. `carom.dem.LinearSpring`.

        Returns
        -------
        Law or None
            The law, its parameter tuned.

        Examples
        --------
        >>> tuning = carom.verify.tune([carom.dem.HardSphere()], chi=1.4412)
        >>> round(tuning.best(carom.dem.HardSphere).tangential_restitution, 2)
        0.36
        """
        return next((one.law for one in self.advice if isinstance(one.law, kind)), None)

    def _repr_html_(self) -> str:
        rows = {called(one.law): _summary(one) for one in self.advice}
        return card(f"Closest to the exact psi_2 at chi = {self.chi:g}", rows)

    def to_dict(self) -> dict[str, Any]:
        """Return chi, kappa, psi_in (first, last) and laws, a record each, as JSON can hold it."""
        return {
            "chi": self.chi,
            "kappa": self.kappa,
            "psi_in": list(self.span),
            "laws": [one.to_dict() for one in self.advice],
        }

    def __str__(self) -> str:
        rows = [
            (
                *(called(one.law), one.parameter, one.value),
                *(one.max_error, one.rms_error, one.before, *(one.step or (None, None))),
            )
            for one in self.advice
        ]
        return "\n".join(
            [
                f"Laws closest to the exact psi_2 at chi = {self.chi:g}, kappa = {self.kappa:.4g},"
                f" psi_1 from {self.span[0]:g} to {self.span[1]:g}",
                *text_table(COLUMNS, rows),
                "max, rms: error in psi_2 with this value; as given: largest error without tuning",
                "steps: time steps per contact that add less than a tenth of max; cost: the error"
                " that they add; all for e = 1",
            ]
        )


@known_keywords
def tune(
    laws: LawOrFunction | Sequence[LawOrFunction] = TUNED,
    *,
    chi: float,
    kappa: float | None = None,
    psi_1: ArrayLike | None = None,
    measure: str = "max",
    progress: Progress = None,
) -> Tuning:
    """Return the parameters with which contact laws come closest to the exact rebound.

    The largest |psi_2 of the law - psi_2(psi_1, chi)| over the incidences, or its root mean square,
    is minimised, for e = 1. Stiffnesses are varied from 0.05 to 2.5 of those of the bodies, beta_0
    from -1 to 1. Laws without a free parameter are only compared.

    Parameters
    ----------
    laws : Law, callable, or sequence of them
        Contact laws, or functions as of `carom.dem.FunctionLaw`; only the tuned parameter is
        changed.
    chi, kappa : float
        As for `rank`.
    psi_1 : array_like, optional
        Incidences psi_1, by default 60 of them up to 4 chi, beyond which all impacts slide.
    measure : str
        Error to minimise: "max", the largest, or "rms", the root mean square.
    progress : bool or callable, optional
        As for `carom.sweep`; laws are counted.

    Returns
    -------
    Tuning
        `advice` has one item per law, ordered by the minimised error: the tuned `law`, the name of
        the `parameter` and its `value` (None if the law has none), max_error and rms_error in
        psi_2, `before`, the largest error without tuning, and a time `step`.

    Raises
    ------
    InputError
        If a law is none, or a value is out of range.

    Examples
    --------
    >>> best = carom.verify.tune([carom.dem.HertzLinearHistory()], chi=1.4412).advice[0]
    >>> best.parameter, round(best.value, 2), round(best.before, 2), round(best.max_error, 2)
    ('stiffness', 0.7, 0.61, 0.17)
    """
    if psi_1 is None:
        psi_1 = np.linspace(0.0, 4.0 * positive("chi", chi), INCIDENCES)[1:]
    impacts = Impacts.of(psi_1, chi, kappa)
    one_of("measure", measure, MEASURES)
    advice = []
    chosen = listed("laws", laws)
    with advancing("tuning the laws", len(chosen), progress, unit="laws") as advance:
        for law in map(as_law, chosen):
            advice.append(_tuned(law, impacts, measure))
            advance(1)
    remaining = [getattr(one, f"{measure}_error") for one in advice]
    ordered = [advice[i] for i in np.argsort(remaining, kind="stable")]  # NaN last
    span = float(impacts.psi.min()), float(impacts.psi.max())
    return Tuning(impacts.chi, impacts.kappa, span, tuple(ordered))


def _tuned(law: Law, impacts: Impacts, measure: str) -> TunedLaw:
    exact = impacts.exact(impacts.restitution(law))

    def error(candidate: Law) -> Array:
        return impacts.rebound(candidate) - exact

    def cost(candidate: Law) -> float:
        value = MEASURES[measure](error(candidate))
        return value if np.isfinite(value) else np.inf

    name, best = None, law
    if type(law) in FREE:
        name, low, high = FREE[type(law)]
        if name == "stiffness_ratio":
            low, high = impacts.kappa * low, impacts.kappa * high
        best = _closest(law, name, low, high, cost)
    remaining, step = error(best), None
    impacts.refuse_failure(law, remaining)
    max_error, rms_error = errors.largest(remaining), errors.root_mean_square(remaining)
    if isinstance(best, ContactLaw) and max_error > 0.0:
        psi, chi, kappa = impacts
        allowed = max(0.1 * max_error, errors.LEAST_ALLOWED)
        step = errors.advised_steps(best, allowed, psi, chi, kappa=kappa)
    value = None if name is None else float(getattr(best, name) or impacts.kappa)
    before = errors.largest(error(law))
    return TunedLaw(best, name, value, max_error, rms_error, before, step)


def _closest(law: Law, name: str, low: float, high: float, cost: Callable[[Law], float]) -> Law:
    """Return the law with the parameter of least cost: the minima of a scan, refined."""
    from scipy.optimize import minimize_scalar

    def changed(value: float) -> Law:
        return replace(law, **{name: float(value)})

    spaced = np.geomspace if low > 0.0 else np.linspace
    scan = spaced(low, high, SCAN_POINTS)
    costs = [cost(changed(value)) for value in scan]
    minima = [(costs[0], scan[0]), (costs[-1], scan[-1])]
    for i in range(1, SCAN_POINTS - 1):
        if costs[i] <= min(costs[i - 1], costs[i + 1]):
            minimum = minimize_scalar(
                lambda value: cost(changed(value)),
                bounds=(float(scan[i - 1]), float(scan[i + 1])),
                method="bounded",
                options={"xatol": 1e-5},
            )
            minima += [(minimum.fun, minimum.x), (costs[i], scan[i])]
    least, value = min(minima)
    return changed(value) if least < cost(law) else law


def _summary(one: TunedLaw) -> str:
    error = f"|error in psi_2| {one.max_error:.3f}"
    if one.value is None:
        return error
    return f"{one.parameter} {one.value:.4g}: {error}, {one.before:.3f} without tuning"


class Setting(NamedTuple):
    """chi, kappa, incidences and wanted e of a tuning; with bodies also them, V_1 and t_c in SI."""

    chi: float
    kappa: float | None
    psi: Array
    restitution: float = 1.0
    pair: Pair | None = None
    normal_speed: float | None = None
    duration: float | None = None


def setting_of(
    case: Case | None,
    chi: str | None,
    kappa: str | None,
    start: str,
    stop: str | None,
    restitution: str | None,
) -> Setting:
    """Return what a tuning is for, a case with angles or chi with psi_1; e is 1 by default."""
    if case is None:
        return _without_bodies(chi, kappa, start, stop, restitution)
    motion = motion_of(case)
    speeds: dict[str, Any] = {name: motion.get(name) for name in SPEEDS}
    moves = any(value is not None for value in speeds.values())
    with Faults() as faults:
        words = "it follows from the case; leave it out"
        given = ((n, text) for n, text in (("chi", chi), ("kappa", kappa)) if text is not None)
        faults.add(*(str(refusal(name, text, words)) for name, text in given))
        wanted: Any = restitution
        if restitution is None:
            wanted = errors.constant_restitution(faults.trying(losses_of, case)) or 1.0
        e = faults.trying(damped_restitution, "restitution", wanted)
        speed = faults.trying(approach, **speeds)[0] if moves else DEFAULT_SPEED
        first = faults.trying(slope, start)
        end = None if stop is None else faults.trying(slope, stop)
        pair = pair_of(case)
        with_friction(pair, "without friction there is nothing to tune")
    per_slope = pair.kappa / pair.friction  # psi_1 = kappa tan(angle)/mu
    last = 4.0 * pair.chi if end is None else per_slope * tan(end)
    psi = _range(per_slope * tan(first), last, start, stop)
    duration = DURATION * pair.scales(speed).time
    return Setting(pair.chi, pair.kappa, psi, e, pair, speed, duration)


def _without_bodies(
    chi: str | None, kappa: str | None, start: str, stop: str | None, restitution: str | None
) -> Setting:
    with Faults() as faults:
        e = 1.0
        if restitution is not None:
            e = faults.trying(damped_restitution, "restitution", restitution) or 1.0
        if e != 1.0:
            allowed = "it needs a case file, as dampings depend on the bodies"
            faults.add(str(refusal("restitution", restitution, allowed)))
        own = faults.if_given(positive, "kappa", kappa)
        first = faults.trying(finite, "psi_in", start)
        last = faults.if_given(finite, "psi_in", stop)
        if chi is None:
            faults.add("case: missing; give a case file, or --chi, e.g. --chi 1.44")
        ratio = cast(float, faults.if_given(positive, "chi", chi))  # or its lack is told
    return Setting(ratio, own, _range(first, 4.0 * ratio if last is None else last, start, stop))


def _range(first: float, last: float, start: str, stop: str | None) -> Array:
    """Return psi_1 from the first to the last; `start` and `stop` are their texts."""
    refuse(first < 0.0 and refusal("from", start, "must not be negative"))
    if first >= last and stop is None:
        raise refusal(
            "from", start, f"at psi_1 = {first:.4g} the contact slides throughout; give a lower one"
        )
    refuse(first >= last and refusal("to", stop, f"must be above --from, {start}"))
    return np.linspace(first, last, INCIDENCES)[0 if first > 0.0 else 1 :]
