"""What users hand over is read by one reader: units, masks, truth values, sizes; or is refused."""

from decimal import Decimal
from fractions import Fraction
from functools import partial

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from tests import checks
from tests.checks import PAIR

import carom
from carom.quantities.refusals import flag, one_of
from carom.quantities.units import counted, whole
from carom.status import LawStatus

UNITS = pint.get_application_registry()
LAWS = (carom.dem.LinearSpring(), carom.dem.LammpsMindlin(), carom.dem.HardSphere(0.4))


def refused(call, *words):
    """The line that refuses a call has these words."""
    line = checks.refused("", call)
    assert len(line) < 1000
    assert all(word in line for word in words), line


@pytest.mark.parametrize(
    "force",
    [
        *(UNITS.Quantity(0.01, "kN"), [UNITS.Quantity(10.0, "N")], UNITS.Quantity([0.01], "kN")),
        np.array([UNITS.Quantity(0.01, "kN")], dtype=object),
        *(xr.DataArray([0.01], attrs={"units": "kN"}), xr.DataArray(UNITS.Quantity([0.01], "kN"))),
        *(pd.Series(["0.01 kN"]), "0.01 kN", Decimal(10), [Fraction(10)]),
    ],
)
def test_units_of_forces_are_heeded(force):
    path = carom.load_path(PAIR, normal_force=force, tangential_force=0.0)
    assert path.normal_force == pytest.approx([10.0], rel=1e-12)


def test_units_of_arrays_are_heeded():
    """Of velocities, spins, angles: pint's arrays count as the numbers in SI units."""
    fast, spin = UNITS.Quantity([[1000.0, 0.0, 2000.0]], "mm/s"), UNITS.Quantity([0, 60, 0], "rpm")
    axis = [0.0, 0.0, 1.0]
    after = carom.collide(PAIR, velocity1=fast, spin1=spin, normal=axis)
    turning = [0.0, 2.0 * np.pi, 0.0]
    plain = carom.collide(PAIR, velocity1=[[1.0, 0.0, 2.0]], spin1=turning, normal=axis)
    assert after.velocity1 == pytest.approx(plain.velocity1, rel=1e-12)
    assert after.spin1 == pytest.approx(plain.spin1, rel=1e-12)
    refused(lambda: carom.collide(PAIR, velocity1=spin, normal=axis), "velocity1: ", "m/s")
    basis = {"speed": 2.0, "contact_beta": 0.3, "normal_restitution": 0.9}
    data = [
        carom.convert_observables(PAIR, known=basis | {"angle": angle}, wanted="rebound_angle")
        for angle in (UNITS.Quantity([10.0, 20.0], "deg"), ["10 deg", "20 deg"])
    ]
    assert data[0] == pytest.approx(data[1], rel=1e-12)


@pytest.mark.parametrize("unit", ["1", "", "dimensionless", "%"])
def test_a_friction_may_be_told_to_be_a_pure_number(unit):
    """A length may not, but for the attribute that is empty."""
    item = xr.DataArray(0.2, attrs={"units": unit})
    pair = carom.Pair(PAIR.first, PAIR.second, friction=item)
    assert pair.friction == pytest.approx(0.002 if unit == "%" else 0.2, rel=1e-15)
    if unit:
        refused(lambda: carom.Sphere(radius=item, material="steel"), "radius: ", "not a value in m")


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.int8, float])
def test_a_unit_is_applied_in_double_precision(kind):
    for radius in (
        UNITS.Quantity(kind(5), "mm"),
        UNITS.Quantity(np.array(5, dtype=kind), "mm"),
        xr.DataArray(kind(5), attrs={"units": "mm"}),
    ):
        assert carom.Sphere(radius=radius, material="steel").radius == 0.005
        assert carom.Grid({"first.radius": [radius]})._coords()["first_radius"][1] == [0.005]


@pytest.mark.parametrize(
    "values", [["5"], [True], np.array(["2020-01-01"], "M8[D]"), [5j], [b"5"], [None]], ids=str
)
def test_what_has_a_unit_holds_numbers(values):
    item = xr.DataArray(np.array(values), attrs={"units": "%"})
    refused(lambda: carom.rebound(item, 1.44), "psi_1: ")
    refused(lambda: carom.load_path(PAIR, normal_force=item, tangential_force=0.0), "normal_force:")
    refused(lambda: carom.Sphere(radius=item[0].assign_attrs(units="mm"), material="steel"), "rad")


@pytest.mark.parametrize(
    "young",
    [
        *("1e305 GPa", Decimal("1e400"), Decimal("Infinity"), np.longdouble("1e4000"), 10**400),
        *(UNITS.Quantity(1e305, "GPa"), UNITS.Quantity(np.inf, "Pa")),
        xr.DataArray(1e305, attrs={"units": "GPa"}),
    ],
    ids=repr,
)
def test_a_modulus_that_overflows_is_not_rigid(young):
    refused(lambda: carom.Material(young=young, poisson=0.3), "young: ", "cannot be used")
    assert carom.Material(young=np.inf, poisson=0.3).is_rigid


def test_an_array_that_overflows_is_refused():
    for psi in (np.array([np.longdouble("1e4000")]), UNITS.Quantity([1e305], "km/mm")):
        refused(partial(carom.rebound, psi, 1.44), "psi_1: ", "floating point cannot hold it")


def test_units_of_two_kinds_at_once_are_refused():
    both = xr.DataArray(UNITS.Quantity([5.0], "mm"), attrs={"units": "m"})
    refused(lambda: carom.Grid({"first.radius": both}), "radius: it has two units")
    refused(lambda: carom.rebound(UNITS.Quantity(-7.0, "dB"), 1.44), "psi_1: ", "not a pure number")


PURE = {
    "rebound": lambda psi: carom.rebound(psi, 1.44),
    "law": carom.laws.ReboundLaw(1.44),
    "contact law": lambda psi: carom.dem.LinearSpring().rebound(psi, 1.44),
    "solve": lambda psi: carom.solve(psi, 1.44),
    "curve": lambda psi: carom.curve(1.44, psi),
}


@pytest.mark.parametrize("call", PURE.values(), ids=PURE)
@pytest.mark.parametrize(
    "psi",
    [
        *(UNITS.Quantity(0.5, "mm"), UNITS.Quantity([0.5], "mm"), [UNITS.Quantity(0.5, "mm")]),
        xr.DataArray([0.5], attrs={"units": "mm"}),
        *(True, [True], np.array([True]), b"1", bytearray(b"1"), np.array([b"1"]), 1j),
        *(np.complex128(0.5), np.timedelta64(5, "s"), np.array(["2020-01-01"], "M8[D]")),
        *("5 mm", None, 10**400, {"psi": 0.5}),
    ],
    ids=str,
)
def test_what_is_no_pure_number_is_refused(call, psi):
    refused(lambda: call(psi), "psi_1: ", "cannot be used")


@pytest.mark.parametrize("key", ["units", "unit", "Units", "Unit", "UNITS", "UNIT"])
@pytest.mark.parametrize("text", ["mm/s", b"mm/s"])
def test_units_are_heeded_however_the_attribute_is_written(key, text):
    """In one number, in an axis, in a column of a dataset: everywhere 2 mm/s or so, never 2 m/s."""
    speeds = xr.DataArray([1.0, 2.0], dims="row", attrs={key: text})
    assert carom.impact(PAIR, speed=speeds[1], angle=0.1).normal_speed < 2.001e-3
    assert carom.Grid({"speed": speeds})._coords()["speed"][1] == pytest.approx([1e-3, 2e-3])
    for source in (xr.Dataset({"speed": speeds}), {"speed": speeds}):
        speed = carom.Table(source).inputs((slice(0, 2),))["speed"]
        assert speed == pytest.approx([1e-3, 2e-3], rel=1e-15)
    basis = {"normal_speed": speeds, "tangential_speed": speeds}
    assert carom.convert_observables(PAIR, known=basis, wanted="speed")[0] < 2e-3


@pytest.mark.parametrize("key", ["unit", "Units", "UNITS"])
def test_two_attributes_must_tell_one_unit(key):
    one = xr.DataArray(5.0, attrs={"units": "mm", key: "mm"})
    assert carom.Sphere(radius=one, material="steel").radius == 0.005
    two = xr.DataArray(5.0, attrs={"units": "mm", key: "m"})
    refused(lambda: carom.Sphere(radius=two, material="steel"), "radius: it has two units")
    refused(lambda: carom.Table({"first.radius": two.expand_dims("row")}), "two units, mm and m")
    alone = xr.DataArray(UNITS.Quantity([5.0], "mm"), attrs={key: "m"})
    refused(lambda: carom.Grid({"first.radius": alone}), "radius: it has two units")


@pytest.mark.parametrize("key", ["scale_factor", "add_offset"])
def test_packed_numbers_of_a_file_are_refused(key):
    packed = xr.DataArray([5, 6], dims="row", attrs={"units": "m/s", key: 0.01})
    for source in ({"speed": packed}, xr.Dataset({"speed": packed})):
        refused(lambda source=source: carom.Table(source), "speed: ", key, "decode_cf")
    refused(lambda: carom.Grid({"speed": packed}), "speed: ", key)


ALONG = {
    "rebound": lambda a, b: carom.rebound(a, b),
    "contact law": lambda a, b: carom.dem.LinearSpring().rebound(a, b),
    "contact law, kappa": lambda a, b: carom.dem.LinearSpring().rebound(a, 1.44, kappa=b),
    "mixture": lambda a, b: carom.laws.ReboundLaw((1.2, 1.3))(a, b),
    "convert": lambda a, b: carom.convert_observables(
        PAIR, known={"angle": a, "contact_beta": b, "normal_restitution": 1.0}, wanted="psi_out"
    ),
    "load path": lambda a, b: carom.load_path(PAIR, normal_force=a, tangential_force=0.01 * b),
    "classical": lambda a, b: carom.classical.cattaneo_mindlin(
        PAIR, normal_force=a, tangential_force=0.01 * b
    ),
    "wear": lambda a, b: carom.wear_of_many(PAIR, speed=a, angle=b, progress=False, n=3),
    "sweep": lambda a, b: carom.Table({"angle": a, "friction": b}),
    "fit": lambda a, b: carom.fit({"angle": a, "contact_beta": b, "speed": a}, pair=PAIR),
    "score": lambda a, b: carom.verify.score({"psi_1": a, "psi_2": b}, chi=1.44),
    "experiment": lambda a, b: carom.verify.Experiment(
        pair=PAIR, law=LAWS[1], normal_speed=0.1, tangential_speed=a, spin=b, steps=99
    ),
    "collide": lambda a, b: carom.collide(PAIR, velocity1=_vectors(a), normal=_vectors(b)),
}
LABELLED = {
    "xarray": lambda labels: xr.DataArray([0.5, 0.6, 0.7], coords={"shot": labels}),
    "pandas": lambda labels: pd.Series([0.5, 0.6, 0.7], index=labels),
}


def _vectors(values):
    if isinstance(values, xr.DataArray):
        return values.expand_dims({"direction": 3}, axis=-1)
    return pd.DataFrame(dict.fromkeys("xyz", values))


@pytest.mark.first_case
@pytest.mark.parametrize("labelled", LABELLED.values(), ids=LABELLED)
@pytest.mark.parametrize("name", ALONG)
@pytest.mark.filterwarnings("ignore:.*left alone")  # vectors that are no normals
def test_what_has_other_labels_is_not_combined_by_place(name, labelled):
    first = labelled([0, 1, 2])
    for other in ([5, 6, 7], [2, 1, 0], [0, 1, 3], ["a", "b", "c"]):
        words = ("their labels along", "differ", "align them")
        refused(lambda other=other: ALONG[name](first, labelled(other)), *words)
    for same in (labelled([0, 1, 2]), np.array([0.5, 0.6, 0.7])):
        if name not in ("fit", "score"):  # which need other numbers
            ALONG[name](first, same)


IN_SPACE = {
    "load path": lambda moved: carom.load_path(PAIR, normal_force=10.0, displacement=moved),
    "collide": lambda moved: carom.collide(PAIR, velocity1=moved, normal=[0.0, 0.0, 1.0]),
}


@pytest.mark.parametrize(("name", "order"), [("load path", "yx"), ("collide", "zxy")])
def test_directions_have_an_order(name, order):
    """Components are read by place; labels that give another order are not passed over."""
    plain = xr.DataArray(1e-7 * np.ones((2, len(order))), dims=("step", "direction"))
    moved = plain.assign_coords(direction=list(order))
    refused(lambda: IN_SPACE[name](moved), "put direction into the order x, y, z")
    IN_SPACE[name](moved.sortby("direction"))


def test_a_masked_point_is_a_point_without_number():
    psi = np.ma.masked_array([0.5, 0.7], [False, True])
    out, status = carom.rebound(psi, 1.44, return_status=True)
    assert out[0] == carom.rebound(0.5, 1.44)
    assert np.isnan(out[1])
    assert status.tolist() == [carom.status.Status.SOLVED, carom.status.Status.PSI_NOT_FINITE]
    with pytest.warns(RuntimeWarning, match=r"1 of 2 .* index \(1,\): psi_1 must be a finite"):
        carom.rebound(psi, 1.44)
    assert np.isnan(carom.laws.ReboundLaw(1.44)(psi)).tolist() == [False, True]


@pytest.mark.parametrize("law", LAWS, ids=str)
@pytest.mark.parametrize(
    ("chi", "kappa", "status"),
    [
        *((chi, None, LawStatus.CHI_NOT_POSITIVE) for chi in (0.0, -1.0, np.nan, np.inf)),
        *((1.44, kappa, LawStatus.KAPPA_NOT_POSITIVE) for kappa in (0.0, -1.0, np.nan, np.inf)),
    ],
)
def test_contact_laws_say_what_they_leave_unsolved(law, chi, kappa, status):
    value = law.rebound(0.5, chi, kappa=kappa, return_status=True)
    assert np.isnan(value[0])
    assert value[1] == status
    with pytest.warns(RuntimeWarning, match=status.message):
        assert np.isnan(law.rebound([0.5, 1.0], chi, kappa=kappa)).all()


@pytest.mark.parametrize("law", LAWS[:2], ids=str)
def test_a_chi_that_is_too_large_costs_no_time(law):
    """A thousand of them in no time: each would take seconds to show that it cannot be solved."""
    chi = np.full(1000, 1e15)
    out, status = law.rebound(0.5, chi, return_status=True)
    assert np.isnan(out).all()
    assert set(status.tolist()) == {LawStatus.CHI_TOO_LARGE}
    for normal in (None, carom.KelvinVoigt(restitution=0.9)):
        out, status = carom.rebound(0.5, chi[:10], losses=normal, return_status=True)
        assert np.isnan(out).all()
        assert np.all(status != 0)


def test_losses_with_a_large_chi_are_not_taken_for_sliding():
    """At chi = 5000 an impact with psi_1 = 15000 sticks before it leaves, |psi_2| is of order one.

    Taken for one that slides throughout it would leave with 5000.
    """
    losses = carom.KelvinVoigt(restitution=0.9)
    out, status = carom.rebound(15000.0, 5000.0, losses=losses, return_status=True)
    assert status == carom.status.Status.TOO_MANY_PHASES
    assert np.isnan(out)
    assert abs(carom.rebound(3000.0, 1000.0, losses=losses)) < 3.0


LOSSES, MANY = "carom.KelvinVoigt(restitution=0.9)", carom.KelvinVoigt([0.9, 0.8])
TAKE_LOSSES = (
    *(partial(carom.solve, 0.5, 1.44), partial(carom.curve, 1.44, 0.5)),
    *(partial(carom.rebound, 0.5, 1.44), partial(carom.laws.ReboundLaw, 1.44)),
    partial(carom.impact, PAIR, speed=1.0),
)
TINY = {"material": "steel", "radius": 1e-120}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        *((lambda call=call: call(losses=0.9), ("losses: ", LOSSES)) for call in TAKE_LOSSES),
        *((lambda call=call: call(losses=MANY), ("losses: ",)) for call in TAKE_LOSSES[2:]),
        (lambda: carom.solve(0.5, 1.44, losses=carom.KelvinVoigt), ("losses: ", LOSSES)),
        (lambda: carom.KelvinVoigt(restitution=["most"]), ("restitution: ",)),
        (lambda: carom.Sphere(**TINY), ("radius: 1e-120", "check the units")),
        (lambda: carom.Sphere(material="steel", radius=1e120), ("radius: 1e+120",)),
        (lambda: carom.Sphere(material="steel", radius=10**400), ("radius: ", "cannot hold")),
        (lambda: carom.Sphere(material=10**5000, radius=1.0), ("material: this int",)),
        (lambda: carom.laws.ReboundLaw(1e15), ("chi: ", "at most 100")),
        (lambda: carom.laws.ReboundLaw((0.5, 1e15)), ("chi: ", "within 0.5 to 5")),
        (lambda: carom.verify.tune(chi=1e15), ("chi: ", "at most 10000")),
        (lambda: carom.verify.rank(chi=1e15), ("chi: ", "at most 10000")),
        (lambda: carom.rebound(np.zeros((10**5, 1)), np.ones(10**5)), ("psi_1, chi: ", "at once")),
        (lambda: carom.curve(np.ones(10**4), np.ones(10**4)), ("psi_1: ", "at most 1,000,000")),
        (lambda: carom.regime_map(np.ones(10**4), np.ones(10**4)), ("psi_1: ", "1,000,000")),
        (lambda: carom.solve(0.5, 1.44).history(10**9), ("n: ", "2 to 1000000")),
        (lambda: carom.rebound(0.5, 1.44, threads=10**9), ("threads: ", "1 to 1024")),
        (lambda: carom.dem.LammpsMindlin().rebound(0.5, 1.44, steps=10**9), ("steps: ",)),
        (lambda: carom.dem.LammpsMindlin().history(0.5, 1.44, steps=10**9), ("steps: ",)),
        (lambda: carom.BoundaryElements(steps=10**9), ("steps: ", "20 to 100000")),
        (lambda: carom.rebound(0.5, 1.44, return_status="no"), ("return_status: ",)),
    ],
)
def test_what_cannot_be_used_is_refused_in_one_line(call, words):
    refused(call, *words)


def test_fields_on_too_many_points_are_refused():
    hit, line = carom.impact(PAIR, speed=1.0), np.linspace(0.0, 1e-4, 32000)
    refused(lambda: hit.fields(1e-6, line, line), "x and y: ", "32000 by 32000 points")
    refused(lambda: hit.stress(1e-6, line, line), "x and z: ", "32000 by 32000 points")
    refused(lambda: hit.radial(1e-6, 10**9), "n: ", "2 to 100000")
    refused(lambda: hit.history(10**9), "n: ", "2 to 1000000")
    refused(lambda: hit.animate("hit.gif", frames=10**9), "frames: ", "1 to 10000")


def test_an_impact_that_cannot_be_solved_is_refused():
    """A thin pin of inertia has chi = 1e7; not a result that is NaN."""
    pin = carom.Sphere(radius="5 mm", material="steel", gyration_radius="1 um")
    pair = carom.Pair(pin, PAIR.second, friction=0.2)
    refused(lambda: carom.impact(pair, speed=1.0, angle=0.1), "chi: ", "not solved")


@pytest.mark.parametrize("text", ["1_000", "٣", "3.0", "1e3", "", "three", "0x10", "²", "1 000"])
def test_whole_numbers_are_ascii_digits(text):
    refused(lambda: whole("points", text, 2), "points: ", "whole number")
    assert whole("points", " +401 ", 2) == 401


@pytest.mark.parametrize("value", [True, 2.0, "2", np.timedelta64(2, "s"), None, [2], Decimal(2)])
def test_counts_are_whole_numbers(value):
    refused(lambda: counted("n", value, 1), "n: ", "whole number of at least 1")
    assert counted("n", np.int8(2), 1) == 2
    refused(lambda: counted("n", 10**5000, 1), "n: this int", "from 1 to 1000000")


def test_flags_and_words_are_what_they_seem():
    assert flag("inplace", np.bool_(True)) is True
    for value in (1, "yes", None, [True], np.ones(2)):
        refused(lambda value=value: flag("inplace", value), "inplace: ", "True or False")
    assert one_of("measure", "max", ("max", "rms")) == "max"
    for value in (["max"], np.array(["max", "rms"]), b"max", "Max", {}):
        refused(lambda value=value: one_of("measure", value, ("max", "rms")), "measure: ", "max")
