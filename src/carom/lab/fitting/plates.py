"""Rebounds from a plate: what follows from its thickness and the speed, and where theory ends."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from carom.bodies.pairs import Pair
from carom.bodies.shapes import HalfSpace
from carom.dimensionless.elastic.phases import LARGEST_GIVE, new_work
from carom.dimensionless.lossy import layout
from carom.dimensionless.rebounds import STEP_TOLERANCE, fill_motion, solved
from carom.impacts.plate_findings import BENDING, LONG_WAVE, OF_PLATES, SHEARING, wave_ratio
from carom.impacts.solve import impact
from carom.io.cells import Mask
from carom.quantities.arrays import Array
from carom.quantities.verdicts import Finding

THICKNESS, DURATION = "thickness", "duration"
LEAST_GIVE = 1e-5  # lambda of what is fitted: 1 - e is 2e-5, below the accuracy of data
KNOTS, SMOOTH = 401, 7  # of lambda, and the degree between: good to 1e-12
CLIPPED = 1.0 - 1e-12  # part of the largest lambda
SHIFT = 1.0  # per cent of a thickness by which shear of the plate may shift it unsaid
Values = Mapping[str, Array]


@cache
def _normal_motion() -> BSpline:
    """Return e, the duration in d_max/V_1, and the speed of the centres as surfaces turn."""
    gives, numbers = np.linspace(0.0, LARGEST_GIVE, KNOTS), np.empty((KNOTS, layout.NUMBERS))
    fill_motion(gives, STEP_TOLERANCE, new_work(), numbers)
    turning = 1.25 * gives * numbers[:, layout.STRONGEST]
    columns = numbers[:, layout.RESTITUTION], numbers[:, layout.TIME], turning
    return make_interp_spline(gives, np.stack(columns, axis=-1), SMOOTH)


def give(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return lambda, which goes as 1/h^2; what is beyond the largest, as errors shift it, is it."""
    with np.errstate(divide="ignore"):  # an end of an interval that is open
        thinner = (pair.thickness or np.inf) / values[THICKNESS]
    whole = pair.plate_give(normal_speed) * thinner**2  # type: ignore[arg-type]
    return np.asarray(np.minimum(whole, LARGEST_GIVE * CLIPPED))


def restitution(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return the restitution at each speed."""
    e = _normal_motion()(give(pair, normal_speed, values))[..., 0]
    return np.asarray(np.minimum(e, 1.0))


def duration(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return the contact time at each speed, in s."""
    times = np.asarray(pair.scales(normal_speed).time)  # type: ignore[arg-type]
    return np.asarray(times * _normal_motion()(give(pair, normal_speed, values))[..., 1])


def turning(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return the speed of the centres as the surfaces turn, over V_1."""
    return np.asarray(_normal_motion()(give(pair, normal_speed, values))[..., 2])


def give_of(measured: Array) -> Array:
    """Return the lambda at which the restitution is so much."""
    gives = np.linspace(0.0, LARGEST_GIVE, KNOTS)
    return np.interp(-measured, -_normal_motion()(gives)[:, 0], gives)


def rebounds(psi: Array, chi: Array, gives: Array, e: Array) -> Array:
    """Return psi_2 of impacts, of one shape: in closed form where all slides throughout."""
    lost = 2.0 * chi * (1.0 + e)
    out = np.asarray(psi - np.copysign(lost, psi))
    rest = np.abs(psi) < np.maximum(lost - e, 1.0)
    out[rest] = solved(psi[rest], chi[rest], give=gives[rest])[0]
    return out


def with_thickness(pair: Pair, thickness: float) -> Pair:
    """Return the pair with a plate of another thickness."""
    wall: Any = pair.second
    plate = HalfSpace(material=wall.material, thickness=thickness, width=wall.width)
    return Pair(pair.first, plate, pair.friction, roughness=pair.roughness)


def thickness_range(pair: Pair, speeds: Array) -> tuple[float, float, float]:
    """Return the thicknesses between which one is sought, and that of which lambda is 1, usually.

    lambda must be no larger than the largest, and the plate thicker than the penetration.
    """
    unit = (pair.thickness or np.nan) * np.sqrt(pair.plate_give(speeds))  # type: ignore[arg-type]
    usual, fastest = float(np.median(unit)), float(unit.max())
    deepest = pair.scales(float(speeds.max())).length
    low = max(fastest / np.sqrt(LARGEST_GIVE), deepest) * (1.0 + 1e-9)
    return low, max(usual / np.sqrt(LEAST_GIVE), 2.0 * low), usual


def doubtful(pair: Pair, speeds: Array, thicknesses: Array) -> Iterator[tuple[Finding, Mask]]:
    """Yield what the theory of plates does not hold for, worst first, and in which rows."""
    findings = [
        _findings(with_thickness(pair, float(h)), float(speed))
        for speed, h in zip(speeds, thicknesses, strict=True)
    ]
    for name in dict.fromkeys(name for row in findings for name in row):
        wrong = [row[name] for row in findings if name in row and row[name].holds is not True]
        if wrong:
            bad = [name in row and row[name].holds is not True for row in findings]
            yield wrong[0], np.array(bad)


def _findings(pair: Pair, speed: float) -> dict[str, Finding]:
    """Return the findings on a plate by name; a fit takes a thick wall as a thin plate, too."""
    hit = impact(pair, normal_speed=speed)
    found = {each.name: each for judge in OF_PLATES if (each := judge(hit)) is not None}
    if pair.gives_way(hit.scales):
        return found
    thick = "no echo is back when the contact ends: the wall is thick; leave thickness out"
    wall: Any = pair.second
    return {BENDING: Finding(BENDING, wave_ratio(hit, wall), LONG_WAVE, False, thick), **found}


def shear(pair: Pair, speed: float, responses: tuple[str, ...], *, fitted: bool) -> str:
    """Return what shear of the plate, which the theory leaves out, does to e or to a thickness.

    1 - e goes as 1/h^2 and is larger by SHEARING/r^2 of itself (theory, page 11), or more where the
    waves are short: a fitted thickness comes out smaller by half of that.
    """
    bending = _findings(pair, speed)[BENDING]
    part = 50.0 * SHEARING / max(bending.value, LONG_WAVE) ** 2
    if part < SHIFT or bending.holds is False:
        return ""
    some = "some" if bending.holds else "more than"
    if not fitted:
        return f"restitution: as the plate also shears, 1 - e is {some} {2.0 * part:.2g} % larger"
    if responses == (DURATION,):
        return "thickness: the plate also shears, and what contact times make of that is not known"
    return f"thickness: as the plate also shears, it comes out {some} {part:.2g} % too small"
