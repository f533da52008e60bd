"""What a sweep computes: a case and its design, every input of a block by name, its outputs."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies import cases
from carom.bodies.cases import FROM_STRENGTH, OF_STRENGTH as LAWS_OF_STRENGTH
from carom.bodies.losses import NO_STRENGTH
from carom.bodies.materials import JUDGED_BY, STRENGTHS
from carom.impacts.histories import spheres
from carom.impacts.outcome import PAIR, RESULTS
from carom.io.labels import attributes, flags
from carom.many.sweeps.designs import Box, Design, Values, chunk_shape, points_in
from carom.many.sweeps.inputs import (
    CODE,
    ELASTIC,
    UNREADABLE,
    input_attributes,
    jsonable,
    leaf,
    refuse_contradictions,
    variable,
)
from carom.many.sweeps.points import WANTED, PointStatus, evaluate, needed_by, needed_strengths
from carom.quantities.refusals import checked_type, hint, one_of, refusal, refuse

OF_STRENGTH = tuple(f"material.{name}" for name in STRENGTHS)
OF_SECOND = {  # what describes a second body of each kind
    "half-space": (*cases.PLATE, *(f"material.{name}" for name in ELASTIC), *OF_STRENGTH),
    "cup": ("radius", "material.young", "material.poisson", *OF_STRENGTH),
    "sphere": (*cases.SIZES, *(f"material.{name}" for name in ELASTIC), *OF_STRENGTH),
}
OPTIONAL = ("gyration_radius", "inner_radius", *cases.PLATE, *OF_STRENGTH)
YIELD = "yield_strength"
AT_REST = {"angle": 0.0, "tangential_speed": 0.0, "spin": 0.0, "spin2": 0.0}


@dataclass(frozen=True, eq=False)
class Common:
    """What the impacts of a design have in common, in SI units, made by `common`."""

    design: Design
    fixed: Mapping[str, float]
    kinds: tuple[str, ...]  # of the second body
    inherits: bool  # whether the second body is made of what the first is
    loss: str | None  # the input that tells the losses of the normal motion
    yields: bool  # whether the yield strengths give the loss
    strengths: tuple[str, ...]  # on which the outputs depend

    def columns(self, inputs: Mapping[str, Any], kind: str) -> dict[str, Any]:
        """Return the inputs of impacts on a body of this kind: numbers, or an array of them."""
        columns: dict[str, Any] = {name: np.float64(v) for name, v in self.fixed.items()}
        for name, values in inputs.items():
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
            values = [
                {**choice.strengths, **choice.values}.get(key, np.nan)
                for choice in self.design._choices[name]
            ]
            numbers[f"{name}.{key}"] = np.array([*values, np.nan])[codes]
        return numbers

    @property
    def numbers(self) -> tuple[str, ...]:
        """Names of the numbers of a material on which the impacts depend."""
        return (*ELASTIC, *self.strengths)

    def tells(self, name: str) -> bool:
        """Tell whether a number of a material is given, for every impact or for some."""
        body = name.partition(".")[0]
        places = [body, *(["first"] if body == "second" and self.inherits else [])]
        inputs = (*self.fixed, *self.design.names)
        return any(
            f"{place}.{name.partition('.')[2]}" in inputs or f"{place}.material" in inputs
            for place in places
        )

    def groups(self, inputs: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
        """Yield the kinds of second bodies, and the points of each."""
        if "second.kind" not in inputs:
            yield self.kinds[0], slice(None)
            return
        for code, kind in enumerate(self.kinds):
            where = np.flatnonzero(inputs["second.kind"] == code)
            if where.size:
                yield kind, where


def common(case: cases.Case, design: Design, strengths: tuple[str, ...] = ()) -> Common:
    """Return what the impacts have in common; `strengths` are those on which outputs depend."""
    cases.check_case(case, losses=True)
    second, names = case.get("second", {}), design.names
    losses = [name for name in cases.LOSSES if name in names or case.get(name) is not None]
    kinds: tuple[str, ...] = (one_of("kind", second.get("kind", cases.KINDS[0]), cases.KINDS),)
    if "second.kind" in names:
        kinds = tuple(choice.label for choice in design._choices["second.kind"])
    inherits = second.get("material") is None and "second.material" not in names
    fixed = {
        n: v for n, v in cases.numbers_of(case).items() if not {n, n.rpartition(".")[0]} & {*names}
    }
    yielding = set(losses) & set(LAWS_OF_STRENGTH)
    yields = bool(yielding - {*names, *fixed})
    if yields or "flow_stress" in yielding:  # which body yields is told by the strengths
        strengths = tuple(dict.fromkeys((YIELD, *strengths)))
    unneeded = {*STRENGTHS, *JUDGED_BY, "roughness"} - set(strengths)
    fixed = {name: value for name, value in fixed.items() if leaf(name) not in unneeded}
    if fixed.get("spin2") == 0.0:  # every body may be without
        del fixed["spin2"]
    plate = "second.thickness" in {*names, *fixed}
    if "sphere" not in kinds and not plate:  # a material may have more than a fixed body needs
        fixed.pop("second.material.density", None)
    alone = "second.width" in {*names, *fixed} and not plate
    refuse(alone and "second.width: is that of a plate; give second.thickness, too")
    cases.refuse_half({*names, *losses, *fixed})
    refuse_contradictions({*names, *losses, *(name for name in fixed if "material" not in name)})
    whole = Common(design, fixed, kinds, inherits, next(iter(losses), None), yields, strengths)
    _refuse_foreign(whole)
    _refuse_missing(whole)
    lossy = "bodies on a plate are elastic so far; leave it or the thickness out"
    refuse(plate and whole.loss is not None and f"{whole.loss}: {lossy}")
    if not any("." in name for name in names):
        cases.pair_of({**case, "friction": 0.0})  # bodies that do not fit are refused at once
    return whole


def _inherit(columns: dict[str, Any], *names: str) -> None:
    for name in names:
        if f"first.{name}" in columns:
            columns.setdefault(f"second.{name}", columns[f"first.{name}"])


def _belongs(name: str, kind: str) -> bool:
    body, _, rest = name.partition(".")
    return rest in OF_SECOND[kind] if body == "second" else name != "spin2" or kind == "sphere"


def _refuse_foreign(whole: Common) -> None:
    names = {*whole.design.names, *whole.fixed} - {"second.kind", "second.material"}
    foreign = {name for name in names if not any(_belongs(name, kind) for kind in whole.kinds)}
    foreign |= {f"first.{name}" for name in cases.SHAPE_NUMBERS} & names
    bodies = " or ".join(whole.kinds)
    refuse(*(f"{name}: a {bodies} has none; leave it out" for name in sorted(foreign)))


def _refuse_missing(whole: Common) -> None:
    first_point = whole.design.inputs(tuple(slice(0, 1) for _ in whole.design.shape))
    for kind in whole.kinds:
        columns = whole.columns(first_point, kind)
        needed = ["friction", "first.radius", *(f"first.material.{name}" for name in ELASTIC)]
        moves = kind == "sphere" or "second.thickness" in columns
        optional = OPTIONAL if moves else (*OPTIONAL, "material.density")
        needed += [f"second.{name}" for name in OF_SECOND[kind] if name not in optional]
        needed += ["normal_speed" if "normal_speed" in columns else "speed"]
        missing = [name for name in needed if name not in columns]
        refuse(
            *(f"{name}: missing; give it in the case or in the design" for name in missing),
            whole.yields and YIELD not in map(leaf, columns) and NO_STRENGTH.format(whole.loss),
        )


OUTPUTS = (
    *("psi_in", "psi_out", "chi", "rebound_speed", "rebound_angle", "tangential_speed_out"),
    *("spin_out", "spin2_out", "tangential_restitution", "contact_restitution"),
    *("dissipated_energy", "duration", "max_force", "max_penetration", "max_radius"),
    "max_pressure",
)
OF_LOSSES = ("normal_restitution", "lost_energy", "shear_lost_energy")
# By what tells the losses: blocks are smaller by so much, as impacts cost more, and take seconds.
COSTLIER = {None: 1, "yield_velocity": 50, "flow_stress": 100, "relaxation_time": 100}
VISCOUS_COST = 16
STRESS_COST = 500  # where the largest stresses are wanted


class VariableInfo(NamedTuple):
    """Type and attributes of a variable of a sweep."""

    dtype: str
    attributes: dict[str, Any]


class SweepProblem:
    """A sweep: what all impacts have in common, in what they differ, and what is wanted of them.

    Arguments and errors as of `carom.sweep`. By default the outputs are `OUTPUTS`, spin2_out only
    if the second body is a sphere, and with losses `OF_LOSSES`.
    """

    def __init__(
        self, case: Mapping[str, Any], design: Design, outputs: Sequence[str] | None = None
    ) -> None:
        checked_type("design", design, Design, "must be a Grid, LatinHypercube or Table")
        checked_type("case", case, Mapping, "must be a mapping like a case file, {'friction': 0.2}")
        wanted = None if outputs is None else checked_outputs(outputs, design.names)
        needed = needed_strengths(wanted or ())
        self.design, self._common = design, common(dict(case), design, needed)
        usual = tuple(n for n in OUTPUTS if n != "spin2_out" or "sphere" in self._common.kinds)
        usual += OF_LOSSES if self.loses else ()
        self.outputs = usual if wanted is None else wanted
        refuse(*self._unknown())

    @property
    def loses(self) -> bool:
        plate = "second.thickness" in {*self.design.names, *self._common.fixed}
        return self._common.loss is not None or plate

    @property
    def bodies(self) -> str:
        """What is struck, in words."""
        return spheres(self.loses)

    def chunks(self) -> tuple[int, ...]:
        """Return the shape of the blocks into which the sweep is cut."""
        searched = any(name in WANTED for name in self.outputs)
        cost = STRESS_COST if searched else COSTLIER.get(self._common.loss, VISCOUS_COST)
        return chunk_shape(self.design.shape, cost)

    def block(self, box: Box, threads: int | None = 1) -> Values:
        """Return outputs, sampled inputs and status of points, whatever the box; else NaN."""
        size, inputs = points_in(box), self.design.inputs(box)
        status = np.full(size, PointStatus.NOT_A_NUMBER, dtype=np.int8)
        outputs = {name: np.full(size, np.nan) for name in self.outputs}
        for kind, where in self._common.groups(inputs):
            part = {name: values[where] for name, values in inputs.items()}
            columns, loss = self._common.columns(part, kind), self._common.loss
            values, status[where] = evaluate(
                columns, kind, loss, status[where].size, self.outputs, threads
            )
            for name in self.outputs:
                outputs[name][where] = values[name]
        return self._laid_out(box, inputs, {**outputs, "status": status})

    def _laid_out(self, box: Box, inputs: Values, results: Values) -> Values:
        """Return results in the shape of a box, with inputs that are no coordinates."""
        shape = tuple(part.stop - part.start for part in box)
        sampled = inputs.items() if self.design._sampled else ()
        whole = {**{variable(name): values for name, values in sampled}, **results}
        return {name: values.reshape(shape) for name, values in whole.items()}

    def variables(self) -> dict[str, VariableInfo]:
        """Return type and attributes of everything that `block` returns."""
        sampled = self.design.names if self.design._sampled else ()
        inputs = {variable(name): self._input_info(name) for name in sampled}
        outputs = {name: VariableInfo("float64", dict(attributes(name))) for name in self.outputs}
        meanings = flags([status.message for status in PointStatus], first=PointStatus.NOT_RUN)
        status = VariableInfo("int8", {"long_name": "what became of the point", **meanings})
        return {**inputs, **outputs, "status": status}

    def description(self) -> dict[str, Any]:
        """Return what tells this sweep from others, as JSON can hold it, in SI units."""
        names = self.design.names
        at_rest = {name: value for name, value in AT_REST.items() if name not in names}
        numbers = jsonable({**at_rest, **self._common.fixed})
        if self._common.yields:
            numbers[str(self._common.loss)] = FROM_STRENGTH
        numbers |= {  # None where not known
            f"{name}.{strength}": [choice.strengths.get(strength) for choice in choices]
            for name, choices in self.design._choices.items()
            if leaf(name) == "material"
            for strength in self._common.strengths
        }
        return {
            "case": dict(sorted(numbers.items())),
            "second": list(self._common.kinds),
            "design": self.design._description(),
            "outputs": list(self.outputs),
        }

    def _unknown(self) -> Iterator[object]:
        """Yield what keeps outputs from being known: losses, rigid bodies, missing strengths."""
        for output in filter(WANTED.__contains__, self.outputs):
            if self.loses:
                allowed = "a sweep with losses or plates does not compute stresses; leave them out"
                yield refusal("outputs", output, allowed)
                continue
            _, body = WANTED[output]
            if self._common.fixed.get(f"{body}.material.young") == inf:
                yield refusal("outputs", output, f"the {body} body is rigid and has no stress")
                continue
            for name in needed_by(output):
                what = f"missing for the {body} body, which {output} needs"
                missing = not self._common.tells(f"{body}.material.{name}")
                yield missing and f"{name}: {what}; give it in its material"

    def _input_info(self, name: str) -> VariableInfo:
        meaning = input_attributes(name, self.design._choices)
        if name not in self.design._choices:
            return VariableInfo("float64", meaning)
        labels = ["unreadable", *(choice.label for choice in self.design._choices[name])]
        return VariableInfo(np.dtype(CODE).name, {**meaning, **flags(labels, first=UNREADABLE)})


def checked_outputs(outputs: Sequence[str], names: Sequence[str]) -> tuple[str, ...]:
    """Return names of results, or raise InputError."""
    results = tuple(dict.fromkeys((*RESULTS, *PAIR, *WANTED)))
    listed = list(outputs) if isinstance(outputs, list | tuple) else []
    allowed = "must be a list of names, e.g. ['rebound_angle']"
    refuse(not listed and refusal("outputs", outputs, allowed))
    for name in listed:
        checked_type("outputs", name, str, "must be the name of a result, e.g. 'rebound_angle'")
    unknown = [name for name in listed if name not in results]
    twice = [name for name in listed if name in names or listed.count(name) > 1]
    shown, near = ", ".join(map(repr, unknown)), dict.fromkeys(hint(n, results) for n in unknown)
    refuse(
        unknown and f"outputs: {shown} cannot be used, as no result is so named; {'; '.join(near)}",
        *(f"outputs: {n!r} is there already, as an input or an output" for n in twice),
    )
    return tuple(listed)
