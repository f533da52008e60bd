"""Rows that are not independent: trials of one setting, in groups or not, and bounces of a drop."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import fdtrc

from carom.io.cells import Mask
from carom.io.user_table import ERROR, UserTable
from carom.lab.fitting import problem as errors
from carom.lab.fitting.estimation import Best, estimate
from carom.lab.fitting.model import Model
from carom.lab.fitting.problem import OUTLIER, FitProblem, RobustLoss
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError

ODD = 1e-3  # chance of a scatter between groups that is called too large
SHARES = (0.0, 0.5, 1.0)  # of readings in the scatter of successive bounces
SLIGHTLY = 2.0  # of -2 log likelihood: by which a smaller share may be less likely
GROUP = "group"  # a column of texts or numbers
FEWEST = 4  # degrees of freedom from which a scatter is told
TURNS = 20  # times that means, and the scatter about them, are estimated
ALIKE = 0.05  # rad, or part of what is usual, by which rows of a group may differ without errors


def by_groups(problem: FitProblem, loss: RobustLoss) -> FitProblem:
    """Return the problem with one row for each group, if a column says which rows are repeated.

    Responses are means, with errors from the scatter within all groups. An error of the motion
    before is common to the rows of a group, and stays as it is; if there is none, those of the
    means come from their scatter between the groups, as those of single rows do.
    """
    if GROUP not in problem.rows.cells:
        return problem
    if problem.bounces is not None:
        why = "bounces of a drop are no repeats of one setting, as each is slower than the last"
        raise InputError(f"{GROUP}: {why}; leave it out, or give one bounce a drop")
    labels, own = _labelled(problem.rows)
    _refuse_unlike(problem, labels, own)
    member = np.equal(own, np.arange(len(labels))[:, np.newaxis]).astype(np.float64)
    counts, sizes = member @ problem.present, member.sum(axis=1)
    if not (counts > 1.0).any():
        words = f"{GROUP}: no two rows have the same, so that nothing is repeated"
        return replace(problem, remarks=(*problem.remarks, words))
    repeats = (counts - (counts > 0)).sum(axis=0)
    values, mean_errors, far = _means(problem, own, member, loss)
    scatter = np.nanmedian(mean_errors * np.sqrt(counts), axis=0)
    unknown = np.isnan(problem.errors).any(axis=0, where=problem.present)
    is_open = unknown & ((repeats < FEWEST) | (not problem.before_errors))
    remarks = _assumed(problem)
    for name, freedom, size in zip(problem.responses, repeats, scatter, strict=True):
        words = f"with {freedom:.0f} degrees of freedom; means over {len(labels)} groups are fitted"
        width = f"it scatters by {GLOSSARY[name].text(size, 2)} within groups"
        remarks.append(f"{name}: {width}, {words}")
    if far.any():
        remarks.append(f"outliers within groups: {problem.rows.named(far)}")
    notes = (*problem.rows.notes, *problem.rows.about_missing())
    first = np.unique(own, return_index=True)[1]
    rows: Any = problem.rows.kept(np.isin(np.arange(own.size), first))
    return replace(
        problem,
        before={name: member @ each / sizes for name, each in problem.before.items()},
        before_errors={name: member @ each / sizes for name, each in problem.before_errors.items()},
        measured=values,
        errors=np.where(is_open, np.nan, mean_errors),
        rows=replace(rows, rows=np.array(labels), word=GROUP, missing={}, notes=notes),
        remarks=(*problem.remarks, *remarks),
        freedom=dict(zip(problem.responses, np.where(unknown, repeats, np.inf), strict=True)),
    )


def _labelled(rows: UserTable) -> tuple[list[str], NDArray[np.int64]]:
    """Return the groups, and the number of that of each row; without one it is one of its own."""
    column = rows.column(GROUP)
    texts = [
        rows.one(place) if gone else f"{cell:g}" if isinstance(cell, float) else str(cell).strip()
        for place, (cell, gone) in enumerate(zip(column.cells, column.missing, strict=True))
    ]
    labels = list(dict.fromkeys(texts))
    return labels, np.array([labels.index(text) for text in texts])


def _refuse_unlike(problem: FitProblem, labels: list[str], own: NDArray[np.int64]) -> None:
    """Raise InputError for groups in which the motion before differs by more than its errors."""
    speed = float(np.median(np.hypot(*problem.motion[:2])))
    sizes = {"m/s": speed, "rad/s": speed / problem.pair.first.radius, "rad": 1.0}
    with Faults() as faults:
        for name, values in problem.before.items():
            usual = ALIKE * (sizes.get(GLOSSARY[name].unit) or float(np.median(np.abs(values))))
            allowed = OUTLIER * problem.before_errors.get(name, np.full(own.size, usual / OUTLIER))
            middle = np.array([np.median(values[own == place]) for place in range(len(labels))])
            for place in np.unique(own[np.abs(values - middle[own]) > allowed]):
                inside = values[own == place]
                span = GLOSSARY[name].span(float(inside.min()), float(inside.max()), 3)
                faults.add(
                    f"{GROUP}: in {labels[place]} {name} goes from {span}, more than its errors "
                    "allow; rows of a group repeat one setting, so give others another group"
                )


def _means(
    problem: FitProblem, own: NDArray[np.int64], member: Array, loss: RobustLoss
) -> tuple[Array, Array, Mask]:
    """Return means by the loss, their errors, and which rows are far from them.

    The scatter is that within all groups; errors that were given count if they are larger. `member`
    has ones where a group, of the first axis, has a row.
    """
    present, counts = problem.present, member @ problem.present
    repeated, used = present & (counts > 1.0)[own], np.sum(counts > 0.0, axis=0, dtype=np.float64)
    measured, given = np.where(present, problem.measured, 0.0), np.nan_to_num(problem.errors)
    shown = np.ma.masked_invalid(problem.measured)
    rows = (shown[own == i] for i in range(len(member)))
    middle = np.array([np.ma.median(each, axis=0).filled(0.0) for each in rows])
    for _ in range(TURNS):
        left = np.where(present, measured - middle[own], 0.0)
        sigma = np.fmax(given, errors.scattered(problem, left, middle[own], used, loss))
        if not loss.is_square:
            loss = errors.likeliest((left / sigma)[repeated])
        pull = present * loss.weight(left / sigma) / sigma**2
        middle = member @ (pull * measured) / np.where(counts > 0.0, member @ pull, 1.0)
    residuals, single = (left / sigma)[repeated], float((counts > 1.0).sum())
    slope = errors.mean_over(residuals, loss.slope)
    spread = errors.mean_over(residuals, lambda r: loss.influence(r) ** 2, single)
    there = np.where(counts > 0.0, 1.0, np.nan)
    mean_errors = np.sqrt(spread) / slope / np.sqrt(there * (member @ (present / sigma**2)))
    return there * middle, mean_errors, np.any(np.abs(left) > OUTLIER * sigma, axis=1)


def _assumed(problem: FitProblem) -> list[str]:
    """Return what is assumed of a motion before that has no errors."""
    exact = problem.exact
    missing = f"as there is no {' and '.join(f'{name}{ERROR}' for name in exact)}"
    if not problem.before_errors:
        words = f"errors of the means come from the scatter between the groups, {missing}"
        return [f"{GROUP}: {words}, which a group has in common"]
    return [f"{GROUP}: {' and '.join(exact)} taken as exact, {missing}"] if exact else []


def with_readings(model: Model, loss: RobustLoss) -> Model:
    """Return the model with the share of readings in the scatter of bounces, where it is unknown.

    It is the smallest that is nearly as likely as any, which makes the longest intervals; by
    restricted likelihood (Patterson & Thompson 1971).
    """
    problem = model.problem
    if problem.bounces is None or problem.all_errors_known:
        return model
    tried: dict[float, float] = {}
    start = estimate(model, loss).at[np.newaxis]
    for share in SHARES:
        shared = replace(problem, bounces=problem.bounces._replace(share=share))
        best = estimate(replace(model, problem=shared), loss, start)
        tried[share] = best.deviance + float(np.linalg.slogdet(best.information.matrix)[1])
    share = min(each for each in SHARES if tried[each] <= min(tried.values()) + SLIGHTLY)
    words = (
        f"{problem.responses[0]}: {100.0 * share:.0f} % of the variance of successive bounces "
        "counts as that of readings, which two bounces have in common"
    )
    bounces = problem.bounces._replace(share=share)
    told = replace(problem, bounces=bounces, remarks=(*problem.remarks, words))
    return replace(model, problem=told)


def about_repeats(best: Best) -> Iterator[str]:
    """Yield how much each response scatters in repeated trials, and if the law leaves more.

    That is the analysis of variance for lack of fit: the squares of what the law leaves of the
    means of the groups, over the variance within these.
    """
    problem, used = best.model.problem, best.information.used
    before = np.column_stack([*problem.before.values()])
    groups = np.unique(before, axis=0, return_inverse=True)[1].ravel()
    for place, name in enumerate(problem.responses):
        there = problem.present[:, place]
        values, own = problem.measured[there, place], groups[there]
        left = values - best.expected[there, place]
        counts = np.bincount(own)
        means = np.bincount(own, weights=values) / np.maximum(counts, 1)
        within, repeated = float(np.square(values - means[own]).sum()), int((counts > 1).sum())
        freedom = len(values) - np.count_nonzero(counts)
        if freedom < FEWEST or within == 0.0:
            continue
        size = GLOSSARY[name].text(float(np.sqrt(within / freedom)), 2)
        line = (
            f"{name}: in {repeated} group{'s' * (repeated > 1)} of repeated trials it scatters by "
            f"{size}, with {freedom} degrees of freedom"
        )
        more = float(np.count_nonzero(counts) - used[place])
        ratio = (float(np.square(left).sum()) - within) / within * freedom / max(more, 1.0)
        if more >= 1.0 and ratio > 0.0 and fdtrc(more, freedom, ratio) < ODD:
            line += (
                f"; from group to group the fit is off by {np.sqrt(ratio):.1f} times what that "
                "allows, so that the intervals may be too short"
            )
        yield line
