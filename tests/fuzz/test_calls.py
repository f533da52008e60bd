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
from carom.sweeps.problem import SweepProblem

SECONDS = 5.0  # of a call
TOLD = ("give NaN", "left alone")  # in warnings that say what became of some points
LINE = re.compile(r"[^\n:]{1,300}: [^\n]+")
UNITS = pint.get_application_registry()
NAN, INF = float("nan"), float("inf")

SCALARS = (
    *(None, True, False, b"1", NAN, INF, -INF, -1, 0, 1, 2, 1e300, -1e300, 1e-300, 10**400, 1e15),
    *(10**9, 0.5, -0.5, 1j, "", "5", "5 mm", "~2", "1_000", "٣", "nan", "1e999", Decimal("0.5")),
    *("first", "steel", "x" * 1000, "two\nlines", datetime.datetime(2020, 1, 1)),
    *(np.float32(0.5), np.int8(3), np.array(0.5), np.array(True), np.float64(NAN), np.ma.masked),
    *(np.timedelta64(5, "s"), UNITS.Quantity(0.5, "mm"), UNITS.Quantity(2.0, "s")),
    *(UNITS.Quantity(0.5, ""), UNITS.Quantity(20.0, "degC"), 10**5000, 5e-324, 1.7e308),
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
    *(
        RECORDS,
        RECORDS[0],
        RECORDS.view(np.recarray),
        np.ma.masked_array(RECORDS),
        RECORDS.reshape(2, 1),
    ),
    *(
        np.zeros(2, "V8"),
        np.zeros(2, [("psi_1", "f8", 2), ("psi_2", "f8")]),
        [{}],
        [[]],
        [["psi_out"]],
    ),
    *([np.array(["psi_out"])], pd.Series(["psi_out"]), ("psi_out",), {"psi_out"}, [pd.NA], pd.NA),
)
THINGS = (
    int,
    lambda *_: None,
    object(),
    carom.KelvinVoigt,
    carom.KelvinVoigt(restitution=0.9),
    iter([1]),
)
HOSTILE = (*SCALARS, *MANY, *THINGS)


@cache
def tables():
    """Callables with valid arguments by name: those that take a millisecond, and the rest."""
    BALL = carom.Sphere(radius="5 mm", material="steel")
    WALL = carom.HalfSpace(material="steel")
    PAIR = carom.Pair(BALL, WALL, friction=0.2)
    BALLS = carom.Pair(BALL, BALL, friction=0.2)
    HIT = carom.impact(PAIR, speed=2.0, angle="30 deg")
    LOSSY = carom.KelvinVoigt(restitution=0.9)
    PATH = carom.load_path(PAIR, normal_force="10 N", tangential_force=[0.0, 1.0])
    SOLVED, LOST = carom.solve(0.5, 1.44), carom.solve(1.5, 1.44, losses=LOSSY)
    LAW, MIXED = carom.laws.ReboundLaw(1.44), carom.laws.ReboundLaw((1.2, 1.3))
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
    MOTION = {"spin": 3.0, "spin2": 1.0, "losses": None, "method": "exact", "progress": False}
    MOTION["normal_spin"] = 100.0
    POLAR, CARTESIAN = {"speed": 2.0, "angle": 0.5}, {"normal_speed": 1.0, "tangential_speed": 0.5}
    STEPS = {"normal_force": "10 N", "tangential_force": [0.0, 1.0, -1.0]}
    PLACES = {"x": [0.0, 1e-5], "y": [0.0], "points": None}
    BELOW = {"x": [0.0, 1e-5], "z": [0.0, 1e-5], "points": None, "body": "second"}
    VECTORS = {"velocity1": [[1.0, 0.0, 1.0]], "spin1": [0.0, 1.0, 0.0], "velocity2": None}
    INSIDE = {"at": 5e-6}
    CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 2.0, "friction": 0.2}
    GRID = carom.Grid({"angle": [0.1, 0.5]})

    cheap = {  # callables and valid arguments by name
        "Material": (carom.Material, {"young": 2e11, "poisson": 0.3, "density": 7850.0,
                                      "yield_strength": "1 GPa", "name": "stuff"}),
        "material": (carom.material, {"name": "steel"}),
        "Sphere": (carom.Sphere, {"radius": 0.01, "material": "steel", "inner_radius": 0.001}),
        "Sphere, K": (carom.Sphere, {"radius": 0.01, "material": WALL.material,
                                      "gyration_radius": 0.005}),
        "HalfSpace": (carom.HalfSpace, {"material": "steel"}),
        "Cup": (carom.Cup, {"radius": 0.01, "material": "steel"}),
        "Pair": (carom.Pair, {"first": BALL, "second": WALL, "friction": 0.2}),
        "KelvinVoigt": (carom.KelvinVoigt, {"restitution": 0.9}),
        "KelvinVoigt, time": (carom.KelvinVoigt, {"loss_time": 1e-6}),
        "ElasticPlastic": (carom.ElasticPlastic, {"yield_velocity": 0.1}),
        "StandardLinearSolid": (
            carom.StandardLinearSolid,
            {"modulus_ratio": 1.5, "relaxation_time": 1e-5},
        ),
        "impact": (carom.impact, {"pair": BALLS, **POLAR, **MOTION}),
        "impact, components": (carom.impact, {"pair": BALLS, **CARTESIAN, **MOTION}),
        "impact, losses": (carom.impact, {"pair": PAIR, **CARTESIAN, "losses": LOSSY}),
        "rebound": (carom.rebound, {"psi": [0.5, 1.0], "chi": 1.44, "threads": 1, "losses": None}),
        "rebound, status": (carom.rebound, {"psi": 0.5, "chi": 1.44, "return_status": True}),
        "rebound, losses": (carom.rebound, {"psi": 0.5, "chi": 1.44, "losses": LOSSY}),
        "solve": (carom.solve, {"psi": 0.5, "chi": 1.44, "losses": None}),
        "solve, losses": (carom.solve, {"psi": 0.5, "chi": 1.44, "losses": LOSSY}),
        **{f"{kind}.{name}": (getattr(each, name), {argument: value})
           for kind, each in (("solution", SOLVED), ("lossy", LOST))
           for name, argument, value in (("at", "time", [0.1, 1.0]), ("history", "n", 5))},
        **{name: (getattr(SOLVED, name), {"time": 1.0})
           for name in ("memory", "phase_at", "slip_rate")},
        **{name: (getattr(SOLVED, name), {"time": 1.0, "radii": [0.0, 0.5]})
           for name in ("traction", "slid")},
        "slip_angles": (SOLVED.slip_angles, {"lateral_ratio": 0.2}),
        "curve": (carom.curve, {"chi": 1.44, "psi": [0.0, 1.0], "losses": None}),
        "regime_map": (carom.regime_map, {"psi": [0.5, 2.0], "chi": 1.44, "progress": False}),
        "law": (LAW, {"psi": [0.5, 2.0]}),
        "impulse": (LAW.impulse, {"psi": [0.5, 2.0]}),
        "dissipation": (LAW.dissipation, {"psi": [0.5, 2.0]}),
        "from_dict": (carom.laws.ReboundLaw.from_dict, {"table": LAW.to_dict()}),
        "from_dict, items": (lambda **table: carom.laws.ReboundLaw.from_dict(table), LAW.to_dict()),
        "from_dict, one item": (_with_one(LAW), {"item": LAW.edges[1]}),
        "outputs": (lambda outputs: SweepProblem(CASE, GRID, outputs), {"outputs": ["psi_out"]}),
        "table": (read_table, {"source": RECORDS, "columns": None}),
        "mixture": (MIXED, {"psi": [0.5, 2.0], "chi": 1.25, "return_status": False}),
        "SmoothLaw": (carom.laws.SmoothLaw, {"restitution": 0.9}),
        "RoughLaw": (carom.laws.RoughLaw, {"restitution": 0.9}),
        "WaltonLaw": (carom.laws.WaltonLaw, {"friction": 0.2, "restitution": 0.9,
                                        "tangential_restitution": 0.4}),
        **{kind.__name__: (kind, given) for kind, given in LAWS.items()},
        **{f"{kind.__name__}.rebound": (kind(**given).rebound, {"psi": [0.5, 2.0], "chi": 1.44,
                                        "kappa": 0.8, "steps": 50, "threads": 1})
           for kind, given in LAWS.items()},
        **{f"{kind.__name__}.history": (kind(**given).history, {"psi": 0.5, "chi": 1.44,
                                        "kappa": 0.8, "steps": 50})
           for kind, given in LAWS.items() if kind is not dem.HardSphere},
        "FunctionLaw": (dem.FunctionLaw, {"function": OWN.function, "name": "own", "pair": PAIR,
                                            "normal": "linear", "restitution": 0.9,
                                            "normal_speed": 0.1}),  # a state may be anything
        "FunctionLaw.rebound": (OWN.rebound, {"psi": [0.5, 2.0], "chi": 1.44, "kappa": 0.8,
                                              "steps": 50, "threads": 1}),
        "FunctionLaw.history": (OWN.history, {"psi": 0.5, "chi": 1.44, "kappa": 0.8, "steps": 50}),
        "FunctionRebound": (dem.FunctionRebound, {"function": RULE.function, "name": "own"}),
        "FunctionRebound.rebound": (RULE.rebound, {"psi": [0.5, 2.0], "chi": 1.44, "kappa": 0.8,
                                                   "return_status": False}),
        "force_error, own": (verify.force_error, {"law": OWN, "psi": 0.5, "chi": 1.44}),
        "collide": (carom.collide, {"pair": PAIR, **VECTORS, "normal": [0.0, 0.0, 1.0], "law": None,
                                    "inplace": False, "threads": 1}),
        "collide, balls": (carom.collide, {"pair": BALLS, **VECTORS, "spin2": [0.0, 0.0, 1.0],
                                           "normal": [0.0, 0.0, 1.0], "law": laws.RoughLaw()}),
        "collide, judged": (carom.collide, {"pair": PAIR, **VECTORS, "normal": [0.0, 0.0, 1.0],
                                            "judge": True}),
        "convert": (
                    lambda wanted, **known: convert(PAIR, known=known, wanted=wanted),
                    {"speed": 2.0, "angle": [0.1, 0.5], "contact_beta": 0.3, "spin": 1.0,
                     "normal_restitution": 0.9, "wanted": "rebound_angle"}),
        "convert, all": (convert, {"pair": PAIR, "known": POLAR, "wanted": "normal_speed"}),
        "load_path": (carom.load_path, {"pair": PAIR, **STEPS}),
        "load_path, moved": (carom.load_path, {"pair": PAIR, "penetration": [1e-6, 2e-6],
                                               "displacement": 1e-7}),
        "load_path, two ways": (carom.load_path, {"pair": PAIR, "normal_force": 10.0,
                                "displacement": [[1e-7, 0.0], [1e-7, 1e-7]], "progress": False}),
        "load_path, pushed": (carom.load_path, {"pair": PAIR, "penetration": [1e-6, 2e-6],
                              "tangential_force": [[0.5, 0.0], [0.0, 0.5]]}),
        "then": (PATH.then, STEPS),
        "path.contact": (PATH.contact, {"at": 1}),
        "path.fields": (PATH.fields, {"at": 1, **PLACES}),
        "path.radial": (PATH.radial, {"at": 1, "n": 3}),
        "hit.contact": (HIT.contact, INSIDE),
        "hit.fields": (HIT.fields, {**INSIDE, **PLACES}),
        "hit.radial": (HIT.radial, {**INSIDE, "n": 3}),
        "hit.history": (HIT.history, {"n": 3}),
        "cattaneo_mindlin": (classical.cattaneo_mindlin, {"pair": PAIR, "normal_force": 10.0,
                                                          "tangential_force": [1.0]}),
        "loop_energy": (classical.loop_energy, {"pair": PAIR, "normal_force": 10.0,
                                                "amplitude": 1.0}),
        "critical_obliquity": (classical.critical_obliquity, {"pair": PAIR}),
        "BoundaryElements": (carom.BoundaryElements, {"elements": 16, "steps": 50}),
        "Grid": (lambda **axes: carom.Grid(axes), {"angle": [0.1, 0.2], "friction": {
            "from": 0.1, "to": 0.2, "points": 3}}),
        "Grid, range": (lambda **ends: carom.Grid({"angle": {key.strip("_"): value for key, value
            in ends.items()}}), {"from_": 0.1, "to": 0.2, "points": 3, "spacing": "log"}),
        "Grid, axes": (carom.Grid, {"axes": {"angle": [0.1]}}),
        "LatinHypercube": (carom.LatinHypercube, {"ranges": {"friction": (0.1, 0.2)}, "samples": 5,
                                                  "seed": 1}),
        "stiffnesses": (verify.stiffnesses, {"pair": PAIR, "normal_speed": 1.0}),
        "poisson_from_kappa": (verify.poisson_from_kappa, {"kappa": 0.8}),
        "damping": (verify.damping_from_restitution,
                    {"restitution": 0.9, "convention": "critical"}),
        "restitution": (verify.restitution_from_damping, {"value": 0.1, "convention": "thornton"}),
        "recipes": (verify.recipes, {"pair": PAIR, "normal_speed": 1.0, "wanted": 0.9,
                                     "spring": dem.LinearSpring(),
                                     "mindlin": dem.LammpsMindlin()}),
        "Experiment": (verify.Experiment, {"pair": PAIR, "law": dem.LammpsMindlin(), "steps": 99,
                                           "normal_speed": 0.1, "tangential_speed": (0.1, 0.0),
                                           "spin": (0.0, 1.0)}),
        "force_error": (verify.force_error, {"law": dem.LinearSpring(), "psi": 0.5, "chi": 1.44,
                                             "kappa": 0.8}),
        "error_map": (verify.error_map, {"law": dem.HardSphere(0.4), "psi": [0.5, 1.0],
                                         "chi": 1.44, "kappa": 0.8, "steps": 50}),
        "bench": (verify.bench, {"engine": verify.Lammps("/nowhere"), "steps": 100, "psi": [0.5]}),
        "Entry": (verify.Entry, {"label": "one", "law": dem.LinearSpring(), "used_by": ""}),
        "dataset": (carom.datasets.table, {"name": "kharaz2001"}),
    }  # fmt: skip
    costly = {
        "ReboundLaw": (carom.laws.ReboundLaw, {"chi": 1.44, "losses": None}),
        "MixtureLaw": (lambda low: carom.laws.ReboundLaw((low, 1.3)), {"low": 1.2}),
        "fit_walton": (carom.laws.fit_walton, {"pair": PAIR, "span": 5.0}),
        "hit.stress": (HIT.stress, {**INSIDE, **BELOW}),
        "path.stress": (PATH.stress, {"at": 1, **BELOW}),
        "hit.peaks": (HIT.peaks, {"depth": 1e-5}),
        "hit.wear": (HIT.wear, {"n": 3, "coefficient": 1e-13, "x": [0.0, 1e-5], "y": [0.0]}),
        "hit.spectrum": (HIT.spectrum, {"frequencies": [0.0, 1e5]}),
        "hit.spectrum, n": (HIT.spectrum, {"max_frequency": 1e5, "n": 3}),
        "strength": (carom.bearable_speeds, {"pair": PAIR, "angle": [0.5], "friction": [0.2],
                                      "workers": 1, "progress": False}),
        "wear": (carom.wear_of_many, {"pair": PAIR, **POLAR, "spin": 1.0, "counts": [1.0, 2.0],
                              "coefficient": 1e-13, "area": 1e-4, "n": 3, "losses": None}),
        "wear, components": (carom.wear_of_many, {"pair": BALLS, **CARTESIAN, "spin2": 1.0}),
        "sweep": (carom.sweep, {"case": CASE, "design": GRID, "outputs": ["psi_out"], "workers": 1,
                                "progress": False, "scheduler": None, "resume": False}),
        "step_error": (verify.step_error, {"law": dem.LinearSpring(), "steps": 50, "psi": [0.5],
                                           "chi": 1.44, "kappa": 0.8}),
        "advised_steps": (verify.advised_steps, {"law": dem.LinearSpring(), "allowed": 0.1,
                                                 "psi": [0.5], "chi": 1.44, "kappa": 0.8}),
        "rank": (verify.rank, {"entries": [dem.LinearSpring()], "chi": 1.44, "kappa": 0.8,
                               "psi": [0.5], "progress": False}),
        "tune": (verify.tune, {"laws": [dem.HardSphere()], "chi": 1.44, "kappa": 0.8,
                               "psi": [0.5], "measure": "max", "progress": False}),
        "score": (verify.score, {"results": {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.0, -1.0]},
                                 "case": None, "chi": 1.44, "tolerance": 0.01, "code": "own",
                                 "law": "new", "restitution": 0.9}),
        "score, own": (verify.score, {"results": OWN, "case": PAIR, "chi": None, "code": "own",
                                      "restitution": None, "tolerance": 0.01}),
        "rank, own": (verify.rank, {"entries": [OWN, RULE], "chi": 1.44, "kappa": 0.8,
                                    "psi": [0.5], "progress": False}),
    }  # fmt: skip
    return cheap, costly


OPEN = {  # NaN or infinity that the docstring tells
    *("law", "impulse", "dissipation", "convert", "convert, all", "Material", "error_map", "tune"),
    *(
        "KelvinVoigt",
        "KelvinVoigt, time",
        "ElasticPlastic",
        "StandardLinearSolid",
        "rank",
        "step_error",
        "Grid, range",
    ),
    *("RoughLaw", "sweep", "force_error", "force_error, own", "memory", "Entry", "rank, own"),
    *("hit.spectrum", "hit.spectrum, n", "strength", "wear", "wear, components"),
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


def complaint(name, function, given):
    """Return what is wrong with how a call ends, or nothing."""
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            with within(SECONDS):
                result = function(**given)
        except TooLong:
            return "takes too long"
        except carom.InputError as error:
            line = str(error)
            return "" if LINE.fullmatch(line) and len(line) < 1000 else f"no line: {line!r}"
        except Exception as error:
            return f"{type(error).__name__}: {error}"
    told = [str(each.message) for each in warned]
    others = [each for each in told if not any(words in each for words in TOLD)]
    explained = len(others) < len(told) or name in OPEN or given.get("return_status") is True
    if others:
        return f"warns: {others[0]}"
    return "" if explained or not is_open(result) else f"not finite: {result!r:.200}"


def hostile_call(chance, table):
    name = chance.choice(sorted(table))
    function, valid = table[name]
    worse = chance.sample(sorted(valid), min(len(valid), chance.choice((1, 1, 2))))
    given = {**valid, **{key: chance.choice(HOSTILE) for key in worse}}
    if callable(given.get("progress")):  # what it raises is the caller's
        given["progress"] = 0.5
    return name, function, given, worse


def run(chance, table, count):
    for _ in range(count):
        name, function, given, worse = hostile_call(chance, table)
        wrong = complaint(name, function, given)
        shown = ", ".join(f"{key}={_shown(given[key])}" for key in worse)
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


def refused_or_told(name, function, given):
    """What is wrong if a call takes numbers with a unit of which nothing is known as bare ones."""
    try:
        function(**given)
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
                given = {**valid, argument: strange}
                told = refused_or_told(f"{name}, {argument}={strange!r:.80}", function, given)
                wrong += [told] if told else []
    assert not wrong, "\n".join(wrong)


@pytest.mark.usefixtures("compiled")
def test_hostile_calls(calls):
    cheap, costly = tables()
    run(random.Random(0), cheap, calls)
    run(random.Random(1), costly, calls // 100)
