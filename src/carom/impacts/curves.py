"""Rebound curves: psi_2 and restitution against psi_1, with the borders between regimes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, ScaleFreeLaw, scale_free
from carom.dimensionless.rebounds import answered, lossy_rebounds, rebound, regime_borders
from carom.impacts.sequences import Sequences
from carom.io.labels import labelled_dataset, pure
from carom.io.progress import Progress, advancing
from carom.quantities.arrays import POSITIVES, Array, finite_line
from carom.quantities.refusals import known_keywords, refusal

if TYPE_CHECKING:
    import xarray as xr

MOST_POINTS = 10**6  # a minute on a curve, and several on a map
SOLID_SPHERE = 2.0 / 7.0  # m_t/m_n of a solid sphere on a fixed body

REGIMES = (
    "stick from the first touch",
    "gross slip, then stick",
    "gross slip through maximum penetration, then microslip",
    "gross slip throughout",
)
AT_ONCE = 1000  # impacts: some tenths of a second
PLACE = "sequence of phases, its place in sequence_name"
MET = "sequence of phases of one impact of the map or more"
BORDER = {"units": "1", "long_name": "psi_in at which the regime changes"}


def borders(chi: float) -> tuple[float, float, float]:
    """Return the |psi_1| at which the regime changes: 1, 2 chi, 4 chi - 1.

    Up to the first the contact sticks from the first touch; up to the second it sticks after gross
    slip; from the third on it slips throughout (Barber 1979, after (34)). For chi <= 1/2 all are 1:
    what does not stick from the first touch slips throughout.

    Parameters
    ----------
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.

    Returns
    -------
    tuple of float
        The three borders, each in units of psi and not below the one before.

    Examples
    --------
    >>> from carom.impacts.curves import borders
    >>> borders(1.5)
    (1.0, 3.0, 5.0)
    """
    first, second, third = regime_borders(chi).tolist()
    return first, second, third


@known_keywords
def curve(
    chi: float | Sequence[float],
    psi_1: ArrayLike,
    *,
    losses: ScaleFreeLaw | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Return psi_2 and restitutions against psi_1, one row per chi, as a labelled dataset.

    psi_2 is exact (Maw, Barber & Fawcett 1976; Barber 1979).
    e_c = psi_2/psi_1 is that of the contact point; e_t = 1 - (2/7)(1 - e_c) that of the centre of a
    solid sphere without spin. At psi_1 = 0 both are limits.

    Parameters
    ----------
    chi : float or sequence of float
        Positive; one row for each.
    psi_1 : array_like
        psi_1 of each column.
    losses : KelvinVoigt, optional
        What the impact loses energy to: a restitution e is given.
    progress : bool or callable, optional
        Whether a progress bar is shown after two seconds, by default in a notebook and on a
        terminal; or a function that is called with the number of impacts done and their total.

    Returns
    -------
    xarray.Dataset
        psi_out, contact_restitution and tangential_restitution, pure numbers along `(chi, psi_in)`,
        NaN with one RuntimeWarning where chi is too large for `rebound`; and border `(chi,
        regime_border)`, the psi_1 at which the regime changes, 1, 2 chi, 2 chi (1 + e) - e.

    Raises
    ------
    InputError
        If a chi is not positive, psi_1 is empty, the points are more than a million, or the losses
        depend on the speed.

    Examples
    --------
    >>> carom.curve(1.44, [0.0, 1.0, 6.0]).psi_out.values.round(4)
    array([[ 0.    , -0.0612,  0.24  ]])
    """
    chis, incoming = _axes(chi, psi_1)
    rows = chis[:, np.newaxis]
    nonzero = np.where(incoming == 0.0, 1e-12, incoming)

    def solve(psi: Array, ratios: Array) -> tuple[Array, Any, str]:
        parts = []
        with advancing("solving the rebounds", psi.size, progress, unit="impacts") as advance:
            for start in range(0, psi.size, AT_ONCE):
                part = slice(start, start + AT_ONCE)
                parts.append(rebound(psi[part], ratios[part], losses=losses, return_status=True))
                advance(psi[part].size)
        return *map(np.concatenate, zip(*parts, strict=True)), ""  # type: ignore[return-value]

    outgoing = answered({"psi_1": nonzero, "chi": rows}, solve, Status, False)
    contact = outgoing / nonzero
    centre = 1.0 - SOLID_SPHERE * (1.0 - contact)
    wide, border = ("chi", "psi_in"), regime_borders(chis, *_ends(losses))
    regimes: Any = ("regime_border", list(REGIMES[1:]), {})
    attributes: dict[str, Any] = {} if losses is None else {"losses": repr(losses)}
    return labelled_dataset(
        {
            "psi_out": (wide, np.where(incoming == 0.0, 0.0, outgoing)),
            "contact_restitution": (wide, contact),
            "tangential_restitution": (wide, centre, {"note": "solid sphere without spin"}),
            "border": (("chi", "regime_border"), border, BORDER),
        },
        {"chi": chis, "psi_in": incoming, "regime_border": regimes},
        {"title": "rebound curve"} | attributes,
    )


def _axes(chi: Any, psi_1: Any) -> tuple[Array, Array]:
    """Return the values along both axes, or raise InputError; also if the points are too many."""
    chis, incoming = finite_line("chi", chi, POSITIVES, above=0.0), finite_line("psi_1", psi_1)
    if chis.size * incoming.size > MOST_POINTS:
        points = f"{chis.size} values of chi times {incoming.size} of psi_1"
        raise refusal("psi_1", points, f"at most {MOST_POINTS:,} points are solved at once")
    return chis, incoming


def _ends(losses: ScaleFreeLaw | None) -> tuple[float, float]:
    """Return e, and the speed of the centres as the surfaces turn, or raise InputError."""
    if losses is None:
        return 1.0, 0.0
    one, numbers = np.ones(1), scale_free(losses)
    values = lossy_rebounds(one, one, numbers)
    gives = 1.25 * numbers.parameter if numbers.loss == Loss.PLATE else 0.0
    return float(values.restitution[0]), float(gives * values.max_force[0])


@known_keywords
def regime_map(
    psi_1: ArrayLike,
    chi: ArrayLike,
    *,
    losses: ScaleFreeLaw | None = None,
    progress: Progress = None,
) -> xr.Dataset:
    """Return which phases follow which for every psi_1 and chi, and the borders between regimes.

    Phases are those of the exact impact (Maw, Barber & Fawcett 1976). Beyond psi_1 =
    2 chi (1 + e) - e, e = 1 without losses, the contact slips throughout. Borders are outlines of
    an image of sequences, finer than the given values, to a thousandth of an axis where three
    regimes meet, through points found by bisection. A regime between the given values that is
    nowhere wider than a thirtieth of an axis, a twentieth with losses, may be missed; what was met
    and is too narrow for an outline is among sequence_met.

    Parameters
    ----------
    psi_1, chi : array_like
        Values along either axis; chi positive.
    losses : KelvinVoigt, optional
        What the impacts lose energy to: a restitution is given.
    progress : bool or callable, optional
        As for `carom.sweep`; rows of chi are counted.

    Returns
    -------
    xarray.Dataset
        sequence `(chi, psi_in)`, the place of the sequence of phases in sequence_name, -1 where an
        impact is not resolved; sequence_name (sequence_name), the kinds of phases in order with the
        sign of slip, the commonest first; and the restitution. Borders between regimes: points
        border_psi, border_chi (border_point) in order, each on curve border_number, with an error
        of at most border_tolerance; border_left, border_right (border_curve), the sequences on
        either side of a curve, seen along its points. Outlines of the regions: points outline_psi,
        outline_chi (outline_point) in order, each on outline_number; outline_sequence (outline),
        the sequence inside; outline_region, the same for a region and the holes in it. Sequences
        that any impact on the way had: sequence_met (met).

    Raises
    ------
    InputError
        If a chi is not positive, a psi_1 not finite, either is empty, or the points are more than a
        million.

    Examples
    --------
    >>> found = carom.regime_map([0.5, 2.0, 6.0], [1.44])
    >>> print(found.sequence_name.values[found.sequence.values[0, 1]])
    gross slip +, stick, slip -, gross slip -
    """
    from carom.impacts.map_borders import border_variables  # half a second, for maps alone

    chis, incoming = _axes(chi, psi_1)
    e, _ = _ends(losses)
    sequences, rows = Sequences(losses, e), []
    with advancing("computing the map of regimes", len(chis), progress, unit="rows") as advance:
        for value in chis:
            rows.append(sequences.of(incoming, np.full(incoming.size, value)))
            advance(1)
    met = np.array(rows)
    counts = Counter(met.ravel().tolist())
    names = [sequences.names[number] for number, _ in counts.most_common()]
    names = [name for name in names if name]
    places = {name: place for place, name in enumerate(names)} | {"": -1}
    codes = np.array([places.get(name, -1) for name in sequences.names], dtype=np.int16)[met]
    found = border_variables(incoming, chis, met, sequences, progress)  # which meets more
    met_names = np.array([name for name in sequences.names if name], dtype=np.str_)
    return labelled_dataset(
        {
            "sequence": (("chi", "psi_in"), codes, pure(PLACE)),
            "restitution": e,
            **found,
            "sequence_met": ("met", met_names, {"long_name": MET}),
        },
        {"chi": chis, "psi_in": incoming, "sequence_name": ("sequence_name", names, {})},
        {"title": "map of regimes"},
    )
