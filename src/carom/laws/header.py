"""The exact rebound as a C header: tables and their evaluation, for simulations in C or C++."""

from collections.abc import Sequence
from string import Template

import numpy as np
from numpy.typing import NDArray

from carom.io.version import __version__
from carom.laws.exact import ReboundLaw
from carom.quantities.refusals import InputError

HEADER = Template("""\
/* The exact oblique impact of spheres: psi_2(psi_1), to $error,
 * at chi = $chis.
 *
 * Written by Carom $version; its licence, BSD 3-Clause, is that of this file.
 *
 * psi = kappa V_x / (mu V_1) is the tangential velocity of the contact point over that of approach,
 * with kappa = G* / E*, chi = (kappa / 2)(m_n / m_t). After the impact
 *
 *     V_x' = (mu V_1 / kappa) psi_2,    J_x = m_t (V_x' - V_x),    V_n' = -e V_n.
 *
 * psi_2 = r(|psi_1|) psi_1, r a polynomial on each panel; psi_2 = psi_1 -+ 2 chi (1 + e) in gross
 * slip throughout (Maw, Barber & Fawcett 1976; Barber 1979); e < 1 of a Kelvin-Voigt solid, viscous
 * in shear as in compression. C99 or C++, nothing to link.
 */
#ifndef $guard
#define $guard
$functions
#endif
""")

FUNCTION = Template("""
/* Return psi_2 at chi = $chi, e = $restitution; NaN of NaN. */
static inline double $name(double psi)
{
    enum { panels = $panels, terms = $terms };
    /* where panels begin, the first also taking what lies below, and where the last one ends */
    static const double edges[panels + 1] = {
$edges
    };
    /* place = slope x + shift goes from -1 to 1 over a panel */
    static const double places[panels][2] = {
$places
    };
    /* 1 - r in rising powers of the place */
    static const double powers[panels][terms] = {
$powers
    };
    const double limit = $limit; /* 2 chi (1 + e): psi_1 - psi_2 in gross slip */
    const double size = psi < 0.0 ? -psi : psi;
    double place, part, lost;
    int low = 0, high = panels, middle, k;

    if (size >= edges[panels])
        return psi < 0.0 ? psi + limit : psi - limit;
    while (high - low > 1) {
        middle = (low + high) / 2;
        if (size < edges[middle])
            high = middle;
        else
            low = middle;
    }
    place = places[low][0] * size + places[low][1];
    part = powers[low][terms - 1];
    for (k = terms - 2; k >= 0; --k)
        part = part * place + powers[low][k];
    part = part < 0.0 ? 0.0 : part > 2.0 ? 2.0 : part; /* beyond, energy would grow */
    lost = part * size > limit ? limit : part * size;
    return psi < 0.0 ? psi + lost : psi - lost;
}
""")


def c_header(laws: Sequence[ReboundLaw]) -> str:
    """Return a C99 header that evaluates one law or more, as `ReboundLaw` does.

    One law becomes `double carom_rebound(double psi)`; of several, each has its chi in its name,
    and its e if that is below 1: `carom_rebound_1_44`, `carom_rebound_1_44_e_0_9`.

    Parameters
    ----------
    laws : sequence of ReboundLaw
        They must differ in chi or e.

    Raises
    ------
    InputError
        If a chi comes twice with the same e.

    Examples
    --------
    >>> import carom
    >>> from carom.laws.header import c_header
    >>> text = c_header([carom.laws.ReboundLaw(0.5), carom.laws.ReboundLaw(1.44)])
    >>> "double carom_rebound_0_5(double psi)" in text
    True
    """
    suffixes = [_suffix(law) for law in laws]
    losses = any(law.restitution < 1.0 for law in laws)
    for index, law in enumerate(laws):
        if suffixes[index] in suffixes[:index]:
            raise InputError(f"chi: {law.chi:g} comes twice; give each chi once")
    names = ["carom_rebound"] if len(laws) == 1 else [f"carom_rebound_{one}" for one in suffixes]
    return HEADER.substitute(
        error="1e-6 max(1, |psi_1|)" if losses else "1e-9 (chi <= 10)",
        chis=", ".join(repr(law.chi) for law in laws),
        version=__version__,
        guard=f"CAROM_REBOUND_{'_AND_'.join(suffixes)}_H".upper(),
        functions="".join(map(_function, names, laws)),
    )


def _suffix(law: ReboundLaw) -> str:
    chi, e = _identifier(law._one_chi()), law.restitution
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
