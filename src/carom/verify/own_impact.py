"""One impact of a user's own bodies: its angle and spin as contact laws have them, and exactly."""

from collections.abc import Sequence
from math import degrees
from typing import Any, NamedTuple

from carom.bodies.cases import Case, motion_of, pair_of
from carom.bodies.checks import checked_pair
from carom.bodies.observables import convert_observables
from carom.dimensionless.law import Law
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.verify.entries import called, damped
from carom.verify.errors import losses_of
from carom.verify.ranking import Ranking
from carom.verify.tables import text_table
from carom.verify.tuning import SPEEDS, TUNED, Tuning

OF_RANKING = ":<32s leaves~at:9.2f spin:9.4g off~by:7.3f at~worst:8.3f"
OF_TUNING = (
    ":<24s leaves~at:9.2f spin:9.4g at~worst:8.3f parameter:>24s value:8.4f leaves~at:9.2f"
    " spin:9.4g at~worst:8.3f steps:6d"
)
UNITS = "leaves at: degrees from the normal; spin: rad/s"


class Rebound(NamedTuple):
    """How the first body leaves: psi_2, the angle from the normal in rad, its spin in rad/s."""

    psi_out: float
    rebound_angle: float
    spin_out: float

    def cells(self) -> tuple[float, float]:
        """Return the angle in degrees and the spin, as tables have them."""
        return degrees(self.rebound_angle), self.spin_out


class OwnImpact:
    """An impact, solved exactly, and as contact laws with the same restitution have it."""

    def __init__(self, hit: Impact, restitution: float) -> None:
        self.hit, self.restitution = hit, restitution
        self.exact = Rebound(hit.psi_out, hit.rebound_angle, hit.spin_out)

    def by(self, law: Law) -> Rebound:
        """Return how the body leaves by a law, which is damped as the impact is."""
        hit = self.hit
        if self.restitution < 1.0 and hasattr(law, "restitution"):
            law = damped(law, self.restitution)
        psi_out = float(law.rebound(hit.psi_in, hit.pair.chi, kappa=hit.pair.kappa))
        known = {"normal_speed": hit.normal_speed, "tangential_speed": hit.tangential_speed}
        known |= {"spin": hit.spin, "normal_restitution": self.restitution, "psi_out": psi_out}
        if len(hit.pair.moving) == 2:
            known["spin2"] = hit.spin2
        wanted = ("rebound_angle", "spin_out")
        left = (convert_observables(hit.pair, known=known, wanted=name) for name in wanted)
        return Rebound(psi_out, *left)

    def verdict(self) -> str:
        """Return whether the theory holds for this impact, in one line, with what fails."""
        validity = self.hit.validity
        if validity.holds is True:
            return "The theory holds for this impact"
        wrong = [finding for finding in validity.findings if finding.holds is validity.holds]
        labels = ", ".join(finding.label for finding in wrong)
        if validity.holds is False:
            words = "The theory fails for this impact, and with it what laws are compared with"
        else:
            words = "Whether the theory holds for this impact is not judged"
        return f"{words}: {labels} (carom impact says more)"

    def to_dict(self, laws: Sequence[tuple[str, Law]]) -> dict[str, Any]:
        """Return the exact impact and that of named laws as what JSON can hold."""
        found = [{"law": name, **self.by(law)._asdict()} for name, law in laws]
        inputs = {"psi_in": self.hit.psi_in, "restitution": self.restitution}
        validity = self.hit.validity
        judged = {"verdict": validity.verdict, "validity": validity.records()}
        return {**judged, **inputs, "exact": self.exact._asdict(), "laws": found}

    def words(self) -> str:
        """Return what strikes how, in one line."""
        hit = self.hit
        normal, aside = f"{hit.normal_speed:.4g} m/s", f"{hit.tangential_speed:.4g} m/s"
        numbers = f"psi_1 = {hit.psi_in:.4g}, chi = {hit.pair.chi:.4g}, e = {self.restitution:g}"
        return f"Your impact: {normal} along the normal, {aside} aside; {numbers}"

    def of_ranking(self, ranking: Ranking) -> str:
        """Return the table of laws with this impact, the best first."""
        rows: list[Sequence[Any]] = [("exact", *self.exact.cells(), None, None)]
        for standing in ranking.standings:
            entry, left = standing.entry, self.by(standing.entry.law)
            off = abs(left.psi_out - self.exact.psi_out)
            rows.append((entry.label, *left.cells(), off, standing.max_error, entry.used_by))
        legend = f"{UNITS}; off by, at worst: |error in psi_2| here, and from psi_1 = "
        span = f"{min(ranking.psi_in):g} to {max(ranking.psi_in):g}"
        lines = [self.verdict(), self.words(), *text_table(OF_RANKING, rows)]
        return "\n".join([*lines, f"{legend}{span}"])

    def of_tuning(self, tuning: Tuning) -> str:
        """Return the table of laws with this impact, as they are by default and tuned."""
        given = {called(law): law for law in TUNED}
        rows: list[Sequence[Any]] = [("exact", *self.exact.cells(), *[None] * 7)]
        for one in tuning.advice:
            before, after = self.by(given[called(one.law)]), self.by(one.law)
            steps = one.step.steps if one.step else None
            tuned = (one.parameter, one.value, *after.cells(), one.max_error, steps)
            rows.append((called(one.law), *before.cells(), one.before, *tuned))
        span = f"{tuning.span[0]:.3g} to {tuning.span[1]:.3g}"
        return "\n".join(
            [
                self.words(),
                *text_table(OF_TUNING, rows),
                f"{UNITS}; first as the law is, then with its parameter tuned",
                f"at worst: |error in psi_2|, psi_1 from {span}, e = 1; steps: per contact, for a"
                " tenth of it",
            ]
        )


def own_impact(case: Case, restitution: float) -> OwnImpact | None:
    """Return the impact of a case with a restitution; None if the case says nothing of speeds."""
    motion = motion_of(case)
    if not {*SPEEDS} & {*motion}:
        return None
    hit = impact(checked_pair(pair_of(case)), losses=losses_of(restitution), **motion)
    return OwnImpact(hit, restitution)
