"""What friction does to the surfaces in an impact: its work per area, and Archard's depth of wear.

Both come from the integral of pressure times slip rate over the time: times the coefficient of
friction it is the work per area, times the coefficient of wear the depth (Archard 1953).
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.states import Trajectory
from carom.impacts.outcome import Outcome
from carom.impacts.result import ImpactResult
from carom.io.labels import labelled_dataset
from carom.quantities.arrays import Array, places
from carom.quantities.refusals import refusal
from carom.quantities.units import Value, counted, not_negative

if TYPE_CHECKING:
    import xarray as xr

MOST_RADII, PER_LOAD = 100_000, "m^2/N"  # the unit of coefficients of wear
MOST_WEAR = 1.0  # m^2/N; those of materials are below 1e-9
LEAST_RADII = 101  # radii at least among which the largest wear is sought
MAP_POINTS = 101  # points of the map along x and y where none are asked for
FRICTIONLESS = 1e-9  # with less friction nothing of it is felt, and psi_1 may be too large
TRUSTED = 1e-4  # energies that are farther from the work per area are not taken for a volume
SAME_WORK = 1e-6  # by which works per area may differ that are one
FARTHEST = 8.0  # by which a radius grows over a panel of the integral over the contact
ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(16)


class Rubbing(NamedTuple):
    """The integral of pressure times slip rate over an impact, mean - lateral cos 2 theta, in Pa m.

    At rising radii, and over the contact in N m by energies and by radii; `inner` are well apart.
    """

    radii: Array
    mean: Array
    lateral: Array
    inner: Array
    by_energies: float
    summed: float

    @property
    def total(self) -> float:
        """What the energies tell, or the radii where those of viscous bodies are but rounding."""
        return self.by_energies if self.error <= TRUSTED else self.summed

    @property
    def error(self) -> float:
        """How far both integrals over the contact are apart, as a share of the larger."""
        largest = max(abs(self.by_energies), self.summed)
        return abs(self.summed - self.by_energies) / largest if largest else 0.0

    def most(self) -> tuple[float, float]:
        """Return the largest value anywhere in the contact, and its distance from the centre."""
        everywhere = self.mean + np.abs(self.lateral)
        smooth = largest(self.inner, everywhere[np.searchsorted(self.radii, self.inner)])
        i = int(everywhere.argmax())
        return max(smooth, (float(everywhere[i]), float(self.radii[i])))


def largest(radii: Array, values: Array) -> tuple[float, float]:
    """Return the largest of values at rising radii and where it is, by a parabola."""
    i = int(np.argmax(values >= (1.0 - SAME_WORK) * values.max()))  # of like ones the inmost
    if not 0 < i < values.size - 1:
        return float(values[i]), float(radii[i])
    r, level = radii[i], values[i]
    after, before = radii[i + 1] - r, radii[i - 1] - r
    rise, fall = values[i + 1] - level, values[i - 1] - level
    bend = (rise / after - fall / before) / (after - before)
    slope = rise / after - bend * after
    shift = float(np.clip(-0.5 * slope / bend, before, after)) if bend < 0.0 else 0.0
    return float(level + shift * (slope + bend * shift)), float(r + shift)


def wear_of(
    hit: ImpactResult, n: int, coefficient: Value | None, x: ArrayLike | None, y: ArrayLike | None
) -> xr.Dataset:
    """Return the wear of an impact as a dataset; arguments and errors as `Impact.wear`."""
    count = counted("n", n, 2, MOST_RADII)
    per_load = None if coefficient is None else not_negative("coefficient", coefficient, PER_LOAD)
    if per_load is not None and per_load > MOST_WEAR:
        raise refusal("coefficient", coefficient, f"must be at most {MOST_WEAR:g} {PER_LOAD}")

    side = np.linspace(-hit.max_radius, hit.max_radius, MAP_POINTS)
    dims, coords, at = places("xy", {"x": x, "y": y}, {"x": side, "y": side}, None)
    r, angle = np.hypot(at[..., 0], at[..., 1]), 2.0 * np.arctan2(at[..., 1], at[..., 0])
    distance = np.linspace(0.0, hit.max_radius, count)
    worn = rubbing(hit, np.concatenate((distance, r.ravel())))

    def read(values: Array, where: Array) -> Array:
        return values[np.searchsorted(worn.radii, where)]

    mean = read(worn.mean, distance)
    seen = read(worn.mean, r) - read(worn.lateral, r) * np.cos(angle)
    most, place = worn.most()
    variables = {
        "mean_friction_work": ("distance", hit.pair.friction * mean),
        "friction_work": (dims, hit.pair.friction * seen),
        "dissipated_energy": hit.dissipated_energy,
        "work_error": worn.error,
        "max_friction_work": hit.pair.friction * most,
        "max_wear_radius": place,
        "max_radius": hit.max_radius,
        "friction": hit.pair.friction,
    }
    if per_load is not None:
        variables |= {
            "mean_wear_depth": ("distance", per_load * mean),
            "wear_depth": (dims, per_load * seen),
            "max_wear_depth": per_load * most,
            "worn_volume": per_load * worn.total,
            "wear_coefficient": per_load,
        }
    attributes = {"title": "wear of the contact by one impact", "inputs": hit.inputs()}
    return labelled_dataset(variables, {"distance": distance, **coords}, attributes)


def rubbing(hit: ImpactResult, radii: Array) -> Rubbing:
    """Return the integral of pressure times slip rate at radii in m, and at more of them."""
    unit = hit.scales.radius
    nodes, areas = _quadrature(cast(Trajectory, hit.solution))
    inner = np.union1d(nodes * unit, hit.max_radius * np.linspace(0.0, 1.0, LEAST_RADII))
    apart = np.append(np.diff(inner) > SAME_WORK * hit.max_radius, True)
    asked = np.union1d(radii, inner)
    mean, lateral = rubbed_at(hit, asked)
    summed = mean[np.searchsorted(asked, nodes * unit)] @ areas * unit**2
    return Rubbing(asked, mean, lateral, inner[apart], float(rubbed(hit)), float(summed))


def rubbed_at(hit: ImpactResult, radii: Array) -> tuple[Array, Array]:
    """Return the integral of pressure times slip rate at radii in m, mean and lateral, in Pa m."""
    solution, scales = cast(Trajectory, hit.solution), hit.scales
    within = radii / scales.radius
    if hit.pair.friction > FRICTIONLESS:
        work = scales.pressure * scales.tangential_length * solution.friction_work(within)
        return work[:, 0], hit.pair.lateral_ratio * work[:, 1]
    slid = abs(hit.contact_velocity) * scales.time
    return scales.pressure * slid * solution.pressed(within), np.zeros(radii.size)


def rubbed(outcome: Outcome) -> Any:
    """Return the integral of pressure times slip rate, N m; viscous energies are good to 1e-7."""
    if outcome.pair.friction > FRICTIONLESS:
        return np.maximum(outcome.dissipated_energy, 0.0) / outcome.pair.friction
    impulse = outcome.pair.normal_mass * outcome.normal_speed * (1.0 + outcome.normal_restitution)
    return abs(outcome.contact_velocity) * impulse


def _quadrature(solution: Trajectory) -> tuple[Array, Array]:
    """Return radii and the areas for which they stand, by Gauss's rule between the borders."""
    borders = solution._slip_borders()
    cuts = [borders[:1]]
    for low, high in pairwise(borders.tolist()):
        parts = int(np.ceil(np.log(high / low) / np.log(FARTHEST))) if low > 0.0 else 1
        cuts.append(np.geomspace(low, high, parts + 1)[1:] if low > 0.0 else np.array([high]))
    ends = np.concatenate(cuts)
    low, width = ends[:-1, np.newaxis], np.diff(ends)[:, np.newaxis]
    phi = 0.25 * np.pi * (1.0 + ABSCISSAS)
    radii = low + width * np.sin(phi) ** 2
    areas = 2.0 * np.pi * radii * width * 0.25 * np.pi * WEIGHTS * np.sin(2.0 * phi)
    return radii.ravel(), areas.ravel()
