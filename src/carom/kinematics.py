"""A rebound seen from outside: the motion before, two impulses, and what is published of it."""

from dataclasses import dataclass
from math import nan
from typing import Any

from carom.elementwise import arctan2, hypot, quotient, where
from carom.histories import Tangential
from carom.pairs import Pair


@dataclass(frozen=True)
class Rebound:
    """An impact known from outside: the motion before, and the two impulses as what they do.

    The tangential impulse J_t acts on the first body against +x; the normal one is
    J_n = m_n (1 + e) V_1. SI units; numbers or arrays of one shape. Signs are those of `impact`:
    positive spin adds to the tangential speed of the contact point, V_x = v_t + R spin + R_2 spin2.

    Examples
    --------
    >>> import carom
    >>> from carom.histories import Tangential
    >>> from carom.kinematics import Rebound
    >>> ball = carom.Sphere(radius="2.5 mm", material="alumina")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="soda-lime-glass"), friction=0.092)
    >>> rebound = Rebound(pair, 2.0, Tangential(2.0, 0.0, 0.0), restitution=0.98, impulse=0.0)
    >>> rebound.tangential_restitution, round(rebound.contact_rebound_angle, 4)
    (1.0, 0.7955)
    """

    pair: Pair
    normal_speed: Any
    before: Tangential
    restitution: Any
    impulse: Any

    @property
    def after(self) -> Tangential:
        """Tangential speed of the centre and spins after."""
        return self.before.after(self.pair, self.impulse)

    @property
    def tangential_speed(self) -> Any:
        """Tangential speed of the centre before, v_t in m/s."""
        return self.before.tangential_speed

    @property
    def spin(self) -> Any:
        """Spin of the first body before, in rad/s."""
        return self.before.spin

    @property
    def spin2(self) -> Any:
        """Spin of the second body before, in rad/s."""
        return self.before.spin2

    @property
    def speed(self) -> Any:
        """Speed of approach of the centres, in m/s."""
        return hypot(self.normal_speed, self.tangential_speed)

    @property
    def angle(self) -> Any:
        """Angle of incidence of the centre from the normal, tan = v_t/V_1."""
        return arctan2(self.tangential_speed, self.normal_speed)

    @property
    def contact_velocity(self) -> Any:
        """Tangential velocity of the contact point before, V_x in m/s."""
        return self.before.contact_velocity(self.pair)

    @property
    def contact_angle(self) -> Any:
        """Angle of incidence of the contact point from the normal, tan = V_x/V_1."""
        return arctan2(self.contact_velocity, self.normal_speed)

    @property
    def psi_in(self) -> Any:
        """kappa V_x/(mu V_1)."""
        return self.pair.psi(self.contact_velocity, self.normal_speed)

    @property
    def normal_restitution(self) -> Any:
        """Normal speed after to before, e."""
        return self.restitution

    @property
    def normal_speed_out(self) -> Any:
        """Normal speed after, e V_1 in m/s."""
        return self.restitution * self.normal_speed

    @property
    def normal_impulse(self) -> Any:
        """J_n = m_n (1 + e) V_1, in N s."""
        return self.pair.normal_mass * (1.0 + self.restitution) * self.normal_speed

    @property
    def tangential_speed_out(self) -> Any:
        """Tangential speed of the centre after, v_t' in m/s."""
        return self.after.tangential_speed

    @property
    def spin_out(self) -> Any:
        """Spin of the first body after, in rad/s."""
        return self.after.spin

    @property
    def spin2_out(self) -> Any:
        """Spin of the second body after, in rad/s."""
        return self.after.spin2

    @property
    def contact_velocity_out(self) -> Any:
        """Tangential velocity of the contact point after, V_x' in m/s."""
        return self.contact_velocity - self.impulse / self.pair.tangential_mass

    @property
    def rebound_angle(self) -> Any:
        """Angle of rebound of the centre from the normal, tan = v_t'/(e V_1)."""
        return arctan2(self.tangential_speed_out, self.normal_speed_out)

    @property
    def contact_rebound_angle(self) -> Any:
        """Angle of rebound of the contact point from the normal, tan = V_x'/(e V_1)."""
        return arctan2(self.contact_velocity_out, self.normal_speed_out)

    @property
    def tangential_restitution(self) -> Any:
        """v_t'/v_t of the centre; NaN if there was none."""
        return _ratio(self.tangential_speed_out, self.tangential_speed)

    @property
    def contact_restitution(self) -> Any:
        """V_x'/V_x of the contact point; NaN if there was none."""
        return _ratio(self.contact_velocity_out, self.contact_velocity)

    @property
    def contact_beta(self) -> Any:
        """-V_x'/V_x of the contact point, beta of Foerster et al. (1994), Walton's beta."""
        return -self.contact_restitution

    @property
    def impulse_ratio(self) -> Any:
        """J_t/J_n: the coefficient of friction where the impact slides throughout."""
        return self.impulse / self.normal_impulse

    @property
    def psi_out(self) -> Any:
        """kappa V_x'/(mu V_1)."""
        return self.pair.psi(self.contact_velocity_out, self.normal_speed)


def _ratio(after: Any, before: Any) -> Any:
    return where(before == 0.0, nan, quotient(after, before))
