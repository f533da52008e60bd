"""`fit` with what happens in laboratories: a bad value, heavy tails, mistakes in the table."""

import re

import numpy as np
import pytest
from scipy.stats import binom

import carom
from carom.lab.fitting import fit

FLOOR = carom.HalfSpace(material="steel")
MU, SPEED, ROWS = 0.12, 3.9, 12
ANGLES = np.radians(np.linspace(4.0, 65.0, ROWS))
SIGMA = {"rebound_angle": 0.006, "spin_out": 8.0, "normal_restitution": 0.01}
SPEEDS = ("normal_speed_out", "tangential_speed_out", "spin_out")


def bodies(radius=2.5e-3, friction=0.3):
    return carom.Pair(carom.Sphere(radius=radius, material="steel"), FLOOR, friction=friction)


KAPPA = bodies().kappa


def exact(names, restitution=0.95, speed=SPEED, angles=ANGLES, friction=MU):
    """What `impact` gives, without noise."""
    losses = carom.KelvinVoigt(restitution=restitution)
    hits = [
        carom.impact(bodies(friction=friction), speed=v, angle=a, losses=losses)
        for v, a in zip(np.broadcast_to(speed, len(angles)), angles, strict=True)
    ]
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in names}


@pytest.fixture(scope="module")
def truth():
    return exact(SIGMA)


def noisy(truth, random, draw=None):
    """A table with noise, in standard deviations as `draw` gives it."""
    normal = draw or (lambda: random.normal(size=ROWS))
    before = {"angle": ANGLES, "speed": np.full(ROWS, SPEED)}
    return before | {name: truth[name] + size * normal() for name, size in SIGMA.items()}


def hold_the_truth(tables, **options):
    """Assert that 95 % intervals miss no more often than is likely for 90 %, 1 in 1000.

    The study with 2000 sets a design tells 94 to 97 %; intervals that hold 80 % are noticed here.
    """
    by_name = {"friction": MU, "kappa": KAPPA, "restitution": 0.95}
    values = [fit(table, pair=bodies(), **options) for table in tables]
    most = binom.ppf(1.0 - 1e-3, len(values), 0.1)
    for name, value in by_name.items():
        inside = [each[name].low <= value <= each[name].high for each in values]
        assert len(inside) - sum(inside) <= most, name


def with_outliers(random):
    """Of 25 values one is 8 to 25 standard deviations off."""

    def draw():
        far = random.uniform(8.0, 25.0, ROWS) * random.choice([-1.0, 1.0], ROWS)
        return np.where(random.random(ROWS) < 0.04, far, random.normal(size=ROWS))

    return draw


@pytest.mark.slow
def test_intervals_hold_with_outliers_and_stated_errors(truth):
    stated = {f"{name}_error": np.full(ROWS, size) for name, size in SIGMA.items()}
    random = np.random.default_rng(1)
    hold_the_truth([noisy(truth, random, with_outliers(random)) | stated for _ in range(40)])


@pytest.mark.slow
def test_intervals_hold_with_heavy_tails(truth):
    random = np.random.default_rng(2)
    tables = [noisy(truth, random, lambda: random.standard_t(4, ROWS)) for _ in range(40)]
    hold_the_truth(tables)


@pytest.mark.slow
def test_intervals_hold_where_speeds_scatter_by_a_share():
    """3 % of speeds from 0.5 to 8 m/s; with one scatter for all, intervals hold 65 %."""
    random = np.random.default_rng(3)
    speed = random.permutation(np.geomspace(0.5, 8.0, ROWS))
    seen = exact(SPEEDS, speed=speed)
    tables = [
        {"angle": ANGLES, "speed": speed}
        | {name: v * (1.0 + 0.03 * random.normal(size=ROWS)) for name, v in seen.items()}
        for _ in range(40)
    ]
    hold_the_truth(tables)


@pytest.mark.slow
def test_correlations_are_those_of_the_fit_by_lmfit(truth):
    """From derivatives of its own, which leastsq takes."""
    result = fit(noisy(truth, np.random.default_rng(13)), pair=bodies())
    for name, others in result.correlations.items():
        assert others[name] == pytest.approx(1.0)
        for other, value in result.lmfit_result.params[name].correl.items():
            assert others[other] == pytest.approx(value, abs=1e-3)
    assert result.to_dict()["correlations"] == result.correlations
    assert f"friction and kappa {result.correlations['friction']['kappa']:+.2f}" in str(result)


@pytest.mark.slow
def test_correlations_are_those_of_repeated_experiments(truth):
    """Least squares of 120 sets with one truth; Fisher's z is uncertain by 1/sqrt(117)."""
    random, names = np.random.default_rng(14), ("friction", "kappa", "restitution")
    stated = {f"{name}_error": np.full(ROWS, size) for name, size in SIGMA.items()}
    fits = [fit(noisy(truth, random) | stated, pair=bodies(), robust=False) for _ in range(120)]
    among = np.corrcoef([[each[name].value for each in fits] for name in names])
    for one, other in ((0, 1), (0, 2), (1, 2)):
        told = np.median([each.correlations[names[one]][names[other]] for each in fits])
        assert np.arctanh(told) == pytest.approx(np.arctanh(among[one, other]), abs=0.3)


FEW = np.radians(np.linspace(20.0, 75.0, 9))
COLUMNS = ("normal_restitution", "tangential_restitution", "rebound_angle")


@pytest.fixture(scope="module")
def few():
    """Nine impacts of friction 0.14, without noise; none of them is near the normal."""
    return exact(COLUMNS, angles=FEW, friction=0.14)


def with_a_bad_value(few, seed):
    """3 % on restitutions, 0.5 degrees on angles, and one restitution 35 % off."""
    random = np.random.default_rng([48, seed])
    table = {"angle": FEW}
    for name, values in few.items():
        size = np.radians(0.5) if "angle" in name else 0.03 * values
        table[name] = values + size * random.normal(size=len(FEW))
    name, row = random.choice(COLUMNS[:2]), random.integers(len(FEW))
    table[name][row] *= random.choice([0.65, 1.35])
    return table


@pytest.mark.slow
def test_one_bad_value_does_not_drive_friction_away(few):
    """Friction ran to 1.1 in some 3 % of the sets, with a kappa of 1.9 that bodies cannot have."""
    fits = [fit(with_a_bad_value(few, seed), pair=bodies()) for seed in range(60)]
    for value, name in ((0.14, "friction"), (KAPPA, "kappa"), (0.95, "restitution")):
        inside = [each[name].low <= value <= each[name].high for each in fits]
        assert len(fits) - sum(inside) <= binom.ppf(1.0 - 1e-3, len(fits), 0.05), name
        if name != "restitution":
            assert all(value / 1.3 < each[name].value < 1.3 * value for each in fits)


@pytest.mark.slow
def test_a_minimum_that_bodies_cannot_have_gives_way_to_one_that_they_can(few):
    """Where it is not clearly better. An interval that is cut says where, and why."""
    cut = told = 0
    for seed in range(12):
        result = fit(with_a_bad_value(few, seed), pair=bodies())
        assert 2.0 / 3.0 <= result.kappa.low < result.kappa.high <= 1.0
        assert result.chi.high == pytest.approx(1.75 * result.kappa.high)
        at_bound = result.kappa.low == 2.0 / 3.0 or result.kappa.high == 1.0
        ends = [note for note in result.notes if "kappa: the interval ends at" in note]
        assert bool(ends) == at_bound
        cut += at_bound
        told += any("other values would fit better, but not clearly" in n for n in result.notes)
    assert cut
    assert told


def test_an_interval_that_is_cut_ends_elsewhere_where_chi_squared_has_risen(few):
    """By fits with kappa held, of lmfit: by 6.63 for 99 % at a free end, by less at a bound."""
    table = {"angle": FEW}
    for name, values in few.items():
        size = np.radians(0.5) if "angle" in name else 0.03 * np.abs(values)
        noise = np.random.default_rng([19, len(name)]).normal(size=len(FEW))
        table |= {name: values + size * noise, f"{name}_error": np.broadcast_to(size, len(FEW))}

    def chi_squared(**fixed):
        return fit(table, pair=bodies(), fixed=fixed, robust=False).lmfit_result.chisqr

    kappa = fit(table, pair=bodies(), robust=False, confidence=0.99).kappa
    least = chi_squared()
    ends = {end: chi_squared(kappa=end) - least for end in (kappa.low, kappa.high)}
    bounds = {end for end in ends if end in (2.0 / 3.0, 1.0)}
    assert len(bounds) == 1
    for end, rise in ends.items():
        assert rise < 6.6 if end in bounds else rise == pytest.approx(6.6349, rel=0.01)


def test_bodies_of_a_negative_poisson_ratio_keep_their_own_kappa():
    material = carom.Material(young=1e6, poisson=-0.5, density=200.0)
    ball = carom.Sphere(radius=2.5e-3, material=material)
    pair = carom.Pair(ball, carom.HalfSpace(material=material), friction=MU)
    assert pair.kappa > 1.1
    hits = [carom.impact(pair, speed=0.1, angle=angle) for angle in ANGLES]
    noise = np.random.default_rng(12).normal(0.0, 0.003, ROWS)
    table = {"angle": ANGLES, "contact_restitution": [h.contact_restitution for h in hits] + noise}
    result = fit(table, pair=pair, fixed={"restitution": 1.0})
    assert result.kappa.low < pair.kappa < result.kappa.high <= 4.0 / 3.0


def first_law(table):
    return min(fit(table, pair=bodies()).comparison, key=lambda each: each.excess).law


@pytest.mark.first_case
@pytest.mark.parametrize("seed", range(3))
def test_one_spin_mistyped_does_not_change_which_law_comes_first(truth, seed):
    random = np.random.default_rng([4, seed])
    table = noisy(truth, random)
    row = random.integers(ROWS)
    spins = table["spin_out"].copy()
    spins[row] *= random.choice([3.5, 10.0, 0.1])
    assert first_law(table) == "exact"
    assert first_law({**table, "spin_out": spins}) == "exact"


@pytest.mark.slow
def test_an_outlier_is_left_out_for_all_laws_and_the_errors_are_those_of_the_best(truth):
    """With one bad spin the laws stand as without that value, to the scatter of one value."""
    table = noisy(truth, np.random.default_rng(5))
    gap, spoilt = [], list(table["spin_out"])
    for value in ("-", spoilt[3] * 10.0):
        spoilt[3] = value
        comparison = fit({**table, "spin_out": list(spoilt)}, pair=bodies()).comparison
        gap.append(comparison["rigid Coulomb"].excess)
    assert gap[1] == pytest.approx(gap[0], rel=0.05)


def test_a_kappa_that_bodies_cannot_have_is_questioned(truth):
    """Spins of a ball of half the size: kappa 0.3 or so, beside 0.82 of the elastic constants."""
    table = noisy(truth, np.random.default_rng(6))
    assert not any("elastic" in note for note in fit(table, pair=bodies()).notes)
    result = fit({**table, "spin_out": 0.5 * table["spin_out"]}, pair=bodies())
    assert result.kappa.elastic == pytest.approx(KAPPA)
    assert any("kappa is 2/3 to 1 for elastic bodies" in note for note in result.notes)


def turned(table):
    """Angles from the surface."""
    return table | {name: np.pi / 2.0 - table[name] for name in ("angle", "rebound_angle")}


def in_radians(table):
    return {f"{n} [deg]" if "angle" in n else n: v for n, v in table.items()}


def spins(factor):
    return lambda table: table | {"spin_out": factor * table["spin_out"]}


def exchanged(table):
    """Components before and after in each other's columns."""
    seen = exact(SPEEDS)
    before = {"normal_speed": SPEED * np.cos(ANGLES), "tangential_speed": SPEED * np.sin(ANGLES)}
    noise = np.random.default_rng(8).normal(0.0, 0.02, (2, ROWS))
    names = (("normal_speed", "normal_speed_out"), ("tangential_speed", "tangential_speed_out"))
    both = {}
    for (one, other), error in zip(names, noise, strict=True):
        both |= {one: seen[other] + error, other: before[one]}
    return both | {"spin_out": table["spin_out"]}


def of_the_centre(table):
    """The tangential restitution of the centre as that of the contact point."""
    seen = exact(["tangential_restitution"])["tangential_restitution"]
    noise = np.random.default_rng(9).normal(0.0, 0.01, ROWS)
    rest = {name: values for name, values in table.items() if name != "rebound_angle"}
    return rest | {"contact_restitution": seen + noise}


MISTAKES = {
    "angles from the surface": (turned, 2.5e-3),
    "angles in radians": (in_radians, 2.5e-3),
    "spins in rpm": (spins(30.0 / np.pi), 2.5e-3),
    "spins in rad/s, not in rpm": (spins(np.pi / 30.0), 2.5e-3),
    "those of half the radius": (dict, 5e-3),
    "those of twice the radius": (dict, 1.25e-3),
    "the motion before and the motion after exchanged": (exchanged, 2.5e-3),
    "tangential_restitution in the column contact_restitution": (of_the_centre, 2.5e-3),
}


@pytest.mark.first_case
@pytest.mark.parametrize("words", MISTAKES)
def test_usual_mistakes_are_named(truth, words):
    change, radius = MISTAKES[words]
    result = fit(change(noisy(truth, np.random.default_rng(7))), pair=bodies(radius))
    entries = [note for note in result.notes if note.startswith("these data fit as")]
    assert len(entries) == 1
    assert words in entries[0]


def test_spins_of_the_other_sign_are_named_where_they_are_not_refused(truth):
    """With a spin before, friction drives some spins on and brakes others whatever the sign."""
    start = np.where(np.arange(ROWS) % 2, 300.0, -300.0)
    hits = [
        carom.impact(bodies(friction=MU), speed=SPEED, angle=angle, spin=-spin)
        for angle, spin in zip(ANGLES, start, strict=True)
    ]
    noise = np.random.default_rng(10).normal(0.0, 8.0, ROWS)
    table = {"angle": ANGLES, "speed": np.full(ROWS, SPEED), "spin": start}
    table["spin_out"] = noise - [hit.spin_out for hit in hits]
    table["rebound_angle"] = [hit.rebound_angle for hit in hits]
    result = fit(table, pair=bodies(), fixed={"restitution": 1.0})
    assert any("spins of the other sign" in note for note in result.notes)


@pytest.mark.first_case
@pytest.mark.parametrize("seed", range(6))
def test_clean_data_are_not_called_mistaken(truth, seed):
    result = fit(noisy(truth, np.random.default_rng([11, seed])), pair=bodies())
    assert not any(note.startswith("these data fit as") for note in result.notes)


SIDES = ("rebound_angle", "spin_out", "normal_restitution", "tangential_restitution")


@pytest.fixture(scope="module")
def sides():
    return exact(SIDES, restitution=0.9)


def seen_from(sides, seed, from_surface):
    """A table of one or two responses, with 1 to 6 % of noise, and angles from either side."""
    random = np.random.default_rng([48, seed])
    chosen = random.choice(SIDES, random.integers(1, 3), replace=False)
    noise = random.choice([0.01, 0.03, 0.06])
    table = {"angle": ANGLES, "speed": np.full(ROWS, SPEED)}
    for name in chosen:
        size = np.radians(20.0 * noise) if "angle" in name else noise * np.median(sides[name])
        table[name] = sides[name] + abs(size) * random.normal(size=ROWS)
    if from_surface:
        table |= {name: np.pi / 2.0 - table[name] for name in table if "angle" in name}
    return chosen, table


def about_angles(result):
    return [note for note in result.notes if note.startswith("these data fit as angles")]


@pytest.mark.first_case
@pytest.mark.parametrize("seed", range(21, 24))
def test_angles_from_the_surface_are_noticed_where_the_fit_is_good_and_wrong(seed):
    """Angles to a degree, spins to a tenth: a friction of 0.22 to 0.25 for 0.14, a good fit."""
    angles, random = np.radians(np.arange(10.0, 50.0, 3.0)), np.random.default_rng(seed)
    sides = exact(("rebound_angle", "spin_out"), restitution=0.9, angles=angles, friction=0.14)
    rebound, spin = sides.values()
    rebound = rebound + random.normal(0.0, 0.02, len(angles))
    spin = spin + random.normal(0.0, 0.1 * np.median(np.abs(spin)), len(angles))
    speeds = {"speed": np.full(len(angles), SPEED), "spin_out": spin}
    before, after = np.pi / 2.0 - angles, np.pi / 2.0 - rebound
    wrong = fit({"angle": before, "rebound_angle": after, **speeds}, pair=bodies())
    right = fit({"surface_angle": before, "surface_angle_out": after, **speeds}, pair=bodies())
    (note,) = about_angles(wrong)
    assert "as angles from the surface" in note
    told = float(re.search(r"with friction ([\d.]+)", note)[1])
    assert told == pytest.approx(right.friction.value, abs=0.01)
    assert right.friction.low < 0.14 < right.friction.high
    assert not wrong.friction.low < 0.14 < wrong.friction.high
    assert not about_angles(right)


@pytest.mark.slow
def test_angles_from_the_other_side_are_mostly_noticed_and_right_ones_never_doubted(sides):
    """A study of 700 sets has no false alarm and finds four in five; without the angles, three."""
    doubted = noticed = 0
    for seed in range(100):
        for from_surface in (False, True):
            _, table = seen_from(sides, seed, from_surface)
            told = bool(about_angles(fit(table, pair=bodies())))
            doubted += told and not from_surface
            noticed += told and from_surface
    assert doubted <= 1
    assert noticed >= 80


@pytest.mark.slow
def test_advice_halves_the_interval():
    """As many further impacts as `advice` says, where it says: the median of 5 within 10 %.

    studies/fit_advice.csv has 0.45 to 0.50 of 60 sets, with and without stated errors.
    """
    ratios = []
    for seed in range(5):
        random = np.random.default_rng([20261124, seed])

        def table(angles, random=random):
            data = {"angle": angles, "speed": np.full(len(angles), SPEED)}
            values = exact(SIGMA, angles=angles)
            for name, size in SIGMA.items():
                data[name] = values[name] + size * random.normal(size=len(angles))
                data[f"{name}_error"] = np.full(len(angles), size)
            return data

        first = table(ANGLES)
        before = fit(first, pair=bodies())
        best = before.advice(1, "kappa").best
        more = table(np.full(best.needed, best.angle))
        after = fit({key: np.concatenate([first[key], more[key]]) for key in first}, pair=bodies())
        ratios.append((after.kappa.high - after.kappa.low) / (before.kappa.high - before.kappa.low))
    assert np.median(ratios) == pytest.approx(0.5, rel=0.1)
