"""A DEM program on the bench: its impacts against the exact answer, law by law."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies.cases import case_of
from carom.bodies.pairs import Pair
from carom.dem.base import ContactLaw
from carom.dem.function import steel_on_steel
from carom.dimensionless.law import Law
from carom.io.progress import Progress, advancing
from carom.io.user_table import CASE
from carom.quantities.arrays import finite_line
from carom.quantities.refusals import checked_type, known_keywords, refusal, refuse
from carom.verify import errors
from carom.verify.engines.experiments import Experiment, Outcomes, psi_out, results_csv
from carom.verify.engines.running import Engine, EngineError, EngineKilled, run
from carom.verify.entries import CATALOGUE, EXACT, Entry, as_entry, listed
from carom.verify.errors import INCIDENCES, Impacts
from carom.verify.tables import text_table

STEPS_PER_CONTACT = 2000
OVERLAP = 1e-6  # d_max/R*: so small that the turning of a normal costs some 2e-5 in psi_2
COLUMNS = ":<32s max:7.3f at:5.2f rms:7.3f law:8.1e seconds:8.2f"


class Measured(NamedTuple):
    """A law, `entry`, run in a program: its errors and how many seconds it took, or its failure.

    `max_error` (at psi_1 = `worst`) and `rms_error` against the exact impact; `law_error` the
    largest difference from Carom's own law at the same steps.
    """

    entry: Entry
    max_error: float
    worst: float
    rms_error: float
    law_error: float
    seconds: float
    failure: str | None

    def to_dict(self) -> dict[str, Any]:
        """Return the numbers, or the failure, as what JSON can hold."""
        if self.failure:
            return {"law": self.entry.label, "failure": self.failure}
        return {"law": self.entry.label, **dict(zip(self._fields[1:-1], self[1:-1], strict=True))}


@dataclass(frozen=True)
class Bench:
    """Impacts in a DEM program against the exact impact, the best law first; made by `bench`.

    `engine` and `version` are the program, `pair`, all `psi` and `steps` the impacts. Each of
    `measured` is a law with its errors, and `outcomes` has its impacts by name.
    """

    engine: str
    version: str
    pair: Pair
    psi_in: tuple[float, ...]
    steps: int
    measured: tuple[Measured, ...]
    outcomes: dict[str, tuple[Experiment, Outcomes]]

    @property
    def failed(self) -> bool:
        """Whether the program failed on any law."""
        return any(one.failure for one in self.measured)

    def results(self) -> str:
        """Return the impacts with the best law as the scorer reads them, the case in comments."""
        law = self.measured[0].entry.label
        names = f"# code: {self.engine}\n# law: {law}\n"
        rows = results_csv(*self.outcomes[law])
        return f"{CASE} {json.dumps(case_of(self.pair))}\n{names}{rows}"

    def to_dict(self) -> dict[str, Any]:
        """Return the measurements as what JSON can hold."""
        return {
            "engine": self.engine,
            "version": self.version or None,
            "chi": self.pair.chi,
            "psi_in": list(self.psi_in),
            "steps": self.steps,
            "laws": [one.to_dict() for one in self.measured],
        }

    def __str__(self) -> str:
        what = f"{self.engine} {self.version}".strip()
        numbers = (one for one in self.measured if not one.failure)
        table = text_table(COLUMNS, [(one.entry.label, *one[1:-1]) for one in numbers])
        failed = (one for one in self.measured if one.failure)  # which come last
        return "\n".join(
            [
                f"|error in psi_2| of {what} at chi = {self.pair.chi:.5g},"
                f" {errors.in_words(self.psi_in)}, with {self.steps} steps per contact",
                *table,
                *(f"  {one.entry.label:32s} {one.failure}" for one in failed),
                "max, at: largest error, and its psi_1",
                "law: largest difference from the same law in Carom, in the same steps",
            ]
        )


@known_keywords
def bench(
    engine: Engine,
    entries: Sequence[Entry | Law] = CATALOGUE,
    *,
    pair: Pair | None = None,
    psi_1: ArrayLike = INCIDENCES,
    steps: int = STEPS_PER_CONTACT,
    time_limit: float = 120.0,
    progress: Progress = None,
) -> Bench:
    """Return how far a DEM program is from the exact impact with each law that it has.

    Parameters
    ----------
    engine : Engine
        `carom.verify.Lammps()`, `carom.verify.Liggghts()` or `carom.verify.Yade()`.
    entries : sequence of Entry or Law
        Laws; those that the program lacks, and repeated ones, are left out.
    pair : Pair, optional
        By default a steel ball on a steel half-space, chi = 1.4412.
    psi_1 : array_like
        Incidences psi_1.
    steps : int
        Time steps per duration of Hertz's contact.
    time_limit : float
        Seconds for each run of the program.
    progress : bool or callable, optional
        As for `carom.sweep`; laws are counted.

    Returns
    -------
    Bench
        `measured` has one item per law, the best first: its `entry`, max_error and rms_error in
        psi_2, `worst`, the psi_1 of the largest error, law_error, the largest difference from the
        same law in Carom, seconds, and the `failure` or None. Also `version` of the program,
        `psi_in`, `steps` and `outcomes`.

    Raises
    ------
    InputError
        If the program is not installed, has none of the laws, or a value is out of range.

    Examples
    --------
    >>> carom.verify.bench(carom.verify.Lammps("/nowhere/lmp"))
    Traceback (most recent call last):
    carom.InputError: LAMMPS: '/nowhere/lmp' is not an executable; give another path
    """
    checked_type("engine", engine, Engine, "must be a DEM program, e.g. carom.verify.Lammps()")
    bodies, psis = steel_on_steel() if pair is None else pair, finite_line("psi_1", psi_1)
    refuse(engine.executable() is None and f"{engine.name}: {engine.remedy}")
    supported = _supported(engine, [as_entry(each) for each in listed("entries", entries)])
    slow = (OVERLAP * bodies.effective_radius / bodies.scales(1.0).length) ** 1.25
    speeds = tuple((psis * bodies.scales(slow).tangential_speed).tolist())
    version, measured, outcomes = "", [], {}
    with advancing(engine.name, len(supported), progress, unit="laws") as advance:
        for done, entry in enumerate(supported, start=1):
            assert isinstance(entry.law, ContactLaw)
            experiment = Experiment(
                pair=bodies, law=entry.law, normal_speed=slow, tangential_speed=speeds, steps=steps
            )
            try:
                result = run(engine, experiment, time_limit=time_limit)
            except EngineError as error:
                measured.append(_failed(entry, str(error)))
                if isinstance(error, EngineKilled):
                    measured += [_failed(each, "not run") for each in supported[done:]]
                    break
            else:
                version = result.version
                outcomes[entry.label] = (experiment, result.outcomes)
                measured.append(_measured(entry, experiment, result.outcomes, result.seconds))
            advance(1)
    ordered = sorted(measured, key=lambda one: (one.failure is not None, one.max_error))
    return Bench(
        engine.name, version, bodies, tuple(psis.tolist()), steps, tuple(ordered), outcomes
    )


def _supported(engine: Engine, entries: Sequence[Entry]) -> list[Entry]:
    """Return the entries that a program has, each law once, or raise InputError for none."""

    def has(entry: Entry) -> bool:
        return isinstance(entry.law, ContactLaw) and engine.supports(entry.law)

    supported: list[Entry] = []
    for entry in filter(has, entries):
        if entry.law not in (other.law for other in supported):
            supported.append(entry)
    if not supported:
        labels = ", ".join(entry.label for entry in entries)
        builds = engine._builder and labels == EXACT
        until = f" until {engine._builder} has built it" if builds else ""
        others = "; ".join(entry.label for entry in filter(has, CATALOGUE))
        raise refusal("law", labels, f"{engine.name} does not have it{until}; it has {others}")
    return supported


def _failed(entry: Entry, failure: str) -> Measured:
    return Measured(entry, *(np.nan,) * 5, failure)


def _measured(entry: Entry, experiment: Experiment, outcomes: Outcomes, seconds: float) -> Measured:
    pair, psi_2 = experiment.pair, psi_out(experiment, outcomes)
    impacts = Impacts(experiment.psi_in, pair.chi, pair.kappa)
    error = psi_2 - impacts.exact(impacts.restitution(entry.law))
    law_error = errors.largest(psi_2 - impacts.rebound(entry.law, experiment.steps))
    worst = float(impacts.psi[int(np.argmax(np.abs(error)))])
    max_error, rms_error = errors.largest(error), errors.root_mean_square(error)
    return Measured(entry, max_error, worst, rms_error, law_error, seconds, None)
