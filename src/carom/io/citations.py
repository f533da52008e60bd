"""What to cite for a result, as BibTeX."""

import re
from functools import cache

from carom.folder import DATA
from carom.io.version import __version__

IMPACT = ("carom", "barber1979", "maw1976")  # the theory of impacts
LOADS = ("carom", "mindlin1953", "maw1976")
TURNING = "moreau1977"
ELEMENTS = ("carom", "kalker1990", "love1929")
FITS = (*IMPACT, "newville2014")
SAMPLES = ("foremanmackey2013",)
VISCOUS = "kuwabara1987"
PLATE = "zener1941"
ADHESION = ("carom", "johnson1971", "thornton1998")


def bibtex(*keys: str) -> str:
    """Return entries of data/citations.bib by key, in this order.

    Examples
    --------
    >>> print(bibtex("maw1976").splitlines()[2])
      author = {Maw, N. and Barber, J. R. and Fawcett, J. N.},
    """
    return "\n".join(_entries()[key] for key in keys)


def with_doi(doi: str) -> str:
    """Return the entry of a publication by its DOI; of one that is not known the DOI alone.

    Examples
    --------
    >>> print(with_doi("10.1000/182"), end="")
    @misc{data,
      doi = {10.1000/182},
    }
    """
    entries = (entry for entry in _entries().values() if f"doi = {{{doi}}}" in entry)
    return next(entries, f"@misc{{data,\n  doi = {{{doi}}},\n}}\n")


@cache
def _entries() -> dict[str, str]:
    text = (DATA / "citations.bib").read_text(encoding="utf-8")
    entries = re.split(r"(?m)^(?=@)", text.replace("VERSION", __version__))[1:]
    return {each[each.index("{") + 1 : each.index(",")]: each.rstrip() + "\n" for each in entries}
