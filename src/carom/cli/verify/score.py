"""`carom verify score`: a user's own results against the exact answer."""

import json

import typer

import carom
from carom.cli.cases import check_outputs, named_values, store, told_case
from carom.cli.options import described, file_argument, file_option

OPTIONS = {
    "results": file_argument(
        "CSV file with the names of its columns in a head; # starts a comment."
    ),
    "case": file_option(
        "Case file, as for carom impact, with the bodies; to score forces it must have the "
        "speeds, too."
    ),
    "chi": "Ratio of inertia to stiffness chi of psi_1 and psi_2, e.g. 1.44, if there is no "
    "column chi.",
    "restitution": "Normal coefficient of restitution of the exact impact, e.g. 0.9, if your "
    "contact is damped (default: that of the case, or 1).",
    "tolerance": "Largest |error in psi_2| that passes, and the limit of every finding of the "
    "audit; tuned laws of DEM codes reach 0.05 at best.",
    "code": "Name of the program, for the report and the figure, e.g. LAMMPS.",
    "law": "Name of its contact law, for the report and the figure, e.g. mindlin.",
    "output": "Store the score: .csv or .nc.",
}


@described(OPTIONS)
def score_command(
    results: str,
    case: str | None = None,
    chi: str | None = None,
    restitution: str | None = None,
    tolerance: str = "0.01",
    column: list[str] | None = None,
    code: str | None = None,
    law: str | None = None,
    plot: str | None = None,
    output: str | None = None,
    as_json: bool = False,
) -> None:
    """Score your own results against the exact impact.

    Use this command to test a DEM code or a contact law of your own. Results pass if no psi_2 is
    off by more than the tolerance, and none breaks the laws of energy, momentum or friction. Errors
    of forces count in units of mu P_max and P_max. The exit code is 0 if the results pass, and 1 if
    they fail.

    The columns of the file say what the results are:

    \b
    a rebound curve:       psi_1, psi_2, and chi as a column or as an option
    velocities:            normal_speed, tangential_speed, spin,
                           tangential_speed_out, spin_out, normal_speed_out if known
    forces of one impact:  time, normal_force, tangential_force

    The tangential force is positive where it slows V_x > 0, and so is minus the x force on the
    first body. Numbers are in SI units, or in the unit that the head names: "spin [rpm]".

    \b
    Example: carom verify score rebounds.csv --chi 1.44 --plot score.png
    Velocities or forces: carom verify score results.csv --case examples/steel_ball.toml
    A damped contact: carom verify score rebounds.csv --chi 1.44 --restitution 0.9
    """
    check_outputs({"plot": plot, "output": output}, results=results, case=case)
    score = carom.verify.score(
        results,
        case=None if case is None else told_case(case, losses=True),
        chi=chi,
        restitution=restitution,
        tolerance=tolerance,
        columns=named_values("column", column, "omega=spin_out"),
        code=code,
        law=law,
    )
    store(score, output, plot)
    typer.echo(json.dumps(score.to_dict(), indent=2) if as_json else str(score))
    if not score.passed:
        raise typer.Exit(1)
