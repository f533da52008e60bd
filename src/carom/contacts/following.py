"""The contact after each step of a load path, in SI units."""

from collections.abc import Callable
from math import isfinite

import numpy as np

from carom.bodies.pairs import ContactScales, Pair
from carom.contacts.load_steps import Steps
from carom.dimensionless.load_paths import paths, turning
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError, refusal

ROUNDING = 1e-12
BEYOND = "its forces are too large or small for floating point; check the units"


def followed(
    pair: Pair, steps: Steps, advance: Callable[[int], object]
) -> tuple[ContactScales, dict[str, Array]]:
    """Return the scales of a path, and its columns, or raise InputError."""
    scales = _scales(pair, float(steps.penetration.max()))
    with np.errstate(all="ignore"):
        depths, targets, by_force = steps.dimensionless(scales)
        if targets.ndim == 1:
            results, _, refused = paths.follow_path(depths, targets, by_force)
            moved, force, rest = results[:, 0], results[:, 1], results[:, 2:]
        else:
            results, refused = turning.follow_path(depths, targets, by_force, advance)
            moved, force, rest = results[:, :2], results[:, 2:4], results[:, 4:]
        if refused != paths.INSIDE:
            raise _refused(steps, refused, pair.friction)
        energy = scales.tangential_force * scales.tangential_length
        moved, force = steps.as_given(
            moved * scales.tangential_length, force * scales.tangential_force
        )
        columns = {
            "displacement": moved,
            "normal_force": steps.normal_force,
            "tangential_force": force,
            "contact_radius": np.sqrt(np.maximum(depths, 0.0)) * scales.radius,
            "stick_radius": rest[:, 0] * scales.radius,
            "tangential_elastic_energy": rest[:, 1] * energy,
            "frictional_work": rest[:, 2] * energy,
        }
    if not all(np.all(np.isfinite(values)) for values in columns.values()):
        raise refusal("penetration", float(steps.penetration.max()), BEYOND)
    return scales, columns


def _refused(steps: Steps, n: int, friction: float) -> InputError:
    wanted, normal = steps.target[n], float(steps.normal_force[n])
    most = friction * normal
    limit, pressed = text(most, "N"), text(normal, "N")
    allowed = f"step {n}: Coulomb's law allows at most {limit} at F_z = {pressed}"
    if float(np.linalg.norm(wanted)) <= most * (1.0 + ROUNDING):
        allowed += "; near this limit give displacements instead"
    return refusal("tangential_force", wanted.tolist(), allowed)


def _scales(pair: Pair, deepest: float) -> ContactScales:
    """Return the scales of the deepest penetration; of any, where the bodies never touch."""
    try:
        scales = pair.contact_scales(deepest if deepest > 0.0 else pair.effective_radius)
        energy = scales.tangential_force * scales.tangential_length
        values = [scales.length, scales.force, scales.tangential_length, energy]
        fits = all(isfinite(value) and value > 0.0 for value in values)
    except OverflowError:
        fits = False
    if not fits:
        raise refusal("penetration", deepest, BEYOND)
    return scales
