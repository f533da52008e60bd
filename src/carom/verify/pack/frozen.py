"""The frozen part of the benchmark pack: files of the package, copied as they are.

Cases, inputs, reference numbers and texts. What a number is does not depend on the machine that
writes a pack; to change one takes a new version of the pack.
"""

from functools import lru_cache
from importlib.resources import files
from importlib.resources.abc import Traversable

VERSION = "1"
COMPILED = "__pycache__"  # what an installer makes of scripts
CASE, INPUTS, REFERENCE = "case.toml", "results.csv", "reference.csv"  # in the folder of a set


@lru_cache(maxsize=1)
def frozen_files() -> dict[str, str]:
    """Return the text of each frozen file by its path in the pack, in order."""
    root = files("carom").joinpath("data/benchmarks/pack")
    return dict(sorted(_texts(root, "").items()))


def folders_with(name: str) -> list[str]:
    """Return the folders of the pack that hold a frozen file of this name.

    Examples
    --------
    >>> from carom.verify.pack.frozen import folders_with
    >>> folders_with("results.csv")[-1]
    'wall_spin'
    """
    ending = f"/{name}"
    return [path.removesuffix(ending) for path in frozen_files() if path.endswith(ending)]


def _texts(folder: Traversable, prefix: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for entry in folder.iterdir():
        path = f"{prefix}{entry.name}"
        if entry.is_dir():
            found |= {} if entry.name == COMPILED else _texts(entry, f"{path}/")
        else:
            found[path] = entry.read_bytes().decode("utf-8")
    return found
