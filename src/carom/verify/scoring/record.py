"""The score of a user's results: errors in psi_2, group by group, findings, pass or fail."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.io.citations import IMPACT, bibtex
from carom.io.labels import MARKS, Finding
from carom.verify.scoring.histories import Forces
from carom.verify.scoring.points import Group, Points

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Score:
    """How far results are from the exact answer; made by `score`.

    Results pass if no psi_2 is off by more than the tolerance, and every finding of the audit
    holds; all are in units of psi, forces in those of the largest, mu P_max and P_max.

    Examples
    --------
    >>> import carom
    >>> psi = [0.5, 1.0, 2.0]
    >>> score = carom.verify.score({"psi_1": psi, "psi_2": carom.rebound(psi, 1.44)}, chi=1.44)
    >>> score.passed, score.max_error
    (True, 0.0)
    """

    kind: str
    tolerance: float
    points: Points = field(repr=False)
    audit: tuple[Finding, ...] = field(repr=False)
    notes: tuple[str, ...] = ()
    forces: Forces | None = field(default=None, repr=False)
    inputs: Mapping[str, Any] = field(default_factory=dict, repr=False)

    @cached_property
    def overall(self) -> Group:
        """The errors in psi_2 of all points."""
        return self.points.group("all", self.points.psi_in == self.points.psi_in)

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

    @property
    def failures(self) -> tuple[str, ...]:
        """What is beyond the tolerance, by name."""
        off = ("psi_2",) if not self.max_error <= self.tolerance else ()
        return (*off, *(finding.name for finding in self.audit if not finding.holds))

    @property
    def passed(self) -> bool:
        """Whether nothing is beyond the tolerance."""
        return not self.failures

    def __str__(self) -> str:
        from carom.verify.scoring.report import as_text

        return as_text(self)

    def as_record(self) -> dict[str, Any]:
        """Return the score as what JSON can hold.

        Returns
        -------
        dict
            passed, tolerance, failures, kind, max_error, rms_error, mean_error, points by column,
            phases, audit, notes.
        """
        from carom.verify.scoring.report import as_record

        return as_record(self)

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        from carom.plots.result import card
        from carom.verify.scoring.report import verdict

        rows = {group.name: f"{group.max_error:.3g}" for group in (self.overall, *self.groups)}
        findings = "\n".join(f"{MARKS[f.holds]} {f.name} = {f.value:.3g}" for f in self.audit)
        return card(verdict(self), rows, self.plot(), findings)

    def cite(self) -> str:
        """Return what to cite for the exact answer, as BibTeX."""
        return bibtex(*IMPACT)

    def to_dataset(self) -> "xr.Dataset":
        """Return the score as one dataset: points along `point`, a history along `time`.

        Returns
        -------
        xarray.Dataset
            Along `point`: psi_in, psi_out, psi_out_exact, error, chi, sequence and energy_change
            (in J, a pure number for psi); audit_name, audit_value, audit_limit, audit_holds and
            audit_verdict (audit); tolerance, passed and the errors as numbers. Exact curves along
            `curve` where chi are few; forces of a history in N along `time` in s.
        """
        from carom.verify.scoring.datasets import score_dataset

        return score_dataset(self)

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Draw the results, the exact answer and the errors.

        Parameters
        ----------
        path : str or Path, optional
            Where the figure is stored, too: .png, .pdf or .svg.

        Returns
        -------
        matplotlib.figure.Figure
            The figure, of two axes or more.

        Raises
        ------
        InputError
            If the name ends otherwise or the file cannot be written.

        Examples
        --------
        >>> import carom
        >>> psi = [0.5, 1.0, 2.0]
        >>> score = carom.verify.score({"psi_1": psi, "psi_2": carom.rebound(psi, 1.44)}, chi=1.44)
        >>> len(score.plot().axes)
        2
        """
        from carom.plots.scores import plot_score
        from carom.plots.style import save_figure

        figure = plot_score(self.to_dataset())
        if path is not None:
            save_figure(figure, path)
        return figure
