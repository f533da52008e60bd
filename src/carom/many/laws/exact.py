"""The exact rebound as a table: at one chi and e or lambda, or over a range of chi."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cached_property, lru_cache
from typing import Any, ClassVar, Self

import numpy as np
from numpy.polynomial import chebyshev

from carom.bodies.checks import checked_pair
from carom.bodies.losses import KelvinVoigt, ZenerPlate
from carom.bodies.pairs import Pair
from carom.dimensionless import rebound_tables as tables
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.law import Codes, Law
from carom.dimensionless.lossy.law import LossyRebounds, scale_free
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.patches import Patches
from carom.dimensionless.rebounds import lossy_rebounds, rebound
from carom.io.citations import IMPACT, PLATE, VISCOUS, bibtex
from carom.io.progress import advancing
from carom.many.laws.portable import applied, lost
from carom.many.laws.rules import DEGREE, Rule, frozen
from carom.quantities.arrays import Array, pure_numbers
from carom.quantities.refusals import InputError, known_keywords, refusal
from carom.quantities.statuses import WordedStatus
from carom.quantities.units import positive

SAME_RESTITUTION = 1e-9  # of a stored table and its plate
LARGEST_CHI = 100.0  # tables of larger ones would take minutes
RANGE = (0.5, 5.0)  # of chi, in which a table over a range takes minutes at most
RETURNING = 3.0  # chi above which the front of slip returns, with losses
ELASTIC, ELASTIC_RANGE, VISCOUS_SOLID, ROUGH = 4e-10, 1e-8, 1e-8, 2e-7  # tolerances of tables
OneLoss = KelvinVoigt | ZenerPlate  # the same at all speeds


@dataclass(frozen=True, eq=False)
class ReboundLaw(Law):
    """The exact rebound, tabulated for arrays of impacts: at one chi, or over a range of it.

        psi_2 = psi_1 r(|psi_1|, chi)
        psi_2 = psi_1 -+ 2 chi (1 + e) in gross slip throughout

    The ratio r (Maw, Barber & Fawcett 1976; Barber 1979, (33)) is stored as Chebyshev series on
    patches between the regime borders. At one chi the error is below 1e-9 for chi up to 10, where
    impacts have few phases, and 2e-9 above; with losses below 3e-8 max(1, |psi_1|) for e >= 0.01
    and chi up to 3, and 1e-6 above. Over a range of chi it is below 1e-7, with losses 1e-6. On a
    plate that gives way it is that of elastic bodies on a thick wall.

    Parameters
    ----------
    chi : float, or two of them
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive, up to 100; spheres have 0.5 to
        3. The table takes 20 to 70 ms up to 3, and seconds beyond 30. Or a range within 0.5 to 5:
        0.1 s for (1.2, 1.5), a second for (0.9, 1.8), and several seconds for chi beyond 2.
    losses : KelvinVoigt or ZenerPlate, optional
        Loss that is the same at all speeds: a restitution, or a plate at one lambda and one chi.
        The table of a viscous solid takes 0.1 to 0.3 s for chi up to 3, and some seconds above;
        over a range some ten times as long. That of a plate takes 0.02 to 0.2 s up to 3.

    Attributes
    ----------
    restitution : float
        Coefficient of restitution e, 1 without losses.
    inelasticity : float
        Zener's parameter of a plate, 0 of a thick wall.
    edges : ndarray, shape (n + 1,)
        Ends of the panels in psi_1, from 0 to max(1, 2 chi (1 + e) - e); empty for a range.
    coefficients : ndarray, shape (n, 11)
        Chebyshev coefficients of r on each panel; empty for a range.

    Raises
    ------
    InputError
        If chi is not positive or above 100, if a range is empty, goes beyond 0.5 to 5 or comes with
        a plate, or if the losses depend on the speed.

    Examples
    --------
    >>> law = carom.laws.ReboundLaw(1.44)
    >>> law([0.5, 1.5, -3.5, 6.0]).round(6)
    array([ 0.047131, -0.429967,  1.477247,  0.24    ])
    >>> carom.laws.ReboundLaw((1.2, 1.5))([0.5, 1.5, -3.5], [1.25, 1.44, 1.5]).round(6)
    array([-0.079793, -0.429967,  1.471999])
    >>> lossy = carom.laws.ReboundLaw(1.44, losses=carom.KelvinVoigt(restitution=0.9))
    >>> lossy([0.5, 6.0]).round(5), round(lossy.duration, 4)
    (array([0.00384, 0.528  ]), 2.9186)
    """

    name: ClassVar[str] = "exact rebound"
    source: ClassVar[str] = "Maw, Barber & Fawcett (1976), Wear 38:101"
    _statuses: ClassVar[type[WordedStatus]] = Status

    chi: float | tuple[float, float]
    restitution: float
    edges: Array
    coefficients: Array
    _table: Patches | None  # over a range
    inelasticity: float

    @known_keywords
    def __init__(self, chi: float | tuple[float, float], *, losses: OneLoss | None = None) -> None:
        e, wide = _restitution_of(losses), isinstance(chi, tuple | list) and len(chi) == 2
        plate = losses if isinstance(losses, ZenerPlate) and e < 1.0 else None
        ends: Any = chi if wide else (chi, chi)
        low, high = (positive("chi", each) for each in ends)
        if wide and not RANGE[0] <= low < high <= RANGE[1]:
            allowed = "must be a range within {:g} to {:g}; carom.rebound takes any chi"
            raise refusal("chi", (low, high), allowed.format(*RANGE))
        if wide and plate is not None:
            raise refusal("chi", (low, high), "the table of a plate is for one chi; give one")
        if high > LARGEST_CHI:
            allowed = f"must be at most {LARGEST_CHI:g} in a table; carom.rebound takes any chi"
            raise refusal("chi", chi, allowed)
        degrees = (8, 8, 8 if wide and e == 1.0 else DEGREE)
        tolerance = ELASTIC_RANGE if wide else ELASTIC
        if e < 1.0 and plate is None:
            tolerance = ROUGH if wide or high > RETURNING else VISCOUS_SOLID
        give = 0.0 if plate is None else plate._scale_free().parameter
        with advancing("tabulating the rebounds", None, unit="impacts") as advance:
            more: Any = {"degrees": degrees, "give": give}
            table = tables.tabulated((low, high), (e, e), tolerance, advance, **more)
        inelasticity = 0.0 if plate is None else float(plate.inelasticity)
        if wide:
            self._hold((low, high), e, np.empty(0), np.empty((0, 0)), table, inelasticity)
        else:
            self._hold(low, e, *tables.panels(table, low, e), None, inelasticity)

    def _hold(self, *values: Any) -> Self:
        for field, value in zip(fields(self), values, strict=True):
            object.__setattr__(self, field.name, value)
        for array in (self.edges, self.coefficients):
            array.setflags(write=False)
        return self

    @classmethod
    def _of(cls, *values: Any) -> Self:
        return object.__new__(cls)._hold(*values)

    @known_keywords
    def __call__(self, psi_1: Any, chi: Any = None, *, return_status: bool = False) -> Any:
        """Return psi_2 for an array of any library that follows the array API standard.

        Masked elements give NaN, and NaN and infinity are kept. A law over a range needs chi, too,
        and takes NumPy arrays; where chi is outside of the range, impacts are solved, and
        `return_status` asks for a `Status` of each.
        """
        if chi is None and not return_status:
            rule = self._rule
            return applied(lambda psi, xp: psi - lost(psi, rule, xp), "psi_1", psi_1)
        own = self._one_chi() if chi is None else chi
        outgoing = self.rebound(psi_1, own, return_status=return_status)
        return outgoing if return_status else np.asarray(outgoing)[()]

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        result, status = np.empty(psi.size), np.zeros(psi.size, dtype=np.int8)
        low, high = self._ends
        inside = (low <= chi) & (chi <= high) & (np.abs(psi) < np.inf)
        some = slice(None) if np.all(inside) else inside  # without copies
        if self._table is None:
            result[some] = psi[some] - lost(psi[some], self._rule, np)
        else:
            impacts = psi[some, np.newaxis], chi[some], np.full(inside.sum(), self.restitution)
            result[some] = tables.psi_out(self._table, *impacts)[:, 0]
        if not np.all(inside):
            result[~inside], status[~inside] = rebound(
                psi[~inside], chi[~inside], losses=self._losses, threads=threads, return_status=True
            )
        return result, status

    @property
    def _ends(self) -> tuple[float, float]:
        return self.chi if isinstance(self.chi, tuple) else (self.chi, self.chi)

    def _one_chi(self) -> float:
        if isinstance(self.chi, tuple):
            raise InputError("chi: the law is for a range; make one of one chi")
        return self.chi

    @property
    def _losses(self) -> OneLoss | None:
        if self.inelasticity > 0.0:
            return ZenerPlate(inelasticity=self.inelasticity)
        return None if self.restitution == 1.0 else KelvinVoigt(restitution=self.restitution)

    def _damped(self, restitution: float) -> ReboundLaw:
        """Return the law of another restitution, which is tabulated anew."""
        return ReboundLaw(self.chi, losses=KelvinVoigt(restitution=restitution))

    @known_keywords
    def impulse(self, psi_1: Any) -> Any:
        """Return the tangential impulse in units of the largest impulse of friction.

            J_t/(mu J_n) = (psi_1 - psi_2)/(2 chi (1 + e))

        It is 1 in gross slip throughout; multiplied by mu (1 + e) m_n V_1 it is in N s.

        Parameters
        ----------
        psi_1 : array of any library that follows the array API standard
            Dimensionless tangential velocity psi_1.

        Returns
        -------
        array
            The impulse, of the library and shape of `psi_1`.

        Raises
        ------
        InputError
            If `psi_1` is not an array of numbers.

        Examples
        --------
        >>> carom.laws.ReboundLaw(1.44).impulse([0.5, 6.0]).round(3)
        array([0.079, 1.   ])
        """
        bound = self._rule.sliding
        return applied(lambda incoming, xp: lost(incoming, self._rule, xp) / bound, "psi_1", psi_1)

    @known_keywords
    def dissipation(self, psi_1: Any) -> Any:
        """Return the energy lost to friction, psi_1^2 - psi_2^2.

        Parameters
        ----------
        psi_1 : array
            As for `impulse`.

        Returns
        -------
        array
            The energy in units of (m_t/2)(mu V_1/kappa)^2, of the library and shape of `psi_1`;
            infinite where it is too large for floating point.

        Raises
        ------
        InputError
            If `psi_1` is not an array of numbers.

        Examples
        --------
        >>> carom.laws.ReboundLaw(1.44).dissipation([0.5, 6.0]).round(3)
        array([ 0.248, 35.942])
        """

        def energy(incoming: Any, xp: Any) -> Any:
            change = lost(incoming, self._rule, xp)
            return change * (2.0 * incoming - change)

        return applied(energy, "psi_1", psi_1)

    @property
    def duration(self) -> float:
        """Duration of the contact, as any psi_1 has it, in d_max/V_1 of Hertz (1882)."""
        return float(hertz.DURATION if self._losses is None else _head_on(self._losses).duration[0])

    @property
    def nbytes(self) -> int:
        """Size of the table in bytes."""
        parts = self._table or (self.edges, self.coefficients)
        return sum(part.nbytes for part in parts)

    def rule(self, pair: Pair) -> Rule:
        """Return the numbers that a collision of this pair needs; its chi must be the law's."""
        chi, (low, high) = checked_pair(pair, plates=self.inelasticity > 0.0).chi, self._ends
        if not (low <= chi <= high or abs(chi - low) <= 1e-9 * low == 1e-9 * high):
            own = f"{low:.10g}" if low == high else f"{low:.10g} to {high:.10g}"
            raise InputError(
                f"law: it is for chi = {own}, but the pair has chi = {chi:.10g}; "
                "make the law with pair.chi"
            )
        rule = self._rule if self._table is None else _section(self, chi)._rule
        if pair.friction == 0.0:
            return rule._replace(sliding=0.0)
        return rule._replace(scale=pair.kappa / pair.friction)

    @cached_property
    def _rule(self) -> Rule:
        """The table in powers, with a last panel on which sliding alone counts."""
        chi = self._one_chi()
        low, high = self.edges[:-1], self.edges[1:]
        powers = np.zeros((self.edges.size, DEGREE + 1))
        rows = [-chebyshev.cheb2poly(row) for row in self.coefficients]
        powers[:-1, : self.coefficients.shape[1]] = rows
        powers[:-1, 0] += 1.0
        powers[-1, 0] = 2.0
        slopes = np.append(2.0 / (high - low), 0.0)
        shifts = np.append(-(high + low) / (high - low), 0.0)
        sliding = 2.0 * chi * (1.0 + self.restitution)
        return frozen(Rule(self.restitution, 1.0, sliding, self.edges, slopes, shifts, powers))

    def cite(self) -> str:
        """Return what to cite for this law, as BibTeX."""
        loss = PLATE if self.inelasticity > 0.0 else VISCOUS
        return bibtex(*IMPACT, *((loss,) if self.restitution < 1.0 else ()))

    def to_dict(self) -> dict[str, Any]:
        """Return the table as plain numbers and lists, for JSON; `from_dict` reads it.

        It has `chi`, `restitution`, `edges` and `coefficients`, of a plate also `inelasticity`.

        Raises
        ------
        InputError
            If the law is for a range of chi; pickle it.
        """
        return {
            "chi": self._one_chi(),
            "restitution": self.restitution,
            "edges": self.edges.tolist(),
            "coefficients": self.coefficients.tolist(),
            **({"inelasticity": self.inelasticity} if self.inelasticity > 0.0 else {}),
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
        >>> law = carom.laws.ReboundLaw(1.44)
        >>> carom.laws.ReboundLaw.from_dict(law.to_dict())(0.5) == law(0.5)
        True
        """
        try:
            edges, rows = (pure_numbers(name, table[name]) for name in ("edges", "coefficients"))
            chi = positive("chi", table["chi"])
            e = _restitution_of(KelvinVoigt(restitution=table.get("restitution", 1.0)))
            plate = ZenerPlate(inelasticity=table.get("inelasticity", 0.0))
            inelasticity = float(plate.inelasticity)
            whole = tables.is_whole(chi, e, edges, rows, DEGREE + 1, inelasticity > 0.0)
            whole &= inelasticity == 0.0 or abs(_restitution_of(plate) - e) < SAME_RESTITUTION
        except (KeyError, IndexError, TypeError, ValueError):
            whole = False
        if not whole:
            raise InputError("table: it is not a table of ReboundLaw; give what to_dict returned")
        return cls._of(chi, e, edges, rows, None, inelasticity)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self)._of, tuple(getattr(self, field.name) for field in fields(self))

    def __repr__(self) -> str:
        if self.inelasticity > 0.0:
            return f"ReboundLaw(chi={self.chi!r}, losses={self._losses!r})"
        if self.restitution == 1.0:
            return f"ReboundLaw(chi={self.chi!r})"
        return f"ReboundLaw(chi={self.chi!r}, losses=KelvinVoigt(restitution={self.restitution!r}))"


@lru_cache(maxsize=128)
def _section(law: ReboundLaw, chi: float) -> ReboundLaw:
    """Return the law at one chi of a range, without solving an impact."""
    assert law._table is not None
    panels = tables.panels(law._table, chi, law.restitution)
    return ReboundLaw._of(chi, law.restitution, *panels, None, 0.0)


@lru_cache(maxsize=128)
def law_of(chi: float, losses: OneLoss | None = None) -> ReboundLaw:
    """Return the law at one chi, built once."""
    return ReboundLaw(chi, losses=losses)


def _restitution_of(losses: OneLoss | None) -> float:
    """Return e of a law of losses that is the same at all speeds, or raise InputError."""
    if losses is None:
        return 1.0
    scale_free(losses)
    if isinstance(losses, KelvinVoigt):
        return float(losses.restitution)
    if isinstance(losses, ZenerPlate):
        return float(_head_on(losses).restitution[0])
    solids = "KelvinVoigt(restitution=...), ZenerPlate(inelasticity=...)"
    raise refusal("losses", losses, f"a table needs {solids} or no losses")


def _head_on(losses: OneLoss) -> LossyRebounds:
    """Return what a central impact comes to."""
    return lossy_rebounds(np.zeros(1), np.ones(1), losses._scale_free())
