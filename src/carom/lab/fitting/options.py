"""Which parameters of a fit are varied, and which are held, as a user says."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.observables import NORMAL
from carom.dimensionless.elastic.phases import LARGEST_GIVE
from carom.io.remedies import REMEDIES
from carom.lab.fitting import plates
from carom.lab.fitting.intervals import ELASTIC_TAKEN, EXAMPLES
from carom.lab.fitting.model import EXACT, OFFSET, half_ratio, offset_parameter, ranged, suited
from carom.lab.fitting.plates import DURATION, THICKNESS
from carom.lab.fitting.problem import FitProblem
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, checked_type, clipped, nearest, refusal, refuse
from carom.quantities.units import number

NAMES = ("friction", "kappa", "chi", THICKNESS, "restitution", OFFSET)
FIRST = ("friction", "kappa", "restitution")  # varied unless something else is said
WITHOUT_FRICTION = {*NORMAL, DURATION}  # responses that do not depend on it


class Options(NamedTuple):
    """Names of free parameters, and the values of all to begin with, or to hold.

    `taken` notes what is taken for granted: a restitution of 1 that nobody has given.
    """

    free: tuple[str, ...]
    start: Mapping[str, float]
    taken: tuple[str, ...]


def read_options(
    problem: FitProblem, vary: Collection[str] | str | None, fixed: Mapping[str, Any] | None
) -> Options:
    """Return what is varied and what it starts from, or raise InputError."""
    held = _fixed(problem, {} if fixed is None else fixed)
    first = _first(problem)
    unheld = [name for name in first if name not in held]
    wanted = unheld if vary is None else _varied(problem, vary)
    for name in filter(held.__contains__, wanted):
        raise InputError(f"{name}: it is both varied and fixed; leave it out of vary or of fixed")
    if OFFSET in (*wanted, *held) and not problem.has_speeds:
        cure = "add a column speed or normal_speed"
        raise InputError(f"{OFFSET}: it needs speeds in the data; {cure}")
    if set(wanted) & {"friction", "kappa"} and OFFSET not in wanted and problem.is_normal:
        alone = THICKNESS if problem.on_plate else "restitution"
        how = REMEDIES.get().vary.format(name=alone)
        raise InputError(
            "data: every impact is a normal one, in which friction and stiffness do not matter; "
            f"measure at other angles, or fit {alone} alone, {how}"
        )
    if problem.on_plate and THICKNESS not in wanted:
        _refuse_foils(problem, held)
    known = "these impacts on plates of known thickness do not depend on friction"
    cure = known if THICKNESS in problem.before else "fix fewer parameters"
    refuse(not wanted and f"vary: nothing is left to fit; {cure}")
    _refuse_assumed(problem, {*wanted, *held})
    pair = problem.pair
    start = {"friction": pair.friction, "kappa": pair.kappa, OFFSET: 0.0}
    if pair.thickness is None:
        start["restitution"] = 1.0
    elif THICKNESS not in problem.before:
        start[THICKNESS] = pair.thickness
    takes_elastic = "restitution" in {*start} - {*wanted, *held} and not problem.is_normal
    return Options(tuple(wanted), {**start, **held}, (ELASTIC_TAKEN,) * takes_elastic)


def _first(problem: FitProblem) -> tuple[str, ...]:
    """Return what is varied unless something else is said."""
    responses = set(problem.responses)
    known = problem.is_normal and responses & WITHOUT_FRICTION
    if problem.on_plate and (known or responses <= WITHOUT_FRICTION):
        return () if THICKNESS in problem.before else (THICKNESS,)
    if problem.is_normal and set(NORMAL) & responses:
        return ("restitution",)
    return FIRST[:2] if problem.on_plate else FIRST


def _refuse_foils(problem: FitProblem, held: Mapping[str, float]) -> None:
    """Raise InputError for plates of known thickness that give way too far to be solved."""
    speeds, pair = problem.motion.normal_speed, problem.pair
    thickness = problem.before.get(THICKNESS, held.get(THICKNESS, pair.thickness))
    values = {THICKNESS: np.broadcast_to(np.asarray(thickness, dtype=np.float64), speeds.shape)}
    thin = plates.give(pair, speeds, values) > LARGEST_GIVE * (1.0 - 1e-9)
    thin |= values[THICKNESS] <= pair.scales(speeds).length  # type: ignore[arg-type]
    if thin.any():
        plate = GLOSSARY[THICKNESS].text(float(values[THICKNESS][thin].min()))
        raise InputError(
            f"thickness: so thin a plate, {plate}, gives way like a foil (lambda above "
            f"{LARGEST_GIVE:g}) or is pierced in {problem.rows.named(thin)}; leave such rows out, "
            "or vary the thickness"
        )


def _refuse_assumed(problem: FitProblem, named: Collection[str]) -> None:
    """Raise InputError for a parameter that would be held at a value that nobody has given."""
    measured = [] if problem.on_plate else [n for n in NORMAL if n in problem.responses]
    why = {"restitution": f"{measured[0]} is in the data" if measured else ""}
    rubs = not problem.is_normal and {*problem.responses} - WITHOUT_FRICTION
    if rubs and not problem.knows_friction:
        why["friction"] = "the bodies have none"
    for name, reason in why.items():
        if reason and name not in named:
            fix = REMEDIES.get().fix.format(name=name, value=EXAMPLES[name])
            cure = f"add it to vary, or fix it, e.g. {fix}"
            raise InputError(f"{name}: {reason}, but it is neither varied nor fixed; {cure}")


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
        wanted = f"{len(free)} parameters ({', '.join(free)})" if len(free) > 1 else free[0]
        name = next(filter(free.__contains__, EXAMPLES))
        fix = REMEDIES.get().fix.format(name=name, value=EXAMPLES[name])
        fewer = f", or fix some, e.g. {fix}" if len(free) > 1 else ""
        raise InputError(
            f"data: {values} cannot determine {wanted}; measure more, at least {least}{fewer}"
        )


def _varied(problem: FitProblem, vary: Collection[str] | str) -> list[str]:
    names = _listed("vary", vary, NAMES)
    for name in names:
        _check_name("vary", name, problem)
    return list(dict.fromkeys("kappa" if name == "chi" else name for name in names))


def _listed(what: str, names: Any, allowed: Collection[str]) -> list[Any]:
    """Return a name, or several, as a list, or raise InputError if they are none."""
    if isinstance(names, str):
        return [names]
    try:
        return list(names)
    except TypeError:
        raise refusal(what, names, f"must be names of {', '.join(allowed)}") from None


def _fixed(problem: FitProblem, fixed: Mapping[str, Any]) -> dict[str, float]:
    """Return the parameters that are held, in SI units; chi becomes kappa."""
    checked_type("fixed", fixed, Mapping, "must be values by name, e.g. {'restitution': 0.98}")
    law = suited(EXACT, problem)
    held: dict[str, float] = {}
    for name, value in fixed.items():
        _check_name("fixed", name, problem)
        si = number(name, value, GLOSSARY[name].unit)
        if name == "chi":
            if "kappa" in fixed:
                raise InputError("kappa and chi: each follows from the other; fix one of them")
            name, si = "kappa", si / half_ratio(problem.pair)
        own = (ranged(each, problem) for each in law.parameters if each.name == name)
        parameter = next(own, None) or offset_parameter(problem)
        if not parameter.low <= si <= parameter.high:
            low, high = map(GLOSSARY[name].text, parameter[1:3])
            raise refusal(f"fixed {name}", value, f"{name} must lie between {low} and {high}")
        held[name] = si
    return held


def read_shared(share: Collection[str] | str, free: Sequence[Collection[str]]) -> tuple[str, ...]:
    """Return the parameters that sets share, of those free in each, or raise InputError."""
    common = [each for each in free[0] if all(each in own for own in free)]
    names = _listed("share", share, common)
    for name in names:
        if not isinstance(name, str) or name not in common:
            hint = f"all sets vary {', '.join(common) or 'nothing in common'}"
            raise refusal("share", name, f"{hint}; chi is shared with kappa")
    return tuple(dict.fromkeys(names))


def _check_name(where: str, name: Any, problem: FitProblem) -> None:
    there_are = f"parameters are {', '.join(NAMES)}"
    shown = clipped(checked_type(where, name, str, there_are))
    if name not in NAMES:
        near = nearest(shown, NAMES) or there_are
        raise InputError(f"{where}: {shown!r} is no parameter; {near}")
    if name == "restitution" and problem.on_plate:
        follows = "that of a plate follows from its thickness and the speed"
        raise refusal(where, name, f"{follows}; leave it out, or vary thickness")
    if name == THICKNESS and not problem.on_plate:
        start = "HalfSpace(material, thickness='3 mm'), --thickness or second.thickness of a case"
        raise refusal(where, name, f"the wall is thick; give its thickness, to begin with: {start}")
    if name == THICKNESS and THICKNESS in problem.before:
        raise refusal(where, name, "it is a column of the data; leave one of them out")
