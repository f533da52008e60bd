"""ReboundLaw on arrays of any library: the exact rebound, odd, and at home at every number."""

import numpy as np
import pytest

import carom

CHI = 1.44
LARGEST = np.finfo(float).max
FRINGE = [0.0, -0.0, 5e-324, 1e-320, -1e-310, 1e-7, 1e15, -1e300, LARGEST, np.inf, -np.inf, np.nan]


@pytest.fixture(scope="module")
def law():
    return carom.laws.ReboundLaw(CHI)


@pytest.fixture(params=["numpy", "array_api_strict", "torch", "jax"])
def make(request):
    """What makes an array of a library of NumPy's; JAX with float64."""
    if request.param == "numpy":
        yield np.asarray
    elif request.param == "jax":
        jax = pytest.importorskip("jax")
        with jax.enable_x64(True):
            yield jax.numpy.asarray
    else:
        library = pytest.importorskip(request.param)
        yield library.tensor if request.param == "torch" else library.asarray


def psi_of(law):
    """Slopes of all regimes, ends of panels and their neighbours among them."""
    edges = law.edges
    beside = [np.nextafter(edges, 0.0), edges, np.nextafter(edges, 9.0)]
    return np.concatenate([*beside, np.linspace(0.0, 9.0, 1601), np.geomspace(1e-9, 1.0, 300)])


def test_is_the_exact_rebound(law, make):
    """To 1e-9, with impulse and dissipation that follow from psi_2; odd and even to the bit."""
    psi = psi_of(law)
    exact = carom.rebound(psi, CHI)
    got, mirrored = (np.asarray(law(make(each))) for each in (psi, -psi))
    assert np.max(np.abs(got - exact)) <= 1e-9
    np.testing.assert_array_equal(mirrored, -got)
    impulse = np.asarray(law.impulse(make(psi)))
    np.testing.assert_allclose(impulse, (psi - got) / (4.0 * CHI), rtol=0, atol=1e-15)
    np.testing.assert_allclose(impulse[psi >= 4.0 * CHI - 1.0], 1.0, rtol=3e-16)
    energy = np.asarray(law.dissipation(make(psi)))
    np.testing.assert_allclose(energy, psi**2 - got**2, rtol=0, atol=1e-13)
    np.testing.assert_array_equal(np.asarray(law.dissipation(make(-psi))), energy)
    assert np.all(energy >= 0.0)


def test_every_number_is_answered_without_a_warning(law, make):
    """Zero, numbers below the normal ones (JAX may flush them), the largest, infinite ones, NaN."""
    fringe = np.array(FRINGE)
    small, huge = np.abs(fringe) < 1e-300, np.abs(fringe) > 10.0
    got = np.asarray(law(make(fringe)))
    np.testing.assert_array_equal(got[huge], fringe[huge] - 4.0 * CHI * np.sign(fringe[huge]))
    np.testing.assert_allclose(got[small], law(1e-9) * 1e9 * fringe[small], rtol=1e-6, atol=1e-307)
    assert np.isnan(got[-1])
    impulse = np.asarray(law.impulse(make(fringe)))
    np.testing.assert_allclose(impulse[huge], np.sign(fringe[huge]), rtol=1e-15)
    assert np.isnan(impulse[-1])
    energy = np.asarray(law.dissipation(make(fringe[~huge | np.isinf(fringe)])))
    np.testing.assert_array_equal(energy[-3:], [np.inf, np.inf, np.nan])


def test_kinds_and_shapes(law, make):
    """float32 stays float32, to 2e-6; shapes stay."""
    psi = np.linspace(-7.0, 7.0, 24, dtype=np.float32).reshape(2, 3, 4)
    got = np.asarray(law(make(psi)))
    assert got.dtype == np.float32
    assert got.shape == (2, 3, 4)
    assert np.max(np.abs(got - law(psi.astype(float)))) < 2e-6
    assert type(law(make(psi))) is type(make(psi))


def test_whole_numbers(law, make):
    """They become the library's own floating-point type."""
    got = law(make(np.array([1, -6])))
    assert got.dtype == make([1.0]).dtype
    np.testing.assert_allclose(np.asarray(got), law([1.0, -6.0]), rtol=0, atol=1e-6)


def test_numbers_and_lists(law):
    """A number gives a float, as `carom.rebound` does; a list gives an array."""
    for function in (law, law.impulse, law.dissipation):
        assert type(function(0.5)) is type(function(2)) is float
        assert type(function([0.5, 2])) is np.ndarray
    assert type(law(np.float32(0.5))) is np.float32
    assert law(6) == 6.0 - 4.0 * CHI


@pytest.mark.parametrize(
    "psi", ["fast", None, 1j, [1.0, None], [[1.0], [1.0, 2.0]], np.array(["2020"], "M8[D]")]
)
def test_refusals(law, psi):
    """One line that says what a slope is."""
    for function in (law, law.impulse, law.dissipation):
        with pytest.raises(carom.InputError, match="must be a real number, or an array") as error:
            function(psi)
        assert str(error.value).startswith("psi_1: ")
        assert "\n" not in str(error.value)


def test_tensors_that_are_no_plain_block(law):
    """Every second entry, transposed, or one value for all: as the plain copy, and no warning."""
    torch = pytest.importorskip("torch")
    psi = torch.linspace(-7.0, 7.0, 24, dtype=torch.float64).reshape(4, 6)
    for view in (psi[:, ::2], psi.T, psi[:1, :1].expand(3, 2)):
        np.testing.assert_array_equal(law(view).numpy(), law(view.numpy().copy()))
