"""How two bodies approach: speeds from what users give."""

from math import inf, pi

from carom.bodies import Value
from carom.elementwise import cos, sin
from carom.quantities import InputError, finite, number, positive, refusal


def approach(
    speed: Value | None,
    angle: Value | None,
    normal_speed: Value | None,
    tangential_speed: Value | None,
) -> tuple[float, float]:
    """Return normal and tangential speed from either way of giving them, in m/s.

    V_1 = speed cos(angle), v_t = speed sin(angle).

    Raises InputError if one is missing, given twice, out of range, or the bodies do not approach.
    """
    if speed is not None:
        if normal_speed is not None or tangential_speed is not None:
            raise InputError("speed: give speed and angle, or normal_speed and tangential_speed")
        return components(positive("speed", speed), slope(0.0 if angle is None else angle))
    if normal_speed is None:
        raise InputError("speed: missing; give speed and angle, or normal_speed")
    if angle is not None:
        raise InputError("angle: goes with speed; with normal_speed give tangential_speed")
    normal = number("normal_speed", normal_speed)
    if not 0.0 < normal < inf:
        raise refusal(
            "normal_speed", normal_speed, "must be positive and finite: the bodies must approach"
        )
    return normal, finite("tangential_speed", 0.0 if tangential_speed is None else tangential_speed)


def components(speed: float, angle: float) -> tuple[float, float]:
    """Return normal and tangential speed, numbers or arrays of them, in m/s."""
    return speed * cos(angle), speed * sin(angle)


def slope(angle: Value) -> float:
    """Return an angle of incidence in rad, or raise InputError if it does not approach."""
    result = finite("angle", angle)
    if abs(result) < pi / 2:
        return result
    if isinstance(angle, str) and any(c.isalpha() or c == "°" for c in angle):
        raise refusal("angle", angle, "must be below 90 deg: the bodies must approach")
    raise refusal("angle", angle, f"a bare angle is in radians, below pi/2; write '{angle} deg'")
