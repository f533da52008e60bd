"""Writing the benchmark pack: the frozen files, what is derived from them, and checksums."""

import hashlib
import json
import os
import shutil
import tempfile
from pathlib import Path

from carom.io.paths import checked_path
from carom.quantities.refusals import InputError, refusal
from carom.verify.pack.frozen import CASE, INPUTS, REFERENCE, VERSION, folders_with, frozen_files
from carom.verify.pack.programs import program_files
from carom.verify.pack.references import ACCURACY, title_of
from carom.verify.pack.tables import read_table

CHECKSUMS = "SHA256SUMS"


def write_pack(folder: str | Path) -> tuple[str, ...]:
    """Write the benchmark pack into a new or empty folder and return its files, relative to it.

    The folder appears whole or not at all. Reference numbers are those of the pack's version, the
    same to the last byte wherever it is written; `sha256sum -c SHA256SUMS` checks a copy.

    Parameters
    ----------
    folder : str or Path
        A folder that does not exist, or is empty; the one it is in must exist.

    Returns
    -------
    tuple of str
        Paths within the folder, / between their parts.

    Raises
    ------
    InputError
        If there is something in the folder, or it cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import carom
    >>> with TemporaryDirectory() as folder:
    ...     files = carom.verify.write_pack(folder + "/bench")
    >>> "wall/reference.csv" in files
    True
    """
    target, files = checked_folder(folder), pack_files()
    try:
        temporary = Path(tempfile.mkdtemp(prefix=".carom-", dir=target.parent))
        try:
            inner = temporary / target.name
            for name, text in files.items():
                path = inner / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(text.encode("utf-8"))
            if target.exists():
                target.rmdir()
            os.replace(inner, target)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"folder: {str(folder)!r} cannot be written; {reason}") from None
    return tuple(files)


def checked_folder(folder: str | Path) -> Path:
    """Return the folder to be written, or raise InputError if a pack cannot be made of it."""
    target = Path(os.path.realpath(checked_path("folder", folder, "folder")))
    if target.exists() and not target.is_dir():
        raise refusal("folder", str(folder), "it is a file; give a new folder")
    if target.is_dir() and any(target.iterdir()):
        raise refusal("folder", str(folder), "it is not empty; give a new folder, or empty it")
    if not target.parent.is_dir():
        raise refusal("folder", str(folder), "the folder it is in must exist; make it first")
    return target


def pack_files() -> dict[str, str]:
    """Return the text of every file of the pack by its path, the checksums last."""
    files = dict(frozen_files())
    for folder in folders_with(REFERENCE):
        files[f"{folder}/reference.json"] = read_table(files[f"{folder}/{REFERENCE}"]).as_json()
    files |= program_files()
    files["pack.json"] = _contents(files)
    files = dict(sorted(files.items()))
    sums = (f"{_digest(t)}  {name}\n" for name, t in files.items() if not name.endswith(INPUTS))
    return files | {CHECKSUMS: "".join(sums)}  # but for what users fill in


def _contents(files: dict[str, str]) -> str:
    """Return what the pack holds, for programs to read."""
    sets = []
    for folder in folders_with(CASE):
        inside = [name for name in files if name.startswith(f"{folder}/")]
        sets.append({"folder": folder, "title": title_of(folder), "files": sorted(inside)})
    record = {"name": "carom benchmark pack", "version": VERSION}
    errors = {"accuracy_of_psi_2": ACCURACY, "per": "max(1, |psi_1|)"}
    return json.dumps(record | errors | {"sets": sets}, indent=1, ensure_ascii=False) + "\n"


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8")).hexdigest()
