"""Sweeps of bodies of any shape: each point is an impact of its own, case by case."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from carom.bodies import cases
from carom.bodies.checks import checked_motion
from carom.bodies.kinematics import RigidMotion
from carom.impacts.outcome import PAIR, RESULTS
from carom.impacts.solve import impact
from carom.many.sweeps.designs import Box, Design, Values, chunk_shape, points_in
from carom.many.sweeps.inputs import leaf, refuse_contradictions
from carom.many.sweeps.points import PointStatus
from carom.many.sweeps.problem import OF_LOSSES, OUTPUTS, SweepProblem, checked_outputs
from carom.quantities.refusals import InputError, refusal, refuse

COST = 200  # of an impact, over that of spheres


class ShapeProblem(SweepProblem):
    """A sweep with a body that is no sphere, in a plane of symmetry; see SweepProblem."""

    def __init__(
        self, case: Mapping[str, Any], design: Design, outputs: Sequence[str] | None = None
    ) -> None:
        cases.check_case(case, losses=True)
        self.design, self._case = design, dict(case)
        losses = [n for n in cases.LOSSES if n in design.names or case.get(n) is not None]
        refuse_contradictions({*design.names, *losses})
        usual = tuple(n for n in (*OUTPUTS, *OF_LOSSES) if n != "spin2_out")
        self.outputs = usual if outputs is None else checked_outputs(outputs, design.names)
        searched = [name for name in self.outputs if name not in (*RESULTS, *PAIR)]
        refuse(searched and refusal("outputs", searched[0], "is known of spheres only"))
        first_point = design.inputs(tuple(slice(0, 1) for _ in design.shape))
        moving = self._at(first_point, 0)
        refuse(not cases.pair_of(moving).is_planar and refusal("inertia", "3 x 3", PLANE))

    @property
    def loses(self) -> bool:
        return True

    @property
    def bodies(self) -> str:
        return "bodies of any shape"

    def chunks(self) -> tuple[int, ...]:
        return chunk_shape(self.design.shape, COST)

    def block(self, box: Box, threads: int | None = 1) -> Values:
        inputs = self.design.inputs(box)
        status = np.full(points_in(box), PointStatus.NOT_RUN, dtype=np.int8)
        outputs = {name: np.full(status.size, np.nan) for name in self.outputs}
        for i in range(status.size):
            status[i], numbers = point_of(self._at(inputs, i))
            for name in numbers.keys() & outputs.keys():
                outputs[name][i] = numbers[name]
        return self._laid_out(box, inputs, {**outputs, "status": status})

    def description(self) -> dict[str, Any]:
        of_design = self.design._description()
        return {"case": self._case, "design": of_design, "outputs": list(self.outputs)}

    def _at(self, inputs: Mapping[str, Any], i: int) -> cases.Case:
        """Return the case of a point."""
        tables = {body: dict(self._case.get(body, {})) for body in ("first", "second")}
        case = {**self._case, **tables}
        for name, values in inputs.items():
            choices = self.design._choices.get(name)
            value = choices[values[i]].label if choices else float(values[i])
            body, _, rest = name.partition(".")
            if rest.startswith("material."):
                stuff = tables[body].get("material", {})
                tables[body]["material"] = {**stuff, leaf(name): value}
            else:
                (tables[body] if rest else case)[rest or name] = value
        return case


PLANE = "sweeps take bodies that move in a plane; give one moment of inertia"


def problem_of(
    case: Mapping[str, Any], design: Design, outputs: Sequence[str] | None = None
) -> SweepProblem:
    """Return a sweep of spheres, or of bodies of any shape."""
    shaped = isinstance(case, Mapping) and isinstance(design, Design) and cases.has_shapes(case)
    return (ShapeProblem if shaped else SweepProblem)(case, design, outputs)


def point_of(case: cases.Case) -> tuple[PointStatus, dict[str, float]]:
    """Return what became of a case, and its numbers."""
    try:
        pair, motion = cases.pair_of(case), cases.motion_of(case)
        if not RigidMotion.of(*checked_motion(pair, **motion)).at_contact(pair)[2] > 0.0:
            return PointStatus.NOT_APPROACHING, {}
    except InputError:
        return PointStatus.OUT_OF_RANGE, {}
    try:
        return PointStatus.SOLVED, impact(pair, **motion, losses=cases.losses_of(case)).scalars()
    except InputError:
        return PointStatus.UNRESOLVED, {}
