"""Which parameters are varied and which are fixed, read from what a user gives."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from carom.datasets.observables import NORMAL
from carom.fitting.laws import EXACT, OFFSET, half_ratio, ranged
from carom.fitting.model import offset_parameter
from carom.fitting.problem import FitProblem
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, checked_type, clipped, nearest, refusal
from carom.quantities.units import number

NAMES = ("friction", "kappa", "chi", "restitution", OFFSET)
EXAMPLES = {"friction": 0.2, "restitution": 0.98}
FIRST = ("friction", "kappa", "restitution")  # varied unless something else is said


class Options(NamedTuple):
    """Names of free parameters, and the values of all to begin with, or to hold."""

    free: tuple[str, ...]
    start: Mapping[str, float]


def read_options(
    problem: FitProblem, vary: Collection[str] | str | None, fixed: Mapping[str, Any] | None
) -> Options:
    """Return what is varied and what it starts from, or raise InputError."""
    held = _fixed(problem, {} if fixed is None else fixed)
    tells_restitution = problem.is_normal and set(NORMAL) & set(problem.responses)
    first = ("restitution",) if tells_restitution else FIRST
    wanted = [name for name in first if name not in held] if vary is None else _varied(vary)
    for name in wanted:
        if name in held:
            raise InputError(
                f"{name}: it is both varied and fixed; leave it out of vary or of fixed"
            )
    if OFFSET in (*wanted, *held) and not problem.has_speeds:
        raise InputError(
            f"{OFFSET}: it needs speeds in the data; add a column speed or normal_speed"
        )
    if set(wanted) & {"friction", "kappa"} and OFFSET not in wanted and problem.is_normal:
        raise InputError(
            "data: every impact is a normal one, in which friction and stiffness do not matter; "
            "measure at other angles, or fit restitution alone, vary='restitution'"
        )
    if not wanted:
        raise InputError("vary: nothing is left to fit; fix fewer parameters")
    _refuse_assumed(problem, {*wanted, *held})
    pair = problem.pair
    start = {"friction": pair.friction, "kappa": pair.kappa, "restitution": 1.0, OFFSET: 0.0}
    return Options(tuple(wanted), {**start, **held})


def _refuse_assumed(problem: FitProblem, told: Collection[str]) -> None:
    """Raise InputError for a parameter that would be held at a value that nobody has given."""
    measured = [name for name in NORMAL if name in problem.responses]
    why = {"restitution": f"{measured[0]} is in the data" if measured else ""}
    if not problem.knows_friction and not problem.is_normal and {*problem.responses} - {*NORMAL}:
        why["friction"] = "the bodies have none"
    for name, reason in why.items():
        if reason and name not in told:
            example = f"fixed={{'{name}': {EXAMPLES[name]}}}"
            raise InputError(
                f"{name}: {reason}, but it is neither varied nor fixed; add it to vary, or fix it, "
                f"e.g. {example}"
            )


def checked_confidence(value: Any) -> float:
    """Return a confidence, or raise InputError if it is out of range."""
    confidence = number("confidence", value, "1")
    if not 0.5 <= confidence < 1.0:
        raise refusal("confidence", value, "must lie between 0.5 and 1, e.g. 0.95")
    return confidence


def check_count(problem: FitProblem, free: Sequence[str]) -> None:
    """Raise InputError if there are too few values for so many parameters."""
    least = len(free) + (not problem.all_errors_known)
    if problem.count < least:
        values = f"{problem.count} measured value{'s' * (problem.count != 1)}"
        told = f"{len(free)} parameters ({', '.join(free)})" if len(free) > 1 else free[0]
        fewer = ", or fix some, e.g. fixed={'restitution': 0.98}" if len(free) > 1 else ""
        raise InputError(
            f"data: {values} cannot determine {told}; measure more, at least {least}{fewer}"
        )


def _varied(vary: Collection[str] | str) -> list[str]:
    try:
        names = [vary] if isinstance(vary, str) else list(vary)
    except TypeError:
        raise refusal("vary", vary, f"must be names of {', '.join(NAMES)}") from None
    for name in names:
        _check_name("vary", name)
    plain = ["kappa" if name == "chi" else name for name in names]
    return list(dict.fromkeys(plain))


def _fixed(problem: FitProblem, fixed: Mapping[str, Any]) -> dict[str, float]:
    """Return the parameters that are held, in SI units; chi becomes kappa."""
    checked_type("fixed", fixed, Mapping, "must be values by name, e.g. {'restitution': 0.98}")
    ranges = {each.name: ranged(each, problem.pair) for each in EXACT.parameters}
    held: dict[str, float] = {}
    for name, value in fixed.items():
        _check_name("fixed", name)
        found = number(name, value, "rad/s" if name == OFFSET else "1")
        if name == "chi":
            if "kappa" in fixed:
                raise InputError("kappa and chi: each follows from the other; fix one of them")
            name, found = "kappa", found / half_ratio(problem.pair)
        parameter = ranges.get(name) or offset_parameter(problem)
        if not parameter.low <= found <= parameter.high:
            low, high = (GLOSSARY[name].text(end) for end in (parameter.low, parameter.high))
            allowed = f"{name} must lie between {low} and {high}"
            raise refusal(f"fixed {name}", value, allowed)
        held[name] = found
    return held


def _check_name(where: str, name: Any) -> None:
    known = f"parameters are {', '.join(NAMES)}"
    shown = clipped(checked_type(where, name, str, known))
    if name not in NAMES:
        raise InputError(f"{where}: {shown!r} is no parameter; {nearest(shown, NAMES) or known}")
