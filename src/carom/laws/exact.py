"""The exact rebound as a table: psi_2(psi_1) at one chi, as Chebyshev series between its kinks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, Self

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from carom.dimensionless import hertz
from carom.dimensionless.chebyshev import Panels, fitted
from carom.dimensionless.phases import Status
from carom.dimensionless.rebounds import solved
from carom.laws.portable import applied, lost
from carom.laws.rules import DEGREE, Rule, frozen
from carom.pairs import Pair
from carom.quantities import InputError, positive, refusal

Array = NDArray[np.float64]

SMALLEST = 1e-6  # psi_1: below, r is that of the first panel
TOLERANCE = 4e-10  # of the tail of a series; the error stays below 1e-9


@dataclass(frozen=True, eq=False)
class ReboundLaw:
    """The exact rebound at one chi, tabulated to 1e-9 for chi up to 10.

    psi_2 = psi_1 r(|psi_1|), r as Chebyshev series on panels up to the border of gross slip
    throughout, psi_2 = psi_1 -+ 4 chi from there on (Maw, Barber & Fawcett 1976; Barber (33)).

    Parameters
    ----------
    chi : float
        (kappa/2)(m_n/m_t), positive; spheres have 0.5 to 3. Made in 20 to 70 ms up to 3, in seconds
        beyond 30. Beyond 10 impacts have many phases, and the error reaches 2e-9.

    Attributes
    ----------
    edges : ndarray, shape (n + 1,)
        psi_1 at which panels begin and end, from 0 to max(1, 4 chi - 1).
    coefficients : ndarray, shape (n, 11)
        Chebyshev coefficients of r on each panel.

    Raises
    ------
    InputError
        If chi is not positive, or too large for `rebound` to solve.

    Examples
    --------
    >>> import carom
    >>> law = carom.ReboundLaw(1.44)
    >>> law([0.5, 1.5, -3.5, 6.0]).round(6)
    array([ 0.047131, -0.429967,  1.477247,  0.24    ])
    >>> law.nbytes < 4000
    True
    """

    chi: float
    edges: Array
    coefficients: Array

    def __init__(self, chi: float) -> None:
        value = positive("chi", chi)
        self._hold(value, _panels(value))

    def _hold(self, chi: float, panels: Panels) -> None:
        object.__setattr__(self, "chi", chi)
        for name, values in zip(("edges", "coefficients"), panels, strict=True):
            values.setflags(write=False)
            object.__setattr__(self, name, values)

    def __call__(self, psi: Any) -> Any:
        """Return psi_2 for an array of any library that follows the array API standard."""
        return applied(lambda incoming, xp: incoming - lost(incoming, self._rule, xp), "psi", psi)

    def impulse(self, psi: Any) -> Any:
        """Return tangential impulse over friction times normal impulse, (psi_1 - psi_2)/(4 chi).

        It is 1 in gross slip throughout; mu 2 m_n V_1 makes it N s.
        """
        bound = self._rule.sliding
        return applied(lambda incoming, xp: lost(incoming, self._rule, xp) / bound, "psi", psi)

    def dissipation(self, psi: Any) -> Any:
        """Return the dissipated energy psi_1^2 - psi_2^2; (m_t/2)(mu V_1/kappa)^2 makes it J."""

        def energy(incoming: Any, xp: Any) -> Any:
            change = lost(incoming, self._rule, xp)
            return change * (2.0 * incoming - change)

        return applied(energy, "psi", psi)

    @property
    def duration(self) -> float:
        """Duration of the contact in units of d_max/V_1; the same for every psi_1 (Hertz 1882)."""
        return float(hertz.DURATION)

    @property
    def nbytes(self) -> int:
        """Size of the table."""
        return self.edges.nbytes + self.coefficients.nbytes

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs; InputError if its chi is another."""
        if abs(pair.chi - self.chi) > 1e-9 * self.chi:
            raise InputError(
                f"law: it is for chi = {self.chi:.10g}, the pair has chi = {pair.chi:.10g}; "
                "make ReboundLaw(pair.chi)"
            )
        if pair.friction == 0.0:
            return self._rule._replace(sliding=0.0)
        return self._rule._replace(scale=pair.kappa / pair.friction)

    @cached_property
    def _rule(self) -> Rule:
        """The table in powers, with a last panel on which sliding alone counts."""
        low, high = self.edges[:-1], self.edges[1:]
        powers = np.zeros((self.edges.size, DEGREE + 1))
        powers[:-1] = [-chebyshev.cheb2poly(row) for row in self.coefficients]
        powers[:-1, 0] += 1.0
        powers[-1, 0] = 2.0
        slopes = np.append(2.0 / (high - low), 0.0)
        shifts = np.append(-(high + low) / (high - low), 0.0)
        return frozen(Rule(1.0, 1.0, 4.0 * self.chi, self.edges, slopes, shifts, powers))

    def to_dict(self) -> dict[str, Any]:
        """Return the table as plain numbers and lists, for JSON; `from_dict` takes it back."""
        return {
            "chi": self.chi,
            "edges": self.edges.tolist(),
            "coefficients": self.coefficients.tolist(),
        }

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Return the law of a stored table, to the last bit, without solving an impact."""
        try:
            edges, rows = (np.array(table[name], float) for name in ("edges", "coefficients"))
            chi = positive("chi", table["chi"])
            whole = _is_whole(chi, edges, rows)
        except (KeyError, TypeError, ValueError):
            whole = False
        if not whole:
            raise InputError("table: not one of a ReboundLaw; give what to_dict returned")
        law = object.__new__(cls)
        law._hold(chi, Panels(edges, rows))
        return law

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_dict, (self.to_dict(),)

    def __repr__(self) -> str:
        return f"ReboundLaw(chi={self.chi!r})"


@lru_cache(maxsize=128)
def law_of(chi: float) -> ReboundLaw:
    """Return the law at one chi, built once."""
    return ReboundLaw(chi)


def _borders(chi: float) -> list[float]:
    return [SMALLEST, 1.0] if chi <= 0.5 else [SMALLEST, 1.0, 2.0 * chi, 4.0 * chi - 1.0]


def _is_whole(chi: float, edges: Array, rows: Array) -> bool:
    """Tell whether a table is that of a law: its ends, its order, no gap in psi_2 at an edge."""
    borders = _borders(chi)
    if rows.shape != (edges.size - 1, DEGREE + 1) or edges.ndim != 1:
        return False
    ends = edges[0] == borders[0] and edges[-1] == borders[-1]
    if not np.all(np.isfinite(edges)):
        return False
    starts = rows @ (-1.0) ** np.arange(rows.shape[1])
    after = np.append(starts[1:], 1.0 - 4.0 * chi / borders[-1])
    gaps = np.abs(rows.sum(axis=1) - after) * edges[1:]
    return bool(ends and np.all(np.diff(edges) > 0.0) and np.all(gaps < 1e-8))


def _panels(chi: float) -> Panels:
    """Return the table of r = psi_2/psi_1 between the regime borders."""

    def ratio(psi: Array) -> tuple[Array, NDArray[np.int64]]:
        outgoing, status, sequence = solved(psi, np.full(psi.size, chi))
        if np.any(status):
            message = Status(int(status[status != 0][0])).message
            raise refusal("chi", chi, f"its rebounds are {message}")
        return outgoing / psi, sequence

    return fitted(ratio, _borders(chi), DEGREE, TOLERANCE, singular=(1.0,))
