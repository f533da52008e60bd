"""Results as points psi_2(psi_1, chi), the exact answer to each, and the errors."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.rebounds import rebound, regime_borders, solved
from carom.impacts.curves import REGIMES, regime_map
from carom.io.cells import MOST_NAMED_ROWS, Rows
from carom.io.progress import advancing
from carom.io.user_table import UserTable
from carom.quantities.arrays import Array
from carom.quantities.prefixes import text
from carom.quantities.refusals import InputError
from carom.quantities.verdicts import Finding
from carom.verify.errors import losses_of

IMPACTS_AT_ONCE = 1 << 16  # after which the bar moves
LARGEST_PSI = 1e9  # there rounding is as large as errors that matter
ROUNDING_OF_PSI = 1e-12  # less is no gain of energy
RATIO_TOLERANCE = 1e-3  # of ratios that should be one
FEWEST_POINTS = 3
PRINTED_DIGITS = 1e-3  # of the limit: numbers were rounded when printed


class Group(NamedTuple):
    """Errors in psi_2 of the points of one name: `max_error`, `rms_error` and `mean_error`."""

    name: str
    points: int
    max_error: float
    rms_error: float
    mean_error: float


@dataclass(frozen=True, eq=False)
class Points(Rows):
    """Rebounds of a user and the exact ones; `energy_change` is that after less that before.

    It is in J, or in units of m_t (mu V_1/kappa)^2/2 where all is dimensionless: psi_2^2 - psi_1^2.
    `sequence` counts into `sequence_names`; with losses the regimes of the exact impacts stand for
    the sequences of their phases. `rows` have their places, lines or rows by `word`.
    """

    psi_in: Array
    psi_out: Array
    chi: Array
    restitution: float
    exact: Array
    sequence: NDArray[np.int64]
    sequence_names: tuple[str, ...]
    energy_change: Array
    rows: NDArray[np.int64]
    word: str

    @cached_property
    def error(self) -> Array:
        """psi_2 less the exact one."""
        return self.psi_out - self.exact

    @property
    def worst(self) -> int:
        """The index of the largest error."""
        return int(np.argmax(np.abs(self.error)))

    def group(self, name: str, where: NDArray[np.bool_]) -> Group:
        """Return the errors of some of the points."""
        error = self.error[where]
        rms = float(np.sqrt(np.mean(error**2)))
        return Group(name, error.size, float(np.abs(error).max()), rms, float(error.mean()))

    @property
    def groups(self) -> tuple[Group, ...]:
        """The errors by the sequence of phases of the exact impact, by rising |psi_1|."""
        places = np.unique(self.sequence).tolist()
        members = {place: self.sequence == place for place in places}
        order = sorted(places, key=lambda place: np.abs(self.psi_in[members[place]]).min())
        return tuple(self.group(self.sequence_names[i], members[i]) for i in order)


class Scored(NamedTuple):
    """What is found of results of one kind; forces are those of a history."""

    points: Points
    audit: tuple[Finding, ...]
    notes: tuple[str, ...]
    inputs: Mapping[str, Any]
    forces: Any = None


def refuse_large(psi_in: Array, psi_out: Array, results: UserTable) -> None:
    """Raise InputError for velocities in a unit that cannot be theirs."""
    large = ~(np.maximum(np.abs(psi_in), np.abs(psi_out)) <= LARGEST_PSI)
    if large.any():
        where = results.named(large)
        raise InputError(f"results: |psi| is above {LARGEST_PSI:g} in {where}; check the units")


def compared(
    psi_in: Array,
    psi_out: Array,
    chi: Array,
    restitution: float,
    energy_change: Array,
    results: UserTable,
) -> Points:
    """Return results beside the exact rebounds, or raise InputError where these are not known."""
    exact, status, codes = _solved(psi_in, chi, restitution)
    if (status != Status.SOLVED).any():
        bad = status != Status.SOLVED
        reason = Status(int(status[bad][0])).message
        raise InputError(f"results: no exact answer for {results.named(bad)}; {reason}")
    if restitution == 1.0:
        sequence, names = _sequences(psi_in, chi, codes)
    else:
        sequence, names = codes, REGIMES
    columns = psi_in, psi_out, chi, restitution, exact, sequence, names, energy_change
    return Points(*columns, results.rows, results.word)


def _solved(
    psi: Array, chi: Array, restitution: float
) -> tuple[Array, NDArray[np.int8], NDArray[np.int64]]:
    """Return the exact rebounds, their status and codes of phases, chunk by chunk."""
    one = solved if restitution == 1.0 else partial(_with_losses, restitution=restitution)
    parts = []
    with advancing("solving the exact impacts", psi.size, unit="impacts") as advance:
        for start in range(0, psi.size, IMPACTS_AT_ONCE):
            part = slice(start, start + IMPACTS_AT_ONCE)
            parts.append(one(np.array(psi[part]), np.array(chi[part])))
            advance(parts[-1][0].size)
    exact, status, codes = map(np.concatenate, zip(*parts, strict=True))
    return exact, status, codes


def _with_losses(
    psi: Array, chi: Array, restitution: float
) -> tuple[Array, NDArray[np.int8], NDArray[np.int64]]:
    """Return the exact rebounds with losses, their status and regimes."""
    losses = losses_of(restitution)
    exact, status = rebound(psi, chi, losses=losses, return_status=True)
    borders = regime_borders(chi, restitution)
    return exact, status, np.sum(np.abs(psi)[:, np.newaxis] > borders, axis=1)


def _sequences(
    psi: Array, chi: Array, codes: NDArray[np.int64]
) -> tuple[NDArray[np.int64], tuple[str, ...]]:
    """Return places in a tuple of names of sequences, of psi_1 > 0; one impact for each code."""
    _, first, inverse = np.unique(codes, return_index=True, return_inverse=True)
    maps = [regime_map([abs(float(psi[i]))], [float(chi[i])]) for i in first]
    sequences = [str(each["sequence_name"].values[0]) for each in maps]
    names = tuple(dict.fromkeys(sequences))
    places = np.array([names.index(name) for name in sequences], dtype=np.int64)
    return places[inverse], names


def within(name: str, value: float, limit: float, verdict: str) -> Finding:
    """Return a finding that holds up to its limit."""
    return Finding(name, value, limit, value <= limit, verdict)


def energy_audit(points: Points, unit: Array, symbol: str, limit: float) -> Finding:
    """Return whether an impact gains energy: neither psi_2^2 over psi_1^2, nor all of it together.

    `unit` is what a change of energy is divided by to be one of psi^2, `symbol` the name of its own
    unit. The value is by how much |psi_2| would be too large if the contact point had all of it.
    """
    before = np.abs(points.psi_in)
    change = np.maximum(points.energy_change, unit * (points.psi_out**2 - before**2))
    excess = np.sqrt(np.maximum(before**2 + change / unit, 0.0)) - before
    gains = excess > ROUNDING_OF_PSI * np.maximum(1.0, before)
    if not gains.any():
        return within("energy gain", 0.0, limit, "no impact gains energy")
    order = np.argsort(-np.where(gains, change, -np.inf))[: min(MOST_NAMED_ROWS, gains.sum())]
    largest = "; ".join(f"{points.one(i)}: {text(change[i], symbol)}" for i in order)
    more = f"; and {gains.sum() - MOST_NAMED_ROWS} more" if gains.sum() > MOST_NAMED_ROWS else ""
    verdict = f"energy is gained in {largest}{more}"
    return within("energy gain", float(excess.max()), limit, verdict)


def friction_audit(points: Points, restitution: Array, limit: float) -> Finding:
    """Return whether friction can give the impulse: |psi_1 - psi_2| <= 2 (1 + e) chi."""
    needed = np.abs(points.psi_in - points.psi_out)
    excess = needed - 2.0 * (1.0 + restitution) * points.chi
    above = excess > PRINTED_DIGITS * limit
    verdict = "no tangential impulse exceeds mu times the normal one"
    if above.any():
        verdict = f"tangential above mu times normal impulse in {points.named(above)}"
        verdict += f", most in {points.one(int(np.argmax(excess)))}"
    return within("friction impulse", max(float(excess.max()), 0.0), limit, verdict)


def restitution_audit(points: Points, restitution: Array, limit: float) -> Finding:
    """Return whether the normal impact leaves as much as the exact one."""
    expected = points.restitution
    off, elastic = np.abs(restitution - expected), expected == 1.0
    value, worst = float(off.max()), int(np.argmax(off))
    verdict = "the normal impact is elastic" if elastic else f"e = {expected:g}, as expected"
    if not value <= limit:
        where = f"in {points.named(off > limit)}, most in {points.one(worst)}"
        advice = "switch the normal damping off, or give the restitution that it has, restitution="
        advice = advice if elastic else "change the damping of the normal contact"
        verdict = f"e = {restitution[worst]:.6g}, not {expected:g}, {where}; {advice}"
    return within("restitution error", value, limit, verdict)


def notes_on(points: Points) -> tuple[str, ...]:
    """Return what may be wrong with all points: the sign of psi_2, or chi, by sliding impacts."""
    notes = []
    if 2.0 * np.linalg.norm(points.psi_out + points.exact) < np.linalg.norm(points.error):
        notes.append("does psi_2 have the opposite sign? Count psi_1 and psi_2 along the same axis")
    most = 2.0 * (1.0 + points.restitution) * points.chi
    slides = np.abs(points.psi_in) > np.maximum(most, 1.0)
    with np.errstate(over="ignore"):  # of a chi of next to nothing
        ratio = np.abs(points.psi_in - points.psi_out)[slides] / most[slides]
    agree = ratio.size > 1 and np.isfinite(ratio).all() and np.ptp(ratio) < RATIO_TOLERANCE
    if agree and abs(ratio[0] - 1.0) > RATIO_TOLERANCE:
        times = f"{ratio[0]:.4g} times"
        factor = f"{2.0 * (1.0 + points.restitution):g} chi"
        notes.append(f"in gross slip psi_1 - psi_2 is {times} {factor}: is chi {times} as large?")
    return tuple(notes)
