"""`carom verify`: contact laws and DEM codes against the exact impact."""

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.cli import completion
from carom.cli.cases import check_outputs, read_case_file, store, store_text, stored
from carom.cli.options import (
    Commands,
    checking,
    described,
    file_argument,
    file_option,
    name_option,
    whole_option,
)
from carom.cli.programs import pack_command
from carom.cli.tables import TABLE, store_format, table_format_of
from carom.io.paths import checked_output
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import one_of
from carom.quantities.units import finite, positive, whole

if TYPE_CHECKING:
    from carom.dimensionless.law import Law
    from carom.verify.tuning import Setting, Tuning

app = Commands(
    "verify",
    "Test contact laws and DEM codes against the exact impact.\n\n"
    "Begin with carom verify laws, which ranks the contact laws in use. carom verify score judges "
    "your own results, and carom verify tune finds the least wrong stiffness of a law.\n\n\b\n"
    "Example: carom verify laws",
)

LAWS_OPTIONS = {
    "case": file_option(
        "Case file, as for carom impact, with your bodies; if it has a speed, each law also says "
        "how they would leave."
    ),
    "chi": "Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive (default: that of "
    "the case, or of solid spheres with Poisson's ratio 0.3).",
    "kappa": "Stiffness ratio kappa = G*/E* (default: that of solid spheres, 4 chi/7).",
    "psi": "Incidence psi_1 = kappa V_x/(mu V_1) at which laws are compared (default: 15 from 0.1 "
    "to 6). You can repeat this option.",
    "law": name_option("Rank only this law, e.g. mindlin_rescale.", completion.laws),
    "restitution": "Give all laws the damping for this normal coefficient of restitution, e.g. "
    "0.9 (default: that of the case, or no damping).",
    "output": "Store the ranking: .csv or .nc.",
    "error_map": typer.Option(
        "--map",
        help="Store a map of the errors of the one --law, for solid spheres of any Poisson's "
        "ratio: a figure or a table.",
    ),
}


@app.command("laws")
@described(LAWS_OPTIONS)
def laws_command(
    case: str | None = None,
    chi: str | None = None,
    kappa: str | None = None,
    psi: list[str] | None = None,
    law: str | None = None,
    restitution: str | None = None,
    as_json: bool = False,
    plot: str | None = None,
    output: str | None = None,
    error_map: str | None = None,
) -> None:
    """Rank contact laws of DEM codes by their largest error.

    Use this command to choose a contact law, or to see how wrong the law of your DEM code is. The
    error is that of psi_2, the dimensionless tangential velocity of the contact point after the
    impact, against the exact impact. The table also says how many time steps a law needs.

    \b
    Example: carom verify laws
    How far off am I: carom verify laws --case glass.toml
    Damped laws, compared at equal restitution: carom verify laws --restitution 0.7
    Thin shells on a wall: carom verify laws --chi 1.0294 --kappa 0.8235 --plot laws.png
    One law for all solid spheres: carom verify laws --law mindlin --map mindlin.png
    """
    from carom.dem.damping import damped_restitution
    from carom.verify.entries import named
    from carom.verify.errors import INCIDENCES, SOLID_CHI
    from carom.verify.own_impact import own_impact
    from carom.verify.tuning import setting_of

    own = None
    with checking() as faults:
        if error_map is not None and law is None:
            faults.add("map: it shows one law; give --law, e.g. --law mindlin")
        if error_map is not None and (kappa is not None or psi):
            faults.add("map: it shows solid spheres at all psi_1; leave --kappa and --psi out")
        files = {"plot": plot, "output": output, "map": error_map}
        faults.trying(check_outputs, files, case=case)
        incidences = [faults.trying(finite, "psi_in", value) for value in psi or INCIDENCES]
        entries = faults.trying(named, law)
        if case is None:
            ratio = faults.if_given(positive, "kappa", kappa)
            size = SOLID_CHI if chi is None else faults.trying(positive, "chi", chi)
            e = faults.if_given(damped_restitution, "restitution", restitution)
        else:
            content = read_case_file(case, losses=True)
            setting = setting_of(content, chi, kappa, "0", None, restitution)
            size, ratio, own = setting.chi, setting.kappa, own_impact(content, setting.restitution)
            e = None if setting.restitution == 1.0 else setting.restitution
    ranking = carom.verify.rank(entries, chi=size, kappa=ratio, psi_1=incidences, restitution=e)
    store(ranking, output, plot)
    if error_map is not None:
        stored(_store_map(ranking.standings[0].entry.law, error_map))
    if as_json:
        laws = [(each.entry.label, each.entry.law) for each in ranking.standings]
        told = {} if own is None else {"own_impact": own.to_dict(laws)}
        typer.echo(json.dumps(ranking.to_dict() | told, indent=2))
    elif own is None:
        typer.echo(str(ranking))
    else:
        typer.echo(f"{own.of_ranking(ranking)}\nWhat to do about it: carom verify tune {case}")


def _store_map(law: "Law", path: str) -> Path:
    from carom.io.files import TABLES

    dataset = carom.verify.error_map(law)
    if path.lower().endswith(TABLES):
        return carom.save(dataset, path)
    return carom.plots.save_figure(carom.plots.plot_error_map(dataset), path)


PURPOSE = """\
Run {0} and rank its contact laws by their error.

Use this command to see how far the rebound in {0} is from the exact impact, with each contact law
that the program has. The error is that of psi_2, the dimensionless tangential velocity of the
contact point after the impact. {0} must be installed.

\b
Example: carom verify {1}
"""
VERDICT = """\
Results of one law, and a verdict on them:
  carom verify lammps --law mindlin --output results.csv
  carom verify score results.csv
"""
COMMANDS = {
    name.lower(): PURPOSE.format(name, name.lower()) for name in ("LAMMPS", "LIGGGHTS", "YADE")
}
COMMANDS["lammps"] += VERDICT


ENGINES_OPTIONS = {
    "case": file_option(
        "Case file, as for carom impact, with the bodies (default: a steel ball on a steel "
        "plate, chi = 1.4412)."
    ),
    "law": name_option("Run only this law, by its name in carom verify laws.", completion.laws),
    "steps": whole_option("Time steps per duration of Hertz's contact."),
    "time_limit": "Time limit of each run, e.g. '60 s'.",
    "program": "Path of the executable (default: Carom looks for it).",
    "output": "Store the results of the one --law as .csv, for carom verify score.",
}


@described(ENGINES_OPTIONS)
def engine_command(
    context: typer.Context,
    case: str | None = None,
    law: str | None = None,
    steps: str = "2000",
    time_limit: str = "120 s",
    program: str | None = None,
    output: str | None = None,
    as_json: bool = False,
) -> None:
    """Run the program that the command is named after, and print how it has done."""
    from carom.bodies.cases import pair_of
    from carom.verify.engines.experiments import MOST_STEPS
    from carom.verify.entries import named

    with checking() as faults:
        count = faults.trying(whole, "steps", steps, 10, MOST_STEPS)
        seconds = faults.trying(positive, "time_limit", time_limit)
        entries = faults.trying(named, law)
        if output is not None:
            faults.trying(checked_output, output, (".csv",))
        if output is not None and law is None:
            faults.add("output: it stores the results of one law; give --law, e.g. --law mindlin")
        pair = None if case is None else pair_of(read_case_file(case))
    engine = getattr(carom.verify, str(context.command.name).capitalize())(program)
    bench = carom.verify.bench(engine, entries, pair=pair, steps=count, time_limit=seconds)
    if output is not None and not bench.failed:
        store_text(bench.results(), output)
    typer.echo(json.dumps(bench.to_dict(), indent=2) if as_json else str(bench))
    if bench.failed:
        raise typer.Exit(1)


for name, words in COMMANDS.items():
    app.command(name, help=words)(engine_command)


app.command("pack")(pack_command)


SCORE_OPTIONS = {
    "results": file_argument(
        "CSV file or spreadsheet with the names of its columns in a head; # starts a comment."
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
    **TABLE,
    "code": "Name of the program, for the report and the figure, e.g. LAMMPS.",
    "law": "Name of its contact law, for the report and the figure, e.g. mindlin.",
    "output": "Store the score: .csv or .nc.",
}


@app.command("score")
@described(SCORE_OPTIONS)
def score_command(
    results: str,
    case: str | None = None,
    tolerance: str = "0.01",
    plot: str | None = None,
    output: str | None = None,
    as_json: bool = False,
    **given: Any,
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
    from carom.io.tables import read_table

    with checking() as faults:
        faults.trying(check_outputs, {"plot": plot, "output": output}, results=results, case=case)
        limit = faults.trying(positive, "tolerance", tolerance, "1")
        table = faults.trying(table_format_of, given)
        content = None if case is None else faults.trying(read_case_file, case, losses=True)
        if None not in (results, table):
            read = faults.trying(read_table, results, **table._asdict(), lenient=True)
        faults.settle()
        how = {name: value for name, value in given.items() if name not in TABLE}
        score = carom.verify.score(read, case=content, tolerance=limit, **how)
    store_format(table, given["save_columns"])
    store(score, output, plot)
    typer.echo(json.dumps(score.to_dict(), indent=2) if as_json else str(score))
    if not score.passed:
        raise typer.Exit(1)


TUNE_OPTIONS = {
    "case": file_argument("Case file, as for carom impact, with bodies, friction and speed."),
    "chi": "Ratio of inertia to stiffness chi, instead of a case file.",
    "kappa": "Stiffness ratio kappa = G*/E*, only with --chi (default: that of solid spheres, 4 "
    "chi/7).",
    "start": typer.Option("--from", help="First incidence: an angle with a case file, else psi_1."),
    "stop": typer.Option(
        "--to",
        help="Last incidence: an angle, e.g. '60 deg', with a case file, else psi_1 (default: "
        "psi_1 = 4 chi).",
    ),
    "restitution": "Normal coefficient of restitution that the dampings shall give (default: that "
    "of the case, or 1).",
    "measure": name_option("Error in psi_2 to minimise: its max or its rms.", ("max", "rms")),
}


@app.command("tune")
@described(TUNE_OPTIONS)
def tune_command(
    case: str | None = None,
    chi: str | None = None,
    kappa: str | None = None,
    start: str = "0",
    stop: str | None = None,
    restitution: str | None = None,
    measure: str = "max",
    as_json: bool = False,
) -> None:
    """Find the least wrong stiffness of every contact law.

    Use this command if you cannot change the contact law of your DEM code. It finds the parameter
    with which each law comes closest to the exact psi_2. With a case file it also prints what to
    write into the inputs of DEM codes: stiffnesses, dampings for the restitution that you want, and
    time steps with the errors that they cause. LAMMPS and LIGGGHTS can have the exact law instead.

    \b
    Example: carom verify tune examples/steel_ball.toml --from "5 deg" --to "60 deg"
    Without bodies: carom verify tune --chi 1.4412
    """
    from carom.verify.entries import called
    from carom.verify.own_impact import own_impact
    from carom.verify.tuning import MEASURES, setting_of

    with checking() as faults:
        faults.trying(one_of, "measure", measure, MEASURES)
        content = None if case is None else read_case_file(case, losses=True)
        setting = setting_of(content, chi, kappa, start, stop, restitution)
    tuning = carom.verify.tune(
        chi=setting.chi, kappa=setting.kappa, psi_1=setting.psi, measure=measure
    )
    liggghts = {"LIGGGHTS": "tangential carom"} if setting.restitution == 1.0 else {}  # elastic
    exact = {"LAMMPS": "pair_style carom", **liggghts, "C++": "carom/contact.hpp"}
    inputs = {"inputs": _inputs_of_codes(setting, tuning), "exact_law": exact}
    scales = {"normal_speed": setting.normal_speed, "duration": setting.duration}
    own = None if content is None else own_impact(content, setting.restitution)
    record = tuning.to_dict() | inputs | scales
    if own is not None:
        record["own_impact"] = own.to_dict([(called(one.law), one.law) for one in tuning.advice])
    table = str(tuning) if own is None else own.of_tuning(tuning)
    if as_json:
        typer.echo(json.dumps(record, indent=2))
        return
    verdict = [] if own is None else [own.verdict()]  # before what to do
    typer.echo("\n".join([*verdict, _advice(table, record)]))


def _inputs_of_codes(setting: "Setting", tuning: "Tuning") -> dict[str, str]:
    """Return what to write into the inputs of codes: the stiffnesses that come closest."""
    from carom.verify.conversions import MINDLIN, SPRING

    if setting.pair is None or setting.normal_speed is None:
        return {}
    spring = tuning.best(carom.dem.LinearSpring) or SPRING
    mindlin = tuning.best(carom.dem.LammpsMindlin) or MINDLIN
    bodies, speed, restitution = setting.pair, setting.normal_speed, setting.restitution
    if restitution < 1.0:  # softened so, the law comes closest if it damps sideways as well
        mindlin = replace(mindlin, tangential_damping=1.0)
    return carom.verify.recipes(bodies, speed, restitution, spring=spring, mindlin=mindlin)


def _advice(table: str, record: dict[str, Any]) -> str:
    """Return what to do: the exact law where it can be had, then the closest of the others."""
    inputs = dict(record["inputs"])
    exact = ", ".join(f"{law} in {code}" for code, law in record["exact_law"].items())
    lines = [f"The exact law itself needs no tuning: {exact}."]
    if words := inputs.pop("LAMMPS, exact law", ""):
        lines += [f"  {line}" for line in words.splitlines()]
    lines.append(table)
    speed, duration = record["normal_speed"], record["duration"]
    if duration is not None:
        lines.append(
            f"At a normal speed of {GLOSSARY['normal_speed'].text(speed, 4)} the contact lasts"
            f" {GLOSSARY['duration'].text(duration, 4)}; the time step is this duration divided by"
            " steps."
        )
        lines.append("Inputs of DEM codes with these stiffnesses:")
        lines += [f"  {code:26s} {text}" for code, text in inputs.items()]
    return "\n".join(lines)
