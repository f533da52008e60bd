"""Phases and zones as figures mark them: tints, hatches, signs, the words for an instant."""

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any, NamedTuple, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from numpy.typing import ArrayLike

from carom.plots.style import scaled

T = TypeVar("T")


class Band(NamedTuple):
    """How a kind of phase or zone is marked: a tint, and a hatch that tells the sign of slip."""

    face: str
    edge: str
    hatch: str

    def key(self, label: str) -> Patch:
        return Patch(facecolor=self.face, edgecolor=self.edge, hatch=self.hatch, label=label)


STICK = Band("#DCEBF7", "#DCEBF7", "")
BANDS = {
    ("stick", 0): STICK,
    ("slip", 1): Band("#FDF1DA", "#F0D9A8", "///"),
    ("slip", -1): Band("#FDF1DA", "#F0D9A8", "\\\\\\"),
    ("slip", 0): Band("#FDF1DA", "#F0D9A8", ""),  # of spin about the normal alone
    ("gross slip", 1): Band("#E8E8E8", "#D0D0D0", "////"),
    ("gross slip", -1): Band("#E8E8E8", "#D0D0D0", "\\\\\\\\"),
    ("gross slip", 0): Band("#E8E8E8", "#D0D0D0", ""),
}
MINUS = "\u2212"
SIGNS = {0: "", 1: " +", -1: f" {MINUS}"}
APART = "apart"  # what a picture says where the bodies press on each other nowhere


class PhaseSpan(NamedTuple):
    """A phase as a stored history holds it, times in s."""

    kind: str
    sign: int
    start: float
    end: float


def phases(dataset: Any) -> list[PhaseSpan]:
    """Return the phases of an impact that a dataset tells, once or at each instant; else none."""
    if "phase_kind" not in dataset:
        return []
    columns = (dataset[f"phase_{name}"].values for name in PhaseSpan._fields)
    rows = zip(*columns, strict=True)
    spans = (PhaseSpan(str(k), int(s), float(a), float(b)) for k, s, a, b in rows)
    return list(dict.fromkeys(spans))


def shade(axis: Axes, start: float, end: float, band: Band) -> None:
    """Fill a band of the x axis behind all data."""
    axis.axvspan(
        start, end, facecolor=band.face, edgecolor=band.edge, hatch=band.hatch, lw=0, zorder=0
    )


def mirrored(
    items: Iterable[T], ends: Iterable[float], low: float, high: float
) -> Iterator[tuple[T, float, float]]:
    """Yield where each item lies, between two ends and mirrored at zero, within two limits."""
    for item, span in zip(items, pairwise(ends), strict=True):
        for side in (-1.0, 1.0):
            start, end = np.clip(sorted(side * place for place in span), low, high)
            if end > start:
                yield item, start, end


def slip_band(dataset: Any) -> Band:
    """Return the mark of the zone that slips at the instant of a fields dataset."""
    kind = "gross slip" if dataset.attrs.get("phase_kind") == "gross slip" else "slip"
    return BANDS[kind, int(dataset.attrs.get("phase_sign", 1))]


def is_apart(dataset: Any) -> bool:
    """Tell whether the bodies of a fields dataset do not touch, or in a point alone."""
    return "contact_radius" in dataset and not float(dataset["contact_radius"]) > 0.0


def moment(dataset: Any, like: ArrayLike | None = None) -> str:
    """Return phase and time of a fields dataset, as far as it has them, in a unit as for `like`."""
    parts = []
    if is_apart(dataset):
        parts.append(APART)
    elif "phase_kind" in dataset.attrs:
        sign = SIGNS[int(dataset.attrs.get("phase_sign", 0))]
        parts.append(str(dataset.attrs["phase_kind"]) + sign)
    if "time" in dataset:
        time, unit, _ = scaled(dataset, "time", like)
        parts.append(f"$t$ = {float(time):.3g}\u00a0{unit}")
    return ", ".join(parts)
