"""One dimensionless impact, its phases, and its state at any time."""

from dataclasses import dataclass, field
from functools import partial
from typing import ClassVar, overload

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless import states
from carom.dimensionless.elastic import dense_output as dense, plates, record as recorded, slip
from carom.dimensionless.elastic.motion import PSI
from carom.dimensionless.elastic.phases import Kind, Status, check_kernels, new_work, run_phases
from carom.dimensionless.elastic.record import Record, Steps, new_record, trimmed
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import Memory
from carom.dimensionless.lossy.law import Loss, LossNumbers, ScaleFreeLaw, scale_free
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.springs.solution import solve_by_marching
from carom.dimensionless.lossy.viscoelastic.solution import solve_viscoelastic
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.rebounds import LINEAR_PSI, STEP_TOLERANCE, is_elastic
from carom.dimensionless.states import ContactState, History, Phase, SlipAngle, Trajectory
from carom.quantities.refusals import known_keywords, refusal
from carom.quantities.statuses import Cause
from carom.quantities.units import pure_number

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(48)  # in time, over a phase
ONE_NUMBER = "give one number; carom.rebound takes arrays"
SHORTEST_PHASE = 1e-12  # in units of d_max/V_1; what is shorter is rounding


@dataclass(frozen=True, eq=False)
class Solution(Trajectory):
    """One oblique impact solved exactly; made by `solve`.

    Times are in units of d_max/V_1, penetrations in d_max, radii in sqrt(R* d_max), tangential
    displacements U in mu d_max/kappa, and velocities psi in mu V_1/kappa. The tangential force is
    given as Q = (2/3) F_x/(mu P_max), and energies are such that the kinetic energy is psi^2/2. The
    theory is that of Maw, Barber & Fawcett (1976) in the form of Barber (1979), with traction (6),
    stick (15) and gross slip (33). `status` is SOLVED or says why not, `phases` are in order, and
    `shear_lost` is the energy lost to viscosity in shear, here none.

    Examples
    --------
    >>> s = carom.solve(0.5, 1.44)
    >>> round(s.psi_out, 10)
    0.0471310838
    >>> s.history(5).psi.round(4)
    array([ 0.5   ,  0.2069, -0.3927, -0.2166,  0.0471])
    """

    psi_in: float
    chi: float
    psi_out: float
    status: Status
    phases: tuple[Phase, ...]
    _record: Record = field(repr=False)
    _steps: Steps = field(repr=False)
    restitution: float = field(default=1.0, repr=False)
    duration: float = field(default=hertz.DURATION, repr=False)
    max_penetration: float = field(default=1.0, repr=False)
    max_force: float = field(default=1.0, repr=False)
    max_radius: float = field(default=1.0, repr=False)
    max_pressure: float = field(default=1.0, repr=False)

    shear_lost: ClassVar[float] = 0.0

    @property
    def _scale(self) -> float:
        """Factor to the recorded impact, 1 or -1; below 1e-6 all is proportional to psi_1."""
        return float(np.copysign(min(1.0, abs(self.psi_in) / LINEAR_PSI), self.psi_in))

    def at(self, time: ArrayLike) -> History:
        wanted = self._times_within(time)
        rows, scale = np.empty((wanted.size, dense.SAMPLED)), self._scale
        dense.sample(self._steps, wanted, rows)
        penetration, speed = rows[:, dense.AT_D], rows[:, dense.AT_V]
        centre = plates.centre_speed(self._steps.give, penetration, speed)
        return History(
            time=wanted,
            penetration=penetration,
            speed=speed,
            centre_speed=centre,
            psi=scale * rows[:, dense.AT_PSI],
            displacement=scale * rows[:, dense.AT_U],
            force=scale * rows[:, dense.AT_Q],
            stick_radius=rows[:, dense.AT_STICK if self.psi_in else dense.AT_CONTACT],
            contact_radius=rows[:, dense.AT_CONTACT],
            stored=scale**2 * rows[:, dense.AT_STORED],
            dissipated=scale**2 * rows[:, dense.AT_DISSIPATED],
            shear_lost=np.zeros(wanted.size),
            normal_force=penetration**1.5,
            normal_stored=penetration**2.5,
            normal_lost=plates.lost(self._steps.give, penetration, centre),
        )

    @known_keywords
    def memory(self, at: float) -> Memory:
        """Return the memory of the contact at a time, g(s) and q(s), and its annuli.

        Parameters
        ----------
        at : float
            Time in units of d_max/V_1, from 0 to `duration`.

        Returns
        -------
        Memory
            The functions `g` and `q` of s = r^2/(R* d_max), with q in units of mu d_max/kappa, and
            `annuli`, each with its radii in units of sqrt(R* d_max) and the sign of its slip.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> memory = carom.solve(0.5, 1.44).memory(1.0)  # the whole contact sticks
        >>> bool(abs(memory.g(0.0)) < 1.0)
        True
        """
        now = states.now_at(self.at(self._time_within(at)))
        return dense.memory_at(self._record, self._steps, now, self._scale or 1.0)

    def _contact_at(self, time: float) -> ContactState:
        rate, now = self.slip_rate(time), states.now_at(self.at(self._time_within(time)))

        def slipping(radii: Array) -> Array:
            shapes = [surface.slip_shape(now["stick_radius"], radius) for radius in radii]
            return rate * np.array(shapes).reshape(-1, 2)

        profile = self.memory(time).profile()
        slid = partial(self.slid, time)
        return ContactState(np.sqrt(now["penetration"]), 0.0, profile, slid, slipping)

    def _touched(self, radii: Array) -> Array:
        if self._steps.give == 0.0:
            return np.array([hertz.time(r * r, np.sqrt(max(1.0 - r**5, 0.0))) for r in radii])
        out = np.empty(radii.size)
        slip.touched(self._steps, radii, out)
        return out

    def _friction_work(self, radii: Array) -> Array:
        out = np.empty((radii.size, 2))
        slip.work(self._steps, radii, out)
        return self._scale**2 * out

    def _pressed(self, radii: Array) -> Array:
        out = np.empty(radii.size)
        slip.pressed(self._steps, radii, out)
        return out

    def _slip_borders(self) -> Array:
        return slip.borders(self._steps, self.max_radius)

    @known_keywords
    def slip_rate(self, at: float) -> float:
        """Return psi - sigma v, the rate of slip far outside the stick region; zero in stick.

        In mu V_1/kappa, at a time in d_max/V_1. Raises InputError as `at`.
        """
        sign = self.phase_at(at).sign
        now = states.now_at(self.at(self._time_within(at)))
        return now["psi"] - sign * abs(self._scale) * now["speed"] if sign else 0.0

    @known_keywords
    def slid(self, at: float, radii: ArrayLike) -> Array:
        """Return the distances that points at given radii have slid since they met.

            w_x = w_0 - lambda w_2 cos 2 theta, w_y = -lambda w_2 sin 2 theta

        Parameters
        ----------
        at, radii : float, array_like
            As in `traction`.

        Returns
        -------
        numpy.ndarray, shape (n, 2)
            w_0 and w_2 in units of mu d_max/kappa, zero outside the contact.

        Raises
        ------
        InputError
            If the time is outside the contact, or the impact is not solved.

        Examples
        --------
        >>> carom.solve(0.5, 1.44).slid(1.0, [0.0, 0.5])  # the whole contact sticks
        array([[0., 0.],
               [0., 0.]])
        """
        now = states.now_at(self.at(self._time_within(at)))
        places = states.places_of(radii)
        out = np.empty((places.size, 2))
        last = int(np.searchsorted(self._steps.times, now["time"], side="right")) - 1
        state = now["time"], now["contact_radius"], now["speed"]
        slip.slid(self._steps, last, *state, places, out)
        return self._scale * out

    def slip_angles(self, lateral_ratio: float) -> tuple[SlipAngle, ...]:
        """Return the largest and the mean angle between slip and traction in each phase, in rad.

        The theory assumes that every point slips along x. In a slip ring the lateral displacement
        turns the slip by up to asin(lambda) at the front. In gross slip the lateral displacement is
        steady and does not turn it (Barber 1979, (30)).

        Parameters
        ----------
        lateral_ratio : float
            The ratio lambda, see `Pair.lateral_ratio`; nu/(2 - nu) for equal materials.

        Returns
        -------
        tuple of SlipAngle
            The `largest` angle and the `mean`, weighted by frictional work, of each phase in rad;
            zero except in slip rings.

        Raises
        ------
        InputError
            If lambda is not between -1 and 1.

        Examples
        --------
        >>> [round(angle.largest, 4) for angle in carom.solve(0.5, 1.44).slip_angles(0.3 / 1.7)]
        [0.0, 0.1774, 0.0]
        """
        ratio = pure_number("lateral_ratio", lateral_ratio)
        if not abs(ratio) < 1.0:
            raise refusal("lateral_ratio", lateral_ratio, "must lie between -1 and 1")
        return tuple(self._slip_angle(phase, ratio) for phase in self.phases)

    def _slip_angle(self, phase: Phase, lateral_ratio: float) -> SlipAngle:
        if phase.kind != states.KIND_NAMES[Kind.SLIP]:
            return SlipAngle(0.0, 0.0)
        middle, half = 0.5 * (phase.start + phase.end), 0.5 * (phase.end - phase.start)
        now = self.at(middle + half * np.sin(0.5 * np.pi * ABSCISSAS))
        power, turned = slip.directions(now.stick_radius / now.contact_radius, lateral_ratio)
        rate = now.psi - phase.sign * abs(self._scale) * now.speed
        rate = np.abs(rate) * now.contact_radius**3
        rate *= WEIGHTS * np.cos(0.5 * np.pi * ABSCISSAS)
        return SlipAngle(float(np.arcsin(lateral_ratio)), float(rate @ turned / (rate @ power)))


@overload
def solve(psi_1: float, chi: float, *, losses: None = ...) -> Solution: ...


@overload
def solve(psi_1: float, chi: float, *, losses: ScaleFreeLaw) -> Solution | LossySolution: ...


@known_keywords
def solve(
    psi_1: float, chi: float, *, losses: ScaleFreeLaw | None = None
) -> Solution | LossySolution:
    """Solve one oblique impact exactly, phase by phase.

        psi' = -(15/4) chi Q

    Q' is that of the current phase: stick (Barber 1979, (15)), a slip ring around a stick region,
    or gross slip (33).

    Parameters
    ----------
    psi_1 : float
        Dimensionless tangential velocity psi_1 = kappa V_x/(mu V_1), any finite number.
    chi : float
        Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive.
    losses : KelvinVoigt, optional
        Loss of energy in the normal motion, with a restitution; by default none.

    Returns
    -------
    Solution or LossySolution
        Its `status`, `psi_out` if that is SOLVED, and `phases` with times in d_max/V_1. Methods
        such as `at` and `history` give the state at any time. With losses a LossySolution.

    Raises
    ------
    InputError
        If an argument is not one number, or out of range.

    Examples
    --------
    >>> for phase in carom.solve(1.5, 1.44).phases:
    ...     print(f"{phase.kind:10s} {phase.sign:+d} until {phase.end:.4f}: {phase.cause}")
    gross slip +1 until 0.7958: slip stops
    stick      +0 until 1.1992: edge reaches friction limit
    slip       -1 until 2.4967: slip front reaches centre
    gross slip -1 until 2.9433: separation
    """
    psi_1, chi = pure_number("psi_1", psi_1, ONE_NUMBER), pure_number("chi", chi, ONE_NUMBER)
    if losses is None:
        return solve_elastic(psi_1, chi)
    return solve_with(psi_1, chi, scale_free(losses))


def solve_with(psi_1: float, chi: float, losses: LossNumbers) -> Solution | LossySolution:
    """Solve one impact with losses, as elastic if that is nothing."""
    if losses.loss == Loss.PLATE or is_elastic(*losses):
        return solve_elastic(psi_1, chi, losses.parameter if losses.loss == Loss.PLATE else 0.0)
    return solve_lossy(psi_1, chi, losses)


def solve_lossy(psi_1: float, chi: float, losses: LossNumbers) -> LossySolution:
    """Solve one impact in the way that suits its losses."""
    viscous = losses.loss == Loss.VISCOUS
    solution = (solve_viscoelastic if viscous else solve_by_marching)(psi_1, chi, losses)
    _refuse_unfit(psi_1, chi, solution.status)
    return solution


def solve_elastic(psi_1: float, chi: float, give: float = 0.0) -> Solution:
    """Solve one elastic impact, on a plate if the wall gives way."""
    check_kernels()
    work, record = new_work(), new_record(True)
    solved_for = max(abs(psi_1), LINEAR_PSI) if psi_1 != 0.0 or give > 0.0 else 0.0
    status = Status(run_phases(solved_for, chi, give, STEP_TOLERANCE, work, record))
    _refuse_unfit(psi_1, chi, status)
    record = trimmed(record)
    count, change_times = len(record.nodes), np.zeros(len(record.changes))
    steps = Steps(record.nodes, record.series, chi, give, np.zeros(count), np.zeros((count + 1, 2)))
    dense.tabulate(record.changes, steps, change_times)
    mirror = -1 if np.signbit(psi_1) else 1
    phases = phases_of(record.changes, change_times, mirror)
    psi_out = float("nan")
    if status is Status.SOLVED:
        psi_out = mirror * min(1.0, abs(psi_1) / LINEAR_PSI) * float(work.series[0, PSI])
    solved = psi_1, chi, psi_out, status, phases, record, steps
    if give == 0.0:
        return Solution(*solved)
    e, duration, deepest = plates.normal_motion(give, STEP_TOLERANCE, work)
    widest = deepest**0.5
    if psi_1 == 0.0:  # recorded at the smallest psi_1
        phases = (Phase(states.KIND_NAMES[Kind.STICK], 0, 0.0, duration, Cause.SEPARATION.message),)
        solved = *solved[:4], phases, record, steps
    return Solution(*solved, e, duration, deepest, deepest**1.5, widest, widest)


def _refuse_unfit(psi_1: float, chi: float, status: Status) -> None:
    if status in (Status.PSI_NOT_FINITE, Status.CHI_NOT_POSITIVE):
        name, value = ("psi_1", psi_1) if status is Status.PSI_NOT_FINITE else ("chi", chi)
        raise refusal(name, value, f"not allowed: {status.message}")


def phases_of(changes: Array, times: Array, mirror: int) -> tuple[Phase, ...]:
    """Return the phases between changes at these times; slip is as recorded, or mirrored by -1."""
    phases: list[Phase] = []
    for i in range(len(changes) - 1):
        kind = states.KIND_NAMES[Kind(int(changes[i, recorded.KIND]))]
        cause = Cause(int(changes[i + 1, recorded.CAUSE])).message
        sign = mirror * int(changes[i, recorded.KIND_SIGN])
        start, end = float(times[i]), float(times[i + 1])
        if end - start <= SHORTEST_PHASE:
            continue
        start = phases[-1].end if phases else 0.0
        if phases and (phases[-1].kind, phases[-1].sign) == (kind, sign):
            start = phases.pop().start
        phases.append(Phase(kind, sign, start, end, cause))
    if phases:  # what was too short to keep may have been the last
        last = Cause(int(changes[-1, recorded.CAUSE])).message
        phases[-1] = phases[-1]._replace(end=float(times[-1]), cause=last)
    return tuple(phases)
