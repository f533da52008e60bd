"""Building LIGGGHTS with the exact law as a tangential model, and where it is found again.

The model in `liggghts_model/` is under the GPL, as LIGGGHTS demands; what it includes is not.
"""

import os
import re
import shutil
import tarfile
import zlib
from lzma import LZMAError
from pathlib import Path
from tempfile import TemporaryDirectory

from carom.adapters import building
from carom.adapters.building import Built
from carom.io.progress import advancing
from carom.quantities.refusals import InputError, refusal

MODEL = building.HERE / "liggghts_model"
FLAGS = ("-std=gnu++17", "-O3", "-w", *building.MATH_FLAGS)
NAME, MACHINE = "liggghts", "serial"  # no MPI
COMMAND = "liggghts build"
NEEDED_FILES = ("tangential_model_base.h", "version_liggghts.txt", "utils.h", "finish.cpp")
MODEL_MARK = b"tangential_model carom"
SPRINGS = (16, 32, 64)
# what C++17 refuses of version 3.8.0, and what wants VTK even where there is none
REFUSED = (
    ("utils.h", r"return static_cast<\s*std::ostringstream.*", "return std::to_string(a);"),
    ("finish.cpp", r"->numneigh > 0", "->numneigh != 0"),
)
DAMAGED = (tarfile.TarError, EOFError, LZMAError, zlib.error)
WANTS_VTK = ("dump_mesh_vtk.h", "dump_mesh_vtk.cpp")


def program() -> Path:
    """Return where the LIGGGHTS of this environment is looked for."""
    return building.home("liggghts") / NAME


def has_model(executable: Path) -> bool:
    """Tell whether the model was compiled into a program."""
    try:
        return MODEL_MARK in executable.read_bytes()
    except OSError:
        return False


def build(source: Path, target: Path, processor: tuple[str, ...] = building.OWN) -> Built:
    """Compile LIGGGHTS of a folder or a tarball with the model, or raise InputError."""
    compiler, make = building.compiler(COMMAND), shutil.which("make")
    if make is None:
        raise InputError(f"{COMMAND}: there is no make; install it")
    building.check_folder(target)
    with TemporaryDirectory() as scratch:
        folder = copied(source, Path(scratch))
        version = (folder / "version_liggghts.txt").read_text(encoding="utf-8", errors="replace")
        add_model(folder)
        command = [make, "-C", str(folder), f"-j{os.cpu_count() or 1}"]
        building.carry_out(COMMAND, [*command, "stubs"])
        words = [f"CC={compiler}", f"LINK={compiler}", f"CCFLAGS={' '.join((*FLAGS, *processor))}"]
        command += [MACHINE, "DEPENDS=", *words]  # compiled once: no need for what depends on what
        with advancing("compiling LIGGGHTS", len(list(folder.glob("*.cpp")))) as advance:
            building.carry_out(COMMAND, command, lambda line: advance(int(" -c " in line)))
        building.place(folder / f"lmp_{MACHINE}", target / NAME)
    return Built(target / NAME, version.strip(), tuple(command))


def copied(source: Path, scratch: Path) -> Path:
    """Return a copy of the folder `src` of LIGGGHTS, or raise InputError."""
    copy = scratch / "sources"
    try:
        if source.is_dir():
            shutil.copytree(source / "src", copy / "src", ignore=shutil.ignore_patterns("Obj_*"))
        else:
            with tarfile.open(source) as packed:
                packed.extractall(copy, filter="data")
    except (*DAMAGED, OSError) as error:
        raise not_sources(source) from error
    for folder in copy.glob("**/src"):
        if all((folder / name).is_file() for name in NEEDED_FILES):
            return folder
    raise not_sources(source)


def not_sources(source: Path) -> InputError:
    """Return the refusal of what is not LIGGGHTS."""
    allowed = "must be the folder or the tarball of LIGGGHTS-PUBLIC 3.8.0, with its folder src"
    return refusal("source", str(source), allowed)


def add_model(folder: Path) -> None:
    """Put the model, with the headers that it includes, among the sources of LIGGGHTS."""
    for file in MODEL.iterdir():
        shutil.copy(file, folder)
    shutil.copytree(building.HEADERS / "carom", folder / "carom", dirs_exist_ok=True)
    for name, refused, instead in REFUSED:
        text = (folder / name).read_text(encoding="utf-8", errors="surrogateescape")
        corrected = re.sub(refused, instead, text)
        (folder / name).write_text(corrected, encoding="utf-8", errors="surrogateescape")
    for name in WANTS_VTK:
        (folder / name).unlink(missing_ok=True)
