"""Histories in SI units: energy and momentum in the course of time, and what datasets say."""

import json

import numpy as np
import pint
import pytest
from scipy.integrate import cumulative_trapezoid

import carom
from carom import Cup, HalfSpace, Material, Pair, Sphere
from carom.io.labels import flags, labelled_dataset

ENERGIES = (
    *("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy"),
    *("normal_elastic_energy", "tangential_elastic_energy", "frictional_work"),
)
KINDS = ("half-space", "rigid half-space", "unlike sphere", "hollow spheres", "cup")


def random_material(rng):
    return Material(
        young=10 ** rng.uniform(6, 11.5),
        poisson=rng.uniform(0.0, 0.5),
        density=rng.uniform(500, 9000),
    )


def random_impact(kind, rng):
    """Return an impact of a random pair, with spins, in any regime."""
    one, two = random_material(rng), random_material(rng)
    radius = 10 ** rng.uniform(-3, -1)
    ball = Sphere(radius=radius, material=one)
    second = {
        "half-space": HalfSpace(material=two),
        "rigid half-space": HalfSpace(material="rigid"),
        "unlike sphere": Sphere(radius=radius * rng.uniform(0.2, 5.0), material=two),
        "hollow spheres": Sphere(radius=2 * radius, material=two, inner_radius=1.7 * radius),
        "cup": Cup(radius=radius * rng.uniform(1.2, 4.0), material=two),
    }[kind]
    if kind == "hollow spheres":
        ball = Sphere(radius=radius, material=one, gyration_radius=0.8 * radius)
    pair = Pair(ball, second, rng.uniform(0.05, 0.8))
    slip = rng.uniform(-6, 6) * pair.friction / pair.kappa
    spin, spin2 = rng.normal(size=2) / radius
    spin2 = spin2 if len(pair.moving) == 2 else 0.0
    carried = sum(b.radius * w for b, w in zip(pair.moving, (spin, spin2), strict=False))
    spins = {"spin": spin, "spin2": spin2}
    return carom.impact(pair, normal_speed=1.0, tangential_speed=slip - carried, **spins)


@pytest.fixture(params=[(kind, seed) for kind in KINDS for seed in range(4)], ids=str)
def hit(request):
    kind, seed = request.param
    return random_impact(kind, np.random.default_rng([KINDS.index(kind), seed]))


def test_energies_add_up_to_a_constant(hit):
    """Kinetic (normal, tangential, spins) + elastic + dissipated, frame of the centre of mass."""
    history = hit.history(201)
    total = sum(history[name].values for name in ENERGIES)
    assert np.max(np.abs(total / total[0] - 1.0)) < 1e-12
    pair, bodies = hit.pair, zip(hit.pair.moving, (hit.spin, hit.spin2), strict=False)
    start = 0.5 * pair.normal_mass * (hit.normal_speed**2 + hit.tangential_speed**2)
    start += sum(0.5 * b.mass * b.gyration_ratio * (b.radius * w) ** 2 for b, w in bodies)
    assert total[0] == pytest.approx(start, rel=1e-14)


def test_friction_acts_on_the_contact_point_alone(hit):
    """Tangential and spin kinetic energy change by as much as (1/2) m_t V_x^2 does."""
    history = hit.history(101)
    moving = history.tangential_kinetic_energy + history.spin_kinetic_energy
    kept = (moving - history.contact_kinetic_energy).values
    assert np.all(history.contact_kinetic_energy <= moving * (1 + 1e-13))
    assert np.max(np.abs(kept - kept[0])) < 2e-14 * float(moving.max())


def test_elastic_energy_is_that_of_the_tangential_springs(hit):
    """(15/8) chi integral of q^2 dx from the memory at a time, which the ledger does not use."""
    history = hit.history(9)
    unit = hit.pair.tangential_mass * hit.scales.tangential_speed**2
    nodes, weights = np.polynomial.legendre.leggauss(64)
    for time, stored in zip(history.time, history.tangential_elastic_energy, strict=True):
        memory = hit.solution.memory(min(float(time) / hit.scales.time, hit.solution.duration))
        squares = 0.0
        for annulus in memory.annuli:
            low, high = annulus.inner, annulus.outer
            x = 0.5 * (low + high) + 0.5 * (high - low) * nodes
            squares += 0.5 * (high - low) * float(weights @ memory.q(x**2) ** 2)
        assert float(stored) == pytest.approx(
            1.875 * hit.pair.chi * squares * unit, rel=1e-8, abs=1e-11 * unit
        )


def test_the_bodies_move_as_the_forces_tell(hit):
    """m_n dV_z = -F_z dt, m_n dv_t = -F_x dt, I_i d(omega_i) = -R_i F_x dt, dU = V_x dt."""
    n = 8001
    h, pair = hit.history(n), hit.pair

    def impulse(name):
        return cumulative_trapezoid(h[name].values, h.time.values, initial=0.0)

    normal, tangential = impulse("normal_force"), impulse("tangential_force")
    momentum = pair.normal_mass * hit.normal_speed
    assert normal[-1] == pytest.approx(2 * momentum, rel=1e-7)
    off = pair.normal_mass * (h.normal_velocity.values[0] - h.normal_velocity.values) - normal
    assert np.max(np.abs(off)) < 1e-7 * momentum
    size = 1e-7 * pair.friction * momentum
    off = pair.normal_mass * (hit.tangential_speed - h.tangential_speed.values) - tangential
    assert np.max(np.abs(off)) < size
    for body, spin in zip(pair.moving, (h.spin.values, h.spin2.values), strict=False):
        moment = body.mass * body.gyration_ratio * body.radius * (spin[0] - spin)
        assert np.max(np.abs(moment - tangential)) < size
    moved = impulse("contact_velocity")
    assert np.max(np.abs(moved - h.displacement.values)) < 1e-6 * np.max(np.abs(moved))


def test_contact_velocity_is_made_of_speed_and_spins(hit):
    """V_x = v_t + R omega + R_2 omega_2 at every time."""
    h, moving = hit.history(101), hit.pair.moving
    carried = sum(b.radius * w for b, w in zip(moving, (h.spin, h.spin2), strict=False))
    size = float(abs(h.tangential_speed).max() + abs(carried).max())
    assert float(abs(h.tangential_speed + carried - h.contact_velocity).max()) < 1e-14 * size
    if len(moving) == 1:
        assert np.all(h.spin2 == 0.0)


def test_a_history_begins_and_ends_as_the_impact(hit):
    h = hit.history(7)
    ends = {
        "spin": (hit.spin, hit.spin_out),
        "spin2": (hit.spin2, hit.spin2_out),
        "tangential_speed": (hit.tangential_speed, hit.tangential_speed_out),
        "contact_velocity": (hit.contact_velocity, hit.contact_velocity_out),
        "normal_velocity": (hit.normal_speed, -hit.normal_speed),
        "frictional_work": (0.0, hit.dissipated_energy),
    }
    for name, (first, last) in ends.items():
        size = np.max(np.abs(h[name].values))
        assert float(h[name][0]) == pytest.approx(first, rel=1e-15), name
        assert float(h[name][-1]) == pytest.approx(last, rel=1e-10, abs=1e-12 * size), name


def test_without_friction_nothing_tangential_changes(steel_ball):
    smooth = Pair(steel_ball, steel_ball, 0)
    hit = carom.impact(smooth, normal_speed=1, tangential_speed=0.7, spin=11, spin2=4)
    h = hit.history(5)
    assert np.all(h.spin == 11.0)
    assert np.all(h.spin2 == 4.0)
    assert np.all(h.tangential_speed == 0.7)
    assert np.all(h.frictional_work == 0.0)
    assert np.allclose(h.displacement, hit.contact_velocity * h.time, rtol=1e-15, atol=0.0)


def test_a_history_has_a_row_for_each_instant(hit):
    """All of it is along time, with the phase of the instant, also as a data frame."""
    history = hit.history(40)
    assert set(history.dims) == {"time"}
    frame = history.to_dataframe()
    assert len(frame) == 40
    for time, row in frame.iterrows():
        phase = [each for each in hit.phases if each.start <= time][-1]
        shown = row[["phase_kind", "phase_sign", "phase_start", "phase_end"]].tolist()
        assert shown == list(phase[:4])
    assert set(hit.to_dataset().dims) == {"time", "phase"}


def sample_history():
    pair = Pair(Sphere(radius="5 mm", material="steel"), HalfSpace(material="glass"), 0.2)
    return carom.impact(pair, speed=2.0, angle="30 deg").history(20)


def test_attributes_follow_the_conventions():
    """Unit (one that pint and udunits know) and meaning everywhere; text has no unit."""
    history, units = sample_history(), pint.UnitRegistry()
    assert history.attrs["Conventions"] == "CF-1.11"
    assert history.attrs["source"] == f"carom {carom.__version__}"
    assert history.attrs["title"]
    assert json.loads(history.attrs["inputs"])["first"]["radius"] == 0.005
    for name, item in history.variables.items():
        assert item.attrs["long_name"], name
        assert "standard_name" not in item.attrs
        if item.dtype.kind == "U":
            assert "units" not in item.attrs
        else:
            units.parse_expression(item.attrs["units"])
    assert units(history.normal_force.units).check("[force]")
    assert units(history.spin_kinetic_energy.units).check("[energy]")


def test_flags_name_their_values():
    sign = sample_history().phase_sign
    assert sign.dtype == sign.flag_values.dtype == np.int8
    names = dict(zip(sign.flag_values.tolist(), sign.flag_meanings.split(), strict=True))
    assert names == {-1: "slip_along_-x", 0: "stick", 1: "slip_along_+x"}
    zone = flags(("outside", "stick", "slip"))
    assert zone["flag_values"].tolist() == [0, 1, 2]


def test_labelled_datasets_take_what_is_natural():
    """Numbers, values along themselves, (dims, values), and attributes on top."""
    grid = labelled_dataset(
        {
            "pressure": (("y", "x"), np.zeros((2, 3))),
            "friction": 0.2,
            "level": (("y", "x"), np.ones((2, 3)), {"units": "1", "long_name": "level"}),
        },
        {"x": [0.0, 1.0, 2.0], "y": [0.0, 1.0], "name": ("x", list("abc"), {"long_name": "name"})},
        {"title": "grid", "inputs": {"friction": 0.2}},
    )
    assert (grid.x.axis, grid.y.axis, grid.pressure.units) == ("X", "Y", "Pa")
    assert (grid.sizes["x"], grid.friction.item(), grid.level.long_name) == (3, 0.2, "level")
    assert json.loads(grid.inputs) == {"friction": 0.2}
    with pytest.raises(KeyError, match="unheard"):
        labelled_dataset({"unheard": 1.0}, {}, {})
