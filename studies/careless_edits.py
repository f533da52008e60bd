"""Do the tests notice a careless edit? Small faults put into the source at random, one at a time.

python studies/careless_edits.py             60 edits, three hours on two cores
python studies/careless_edits.py --list      the edits alone
python studies/careless_edits.py --only 7    one of them, with what the tests say; 0: no edit at all

An edit is what a tired hand does: an operator, a comparison or a bound turned round, a constant
off by a hundredth or by one, a sign or a `not` lost, a statement gone. Left out are the words that
guard and do nothing else: strict=True of zip, frozen=True of a dataclass.
"""

import argparse
import ast
import csv
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from rich.progress import track

ROOT = Path(__file__).parents[1]
TABLE = Path(__file__).with_suffix(".csv")
SEED = 20261122
EDITS = 60
NEAR = 40  # characters around an edit
RELATED = 15  # test files that are run first
LIMIT = 600  # s that the tests of one edit may take, three times what they need
SWAPS = {
    **{ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")},
    **{ast.Lt: ("<", ">="), ast.LtE: ("<=", ">"), ast.Gt: (">", "<="), ast.GtE: (">=", "<")},
    **{
        ast.Eq: ("==", "!="),
        ast.NotEq: ("!=", "=="),
        ast.And: ("and", "or"),
        ast.Or: ("or", "and"),
    },
}
GUARDS = ("strict", "frozen", "eq", "slots", "kw_only", "compare", "repr")
NAMES = {"min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum"} | {
    **{"sin": "cos", "cos": "sin", "any": "all", "all": "any", "first": "second"}
}


class Edit(NamedTuple):
    """Some characters of a file, and what stands there instead."""

    file: str
    start: int
    end: int
    new: str

    def told(self, text: str) -> tuple[int, str, str]:
        """Return the line and what it says before and after."""
        number = text.count("\n", 0, self.start) + 1
        edited = text[: self.start] + self.new + text[self.end :]
        lines = [each.splitlines()[number - 1].strip() for each in (text, edited)]
        return number, *lines


def edits_of(file: str, text: str) -> Iterator[Edit]:
    """Yield every edit that a file admits."""
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    lines = text.splitlines()

    def place(line: int, column: int) -> int:
        return starts[line - 1] + len(lines[line - 1].encode()[:column].decode())

    def begin(node: ast.AST) -> int:
        return place(node.lineno, node.col_offset)

    def end(node: ast.AST) -> int:
        return place(node.end_lineno, node.end_col_offset)

    def between(operator: ast.AST, left: ast.AST, right: ast.AST) -> Iterator[Edit]:
        if type(operator) in SWAPS:
            old, new = SWAPS[type(operator)]
            at = text.find(old, end(left), begin(right))
            if at >= 0:
                yield Edit(file, at, at + len(old), new)

    for node in ast.walk(_stripped(ast.parse(text))):
        match node:
            case ast.BinOp(left=left, op=op, right=right):
                yield from between(op, left, right)
            case ast.Compare(left=left, ops=[op], comparators=[right]):
                yield from between(op, left, right)
            case ast.BoolOp(op=op, values=[left, right, *_]):
                yield from between(op, left, right)
            case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand):
                yield Edit(file, begin(node), begin(operand), "")
            case ast.Constant(value=bool() | int() | float() as value):
                yield Edit(file, begin(node), end(node), _other(value))
            case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name) as func) if (
                name in NAMES
            ):
                yield Edit(file, end(func) - len(name), end(func), NAMES[name])
            case ast.Expr(value=ast.Call()) | ast.AugAssign() | ast.Raise():
                yield Edit(file, begin(node), end(node), "pass")


def _other(value: bool | int | float) -> str:
    if isinstance(value, bool):
        return str(not value)
    if isinstance(value, int):
        return str(value + 1)
    return repr(value * 1.01) if value else "0.01"


def _stripped(tree: ast.Module) -> ast.Module:
    """Remove annotations and guards."""
    for node in ast.walk(tree):
        for name in ("annotation", "returns"):
            if getattr(node, name, None) is not None:
                setattr(node, name, None)
        if isinstance(node, ast.Call):
            node.keywords = [each for each in node.keywords if each.arg not in GUARDS]
    return tree


def sampled(count: int) -> list[Edit]:
    """Return edits drawn at random from all that the package admits.

    Each draws its own lot from its words, so that a change elsewhere leaves the sample as it is.
    """
    lots: dict[str, Edit] = {}
    for path in sorted((ROOT / "src/carom").rglob("*.py")):
        file, text = str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")
        for edit in edits_of(file, text):
            words = text[max(edit.start - NEAR, 0) : edit.end + NEAR]
            lots[sha256(f"{SEED} {file} {words} {edit.new}".encode()).hexdigest()] = edit
    return [lots[lot] for lot in sorted(lots)[:count]]


def test_files(edit: Edit) -> tuple[list[str], list[str]]:
    """Return the tests that speak most of the file, and the others, those with a browser last."""
    module = edit.file.removeprefix("src/").removesuffix(".py").split("/")
    words = {*module[1:], *(module[1:2] and [".".join(module)])} - {"__init__"}
    scores = {}
    for path in sorted((ROOT / "tests").glob("*/test_*.py")):
        name, text = str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")
        share = sum(len(re.findall(rf"\b{word}\b", text)) for word in words) / len(text)
        scores[name] = share - 1.0 * ("browser" in name)
    ordered = sorted(scores, key=scores.__getitem__, reverse=True)
    return ordered[:RELATED], ordered[RELATED:]


def caught(edit: Edit, shown: bool = False) -> str:
    """Return the test that notices the edit, empty if none does."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        _copy_to(tree)
        path = tree / edit.file
        text = path.read_text(encoding="utf-8")
        path.write_text(text[: edit.start] + edit.new + text[edit.end :], encoding="utf-8")
        source = str(tree / "src")
        (tree / "tmp").mkdir()
        own = {"PYTHONPATH": source, "TMPDIR": str(tree / "tmp"), "PYTHONDONTWRITEBYTECODE": "1"}
        environment = {**os.environ, **own}
        library = [sys.executable, "-m", "carom.native.building", str(tree / "src/carom/lib")]
        built = subprocess.run(library, env=environment, capture_output=not shown, text=True)
        if built.returncode:
            return "the library is not built"
        for files in test_files(edit):
            pytest = [sys.executable, "-m", "pytest", "-x", "-n", "2", "-m", "not slow", *files]
            try:
                run = subprocess.run(
                    pytest, cwd=tree, env=environment, capture_output=True, text=True, timeout=LIMIT
                )
            except subprocess.TimeoutExpired:
                return "the tests do not end"
            if shown:
                print(run.stdout)
            if run.returncode:
                failed = re.findall(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", run.stdout, re.MULTILINE)
                return failed[0] if failed else "pytest does not start"
    return ""


def _copy_to(tree: Path) -> None:
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, names.split("\0")):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tree / name)


def main() -> None:
    """Run the tests on every edit and store who caught it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--list", action="store_true", help="show the edits, run nothing")
    parser.add_argument("--only", type=int, metavar="N", help="the N-th edit alone, 0: none")
    given = parser.parse_args()
    edits = sampled(EDITS)
    told = [edit.told((ROOT / edit.file).read_text(encoding="utf-8")) for edit in edits]
    if given.list:
        for number, (edit, (line, old, new)) in enumerate(zip(edits, told, strict=True), 1):
            print(f"{number:2} {edit.file}:{line}\n     {old}\n     {new}")
        return
    if given.only is not None:
        nothing = edits[0]._replace(end=edits[0].start, new="")
        print(caught([nothing, *edits][given.only], shown=True) or "not caught")
        return
    run_all(edits, told)


def run_all(edits: list[Edit], told: list[tuple[int, str, str]]) -> None:
    """Run the tests on every edit that is not in the table yet, and add who caught it."""
    known = set()
    if TABLE.exists():
        rows = csv.DictReader(TABLE.read_text(encoding="utf-8").splitlines())
        known = {(row["file"], row["before"], row["after"]) for row in rows}
    with TABLE.open("a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if not known:
            writer.writerow(["file", "line", "before", "after", "caught_by", "seconds"])
        for edit, (line, old, new) in zip(track(edits), told, strict=False):
            if (edit.file, old, new) in known:
                continue
            begun = time.monotonic()
            who = caught(edit)
            writer.writerow([edit.file, line, old, new, who, round(time.monotonic() - begun)])
            file.flush()


if __name__ == "__main__":
    main()
