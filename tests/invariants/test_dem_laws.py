"""What every contact law keeps: symmetry, Coulomb's cone, impulse, energy, scaling, refusals."""

import numpy as np
import pytest

import carom
from carom import dem

CHI = 1.4412
VARIANTS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
DAMPED = {"restitution": 0.8, "tangential_damping": 0.5}
PASSIVE = [  # no spring stiffens while it is stretched, or what it gains it has lost before
    dem.LinearSpring(),
    dem.LinearSpring(2 / 7),
    dem.LinearSpring(0.6, **DAMPED),
    dem.HertzLinearHistory(),
    dem.LammpsMindlin("mindlin_rescale"),
    dem.LammpsMindlin("mindlin_rescale/force"),
    dem.LiggghtsHertz(0.8),
    dem.StrongeLaw(restitution=0.7),
    dem.WaltonBraunLaw(),
    dem.WaltonBraunLaw(restitution=0.7),
    dem.ExactContactLaw(32, restitution=0.7),
]
ELASTIC = [
    *(law for law in PASSIVE if getattr(law, "restitution", 1.0) == 1.0),
    dem.LammpsMindlin("mindlin"),
    dem.LammpsMindlin("mindlin/force"),
    dem.ThorntonLaw(),
]
CONTACTS = [
    *PASSIVE,
    *(dem.LammpsMindlin(name) for name in VARIANTS[:2]),
    *(dem.LammpsMindlin(name, **DAMPED) for name in VARIANTS),
    dem.LammpsMindlin("mindlin", restitution=0.7, damping="tsuji"),
    dem.EdemHertzMindlin(0.9),
    dem.ThorntonLaw(),
    dem.ExactContactLaw(32),  # which gives energy back as exactly as its springs are many
]
LAWS = [*CONTACTS, dem.HardSphere(0.4, 0.9)]


def sample(n, seed):
    """Return psi_1 and chi of impacts that stick, slip partly, slide."""
    rng = np.random.default_rng(seed)
    chi = rng.choice(np.geomspace(0.2, 6.0, 12), n)
    return 4.6 * chi * rng.uniform(0.005, 1.0, n) ** 1.5, chi


@pytest.mark.first_case
@pytest.mark.parametrize("steps", [None, 50])
@pytest.mark.parametrize("law", LAWS, ids=str)
def test_mirrored_impacts_are_mirrored(law, steps):
    psi, chi = sample(12, 1)
    out = law.rebound(psi, chi, steps=steps)
    assert np.array_equal(law.rebound(-psi, chi, steps=steps), -out)
    assert np.all(np.isfinite(out))


@pytest.mark.first_case
@pytest.mark.parametrize("law", [*PASSIVE, dem.HardSphere(0.4, 0.9), dem.HardSphere()], ids=str)
def test_no_energy_is_gained(law):
    psi, chi = sample(100, 2)
    assert np.all(np.abs(law.rebound(psi, chi)) <= psi + 1e-8)


@pytest.mark.parametrize(
    ("variant", "psi", "chi", "gain"),
    [("mindlin", 0.657, 0.4403, 1.0634), ("mindlin/force", 0.00166, 0.4146, 1.0503)],
)
def test_mindlin_without_rescaling_makes_energy(variant, psi, chi, gain):
    """LAMMPS documents it; the largest found by a scan of psi_1 and chi."""
    assert dem.LammpsMindlin(variant).rebound(psi, chi) / -psi == pytest.approx(gain, abs=2e-4)


@pytest.mark.parametrize("law", [*ELASTIC, *PASSIVE[-3:]], ids=str)
def test_impulse_is_within_coulombs_cone(law):
    """|T| <= mu N over the whole contact: |psi_2 - psi_1| <= 2 chi (1 + e)."""
    psi, chi = sample(40, 3)
    most = 2 * chi * (1 + getattr(law, "restitution", 1.0))
    assert np.all(np.abs(law.rebound(psi, chi) - psi) <= most * (1 + 1e-7))


@pytest.mark.parametrize("psi", [0.4, -1.3, 3.0])
@pytest.mark.parametrize("law", CONTACTS, ids=str)
def test_history_keeps_the_cone_and_the_impulse(law, psi):
    """Change of velocity = integral of the force, for velocity Verlet by trapezia to rounding."""
    history, steps = law.history(psi, CHI, steps=300), 300
    f, t = history["normal_force"], history["tangential_force"]
    dt = history["time"][1]
    if not (isinstance(law, dem.LiggghtsHertz) and not isinstance(law, dem.EdemHertzMindlin)):
        assert np.all(np.abs(t) <= np.abs(f) * (1 + 1e-12))
    for name, force, pull in (("normal_velocity", f, 1.25), ("psi", t, 2.5 * CHI)):
        lost = pull * dt * (force[1:] + force[:-1]) / 2
        assert np.allclose(np.diff(history[name]), -lost, rtol=0.0, atol=1e-13)
    assert history["psi"][0] == psi
    assert history["normal_velocity"][0] == 1.0
    last = history["psi"][-1] - pull * dt * t[-1] / 2
    assert law.rebound(psi, CHI, steps=steps) == pytest.approx(last, abs=1e-13)


def test_liggghts_leaves_the_cone_by_its_damping():
    history = dem.LiggghtsHertz(0.5).history(0.5, CHI, steps=1000)
    assert np.max(np.abs(history["tangential_force"]) - np.abs(history["normal_force"])) > 0.01


@pytest.mark.parametrize("law", [law for law in CONTACTS if law != dem.ThorntonLaw()], ids=str)
def test_grazing_of_the_normal_has_a_limit(law):
    """psi_2/psi_1 -> a number as psi_1 -> 0."""
    psi = np.array([1e-3, 1e-4, 1e-5])
    ratio = law.rebound(psi, CHI) / psi
    assert np.ptp(ratio) < 5e-3
    assert abs(ratio[0]) < 1.0


@pytest.mark.parametrize(
    ("make", "parameter"),
    [
        *((dem.LinearSpring, 0.6), (dem.StrongeLaw, 0.6)),
        *((dem.WaltonBraunLaw, 0.6), (dem.HertzLinearHistory, 1.0)),
        *((lambda s, name=name: dem.LammpsMindlin(name, s), 1.0) for name in VARIANTS),
    ],
)
def test_units_of_psi(make, parameter):
    """Slower sliding of a stiffer spring: chi s alone sets what psi/chi becomes."""
    psi, factor = np.array([0.2, 0.7, 1.5, 3.0]), 0.7
    linear = parameter == 0.6  # k_t/k_n, in units of kappa; else in units of Mindlin's
    out = make(parameter).rebound(psi, CHI, kappa=0.8)
    scaled = make(parameter if linear else parameter / factor).rebound(
        factor * psi, factor * CHI, kappa=0.8 * factor
    )
    assert np.allclose(scaled, factor * out, rtol=0.0, atol=3e-8)


@pytest.mark.parametrize("law", CONTACTS[:9], ids=str)
def test_solid_spheres_unless_kappa_is_given(law):
    psi, chi = sample(6, 4)
    assert np.array_equal(law.rebound(psi, chi), law.rebound(psi, chi, kappa=4 / 7 * chi))
    if getattr(law, "stiffness_ratio", None) is not None:
        assert not np.allclose(law.rebound(psi, chi), law.rebound(psi, chi, kappa=1.3 * chi))


@pytest.mark.first_case
@pytest.mark.parametrize("steps", [None, 40])
@pytest.mark.parametrize("law", LAWS, ids=str)
def test_what_is_out_of_range_is_nan_and_nothing_else(law, steps):
    psi = np.array([0.3, np.nan, 0.5, 0.5, 0.5, 0.5, 0.5, 2.0])
    chi = np.array([CHI, CHI, 0.0, -1.0, np.nan, CHI, CHI, CHI])
    kappa = np.array([0.8, 0.8, 0.8, 0.8, 0.8, 0.0, np.nan, 0.8])
    inputs = {"kappa": kappa, "steps": steps}
    out, status = law.rebound(psi, chi, **inputs, return_status=True)
    assert list(np.isfinite(out)) == [True, *[False] * 6, True]
    assert status.tolist() == [0, 1, 2, 2, 2, 3, 3, 0]
    with pytest.warns(RuntimeWarning, match=r"6 of 8 .* index \(1,\): psi_1 must be a finite"):
        assert np.array_equal(law.rebound(psi, chi, **inputs), out, equal_nan=True)
    for i in (0, 7):
        assert out[i] == law.rebound(psi[i], chi[i], kappa=kappa[i], steps=steps)


@pytest.mark.parametrize("law", LAWS, ids=str)
def test_shapes_broadcast(law):
    psi, chi = np.array([[0.2], [1.0], [3.0]]), np.array([0.6, CHI])
    out = law.rebound(psi, chi, kappa=0.8, steps=30)
    assert out.shape == (3, 2)
    expected = [[law.rebound(p, c, kappa=0.8, steps=30) for c in chi] for p in psi[:, 0]]
    assert np.array_equal(out, expected)
    assert isinstance(law.rebound(1, CHI, steps=30), float)


def test_no_impacts_have_no_rebounds():
    assert dem.LinearSpring().rebound([], CHI).shape == (0,)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: dem.LinearSpring(0.0), "stiffness_ratio"),
        (lambda: dem.LinearSpring(float("inf")), "stiffness_ratio"),
        (lambda: dem.StrongeLaw(-1.0), "stiffness_ratio"),
        (lambda: dem.WaltonBraunLaw("soft"), "stiffness_ratio"),
        (lambda: dem.LinearSpring(restitution=0.0), "restitution"),
        (lambda: dem.LammpsMindlin(restitution=1.1), "restitution"),
        (lambda: dem.LiggghtsHertz(float("nan")), "restitution"),
        (lambda: dem.EdemHertzMindlin(None), "restitution"),
        (lambda: dem.StrongeLaw(restitution=-0.5), "restitution"),
        (lambda: dem.HardSphere(1.2), "tangential_restitution"),
        (lambda: dem.HardSphere(0.4, restitution=0.0), "restitution"),
        (lambda: dem.LinearSpring(tangential_damping=-1.0), "tangential_damping"),
        (lambda: dem.HertzLinearHistory(tangential_damping=float("inf")), "tangential_damping"),
        (lambda: dem.HertzLinearHistory(0.0), "stiffness"),
        (lambda: dem.LammpsMindlin("hooke"), "variant"),
        (lambda: dem.LammpsMindlin(damping="velocity"), "damping"),
        (lambda: dem.ThorntonLaw().rebound(1.0, CHI, steps=3), "steps"),
        (lambda: dem.ThorntonLaw().rebound(1.0, CHI, steps=10.5), "steps"),
        (lambda: dem.LinearSpring().history(1.0, CHI, steps=True), "steps"),
    ],
)
def test_parameters_out_of_range_are_refused_in_a_line(make, name):
    with pytest.raises(carom.InputError) as refused:
        make()
    message = str(refused.value)
    assert message.startswith(f"{name}: ")
    assert "\n" not in message


@pytest.mark.parametrize("law", LAWS, ids=str)
def test_laws_are_records_with_a_source(law):
    assert law.name
    assert law.source
    assert hash(law) == hash(type(law)(**vars(law)))
    with pytest.raises(AttributeError):
        law.name = "another"
