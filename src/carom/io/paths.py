"""Names of files that users give, opening them, and writing them: whole or not at all.

A link is followed, so that the file it points to is written and the link stays. A stream is what
cannot be replaced: a pipe, a device, and whatever /dev/stdout is at the moment. For commands "-" is
the standard input.
"""

import errno
import io
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from threading import Thread
from typing import IO, Any

from carom.quantities.refusals import InputError, refusal, refuse

DESCRIPTOR_FOLDERS = ("/dev/fd", "/proc/self/fd")  # in which a name is an open file
STREAM_FORMATS = (".csv", ".png", ".gif", ".h", ".html")  # if it has no ending
PIPE_SECONDS = 5.0  # that somebody has to open the other end of a pipe
MOST_LINKS = 40  # that are followed, as the system does
STANDARD_INPUT = "-"
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)  # of a disk, or of what one may have

_standard: ContextVar[list[bytes] | None] = ContextVar("standard", default=None)  # its content


class Unwritten(OSError):
    """A disk is full, or fails, as something is written: no bad input. `strerror` says what."""


def checked_path(what: str, path: str | Path, kind: str = "file") -> Path:
    """Return the path of a file, or a folder, or raise InputError if that cannot be its name.

    Whether it exists is not asked, but Path("") is the folder in which the process runs, and a name
    that no file can have would be found out late, by an error of another kind.
    """
    if not isinstance(path, str | os.PathLike) or isinstance(os.fspath(path), bytes):
        raise refusal(what, path, f"must be the name of a {kind}")
    allowed = "" if str(path).strip() else f"it is empty; give the name of a {kind}"
    try:
        os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        pass
    except OSError as error:
        allowed = f"{_reason(error)}; give another name"
    except ValueError:  # NUL, or half of a character
        allowed = "no file can have such a name; give another"
    refuse(allowed and refusal(what, str(path), allowed))
    return Path(path)


@contextmanager
def accessing(what: str, path: str | Path, done: str) -> Iterator[None]:
    """Say in one line that a file or folder cannot be "read" or "written", and why.

    Raises Unwritten where a disk is full, else InputError.
    """
    try:
        yield
    except Unwritten:
        raise
    except OSError as error:
        words = f"{what}: {str(path)!r} cannot be {done}; {_reason(error)}"
        raise unwritten(error, words) or InputError(words) from None


def unwritten(error: OSError, words: str) -> Unwritten | None:
    """Return the error to be raised, with these words, if a disk is full; None otherwise."""
    return Unwritten(error.errno, words) if error.errno in FULL else None


def checked_folder(folder: str | Path) -> tuple[Path, Path]:
    """Return the path of a folder to be written and its real one, or raise InputError."""
    target = checked_path("folder", folder, "folder")
    real = Path(os.path.realpath(target))
    there, which = (real, "it") if real.exists() else (real.parent, "the folder it is in")
    if not there.is_dir():
        must = "is a file; give a new folder" if there == real else "must exist; make it first"
        raise refusal("folder", str(target), f"{which} {must}")
    locked = not os.access(there, os.W_OK)
    refuse(locked and refusal("folder", str(target), f"{which} cannot be written to"))
    return target, real


def new_folder(folder: str | Path) -> Path:
    """Return the real path of a new or empty folder, or raise InputError."""
    _, target = checked_folder(folder)
    full = target.is_dir() and any(target.iterdir())
    refuse(full and refusal("folder", str(folder), "it is not empty; give a new folder"))
    return target


def write_folder(folder: str | Path, files: Mapping[str, bytes]) -> None:
    """Write files into a new or empty folder, which appears whole or not at all.

    Raises InputError if there is something in the folder, or it cannot be written.
    """
    target = new_folder(folder)
    with accessing("folder", folder, "written"):
        temporary = Path(tempfile.mkdtemp(prefix=".carom-", dir=target.parent))
        try:
            inner = temporary / target.name
            for name, content in files.items():
                path = inner / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
            if target.exists():
                target.rmdir()
            os.replace(inner, target)
        finally:
            shutil.rmtree(temporary, ignore_errors=True)


@contextmanager
def reading_standard_input() -> Iterator[None]:
    """Let "-" stand for the standard input inside of this context, as often as it is read."""
    token = _standard.set([])
    try:
        yield
    finally:
        _standard.reset(token)


def _standard_input(kept: list[bytes], mode: str, how: Mapping[str, Any]) -> Any:
    if not kept:
        if sys.stdin is None:
            raise OSError(errno.EBADF, "the standard input is closed")
        kept.append(sys.stdin.buffer.read())
    content: Any = io.BufferedReader(io.BytesIO(kept[0]))
    return content if "b" in mode else io.TextIOWrapper(content, **how)


def opened(path: Path, mode: str = "r", **how: Any) -> Any:
    """Return an open file; raises OSError as `open`, and for a pipe that has no other end."""
    kept = _standard.get()
    if kept is not None and str(path) == STANDARD_INPUT and "r" in mode:
        return _standard_input(kept, mode, how)
    if not path.is_fifo():
        return path.open(mode, **how)
    files: list[IO[Any]] = []

    def wait() -> None:
        with suppress(OSError):
            files.append(path.open(mode, **how))

    waiting = Thread(target=wait, daemon=True)
    waiting.start()
    waiting.join(PIPE_SECONDS)
    if files:
        return files[0]
    os.close(os.open(path, os.O_RDWR | os.O_NONBLOCK))  # lets the thread go
    waiting.join()
    for file in files:
        file.close()
    raise OSError(errno.ENXIO, "nobody opens the other end of this pipe")


def checked_output(path: str | Path, endings: Sequence[str]) -> Path:
    """Return the path of an output file, or raise InputError if it cannot become one."""
    target = checked_path("output file", path)
    real, stream = os.path.realpath(target), is_stream(target)
    alone = not os.path.isdir(os.path.dirname(real)) and not stream
    faults = {
        f"must end in {' or '.join(endings)}": target.suffix.lower() not in endings
        and not (target.suffix == "" and stream),
        "it is a folder; give the name of a file": os.path.isdir(real),
        "its folder must exist; make it first": alone,
    }
    refuse(*(there and refusal("output file", str(path), words) for words, there in faults.items()))
    return target


def ending_of(target: Path, endings: Sequence[str]) -> str:
    """Return the ending that tells the format: a stream may have none, e.g. /dev/stdout."""
    return target.suffix.lower() or next(each for each in endings if each in STREAM_FORMATS)


def is_stream(target: Path) -> bool:
    """Tell whether a file is one to write into, not to replace."""
    if _descriptor(target) is not None:
        return True
    try:
        mode = target.stat().st_mode
    except OSError:  # to be made, or not to be reached
        return False
    return not S_ISREG(mode) and not S_ISDIR(mode)


def replace_whole(target: Path, write: Callable[[Path], object], ending: str = "") -> Path:
    """Call `write` on a temporary file, then put it in the place of the target, or into a stream.

    The temporary file has the ending of the target, or this one.
    """
    ending = ending or target.suffix
    with accessing("output file", target, "written"):
        if is_stream(target):
            with tempfile.TemporaryDirectory() as folder:
                write(whole := Path(folder, f"output{ending}"))
                _pour(whole, target)
        else:
            _replace(Path(os.path.realpath(target)), write, ending)
    return target


def _replace(real: Path, write: Callable[[Path], object], ending: str) -> None:
    if real.is_symlink():  # what realpath leaves of links in a circle
        real.stat()
    handle, name = tempfile.mkstemp(ending, ".carom-", real.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        write(temporary)
        os.umask(mask := os.umask(0))  # the only way to learn it
        temporary.chmod(real.stat().st_mode if real.exists() else 0o666 & ~mask)
        temporary.replace(real)
    finally:
        temporary.unlink(missing_ok=True)


def _pour(source: Path, target: Path) -> None:
    """Write the content of a file into a stream, behind what this process has printed."""
    with suppress(AttributeError, ValueError):  # there is none, or it is closed
        sys.stdout.flush()
    descriptor = _descriptor(target)  # which, opened by its name, is written from its start
    there = opened(target, "wb") if descriptor is None else os.fdopen(os.dup(descriptor), "wb")
    with source.open("rb") as content, there as stream:
        shutil.copyfileobj(content, stream)


def _descriptor(target: Path) -> int | None:
    """Return the number of an open file that is meant by names like /dev/stdout, /dev/fd/63."""
    folders = {os.path.realpath(folder) for folder in DESCRIPTOR_FOLDERS}
    for _ in range(MOST_LINKS):
        if target.name.isdecimal() and os.path.realpath(target.parent) in folders:
            return int(target.name)
        try:
            target = target.parent / os.readlink(target)
        except OSError:
            return None
    return None


def _reason(error: OSError) -> str:
    return error.strerror or str(error)
