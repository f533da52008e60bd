"""Rows that are not independent: repeated trials of one setting, successive bounces of a drop."""

from dataclasses import replace

import numpy as np
from scipy.special import fdtrc

from carom.fitting.estimation import Best, estimate
from carom.fitting.groups import FEWEST
from carom.fitting.model import Model
from carom.fitting.problem import RobustLoss
from carom.quantities.glossary import GLOSSARY

ODD = 1e-3  # chance of a scatter between groups that is called too large
SHARES = (0.0, 0.5, 1.0)  # of readings in the scatter of successive bounces
SLIGHTLY = 2.0  # of -2 log likelihood: by which a smaller share may be less likely


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


def about_repeats(best: Best) -> list[str]:
    """Return how much each response scatters in repeated trials, and if the law leaves more.

    That is the analysis of variance for lack of fit: the squares of what the law leaves of the
    means of the groups, over the variance within these.
    """
    problem, used, lines = best.model.problem, best.information.used, []
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
        lines.append(line)
    return lines
