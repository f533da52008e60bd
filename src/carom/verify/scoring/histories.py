"""The score of a history of forces: the rebound that it makes, and what is found on the way."""

from dataclasses import dataclass
from functools import cached_property
from math import isfinite

import numpy as np

from carom.dimensionless.numerics import hertz
from carom.dimensionless.states import History
from carom.impacts.exact import Impact
from carom.io.columns import Results
from carom.io.labels import Finding
from carom.quantities.arrays import Array
from carom.quantities.units import InputError
from carom.verify.scoring.contact import Samples, contact_samples
from carom.verify.scoring.points import PRINTED, Points, compared, energy_audit, restitution_audit

TAIL = 64  # instants added where the exact contact outlasts the one that was given
NAMES = ("time", "normal_force", "tangential_force", "contact_velocity")


@dataclass(frozen=True, eq=False)
class Forces:
    """A history of forces, its time since the first touch, and the exact history; SI units.

    Impulses are integrals, by trapezia, of the difference from the exact forces, whose own impulses
    are known: however coarse it is sampled, the exact history has no error.
    """

    hit: Impact
    samples: Samples

    @cached_property
    def time(self) -> Array:
        """Time since the first touch, until neither contact lasts."""
        own, exact = self.samples.time, self.hit.duration
        if own[-1] >= exact * (1.0 - 1e-12):
            return own
        return np.concatenate([own, np.linspace(own[-1], exact, TAIL)[1:]])

    @property
    def normal_force(self) -> Array:
        """The normal force that was given, zero after the last touch."""
        return self._padded(self.samples.normal_force)

    @property
    def tangential_force(self) -> Array:
        """The tangential force that was given, zero after the last touch."""
        return self._padded(self.samples.tangential_force)

    def _padded(self, values: Array) -> Array:
        return np.concatenate([values, np.zeros(self.time.size - values.size)])

    @cached_property
    def solution(self) -> History:
        """The exact impact at these times, dimensionless; as it ends where they go on."""
        scale = self.hit.scales.time
        return self.hit.solution.at(np.clip(self.time / scale, 0.0, hertz.DURATION))

    @property
    def exact_normal_force(self) -> Array:
        """The exact normal force."""
        return self.solution.penetration**1.5 * self.hit.scales.force

    @property
    def exact_tangential_force(self) -> Array:
        """The exact tangential force."""
        return self.solution.force * self.hit.scales.tangential_force

    @cached_property
    def normal_error(self) -> Array:
        """Error in the normal force, in units of P_max."""
        return (self.normal_force - self.exact_normal_force) / self.hit.scales.force

    @cached_property
    def tangential_error(self) -> Array:
        """Error in the tangential force, in units of mu P_max."""
        unit = self.hit.pair.friction * self.hit.scales.force
        return (self.tangential_force - self.exact_tangential_force) / unit

    @cached_property
    def psi(self) -> Array:
        """psi of the contact point as the tangential force that was given makes it."""
        excess = self.tangential_force - self.exact_tangential_force
        impulse = np.concatenate([[0.0], np.cumsum(np.diff(self.time) * _middles(excess))])
        unit = self.hit.pair.tangential_mass * self.hit.scales.tangential_speed
        return self.solution.psi - impulse / unit

    @property
    def restitution(self) -> float:
        """Normal velocity after to before, from the impulse of the normal force."""
        excess = self.normal_force - self.exact_normal_force
        impulse = float(np.diff(self.time) @ _middles(excess))
        return 1.0 + impulse / (self.hit.pair.normal_mass * self.hit.normal_speed)

    @property
    def duration_error(self) -> float:
        """Error in the duration of the contact, relative."""
        return self.samples.end / self.hit.duration - 1.0

    @property
    def peak_error(self) -> float:
        """Error in the largest normal force of these times, in units of P_max."""
        own, exact = self.normal_force.max(), self.exact_normal_force.max()
        return float(own - exact) / self.hit.scales.force

    @property
    def energy_change(self) -> float:
        """Kinetic energy after less that before, in J."""
        normal = self.hit.scales.energy * (self.restitution**2 - 1.0)
        return normal - self.lost

    @property
    def lost(self) -> float:
        """Work that the tangential force has taken from the motion, in J."""
        unit = 0.5 * self.hit.pair.tangential_mass * self.hit.scales.tangential_speed**2
        return float(unit * (self.psi[0] - self.psi[-1]) * (self.psi[0] + self.psi[-1]))

    def rms(self, values: Array) -> float:
        """Return the root of the mean square over time."""
        squares = np.diff(self.time) @ _middles(values**2)
        return float(np.sqrt(squares / self.time[-1]))


def _middles(values: Array) -> Array:
    return 0.5 * (values[1:] + values[:-1])


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
