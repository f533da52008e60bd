"""What the copy of the page holds that runs without this program: the exact rebound, and words."""

import json
from base64 import b64encode
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.lossy.law import scale_free
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.rebound_tables import SMALLEST, SMALLEST_LOSSY, tabulated
from carom.explorer.results import OF_LOSSES, SIGNS
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import READ
from carom.verify.errors import losses_of

RESTITUTIONS = (1.0, 0.9, 0.7)
LEAST_CHI, LARGEST_CHI = 0.5, 3.0
FARTHEST = 10.0  # psi_1 that is promised; the tables reach until everything slides
IMPACTS = 150_000  # that are solved for all tables, about
TOLERANCE, SOLVED = 2e-7, 1e-8  # of series and of impacts with losses, for 1e-6 in psi_2

Advance = Callable[[int], object]


def tables(advance: Advance) -> str:
    """Return the tables as a script; `advance` is told of impacts that are solved."""
    found = {
        "chi": [LEAST_CHI, LARGEST_CHI],
        "psi": FARTHEST,
        "rebounds": {_key(e): _packed(e, advance) for e in RESTITUTIONS},
        "losses": {_key(e): _losses(e) for e in RESTITUTIONS},
        "rows": {name: _row(name, sign) for name, sign in SIGNS.items()},
        "lossy": {name: _row(name, sign) for name, sign in OF_LOSSES.items()},
        "prefixes": {unit: _prefixes(unit) for unit in ("s", "N", "J", "m", "m/s")},
    }
    told = json.dumps(found, ensure_ascii=False, separators=(",", ":"))
    return f"window.Carom = window.Carom || {{}};\nCarom.tables = {told};\n"


def _packed(restitution: float, advance: Advance) -> dict[str, Any]:
    """Return a table of psi_2 as text, its variables chi and the place of psi_1."""
    ranges = (LEAST_CHI, LARGEST_CHI), (restitution, restitution)
    table = tabulated(*ranges, TOLERANCE, advance, impact_tolerance=SOLVED)
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
    found = lossy_rebounds(np.array([1.0]), np.array([1.0]), numbers)
    return {"alpha": float(numbers.parameter), "max_force": float(found.max_force[0])}


def _row(name: str, sign: str) -> dict[str, str]:
    return {"symbol": sign, "meaning": GLOSSARY[name].meaning, "unit": GLOSSARY[name].unit}


def _prefixes(unit: str) -> list[tuple[int, str]]:
    return sorted(READ[unit].items())


def _key(restitution: float) -> str:
    return f"{restitution:g}"
