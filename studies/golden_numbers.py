"""Do calls, commands, texts and kernels give what they gave before a change? To the last bit.

python studies/golden_numbers.py record FILE     the state before, in a minute or two
python studies/golden_numbers.py compare FILE    the state after: what differs, by name; exit code 1

The same bits are to be expected of one machine only, so FILE is none that is kept.
"""

import argparse
import dataclasses
import hashlib
import json
import os
import random
import re
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

ROOT = Path(__file__).parents[1]
EXAMPLES = Path("examples")  # seen from there
sys.path.insert(0, str(ROOT))
os.chdir(ROOT)

from tests.fuzz import test_calls as pool  # noqa: E402

import carom  # noqa: E402

VARIED, HOSTILE, COSTLY = 4000, 4000, 400  # calls
ELSEWHERE = {"bench"}  # it needs programs of others
UNTOLD = {"source", "version", "created", "history"}  # attributes that tell where a dataset is from

ADDRESS = re.compile(r"0x[0-9a-f]{6,}")
MODULES = re.compile(r"\bcarom(?:\.[a-z_]\w*)+\.(?=[A-Z<])")  # before a class: where it stands

ROOMS = "carom|dimensionless|halfspace|theory|dem|laws|many|collisions"
PARTS = "numerics|elastic|lossy|springs|viscoelastic"
MODULE = re.compile(rf"\b(?:(?:{ROOMS}|{PARTS})_)+(?=\w)")  # in names of C functions

Answers = dict[str, str]


def words_of(text: str) -> str:
    """Return a text without addresses, and without the modules in which classes stand."""
    return MODULES.sub("", ADDRESS.sub("0x", text)).replace(str(ROOT), "")


def written(value: Any) -> str:
    """Return everything that a result says, numbers to the last bit."""
    if isinstance(value, float | np.floating):
        return float(value).hex()
    if value is None or isinstance(value, str | bytes | int | complex | np.generic):
        return words_of(repr(value))

    if isinstance(value, xr.Dataset):
        told = {name: each for name, each in value.attrs.items() if name not in UNTOLD}
        columns = {str(name): each for name, each in value.variables.items()}
        return f"Dataset({written(told)}, {written(columns)})"
    if isinstance(value, xr.DataArray):
        return f"DataArray({written(value.to_dataset(name='values'))})"
    if isinstance(value, xr.Variable):
        return f"({value.dims}, {written(value.values)}, {written(dict(value.attrs))})"
    if isinstance(value, pd.DataFrame):
        return f"DataFrame({written(value.to_dict('list'))})"

    if isinstance(value, np.ndarray):
        return _written_array(value)
    if isinstance(value, dict):
        return "{" + ", ".join(sorted(f"{key!r}: {written(value[key])}" for key in value)) + "}"
    if isinstance(value, list | tuple):
        return f"{type(value).__name__}({', '.join(map(written, value))})"
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [each.name for each in dataclasses.fields(value) if not each.name.startswith("_")]
        parts = [f"{name}={written(getattr(value, name))}" for name in names]
        if hasattr(value, "to_dataset"):
            parts += [written(value.to_dataset()), words_of(str(value))]
        return f"{type(value).__name__}({', '.join(parts)})"
    return type(value).__name__


def _written_array(array: np.ndarray) -> str:
    if array.dtype == object or array.dtype.fields:
        return written(array.tolist())
    digest = hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()[:16]
    return f"{array.dtype.str}{array.shape}{digest}"


def answer(function: Callable[..., Any], data: dict[str, Any]) -> str:
    """Return what a call comes to: its result and warnings, or its error."""
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            said = written(function(**data))
        except Exception as error:
            said = words_of(f"{type(error).__name__}: {error}")
    return " | ".join([said, *(words_of(str(each.message)) for each in warned)])


def calls() -> Iterator[tuple[str, str]]:
    """Yield answers of the functions that users call: to varied numbers, and to hostile input."""
    cheap, costly = pool.tables()
    for kind, table, count in (("cheap", cheap, VARIED), ("costly", costly, COSTLY)):
        names = sorted(set(table) - ELSEWHERE)
        for i in range(count):
            name = names[i % len(names)]
            function, valid = table[name]
            chance = random.Random(f"{kind} {i}")
            data = {key: varied(value, chance) for key, value in valid.items()}
            yield f"call {kind} {i}: {name}", answer(function, data)

    names = sorted(set(cheap) - ELSEWHERE)
    for i in range(HOSTILE):
        chance = random.Random(f"hostile {i}")
        alone = {names[i % len(names)]: cheap[names[i % len(names)]]}
        name, function, data, worse = pool.hostile_call(chance, alone)
        yield f"call hostile {i}: {name}, {', '.join(worse)}", answer(function, data)


def varied(value: Any, chance: random.Random) -> Any:
    """Return numbers that are somewhat larger or smaller; everything else as it is."""
    if isinstance(value, float):
        return value * chance.uniform(0.7, 1.4)
    if isinstance(value, list):
        return [varied(each, chance) for each in value]
    return value


def commands() -> Iterator[tuple[str, str]]:
    """Yield what commands print, as text and as JSON, and their refusals."""
    ball = ["--radius", "5mm", "--material", "steel", "--friction", "0.2"]
    fast = ["--speed", "2", "--angle", "30deg"]
    impact = ["impact", *ball, *fast]
    lines = [
        impact,
        [*impact, "--restitution", "0.9"],
        [*impact, "--spin", "100 rad/s", "--normal-spin", "30"],
        [*impact, "--second-material", "soda-lime-glass"],
        *(["impact", str(path)] for path in sorted(EXAMPLES.glob("*.toml"))),
        ["curve", "--chi", "1.44"],
        ["curve", "--chi", "1.44", "--restitution", "0.8"],
        ["curve", "--chi", "1.44", "--export", "c"],
        ["materials"],
        *(["fit", "--dataset", name] for name in ("kharaz2001", "foerster1994-glass")),
        *(["fit", str(path)] for path in sorted(EXAMPLES.glob("data/*.csv"))),
        ["fit", "--template"],
        ["verify", "laws"],
        ["verify", "laws", "--law", "mindlin"],
        ["sweep", str(EXAMPLES / "sweep.toml"), "--progress"],
        ["sweep", str(EXAMPLES / "sweep.toml")],
        ["impact", "--radius", "-5mm", "--material", "stel", "--friction", "x"],
        ["impact", "--speed", "2"],
        ["curve"],
        ["fit"],
        ["fit", "nothing.csv"],
        ["nothing"],
    ]
    groups = [[], ["impact"], ["curve"], ["fit"], ["track"], ["sweep"], ["materials"], ["explore"]]
    groups += [["verify"], ["lammps"], ["liggghts"]]
    lines += [[*words, "--help"] for words in groups]

    for line in lines:
        for more in ([], ["--json"]):
            yield f"command {' '.join([*line, *more])}", said([*line, *more])


def said(words: list[str]) -> str:
    """Return what a command prints, and its exit code."""
    program = [sys.executable, "-c", "from carom.cli import run; run()", *words]
    plain = {**os.environ, "COLUMNS": "100", "TERM": "dumb"}
    done = subprocess.run(
        program, capture_output=True, text=True, env=plain, timeout=600, check=False
    )
    text = re.sub(r'"(source|version)": "[^"]*"', r'"\1"', done.stdout)
    return words_of(f"{done.returncode}\n{text}\n{done.stderr}")


def kernels() -> Iterator[tuple[str, str]]:
    """Yield the machine code of each function of the library, without places and modules."""
    library = carom.get_library()
    listing = subprocess.run(
        ["objdump", "-d", "--no-show-raw-insn", "--no-addresses", library],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    for block in listing.split("\n\n"):
        head, _, body = block.partition("\n")
        if match := re.fullmatch(r"<(.+)>:", head.strip()):
            yield f"kernel {short(match[1])}", normal(body)


def short(symbol: str) -> str:
    """Return the name of a function without the modules it stands in, as C or numba has it."""
    if not symbol.startswith("_ZN5carom"):
        return MODULE.sub("", symbol)

    name, rest = "", symbol.removeprefix("_ZN")
    while match := re.match(r"\d+", rest):  # how long each part is, and the part
        end = match.end() + int(match[0])
        name, rest = rest[match.end() : end], rest[end:]
    return name + re.sub(r"B\d+v\d+", "", rest)


def normal(body: str) -> str:
    """Return instructions without addresses; what is called by its short name."""
    body = re.sub(r"-?0x[0-9a-f]+\(%rip\)", "(%rip)", body)
    body = re.sub(r"\s+#.*", "", body)
    return re.sub(r"<([^>+]+)", lambda match: f"<{short(match[1])}", body)


def recorded() -> Answers:
    """Return digests of all answers by name; refusals and warnings as they are."""
    answers: Answers = {}
    for part in (calls, commands, kernels):
        for name, text in part():
            digest = hashlib.sha256(text.encode(errors="replace")).hexdigest()[:16]
            answers[name] = text if len(text) < 200 else f"{digest} {text[:200]}"
        print(f"{len(answers)} answers", file=sys.stderr)
    return answers


def main() -> int:
    """Record, or compare and tell what differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("record", "compare"))
    parser.add_argument("file", type=Path)
    given = parser.parse_args()

    now = recorded()
    if given.what == "record":
        given.file.write_text(json.dumps(now, indent=0))
        return 0

    before = json.loads(given.file.read_text())
    differ = [name for name in sorted({*before, *now}) if before.get(name) != now.get(name)]
    for name in differ:
        print(f"{name}\n  before: {before.get(name)}\n  now:    {now.get(name)}")
    print(f"{len(differ)} of {len(now)} differ")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
