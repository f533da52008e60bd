"""What a sweep computes: a case, its design, its outputs; any block of it, alone."""

from collections.abc import Mapping, Sequence
from math import inf, prod
from typing import Any, NamedTuple

import numpy as np

from carom.bodies.cases import FROM_STRENGTH
from carom.impacts.history import PAIR, RESULTS
from carom.io.labels import attributes, flags
from carom.quantities.refusals import InputError, hint, refusal
from carom.sweeps.blocks import Box, Values, chunk_shape
from carom.sweeps.columns import AT_REST, common
from carom.sweeps.designs import Design
from carom.sweeps.inputs import CODE, UNREADABLE, input_attributes, jsonable, leaf, variable
from carom.sweeps.points import PointStatus, evaluate
from carom.sweeps.strength import WANTED, needed_by, needed_strengths

OUTPUTS = (
    "psi_in",
    "psi_out",
    "chi",
    "rebound_speed",
    "rebound_angle",
    "tangential_speed_out",
    "spin_out",
    "spin2_out",
    "tangential_restitution",
    "contact_restitution",
    "dissipated_energy",
    "duration",
    "max_force",
    "max_penetration",
    "max_radius",
    "max_pressure",
)
OF_LOSSES = ("normal_restitution", "lost_energy", "shear_lost_energy")
# By what tells the losses: blocks are smaller by so much, as impacts cost more, and take seconds.
COSTLIER = {None: 1, "yield_velocity": 50, "relaxation_time": 100}
VISCOUS = 16
SEARCHED = 500  # where the largest stresses are wanted


class VariableInfo(NamedTuple):
    """Type and attributes of a variable of a sweep."""

    dtype: str
    attributes: dict[str, Any]


class SweepProblem:
    """A sweep: what all impacts have in common, in what they differ, and what is wanted of them.

    Parameters
    ----------
    case : mapping
        As a case file: friction, speeds, spins, first and second; what the design gives takes the
        place of what stands here.
    design : Grid, LatinHypercube or Table
        In what the impacts differ.
    outputs : sequence of str, optional
        Names of results of an impact or of quantities of its pair; by default `OUTPUTS`, spin2_out
        only if the second body is a sphere, and with losses `OF_LOSSES`.

    Raises
    ------
    InputError
        If the case or an output is not known, something is missing or given in two ways.

    Examples
    --------
    >>> import carom
    >>> from carom.sweeps.problem import SweepProblem
    >>> case = {"friction": 0.2, "speed": 2.0, "first": {"radius": "5 mm", "material": "steel"}}
    >>> grid = carom.Grid({"angle": ["20 deg", "40 deg", "100 deg"]})
    >>> problem = SweepProblem(case, grid, ["psi_out"])
    >>> found = problem.block((slice(0, 3),))
    >>> found["psi_out"].round(4).tolist()
    [-0.4269, -1.4738, nan]
    >>> [carom.status.PointStatus(status).message for status in found["status"]]
    ['solved', 'solved', 'bodies do not approach']
    """

    def __init__(
        self, case: Mapping[str, Any], design: Design, outputs: Sequence[str] | None = None
    ) -> None:
        if not isinstance(design, Design):
            raise refusal("design", design, "must be a Grid, LatinHypercube or Table")
        if not isinstance(case, Mapping):
            raise refusal("case", case, "must be a mapping like a case file, {'friction': 0.2}")
        wanted = None if outputs is None else _checked(outputs, design.names)
        needed = needed_strengths(wanted or ())
        self.design, self._common = design, common(dict(case), design, needed)
        usual = tuple(n for n in OUTPUTS if n != "spin2_out" or "sphere" in self._common.kinds)
        usual += OF_LOSSES if self.loses else ()
        self.outputs = usual if wanted is None else wanted
        self._refuse_unknown()

    @property
    def loses(self) -> bool:
        """Whether energy is lost but to friction."""
        return self._common.loss is not None

    def chunks(self) -> tuple[int, ...]:
        """Return the shape of the blocks into which the sweep is cut."""
        searched = any(name in WANTED for name in self.outputs)
        cost = SEARCHED if searched else COSTLIER.get(self._common.loss, VISCOUS)
        return chunk_shape(self.design.shape, cost)

    def block(self, box: Box, threads: int | None = 1) -> Values:
        """Return the outputs, sampled inputs and status of a box of points, in its shape.

        The numbers of a point do not depend on the box. NaN where the status is not SOLVED.
        """
        shape = tuple(part.stop - part.start for part in box)
        size, given = prod(shape), self.design.inputs(box)
        status = np.full(size, PointStatus.NOT_A_NUMBER, dtype=np.int8)
        found = {name: np.full(size, np.nan) for name in self.outputs}
        for kind, where in self._common.groups(given):
            part = {name: values[where] for name, values in given.items()}
            columns, loss = self._common.columns(part, kind), self._common.loss
            values, status[where] = evaluate(
                columns, kind, loss, status[where].size, self.outputs, threads
            )
            for name in self.outputs:
                found[name][where] = values[name]
        inputs = {variable(name): given[name] for name in given} if self.design.sampled else {}
        whole = {**inputs, **found, "status": status}
        return {name: values.reshape(shape) for name, values in whole.items()}

    def variables(self) -> dict[str, VariableInfo]:
        """Return type and attributes of everything that `block` returns."""
        sampled = self.design.names if self.design.sampled else ()
        inputs = {variable(name): self._input_info(name) for name in sampled}
        found = {name: VariableInfo("float64", dict(attributes(name))) for name in self.outputs}
        meanings = flags([status.message for status in PointStatus], first=PointStatus.NOT_RUN)
        status = VariableInfo("int8", {"long_name": "what became of the point", **meanings})
        return {**inputs, **found, "status": status}

    def description(self) -> dict[str, Any]:
        """Return what tells this sweep from others, as JSON can hold it, in SI units."""
        names = self.design.names
        at_rest = {name: value for name, value in AT_REST.items() if name not in names}
        numbers = jsonable({**at_rest, **self._common.fixed})
        if self._common.yields:
            numbers["yield_velocity"] = FROM_STRENGTH
        numbers |= self._strengths()
        return {
            "case": dict(sorted(numbers.items())),
            "second": list(self._common.kinds),
            "design": self.design.description(),
            "outputs": list(self.outputs),
        }

    def _strengths(self) -> dict[str, Any]:
        """Return the strengths of the materials that are inputs, None where not known."""
        return {
            f"{name}.{strength}": [choice.strengths.get(strength) for choice in choices]
            for name, choices in self.design.choices.items()
            if leaf(name) == "material"
            for strength in self._common.strengths
        }

    def _refuse_unknown(self) -> None:
        """Raise InputError if outputs need strengths that nothing tells, or losses do without."""
        for output in self.outputs:
            if output not in WANTED:
                continue
            if self.loses:
                allowed = "a sweep with losses does not compute stresses; leave them out"
                raise refusal("outputs", output, allowed)
            body = WANTED[output].body
            if self._common.fixed.get(f"{body}.material.young") == inf:
                raise refusal("outputs", output, f"the {body} body is rigid and has no stress")
            for name in needed_by(output):
                if not self._common.tells(f"{body}.material.{name}"):
                    raise InputError(
                        f"{name}: missing for the {body} body, which {output} needs; give it in "
                        "its material"
                    )

    def _input_info(self, name: str) -> VariableInfo:
        known = input_attributes(name, self.design.choices)
        if name not in self.design.choices:
            return VariableInfo("float64", known)
        labels = ["unreadable", *(choice.label for choice in self.design.choices[name])]
        return VariableInfo(np.dtype(CODE).name, {**known, **flags(labels, first=UNREADABLE)})


def _checked(outputs: Sequence[str], names: Sequence[str]) -> tuple[str, ...]:
    known = tuple(dict.fromkeys((*RESULTS, *PAIR, *WANTED)))
    if not isinstance(outputs, list | tuple) or not outputs:
        raise refusal("outputs", outputs, "must be a list of names, e.g. ['rebound_angle']")
    for name in outputs:
        if not isinstance(name, str):
            raise refusal("outputs", name, "must be the name of a result, e.g. 'rebound_angle'")
        if name not in known:
            raise InputError(f"outputs: {name!r} is not a result of an impact; {hint(name, known)}")
        if name in names or list(outputs).count(name) > 1:
            raise InputError(f"outputs: {name!r} is there already, as an input or an output")
    return tuple(outputs)
