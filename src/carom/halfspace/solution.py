"""One impact solved by boundary elements, in plain numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import groupby, pairwise
from math import ceil
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from carom.halfspace import motion
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import LedgerEntry, entry
from carom.halfspace.quasistatic import ContactStep, Patch
from carom.halfspace.transforms import Field, Mirrors
from carom.quantities.statuses import Cause, cause_between

LEAST_SHARE = 0.3  # of the last but one refinement: errors of both signs may hide in the last
MOST_TO_COME = 3.0  # refinements of the last kind, if they do not get smaller

THIN_ZONE = 0.02  # of the contact: as little as this is the grid's
SHORTEST_STAGE = 0.02  # of the contact time

Progress = Callable[[int], object]
FAINT = 1e-6  # of the normal force: slip that pulls so little has no sign
SNAPSHOTS = 60  # steps of an impact whose fields are kept, about


class Resolution(NamedTuple):
    """Elements across the largest contact, and steps in the duration of Hertz's impact."""

    elements: int = 64
    steps: int = 300

    @property
    def half(self) -> "Resolution":
        """Half as fine in space and time."""
        return Resolution(max(self.elements // 2, 2), max(self.steps // 2, 2))


STANDARD = Resolution()


def refinement_error(quarter: float, half: float, whole: float) -> float:
    """Return about the error of a number, from grids that are whole, half and a quarter as fine.

    The last change, more where changes fall slowly, by their geometric series, and at least three
    tenths of the change before.
    """
    before, last = abs(half - quarter), abs(whole - half)
    to_come = min(last / (before - last), MOST_TO_COME) if before > last else MOST_TO_COME
    return max(last * to_come if before < 2.0 * last else last, LEAST_SHARE * before)


class SlipStage(NamedTuple):
    """A stretch of time in which all sticks, all slips, or both; `cause` is what ends it."""

    kind: str
    sign: int  # of slip along the direction of the motion before
    start: float
    end: float
    cause: str


def stages(time: Field, slipping: Field, sign: Field) -> tuple[SlipStage, ...]:
    """Return stages of an impact not too short for the grid, by the share that slips in steps."""
    kinds = [_kind(*step) for step in zip(slipping[1:-1], sign[1:-1], strict=True)]
    runs = [(kind, len(list(group))) for kind, group in groupby(kinds)]
    starts = np.cumsum([0, *(length for _, length in runs)])
    long = [
        (kind, float(time[first]))
        for (kind, length), first in zip(runs, starts, strict=False)
        if time[first + length] - time[first] >= SHORTEST_STAGE * time[-1]
    ] or [(kinds[0], 0.0)]
    kept = [next(group) for _, group in groupby(long, key=lambda item: item[0])]
    begins = [0.0, *(start for _, start in kept[1:])]
    ends = [*begins[1:], float(time[-1])]
    changes = pairwise(kind for (kind, _), _ in kept)
    causes = [*(cause_between(*change).message for change in changes), Cause.SEPARATION.message]
    return tuple(
        SlipStage(kind, sign, begin, end, cause)
        for ((kind, sign), _), begin, end, cause in zip(kept, begins, ends, causes, strict=True)
    )


def _kind(slipping: float, sign: float) -> tuple[str, int]:
    if slipping <= THIN_ZONE:
        return "stick", 0
    return "slip" if slipping < 1.0 - THIN_ZONE else "gross slip", int(sign)


class Snapshot(NamedTuple):
    """The contact at the end of a step, with the velocity of slip during it."""

    entry: LedgerEntry[float]
    step: ContactStep
    slip_velocity: Field


@dataclass(frozen=True, eq=False)
class HalfspaceSolution:
    """An impact step by step: psi_2 = kappa V_x/(friction V_1) at its end, and the way there."""

    psi_in: float
    chi: float
    psi_out: float  # along x
    spin_out: float  # about the normal, as in `NormalSpin`
    restitution: float  # unlike materials exchange a little with the other motion
    duration: float
    max_penetration: float  # in those of Hertz, as what follows
    max_force: float
    max_radius: float  # that of the circle of the same area
    max_pressure: float  # of Hertz's theory at the largest force
    materials: Materials
    spin: motion.NormalSpin
    resolution: Resolution
    ledger: LedgerEntry[Field]  # of arrays along the steps
    snapshots: tuple[Snapshot, ...]
    patch: Patch
    shear_lost: float = 0.0  # to viscosity: the bodies are elastic

    @property
    def energy_error(self) -> float:
        """Largest change of all energies over those before; of normal spin its loss counts."""
        ledger, lightness = self.ledger, self.spin.lightness
        around = ledger.spin**2 / lightness if lightness > 0.0 else np.zeros(ledger.time.size)
        moving = 0.5 * (ledger.psi**2 + ledger.psi_across**2)
        tangential = (moving + ledger.stored + np.cumsum(ledger.lost)) / self.chi
        tangential = tangential / self.materials.kappa + around - around[-1]
        normal = ledger.centre_speed**2 + ledger.normal_stored
        total = normal + self.materials.friction**2 * tangential
        return float(np.abs(total - total[0]).max() / total[0])

    @property
    def phases(self) -> tuple[SlipStage, ...]:
        """Stick, slip and gross slip in order, as far as the grid shows them."""
        pull, ledger = self.ledger.slip_force, self.ledger
        sign = np.where(np.abs(pull) > FAINT * ledger.normal_force, np.sign(pull), 0.0)
        return stages(ledger.time, ledger.slip_share, sign)

    def slip_angles(self, start: float, end: float) -> tuple[float, float]:
        """Return largest and mean angle of slip against x between two times."""
        ledger = self.ledger
        within = (ledger.time > start) & (ledger.time <= end)
        work = np.maximum(ledger.lost[within], 0.0)
        if not work.any():
            return 0.0, 0.0
        mean = np.sum(ledger.slip_angle[within] * work) / work.sum()
        return float(ledger.slip_angle_max[within].max()), float(mean)

    def history(self, n: int) -> Any:
        return self.at(np.linspace(0.0, self.duration, n))

    def at(self, time: Field) -> Any:
        """Return the impact at times as `LedgerEntry` has it, linear between the steps."""
        columns = self.ledger._asdict() | {"dissipated": np.cumsum(self.ledger.lost)}
        sampled = {name: np.interp(time, self.ledger.time, each) for name, each in columns.items()}
        none = np.zeros(np.size(time))
        return SimpleNamespace(**sampled | {"time": time}, shear_lost=none, normal_lost=none)


def solve(
    psi: float,
    chi: float,
    materials: Materials,
    resolution: Resolution = STANDARD,
    *,
    spin: motion.NormalSpin = motion.NO_SPIN,
    progress: Progress | None = None,
) -> HalfspaceSolution:
    """Return the impact with psi_1 = psi, the motion along x.

    Like materials are symmetric about both axes, unlike ones about that of motion; spin about the
    normal leaves like ones the axis across the motion, and unlike ones none. `progress` is called
    after every step with how many of `resolution.steps` it makes up for.
    """
    mirrors = Mirrors(x=materials.beta == 0.0, y=spin.speed == 0.0)
    patch = Patch.across(resolution.elements, materials, mirrors)
    rows: list[LedgerEntry[float]] = []
    snapshots: list[Snapshot] = []
    every = ceil(max(resolution) / SNAPSHOTS)
    motions = motion.move(patch, np.array([psi, 0.0]), chi, resolution.steps, spin)
    for count, (before, now) in enumerate(pairwise(motions)):
        if not rows:
            rows.append(entry(patch, chi, before, before))
        rows.append(entry(patch, chi, before, now))
        if count % every == 0:
            slip_velocity = now.step.moved / (now.time - before.time)
            snapshots.append(Snapshot(rows[-1], now.step, slip_velocity))
        if progress is not None:
            progress(_steps_until(now, resolution) - _steps_until(before, resolution))
    ledger = LedgerEntry(*np.array(rows).T)
    max_force = float(ledger.normal_force.max())
    return HalfspaceSolution(
        psi,
        chi,
        psi_out=float(ledger.psi[-1]),
        spin_out=float(ledger.spin[-1]),
        restitution=-float(ledger.centre_speed[-1]),
        duration=float(ledger.time[-1]),
        max_penetration=float(ledger.penetration.max()),
        max_force=max_force,
        max_radius=float(ledger.contact_radius.max()),
        max_pressure=float(max_force ** (1.0 / 3.0)),
        materials=materials,
        spin=spin,
        resolution=resolution,
        ledger=ledger,
        snapshots=tuple(snapshots),
        patch=patch,
    )


def _steps_until(now: motion.BodyMotion, resolution: Resolution) -> int:
    """Return how many steps of equal length an instant is worth; all of them at the end."""
    apart = now.approach < 0.0 and now.force == 0.0
    passed = 1.0 if apart else min(now.time / motion.DURATION, 1.0)
    return round(passed * resolution.steps)
