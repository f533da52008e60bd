"""The scorer: a user's own results against the exact answer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from carom.bodies.pairs import Pair
from carom.dimensionless.law import Law
from carom.impacts.exact import Impact
from carom.io.cells import is_nan
from carom.io.heads import spelled
from carom.io.tables import read_table
from carom.io.user_table import UserTable, in_units, others
from carom.quantities.arrays import Array
from carom.quantities.refusals import Faults, InputError, known_keywords, nearest, refusal, refuse
from carom.quantities.units import positive
from carom.verify.entries import is_function
from carom.verify.scoring import points as scored
from carom.verify.scoring.cases import ScoredCase, results_of, scored_case
from carom.verify.scoring.histories import NAMES as HISTORY, score_history
from carom.verify.scoring.origins import MOST_ORIGINS, NAMES, origins_of
from carom.verify.scoring.result import Score
from carom.verify.scoring.velocities import AFTER, BEFORE, score_velocities

__all__ = ["TOLERANCE", "Score", "score"]

TOLERANCE = 0.01  # in psi_2: a hundredth of the largest psi_1 that sticks from the first touch
DIMENSIONLESS = ("psi_in", "psi_out", "chi")


@known_keywords
def score(
    results: Any,
    *,
    case: str | Path | Mapping[str, Any] | Pair | Impact | None = None,
    chi: float | str | None = None,
    restitution: float | str | None = None,
    tolerance: float | str = TOLERANCE,
    columns: Mapping[str, str] | str | Path | None = None,
    sheet: str | None = None,
    decimal: str | None = None,
    code: str | None = None,
    law: str | None = None,
) -> Score:
    """Score a user's own results of oblique impacts, or a contact law, against the exact answer.

    The error is psi_2 of the results less the exact psi_2(psi_1, chi) of Maw, Barber & Fawcett
    (1976), with psi = kappa V_x/(mu V_1); for a restitution below 1 the exact psi_2 is that of
    Kelvin-Voigt solids. The columns say what the results are. A rebound curve has psi_1, psi_2 and
    chi. Velocities have normal_speed and tangential_speed, or speed and angle, with spin and spin2;
    and after the impact tangential_speed_out, spin_out, and normal_speed_out, spin2_out if known.
    The history of one impact has time, normal_force, tangential_force, and contact_velocity if
    known; its psi_2 follows from psi_1 and the impulse. The audit names results that no contact law
    may give: a gain of energy, |psi_2| > |psi_1|, more friction than there is, |psi_1 - psi_2| >
    2 (1 + e) chi or |F_t| > mu F_n, and speeds and spins that change by different impulses.

    Parameters
    ----------
    results : str, Path, mapping, pandas.DataFrame, Law or callable
        A file, CSV or a spreadsheet, with a header and comments after #; or columns by name, each
        of shape (n,), or the fields of a structured array. SI units, or with a unit in the name of
        a column: "spin [rpm]", "angle (deg)"; "-" after the impact leaves a row out. Speeds of two
        spheres are relative; normal_speed is positive before and normal_speed_out after; positive
        spin adds to the tangential speed of the contact point; tangential_force is positive against
        V_x > 0. At least 3 points, or 20 rows with a force. Or a contact law, or a function as of
        `carom.dem.FunctionLaw`: its psi_2 at the 15 incidences of `rank`.
    case : str, Path, mapping, Pair or Impact, optional
        The bodies and their friction, as in a case file for `carom impact`. They are needed unless
        the results are psi_1 and psi_2, or a comment of the file, "# case:", holds them as JSON. A
        history needs the motion, too: give a case with speeds, or an Impact.
    chi : float, optional
        For psi_1 and psi_2 if there is no column of that name; for a law 1.4412 by default.
    restitution : float, optional
        e of the exact impact, if the contact is damped; by default that of the case, or 1.
    tolerance : float
        Largest |error in psi_2| that passes, and the limit of the findings of the audit in units of
        psi, of errors of forces in mu P_max and P_max, and of the relative error of the duration.
    columns : mapping or str, optional
        Quantities by the heads of columns that have other names, e.g. {"omega": "spin_out"} or
        {"w": "spin_out [rpm]"}; or a TOML file with them in a table [columns].
    sheet, decimal : str, optional
        As in `carom.Table`.
    code, law : str, optional
        Names of the program and its contact law; by default the columns of these names, up to eight
        different ones, else the comments "# code:" and "# law:" of the file.

    Returns
    -------
    Score
        `passed` and `failures`; max_error, rms_error and mean_error in psi_2, the same for each
        sequence of phases in `groups` and for each code and law in `by_origin`; `audit`, a finding
        each with its value, limit and verdict; `notes`; and what gives the rest: plot, to_dataset,
        cite.

    Raises
    ------
    InputError
        If columns are missing, a number is missing or in a wrong unit, there are too few, a history
        is not that of one whole contact, or the function of a law fails.

    Examples
    --------
    >>> psi = [0.5, 1.0, 2.0, 4.0]
    >>> result = carom.verify.score({"psi_1": psi, "psi_2": [0.05, -0.06, -0.84, -1.51]}, chi=1.44)
    >>> result.passed, round(result.max_error, 3)
    (False, 0.075)
    >>> round(carom.verify.score(carom.dem.LammpsMindlin("mindlin")).max_error, 3)
    0.576
    """
    limit = positive("tolerance", tolerance, "1")
    law_notes: tuple[str, ...] = ()
    if isinstance(results, Law) or (is_function(results) and not hasattr(results, "items")):
        own = results_of(results, case, chi, restitution)
        results, case, chi, restitution = own.columns, None, own.chi, own.restitution
        law, law_notes = own.name if law is None else law, own.notes
    table = read_table(results, columns, sheet=sheet, decimal=decimal, lenient=True)
    with Faults() as faults:
        table = table.told(faults)
        kind, names = _kind(table.names)
        if kind != "psi" and chi is not None:
            raise refusal("chi", chi, "it follows from the case; leave it out")
        unused = [name for name in others(table, names) if name not in NAMES]
        _refuse_nan(table)
        quantities = in_units(table, names, (*AFTER, "psi_out"))
        faults.settle()
        quantities = _measured(quantities)
        found = SCORERS[kind](quantities, scored_case(case, chi, table.case, restitution), limit)
    most = 1 if kind == "history" else MOST_ORIGINS
    origins, notes = origins_of(quantities, {"code": code, "law": law}, most)
    ignored = (f"columns that were not used: {', '.join(unused)}",) if unused else ()
    notes = *found.notes, *notes, *quantities.notes, *ignored, *law_notes
    return Score(kind, limit, found.points, found.audit, notes, found.inputs, found.forces, origins)


def _refuse_nan(table: UserTable) -> None:
    """Add to the faults results that are NaN: a program has failed there, which is no gap."""
    for name in filter(table.names.__contains__, (*AFTER, "psi_out")):
        column = table.cells[name]
        failed = np.fromiter(map(is_nan, column.cells), np.bool_, len(column.cells))
        if failed.any():
            where = table.cells_named(name, failed)
            table.faults.add(f"{spelled(name)}: NaN in {where}; write '-' to leave such rows out")


def _measured(quantities: UserTable) -> UserTable:
    """Return the rows without a gap after the impact, with a note on the others."""
    after = [quantities[name] for name in ("psi_out", *AFTER) if name in quantities.columns]
    missing = np.any(np.isnan(after), axis=0)
    if not np.any(missing):
        return quantities
    note = f"left out, as nothing was measured after the impact: {quantities.named(missing)}"
    return replace(quantities.kept(~missing), notes=(*quantities.notes, note))


def _kind(names: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """Return what results with these columns are, and the columns that such results may have."""
    if {"normal_force", "tangential_force"} & set(names):
        return "history", HISTORY
    if {"psi_in", "psi_out"} & set(names):
        return "psi", DIMENSIONLESS
    if set(BEFORE + AFTER) & set(names):
        return "velocities", BEFORE + AFTER
    columns = ("psi_1", "psi_2", *BEFORE, *AFTER, *HISTORY)
    hints = filter(None, (nearest(name, columns) for name in names))
    raise InputError(
        f"results: no column of {', '.join(names)} is known; {next(hints, '')}".rstrip()
        + " give psi_1, psi_2; or "
        "normal_speed, tangential_speed, spin, tangential_speed_out, spin_out; or time, "
        "normal_force, tangential_force"
    )


def score_rebounds(results: UserTable, case: ScoredCase, limit: float) -> scored.Scored:
    """Return the points of a rebound curve, and what is found of them."""
    results.require("psi_in", "psi_out")
    results.require_rows(scored.FEWEST_POINTS)
    chi, before, after = _chi(results, case), results["psi_in"], results["psi_out"]
    scored.refuse_large(before, after, results)
    change = (after - before) * (after + before)
    points = scored.compared(before, after, chi, case.restitution, change, results)
    restitution, unit = np.full(len(results), case.restitution), np.ones(len(results))
    audit = (
        scored.energy_audit(points, unit, "in psi^2", limit),
        scored.friction_audit(points, restitution, limit),
    )
    return scored.Scored(points, audit, scored.notes_on(points), {})


def _chi(results: UserTable, case: ScoredCase) -> Array:
    options = {"--chi": case.chi, "--case": case.case}
    used = [option for option, value in options.items() if value is not None]
    if "chi" in results.columns:
        refuse(used and f"chi: the results have a column chi; leave {used[0]} out")
        results.refuse("chi", results["chi"] <= 0.0, "must be positive")
        return np.asarray(results["chi"])
    if len(used) != 1:
        raise InputError(
            f"chi: {'given twice' if used else 'missing'}; give a column chi, or --chi, e.g. 1.44, "
            "or --case with the bodies"
        )
    chi = positive("chi", case.chi) if case.chi is not None else case.pair.chi
    return np.full(len(results), chi)


SCORERS = {"psi": score_rebounds, "velocities": score_velocities, "history": score_history}
