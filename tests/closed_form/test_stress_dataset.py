"""The stress in either body of an impact, with units: where it is largest, and what is refused."""

import math

import numpy as np
import pytest

import carom
from carom.dimensionless.fields import peaks
from carom.dimensionless.fields.subsurface import COMPONENTS, stresses

STEEL = carom.Material(young="210 GPa", poisson=0.3, density=7850)
BALL = carom.Sphere(radius="5 mm", material=STEEL)
HIT = carom.impact(
    carom.Pair(BALL, carom.HalfSpace(material=STEEL), friction=0.2), speed=2.0, angle="30 deg"
)
STEEP = carom.impact(HIT.pair, speed=2.0, angle="75 deg")  # slides throughout

TIMES = [0.1, 0.3, 0.48, 0.55, 0.7, 0.9]


@pytest.mark.parametrize("share", TIMES)
def test_surface_carries_the_tractions_of_the_fields(share):
    """sigma_zz = -p, and sigma_xz = -f in the second body, +f in the first."""
    time = share * HIT.duration
    x = np.linspace(-1.2, 1.2, 17) * HIT.max_radius
    fields = HIT.fields(time, x=x, y=[0.0]).isel(y=0)
    limit = 1e-9 * HIT.max_pressure
    for body, sign in [("first", 1.0), ("second", -1.0)]:
        stress = HIT.stress(time, x=x, z=[0.0], body=body).isel(z=0)
        assert np.abs(stress.sigma_zz + fields.pressure).max() < limit
        assert np.abs(stress.sigma_xz - sign * fields.traction_x).max() < limit


def test_sliding_impact():
    """The largest tension of full sliding by its closed form, behind the contact in either body."""
    time = 0.3 * STEEP.duration
    for body, side in [("second", -1.0), ("first", 1.0)]:
        stress = STEEP.stress(time, x=[0.0], z=[0.0], body=body)
        p_0 = -float(stress.sigma_zz[0, 0])
        expected = p_0 * (0.4 / 3.0 + math.pi * 0.2 * 4.3 / 8.0)
        assert float(stress.max_tension) == pytest.approx(expected, rel=1e-9)
        edge = side * float(stress.contact_radius)
        assert float(stress.max_tension_x) == pytest.approx(edge, rel=1e-12)
        assert float(stress.max_tension_y) == float(stress.max_tension_z) == 0.0
        assert float(stress.max_von_mises_x) * side < 0.0


def test_bodies_mirror_each_other():
    """Equal materials: what one body has at x the other has at -x."""
    grid = {"x": np.linspace(-1.0, 1.0, 20) * HIT.max_radius, "z": [0.0, 1e-5, 1e-4]}
    one, other = (HIT.stress(0.6 * HIT.duration, **grid, body=b) for b in ("first", "second"))
    limit = 1e-12 * HIT.max_pressure
    for name in ("sigma_xx", "sigma_zz", "von_mises", "principal_1", "max_shear"):
        assert np.abs(one[name].values - other[name].values[:, ::-1]).max() < limit
    assert np.abs(one.sigma_xz.values + other.sigma_xz.values[:, ::-1]).max() < limit


def test_invariants_of_the_tensor():
    """Principal stresses in order, with the trace, the determinant, and von Mises from them."""
    generator = np.random.default_rng(2)
    points = generator.uniform(-1.0, 1.0, (50, 3)) * HIT.max_radius
    ds = HIT.stress(0.5 * HIT.duration, points=np.abs(points)) / HIT.max_pressure
    s = [ds[f"principal_{k}"].values for k in (1, 2, 3)]
    xx, yy, zz, xy, xz, yz = (ds[f"sigma_{n}"].values for n in COMPONENTS)
    assert np.all(s[0] >= s[1])
    assert np.all(s[1] >= s[2])
    assert sum(s) == pytest.approx(xx + yy + zz, abs=1e-13)
    determinant = xx * (yy * zz - yz**2) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    assert s[0] * s[1] * s[2] == pytest.approx(determinant, abs=1e-13)
    mises = np.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2))
    assert ds.von_mises.values == pytest.approx(mises, abs=1e-13)
    assert ds.max_shear.values == pytest.approx(0.5 * (s[0] - s[2]), abs=1e-13)


@pytest.mark.first_case
@pytest.mark.parametrize(("psi", "chi"), [(0.5, 1.44), (1.5, 1.44), (0.2, 40.0)])
@pytest.mark.parametrize("friction", [0.1, 0.5])
def test_nothing_is_larger_than_the_largest(psi, chi, friction):
    """In stick and slip, none of 3000 points exceeds the maxima, which lie in the plane y = 0."""
    generator = np.random.default_rng(11)
    solution = carom.solve(psi, chi)
    for time in (1.45, 1.9, 2.5):
        profile = solution.memory(time).profile()
        at = generator.uniform([-1.3, 0.0, 0.0], [1.3, 1.3, 1.0], (3000, 3)) * profile.edges[-1]
        at[:2000, 2] = 0.0
        at[:1000, 1] = 0.0

        inputs = {"friction": friction, "poisson": 0.3}
        stress = stresses(at, profile, **inputs)
        worst = peaks.largest(peaks.VON_MISES, profile, **inputs)
        pulled = peaks.largest(peaks.TENSION, profile, **inputs, deepest=0.0)
        assert worst.value >= peaks.von_mises(stress).max()
        assert pulled.value >= peaks.principal_stresses(stress[:2000])[:, 0].max()
        assert worst.y == pytest.approx(0.0, abs=1e-6)
        assert pulled.y == pytest.approx(0.0, abs=1e-6)


def test_maxima_of_a_small_contact():
    """Just after touch a sliding contact has the maxima of any other, scaled."""
    items = []
    for share in (1e-9, 0.3):
        stress = STEEP.stress(share * STEEP.duration, points=[[0.0, 0.0, 0.0]])
        p_0, b = -float(stress.sigma_zz[0]), float(stress.contact_radius)
        places = [float(stress[f"max_von_mises_{axis}"]) / b for axis in "xz"]
        items.append([float(stress.max_von_mises) / p_0, float(stress.max_tension) / p_0, *places])
    assert items[0] == pytest.approx(items[1], rel=1e-6)


def test_maxima_do_not_depend_on_the_grid():
    """They belong to the body: the same for a grid, another grid, and one point."""
    time = 0.6 * HIT.duration
    actual = [HIT.stress(time), HIT.stress(time, x=[0], z=[1]), HIT.stress(time, points=[[0] * 3])]
    for name in ("max_von_mises", "max_von_mises_z", "max_tension", "max_tension_x"):
        assert len({float(dataset[name]) for dataset in actual}) == 1


def test_dataset():
    """Dims, default grid and units as documented; no contact, no stress."""
    stress = HIT.stress(0.4 * HIT.duration)
    assert stress.sigma_xx.dims == ("z", "x")
    assert stress.sigma_xx.shape == (61, 101)
    reach = 2.0 * float(stress.contact_radius)
    assert (float(stress.x[0]), float(stress.z[0])) == (-reach, 0.0)
    assert (float(stress.x[-1]), float(stress.z[-1])) == (reach, reach)
    assert {stress[name].units for name in ("sigma_xx", "von_mises", "max_tension")} == {"Pa"}
    assert stress.attrs["body"] == "second"
    at_touch = HIT.stress(0.0)
    assert float(np.abs(at_touch.von_mises).max()) == float(at_touch.max_von_mises) == 0.0
