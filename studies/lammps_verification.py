"""Sticking impacts as tests for LAMMPS, and what they find in the LAMMPS that is installed.

python studies/lammps_verification.py            files, and the tables of the page: some ten seconds
python studies/lammps_verification.py --check    whether files and tables are still true

The files are those of examples/lammps/verification but for README.md and run_tests.py, the page is
docs/how-to/lammps-verification.md.
"""

import argparse
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager
from dataclasses import fields, replace
from functools import cache
from math import ceil, floor, log10
from pathlib import Path
from string import Template
from tempfile import TemporaryDirectory
from unittest.mock import patch

import lammps_twin
import numpy as np
from lammps_dem_tests import SEGMENTS, dem_test_yaml
from lammps_twin import Contact, State, outcomes_of, trajectory
from lammps_unittest import unit_test_yaml
from page_blocks import blocks, page_with, table

import carom
from carom.bodies.shapes import Sphere
from carom.dem.base import ContactLaw
from carom.verify.engines import arrangement
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.lammps import Lammps, coefficients

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "examples" / "lammps" / "verification"
PAGE = ROOT / "docs" / "how-to" / "lammps-verification.md"
sys.path.insert(0, str(FOLDER))
import run_tests  # noqa: E402

NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]\d+)?")
GRANULAR = "unittest/granular/tests"
STYLES = "unittest/force-styles/tests"
INPUTS = "examples/granular"
RELEASE = "22Jul25"  # of LAMMPS that logs are of
SPEED = 1e-3  # m/s: d_max/R = 1e-5, so that a normal turns by little
STEPS = 2000  # per duration of Hertz's contact
EPSILON = 1e-8  # a hundred times what rounding makes
ROOM = 1.1  # of the tolerance of a law, over its error
IMPACTS = ((0.6, 0.0), (1.2, 1.0), (2.5, 0.5), (4.0, -0.5))  # psi_1, and the share that is spin

STEEL = carom.material("steel")
GLASS = carom.Material(young=70e9, poisson=0.2, density=2500)
BALL, BEAD = carom.Sphere(radius=5e-3, material=STEEL), carom.Sphere(radius=3e-3, material=GLASS)
BODIES = {
    "wall": carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2),
    "pair": carom.Pair(BALL, BALL, friction=0.2),
    "unequal": carom.Pair(BEAD, BALL, friction=0.3),
}
LAWS: dict[str, ContactLaw] = {
    "linear_history": carom.dem.LinearSpring(),
    "mindlin": carom.dem.LammpsMindlin("mindlin"),
    "mindlin/force": carom.dem.LammpsMindlin("mindlin/force"),
    "mindlin_rescale": carom.dem.LammpsMindlin("mindlin_rescale"),
    "mindlin_rescale/force": carom.dem.LammpsMindlin("mindlin_rescale/force"),
}
LENGTHS = [round(share * STEPS) for share in SEGMENTS]
BROKEN = "mindlin_rescale"  # the law that is broken on purpose

INPUT = Template("""\
# $count oblique impacts of $bodies that stick for a while, beside the exact
# rebound of elastic spheres (Maw, Barber & Fawcett 1976).
#
#   lmp -in $name -var model mindlin_rescale/force
#
# model: linear_history, mindlin, mindlin/force, mindlin_rescale or mindlin_rescale/force.
# psi = kappa V_x/(mu V_1) of the contact point, kappa = G*/E* = $kappa, mu = $mu, V_1 = $speed m/s;
# chi = $chi. The exact psi after depends on psi before and chi alone. No damping, no gravity.

variable        model index mindlin
if "$${model} == linear_history" then &
  "variable law string 'hooke $spring_kn 0.0 tangential linear_history $spring_kt 0.0 $mu'" &
else &
  "variable law string 'hertz $kn 0.0 tangential $${model} $kt 0.0 $mu'"

units           si
atom_style      sphere
atom_modify     map array
boundary        f f f
newton          off
comm_modify     vel yes
region          box block $region units box
create_box      1 box
$atoms
neighbor        $skin bin

pair_style      granular
pair_coeff      * * $${law} damping velocity
$wall
fix             move all nve/sphere
compute         spin all property/atom omegay
timestep        $time_step   # $steps steps in Hertz's contact of $duration s
thermo          $run
run             $run

print           "psi before   psi after   exact"
$results
""")


def experiment(bodies: str, law: str) -> Experiment:
    """Return the impacts of some bodies by a law."""
    pair = BODIES[bodies]
    unit = pair.scales(SPEED).tangential_speed
    return Experiment(
        pair=pair,
        law=LAWS[law],
        normal_speed=SPEED,
        tangential_speed=tuple((1.0 - share) * psi * unit for psi, share in IMPACTS),
        spin=tuple(share * psi * unit / pair.first.radius for psi, share in IMPACTS),
        steps=STEPS,
    )


@cache
def errors(bodies: str, law: str) -> np.ndarray:
    """Return psi_2 of a law in these steps less the exact one, impact by impact."""
    wanted = experiment(bodies, law)
    (last,) = trajectory(wanted, [sum(LENGTHS)])
    exact = carom.rebound(wanted.psi_in, wanted.pair.chi)
    return np.asarray(psi_out(wanted, outcomes_of(last)) - exact)


def rounded_up(value: float) -> float:
    """Return the next number of two digits."""
    unit = 10.0 ** (floor(log10(value)) - 1)
    return round(ceil(value / unit) * unit, 12)


def tolerance(bodies: str, law: str) -> float:
    """Return the error in psi_2 that a law is allowed."""
    return rounded_up(ROOM * float(np.max(np.abs(errors(bodies, law)))))


def files() -> dict[str, str]:
    """Return every file by its path in the folder, which is the one in LAMMPS's own tree."""
    found = {}
    for bodies in BODIES:
        name = f"in.sticking.{bodies}"
        found[f"{INPUTS}/{name}"] = script(name, bodies)
        for law in LAWS:
            wanted, word = experiment(bodies, law), re.sub(r"\W|_", "", law)
            name = f"dem04-{word}-sticking-{bodies}-3d-si.yaml"
            found[f"{GRANULAR}/{name}"] = dem_test_yaml(wanted, epsilon=EPSILON)
            name = f"fix-timestep-sticking_{bodies}_{word}.yaml"
            allowed = tolerance(bodies, law)
            found[f"{STYLES}/{name}"] = unit_test_yaml(wanted, tolerance=allowed)
    return found


def script(name: str, bodies: str) -> str:
    """Return impacts as an input in the manner of LAMMPS's examples."""
    wanted, spring = (
        experiment(bodies, "mindlin"),
        coefficients(experiment(bodies, "linear_history")),
    )
    pair, law, edge = wanted.pair, coefficients(wanted), arrangement.spacing(wanted.pair)
    words = "${law} damping velocity zplane 0.0 NULL"
    return INPUT.substitute(
        arrangement.shared_values(wanted),
        name=name,
        kappa=f"{pair.kappa:.6g}",
        chi=f"{pair.chi:.6g}",
        mu=law.mu,
        speed=f"{SPEED:g}",
        kn=law.kn,
        kt=law.kt,
        spring_kn=spring.kn,
        spring_kt=spring.kt,
        region=f"{-edge!r} {edge!r} {-edge!r} {edge * len(wanted)!r} {-edge!r} {edge!r}",
        atoms="\n".join(created(wanted)),
        wall=f"fix             wall all wall/gran granular {words}\n" if bodies == "wall" else "",
        results="\n".join(printed(wanted)),
    )


def created(wanted: Experiment) -> Iterator[str]:
    """Yield the commands that make the spheres of an input."""
    for number, body in enumerate(arrangement.placed(wanted), 1):
        size, density = 2.0 * body.sphere.radius, body.sphere.material.density
        yield f"create_atoms    1 single 0.0 {body.y:.6g} {body.z!r} units box"
        yield f"set             atom {number} diameter {size:g} density {density:g}"
        motion = f"vx {0.0 + body.vx!r} vz {body.vz!r} omega 0 {0.0 - body.spin!r} 0"
        yield f"set             atom {number} {motion}"


def printed(wanted: Experiment) -> Iterator[str]:
    """Yield the commands that print how the contact points leave."""
    pair, unit, count = wanted.pair, wanted.scales.tangential_speed, len(wanted)
    exact = np.asarray(carom.rebound(wanted.psi_in, pair.chi))
    for i, (before, after) in enumerate(zip(wanted.psi_in, exact, strict=True), 1):
        point = f"vx[{i}]-{pair.first.radius:g}*C_spin[{i}]"
        if isinstance(pair.second, Sphere):
            point += f"-vx[{i + count}]-{pair.second.radius:g}*C_spin[{i + count}]"
        yield f'print           "{before:8.2f} $(({point})/{unit:.12g}:%12.4f) {after:12.4f}"'


def write_log(bodies: str) -> None:
    """Run an input and leave its log beside it, as examples of LAMMPS have them."""
    folder, name = FOLDER / INPUTS, f"sticking.{bodies}"
    with TemporaryDirectory() as place:
        log = Path(place, "log")
        command = [str(Lammps().executable()), "-in", f"in.{name}", "-log", str(log)]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        lines = log.read_text(encoding="utf-8").splitlines()
    kept = [line for line in lines if not line.startswith("Loaded ")]  # plugins, where they are
    (folder / f"log.{RELEASE}.{name}.g++.1").write_text("\n".join(kept) + "\n", encoding="utf-8")


def laws() -> Iterator[str]:
    """Yield how far each law is from the exact answer, impact by impact, and its tolerances."""
    for law in LAWS:
        row = errors("wall", law)
        allowed = [f"{tolerance(bodies, law):g}" for bodies in BODIES]
        yield " | ".join([f"`{law}`", *(f"{value:+.3f}" for value in row), *allowed])


def exact_row() -> str:
    """Return psi before and after of the impacts on a wall."""
    wanted = experiment("wall", "mindlin")
    after = np.asarray(carom.rebound(wanted.psi_in, wanted.pair.chi))
    return ", ".join(
        f"{psi:g} to {out:.4f}" for psi, out in zip(wanted.psi_in.round(12), after, strict=True)
    )


def agreement(texts: dict[str, str]) -> Iterator[str]:
    """Yield how far LAMMPS is from the law as its manual states it, in units of each number."""
    for law in LAWS:
        word = re.sub(r"\W|_", "", law)
        found = []
        for bodies in BODIES:
            text = texts[f"{GRANULAR}/dem04-{word}-sticking-{bodies}-3d-si.yaml"]
            found.append(f"{max(run_tests.errors(run_tests.yaml.safe_load(text))):.0e}")
        yield " | ".join([f"`{law}`", *found])


def coefficient(**changed: float | str) -> AbstractContextManager[object]:
    """Return a context in which the twin takes another law; numbers are factors."""
    law = coefficients(experiment("wall", BROKEN))
    values = {
        name: value if isinstance(value, str) else getattr(law, name) * value
        for name, value in changed.items()
    }
    return patch.object(lammps_twin, "coefficients", lambda _: replace(law, **values))


def multiplied(name: str, factor: float) -> AbstractContextManager[object]:
    """Return a context in which what a method of the twin's contact returns is multiplied."""
    right = getattr(Contact, name)
    return patch.object(Contact, name, lambda self, *given: factor * right(self, *given))


def broken() -> dict[str, AbstractContextManager[object]]:
    """Return ways to break the law on purpose, as contexts, by what is wrong."""
    return {
        "none": coefficient(),
        "$k_t$ 5 % too large": coefficient(kt=1.05),
        "$k_t$ 5 % too small": coefficient(kt=0.95),
        "$k_t$ halved": coefficient(kt=0.5),
        "$k_t$ doubled": coefficient(kt=2.0),
        "friction 5 % too large": coefficient(mu=1.05),
        "friction 5 % too small": coefficient(mu=0.95),
        "`mindlin` instead": coefficient(tangential="mindlin"),
        "`mindlin_rescale/force` instead": coefficient(tangential="mindlin_rescale/force"),
        "torque doubled": multiplied("_arms", 2.0),
        "torque missing": multiplied("_arms", 0.0),
        "torque of the wrong sign": multiplied("_arms", -1.0),
        "friction of the wrong sign": multiplied("_friction", -1.0),
    }


def energy(state: State) -> float:
    """Return the kinetic energy of the first of the balls on a wall, in units of its mass."""
    speeds = (
        state.vx[0, 0] ** 2,
        state.vz[0, 0] ** 2,
        0.4 * (BALL.radius * state.omega[0, 0]) ** 2,
    )
    return 0.5 * float(sum(speeds))


def breaks() -> Iterator[str]:
    """Yield what each mistake does to the numbers of a test and to the energy of its first ball."""
    wanted = experiment("wall", BROKEN)
    right = trajectory(wanted, [0, *LENGTHS])
    for name, mistake in broken().items():
        with mistake:
            wrong = trajectory(wanted, [0, *LENGTHS])
        found = max(
            run_tests.error(getattr(one, field.name), getattr(other, field.name))
            for one, other in zip(wrong, right, strict=True)
            for field in fields(State)
        )
        gained = energy(wrong[-1]) / energy(wrong[0]) - 1.0
        yield f"{name} | {float(f'{found:.1g}'):g} | {gained:+.4f}"


def tables(texts: dict[str, str]) -> dict[str, str]:
    """Return the blocks of the page by name."""
    heads = " | ".join(f"{psi:g}" for psi, _ in IMPACTS)
    allowed = " | ".join(f"allowed, {bodies}" for bodies in BODIES)
    return {
        "exact": exact_row(),
        "laws": table(f"law | {heads} | {allowed}", laws()),
        "agreement": table(f"law | {' | '.join(BODIES)}", agreement(texts)),
        "breaks": table("mistake | largest error | energy gained", breaks()),
    }


def same(one: str, other: str) -> bool:
    """Tell whether two texts are equal, but for what another machine does to a last digit."""
    numbers = [np.array(NUMBER.findall(text), dtype=float) for text in (one, other)]
    words = [NUMBER.sub("#", text) for text in (one, other)]
    return words[0] == words[1] and np.allclose(*numbers, rtol=1e-9, atol=1e-18)


def stale(texts: dict[str, str]) -> list[str]:
    """Return the files of the folder that are not as they would be written, or should not be."""
    there = {
        path.relative_to(FOLDER).as_posix()
        for path in FOLDER.rglob("*")
        if path.is_file()
        and path.parent not in (FOLDER, FOLDER / "__pycache__")  # what Python keeps of run_tests.py
        and "log." not in path.name
    }
    missing = there ^ set(texts)
    return sorted(missing) + [
        name
        for name in sorted(there & set(texts))
        if not same((FOLDER / name).read_text(encoding="utf-8"), texts[name])
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="only tell whether it is true")
    texts = files()
    if parser.parse_args().check:
        wrong = stale(texts)
        wrong += [] if blocks(PAGE) == tables(texts) else [PAGE.name]
        print(f"no longer true: {', '.join(wrong)}" if wrong else "all is true")
        raise SystemExit(1 if wrong else 0)
    for name, text in texts.items():
        path = FOLDER / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    for bodies in BODIES:
        write_log(bodies)
    PAGE.write_text(page_with(PAGE, tables(texts)), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
