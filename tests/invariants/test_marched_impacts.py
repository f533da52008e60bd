"""What holds for impacts marched over springs: spheres that yield, and standard linear solids."""

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson
from tests.invariants.test_lossy_impacts import MANY

import carom
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import borne
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs.solution import solve_by_marching
from carom.dimensionless.rebounds import lossy_rebounds
from carom.dimensionless.solution import solve_lossy

MARCHED = [law for law in MANY.values() if law.loss is not Loss.VISCOUS]
laws = pytest.mark.parametrize("law", MARCHED, ids=str)


def impacts(seed, count):
    rng = np.random.default_rng(seed)
    return rng.uniform(0.0, 8.0, count), rng.uniform(0.3, 3.0, count)


@pytest.mark.first_case
@laws
def test_friction_bounds_the_impulse_and_energy_is_lost(law):
    """|psi_1 - psi_2| <= 2 chi (1 + e), reached where all slides, and |psi_2| <= |psi_1|.

    In a yielding sphere the pressure jumps at the turning point, up at the centre, where springs
    stick until they have caught up: a thousandth of the impulse at most.
    """
    psi, chi = impacts(9, 40)
    rebounds = lossy_rebounds(psi, chi, law)
    most = 2.0 * chi * (1.0 + rebounds.restitution)
    assert np.all(rebounds.status == Status.SOLVED)
    assert np.all(np.abs(psi - rebounds.psi_out) <= most + 1e-6)
    assert np.all(np.abs(rebounds.psi_out) <= psi + 1e-9)
    far = psi > most + 1.0
    short = (most - np.abs(psi - rebounds.psi_out))[far] / most[far]
    assert np.all((short >= -1e-7) & (short < (1e-3 if law.loss is Loss.PLASTIC else 1e-6)))
    assert 5 < far.sum() < 40


@laws
@pytest.mark.parametrize("psi", [0.3, 1.5, 8.0])
def test_ledgers_close_along_the_history(law, psi):
    """v^2 + stored + lost = 1; no work is taken back; springs let go end with nothing stored."""
    s = solve_lossy(psi, 1.44, law)
    h, scale = s.history(800), 1e-4 * (1.0 + psi**2)
    assert np.max(np.abs(h.speed**2 + h.normal_stored + h.normal_lost - 1.0)) < 1e-4
    assert np.min(np.diff(h.normal_lost)) > -1e-5
    assert abs(h.normal_stored[-1]) < 1e-6
    assert h.normal_lost[-1] == pytest.approx(1.0 - s.restitution**2, abs=1e-5)
    assert np.min(np.diff(h.dissipated)) > -scale
    assert np.min(np.diff(h.shear_lost)) > -1e-9
    assert s.shear_lost == pytest.approx(h.shear_lost[-1], abs=scale)
    lost = h.dissipated[-1] + h.shear_lost[-1]
    assert abs(psi**2 - s.psi_out**2 - 2.0 * lost) < scale
    if law.loss is not Loss.RELAXING:
        assert s.shear_lost == 0.0


@laws
def test_histories_agree_with_themselves(law):
    """dU = psi dt, dd = v dt; what ends a history is what an impact comes to."""
    for psi, chi in zip(*impacts(11, 2), strict=True):
        s = solve_lossy(psi, chi, law)
        h = s.history(3001)
        assert np.max(np.abs(h.force) - 2.0 / 3.0 * h.normal_force) < 2e-5
        assert np.all(h.stick_radius <= h.contact_radius + 1e-12)
        assert h.time[-1] == s.duration
        assert h.psi[-1] == pytest.approx(s.psi_out, abs=1e-5)
        assert h.speed[-1] == pytest.approx(-s.restitution, abs=1e-5)
        for rate, kept in ((h.psi, h.displacement), (h.speed, h.penetration)):
            assert cumulative_simpson(rate, x=h.time, initial=0.0) == pytest.approx(kept, abs=1e-4)
        assert h.penetration.max() == pytest.approx(s.max_penetration, rel=1e-4)
        assert h.normal_force.max() == pytest.approx(s.max_force, rel=1e-4)


@laws
def test_phases_are_told(law):
    """Stick from the touch below psi_1 = 1, slip to the end beyond what slides throughout."""
    kinds = {psi: [p.kind for p in solve_lossy(psi, 1.44, law).phases] for psi in (0.5, 9.0)}
    assert kinds[0.5][0] == "stick"
    assert kinds[0.5][-1] == "gross slip" or law.loss is Loss.METAL  # too short to be a phase
    assert set(kinds[9.0]) == {"gross slip"} or law.loss is Loss.PLASTIC
    assert kinds[9.0][0] == kinds[9.0][-1] == "gross slip"


@pytest.mark.first_case
@pytest.mark.parametrize("psi", [0.3, 1.5])
@pytest.mark.parametrize(
    "law",
    [LossNumbers(Loss.PLATE, 0.0), LossNumbers(Loss.RELAXING, 1e6, 1e-9)],
    ids=["plate without give", "solid that does not relax"],
)
def test_fields_are_the_elastic_ones_where_nothing_is_lost(law, psi):
    """Tractions, slip and its rate, work of friction, pressure over time."""
    s, exact = solve_by_marching(psi, 1.44, law), carom.solve(psi, 1.44)
    assert s.psi_out == pytest.approx(exact.psi_out, abs=1e-6 * max(psi, 1.0))
    parts = np.array([0.0, 0.1, 0.3, 0.5, 0.7, 0.9])
    for time in (0.3, 1.1, 1.9, 2.6):
        actual, wanted = s.contact_at(time), exact.contact_at(time)
        radii = parts * wanted.radius
        assert actual.radius == pytest.approx(wanted.radius, abs=2e-5)
        assert s.traction(time, radii) == pytest.approx(exact.traction(time, radii), abs=2e-3)
        assert actual.slid(radii) == pytest.approx(wanted.slid(radii), abs=5e-4)
        rates = actual.slipping(radii) - wanted.slipping(radii)
        assert np.median(np.abs(rates)) < 2e-3
        assert np.max(np.abs(rates)) < 0.05
    work = exact.friction_work(parts)
    assert s.friction_work(parts) == pytest.approx(work, abs=3e-3 * (1.0 + psi**2))
    assert s.pressed(parts) == pytest.approx(exact.pressed(parts), abs=2e-3)
    assert s.touched(parts) == pytest.approx(exact.touched(parts), abs=1e-5)


@laws
def test_fields_obey_coulombs_law_and_bear_the_load(law):
    """In the springs; over the contact pressure and traction make the forces of the history."""
    for psi, share in ((0.4, 0.3), (1.5, 0.7), (4.0, 0.5)):
        s = solve_lossy(psi, 1.44, law)
        time = share * s.duration
        now, state = s.at(time), s.contact_at(time)
        edge, profile = state.radius, state.profile
        x = edge * (np.arange(4000) + 0.5) / 4000
        bears = borne(profile, x)
        pulls = borne(profile._replace(n=profile.g), x)
        assert np.all(np.abs(pulls) <= bears + 1e-9)
        assert 1.5 * edge * np.mean(bears) == pytest.approx(now.normal_force[0], abs=2e-3)
        assert edge * np.mean(pulls) == pytest.approx(now.force[0], abs=2e-3)
        pressure = np.empty(x.size)
        surface.tractions(profile._replace(g=profile.n), x, pressure)
        load = 3.0 * edge * np.mean(pressure * x)
        assert load == pytest.approx(now.normal_force[0], rel=5e-3)
        assert np.all(pressure >= 0.0)


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "law"), list(zip((0.4, 2.0, 1.0, 0.4, 2.0), MARCHED, strict=True)))
def test_work_of_friction_is_what_the_ledger_says(law, psi):
    """Summed over the contact, from slip and traction; the ledger is that of energies."""
    s = solve_lossy(psi, 1.44, law)
    radii = np.linspace(0.0, s.max_radius, 401)
    work = s.friction_work(radii)[:, 0]
    total = np.trapezoid(work * radii, radii) * 5.625 * s.chi * (2.0 / 3.0) * 2.0
    lost = s.history(400).dissipated[-1]
    assert total == pytest.approx(lost, rel=2e-2, abs=2e-3)


@pytest.mark.slow
def test_figures_and_wear_of_marched_impacts():
    ball = carom.Sphere(radius="5 mm", material="nylon")
    pair = carom.Pair(ball, carom.HalfSpace(material="nylon"), friction=0.2)
    inputs = {"normal_speed": 1.0, "tangential_speed": 0.5}
    hit = carom.impact(pair, **inputs, losses=carom.StandardLinearSolid(1.5, "20 us"))
    elastic = carom.impact(pair, **inputs)
    like = carom.impact(pair, **inputs, losses=carom.StandardLinearSolid(1.0001, "20 us"))
    half = 0.5 * elastic.duration
    exact, nearly, above = (each.stress(half) for each in (elastic, like, hit))
    for name in ("max_von_mises", "max_tension"):
        assert float(nearly[name]) == pytest.approx(float(exact[name]), rel=5e-3)
    assert float(above.max_von_mises) > 1.01 * float(exact.max_von_mises)
    assert float(like.wear().max_friction_work) == pytest.approx(
        float(elastic.wear().max_friction_work), rel=3e-3
    )
    assert float(hit.wear().work_error) < 5e-3
    along = hit.radial(0.3 * hit.duration)
    assert np.all(np.abs(along.traction_x) <= along.friction_limit * (1.0 + 1e-9))
    rounding = 1e-12 * along.memory_limit.max()
    assert np.all(np.abs(along.memory_q) <= along.memory_limit + rounding)


@pytest.mark.parametrize("law", [carom.ElasticPlastic("0.1 m/s"), carom.Metal()], ids=str)
def test_the_stress_below_a_yielded_contact_is_refused(pair, law):
    hit = carom.impact(pair, normal_speed=1.0, losses=law)
    assert float(hit.fields(0.5 * hit.duration).pressure.max()) > 0.0
    for call in (lambda: hit.stress(0.5 * hit.duration), hit.peaks):
        with pytest.raises(carom.InputError, match="stress a yielded contact leaves below it"):
            call()
