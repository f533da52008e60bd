"""The exact rebound as a table of psi_2(psi_1) at one chi and e, in series between its kinks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, Self

import numpy as np
from numpy.polynomial import chebyshev

from carom.bodies.losses import KelvinVoigt
from carom.bodies.pairs import Pair
from carom.dimensionless.lossy.law import scale_free
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.chebyshev import Panels
from carom.io.citations import IMPACT, VISCOUS, bibtex
from carom.laws.panels import LARGEST_CHI, panel_ends, panels
from carom.laws.portable import applied, lost
from carom.laws.rules import DEGREE, Rule, frozen
from carom.quantities.arrays import Array, pure_numbers
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import positive


@dataclass(frozen=True, eq=False)
class ReboundLaw:
    """The exact rebound at one chi, tabulated for arrays of impacts.

        psi_2 = psi_1 r(|psi_1|)
        psi_2 = psi_1 -+ 2 chi (1 + e) in gross slip throughout

    The ratio r (Maw, Barber & Fawcett 1976; Barber 1979, (33)) is stored as Chebyshev series on
    panels. The error is below 1e-9 for chi up to 10, where impacts have few phases, and 2e-9 above.
    With losses it is below 3e-8 max(1, |psi_1|) for e >= 0.01 and chi up to 3, and 1e-6 above.

    Parameters
    ----------
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive, up to 100; spheres have 0.5 to
        3. The table takes 20 to 70 ms up to 3, and seconds beyond 30.
    losses : KelvinVoigt, optional
        Loss of energy that is the same at all speeds, which means a restitution. The table takes
        0.1 to 0.3 s for chi up to 3, and some seconds above.

    Attributes
    ----------
    restitution : float
        Coefficient of restitution e, 1 without losses.
    edges : ndarray, shape (n + 1,)
        Ends of the panels in psi_1, from 0 to max(1, 2 chi (1 + e) - e).
    coefficients : ndarray, shape (n, 11)
        Chebyshev coefficients of r on each panel.

    Raises
    ------
    InputError
        If chi is not positive or above 100, or if the losses depend on the speed.

    Examples
    --------
    >>> import carom
    >>> law = carom.laws.ReboundLaw(1.44)
    >>> law([0.5, 1.5, -3.5, 6.0]).round(6)
    array([ 0.047131, -0.429967,  1.477247,  0.24    ])
    >>> law.nbytes < 4000
    True
    >>> lossy = carom.laws.ReboundLaw(1.44, losses=carom.KelvinVoigt(restitution=0.9))
    >>> lossy([0.5, 6.0]).round(5), round(lossy.duration, 4)
    (array([0.00384, 0.528  ]), 2.9186)
    """

    chi: float
    restitution: float
    edges: Array
    coefficients: Array

    @known_keywords
    def __init__(self, chi: float, *, losses: KelvinVoigt | None = None) -> None:
        value, e = positive("chi", chi), _restitution_of(losses)
        if value > LARGEST_CHI:
            allowed = f"must be at most {LARGEST_CHI:g} in a table; carom.rebound takes any chi"
            raise refusal("chi", chi, allowed)
        self._hold(value, e, panels(value, e))

    def _hold(self, chi: float, restitution: float, panels: Panels) -> None:
        object.__setattr__(self, "chi", chi)
        object.__setattr__(self, "restitution", restitution)
        for name, values in zip(("edges", "coefficients"), panels, strict=True):
            values.setflags(write=False)
            object.__setattr__(self, name, values)

    def __call__(self, psi: Any) -> Any:
        """Return psi_2 for an array of any library that follows the array API standard.

        Masked elements give NaN, and NaN and infinity are kept.
        """
        return applied(lambda incoming, xp: incoming - lost(incoming, self._rule, xp), "psi", psi)

    def impulse(self, psi: Any) -> Any:
        """Return the tangential impulse in units of the largest impulse of friction.

            J_t/(mu J_n) = (psi_1 - psi_2)/(2 chi (1 + e))

        It is 1 in gross slip throughout; multiplied by mu (1 + e) m_n V_1 it is in N s.

        Parameters
        ----------
        psi : array of any library that follows the array API standard
            Dimensionless tangential velocity psi_1.

        Returns
        -------
        array
            The impulse, of the library and shape of `psi`.

        Raises
        ------
        InputError
            If `psi` is not an array of numbers.

        Examples
        --------
        >>> import carom
        >>> carom.laws.ReboundLaw(1.44).impulse([0.5, 6.0]).round(3)
        array([0.079, 1.   ])
        """
        bound = self._rule.sliding
        return applied(lambda incoming, xp: lost(incoming, self._rule, xp) / bound, "psi", psi)

    def dissipation(self, psi: Any) -> Any:
        """Return the energy lost to friction, psi_1^2 - psi_2^2.

        Parameters
        ----------
        psi : array of any library that follows the array API standard
            Dimensionless tangential velocity psi_1.

        Returns
        -------
        array
            The energy in units of (m_t/2)(mu V_1/kappa)^2, of the library and shape of `psi`;
            infinite where it is too large for floating point.

        Raises
        ------
        InputError
            If `psi` is not an array of numbers.

        Examples
        --------
        >>> import carom
        >>> carom.laws.ReboundLaw(1.44).dissipation([0.5, 6.0]).round(3)
        array([ 0.248, 35.942])
        """

        def energy(incoming: Any, xp: Any) -> Any:
            change = lost(incoming, self._rule, xp)
            return change * (2.0 * incoming - change)

        return applied(energy, "psi", psi)

    @property
    def duration(self) -> float:
        """Duration of the contact in units of d_max/V_1, the same for every psi_1 (Hertz 1882).

        d_max is the largest penetration of the elastic impact.
        """
        if self.restitution == 1.0:
            return float(hertz.DURATION)
        losses, one = KelvinVoigt(restitution=self.restitution).scale_free(), np.ones(1)
        return float(lossy_rebounds(0.0 * one, one, losses).duration[0])

    @property
    def nbytes(self) -> int:
        """Size of the table in bytes."""
        return self.edges.nbytes + self.coefficients.nbytes

    def rule(self, pair: Pair) -> Rule:
        """Return the numbers that a collision of this pair needs; its chi must be the same."""
        if abs(pair.chi - self.chi) > 1e-9 * self.chi:
            raise InputError(
                f"law: it is for chi = {self.chi:.10g}, but the pair has chi = {pair.chi:.10g}; "
                "make the law with pair.chi"
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
        sliding = 2.0 * self.chi * (1.0 + self.restitution)
        return frozen(Rule(self.restitution, 1.0, sliding, self.edges, slopes, shifts, powers))

    def cite(self) -> str:
        """Return what to cite for this law, as BibTeX."""
        return bibtex(*IMPACT, *((VISCOUS,) if self.restitution < 1.0 else ()))

    def to_dict(self) -> dict[str, Any]:
        """Return the table as plain numbers and lists, for JSON; `from_dict` reads it.

        Returns
        -------
        dict
            The values `chi`, `restitution`, `edges` and `coefficients`.
        """
        return {
            "chi": self.chi,
            "restitution": self.restitution,
            "edges": self.edges.tolist(),
            "coefficients": self.coefficients.tolist(),
        }

    @classmethod
    def from_dict(cls, table: Mapping[str, Any]) -> Self:
        """Return the law of a stored table, exactly, without solving an impact.

        Parameters
        ----------
        table : mapping
            The table that `to_dict` returned, for example read from JSON.

        Returns
        -------
        ReboundLaw
            The law, with the same table.

        Raises
        ------
        InputError
            If this is not the complete table of a law.

        Examples
        --------
        >>> import carom
        >>> law = carom.laws.ReboundLaw(1.44)
        >>> carom.laws.ReboundLaw.from_dict(law.to_dict())(0.5) == law(0.5)
        True
        """
        try:
            edges, rows = (pure_numbers(name, table[name]) for name in ("edges", "coefficients"))
            chi = positive("chi", table["chi"])
            e = _restitution_of(KelvinVoigt(restitution=table.get("restitution", 1.0)))
            whole = _is_whole(chi, e, edges, rows)
        except (KeyError, IndexError, TypeError, ValueError):
            whole = False
        if not whole:
            raise InputError("table: it is not a table of ReboundLaw; give what to_dict returned")
        law = object.__new__(cls)
        law._hold(chi, e, Panels(edges, rows))
        return law

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_dict, (self.to_dict(),)

    def __repr__(self) -> str:
        if self.restitution == 1.0:
            return f"ReboundLaw(chi={self.chi!r})"
        return f"ReboundLaw(chi={self.chi!r}, losses=KelvinVoigt(restitution={self.restitution!r}))"


@lru_cache(maxsize=128)
def law_of(chi: float, losses: KelvinVoigt | None = None) -> ReboundLaw:
    """Return the law at one chi, built once."""
    return ReboundLaw(chi, losses=losses)


def _is_whole(chi: float, restitution: float, edges: Array, rows: Array) -> bool:
    """Tell whether a table is that of a law: its ends, its order, no gap in psi_2 at an edge."""
    ends, sliding = panel_ends(chi, restitution), 2.0 * chi * (1.0 + restitution)
    if rows.shape != (edges.size - 1, DEGREE + 1) or edges.ndim != 1:
        return False
    if not np.all(np.isfinite(edges)) or [edges[0], edges[-1]] != [ends[0], ends[-1]]:
        return False
    places = edges[1:]
    starts = rows @ (-1.0) ** np.arange(rows.shape[1])
    after = np.append(starts[1:], 1.0 - sliding / places[-1])
    gaps = np.abs(rows.sum(axis=1) - after) * places
    return bool(np.all(np.diff(edges) > 0.0) and np.all(gaps < 1e-8))


def _restitution_of(losses: KelvinVoigt | None) -> float:
    """Return e of a law of losses that is the same at all speeds, or raise InputError."""
    if losses is None:
        return 1.0
    scale_free(losses)
    if not isinstance(losses, KelvinVoigt):
        raise refusal("losses", losses, "a table needs KelvinVoigt(restitution=...), or no losses")
    return float(losses.restitution)
