"""Joint fits of several sets of rebounds, beside one table, sums of profiles, means of drops."""

from functools import cache

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from scipy.stats import chi2, t as student, ttest_ind
from tests.checks import refused

import carom
from carom.lab.fitting import fit, joint_fit

STEEL = carom.HalfSpace(material="steel")
DEGREES = np.array([12.0, 25.0, 38.0, 50.0, 61.0, 72.0])
NOISE = 0.01


def pair_of(radius="5 mm", friction=0.15, wall=STEEL):
    return carom.Pair(carom.Sphere(radius=radius, material="steel"), wall, friction=friction)


@cache
def exact(radius, friction, e):
    losses = carom.KelvinVoigt(restitution=e)
    pair = pair_of(radius, friction)
    hits = [carom.impact(pair, speed=1.0, angle=f"{a} deg", losses=losses) for a in DEGREES]
    names = ("normal_restitution", "tangential_restitution")
    return {name: np.array([getattr(hit, name) for hit in hits]) for name in names}


def measured(seed, radius="5 mm", friction=0.15, e=0.9, error=NOISE):
    """Return six impacts with normal noise, and its size."""
    random = np.random.default_rng(seed)
    data = {"angle [deg]": DEGREES, "speed": np.ones(6)}
    for name, values in exact(radius, friction, e).items():
        data[name] = values + random.normal(0.0, error, 6)
        data[name + "_error"] = np.full(6, error)
    return data


def stacked(*sets):
    return {name: np.concatenate([each[name] for each in sets]) for name in sets[0]}


@pytest.mark.first_case
@pytest.mark.parametrize("robust", [False, True])
def test_sets_that_share_everything_are_one_table(robust):
    """Equal bodies, errors stated, all shared: values, intervals, correlations are those of it."""
    sets, how = [measured(1), measured(2)], {"pair": pair_of(), "robust": robust}
    joint = joint_fit(sets, share=("friction", "kappa", "restitution"), **how)
    whole = fit(stacked(*sets), **how)
    for name in ("friction", "kappa", "chi", "restitution"):
        width = whole[name].high - whole[name].low
        for part in joint.fits.values():
            for end in ("value", "low", "high"):
                actual, expected = getattr(part[name], end), getattr(whole[name], end)
                assert actual == pytest.approx(expected, abs=4e-3 * width)
    for part in joint.fits.values():
        actual = part.correlations["friction"]["kappa"]
        assert actual == pytest.approx(whole.correlations["friction"]["kappa"], abs=2e-3)
        assert part.advice(3, "friction").shorter == pytest.approx(
            whole.advice(3, "friction").shorter, rel=2e-3
        )


@pytest.mark.slow
@pytest.mark.parametrize("name", ["friction", "kappa"])
def test_a_shared_parameter_has_the_sum_of_the_profiles(name):
    """Balls of two sizes and restitutions: where losses of fits alone with it held add up to."""
    sets = [measured(3), measured(4, "3 mm", e=0.8)]
    pairs = [pair_of(), pair_of("3 mm")]
    joint = joint_fit(sets, share=name, pair=pairs, robust=False)

    @cache
    def loss(value):
        fits = [
            fit(data, pair=pair, fixed={name: value}, robust=False)
            for data, pair in zip(sets, pairs, strict=True)
        ]
        return sum(each.lmfit_result.chisqr for each in fits)

    shared = [part[name] for part in joint.fits.values()]
    middle, width = shared[0].value, shared[0].high - shared[0].low
    guess = middle - width, middle + width
    best = minimize_scalar(loss, bounds=guess, method="bounded", options={"xatol": 1e-5})
    rise = chi2.ppf(0.95, 1)
    ends = [brentq(lambda v: loss(v) - best.fun - rise, best.x, end, xtol=1e-5) for end in guess]
    assert shared[0].value == shared[1].value
    assert shared[0].value == pytest.approx(best.x, abs=0.01 * width)
    assert (shared[0].low, shared[0].high) == pytest.approx(ends, abs=0.01 * width)
    assert joint["set 1"].restitution.value == pytest.approx(0.9, abs=0.02)
    assert joint["set 2"].restitution.value == pytest.approx(0.8, abs=0.02)


def test_a_plate_struck_by_two_balls_has_one_thickness():
    """Balls of two sizes: the sum of profiles over a thickness that each fit scales for itself."""
    plate = carom.HalfSpace("steel", thickness="4 mm")
    sets, pairs, random = [], [], np.random.default_rng(5)
    for radius in ("5 mm", "3 mm"):
        pairs.append(pair_of(radius, wall=plate))
        speeds = np.array([0.2, 0.4, 0.8, 1.6])
        hits = [carom.impact(pairs[-1], speed=v, angle=0.0) for v in speeds]
        e = np.array([hit.normal_restitution for hit in hits]) + random.normal(0.0, 0.01, 4)
        sets.append(
            {
                "normal_speed": speeds,
                "normal_restitution": e,
                "normal_restitution_error": [0.01] * 4,
            }
        )
    joint = joint_fit(sets, share="thickness", pair=pairs, robust=False)

    def loss(h):
        held = [
            carom.Pair(p.first, carom.HalfSpace("steel", thickness=h), friction=0.15) for p in pairs
        ]
        hits = [
            [carom.impact(p, speed=v, angle=0.0) for v in d["normal_speed"]]
            for p, d in zip(held, sets, strict=True)
        ]
        return sum(
            float(
                np.square(
                    (np.array([hit.normal_restitution for hit in own]) - d["normal_restitution"])
                    / 0.01
                ).sum()
            )
            for own, d in zip(hits, sets, strict=True)
        )

    best = minimize_scalar(loss, bounds=(3e-3, 6e-3), method="bounded", options={"xatol": 1e-8})
    actual = joint["set 1"].thickness
    assert actual.value == pytest.approx(best.x, rel=1e-3)
    assert actual.value == joint["set 2"].thickness.value
    for end in (actual.low, actual.high):
        assert loss(end) - best.fun == pytest.approx(chi2.ppf(0.95, 1), rel=0.02)


def test_a_difference_of_drops_is_that_of_means():
    """Drops of one height, least squares: e is a mean, its interval Student's; MOVER by hand."""
    random = np.random.default_rng(6)
    sets = {
        name: {"normal_speed": np.full(n, 0.3), "normal_restitution": random.normal(e, 0.01, n)}
        for name, e, n in (("steel", 0.9, 6), ("brass", 0.8, 9))
    }
    joint = joint_fit(sets, pair=pair_of(), robust=False)
    ratios = [each["normal_restitution"] for each in sets.values()]
    means = [each.mean() for each in ratios]
    reach = [
        student.ppf(0.975, len(each) - 1) * each.std(ddof=1) / np.sqrt(len(each)) for each in ratios
    ]
    actual = joint.difference("restitution", "steel", "brass")
    assert actual.value == pytest.approx(means[0] - means[1], abs=1e-6)
    width = np.hypot(*reach)
    assert actual.low == pytest.approx(actual.value - width, abs=0.01 * width)
    assert actual.high == pytest.approx(actual.value + width, abs=0.01 * width)
    assert actual.differs
    back = joint.difference("restitution", "brass", "steel")
    assert (back.value, back.low, back.high) == pytest.approx(
        (-actual.value, -actual.high, -actual.low), abs=1e-12
    )


def test_errors_that_sets_have_in_common_do_not_count_in_a_difference():
    """Slip throughout tells mu (1 + e), a shared e is uncertain: mu of both is, their ratio not."""
    random, sets = np.random.default_rng(13), {}
    cotangent, e, error = 1.0 / np.tan(np.radians(78.0)), 0.9, 0.0005
    for name in "ab":
        ratio = 1.0 - 0.15 * (1.0 + e) * cotangent + error * random.normal(size=8)
        sets[name] = {"angle [deg]": np.full(8, 78.0), "tangential_restitution": ratio}
        sets[name]["tangential_restitution_error"] = np.full(8, error)
        sets[name]["normal_restitution"] = [e, *[np.nan] * 7]
        sets[name]["normal_restitution_error"] = [0.03, *[np.nan] * 7]
    how = {"pair": pair_of(), "fixed": {"kappa": 0.82}, "robust": False}
    joint = joint_fit(sets, share="restitution", **how)
    fitted = [1.0 - each["tangential_restitution"].mean() for each in sets.values()]
    factor = cotangent * (1.0 + e)
    assert joint["a"].friction.value == pytest.approx(fitted[0] / factor, rel=1e-3)
    less = joint.difference("friction", "a", "b")
    from_ratios = error * np.sqrt(2.0 / 8.0) / factor
    from_e = (fitted[0] - fitted[1]) / factor * 0.03 / np.sqrt(2.0) / (1.0 + e)
    expected = 2.0 * 1.96 * np.hypot(from_ratios, from_e)
    assert less.high - less.low == pytest.approx(expected, rel=0.05)
    assert joint["a"].friction.high - joint["a"].friction.low > 2.0 * expected


@pytest.mark.slow
def test_sets_that_contradict_each_other_are_told():
    sets = {"a": measured(7), "b": measured(8, friction=0.25)}
    joint = joint_fit(sets, share="friction", pair=pair_of())
    assert joint.agreement < 1e-6
    assert "contradict a common friction" in joint.verdict
    assert "contradict a common friction" in str(joint)
    same = joint_fit({"a": measured(7), "b": measured(8)}, share="friction", pair=pair_of())
    assert same.agreement > 0.01
    assert "the sets agree" in same.verdict


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_agreement_of_two_means_is_that_of_welch(seed):
    """Drops of one height, least squares: e is a mean, and means agree as by Welch's t test."""
    random = np.random.default_rng(seed)
    ratios = random.normal(0.9, 0.004, 5), random.normal(0.9, 0.02, 12)
    sets = [{"normal_speed": np.full(e.size, 0.3), "normal_restitution": e} for e in ratios]
    joint = joint_fit(sets, share="restitution", pair=pair_of(), robust=False)
    assert joint.agreement == pytest.approx(ttest_ind(*ratios, equal_var=False).pvalue, rel=2e-3)


@pytest.mark.slow
@pytest.mark.parametrize("errors", ["stated", "from the scatter"])
def test_intervals_and_agreement_hold_as_often_as_they_say(errors):
    """200 pairs of sets: a shared friction, a difference of restitutions, and the F-test."""
    inside, differences, unlikely = 0, 0, 0
    for seed in range(200):
        sets = {"a": measured(2 * seed), "b": measured(2 * seed + 1, "3 mm", e=0.8)}
        if errors != "stated":
            sets = {
                name: {k: v for k, v in each.items() if not k.endswith("_error")}
                for name, each in sets.items()
            }
        pairs = [pair_of(), pair_of("3 mm")]
        joint = joint_fit(sets, share="friction", pair=pairs, robust=False)
        friction, less = joint["a"].friction, joint.difference("restitution", "a", "b")
        inside += friction.low <= 0.15 <= friction.high
        differences += less.low <= 0.1 <= less.high
        unlikely += joint.agreement < 0.05
    assert 180 <= inside <= 199  # 190 +- 3.2 standard deviations
    assert 180 <= differences <= 199
    assert 2 <= unlikely <= 20


def test_chi_of_unlike_balls_differs_though_they_share_kappa():
    """A solid ball and a hollow one: chi = (kappa/2)(m_n/m_t), with one kappa."""
    hollow = carom.Sphere(radius="5 mm", material="steel", inner_radius="4.5 mm")
    pairs = [pair_of(), carom.Pair(hollow, STEEL, friction=0.15)]
    joint = joint_fit([measured(14), measured(15)], share="kappa", pair=pairs)
    kappa, ratios = joint["set 1"].kappa, [pair.chi / pair.kappa for pair in pairs]
    less = joint.difference("chi", "set 2", "set 1")
    assert less.value == pytest.approx((ratios[1] - ratios[0]) * kappa.value, rel=1e-9)
    width = (ratios[1] - ratios[0]) * (kappa.high - kappa.low)
    assert abs(less.high - less.low) == pytest.approx(abs(width), rel=1e-6)


def test_what_cannot_be_joined_is_refused():
    data = measured(9)
    pair = pair_of()
    refused("one set alone", joint_fit, [data], pair=pair)
    refused("several sets", joint_fit, "speed", pair=pair)
    both = {"a": data, "b": data}
    refused("share: 'mu'.*friction", joint_fit, both, pair=pair, share="mu")
    refused("chi is shared with kappa", joint_fit, both, pair=pair, share="chi")
    refused("one for each set", joint_fit, both, pair=[pair])
    wrong = {"angle [deg]": [10.0, 95.0], "spin_out": ["x", 2.0]}
    refused("a: .*spin_out.* b: ", joint_fit, {"a": wrong, "b": {"angle": [0.1]}}, pair=pair)
    joint = joint_fit(both, pair=pair, share="friction")
    refused("friction is shared", joint.difference, "friction", "a", "b")
    refused("'c'.*a, b", joint.difference, "kappa", "a", "c")
    refused("did you mean 'friction'", joint.difference, "frict", "a", "b")
    refused("fit alone", joint["a"].posterior)


def test_what_is_not_told_has_no_difference():
    """Rows that slip throughout do not tell kappa."""
    steep = {"angle [deg]": [70.0, 75.0, 80.0], "impulse_ratio": [0.15, 0.152, 0.149]}
    joint = joint_fit([steep, measured(10)], pair=pair_of(), fixed={"restitution": 0.9})
    less = joint.difference("kappa", "set 1", "set 2")
    assert not less.determined
    assert less.differs is None
    assert "slips throughout" in str(less)
    together = joint_fit(
        [steep, measured(10)], pair=pair_of(), fixed={"restitution": 0.9}, share="kappa"
    )
    assert together["set 1"].kappa.determined  # by the other set


@pytest.mark.slow
def test_the_result_is_stored_drawn_and_reported(tmp_path):
    joint = joint_fit({"a": measured(11), "b": measured(12)}, share="friction", pair=pair_of())
    dataset = joint.to_dataset()
    assert float(dataset["value"].sel(set="b", parameter="kappa")) == joint["b"].kappa.value
    axes = dict(
        zip(dataset["parameter"].values, joint.plot(tmp_path / "sets.png").axes, strict=True)
    )
    drawn = {name: len(axis.lines[0].get_xdata()) for name, axis in axes.items()}
    assert drawn == {"friction": 1, "kappa": 2, "chi": 2, "restitution": 2}  # a shared one once
    assert axes["friction"].get_xlabel() == r"friction $\mu$"
    places = [text.get_text() for text in axes["friction"].get_yticklabels()]
    assert places == ["a", "b", "all sets"]
    assert joint["a"].report(tmp_path / "a.html").exists()
    assert "the other data" in (tmp_path / "a.html").read_text(encoding="utf-8")
    assert joint.to_dict()["differences"]["kappa"]["b"]["value"] == pytest.approx(
        joint["b"].kappa.value - joint["a"].kappa.value
    )
    assert joint.cite().count("@software{carom") == 1
