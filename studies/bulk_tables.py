"""The tables of docs/bulk_study.md, from the simulations that bulk_study.py has stored.

python studies/bulk_tables.py            write the tables into the page, draw that of docs/bulk.md
python studies/bulk_tables.py --check    only tell whether they are true
"""

import argparse
from collections.abc import Iterator
from itertools import product
from pathlib import Path

from bulk import modulus
from bulk.cells import both_ways, cooled, flowing, left, over_blocks, sheared, turned
from bulk.contact_laws import BESIDE, COARSE, EXACT, LAWS
from bulk.results import CELLS, Cell, Mean, excess, mean, ratio
from bulk_figures import draw
from page_blocks import as_maths, blocks, page_with, table

PAGE = Path(__file__).parents[1] / "docs" / "bulk_study.md"
FRICTIONS = (0.1, 0.3, 0.5)
OTHERS = LAWS[1:]
FLOWS = [*product((0.1, 0.3, 0.5), (1e-3, 1e-2, 1e-1))]
STRAINS = [strain for strain in modulus.STRAINS if strain != 3e-5]  # of which the modulus is told
STEEP = FRICTIONS[1:]  # with less, runs of one law differ by 6 degrees
DAMPED = [*((0.1, x) for x in (3e-5, 1e-4, 1e-3)), *((0.3, x) for x in modulus.STRAINS[1:])]


def decays() -> Iterator[str]:
    """Yield what each law leaves of the kinetic energy, over what the exact one leaves."""
    cases = [(mu, e) for e in (1.0, 0.9) for mu in FRICTIONS]
    exact = (f"{mean(left(EXACT.name, mu, e)).scaled(100.0).text(3)}" for mu, e in cases)
    yield f"exact (%) | {' | '.join(exact)}"
    for law in OTHERS:
        found = (ratio(left(law.name, mu, e)) for mu, e in cases)
        yield f"{law.name} | {' | '.join(each.text(2) for each in found)}"


def moduli() -> Iterator[str]:
    """Yield the modulus by the exact law, those by others over it."""
    for law in LAWS:
        cells = [sheared(law.name, 0.3, strain, "modulus") for strain in STRAINS]
        found = (mean(cell).scaled(1e3) if law is EXACT else ratio(cell) for cell in cells)
        yield f"{law.name} | {' | '.join(each.text(3) for each in found)}"


def dampings() -> Iterator[str]:
    """Yield the damping ratio by the exact law in percent, the excess of others over it."""
    for law in LAWS:
        cells = [sheared(law.name, *case, "damping") for case in DAMPED]
        found = (mean(cell) if law is EXACT else excess(cell) for cell in cells)
        yield f"{law.name} | {' | '.join(each.scaled(100.0).text(3) for each in found)}"


def flows(quantity: str, digits: int, cases: list[tuple[float, float]]) -> Iterator[str]:
    """Yield a quantity of simple shear by each law."""
    for law in LAWS:
        cells = (flowing(law.name, *case, quantity) for case in cases)
        yield f"{law.name} | {' | '.join(over_blocks(cell).text(digits) for cell in cells)}"


def drums() -> Iterator[str]:
    """Yield the slopes in the drum by each law."""
    for law in LAWS:
        found = [over_blocks(turned(law.name, mu, "turning")).text(1) for mu in STEEP]
        found += [mean(turned(law.name, mu, "rest")).text(1) for mu in STEEP]
        yield f"{law.name} | {' | '.join(found)}"


def circle() -> Iterator[str]:
    """Yield the energies of a gas by time stepping and by events, in percent of the first."""
    for friction in FRICTIONS:
        for quantity in ("translational", "rotational"):
            cells = []
            for time in (10.0, 40.0):
                stepped, events = both_ways(friction, quantity, time)
                percent = (each.scaled(100.0).text(2) for each in (stepped, events))
                cells += percent
            yield f"{friction}, {quantity} | {' | '.join(cells)}"


def gases() -> Iterator[str]:
    """Yield the energies of a gas by other laws over those by the exact one."""
    cases = [(name, time) for name in ("translational", "rotational") for time in (10.0, 40.0)]
    for law in OTHERS:
        found = (ratio(cooled(law.name, 0.3, *case)).text(2) for case in cases)
        yield f"{law.name} | {' | '.join(found)}"


POINTS = {  # one point of each experiment: cell, size of a larger one over its own, unit
    "kinetic energy left, friction 0.3, e = 1 (%)": (left(EXACT.name, 0.3, 1.0), 4, 100.0),
    "modulus (1e-3 E), strain 3e-4": (sheared(EXACT.name, 0.3, 3e-4, "modulus"), 4, 1e3),
    "damping ratio (%), strain 3e-4": (sheared(EXACT.name, 0.3, 3e-4, "damping"), 4, 100.0),
    "stress ratio, I = 0.01": (flowing(EXACT.name, 0.3, 1e-2, "ratio"), 4, 1.0),
    "turning drum (degrees)": (turned(EXACT.name, 0.3, "turning"), 1.5, 1.0),
}


def of_two(cell: Cell, unit: float) -> str:
    """Return the mean of seeds 1 and 2 with its standard error, a dash if they are not there."""
    if cell not in CELLS:
        return "-"
    one, other = (unit * CELLS[cell][seed] for seed in (1, 2))
    return Mean((one + other) / 2, abs(one - other) / 2).text(3 if one < 10.0 else 2)


def converged() -> Iterator[str]:
    """Yield one point of each experiment, then with a finer step, more spheres, another law."""
    for name, (cell, larger, unit) in POINTS.items():
        changes = [{}, {"step": 0.5}, {"size": round(larger * cell.size)}]
        cells = [cell._replace(**change) for change in changes]
        if cell.law == EXACT.name:
            cells += [cell._replace(law=law.name) for law in (COARSE, BESIDE)]
            cells += [each._replace(law=LAWS[1].name) for each in cells[:3]]
        cells += [cell._replace(law="")] * (8 - len(cells))
        yield f"{name} | {' | '.join(of_two(each, unit) for each in cells)}"


def by_laws(first: str, cases: list[str], rows: Iterator[str]) -> str:
    """Return a table of cases below each other, from rows of laws: they are beside each other."""
    laws, *columns = zip(*(row.split(" | ") for row in rows), strict=True)
    lines = (" | ".join([case, *column]) for case, column in zip(cases, columns, strict=True))
    return table(" | ".join([first, *laws]), lines)


def tables() -> dict[str, str]:
    """Return the blocks of the page by name."""
    boosted = [f"{e}, {mu}" for e in (1, 0.9) for mu in FRICTIONS]
    strains = [f"{strain:g}" for strain in STRAINS]
    damped = [f"{mu}, {strain:g}" for mu, strain in DAMPED]
    dense = [case for case in FLOWS if case[0] > FRICTIONS[0]]
    shears, fewer = ([f"{mu}, {inertia:g}" for mu, inertia in each] for each in (FLOWS, dense))
    slopes = [f"{when}, {mu}" for when in ("turning", "at rest") for mu in STEEP]
    kinds = ("stepped", "events")
    times = " | ".join(f"{kind}, {time}" for time in (10, 40) for kind in kinds)
    other = "law | translational, 10 | 40 | rotational, 10 | 40"
    more = "half the step | larger"
    found = {
        "decay": by_laws("restitution, friction", boosted, decays()),
        "modulus": by_laws("strain", strains, moduli()),
        "damping": by_laws("friction, strain", damped, dampings()),
        "ratio": by_laws("friction, $I$", shears, flows("ratio", 3, FLOWS)),
        "fraction": by_laws("friction, $I$", fewer, flows("fraction", 4, dense)),
        "drum": by_laws("drum, friction", slopes, drums()),
        "circle": table(f"friction, energy | {times}", circle()),
        "gas": table(other, gases()),
        "converged": table(
            f"point | exact | {more} | 16 springs | beside granular | mindlin | {more}", converged()
        ),
    }
    return {name: as_maths(text) for name, text in found.items()}


def main() -> None:
    """Write the tables and figures, or check the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only tell whether they are true")
    if parser.parse_args().check:
        wrong = [name for name, text in tables().items() if blocks(PAGE)[name] != text]
        print(f"no longer true: {', '.join(wrong)}" if wrong else "all is true")
        raise SystemExit(1 if wrong else 0)
    PAGE.write_text(page_with(PAGE, tables()), encoding="utf-8")
    draw()


if __name__ == "__main__":
    main()
