"""Completion of command lines by the shell: its script, and the names that options take."""

import os
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import typer
from typer import completion

from carom.io.paths import accessing, replace_whole
from carom.quantities.refusals import InputError

ASKED = "_CAROM_COMPLETE"  # the variable by which a shell asks, and by which a script is had
SHELLS = ("bash", "zsh", "fish", "powershell", "pwsh")
LOADED = '\n[ "$funcstack[1]" = _carom ] && _carom_completion "$@"\n'
ROOM = 1 << 18  # bytes that must be free: more than files of shells have
NAMES = {"prog_name": "carom", "complete_var": ASKED}


class WithValues:
    """How a shell completes --option=VALUE: a word of its own, or three as in bash."""

    def get_completions(self, args: list[str], incomplete: str) -> list[Any]:
        """Return what the word may become; the option stays in front of its value."""
        before = args[:-1] if args[-1:] == ["="] else args
        items: list[Any] = super().get_completions(before, incomplete)  # type: ignore[misc]
        option, equals, _ = incomplete.partition("=")
        if equals and option.startswith("--"):
            for item in items:
                item.value = f"{option}={item.value}"
        return items


def prepare() -> None:
    """Let typer know the shells, if one of them asks."""
    if ASKED in os.environ:
        completion.completion_init()  # type: ignore[attr-defined]
        known = completion.shell_completion  # type: ignore[attr-defined]
        for shell in SHELLS:
            kind = type(shell, (WithValues, known.get_completion_class(shell)), {})
            known.add_completion_class(kind, shell)


def show(shell: str) -> None:
    """Print the script with which a shell completes."""
    typer.echo(completion.get_completion_script(**NAMES, shell=shell))  # type: ignore[attr-defined]


def install(shell: str) -> None:
    """Store the script where a shell finds it; raises InputError if that cannot be written."""
    try:
        with accessing("--install-completion", shell, "written"):
            with TemporaryFile(dir=Path.home()) as room:  # typer would empty files on a full disk
                room.write(bytes(ROOM))
            _, path = completion.install(**NAMES, shell=shell)  # type: ignore[attr-defined]
            if shell == "zsh":  # which loads the script at the first Tab, and has that to do
                script = path.read_text() + LOADED
                replace_whole(path, lambda file: file.write_text(script))
    except (RuntimeError, UnicodeError) as error:  # no HOME, a file of the shell in no UTF-8
        raise InputError(f"--install-completion: {shell!r} cannot be written; {error}") from None
    typer.echo(f"Carom has stored {path}; open a new terminal to use it.", err=True)


def shell_of(option: str, given: str = "") -> str:
    """Return the shell that is given, or that this runs in, or raise InputError."""
    import shellingham

    name = given
    try:
        name = name or shellingham.detect_shell()[0]
    except (shellingham.ShellDetectionFailure, OSError, NotImplementedError):
        name = Path(os.environ.get("SHELL", "")).name
    if name not in SHELLS:
        found = f"{name!r} is not supported" if name else "the shell is not known"
        raise InputError(f"{option}: {found}; give one, e.g. carom {option} bash, zsh or fish")
    return name


def materials() -> Iterable[str]:
    """Return the names of materials."""
    import carom

    return [*carom.materials(), "rigid"]


def datasets() -> Iterable[str]:
    """Return the names of published measurements."""
    import carom

    return carom.datasets.names()


def laws() -> Iterable[str]:
    """Return the names of contact laws that are one word."""
    from carom.verify.entries import CATALOGUE, SHORT_NAMES

    labels = (entry.label for entry in CATALOGUE)
    return [*(label for label in labels if " " not in label), *SHORT_NAMES]
