"""The score with its words, its dataset and its figure."""

from typing import TYPE_CHECKING, Any

from carom import plots
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import MARKS
from carom.plots.result import Result, card
from carom.verify.scoring.datasets import score_dataset
from carom.verify.scoring.record import ScoreRecord
from carom.verify.scoring.report import as_text, verdict

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


class Score(ScoreRecord, Result):
    """How far results are from the exact answer; made by `score`.

    Results pass if no psi_2 is off by more than the tolerance, and every finding of the audit is
    within it, too. Findings are in units of psi; errors of forces are in units of the largest
    forces, mu P_max and P_max.

    Examples
    --------
    >>> import carom
    >>> psi = [0.5, 1.0, 2.0]
    >>> score = carom.verify.score({"psi_1": psi, "psi_2": carom.rebound(psi, 1.44)}, chi=1.44)
    >>> score.passed, score.max_error
    (True, 0.0)
    """

    def __str__(self) -> str:
        return as_text(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the score as what JSON can hold.

        Returns
        -------
        dict
            passed, tolerance, failures, kind, restitution, max_error, rms_error, mean_error, points
            by column, phases, laws by code and name, audit, notes.
        """
        points = self.points
        columns = {
            points.word: points.rows,
            "psi_in": points.psi_in,
            "psi_out": points.psi_out,
            "chi": points.chi,
            "psi_out_exact": points.exact,
            "error": points.error,
            "energy_change": points.energy_change,
        }
        names = ("kind", "restitution", "max_error", "rms_error", "mean_error")
        return {
            "passed": self.passed,
            "tolerance": self.tolerance,
            "failures": list(self.failures),
            **{name: getattr(self, name) for name in names},
            "points": {name: values.tolist() for name, values in columns.items()},
            "phases": [group._asdict() for group in self.groups],
            "laws": [
                {"code": origin.code or None, "law": origin.law or None, **group.numbers}
                for origin, group in zip(self.origins.known, self.by_origin, strict=True)
            ],
            "audit": [finding._asdict() for finding in self.audit],
            "notes": list(self.notes),
        }

    as_record = to_dict  # its name before

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
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
            (in J, a pure number for psi), code and law where they are known; audit_name,
            audit_value, audit_limit, audit_holds and audit_verdict (audit); tolerance, passed and
            the errors as numbers. Exact curves along `curve` where chi are few; forces of a history
            in N along `time` in s.
        """
        return score_dataset(self)

    def _draw(self, dataset: "xr.Dataset", **look: Any) -> "Figure":
        return plots.plot_score(dataset, **look)
