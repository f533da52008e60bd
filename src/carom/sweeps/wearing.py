"""Wear by many impacts of one pair: a mill, a nozzle, a chute, by their angles and speeds."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair, checked_pair
from carom.bodies.shapes import describe
from carom.dimensionless.lossy.law import checked_law
from carom.impacts.exact import solve_exactly
from carom.impacts.wear import MOST_RADII, largest, read_coefficient, rubbed_at
from carom.io.labels import flags, labelled_dataset
from carom.io.progress import Progress, advancing
from carom.quantities.arrays import Array
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import refusal
from carom.quantities.units import Value, counted, positive
from carom.sweeps.points import PointStatus
from carom.sweeps.rubbing import Many, motion_of, read_columns, solve_all

if TYPE_CHECKING:
    import xarray as xr

FINE = 201  # distances at least among which the largest wear of a spot is sought
STATUS = {
    "long_name": "what became of the impact",
    **flags([status.message for status in PointStatus], first=PointStatus.NOT_RUN),
}


@known_keywords
def wear_of_many(
    pair: Pair,
    *,
    speed: ArrayLike | None = None,
    angle: ArrayLike | None = None,
    normal_speed: ArrayLike | None = None,
    tangential_speed: ArrayLike | None = None,
    spin: ArrayLike = 0.0,
    spin2: ArrayLike = 0.0,
    counts: ArrayLike = 1.0,
    coefficient: Value | None = None,
    area: Value | None = None,
    losses: LossLaw | None = None,
    n: int = 201,
    progress: Progress = None,
) -> "xr.Dataset":
    """Add up the wear of many impacts of one pair: spread over an area, or all on one spot.

    The work of friction of each impact is exact (Maw, Barber & Fawcett 1976), and k/mu times it is
    the worn volume (Archard 1953). If the impacts are spread evenly, the depth is volume over area.
    On one spot the depths of all impacts, those of `Impact.wear`, add up around the centre. The
    change in shape of the worn surface is neglected.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    speed, angle : array_like
        Speeds of approach in m/s and angles from the normal in rad, or texts with units.
    normal_speed, tangential_speed : array_like
        Components of the velocity in m/s, instead of speed and angle.
    spin, spin2 : array_like
        Spins before the impacts in rad/s.
    counts : array_like
        How often each impact happens: a number, a share, or a rate; the totals are in its unit.
    coefficient : float or str, optional
        Coefficient of wear k in m^2/N of one body, as in `Impact.wear`.
    area : float or str, optional
        Area in m^2 over which the impacts are spread evenly; without it they all hit one spot.
    losses : KelvinVoigt, StandardLinearSolid or ElasticPlastic, optional
        How the impacts lose energy besides friction.
    n : int
        Number of distances from the centre of the spot, from 2 to 100,000.
    progress : bool or callable, optional
        Whether a progress bar is shown after two seconds, by default in a notebook and on a
        terminal; or a function that is called with the number of impacts done and their total.

    Returns
    -------
    xarray.Dataset
        Along `impact`: the given motion, counts, status (`PointStatus`) and dissipated_energy, the
        work of friction in J of one such impact. As numbers: total_friction_work, and
        unsolved_impacts, the number of impacts that it does not contain; with a coefficient also
        total_worn_volume. Both totals are NaN if no impact is solved. With an area also
        spread_friction_work and spread_wear_depth. Without an area mean_friction_work and
        mean_wear_depth along `distance`, means around the centre, and max_friction_work and
        max_wear_depth at the deepest place, at the distance max_wear_radius. On one spot an elastic
        impact takes some 2 ms, one with losses 0.2 s and more. The work of each viscous impact is
        known to some 1e-7 of its energy.

    Raises
    ------
    InputError
        If arrays do not fit each other, or a number is given twice or cannot be read. An impact
        that is out of range or not solved raises nothing; its status says so.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="2 mm", material="alumina")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> mill = carom.wear_of_many(
    ...     pair, speed="3 m/s", angle=["20 deg", "45 deg", "70 deg"], counts=[5e5, 3e5, 1e5],
    ...     coefficient="1e-13 m^2/N", area="1 cm^2",
    ... )
    >>> f"{float(mill.spread_wear_depth) * 1e9:.1f} nm"
    '219.2 nm'
    """
    checked_pair(pair)
    count = counted("n", n, 2, MOST_RADII)
    per_load = None if coefficient is None else read_coefficient(coefficient)
    spread = None if area is None else positive("area", area)
    _checked(losses, pair)
    motion = {"speed": speed, "angle": angle, "normal_speed": normal_speed}
    motion |= {"tangential_speed": tangential_speed, "spin": spin, "spin2": spin2, "counts": counts}
    many = solve_all(pair, read_columns(pair, motion), losses, progress)
    found = {"friction": pair.friction, **_of_all(many, pair.friction, per_load)}
    coords: dict[str, Any] = {}
    if spread is None:
        distance = _evenly(float(many.radii[many.solved].max(initial=0.0)), count)
        spot = _on_spot(pair, many, losses, distance, progress)
        coords["distance"] = distance
        found |= _of_spot(distance, spot, pair.friction, per_load)
    else:
        found |= {"area": spread, "spread_friction_work": pair.friction * many.total / spread}
        found |= {} if per_load is None else {"spread_wear_depth": per_load * many.total / spread}
    attributes = {"title": "wear by many impacts", "inputs": _inputs(pair, losses)}
    return labelled_dataset(found, coords, attributes)


def _of_all(many: Many, friction: float, per_load: float | None) -> dict[str, Any]:
    """Return what was given, and what comes of each impact and of all."""
    given = {name: ("impact", values) for name, values in many.columns.items()}
    found: dict[str, Any] = given | {
        "counts": ("impact", many.counts),
        "status": ("impact", many.status, STATUS),
        "dissipated_energy": ("impact", friction * many.rubbed),
        "total_friction_work": friction * many.total,
        "unsolved_impacts": int(np.count_nonzero(~many.solved)),
    }
    if per_load is not None:
        found["wear_coefficient"] = per_load
        found["total_worn_volume"] = per_load * many.total
    return found


class Spot(NamedTuple):
    """What impacts on one spot rub at rising distances: mean around the centre, lateral part."""

    radii: Array
    mean: Array
    lateral: Array

    def at(self, distance: Array) -> Array:
        """Return the means at distances that are among the radii."""
        return self.mean[np.searchsorted(self.radii, distance)]

    def most(self) -> tuple[float, float]:
        """Return the largest value anywhere on the spot, and its distance from the centre."""
        inner = _evenly(self.radii[-1], FINE)
        at = np.searchsorted(self.radii, inner)
        return largest(inner, self.mean[at] + np.abs(self.lateral[at]))


def _evenly(end: float, n: int) -> Array:
    return np.linspace(0.0, end, n)


def _on_spot(
    pair: Pair, many: Many, losses: LossLaw | None, distance: Array, progress: Progress
) -> Spot:
    """Return what all impacts on one spot rub, at these distances and at more of them."""
    radii = np.union1d(distance, _evenly(distance[-1], FINE))
    mean, lateral, (normal, motion) = *np.zeros((2, radii.size)), motion_of(many.columns)
    which = np.flatnonzero(many.solved & (many.counts > 0.0))
    with advancing("adding up the wear", which.size, progress, unit="impacts") as advance:
        for i in which.tolist():
            before = Tangential(*(float(values[i]) for values in motion))
            rubbed = rubbed_at(solve_exactly(pair, float(normal[i]), before, losses), radii)
            mean += many.counts[i] * rubbed[0]
            lateral += many.counts[i] * rubbed[1]
            advance(1)
    return Spot(radii, mean, lateral)


def _of_spot(
    distance: Array, spot: Spot, friction: float, per_load: float | None
) -> dict[str, Any]:
    most, place = spot.most()
    found: dict[str, Any] = {"max_wear_radius": place}
    factors = {"friction_work": friction, "wear_depth": per_load}
    for name, factor in factors.items():
        if factor is not None:
            found[f"mean_{name}"] = ("distance", factor * spot.at(distance))
            found[f"max_{name}"] = factor * most
    return found


def _checked(losses: LossLaw | None, pair: Pair) -> None:
    """Raise InputError for losses that many impacts cannot have, before any is solved."""
    if losses is None:
        return
    if any(map(np.ndim, checked_law(losses, "loss")(pair, 1.0))):
        raise refusal("losses", losses, "wear takes one number; carom.sweep takes many")


def _inputs(pair: Pair, losses: LossLaw | None) -> dict[str, Any]:
    bodies = {"first": describe(pair.first), "second": describe(pair.second)}
    law = {} if losses is None else {"losses": losses.describe()}
    return bodies | {"friction": pair.friction} | law
