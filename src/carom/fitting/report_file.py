"""The report of a fit as a file: the answer, its uncertainty, what was read and what neglected."""

from abc import abstractmethod
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from carom.bodies.pairs import Pair
from carom.bodies.shapes import named
from carom.fitting.budget import budget
from carom.fitting.comparison import FitRecord, LossComparison
from carom.fitting.problem import FitProblem
from carom.impacts.solve import impact
from carom.io.files import DOCUMENTS
from carom.io.labels import MARKS, Finding
from carom.io.paths import checked_output
from carom.io.user_table import ERROR
from carom.io.version import __version__
from carom.plots.documents import Section, write_document
from carom.plots.result import Result
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import checked_type

TITLE = "Parameters from measured rebounds"
AIR = "no correction is made for drag; a note tells of it where heights show what it takes"
SHARES = (
    "Which part of the variance of a parameter comes from the error of a quantity, to first order. "
    "Without that error the interval would be half as wide where the part is 75\N{NO-BREAK SPACE}%."
)


class ReportedFit(FitRecord, Result):
    """A fit of which a report can be written."""

    @property
    @abstractmethod
    def pair(self) -> Pair:
        """The bodies with what was fitted."""

    @property
    @abstractmethod
    def losses(self) -> LossComparison | None:
        """Laws of losses, compared, or None."""

    def report(self, path: str | Path, title: str = TITLE, command: str = "") -> Path:
        """Write the result as a report to read and to print: one file that holds everything.

        It has the parameters, the figure with outliers marked, what the uncertainty comes from,
        what was read, what was neglected, the notes, a sentence for a paper, and how it was made.

        Parameters
        ----------
        path : str or Path
            A name that ends in .html or .pdf; a file that is there is replaced whole.
        title : str
            The title of the report.
        command : str
            What made the fit, as a line of a shell or of Python, to be printed at the end.

        Returns
        -------
        pathlib.Path
            The file that was written.

        Raises
        ------
        InputError
            If the name ends otherwise or the file cannot be written.

        Examples
        --------
        >>> from tempfile import TemporaryDirectory
        >>> found = carom.fit(carom.datasets.load("kharaz2001"))
        >>> with TemporaryDirectory() as folder:
        ...     found.report(folder + "/report.html", "Alumina on glass").name
        'report.html'
        """
        for name, words in (("title", title), ("command", command)):
            checked_type(name, words, str, "must be a text")
        return _written(self, checked_output(path, DOCUMENTS), title, command)


def _written(fit: ReportedFit, path: Path, title: str, command: str) -> Path:
    """Write the report of a fit, as `ReportedFit.report`."""
    problem = fit._best.model.problem
    level = f"in brackets {100.0 * fit.confidence:g} % intervals"
    rows = [(name, str(estimate)) for name, estimate in fit.estimates.items()]
    bodies = f"{named(fit.pair.first)} on {named(fit.pair.second)}"
    read = f"{problem.count} values in {problem.trials} rows; {bodies}."
    laws = _laws(fit)
    sections = [
        Section("Result", (), [("parameter", f"value, {level}"), *rows]),
        *_budget(fit),
        Section("What was read", (read,), [*_columns(problem, fit)]),
        Section("What was neglected", (), [("", "assumption", "verdict"), *_neglected(fit)]),
        Section("Notes", fit.notes or ("none",)),
        *([Section("Laws", (), (), laws)] if laws else []),
        Section("To copy into a paper", (_sentence(fit),), (), fit.cite()),
        Section("How it was made", (f"By Carom {__version__}.",), (), command),
    ]
    return write_document(path, title, sections, lambda narrow: _figures(fit, narrow))


def _figures(fit: ReportedFit, narrow: bool) -> dict[str, Any]:
    """Return the figures: narrow ones, of one response each, or one for a whole page."""
    from carom.plots.fits import plot_fit  # which loads matplotlib

    whole = "measured values and the fit"
    if not narrow or (fit.losses and fit._best.model.problem.is_normal):
        return {whole: fit.plot()}
    dataset = fit.to_dataset()
    return {
        f"{whole}, with residuals: {name}": plot_fit(dataset.sel(response=[name]))
        for name in fit._best.model.problem.responses
    }


def _budget(fit: ReportedFit) -> Iterator[Section]:
    costs = budget(fit._best)
    known = [i for i, name in enumerate(costs.parameters) if fit.estimates[name].determined]
    if not known:
        return
    head = ("quantity", *(costs.parameters[i] for i in known))
    rows = [
        (name, *(f"{100.0 * shares[i]:.1f} %" for i in known))
        for name, shares in zip(costs.quantities, costs.shares, strict=True)
    ]
    yield Section("What the uncertainty comes from", (SHARES,), [head, *rows])


def _columns(problem: FitProblem, fit: ReportedFit) -> Iterator[tuple[str, ...]]:
    """Yield a head, then each column: name, how many values, from where to where, errors."""
    best = fit._best
    yield "quantity", "values", "range", "standard deviation"
    for name, values in problem.before.items():
        errors = problem.before_errors.get(name)
        yield _column(problem, name, values, errors, "none: taken as exact")
    for place, name in enumerate(problem.responses):
        there = problem.present[:, place]
        errors = (best.scale * best.sigma)[there, place]
        yield _column(problem, name, problem.measured[there, place], errors, "")


def _column(
    problem: FitProblem, name: str, values: Any, errors: Any, without: str
) -> tuple[str, ...]:
    quantity, cells = GLOSSARY[name], problem.rows.cells
    head = cells[name].head if name in cells else name
    spread = without if errors is None else quantity.span(np.min(errors), np.max(errors), 2)
    span = quantity.span(np.min(values), np.max(values), 4)
    return head if head.startswith(name) else f"{name}: {head}", f"{np.size(values)}", span, spread


def _neglected(fit: ReportedFit) -> Iterator[tuple[str, str, str]]:
    """Yield the assumptions that the fit makes, with a mark, worst of the slowest and fastest."""
    problem = fit._best.model.problem
    moving = [name for name, values in problem.before.items() if np.any(values)]
    exact = [name for name in moving if name not in problem.before_errors]
    if exact:
        missing = ", ".join(f"{name}{ERROR}" for name in exact)
        yield MARKS[None], "errors before the impact", f"{missing}: none, so they are taken as zero"
    air = [note.partition(": ")[2] for note in fit.notes if note.startswith("air: ")]
    yield MARKS[None], "air", "; ".join(air) or AIR
    if not problem.has_speeds:
        yield MARKS[None], "speed", "none was read: yield, waves and weight cannot be judged"
        return
    for finding in _findings(fit):
        yield MARKS[finding.holds], finding.label, finding.verdict


def _findings(fit: ReportedFit) -> list[Finding]:
    """Return what the theory assumes of the impacts, judged for the slowest and the fastest."""
    problem = fit._best.model.problem
    normal, along = problem.motion.normal_speed, problem.contact_velocity
    worst: dict[str, Finding] = {}
    for row in (int(np.argmax(normal)), int(np.argmin(normal))):
        speeds = {"normal_speed": float(normal[row]), "tangential_speed": float(along[row])}
        for finding in impact(fit.pair, **speeds).validity.findings:  # type: ignore[call-overload]
            if worst.setdefault(finding.name, finding).holds:
                worst[finding.name] = finding if not finding.holds else worst[finding.name]
    return [*worst.values()]


def _laws(fit: ReportedFit) -> str:
    parts = [] if fit._best.model.problem.is_normal else [str(fit.comparison)]
    return "\n".join([*parts, *([str(fit.losses)] if fit.losses else [])])


def _sentence(fit: ReportedFit) -> str:
    """Return the result in a sentence for a paper."""
    problem, pair = fit._best.model.problem, fit.pair
    determined = [f"{name} {each}" for name, each in fit.estimates.items() if each.determined]
    others = (each for each in map(fit.estimates.get, fit._best.model.law.names) if each)
    held = [f"{each.name} {each.value:.4g}" for each in others if not each.determined]
    theory = "with the waves in the plate (Zener 1941)" if problem.on_plate else ""
    if not problem.is_normal:
        theory = f"by the theory of Maw, Barber & Fawcett (1976) {theory}"
        theory += f"with {', '.join(held)} held fixed" if held else ""
    found = f"we found {', '.join(determined)}" if determined else "no parameter was found"
    losses = fit.losses if problem.is_normal else None
    verdict = "" if losses is None else f"{losses.verdict[0].upper()}{losses.verdict[1:]}."
    return " ".join(
        f"From {problem.trials} {'drops' if problem.is_normal else 'rebounds'} of a "
        f"{named(pair.first)} on a {named(pair.second)}, {found} {theory} "
        f"({100.0 * fit.confidence:g} % intervals by profile likelihood in brackets; "
        f"Carom {__version__}). {verdict}".split()
    )
