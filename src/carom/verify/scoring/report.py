"""The score in words."""

from collections.abc import Sequence

import numpy as np

from carom.io.labels import MARKS
from carom.verify.scoring.points import Group
from carom.verify.scoring.record import ScoreRecord

LISTED = 40  # points; of more, as many of the worst are listed


def as_text(score: ScoreRecord) -> str:
    """Return the score as text to read, the verdict last."""
    parts = [*_points(score), *_groups(score), *_origins(score), *_audit(score)]
    parts += [f"note: {note}" for note in score.notes]
    return "\n".join([*parts, verdict(score)])


def verdict(score: ScoreRecord) -> str:
    """Return pass or fail in one line."""
    points = score.points
    worst = f"max |error in psi_2| = {score.max_error:.4g}"
    if label := score.origins.of(points.worst).label:
        worst += f" with {label}"
    if points.rows.size > 1:
        worst += f" in {points.one(points.worst)}, rms {score.rms_error:.4g}"
        worst += f", mean {score.mean_error:+.4g}"
    if score.passed:
        return f"PASS: {worst}; tolerance {score.tolerance:g}"
    return f"FAIL: {worst}; beyond the tolerance {score.tolerance:g}: {', '.join(score.failures)}"


def _points(score: ScoreRecord) -> list[str]:
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


def _groups(score: ScoreRecord) -> list[str]:
    groups = (*score.groups, score.overall)
    return _table("By sequence of phases, for psi_1 > 0", groups)


def _origins(score: ScoreRecord) -> list[str]:
    several = len(score.origins.known) > 1
    return _table("By law", score.by_origin) if several else []


def _table(title: str, groups: Sequence[Group]) -> list[str]:
    head = f"{'points':>7s} {'max |error|':>12s} {'rms':>11s} {'mean':>11s}"
    wide = max(44, *(len(group.name) for group in groups))
    rows = [
        f"  {group.name:{wide}s} {group.points:7d} {group.max_error:12.4e}"
        f" {group.rms_error:11.4e} {group.mean_error:+11.3e}"
        for group in groups
    ]
    return [title, f"  {'':{wide}s} {head}", *rows]


def _audit(score: ScoreRecord) -> list[str]:
    return ["Audit"] + [
        f"  {MARKS[finding.holds]} {finding.name + f' = {finding.value:.3g}':32s} {finding.verdict}"
        for finding in score.audit
    ]
