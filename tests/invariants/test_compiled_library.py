"""The compiled library and numba agree to the last bit, at every entry point."""

import copy

import numpy as np
import pytest

import carom
from carom.dem import lattice
from carom.dimensionless import rebound_tables
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.numerics import chebyshev, hertz, permutation, shared_library
from carom.dimensionless.numerics.kernels import ENTRIES
from carom.dimensionless.rebounds import lossy_rebounds
from carom.dimensionless.solution import solve_lossy

pytestmark = pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
STEEL = carom.material("steel")
BALL = carom.Sphere(radius=0.005, material=STEEL)
PAIR = carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2)


def leaves(value):
    """Give arrays and numbers within tuples."""
    if isinstance(value, tuple):
        for each in value:
            yield from leaves(each)
    elif value is not None:
        yield np.asarray(value)


@pytest.fixture
def calls(monkeypatch):
    """How often each entry point is called, while every call is made in both ways and compared."""
    counts = {kernel.__name__ + "@" + kernel.__module__: 0 for kernel in ENTRIES}

    def checked(kernel):
        by_library = shared_library.function(kernel.signatures(), kernel.floats)
        assert by_library is not None

        def call(*inputs):
            other = copy.deepcopy(inputs)
            expected = kernel.dispatcher(*other)
            actual = by_library(*inputs)
            pairs = zip(leaves((inputs, actual)), leaves((other, expected)), strict=True)
            for one, two in pairs:
                assert one.dtype.kind == two.dtype.kind
                assert one.tobytes() == two.tobytes(), kernel.__name__
            counts[kernel.__name__ + "@" + kernel.__module__] += 1
            return actual

        return call

    viscous_loss.cache_clear()  # of other tests in this process
    for kernel in ENTRIES:
        monkeypatch.setitem(kernel.__dict__, "compiled", checked(kernel))
    return counts


def rebounds(rng):
    chi = np.concatenate([rng.uniform(0.05, 8.0, 300), [0.5, 1.0, 1.44, 2.0, np.nan, -1.0, 1e4]])
    psi = rng.uniform(-12.0, 12.0, chi.size)
    psi[:20] = [0.0, -0.0, 1.0, -1.0, 1e-9, 4.0, 5.0, 5.76, 1e9, np.inf] * 2
    carom.rebound(psi, chi, threads=1, return_status=True)
    for e in (1.0, 0.9, 0.5, 0.1):
        some = slice(0, 60)
        normal = carom.KelvinVoigt(restitution=e)
        carom.rebound(psi[some], chi[40:100], losses=normal, threads=1, return_status=True)
    for _ in range(5):
        losses = LossNumbers(Loss.VISCOUS, rng.uniform(1e-4, 2.0, 280))
        lossy_rebounds(psi[20:300], chi[20:300], losses)


def impacts(rng):
    for psi, chi in zip(rng.uniform(0.0, 6.0, 12), rng.uniform(0.3, 2.5, 12), strict=True):
        solution = carom.solve(psi, chi)
        times = solution.duration * np.concatenate([[0.0, 0.5, 1.0], rng.uniform(0.0, 1.0, 9)])
        solution.at(times)
        solution.traction(times[4], np.linspace(0.0, 1.0, 7))
        solution.slid(times[5], np.linspace(0.0, 1.0, 7))
        solution.memory(times[6]).profile()
        plate = carom.ZenerPlate(inelasticity=rng.uniform(0.0, 2.0))
        carom.rebound([psi, -psi], chi, losses=plate)
        bent = carom.solve(psi, chi, losses=plate)
        bent.at(bent.duration * rng.uniform(0.0, 1.0, 4))
        radii = bent.max_radius * np.linspace(0.0, 0.99, 5)
        assert np.all(np.isfinite([*bent.touched(radii), *bent.friction_work(radii).ravel()]))
        lossy = carom.solve(psi, chi, losses=carom.KelvinVoigt(restitution=0.8))
        lossy.at(lossy.duration * rng.uniform(0.0, 1.0, 4))
        inside = lossy.contact_at(lossy.duration * rng.uniform(0.1, 0.9))
        inside.slid(inside.radius * rng.uniform(0.0, 1.0, 3))


def marched(rng):
    for loss, low in ((Loss.PLASTIC, 0.2), (Loss.RELAXING, 0.05), (Loss.METAL, 0.2)):
        most = 0.01 if loss is Loss.METAL else 4.0
        parameter, extra = rng.uniform(low, 1.0, 6), rng.uniform(0.025 * most, most, 6)
        psi, chi = rng.uniform(-6.0, 6.0, 6), rng.uniform(0.3, 2.5, 6)
        lossy_rebounds(psi, chi, LossNumbers(loss, parameter, extra), 1)
        solution = solve_lossy(1.3, 1.44, LossNumbers(loss, parameter[0], extra[0]))
        solution.at(0.5 * solution.duration)


def contacts(rng):
    hit = carom.impact(PAIR, speed=2.0, angle=0.5)
    path = carom.load_path(PAIR, normal_force=10.0, tangential_force=[0.0, 1.5, -1.0, 0.5])
    for time in rng.uniform(0.05, 0.95, 4):
        for contact in (hit.contact(time * hit.duration), path.contact(3)):
            assert contact is not None
        hit.fields(time * hit.duration)
        hit.radial(time * hit.duration)
        hit.stress(time * hit.duration, x=[0.0, 1e-4], z=[0.0, 1e-4])
    path.fields(2)
    path.radial(1)
    carom.load_path(PAIR, normal_force=10.0, displacement=[[1e-7, 0.0], [1e-7, 1e-7]])


def laws(rng):
    psi = rng.uniform(-6.0, 6.0, 20)
    for law in (carom.dem.LinearSpring(), carom.dem.LammpsMindlin(), carom.dem.ThorntonLaw()):
        law.rebound(psi, 1.44)
        law.rebound(psi, 1.44, steps=100)
        law.history(0.7, 1.44)
    for law in (carom.dem.ExactContactLaw(16), carom.dem.ExactContactLaw(16, restitution=0.8)):
        law.rebound(psi, 1.44, steps=40)
        law.history(0.7, 1.44, steps=40)
    memory, load = np.zeros(lattice.places(16)), np.empty(3)
    lattice.step(memory, 16, 0.1, np.array([1.0, 0.5, 0.2]), 0.1, 0.2, 0.2, 1.4, load)
    carom.laws.ReboundLaw((1.4, 1.45))(psi, 1.42)
    for kind in (np.float32, np.float64):
        velocity = rng.normal(size=(700, 3)).astype(kind)
        normal = rng.normal(size=(700, 3))
        normal = (normal / np.linalg.norm(normal, axis=1, keepdims=True)).astype(kind)
        for law in (None, carom.laws.RoughLaw(restitution=0.9)):
            carom.collide(PAIR, velocity1=velocity, normal=normal, law=law, threads=1)
        plate = carom.HalfSpace(material="steel", thickness="3 mm")
        on_plate = carom.Pair(PAIR.first, plate, friction=0.2)
        carom.collide(on_plate, velocity1=velocity, normal=normal, threads=1)
    places = np.arange(50, dtype=np.uint64)
    permutation.fractions(places, 1000, permutation.secrets(1, 1)[0])


def damage(rng):
    body = carom.material("steel", fracture_toughness=1e6, flaw_size=1e-5)
    ball = carom.Sphere(radius=0.005, material=body)
    pair = carom.Pair(ball, carom.HalfSpace(material=body), friction=0.2)
    hit = carom.impact(pair, speed=2.0, angle=rng.uniform(0.3, 0.8))
    hit.peaks()
    hit.wear()
    hit.solution.pressed(rng.uniform(0.0, 1.0, 5))
    assert "K/K_c" in str(hit.validity)


def numbers(rng):
    for t in rng.uniform(0.0, 1.0, 20):
        hertz.time(t * t, t)
        hertz.elapsed(t)
        chebyshev.evaluate(rng.normal(size=9), 0.0, 1.0, t)
    psi, numbers = rng.uniform(-5, 5, (4, 9)), (np.full(4, 1.3), np.full(4, 0.9))
    rebound_tables.psi_out(rebound_tables.stored(), psi, *numbers)


@pytest.mark.slow
def test_the_library_gives_the_bits_of_numba(calls):
    rng = np.random.default_rng(20)
    for work in (rebounds, impacts, marched, contacts, damage, laws, numbers):
        work(rng)
    never = [name for name, count in calls.items() if count == 0]
    assert not never
