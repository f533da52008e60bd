"""The commands. No physics here: they read, call the library, and print.

This file is how a command begins and ends. It loads next to nothing, so that a signal finds it
ready. Imports inside functions are for what only one command needs, so that `carom --help` is
quick; in the rest of the package, for third-party packages that are heavy or optional.
"""

import errno
import os
import signal
import sys
import warnings
from contextlib import suppress
from typing import Never

UNWRITTEN = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EBADF)
FAILED, REFUSED, INTERRUPTED = 1, 2, 130  # exit codes
ENDING = ("SIGINT", "SIGTERM", "SIGHUP")

heard: list[int] = []  # signals that are to end this process


def main(arguments: list[str] | None = None) -> int:
    """Run a command; return 0, 1 for a failure, 2 after a line for bad input, 130 if stopped."""
    try:
        from carom.cli.commands import answer

        code = answer(arguments)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt as error:
        return _say(str(error) or "the command was interrupted", INTERRUPTED)
    except Exception as error:  # the last resort: a line instead of a traceback
        return _failed(error)


def _failed(error: Exception) -> int:
    if heard:  # C code makes other errors of what ends a process
        return _say("the command was interrupted", 128 + heard[0])
    from carom.io.paths import Unwritten
    from carom.quantities.refusals import InputError

    if isinstance(error, Unwritten):
        return _say(error.strerror or str(error), FAILED)
    if isinstance(error, InputError):
        return _say(str(error), REFUSED)
    if isinstance(error, BrokenPipeError):  # whoever has read the output has gone
        return FAILED
    if isinstance(error, OSError) and error.errno in UNWRITTEN:
        return _say(f"the output cannot be written; {error.strerror}", FAILED)
    return _say(f"the command failed, {type(error).__name__}: {error}", FAILED)


def run() -> None:
    """Run a command from the shell, in a process of its own."""
    try:
        code = _run()
    except KeyboardInterrupt:
        code = _say("the command was interrupted", INTERRUPTED)
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # once more ends it without a word
    if code == FAILED:  # what stdout did not take is dropped
        with suppress(OSError):
            sys.stdout.flush()
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    sys.exit(code)


def _run() -> int:
    for name in ENDING:
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        usual = signal.SIG_DFL, signal.default_int_handler
        if number is not None and signal.getsignal(number) in usual:  # not ignored, as by nohup
            signal.signal(number, _end)
    _open_all()
    os.environ["MPLBACKEND"] = "agg"  # for files: no screen, and no backend that is not there
    _quieten()
    return main()


def _end(number: int, _: object) -> Never:
    """End this process, so that it still removes its temporary files."""
    heard.append(number)
    if number == signal.SIGINT:
        raise KeyboardInterrupt
    sys.exit(128 + number)


def _open_all() -> None:
    """Open closed standard streams, whose place no file may take: what is printed then fails."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:  # a new file takes the lowest number that is free
            os.open(os.devnull, os.O_RDONLY if descriptor == 1 else os.O_RDWR)
    sys.stdout = sys.stdout or open(1, "w", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", closefd=False)  # noqa: SIM115


def _say(message: str, code: int) -> int:
    with suppress(OSError):  # stderr is full, too
        print(f"carom: {' '.join(message.split())}", file=sys.stderr, flush=True)
    return code


def _quieten() -> None:
    """Show the warnings of this package in one line each, and none of the packages it uses."""
    import logging

    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # of its folders and its fonts
    logging.getLogger("asyncio").setLevel(logging.CRITICAL)  # of what an end has left unfinished
    if sys.warnoptions:  # somebody looks for them
        return
    warnings.filterwarnings("ignore")
    warnings.filterwarnings("default", module=r"carom\.")
    warnings.filterwarnings("ignore", r".* encountered in ", RuntimeWarning)  # by NumPy
    warnings.formatwarning = lambda message, *_, **__: f"carom: {message}\n"
