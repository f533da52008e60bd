"""`carom verify tune`: parameters of contact laws for a pair of bodies."""

import json
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import typer

import carom
from carom.cli.cases import told_case
from carom.cli.options import described, file_argument
from carom.quantities.glossary import GLOSSARY

if TYPE_CHECKING:
    from carom.verify.tuning import Setting, Tuning


OPTIONS = {
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
    "measure": "Error in psi_2 to minimise over the incidences: its max or its rms.",
}


@described(OPTIONS)
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
    from carom.verify.tuning import setting_of

    content = None if case is None else told_case(case, losses=True)
    setting = setting_of(content, chi, kappa, start, stop, restitution)
    tuning = carom.verify.tune(
        chi=setting.chi, kappa=setting.kappa, psi=setting.psi, measure=measure
    )
    given = {"normal_speed": setting.normal_speed, "duration": setting.duration}
    inputs = {"inputs": _inputs(setting, tuning), "exact_law": _exact_law(setting.restitution)}
    record = tuning.to_dict() | inputs | given
    typer.echo(json.dumps(record, indent=2) if as_json else _text(tuning, record))


def _inputs(setting: "Setting", tuning: "Tuning") -> dict[str, str]:
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


def _exact_law(restitution: float) -> dict[str, str]:
    """Return what the exact law is called in codes that have it; that in LIGGGHTS is elastic."""
    elastic = {"LIGGGHTS": "tangential carom"} if restitution == 1.0 else {}
    return {"LAMMPS": "pair_style carom", **elastic, "C++": "carom/contact.hpp"}


def _text(tuning: "Tuning", record: dict[str, Any]) -> str:
    lines = [str(tuning)]
    speed, duration = record["normal_speed"], record["duration"]
    if duration is not None:
        lines.append(
            f"At a normal speed of {GLOSSARY['normal_speed'].text(speed, 4)} the contact lasts"
            f" {GLOSSARY['duration'].text(duration, 4)}; the time step is this duration divided by"
            " steps."
        )
        lines.append("Inputs of DEM codes with these stiffnesses:")
        lines += [f"  {code:26s} {text}" for code, text in record["inputs"].items()]
    exact = ", ".join(f"{law} in {code}" for code, law in record["exact_law"].items())
    lines.append(f"The exact law itself needs no tuning: {exact}.")
    return "\n".join(lines)
