"""Running a DEM program on an experiment: in a folder of its own, within a time limit."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
import warnings
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import IO, ClassVar, NamedTuple

import numpy as np

from carom.dem.base import ContactLaw
from carom.quantities.refusals import refusal, refuse
from carom.quantities.units import positive
from carom.verify.engines.arrangement import outcomes_of, read_dump
from carom.verify.engines.experiments import Experiment, Outcomes

PRINTED_FILE = "printed.txt"  # in the folder of the program
SECONDS_BETWEEN_LOOKS = 0.1
MISSING_LIBRARY = r"(?:error while loading shared libraries|Library not loaded): ([^:\s]+)"
LAST_LINES, LAST_CHARACTERS = 3, 300
BYTES_READ, MOST_BYTES_PRINTED = 1 << 16, 1 << 26


class EngineError(RuntimeError):
    """A DEM program has failed; the message ends with the last lines that it printed."""


class EngineKilled(EngineError):
    """It had to be killed; what comes next would most likely have to be, too."""


@dataclass(frozen=True)
class Engine(ABC):
    """A DEM program that is driven by files and a command: the one at a path, else by its name.

    `name` is what messages call it, `advice` says how to get it.

    Parameters
    ----------
    path : str or Path, optional
        Where the program is.
    """

    path: str | Path | None = None

    name: ClassVar[str]
    _called: ClassVar[str]  # its executable
    _arguments: ClassVar[tuple[str, ...]]  # that run its inputs
    advice: ClassVar[str]  # how to get it
    _greeting: ClassVar[str]  # the pattern in which it prints its version
    _builder: ClassVar[str] = ""  # the command that builds it with the exact law
    _result: ClassVar[str] = ""  # the dump that it leaves

    @abstractmethod
    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law."""

    @abstractmethod
    def files(self, experiment: Experiment) -> dict[str, str]:
        """Return complete inputs: text by file name."""

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        """Return what a run has left in its folder; ValueError or OSError if it is not there."""
        return outcomes_of(experiment, read_dump(folder / self._result))

    @property
    def remedy(self) -> str:
        """What to do if the program is not there."""
        if self.path is not None:
            return f"{str(self.path)!r} is not an executable; give another path"
        return f"not found; {self.advice}"

    def executable(self) -> Path | None:
        """Return where the program is, or None."""
        path = shutil.which(self._called if self.path is None else self.path)
        return Path(path).absolute() if path else None

    def command(self, folder: Path) -> list[str]:
        """Return the command that runs the inputs in a folder."""
        return [str(self.executable() or self._called), *self._arguments]

    def version(self, printed: str) -> str:
        """Return the version that the program has printed."""
        greeting = re.search(self._greeting, printed, re.MULTILINE)
        return greeting.group(1) if greeting else "unknown"


class Run(NamedTuple):
    """The outcomes of an experiment, the version of the program, and the seconds that it took."""

    outcomes: Outcomes
    version: str
    seconds: float


def run(engine: Engine, experiment: Experiment, *, time_limit: float = 120.0) -> Run:
    """Run the impacts of an experiment in a DEM program and return how the bodies leave.

    Parameters
    ----------
    engine : Engine
        The program.
    experiment : Experiment
        The impacts, one pair and law.
    time_limit : float
        Seconds after which the program, and all that it started, is killed.

    Returns
    -------
    Run
        `outcomes`: how the first body leaves each impact relative to the second, arrays of shape
        (n,), one value an impact: `normal_speed` in m/s, positive when the bodies recede,
        `tangential_speed` in m/s and `spin` in rad/s. `version`: what the program printed as its
        version, or "unknown". `seconds`: how long it ran, in s.

    Raises
    ------
    InputError
        If the program is not installed or does not have the law.
    EngineError
        If it crashes, takes too long, or leaves no results, or results that are not finite.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> experiment = carom.verify.Experiment(
    ...     pair=pair, law=carom.dem.LammpsMindlin(), normal_speed=0.01,
    ...     tangential_speed=(0.005,), steps=1000,
    ... )
    >>> carom.verify.run(carom.verify.Lammps("/nowhere/lmp"), experiment)
    Traceback (most recent call last):
    carom.InputError: LAMMPS: '/nowhere/lmp' is not an executable; give another path
    """
    limit = positive("time_limit", time_limit)
    if not engine.supports(experiment.law):
        raise refusal("law", experiment.law, f"{engine.name} does not have it")
    refuse(engine.executable() is None and f"{engine.name}: {engine.remedy}")
    with TemporaryDirectory(prefix="carom-") as name:
        folder = Path(name)
        for file, text in engine.files(experiment).items():
            (folder / file).write_text(text, encoding="utf-8")
        start = perf_counter()
        _execute(engine, folder, limit)
        seconds = perf_counter() - start
        return Run(_results(engine, folder, experiment), engine.version(_printed(folder)), seconds)


def _execute(engine: Engine, folder: Path, time_limit: float) -> None:
    """Run the command of a program; whatever happens, no process of its group is left."""
    with (folder / PRINTED_FILE).open("wb") as printed:
        try:
            process = subprocess.Popen(
                engine.command(folder),
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=printed,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                env=os.environ | {"OMP_NUM_THREADS": "1"},
            )
        except OSError as error:
            raise EngineError(f"{engine.name} does not start: {error.strerror}") from None
        try:
            reason = _awaited(process, printed, time_limit)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    if reason is not None:
        raise _failure(engine, folder, reason, EngineKilled)
    if process.returncode != 0:
        raise _crash(engine, folder, process.returncode)


def _awaited(process: subprocess.Popen[bytes], printed: IO[bytes], limit: float) -> str | None:
    """Return nothing when a process has ended, or why it has to be killed."""
    deadline = perf_counter() + limit
    while True:
        try:
            process.wait(max(0.0, min(SECONDS_BETWEEN_LOOKS, deadline - perf_counter())))
            return None
        except subprocess.TimeoutExpired:
            if perf_counter() >= deadline:
                return f"was killed at its time limit of {limit:g} s"
            if os.fstat(printed.fileno()).st_size > MOST_BYTES_PRINTED:
                return f"was killed as it printed more than {MOST_BYTES_PRINTED >> 20} MB"


def _results(engine: Engine, folder: Path, experiment: Experiment) -> Outcomes:
    """Return the outcomes of a run, one finite number an impact."""
    try:
        with warnings.catch_warnings(action="ignore"):  # an empty file is counted below
            outcomes = engine.outcomes(folder, experiment)
    except FileNotFoundError:
        raise _failure(engine, folder, "has left no results") from None
    except (OSError, ValueError, IndexError, KeyError) as error:
        reason = " ".join(str(error).split())
        raise _failure(engine, folder, f"has left no results ({reason})") from None
    for column in outcomes:
        if column.shape != (len(experiment),):
            raise _failure(engine, folder, f"has left {column.size} of {len(experiment)} results")
        if not np.all(np.isfinite(column)):
            raise _failure(engine, folder, "has left results that are not finite")
    return outcomes


def _crash(engine: Engine, folder: Path, code: int) -> EngineError:
    missing = re.search(MISSING_LIBRARY, _printed(folder))
    if missing:
        cure = f"{missing[1]} is missing; {engine.advice}"
        return EngineError(f"{engine.name} does not start: {cure}")
    reason = f"exit code {code}" if code > 0 else f"signal {signal.Signals(-code).name}"
    return _failure(engine, folder, f"has crashed ({reason})")


def _failure(
    engine: Engine, folder: Path, what: str, kind: type[EngineError] = EngineError
) -> EngineError:
    """Return the error that tells what has happened and the last words of a program."""
    lines = [" ".join(line.split()) for line in _printed(folder).splitlines() if line.strip()]
    words = " | ".join(lines[-LAST_LINES:])[-LAST_CHARACTERS:] or "nothing"
    return kind(f"{engine.name} {what}; it printed last: {words}")


def _printed(folder: Path) -> str:
    """Return the beginning and the end of what a program has printed, as text that can be shown."""
    with (folder / PRINTED_FILE).open("rb") as printed:
        size = os.fstat(printed.fileno()).st_size
        content = printed.read(BYTES_READ)
        printed.seek(max(BYTES_READ, size - BYTES_READ))
        content += printed.read(BYTES_READ)
    text = content.decode("utf-8", errors="replace")
    return "".join(c if c.isprintable() or c in "\n\t" else "?" for c in text)
