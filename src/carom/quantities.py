"""The glossary of quantities, and the reading and checking of what users give."""

import math
from collections.abc import Iterable
from difflib import get_close_matches
from functools import lru_cache
from typing import Any, NamedTuple


class InputError(ValueError):
    """What was given cannot be used; the message names it, its value, and what is allowed."""


class Quantity(NamedTuple):
    """An entry of the glossary: mathematical symbol, SI unit, meaning."""

    symbol: str
    unit: str
    meaning: str

    def label(self) -> str:
        """Return the label of an axis."""
        unit = "" if self.unit == "1" else f" ({self.unit})"
        return f"{self.meaning}, {self.symbol}{unit}"


GLOSSARY = {
    # what is given
    "radius": Quantity("$R$", "m", "radius"),
    "inner_radius": Quantity("$R_i$", "m", "inner radius of a hollow sphere"),
    "gyration_radius": Quantity("$K$", "m", "radius of gyration about the centre"),
    "young": Quantity("$E$", "Pa", "Young's modulus"),
    "poisson": Quantity(r"$\nu$", "1", "Poisson's ratio"),
    "density": Quantity(r"$\rho$", "kg/m^3", "density"),
    "yield_strength": Quantity("$Y$", "Pa", "yield strength"),
    "friction": Quantity(r"$\mu$", "1", "coefficient of friction"),
    "speed": Quantity("$V$", "m/s", "speed of approach of the centres"),
    "angle": Quantity(r"$\theta$", "rad", "angle of incidence from the normal"),
    "normal_speed": Quantity("$V_1$", "m/s", "normal speed of approach"),
    "tangential_speed": Quantity("$v_t$", "m/s", "tangential speed of the centres"),
    "spin": Quantity(r"$\omega$", "rad/s", "spin of the first body"),
    "spin2": Quantity(r"$\omega_2$", "rad/s", "spin of the second body"),
    # of a pair
    "effective_modulus": Quantity("$E^*$", "Pa", "effective modulus of both bodies"),
    "effective_shear_modulus": Quantity("$G^*$", "Pa", "effective shear modulus of both bodies"),
    "effective_radius": Quantity("$R^*$", "m", "effective radius of both bodies"),
    "normal_mass": Quantity("$m_n$", "kg", "effective mass in the normal direction"),
    "tangential_mass": Quantity("$m_t$", "kg", "effective mass of the contact point, tangentially"),
    "kappa": Quantity(r"$\kappa$", "1", "ratio of tangential to normal contact stiffness"),
    "chi": Quantity(r"$\chi$", "1", "ratio of inertia to stiffness, tangential against normal"),
    "dundurs_beta": Quantity(r"$\beta$", "1", "Dundurs' second parameter"),
    # dimensionless impact
    "psi_in": Quantity(r"$\psi_1$", "1", "dimensionless velocity of the contact point before"),
    "psi_out": Quantity(r"$\psi_2$", "1", "dimensionless velocity of the contact point after"),
    "contact_restitution": Quantity(
        "$e_c$", "1", "tangential velocity of the contact point, after to before"
    ),
    "tangential_restitution": Quantity(
        "$e_t$", "1", "tangential velocity of the centres, after to before"
    ),
    "normal_restitution": Quantity("$e$", "1", "normal velocity, after to before"),
    # a history
    "time": Quantity("$t$", "s", "time since the first touch"),
    "penetration": Quantity("$d$", "m", "normal approach of the bodies"),
    "normal_velocity": Quantity("$V_z$", "m/s", "normal velocity, positive while approaching"),
    "contact_velocity": Quantity("$V_x$", "m/s", "tangential velocity of the contact point"),
    "displacement": Quantity("$u_x$", "m", "tangential displacement of the bodies since touch"),
    "normal_force": Quantity("$F_z$", "N", "normal force"),
    "tangential_force": Quantity("$F_x$", "N", "tangential force, positive against $V_x$"),
    "contact_radius": Quantity("$b$", "m", "radius of the contact"),
    "stick_radius": Quantity("$a$", "m", "radius of the stick zone"),
    "normal_kinetic_energy": Quantity("$T_n$", "J", "kinetic energy of the normal motion"),
    "tangential_kinetic_energy": Quantity("$T_t$", "J", "kinetic energy of the contact point"),
    "normal_elastic_energy": Quantity("$E_n$", "J", "elastic energy of normal deformation"),
    "tangential_elastic_energy": Quantity("$E_t$", "J", "elastic energy of tangential deformation"),
    "frictional_work": Quantity("$W$", "J", "energy dissipated by slip so far"),
    # a result
    "duration": Quantity("$t_c$", "s", "duration of the contact"),
    "max_penetration": Quantity("$d_{max}$", "m", "largest penetration"),
    "max_force": Quantity("$P_{max}$", "N", "largest normal force"),
    "max_radius": Quantity("$a_{max}$", "m", "largest radius of the contact"),
    "max_pressure": Quantity("$p_0$", "Pa", "largest contact pressure"),
    "rebound_speed": Quantity("$V'$", "m/s", "speed of the centres after the impact"),
    "rebound_angle": Quantity(
        r"$\theta'$", "rad", "angle of rebound of the centres, from the normal"
    ),
    "tangential_speed_out": Quantity("$v_t'$", "m/s", "tangential speed of the centres after"),
    "spin_out": Quantity(r"$\omega'$", "rad/s", "spin of the first body after"),
    "spin2_out": Quantity(r"$\omega_2'$", "rad/s", "spin of the second body after"),
    "dissipated_energy": Quantity("$W$", "J", "energy lost to friction"),
}

HINTS = {
    "m": "5 mm",
    "Pa": "210 GPa",
    "kg/m^3": "7850 kg/m^3",
    "m/s": "2 m/s",
    "rad": "30 deg",
    "rad/s": "100 rad/s",
    "1": "0.3",
}


def number(name: str, value: Any, unit: str | None = None) -> float:
    """Return a value in SI units: a number, or text with a unit such as "5 mm".

    Raises InputError for anything else, for an unknown unit and for a unit of another kind.

    Examples
    --------
    >>> number("radius", "5 mm")
    0.005
    >>> number("angle", "90 deg") == math.pi / 2
    True
    """
    unit = unit or GLOSSARY[name].unit
    if isinstance(value, str):
        result = _parsed(name, value, unit)
    elif isinstance(value, bool) or value is None:
        raise refusal(name, value, _expected(unit))
    else:
        try:
            result = float(value)
        except (TypeError, ValueError):
            raise refusal(name, value, _expected(unit)) from None
    if math.isnan(result):
        raise refusal(name, value, _expected(unit))
    return result


def positive(name: str, value: Any) -> float:
    """Return a positive finite value in SI units, or raise InputError."""
    result = number(name, value)
    if not 0.0 < result < math.inf:
        raise refusal(name, value, f"must be positive and finite, e.g. {_example(name)}")
    return result


def not_negative(name: str, value: Any) -> float:
    """Return a finite value >= 0 in SI units, or raise InputError."""
    result = number(name, value)
    if not 0.0 <= result < math.inf:
        raise refusal(name, value, f"must be zero or positive and finite, e.g. {_example(name)}")
    return result


def finite(name: str, value: Any, unit: str | None = None) -> float:
    """Return a finite value in SI units, or raise InputError."""
    result = number(name, value, unit)
    if not math.isfinite(result):
        raise refusal(name, value, "must be finite")
    return result


def refusal(name: str, value: Any, allowed: str) -> InputError:
    """Return the error that refuses a value."""
    return InputError(f"{name}: {value!r} cannot be used; {allowed}")


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint at the known words that are nearest to one."""
    found = get_close_matches(word, list(known), n=3, cutoff=0.5)
    return f"did you mean {' or '.join(repr(name) for name in found)}?" if found else ""


def _example(name: str) -> str:
    return f"'{HINTS[GLOSSARY[name].unit]}'"


def _expected(unit: str) -> str:
    if unit == "1":
        return "give a number without a unit, e.g. 0.3"
    return f"give a number in {unit}, or text with a unit such as '{HINTS[unit]}'"


def _parsed(name: str, text: str, unit: str) -> float:
    try:
        return float(text)
    except ValueError:
        pass
    import pint

    try:
        quantity = _registry().Quantity(text)
        if quantity.unitless:
            return float(quantity.magnitude)
        if quantity.dimensionless and unit == "1":
            raise refusal(name, text, f"it has a unit; {_expected(unit)}")
        if unit == "rad/s" and str(quantity.units) == "hertz":
            raise refusal(name, text, "a spin is not in Hz; write 'rpm' or 'rad/s'")
        return float(quantity.to("" if unit == "1" else unit).magnitude)
    except pint.UndefinedUnitError as error:
        unknown = error.unit_names if isinstance(error.unit_names, str) else error.unit_names[0]
        raise refusal(name, text, f"unit {unknown!r} is not known; {_expected(unit)}") from None
    except pint.DimensionalityError as error:
        kind = (
            f"that is in {error.units1}, not a value in {unit}" if unit != "1" else "it has a unit"
        )
        raise refusal(name, text, f"{kind}; {_expected(unit)}") from None
    except InputError:
        raise
    except Exception:  # pint lets errors of the tokenizer through
        raise refusal(name, text, _expected(unit)) from None


@lru_cache(maxsize=1)
def _registry() -> Any:
    import pint

    try:  # parsing the definitions anew takes longer than an impact
        return pint.UnitRegistry(cache_folder=":auto:")
    except Exception:  # a cache that cannot be used is no reason to fail
        return pint.UnitRegistry()
