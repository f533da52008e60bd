"""How many small edits of the code do the tests notice? Seeded, room by room.

python studies/power_of_tests.py trace    which tests run which lines, once: half an hour
python studies/power_of_tests.py          edits one by one, against the tests that run their lines;
                                          goes on where it was stopped; writes power_of_tests.csv

Edits turn operators and comparisons, change constants and signs, and drop statements. They are made
in a copy, whose library is built again where kernels can be other ones. An edit of a kernel is
tried against the tests that run a caller of it in Python. Needs coverage and a C compiler.
"""

import argparse
import ast
import csv
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "carom"
TABLE = Path(__file__).with_suffix(".csv")
TRACE = ROOT / ".coverage.power"  # which tests run which lines
ROOMS = {
    "theory": ("dimensionless/**/*.py", "halfspace/**/*.py"),
    "bodies": ("bodies/*.py",),
    "fits": ("fitting/*.py",),
    "tables": ("io/*.py",),
    "verdicts": ("impacts/findings.py", "impacts/plate_findings.py", "impacts/validity.py"),
}
TESTS = ("tests", "--ignore=tests/browser", "--ignore=tests/lammps", "--ignore=tests/liggghts")
EACH, MOST, SECONDS = 24, 60, 600.0  # edits of a room; tests of an edit, and their time
BUILDING = "carom.native.building"
COLUMNS = ("room", "place", "edit", "tests", "noticed", "seconds")


class Edit(NamedTuple):
    """A place in a file, from one byte to another, and what is put there."""

    path: Path
    line: int
    start: int
    stop: int
    old: str
    new: str

    def applied(self) -> bytes:
        raw = self.path.read_bytes()
        return raw[: self.start] + self.new.encode() + raw[self.stop :]


OPERATORS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")}
COMPARISONS = {ast.Lt: ("<", ">="), ast.LtE: ("<=", ">"), ast.Gt: (">", "<="), ast.GtE: (">=", "<")}
COMPARISONS |= {ast.Eq: ("==", "!="), ast.NotEq: ("!=", "==")}


def edits_of(path: Path) -> Iterator[Edit]:
    """Yield all edits of the functions of a file, and of its constants."""
    raw = path.read_bytes()
    starts = [0]
    for line in raw.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))

    def span(node: Any) -> tuple[int, int]:
        start = starts[node.lineno - 1] + node.col_offset
        return start, starts[node.end_lineno - 1] + node.end_col_offset

    def edit(node: Any, start: int, stop: int, new: str) -> Edit:
        return Edit(path, node.lineno, start, stop, raw[start:stop].decode(), new)

    def swapped(node: Any, left: Any, right: Any, signs: tuple[str, str]) -> Iterator[Edit]:
        start, stop = span(left)[1], span(right)[0]
        between = raw[start:stop].decode()
        if between.count(signs[0]) == 1:
            yield edit(node, start, stop, between.replace(*signs))

    for node in ast.walk(ast.parse(raw)):
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            yield from swapped(node, node.left, node.right, OPERATORS[type(node.op)])
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in COMPARISONS:
            yield from swapped(node, node.left, node.comparators[0], COMPARISONS[type(node.ops[0])])
        elif isinstance(node, ast.Constant) and type(node.value) in (int, float) and node.value:
            new = node.value * 1.2 if isinstance(node.value, float) else node.value + 1
            yield edit(node, *span(node), repr(new))
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
            yield edit(node, span(node)[0], span(node.operand)[0], "")
        elif isinstance(node, ast.AugAssign) or _calls(node):
            yield edit(node, *span(node), "pass")


def _calls(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)


def chosen() -> Iterator[tuple[str, Edit]]:
    """Yield the edits of each room, seeded; a room has as many of each file as it has lines."""
    for room, places in ROOMS.items():
        paths = sorted(path for place in places for path in PACKAGE.glob(place))
        edits = [edit for path in paths for edit in edits_of(path)]
        for edit in random.Random(room).sample(edits, EACH):
            yield room, edit


class Trace:
    """Which tests run which lines, as coverage has kept it, and what calls a kernel."""

    def __init__(self) -> None:
        from coverage import CoverageData

        self.data = CoverageData(str(TRACE))
        self.data.read()
        self.functions: dict[str, tuple[Path, ast.FunctionDef]] = {}
        self.kernels: set[str] = set()
        self.callers: dict[str, set[str]] = defaultdict(set)  # of kernels and of constants
        for path in PACKAGE.rglob("*.py"):
            self._enter(path)

    def _enter(self, path: Path) -> None:
        """Enter the functions of a file, and what each of them refers to, by dotted names."""
        module = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
        tree = ast.parse(path.read_bytes())
        known = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                known |= {
                    each.asname or each.name: f"{node.module}.{each.name}" for each in node.names
                }

        for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
            own = f"{module}.{function.name}"
            self.functions[own] = path, function
            marks = {
                getattr(each, "id", "")
                for mark in function.decorator_list
                for each in ast.walk(mark)
            }
            if marks & {"kernel", "entry_point"}:
                self.kernels.add(own)
            for node in ast.walk(function):
                if isinstance(node, ast.Name):
                    self.callers[known.get(node.id, f"{module}.{node.id}")].add(own)
                elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                    home = known.get(node.value.id, module)
                    self.callers[f"{home}.{node.attr}"].add(own)

    def tests(self, edit: Edit) -> list[str]:
        """Return the tests that run the line of an edit, or what calls the kernel it is in."""
        found = self._at(edit.path, {edit.line})
        return sorted(found or self._of_callers(self._around(edit)))

    def _around(self, edit: Edit) -> list[str]:
        """Return the dotted names of what an edit is in: a function, or constants of a module."""
        inside = [
            name
            for name, (path, node) in self.functions.items()
            if path == edit.path and node.lineno <= edit.line <= (node.end_lineno or 0)
        ]
        if inside:
            return inside
        module = ".".join(edit.path.relative_to(PACKAGE.parent).with_suffix("").parts)
        statements = ast.parse(edit.path.read_bytes()).body
        there = [each for each in statements if each.lineno <= edit.line <= (each.end_lineno or 0)]
        names = {node.id for each in there for node in ast.walk(each) if isinstance(node, ast.Name)}
        return [caller for name in names for caller in self.callers[f"{module}.{name}"]]

    def _of_callers(self, names: list[str]) -> set[str]:
        """Return the tests that run these functions, or what calls them where they are kernels."""
        seen, waiting, found = set(names), list(names), set()
        while waiting:
            name = waiting.pop()
            path, node = self.functions[name]
            found |= self._at(path, {each.lineno for each in node.body})
            if name in self.kernels:
                waiting += self.callers[name] - seen
                seen |= self.callers[name]
        return found

    def _at(self, path: Path, lines: set[int]) -> set[str]:
        there = self.data.contexts_by_lineno(str(path))
        return {test for line in lines for test in there.get(line, ()) if test}


def trace() -> None:
    """Run the fast tests, and keep which of them run which lines."""
    with tempfile.TemporaryDirectory() as folder:
        settings = Path(folder, "settings")
        plugin = Path(folder, "contexts_by_test.py")
        settings.write_text(f"[run]\nsource = {PACKAGE}\ndata_file = {TRACE}\n")
        plugin.write_text(CONTEXTS)
        environment = {**os.environ, "PYTHONPATH": f"{folder}:{ROOT / 'src'}"}
        command = [sys.executable, "-m", "coverage", "run", f"--rcfile={settings}", "-m", "pytest"]
        command += ["-p", "contexts_by_test", "-n", "0", "-q", *TESTS]
        subprocess.run(command, cwd=ROOT, env=environment, check=False)


CONTEXTS = """
import coverage, pytest

@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item):
    coverage.Coverage.current().switch_context(item.nodeid)
    try:
        return (yield)
    finally:
        coverage.Coverage.current().switch_context("")
"""


def outcome(copy: Path, edit: Edit, tests: list[str]) -> str:
    """Return whether a build or a test fails: yes, no, or that time was up."""
    environment = {**os.environ, "PYTHONPATH": str(copy / "src"), "PYTHONDONTWRITEBYTECODE": "1"}
    pytest = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider"]
    commands = [[*pytest, "-m", "slow or not slow", *tests]]
    if edit.path.relative_to(PACKAGE).as_posix() in of_kernels():
        commands.insert(0, [sys.executable, "-m", BUILDING])

    how: dict[str, Any] = {"cwd": copy, "env": environment, "capture_output": True}
    try:
        failed = any(subprocess.run(each, timeout=SECONDS, **how).returncode for each in commands)
    except subprocess.TimeoutExpired:
        return "time is up"
    return "yes" if failed else "no"


@cache
def of_kernels() -> set[str]:
    """Return the files that the library is made from."""
    contents = json.loads((PACKAGE / "lib" / "kernels.json").read_text())
    return set(contents["files"])


def measure() -> None:
    """Make edits that are not in the table yet, each in a copy, and enter what comes of them."""
    rows = list(csv.DictReader(TABLE.open())) if TABLE.exists() else []
    done = {(row["place"], row["edit"]) for row in rows}
    known = Trace()
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "carom")
        ignored = shutil.ignore_patterns(".git", "__pycache__", "node_modules")
        shutil.copytree(ROOT, copy, ignore=ignored, symlinks=True)
        for room, edit in chosen():
            place = f"{edit.path.relative_to(PACKAGE)}:{edit.line}"
            words = f"{edit.old.strip()[:60]} -> {edit.new.strip()}"
            if (place, words) in done:
                continue

            tests = known.tests(edit)
            tests = random.Random(place).sample(tests, min(len(tests), MOST))
            begun = time.monotonic()
            target = copy / edit.path.relative_to(ROOT)
            original = target.read_bytes()
            target.write_bytes(edit.applied())
            seen = outcome(copy, edit, tests) if tests else "no"
            target.write_bytes(original)

            seconds = round(time.monotonic() - begun)
            rows.append(
                dict(zip(COLUMNS, (room, place, words, len(tests), seen, seconds), strict=True))
            )
            print(*rows[-1].values(), flush=True)
            with TABLE.open("w", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
                writer.writeheader()
                writer.writerows(rows)

    for room in ROOMS:
        seen = [row["noticed"] == "yes" for row in rows if row["room"] == room]
        print(f"{room}: {sum(seen)} of {len(seen)}")


def main() -> None:
    """Trace, or measure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="?", choices=("trace", "measure"), default="measure")
    {"trace": trace, "measure": measure}[parser.parse_args().what]()


if __name__ == "__main__":
    main()
