"""One oblique impact with units: two bodies and their velocities in, the rebound out."""

from dataclasses import dataclass, field
from functools import cached_property
from math import atan2, hypot, isfinite, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.approach import approach
from carom.bodies import Sphere, Value, describe
from carom.dimensionless import hertz
from carom.dimensionless.solution import Phase, Solution, solve
from carom.pairs import Pair, Scales
from carom.quantities import InputError, finite, refusal
from carom.results import Validity, labelled
from carom.validity import judge

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


RESULTS = (
    "psi_in",
    "psi_out",
    "duration",
    "max_penetration",
    "max_force",
    "max_radius",
    "max_pressure",
    "rebound_speed",
    "rebound_angle",
    "tangential_speed_out",
    "spin_out",
    "spin2_out",
    "normal_restitution",
    "tangential_restitution",
    "contact_restitution",
    "dissipated_energy",
)
PAIR = (
    "friction",
    "chi",
    "kappa",
    "dundurs_beta",
    "effective_modulus",
    "effective_shear_modulus",
    "effective_radius",
    "normal_mass",
    "tangential_mass",
)


@dataclass(frozen=True, eq=False)
class Impact:
    """The result of `impact`: the rebound, every phase, and histories on request; SI units.

    Tangential speeds are those of the first body relative to the second, positive spin adds to the
    tangential speed of the contact point: V_x = v_t + R spin + R_2 spin2.
    """

    pair: Pair
    normal_speed: float
    tangential_speed: float
    spin: float
    spin2: float
    solution: Solution = field(repr=False)

    @property
    def contact_velocity(self) -> float:
        """Tangential velocity of the contact point before, V_x in m/s."""
        return _contact_velocity(self.pair, self.tangential_speed, self.spin, self.spin2)

    @property
    def contact_velocity_out(self) -> float:
        """Tangential velocity of the contact point after, in m/s."""
        if not isfinite(self.psi_in):
            return self.contact_velocity
        return self.psi_out * self.scales.tangential_speed

    @property
    def psi_in(self) -> float:
        """kappa V_x/(mu V_1) before; infinite without friction."""
        return self.pair.psi(self.contact_velocity, self.normal_speed)

    @property
    def psi_out(self) -> float:
        """kappa V_x/(mu V_1) after; infinite without friction."""
        return self.solution.psi_out if isfinite(self.psi_in) else self.psi_in

    @property
    def tangential_impulse(self) -> float:
        """Impulse of the tangential force on the first body, against +x, in N s."""
        return self.pair.tangential_mass * (self.contact_velocity - self.contact_velocity_out)

    @property
    def tangential_speed_out(self) -> float:
        """Tangential speed of the first centre relative to the second after, in m/s."""
        return self.tangential_speed - self.tangential_impulse / self.pair.normal_mass

    @property
    def spin_out(self) -> float:
        """Spin of the first body after, in rad/s."""
        return self._spin_after(self.pair.first, self.spin)

    @property
    def spin2_out(self) -> float:
        """Spin of the second body after, in rad/s; zero for a half-space or cup."""
        second = self.pair.second
        return self._spin_after(second, self.spin2) if isinstance(second, Sphere) else 0.0

    def _spin_after(self, body: Sphere, spin: float) -> float:
        lever = 1.0 / (body.mass * body.gyration_ratio * body.radius)
        return spin - self.tangential_impulse * lever

    @property
    def rebound_speed(self) -> float:
        """Relative speed of the centres after, in m/s."""
        return hypot(self.normal_speed, self.tangential_speed_out)

    @property
    def rebound_angle(self) -> float:
        """Angle of rebound of the centre from the normal, in rad; negative if it goes back."""
        return atan2(self.tangential_speed_out, self.normal_speed)

    @property
    def normal_restitution(self) -> float:
        """Normal velocity after to before: 1 for elastic bodies."""
        return 1.0

    @property
    def tangential_restitution(self) -> float:
        """Tangential velocity of the centres after to before, v_t'/v_t; NaN if there was none."""
        return _ratio(self.tangential_speed_out, self.tangential_speed)

    @property
    def contact_restitution(self) -> float:
        """Tangential velocity of the contact point after to before; NaN if there was none."""
        return _ratio(self.contact_velocity_out, self.contact_velocity)

    @property
    def dissipated_energy(self) -> float:
        """Energy lost to friction, in J."""
        before, after = self.contact_velocity, self.contact_velocity_out
        return 0.5 * self.pair.tangential_mass * (before - after) * (before + after)

    @cached_property
    def scales(self) -> Scales:
        """What the dimensionless impact is multiplied by."""
        return self.pair.scales(self.normal_speed)

    @property
    def duration(self) -> float:
        """Duration of the contact, in s."""
        return float(hertz.DURATION) * self.scales.time

    @property
    def max_penetration(self) -> float:
        """Largest normal approach, in m."""
        return self.scales.length

    @property
    def max_force(self) -> float:
        """Largest normal force, in N."""
        return self.scales.force

    @property
    def max_radius(self) -> float:
        """Largest contact radius, in m."""
        return self.scales.radius

    @property
    def max_pressure(self) -> float:
        """Largest contact pressure, in Pa."""
        return self.pair.peak_pressure(self.normal_speed)

    @cached_property
    def phases(self) -> tuple[Phase, ...]:
        """The phases in order, times in s."""
        if not isfinite(self.psi_in):
            sign = 1 if self.psi_in > 0.0 else -1
            return (Phase("gross slip", sign, 0.0, self.duration, "separation"),)
        unit = self.scales.time
        return tuple(
            Phase(p.kind, p.sign, p.start * unit, p.end * unit, p.cause)
            for p in self.solution.phases
        )

    @property
    def validity(self) -> Validity:
        """How far the assumptions of the theory hold, as numbers with a verdict."""
        return judge(self.pair, self.normal_speed, self.duration)

    def history(self, n: int = 200) -> "xr.Dataset":
        """Return the impact at n times: a dataset with forces, velocities, radii, energies."""
        if not isinstance(n, int) or n < 2:
            raise refusal("n", n, "must be a whole number of at least 2")
        return labelled(self._columns(n), self.scalars(), self.phases, self.inputs())

    def to_dataset(self) -> "xr.Dataset":
        """Return all of the result as one dataset, with a history of 400 times."""
        return self.history(400)

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Draw the impact; with a path, store the figure there."""
        from carom.plots import plot_impact, save_figure

        figure = plot_impact(self.to_dataset())
        if path is not None:
            save_figure(figure, path)
        return figure

    def _columns(self, n: int) -> dict[str, Any]:
        h, scales = self.solution.history(n), self.scales
        slides_freely = not isfinite(self.psi_in)
        velocity = h.psi * scales.tangential_speed
        displacement = h.displacement * scales.tangential_length
        if slides_freely:
            velocity = velocity + self.contact_velocity
            displacement = displacement + self.contact_velocity * h.time * scales.time
        tangential = self.pair.tangential_mass * scales.tangential_speed**2
        return {
            "time": h.time * scales.time,
            "penetration": h.penetration * scales.length,
            "normal_velocity": h.speed * self.normal_speed,
            "contact_velocity": velocity,
            "displacement": displacement,
            "normal_force": h.penetration**1.5 * scales.force,
            "tangential_force": h.force * scales.tangential_force,
            "contact_radius": h.contact_radius * scales.radius,
            "stick_radius": h.stick_radius * scales.radius * (0.0 if slides_freely else 1.0),
            "normal_kinetic_energy": h.speed**2 * scales.energy,
            "tangential_kinetic_energy": 0.5 * self.pair.tangential_mass * velocity**2,
            "normal_elastic_energy": h.penetration**2.5 * scales.energy,
            "tangential_elastic_energy": h.stored * tangential,
            "frictional_work": h.dissipated * tangential,
        }

    def scalars(self) -> dict[str, float]:
        """Return the numbers of the result by name."""
        numbers = {name: float(getattr(self, name)) for name in RESULTS}
        return numbers | {name: getattr(self.pair, name) for name in PAIR}

    def inputs(self) -> dict[str, Any]:
        """Return what the impact was made from, as plain numbers and words."""
        return {
            "first": describe(self.pair.first),
            "second": describe(self.pair.second),
            "friction": self.pair.friction,
            "normal_speed": self.normal_speed,
            "tangential_speed": self.tangential_speed,
            "spin": self.spin,
            "spin2": self.spin2,
        }


def impact(
    pair: Pair,
    *,
    speed: Value | None = None,
    angle: Value | None = None,
    normal_speed: Value | None = None,
    tangential_speed: Value | None = None,
    spin: Value = 0.0,
    spin2: Value = 0.0,
) -> Impact:
    """Solve one oblique impact of two elastic bodies exactly, within Hertz's theory.

    V_1 = speed cos(angle), v_t = speed sin(angle), V_x = v_t + R spin + R_2 spin2,
    psi_1 = kappa V_x/(mu V_1).

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    speed, angle : float or str
        Speed of approach of the centres and its angle from the normal; a bare angle is in radians.
    normal_speed, tangential_speed : float or str
        The same as components, instead of speed and angle; relative, of the first to the second.
    spin, spin2 : float or str
        Spin of either body; positive spin adds to the tangential speed of the contact point.

    Raises
    ------
    InputError
        If a value is missing, given twice, out of range, or the bodies do not approach.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
    >>> [phase.kind for phase in hit.phases]
    ['gross slip', 'stick', 'slip', 'gross slip']
    >>> round(hit.rebound_angle * 180 / 3.141592653589793, 2)
    18.6
    """
    if not isinstance(pair, Pair):
        raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
    normal, tangential = approach(speed, angle, normal_speed, tangential_speed)
    first_spin, second_spin = finite("spin", spin), finite("spin2", spin2)
    if second_spin and not isinstance(pair.second, Sphere):
        raise refusal("spin2", spin2, "only a second sphere can spin; leave it out")
    velocity = _contact_velocity(pair, tangential, first_spin, second_spin)
    _refuse_overflow(pair, normal, velocity)
    psi = pair.psi(velocity, normal)
    solution = solve(psi if isfinite(psi) else 0.0, pair.chi)
    return Impact(pair, normal, tangential, first_spin, second_spin, solution)


def _refuse_overflow(pair: Pair, normal: float, velocity: float) -> None:
    """Refuse sizes and speeds whose scales leave the range of floating-point numbers."""
    try:
        scales = (*pair.scales(normal), velocity, pair.peak_pressure(normal))
        fits = all(isfinite(value) for value in scales) and min(scales[:5]) > 0.0
    except (OverflowError, ZeroDivisionError):
        fits = False
    if not fits:
        raise InputError(
            f"speed: {normal:g} m/s at a radius of {pair.first.radius:g} m gives numbers that "
            "floating point cannot hold; check the units"
        )


def _contact_velocity(pair: Pair, tangential: float, *spins: float) -> float:
    carried = (b.radius * spin for b, spin in zip(pair.moving, spins, strict=False))
    return tangential + sum(carried)


def _ratio(after: float, before: float) -> float:
    return after / before if before != 0.0 else nan
