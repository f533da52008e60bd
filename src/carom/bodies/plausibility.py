"""Values that hint at a forgotten unit, such as a radius of 5 m instead of 5 mm."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.case_materials import material_values
from carom.bodies.materials import VALUES
from carom.bodies.pairs import OF_BOTH, Pair
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError
from carom.quantities.units import number
from carom.quantities.verdicts import Finding

BODIES = ("first", "second")
SIZES = ("radius", "inner_radius", "gyration_radius")


class Likely(NamedTuple):
    """Between which values a quantity usually lies, and the unit that is forgotten beyond them."""

    least: float
    most: float
    forgotten: str


LIKELY = {
    **dict.fromkeys(SIZES, Likely(0.0, 1.0, "mm")),
    "young": Likely(1e3, 5e12, "GPa"),
    "density": Likely(10.0, 3e4, "g/cm^3"),
    "yield_strength": Likely(1e3, 1e12, "MPa"),
    "tensile_strength": Likely(1e3, 1e12, "MPa"),
    "fracture_toughness": Likely(1e3, 1e10, "MPa m^0.5"),
    "flaw_size": Likely(0.0, 0.01, "um"),
    "hardness": Likely(1e3, 1e12, "GPa"),
    "surface_energy": Likely(0.0, 10.0, "mJ/m^2"),
    "loss_factor": Likely(0.0, 3.0, "%"),
    "friction": Likely(0.0, 5.0, "%"),
    "roughness": Likely(0.0, 1e-3, "um"),
}


def doubts(pair: Pair) -> tuple[Finding, ...]:
    """Return findings on implausible values of a pair of bodies; usually there are none."""
    values: list[tuple[str, float | None]] = [(name, getattr(pair, name)) for name in OF_BOTH]
    for body in (pair.first, pair.second):
        values += [(name, getattr(body, name, None)) for name in SIZES]
        values += [(name, getattr(body.material, name)) for name in VALUES]
    return _doubts(values)


def doubts_of_case(case: Mapping[str, Any]) -> tuple[str, ...]:
    """Return sentences on implausible values of a case; values that cannot be read are left out."""
    return _verdicts(_values(case))


def doubts_of_values(arrays: Iterable[tuple[str, ArrayLike]]) -> tuple[str, ...]:
    """Return sentences on implausible numbers in SI units; of each array the ends are checked."""
    ends: list[tuple[str, float]] = []
    for name, values in arrays:
        numbers = np.ravel(values)
        usable = numbers[(numbers > 0.0) & (numbers < np.inf)]
        ends += [(name, float(end)) for end in (usable.min(), usable.max())] if usable.size else []
    return _verdicts(ends)


def _doubts(values: Iterable[tuple[str, float | None]]) -> tuple[Finding, ...]:
    findings = (_doubt(name, value) for name, value in values)
    return tuple(dict.fromkeys(finding for finding in findings if finding))


def _verdicts(values: Iterable[tuple[str, float]]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(finding.verdict for finding in _doubts(values)))


def _values(case: Mapping[str, Any]) -> Iterator[tuple[str, float]]:
    for name, value in case.items():
        if name in BODIES and isinstance(value, Mapping):
            yield from _values(value)
        with suppress(InputError):
            if name == "material":
                yield from material_values(value).items()
            elif name in LIKELY:
                yield name, number(name, value)


def _doubt(name: str, value: float | None) -> Finding | None:
    likely = LIKELY.get(name)
    if likely is None or value is None or value in (0.0, float("inf")):
        return None
    if likely.least <= value <= likely.most:
        return None
    meaning, unit = GLOSSARY[name].meaning, GLOSSARY[name].unit
    shown = f"{value:g}" if unit == "1" else f"{value:g} {unit}"
    words = f"a {meaning} of {shown}; write '{value:g} {likely.forgotten}'?"
    limit = likely.most if value > likely.most else likely.least
    return Finding(meaning, value, limit, False, words)
