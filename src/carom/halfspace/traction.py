"""The two problems of contact: pressures that only push, and tractions that friction bounds.

Each knows the other's result; what makes them one kind of problem is in `projected`.
"""

from typing import NamedTuple

import numpy as np

from carom.halfspace.compliance import Compliance
from carom.halfspace.influence import Field, Mask
from carom.halfspace.projected import Face, Operator, SurfaceLoad, minimise


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
        """Return the largest pressure."""
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
        """Return where traction moves freely, sticking, and along the edge of a disc, slipping.

        Along the edge the energy is bent by slip over bound.
        """
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
    compliance: Compliance, given: Field, bound: Field, start: Field, tolerance: float = 1e-6
) -> SurfaceLoad:
    """Return the traction with |q| <= bound that follows a given displacement as far as it can.

    Of all such tractions it has the least energy (1/2) q.T q - given.q (Kalker 1990, section 4.2):
    where |q| < bound the surfaces give way by what is given, elsewhere given - T q is slip along q.
    `tolerance` is a share of the largest bound, or of what would meet the displacement if that is
    less.
    """
    operator = Operator(
        compliance.tangential, compliance.roughly_traction, compliance.tangential_diagonal
    )
    met = float(np.abs(given * (bound > 0.0)).max()) / compliance.tangential_diagonal
    bounds = Discs(bound, min(float(bound.max()), met))
    return minimise(operator, given, bounds, start, tolerance)
