"""Kernels for the explorer page: the same sources, compiled for browsers instead of processors.

    python -m carom.native.browser FOLDER

An object file of WebAssembly is a module that a browser loads, once it says what it exports; no
linker is needed. Beside it is told how long the arrays are that its functions work on, what their
columns hold, and from which sources it was made.
"""

import json
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm

from carom.dimensionless.elastic import dense_output, phases, record
from carom.dimensionless.lossy import law, layout
from carom.dimensionless.lossy.springs import march, motion, springs
from carom.dimensionless.lossy.viscoelastic import impacts, record as viscous, work
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.kernels import ENTRIES, Kernel
from carom.dimensionless.numerics.shared_library import BROWSER, BROWSER_CONTENTS, digest
from carom.dimensionless.rebounds import LINEAR_PSI, STEP_TOLERANCE
from carom.dimensionless.states import KIND_NAMES
from carom.folder import PACKAGE
from carom.native import emission, numba_internals
from carom.native.building import HERE, source_files

FUNCTIONS = (
    "rebounds.fill",  # psi_2 of elastic impacts, on plates too
    "elastic.plates.normal_motion",
    "elastic.phases.run_phases",  # one of them, and its course
    "elastic.dense_output.tabulate",
    "elastic.dense_output.sample",
    "lossy.viscoelastic.normal.restitution",
    "lossy.viscoelastic.impacts.fill",
    "lossy.viscoelastic.impacts.outgoing",
    "lossy.springs.march.trace",  # springs, of which tractions are made
)
MODULES = sorted({f"carom.dimensionless.{name.rpartition('.')[0]}" for name in FUNCTIONS})
TARGET = "wasm32-unknown-unknown"
FEATURES = "+bulk-memory,+mutable-globals,+nontrapping-fptoint,+sign-ext,+simd128"
CUSTOM, EXPORTS, FOLLOWING = 0, 7, (8, 9, 10, 11, 12)  # kinds of sections of a module
SYMBOLS, FUNCTION, UNDEFINED = 8, 0, 0x10  # of the section by which linkers find names
MOST_STEPS, MOST_STRETCHES = 4000, 300  # of an impact that a page shows


def build(folder: Path, sources: str, files: Sequence[str]) -> None:
    """Write the module and what it holds into a folder; sources is their checksum."""
    kernels = {_path(each): each for each in ENTRIES if _path(each) in FUNCTIONS}
    symbols = {path: next(iter(kernels[path].signatures())) for path in FUNCTIONS}
    module = exporting(_wasm(emission.linked([*kernels.values()])), symbols)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / BROWSER).write_bytes(module)
    contents = {
        "sources": sources,
        "files": list(files),
        "sha256": sha256(module).hexdigest(),
        **described(),
    }
    (folder / BROWSER_CONTENTS).write_text(json.dumps(contents, indent=1) + "\n", encoding="utf-8")


def _path(kernel: Kernel[..., Any]) -> str:
    return f"{kernel.__module__}.{kernel.py_func.__name__}".removeprefix("carom.dimensionless.")


def described() -> dict[str, Any]:
    """Return the arrays that functions work on, what their columns hold, and other numbers."""
    elastic = record.new_record(True)
    cut = {"nodes": MOST_STEPS, "series": MOST_STEPS, "stacks": MOST_STRETCHES}
    cut["depths"] = MOST_STRETCHES
    kept = {name: each[: cut.get(name)] for name, each in elastic._asdict().items()}
    return {
        "arrays": {
            "elastic": _shapes(phases.new_work()._asdict()),
            "course": _shapes(kept),
            "nothing": _shapes(record.new_record(False)._asdict()),
            "viscous": _shapes(work.new_work()._asdict()),
            "panels": _shapes(viscous.new_record(True)._asdict()),
            "no_panels": _shapes(viscous.new_record(False)._asdict()),
            "springs": _shapes(march.new_work()._asdict()),
            "trial": _shapes(march.new_work()._asdict()),
        },
        "columns": {
            "sampled": _places(dense_output, "AT_"),
            "changes": {name: getattr(record, name) for name in ("KIND", "KIND_SIGN")},
            "rows": _places(layout, "AT_"),
            "numbers": {
                name: value
                for name, value in _places(layout, "").items()
                if name.isupper() and not name.startswith(("AT_", "ROWS", "NUMBERS"))
            },
            "frames": {"PULLED": march.PULLED, "X": springs.X},
        },
        "sizes": {
            "sampled": dense_output.SAMPLED,
            "rows": march.ROWS,
            "frames": march.FRAMES,
            "numbers": layout.NUMBERS,
            "spare": march.SPARE_SPRINGS,
        },
        "losses": {each.name: each.value for each in law.Loss},
        "kinds": {str(int(kind)): name for kind, name in KIND_NAMES.items()},
        "inertia": list(motion.Inertia(0.0)),
        "tolerances": {"step": STEP_TOLERANCE, "panel": impacts.TOLERANCE},
        "smallest": {"elastic": LINEAR_PSI, "viscous": impacts.SMALLEST_PSI},
        "largest_psi": law.LARGEST_PSI,
        "duration": hertz.DURATION,
    }


def _shapes(arrays: dict[str, Any]) -> list[Any]:
    return [[each.dtype.str[1:], list(each.shape)] for each in arrays.values()]


def _places(module: Any, prefix: str) -> dict[str, int]:
    names = (name for name in vars(module) if name.startswith(prefix))
    return {name: getattr(module, name) for name in names if type(getattr(module, name)) is int}


def _wasm(library: Any) -> bytes:
    """Return the object file of a library for browsers."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TARGET).create_target_machine(
        features=FEATURES, opt=3, reloc="static", codemodel="default"
    )
    text = str(numba_internals.whole(library))
    for what, value in (("datalayout", machine.target_data), ("triple", TARGET)):
        text = re.sub(rf'target {what} = ".*"', f'target {what} = "{value}"', text)
    module = llvm.parse_assembly(text)
    passes = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    passes.getModulePassManager().run(module, passes)
    return bytes(machine.emit_object(module))


def exporting(module: bytes, symbols: Mapping[str, str]) -> bytes:
    """Return an object file with functions exported by name, and without what only linkers read."""
    sections = list(_sections(module))
    (linking,) = (each for kind, each in sections if kind == CUSTOM and each[1:8] == b"linking")
    indices = _functions(linking, _text(linking, 0)[1])
    exported = ((name, indices[symbol]) for name, symbol in symbols.items())
    entries = b"".join(_named(name) + b"\0" + _leb(index) for name, index in exported)
    parts = [(kind, content) for kind, content in sections if kind != CUSTOM]
    place = next(i for i, (kind, _) in enumerate(parts) if kind in FOLLOWING)
    parts.insert(place, (EXPORTS, _leb(len(symbols)) + entries))
    return module[:8] + b"".join(bytes([k]) + _leb(len(each)) + each for k, each in parts)


def _sections(module: bytes) -> Iterator[tuple[int, bytes]]:
    """Give the kind and the content of each section, which follow a head of eight bytes."""
    place = 8
    while place < len(module):
        kind = module[place]
        size, start = _number(module, place + 1)
        place = start + size
        yield kind, module[start:place]


def _functions(linking: bytes, place: int) -> dict[str, int]:
    """Return the places of functions by their names, from the table of symbols."""
    _, place = _number(linking, place)  # the version
    while linking[place] != SYMBOLS:
        size, start = _number(linking, place + 1)
        place = start + size
    _, place = _number(linking, place + 1)
    count, place = _number(linking, place)
    found = {}
    for _ in range(count):
        kind = linking[place]
        flags, place = _number(linking, place + 1)
        index, place = _number(linking, place) if kind != 1 else (0, place)
        named = kind == 1 or not flags & UNDEFINED
        name, place = _text(linking, place) if named else ("", place)
        if kind == FUNCTION:
            found[name] = index
        if kind == 1 and not flags & UNDEFINED:  # of data: segment, offset, size
            for _ in range(3):
                _, place = _number(linking, place)
    return found


def _number(data: bytes, place: int) -> tuple[int, int]:
    """Return a number in LEB128 and the place behind it."""
    value = shift = 0
    while True:
        byte = data[place]
        value |= (byte & 127) << shift
        place, shift = place + 1, shift + 7
        if byte < 128:
            return value, place


def _text(data: bytes, place: int) -> tuple[str, int]:
    size, start = _number(data, place)
    return data[start : start + size].decode(), start + size


def _leb(number: int) -> bytes:
    low = bytes([number & 127 | (128 if number > 127 else 0)])
    return low + (_leb(number >> 7) if number > 127 else b"")


def _named(name: str) -> bytes:
    return _leb(len(name)) + name.encode()


def main(folder: str) -> None:
    """Write the module for browsers into a folder."""
    for name in MODULES:
        import_module(name)
    files = [path for path in source_files() if not path.is_relative_to(HERE)]
    build(Path(folder), digest(files), [path.relative_to(PACKAGE).as_posix() for path in files])


if __name__ == "__main__":
    main(*sys.argv[1:])
