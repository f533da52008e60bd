"""What the page asks of the program besides what it computes by itself: contact laws.

All is as JSON holds it, null for what is no finite number.
"""

from typing import Any

import numpy as np

from carom.explorer.limits import LAW_SECONDS
from carom.explorer.outcomes import outcome_of
from carom.explorer.overlays import followers, law_curves
from carom.explorer.views import View
from carom.quantities.arrays import Array
from carom.quantities.units import or_none

CURVE_DECIMALS = 7  # one may zoom


def laws(view: View) -> dict[str, Any]:
    """Return the contact laws of a view, "slow" those that take too long."""
    outcome, labels = outcome_of(view), view.laid_over
    curves = law_curves(outcome, labels, LAW_SECONDS, followers.joined())
    solved = [
        {
            "label": law.label,
            "psi": _fine(law.psi_in),
            "out": _fine(law.psi_out),
            "at": or_none(law.at),
            "off": or_none(law.at - outcome.psi_out),
            "share": _fine(law.share),
            "force": _fine(law.force),
        }
        for law in curves
        if law is not None
    ]
    slow = [label for label, law in zip(labels, curves, strict=True) if law is None]
    return {"laws": solved, "slow": slow}


def _fine(values: Array) -> list[float | None]:
    return [or_none(value) for value in np.round(values, CURVE_DECIMALS).tolist()]
