"""Closed forms of classical tangential contact of spheres, which `load_path` reproduces."""

from math import atan
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.checks import with_friction
from carom.bodies.pairs import Pair
from carom.quantities.arrays import Array, along_the_same, numbers, together
from carom.quantities.refusals import refusal, refuse

FREE = "without friction the bodies slide freely"


class Obliquity(NamedTuple):
    """Angles of the force and of the displacement from the normal, in rad.

    Examples
    --------
    >>> carom.classical.Obliquity(force=0.1974, displacement=0.2383).force
    0.1974
    """

    force: float
    displacement: float


def cattaneo_mindlin(pair: Pair, normal_force: ArrayLike, tangential_force: ArrayLike) -> Array:
    """Return the tangential displacement under a force that grows at constant normal force.

        U = (3 mu P/(4 a G*)) (1 - (1 - T/(mu P))^(2/3))

    a is the contact radius, and U is odd in T (Cattaneo 1938, Mindlin 1949; Johnson, Contact
    Mechanics, 1985, section 7.2).

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    normal_force, tangential_force : array_like
        P > 0 and T in N, with |T| <= mu P, of shapes that broadcast.

    Returns
    -------
    numpy.ndarray
        Displacement U in m, of the broadcast shape.

    Raises
    ------
    InputError
        If P is not positive, |T| above mu P, or there is no friction.

    Examples
    --------
    >>> import numpy as np
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> path = carom.load_path(pair, normal_force="10 N", tangential_force=[0.0, 1.5])
    >>> moved = carom.classical.cattaneo_mindlin(pair, 10.0, 1.5)
    >>> bool(np.isclose(path.displacement[-1], moved, rtol=1e-12))
    True
    """
    share, most = _share(pair, normal_force, tangential_force)
    with np.errstate(divide="ignore"):
        part = -np.expm1(2.0 / 3.0 * np.log1p(-np.abs(share)))
    return np.copysign(_gross_displacement(pair, most) * part, share)


def loop_energy(pair: Pair, normal_force: ArrayLike, amplitude: ArrayLike) -> Array:
    """Return the energy lost in a cycle of a tangential force between -T and T at constant P.

        W = (18 mu^2 P^2/(5 a G*)) (1 - (1 - t)^(5/3) - (5/6) t (1 + (1 - t)^(2/3)))
        t = T/(mu P)

    Here a is the contact radius (Mindlin & Deresiewicz 1953, J. Appl. Mech. 20:327; Johnson 1985,
    section 7.4). With y = (1 - t)^(1/3) the last bracket is (1 - y)^3 (1 + 3 y + y^2)/6.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    normal_force, amplitude : array_like
        P > 0 and 0 <= T <= mu P in N, of shapes that broadcast.

    Returns
    -------
    numpy.ndarray
        Energy W in J, of the broadcast shape.

    Raises
    ------
    InputError
        If P is not positive, T not between 0 and mu P, or there is no friction.

    Examples
    --------
    >>> import numpy as np
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> path = carom.load_path(pair, normal_force=10.0, tangential_force=[0.0, 1.5, -1.5, 1.5])
    >>> lost = path.frictional_work[3] - path.frictional_work[1]
    >>> bool(np.isclose(lost, carom.classical.loop_energy(pair, 10.0, 1.5), rtol=1e-12))
    True
    """
    share, most = _share(pair, normal_force, amplitude)
    refuse(np.any(share < 0.0) and refusal("amplitude", amplitude, "must not be negative"))
    with np.errstate(divide="ignore"):
        gap = -np.expm1(np.log1p(-share) / 3.0)
    y = 1.0 - gap
    bracket = gap**3 * (1.0 + 3.0 * y + y**2) / 6.0
    return np.asarray(4.8 * most * _gross_displacement(pair, most) * bracket)


def critical_obliquity(pair: Pair) -> Obliquity:
    """Return the largest obliquity at which a load of constant direction causes no slip.

        F_x/P = mu, U/d = mu/kappa

    From the first touch up to these ratios the whole contact sticks, and unloading along the same
    line retraces the loading. Beyond them the whole contact slides (Mindlin & Deresiewicz 1953,
    J. Appl. Mech. 20:327; Johnson 1985, section 7.3).

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.

    Returns
    -------
    Obliquity
        Angles from the normal in rad: `force`, atan(mu), and `displacement`, atan(mu/kappa).

    Raises
    ------
    InputError
        If this is not a pair of bodies.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> round(carom.classical.critical_obliquity(pair).force, 4)
    0.1974
    """
    with_friction(pair, FREE)
    return Obliquity(atan(pair.friction), atan(pair.friction / pair.kappa))


def _share(pair: Pair, normal: ArrayLike, tangential: ArrayLike) -> tuple[Array, Array]:
    """Return T/(mu P), and mu P in N."""
    with_friction(pair, FREE)
    allowed = "must be finite numbers in N, shapes that broadcast"
    along_the_same(normal_force=normal, tangential_force=tangential)
    load = numbers("normal_force", normal, allowed)
    across = numbers("tangential_force", tangential, allowed)
    pressed = np.all((load > 0.0) & np.isfinite(load))
    refuse(
        not pressed and refusal("normal_force", normal, "must be positive and finite"),
        not np.all(np.isfinite(across)) and refusal("tangential_force", tangential, allowed),
    )
    shape = together({"normal_force": load, "tangential_force": across})
    most = pair.friction * np.broadcast_to(load, shape)
    with np.errstate(all="ignore"):
        share, moved = np.asarray(across / most), _gross_displacement(pair, most)
        fits = np.isfinite(most) & np.isfinite(share) & np.isfinite(most * moved)
    large = "its results are too large for floating point; check the units"
    refuse(not np.all(fits) and refusal("normal_force", normal, large))
    allowed = "Coulomb's law allows at most mu P"
    refuse(np.any(np.abs(share) > 1.0) and refusal("tangential_force", tangential, allowed))
    return share, most


def _gross_displacement(pair: Pair, most: Array) -> Array:
    """Return the displacement in m at which a growing force reaches mu P: mu d/kappa."""
    unit = pair.contact_scales(1.0).force
    return np.asarray(pair.friction / pair.kappa * (most / (pair.friction * unit)) ** (2.0 / 3.0))
