"""Wear by many impacts of one pair: a mill, a nozzle, a chute, by their angles and speeds."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.kinematics import Tangential
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.bodies.shapes import describe
from carom.impacts.exact import solve_exactly
from carom.impacts.wear import MOST_RADII, read_coefficient, rubbed_at
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

STATUS = {
    "long_name": "what became of the impact",
    **flags([status.message for status in PointStatus], first=PointStatus.NOT_RUN),
}


@known_keywords
def wear(
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

    The work of friction of each impact, exactly (Maw, Barber & Fawcett 1976); the volume k/mu times
    that (Archard 1953). Spread evenly, volume over area is the depth; on one spot the depths of all
    impacts add up around the centre, as `Impact.wear` has them. That the surface changes its shape
    is left out.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    speed, angle : array_like
        Speeds of approach in m/s and angles from the normal in rad, or texts with units.
    normal_speed, tangential_speed : array_like
        The same as components, instead of speed and angle.
    spin, spin2 : array_like
        Spins before in rad/s.
    counts : array_like
        How often each impact happens: a number, a share, or a rate; the totals are in its unit.
    coefficient : float or str, optional
        Coefficient of wear k in m^2/N of the body whose wear is asked for, as in `Impact.wear`.
    area : float or str, optional
        Area in m^2 over which the impacts are spread evenly; without it they all hit one spot.
    losses : KelvinVoigt, StandardLinearSolid or ElasticPlastic, optional
        What the impacts lose energy to; on one spot KelvinVoigt alone.
    n : int
        How many distances from the centre of the spot, from 2 to 100,000.
    progress : bool or callable, optional
        Whether a bar is shown after two seconds, by default in a notebook and on a terminal; or
        what is called with the impacts done and their number.

    Returns
    -------
    xarray.Dataset
        Along `impact` what was given, counts, status (`PointStatus`) and dissipated_energy, the
        work of friction in J of one such impact; as numbers total_friction_work, the
        unsolved_impacts that are left out of it, and with a coefficient total_worn_volume. With an
        area spread_friction_work and spread_wear_depth, without it mean_friction_work and
        mean_wear_depth along `distance`, their largest values and max_wear_radius.

    Raises
    ------
    InputError
        If arrays do not fit each other, a number is given twice or cannot be read, or the losses
        are those of a solid whose contact is not known over its area. An impact that is out of
        range or not solved raises nothing; its status says so.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="2 mm", material="alumina")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> mill = carom.wear(
    ...     pair, speed="3 m/s", angle=["20 deg", "45 deg", "70 deg"], counts=[5e5, 3e5, 1e5],
    ...     coefficient="1e-13 m^2/N", area="1 cm^2",
    ... )
    >>> f"{float(mill.spread_wear_depth) * 1e9:.1f} nm"
    '219.2 nm'
    """
    if not isinstance(pair, Pair):
        raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
    count = counted("n", n, 2, MOST_RADII)
    per_load = None if coefficient is None else read_coefficient(coefficient)
    spread = None if area is None else positive("area", area)
    motion = {"speed": speed, "angle": angle, "normal_speed": normal_speed}
    motion |= {"tangential_speed": tangential_speed, "spin": spin, "spin2": spin2, "counts": counts}
    many = solve_all(pair, read_columns(pair, motion), losses, progress)
    found = {"friction": pair.friction, **_of_all(many, pair.friction, per_load)}
    coords: dict[str, Any] = {}
    if spread is None:
        coords["distance"], summed = _on_spot(pair, many, losses, count, progress)
        found |= _of_spot(coords["distance"], summed, pair.friction, per_load)
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


def _on_spot(
    pair: Pair, many: Many, losses: LossLaw | None, n: int, progress: Progress
) -> tuple[Array, Array]:
    """Return distances from the centre of one spot, and what all impacts on it rub there."""
    radii = np.linspace(0.0, float(many.radii[many.solved].max(initial=0.0)), n)
    summed, (normal, motion) = np.zeros(n), motion_of(many.columns)
    which = np.flatnonzero(many.solved & (many.counts > 0.0))
    with advancing("wear around the centre", which.size, progress, unit="impacts") as advance:
        for i in which.tolist():
            before = Tangential(*(float(values[i]) for values in motion))
            hit = solve_exactly(pair, float(normal[i]), before, losses)
            summed += many.counts[i] * rubbed_at(hit, radii)[0]
            advance(1)
    return radii, summed


def _of_spot(
    radii: Array, summed: Array, friction: float, per_load: float | None
) -> dict[str, Any]:
    most = int(summed.argmax())
    found: dict[str, Any] = {"max_wear_radius": radii[most]}
    factors = {"friction_work": friction, "wear_depth": per_load}
    for name, factor in factors.items():
        if factor is not None:
            found[f"mean_{name}"] = ("distance", factor * summed)
            found[f"max_{name}"] = factor * summed[most]
    return found


def _inputs(pair: Pair, losses: LossLaw | None) -> dict[str, Any]:
    bodies = {"first": describe(pair.first), "second": describe(pair.second)}
    law = {} if losses is None else {"losses": losses.describe()}
    return bodies | {"friction": pair.friction} | law
