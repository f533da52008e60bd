"""Findings on assumptions of a theory, and the verdict that they add up to."""

from dataclasses import dataclass
from math import isfinite, isnan
from typing import Any, NamedTuple

from carom.quantities.prefixes import Printed

MARKS = {True: "ok   ", False: "FAILS", None: "?    "}  # of an assumption
VERDICTS = {True: "holds", False: "fails", None: "not judged"}  # of all of them


class Finding(NamedTuple):
    """A number that tells if the theory holds: name, value, limit, verdict, what is missing."""

    name: str
    value: float
    limit: float
    holds: bool | None  # None: cannot be judged
    verdict: str
    missing: str = ""  # the argument that would let it be judged, and whose

    @property
    def label(self) -> str:
        """Name and value, the name alone where no value is known."""
        return self.name if isnan(self.value) else f"{self.name} = {self.value:.3g}"


@dataclass(frozen=True)
class Validity(Printed):
    """All `findings` on one impact: whether the assumptions of the theory hold; printed, a table.

    What a finding lacks to be judged is in its `missing` and its `verdict`, which tells where to
    put it.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="bearing steel")
    >>> wall = carom.HalfSpace(material="bearing steel")
    >>> pair = carom.Pair(ball, wall, friction=0.2, roughness="30 nm")
    >>> carom.impact(pair, speed=0.1, angle="30 deg").validity.holds
    True
    >>> carom.impact(pair, speed=5.0, angle="30 deg").validity.verdict
    'fails'
    """

    findings: tuple[Finding, ...]

    @property
    def holds(self) -> bool | None:
        """True if all assumptions hold, False if one fails, None if one of them is not judged."""
        holds = {finding.holds for finding in self.findings}
        return False if False in holds else (None if None in holds else True)

    @property
    def verdict(self) -> str:
        """What `holds` says in words, as holds, fails or not judged."""
        return VERDICTS[self.holds]

    def records(self) -> list[dict[str, Any]]:
        """Return the findings as what JSON can hold; a value that is not finite is None."""
        values = (each.value if isfinite(each.value) else None for each in self.findings)
        return [
            {**finding._asdict(), "value": value}
            for finding, value in zip(self.findings, values, strict=True)
        ]

    def __str__(self) -> str:
        lines = [f"{MARKS[f.holds]} {f.label}: {f.verdict}" for f in self.findings]
        return "\n".join([*lines, f"verdict: {self.verdict}"])
