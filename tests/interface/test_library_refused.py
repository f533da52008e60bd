"""A compiled library that cannot be used is never used: the reason is told, numba does the work."""

import json
import os
import platform
import shutil
import subprocess
import sys
from base64 import b64decode
from importlib.util import module_from_spec, spec_from_file_location
from itertools import takewhile
from pathlib import Path

import pytest

import carom
from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.shared_library import BROWSER, BROWSER_CONTENTS, CONTENTS
from carom.folder import PACKAGE
from carom.native import browser, building
from carom.page import page

needs_library = pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
NONE = "there is no compiled library; install carom again, with a C compiler"
DAMAGED = "the compiled library is damaged; install carom again"
FIRST = "import carom, sys; print(carom.rebound(0.5, 1.44), 'numba' in sys.modules)"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A copy of the library that is there, in use from now on."""
    copy = tmp_path / "lib"
    shutil.copytree(shared_library.FOLDER, copy)
    monkeypatch.setattr(shared_library, "FOLDER", copy)
    shared_library.opened.cache_clear()
    yield copy
    shared_library.opened.cache_clear()


def changed(folder, **values):
    """Write other values for every library into the table of contents."""
    contents = json.loads((folder / CONTENTS).read_text())
    for each in contents["libraries"]:
        each.update(values)
    (folder / CONTENTS).write_text(json.dumps(contents))


@needs_library
def test_a_copy_is_as_good(folder):
    assert shared_library.reason() == ""
    assert carom.get_library().startswith(str(folder))


@needs_library
def test_for_another_processor(folder):
    changed(folder, level=9)
    assert shared_library.reason() == "there is no compiled library for this processor"


@needs_library
def test_the_best_for_this_processor_is_used(folder):
    """Of libraries for several levels, in whatever order: the highest that is not too high."""
    contents = json.loads((folder / CONTENTS).read_text())
    (path,) = folder.glob("libcarom*")
    one = contents["libraries"][0]
    names = {level: f"{level}-{path.name}" for level in (0, one["level"], 9)}
    for name in names.values():
        shutil.copy(path, folder / name)
    contents["libraries"] = [one | {"file": name, "level": level} for level, name in names.items()]
    (folder / CONTENTS).write_text(json.dumps(contents))
    assert carom.get_library() == str(folder / names[one["level"]])


@needs_library
@pytest.mark.parametrize(
    ("levels", "used"), [("1", 1), ("1 2", 1), ("0", 0), ("", "own"), ("4 1", "own")]
)
def test_the_environment_limits_the_level(folder, levels, used, monkeypatch):
    """So that the same machine code is run on machines of several kinds."""
    contents = json.loads((folder / CONTENTS).read_text())
    own = contents["libraries"][0]["level"]
    libraries = [contents["libraries"][0] | {"level": level} for level in (0, 1, own)]
    for each in libraries:
        each["file"] = f"{each['level']}.so"
        shutil.copy(next(folder.glob("libcarom*")), folder / each["file"])
    (folder / CONTENTS).write_text(json.dumps(contents | {"libraries": libraries}))
    monkeypatch.setenv(shared_library.LEVELS, levels)
    level = own if used == "own" else used
    assert carom.get_library() == str(folder / f"{level}.so")


LEVELS = {  # of x86-64, and what Linux calls what they need
    2: "cx16 lahf_lm popcnt pni sse4_1 sse4_2 ssse3",
    3: "abm avx avx2 bmi1 bmi2 f16c fma movbe xsave",
    4: "avx512f avx512bw avx512cd avx512dq avx512vl",
}


@needs_library
def test_the_level_is_that_of_the_processor():
    if platform.machine() != "x86_64" or not Path("/proc/cpuinfo").is_file():
        pytest.skip("this is not Linux on x86-64")
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    flags = set(next(line for line in lines if line.startswith("flags")).split())
    level = 1 + sum(
        1 for _ in takewhile(lambda words: set(words.split()) <= flags, LEVELS.values())
    )
    assert shared_library.opened().handle.carom_processor_level() == level


@pytest.mark.parametrize("levels", ["5", "x86-64-v3", "1,3", "-1", "1.0"])
def test_a_level_that_is_none_is_refused(folder, levels, monkeypatch):
    monkeypatch.setenv(shared_library.LEVELS, levels)
    with pytest.raises(
        carom.InputError, match=f"^CAROM_LEVELS: {levels!r} cannot be used; must be"
    ):
        carom.get_library()


CUT = [lambda content, size=size: content[:size] for size in (0, 100, 60_000, -1)]


def turned(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


@needs_library
@pytest.mark.parametrize("change", [*CUT, turned])
def test_cut_off_or_a_bit_turned(folder, change):
    for path in folder.glob("libcarom*"):
        path.write_bytes(change(path.read_bytes()))
    assert shared_library.reason() == DAMAGED


@needs_library
def test_gone(folder):
    for path in folder.glob("libcarom*"):
        path.unlink()
    assert shared_library.reason() == NONE


@needs_library
@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"files": 5}', "\0"])
def test_its_contents_damaged(folder, text):
    (folder / CONTENTS).write_text(text)
    assert shared_library.reason() == DAMAGED


@needs_library
def test_made_from_other_sources(folder):
    contents = json.loads((folder / CONTENTS).read_text())
    (folder / CONTENTS).write_text(json.dumps(contents | {"sources": "0" * 64}))
    assert shared_library.reason().startswith("the compiled library was built from other sources")


def test_none_at_all(tmp_path, monkeypatch):
    monkeypatch.setattr(shared_library, "FOLDER", tmp_path)
    shared_library.opened.cache_clear()
    assert shared_library.reason() == NONE
    with pytest.raises(RuntimeError, match=NONE):
        carom.get_library()
    shared_library.opened.cache_clear()


def first_by(way):
    """The first number of a process whose environment says by what kernels are run."""
    environment = {**os.environ, "CAROM_KERNELS": way}
    command = [sys.executable, "-c", FIRST]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


@pytest.mark.parametrize("way", ["python", pytest.param("numba", marks=pytest.mark.slow)])
def test_the_environment_chooses(way):
    value, loaded = first_by(way).stdout.split()
    assert float(value) == pytest.approx(carom.rebound(0.5, 1.44), abs=1e-14)
    assert loaded == str(way == "numba")


def test_a_word_that_is_no_way_is_refused():
    assert "CAROM_KERNELS: 'gpu' cannot be used; must be one of" in first_by("gpu").stderr


@pytest.mark.parametrize(
    ("compiler", "words"),
    [
        ("/nowhere/cc", "cc has failed"),
        (shutil.which("false"), "false has failed"),
        ("", "there is no C compiler"),
    ],
)
def test_no_library_is_built_without_a_compiler(compiler, words, tmp_path, monkeypatch, capsys):
    """In one line, and nothing is left behind."""
    monkeypatch.setattr(building, "_build_for_browsers", lambda *_: None)  # these need none
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("CC", compiler)
    assert building.main([str(tmp_path / "lib")]) == 1
    told = capsys.readouterr().err
    assert told.startswith("carom: no compiled library: ")
    assert words in told
    assert told.count("\n") == 1
    assert not list(tmp_path.rglob("libcarom*"))


@pytest.fixture
def hook(tmp_path):
    """The hook of the build, of a copy of the sources."""
    path = Path(__file__).parents[2] / "hatch_build.py"
    spec = spec_from_file_location("hatch_build", path)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    leave = shutil.ignore_patterns("__pycache__", "lib")
    shutil.copytree(PACKAGE, tmp_path / "src/carom", ignore=leave)
    return module.CompiledKernels(str(tmp_path), {}, None, None, "", "wheel")


BROKEN = "raise IndexError('tuple index out of range')"


@pytest.mark.parametrize("version", ["standard", "editable"])
@pytest.mark.parametrize(
    ("line", "compiler", "reason"),
    [
        (BROKEN, "cc", "IndexError: tuple index out of range"),
        ("import os; os._exit(3)", "cc", "exit status 3"),
        ("", "/nowhere/cc", "cc has failed: [Errno 2] No such file or directory: '/nowhere/cc'"),
    ],
)
def test_a_failed_build_is_told_at_the_first_call(
    version, line, compiler, reason, hook, tmp_path, monkeypatch, capfd
):
    """Whatever fails: the installation goes on, and the library says why it is not there."""
    if line:  # else kernels for browsers that were built from the same sources serve
        with (tmp_path / "src/carom/native/__init__.py").open("a") as file:
            file.write(f"\n{line}\n")
    monkeypatch.setenv("CC", compiler)
    data = {"force_include": {}}
    hook.initialize(version, data)
    included = {target: Path(source) for source, target in data["force_include"].items()}
    if version == "editable":
        own = tmp_path / "src/carom"
        included = {path.relative_to(own.parent).as_posix(): path for path in own.glob("lib/*")}
    names = [CONTENTS] if line else [BROWSER_CONTENTS, BROWSER, CONTENTS]  # the page needs no C
    assert sorted(included) == [f"carom/lib/{name}" for name in names]
    assert "tag" not in data
    assert reason.startswith("exit") or reason in capfd.readouterr().err  # for pip --verbose
    monkeypatch.setattr(shared_library, "FOLDER", included[f"carom/lib/{CONTENTS}"].parent)
    shared_library.opened.cache_clear()
    assert shared_library.reason() == f"the compiled library could not be built: {reason}"
    shared_library.opened.cache_clear()
    hook.finalize(version, data, "")


@needs_library
@pytest.mark.slow
def test_editable_sources_get_their_library(hook, tmp_path):
    hook.initialize("editable", {})
    program = "import carom; print(carom.__file__, carom.get_library(), carom.rebound(0.5, 1.44))"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "src")}
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    file, library, value = run.stdout.split()
    assert Path(library).parent == Path(file).parent / "lib" == tmp_path / "src/carom/lib"
    assert float(value) == carom.rebound(0.5, 1.44)


def test_libraries_are_kept_in_the_home_unless_told_otherwise(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv(building.CACHE, raising=False)
    assert building.kept_in() == tmp_path / ".cache/carom/build"
    monkeypatch.setenv(building.CACHE, str(tmp_path))
    assert building.kept_in() == tmp_path


def test_without_a_home_nothing_is_kept(monkeypatch):
    monkeypatch.delenv(building.CACHE, raising=False)
    monkeypatch.setattr(Path, "home", lambda: (_ for _ in ()).throw(RuntimeError))
    with pytest.raises(OSError):
        building.kept_in().joinpath("deeper").mkdir(parents=True, exist_ok=True)


LOCKED = 'mount --bind "$0" "$0" && mount -o remount,bind,ro "$0" && exec "$@"'


@pytest.fixture
def read_only(tmp_path):
    """How to run Python where nobody can write into the package; without a home and a network."""
    package = shutil.copytree(PACKAGE, tmp_path / "of another user/carom")
    locked = []
    if os.geteuid() == 0:  # for whom permissions are nothing: a place mounted to be read
        locked = ["unshare", "--mount", "--net", "sh", "-c", LOCKED, str(package)]
        if shutil.which("unshare") is None or subprocess.run([*locked, "true"]).returncode:
            pytest.skip("root can write everywhere, and can mount nothing here")
    for path in (*package.rglob("*"), package):
        path.chmod(0o555 if path.is_dir() else 0o444)
    environment = {**os.environ, "PYTHONPATH": str(package.parent), "HOME": "/nowhere"}
    environment.pop("NUMBA_CACHE_DIR", None)
    before = sorted(package.rglob("*"))

    def python(program, **more):
        command = [*locked, sys.executable, "-c", program]
        entries = {"env": environment | more, "capture_output": True, "text": True}
        return subprocess.run(command, **entries)

    yield python
    assert sorted(package.rglob("*")) == before
    for path in (package, *package.rglob("*")):
        path.chmod(0o755)


WRITES = "import carom; open(carom.__file__, 'a')"
IMPACT = "import carom; print(carom.__file__, carom.rebound(0.5, 1.44))"
HERTZ = (
    "from carom.dimensionless.numerics import hertz as h; print(*h.penetration_and_speed(h.HALF))"
)


@pytest.mark.skipif(sys.platform == "win32", reason="permissions are others there")
@pytest.mark.parametrize("way", ["library", pytest.param("numba", marks=pytest.mark.slow)])
def test_a_read_only_installation(read_only, way):
    """Numbers as ever and no word, by the library and by numba, which then keeps nothing."""
    assert "Error: [Errno" in read_only(WRITES).stderr
    work = IMPACT if way == "library" else HERTZ
    run = read_only(work, CAROM_KERNELS=way)
    assert (run.returncode, run.stderr) == (0, "")
    if way == "library":
        file, value = run.stdout.rsplit(maxsplit=1)
        assert Path(file) != Path(carom.__file__)
        assert float(value) == carom.rebound(0.5, 1.44)
    else:
        assert [float(text) for text in run.stdout.split()] == [1.0, 0.0]


@pytest.fixture
def for_browsers(folder, monkeypatch):
    """A copy of the kernels for the page, in use from now on."""
    monkeypatch.setattr(page, "FOLDER", folder)
    page.kernels.cache_clear()
    yield folder
    page.kernels.cache_clear()


def refused_by_the_page():
    refused = r"^the explorer needs the kernels for browsers; install carom again$"
    with pytest.raises(carom.InputError, match=refused):
        page.kernels()


@pytest.mark.slow
@needs_library
def test_kernels_for_browsers_are_those_of_these_sources(for_browsers):
    contents = json.loads((for_browsers / BROWSER_CONTENTS).read_text())
    program = "from carom.native import browser; print(*browser.source_files(), sep='\\n')"
    command = [sys.executable, "-c", program]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    loaded = [Path(line).relative_to(PACKAGE) for line in ran.stdout.splitlines()]
    needed = {path.as_posix() for path in loaded if path.parts[0] != "native"}
    assert set(contents["files"]) == needed
    described = json.loads(json.dumps(browser.described()))
    assert {name: contents[name] for name in described} == described
    told = json.loads(page.kernels().decode().removeprefix("Carom.wasm = ").rstrip(";\n"))
    assert b64decode(told.pop("code")) == (for_browsers / BROWSER).read_bytes()
    assert told == described


@needs_library
@pytest.mark.parametrize("change", [*CUT, turned])
def test_damaged_kernels_for_browsers_are_refused(for_browsers, change):
    module = for_browsers / BROWSER
    module.write_bytes(change(module.read_bytes()))
    refused_by_the_page()


@needs_library
@pytest.mark.parametrize("name", [BROWSER, BROWSER_CONTENTS])
def test_missing_kernels_for_browsers_are_refused(for_browsers, name):
    (for_browsers / name).unlink()
    refused_by_the_page()


@needs_library
@pytest.mark.parametrize("text", ["", "{", "[]", "{}", "null", '{"files": 5}', "\0"])
def test_damaged_contents_of_kernels_for_browsers_are_refused(for_browsers, text):
    (for_browsers / BROWSER_CONTENTS).write_text(text)
    refused_by_the_page()


@needs_library
def test_kernels_for_browsers_of_other_sources_are_refused(for_browsers, tmp_path, monkeypatch):
    """One line of any file that they are made from is enough."""
    contents = json.loads((for_browsers / BROWSER_CONTENTS).read_text())
    for name in contents["files"]:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(PACKAGE / name, tmp_path / name)
    monkeypatch.setattr(page, "PACKAGE", tmp_path)
    assert page.kernels()
    page.kernels.cache_clear()
    with (tmp_path / "dimensionless/rebounds.py").open("a") as file:
        file.write("# another line\n")
    refused_by_the_page()
