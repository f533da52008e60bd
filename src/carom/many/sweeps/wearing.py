"""Wear by many impacts of one pair: a mill, a nozzle, a chute, by their angles and speeds."""

from collections.abc import Mapping
from math import nan
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.checks import check_second_spin, checked_pair
from carom.bodies.kinematics import Tangential, by_angle
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.bodies.shapes import Sphere
from carom.dimensionless.lossy.law import checked_law
from carom.impacts.exact import solve_exactly
from carom.impacts.outcome import Outcome, outcome_fits
from carom.impacts.wear import MOST_RADII, PER_LOAD, largest, rubbed, rubbed_at
from carom.io.labels import flags, labelled_dataset
from carom.io.progress import Progress, advancing
from carom.many.sweeps import points
from carom.many.sweeps.points import PointStatus
from carom.quantities.arrays import Array, along_the_same, numbers, together
from carom.quantities.refusals import known_keywords, refusal
from carom.quantities.units import Value, counted, not_negative, positive

if TYPE_CHECKING:
    import xarray as xr

REALS = "give real numbers, one or an array of them"
LARGEST_WORK = 1e250  # in N m; per area it is more
IMPACTS_AT_ONCE = 20_000  # that are solved before progress is said
FEWEST_DISTANCES = 201  # distances at least among which the largest wear of a spot is sought
STATUS = {
    "long_name": "what became of the impact",
    **flags([status.message for status in PointStatus], first=PointStatus.NOT_RUN),
}


class Many(NamedTuple):
    """Impacts of one pair side by side; `rubbed` in N m, `radii` the largest of the contact."""

    columns: dict[str, Array]
    counts: Array
    status: points.Codes
    rubbed: Array
    radii: Array

    @property
    def solved(self) -> Any:
        return self.status == PointStatus.SOLVED

    def part(self, which: slice) -> "Many":
        """Return some of the impacts; what is written there is written here."""
        columns = {name: values[which] for name, values in self.columns.items()}
        counts, status = self.counts[which], self.status[which]
        return Many(columns, counts, status, self.rubbed[which], self.radii[which])

    @property
    def total(self) -> float:
        """What all solved impacts rub, each as often as it happens, in N m; NaN if none is."""
        if self.status.size and not self.solved.any():
            return nan
        return float(self.rubbed[self.solved] @ self.counts[self.solved])


def _read_columns(pair: Pair, motion: dict[str, ArrayLike | None]) -> dict[str, Array]:
    """Return what was given as lines of one length, by name, or raise InputError."""
    others = ("normal_speed", "tangential_speed") if by_angle(motion) else ("speed", "angle")
    used = {name: value for name, value in motion.items() if name not in others}
    columns = {name: 0.0 if value is None else value for name, value in used.items()}
    along_the_same(**columns)
    read = {name: numbers(name, value, REALS, gaps=True) for name, value in columns.items()}
    check_second_spin(pair, columns["spin2"], spins=bool(read["spin2"].any()))
    shape = together(read)
    if not isinstance(pair.second, Sphere):
        del read["spin2"]
    return {name: np.broadcast_to(values, shape).ravel() for name, values in read.items()}


def _motion_of(columns: Mapping[str, Any]) -> tuple[Any, Any]:
    """Return normal speeds and tangential motions."""
    normal, tangential = points.velocities(columns)
    spin2 = columns.get("spin2", np.zeros_like(normal))
    return normal, Tangential(tangential, columns["spin"], spin2)


def _solve_all(
    pair: Pair, columns: dict[str, Array], losses: LossLaw | None, progress: Progress
) -> Many:
    """Return all impacts with what each of them rubs, and a status for each."""
    counts = columns.pop("counts")
    status = np.full(counts.size, PointStatus.NOT_RUN, dtype=np.int8)
    nothing = np.full(counts.size, np.nan)
    many = Many(columns, counts, status, nothing, nothing.copy())
    with advancing("solving the impacts", counts.size, progress, unit="impacts") as advance:
        for start in range(0, counts.size, IMPACTS_AT_ONCE):
            part = slice(start, start + IMPACTS_AT_ONCE)
            with np.errstate(all="ignore"):
                _fill(pair, losses, many.part(part))
            advance(many.status[part].size)
    return many


def _fill(pair: Pair, losses: LossLaw | None, block: Many) -> None:
    """Solve a block of impacts and write what comes of it."""
    normal, motion = _motion_of(block.columns)
    solution = points.BlockSolution.blank(block.counts.size, losses is not None)
    tangential, spin, spin2 = motion
    scales = pair.scales(normal)
    outcome = Outcome(pair, normal, tangential, spin, spin2, solution, scales=scales)
    block.status[:] = _status(block.columns, block.counts, outcome)
    points.solve_block(outcome, losses, block.status, None)
    rubbed_now = np.asarray(rubbed(outcome), dtype=np.float64)
    block.status[block.solved & ~(rubbed_now < LARGEST_WORK)] = PointStatus.BEYOND_FLOATING_POINT
    block.rubbed[block.solved] = rubbed_now[block.solved]
    block.radii[block.solved] = np.asarray(outcome.max_radius)[block.solved]


def _status(columns: Mapping[str, Array], counts: Array, outcome: Outcome) -> points.Codes:
    """Return what is known before solving; of two faults the one that is marked later."""
    status = np.full(counts.size, PointStatus.SOLVED, dtype=np.int8)
    fits = np.broadcast_to(outcome_fits(outcome), status.shape)
    status[~fits] = PointStatus.BEYOND_FLOATING_POINT
    status[~(counts >= 0.0)] = PointStatus.OUT_OF_RANGE
    status[~points.approaches(columns)] = PointStatus.NOT_APPROACHING
    for values in (*columns.values(), counts):
        status[~np.isfinite(values)] = PointStatus.NOT_A_NUMBER
    return status


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
    losses : KelvinVoigt, StandardLinearSolid, Metal or ElasticPlastic, optional
        How the impacts lose energy besides friction.
    n : int
        Number of distances from the centre of the spot, from 2 to 100,000.
    progress : bool or callable, optional
        As for `carom.sweep`; impacts are counted.

    Returns
    -------
    xarray.Dataset
        Along `impact`: the given motion, counts, status (`PointStatus`) and dissipated_energy, the
        work of friction in J of one such impact. As numbers: total_friction_work, and
        unsolved_impacts, which it does not contain; with a coefficient also total_worn_volume; NaN
        if no impact is solved. With an area also spread_friction_work and spread_wear_depth, else
        mean_friction_work and mean_wear_depth along `distance`, means around the centre, and
        max_friction_work and max_wear_depth at the distance max_wear_radius. On one spot an elastic
        impact takes some 2 ms, one with losses 0.2 s and more.

    Raises
    ------
    InputError
        If arrays do not fit each other, or a number is given twice or cannot be read. An impact
        that is out of range or not solved raises nothing; its status says so.

    Examples
    --------
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
    per_load = None if coefficient is None else not_negative("coefficient", coefficient, PER_LOAD)
    spread = None if area is None else positive("area", area)
    if losses is not None and any(map(np.ndim, checked_law(losses)._loss(pair, pair.scales(1.0)))):
        raise refusal("losses", losses, "wear takes one number; carom.sweep takes many")
    motion = {"speed": speed, "angle": angle, "normal_speed": normal_speed}
    motion |= {"tangential_speed": tangential_speed, "spin": spin, "spin2": spin2, "counts": counts}
    many = _solve_all(pair, _read_columns(pair, motion), losses, progress)
    columns = {"friction": pair.friction, **_of_all(many, pair.friction, per_load)}
    coords: dict[str, Any] = {}
    if spread is None:
        distance = np.linspace(0.0, float(many.radii[many.solved].max(initial=0.0)), count)
        coords["distance"] = distance
        columns |= _on_spot(pair, many, losses, distance, per_load, progress)
    else:
        columns |= {"area": spread, "spread_friction_work": pair.friction * many.total / spread}
        columns |= {} if per_load is None else {"spread_wear_depth": per_load * many.total / spread}
    inputs = pair._describe() | ({} if losses is None else {"losses": losses._describe()})
    return labelled_dataset(columns, coords, {"title": "wear by many impacts", "inputs": inputs})


def _of_all(many: Many, friction: float, per_load: float | None) -> dict[str, Any]:
    """Return what was given, and what comes of each impact and of all."""
    inputs = {name: ("impact", values) for name, values in many.columns.items()}
    columns: dict[str, Any] = inputs | {
        "counts": ("impact", many.counts),
        "status": ("impact", many.status, STATUS),
        "dissipated_energy": ("impact", friction * many.rubbed),
        "total_friction_work": friction * many.total,
        "unsolved_impacts": int(np.count_nonzero(~many.solved)),
    }
    if per_load is not None:
        columns["wear_coefficient"] = per_load
        columns["total_worn_volume"] = per_load * many.total
    return columns


def _on_spot(
    pair: Pair,
    many: Many,
    losses: LossLaw | None,
    distance: Array,
    per_load: float | None,
    progress: Progress,
) -> dict[str, Any]:
    """Return what all impacts on one spot rub and wear, at these distances and at the deepest."""
    inner = np.linspace(0.0, distance[-1], FEWEST_DISTANCES)
    radii = np.union1d(distance, inner)
    mean, lateral, (normal, motion) = *np.zeros((2, radii.size)), _motion_of(many.columns)
    which = np.flatnonzero(many.solved & (many.counts > 0.0))
    with advancing("adding up the wear", which.size, progress, unit="impacts") as advance:
        for i in which.tolist():
            before = Tangential(*(float(values[i]) for values in motion))
            scales = pair.scales(float(normal[i]))
            work = rubbed_at(solve_exactly(pair, scales, before, losses), radii)
            mean += many.counts[i] * work[0]
            lateral += many.counts[i] * work[1]
            advance(1)
    at = np.searchsorted(radii, inner)
    most, place = largest(inner, mean[at] + np.abs(lateral[at]))
    around = mean[np.searchsorted(radii, distance)]
    columns: dict[str, Any] = {"max_wear_radius": place}
    for name, factor in (("friction_work", pair.friction), ("wear_depth", per_load)):
        if factor is not None:
            columns[f"mean_{name}"] = ("distance", factor * around)
            columns[f"max_{name}"] = factor * most
    return columns
