"""`carom verify score`: a user's own results against the exact answer."""

import json
from pathlib import Path
from typing import Annotated

import typer


def score_command(
    results: Annotated[Path, typer.Argument(help="CSV file with a header; comments after #.")],
    case: Annotated[
        Path | None,
        typer.Option(help="Case file as for `carom impact`: the bodies; for a history the motion."),
    ] = None,
    chi: Annotated[
        str | None, typer.Option(help="chi of psi_1, psi_2 if there is no such column, e.g. 1.44.")
    ] = None,
    tolerance: Annotated[
        str,
        typer.Option(
            help="Largest |error in psi_2| that passes, and of the audit; the best laws reach 0.05."
        ),
    ] = "0.01",
    plot: Annotated[str | None, typer.Option(help="Store a figure: .png, .pdf or .svg.")] = None,
    output: Annotated[str | None, typer.Option(help="Store the score: .csv or .nc.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
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
    """
    from carom.cli.cases import refuse_same
    from carom.io.files import FIGURES, TABLES, checked_output, save
    from carom.verify.scoring import score

    refuse_same({"results": results, "case": case, "plot": plot, "output": output})
    for path, endings in ((plot, FIGURES), (output, TABLES)):
        if path is not None:
            checked_output(path, endings)
    result = score(results, case=case, chi=chi, tolerance=tolerance)
    if output is not None:
        typer.echo(f"stored {save(result, output)}", err=True)
    if plot is not None:
        result.plot(plot)
        typer.echo(f"stored {plot}", err=True)
    typer.echo(json.dumps(result.as_record(), indent=2) if as_json else str(result))
    if not result.passed:
        raise typer.Exit(1)
