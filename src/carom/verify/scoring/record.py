"""The score of a user's results: errors in psi_2, group by group, findings, pass or fail."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from carom.io.labels import Finding
from carom.verify.scoring.histories import Forces
from carom.verify.scoring.origins import Origins, unknown
from carom.verify.scoring.points import Group, Points


@dataclass(frozen=True, eq=False)
class ScoreRecord:
    """What is known of results: their points, errors, findings; no dataset, no figure."""

    kind: str
    tolerance: float
    points: Points = field(repr=False)
    audit: tuple[Finding, ...] = field(repr=False)
    notes: tuple[str, ...] = ()
    forces: Forces | None = field(default=None, repr=False)
    inputs: Mapping[str, Any] = field(default_factory=dict, repr=False)
    told_origins: Origins | None = field(default=None, repr=False)

    @cached_property
    def overall(self) -> Group:
        """The errors in psi_2 of all points."""
        return self.points.group("all", self.points.psi_in == self.points.psi_in)

    @property
    def restitution(self) -> float:
        """Restitution of the exact impacts."""
        return self.points.restitution

    @property
    def max_error(self) -> float:
        """Largest |error in psi_2|."""
        return self.overall.max_error

    @property
    def rms_error(self) -> float:
        """Root mean square of the errors in psi_2."""
        return self.overall.rms_error

    @property
    def mean_error(self) -> float:
        """Mean error in psi_2."""
        return self.overall.mean_error

    @property
    def groups(self) -> tuple[Group, ...]:
        """Errors by the sequence of phases of the exact impact, as for psi_1 > 0."""
        return self.points.groups

    @cached_property
    def origins(self) -> Origins:
        """By which code and law each point was computed."""
        return self.told_origins or unknown(self.points.rows.size)

    @property
    def by_origin(self) -> tuple[Group, ...]:
        """Errors by code and law, in the order in which they come."""
        known, places = self.origins
        return tuple(
            self.points.group(origin.label or "no name", places == place)
            for place, origin in enumerate(known)
        )

    @property
    def failures(self) -> tuple[str, ...]:
        """What is beyond the tolerance, by name."""
        off = ("psi_2",) if not self.max_error <= self.tolerance else ()
        return (*off, *(finding.name for finding in self.audit if not finding.holds))

    @property
    def passed(self) -> bool:
        """Whether nothing is beyond the tolerance."""
        return not self.failures
