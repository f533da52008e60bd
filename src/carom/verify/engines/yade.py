"""YADE, driven through many impacts side by side."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from carom.bodies.pairs import Counterbody
from carom.bodies.shapes import Sphere
from carom.dem import LammpsMindlin, LinearSpring, YadeMindlin
from carom.dem.base import ContactLaw
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.running import Engine

SCRIPT, RESULT = "impacts.py", "results.txt"


MINDLIN = "Law2_ScGeom_MindlinPhys_Mindlin()"
ABOUT_MINDLIN = """
        # Law2_ScGeom_MindlinPhys_HertzWithLinearShear(nonLin=1) gives the same; with nonLin=0, its
        # default, the shear stiffness is kso, which has the unit of another quantity.
        # Law2_ScGeom_MindlinPhys_MindlinDeresiewitz never sets a shear force: psi_2 = psi_1"""


@dataclass(frozen=True)
class Yade(Engine):
    """YADE: its law Mindlin, which adds up the force as LAMMPS's mindlin/force does, and springs.

    HertzWithLinearShear with nonLin = 1 is the same law; with nonLin = 0, its default, k_t does not
    depend on the contact at all. MindlinDeresiewitz never sets a shear force, so psi_2 = psi_1.

    Parameters
    ----------
    path : str or Path, optional
        The executable, by default the one on the PATH.

    Examples
    --------
    >>> engine = carom.verify.Yade()
    >>> mindlin = carom.dem.YadeMindlin(restitution=0.9)
    >>> engine.supports(mindlin), engine.supports(carom.dem.LammpsMindlin("mindlin"))
    (True, False)
    """

    name: ClassVar[str] = "YADE"
    _called: ClassVar[str] = "yade"
    _arguments: ClassVar[tuple[str, ...]] = ("-j1", "-n", "-x", SCRIPT)
    advice: ClassVar[str] = "install Debian's package yade"
    _greeting: ClassVar[str] = r"Welcome to Yade (\S+)"

    def supports(self, law: ContactLaw) -> bool:
        """Tell whether the program has this law; its springs have no dashpot of their own."""
        if isinstance(law, LinearSpring):
            return law.restitution == 1.0
        if isinstance(law, LammpsMindlin):
            return law.variant == "mindlin/force" and law.restitution == law.stiffness == 1.0
        return isinstance(law, YadeMindlin)

    def files(self, experiment: Experiment) -> dict[str, str]:
        return {SCRIPT: _script(experiment)}

    def outcomes(self, folder: Path, experiment: Experiment) -> Outcomes:
        return arrangement.outcomes_of(experiment, np.loadtxt(folder / RESULT, ndmin=2))


def _script(experiment: Experiment) -> str:
    pair, second = experiment.pair, experiment.pair.second
    first_young, second_young = arrangement.young_moduli(pair)
    physics, functor = _law(experiment)
    motions = zip(experiment.tangential_speed, experiment.spin, strict=True)
    return arrangement.filled(
        "yade.in",
        experiment,
        script=SCRIPT,
        result=RESULT,
        first_material=_material(pair.first, first_young),
        second_material=_material(second, second_young),
        friction=pair.friction,
        radius=pair.first.radius,
        second_radius=second.radius if isinstance(second, Sphere) else 0.0,
        height=arrangement.ALMOST_TOUCHING * arrangement.touching(pair),
        normal_speed=experiment.normal_speed,
        impacts="\n".join(f"    ({speed!r}, {spin!r})," for speed, spin in motions),
        spacing=arrangement.spacing(pair),
        physics=physics,
        functor=functor,
        comment=ABOUT_MINDLIN if functor == MINDLIN else "",
    )


def _material(body: Counterbody, young: float) -> str:
    poisson, density = body.material.poisson, body.material.density or 1.0
    return f"young={young!r}, poisson={poisson!r}, density={density!r}"


def _law(experiment: Experiment) -> tuple[str, str]:
    """Return YADE's words for what a contact is made of, and for its law."""
    if isinstance(experiment.law, LinearSpring):
        normal, tangential, _ = arrangement.spring(experiment)
        springs = f"kn={_matched(normal)}, ks={_matched(tangential)}"
        physics = f"Ip2_FrictMat_FrictMat_FrictPhys({springs})"
        return physics, "Law2_ScGeom_FrictPhys_CundallStrack()"
    e = arrangement.restitution(experiment)
    damping = "" if e == 1.0 else f"en={_matched(e)}, es={_matched(e)}"
    return f"Ip2_FrictMat_FrictMat_MindlinPhys({damping})", MINDLIN


def _matched(value: float) -> str:
    return f"MatchMaker(algo='val', val={float(value)!r})"
