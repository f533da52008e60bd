"""Which speeds bodies bear, over the angle of incidence and the coefficient of friction."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.pairs import Pair
from carom.impacts.peaks import UNCOUPLED
from carom.impacts.validity import WEAK_COUPLING
from carom.io.progress import Progress
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import refusal
from carom.sweeps import sweep
from carom.sweeps.designs import Grid
from carom.sweeps.strength import speeds_known, unit_case

if TYPE_CHECKING:
    import xarray as xr

BOUNDS = "speeds above the lower yield speed hold for elastic bodies, and so are lower bounds"
ANGLES = np.linspace(0.0, 85.0, 18) * (pi / 180.0)  # where none are given


@known_keywords
def strength(
    pair: Pair,
    *,
    angle: ArrayLike | None = None,
    friction: ArrayLike | None = None,
    workers: int | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Return the speeds from which on bodies yield or crack, against angle and friction.

    The largest stress of an elastic impact grows as V^(2/5) at one angle, so that
    V_Y = V (Y/sigma_M)^(5/2), and V_t likewise of the tensile strength, with the largest von Mises
    and tensile stress over the whole impact (`Impact.peaks`). Flaws up to the flaw size crack from
    the speed on at which K = K_c; where the contact is so small that deeper flaws are pulled at
    less, the force for that is proportional to the radius: Auerbach's law (1891). Without friction,
    nu = 0.3, a sphere yields at a pressure of 1.6 Y (Johnson 1985, section 6.1). Of V_t and V_c
    take the second where flaws are known: a tensile strength that is measured in bending is
    exceeded long before flaws crack in the stress beside a contact, which falls with the depth.

    Parameters
    ----------
    pair : Pair
        The bodies, with yield_strength, tensile_strength, or fracture_toughness and flaw_size, of
        the materials that are to be judged.
    angle : array_like, optional
        Angles of incidence from the normal, in rad or as text; by default 18 up to 85 degrees.
    friction : array_like, optional
        Coefficients of friction; by default that of the pair.
    workers : int, optional
        Threads, by default one for each core.
    progress : bool or callable, optional
        As `sweep` takes it.

    Returns
    -------
    xarray.Dataset
        Along `friction` and `angle`: yield_speed_first, tensile_speed_first, crack_speed_first and
        the same of the second body in m/s, those that the strengths give, inf for never; `status`.
        Speeds above the lower of both yield speeds are lower bounds: bodies that yield are pressed
        less. The attribute `notes` says so, and of unlike materials what the theory leaves out.

    Raises
    ------
    InputError
        If no strength is known, or angles and frictions are no numbers. One that is out of range
        raises nothing; its status says so.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="bearing steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="bearing steel"), friction=0.2)
    >>> found = carom.strength(pair, angle=["0 deg", "60 deg"])
    >>> found.yield_speed_second.round(2).values
    array([[0.87, 1.62]])
    """
    if not isinstance(pair, Pair):
        raise refusal("pair", pair, "must be a Pair of bodies; make one with carom.Pair")
    outputs = speeds_known(pair)
    axes = {
        "friction": pair.friction if friction is None else friction,
        "angle": ANGLES if angle is None else angle,
    }
    grid = Grid({name: _listed(values) for name, values in axes.items()})
    found = sweep(unit_case(pair), grid, outputs=list(outputs), workers=workers, progress=progress)
    notes = [BOUNDS] + [UNCOUPLED] * (abs(pair.dundurs_beta) > WEAK_COUPLING)
    return found.assign_attrs(title="speeds that bodies bear", notes="; ".join(notes))


def _listed(values: ArrayLike) -> ArrayLike:
    return [values] if isinstance(values, int | float | str) else values
