"""Findings on an impact: a number with its bound, and whether it holds, fails or is not judged."""

from math import nan

from carom.bodies.materials import Material
from carom.io.labels import Finding
from carom.quantities.glossary import GLOSSARY


def judged(name: str, value: float, limit: float, good: str, bad: str) -> Finding:
    """Return the finding on a number that must not be beyond a limit."""
    holds = abs(value) <= limit
    return Finding(name, value, limit, holds, good if holds else bad)


def bounded(name: str, value: float, limit: float, good: str, bad: str) -> Finding:
    """Return the finding on a bound from above: beyond the limit it does not tell."""
    holds = True if abs(value) <= limit else None
    return Finding(name, value, limit, holds, good if holds else bad)


def lacking(
    name: str, limit: float, key: str, bodies: dict[str, Material], value: float = nan
) -> Finding:
    """Return the finding that cannot be judged, as these bodies lack a value of their material."""
    names = (stuff.name or f"the {body} body" for body, stuff in bodies.items())
    whose = " and ".join(dict.fromkeys(names))
    where = f"no {GLOSSARY[key].meaning} of {whose}: Material({key}=...)"
    return Finding(name, value, limit, None, f"not judged: {where}", f"{key} of {whose}")
