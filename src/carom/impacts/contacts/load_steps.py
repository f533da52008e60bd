"""The steps of a load path: read and checked, and the contact after each of them, in SI units."""

from collections.abc import Callable
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies.pairs import ContactScales, Pair
from carom.dimensionless.load_paths import paths, turning
from carom.quantities.arrays import Array, along_the_same, numbers, refuse_where
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError, refusal, refuse

if TYPE_CHECKING:
    import xarray as xr

Control = ArrayLike | str | None
FORCE_ROUNDING = 1e-12
BEYOND = "its forces are too large or small for floating point; check the units"


class Steps(NamedTuple):
    """Steps of a path: penetrations in m, normal forces in N, targets (n,) or (n, 2) in m or N."""

    penetration: Array
    normal_force: Array
    target: Array
    by_force: NDArray[np.bool_]

    def followed_by(self, more: "Steps") -> "Steps":
        targets = [self.target, more.target]
        if self.target.ndim != more.target.ndim:  # what had one direction goes along x
            targets = [t if t.ndim == 2 else t[:, None] * [1.0, 0.0] for t in targets]
        pairs = zip(self._replace(target=targets[0]), more._replace(target=targets[1]), strict=True)
        columns: list[Any] = [np.concatenate(pair) for pair in pairs]
        return Steps(*columns)

    def first(self, n: int) -> "Steps":
        columns: list[Any] = [column[:n] for column in self]
        return Steps(*columns)

    def dimensionless(self, scales: ContactScales) -> tuple[Array, Array, NDArray[np.bool_]]:
        """Return penetrations d, displacements U or forces Q, and where these are forces."""
        unit = np.where(self.by_force, scales.tangential_force, scales.tangential_length)
        return self.penetration / scales.length, (self.target.T / unit).T, self.by_force

    def as_given(self, moved: Array, force: Array) -> tuple[Array, Array]:
        """Return displacements and tangential forces: those that were given to the bit."""
        by_force = self.by_force.reshape(-1, *[1] * (self.target.ndim - 1))
        return np.where(by_force, moved, self.target), np.where(by_force, self.target, force)


def read_steps(
    pair: Pair, normal: Control, depth: Control, tangential: Control, moved: Control
) -> Steps:
    """Return the steps that the four controls describe, or raise InputError."""
    tangential, moved = _directions_last(tangential), _directions_last(moved)
    along_the_same(tangential_force=tangential)  # each with its directions
    along_the_same(displacement=moved)
    along_the_same(
        normal_force=normal,
        penetration=depth,
        tangential_force=_directions_last(tangential, first=True),
        displacement=_directions_last(moved, first=True),
    )
    across = _one_of(1, normal_force=normal, penetration=depth)
    along = _one_of(2, tangential_force=tangential, displacement=moved)
    sizes = {len(values) for _, values in (across, along) if values.ndim} - {1}
    allowed = f"must have {across[1].size} values as {across[0]}, or a single one"
    if len(sizes) > 1:
        raise refusal(along[0], f"an array of {len(along[1])} values", allowed)
    n = max(sizes, default=1)
    control = np.broadcast_to(across[1], n).copy()
    target = np.broadcast_to(along[1], (n, *along[1].shape[1:])).copy()
    unit = pair.contact_scales(1.0).force
    if across[0] == "penetration":
        with np.errstate(over="ignore"):
            depth, force = control, np.maximum(control, 0.0) ** 1.5 * unit
    else:
        _refuse_steps("normal_force", control, control < 0.0, "must not be negative")
        depth, force = np.cbrt(control / unit) ** 2, control
    return Steps(depth, force, target, np.full(n, along[0] == "tangential_force"))


def _directions_last(control: Control, first: bool = False) -> Control:
    """Return an array of xarray's with its `direction` as the last dimension, or the first one."""
    if "direction" not in getattr(control, "dims", ()):
        return control
    array = cast("xr.DataArray", control)
    return array.isel(direction=0) if first else array.transpose(..., "direction")


def _one_of(most: int, **controls: Control) -> tuple[str, Array]:
    """Return which control is given, in SI units, without a dimension if it is a single number."""
    chosen = {name: value for name, value in controls.items() if value is not None}
    if len(chosen) != 1:
        which = "not both" if chosen else "one of them"
        raise InputError(f"load path: give {' or '.join(controls)}, {which}")
    name, value = next(iter(chosen.items()))
    allowed = "must be one or a list of numbers in SI units, or texts with a unit"
    if most == 2:
        allowed += ", or of shape (n, 2), along x and y"
    values = numbers(name, value, allowed)
    if values.ndim > most or values.size == 0 or (values.ndim == 2 and values.shape[1] != 2):
        raise refusal(name, values, allowed)
    _refuse_steps(name, values, ~np.isfinite(values), "must be finite")
    return name, values


def _refuse_steps(name: str, values: Array, bad: NDArray[np.bool_], allowed: str) -> None:
    step = int(np.argmax(np.atleast_2d(bad.T).any(axis=0)))
    refuse_where(name, values, bad, f"step {step}: it {allowed}")


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
        units = scales.tangential_length, scales.tangential_force
        moved, force = steps.as_given(moved * units[0], force * units[1])
        columns = {
            "displacement": moved,
            "normal_force": steps.normal_force,
            "tangential_force": force,
            "contact_radius": np.sqrt(np.maximum(depths, 0.0)) * scales.radius,
            "stick_radius": rest[:, 0] * scales.radius,
            "tangential_elastic_energy": rest[:, 1] * energy,
            "frictional_work": rest[:, 2] * energy,
        }
    held = all(np.all(np.isfinite(values)) for values in columns.values())
    refuse(not held and refusal("penetration", float(steps.penetration.max()), BEYOND))
    return scales, columns


def _refused(steps: Steps, n: int, friction: float) -> InputError:
    wanted, normal = steps.target[n], float(steps.normal_force[n])
    most = friction * normal
    limit, pressed = text(most, "N"), text(normal, "N")
    allowed = f"step {n}: Coulomb's law allows at most {limit} at F_z = {pressed}"
    if float(np.linalg.norm(wanted)) <= most * (1.0 + FORCE_ROUNDING):
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
    refuse(not fits and refusal("penetration", deepest, BEYOND))
    return scales
