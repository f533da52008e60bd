"""The score of a history of forces: the rebound that it makes, and what is found on the way."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.pairs import Scales
from carom.dimensionless.numerics import hertz
from carom.impacts.exact import Impact
from carom.impacts.histories import labelled
from carom.io.cells import Mask
from carom.io.labels import labelled_dataset
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError
from carom.quantities.verdicts import Finding
from carom.verify.scoring import points as scored
from carom.verify.scoring.cases import ScoredCase
from carom.verify.scoring.points import LARGEST_PSI, PRINTED_DIGITS, Scored, within

if TYPE_CHECKING:
    import xarray as xr

FEWEST_ROWS = 20  # with a force
PEAK_INSTANTS, TIME_TOLERANCE = 100, 1e-12  # the latter in d_max/V_1
SMALL_FORCE = 0.1  # of the peak: what the first and last force of elastic bodies may be
PREFIXES = {1e3: "m", 1e6: "u", 1e9: "n", 1e-3: "k", 1e-6: "M"}  # by the factor of numbers
PREFIX_RATIO = 1.5  # how far a factor may be from one of them
LARGEST_DURATION = 30.0  # in Hertz's; no law of contact explains more
TAIL_INSTANTS = 64  # added where the exact contact outlasts that of the results
NAMES = ("time", "normal_force", "tangential_force", "contact_velocity")


class Samples(NamedTuple):
    """Forces since the first `touch`, with zeros at either end, whose places in `rows` are -1."""

    time: Array
    normal_force: Array
    tangential_force: Array
    rows: NDArray[np.int64]
    touch: float


def contact_samples(results: UserTable, hit: Impact) -> Samples:
    """Return the forces while the bodies touch, or raise InputError if the record is not whole.

    The first touch lies between the last row without force and the first with one, as long before
    as the exact impact takes to that force; so does the last.
    """
    time, force = results["time"], results["normal_force"]
    falls = np.concatenate([[False], np.diff(time) <= 0.0])
    allowed = "it must rise from row to row; sort the rows, and delete duplicates"
    results.refuse("time", falls, allowed)
    first, last = _ends(results)
    _check_units(time[first : last + 1], force, hit.scales)
    _check_ends(results, first, last, hit)
    count = last - first + 1
    if count < FEWEST_ROWS:
        raise InputError(
            f"results: {count} rows have a normal force; a history needs at least {FEWEST_ROWS}, "
            "record more often"
        )
    touch = float(time[first]) - _when(float(force[first]), hit, 0.0)
    parting = _when(float(force[last]), hit, hit.solution.duration)
    end = float(time[last]) + (hit.duration - parting)
    if first > 0:
        touch = max(touch, float(time[first - 1]))
    if last + 1 < len(results):
        end = min(end, float(time[last + 1]))
    part, framed = slice(first, last + 1), {}
    for name in ("normal_force", "tangential_force"):
        framed[name] = np.concatenate([[0.0], results[name][part], [0.0]])
    return Samples(
        time=np.concatenate([[touch], time[part], [end]]) - touch,
        rows=np.concatenate([[-1], np.arange(first, last + 1), [-1]]),
        touch=touch,
        **framed,
    )


def _when(force: float, hit: Impact, end: float) -> float:
    """Return when the exact force, between one end of the contact and its peak, has a value."""
    from scipy.optimize import brentq

    exact = hit.solution.history(PEAK_INSTANTS)
    peak = float(exact.time[np.argmax(exact.normal_force)])

    def excess(time: float) -> float:
        return float(hit.solution.at(time).normal_force[0]) - force / hit.scales.force

    time = peak if excess(peak) <= 0.0 else brentq(excess, end, peak, xtol=TIME_TOLERANCE)
    return time * hit.scales.time


def _ends(results: UserTable) -> tuple[int, int]:
    force = results["normal_force"]
    touching = force > 0.0
    if touching.sum() < 0.5 * np.count_nonzero(force) or not touching.any():
        raise InputError(
            "normal_force: must be positive where the bodies press on each other; change its sign"
        )
    first, last = (int(i) for i in np.flatnonzero(touching)[[0, -1]])
    inside = np.arange(force.size)
    gaps: Mask = ~touching & (inside > first) & (inside < last)
    apart = "the bodies part and meet again; give the history of one impact"
    results.refuse("normal_force", gaps, apart)
    return first, last


def _check_ends(results: UserTable, first: int, last: int, hit: Impact) -> None:
    """Raise InputError if the record does not start at the first touch and end at the last."""
    exact = hit.solution.history(FEWEST_ROWS + 1).normal_force / hit.solution.max_force
    force = results["normal_force"]
    for place, what, soon in (
        (first, "start at the first touch", exact[1]),
        (last, "go on to the last touch", exact[-2]),
    ):
        share = float(force[place]) / float(force.max())
        if share > max(SMALL_FORCE, soon):  # forces of viscous bodies rise steeply
            raise InputError(
                f"normal_force: the history does not {what}; in {results.one(place)} it is "
                f"{100 * share:.0f} % of the peak; record from before the touch until they part"
            )


def _check_units(time: Array, force: Array, scales: Scales) -> None:
    lasted = float(time[-1] - time[0]) / (hertz.DURATION * scales.time)
    pressed = float(force.max()) / scales.force
    for name, ratio, unit in (("time", lasted, "s"), ("normal_force", pressed, "N")):
        what = "the contact lasts" if name == "time" else "the peak is"
        for factor, prefix in PREFIXES.items():
            if 1.0 / PREFIX_RATIO < ratio / factor < PREFIX_RATIO:
                raise InputError(
                    f"{name}: {what} {ratio:.4g} times Hertz's; if it is in {prefix}{unit}, "
                    f"head the column '{name} [{prefix}{unit}]'"
                )
    if len(time) > 1 and not 1.0 / LARGEST_DURATION < lasted < LARGEST_DURATION:
        raise InputError(
            f"time: the contact lasts {lasted:.4g} times Hertz's duration, "
            f"{text(hertz.DURATION * scales.time, 's', 4)}; is time counted in steps?"
        )


class Forces(NamedTuple):
    """A history of forces against time since the first touch, and the exact one; SI units.

    `hit` is the exact impact, with `exact_normal_force` and `exact_tangential_force` at the times
    of the `samples`. `normal_error`, `tangential_error` and `peak_error` are in units of P_max and
    mu P_max, `duration_error` in the exact duration; `psi` of the contact point is as the
    tangential force that was given makes it, `restitution` as the normal one does.
    """

    hit: Impact
    samples: Samples
    time: Array
    normal_force: Array
    tangential_force: Array
    exact_normal_force: Array
    exact_tangential_force: Array
    normal_error: Array
    tangential_error: Array
    psi: Array
    restitution: float
    duration_error: float
    peak_error: float

    def rms(self, values: Array) -> float:
        """Return the root of the mean square over time."""
        squares = np.diff(self.time) @ _middles(values**2)
        return float(np.sqrt(squares / self.time[-1]))

    def to_dataset(self) -> "xr.Dataset":
        """Return the forces and the exact ones along time."""
        hit, names = self.hit, ("time", "normal_force", "tangential_force")
        dataset = labelled(
            {name: getattr(self, name) for name in names},
            {"friction": hit.pair.friction, "max_force": hit.max_force, "duration": hit.duration},
            hit.phases,
            hit.inputs(),
        )
        exact = {
            f"{name}_exact": (
                "time",
                getattr(self, f"exact_{name}"),
                {"units": "N", "long_name": f"exact {name.replace('_', ' ')}"},
            )
            for name in names[1:]
        }
        return dataset.assign(labelled_dataset(exact, {}, {}).data_vars)


def forces_of(hit: Impact, samples: Samples) -> Forces:
    """Return a history beside the exact one, until neither contact lasts.

    Impulses are integrals, by trapezia, of the difference from the exact forces, whose own impulses
    are known: however coarse it is sampled, the exact history has no error.
    """
    time, pair, scales = samples.time, hit.pair, hit.scales
    if time[-1] < hit.duration * (1.0 - 1e-12):
        time = np.concatenate([time, np.linspace(time[-1], hit.duration, TAIL_INSTANTS)[1:]])
    after = np.zeros(time.size - samples.time.size)
    normal = np.concatenate([samples.normal_force, after])
    tangential = np.concatenate([samples.tangential_force, after])
    exact = hit.solution.at(np.clip(time / scales.time, 0.0, hit.solution.duration))
    exact_normal = exact.normal_force * scales.force
    exact_tangential = exact.force * scales.tangential_force
    off_normal, off_tangential = normal - exact_normal, tangential - exact_tangential
    impulse = np.concatenate([[0.0], np.cumsum(np.diff(time) * _middles(off_tangential))])
    normal_impulse = float(np.diff(time) @ _middles(off_normal))
    return Forces(
        hit=hit,
        samples=samples,
        time=time,
        normal_force=normal,
        tangential_force=tangential,
        exact_normal_force=exact_normal,
        exact_tangential_force=exact_tangential,
        normal_error=off_normal / scales.force,
        tangential_error=off_tangential / (pair.friction * scales.force),
        psi=exact.psi - impulse / (pair.tangential_mass * scales.tangential_speed),
        restitution=hit.normal_restitution + normal_impulse / (pair.normal_mass * hit.normal_speed),
        duration_error=float(samples.time[-1]) / hit.duration - 1.0,
        peak_error=float(normal.max() - exact_normal.max()) / scales.force,
    )


def _middles(values: Array) -> Array:
    return 0.5 * (values[1:] + values[:-1])


def score_history(results: UserTable, case: ScoredCase, limit: float) -> Scored:
    """Return the one point that a history makes, what is found on the way, and the forces."""
    hit = case.impact
    results.require("time", "normal_force", "tangential_force")
    scales = hit.scales
    largest = scales.force, scales.force, scales.tangential_speed
    for name, scale in zip(NAMES[1:], largest, strict=True):
        if name in results.columns:
            results.refuse(name, np.abs(results[name]) > LARGEST_PSI * scale, "check its unit")
    forces = forces_of(hit, contact_samples(results, hit))
    before, after = np.array([hit.psi_in]), forces.psi[-1:]
    one = UserTable({}, np.array([1]), "impact")
    scored.refuse_large(before, after, one)
    unit = 0.5 * hit.pair.tangential_mass * np.array([scales.tangential_speed]) ** 2
    lost = unit * (forces.psi[0] - after) * (forces.psi[0] + after)
    change, chi = scales.energy * (forces.restitution**2 - 1.0) - lost, np.array([hit.pair.chi])
    points = scored.compared(before, after, chi, case.restitution, change, one)
    audit = (
        _off("tangential force", forces, forces.tangential_error, "mu P_max", limit),
        _off("normal force", forces, forces.normal_error, "P_max", limit),
        _share("peak force", forces.peak_error, "of P_max", limit),
        _share("duration", forces.duration_error, "of the exact one", limit),
        _cone_audit(results, forces, limit),
        _work_audit(forces, limit),
        scored.energy_audit(points, unit, "J", limit),
        scored.restitution_audit(points, np.array([forces.restitution]), limit),
        *_velocity_audit(results, forces, limit),
    )
    return Scored(points, audit, _notes(forces), hit.inputs(), forces)


def _off(name: str, forces: Forces, error: Array, unit: str, limit: float) -> Finding:
    worst = int(np.argmax(np.abs(error)))
    value = float(abs(error[worst]))
    where = f"{error[worst]:+.3g} {unit} at t = {text(forces.time[worst], 's', 4)}"
    verdict = f"off by {where} after the touch; rms {forces.rms(error):.3g}"
    return within(name, value, limit, verdict)


def _share(name: str, error: float, unit: str, limit: float) -> Finding:
    return within(name, abs(error), limit, f"off by {error:+.3g} {unit}")


def _cone_audit(results: UserTable, forces: Forces, limit: float) -> Finding:
    """Return whether |F_t| <= mu F_n, in units of mu P_max."""
    friction, peak = forces.hit.pair.friction, forces.hit.scales.force
    over = np.abs(results["tangential_force"]) - friction * np.maximum(results["normal_force"], 0.0)
    over = over / (friction * peak)
    outside, value = over > PRINTED_DIGITS * limit, max(float(over.max()), 0.0)
    verdict = "|F_t| <= mu F_n at all times"
    if outside.any():
        most = results.one(int(np.argmax(over)))
        verdict = f"|F_t| > mu F_n in {results.named(outside)}; most in {most}, by {value:.3g}"
    return within("friction cone", value, limit, verdict)


def _work_audit(forces: Forces, limit: float) -> Finding:
    """Return whether the tangential force takes energy from the motion before it gives any."""
    gain = np.abs(forces.psi) - abs(forces.hit.psi_in)
    worst = int(np.argmax(gain))
    value, verdict = max(float(gain[worst]), 0.0), "friction never adds to the motion"
    if value > PRINTED_DIGITS * limit:
        when = f"at t = {text(forces.time[worst], 's', 4)} after the touch"
        verdict = f"the tangential force adds to the motion, most {when}: {value:.3g} of psi"
    return within("work", value, limit, verdict)


def _velocity_audit(results: UserTable, forces: Forces, limit: float) -> tuple[Finding, ...]:
    """Return whether the velocity of the contact point, if given, is what the force makes of it."""
    if "contact_velocity" not in results.columns:
        return ()
    own = forces.samples.rows >= 0
    rows = forces.samples.rows[own]
    velocity = results["contact_velocity"][rows] / forces.hit.scales.tangential_speed
    off = np.abs(velocity - forces.psi[: own.size][own])
    worst = int(np.argmax(off))
    value = float(off[worst])
    where = results.one(int(rows[worst]))
    words = f"differs from the impulse by up to {value:.3g} of psi, in {where}"
    return (within("contact velocity", value, limit, words),)


def _notes(forces: Forces) -> tuple[str, ...]:
    turned = -forces.tangential_force - forces.exact_tangential_force
    off = forces.tangential_force - forces.exact_tangential_force
    if 2.0 * forces.rms(turned) < forces.rms(off):
        return ("does tangential_force have the opposite sign? It is positive against V_x > 0",)
    return ()
