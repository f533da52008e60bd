"""`carom verify score`: a user's own results against the exact answer."""

import json
from pathlib import Path
from typing import Annotated

import typer

import carom
from carom.cli.cases import (
    Column,
    Json,
    Plot,
    check_outputs,
    file_argument,
    file_option,
    named_values,
    refuse_same,
    store,
    told_case,
)


def score_command(
    results: Annotated[Path, file_argument("CSV file with a header; comments after #.")],
    case: Annotated[
        Path | None,
        file_option("Case file as for `carom impact`: the bodies; for a history the motion."),
    ] = None,
    chi: Annotated[
        str | None, typer.Option(help="chi of psi_1, psi_2 if there is no such column, e.g. 1.44.")
    ] = None,
    restitution: Annotated[
        str | None,
        typer.Option(help="What a damped normal contact is to leave, e.g. 0.9; also in the case."),
    ] = None,
    tolerance: Annotated[
        str,
        typer.Option(
            help="Largest |error in psi_2| that passes, and of the audit; the best laws reach 0.05."
        ),
    ] = "0.01",
    column: Column = None,
    plot: Plot = None,
    output: Annotated[str | None, typer.Option(help="Store the score: .csv or .nc.")] = None,
    as_json: Json = False,
) -> None:
    """Score your own results against the exact impact; exit code 0 if they pass, 1 if they fail.

    The columns tell what they are: psi_1, psi_2 (chi); or normal_speed, tangential_speed, spin,
    tangential_speed_out, spin_out (normal_speed_out); or time, normal_force, tangential_force of
    one impact, the tangential force positive where it slows V_x > 0: minus the x force on the
    first body. SI units, or named in the head: "spin [rpm]".

    They pass if no psi_2 is off by more than the tolerance, and no energy, momentum or friction is;
    errors of forces count in units of mu P_max and P_max.

    Example: carom verify score rebounds.csv --chi 1.44 --plot score.png

    Velocities or forces: carom verify score results.csv --case examples/steel_ball.toml

    Damped, against solids that leave as much: add --restitution 0.9
    """
    from carom.io.files import FIGURES, TABLES

    refuse_same({"results": results, "case": case, "plot": plot, "output": output})
    check_outputs((plot, FIGURES), (output, TABLES))
    score = carom.verify.score(
        results,
        case=None if case is None else told_case(case, losses=True),
        chi=chi,
        restitution=restitution,
        tolerance=tolerance,
        columns=named_values("column", column, "omega=spin_out"),
    )
    store(score, output, plot)
    typer.echo(json.dumps(score.to_dict(), indent=2) if as_json else str(score))
    if not score.passed:
        raise typer.Exit(1)
