"""The score of a history of forces: the rebound that it makes, and what is found on the way."""

from math import isfinite

import numpy as np

from carom.exact_impacts import Impact
from carom.quantities import InputError
from carom.readings import Array, Results
from carom.results import Finding
from carom.verify.scoring.audits import PRINTED, energy_audit, restitution_audit
from carom.verify.scoring.contact import contact_samples
from carom.verify.scoring.forces import Forces
from carom.verify.scoring.points import Points, compared

NAMES = ("time", "normal_force", "tangential_force", "contact_velocity")


def score_history(
    results: Results, hit: Impact, limit: float
) -> tuple[Points, tuple[Finding, ...], tuple[str, ...], Forces]:
    """Return the one point that a history makes, what is found, notes, and the forces.

    Raises InputError for a record that is not one whole contact, or is in wrong units.
    """
    results.require("time", "normal_force", "tangential_force")
    if not isfinite(hit.psi_in):
        raise InputError("friction: without friction psi is infinite; there is nothing to score")
    forces = Forces(hit, contact_samples(results, hit.scales))
    change = np.array([forces.energy_change])
    before, after = np.array([hit.psi_in]), forces.psi[-1:]
    one = Results({}, np.array([1]), "impact")
    points = compared(before, after, np.array([hit.pair.chi]), change, one)
    unit = 0.5 * hit.pair.tangential_mass * np.array([hit.scales.tangential_speed]) ** 2
    findings = (
        _off("tangential force", forces, forces.tangential_error, "mu P_max", limit),
        _off("normal force", forces, forces.normal_error, "P_max", limit),
        _share("peak force", forces.peak_error, "of P_max", limit),
        _share("duration", forces.duration_error, "of Hertz's", limit),
        _cone_audit(results, forces, limit),
        _work_audit(forces, limit),
        energy_audit(points, unit, "J", limit),
        restitution_audit(points, np.array([forces.restitution]), limit),
        *_velocity_audit(results, forces, limit),
    )
    return points, findings, _notes(forces), forces


def _off(name: str, forces: Forces, error: Array, unit: str, limit: float) -> Finding:
    worst = int(np.argmax(np.abs(error)))
    value = float(abs(error[worst]))
    where = f"{error[worst]:+.3g} {unit} at t = {forces.time[worst]:.4g} s"
    verdict = f"off by {where} after the touch; rms {forces.rms(error):.3g}"
    return Finding(name, value, limit, value <= limit, verdict)


def _share(name: str, error: float, unit: str, limit: float) -> Finding:
    verdict = f"off by {error:+.3g} {unit}"
    return Finding(name, abs(error), limit, abs(error) <= limit, verdict)


def _cone_audit(results: Results, forces: Forces, limit: float) -> Finding:
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
        return Finding("work", value, limit, True, "at no time does friction add to the motion")
    when = f"at t = {forces.time[worst]:.4g} s after the touch"
    verdict = f"the tangential force has added to the motion, most {when}: {value:.3g} of psi"
    return Finding("work", value, limit, value <= limit, verdict)


def _velocity_audit(results: Results, forces: Forces, limit: float) -> tuple[Finding, ...]:
    """Return whether the velocity of the contact point, if given, is what the force makes of it."""
    if "contact_velocity" not in results.columns:
        return ()
    own = forces.samples.rows >= 0
    rows = forces.samples.rows[own]
    velocity = results["contact_velocity"][rows] / forces.hit.scales.tangential_speed
    off = np.abs(velocity - forces.psi[: own.size][own])
    worst = int(np.argmax(off))
    value = float(off[worst])
    words = f"off the impulse by at most {value:.3g} of psi, in {results.one(int(rows[worst]))}"
    return (Finding("contact velocity", value, limit, value <= limit, words),)


def _notes(forces: Forces) -> tuple[str, ...]:
    turned = -forces.tangential_force - forces.exact_tangential_force
    off = forces.tangential_force - forces.exact_tangential_force
    if 2.0 * forces.rms(turned) < forces.rms(off):
        return ("tangential_force has the opposite sign? It is positive against V_x > 0",)
    return ()
