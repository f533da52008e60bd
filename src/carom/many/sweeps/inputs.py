"""Inputs of sweeps: their names, their meaning, and those whose values are names themselves."""

from collections.abc import Iterable, Mapping
from itertools import combinations
from math import isinf
from typing import Any, NamedTuple

import numpy as np

from carom.bodies import cases
from carom.bodies.case_materials import material_values, read_material
from carom.bodies.materials import STRENGTHS
from carom.io.labels import attributes
from carom.quantities.glossary import meant, remark
from carom.quantities.refusals import heading, hint, one_of, refusal, refuse

CODE = np.int8

ELASTIC = ("young", "poisson", "density")
BODIES = ("first", "second")
CHOSEN = ("first.material", "second.material", "second.kind")  # by name, not by number
INPUTS = (
    "friction",
    *cases.MOTION,
    *cases.LOSSES,
    cases.RATIO,
    *(f"{body}.{size}" for body in BODIES for size in cases.SIZES),
    *(f"second.{size}" for size in cases.PLATE),
    *(f"first.{size}" for size in cases.SHAPE_NUMBERS),
    *(f"{body}.material.{value}" for body in BODIES for value in ELASTIC),
    *CHOSEN,
)
EXCLUSIVE = [  # what cannot be given together, and why
    ({"speed", "angle"}, {"normal_speed", "tangential_speed"}, "both tell how the bodies approach"),
    *(({one}, {other}, cases.ONE_LOSS) for one, other in combinations(cases.LOSSES, 2)),
]
for _body in BODIES:
    _values = {f"{_body}.material.{value}" for value in ELASTIC}
    _inertia = ({f"{_body}.gyration_radius"}, {f"{_body}.inner_radius"}, "both give its inertia")
    EXCLUSIVE += [_inertia, ({f"{_body}.material"}, _values, "both tell what it is made of")]
UNREADABLE = -1  # code of a choice
MOST_NAMES = np.iinfo(CODE).max


class Choice(NamedTuple):
    """One of the values of an input that has names: a material with its numbers, or a kind."""

    label: str
    values: dict[str, float]
    strengths: Mapping[str, float] = {}  # of a material, which elastic impacts do not depend on

    def description(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return {"label": self.label, **jsonable(self.values)}


Choices = Mapping[str, tuple[Choice, ...]]


def leaf(name: str) -> str:
    """Return the last part of a name: what the glossary calls it."""
    return name.rpartition(".")[2]


def jsonable(numbers: Mapping[str, float]) -> dict[str, Any]:
    """Return numbers as JSON can hold them."""
    return {name: "inf" if isinf(value) else value for name, value in numbers.items()}


def variable(name: str) -> str:
    """Return how datasets call an input."""
    return name.replace(".", "_")


def input_attributes(name: str, choices: Choices) -> dict[str, Any]:
    """Return unit and meaning of an input for a dataset, or its meaning alone if it has names."""
    body = f" of the {name.partition('.')[0]} body" if "." in name else ""
    if name in choices:
        return {"long_name": f"{leaf(name)}{body}"}
    entry = attributes(leaf(name))
    return entry | {"long_name": f"{entry['long_name']}{body}"}


def checked_names(inputs: Iterable[Any], *, listing: bool = True) -> tuple[str, ...]:
    """Return names of inputs, or raise InputError for unknown ones or contradictions."""
    names = tuple(inputs)
    unknown = [name for name in names if name not in INPUTS]
    refuse(
        not names and "design: no inputs; give at least one, e.g. 'angle'",
        *(_unknown(n, listing and n == unknown[0]) for n in unknown),
    )
    refuse_contradictions(names)
    return names


def _unknown(name: Any, listing: bool) -> str:
    """Return what is wrong with a name, and the inputs that it stands for, the nearest, or all."""
    last, what_to_do = leaf(str(name)), hint(name, INPUTS)
    if stands := meant(last, map(leaf, INPUTS)):
        places = [each for each in INPUTS if leaf(each) == stands]
        half = ", half of it" if "half" in remark(last, stands) else ""
        what_to_do = f"write {' or '.join(places)}{half}"
    whole = f"{heading(str(name))}: not an input of an impact; {what_to_do}"
    return whole if listing else whole.partition("; known names are")[0]


def refuse_contradictions(names: Iterable[str]) -> None:
    """Raise InputError if one thing is given in two ways."""
    there = set(names)
    for some, others, why in EXCLUSIVE:
        one, other = sorted(there & some), sorted(there & others)
        refuse(one and other and f"{one[0]}: give it or {other[0]}, not both; {why}")


def read_choices(name: str, values: Any) -> tuple[Choice, ...]:
    """Return the choices of an input that has names, or raise InputError."""
    plain = np.atleast_1d(values).tolist() if isinstance(values, np.ndarray) else values
    listed = plain if isinstance(plain, list | tuple) else [plain]
    return checked_choices(name, [read_choice(name, value) for value in listed])


def checked_choices(name: str, choices: list[Choice]) -> tuple[Choice, ...]:
    """Return choices, or raise InputError if there are none, too many, or some are alike."""
    labels, count = [choice.label for choice in choices], len(choices)
    twice = dict.fromkeys(label for label in labels if labels.count(label) > 1)
    refuse(
        not 0 < count <= MOST_NAMES and refusal(name, f"{count} names", f"give 1 to {MOST_NAMES}"),
        *(refusal(name, label, "it is given twice; names must differ") for label in twice),
    )
    return tuple(choices)


def read_choice(name: str, value: Any) -> Choice:
    """Return a choice, or raise InputError if there is none of that name."""
    if leaf(name) == "kind":
        return Choice(one_of("kind", value, cases.KINDS), {})
    stuff = read_material(value)
    values = material_values(stuff)
    elastic = {key: number for key, number in values.items() if key in ELASTIC}
    unnamed = ", ".join(f"{key}={number:g}" for key, number in elastic.items())
    label = value if isinstance(value, str) else stuff.name or unnamed
    strengths = {key: number for key, number in values.items() if key in STRENGTHS}
    return Choice(label, elastic, strengths)
