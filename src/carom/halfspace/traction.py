"""The two problems of contact: pressures that only push, and tractions that friction bounds.

Each knows the other's result. Both are of one kind: among tractions x within bounds, half-lines for
the pressure and discs for the traction, find the one of least (1/2) x.A x - wanted.x, A the
compliance. What is left, wanted - A x, is the pull on each element: a gap that closes, or slip.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from carom.halfspace.compliance import Compliance
from carom.halfspace.transforms import Field, Mask

MOST_ITERATIONS = 200
MOST_INNER = 80  # conjugate gradients within one face
FORCING = 1e-4  # what they leave of the squared residual
FINEST = 0.3  # of what ends the whole
HALVINGS = 30
ENERGY_ROUNDING = 8.0 * np.finfo(np.float64).eps  # of the work that energies are made of
LEAST_DECREASE = 1e-4  # of what the slope promises (Armijo)


class SurfaceLoad(NamedTuple):
    """Tractions, and the displacement that they cause."""

    load: Field
    displacement: Field


class Face(NamedTuple):
    """Directions in which tractions may move, and how the bounds bend there."""

    project: Callable[[Field], Field]
    bend: Field | float


class Operator(NamedTuple):
    """A compliance: its displacements, roughly its inverse, and its diagonal."""

    displacement: Callable[[Field], Field]
    roughly_inverse: Callable[[Field], Field]
    diagonal: float


def minimise(
    operator: Operator, wanted: Field, bounds: "Pushing | Discs", start: Field, tolerance: float
) -> SurfaceLoad:
    """Return the tractions of least energy within the bounds.

    Newton's method projected (Bertsekas 1982, SIAM J. Control Optim. 20:221): preconditioned
    conjugate gradients within the face of tractions that may move, then a search along the path
    that is projected back within the bounds; from the gradient, should Newton's direction not
    descend. It ends where no traction x differs from project(x + pull/diagonal) by more than
    `tolerance` of the largest; raises RuntimeError if that is not reached.
    """
    load = bounds.project(start)
    displacement = operator.displacement(load)
    for _ in range(MOST_ITERATIONS):
        pull = wanted - displacement
        downhill = pull / operator.diagonal
        allowed = tolerance * bounds.largest(load)
        if np.abs(bounds.project(load + downhill) - load).max() <= allowed:
            return SurfaceLoad(load, displacement)
        face = bounds.face(load, pull)
        newton = _newton(operator, face, pull, FINEST * allowed * operator.diagonal)
        change = _search(operator, bounds, load, newton, pull)
        change = change or _search(operator, bounds, load, downhill, pull)
        if change is None:
            raise RuntimeError("no traction of lower energy was found")
        load, displacement = load + change.load, displacement + change.displacement
    raise RuntimeError(f"the tractions did not converge in {MOST_ITERATIONS} iterations")


def _newton(operator: Operator, face: Face, pull: Field, finest: float) -> Field:
    """Return the step to the lowest energy within a face, to first order of its bend."""
    residual, weight = face.project(pull), np.sqrt(1.0 / (1.0 + face.bend / operator.diagonal))

    def scaled(vectors: Field) -> Field:
        return weight * face.project(operator.roughly_inverse(face.project(weight * vectors)))

    step, direction = np.zeros_like(pull), scaled(residual)
    square = first = float(np.sum(residual * direction))
    for _ in range(MOST_INNER):
        if square <= FORCING * first or np.abs(residual).max() <= finest:
            break
        bent = face.project(operator.displacement(direction)) + face.bend * direction
        length = square / float(np.sum(direction * bent))
        step += length * direction
        residual = residual - length * bent
        preconditioned = scaled(residual)
        last, square = square, float(np.sum(residual * preconditioned))
        direction = preconditioned + square / last * direction
    return step


def _search(
    operator: Operator, bounds: "Pushing | Discs", load: Field, direction: Field, pull: Field
) -> SurfaceLoad | None:
    """Return a change along the projected direction that lowers the energy, or None."""
    length, rounding = 1.0, ENERGY_ROUNDING * float(np.sum(np.abs(pull * load)))
    for _ in range(HALVINGS):
        change = bounds.project(load + length * direction) - load
        slope = float(np.sum(pull * change))
        if slope > -rounding:
            displacement = operator.displacement(change)
            bent = 0.5 * float(np.sum(change * displacement))
            if bent <= (1.0 - LEAST_DECREASE) * slope + rounding:
                return SurfaceLoad(change, displacement)
        length *= 0.5
    return None


class Pushing:
    """Pressures cannot pull: p >= 0."""

    def project(self, load: Field) -> Field:
        """Return the pressure without what pulls."""
        return np.maximum(load, 0.0)

    def face(self, load: Field, pull: Field) -> Face:
        """Return the elements that touch or overlap."""
        touching = (load > 0.0) | (pull > 0.0)
        return Face(lambda vectors: np.where(touching, vectors, 0.0), 0.0)

    def largest(self, load: Field) -> float:
        return float(load.max())


def solve_pressure(
    compliance: Compliance, overlap: Field, start: Field, tolerance: float = 1e-6
) -> SurfaceLoad:
    """Return the pressure p >= 0 and its N p: the overlap where p > 0, at least that elsewhere.

    Of the pressures that do not pull it has the least energy (1/2) p.N p - overlap.p (Kalker 1990,
    section 4.2): conjugate gradients on the elements that touch, with pressures that would pull cut
    off and elements that overlap taken in. `overlap` is that of the undeformed bodies.
    """
    if overlap.max() <= 0.0:
        return SurfaceLoad(np.zeros_like(start), np.zeros_like(start))
    operator = Operator(compliance.normal, compliance.roughly_pressure, compliance.normal_diagonal)
    guess = start if start.any() else np.maximum(overlap, 0.0)
    return minimise(operator, overlap, Pushing(), guess, tolerance)


class Discs(NamedTuple):
    """Tractions are at most friction times pressure, in any direction: |q| <= p."""

    bound: Field
    scale: float  # what errors are measured by

    def project(self, load: Field) -> Field:
        """Return the nearest traction with |q| <= p."""
        size = np.hypot(*load)
        return load * (np.minimum(size, self.bound) / np.where(size > 0.0, size, 1.0))

    def face(self, load: Field, pull: Field) -> Face:
        """Return where traction is free, or along the edge of a disc, bent by slip over bound."""
        size = np.hypot(*load)
        unit = load / np.where(size > 0.0, size, 1.0)
        outwards = np.sum(pull * unit, axis=0)
        slips = (size > 0.0) & at_bound(load, self.bound) & (outwards > 0.0)
        sticks = (self.bound > 0.0) & ~slips
        edge = np.where(slips, np.stack([-unit[1], unit[0]]), 0.0)
        bend = np.where(slips, outwards / np.where(slips, self.bound, 1.0), 0.0)

        def project(vectors: Field) -> Field:
            return np.where(sticks, vectors, np.sum(edge * vectors, axis=0) * edge)

        return Face(project, bend)

    def largest(self, load: Field) -> float:
        """Return the scale of the tractions."""
        return self.scale


def at_bound(traction: Field, bound: Field, within: float = 1e-12) -> Mask:
    """Return where a traction is as large as friction allows, within a share of that."""
    return np.asarray(np.hypot(*traction) >= bound * (1.0 - within))


def solve_traction(
    compliance: Compliance, wanted: Field, bound: Field, start: Field, tolerance: float = 1e-6
) -> SurfaceLoad:
    """Return the traction with |q| <= bound that follows a displacement as far as it can.

    Of all such tractions it has the least energy (1/2) q.T q - wanted.q (Kalker 1990, section 4.2):
    where |q| < bound the surfaces give way as wanted, elsewhere wanted - T q is slip along q.
    `tolerance` is a share of the largest bound, or of what would meet the displacement if that is
    less.
    """
    operator = Operator(
        compliance.tangential, compliance.roughly_traction, compliance.tangential_diagonal
    )
    met = float(np.abs(wanted * (bound > 0.0)).max()) / compliance.tangential_diagonal
    bounds = Discs(bound, min(float(bound.max()), met))
    return minimise(operator, wanted, bounds, start, tolerance)
