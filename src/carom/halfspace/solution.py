"""One impact solved by boundary elements, in plain numbers."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil
from typing import NamedTuple

import numpy as np

from carom.halfspace import motion
from carom.halfspace.compliance import Materials
from carom.halfspace.influence import Field
from carom.halfspace.ledger import LedgerEntry, entry
from carom.halfspace.quasistatic import ContactStep, Patch
from carom.halfspace.refinement import STANDARD, Resolution
from carom.halfspace.stages import SlipStage, stages
from carom.halfspace.transforms import Mirrors

Progress = Callable[[int], object]
FAINT = 1e-6  # of the normal force: slip that pulls so little has no sign
VELOCITIES = ("velocity", "velocity_across", "turn_velocity")
SNAPSHOTS = 60  # steps of an impact whose fields are kept, about


class GridHistory(NamedTuple):
    """An impact at some times; units d_max, d_max/V_1, and for tangential motion those of psi."""

    time: Field
    penetration: Field
    speed: Field
    psi: Field
    displacement: Field
    force: Field
    stick_radius: Field
    contact_radius: Field
    stored: Field
    dissipated: Field
    shear_lost: Field
    normal_force: Field
    normal_stored: Field
    normal_lost: Field
    slip_angle: Field
    slip_angle_max: Field


class Turning(NamedTuple):
    """Spin about the normal at some times, the moment against it, velocity across the motion."""

    speed: Field
    moment: Field
    velocity_across: Field


class Snapshot(NamedTuple):
    """The contact at the end of a step, with the velocity of slip during it."""

    entry: LedgerEntry
    step: ContactStep
    slip_velocity: Field


@dataclass(frozen=True, eq=False)
class HalfspaceSolution:
    """An impact step by step: psi_2 = kappa V_x/(friction V_1) at its end, and the way there."""

    psi_in: float
    chi: float
    materials: Materials
    spin: motion.NormalSpin
    resolution: Resolution
    ledger: Field  # a row a LedgerEntry
    snapshots: tuple[Snapshot, ...]
    patch: Patch

    def column(self, name: str) -> Field:
        """Return one quantity of `LedgerEntry` along the steps."""
        return np.asarray(getattr(LedgerEntry(*self.ledger.T), name))

    @property
    def psi_out(self) -> float:
        """psi after the impact, along x."""
        return self.materials.kappa * float(self.column("velocity")[-1])

    @property
    def spin_out(self) -> float:
        """Spin about the normal after the impact, as in `NormalSpin`."""
        return float(self.column("turn_velocity")[-1])

    @property
    def restitution(self) -> float:
        """Normal velocity after to before; unlike materials exchange a little with the other."""
        return -float(self.column("approach")[-1])

    @property
    def duration(self) -> float:
        """Time of contact, in d_max/V_1."""
        return float(self.column("time")[-1])

    @property
    def max_penetration(self) -> float:
        """Largest approach, in d_max of Hertz."""
        return float(self.column("depth").max())

    @property
    def max_force(self) -> float:
        """Largest normal force, in that of Hertz."""
        return float(self.column("normal_force").max())

    @property
    def max_radius(self) -> float:
        """Largest radius of the contact, that of the circle of the same area, in that of Hertz."""
        return float(self.column("contact_radius").max())

    @property
    def max_pressure(self) -> float:
        """Largest pressure of Hertz's theory at the largest force, in that of Hertz."""
        return float(self.max_force ** (1.0 / 3.0))

    @property
    def shear_lost(self) -> float:
        """Energy lost to viscosity in shear: none, the bodies are elastic."""
        return 0.0

    @property
    def energy_error(self) -> float:
        """Largest change of the sum of all energies, as a share of those before the impact.

        Of spin about the normal what it loses counts: all of it may be as large as one likes.
        """
        response = motion.responses(self.chi, self.materials.kappa, self.spin.lightness)
        along, across, around = (
            0.5 * self.column(name) ** 2 / each if each > 0.0 else np.zeros(len(self.ledger))
            for name, each in zip(VELOCITIES, response, strict=True)
        )
        lost = np.cumsum(self.column("lost"))
        tangential = along + across + around - around[-1] + self.column("tangential_stored") + lost
        normal = 0.5 * self.column("approach") ** 2 / motion.NORMAL + self.column("normal_stored")
        total = normal + self.materials.friction**2 * tangential
        return float(np.abs(total - total[0]).max() / total[0])

    @property
    def phases(self) -> tuple[SlipStage, ...]:
        """Stick, slip and gross slip in order, as far as the grid shows them."""
        pull = self.column("slip_drag")
        sign = np.where(np.abs(pull) > FAINT * self.column("force"), np.sign(pull), 0.0)
        return stages(self.column("time"), self.column("slip_share"), sign)

    def slip_angles(self, start: float, end: float) -> tuple[float, float]:
        """Return largest and mean angle of slip against x between two times."""
        time = self.column("time")
        within = (time > start) & (time <= end)
        work = np.maximum(self.column("lost")[within], 0.0)
        if not work.any():
            return 0.0, 0.0
        mean = np.sum(self.column("slip_angle")[within] * work) / work.sum()
        return float(self.column("slip_angle_max")[within].max()), float(mean)

    def history(self, n: int) -> GridHistory:
        """Return the impact at n evenly spaced times."""
        return self.at(np.linspace(0.0, self.duration, n))

    def at(self, time: Field) -> GridHistory:
        """Return the impact at times, linear between the steps."""
        return GridHistory(
            time, *(np.interp(time, self.column("time"), c) for c in self._columns())
        )

    def turning(self, n: int) -> Turning:
        """Return the spin about the normal at n evenly spaced times, and what goes with it."""
        time = np.linspace(0.0, self.duration, n)
        names = ("turn_velocity", "moment", "velocity_across")
        return Turning(*(np.interp(time, self.column("time"), self.column(name)) for name in names))

    def snapshot(self, time: float) -> Snapshot:
        """Return the kept step that ends nearest to a time."""
        return min(self.snapshots, key=lambda kept: abs(kept.entry.time - time))

    def _columns(self) -> tuple[Field, ...]:
        """Return all columns of a history but the time, in its units."""
        kappa = self.materials.kappa
        of_normal = 2.0 * motion.NORMAL
        energy = kappa * of_normal * self.chi  # of psi^2/2 in those of the tangential motion
        return (
            self.column("depth"),
            self.column("approach"),
            kappa * self.column("velocity"),
            kappa * self.column("displacement"),
            self.column("tangential_force"),
            self.column("stick_radius"),
            self.column("contact_radius"),
            energy * self.column("tangential_stored"),
            energy * np.cumsum(self.column("lost")),
            np.zeros(len(self.ledger)),
            self.column("normal_force"),
            of_normal * self.column("normal_stored"),
            np.zeros(len(self.ledger)),
            self.column("slip_angle"),
            self.column("slip_angle_max"),
        )


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
    rows: list[LedgerEntry] = []
    snapshots: list[Snapshot] = []
    every = ceil(max(resolution) / SNAPSHOTS)
    motions = motion.move(patch, np.array([psi, 0.0]), chi, resolution.steps, spin)
    for count, (before, now) in enumerate(pairwise(motions)):
        if not rows:
            rows.append(entry(patch, before, before))
        rows.append(entry(patch, before, now))
        if count % every == 0:
            slip_velocity = now.step.moved / (now.time - before.time)
            snapshots.append(Snapshot(rows[-1], now.step, slip_velocity))
        if progress is not None:
            progress(_steps_until(now, resolution) - _steps_until(before, resolution))
    return HalfspaceSolution(
        psi, chi, materials, spin, resolution, np.array(rows), tuple(snapshots), patch
    )


def _steps_until(now: motion.BodyMotion, resolution: Resolution) -> int:
    """Return how many steps of equal length an instant is worth; all of them at the end."""
    apart = now.approach < 0.0 and now.force == 0.0
    passed = 1.0 if apart else min(now.time / motion.DURATION, 1.0)
    return round(passed * resolution.steps)
