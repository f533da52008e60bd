"""Writing the benchmark pack: the frozen files, inputs of DEM codes for its sets, checksums."""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from carom.bodies.cases import pair_of
from carom.dem import LammpsMindlin, LiggghtsHertz
from carom.dem.base import ContactLaw
from carom.io.paths import write_folder
from carom.verify.engines.arrangement import template
from carom.verify.engines.experiments import Experiment
from carom.verify.engines.lammps import Lammps
from carom.verify.engines.liggghts import Liggghts
from carom.verify.engines.running import Engine
from carom.verify.engines.yade import Yade
from carom.verify.pack import frozen
from carom.verify.pack.frozen import CASE, INPUTS, REFERENCE, folders_with, frozen_files

CHECKSUMS = "SHA256SUMS"
STEPS_PER_CONTACT = 2000
PROGRAMS: Mapping[str, tuple[Engine, ContactLaw]] = {  # each with a law that it has
    "lammps": (Lammps(), LammpsMindlin()),
    "liggghts": (Liggghts(), LiggghtsHertz()),
    "yade": (Yade(), LammpsMindlin("mindlin/force")),
}


def write_pack(folder: str | Path) -> tuple[str, ...]:
    """Write the benchmark pack into a new or empty folder and return its files, relative to it.

    The folder appears whole or not at all. Reference numbers are those of the pack's version, the
    same to the last byte wherever it is written; `sha256sum -c SHA256SUMS` checks a copy.

    Parameters
    ----------
    folder : str or Path
        A folder that does not exist, or is empty; the one it is in must exist.

    Returns
    -------
    tuple of str
        Paths within the folder, / between their parts.

    Raises
    ------
    InputError
        If there is something in the folder, or it cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     files = carom.verify.write_pack(folder + "/bench")
    >>> "wall/reference.csv" in files
    True
    """
    files = pack_files()
    write_folder(folder, {name: text.encode("utf-8") for name, text in files.items()})
    return tuple(files)


def pack_files() -> dict[str, str]:
    """Return the text of every file of the pack by its path, the checksums last."""
    files = dict(frozen_files())
    for folder in folders_with(REFERENCE):
        files[f"{folder}/reference.json"] = frozen.read_table(
            files[f"{folder}/{REFERENCE}"]
        ).as_json()
    files |= program_files()
    files["pack.json"] = _contents(files)
    files = dict(sorted(files.items()))
    kept = {name: text.encode() for name, text in files.items() if not name.endswith(INPUTS)}
    sums = (f"{hashlib.sha256(text).hexdigest()}  {name}\n" for name, text in kept.items())
    return files | {CHECKSUMS: "".join(sums)}  # but for what users fill in


def _contents(files: dict[str, str]) -> str:
    """Return what the pack holds, for programs to read."""
    sets = []
    for folder in folders_with(CASE):
        inside = [name for name in files if name.startswith(f"{folder}/")]
        sets.append({"folder": folder, "title": frozen.title_of(folder), "files": sorted(inside)})
    record = {"name": "carom benchmark pack", "version": frozen.VERSION}
    errors = {"accuracy_of_psi_2": frozen.ACCURACY, "per": "max(1, |psi_1|)"}
    return json.dumps(record | errors | {"sets": sets}, indent=1, ensure_ascii=False) + "\n"


def program_files() -> dict[str, str]:
    """Return the inputs of each program for each set that it can run, by path in the pack."""
    texts: dict[str, str] = {}
    run = template("run.sh")
    for folder in filter(is_one_experiment, folders_with(INPUTS)):
        case, inputs = frozen.case_of(folder), frozen.inputs_of(folder)
        for name, (program, _) in PROGRAMS.items():
            experiment = experiment_of(name, case, inputs)
            command = " ".join([program._called, *program._arguments])
            files = {**program.files(experiment), "run.sh": run.substitute(command=command)}
            texts |= {f"{folder}/{name}/{file}": text for file, text in files.items()}
    return texts


def experiment_of(name: str, case: Mapping[str, Any], inputs: frozen.DecimalTable) -> Experiment:
    """Return the impacts of a set as a program is to run them."""
    return Experiment(
        pair=pair_of(case),
        law=PROGRAMS[name][1],
        normal_speed=float(inputs.numbers("normal_speed")[0]),
        tangential_speed=tuple(inputs.numbers("tangential_speed").tolist()),
        spin=tuple(inputs.numbers("spin").tolist()),
        steps=STEPS_PER_CONTACT,
    )


def is_one_experiment(folder: str) -> bool:
    """Whether it is a set of bodies that a program can run: with one normal speed."""
    if "/" in folder or f"{folder}/{CASE}" not in frozen_files():
        return False
    return bool(np.ptp(frozen.inputs_of(folder).numbers("normal_speed")) == 0.0)
