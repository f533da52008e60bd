"""Every input of a block of impacts by name: what a case says and what a design gives, together."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import cases
from carom.bodies.materials import STRENGTHS
from carom.quantities.refusals import InputError
from carom.quantities.units import not_negative
from carom.sweeps.designs import Design
from carom.sweeps.inputs import BODIES, ELASTIC, leaf, refuse_contradictions

OF_STRENGTH = tuple(f"material.{name}" for name in STRENGTHS)
OF_SECOND = {  # what describes a second body of each kind
    "half-space": ("material.young", "material.poisson", *OF_STRENGTH),
    "cup": ("radius", "material.young", "material.poisson", *OF_STRENGTH),
    "sphere": (*cases.SIZES, *(f"material.{name}" for name in ELASTIC), *OF_STRENGTH),
}
OPTIONAL = ("gyration_radius", "inner_radius", *OF_STRENGTH)
YIELD = "yield_strength"
AT_REST = {"angle": 0.0, "tangential_speed": 0.0, "spin": 0.0, "spin2": 0.0}


@dataclass(frozen=True, eq=False)
class Common:
    """What the impacts of a design have in common, in SI units, made by `common`.

    `kinds` are those of the second body, `inherits` whether it is made of what the first is; `loss`
    is what the normal motion loses energy to, if it does, and `yields` whether the yield velocity
    is that of the yield strengths; `strengths` are those on which the outputs depend.
    """

    design: Design
    fixed: Mapping[str, float]
    kinds: tuple[str, ...]
    inherits: bool
    loss: str | None
    yields: bool
    strengths: tuple[str, ...]

    def columns(self, given: Mapping[str, Any], kind: str) -> dict[str, Any]:
        """Return the inputs of impacts on a body of this kind: numbers, or an array of them."""
        columns: dict[str, Any] = {name: np.float64(v) for name, v in self.fixed.items()}
        for name, values in given.items():
            if leaf(name) == "material":
                columns |= self._taken_apart(name, values)
            elif leaf(name) != "kind":
                columns[name] = values
        if kind == "sphere":
            _inherit(columns, "radius")
        if self.inherits:
            _inherit(columns, *(f"material.{name}" for name in self.numbers))
        return {**AT_REST, **{n: v for n, v in columns.items() if _belongs(n, kind)}}

    def _taken_apart(self, name: str, codes: NDArray[Any]) -> dict[str, NDArray[np.float64]]:
        """Return the numbers of materials that are given by name; the last code, -1, has none."""
        numbers = {}
        for key in self.numbers:
            known = [
                {**choice.strengths, **choice.values}.get(key, np.nan)
                for choice in self.design.choices[name]
            ]
            numbers[f"{name}.{key}"] = np.array([*known, np.nan])[codes]
        return numbers

    @property
    def numbers(self) -> tuple[str, ...]:
        """Names of the numbers of a material on which the impacts depend."""
        return (*ELASTIC, *self.strengths)

    def tells(self, name: str) -> bool:
        """Tell whether a number of a material is given, for every impact or for some."""
        body = name.partition(".")[0]
        places = [body, *(["first"] if body == "second" and self.inherits else [])]
        given = (*self.fixed, *self.design.names)
        return any(
            f"{place}.{name.partition('.')[2]}" in given or f"{place}.material" in given
            for place in places
        )

    def groups(self, given: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """Yield the kinds of second bodies, and the points of each."""
        if "second.kind" not in given:
            yield self.kinds[0], slice(None)
            return
        for code, kind in enumerate(self.kinds):
            where = np.flatnonzero(given["second.kind"] == code)
            if where.size:
                yield kind, where


def common(case: cases.Case, design: Design, strengths: tuple[str, ...] = ()) -> Common:
    """Return what the impacts have in common; `strengths` are those on which outputs depend.

    Raises InputError if case and design do not give everything that an impact needs, or something
    in two ways, or what the second body does not have.
    """
    cases.check_case(case, losses=True)
    second, names = case.get("second", {}), design.names
    losses = [name for name in cases.LOSSES if name in names or case.get(name) is not None]
    kinds: tuple[str, ...] = (cases.as_kind(second.get("kind", cases.KINDS[0])),)
    if "second.kind" in names:
        kinds = tuple(choice.label for choice in design.choices["second.kind"])
    inherits = second.get("material") is None and "second.material" not in names
    fixed = {name: value for name, value in _numbers(case) if not _replaced(name, names)}
    yields = "yield_velocity" in losses and "yield_velocity" not in (*names, *fixed)
    if yields:
        strengths = tuple(dict.fromkeys((YIELD, *strengths)))
    unneeded = set(STRENGTHS) - set(strengths)
    fixed = {name: value for name, value in fixed.items() if leaf(name) not in unneeded}
    if fixed.get("spin2") == 0.0:  # every body may be without
        del fixed["spin2"]
    if "sphere" not in kinds:  # a material may have more than a fixed body needs
        fixed.pop("second.material.density", None)
    cases.refuse_half({*names, *losses, *fixed})
    refuse_contradictions({*names, *losses, *(name for name in fixed if "material" not in name)})
    whole = Common(design, fixed, kinds, inherits, next(iter(losses), None), yields, strengths)
    _refuse_foreign(whole)
    _refuse_missing(whole)
    if not any("." in name for name in names):
        cases.pair_of({**case, "friction": 0.0})  # bodies that do not fit are refused at once
    return whole


def _numbers(case: cases.Case) -> Iterator[tuple[str, float]]:
    """Yield the numbers of a case by name, each of them checked."""
    for name, check in {"friction": not_negative, **cases.MOTION}.items():
        if case.get(name) is not None:
            yield name, check(name, case[name])
    for name in cases.LOSSES:
        if case.get(name) is not None and (value := cases.read_loss(name, case[name])) is not None:
            yield name, value
    if case.get(cases.RATIO) is not None:
        yield cases.RATIO, cases.read_ratio(case[cases.RATIO])
    for body in BODIES:
        table = case.get(body, {})
        for name, check in cases.SIZES.items():
            if table.get(name) is not None:
                yield f"{body}.{name}", check(name, table[name])
        if table.get("material") is not None:
            for name, value in cases.material_values(table["material"]).items():
                yield f"{body}.material.{name}", value


def _replaced(name: str, names: tuple[str, ...]) -> bool:
    """Whether a design gives this number, or the material that it is of."""
    return name in names or (".material." in name and name.rpartition(".")[0] in names)


def _inherit(columns: dict[str, Any], *names: str) -> None:
    for name in names:
        if f"first.{name}" in columns:
            columns.setdefault(f"second.{name}", columns[f"first.{name}"])


def _belongs(name: str, kind: str) -> bool:
    body, _, rest = name.partition(".")
    return rest in OF_SECOND[kind] if body == "second" else name != "spin2" or kind == "sphere"


def _refuse_foreign(whole: Common) -> None:
    for name in (*whole.design.names, *whole.fixed):
        chosen = name in ("second.kind", "second.material")
        if not (chosen or any(_belongs(name, kind) for kind in whole.kinds)):
            raise InputError(f"{name}: a {' or '.join(whole.kinds)} has none; leave it out")


def _refuse_missing(whole: Common) -> None:
    given = whole.design.inputs(tuple(slice(0, 1) for _ in whole.design.shape))
    for kind in whole.kinds:
        columns = whole.columns(given, kind)
        needed = ["friction", "first.radius", *(f"first.material.{name}" for name in ELASTIC)]
        needed += [f"second.{name}" for name in OF_SECOND[kind] if name not in OPTIONAL]
        needed += ["normal_speed" if "normal_speed" in columns else "speed"]
        for name in needed:
            if name not in columns:
                raise InputError(f"{name}: missing; give it in the case or in the design")
        if whole.yields and not any(leaf(name) == YIELD for name in columns):
            raise InputError("yield_velocity: missing; give it, or a yield_strength of a material")
