"""Hostile calls of the whole Python interface: a result, or one line that names the argument.

Of valid arguments one or two are replaced. What comes back is finite, or its NaN is explained by a
status, by one warning or by the docstring; what is refused is refused in one line, within seconds.
"""

import datetime
import random
import re
import signal
import warnings
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from decimal import Decimal
from functools import cache

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import carom
from carom import classical, convert_observables as convert, dem, laws, verify
from carom.io.tables import read_table
from carom.many.sweeps.problem import SweepProblem

SECONDS = 5.0  # of a call
TOLD = ("give NaN", "left alone")  # in warnings that say what became of some points
LINE = re.compile(r"[^\n:]{1,300}: [^\n]+")
UNITS = pint.get_application_registry()
NAN, INF = float("nan"), float("inf")

EXTREME = (5e-324, 1e-310, 1e-200, 1e-100, 1e100, 1e200, 1.7e308)
SCALARS = (
    *(None, True, False, b"1", NAN, INF, -INF, -1, 0, 1, 2, 1e300, -1e300, 1e-300, 10**400, 1e15),
    *(10**9, 0.5, -0.5, 1j, "", "5", "5 mm", "~2", "1_000", "٣", "nan", "1e999", Decimal("0.5")),
    *("first", "steel", "x" * 1000, "two\nlines", datetime.datetime(2020, 1, 1)),
    *(np.float32(0.5), np.int8(3), np.array(0.5), np.array(True), np.float64(NAN), np.ma.masked),
    *(np.timedelta64(5, "s"), UNITS.Quantity(0.5, "mm"), UNITS.Quantity(2.0, "s")),
    *(UNITS.Quantity(0.5, ""), UNITS.Quantity(20.0, "degC"), 10**5000, *EXTREME),
)
RECORDS = np.array([(0.5, 0.1), (1.0, -0.2)], [("psi_1", "f8"), ("psi_2", "f8")])
MANY = (
    *([], [0.5], [0.5, 1.0], [[0.5, 1.0], [1.0, 2.0]], [[1.0], [1.0, 2.0]], ["1 mm", "2 mm"]),
    *([True, 1.0], [None], ["a"], [b"1"], [NAN, 1.0], [INF], [1j], (), {}, {"a": 1}, {1.0}),
    *(np.zeros(0), np.zeros((3, 0)), np.zeros((2, 3)), np.ones(3), np.ones((2, 2, 2))),
    *(np.float32([0.5, 1.0]), np.int8([1, 2]), np.array([True]), np.array(["1", "x"])),
    *(np.array([1.0, None], dtype=object), np.array(["2020-01-01"], "M8[D]"), np.array([b"1"])),
    *(np.ma.masked_array([0.5, 1.0], [0, 1]), np.ma.masked_array([[0.0, 0.0, 1.0]], [[0, 0, 1]])),
    *(UNITS.Quantity([0.5, 1.0], "mm"), UNITS.Quantity([0.5, 1.0], "N"), pd.Series([0.5, 1.0])),
    *(xr.DataArray([0.5, 1.0]), xr.DataArray([0.5, 1.0], attrs={"units": "mm"}), range(3)),
    *(xr.Dataset({"a": 1.0}), pd.DataFrame({"a": [1.0]}), [0.5, [1.0, [2.0]]], bytearray(b"12")),
    *(RECORDS, RECORDS[0], RECORDS.view(np.recarray), np.ma.masked_array(RECORDS)),
    *(RECORDS.reshape(2, 1), np.zeros(2, "V8"), [{}], [[]], [["psi_out"]]),
    np.zeros(2, [("psi_1", "f8", 2), ("psi_2", "f8")]),
    *([np.array(["psi_out"])], pd.Series(["psi_out"]), ("psi_out",), {"psi_out"}, [pd.NA], pd.NA),
)
LOSSY = carom.KelvinVoigt(restitution=0.9)
THINGS = (int, lambda *_: None, object(), carom.KelvinVoigt, LOSSY, iter([1]))
HOSTILE = (*SCALARS, *MANY, *THINGS)


BALL = carom.Sphere(radius="5 mm", material="steel")
WALL = carom.HalfSpace(material="steel")
PAIR, BALLS = (carom.Pair(BALL, other, friction=0.2) for other in (WALL, BALL))
POLAR, CARTESIAN = {"speed": 2.0, "angle": 0.5}, {"normal_speed": 1.0, "tangential_speed": 0.5}
MOTION = {"spin": 3.0, "spin2": 1.0, "losses": None, "method": "exact", "progress": False}
MOTION["normal_spin"] = 100.0
AT_CHI = {"chi": 1.44, "kappa": 0.8}
SLIDING = {"tangential_damping": 0.5, "restitution": 0.9}
OWN = dem.FunctionLaw(lambda contact, state: (-1e-3 * contact.normal_force, state))
RULE = dem.FunctionRebound(lambda psi, chi: -0.4 * psi)
LAWS = {
    dem.LinearSpring: {"stiffness_ratio": 0.3, **SLIDING},
    dem.ExactContactLaw: {"springs": 16, "restitution": 0.9, "viscous_shear": True},
    dem.HertzLinearHistory: {"stiffness": 0.8, **SLIDING},
    dem.LammpsMindlin: {"variant": "mindlin", "stiffness": 1.0, "damping": "tsuji", **SLIDING},
    dem.LiggghtsHertz: {"restitution": 0.9},
    dem.EdemHertzMindlin: {"restitution": 0.9},
    dem.YadeMindlin: {"restitution": 0.9},
    dem.ThorntonLaw: {},
    dem.WaltonBraunLaw: {"stiffness_ratio": 0.3, "restitution": 0.9},
    dem.StrongeLaw: {"stiffness_ratio": 0.3, "restitution": 0.9},
    dem.HardSphere: {"tangential_restitution": 0.4, "restitution": 0.9},
}


TRACK = {"frame": range(12), "x": [10.0 * i + 0.1 * (i % 3) for i in range(12)]}
TRACK |= {"y": [500.0 - 20.0 * abs(i - 5.4) + 0.1 * (i % 2) for i in range(12)]}
TRACK |= {"mark_x": [x + 30.0 for x in TRACK["x"]], "mark_y": TRACK["y"]}


class Calls(dict):
    """Callables with valid arguments by name; a name says what is called, and in which way."""

    def add(self, name, function, /, **valid):
        assert name not in self
        self[name] = function, valid


def bodies_and_losses(calls):
    stuff = {"young": 2e11, "poisson": 0.3, "density": 7850.0, "yield_strength": "1 GPa"}
    calls.add("Material", carom.Material, **stuff, name="stuff")
    calls.add("material", carom.material, name="steel")
    calls.add("Sphere", carom.Sphere, radius=0.01, material="steel", inner_radius=0.001)
    weighted = {"material": WALL.material, "gyration_radius": 0.005}
    calls.add("Sphere, K", carom.Sphere, radius=0.01, **weighted)
    calls.add("HalfSpace", carom.HalfSpace, material="steel")
    calls.add("Cup", carom.Cup, radius=0.01, material="steel")
    leaning = {"angle": 0.5, "material": "steel", "in_space": True}
    calls.add("rod", carom.shapes.rod, length=0.1, radius=0.01, **leaning)
    rounded = {"length": 0.1, "radius": 0.02, "edge_radius": 0.005, "inner_radius": 0.01}
    calls.add("cylinder", carom.shapes.cylinder, **rounded, **leaning)
    calls.add("ellipsoid", carom.shapes.ellipsoid, semi_axes=(0.01, 0.02, 0.03), **leaning)
    turned = {"orientation": np.eye(3), "material": "steel"}
    calls.add("ellipsoid, turned", carom.shapes.ellipsoid, semi_axes=(0.01, 0.02, 0.03), **turned)
    centres = [(0.0, 0.0, 0.0), (0.0, 0.01, 0.02)]
    calls.add("clump", carom.shapes.clump, centres=centres, radii=0.01, **leaning)
    calls.add("clump, turned", carom.shapes.clump, centres=centres, radii=[0.01, 0.02], **turned)
    heavy = {"mass": 0.1, "curvatures": (300.0, 200.0), "material": "steel"}
    calls.add("Body", carom.Body, **heavy, inertia=1e-5, contact=(0.01, -0.02), name="rod")
    whole = {"inertia": np.diag([1e-5, 2e-5, 2e-5]), "contact": (0.01, 0.0, -0.02)}
    calls.add("Body, in space", carom.Body, **heavy, **whole)
    egg = carom.Pair(carom.Body(**heavy, **whole), WALL, friction=0.2)
    for name, at in {"": 0.0, ", sliding": [0.1, 0.2]}.items():
        spins = {"spin": [1.0, 2.0, 3.0], "spin2": 0.0, "normal_spin": 0.0}
        moving = {"normal_speed": 1.0, "tangential_speed": at, **spins}
        calls.add(f"impact of a body{name}", carom.impact, pair=egg, **moving, losses=None)
    calls.add("Pair", carom.Pair, first=BALL, second=WALL, friction=0.2)
    calls.add("KelvinVoigt", carom.KelvinVoigt, restitution=0.9)
    calls.add("KelvinVoigt, time", carom.KelvinVoigt, loss_time=1e-6)
    calls.add("ElasticPlastic", carom.ElasticPlastic, yield_velocity=0.1)
    calls.add("Metal", carom.Metal, flow_stress=4e8)
    solid = {"modulus_ratio": 1.5, "relaxation_time": 1e-5}
    calls.add("StandardLinearSolid", carom.StandardLinearSolid, **solid)
    basis = {"speed": 2.0, "angle": [0.1, 0.5], "contact_beta": 0.3, "spin": 1.0}
    basis |= {"normal_restitution": 0.9, "wanted": "rebound_angle"}
    calls.add("convert", lambda wanted, **names: convert(PAIR, known=names, wanted=wanted), **basis)
    calls.add("convert, all", convert, pair=PAIR, known=POLAR, wanted="normal_speed")
    force = {"pair": PAIR, "normal_force": 10.0}
    calls.add("cattaneo_mindlin", classical.cattaneo_mindlin, **force, tangential_force=[1.0])
    calls.add("loop_energy", classical.loop_energy, **force, amplitude=1.0)
    sticky = {**CARTESIAN, "spin": 3.0, "spin2": 1.0, "work_of_adhesion": 0.1}
    calls.add("adhesive_impact", classical.adhesive_impact, pair=BALLS, **sticky)
    calls.add("critical_obliquity", classical.critical_obliquity, pair=PAIR)
    scale = {"frame_rate": 1000.0, "pixels_per_mm": 10.0}
    calls.add("track", lambda **columns: carom.track(columns, **scale), **TRACK)
    options = {"plate_angle": 0.1, "gravity": 9.8, "y_down": True, "columns": None, **scale}
    calls.add("track, all", carom.track, source=TRACK, **options)
    calls.add("dataset", carom.datasets.table, name="kharaz2001")
    calls.add("table", read_table, source=RECORDS, columns=None)


def rebounds(calls):
    solved, lost = carom.solve(0.5, 1.44), carom.solve(1.5, 1.44, losses=LOSSY)
    one = {"psi_1": 0.5, "chi": 1.44}
    calls.add("rebound", carom.rebound, psi_1=[0.5, 1.0], chi=1.44, threads=1, losses=None)
    calls.add("rebound, status", carom.rebound, **one, return_status=True)
    calls.add("rebound, losses", carom.rebound, **one, losses=LOSSY)
    calls.add("solve", carom.solve, **one, losses=None)
    calls.add("solve, losses", carom.solve, **one, losses=LOSSY)
    for kind, each in (("solution", solved), ("lossy", lost)):
        calls.add(f"{kind}.at", each.at, time=[0.1, 1.0])
        calls.add(f"{kind}.history", each.history, n=5)
    for name in ("memory", "phase_at", "slip_rate"):
        calls.add(name, getattr(solved, name), at=1.0)
    for name in ("traction", "slid"):
        calls.add(name, getattr(solved, name), at=1.0, radii=[0.0, 0.5])
    calls.add("slip_angles", solved.slip_angles, lateral_ratio=0.2)
    calls.add("curve", carom.curve, chi=1.44, psi_1=[0.0, 1.0], losses=None)
    calls.add("regime_map", carom.regime_map, psi_1=[0.5, 2.0], chi=1.44, progress=False)


def tabulated(calls):
    law, mixed = carom.laws.ReboundLaw(1.44), carom.laws.ReboundLaw((1.2, 1.3))
    for name, each in (("law", law), ("impulse", law.impulse), ("dissipation", law.dissipation)):
        calls.add(name, each, psi_1=[0.5, 2.0])
    from_dict = carom.laws.ReboundLaw.from_dict
    calls.add("from_dict", from_dict, table=law.to_dict())
    calls.add("from_dict, items", lambda **table: from_dict(table), **law.to_dict())
    calls.add("from_dict, one item", _with_one(law), item=law.edges[1])
    calls.add("mixture", mixed, psi_1=[0.5, 2.0], chi=1.25, return_status=False)
    calls.add("SmoothLaw", carom.laws.SmoothLaw, restitution=0.9)
    calls.add("RoughLaw", carom.laws.RoughLaw, restitution=0.9)
    both = {"restitution": 0.9, "tangential_restitution": 0.4}
    calls.add("WaltonLaw", carom.laws.WaltonLaw, friction=0.2, **both)


def contact_laws(calls):
    many, steps = {"psi_1": [0.5, 2.0], **AT_CHI}, {"steps": 50}
    for kind, data in LAWS.items():
        name = kind.__name__
        calls.add(name, kind, **data)
        calls.add(f"{name}.rebound", kind(**data).rebound, **many, **steps, threads=1)
        if kind is not dem.HardSphere:
            calls.add(f"{name}.history", kind(**data).history, psi_1=0.5, **AT_CHI, **steps)
    own = {"function": OWN.function, "name": "own"}  # a state may be anything
    own |= {"normal": "linear", "restitution": 0.9, "normal_speed": 0.1, "pair": PAIR}
    calls.add("FunctionLaw", dem.FunctionLaw, **own)
    calls.add("FunctionLaw.rebound", OWN.rebound, **many, **steps, threads=1)
    calls.add("FunctionLaw.history", OWN.history, psi_1=0.5, **AT_CHI, **steps)
    calls.add("FunctionRebound", dem.FunctionRebound, function=RULE.function, name="own")
    calls.add("FunctionRebound.rebound", RULE.rebound, **many, return_status=False)
    spring, speed = dem.LinearSpring(), {"pair": PAIR, "normal_speed": 1.0}
    calls.add("force_error", verify.force_error, law=spring, psi_1=0.5, **AT_CHI)
    calls.add("force_error, own", verify.force_error, law=OWN, psi_1=0.5, chi=1.44)
    grid = {"psi_1": [0.5, 1.0], **AT_CHI}
    calls.add("error_map", verify.error_map, law=dem.HardSphere(0.4), **grid, **steps)
    calls.add("stiffnesses", verify.stiffnesses, **speed)
    calls.add("poisson_from_kappa", verify.poisson_from_kappa, kappa=0.8)
    items = {"restitution": 0.9, "convention": "critical"}
    calls.add("damping", verify.damping_from_restitution, **items)
    items = {"value": 0.1, "convention": "thornton"}
    calls.add("restitution", verify.restitution_from_damping, **items)
    tuned = {"spring": spring, "mindlin": dem.LammpsMindlin()}
    calls.add("recipes", verify.recipes, **speed, wanted=0.9, **tuned)
    motion = {"normal_speed": 0.1, "tangential_speed": (0.1, 0.0), "spin": (0.0, 1.0)}
    data = {"pair": PAIR, "law": dem.LammpsMindlin(), "steps": 99}
    calls.add("Experiment", verify.Experiment, **data, **motion)
    calls.add("bench", verify.bench, engine=verify.Lammps("/nowhere"), steps=100, psi_1=[0.5])
    calls.add("Entry", verify.Entry, label="one", law=spring, used_by="")


def impacts_and_paths(calls):
    hit = carom.impact(PAIR, speed=2.0, angle="30 deg")
    path = carom.load_path(PAIR, normal_force="10 N", tangential_force=[0.0, 1.0])
    calls.add("impact", carom.impact, pair=BALLS, **POLAR, **MOTION)
    calls.add("impact, components", carom.impact, pair=BALLS, **CARTESIAN, **MOTION)
    calls.add("impact, losses", carom.impact, pair=PAIR, **CARTESIAN, losses=LOSSY)
    places = {"x": [0.0, 1e-5], "y": [0.0], "points": None}
    for name, each, at in (("hit", hit, 5e-6), ("path", path, 1)):
        calls.add(f"{name}.contact", each.contact, at=at)
        calls.add(f"{name}.fields", each.fields, at=at, **places)
        calls.add(f"{name}.radial", each.radial, at=at, n=3)
    calls.add("hit.history", hit.history, n=3)
    steps = {"normal_force": "10 N", "tangential_force": [0.0, 1.0, -1.0]}
    aside, pushed = [[1e-7, 0.0], [1e-7, 1e-7]], [[0.5, 0.0], [0.0, 0.5]]
    moved = {"pair": PAIR, "penetration": [1e-6, 2e-6]}
    calls.add("load_path", carom.load_path, pair=PAIR, **steps)
    calls.add("load_path, moved", carom.load_path, **moved, displacement=1e-7)
    data = {"normal_force": 10.0, "displacement": aside, "progress": False}
    calls.add("load_path, two ways", carom.load_path, pair=PAIR, **data)
    calls.add("load_path, pushed", carom.load_path, **moved, tangential_force=pushed)
    calls.add("then", path.then, **steps)
    vectors = {"velocity1": [[1.0, 0.0, 1.0]], "spin1": [0.0, 1.0, 0.0], "velocity2": None}
    vectors["normal"] = [0.0, 0.0, 1.0]
    data = {"law": None, "inplace": False, "threads": 1}
    calls.add("collide", carom.collide, pair=PAIR, **vectors, **data)
    data = {"spin2": [0.0, 0.0, 1.0], "law": laws.RoughLaw()}
    calls.add("collide, balls", carom.collide, pair=BALLS, **vectors, **data)
    calls.add("collide, judged", carom.collide, pair=PAIR, **vectors, judge=True)
    calls.add("BoundaryElements", carom.BoundaryElements, elements=16, steps=50)


CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 2.0, "friction": 0.2}
GRID = carom.Grid({"angle": [0.1, 0.5]})


def sweeps(calls):
    ends = {"from": 0.1, "to": 0.2, "points": 3}
    calls.add("outputs", lambda outputs: SweepProblem(CASE, GRID, outputs), outputs=["psi_out"])
    calls.add("Grid", lambda **axes: carom.Grid(axes), angle=[0.1, 0.2], friction=ends)
    calls.add("Grid, range", lambda **span: carom.Grid({"angle": span}), **ends, spacing="log")
    calls.add("Grid, axes", carom.Grid, axes={"angle": [0.1]})
    ranges = {"friction": (0.1, 0.2)}
    calls.add("LatinHypercube", carom.LatinHypercube, ranges=ranges, samples=5, seed=1)


def slow_ones(calls):
    """Those that take more than a millisecond."""
    hit = carom.impact(PAIR, speed=2.0, angle="30 deg")
    path = carom.load_path(PAIR, normal_force="10 N", tangential_force=[0.0, 1.0])
    calls.add("ReboundLaw", carom.laws.ReboundLaw, chi=1.44, losses=None)
    calls.add("MixtureLaw", lambda low: carom.laws.ReboundLaw((low, 1.3)), low=1.2)
    calls.add("fit_walton", carom.laws.fit_walton, pair=PAIR, span=5.0)
    below = {"x": [0.0, 1e-5], "z": [0.0, 1e-5], "points": None, "body": "second"}
    calls.add("hit.stress", hit.stress, at=5e-6, **below)
    calls.add("path.stress", path.stress, at=1, **below)
    calls.add("hit.peaks", hit.peaks, depth=1e-5)
    calls.add("hit.wear", hit.wear, n=3, coefficient=1e-13, x=[0.0, 1e-5], y=[0.0])
    calls.add("hit.spectrum", hit.spectrum, frequencies=[0.0, 1e5])
    calls.add("hit.spectrum, n", hit.spectrum, max_frequency=1e5, n=3)
    alone = {"workers": 1, "progress": False}
    calls.add("strength", carom.bearable_speeds, pair=PAIR, angle=[0.5], friction=[0.2], **alone)
    worn = {"spin": 1.0, "counts": [1.0, 2.0], "coefficient": 1e-13, "area": 1e-4, "n": 3}
    calls.add("wear", carom.wear_of_many, pair=PAIR, **POLAR, **worn, losses=None)
    calls.add("wear, components", carom.wear_of_many, pair=BALLS, **CARTESIAN, spin2=1.0)
    swept = {"case": CASE, "design": GRID, "outputs": ["psi_out"], "scheduler": None}
    calls.add("sweep", carom.sweep, **swept, **alone, resume=False)
    at = {"psi_1": [0.5], **AT_CHI}
    calls.add("step_error", verify.step_error, law=dem.LinearSpring(), steps=50, **at)
    calls.add("advised_steps", verify.advised_steps, law=dem.LinearSpring(), allowed=0.1, **at)
    calls.add("rank", verify.rank, entries=[dem.LinearSpring()], **at, progress=False)
    calls.add("rank, own", verify.rank, entries=[OWN, RULE], **at, progress=False)
    measure = {"measure": "max", "progress": False}
    calls.add("tune", verify.tune, laws=[dem.HardSphere()], **at, **measure)
    results = {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.0, -1.0]}
    data = {"case": None, "chi": 1.44, "law": "new", "restitution": 0.9}
    common = {"tolerance": 0.01, "code": "own"}
    calls.add("score", verify.score, results=results, **data, **common)
    data = {"results": OWN, "case": PAIR, "chi": None, "restitution": None}
    calls.add("score, own", verify.score, **data, **common)
    sets = [
        {"angle [deg]": [20, 45, 60, 70], "impulse_ratio": [0.2, 0.21, r, 0.2]} for r in (0.2, 0.19)
    ]
    how = {"share": "friction", "fixed": {"restitution": 1}, "vary": None, "robust": True}
    calls.add("joint_fit", carom.joint_fit, data=sets, pair=PAIR, confidence=0.95, **how)
    calls.add("fit", carom.fit, data=sets[0], pair=PAIR, confidence=0.95, fixed={"restitution": 1})


@cache
def tables():
    """Callables with valid arguments by name: those that take a millisecond, and the rest."""
    cheap, costly = Calls(), Calls()
    for fill in (bodies_and_losses, rebounds, tabulated, contact_laws, impacts_and_paths, sweeps):
        fill(cheap)
    slow_ones(costly)
    return cheap, costly


OPEN = {  # NaN or infinity that the docstring tells
    *("law", "impulse", "dissipation", "convert", "convert, all", "Material", "error_map", "tune"),
    *("KelvinVoigt", "KelvinVoigt, time", "ElasticPlastic", "StandardLinearSolid", "step_error"),
    *("RoughLaw", "sweep", "force_error", "force_error, own", "memory", "Entry", "rank, own"),
    *("hit.spectrum", "hit.spectrum, n", "strength", "wear", "wear, components", "rank"),
    *("Grid, range", "Metal", "adhesive_impact", "collide, judged"),
}


def _with_one(law):
    """A function that reads the table of a law with another item in the place of one."""

    def read(item):
        table = law.to_dict()
        table["edges"][1] = item
        return carom.laws.ReboundLaw.from_dict(table)

    return read


class TooLong(BaseException):
    """A call has not come back in time."""


@contextmanager
def within(seconds):
    def stop(*_):
        raise TooLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)  # of this process, however busy the machine is
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def is_open(value):
    """Whether some number in a result is not finite; of records in their public fields."""
    if isinstance(value, float | np.floating):
        return not np.isfinite(value)
    if isinstance(value, np.ndarray):
        return value.dtype.kind == "f" and not np.all(np.isfinite(value))
    if isinstance(value, xr.Dataset):
        return any(is_open(each.values) for each in value.variables.values())
    if isinstance(value, dict):
        return any(map(is_open, value.values()))
    if isinstance(value, list | tuple):
        return any(map(is_open, value))
    if is_dataclass(value) and not isinstance(value, type):
        status = getattr(value, "status", carom.status.Status.SOLVED)
        names = (each.name for each in fields(value) if not each.name.startswith("_"))
        return status == 0 and any(is_open(getattr(value, name)) for name in names)
    return False


def complaint(name, function, data):
    """Return what is wrong with how a call ends, or nothing."""
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            with within(SECONDS):
                result = function(**data)
        except TooLong:
            return "takes too long"
        except carom.InputError as error:
            line = str(error)
            return "" if LINE.fullmatch(line) and len(line) < 1000 else f"no line: {line!r}"
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    items = [str(each.message) for each in warned]
    others = [each for each in items if not any(words in each for words in TOLD)]
    explained = len(others) < len(items) or name in OPEN or data.get("return_status") is True
    if others:
        return f"warns: {others[0]}"
    return "" if explained or not is_open(result) else f"not finite: {result!r:.200}"


def hostile_call(chance, table):
    name = chance.choice(sorted(table))
    function, valid = table[name]
    worse = chance.sample(sorted(valid), min(len(valid), chance.choice((1, 1, 2))))
    data = {**valid, **{key: chance.choice(HOSTILE) for key in worse}}
    if callable(data.get("progress")):  # what it raises is the caller's
        data["progress"] = 0.5
    return name, function, data, worse


def run(chance, table, count):
    for _ in range(count):
        name, function, data, worse = hostile_call(chance, table)
        wrong = complaint(name, function, data)
        shown = ", ".join(f"{key}={_shown(data[key])}" for key in worse)
        assert not wrong, f"{name}({shown}): {wrong}"


def _shown(value):
    try:
        return repr(value)[:80]
    except ValueError:  # of integers with too many digits
        return "an integer"


@pytest.fixture(scope="module")
def compiled():
    """Every valid call once: without them refusals might come from the other arguments."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        cheap, costly = tables()
        for name, (function, valid) in (cheap | costly).items():
            if name != "bench":  # there is no such program
                function(**valid)


class Lengths(np.ndarray):
    """An array with a unit, as astropy and unyt make them; functions of NumPy drop it."""

    unit = "mm"

    def __array_wrap__(self, array, context=None, return_scalar=False):
        return np.asarray(array)


class Length(float):
    """A number with a unit."""

    units = "mm"


def with_unit(value):
    """What bears a unit instead of a valid argument, or of the numbers in it; None of others."""
    if isinstance(value, dict):
        return [{**value, k: each} for k, v in value.items() for each in with_unit(v)]
    if isinstance(value, bool | str) or value is None:
        return []
    if isinstance(value, int | float):
        return [np.asarray(value).view(Lengths), Length(value)]
    try:
        numbers = np.asarray(value)
    except ValueError:
        return []
    if numbers.dtype.kind not in "if":
        return []
    return [numbers.view(Lengths), [Length(each) for each in numbers.ravel()]]


def refused_or_told(name, function, data):
    """What is wrong if a call takes numbers with a unit of which nothing is known as bare ones."""
    try:
        function(**data)
    except carom.InputError:
        return ""
    except Exception as error:
        return f"{name}: {type(error).__name__}: {error}"
    return f"{name}: read as bare numbers"


@pytest.mark.usefixtures("compiled")
def test_quantities_of_other_libraries_are_never_bare_numbers():
    """Every argument of every function that takes numbers."""
    cheap, costly = tables()
    wrong = []
    for name, (function, valid) in (cheap | costly).items():
        for argument, value in valid.items():
            if argument in ("initial_state", "progress"):  # which may be anything
                continue
            for strange in with_unit(value):
                data = {**valid, argument: strange}
                reply = refused_or_told(f"{name}, {argument}={strange!r:.80}", function, data)
                wrong += [reply] if reply else []
    assert not wrong, "\n".join(wrong)


def sized(value):
    """Numbers of every size instead of a valid one, or of each in an array; none of others."""
    if isinstance(value, bool | str | dict) or value is None:
        return []
    try:
        numbers = np.asarray(value)
    except ValueError:
        return []
    if numbers.dtype.kind not in "if":
        return []
    signs = (1.0, -1.0) if np.any(numbers < 0.0) else (1.0,)
    sizes = [sign * size for sign in signs for size in EXTREME]
    return [np.full(numbers.shape, size).tolist() for size in sizes]


@pytest.mark.slow
@pytest.mark.usefixtures("compiled")
def test_numbers_of_every_size_in_every_argument():
    """A result, a status or one line, and no warning of NumPy's."""
    cheap, costly = tables()
    wrong = []
    for name, (function, valid) in (cheap | costly).items():
        for argument, value in valid.items():
            for size in sized(value):
                reply = complaint(name, function, {**valid, argument: size})
                wrong += [f"{name}, {argument}={size!r:.80}: {reply}"] if reply else []
    assert not wrong, "\n".join(wrong)


WRONG_NAMES = [0.3, None, {1.0}, [0.3], [None], [{}], b"x", int, object(), 1j, np.zeros((2, 2))]
WRONG_NAMES += ["", "frction", ["friction", 0.3], {"friction": 0.3}.values(), iter([1]), True]


@pytest.mark.parametrize("argument", ["share", "vary"])
@pytest.mark.parametrize("names", WRONG_NAMES, ids=lambda names: f"{type(names).__name__}")
def test_names_of_parameters_that_are_none(argument, names):
    _, costly = tables()
    function, valid = costly["joint_fit"]
    if names is None and argument == "vary":
        return  # what usually is varied
    with pytest.raises(carom.InputError, match=f"{argument}: "):
        function(**{**valid, argument: names})


@pytest.mark.usefixtures("compiled")
def test_hostile_calls(calls):
    cheap, costly = tables()
    run(random.Random(0), cheap, calls)
    run(random.Random(1), costly, calls // 100)
