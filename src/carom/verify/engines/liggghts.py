"""LIGGGHTS, driven through many impacts side by side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from carom.adapters import liggghts
from carom.bodies.shapes import Sphere
from carom.dem import ExactContactLaw, LiggghtsHertz, LinearSpring
from carom.dem.base import ContactLaw
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment
from carom.verify.engines.running import Engine

INPUT, SPHERES, RESULT = "in.liggghts", "spheres.data", "results.dump"


@dataclass(frozen=True)
class Liggghts(Engine):
    """LIGGGHTS-PUBLIC: Hertz or linear springs, with tangential history.

    A LIGGGHTS that `carom liggghts build` has compiled has the exact law, too. The contact point of
    LIGGGHTS lies at R - d/2 from the centre, which changes psi_2 by a few d/R; impacts at low speed
    are the sharper test. LIGGGHTS needs a restitution above 0.05.

    Parameters
    ----------
    path : str or Path, optional
        The executable, by default the one that `carom liggghts build` has built, else that on
        the PATH.

    Examples
    --------
    >>> engine = carom.verify.Liggghts()
    >>> hertz = carom.dem.LiggghtsHertz(restitution=0.9)
    >>> engine.supports(hertz), engine.supports(carom.dem.LammpsMindlin())
    (True, False)
    """

    name: ClassVar[str] = "LIGGGHTS"
    _called: ClassVar[str] = "liggghts"
    _arguments: ClassVar[tuple[str, ...]] = ("-in", INPUT)
    advice: ClassVar[str] = "install Debian's package liggghts, or carom liggghts build"
    _greeting: ClassVar[str] = r"LIGGGHTS-PUBLIC ([\w.]+)"
    _builder: ClassVar[str] = "carom liggghts build"
    _result: ClassVar[str] = RESULT

    def executable(self) -> Path | None:
        built = liggghts.program()
        return built if self.path is None and built.exists() else super().executable()

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law; the exact one where it was built with it."""
        if isinstance(law, ExactContactLaw):
            fits = law.springs in liggghts.SPRINGS and law.restitution == 1.0
            executable = self.executable() if fits else None
            return executable is not None and liggghts.has_model(executable)
        if isinstance(law, LinearSpring):
            return law.restitution == 1.0 or law.tangential_damping == 0.0
        return type(law) is LiggghtsHertz

    def files(self, experiment: Experiment) -> dict[str, str]:
        return {INPUT: _script(experiment), SPHERES: arrangement.data_file(experiment)}


def _words(law: ContactLaw) -> tuple[str, str]:
    if isinstance(law, ExactContactLaw):
        return "hertz tangential carom", f"springs {law.springs}"
    if isinstance(law, LinearSpring):
        return "hooke/stiffness tangential history", "tangential_damping off"
    return "hertz tangential history", "tangential_damping on"


def _script(experiment: Experiment) -> str:
    model, options = _words(experiment.law)
    wall = f"fix             wall all wall/gran model {model} primitive type 2 zplane 0.0 {options}"
    if isinstance(experiment.pair.second, Sphere):
        wall = "# no wall: the second bodies are spheres"
    return arrangement.filled(
        "liggghts.in",
        experiment,
        input=INPUT,
        result=RESULT,
        spheres=SPHERES,
        properties="\n".join(_properties(experiment)),
        model=f"{model} {options}",
        wall=wall,
    )


def _properties(experiment: Experiment) -> Iterator[str]:
    pair, law = experiment.pair, experiment.law

    def each(name: str, one: float, two: float) -> str:
        values = f"{float(one)!r} {float(two)!r}"
        return f"fix {name} all property/global {name} peratomtype {values}"

    def both(name: str, value: float) -> str:
        values = " ".join([repr(float(value))] * 4)
        return f"fix {name} all property/global {name} peratomtypepair 2 {values}"

    yield both("coefficientFriction", pair.friction)
    if isinstance(law, LinearSpring):
        normal, tangential, dashpot = arrangement.spring(experiment)
        yield both("kn", normal)
        yield both("kt", tangential)
        # LIGGGHTS multiplies gamman by the effective mass; gammat is not used, yet must be there
        yield both("gamman", dashpot / pair.normal_mass)
        yield both("gammat", 0.0)
    else:
        yield each("youngsModulus", *arrangement.young_moduli(pair))
        yield each("poissonsRatio", pair.first.material.poisson, pair.second.material.poisson)
        yield both("coefficientRestitution", arrangement.restitution(experiment))
