"""Laws of rigid spheres that simulations use instead of the exact law."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from carom.bodies.pairs import Pair
from carom.many.laws.rules import Rule, constant_rule
from carom.quantities.units import not_negative, within


def _check_ratios(law: object, **least: float) -> None:
    """Read the coefficients of a frozen law; raise InputError unless they lie from these to 1."""
    for name, low in least.items():
        object.__setattr__(law, name, within(name, getattr(law, name), low, 1.0, "1"))


@dataclass(frozen=True, kw_only=True)
class SmoothLaw:
    """Perfectly smooth spheres, whose spins never change: V_n' = -e V_n, V_t' = V_t.

    Parameters
    ----------
    restitution : float
        Coefficient of restitution e, from 0 to 1.

    Raises
    ------
    InputError
        If e is out of range.

    Examples
    --------
    >>> carom.laws.SmoothLaw(restitution=0.9)
    SmoothLaw(restitution=0.9)
    """

    restitution: float = 1.0

    def __post_init__(self) -> None:
        _check_ratios(self, restitution=0.0)

    def rule(self, pair: Pair) -> Rule:
        """Return the numbers that a collision of this pair needs."""
        return constant_rule(self.restitution, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class RoughLaw:
    """Perfectly rough spheres: V_n' = -e V_n, V_t' = -V_t (Bryan 1894; Pidduck 1922).

    Parameters
    ----------
    restitution : float
        Coefficient of restitution e, from 0 to 1; with 1 no energy is lost.

    Raises
    ------
    InputError
        If e is out of range.

    Examples
    --------
    >>> carom.laws.RoughLaw()
    RoughLaw(restitution=1.0)
    """

    restitution: float = 1.0

    def __post_init__(self) -> None:
        _check_ratios(self, restitution=0.0)

    def rule(self, pair: Pair) -> Rule:
        """Return the numbers that a collision of this pair needs."""
        return constant_rule(self.restitution, inf, 2.0)


@dataclass(frozen=True, kw_only=True)
class WaltonLaw:
    """Walton's law, with friction mu in sliding and tangential restitution beta_0 otherwise.

        |J_t| = min(m_t (1 + beta_0) |V_t|, mu |J_n|), J_n = (1 + e) m_n V_n

    Its three parameters e, mu and beta_0 are those of Walton (1993) and of Foerster, Louge, Chang &
    Allia (1994), (11)-(13).

    Parameters
    ----------
    friction : float
        Coefficient of friction mu, zero or positive.
    restitution : float
        Normal coefficient of restitution e, from 0 to 1.
    tangential_restitution : float
        beta_0 = -V_t'/V_t of the contact point, from -1 (smooth) to 1 (perfectly rough).

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> law = carom.laws.WaltonLaw(friction=0.2, restitution=1.0, tangential_restitution=0.4)
    >>> law.tangential_restitution
    0.4
    """

    friction: float
    restitution: float = 1.0
    tangential_restitution: float

    def __post_init__(self) -> None:
        _check_ratios(self, restitution=0.0, tangential_restitution=-1.0)
        object.__setattr__(self, "friction", not_negative("friction", self.friction))

    def rule(self, pair: Pair) -> Rule:
        """Return the numbers that a collision of this pair needs."""
        bound = self.friction * (1.0 + self.restitution) * pair.normal_mass / pair.tangential_mass
        return constant_rule(self.restitution, bound, 1.0 + self.tangential_restitution)
