"""How far is the theory off where waves run in the wall? Impacts on elastic layers, by springs.

python studies/wall_waves.py            check the bounds against the table, and print how tight
python studies/wall_waves.py --run      make the table again, in some minutes

The bodies are drawn at random; the twin in tests/oracles/layer.py solves each impact with all waves
of the wall, on a layer or on a half-space. Rows are left out where bending waves are shorter than
six thicknesses, the contact is wider than a tenth of the thickness, waves in a half-space take
less than 0.001 of the energy, below which steps of the twin count, or its passes do not converge.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

import carom
from carom.bodies.walls import half_wave, radiated_share
from carom.dimensionless.neglected import plate_error, wave_error

TABLE = Path(__file__).with_suffix(".csv")
MATERIALS = (
    *("bearing-steel", "alumina", "soda-lime-glass", "aluminium-7075", "pmma", "titanium-alloy"),
)
RADIUS, FRICTION = 5e-3, 0.15
PLATES, THICK = 1000, 500
CONVERGED, LATEST = 1e-5, 180.0  # of psi_2, and of t c_T/h
LONG_WAVE, SMALL, SHEARING, LEAST = 6.0, 0.1, 7.0, 1e-3


def drawn(rng: np.random.Generator, wall: str) -> tuple[dict[str, object], carom.Pair] | None:
    """Return the inputs of an impact, and its bodies."""
    first, second = rng.choice(MATERIALS, 2)
    if rng.random() < 0.4:
        second = first
    gyration = RADIUS * np.sqrt(rng.choice([0.08, 0.15, 0.25, 0.4, 0.4, 0.66, 1.0]))
    thickness = RADIUS * 10.0 ** rng.uniform(-0.6, 1.1) if wall == "plate" else None
    ball = carom.Sphere(radius=RADIUS, material=str(first), gyration_radius=gyration)
    pair = carom.Pair(ball, carom.HalfSpace(str(second), thickness=thickness), FRICTION)
    fastest = 0.5 if wall == "plate" else 1.0
    inputs = {
        "wall": wall,
        "first": first,
        "second": second,
        "gyration_radius": gyration,
        "thickness": thickness or np.inf,
        "normal_speed": 10.0 ** rng.uniform(-2.0, fastest),
        "psi_in": 10.0 ** rng.uniform(-1.3, 0.9),
    }
    return inputs, pair


def solved(inputs: dict[str, object], pair: carom.Pair) -> dict[str, object] | None:
    """Return a row of the table: psi_2 and e by the theory and with all waves; None if left out."""
    from tests.oracles.layer import impact_on_layer

    speed, psi = float(inputs["normal_speed"]), float(inputs["psi_in"])
    sliding = psi * FRICTION * speed / pair.kappa
    try:
        hit = carom.impact(pair, normal_speed=speed, tangential_speed=sliding)
    except carom.InputError:  # a foil
        return None
    stuff, thick = pair.second.material, inputs["wall"] == "half-space"
    shear_speed = np.sqrt(stuff.shear_modulus / stuff.density)
    row = {"chi": pair.chi, "psi_out": hit.psi_out, "restitution": hit.normal_restitution}
    if thick:
        row["share"] = radiated_share(pair, hit.scales)
        if not LEAST < row["share"] < 0.06:
            return None
    else:
        row["wave_ratio"] = 2.0 * half_wave(pair.second, hit.duration) / pair.thickness
        row["size"] = hit.max_radius / pair.thickness
        late = 1.15 * hit.duration * shear_speed / pair.thickness > LATEST
        bends = pair.gives_way(hit.scales) and row["wave_ratio"] > LONG_WAVE
        if late or not bends or row["size"] > SMALL:
            return None
    duration = None if thick else hit.duration
    exact = impact_on_layer(pair, speed, psi, duration=duration, steps=3200, springs=600)
    if exact.change > CONVERGED:
        return None
    of_waves = {"psi_out_waves": exact.psi_out, "restitution_waves": exact.restitution}
    return {**inputs, **row, **of_waves}


def run() -> None:
    """Make the table."""
    sys.path.append(str(Path(__file__).parents[1]))
    rng, rows = np.random.default_rng(63), []
    for wall, count in (("plate", PLATES), ("half-space", THICK)):
        wanted = len(rows) + count
        while len(rows) < wanted:
            row = solved(*drawn(rng, wall))
            rows += [row] if row else []
    pd.DataFrame(rows).to_csv(TABLE, index=False, float_format="%.7g")


def bounds(table: pd.DataFrame) -> np.ndarray:
    """Return the bound on the error of psi_2 in each row."""
    sheared = (1.0 - table.restitution) * SHEARING / table.wave_ratio**2
    on_plate = plate_error(table.chi, table.psi_in, table["size"], sheared)
    thick = wave_error(table.chi, table.psi_in, table.share)
    return np.where(table.wall == "plate", on_plate, thick)


def main() -> str:
    """Check the bounds, and return how they compare with the differences."""
    table = pd.read_csv(TABLE)
    off, bound = (table.psi_out_waves - table.psi_out).abs(), bounds(table)
    assert np.all(off <= bound)
    lines = []
    for wall, rows in table.groupby("wall"):
        most, ratio = off[rows.index].max(), np.median(bound[rows.index] / off[rows.index])
        found = f"{len(rows)} impacts, up to {most:.3f}"
        lines.append(f"{wall}: {found}; the bound is {ratio:.1f} times")
    return "\n".join(lines)


if __name__ == "__main__":
    if "--run" in sys.argv:
        run()
    print(main())
