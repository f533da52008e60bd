"""Rebounds of many impacts at once, in threads."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.dimensionless.elastic import plates
from carom.dimensionless.elastic.integration import Work
from carom.dimensionless.elastic.motion import PSI
from carom.dimensionless.elastic.phases import (
    LARGEST_GIVE,
    Status,
    check_kernels,
    new_work,
    run_phases,
)
from carom.dimensionless.elastic.record import KIND, KIND_SIGN, Record, new_record
from carom.dimensionless.lossy import law, layout
from carom.dimensionless.lossy.law import Loss, LossNumbers, LossyRebounds, ScaleFreeLaw
from carom.dimensionless.lossy.springs import march, metal
from carom.dimensionless.lossy.springs.solids import SOLIDS
from carom.dimensionless.lossy.viscoelastic import impacts as viscoelastic, record, work
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array, Codes, Counts, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.numerics.threads import in_blocks
from carom.quantities.arrays import along_the_same, pure_numbers, together
from carom.quantities.refusals import flag, known_keywords, refusal
from carom.quantities.statuses import WordedStatus
from carom.quantities.units import threads_or_none

THROUGHOUT = 3  # place of the regime of gross slip throughout
STEP_TOLERANCE = 1e-10  # of one Taylor step; keeps psi_2 to a tenth of what `rebound` promises
LINEAR_PSI = 1e-6  # below, psi_2 is taken proportional to psi_1: rounding would cost more
BLOCK, SMALLEST_BLOCK = 256, 64  # impacts that a thread takes at once

NEARLY_ELASTIC, NEARLY_YIELDING = 1e-10, 1e-5
LOSSY_BLOCK, SMALLEST_LOSSY_BLOCK = 64, 2  # the same with losses


@kernel
def outgoing(
    psi_1: float, chi: float, give: float, work: Work, record: Record
) -> tuple[float, int]:
    """Return psi_2 of one impact, of either sign, and its status; `give` is lambda of a plate."""
    speed = abs(psi_1)
    scale = 1.0
    if 0.0 < speed < LINEAR_PSI:
        scale = speed / LINEAR_PSI
        speed = LINEAR_PSI
    if speed == 0.0 and give > 0.0:
        return psi_1, Status.SOLVED.value
    status = run_phases(speed, chi, give, STEP_TOLERANCE, work, record)
    if status != Status.SOLVED:
        return np.nan, status
    result = scale * work.series[0, PSI] if speed > 0.0 else 0.0
    return -result if np.signbit(psi_1) else result, status


@kernel
def code_of_phases(record: Record) -> int:
    """Return a number that tells one sequence of phases and stretches of memory from another."""
    code = 1 + int(record.counts[1])
    for row in range(record.counts[2]):
        digit = 3 * int(record.changes[row, KIND]) + int(record.changes[row, KIND_SIGN]) + 1
        code = (code * 16 + digit) % 2147483629  # a prime: sequences of any length stay apart
    return code


@entry_point()
def fill(
    psi_1: Vector,
    chi: Vector,
    give: Vector,
    work: Work,
    record: Record,
    psi_2: Vector,
    status: Codes,
    sequence: Counts,
) -> None:
    """Write psi_2, the status and the sequence of phases of every impact."""
    for i in range(psi_1.size):
        record.counts[:] = 0
        psi_2[i], status[i] = outgoing(psi_1[i], chi[i], give[i], work, record)
        sequence[i] = code_of_phases(record)


@entry_point()
def fill_motion(give: Vector, tolerance: float, work: Work, numbers: Matrix) -> None:
    """Write what the normal motion of every impact comes to, NaN where lambda is out of range."""
    for i in range(give.size):
        out = numbers[i]
        out[: layout.NUMBERS] = np.nan
        if not 0.0 <= give[i] <= LARGEST_GIVE:
            continue
        e, duration, deepest = plates.normal_motion(give[i], tolerance, work)
        out[layout.RESTITUTION], out[layout.LOST], out[layout.TIME] = e, 1.0 - e * e, duration
        out[layout.DEEPEST], out[layout.WIDEST] = deepest, np.sqrt(deepest)
        out[layout.STRONGEST] = deepest * np.sqrt(deepest)


def solved(
    psi_1: Array, chi: Array, threads: int | None = None, give: Array | float = 0.0
) -> tuple[Array, NDArray[np.int8], NDArray[np.int64]]:
    """Return psi_2, `Status` and code of phases of impacts, in threads; `give` is of a plate."""
    check_kernels()
    gives = np.broadcast_to(np.asarray(give, dtype=np.float64), psi_1.shape).copy()
    psi_2, status = np.empty(psi_1.size), np.empty(psi_1.size, dtype=np.int8)
    sequence = np.empty(psi_1.size, dtype=np.int64)

    def block(part: slice) -> None:
        results = psi_2[part], status[part], sequence[part]
        arguments = psi_1[part], chi[part], gives[part]
        fill(*arguments, new_work(), new_record(False), *results)

    in_blocks(block, psi_1.size, BLOCK, SMALLEST_BLOCK, threads)
    return psi_2, status, sequence


def is_elastic(loss: int, parameter: Array, extra: Array) -> NDArray[np.bool_]:
    """Tell where so little is lost, 1 - e below 2e-10, that the impact is the elastic one."""
    if loss not in SOLIDS:
        raise refusal(
            "loss", loss, "has no solid in SOLIDS of dimensionless/lossy/springs/march.py"
        )
    if loss == Loss.PLASTIC:
        return np.asarray(parameter > 1.0 - NEARLY_YIELDING)
    if loss == Loss.METAL:
        return np.asarray(parameter * parameter * metal.FLATTENS >= 1.0)
    alpha = parameter * extra if loss == Loss.RELAXING else parameter
    return np.asarray((alpha >= 0.0) & (alpha < NEARLY_ELASTIC))


def lossy_rebounds(
    psi_1: Array,
    chi: Array,
    losses: LossNumbers,
    threads: int | None = None,
    tolerance: float = viscoelastic.TOLERANCE,
) -> LossyRebounds:
    """Return what impacts with losses come to, in threads; NaN where the status is not SOLVED."""
    parameter, extra = (np.broadcast_to(x, psi_1.shape) for x in losses[1:])
    elastic = is_elastic(losses.loss, parameter, extra)
    numbers, status = np.ones((psi_1.size, layout.NUMBERS)), np.zeros(psi_1.size, dtype=np.int8)
    numbers[:, layout.TIME], numbers[:, layout.SHEAR_LOST] = hertz.DURATION, 0.0
    psi_2, status[elastic], _ = solved(psi_1[elastic], chi[elastic], threads)
    numbers[elastic, layout.PSI_OUT] = psi_2
    lossy = np.flatnonzero(~elastic)
    columns = tuple(x[lossy] for x in (psi_1, chi, parameter, extra))
    rows, codes = np.empty((lossy.size, march.NUMBERS)), np.empty(lossy.size, dtype=np.int8)

    def block(part: slice) -> None:
        psis, chis, parameters, extras = (column[part] for column in columns)
        out = rows[part], codes[part]
        if losses.loss == Loss.PLATE:
            psi_2, codes[part], _ = solved(psis, chis, 1, parameters)
            fill_motion(parameters, STEP_TOLERANCE, new_work(), rows[part])
            rows[part, layout.PSI_OUT], rows[part, layout.SHEAR_LOST] = psi_2, 0.0
        elif losses.loss == Loss.VISCOUS:
            arrays = tolerance, work.new_work(), record.new_record(False)
            viscoelastic.fill(psis, chis, parameters, *arrays, *out)
        else:
            solid = int(losses.loss), parameters, extras
            march.fill(psis, chis, *solid, march.new_work(), *out)

    in_blocks(block, lossy.size, LOSSY_BLOCK, SMALLEST_LOSSY_BLOCK, threads)
    numbers[lossy], status[lossy] = rows[:, : layout.NUMBERS], codes
    numbers[status != Status.SOLVED] = np.nan
    return law.named(numbers, losses.loss, status)


@known_keywords
def rebound(
    psi_1: ArrayLike,
    chi: ArrayLike,
    *,
    threads: int | None = None,
    return_status: bool = False,
    losses: ScaleFreeLaw | None = None,
) -> Any:
    """Return the tangential velocity of the contact point after an oblique impact.

        psi_2 = psi_2(psi_1, chi)

    The function is the exact solution of Maw, Barber & Fawcett (1976), with the stick phase of
    Barber (1979), (15)-(37), and the slip ring that follows it. Its error is below
    1e-10 max(1, |psi_1|) for 0.05 <= chi <= 10 and ten times that for chi <= 60. With losses it is
    below 1e-8 max(1, |psi_1|).

    Parameters
    ----------
    psi_1 : array_like
        Dimensionless tangential velocity of the contact point before the impact,
        psi_1 = kappa V_x/(mu V_1), of any sign.
    chi : array_like
        Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive; broadcast against
        `psi_1`.
    threads : int, optional
        Number of threads, by default all cores. The result does not depend on it.
    return_status : bool
        Whether to return also an array of `Status` values, one for each impact.
    losses : KelvinVoigt, optional
        Loss of energy in the normal motion, with a restitution; by default none.

    Returns
    -------
    float or ndarray
        psi_2, in the shape of the broadcast arguments. It is NaN where an argument is out of range
        or masked, and where chi is too large (above some thousands, or above 1000 with losses).
        One RuntimeWarning then says where and why, unless `return_status` is set.

    Raises
    ------
    InputError
        If an argument is not a pure number, the shapes do not fit, `losses` is not a law of losses
        or depends on the speed, or `threads` is below 1.

    Examples
    --------
    >>> carom.rebound([0.5, 1.5, 3.5, 6.0], 1.44).round(6)
    array([ 0.047131, -0.429967, -1.477247,  0.24    ])
    >>> carom.rebound([0.5, 6.0], 1.44, losses=carom.KelvinVoigt(restitution=0.9)).round(6)
    array([0.00384, 0.528  ])
    """
    threads, return_status = threads_or_none(threads), flag("return_status", return_status)

    def solve(psi: Array, chi: Array) -> tuple[Array, Codes, str]:
        if losses is None:
            return *solved(psi, chi, threads)[:2], ""
        lossy = lossy_rebounds(psi, chi, law.scale_free(losses), threads)
        return lossy.psi_out, lossy.status, ""

    return answered({"psi_1": psi_1, "chi": chi}, solve, Status, return_status)


def regime_borders(chi: ArrayLike, restitution: ArrayLike = 1.0, turning: float = 0.0) -> Array:
    """Return the |psi_1| at which the regime changes, along a new last axis.

    They are 1; 2 chi (1 - w), up to which gross slip ends before the largest compression; and
    2 chi (1 + e) - e, from which on gross slip lasts to the end. All are 1 for chi <= 1/2. w is the
    speed of the centres as the surfaces turn, 0 unless a plate gives way.
    """
    chi, e = np.broadcast_arrays(np.asarray(chi, dtype=np.float64), np.asarray(restitution))
    with np.errstate(over="ignore"):
        twice = 2.0 * chi
        borders = np.ones_like(twice), twice * (1.0 - turning), twice * (1.0 + e) - e
    return np.asarray(np.maximum(np.stack(borders, axis=-1), 1.0))


def regimes(psi: Array, chi: float, restitution: float) -> NDArray[np.int8]:
    """Return the place of the regime of each psi_1 in `carom.impacts.curves.REGIMES`."""
    borders = regime_borders(chi, restitution)
    return np.searchsorted(borders, np.abs(psi), side="right").astype(np.int8)


def answered(
    arguments: Mapping[str, Any],
    solve: Callable[..., tuple[Array, Codes, str]],
    kind: type[WordedStatus],
    return_status: bool,
) -> Any:
    """Return psi_2 of impacts whose arguments broadcast, and the status of each if asked for.

    `solve` takes flat arrays and returns psi_2, a status, zero where solved, and the first reason,
    "" if its status of this `kind` says it; of that there is one warning, unless status is asked.
    """
    along_the_same(**arguments)
    numbers = {name: pure_numbers(name, values) for name, values in arguments.items()}
    shape = together(numbers)
    flat = (np.array(np.broadcast_to(values, shape)).ravel() for values in numbers.values())
    psi_out, codes, reason = solve(*flat)
    result = psi_out.reshape(shape) if shape else float(psi_out[0])
    status = codes.reshape(shape)
    if return_status:
        return result, status if shape else int(codes[0])
    unsolved = np.argwhere(status)
    if len(unsolved):
        first = tuple(int(i) for i in unsolved[0])
        reason = reason or kind(int(status[first])).message
        where = f"first at index {first}: {reason}" if first else reason
        warnings.warn(
            f"{len(unsolved)} of {status.size} impacts give NaN ({where}); "
            "return_status=True tells each",
            RuntimeWarning,
            stacklevel=4,  # past `known_keywords` to the user
        )
    return result
