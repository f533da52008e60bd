"""The score of results: errors in psi_2, findings, pass or fail; in words and as a dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.dimensionless.rebounds import regime_borders
from carom.impacts.curves import curve
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import flags, labelled_dataset, pure
from carom.plots.result import Result, card
from carom.quantities.glossary import GLOSSARY
from carom.quantities.verdicts import MARKS, Finding
from carom.verify.errors import losses_of
from carom.verify.scoring.histories import Forces
from carom.verify.scoring.origins import Origins
from carom.verify.scoring.points import Group, Points
from carom.verify.tables import text_table

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

MOST_LISTED = 40  # points; of more, as many of the worst
MOST_CURVES, CURVE_POINTS = 5, 401  # exact curves in the dataset, one for each chi
NUMBERS = {
    "tolerance": "largest error that passes",
    "restitution": "restitution of the exact impacts",
    "max_error": "largest |error in psi_2|",
    "rms_error": "root mean square of the errors in psi_2",
    "mean_error": "mean error in psi_2",
}


@dataclass(frozen=True, eq=False)
class Score(Result):
    """How far results are from the exact answer; made by `score`.

    Results pass if no psi_2 is off by more than the tolerance, and every finding of the audit is
    within it, too. Findings are in units of psi; errors of forces are in units of the largest
    forces, mu P_max and P_max. `kind` says what was scored, `points` are the rebounds and `forces`
    a history, `origins` their codes and laws; `inputs` made the exact answer, `notes` are remarks.

    Examples
    --------
    >>> psi = [0.5, 1.0, 2.0]
    >>> score = carom.verify.score({"psi_1": psi, "psi_2": carom.rebound(psi, 1.44)}, chi=1.44)
    >>> score.passed, score.max_error
    (True, 0.0)
    """

    kind: str
    tolerance: float
    points: Points = field(repr=False)
    audit: tuple[Finding, ...] = field(repr=False)
    notes: tuple[str, ...]
    inputs: Mapping[str, Any] = field(repr=False)
    forces: Forces | None = field(repr=False)
    origins: Origins = field(repr=False)  # of each point

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

    @property
    def by_origin(self) -> tuple[Group, ...]:
        """Errors by code and law, in the order in which they come."""
        origins, places = self.origins
        return tuple(
            self.points.group(origin.label or "no name", places == place)
            for place, origin in enumerate(origins)
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

    def __str__(self) -> str:
        groups = (*self.groups, self.overall)
        parts = [*_listed(self), *_table("By sequence of phases, for psi_1 > 0", groups)]
        parts += _table("By law", self.by_origin) if len(self.origins.distinct) > 1 else []
        parts += ["Audit"]
        for finding in self.audit:
            found = f"{finding.name} = {finding.value:.3g}"
            parts.append(f"  {MARKS[finding.holds]} {found:32s} {finding.verdict}")
        parts += [f"note: {note}" for note in self.notes]
        return "\n".join([*parts, verdict(self)])

    def to_dict(self) -> dict[str, Any]:
        """Return the score as what JSON can hold.

        It has passed, tolerance, failures, kind, restitution, max_error, rms_error, mean_error,
        points by column, phases, laws by code and name, audit and notes.
        """
        points = self.points
        columns = {points.word: points.rows, "psi_in": points.psi_in, "psi_out": points.psi_out}
        columns |= {"chi": points.chi, "psi_out_exact": points.exact, "error": points.error}
        columns["energy_change"] = points.energy_change
        names = ("kind", "restitution", "max_error", "rms_error", "mean_error")
        return {
            "passed": self.passed,
            "tolerance": self.tolerance,
            "failures": list(self.failures),
            **{name: getattr(self, name) for name in names},
            "points": {name: values.tolist() for name, values in columns.items()},
            "phases": [group._asdict() for group in self.groups],
            "laws": [
                {"code": origin.code or None, "law": origin.law or None}
                | {name: value for name, value in group._asdict().items() if name != "name"}
                for origin, group in zip(self.origins.distinct, self.by_origin, strict=True)
            ],
            "audit": [finding._asdict() for finding in self.audit],
            "notes": list(self.notes),
        }

    def _repr_html_(self) -> str:
        rows = {group.name: f"{group.max_error:.3g}" for group in (self.overall, *self.groups)}
        findings = "\n".join(f"{MARKS[f.holds]} {f.name} = {f.value:.3g}" for f in self.audit)
        return card(verdict(self), rows, self.plot(), findings)

    def cite(self) -> str:
        """Return what to cite for the exact answer, as BibTeX."""
        return bibtex(*IMPACT)

    def to_dataset(self) -> xr.Dataset:
        """Return the score as one dataset: points along `point`, a history along `time`.

        Along `point`: psi_in, psi_out, psi_out_exact, error, chi, sequence and energy_change (in J,
        a pure number for psi), code and law where they are known; audit_name, audit_value,
        audit_limit, audit_holds and audit_verdict (audit); tolerance, passed and the errors as
        numbers. Exact curves along `curve` where chi are few; forces in N along `time` in s.
        """
        attrs = {
            "title": "results against the exact impact",
            "kind": self.kind,
            "verdict": verdict(self),
            "inputs": dict(self.inputs),
        }
        numbers = {name: ((), getattr(self, name), pure(words)) for name, words in NUMBERS.items()}
        passed = {"passed": ((), np.int8(self.passed), flags(("failed", "passed")))}
        variables = {**_points(self), **_findings(self), **numbers, **passed}
        points, words = self.points, {"long_name": f"{self.points.word} of the results"}
        names = {"long_name": "phases of the exact impact for psi_1 > 0, with losses its regime"}
        coords = {
            "row": ("point", points.rows, words),
            "sequence_name": ("sequence_name", list(points.sequence_names), names),
        }
        if self.forces is None:
            return labelled_dataset(variables | _curves(points), coords, attrs)
        whole = labelled_dataset(variables, coords, attrs)
        return self.forces.to_dataset().merge(whole).assign_attrs(whole.attrs)

    def _draw(self, dataset: xr.Dataset, **look: Any) -> Figure:
        from carom.plots.scores import plot_score

        return plot_score(dataset, **look)


def verdict(score: Score) -> str:
    """Return pass or fail in one line."""
    points = score.points
    worst = f"max |error in psi_2| = {score.max_error:.4g}"
    origins, places = score.origins
    if label := origins[int(places[points.worst])].label:
        worst += f" with {label}"
    if points.rows.size > 1:
        worst += f" in {points.one(points.worst)}, rms {score.rms_error:.4g}"
        worst += f", mean {score.mean_error:+.4g}"
    if score.passed:
        return f"PASS: {worst}; tolerance {score.tolerance:g}"
    return f"FAIL: {worst}; beyond the tolerance {score.tolerance:g}: {', '.join(score.failures)}"


def _listed(score: Score) -> list[str]:
    points = score.points
    shown = np.arange(points.rows.size)
    title = "psi_2 against the exact impact"
    if score.restitution != 1.0:
        title += f" with e = {score.restitution:g}"
    if shown.size > MOST_LISTED:
        shown = np.sort(np.argsort(-np.abs(points.error))[:MOST_LISTED])
        title += f", the worst {MOST_LISTED} of {points.rows.size} points"
    columns = points.rows, points.psi_in, points.chi, points.psi_out, points.exact, points.error
    rows = zip(*(column[shown] for column in columns), strict=True)
    numbers = "psi_1:12.6g chi:10.5g psi_2:14.9f exact:14.9f error:11.3e"
    return [title, *text_table(f"{points.word}:8d {numbers}", rows)]


def _table(title: str, groups: Sequence[Group]) -> list[str]:
    wide = max(44, *(len(group.name) for group in groups))
    numbers = "points:7d max~|error|:12.4e rms:11.4e mean:+11.3e"
    return [title, *text_table(f":<{wide}s {numbers}", groups)]


def _points(score: Score) -> dict[str, Any]:
    points = score.points
    energy = {"units": "1" if score.kind == "psi" else "J"}
    energy["long_name"] = "kinetic energy after less that before"
    if score.kind == "psi":
        energy["long_name"] += ", in m_t (mu V_1/kappa)^2/2"
    order = pure("sequence of phases of the exact impact, its place in sequence_name")
    return {
        "psi_in": ("point", points.psi_in),
        "psi_out": ("point", points.psi_out),
        "psi_out_exact": ("point", points.exact, pure("exact psi_2")),
        "error": ("point", points.error, pure("error in psi_2")),
        "chi": ("point", points.chi),
        "energy_change": ("point", points.energy_change, energy),
        "sequence": ("point", points.sequence.astype(np.int16), order),
        **_origins(score),
    }


def _origins(score: Score) -> dict[str, Any]:
    """Return code and law of each point, where any is known."""
    origins, places = score.origins
    if not any(origin.label for origin in origins):
        return {}
    words = {"code": "program that computed the results", "law": "contact law of the results"}
    return {
        name: ("point", [getattr(origins[place], name) for place in places], {"long_name": meaning})
        for name, meaning in words.items()
    }


def _findings(score: Score) -> dict[str, Any]:
    audit = score.audit
    words: dict[str, dict[str, Any]] = {
        "name": {"long_name": "what is told"},
        "value": pure("what was found"),
        "limit": pure("its limit"),
        "holds": flags(("broken", "holds")),
        "verdict": {"long_name": "in words"},
    }
    columns: dict[str, Any] = {name: [getattr(one, name) for one in audit] for name in words}
    columns["holds"] = np.array(columns["holds"], dtype=np.int8)
    return {f"audit_{name}": ("audit", columns[name], words[name]) for name in words}


def _curves(points: Points) -> dict[str, Any]:
    """Return the exact curves, if they are few, and the borders of the regimes of a single one."""
    chis, e = np.unique(points.chi), points.restitution
    if chis.size > MOST_CURVES:
        return {}
    low, high = min(0.0, float(points.psi_in.min())), max(0.0, float(points.psi_in.max()))
    psi = np.linspace(low, high, CURVE_POINTS)
    exact = curve(chis.tolist(), psi, losses=losses_of(e))["psi_out"].values.ravel()
    lines = {
        "curve_chi": ("curve", np.repeat(chis, CURVE_POINTS), pure(GLOSSARY["chi"].meaning)),
        "curve_psi_in": ("curve", np.tile(psi, chis.size), pure("psi_1")),
        "curve_psi_out": ("curve", exact, pure("exact psi_2")),
    }
    if chis.size == 1:
        words = pure("|psi_1| at which the regime changes")
        lines["border"] = ("regime_border", regime_borders(float(chis[0]), e), words)
    return lines
