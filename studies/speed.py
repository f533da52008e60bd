"""What does an impact cost by each method, and how far off is it? Table: speed.csv.

python studies/speed.py            a minute; on one core
python studies/speed.py --draw     figure and page alone, from the table

CPU times, taken in turn in one run and kept as ratios to that of `carom.rebound`. LAMMPS is
measured where it is installed, else its row is kept. benchmarks/ tells how times grow with size.
"""

import argparse
import csv
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from accuracy import impacts
from page_blocks import as_maths, page_with, table
from small_pictures import store_small

import carom
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import ELASTIC, Inertia
from carom.plots import style
from carom.verify.engines.experiments import psi_out

TABLE, DOCS = Path(__file__).with_name("speed.csv"), Path(__file__).parents[1] / "docs"
FIGURE, PAGE = DOCS / "figures" / "speed.png", DOCS / "accuracy.md"
BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
MARKS = {
    "exact": ("o", style.BLUE),
    "tables": ("s", style.GREEN),
    "numerical": ("^", style.PURPLE),
    "contact law": ("D", style.VERMILION),
}
BESIDE = {  # where a label goes that would cover another, in points, and how it is aligned
    "ReboundLaw": (4, -8, "left"),
    "sweep": (4, -8, "left"),
    "rebound": (-4, 2, "right"),
    "collide": (-4, 2, "right"),
    "mindlin, 50 steps": (-4, 2, "right"),
    "collide, Walton": (4, -8, "left"),
    "boundary elements, 16 across": (-4, 2, "right"),
    "boundary elements, 32 across": (-4, -8, "right"),
}
FOUND = {"rebound, e = 0.9": 9e-8}  # by annuli and small steps
SEED, RUNS = 20261121, 5
FINE, COARSE = 5000, 1000  # steps of LAMMPS, whose difference leaves out its start
DEM_STEPS = 50  # per contact: enough for mindlin


class Row(NamedTuple):
    """A method: what kind it is, its time over that of `rebound`, its largest error in psi_2."""

    method: str
    kind: str
    ratio: float
    error: float


class Method(NamedTuple):
    """What is timed, on how many impacts; returns psi_2 of them, or nothing to compare."""

    method: str
    kind: str
    psi: Any
    solve: Callable[[Any], Any]


def clock() -> float:
    """Return the CPU time so far of this process and of those that it waited for, in s."""
    return sum(os.times()[:4])


def cases(count: int) -> Any:
    """Return psi_1 from 0 to 6 in all regimes, in no order."""
    return np.random.default_rng(SEED).uniform(0.0, 6.0, count)


def each(solve: Callable[[float], float]) -> Callable[[Any], Any]:
    """Return a method that takes impacts one by one."""
    return lambda psi: np.array([solve(float(value)) for value in psi])


def methods() -> list[Method]:
    """Return all methods but LAMMPS and the boundary elements."""
    chi, kappa = PAIR.chi, PAIR.kappa
    law, mixture = carom.laws.ReboundLaw(chi), carom.laws.ReboundLaw((1.1, 1.8))
    weak = carom.KelvinVoigt(restitution=0.9)
    softer = carom.dem.LammpsMindlin("mindlin_rescale/force", stiffness=0.78)
    dem = {
        "mindlin": (carom.dem.LammpsMindlin("mindlin"), DEM_STEPS),
        "mindlin_rescale/force with 0.78 k_t": (softer, 640),
        "linear spring": (carom.dem.LinearSpring(), DEM_STEPS),
    }
    some, many, most = cases(300), cases(3000), cases(300_000)
    return [
        Method("rebound", "exact", many, lambda psi: carom.rebound(psi, chi, threads=1)),
        Method("impact, with units", "exact", some, each(one_impact)),
        Method("sweep", "exact", many, swept),
        Method("rebound, e = 0.9", "exact", some, lambda p: carom.rebound(p, chi, losses=weak)),
        Method("collide", "tables", most, lambda psi: collided(psi, None)),
        Method("collide, Walton", "contact law", most, lambda p: collided(p, walton())),
        Method("ReboundLaw", "tables", most, law),
        Method("ReboundLaw over chi", "tables", most, lambda psi: mixture(psi, chi)),
        *(
            Method(f"annuli and steps, {n} springs", "numerical", some, by_springs(chi, n))
            for n in (500, 125)
        ),
        *(
            Method(f"{name}, {n} steps", "contact law", many, stepped(law, chi, kappa, n))
            for name, (law, n) in dem.items()
        ),
    ]


def by_springs(chi: float, springs: int) -> Callable[[Any], Any]:
    """Return the method of 1976, with four steps a spring."""
    return each(lambda psi: marched(psi, Inertia(chi), ELASTIC, springs)[PSI_OUT])


def stepped(law: Any, chi: float, kappa: float, steps: int) -> Callable[[Any], Any]:
    """Return a contact law of DEM codes in fixed steps."""
    return lambda psi: law.rebound(psi, chi, kappa=kappa, steps=steps)


def walton() -> Any:
    """Return Walton's law as close to the exact one as it comes."""
    return carom.laws.fit_walton(PAIR).law


def one_impact(psi: float) -> float:
    """Return psi_2 of an impact with units."""
    sideways = psi * PAIR.scales(1.0).tangential_speed
    return carom.impact(PAIR, normal_speed=1.0, tangential_speed=sideways).psi_out


def swept(psi: Any) -> Any:
    """Return psi_2 from a sweep."""
    case = {"first": {"radius": "5 mm", "material": "steel"}, "friction": 0.2, "normal_speed": 1}
    sideways = psi * PAIR.scales(1.0).tangential_speed
    table = carom.Table({"tangential_speed": sideways})
    return carom.sweep(case, table, workers=1, outputs=["psi_out"]).psi_out.values


def collided(psi: Any, law: Any) -> Any:
    """Return psi_2 from velocities and spins in three dimensions."""
    before = np.zeros((psi.size, 3))
    before[:, 0], before[:, 2] = psi * PAIR.scales(1.0).tangential_speed, 1.0
    after = carom.collide(PAIR, velocity1=before, normal=[0.0, 0.0, 1.0], law=law, threads=1)
    contact = after.velocity1[:, 0] + BALL.radius * after.spin1[:, 1]
    return contact / PAIR.scales(1.0).tangential_speed


def worst(psi: Any, found: Any) -> float:
    """Return the largest |error in psi_2|."""
    return float(np.max(np.abs(found - carom.rebound(psi, PAIR.chi))))


def exact_error() -> float:
    """Return the largest error of `rebound` in the table of 30 digits, over max(1, |psi_1|)."""
    psi, chi, out = impacts()
    return float(np.max(np.abs(carom.rebound(psi, chi) - out) / np.maximum(1.0, np.abs(psi))))


def timed(every: list[Method]) -> list[float]:
    """Return the median time of each method per impact, all in turn; the first round compiles."""
    times = np.empty((RUNS + 1, len(every)))
    for round_ in times:
        for place, method in enumerate(every):
            start = clock()
            method.solve(method.psi)
            round_[place] = (clock() - start) / method.psi.size
    return list(np.median(times[1:], axis=0))


def elements(unit: float) -> list[Row]:
    """Return what boundary elements cost and leave, psi_1 = 1.5 and 3; nu = 0.3."""
    rows = []
    for across, steps in ((16, 75), (32, 150)):
        found = []
        start = clock()
        for psi in (1.5, 3.0):
            sideways = psi * PAIR.scales(1.0).tangential_speed
            how = carom.BoundaryElements(elements=across, steps=steps)
            hit = carom.impact(PAIR, normal_speed=1.0, tangential_speed=sideways, method=how)
            found.append(abs(hit.psi_out - carom.rebound(psi, PAIR.chi)))
        each_one = (clock() - start) / 2.0
        rows.append(
            Row(f"boundary elements, {across} across", "numerical", each_one / unit, max(found))
        )
    return rows


def lammps(unit: float) -> list[Row]:
    """Return what a collision costs in LAMMPS with mindlin, start left out; or the row kept."""
    engine, psi = carom.verify.Lammps(), cases(400)
    name = f"LAMMPS, mindlin, {DEM_STEPS} steps"
    if engine.executable() is None:
        return [row for row in read() if row.method == name] if TABLE.exists() else []
    seconds = {}
    for steps in (COARSE, FINE, DEM_STEPS):
        start = clock()
        bench = carom.verify.bench(
            engine, [carom.dem.LammpsMindlin("mindlin")], psi_1=psi, steps=steps
        )
        seconds[steps] = clock() - start
    per_step = (seconds[FINE] - seconds[COARSE]) / ((FINE - COARSE) * psi.size)
    found = psi_out(*next(iter(bench.outcomes.values())))
    return [Row(name, "contact law", DEM_STEPS * per_step / unit, worst(psi, found))]


def measure() -> list[Row]:
    """Return all rows, the cheapest first."""
    every = methods()
    times = timed(every)
    unit = times[0]
    rows = [Row("rebound", "exact", 1.0, exact_error())]
    for method, seconds in list(zip(every, times, strict=True))[1:]:
        error = FOUND.get(method.method) or worst(method.psi, method.solve(method.psi))
        rows.append(Row(method.method, method.kind, seconds / unit, max(error, rows[0].error)))
    print(f"rebound: {1e6 * unit:.1f} us for an impact")
    return sorted([*rows, *elements(unit), *lammps(unit)], key=lambda row: row.ratio)


def read() -> list[Row]:
    """Return the rows that are stored."""
    with TABLE.open(encoding="utf-8") as lines:
        return [Row(m, k, float(r), float(e)) for m, k, r, e in list(csv.reader(lines))[1:]]


def write(rows: list[Row]) -> None:
    """Store the rows."""
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(("method", "kind", "time over that of rebound", "largest error of psi_2"))
        out.writerows((r.method, r.kind, f"{r.ratio:.2g}", f"{r.error:.1e}") for r in rows)


def lines(rows: list[Row]) -> str:
    """Return the table of the page."""
    return table(
        "method | kind | time | largest error of $\\psi_2$",
        (f"{as_maths(r.method)} | {r.kind} | {r.ratio:.2g} | {r.error:.1e}" for r in rows),
    )


def draw(rows: list[Row]) -> None:
    """Draw error against time."""
    with style.style():
        figure, axes = style.new_figure(width=style.DOUBLE, height=90)
        axis = axes[0, 0]
        for kind, (marker, color) in MARKS.items():
            of = [row for row in rows if row.kind == kind]
            points = [row.ratio for row in of], [row.error for row in of]
            axis.loglog(*points, marker, color=color, label=kind)
        for row in rows:
            x, y, side = BESIDE.get(row.method, (4, 2, "left"))
            at, how = (row.ratio, row.error), {"ha": side, "fontsize": 6.5}
            axis.annotate(
                style.with_formulas(row.method), at, (x, y), textcoords="offset points", **how
            )
        axis.set(xlabel="CPU time of an impact, relative to carom.rebound", xlim=(4e-4, 1e6))
        axis.set_ylabel(r"largest error of $\psi_2$")
        axis.legend(loc="lower right")
        store_small(figure, FIGURE)


def main() -> None:
    """Measure and draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--draw", action="store_true", help="figure and page alone")
    if not parser.parse_args().draw:
        os.sched_setaffinity(0, {sorted(os.sched_getaffinity(0))[0]})
        write(measure())
    draw(read())
    PAGE.write_text(page_with(PAGE, {"speed": lines(read())}), encoding="utf-8")


if __name__ == "__main__":
    main()
