"""The report of a fit as a file: the answer, its uncertainty, what was read and what neglected."""

import re
from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from carom.impacts.solve import impact
from carom.io.files import DOCUMENTS
from carom.io.paths import checked_output
from carom.io.user_table import ERROR
from carom.io.version import __version__
from carom.lab.fitting.bounces import BOUNCES
from carom.lab.fitting.comparison import FitRecord
from carom.lab.fitting.estimation import Best
from carom.lab.fitting.problem import FitProblem
from carom.lab.fitting.report import summary
from carom.plots.result import Result, Section
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import checked_type
from carom.quantities.verdicts import VERDICTS, Finding

ELSEWHERE = "the other data"
NEAR_ZERO = 1e-6  # of a residual, below which its root loss is taken to be linear
TITLE = "Parameters from measured rebounds"
AIR = "no correction is made for drag; a note tells of it where heights show what it takes"
ROWS = "Measured values with their standard deviations, and what the fit gives; below, the rest."
CURVES = "The dark band is the {} of the curve of the exact law; shades are its regimes of slip."
DROPS = "Measured restitutions with their standard deviations, and each law of losses as it fits."
SHARES = (
    "Which part of the variance of a parameter comes from the error of a quantity, to first order. "
    "Without that error the interval would be half as wide where the part is 75\N{NO-BREAK SPACE}%."
)


class Reported(Result):
    """A result of which a report can be written."""

    @abstractmethod
    def _sections(self) -> Iterable[Section]:
        """Return what its report says."""

    def report(self, path: str | Path, title: str = TITLE, command: str = "") -> Path:
        """Write the result as a report to read and to print: one file that holds everything.

        It tells what was read, shows the figure with outliers marked and the parameters, and says
        what the uncertainty comes from and what was neglected; with the notes, a sentence for a
        paper, how it was made, and what to cite.

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
        from carom.plots.documents import write_document  # which loads matplotlib

        for name, words in (("title", title), ("command", command)):
            checked_type(name, words, str, "must be a text")
        made = Section("How it was made", (f"By Carom {__version__}.",), (), command)
        cited = Section("References", (), (), self.cite())
        target = checked_output(path, DOCUMENTS)
        return write_document(target, title, [*self._sections(), made, cited])


def sections_of(fit: FitRecord, draw: Callable[..., Any]) -> Iterator[Section]:
    """Yield what the report of a fit says."""
    problem, losses = fit._best.model.problem, fit.losses
    bodies = f"{fit.pair.first} on {fit.pair.second}"
    read = f"{problem.count} values in {problem.trials} rows; {bodies}."
    yield Section("What was read", (read,), [*_columns(problem, fit)])
    level = f"{100.0 * fit.confidence:g}\N{NO-BREAK SPACE}% interval"
    curves = ROWS if problem.is_one else f"{ROWS} {CURVES.format(level)}"
    yield Section("Data and fit", (DROPS if problem.is_normal and losses else curves,), draw=draw)
    head = "parameter", "", "value", level
    words = {name: re.split(",| that ", GLOSSARY[name].meaning)[0] for name in fit.estimates}
    rows = ((name, words[name], *each.cells) for name, each in fit.estimates.items())
    yield Section("Parameters", (), [head, *rows])
    yield from _budget(fit)
    yield Section("What was neglected", (), [("assumption", "finding", ""), *_neglected(fit)])
    yield Section("Notes", (*summary(fit), *fit.notes) or ("none",))
    if not problem.is_normal:
        yield Section("Laws of rebound", (fit.comparison.verdict,), fit.comparison.rows)
    if losses:
        yield Section(f"Losses at normal speeds of {losses.range}", (losses.verdict,), losses.rows)
    yield Section("To copy into a paper", (_sentence(fit),))


def _budget(fit: FitRecord) -> Iterator[Section]:
    free = enumerate(fit._best.model.free)
    known = {name: i for i, name in free if fit.estimates[name].determined}
    if known:
        shares = budget(fit._best).items()
        rows = ((n, *(f"{100.0 * each[i]:.1f} %" for i in known.values())) for n, each in shares)
        yield Section("What the uncertainty comes from", (SHARES,), [("quantity", *known), *rows])


def _columns(problem: FitProblem, fit: FitRecord) -> Iterator[tuple[str, ...]]:
    """Yield a head, then each column: name, how many values, from where to where, errors."""
    best = fit._best
    rows = problem.rows.columns
    yield "quantity", "values", "range", "standard deviation"
    for name in filter(rows.__contains__, BOUNCES):  # from which the speeds were taken
        yield _column(problem, name, rows[name], rows.get(name + ERROR), "")
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


def _neglected(fit: FitRecord) -> Iterator[tuple[str, str, str]]:
    """Yield the assumptions that the fit makes, judged for the slowest and the fastest."""
    problem = fit._best.model.problem
    if problem.exact:
        missing = ", ".join(f"{name}{ERROR}" for name in problem.exact)
        yield "errors before the impact", f"{missing}: none, taken as zero", VERDICTS[None]
    air = [note.partition(": ")[2] for note in fit.notes if note.startswith("air: ")]
    yield "air", "; ".join(air) or AIR, VERDICTS[None]
    if not problem.has_speeds:
        yield "speed", "none was read: yield, waves and weight", VERDICTS[None]
        return
    for finding in _findings(fit):
        yield finding.label, finding.verdict, VERDICTS[finding.holds]


def _findings(fit: FitRecord) -> list[Finding]:
    """Return what the theory assumes of the impacts, judged for the slowest and the fastest."""
    problem = fit._best.model.problem
    normal, along = problem.motion.normal_speed, problem.contact_velocity
    worst: dict[str, Finding] = {}
    for row in (int(np.argmax(normal)), int(np.argmin(normal))):
        speeds = {"normal_speed": float(normal[row]), "tangential_speed": float(along[row])}
        for finding in impact(fit.pair, **speeds).validity.findings:  # type: ignore[call-overload]
            if worst.setdefault(finding.name, finding).holds and not finding.holds:
                worst[finding.name] = finding
    return [*worst.values()]


def _sentence(fit: FitRecord) -> str:
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
        f"{pair.first} on a {pair.second}, {found} {theory} "
        f"({100.0 * fit.confidence:g} % intervals by profile likelihood in brackets; "
        f"Carom {__version__}). {verdict}".split()
    )


def budget(best: Best) -> dict[str, Array]:
    """Return the parts that the errors of each column have in the variances of the parameters.

    To first order an error v of a row, in the unit of the responses, moves the coordinates by
    C S^T D W v: W makes residuals independent, D is the slope of the root of the loss, S that of
    the roots over the coordinates, and C = (S^T S)^-1. The covariance of a row is the sum of v v^T
    over the columns (`Model.weights`), so that the parts are those of a sum of squares. Readings
    that are after one bounce and before the next are one quantity.
    """
    if best.weights.across is not None:
        return {best.model.problem.responses[0]: np.ones(len(best.model.free))}
    r = np.where(np.abs(best.residuals) > NEAR_ZERO, best.residuals, NEAR_ZERO)
    slope = best.loss.influence(r) / best.loss.root(r)  # of the root, least for outliers
    gain = best.information.slopes @ best.information.covariance
    squares = {}
    for name, errors in _errors_by_column(best):
        whitened = slope * np.einsum("rij,rj->ri", best.weights.factors, errors)
        squares[name] = np.square(np.einsum("rj,rjp->rp", whitened, gain)).sum(axis=0)
    if best.elsewhere is not None:
        squares[ELSEWHERE] = np.square(best.elsewhere @ best.information.covariance).sum(axis=0)
    return {name: each / sum(squares.values()) for name, each in squares.items()}


def _errors_by_column(best: Best) -> Iterator[tuple[str, Array]]:
    """Yield each uncertain column, and what one standard deviation of it does to the responses."""
    problem, at = best.model.problem, best.at[np.newaxis]
    for name, (up, down) in zip(problem.before_errors, problem.shaken, strict=True):
        change = 0.5 * (best.model.expected(at, up)[0] - best.model.expected(at, down)[0])
        yield name, np.where(problem.present, best.scale * change, 0.0)
    for place, name in enumerate(problem.responses):
        own = np.zeros(problem.measured.shape)
        own[:, place] = np.where(problem.present, best.scale * best.sigma, 0.0)[:, place]
        yield name, own
