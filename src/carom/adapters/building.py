"""What building for a DEM program takes: a compiler, a command that may fail, a place."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from carom.folder import PACKAGE
from carom.io.paths import FULL, Unwritten, unwritten
from carom.quantities.refusals import InputError, refusal

HERE = Path(__file__).parent
HEADERS = PACKAGE / "include"
COMPILERS = ("c++", "g++", "clang++")
MATH_FLAGS = ("-fno-math-errno", "-fno-trapping-math")  # without them roots are not vectors
OWN = ("-march=native",)  # it is built where it runs
FAILURE = re.compile(r"error:|undefined reference|\*\*\*", re.IGNORECASE)
LONGEST_COMPLAINT = 400  # characters


class Built(NamedTuple):
    """What was built: where it is, for which version, by which command."""

    path: Path
    version: int | str
    command: tuple[str, ...]


def home(program: str) -> Path:
    """Return the folder of this environment for what is built for a program."""
    return Path(sys.prefix) / "share" / "carom" / program


def compiler(command: str) -> str:
    """Return where a C++ compiler is, or raise InputError for the command that asks."""
    for path in filter(None, map(shutil.which, COMPILERS)):
        return path
    raise InputError(f"{command}: there is no C++ compiler; install g++ or clang++")


def carry_out(
    command: str, words: Sequence[str], tell: Callable[[str], object] = lambda line: None
) -> None:
    """Run what compiles, telling each line of it, or raise InputError with its complaint."""
    output: list[str] = []
    to_line: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    to_line |= {"text": True, "errors": "replace", "start_new_session": True}
    with subprocess.Popen(words, **to_line) as running:
        try:
            for line in running.stdout or ():
                output.append(line)
                tell(line)
        except BaseException:  # an interrupt ends what the compiler has started, too
            with contextlib.suppress(OSError):
                os.killpg(running.pid, signal.SIGKILL)
            raise
    if running.returncode:
        raise _failure(command, output)


def _failure(command: str, output: Sequence[str]) -> Unwritten | InputError:
    """Return the error for what a compiler says: a full disk is no bad input."""
    first = next((i for i, line in enumerate(output) if FAILURE.search(line)), 0)
    complaint = "".join(output[first:]).strip()
    words = f"{command}: the compiler failed: {complaint[:LONGEST_COMPLAINT]}"

    for code in FULL:
        if os.strerror(code) in complaint:
            return Unwritten(code, words)
    return InputError(words)


def check_folder(folder: Path) -> None:
    """Raise InputError if a folder is none or cannot be written, before it takes minutes."""
    there = next(path for path in (folder, *folder.absolute().parents) if os.path.exists(path))
    if not there.is_dir():
        raise _unwritable(folder, f"{there} is not a folder")
    if not os.access(there, os.W_OK | os.X_OK):
        raise _unwritable(folder, "permission denied")


def place(made: Path, target: Path) -> None:
    """Put what was made into its place, whole; raises Unwritten on a full disk, else InputError."""
    copied = target.with_name(target.name + ".new")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(made, copied)
        copied.replace(target)
    except OSError as error:
        with contextlib.suppress(OSError):
            copied.unlink()
        why = str(error.strerror)
        full = unwritten(error, f"folder: {str(target.parent)!r} cannot be written; {why}")
        raise full or _unwritable(target.parent, why) from error


def _unwritable(folder: Path, why: str) -> InputError:
    return refusal("folder", str(folder), f"cannot be written: {why}; give another with --folder")
