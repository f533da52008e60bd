"""The score of a history of forces: the rebound that it makes, and what is found on the way."""

from typing import NamedTuple

import numpy as np

from carom.bodies.pairs import Scales
from carom.impacts.exact import Impact
from carom.io.labels import Finding
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.verify.scoring.contact import Samples, contact_samples
from carom.verify.scoring.points import (
    LARGEST,
    PRINTED,
    Points,
    compared,
    energy_audit,
    refuse_large,
    restitution_audit,
)

TAIL = 64  # instants added where the exact contact outlasts the one that was given
NAMES = ("time", "normal_force", "tangential_force", "contact_velocity")


class Forces(NamedTuple):
    """A history of forces against time since the first touch, and the exact one; SI units.

    Errors of forces are in units of P_max and mu P_max; `psi` of the contact point is as the
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


def forces_of(hit: Impact, samples: Samples) -> Forces:
    """Return a history beside the exact one, until neither contact lasts.

    Impulses are integrals, by trapezia, of the difference from the exact forces, whose own impulses
    are known: however coarse it is sampled, the exact history has no error.
    """
    time, pair, scales = samples.time, hit.pair, hit.scales
    if time[-1] < hit.duration * (1.0 - 1e-12):
        time = np.concatenate([time, np.linspace(time[-1], hit.duration, TAIL)[1:]])
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
        duration_error=samples.end / hit.duration - 1.0,
        peak_error=float(normal.max() - exact_normal.max()) / scales.force,
    )


def _middles(values: Array) -> Array:
    return 0.5 * (values[1:] + values[:-1])


def score_history(
    results: UserTable, hit: Impact, expected: float, limit: float
) -> tuple[Points, tuple[Finding, ...], tuple[str, ...], Forces]:
    """Return the one point that a history makes, what is found, notes, and the forces.

    Raises InputError for a record that is not one whole contact, or is in wrong units.
    """
    results.require("time", "normal_force", "tangential_force")
    _refuse_large(results, hit.scales)
    forces = forces_of(hit, contact_samples(results, hit))
    change = np.array([_energy_change(forces)])
    before, after = np.array([hit.psi_in]), forces.psi[-1:]
    one = UserTable({}, np.array([1]), "impact")
    refuse_large(before, after, one)
    points = compared(before, after, np.array([hit.pair.chi]), expected, change, one)
    unit = 0.5 * hit.pair.tangential_mass * np.array([hit.scales.tangential_speed]) ** 2
    findings = (
        _off("tangential force", forces, forces.tangential_error, "mu P_max", limit),
        _off("normal force", forces, forces.normal_error, "P_max", limit),
        _share("peak force", forces.peak_error, "of P_max", limit),
        _share("duration", forces.duration_error, "of the exact one", limit),
        _cone_audit(results, forces, limit),
        _work_audit(forces, limit),
        energy_audit(points, unit, "J", limit),
        restitution_audit(points, np.array([forces.restitution]), limit),
        *_velocity_audit(results, forces, limit),
    )
    return points, findings, _notes(forces), forces


def _refuse_large(results: UserTable, scales: Scales) -> None:
    """Raise InputError for numbers in a unit that cannot be theirs."""
    units = {"normal_force": scales.force, "tangential_force": scales.force}
    units["contact_velocity"] = scales.tangential_speed
    for name, unit in units.items():
        if name in results.columns:
            results.refuse(name, np.abs(results[name]) > LARGEST * unit, "check its unit")


def _energy_change(forces: Forces) -> float:
    """Return kinetic energy after less that before, in J."""
    psi, scales = forces.psi, forces.hit.scales
    unit = 0.5 * forces.hit.pair.tangential_mass * scales.tangential_speed**2
    lost = float(unit * (psi[0] - psi[-1]) * (psi[0] + psi[-1]))
    return scales.energy * (forces.restitution**2 - 1.0) - lost


def _off(name: str, forces: Forces, error: Array, unit: str, limit: float) -> Finding:
    worst = int(np.argmax(np.abs(error)))
    value = float(abs(error[worst]))
    where = f"{error[worst]:+.3g} {unit} at t = {text(forces.time[worst], 's', 4)}"
    verdict = f"off by {where} after the touch; rms {forces.rms(error):.3g}"
    return Finding(name, value, limit, value <= limit, verdict)


def _share(name: str, error: float, unit: str, limit: float) -> Finding:
    verdict = f"off by {error:+.3g} {unit}"
    return Finding(name, abs(error), limit, abs(error) <= limit, verdict)


def _cone_audit(results: UserTable, forces: Forces, limit: float) -> Finding:
    """Return whether |F_t| <= mu F_n, in units of mu P_max."""
    friction, peak = forces.hit.pair.friction, forces.hit.scales.force
    over = np.abs(results["tangential_force"]) - friction * np.maximum(results["normal_force"], 0.0)
    over = over / (friction * peak)
    outside = over > PRINTED * limit
    if not outside.any():
        value = max(float(over.max()), 0.0)
        return Finding("friction cone", value, limit, True, "|F_t| <= mu F_n at all times")
    worst = int(np.argmax(over))
    value = float(over[worst])
    verdict = f"|F_t| > mu F_n in {results.named(outside)}; most in {results.one(worst)}"
    return Finding("friction cone", value, limit, value <= limit, f"{verdict}, by {value:.3g}")


def _work_audit(forces: Forces, limit: float) -> Finding:
    """Return whether the tangential force takes energy from the motion before it gives any."""
    gain = np.abs(forces.psi) - abs(forces.hit.psi_in)
    worst = int(np.argmax(gain))
    value = max(float(gain[worst]), 0.0)
    if value <= PRINTED * limit:
        return Finding("work", value, limit, True, "friction never adds to the motion")
    when = f"at t = {text(forces.time[worst], 's', 4)} after the touch"
    verdict = f"the tangential force adds to the motion, most {when}: {value:.3g} of psi"
    return Finding("work", value, limit, value <= limit, verdict)


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
    words = (
        f"differs from the impulse by up to {value:.3g} of psi, in {results.one(int(rows[worst]))}"
    )
    return (Finding("contact velocity", value, limit, value <= limit, words),)


def _notes(forces: Forces) -> tuple[str, ...]:
    turned = -forces.tangential_force - forces.exact_tangential_force
    off = forces.tangential_force - forces.exact_tangential_force
    if 2.0 * forces.rms(turned) < forces.rms(off):
        return ("does tangential_force have the opposite sign? It is positive against V_x > 0",)
    return ()
