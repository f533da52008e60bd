"""The exact rebound as tables for the copy of the page that runs without this program.

psi_2 is stored as Chebyshev series on patches of chi and a scaled psi_1, in which the borders of
the regimes are straight: on them psi_2 is not smooth.
"""

import json
from base64 import b64encode
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.dimensionless.lossy.law import LossNumbers, scale_free
from carom.dimensionless.numerics.chebyshev_2d import TERMS, Patches, fitted_patches
from carom.dimensionless.rebounds import lossy_rebounds, solved
from carom.explorer.results import SIGNS, SIGNS_OF_LOSSES
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import READ
from carom.verify.errors import losses_of

RESTITUTIONS = (1.0, 0.9, 0.7)
LEAST_CHI, LARGEST_CHI = 0.5, 3.0
LARGEST_PSI = 10.0  # that is promised; the tables reach until everything slides
SMALLEST_PSI = {True: 1e-6, False: 1e-3}  # elastic or not: below, psi_2/psi_1 hardly changes
TOLERANCE = 5e-7  # of the last terms of a series, for 1e-6 in psi_2
SOLVED_IMPACTS = 122_000  # for all tables, about
PANEL_TOLERANCE = 1e-8  # of a panel of a viscous impact, for 5e-9 in psi_2

Advance = Callable[[int], object]


def tables(advance: Advance) -> str:
    """Return the tables as a script; `advance` is called with how many more impacts are solved."""
    content = {
        "chi": [LEAST_CHI, LARGEST_CHI],
        "psi": LARGEST_PSI,
        "rebounds": {_key(e): _packed(_patches(e, advance), e) for e in RESTITUTIONS},
        "losses": {_key(e): _losses(e) for e in RESTITUTIONS},
        "rows": {name: _row(name, sign) for name, sign in SIGNS.items()},
        "lossy": {name: _row(name, sign) for name, sign in SIGNS_OF_LOSSES.items()},
        "prefixes": {unit: _prefixes(unit) for unit in ("s", "N", "J", "m", "m/s")},
    }
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    return f"window.Carom = window.Carom || {{}};\nCarom.tables = {text};\n"


def psi_at(place: Array, chi: Array, restitution: float) -> Array:
    """Return psi_1 where 1, 2 chi and 2 chi (1 + e) - e lie at 1, 2 and 3."""
    width = 2.0 * chi - 1.0
    loading = np.where(place <= 1.0, place, 1.0 + width * (place - 1.0))
    return np.where(place <= 2.0, loading, 2.0 * chi + restitution * width * (place - 2.0))


def _patches(restitution: float, advance: Advance) -> Patches:
    law = losses_of(restitution)

    def lost(place: Array, chi: Array) -> Array:
        psi = psi_at(place, chi, restitution)
        out = solved(psi, chi)[0] if law is None else _viscous(psi, chi, scale_free(law))
        advance(place.size)
        return (1.0 + psi) * (1.0 - out / psi)  # an error in it is about that in psi_2

    whole = SMALLEST_PSI[law is None], 3.0, LEAST_CHI, LARGEST_CHI
    return fitted_patches(lost, whole, (1.0, 2.0), TOLERANCE, singular=1.0)


def _viscous(psi: Array, chi: Array, losses: LossNumbers) -> Array:
    return lossy_rebounds(psi, chi, losses, tolerance=PANEL_TOLERANCE).psi_out


def _packed(patches: Patches, restitution: float) -> dict[str, Any]:
    """Return a tree of patches as text, of the series those that are read."""
    leaves = patches.cuts[:, 0] < 0.0
    number = np.where(leaves, np.cumsum(leaves) - 1, 0)
    children = np.where(leaves[:, np.newaxis], -1, patches.children)
    return {
        "smallest": SMALLEST_PSI[restitution == 1.0],
        "terms": TERMS,
        "cuts": _text(patches.cuts, np.float64),
        "children": _text(children, np.int16),
        "corners": _text(patches.corners, np.float64),
        "leaf": _text(number, np.int16),
        "series": _text(patches.series[leaves], np.float64),
    }


def _text(values: Array, kind: type) -> str:
    return b64encode(values.astype(np.dtype(kind).newbyteorder("<")).tobytes()).decode()


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


def _prefixes(unit: str) -> list[tuple[int, str]]:
    return sorted(READ[unit].items())


def _key(restitution: float) -> str:
    return f"{restitution:g}"
