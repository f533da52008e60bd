"""The law against the array API standard (2023.12): NumPy, JAX, torch, CuPy and others alike.

What is differentiated may be neither infinite nor NaN, not even where `where` drops it: hence the
arguments that are replaced by harmless ones on the side that is not taken.
"""

from collections.abc import Callable
from typing import Any

import array_api_compat
import numpy as np

from carom.many.laws.rules import Rule
from carom.quantities.arrays import pure_numbers
from carom.quantities.refusals import refusal
from carom.quantities.units import bears_unit

ALLOWED = "must be a real number, or an array of them"


def is_foreign(values: Any) -> bool:
    """Return whether this is an array of another library than NumPy, without units."""
    numpy_own = isinstance(values, np.ndarray | np.generic)
    return array_api_compat.is_array_api_obj(values) and not numpy_own and not bears_unit(values)


def is_floats(values: Any) -> bool:
    """Return whether these are NumPy's floating-point numbers, none masked, without units."""
    if not isinstance(values, np.ndarray | np.generic) or isinstance(values, np.ma.MaskedArray):
        return False
    return values.dtype in (np.float32, np.float64) and not bears_unit(values)


def applied(function: Callable[[Any, Any], Any], name: str, values: Any) -> Any:
    """Return function(array, library) for values of any kind; a number gives a float."""
    with np.errstate(over="ignore"):  # what is infinite is told by the docstrings
        if is_foreign(values) or is_floats(values):
            return function(*floating(name, values))
        result = function(*floating(name, pure_numbers(name, values, ALLOWED)))
    return result if np.ndim(result) else float(result)


def floating(name: str, array: Any) -> tuple[Any, Any]:
    """Return real numbers as float32 or float64 and their library, or raise InputError."""
    xp = array_api_compat.array_namespace(array)
    if not xp.isdtype(array.dtype, ("integral", "real floating")):
        raise refusal(name, array, ALLOWED)
    if array.dtype not in (xp.float32, xp.float64):
        array = xp.astype(array, xp.asarray(1.0).dtype)
    return array, xp


def constants(values: Any, array: Any, xp: Any) -> Any:
    """Return plain numbers as an array of the library, type and device of another."""
    # a copy: torch warns of memory that cannot be written
    return xp.asarray(np.array(values), dtype=array.dtype, device=array_api_compat.device(array))


def lost(psi: Any, rule: Rule, xp: Any) -> Any:
    """Return psi_1 - psi_2 = (1 + beta) psi_1, at most `sliding`, at slopes of either sign."""
    size = xp.abs(psi)
    one_plus_beta, slides = _stuck_or_slides(size, xp.ones_like(size), rule, xp)
    held = xp.where(slides, xp.zeros_like(psi), psi)
    return xp.where(slides, rule.sliding * xp.sign(psi), one_plus_beta * held)


def part_lost(tangential: Any, normal: Any, rule: Rule, xp: Any) -> Any:
    """Return 1 + beta at slopes tangential/normal of speeds >= 0 and > 0, as the compiled twin."""
    value, slides = _stuck_or_slides(tangential, normal, rule, xp)
    one = xp.ones_like(value)
    bound = rule.sliding * xp.where(slides, normal, one) / xp.where(slides, tangential, one)
    return xp.where(slides, bound, value)


def _stuck_or_slides(tangential: Any, normal: Any, rule: Rule, xp: Any) -> tuple[Any, Any]:
    """Return 1 + beta without the bound of sliding, and whether that bound is exceeded."""
    last = float(rule.edges[-1])  # beyond, the series is constant; so nothing overflows
    inside = tangential < last * normal
    quotient = tangential / xp.where(inside, normal, xp.ones_like(normal))
    value = _series(xp.where(inside, quotient, xp.full_like(quotient, last)), rule, xp)
    return value, 0.5 * value * tangential > 0.5 * rule.sliding * normal


def _series(slope: Any, rule: Rule, xp: Any) -> Any:
    flat = xp.reshape(slope, (-1,))
    edges, slopes, shifts, powers = (constants(part, flat, xp) for part in rule[3:])
    panel = xp.searchsorted(edges[1:], flat, side="right")
    place = xp.take(slopes, panel) * flat + xp.take(shifts, panel)
    value = xp.take(powers[:, -1], panel)
    for term in range(powers.shape[1] - 2, -1, -1):
        value = value * place + xp.take(powers[:, term], panel)
    return xp.reshape(xp.clip(value, 0.0, 2.0), slope.shape)
