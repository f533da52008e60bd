"""Contact laws and rebound laws that are Python functions: a developer's own."""

from abc import abstractmethod
from collections.abc import Callable
from copy import deepcopy
from dataclasses import KW_ONLY, dataclass
from inspect import signature
from math import isfinite, isnan
from typing import Any, ClassVar

import numpy as np

from carom.bodies.pairs import Pair, checked_scales, with_friction
from carom.dem import contact_step
from carom.dem.base import ContactLaw, Law
from carom.dem.coefficients import SPRING
from carom.dem.contact_step import NORMAL, Bodies, ContactStep, Fault
from carom.dem.damping import damping_ratio, hertz_damping
from carom.dem.status import Codes, LawStatus, status_of
from carom.dem.stepping import HISTORY
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, checked_type, clipped, one_of, refusal
from carom.quantities.units import bears_unit, number, positive

CONVERGED = 2000  # steps where none are asked for
FORCE, REBOUND = "def law(contact, state)", "def rebound(psi, chi)"


@dataclass(frozen=True)
class ByFunction(Law):
    """A law that asks a Python function, one impact after the other, in this thread."""

    function: Callable[..., Any]
    _: KW_ONLY
    name: str = ""  # type: ignore[misc]  # of its own, not of the class

    source: ClassVar[str] = "a Python function"
    written: ClassVar[str]  # how the function begins

    def __post_init__(self) -> None:
        _check_function(self.function, self.written)
        checked_type("name", self.name, str, "must be a text, e.g. name='my law'")
        own = str(getattr(self.function, "__name__", type(self.function).__name__))
        object.__setattr__(self, "name", clipped(self.name) or own)
        super().__post_init__()

    @abstractmethod
    def _one(self, psi: float, chi: float, kappa: float, steps: int | None) -> float:
        """Return psi_2 of one impact, or raise Fault."""

    def _why(self, psi: float, chi: float, kappa: float) -> str:
        try:
            self._one(psi, chi, kappa, None)
        except Fault as fault:
            return _told(self, fault, psi, chi)
        return ""

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        status = status_of(psi, chi, kappa, self.largest_chi)
        result = np.full(psi.size, np.nan)
        for i in np.flatnonzero(status == LawStatus.SOLVED):
            try:
                result[i] = self._one(float(psi[i]), float(chi[i]), float(kappa[i]), steps)
            except Fault as fault:
                status[i] = fault.status
        return result, status


@dataclass(frozen=True)
class FunctionLaw(ByFunction, ContactLaw):
    """A contact law that is a Python function, called in every time step, in SI units.

    function(contact, state) returns the tangential force on the first body in N, and the state that
    it is given in the next step. `contact` is a `carom.dem.ContactStep`: overlap, normal force
    and velocities in this step, stiffnesses, friction, radius, moduli, masses. The force acts along
    x, so that friction that slows V_x > 0 is negative, -k_t U or -mu F_n; `history` and all else in
    Carom count it as positive there. Impacts are solved one by one in equal time steps by velocity
    Verlet, as codes do it, each in milliseconds: in 2000 steps where no number is asked for, which
    leaves errors of 1e-6 in psi_2, of 0.002 for laws of the first order in the step. A function
    that raises or returns no force leaves NaN and a status.

    Parameters
    ----------
    function : callable
        Takes a step and a state, returns a force and a state.
    name : str, optional
        What the law is called in tables and figures; by default the name of the function.
    initial_state : any
        State at the first touch, by default 0.0, a spring without stretch; copied for each impact.
    normal : str
        Normal force: "hertz", or "linear" springs that are pressed as far.
    restitution : float
        e that the damping of the normal force is made for as LAMMPS does it, above 0, at most 1.
    pair : Pair, optional
        Bodies whose R*, E*, m_n and mu the function sees; by default a steel ball of 5 mm on steel,
        mu = 0.2. G* and m_t follow from the chi and kappa of the impact.
    normal_speed : float or str
        V_1 in m/s; psi_2 depends on it only if the law has a length, force or time of its own.

    Raises
    ------
    InputError
        If the function is none or takes other arguments, or a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> def sliding(contact, state):
    ...     sign = 1.0 if contact.tangential_velocity > 0.0 else -1.0
    ...     return -sign * contact.friction * contact.normal_force, state
    >>> law = carom.dem.FunctionLaw(sliding)
    >>> round(law.rebound(8.0, 1.4412), 4), round(8.0 - 4 * 1.4412, 4)
    (2.2352, 2.2352)
    """

    written: ClassVar[str] = FORCE
    symmetric: ClassVar[bool] = False  # unless the function is
    most_steps: ClassVar[int] = CONVERGED

    _: KW_ONLY
    initial_state: Any = 0.0
    normal: str = NORMAL[0]
    restitution: float = 1.0
    pair: Pair | None = None
    normal_speed: float = 0.1

    def __post_init__(self) -> None:
        super().__post_init__()
        one_of("normal", self.normal, NORMAL)
        try:
            deepcopy(self.initial_state)
        except Exception:
            allowed = "must be something that can be copied, e.g. 0.0 or a tuple"
            raise refusal("initial_state", self.initial_state, allowed) from None
        if self.pair is not None:
            with_friction(self.pair, "psi is infinite without friction")
        speed = positive("normal_speed", self.normal_speed)
        checked_scales(self._pair(), speed)
        object.__setattr__(self, "normal_speed", speed)

    def _pair(self) -> Pair:
        return contact_step.steel_on_steel() if self.pair is None else self.pair

    def _bodies(self, chi: float, kappa: float) -> Bodies:
        linear = self.normal == "linear"
        part = 2.0 * SPRING * damping_ratio(self.restitution)
        damping = part if linear else hertz_damping(self.restitution)
        given: Any = {"linear": linear, "damping": damping}
        return contact_step.bodies_of(self._pair(), self.normal_speed, chi, kappa, **given)

    def _stepped(
        self, psi: float, chi: float, kappa: float, steps: int, record: Array
    ) -> tuple[int, float]:
        """Return how many rows of the record are filled and psi_2, or raise Fault."""
        try:
            bodies = self._bodies(chi, kappa)
            start = deepcopy(self.initial_state)
            count, psi_out = contact_step.stepped_by(bodies, self._force, start, psi, steps, record)
        except ArithmeticError:  # of numbers that floating point cannot hold
            raise Fault(LawStatus.UNRESOLVED, LawStatus.UNRESOLVED.message) from None
        if not isfinite(psi_out):
            raise Fault(LawStatus.UNRESOLVED, LawStatus.UNRESOLVED.message)
        return count, psi_out

    def _force(self, contact: ContactStep, state: Any) -> tuple[float, Any]:
        """Return the force and the state that the function returns, or raise Fault."""
        answer = _answer(self.function, contact, state)
        try:
            force, after = answer
        except (TypeError, ValueError):
            words = f"returned {clipped(repr(answer))}, which is not a force and a state"
            raise Fault(LawStatus.NOT_A_NUMBER, words) from None
        return force if _is_finite(force) else _number("force", force, "N"), after

    def _one(self, psi: float, chi: float, kappa: float, steps: int | None) -> float:
        nothing = np.empty((0, len(HISTORY)))
        return self._stepped(psi, chi, kappa, steps or CONVERGED, nothing)[1]

    def _recorded(self, psi: float, chi: float, kappa: float, steps: int, record: Array) -> int:
        try:
            return self._stepped(psi, chi, kappa, steps, record)[0]
        except Fault as fault:
            raise InputError(_told(self, fault, psi, chi)) from fault


@dataclass(frozen=True)
class FunctionRebound(ByFunction):
    """A rebound law that is a Python function psi_2(psi_1, chi), both numbers.

    psi_1 may be negative. A function that raises or returns no number leaves NaN and a status.

    Parameters
    ----------
    function : callable
        Takes psi_1 and chi, returns psi_2.
    name : str, optional
        What the law is called in tables and figures; by default the name of the function.

    Raises
    ------
    InputError
        If the function is none, or takes other arguments.

    Examples
    --------
    >>> import carom
    >>> def hard_sphere(psi, chi):
    ...     return max(-0.4 * psi, psi - 4.0 * chi) if psi > 0.0 else -hard_sphere(-psi, chi)
    >>> carom.dem.FunctionRebound(hard_sphere).rebound([1.0, 10.0], 1.5)
    array([-0.4,  4. ])
    """

    written: ClassVar[str] = REBOUND

    def _one(self, psi: float, chi: float, kappa: float, steps: int | None) -> float:
        answer = _answer(self.function, psi, chi)
        return float(answer) if _is_finite(answer) else _number("psi_2", answer, "1")


def _told(law: ByFunction, fault: Fault, psi: float, chi: float) -> str:
    where = f"psi_1 = {psi:g}, chi = {chi:g}"
    where = where if fault.step < 0 else f"time step {fault.step + 1}, {where}"
    return f"{law.name.replace(':', ' ')}: {fault} ({where})"


def _check_function(function: Any, written: str) -> None:
    """Raise InputError for what is no function, or does not take two arguments."""
    if not callable(function) or isinstance(function, type):
        raise refusal("function", function, f"must be a function, {written}")
    try:
        taken = signature(function)
    except (TypeError, ValueError):  # of functions that are not Python's
        return
    try:
        taken.bind(None, None)
    except TypeError:
        raise refusal("function", function, f"must take two arguments, {written}") from None


def _answer(function: Callable[..., Any], *given: Any) -> Any:
    try:
        return function(*given)
    except Exception as error:
        words = f"raised {type(error).__name__}: {clipped(str(error))}"
        raise Fault(LawStatus.RAISED, words) from error


def _is_finite(value: Any) -> bool:
    plain = type(value) is float or (isinstance(value, float) and not bears_unit(value))
    return plain and isfinite(value)


def _number(name: str, value: Any, unit: str) -> float:
    """Return what a function has returned as a finite number in a unit, or raise Fault."""
    try:
        found = value if isinstance(value, float) and isnan(value) else number(name, value, unit)
    except InputError:
        shown = clipped(repr(value))
        raise Fault(LawStatus.NOT_A_NUMBER, f"returned {shown} as the {name}") from None
    if not isfinite(found):
        raise Fault(LawStatus.NOT_A_NUMBER, f"returned {found} as the {name}")
    return found
