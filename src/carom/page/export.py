"""A copy of the page as a folder of files, which needs neither this program nor a network."""

import tempfile
from pathlib import Path
from typing import NamedTuple

from carom.io.paths import accessing, checked_folder, write_folder
from carom.page.page import ASSETS, KERNELS, asset, assets_in, kernels, page, plotly_file
from carom.quantities.refusals import refusal, refuse

PAGE, PLOTLY = "index.html", "plotly.min.js"
COPIED = (ASSETS, PLOTLY, PAGE)
COPY_MARK = 'id="config"'  # in its page


class Copy(NamedTuple):
    """A copy of the page: where it is, its size, and of how many files it is made."""

    folder: str
    bytes: int
    files: int


def export(folder: str | Path) -> Copy:
    """Write a copy of the page into a new or empty folder, or in the place of an older copy.

    Once all of it is made it takes its place, or what was there is put back. InputError if the
    folder holds anything else, or cannot be written.
    """
    target, real = checked_folder(folder)
    with accessing("folder", target, "written"):
        allowed = "it holds other files; give a new or empty folder"
        foreign = real.exists() and not _is_ours(real)
        refuse(foreign and refusal("folder", str(target), allowed))
        parts = _parts()
        if real.exists():
            _replace(real, parts)
        else:
            write_folder(target, parts)
    return Copy(str(target), sum(map(len, parts.values())), len(parts))


def _is_ours(folder: Path) -> bool:
    """Tell whether a folder is empty, or holds a copy and nothing else."""
    held = {each.name for each in folder.iterdir()}
    if not held:
        return True
    if held != set(COPIED) or any(each.is_symlink() for each in folder.iterdir()):
        return False
    html = (folder / PAGE).read_text(encoding="utf-8", errors="replace")
    parts = {each.name for each in (folder / ASSETS).iterdir()}
    return COPY_MARK in html and parts <= {*assets_in(html)}


def _parts() -> dict[str, bytes]:
    """Return the content of all files by their places."""
    html = page(static=True)
    parts = {PAGE: html.encode()}
    for name in assets_in(html):
        parts[f"{ASSETS}/{name}"] = kernels() if name == KERNELS else asset(name)
    parts[PLOTLY] = plotly_file().read_bytes()
    return parts


def _replace(real: Path, parts: dict[str, bytes]) -> None:
    """Write all beside its place, then put it there; the folder stays the same one."""
    with tempfile.TemporaryDirectory(prefix=".carom-", dir=real) as room:
        made, old = Path(room, "new"), Path(room, "old")
        for name, content in parts.items():
            place = made / name
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
        old.mkdir()
        try:
            for name in COPIED:
                _moved(real / name, old / name)
                _moved(made / name, real / name)
        except BaseException:
            for name in COPIED:
                if not (made / name).exists():
                    _moved(real / name, made / name)
                _moved(old / name, real / name)
            raise


def _moved(one: Path, other: Path) -> None:
    """Move a file or folder, if it is there."""
    if one.exists():
        one.replace(other)
