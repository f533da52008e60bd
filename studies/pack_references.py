"""The reference numbers of the benchmark pack, computed; the pack holds them frozen.

An error is a bound: 1e-10 max(1, |psi_1|) for psi_2, which is ten times what impacts solved to 30
digits by another algorithm show, times what psi_2 is multiplied by on its way to SI units, plus the
rounding of this way and of 12 printed digits. Inputs are exact: they are what is printed.
"""

import sys
from decimal import ROUND_UP, Context, Decimal
from pathlib import Path

import numpy as np
from lammps_unittest import unit_test_yaml
from numpy.typing import ArrayLike

from carom.bodies.cases import motion_of, pair_of
from carom.bodies.kinematics import inertia
from carom.bodies.pairs import Pair
from carom.dimensionless.rebounds import rebound
from carom.impacts.exact import Impact
from carom.impacts.solve import impact
from carom.quantities.arrays import Array
from carom.verify.engines.experiments import AFTER, Outcomes
from carom.verify.pack.frozen import (
    ACCURACY,
    CASE,
    INPUTS,
    REFERENCE,
    DecimalTable,
    case_of,
    folders_with,
    frozen_files,
    inputs_of,
    read_table,
    title_of,
)
from carom.verify.pack.writing import experiment_of, is_one_experiment

ROUNDING = 2e-15  # of the few operations between psi and SI units, relative to their terms
TIMES = 101  # of a history
DIGITS = 12  # of every number
TOLERANCE = 0.01  # in psi_2, of a test of LAMMPS; that of the scorer
ERROR_DIGITS = Context(prec=2, rounding=ROUND_UP)
ERROR = "_error"  # the column of errors of a column ends so
BEFORE = ("normal_speed", "tangential_speed", "spin", "spin2")
SIGNS = (
    "SI units. Speeds of the first body relative to the second: normal_speed towards it before,",
    "normal_speed_out away from it after; tangential speeds along +x. Positive spin adds to the",
    "tangential speed of the contact point, V_x = tangential_speed + radius x spin.",
    "NAME_error bounds the error of NAME; columns without one are given, hence exact.",
)

Columns = dict[str, list[str]]


def references() -> dict[str, DecimalTable]:
    """Return every table of reference numbers by its path in the pack."""
    found: dict[str, DecimalTable] = {}
    for folder in folders_with(INPUTS):
        made = _of_cases if f"{folder}/{CASE}" in frozen_files() else _of_numbers
        found[f"{folder}/{REFERENCE}"] = made(folder)
    for folder in folders_with(CASE):
        if folder.startswith("histories/"):
            found[f"{folder}/{REFERENCE}"] = _of_history(folder)
    return found


def _of_numbers(folder: str) -> DecimalTable:
    inputs = inputs_of(folder)
    psi, chi = inputs.numbers("psi_1"), inputs.numbers("chi")
    error = ACCURACY * np.maximum(1.0, np.abs(psi))
    notes = (
        "psi_2 of elastic spheres, e = 1: psi = kappa V_x/(mu V_1), chi = (kappa/2)(m_n/m_t).",
        "psi_2 is odd in psi_1. psi_2_error bounds the error of psi_2; psi_1 and chi are exact.",
    )
    columns = exact("psi_1", psi) | exact("chi", chi)
    return DecimalTable(notes, columns | uncertain("psi_2", rebound(psi, chi), error))


def _of_cases(folder: str) -> DecimalTable:
    inputs, pair = inputs_of(folder), pair_of(case_of(folder))
    given = {name: inputs.numbers(name) for name in BEFORE if name in inputs.columns}
    rows = zip(*given.values(), strict=True)
    hits = [impact(pair, **dict(zip(given, row, strict=True))) for row in rows]
    columns: Columns = {}
    for name, values in given.items():
        columns |= exact(name, values)
    columns |= exact("normal_speed_out", given["normal_speed"])  # e = 1
    for name, (values, errors) in _outcomes(pair, hits).items():
        columns |= uncertain(name, values, errors)
    return DecimalTable((*title_of(folder), *SIGNS), columns)


def _column(hits: list[Impact], name: str) -> Array:
    return np.array([getattr(hit, name) for hit in hits])


def _outcomes(pair: Pair, hits: list[Impact]) -> dict[str, tuple[Array, Array]]:
    """Return what each impact gives, and the bounds of its error."""
    psi = _column(hits, "psi_in")
    impulse_error = pair.tangential_mass * _velocity_error(hits)
    found = {}
    levers = {"tangential_speed_out": 1.0 / pair.normal_mass}
    for name, body in zip(("spin_out", "spin2_out"), pair.moving, strict=False):
        levers[name] = body.radius / inertia(body)
    for name, lever in levers.items():
        before = np.abs(_column(hits, name.removesuffix("_out")))
        found[name] = (_column(hits, name), lever * impulse_error + ROUNDING * before)
    accuracy = ACCURACY * np.maximum(1.0, np.abs(psi))
    found["psi_in"] = (psi, ROUNDING * np.abs(psi))
    found["psi_out"] = (_column(hits, "psi_out"), accuracy)
    for name in ("duration", "max_force", "max_penetration"):
        values = _column(hits, name)
        found[name] = (values, 10.0 * ROUNDING * values)
    return found


def _velocity_error(hits: list[Impact]) -> Array:
    """Return the bound of the error of the change of V_x, in m/s."""
    psi, unit = _column(hits, "psi_in"), np.array([hit.scales.tangential_speed for hit in hits])
    before, after = _column(hits, "contact_velocity"), _column(hits, "contact_velocity_out")
    rounding = ROUNDING * (np.abs(before) + np.abs(after))
    return np.asarray(ACCURACY * np.maximum(1.0, np.abs(psi)) * unit + rounding)


def _of_history(folder: str) -> DecimalTable:
    case = case_of(folder)
    hit = impact(pair_of(case), **motion_of(case))
    history, pair, scales = hit.history(TIMES), hit.pair, hit.scales
    share = ACCURACY * max(1.0, abs(hit.psi_in))
    velocity_error = share * scales.tangential_speed
    impulse_error = pair.tangential_mass * velocity_error
    errors = {
        "time": ROUNDING * hit.duration,
        "normal_force": ACCURACY * scales.force,
        "tangential_force": share * scales.tangential_force,
        "penetration": ACCURACY * scales.length,
        "normal_velocity": ACCURACY * hit.normal_speed,
        "contact_velocity": velocity_error,
        "tangential_speed": impulse_error / pair.normal_mass,
        "spin": impulse_error * pair.first.radius / inertia(pair.first),
    }
    columns: Columns = {}
    for name, error in errors.items():
        columns |= uncertain(name, history[name].values, error)
    notes = (
        "time since the first touch; normal_velocity is positive while the bodies approach;",
        "tangential_force is positive against +x, on the first body.",
    )
    return DecimalTable((*title_of(folder), *notes, *SIGNS), columns)


def exact(name: str, values: ArrayLike) -> Columns:
    """Return a column of numbers that are given, not computed."""
    return {name: [_decimal(value) for value in _flat(values)]}


def uncertain(name: str, values: ArrayLike, errors: ArrayLike) -> Columns:
    """Return a column of computed numbers and one of their errors, rounding to 12 digits included.

    Examples
    --------
    >>> from pack_references import uncertain
    >>> uncertain("psi_out", [-1.23456789012345], [1e-10])
    {'psi_out': ['-1.23456789012'], 'psi_out_error': ['1.1e-10']}
    """
    numbers = _flat(values)
    bounds = np.broadcast_to(_flat(errors), numbers.shape)
    cells = [_decimal(value) for value in numbers]
    sums = [bound + _half_unit(cell) for bound, cell in zip(bounds, cells, strict=True)]
    return {name: cells, name + ERROR: [_rounded_up(error) for error in sums]}


def _flat(values: ArrayLike) -> Array:
    return np.atleast_1d(np.asarray(values, dtype=np.float64))


def _decimal(value: float) -> str:
    return f"{value + 0.0:.{DIGITS}g}"  # + 0.0: no negative zero


def _half_unit(cell: str) -> float:
    """Return half a unit of the last of the digits."""
    number = Decimal(cell)
    return 0.5 * 10.0 ** (number.adjusted() - DIGITS + 1) if number else 0.0


def _rounded_up(error: float) -> str:
    return f"{float(ERROR_DIGITS.create_decimal(repr(float(error)))):.2g}"


def unit_tests() -> dict[str, str]:
    """Return the sets as tests of LAMMPS's own suite, against the frozen numbers, by path."""
    tests: dict[str, str] = {}
    for folder in filter(is_one_experiment, folders_with(INPUTS)):
        reference = read_table(frozen_files()[f"{folder}/{REFERENCE}"])
        outcomes = Outcomes(*(reference.numbers(name) for name in AFTER))
        experiment = experiment_of("lammps", case_of(folder), inputs_of(folder))
        text = unit_test_yaml(experiment, tolerance=TOLERANCE, outcomes=outcomes)
        tests[f"{folder}/lammps/fix-timestep-{folder}.yaml"] = text
    return tests


def freeze(folder: Path) -> list[Path]:
    """Write every table of reference numbers, then every test of LAMMPS, and return the paths."""
    paths = []
    tables = {name: table.as_csv() for name, table in references().items()}
    for name, text in (tables | unit_tests()).items():
        path = folder / name
        path.write_text(text, encoding="utf-8", newline="\n")
        paths.append(path)
    return paths


if __name__ == "__main__":
    print(*freeze(Path(sys.argv[1])), sep="\n")
