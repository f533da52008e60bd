"""Building the shared library of compiled kernels, when the package is built.

    python -m carom.native.building [FOLDER [LEVEL ...]]

Groups of kernels become object files side by side, and the C compiler links them with the functions
for other languages. Without a folder the library is for this package itself. Levels are those of
x86-64, 1 to 4; without one it is that of this processor. What was built is kept by a checksum of
all that it was made from, so that it is made once. Kernels for browsers are made beside it, also
where there is no C compiler.
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

from carom.dimensionless import rebounds
from carom.dimensionless.elastic import phases, record as elastic
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.viscoelastic import impacts, work
from carom.dimensionless.lossy.viscoelastic.record import new_record
from carom.dimensionless.numerics.kernels import ENTRIES, INSTALL, VARIABLE
from carom.dimensionless.numerics.shared_library import (
    BROWSER,
    BROWSER_CONTENTS,
    CONTENTS,
    FOLDER,
    digest,
)
from carom.folder import PACKAGE

HERE = Path(__file__).parent
INCLUDE = PACKAGE / "include"
PROCESSOR = HERE / "processor.c"
OWN_FILES = (*sorted(HERE.glob("*.*")), INCLUDE / "carom.h")
COMPILERS = ("cc", "gcc", "clang")
FLAGS = ("-O2", "-std=c11", "-fPIC", "-shared", "-fvisibility=hidden")
ENDINGS = {"darwin": ".dylib", "win32": ".dll"}
GENERIC = {0: "generic", 1: "x86-64", 2: "x86-64-v2", 3: "x86-64-v3", 4: "x86-64-v4"}
CACHE = "CAROM_BUILD_CACHE"  # of the environment: a folder
CALLED_BY_C: dict[str, Any] = {
    "ELASTIC": rebounds.fill,
    "MOTION": rebounds.fill_motion,
    "LOSSY": impacts.fill,
}


class NotBuilt(Exception):
    """There is no library; the message says why."""


def build(folder: Path, levels: Sequence[int] = ()) -> None:
    """Write the libraries and what they hold into a folder, or raise NotBuilt."""
    modules = entry_modules()
    files = source_files()
    sources = digest(files)
    libraries = []
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(1) as beside:
        for_browsers = beside.submit(_build_for_browsers, folder, sources)
        for level in levels or [processor_level(Path(scratch))]:
            path = _kept(sources, modules, level, Path(scratch))
            checksum = sha256(path.read_bytes()).hexdigest()
            libraries.append({"file": path.name, "level": level, "sha256": checksum})
            _put(path, folder)
        for_browsers.result()
    signatures = (each for kernel in ENTRIES for each in kernel.signatures().items())
    contents = {
        "compiled_by": f"numba {_numba()}",
        "sources": sources,
        "files": [path.relative_to(PACKAGE).as_posix() for path in files],
        "signatures": {name: str(each) for name, each in signatures},
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
    own = (module for name, module in sys.modules.items() if name.split(".")[0] == "carom")
    files = {Path(getattr(module, "__file__", None) or "") for module in own}
    return sorted(path for path in files if path.suffix == ".py")


def processor_level(scratch: Path) -> int:
    """Return which level of x86-64 this processor has, 0 if it is another one."""
    path = scratch / f"processor{_ending()}"
    _link(path, [PROCESSOR])
    return int(ctypes.CDLL(str(path)).carom_processor_level())


def _build_for_browsers(folder: Path, sources: str) -> None:
    """Write the kernels for browsers into a folder, built now or before."""
    recipe = [sources, digest(OWN_FILES), _numba(), version("llvmlite")]
    kept = kept_in() / sha256(" ".join(recipe).encode()).hexdigest()[:16]
    with tempfile.TemporaryDirectory() as scratch:
        made = kept
        if not (kept / BROWSER_CONTENTS).is_file():
            made = Path(scratch)
            _run([sys.executable, "-m", "carom.native.browser", scratch], _environment(0))
            with suppress(OSError):  # it is made again then
                kept.mkdir(parents=True, exist_ok=True)
                for name in (BROWSER, BROWSER_CONTENTS):
                    _put(made / name, kept)
        for name in (BROWSER, BROWSER_CONTENTS):
            _put(made / name, folder)


def _kept(sources: str, modules: Sequence[str], level: int, scratch: Path) -> Path:
    """Return the library for a level, built now or before."""
    compiler = os.environ.get("CC", "")  # it can be one for other machines
    recipe = [sources, digest(OWN_FILES), str(level), _numba(), version("llvmlite"), compiler]
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


def kernels_h() -> str:
    """Return what the functions in C must know of kernels: shapes of scratch arrays, codes."""
    elastic_work = phases.new_work()
    functions = {name: next(iter(kernel.signatures())) for name, kernel in CALLED_BY_C.items()}
    defined = {
        **{f"CAROM_{name}": function for name, function in functions.items()},
        "CAROM_ELASTIC_SCRATCH": _shapes((*elastic_work, *elastic.new_record(False))),
        "CAROM_WORK_ARRAYS": len(elastic_work),
        "CAROM_LOSSY_SCRATCH": _shapes((*work.new_work(), *new_record(False))),
        "CAROM_NUMBERS": layout.NUMBERS,
        "CAROM_PSI_OUT": layout.PSI_OUT,
        "CAROM_RESTITUTION": layout.RESTITUTION,
        "CAROM_DURATION": layout.TIME,
        "CAROM_NEARLY_ELASTIC": rebounds.NEARLY_ELASTIC,
        "CAROM_STEP_TOLERANCE": rebounds.STEP_TOLERANCE,
        "CAROM_TOLERANCE": impacts.TOLERANCE,
        "CAROM_MESSAGES": _braces(f'"{status.message}"' for status in phases.Status),
    }
    lines = (f"#define {name} {value}" for name, value in defined.items())
    declared = (f"int {name}(const int64_t *words);" for name in functions.values())
    return "\n".join(("#include <stdint.h>", "", *lines, "", *declared, ""))


def _shapes(arrays: Iterable[Any]) -> str:
    return _braces(f"{{{each.ndim}, {_braces(map(str, each.shape))}}}" for each in arrays)


def _braces(texts: Iterable[str]) -> str:
    return f"{{{', '.join(texts)}}}"


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
    environment = _environment(level)

    def emit(path: Path, group: Sequence[str]) -> None:
        command = [sys.executable, "-m", "carom.native.emission", path, *group]
        _run([str(each) for each in command], environment)

    with ThreadPoolExecutor(len(groups)) as pool:
        list(pool.map(emit, paths, groups))
    return paths


def _environment(level: int) -> dict[str, str]:
    """Return the environment in which numba makes modules for a level of processors."""
    numba = {"NUMBA_CPU_NAME": GENERIC[level], "NUMBA_CPU_FEATURES": ""}
    return {**os.environ, VARIABLE: "numba", **numba}


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
    texts = [path.read_bytes() for path in folder.glob("*.py")]
    return sum(len(text) for text in texts if b"@kernel" in text)


def _link(target: Path, parts: Sequence[Path]) -> None:
    """Make a shared library of files in C and object files, with headers beside the target."""
    own = os.environ.get("CC", "").split()
    compiler = own or [*filter(None, map(shutil.which, COMPILERS))][:1]
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
        lines = str(getattr(error, "stderr", "") or error).strip().splitlines()
        why = lines[-1] if lines else error
        raise NotBuilt(f"{Path(command[0]).name} has failed: {why}") from None


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
