"""One oblique impact with units: two bodies and their velocities in, the rebound out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypedDict, Unpack, overload

from numpy.typing import ArrayLike

from carom.bodies.checks import checked_motion, checked_pair, checked_scales
from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.impacts.exact import Impact, solve_exactly
from carom.io.progress import Progress
from carom.quantities.refusals import Faults, checked_type, known_keywords, refusal, refuse
from carom.quantities.units import Value, finite

if TYPE_CHECKING:
    from carom.impacts.boundary_elements import BoundaryElements, HalfspaceImpact


class Inputs(TypedDict, total=False):
    """How two bodies meet and what they lose, by the names of `impact`."""

    speed: Value | None
    angle: Value | None
    normal_speed: Value | None
    tangential_speed: Value | ArrayLike | None
    spin: Value | ArrayLike
    spin2: Value | ArrayLike
    normal_spin: Value
    losses: LossLaw | None
    progress: Progress


@overload
def impact(pair: Pair, *, method: Literal["exact"] = ..., **inputs: Unpack[Inputs]) -> Impact: ...
@overload
def impact(
    pair: Pair, *, method: Literal["halfspace"] | BoundaryElements, **inputs: Unpack[Inputs]
) -> HalfspaceImpact: ...
@known_keywords
def impact(
    pair: Pair,
    *,
    speed: Value | None = None,
    angle: Value | None = None,
    normal_speed: Value | None = None,
    tangential_speed: Value | ArrayLike | None = None,
    spin: Value | ArrayLike = 0.0,
    spin2: Value | ArrayLike = 0.0,
    normal_spin: Value = 0.0,
    losses: LossLaw | None = None,
    method: str | BoundaryElements = "exact",
    progress: Progress = None,
) -> Impact | HalfspaceImpact:
    """Solve one oblique impact of two bodies: exactly, within the theory, or by boundary elements.

        V_1 = V cos(theta), v_t = V sin(theta), V_x = v_t + R omega + R_2 omega_2
        psi_1 = kappa V_x/(mu V_1)

    V is the `speed`, theta the `angle`, and omega and omega_2 are the spins. The theory is that of
    Maw, Barber & Fawcett (1976) and of Barber (1979), stick (15) and gross slip (33); the boundary
    elements are those of Love (1929) and Kalker (1990), section 4.2.

    Parameters
    ----------
    pair : Pair
        The bodies and their friction.
    speed : float or str
        Speed of approach of the centres, in m/s.
    angle : float or str
        Angle of incidence from the normal; a bare number is in radians.
    normal_speed, tangential_speed : float or str
        Components of the velocity of the first body relative to the second, in m/s, instead of
        speed and angle; of a `Body` of its centre of mass, in space two tangential ones.
    spin, spin2 : float or str
        Spin of the first body, and of the second if it is a sphere, in rad/s; positive spin adds
        to the tangential speed of the contact point. Of a `Body` V_x = v_x - z omega; in space
        three, right-handed about x, y and z, which points from the second body to the first.
    normal_spin : float or str
        Spin about the line of impact of the first body, less that of the second, in rad/s;
        positive is clockwise seen from the first body. The theory neglects it, and `validity` says
        how much it may change psi_2; boundary elements solve for it.
    losses : KelvinVoigt, StandardLinearSolid, Metal or ElasticPlastic, optional
        How the impact loses energy besides friction; by default the bodies are elastic.
    method : "exact", "halfspace" or BoundaryElements
        "exact" solves the theory, in which slip is parallel to x and unlike materials do not
        couple. "halfspace" solves the full contact in three dimensions, which assumes neither, in
        two seconds, or fifteen for unlike materials. `BoundaryElements` does so with a grid and
        steps of your own.
    progress : bool or callable, optional
        Whether the boundary elements show a progress bar, by default in a notebook and on a
        terminal; or a function that is called with the number of steps done and their total.

    Returns
    -------
    Impact, BodyImpact or HalfspaceImpact
        The rebound (psi_out, rebound_angle, spin_out, restitutions, energies), the phases and
        `validity`, and methods for the rest: history, fields, plot, animate, to_dataset, cite.

    Raises
    ------
    InputError
        If a value is missing, given twice, out of range, or the bodies do not approach, or springs
        do not resolve the impact of a `Body`, as in a jam at a grazing angle.
    RuntimeError
        If the boundary elements do not converge, as where friction times Dundurs' beta exceeds 1.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
    >>> [phase.kind for phase in hit.phases]
    ['gross slip', 'stick', 'slip', 'gross slip']
    >>> round(hit.rebound_angle * 180 / 3.141592653589793, 2)
    18.6
    """
    checked_pair(pair, plates=True, any_shape=True)
    with Faults() as faults:
        speeds = {"tangential_speed": tangential_speed, "spin": spin, "spin2": spin2}
        read = faults.trying(checked_motion, pair, speed, angle, normal_speed, **speeds)
        about_normal = faults.trying(finite, "normal_spin", normal_spin)
    approaching, motion = read
    if not pair.is_round:
        spheres = "of spheres only; leave it out"
        refuse(
            about_normal and refusal("normal_spin", normal_spin, spheres),
            method != "exact" and refusal("method", method, spheres),
        )
        from carom.impacts.body_impact import solve_bodies

        return solve_bodies(pair, approaching, motion, losses)
    velocity = motion.contact_velocity(pair)
    scales = checked_scales(pair, approaching, velocity, motion[0], *motion.carried(pair))
    if isinstance(method, str) and method == "exact":
        return solve_exactly(pair, scales, motion, losses, about_normal)
    checked_pair(pair)
    elements = _elements(method, losses)
    from carom.impacts.boundary_elements import solve_by_elements

    return solve_by_elements(pair, scales, motion, about_normal, elements, progress)


def _elements(method: str | BoundaryElements, losses: LossLaw | None) -> BoundaryElements:
    from carom.impacts.boundary_elements import BoundaryElements

    named = isinstance(method, str) and method == "halfspace"
    allowed = "must be 'exact', 'halfspace' or carom.BoundaryElements(elements=, steps=)"
    elements = BoundaryElements() if named else method
    elements = checked_type("method", elements, BoundaryElements, allowed)
    if losses is not None:
        allowed = "boundary elements solve elastic bodies only; leave losses or method out"
        raise refusal("losses", losses, allowed)
    return elements
