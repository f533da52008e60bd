"""What the page asks of a view: its pictures, histories, curves, numbers; contact laws that follow.

All is as JSON holds it, null for what is no finite number.
"""

from time import monotonic
from typing import Any

import numpy as np

from carom.bodies.losses import ZenerPlate
from carom.explorer.limits import LAW_SECONDS
from carom.explorer.overlays import LawCurve, exact_curve, followers, law_curves
from carom.explorer.scenes import Scene, scene_of
from carom.explorer.views import View
from carom.quantities.arrays import Array
from carom.quantities.units import or_none

PROMPT_SECONDS = 0.06  # from the question on, until which an answer waits for contact laws
CARRIED_DIGITS = 6
CURVE_DECIMALS = 7  # one may zoom

Answer = dict[str, Any]


def answer(view: View) -> Answer:
    """Return what there is to see of a view, or raise Refused."""
    end = monotonic() + PROMPT_SECONDS
    scene = scene_of(view)
    psi, out = exact_curve(scene)
    shown: Answer = {
        "query": view.query(),
        "carried": _carried(view, scene),
        "scene": scene.moving(),
        "history": {
            "share": _fine(scene.share),
            "force": _fine(scene.force),
            "limit": _fine(scene.limit),
            "unit": scene.force_unit,
            "energies": {name: _fine(part) for name, part in scene.energies.items()},
        },
        "curve": {
            "psi": _fine(psi),
            "out": _fine(out),
            "borders": scene.borders.tolist(),
            "at": [scene.psi_in, scene.psi_out] if scene.rubs else None,
        },
        "undamped": list(view.undamped),
        "results": scene.results,
        "findings": scene.findings,
    }
    laws = law_curves(scene, view.laid_over, max(0.0, end - monotonic()))
    return shown | _laws(view, scene, laws, "late")


def laws(view: View) -> Answer:
    """Return the contact laws of a view once they are solved, "slow" those that are not."""
    scene = scene_of(view)
    curves = law_curves(scene, view.laid_over, LAW_SECONDS, followers.joined())
    return _laws(view, scene, curves, "slow")


def _laws(view: View, scene: Scene, curves: list[LawCurve | None], left: str) -> Answer:
    missing = [label for label, law in zip(view.laid_over, curves, strict=True) if law is None]
    solved = [
        {
            "label": law.label,
            "psi": _fine(law.psi_in),
            "out": _fine(law.psi_out),
            "at": or_none(law.at),
            "off": or_none(law.at - scene.psi_out),
            "share": _fine(law.share),
            "force": _fine(law.force),
        }
        for law in curves
        if law is not None
    ]
    return {"laws": solved, left: missing}


def _carried(view: View, scene: Scene) -> Answer | None:
    """Return the numbers of an impact of bodies, with which it goes on as such."""
    if view.in_numbers or not scene.rubs:
        return None
    give = scene.losses.inelasticity if isinstance(scene.losses, ZenerPlate) else 0.0
    numbers = {"psi": scene.psi_in, "chi": scene.chi, "inelasticity": give}
    return {name: float(f"{number:.{CARRIED_DIGITS}g}") for name, number in numbers.items()}


def _fine(values: Array) -> list[float | None]:
    return [or_none(value) for value in np.round(values, CURVE_DECIMALS).tolist()]
