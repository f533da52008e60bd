"""Load paths against closed forms: Hertz pressures superposed, of either sign, on discs.

Full slip on a disc of radius x has the force mu P(x) and moves the bodies by (mu/kappa) d(x). The
classical solutions are sums of such discs (Cattaneo 1938; Jaeger 1993): an annulus that has slipped
towards + carries g = 1, one that has slipped towards - carries g = -1.
"""

from math import atan, pi

import numpy as np
import pytest
from tests import checks

from carom import Material, Pair, Sphere, read, save
from carom.classical import cattaneo_mindlin, critical_obliquity, loop_energy
from carom.impacts.contacts.load_paths import load_path
from carom.quantities.refusals import InputError

GLASS = Material(young="70 GPa", poisson=0.23, density=2500)
STEEL = Material(young="210 GPa", poisson=0.3, density=7850)
PAIR = Pair(
    Sphere(radius="5 mm", material=GLASS), Sphere(radius="9 mm", material=STEEL), friction=0.3
)
MU, KAPPA = PAIR.friction, PAIR.kappa
STIFFNESS = 4 / 3 * PAIR.effective_modulus * PAIR.effective_radius**0.5


def relative(value, tolerance):
    return pytest.approx(value, rel=tolerance, abs=0.0)


def depth(force):
    return np.cbrt(force / STIFFNESS) ** 2


def radius(force):
    return np.sqrt(PAIR.effective_radius * depth(force))


def superposed(*discs):
    """Force and displacement of discs of full slip, each a share and the force P(x) it bears."""
    force = sum(share * MU * load for share, load in discs)
    return force, sum(share * MU / KAPPA * depth(load) for share, load in discs)


def check(path, force, moved, stick, tolerance=1e-12):
    size = MU * path.normal_force.max()
    assert path.tangential_force[-1] == pytest.approx(force, abs=tolerance * size)
    length = MU / KAPPA * path.penetration.max()
    assert path.displacement[-1] == pytest.approx(moved, abs=tolerance * length)
    assert path.stick_radius[-1] == relative(radius(stick), tolerance)


def test_cattaneo_mindlin():
    """U = (3 mu P/(4 a G*)) (1 - (1 - T/mu P)^(2/3)), stick radius a (1 - T/mu P)^(1/3)."""
    share = np.concatenate([np.linspace(0.0, 0.999, 40), [1.0]])
    path = load_path(PAIR, normal_force=20.0, tangential_force=share * MU * 20.0)
    unit = 3 * MU * 20.0 / (4 * radius(20.0) * PAIR.effective_shear_modulus)
    np.testing.assert_allclose(path.displacement, unit * (1 - (1 - share) ** (2 / 3)), rtol=1e-12)
    np.testing.assert_allclose(path.stick_radius, radius(20.0) * (1 - share) ** (1 / 3), rtol=1e-12)
    formula = cattaneo_mindlin(PAIR, 20.0, -share * MU * 20.0)
    np.testing.assert_allclose(-path.displacement, formula, rtol=1e-12)
    driven = load_path(PAIR, penetration=depth(20.0), displacement=path.displacement)
    np.testing.assert_allclose(driven.tangential_force, path.tangential_force, rtol=1e-12)
    for one in (path, driven):
        np.testing.assert_allclose(one.normal_force, 20.0, rtol=1e-14)
        np.testing.assert_allclose(one.contact_radius, radius(20.0), rtol=1e-14)
        np.testing.assert_allclose(one.penetration, depth(20.0), rtol=1e-14)


@pytest.mark.parametrize("top", [0.05, 0.6, 0.97])
def test_masing_unloading_and_reloading(top):
    """After a reversal the first loading returns at twice the scale, until a branch closes."""
    load, peak = 20.0, top * MU * 20.0
    start = load_path(PAIR, normal_force=load, tangential_force=[0.0, peak])
    first = cattaneo_mindlin(PAIR, load, peak)
    for force in (0.7 * peak, 0.0, -0.8 * peak):
        back = start.then(normal_force=load, tangential_force=force)
        down = first - 2 * cattaneo_mindlin(PAIR, load, (peak - force) / 2)
        check(back, force, down, load * (1 - (peak - force) / (2 * MU * load)))
        again = back.then(normal_force=load, tangential_force=0.5 * (force + peak))
        up = down + 2 * cattaneo_mindlin(PAIR, load, (peak - force) / 4)
        check(again, 0.5 * (force + peak), up, load * (1 - (peak - force) / (4 * MU * load)))
        closed = again.then(normal_force=load, tangential_force=peak)
        assert closed.displacement[-1] == relative(first, 1e-12)
        assert closed.stick_radius[-1] == relative(radius(load * (1 - top)), 1e-12)


@pytest.mark.parametrize("top", [1e-3, 0.1, 0.6, 0.99, 1.0])
def test_energy_of_a_hysteresis_loop(top):
    """The frictional work of each cycle is the area of the loop, in closed form."""
    load, peak = 20.0, top * MU * 20.0
    forces = [0.0, peak, 0.2 * peak, -peak, -0.3 * peak, 0.1 * peak, peak, -peak, peak]
    path = load_path(PAIR, normal_force=load, tangential_force=forces)
    inner = loop_energy(PAIR, load, 0.2 * peak)  # from -0.3 to 0.1
    back = load_path(PAIR, normal_force=load, tangential_force=[0.0, *[peak, -peak] * 2, peak])
    cycle = back.frictional_work[3] - back.frictional_work[1]
    assert cycle == relative(loop_energy(PAIR, load, peak), 1e-11)
    assert back.frictional_work[5] - back.frictional_work[3] == relative(cycle, 1e-11)
    assert path.frictional_work[6] - path.frictional_work[1] == relative(cycle, 1e-11)
    nested = load_path(
        PAIR,
        normal_force=load,
        tangential_force=[0.0, peak, -peak, 0.1 * peak, -0.3 * peak, 0.1 * peak, peak],
    )
    whole = nested.frictional_work[6] - nested.frictional_work[1]
    assert whole == relative(cycle + inner, 1e-11)
    if top < 1.0:
        stored = nested.tangential_elastic_energy
        assert stored[6] == relative(stored[1], 1e-12)


def test_loop_energy_is_the_area_between_the_branches():
    """By quadrature of 2 (branch down - branch up); cubic in the amplitude where it is small."""
    for share in (0.3, 0.9):
        peak = share * MU * 20.0
        x, w = np.polynomial.legendre.leggauss(40)
        first = cattaneo_mindlin(PAIR, 20.0, peak)
        down = first - 2 * cattaneo_mindlin(PAIR, 20.0, peak * (1 - x) / 2)
        up = 2 * cattaneo_mindlin(PAIR, 20.0, peak * (1 + x) / 2) - first
        area = peak * np.sum(w * (down - up))
        assert loop_energy(PAIR, 20.0, peak) == relative(area, 1e-12)
    small = loop_energy(PAIR, 20.0, np.array([1e-8, 2e-8]))
    assert small[1] / small[0] == pytest.approx(8.0, rel=1e-7)


START = superposed((1, 20.0), (-1, 8.0))  # Cattaneo: P = 20 N, stick zone that of 8 N


@pytest.mark.parametrize(
    ("discs", "stick"),
    [
        pytest.param(
            [(1, 20.0), (-1, 8.0), (0.4, 30.0), (-0.4, 20.0)], 30.0, id="P up, T up, stick"
        ),
        pytest.param([(1, 30.0), (-1, 5.0)], 5.0, id="P up, T up, slip"),
        pytest.param(
            [(1, 20.0), (-1, 8.0), (-0.9, 30.0), (0.9, 20.0)], 30.0, id="P up, T down, stick"
        ),
        pytest.param([(-1, 30.0), (2, 18.0), (-1, 8.0)], 18.0, id="P up, T down, slip"),
        pytest.param([(-1, 30.0), (1, 6.0)], 6.0, id="P up, T down, slip beyond the memory"),
        pytest.param([(1, 15.0), (-1, 2.0)], 2.0, id="P down, T up, slip"),
        pytest.param([(1, 15.0), (-1, 7.0)], 7.0, id="P down, T down slowly, slip as before"),
        pytest.param([(-1, 15.0), (2, 11.0), (-1, 8.0)], 11.0, id="P down, T down, slip back"),
        pytest.param([(-1, 15.0), (1, 3.0)], 3.0, id="P down, T down, slip beyond the memory"),
    ],
)
def test_varying_normal_and_tangential_force(discs, stick):
    """Mindlin & Deresiewicz's cases, from Cattaneo's state by one straight step, in any control."""
    start = load_path(PAIR, normal_force=20.0, tangential_force=[0.0, START[0]])
    force, moved = superposed(*discs)
    load = max(load for _, load in discs if load > stick) if stick < 30.0 else 30.0
    check(start.then(normal_force=load, tangential_force=force), force, moved, stick)
    check(start.then(normal_force=load, displacement=moved), force, moved, stick)
    check(start.then(penetration=depth(load), tangential_force=force), force, moved, stick)
    check(start.then(penetration=depth(load), displacement=moved), force, moved, stick)


def test_loading_again_after_partial_unloading():
    """Contact laid anew remembers nothing; a reversed force slips it, then what is older."""
    gone = MU / KAPPA * (depth(30.0) - depth(20.0))  # so that the stick zone is that of 20 N
    path = load_path(PAIR, normal_force=30.0, displacement=[0.0, gone])
    check(path, *superposed((1, 30.0), (-1, 20.0)), 20.0)
    path = path.then(normal_force=18.0, displacement=gone)
    low = (depth(18.0) - depth(30.0) + depth(20.0)) / depth(1.0)
    low = low**1.5  # the front has moved in by as much as d has fallen
    check(path, *superposed((1, 18.0), (-1, low)), low)
    path = path.then(normal_force=40.0, displacement=gone)
    check(path, *superposed((1, 18.0), (-1, low)), 40.0)
    shallow = path.then(
        normal_force=40.0, tangential_force=superposed((1, 18), (-1, low), (-1, 40), (1, 25))[0]
    )
    check(shallow, *superposed((1, 18.0), (-1, low), (-1, 40.0), (1, 25.0)), 25.0)
    middle = 0.5 * (low + 18.0)
    force, moved = superposed((-1, 40.0), (2, middle), (-1, low))
    check(path.then(normal_force=40.0, tangential_force=force), force, moved, middle)
    force, moved = superposed((-1, 40.0), (1, 0.5 * low))
    check(path.then(normal_force=40.0, displacement=moved), force, moved, 0.5 * low)


@pytest.mark.parametrize("share", [-1 + 1e-9, -0.4, 0.0, 0.7, 1 - 1e-9])
def test_oblique_loading_below_the_critical_angle(share):
    """F_x = share mu P: U = share mu d/kappa, all sticks, no work; unloading retraces it."""
    load = np.array([1.0, 5.0, 6.0, 20.0, 13.0, 6.0, 2.0, 0.0])
    for control in (
        {"tangential_force": share * MU * load},
        {"displacement": share * MU / KAPPA * depth(load)},
    ):
        path = load_path(PAIR, normal_force=load, **control)
        atol = 1e-13 * MU * 20.0
        np.testing.assert_allclose(path.tangential_force, share * MU * load, rtol=0, atol=atol)
        moved, atol = share * MU / KAPPA * depth(load), 1e-13 * MU / KAPPA * depth(20.0)
        np.testing.assert_allclose(path.displacement, moved, rtol=0, atol=atol)
        assert np.all(path.frictional_work < 1e-16 * MU**2 / KAPPA * 20.0 * depth(20.0))


@pytest.mark.parametrize("share", [0.1, 0.9])
def test_the_secant_stiffness_of_loading_in_one_direction_is_two_thirds_of_mindlins(share):
    """F_x/U = (2/3) 2 G* b, equation (15) of Di Renzo & Di Maio (2005): the force grows as b^3, the
    tangent stiffness is 2 G* b, so U = int dF/(2 G* b). MercuryDPM takes it for a stiffness."""
    normal = np.linspace(0.0, 20.0, 30)[1:]
    path = load_path(PAIR, normal_force=normal, tangential_force=share * MU * normal)
    secant = path.tangential_force / path.displacement
    mindlin = 2.0 * PAIR.effective_shear_modulus * path.contact_radius
    np.testing.assert_allclose(secant / mindlin, 2.0 / 3.0, rtol=1e-12)


@pytest.mark.parametrize("excess", [1e-6, 0.5])
def test_oblique_loading_beyond_the_critical_angle(excess):
    """U/d = k mu/kappa, k > 1: all slides, F_x = mu P, W = 0.4 (k - 1) mu^2 P d/kappa."""
    k, load = 1 + excess, np.array([3.0, 12.0, 20.0])
    path = load_path(PAIR, normal_force=load, displacement=-k * MU / KAPPA * depth(load))
    np.testing.assert_allclose(path.tangential_force, -MU * load, rtol=1e-13)
    assert np.all(path.stick_radius == 0.0)
    work = 0.4 * (k - 1) * MU**2 / KAPPA * load * depth(load)
    np.testing.assert_allclose(path.frictional_work, work, rtol=1e-9)
    angles = critical_obliquity(PAIR)
    assert angles == pytest.approx((atan(MU), atan(MU / KAPPA)))
    assert 0.0 < angles.force < pi / 2


def test_sliding_at_constant_load():
    """Once all slides the displacement costs mu P each metre, and nothing more is stored."""
    full = MU / KAPPA * depth(20.0)
    path = load_path(PAIR, normal_force=20.0, displacement=[0.0, full, 3 * full, 10 * full])
    np.testing.assert_allclose(path.tangential_force[1:], MU * 20.0, rtol=1e-14)
    np.testing.assert_allclose(
        np.diff(path.frictional_work[1:]), MU * 20.0 * full * np.array([2, 7]), rtol=1e-12
    )
    assert np.ptp(path.tangential_elastic_energy[1:]) <= 1e-14 * path.frictional_work[-1]


def test_bodies_that_never_touch():
    path = load_path(PAIR, penetration=[0.0, -1e-6], displacement=[1e-6, 2e-6])
    assert np.all(path.displacement == [1e-6, 2e-6])
    for name in ("normal_force", "tangential_force", "contact_radius", "stick_radius"):
        assert np.all(getattr(path, name) == 0.0)
    checks.refused(r"at: -1 .* do not touch", path.contact)


def test_dataset_is_labelled_and_stored(tmp_path):
    path = load_path(PAIR, penetration="1 um", tangential_force=[0.0, 0.1])
    table = path.to_dataset()
    assert table.sizes == {"step": 2}
    assert table.frictional_work.units == "J"
    assert '"friction": 0.3' in table.inputs
    assert read(save(table, tmp_path / "path.nc")).identical(table)


@pytest.mark.parametrize(
    ("controls", "message"),
    [
        ({}, "give normal_force or penetration, one of them"),
        ({"penetration": 1e-6}, "give tangential_force or displacement, one of them"),
        ({"penetration": 1, "normal_force": 1, "displacement": 0}, "penetration, not both"),
        ({"penetration": [], "displacement": 0}, r"penetration: .* shape \(0,\)"),
        ({"penetration": [[1e-6]], "displacement": 0}, r"penetration: .* shape \(1, 1\)"),
        ({"penetration": [1e-6, np.nan], "displacement": 0}, "penetration: nan .* step 1"),
        ({"normal_force": [1.0, np.inf], "displacement": 0}, "normal_force: inf .* step 1"),
        ({"normal_force": [1.0, -2.0], "displacement": 0}, r"normal_force: -2.0 .* step 1"),
        ({"normal_force": "3 kg", "displacement": 0}, "normal_force: '3 kg' .* not a value in N;"),
        ({"normal_force": 1.0, "tangential_force": "push"}, "tangential_force: 'push'"),
        ({"normal_force": [1.0, 2.0], "displacement": [0.0] * 3}, "displacement: .* 3 values"),
        ({"penetration": 1e300, "displacement": 0}, "penetration: 1e.300 .* check the units"),
    ],
)
def test_bad_input_is_refused_in_one_line(controls, message):
    with pytest.raises(InputError, match=message) as caught:
        load_path(PAIR, **controls)
    assert "\n" not in str(caught.value)


def test_what_cannot_be_followed():
    smooth = Pair(PAIR.first, PAIR.second, friction=0.0)
    with pytest.raises(InputError, match=r"friction: 0.0 .* needs friction"):
        load_path(smooth, normal_force=1.0, displacement=0.0)
    checks.refused("pair: ", load_path, "steel", normal_force=1.0, displacement=0.0)
    for step in (1, -2, 0.5):
        with pytest.raises(InputError, match=f"at: {step} "):
            load_path(PAIR, normal_force=1.0, displacement=0.0).contact(step)
    refused = {0.31: "at most mu P", np.nan: "finite", True: "finite", (1.0, 2.0): "broadcast"}
    for force, message in refused.items():
        with pytest.raises(InputError, match=f"tangential_force: .* {message}"):
            cattaneo_mindlin(PAIR, [1.0, 2.0, 3.0], force)
    checks.refused("pair: ", critical_obliquity, "steel")
    assert cattaneo_mindlin(PAIR, "1 N", "0.1 N") == cattaneo_mindlin(PAIR, 1.0, 0.1)
    checks.refused("amplitude: ", loop_energy, PAIR, 1.0, -0.1)


ASIDE = np.array([0.6, -0.8])


@pytest.mark.parametrize(
    "tangential",
    [
        {"displacement": np.array([1e-7, 4e-7, -2e-7])},
        {"tangential_force": np.array([1.0, 4.0, -3.0])},
    ],
)
def test_two_directions_on_one_line_are_exact(tangential):
    """A path along a line at any angle is that of one direction, turned."""
    name, values = next(iter(tangential.items()))
    plain = load_path(PAIR, normal_force=[20.0, 30.0, 15.0], **tangential)
    turned = load_path(PAIR, normal_force=[20.0, 30.0, 15.0], **{name: np.outer(values, ASIDE)})
    for column in ("displacement", "tangential_force"):
        expected = np.outer(getattr(plain, column), ASIDE)
        atol = 1e-13 * np.abs(expected).max()
        np.testing.assert_allclose(getattr(turned, column), expected, rtol=0, atol=atol)
    for column in ("stick_radius", "frictional_work", "tangential_elastic_energy", "normal_force"):
        np.testing.assert_allclose(getattr(turned, column), getattr(plain, column), rtol=1e-12)


def test_a_path_of_two_directions_goes_in_and_out(tmp_path):
    """Shapes; what drove it comes back to the bit, is stored, and drives the next path."""
    bent = load_path(PAIR, normal_force="20 N", displacement=[["0.2 um", "0 um"], [2e-7, 1e-7]])
    assert bent.displacement[1].tolist() == [2e-7, 1e-7]
    assert bent.normal_force.tolist() == [20.0, 20.0]
    assert bent.displacement.shape == bent.tangential_force.shape == (2, 2)
    kept = read(save(bent, tmp_path / "bent.nc"))
    assert kept["tangential_force"].dims == ("step", "direction")
    for values in (kept["displacement"], kept["displacement"].T):
        again = load_path(PAIR, normal_force=kept["normal_force"], displacement=values)
        np.testing.assert_array_equal(again.tangential_force, bent.tangential_force)
    longer = load_path(PAIR, normal_force=20.0, displacement=2e-7).then(
        normal_force=20.0, displacement=[[2e-7, 1e-7]]
    )
    np.testing.assert_allclose(longer.tangential_force, bent.tangential_force, rtol=1e-12)
    one = load_path(PAIR, normal_force=[10.0, 20.0, 30.0], tangential_force=[[0.1, 0.2]])
    assert one.displacement.shape == (3, 2)


def test_controls_come_back_to_the_bit():
    """Of any size, in one direction or two; what a path tells of itself drives the same again."""
    rng = np.random.default_rng(44)
    for _ in range(20):
        loads = 10.0 ** rng.uniform(-6.0, 4.0, 5)
        limits = MU * np.minimum.accumulate(loads)[:, None]
        forces = 0.9 * limits * rng.uniform(-0.2, 0.2, (5, 2))
        for values in (forces, forces[:, 0]):
            pushed = load_path(PAIR, normal_force=loads, tangential_force=values)
            np.testing.assert_array_equal(pushed.normal_force, loads)
            np.testing.assert_array_equal(pushed.tangential_force, values)
            again = {"penetration": pushed.penetration, "displacement": pushed.displacement}
            driven = load_path(PAIR, **again)
            np.testing.assert_array_equal(driven.penetration, pushed.penetration)
            np.testing.assert_array_equal(driven.displacement, pushed.displacement)
            size = 1e-9 * MU * loads.max()
            np.testing.assert_allclose(driven.tangential_force, values, rtol=0.0, atol=size)
            np.testing.assert_allclose(driven.normal_force, loads, rtol=1e-14)


def test_what_two_directions_cannot_be():
    bent = load_path(PAIR, normal_force=20.0, displacement=[[2e-7, 0.0], [2e-7, 1e-7]])
    wrong = {
        r"step 1: Coulomb's law allows at most 6 N": [[0.0, 0.0], [6.0, 1.0]],
        r"near this limit give displacements": [[1.0, 0.0], [0.0, 6.0]],
        r"an array of shape \(1, 3\) cannot be used; .* or of shape \(n, 2\)": [[1.0, 0.0, 0.0]],
        r"step 1: it must be finite": [[0.0, 0.0], [1.0, np.nan]],
        r"an array of 2 values' cannot be used; must have 3 values": [[0.0, 0.0], [1.0, 0.0]],
    }
    for words, force in wrong.items():
        load = [20.0, 20.0, 20.0] if "3 values" in words else 20.0
        checks.refused(words, load_path, PAIR, normal_force=load, tangential_force=force)
    for look in (bent.contact, bent.fields, bent.radial, bent.stress):
        checks.refused(r"at: -1 .* only for paths in one direction", look)


def test_progress_of_a_path_that_turns():
    entries = []
    load_path(
        PAIR,
        normal_force=20.0,
        displacement=[[2e-7, 0.0], [2e-7, 1e-7]],
        progress=lambda done, total: entries.append((done, total)),
    )
    assert entries == [(1, 2), (2, 2)]
