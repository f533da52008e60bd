"""Inputs of DEM codes for the sets of the pack, ready to run."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from carom.bodies.cases import pair_of
from carom.dem import LammpsMindlin, LiggghtsHertz
from carom.dem.base import ContactLaw
from carom.verify.engines.experiments import Experiment, Outcomes
from carom.verify.engines.lammps import Lammps
from carom.verify.engines.lammps_unittest import unit_test_yaml
from carom.verify.engines.liggghts import Liggghts
from carom.verify.engines.running import Engine
from carom.verify.engines.yade import Yade
from carom.verify.pack.frozen import CASE, INPUTS, REFERENCE, folders_with, frozen_files
from carom.verify.pack.references import case_of, inputs_of
from carom.verify.pack.tables import DecimalTable, read_table

STEPS = 2000  # per duration of the contact
TOLERANCE = 0.01  # in psi_2, of LAMMPS's unit test; that of the scorer
AFTER = ("normal_speed_out", "tangential_speed_out", "spin_out")
PROGRAMS: Mapping[str, tuple[Engine, ContactLaw]] = {  # each with a law that it has
    "lammps": (Lammps(), LammpsMindlin()),
    "liggghts": (Liggghts(), LiggghtsHertz()),
    "yade": (Yade(), LammpsMindlin("mindlin/force")),
}
RUN = """\
#!/bin/sh
# Runs these impacts, leaves results.csv and scores it: exit code 0 if they pass, else 1.
# What follows the name of this script goes to the scorer, e.g. --tolerance 0.6 --plot score.png
set -e
cd "$(dirname "$0")"
command -v carom >/dev/null || {{ echo "no carom: activate its environment" >&2; exit 2; }}
{command}
"${{PYTHON:-python3}}" -m carom.verify.pack.collect .
carom verify score results.csv --case ../case.toml "$@"
"""


def program_files() -> dict[str, str]:
    """Return the inputs of each program for each set that it can run, by path in the pack."""
    found: dict[str, str] = {}
    for folder in folders_with(INPUTS):
        if not _is_one_experiment(folder):
            continue
        case, inputs = case_of(folder), inputs_of(folder)
        for name, (program, _) in PROGRAMS.items():
            experiment = experiment_of(name, case, inputs)
            command = " ".join([program.called, *program.arguments])
            files = {**program.files(experiment), "run.sh": RUN.format(command=command)}
            if name == "lammps":
                files[f"fix-timestep-{folder}.yaml"] = _unit_test(folder, experiment)
            found |= {f"{folder}/{name}/{file}": text for file, text in files.items()}
    return found


def experiment_of(name: str, case: Mapping[str, Any], inputs: DecimalTable) -> Experiment:
    """Return the impacts of a set as a program is to run them."""
    return Experiment(
        pair=pair_of(case),
        law=PROGRAMS[name][1],
        normal_speed=float(inputs.numbers("normal_speed")[0]),
        tangential_speed=tuple(inputs.numbers("tangential_speed").tolist()),
        spin=tuple(inputs.numbers("spin").tolist()),
        steps=STEPS,
    )


def _is_one_experiment(folder: str) -> bool:
    """Whether it is a set of bodies that a program can run: with one normal speed."""
    if "/" in folder or f"{folder}/{CASE}" not in frozen_files():
        return False
    return bool(np.ptp(inputs_of(folder).numbers("normal_speed")) == 0.0)


def _unit_test(folder: str, experiment: Experiment) -> str:
    """Return the set as a test of LAMMPS's own suite, against the frozen numbers."""
    reference = read_table(frozen_files()[f"{folder}/{REFERENCE}"])
    exact = Outcomes(*(reference.numbers(name) for name in AFTER))
    return unit_test_yaml(experiment, tolerance=TOLERANCE, outcomes=exact)
