"""The study behind the validity of the theory, studies/halfspace_*: it holds, and is current.

Full solutions of impacts by boundary elements, over the whole domain of the bounds, and what they
differ by from the theory, which is exact at nu = 0.
"""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from carom.dimensionless.neglected import not_studied, rebound_error
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin
from carom.halfspace.solution import Resolution, solve

STUDIES = Path(__file__).parents[2] / "studies"
PAGE = (STUDIES.parent / "docs/halfspace_study.md").read_text(encoding="utf-8")
sys.path.insert(0, str(STUDIES))

import halfspace_differences as study  # noqa: E402
import halfspace_tables as tables  # noqa: E402
from halfspace_study import TABLE, load  # noqa: E402


@pytest.fixture(scope="module")
def judged():
    """Error and estimate of the 200 impacts on 32 elements, with psi_1 - 1."""
    values = [
        (*one, case[2] - 1.0)
        for kind in ("nu 0", "like", "unlike")
        for one, case in zip(
            study.estimates(kind, 32),
            [c for c in study.cases("judge") if c[1].startswith(f"{kind} ")],
            strict=True,
        )
    ]
    return np.array(values).T


def test_the_estimate_covers_the_error(judged):
    """In 95 % of 200 impacts, and of those near psi_1 = 1, where the order is lowest."""
    error, estimate, off = judged
    assert error.size == 200
    covered = error <= estimate
    assert covered.mean() >= 0.95
    near = np.abs(off) <= 0.1
    assert near.sum() >= 30
    assert covered[near].mean() >= 0.95


def test_the_estimate_tells_something(judged):
    """It is not much larger than the errors themselves: half within 40 times."""
    error, estimate, _ = judged
    assert np.median(estimate) <= 40.0 * np.median(error)
    assert np.quantile(estimate, 0.95) <= 30.0 * np.quantile(error, 0.95)


@pytest.mark.parametrize("kind", ["nu 0", "like"])
def test_the_default_grid_is_right_to_1e_4(kind):
    """Like materials on 64 elements: half within 1e-5; 1e-4 up to chi = 2, 3e-4 up to 8."""
    error = np.array([one.error for one in study.estimates(kind, 64)])
    chi = np.array(
        [study.finest(c)[0].chi for c in study.cases("judge") if c[1].startswith(f"{kind} ")]
    )
    assert error.size == 80
    assert np.median(error) <= 1e-5
    assert error[chi <= 2.0].max() <= 1e-4
    assert error.max() <= 3e-4


@pytest.mark.parametrize("label", [*tables.SERIES, *tables.APART, *tables.APART_SPIN])
def test_bounds_hold(label):
    """Each impact is inside the domain and within its bound; those kept apart, too."""
    for one in study.judged(label):
        impact = study.finest(one.case)[0]
        numbers = impact.kappa, impact.beta, impact.friction, impact.chi
        assert not_studied(*numbers) == "", one
        assert one.size <= one.bound, one


@pytest.mark.parametrize("label", tables.SERIES)
def test_bounds_are_not_idle(label):
    """Some impact of each series comes to a third of its bound."""
    shares = [one.size / one.bound for one in study.judged(label)]
    assert max(shares) > 0.3


def test_what_is_kept_apart_is_many():
    """100 impacts that no bound has seen, and 50 with spin."""
    counts = [
        sum(len(study.judged(one)) for one in set_) for set_ in (tables.APART, tables.APART_SPIN)
    ]
    assert counts == [100, 50]


@pytest.mark.slow
@pytest.mark.parametrize("beyond", [10.0, 200.0])
@pytest.mark.parametrize(("chi", "beta", "friction"), [(1.5, 0.5, 1.0), (7.0, 0.4, 0.05)])
def test_bounds_hold_far_beyond_sliding(chi, beta, friction, beyond):
    """Differences fall slowly there: the bound stays what it is where the study ends."""
    psi, grid = 4.0 * chi - 1.0 + beyond, Resolution(8, 38)
    full, plain = (
        solve(psi, chi, materials, grid).psi_out
        for materials in (Materials(0.85, beta, friction), Materials(1.0))
    )
    assert 1e-6 < abs(full - plain) <= rebound_error(0.85, beta, friction, chi, psi)


@pytest.mark.first_case
@pytest.mark.parametrize(
    "label",
    ["solid", "unlike", "spin"]
    + [
        pytest.param(one, marks=pytest.mark.slow)
        for one in ("like", "pair", "apart unlike", "judge")
    ],
)
def test_rows_are_those_of_the_code(label):
    """The coarsest impact of a series computed again: only rounding and tolerances may differ."""
    stored = {i: row for i, row in load(TABLE).items() if i.label == label}
    impact = min(stored, key=lambda one: (one.elements, one.case))
    again = solve(
        impact.psi_1,
        impact.chi,
        Materials(impact.kappa, impact.beta, impact.friction),
        Resolution(impact.elements, impact.steps),
        spin=NormalSpin(impact.spin, impact.lightness),
    )
    assert again.psi_out == pytest.approx(stored[impact].psi_2, abs=2e-5)
    assert again.restitution == pytest.approx(stored[impact].restitution, abs=1e-6)


SERIES = (*tables.SERIES, *tables.APART, *tables.APART_SPIN)
TELLING = ("README.md", "docs/halfspace.md", "docs/halfspace_study.md", "paper/paper.md")


def test_prose_counts_impacts_as_the_table_does():
    """Rows are solutions on several grids: the impacts that are judged are fewer, and those with a
    comma in their number are no others."""
    judged = {label: len(study.judged(label)) for label in SERIES}
    solved = {impact._replace(label="", case="", elements=0, steps=0) for impact in load(TABLE)}
    by_name = {
        "impacts were solved and compared": sum(judged.values()),
        "of them with spin": sum(n for label, n in judged.items() if "spin" in label),
        "impacts": len(solved),
        "of them at": sum(one.kappa == 1.0 and not one.beta for one in solved),
        "solutions": len(load(TABLE)),
    }
    page = " ".join(PAGE.split())
    for words, count in by_name.items():
        if words != "impacts":
            assert f"{count:,} {words}" in page, words
    assert f"the study has {len(solved):,} impacts" in page
    for name in TELLING:
        text = " ".join((STUDIES.parent / name).read_text(encoding="utf-8").split())
        text = text.replace("[1,500 impacts](docs/validity.md", "")  # those of waves in walls
        counts = set(re.findall(r"(\d,\d{3}) (?:impacts|full|solutions)", text))
        assert f"{sum(judged.values()):,}" in counts, name
        allowed = {f"{count:,}" for count in by_name.values()} if "_study" in name else set()
        assert counts <= allowed | {f"{sum(judged.values()):,}"}, name


def test_prose_tells_the_largest_differences_of_the_table():
    """Differences, not bounds, of each kind of bodies without spin: README and pages."""

    def largest(*labels):
        values = [case for label in labels for case in study.cases(label)]
        return max((abs(study.difference(case).value), case) for case in values)

    solid, like, pair, unlike = (
        largest(*labels)
        for labels in (("solid",), ("like", "apart like"), ("pair",), ("unlike", "apart unlike"))
    )
    readme = " ".join((STUDIES.parent / "README.md").read_text(encoding="utf-8").split())
    assert (
        f"{solid[0]:.4f} for solid spheres of like materials, {like[0]:.4f} for other bodies of "
        f"like materials, {pair[0]:.2f} for five real pairs of unlike materials and"
    ) in readme
    assert f"{unlike[0]:.1f} for any unlike materials" in readme
    page, one = " ".join(PAGE.split()), study.finest(like[1])[0]
    assert f"by {1e3 * like[0]:.1f}e-3 at $\\chi$ = {one.chi:.1f}" in page
    one = study.finest(unlike[1])[0]
    said = (
        rf"-{unlike[0]:.2f}, for $\beta$ = {one.beta:.2g}, friction {one.friction:.2g} and $\chi$ "
    )
    assert f"{said}= {one.chi:.1f} at $\\psi_1$ = {one.psi_1:.1f}" in page
    # in units of nu^2, as the pages of the theory have it; the bound is 0.011 chi nu^2
    shares = [
        abs(study.difference(case).value) / poisson(study.finest(case)[0]) ** 2
        for case in study.cases("solid")
        if poisson(study.finest(case)[0])
    ]
    for name in ("docs/theory.md", "docs/theory/full_contact.md"):
        text = (STUDIES.parent / name).read_text(encoding="utf-8")
        (said,) = re.findall(r"at most \$(0\.\d+) (?:\\, )?\\nu\^2\$", text)
        assert said == f"{max(shares):.3f}"


def poisson(impact):
    """Poisson's ratio of like materials with this kappa."""
    return 2.0 * (1.0 - impact.kappa) / (2.0 - impact.kappa)


def test_the_page_tells_what_the_table_holds():
    """Every row of the tables on docs/halfspace_study.md is computed from it."""
    values = (
        *(tables.error_table(), tables.like_table(), tables.pair_table(), tables.slip_table()),
        tables.bound_table(tables.SERIES | tables.APART | tables.APART_SPIN),
    )
    lines = [line for table in values for line in table]
    assert len(lines) > 35
    assert [line for line in lines if line not in PAGE.splitlines()] == []
