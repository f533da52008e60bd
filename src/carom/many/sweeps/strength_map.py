"""Which speeds bodies bear, over the angle of incidence and the coefficient of friction."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.cases import case_of
from carom.bodies.checks import checked_pair
from carom.bodies.pairs import Pair
from carom.impacts.peaks import UNCOUPLED
from carom.impacts.validity import WEAK_COUPLING
from carom.io.progress import Progress
from carom.many.sweeps import sweep
from carom.many.sweeps.designs import Grid
from carom.many.sweeps.points import BEARABLE, WANTED, needed_by
from carom.quantities.refusals import InputError, known_keywords

if TYPE_CHECKING:
    import xarray as xr

BOUNDS = "speeds above the lower yield speed hold for elastic bodies, and so are lower bounds"
USUAL_ANGLES = np.linspace(0.0, 85.0, 18) * (pi / 180.0)


@known_keywords
def bearable_speeds(
    pair: Pair,
    *,
    angle: ArrayLike | None = None,
    friction: ArrayLike | None = None,
    workers: int | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Return the speeds above which bodies yield or crack, against angle and friction.

    At one angle the largest stress of an elastic impact grows as V^(2/5). Hence a body yields above
    V_Y = V (Y/sigma_M)^(5/2), with the largest von Mises stress sigma_M of the whole impact
    (`Impact.peaks`), and exceeds its tensile strength above V_t, which follows in the same way from
    the largest tensile stress. Flaws up to the flaw size grow into cracks above V_c, the speed at
    which K = K_c; for small contacts by Auerbach's law (1891). Without friction, for nu = 0.3, a
    sphere yields at a pressure of 1.6 Y (Johnson 1985, section 6.1). If flaws are known, use V_c
    and not V_t: a tensile strength measured in bending is exceeded beside a contact long before
    flaws crack, as the stress there falls with the depth.

    Parameters
    ----------
    pair : Pair
        The bodies. The materials to be judged need a yield_strength, a tensile_strength, or
        fracture_toughness and flaw_size.
    angle : array_like, optional
        Angles of incidence from the normal, in rad or as text; by default 18 up to 85 degrees.
    friction : array_like, optional
        Coefficients of friction; by default that of the pair.
    workers, progress : optional
        As for `sweep`.

    Returns
    -------
    xarray.Dataset
        Along `friction` and `angle`: yield_speed_first, tensile_speed_first, crack_speed_first and
        the same for the second body in m/s, as far as the strengths are known, inf for never; and
        `status`. Speeds above the lower of both yield speeds are lower bounds, as the pressure is
        smaller once a body yields. The attribute `notes` says so, and names what the theory
        neglects for unlike materials.

    Raises
    ------
    InputError
        If no strength is known, or angles and frictions are not numbers. A number that is out of
        range raises nothing; its status says so.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="bearing steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="bearing steel"), friction=0.2)
    >>> found = carom.bearable_speeds(pair, angle=["0 deg", "60 deg"])
    >>> found.yield_speed_second.round(2).values
    array([[0.87, 1.62]])
    """
    checked_pair(pair)
    outputs = _speeds_known(pair)
    axes = {
        "friction": pair.friction if friction is None else friction,
        "angle": USUAL_ANGLES if angle is None else angle,
    }
    case = {**case_of(pair), "speed": 1.0}  # the speeds that bodies bear are multiples of it
    lists = {n: [v] if isinstance(v, int | float | str) else v for n, v in axes.items()}
    speeds = sweep(case, Grid(lists), outputs=outputs, workers=workers, progress=progress)
    notes = [BOUNDS] + [UNCOUPLED] * (abs(pair.dundurs_beta) > WEAK_COUPLING)
    return speeds.assign_attrs(title="speeds that bodies bear", notes="; ".join(notes))


def _speeds_known(pair: Pair) -> list[str]:
    """Return which speeds the strengths of a pair give, or raise InputError if none."""
    names = []
    for name, (quantity, body) in WANTED.items():
        stuff = getattr(pair, body).material
        known = all(getattr(stuff, strength) is not None for strength in needed_by(name))
        if quantity in BEARABLE and known and not stuff.is_rigid:
            names.append(name)
    if not names:
        raise InputError(
            "strength: no strength of either body is known; give yield_strength, tensile_strength, "
            "or fracture_toughness with flaw_size, to carom.Material or carom.material(name, ...)"
        )
    return names
