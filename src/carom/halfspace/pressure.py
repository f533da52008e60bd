"""Normal contact: pressure where the bodies touch, a gap elsewhere."""

import numpy as np

from carom.halfspace.compliance import Compliance
from carom.halfspace.influence import Field
from carom.halfspace.projected import Face, Operator, minimise


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
) -> Field:
    """Return the pressure p >= 0 with N p = overlap where p > 0 and N p >= overlap elsewhere.

    Of the pressures that do not pull it has the least energy (1/2) p.N p - overlap.p (Kalker 1990,
    section 4.2): conjugate gradients on the elements that touch, with pressures that would pull cut
    off and elements that overlap taken in. `overlap` is that of the undeformed bodies.
    """
    if overlap.max() <= 0.0:
        return np.zeros_like(start)
    operator = Operator(compliance.normal, compliance.roughly_pressure, compliance.normal_diagonal)
    guess = start if start.any() else np.maximum(overlap, 0.0)
    return minimise(operator, overlap, Pushing(), guess, tolerance).load
