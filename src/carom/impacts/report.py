"""An impact in words: the text that is printed."""

from __future__ import annotations

from math import degrees, isnan
from typing import Any, Protocol

from carom.bodies.losses import LossLaw
from carom.bodies.pairs import Pair
from carom.dimensionless.states import Phase, SlipAngle
from carom.impacts.history import RESULTS
from carom.io.labels import MARKS, Validity
from carom.quantities.glossary import GLOSSARY

OF_LOSSES = ("normal_restitution", "lost_energy", "shear_lost_energy")  # 1 and 0 without
OF_ELEMENTS = ("normal_spin_out", "contact_velocity_across", "psi_out_error", "energy_error")
NOTES = {
    "exact": "  * angle between slip and x in degrees, which the theory neglects",
    "lossy": "  * angle between slip and x, which is known without losses only",
    "halfspace": "  * angle between slip and x in degrees",
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
    phases = [
        f"  {_slip(p.kind, p.sign):14s}{p.start:12.4e} {p.end:12.4e}"
        f" {_in_degrees(angle.mean)} {_in_degrees(angle.largest)}   {p.cause}"
        for p, angle in zip(hit.phases, hit.slip_angles, strict=True)
    ]
    columns = f"{'from (s)':>12s} {'to (s)':>12s} {'mean*':>9s} {'max*':>9s}"
    head = f"  {'':14s}{columns}   ended by"
    findings = [f"  {MARKS[f.holds]} {f.told:38s} {f.verdict}" for f in hit.validity.findings]
    parts = ("Rebound", *lines, "Phases", head, *phases, note, "Validity", *findings)
    return "\n".join(parts)


def _in_degrees(angle: float) -> str:
    return "-".rjust(9) if isnan(angle) else f"{degrees(angle):9.2f}"


def _slip(kind: str, sign: int) -> str:
    return kind if sign == 0 else f"{kind} {'+' if sign > 0 else '-'}"
