"""Functions that are evaluated in the page, each in a file of its own."""

from pathlib import Path


def script(name):
    """Return the text of a function."""
    return Path(__file__).with_name(f"{name}.js").read_text("utf-8")
