"""Building the shared library of compiled kernels, when the package is built.

    python -m carom.native.building [FOLDER [LEVEL ...]]

Groups of kernels become object files side by side, and the C compiler links them with the functions
for other languages. Without a folder the library is for this package itself. Levels are those of
x86-64, 1 to 4; without one it is that of this processor. What was built is kept by a checksum of
all that it was made from, so that it is made once.
"""

import ctypes
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from hashlib import sha256
from importlib import import_module
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from carom.dimensionless.numerics.kernels import ENTRIES, INSTALL, VARIABLE
from carom.dimensionless.numerics.shared_library import CONTENTS, FOLDER, PACKAGE, digest
from carom.native.c_header import kernels_h

HERE = Path(__file__).parent
INCLUDE = PACKAGE / "include"
PROCESSOR = HERE / "processor.c"
OWN_FILES = (*sorted(HERE.glob("*.*")), INCLUDE / "carom.h")
COMPILERS = ("cc", "gcc", "clang")
FLAGS = ("-O2", "-std=c11", "-fPIC", "-shared", "-fvisibility=hidden")
ENDINGS = {"darwin": ".dylib", "win32": ".dll"}
GENERIC = {0: "generic", 1: "x86-64", 2: "x86-64-v2", 3: "x86-64-v3", 4: "x86-64-v4"}
CACHE = "CAROM_BUILD_CACHE"  # of the environment: a folder


class NotBuilt(Exception):
    """There is no library; the message says why."""


def build(folder: Path, levels: Sequence[int] = ()) -> None:
    """Write the libraries and what they hold into a folder, or raise NotBuilt."""
    modules = entry_modules()
    files = source_files()
    known = digest(files)
    libraries = []
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for level in levels or [processor_level(Path(scratch))]:
            path = _kept(known, modules, level, Path(scratch))
            checksum = sha256(path.read_bytes()).hexdigest()
            libraries.append({"file": path.name, "level": level, "sha256": checksum})
            _put(path, folder)
    signatures = {
        name: str(each) for kernel in ENTRIES for name, each in kernel.signatures().items()
    }
    contents = {
        "compiled_by": f"numba {_numba()}",
        "sources": known,
        "files": [path.relative_to(PACKAGE).as_posix() for path in files],
        "signatures": signatures,
        "libraries": libraries,
    }
    (folder / CONTENTS).write_text(json.dumps(contents, indent=1) + "\n", encoding="utf-8")


def entry_modules() -> list[str]:
    """Return the modules with entry points, imported."""
    paths = [path for path in PACKAGE.rglob("*.py") if b"\n@entry_point(" in path.read_bytes()]
    names = [
        ".".join(("carom", *path.relative_to(PACKAGE).with_suffix("").parts)) for path in paths
    ]
    for name in names:
        import_module(name)
    return sorted(names)


def source_files() -> list[Path]:
    """Return the files of the package that kernels can take anything from: all that is imported."""
    found = {Path(each.__file__) for each in _own_modules() if each.__file__}
    return sorted(path for path in found if path.suffix == ".py")


def _own_modules() -> list[Any]:
    own = [module for name, module in sys.modules.items() if name.split(".")[0] == "carom"]
    return [module for module in own if getattr(module, "__file__", None)]


def processor_level(scratch: Path) -> int:
    """Return which level of x86-64 this processor has, 0 if it is another one."""
    path = scratch / f"processor{_ending()}"
    _link(path, [PROCESSOR])
    return int(ctypes.CDLL(str(path)).carom_processor_level())


def _kept(known: str, modules: Sequence[str], level: int, scratch: Path) -> Path:
    """Return the library for a level, built now or before."""
    recipe = [known, digest(OWN_FILES), str(level), _numba(), version("llvmlite")]
    name = f"libcarom{'' if level == 0 else f'-{level}'}{_ending()}"
    folder = kept_in() / sha256(" ".join(recipe).encode()).hexdigest()[:16]
    if (folder / name).is_file():
        return folder / name
    (scratch / "kernels.h").write_text(kernels_h(), encoding="utf-8")
    _link(scratch / name, [PROCESSOR, HERE / "rebound.c", *_objects(modules, level, scratch)])
    with suppress(OSError):  # it is made again then
        folder.mkdir(parents=True, exist_ok=True)
        _put(scratch / name, folder)
    return scratch / name


def _numba() -> str:
    try:
        return version("numba")
    except PackageNotFoundError:
        raise NotBuilt(f"numba is not installed; {INSTALL}") from None


def _put(path: Path, folder: Path) -> None:
    """Copy a file into a folder, whole or not at all; a process may have an older one open."""
    partial = folder / f"{path.name}.{os.getpid()}"
    shutil.copy(path, partial)
    partial.replace(folder / path.name)


def kept_in() -> Path:
    """Return the folder in which libraries are kept, from one build to the next."""
    try:
        return Path(os.environ.get(CACHE) or Path.home() / ".cache/carom/build")
    except RuntimeError:  # a user without a home: nothing can be kept
        return Path(os.devnull)


def _objects(modules: Sequence[str], level: int, scratch: Path) -> list[Path]:
    """Return object files of all entry points, made by several processes."""
    groups = _shared_out(modules, max(2, os.cpu_count() or 2))
    paths = [scratch / f"kernels{level}-{i}.o" for i in range(len(groups))]
    environment = {**os.environ, VARIABLE: "numba", "NUMBA_CPU_NAME": GENERIC[level]}
    environment["NUMBA_CPU_FEATURES"] = ""

    def emit(path: Path, group: Sequence[str]) -> None:
        command = [sys.executable, "-m", "carom.native.emission", path, *group]
        _run([str(each) for each in command], environment)

    with ThreadPoolExecutor(len(groups)) as pool:
        list(pool.map(emit, paths, groups))
    return paths


def _shared_out(modules: Iterable[str], workers: int) -> list[list[str]]:
    """Return groups of modules: those of one folder, which share kernels, stay together."""
    folders: dict[str, list[str]] = {}
    for name in modules:
        folders.setdefault(name.rpartition(".")[0], []).append(name)
    groups: list[list[str]] = [[] for _ in range(min(workers, len(folders)))]
    sizes = [0] * len(groups)
    for names in sorted(folders.values(), key=_size, reverse=True):
        least = sizes.index(min(sizes))
        groups[least] += names
        sizes[least] += _size(names)
    return groups


def _size(names: Sequence[str]) -> int:
    """Return how much code of kernels lies in the folder of some modules."""
    folder = Path(sys.modules[names[0]].__file__ or "").parent
    return sum(
        len(text)
        for path in folder.glob("*.py")
        for text in [path.read_bytes()]
        if b"@kernel" in text
    )


def _link(target: Path, parts: Sequence[Path]) -> None:
    """Make a shared library of files in C and object files, with headers beside the target."""
    own = os.environ.get("CC", "").split()
    compiler = own or [found for name in COMPILERS if (found := shutil.which(name))][:1]
    if not compiler:
        raise NotBuilt("there is no C compiler; install one, and then carom again")
    folders = [f"-I{folder}" for folder in (INCLUDE, target.parent)]
    _run([*compiler, *FLAGS, *folders, "-o", *map(str, (target, *parts)), "-lm"], os.environ)


def _run(command: Sequence[str], environment: Any) -> None:
    try:
        subprocess.run(
            command, env=environment, cwd=PACKAGE.parent, check=True, capture_output=True, text=True
        )
    except (OSError, subprocess.CalledProcessError) as error:
        told = str(getattr(error, "stderr", "") or error).strip().splitlines()
        raise NotBuilt(
            f"{Path(command[0]).name} has failed: {told[-1] if told else error}"
        ) from None


def _ending() -> str:
    return ENDINGS.get(sys.platform, ".so")


def main(arguments: Sequence[str]) -> int:
    """Build into the folder that is told; say in a line why not."""
    folder, *levels = arguments or [str(FOLDER)]
    try:
        build(Path(folder), [int(level) for level in levels])
    except NotBuilt as error:
        print(f"carom: no compiled library: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
