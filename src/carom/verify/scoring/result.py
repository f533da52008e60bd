"""The score of results: errors in psi_2, findings, pass or fail; in words and as a dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from carom import plots
from carom.dimensionless.rebounds import regime_borders
from carom.impacts.curves import curve
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import MARKS, Finding, flags, labelled, labelled_dataset
from carom.plots.result import Result, card
from carom.quantities.glossary import GLOSSARY
from carom.verify.errors import losses_of, pure
from carom.verify.scoring.histories import Forces
from carom.verify.scoring.origins import Origins, of_all
from carom.verify.scoring.points import Group, Points

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

LISTED = 40  # points; of more, as many of the worst are listed
CURVES = 5  # chi of which the exact curve is part of the dataset
SMOOTH = 401  # psi_1 of such a curve
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
    forces, mu P_max and P_max.

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
        return self.told_origins or of_all(self.points.rows.size)

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

    def __str__(self) -> str:
        groups = (*self.groups, self.overall)
        parts = [*_listed(self), *_table("By sequence of phases, for psi_1 > 0", groups)]
        parts += _table("By law", self.by_origin) if len(self.origins.known) > 1 else []
        parts += _audited(self)
        parts += [f"note: {note}" for note in self.notes]
        return "\n".join([*parts, verdict(self)])

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
                {"code": origin.code or None, "law": origin.law or None}
                | {name: value for name, value in group._asdict().items() if name != "name"}
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

    def to_dataset(self) -> xr.Dataset:
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

    def _draw(self, dataset: xr.Dataset, **look: Any) -> Figure:
        return plots.plot_score(dataset, **look)


def verdict(score: Score) -> str:
    """Return pass or fail in one line."""
    points = score.points
    worst = f"max |error in psi_2| = {score.max_error:.4g}"
    known, places = score.origins
    if label := known[int(places[points.worst])].label:
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
    if shown.size > LISTED:
        shown = np.sort(np.argsort(-np.abs(points.error))[:LISTED])
        title += f", the worst {LISTED} of {points.rows.size} points"
    columns = f"{'psi_1':>12s} {'chi':>10s} {'psi_2':>14s} {'exact':>14s} {'error':>11s}"
    rows = [
        f"  {points.rows[i]:8d} {points.psi_in[i]:12.6g} {points.chi[i]:10.5g}"
        f" {points.psi_out[i]:14.9f} {points.exact[i]:14.9f} {points.error[i]:11.3e}"
        for i in shown
    ]
    return [title, f"  {points.word:>8s} {columns}", *rows]


def _table(title: str, groups: Sequence[Group]) -> list[str]:
    head = f"{'points':>7s} {'max |error|':>12s} {'rms':>11s} {'mean':>11s}"
    wide = max(44, *(len(group.name) for group in groups))
    rows = [
        f"  {group.name:{wide}s} {group.points:7d} {group.max_error:12.4e}"
        f" {group.rms_error:11.4e} {group.mean_error:+11.3e}"
        for group in groups
    ]
    return [title, f"  {'':{wide}s} {head}", *rows]


def _audited(score: Score) -> list[str]:
    return ["Audit"] + [
        f"  {MARKS[finding.holds]} {finding.name + f' = {finding.value:.3g}':32s} {finding.verdict}"
        for finding in score.audit
    ]


def score_dataset(score: Score) -> xr.Dataset:
    """Return the score as a dataset: errors along `point`, findings along `audit`.

    Exact curves of few chi lie along `curve`, one after the other; a history along `time`.
    """
    attrs = {
        "title": "results against the exact impact",
        "kind": score.kind,
        "verdict": verdict(score),
        "inputs": dict(score.inputs),
    }
    numbers = {name: ((), getattr(score, name), pure(words)) for name, words in NUMBERS.items()}
    passed = {"passed": ((), np.int8(score.passed), flags(("failed", "passed")))}
    variables = {**_points(score), **_findings(score), **numbers, **passed}
    points, words = score.points, {"long_name": f"{score.points.word} of the results"}
    names = {"long_name": "phases of the exact impact for psi_1 > 0, with losses its regime"}
    coords = {
        "row": ("point", points.rows, words),
        "sequence_name": ("sequence_name", list(points.sequence_names), names),
    }
    if score.forces is None:
        return labelled_dataset(variables | _curves(score), coords, attrs)
    whole = labelled_dataset(variables, coords, attrs)
    return _history(score.forces).merge(whole).assign_attrs(whole.attrs)


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
    known, places = score.origins
    if not any(origin.label for origin in known):
        return {}
    words = {"code": "program that computed the results", "law": "contact law of the results"}
    return {
        name: ("point", [getattr(known[place], name) for place in places], {"long_name": meaning})
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


def _curves(score: Score) -> dict[str, Any]:
    """Return the exact curves, if they are few, and the borders of the regimes of a single one."""
    points = score.points
    chis = np.unique(points.chi)
    if chis.size > CURVES:
        return {}
    low, high = min(0.0, float(points.psi_in.min())), max(0.0, float(points.psi_in.max()))
    psi = np.linspace(low, high, SMOOTH)
    e = points.restitution
    exact = curve(chis.tolist(), psi, losses=losses_of(e))["psi_out"].values.ravel()
    lines = {
        "curve_chi": ("curve", np.repeat(chis, SMOOTH), pure(GLOSSARY["chi"].meaning)),
        "curve_psi_in": ("curve", np.tile(psi, chis.size), pure("psi_1")),
        "curve_psi_out": ("curve", exact, pure("exact psi_2")),
    }
    if chis.size > 1:
        return lines
    words = pure("|psi_1| at which the regime changes")
    return lines | {"border": ("regime_border", regime_borders(float(chis[0]), e), words)}


def _history(forces: Forces) -> xr.Dataset:
    hit = forces.hit
    dataset = labelled(
        {
            "time": forces.time,
            "normal_force": forces.normal_force,
            "tangential_force": forces.tangential_force,
        },
        {"friction": hit.pair.friction, "max_force": hit.max_force, "duration": hit.duration},
        hit.phases,
        hit.inputs(),
    )
    exact = {
        "normal force": forces.exact_normal_force,
        "tangential force": forces.exact_tangential_force,
    }
    newton = {
        f"{name.replace(' ', '_')}_exact": (
            "time",
            values,
            {"units": "N", "long_name": f"exact {name}"},
        )
        for name, values in exact.items()
    }
    return dataset.assign(labelled_dataset(newton, {}, {}).data_vars)
