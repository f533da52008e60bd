"""What a view comes to, solved by the library: for contact laws, files, and the verdict."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from math import isfinite, isnan

from carom.bodies.losses import ZENER, LossLaw, ZenerPlate
from carom.bodies.materials import Material
from carom.bodies.pairs import Pair
from carom.dimensionless.law import SOLID
from carom.dimensionless.solution import solve
from carom.dimensionless.states import History
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.page.views import OWN, PAGE, Refused, View, in_words
from carom.quantities.arrays import Array
from carom.quantities.prefixes import prefixed
from carom.quantities.refusals import InputError
from carom.quantities.verdicts import MARKS, Finding

KEPT_OUTCOMES = 16
FORCE_SCALE = 1.5  # F_x/(mu F_max) over Q of the theory
OF_PLATES = ("thickness", "inelasticity")  # what the library refuses where a plate is too thin
TOO_LARGE = "with the other numbers it leads to some that a computer cannot hold"


@dataclass(frozen=True, eq=False)
class Outcome:
    """An impact in plain numbers, and the scales of what is drawn over it."""

    psi_in: float
    psi_out: float
    chi: float
    kappa: float
    restitution: float
    losses: LossLaw | None  # that alone decide the restitution, at any speed
    lasts: float  # d_max/V_1
    force_scale: float  # mu times the largest force without losses, in the unit of the page

    @property
    def rubs(self) -> bool:
        """Whether there is a psi_1: without friction it is infinite."""
        return isfinite(self.psi_in)


def outcome_of(view: View) -> Outcome:
    """Solve what a view asks for, or raise InputError."""
    return _solved(replace(view, law=(), data=""))


@lru_cache(maxsize=KEPT_OUTCOMES)
def _solved(view: View) -> Outcome:
    with refusals("psi" if view.in_numbers else "friction"):
        return _of_numbers(view) if view.in_numbers else _of_bodies(view)


def impact_of(view: View) -> Impact:
    """Return the impact of the bodies of a view, or raise Refused."""
    with refusals("speed"):
        hit: Impact = impact(view.pair, losses=view.losses, **view.motion)
        return hit


def verdict(view: View) -> tuple[dict[str, str], ...]:
    """Return whether the theory holds for the bodies of a view; nothing is said of numbers."""
    if view.in_numbers:
        return ()
    with refusals("friction"):
        return told(impact_of(view).validity.findings, view.pair)


def told(findings: Iterable[Finding], pair: Pair) -> tuple[dict[str, str], ...]:
    """Return findings in the page's words, those first in which the theory does not hold.

    Each is told whole, and as `plain` in words without letters.
    """
    first = {False: 0, None: 1, True: 2}
    ordered = sorted(findings, key=lambda finding: first[finding.holds])
    return tuple(
        {
            "mark": MARKS[each.holds].strip(),
            "text": in_words(f"{each.label}: {each.verdict}"),
            "plain": plain(each, pair),
        }
        for each in ordered
    )


def plain(finding: Finding, pair: Pair) -> str:
    """Return what a finding comes to, with its number and the limit, in words of the page."""
    if finding.missing:
        lacks, _, _ = in_words(finding.verdict).removeprefix("not judged: ").partition("; ")
        return f"{lacks} is known" if lacks.startswith("no ") else lacks

    kind = "fails"
    if finding.holds is None:
        kind = "unknown" if isnan(finding.value) else "open"
    words = PAGE["verdicts"][kind].get(finding.name, "")
    if finding.holds or not words:
        return in_words(finding.verdict).removeprefix("not judged: ")
    value, limit = apart(finding.value, finding.limit)
    return str(words.format(softer=softer(pair), value=value, limit=limit))


def apart(value: float, limit: float) -> tuple[str, str]:
    """Return two numbers in as few digits, two at least, as tell them apart."""
    for digits in range(2, 9):
        told = [f"{float(f'{each:.{digits}g}'):g}" for each in (value, limit)]
        if told[0] != told[1]:
            break
    return told[0], told[1]


def softer(pair: Pair) -> str:
    """Return what the body is called that is pressed flatter."""

    def gives(stuff: Material) -> float:
        return 0.0 if stuff.is_rigid else (1.0 - stuff.poisson**2) / stuff.young

    first, second = pair.first.material, pair.second.material
    softest = first if gives(first) >= gives(second) else second
    if softest.name != OWN:
        return str(softest.name).replace("-", " ")
    return "the ball" if softest is first else "what it strikes"


@contextmanager
def refusals(field: str) -> Iterator[None]:
    """Refuse a field of the page where the library refuses: each is right by itself."""
    try:
        yield
    except Refused:
        raise
    except (InputError, ArithmeticError) as error:
        name, _, message = str(error).partition(": ")
        if name in OF_PLATES:
            raise Refused("thickness", in_words(message)) from None
        raise Refused(field, TOO_LARGE) from None


def _of_bodies(view: View) -> Outcome:
    hit = impact_of(view)
    pair = hit.pair
    give = pair.plate_give(hit.normal_speed)
    newtons, _ = prefixed(pair.friction * hit.max_force or hit.max_force, "N")
    return Outcome(
        psi_in=hit.psi_in,
        psi_out=hit.psi_out,
        chi=pair.chi,
        kappa=pair.kappa,
        restitution=hit.normal_restitution if give else view.restitution,
        losses=ZenerPlate(inelasticity=ZENER * give) if give else view.losses,
        lasts=hit.solution.duration,
        force_scale=pair.friction * hit.scales.force * newtons,
    )


def _of_numbers(view: View) -> Outcome:
    if not view.friction:
        raise Refused("friction", "must be above 0: without friction there is no ψ₁")
    solution = solve(view.psi, view.chi, losses=view.losses)
    return Outcome(
        psi_in=solution.psi_in,
        psi_out=solution.psi_out,
        chi=solution.chi,
        kappa=SOLID * solution.chi,
        restitution=solution.restitution if view.on_plate else view.restitution,
        losses=view.losses,
        lasts=solution.duration,
        force_scale=1.0,
    )


def columns_of_numbers(history: History) -> dict[str, Array]:
    """Return the columns of a history in units of the theory, by the names of those of bodies."""
    return {
        "time": history.time,
        "normal_force": history.normal_force,
        "tangential_force": FORCE_SCALE * history.force,
        "contact_velocity": history.psi,
        "normal_velocity": history.centre_speed,
        "contact_radius": history.contact_radius,
        "stick_radius": history.stick_radius,
        "contact_kinetic_energy": 0.5 * history.psi**2,
        "tangential_elastic_energy": history.stored,
        "frictional_work": history.dissipated,
        "shear_loss": history.shear_lost,
    }
