"""Packings of spheres without friction in a periodic box, compressed to a pressure and at rest.

All laws start from the same packing of the same normal force, without any tangential force.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

from bulk.contact_laws import MODULUS
from bulk.simulations import run

COMPRESS = """\
boundary p p p
region box prism 0 {side} 0 {side} 0 {side} 0 0 0
create_box 1 box
create_atoms 1 random {size} {seed} NULL overlap 0.7 maxtry 1000
set group all diameter 1.0 density $(6/PI)
neighbor 0.15 bin
pair_style granular
pair_coeff * * {normal} 0.5 tangential linear_nohistory 0.0 0.0 damping coeff_restitution
timestep {step}
fix motion all nve/sphere
fix drag all viscous 0.02
compute stress all pressure NULL virial
fix squeeze all deform/pressure 1 box pressure {pressure} 0.002 normalize/pressure yes &
    max/rate 1e-3 remap x
fix_modify squeeze press stress
run {steps}
fix drag all viscous 0.01
run {steps}
write_data {file}
"""
BEGIN = """\
boundary p p p
neighbor 0.1 bin
read_data {packing}
{law}
timestep {step}
fix motion all nve/sphere
"""  # of what is done with a packing
LOOSE = 0.45  # volume fraction at the start


def packing(folder: Path, size: int, seed: int, pressure: float, spring: float = 0.0) -> Path:
    """Return the file of a packing, which is made if it is not there.

    The normal force is Hertz's, or that of linear springs of a stiffness.
    """
    file = folder / f"packing_{size}_{seed}_{pressure:g}_{spring:.4g}.data"
    if not file.exists():
        normal = f"hooke {spring!r}" if spring else f"hertz {4 / 3 * MODULUS!r}"
        text = COMPRESS.format(
            side=f"$(({size}*PI/6/{LOOSE})^(1/3))",
            size=size,
            seed=seed,
            normal=normal,
            step=0.4 * (1e-4 / pressure) ** (1 / 6),
            pressure=pressure,
            steps=40_000,
            file=file.name,
        )
        with TemporaryDirectory(dir=folder) as own:  # two may make it at once
            run(text, Path(own))
            Path(own, file.name).replace(file)
    return file
