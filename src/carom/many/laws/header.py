"""The exact rebound as a C header: tables and their evaluation, for simulations in C or C++."""

from collections.abc import Sequence
from pathlib import Path
from string import Template

import numpy as np
from numpy.typing import NDArray

from carom.io.version import __version__
from carom.many.laws.exact import ReboundLaw
from carom.quantities.refusals import InputError

HERE = Path(__file__).parent
HEADER, FUNCTION = (
    Template(HERE.joinpath(name).read_text("utf-8")) for name in ("rebound.h", "rebound_function.h")
)


def c_header(laws: Sequence[ReboundLaw]) -> str:
    """Return a C99 header that evaluates one law or more, as `ReboundLaw` does.

    One law becomes `double carom_rebound(double psi)`; of several, each has its chi in its name,
    with losses also its e or Zener's parameter: `carom_rebound_1_44`, `carom_rebound_1_44_e_0_9`,
    `carom_rebound_1_44_plate_0_4`.

    Parameters
    ----------
    laws : sequence of ReboundLaw
        They must differ in chi or losses.

    Raises
    ------
    InputError
        If a chi comes twice with the same losses.

    Examples
    --------
    >>> text = c_header([carom.laws.ReboundLaw(0.5), carom.laws.ReboundLaw(1.44)])
    >>> "double carom_rebound_0_5(double psi)" in text
    True
    """
    suffixes = [_suffix(law) for law in laws]
    viscous = any(law.restitution < 1.0 and law.inelasticity == 0.0 for law in laws)
    for index, law in enumerate(laws):
        if suffixes[index] in suffixes[:index]:
            raise InputError(f"chi: {law.chi:g} comes twice; give each chi once")
    names = ["carom_rebound"] if len(laws) == 1 else [f"carom_rebound_{one}" for one in suffixes]
    return HEADER.substitute(
        error="1e-6 max(1, |psi_1|)" if viscous else "1e-9 (chi <= 10)",
        chis=", ".join(repr(law.chi) for law in laws),
        version=__version__,
        guard=f"CAROM_REBOUND_{'_AND_'.join(suffixes)}_H".upper(),
        functions="".join(f"\n{_function(*each)}" for each in zip(names, laws, strict=True)),
    )


def _suffix(law: ReboundLaw) -> str:
    chi, e = _identifier(law._one_chi()), law.restitution
    if law.inelasticity > 0.0:
        return f"{chi}_plate_{_identifier(law.inelasticity)}"
    return chi if e == 1.0 else f"{chi}_e_{_identifier(e)}"


def _identifier(value: float) -> str:
    return f"{value!r}".removesuffix(".0").translate(str.maketrans(".-", "_m", "+"))


def _function(name: str, law: ReboundLaw) -> str:
    table = law._rule
    places = zip(table.slopes[:-1], table.shifts[:-1], strict=True)
    return FUNCTION.substitute(
        name=name,
        chi=repr(law.chi),
        restitution=repr(law.restitution),
        panels=len(law.coefficients),
        terms=table.powers.shape[1],
        edges=_row(table.edges, 8),
        places="\n".join(f"{' ' * 8}{{{float(a)!r}, {float(b)!r}}}," for a, b in places),
        powers="\n".join(
            f"{' ' * 8}{{\n{_row(panel, 12)}\n{' ' * 8}}}," for panel in table.powers[:-1]
        ),
        limit=repr(table.sliding),
    )


def _row(values: NDArray[np.float64], indent: int) -> str:
    """Return numbers that C reads to the last bit, three a line."""
    words = [repr(float(value)) for value in values]
    lines = (words[start : start + 3] for start in range(0, len(words), 3))
    return ",\n".join(" " * indent + ", ".join(line) for line in lines)
