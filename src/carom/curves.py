"""Rebound curves: psi_2 and restitution against psi_1, with the borders between regimes."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.rebounds import rebound
from carom.quantities import positive, refusal
from carom.results import attributes, carom_version

if TYPE_CHECKING:
    import xarray as xr

SOLID_SPHERE = 2.0 / 7.0  # m_t/m_n of a solid sphere on a fixed body

REGIMES = (
    "stick from the first touch",
    "gross slip, then stick",
    "gross slip through maximum penetration, then microslip",
    "gross slip throughout",
)


def borders(chi: float) -> tuple[float, float, float]:
    """Return the |psi_1| at which the regime changes: 1, 2 chi, 4 chi - 1.

    Up to the first the contact sticks from the first touch; up to the second it sticks after gross
    slip; from the third on it slips throughout (Barber 1979, after (34)). For chi <= 1/2 all are 1:
    what does not stick from the first touch slips throughout.
    """
    if chi <= 0.5:
        return 1.0, 1.0, 1.0
    return 1.0, 2.0 * chi, 4.0 * chi - 1.0


def curve(chi: float | Sequence[float], psi: ArrayLike) -> "xr.Dataset":
    """Return psi_2 and restitutions against psi_1, one row per chi, as a labelled dataset.

    e_c = psi_2/psi_1 is that of the contact point; e_t = 1 - (2/7)(1 - e_c) that of the centre of a
    solid sphere without spin. At psi_1 = 0 both are limits.

    Raises InputError for a chi that is not positive or an empty psi.

    Examples
    --------
    >>> import carom
    >>> carom.curve(1.44, [0.0, 1.0, 6.0]).psi_out.values.round(4)
    array([[ 0.    , -0.0612,  0.24  ]])
    """
    import xarray as xr

    chis = [positive("chi", value) for value in np.atleast_1d(np.asarray(chi, dtype=object))]
    try:
        incoming = np.atleast_1d(np.asarray(psi, dtype=np.float64))
    except (TypeError, ValueError):
        raise refusal("psi", psi, "must be a list of finite numbers") from None
    if not chis:
        raise refusal("chi", chi, "must be one positive number or more")
    if incoming.size == 0 or incoming.ndim > 1 or not np.all(np.isfinite(incoming)):
        raise refusal("psi", psi, "must be a list of finite numbers")
    rows = np.array(chis)[:, np.newaxis]
    outgoing = rebound(incoming, rows)
    nonzero = np.where(incoming == 0.0, 1e-12, incoming)
    contact = rebound(nonzero, rows) / nonzero
    wide = ("chi", "psi_in")
    variables: dict[str, Any] = {
        "psi_out": (wide, outgoing, attributes("psi_out")),
        "contact_restitution": (wide, contact, attributes("contact_restitution")),
        "tangential_restitution": (
            wide,
            1.0 - SOLID_SPHERE * (1.0 - contact),
            attributes("tangential_restitution") | {"note": "solid sphere without spin"},
        ),
        "border": (
            ("chi", "regime_border"),
            np.array([borders(value) for value in chis]),
            {"units": "1", "long_name": "psi_in at which the regime changes"},
        ),
    }
    coordinates: dict[str, Any] = {
        "chi": ("chi", np.array(chis), attributes("chi")),
        "psi_in": ("psi_in", incoming, attributes("psi_in")),
        "regime_border": ("regime_border", list(REGIMES[1:])),
    }
    attrs = {"title": "rebound curve", "carom_version": carom_version()}
    return xr.Dataset(variables, coords=coordinates, attrs=attrs)
