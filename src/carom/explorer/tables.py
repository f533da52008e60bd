"""What the copy of the page holds that runs without this program: the exact rebound, and words."""

import json
from base64 import b64encode
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.lossy.law import scale_free
from carom.dimensionless.rebound_tables import SMALLEST, SMALLEST_LOSSY, tabulated
from carom.dimensionless.rebounds import lossy_rebounds
from carom.explorer.results import SIGNS, SIGNS_OF_LOSSES
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import READ
from carom.verify.errors import losses_of

RESTITUTIONS = (1.0, 0.9, 0.7)
LEAST_CHI, LARGEST_CHI = 0.5, 3.0
LARGEST_PSI = 10.0  # that is promised; the tables reach until everything slides
SOLVED_IMPACTS = 150_000  # for all tables, about
TOLERANCE, PANEL_TOLERANCE = 2e-7, 1e-8  # of series and of viscous impacts, for 1e-6 in psi_2

Advance = Callable[[int], object]


def tables(advance: Advance) -> str:
    """Return the tables as a script; `advance` is called with how many more impacts are solved."""
    content = {
        "chi": [LEAST_CHI, LARGEST_CHI],
        "psi": LARGEST_PSI,
        "rebounds": {f"{e:g}": _packed(e, advance) for e in RESTITUTIONS},
        "losses": {f"{e:g}": _losses(e) for e in RESTITUTIONS},
        "rows": {name: _row(name, sign) for name, sign in SIGNS.items()},
        "lossy": {name: _row(name, sign) for name, sign in SIGNS_OF_LOSSES.items()},
        "prefixes": {unit: sorted(READ[unit].items()) for unit in ("s", "N", "J", "m", "m/s")},
    }
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    return f"Carom.tables = {text};\n"


def _packed(restitution: float, advance: Advance) -> dict[str, Any]:
    """Return a table of psi_2 as text, its variables chi and the place of psi_1."""
    ranges = (LEAST_CHI, LARGEST_CHI), (restitution, restitution)
    table = tabulated(*ranges, TOLERANCE, advance, impact_tolerance=PANEL_TOLERANCE)
    return {
        "smallest": SMALLEST if restitution == 1.0 else SMALLEST_LOSSY,
        **{name: _text(values) for name, values in table._asdict().items()},
        "terms": table.terms.tolist(),
    }


def _text(values: NDArray[Any]) -> str:
    kind = "<f8" if values.dtype.kind == "f" else "<i2"
    return b64encode(values.astype(kind).tobytes()).decode()


def _losses(restitution: float) -> dict[str, float]:
    """Return what the normal motion comes to, in units of the elastic one."""
    law = losses_of(restitution)
    if law is None:
        return {"alpha": 0.0, "max_force": 1.0}
    numbers = scale_free(law)
    rebounds = lossy_rebounds(np.array([1.0]), np.array([1.0]), numbers)
    return {"alpha": float(numbers.parameter), "max_force": float(rebounds.max_force[0])}


def _row(name: str, sign: str) -> dict[str, str]:
    return {"symbol": sign, "meaning": GLOSSARY[name].meaning, "unit": GLOSSARY[name].unit}
