"""Contact laws and rebound laws that are Python functions: a developer's own."""

from abc import abstractmethod
from collections.abc import Callable
from copy import deepcopy
from dataclasses import KW_ONLY, dataclass, field
from inspect import signature
from math import isfinite, isnan, nan, sqrt
from typing import Any, ClassVar, NamedTuple

import numpy as np

from carom.bodies.checks import checked_scales, with_friction
from carom.bodies.pairs import Pair, Scales
from carom.bodies.shapes import HalfSpace, Sphere
from carom.dem.base import CodeLaw, ContactLaw
from carom.dem.coefficients import SPRING
from carom.dem.damping import damping_ratio, hertz_damping
from carom.dem.stepping import HISTORY, MOST_DURATIONS
from carom.dimensionless.law import Codes, LawStatus, status_of
from carom.dimensionless.numerics.hertz import DURATION
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, checked_type, clipped, one_of, refusal
from carom.quantities.units import bears_unit, number, positive

DEFAULT_STEPS = 2000
FORCE, REBOUND = "def law(contact, state)", "def rebound(psi, chi)"
NORMAL = ("hertz", "linear")  # how the elastic part of the normal force grows


class ContactStep(NamedTuple):
    """What a contact law is given in one time step, in SI units.

    V_x, `tangential_velocity`, is that of the contact point, of the first body relative to the
    second; the force that a law returns acts on the first body along x, so that it is negative
    where it slows V_x > 0. Stiffnesses are those of a contact of radius a that sticks, k_n = 2 E* a
    and k_t = 2 G* a (Mindlin 1949), which is 8 G_eff a where codes write G* = 4 G_eff; with linear
    springs they are constants, k_t = kappa k_n.

    Parameters
    ----------
    overlap, normal_velocity : float
        d in m; in m/s, positive while the bodies approach.
    normal_force : float
        F_n in N, damping included; negative where it pulls.
    tangential_velocity, time_step, contact_radius : float
        V_x in m/s; in s; a = sqrt(R* d) in m.
    normal_stiffness, tangential_stiffness : float
        k_n and k_t in N/m.
    friction, effective_radius : float
        Coefficient mu; R* in m.
    effective_modulus, effective_shear_modulus : float
        E* and G* in Pa.
    normal_mass, tangential_mass : float
        m_n and m_t in kg: dv/dt = -F_n/m_n, dV_x/dt = F_t/m_t.

    Examples
    --------
    >>> def spring(contact, stretch):
    ...     stretch = stretch + contact.tangential_velocity * contact.time_step
    ...     return -contact.tangential_stiffness * stretch, stretch
    >>> round(carom.dem.FunctionLaw(spring).rebound(0.5, 1.44), 3)
    0.477
    """

    overlap: float
    normal_velocity: float
    normal_force: float
    tangential_velocity: float
    time_step: float
    contact_radius: float
    normal_stiffness: float
    tangential_stiffness: float
    friction: float
    effective_radius: float
    effective_modulus: float
    effective_shear_modulus: float
    normal_mass: float
    tangential_mass: float


class Fault(Exception):
    """What a function did wrong: a status, and the words for it; `step` is where."""

    def __init__(self, status: int, words: str) -> None:
        super().__init__(words)
        self.status, self.step = status, -1


class Bodies(NamedTuple):
    """Two bodies in SI units; chi and kappa set G* and m_t, `constants` those of a ContactStep."""

    constants: tuple[float, float, float, float, float, float]
    speed: float
    length: float
    force: float
    kappa: float
    linear: bool
    damping: float

    def normal_force(self, d: float, v: float) -> float:
        """Return the normal force in N, its damping included."""
        part, rate = d / self.length, v / self.speed
        if self.linear:
            return self.force * (SPRING * part + self.damping * rate)
        return self.force * (part * sqrt(part) + self.damping * sqrt(sqrt(part)) * rate)


def steel_on_steel() -> Pair:
    """Return the pair of the published comparison: nu = 0.3, hence chi = 1.4412."""
    return Pair(Sphere(radius=0.005, material="steel"), HalfSpace(material="steel"), friction=0.2)


def stepped_by(
    bodies: Bodies,
    law: Callable[[Any, Any], tuple[float, Any]],
    state: Any,
    psi: float,
    steps: int,
    record: Array,
) -> tuple[int, float]:
    """Return filled rows and psi_2 by Verlet, as `stepping.stepped`; -1 if bodies do not part."""
    friction, radius, modulus, _, m_n, m_t = bodies.constants
    unit, limit = friction * bodies.speed / bodies.kappa, friction * bodies.force
    whole = bodies.length / bodies.speed  # unit of time
    dt = DURATION * whole / steps
    d, v, along, f_n, f_t = 0.0, bodies.speed, psi * unit, 0.0, 0.0
    for i in range(MOST_DURATIONS * steps):
        if i < len(record):
            normal = (i * dt / whole, d / bodies.length, v / bodies.speed)
            record[i] = *normal, along / unit, f_n / bodies.force, -f_t / limit
        v -= 0.5 * dt * f_n / m_n
        along += 0.5 * dt * f_t / m_t
        d += dt * v
        if d <= 0.0:
            return i + 1, along / unit
        f_n = bodies.normal_force(d, v)
        a = sqrt(radius * d)
        k_n = SPRING * bodies.force / bodies.length if bodies.linear else 2.0 * modulus * a
        try:
            own = (d, v, f_n, along, dt, a, k_n, bodies.kappa * k_n)
            f_t, state = law(ContactStep(*own, *bodies.constants), state)
        except Fault as fault:
            fault.step = i
            raise
        v -= 0.5 * dt * f_n / m_n
        along += 0.5 * dt * f_t / m_t
    return -1, float("nan")


@dataclass(frozen=True)
class ByFunction(CodeLaw):
    """A law that asks a Python function, one impact after the other, in this thread."""

    function: Callable[..., Any]
    _: KW_ONLY
    name: str = ""  # type: ignore[misc]  # of its own, not of the class

    source: ClassVar[str] = "a Python function"
    _written: ClassVar[str]  # how the function begins

    def __post_init__(self) -> None:
        _check_function(self.function, self._written)
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
            return _located(self, fault, psi, chi)
        return ""

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        status = status_of(psi, chi, kappa, self._largest_chi)
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
    >>> def sliding(contact, state):
    ...     sign = 1.0 if contact.tangential_velocity > 0.0 else -1.0
    ...     return -sign * contact.friction * contact.normal_force, state
    >>> law = carom.dem.FunctionLaw(sliding)
    >>> round(law.rebound(8.0, 1.4412), 4), round(8.0 - 4 * 1.4412, 4)
    (2.2352, 2.2352)
    """

    _written: ClassVar[str] = FORCE
    _symmetric: ClassVar[bool] = False  # unless the function is
    _most_steps: ClassVar[int] = DEFAULT_STEPS

    _: KW_ONLY
    initial_state: Any = 0.0
    normal: str = NORMAL[0]
    restitution: float = 1.0
    pair: Pair | None = None
    normal_speed: float = 0.1
    _scaled: tuple[Pair, Scales] = field(init=False, repr=False, compare=False)

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
        bodies = steel_on_steel() if self.pair is None else self.pair
        object.__setattr__(self, "normal_speed", speed)
        object.__setattr__(self, "_scaled", (bodies, checked_scales(bodies, speed)))

    def _bodies(self, chi: float, kappa: float) -> Bodies:
        linear, damping = self.normal == "linear", hertz_damping(self.restitution)
        if linear:
            damping = 2.0 * SPRING * damping_ratio(self.restitution)
        pair, scales = self._scaled
        mass, modulus = pair.normal_mass, pair.effective_modulus
        moduli, masses = (modulus, kappa * modulus), (mass, 0.5 * kappa * mass / chi)
        constants = (pair.friction, pair.effective_radius, *moduli, *masses)
        return Bodies(
            constants, self.normal_speed, scales.length, scales.force, kappa, linear, damping
        )

    def _stepped(
        self, psi: float, chi: float, kappa: float, steps: int, record: Array
    ) -> tuple[int, float]:
        """Return how many rows of the record are filled and psi_2, or raise Fault."""
        try:
            bodies = self._bodies(chi, kappa)
            start = deepcopy(self.initial_state)
            count, psi_out = stepped_by(bodies, self._force, start, psi, steps, record)
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
        return _number("force", force, "N"), after

    def _one(self, psi: float, chi: float, kappa: float, steps: int | None) -> float:
        nothing = np.empty((0, len(HISTORY)))
        return self._stepped(psi, chi, kappa, steps or DEFAULT_STEPS, nothing)[1]

    def _recorded(self, psi: float, chi: float, kappa: float, steps: int, record: Array) -> int:
        try:
            return self._stepped(psi, chi, kappa, steps, record)[0]
        except Fault as fault:
            raise InputError(_located(self, fault, psi, chi)) from fault


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
    >>> def hard_sphere(psi, chi):
    ...     return max(-0.4 * psi, psi - 4.0 * chi) if psi > 0.0 else -hard_sphere(-psi, chi)
    >>> carom.dem.FunctionRebound(hard_sphere).rebound([1.0, 10.0], 1.5)
    array([-0.4,  4. ])
    """

    _written: ClassVar[str] = REBOUND

    def _one(self, psi: float, chi: float, kappa: float, steps: int | None) -> float:
        return float(_number("psi_2", _answer(self.function, psi, chi), "1"))


def _located(law: ByFunction, fault: Fault, psi: float, chi: float) -> str:
    """Return what went wrong in which impact, and in which time step if one is meant."""
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


def _answer(function: Callable[..., Any], *arguments: Any) -> Any:
    try:
        return function(*arguments)
    except Exception as error:
        words = f"raised {type(error).__name__}: {clipped(str(error))}"
        raise Fault(LawStatus.RAISED, words) from error


def _number(name: str, value: Any, unit: str) -> float:
    """Return what a function has returned as a finite number in a unit, or raise Fault."""
    plain = type(value) is float or (isinstance(value, float) and not bears_unit(value))
    if plain and isfinite(value):  # at every time step
        return float(value)
    shown = clipped(repr(value))
    try:
        real = value if isinstance(value, float) and isnan(value) else number(name, value, unit)
        shown = str(real)
    except InputError:
        real = nan
    if not isfinite(real):
        raise Fault(LawStatus.NOT_A_NUMBER, f"returned {shown} as the {name}")
    return real
