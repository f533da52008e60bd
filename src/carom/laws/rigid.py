"""Laws of rigid spheres that simulations use in place of the exact one: smooth, rough, Walton's."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from carom.laws.rules import Rule, constant_rule
from carom.pairs import Pair
from carom.quantities import not_negative, number, refusal


def _ratio(name: str, value: float, least: float) -> float:
    result = number(name, value, "1")
    if not least <= result <= 1.0:
        raise refusal(name, value, f"must lie between {least:g} and 1")
    return result


@dataclass(frozen=True, init=False)
class SmoothLaw:
    """Smooth spheres: V_n' = -e V_n, V_t' = V_t; spins never change.

    Parameters
    ----------
    restitution : float
        e, from 0 to 1.

    Raises
    ------
    InputError
        If e is out of range.

    Examples
    --------
    >>> import carom
    >>> carom.SmoothLaw(restitution=0.9)
    SmoothLaw(restitution=0.9)
    """

    restitution: float

    def __init__(self, *, restitution: float = 1.0) -> None:
        object.__setattr__(self, "restitution", _ratio("restitution", restitution, 0.0))

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs."""
        return constant_rule(self.restitution, 1.0, 0.0, 0.0)


@dataclass(frozen=True, init=False)
class RoughLaw:
    """Perfectly rough spheres: V_n' = -e V_n, V_t' = -V_t (Bryan 1894; Pidduck 1922).

    Parameters
    ----------
    restitution : float
        e, from 0 to 1; with 1 no energy is lost.

    Raises
    ------
    InputError
        If e is out of range.

    Examples
    --------
    >>> import carom
    >>> carom.RoughLaw()
    RoughLaw(restitution=1.0)
    """

    restitution: float

    def __init__(self, *, restitution: float = 1.0) -> None:
        object.__setattr__(self, "restitution", _ratio("restitution", restitution, 0.0))

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs."""
        return constant_rule(self.restitution, 1.0, inf, 2.0)


@dataclass(frozen=True, init=False)
class WaltonLaw:
    """Walton's three parameters: e, friction mu while it slides, beta_0 where it does not.

    |J_t| = min(m_t (1 + beta_0) |V_t|, mu |J_n|), J_n = (1 + e) m_n V_n (Walton 1993; Foerster,
    Louge, Chang & Allia 1994, (11)-(13)).

    Parameters
    ----------
    friction : float
        mu, zero or positive.
    restitution : float
        e, from 0 to 1.
    tangential_restitution : float
        beta_0 = -V_t'/V_t of the contact point, from -1 (smooth) to 1 (perfectly rough).

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> law = carom.WaltonLaw(friction=0.2, restitution=1.0, tangential_restitution=0.4)
    >>> law.tangential_restitution
    0.4
    """

    friction: float
    restitution: float
    tangential_restitution: float

    def __init__(
        self, *, friction: float, restitution: float = 1.0, tangential_restitution: float
    ) -> None:
        beta = _ratio("tangential_restitution", tangential_restitution, -1.0)
        for name, value in (
            ("friction", not_negative("friction", friction)),
            ("restitution", _ratio("restitution", restitution, 0.0)),
            ("tangential_restitution", beta),
        ):
            object.__setattr__(self, name, value)

    def rule(self, pair: Pair) -> Rule:
        """Return what a collision of this pair needs."""
        bound = self.friction * (1.0 + self.restitution) * pair.normal_mass / pair.tangential_mass
        return constant_rule(self.restitution, 1.0, bound, 1.0 + self.tangential_restitution)
