"""An impact in words: the text that is printed."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, isnan
from typing import Any, Protocol

from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.dimensionless.states import Phase, SlipAngle
from carom.impacts.outcome import RESULTS
from carom.io.labels import MARKS, Validity
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import column

OF_LOSSES = ("normal_restitution", "lost_energy", "shear_lost_energy")  # 1 and 0 without
OF_ELEMENTS = ("normal_spin_out", "contact_velocity_across", "psi_out_error", "energy_error")
NOTES = {
    "exact": "  * angle between the slip and x in degrees, which the theory neglects",
    "lossy": "  * angle between the slip and x, which is known only without losses",
    "halfspace": "  * angle between the slip and x in degrees",
}


class Reported(Protocol):
    """What a report needs of an impact."""

    @property
    def pair(self) -> Pair: ...
    @property
    def losses(self) -> LossLaw | None: ...
    @property
    def phases(self) -> tuple[Phase, ...]: ...
    @property
    def slip_angles(self) -> tuple[SlipAngle, ...]: ...
    @property
    def validity(self) -> Validity: ...
    def scalars(self) -> dict[str, float]: ...
    def inputs(self) -> dict[str, Any]: ...


def impact_text(hit: Reported) -> str:
    """Return the result as text to read."""
    scalars, method = hit.scalars(), hit.inputs().get("method", "exact")
    note = NOTES["lossy" if hit.losses is not None else method]
    loses = hit.losses is not None or (method != "exact" and hit.pair.dundurs_beta != 0.0)
    shown = ["chi", *(name for name in RESULTS if loses or name not in OF_LOSSES)]
    shown += [name for name in OF_ELEMENTS if name in scalars]
    if len(hit.pair.moving) == 1:
        shown.remove("spin2_out")
    lines = [
        f"  {GLOSSARY[name].meaning:58s} {GLOSSARY[name].text(scalars[name])}" for name in shown
    ]
    times, unit = phase_times(hit.phases)
    phases = [
        f"  {_slip(p.kind, p.sign):14s}{start:>12s} {end:>12s}"
        f" {_in_degrees(angle.mean)} {_in_degrees(angle.largest)}   {p.cause}"
        for p, (start, end), angle in zip(hit.phases, times, hit.slip_angles, strict=True)
    ]
    columns = f"{f'from ({unit})':>12s} {f'to ({unit})':>12s} {'mean*':>9s} {'max*':>9s}"
    head = f"  {'':14s}{columns}   ended by"
    findings = [f"  {MARKS[f.holds]} {f.told:38s} {f.verdict}" for f in hit.validity.findings]
    parts = ("Rebound", *lines, "Phases", head, *phases, note, "Validity", *findings)
    return "\n".join(parts)


def phase_times(phases: Sequence[Phase]) -> tuple[list[tuple[str, str]], str]:
    """Return start and end of each phase, as cells of two columns, and their unit."""
    cells, unit = column([time for p in phases for time in (p.start, p.end)], "s")
    return list(zip(cells[::2], cells[1::2], strict=True)), unit


def _in_degrees(angle: float) -> str:
    return "-".rjust(9) if isnan(angle) else f"{degrees(angle):9.2f}"


def _slip(kind: str, sign: int) -> str:
    return kind if sign == 0 else f"{kind} {'+' if sign > 0 else '-'}"
