"""What the functions in C must know of the kernels: shapes of scratch arrays, codes."""

from collections.abc import Iterable
from typing import Any

from carom.dimensionless.elastic import phases, record as elastic
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.panels import work
from carom.dimensionless.lossy.rebounds import NEARLY_ELASTIC
from carom.dimensionless.lossy.viscoelastic.impacts import TOLERANCE
from carom.dimensionless.lossy.viscoelastic.record import new_record

ELASTIC = "carom_dimensionless_elastic_batch_fill"
LOSSY = "carom_dimensionless_lossy_rebounds_fill"


def kernels_h() -> str:
    """Return the header."""
    defined = {
        "CAROM_ELASTIC": ELASTIC,
        "CAROM_LOSSY": LOSSY,
        "CAROM_ELASTIC_SCRATCH": _shapes((*phases.new_work(), *elastic.new_record(False))),
        "CAROM_LOSSY_SCRATCH": _shapes((*work.new_work(), *new_record(False))),
        "CAROM_NUMBERS": layout.NUMBERS,
        "CAROM_PSI_OUT": layout.PSI_OUT,
        "CAROM_RESTITUTION": layout.RESTITUTION,
        "CAROM_NEARLY_ELASTIC": NEARLY_ELASTIC,
        "CAROM_TOLERANCE": TOLERANCE,
        "CAROM_MESSAGES": _braces(f'"{status.message}"' for status in phases.Status),
    }
    lines = (f"#define {name} {value}" for name, value in defined.items())
    declared = (f"int {name}(const int64_t *words);" for name in (ELASTIC, LOSSY))
    return "\n".join(("#include <stdint.h>", "", *lines, "", *declared, ""))


def _shapes(arrays: Iterable[Any]) -> str:
    return _braces(f"{{{each.ndim}, {_braces(map(str, each.shape))}}}" for each in arrays)


def _braces(texts: Iterable[str]) -> str:
    return f"{{{', '.join(texts)}}}"
