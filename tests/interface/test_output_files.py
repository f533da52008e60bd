"""Where results go: into the file that a link points to, into pipes and devices, never elsewhere.

What is expected is what a shell does with `> name`, but for one thing: a file that is there is
replaced whole or not at all.
"""

import os
import stat
import subprocess
import sys
import threading
from functools import cache, partial
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from tests.checks import PAIR, refused

import carom
from carom.cli import main
from carom.io.paths import replace_whole

CURVE = carom.curve(1.44, [0.5, 2.0, 6.0])
COMMAND = ["curve", "--chi", "1.44", "--points", "3"]
CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 1.0, "friction": 0.1}


@cache
def figure():
    return carom.plots.plot_curve(CURVE)


@cache
def filmed():
    hit = carom.impact(PAIR, speed=2.0, angle=0.5)
    return hit.history(20), [hit.fields(1.5e-5)]


def film(path):
    return carom.plots.animate(*filmed(), path)


WRITERS = {
    ".nc": lambda path: carom.save(CURVE, path),
    ".csv": lambda path: carom.save(CURVE, path),
    ".png": lambda path: carom.plots.save_figure(figure(), path),
    ".pdf": lambda path: carom.plots.save_figure(figure(), path),
    ".svg": lambda path: carom.plots.save_figure(figure(), path),
    ".gif": film,
    ".h": lambda path: main(["curve", "--chi", "1.44", "--export", "c", "--output", str(path)]),
}
FIRST = (b"\x89HDF", b"chi,psi_in", b"\x89PNG", b"%PDF", b"<?xml", b"GIF8", b"/*")
STARTS = dict(zip(WRITERS, FIRST, strict=True))


def left(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("ending", "there"), [*product(WRITERS, [True]), *product((".nc", ".csv", ".h"), [False])]
)
def test_a_link_stays_and_its_file_is_written(ending, there, tmp_path):
    """Through two links, into another folder; also where the file is yet to be made."""
    (tmp_path / "data").mkdir()
    target, middle, link = (tmp_path / n for n in ("data/kept", "middle", f"x{ending}"))
    if there:
        target.write_text("old")
        target.chmod(0o600)
    middle.symlink_to("data/kept")
    link.symlink_to(middle)
    WRITERS[ending](link)
    assert target.read_bytes().startswith(STARTS[ending])
    assert link.is_symlink()
    assert middle.is_symlink()
    assert not target.is_symlink()
    assert left(tmp_path) == sorted(["data", "middle", link.name])
    assert left(tmp_path / "data") == ["kept"]
    if there:
        assert stat.S_IMODE(target.stat().st_mode) == 0o600
    if ending == ".nc":
        assert carom.read(link).identical(CURVE)


def test_what_a_link_points_to_survives_a_failed_write(tmp_path):
    (tmp_path / "kept").write_text("precious")
    (tmp_path / "x.csv").symlink_to("kept")

    def fail(where):
        where.write_text("half")
        raise OSError("disk full")

    refused("cannot be written; disk full", replace_whole, tmp_path / "x.csv", fail)
    assert (tmp_path / "kept").read_text() == "precious"
    assert left(tmp_path) == ["kept", "x.csv"]


@pytest.mark.first_case
@pytest.mark.parametrize("ending", WRITERS)
def test_a_pipe_is_written_into(ending, tmp_path):
    """The reader of a FIFO gets the file; the FIFO is still one."""
    pipe, got = tmp_path / f"x{ending}", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()), daemon=True)
    reader.start()
    WRITERS[ending](pipe)
    reader.join(20.0)
    assert got[0].startswith(STARTS[ending])
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert left(tmp_path) == [pipe.name]
    if ending == ".nc":
        (tmp_path / "again.nc").write_bytes(got[0])
        assert carom.read(tmp_path / "again.nc").identical(CURVE)


@pytest.mark.first_case
@pytest.mark.parametrize("ending", ["", *WRITERS])
def test_a_device_stays_one(ending, tmp_path):
    """By its own name, which has no ending, and by a link's."""
    name = "/dev/null"
    if ending:
        (tmp_path / f"x{ending}").symlink_to(name)
        name = tmp_path / f"x{ending}"
    before = os.stat("/dev/null")
    for write in [WRITERS[ending]] if ending else WRITERS.values():
        write(name)
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    assert os.stat("/dev/null").st_ino == before.st_ino
    assert not ending or name.is_symlink()


def test_a_full_device_is_told_in_one_line(refusal):
    """What does not fit is said."""
    line = refusal(*COMMAND, "--output", "/dev/full", code=1)
    assert "'/dev/full' cannot be written; No space left on device\n" in line


def into_a_file(folder, mode):
    with open(folder / "all.txt", mode) as file:
        yield file.fileno()
    yield (folder / "all.txt").read_text()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "mode"),
    [("/dev/stdout", None), ("/dev/stdout", "w"), ("/dev/fd/1", "a"), ("link.csv", "w")],
)
def test_what_goes_to_stdout_is_there_once_and_whole(name, mode, tmp_path, command):
    """Into a pipe and into a file, which the shell has opened: the CSV, then the printed table."""
    (tmp_path / "link.csv").symlink_to("/dev/stdout")
    (tmp_path / "all.txt").write_text("before\n")
    file = into_a_file(tmp_path, mode) if mode else None
    stdout = next(file) if file else None
    code, out, err = command(tmp_path, *COMMAND, "--output", name, stdout=stdout)
    assert (code, err) == (0, f"Carom has stored {name}.\n")
    text = next(file) if file else out
    assert text.startswith("before\n") == (mode == "a")
    text = text.removeprefix("before\n")
    wanted = carom.save(carom.curve(1.44, np.linspace(0.0, 6.76, 3)), tmp_path / "wanted.csv")
    assert text.startswith(wanted.read_text(encoding="utf-8"))
    assert text.removeprefix(wanted.read_text(encoding="utf-8")).startswith("chi = 1.44\n")


@pytest.mark.slow
def test_a_substituted_process_is_written_into(tmp_path):
    """`--plot >(cat > x.png)`: bash names a pipe /dev/fd/63. No screen is needed for a figure,
    whatever backend of matplotlib is set, be there one or not."""
    python = f"{sys.executable} -c 'from carom.cli import run; run()'"
    line = f"MPLBACKEND=bogus {python} {' '.join(COMMAND)} --plot >(cat > x.png); wait $!"
    subprocess.run(["bash", "-c", line], cwd=tmp_path, timeout=120, check=True)
    assert (tmp_path / "x.png").read_bytes().startswith(b"\x89PNG")


def test_links_that_lead_nowhere_are_refused_and_stay(tmp_path):
    """In a circle, into a folder that is not there, to a folder."""
    (tmp_path / "a.csv").symlink_to("b.csv")
    (tmp_path / "b.csv").symlink_to("a.csv")
    (tmp_path / "none.csv").symlink_to("no/such/x.csv")
    (tmp_path / "folder.csv").symlink_to(".")
    for name, words in {
        "a.csv": "Too many levels of symbolic links",
        "none.csv": "its folder must exist",
        "folder.csv": "it is a folder",
    }.items():
        refused(words, carom.save, CURVE, tmp_path / name)
        assert (tmp_path / name).is_symlink()
    assert left(tmp_path) == ["a.csv", "b.csv", "folder.csv", "none.csv"]


@pytest.mark.parametrize("there", [True, False], ids=["empty", "dangling"])
def test_a_pack_and_a_store_are_made_where_a_link_points(there, tmp_path):
    for name in ("bench", "there.zarr"):
        (tmp_path / name).symlink_to(f"real-{name}")
    if there:
        (tmp_path / "real-bench").mkdir()
    assert "wall/reference.csv" in carom.verify.write_pack(tmp_path / "bench")
    grid = carom.Grid({"angle": [0.1, 0.2]})
    first = carom.sweep(CASE, grid, store=tmp_path / "there.zarr").load()
    assert carom.read(tmp_path / "real-there.zarr").load().identical(first)
    again = carom.sweep(CASE, grid, store=tmp_path / "there.zarr", resume=True)
    assert again.load().identical(first)
    assert (tmp_path / "real-bench/wall/reference.csv").is_file()
    assert left(tmp_path) == ["bench", "real-bench", "real-there.zarr", "there.zarr"]
    assert all((tmp_path / name).is_symlink() for name in ("bench", "there.zarr"))


BODIES = "friction = 0.2\nspeed = 1\n[first]\nradius = 1\nmaterial = 'steel'\n"
NONE = {"empty": "", "blank": " \t ", "NUL": "a\0b", "long": "x" * 300, "half": "\ud800"}
IN_PYTHON = {
    "save": (lambda name: carom.save(CURVE, name), ".csv"),
    "read": (carom.read, ".nc"),
    "figure": (lambda name: carom.plots.save_figure(figure(), name), ".svg"),
    "animation": (carom.plots.checked_animation, ".gif"),
    "pack": (carom.verify.write_pack, ""),
    "store": (lambda name: carom.sweep(CASE, carom.Grid({"angle": [0.1]}), store=name), ".zarr"),
    "fit": (carom.fit, ".csv"),
    "score": (lambda name: carom.verify.score(name), ".csv"),
    "table": (lambda name: carom.sweep(CASE, carom.Table(name)), ".csv"),
}
FIT = ["fit", "--dataset", "kharaz2001"]
FILES = {
    "impact": (["impact", "NAME"], ".toml"),
    "output": ([*COMMAND, "--output", "NAME"], ".csv"),
    "plot": ([*COMMAND, "--plot", "NAME"], ".png"),
    "header": (["curve", "--chi", "1", "--export", "c", "--output", "NAME"], ".h"),
    "sweep": (["sweep", "NAME"], ".toml"),
    "store": (["sweep", "sweep.toml", "--store", "NAME"], ".zarr"),
    "sweep's output": (["sweep", "sweep.toml", "--output", "NAME"], ".nc"),
    "fit": (["fit", "NAME"], ".csv"),
    "posterior": ([*FIT, "--steps", "100", "--posterior", "NAME"], ".csv"),
    "case": ([*FIT, "--case", "NAME"], ".toml"),
    "score": (["verify", "score", "NAME"], ".csv"),
    "tune": (["verify", "tune", "NAME"], ".toml"),
    "laws": (["verify", "laws", "--law", "mindlin", "--map", "NAME"], ".png"),
    "pack": (["verify", "pack", "NAME"], ""),
}


@pytest.mark.parametrize("kind", NONE)
@pytest.mark.parametrize("what", IN_PYTHON)
def test_what_can_be_no_name_is_refused(what, kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, ending = IN_PYTHON[what]
    name = NONE[kind] if kind in ("empty", "blank") else NONE[kind] + ending
    refused("", call, name)
    assert left(tmp_path) == []


@pytest.mark.first_case
@pytest.mark.parametrize("kind", NONE)
@pytest.mark.parametrize("what", FILES)
def test_what_can_be_no_name_is_refused_by_commands(what, kind, tmp_path, refusal):
    Path("sweep.toml").write_text(f"{BODIES}[sweep.axes]\nangle = [0.1, 0.2]\n")
    words, ending = FILES[what]
    name = NONE[kind] if kind in ("empty", "blank") else NONE[kind] + ending
    refusal(*(name if word == "NAME" else word for word in words))
    assert left(tmp_path) == ["sweep.toml"]


def test_names_in_the_table_of_a_case_file_are_refused_too(tmp_path, refusal):
    for key in ("plot", "animation", "data"):
        for name in ("", " ", "a\\u0000b.csv"):
            Path("case.toml").write_text(f'{BODIES}[output]\n{key} = "{name}"\n')
            refusal("impact", "case.toml")
    assert left(tmp_path) == ["case.toml"]


def test_the_longest_name_that_a_file_can_have_is_one(tmp_path):
    """255 letters: what is written beside it has a shorter name."""
    path = tmp_path / ("x" * 252 + ".nc")
    assert carom.read(carom.save(CURVE, path)).identical(CURVE)


@pytest.fixture
def lonely(tmp_path, monkeypatch):
    """A pipe of which nobody opens the other end, and commands that soon give up."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("carom.io.paths.PIPE_SECONDS", 0.02)

    def pipe(ending):
        name = f"pipe{ending}"
        os.mkfifo(name)
        Path("sweep.toml").write_text(f"{BODIES}[sweep]\ntable = '{name}'\n")
        Path("axes.toml").write_text(f"{BODIES}[sweep.axes]\nangle = [0.1, 0.2]\n")
        return name

    return pipe


READ = [name for name in FILES if name not in ("pack", "store", "laws")]


@pytest.mark.first_case
@pytest.mark.parametrize("what", [*READ, "table of a sweep"])
def test_a_pipe_without_another_end_is_refused(what, lonely, capsys):
    """Nobody writes into it, or reads: no command waits for ever."""
    words, ending = FILES.get(what, (["sweep", "sweep.toml"], ".csv"))
    if what == "sweep's output":
        words = ["sweep", "axes.toml", "--output", "NAME"]
    name, threads = lonely(ending), threading.active_count()
    assert main([name if word == "NAME" else word for word in words]) == 2
    err = [line for line in capsys.readouterr().err.splitlines() if "The chain" not in line]
    assert len(err) == 1
    assert err[0].endswith("; nobody opens the other end of this pipe")
    assert stat.S_ISFIFO(os.stat(name).st_mode)
    assert threading.active_count() == threads


@pytest.mark.first_case
@pytest.mark.parametrize("what", ["impact", "sweep", "fit", "score", "table of a sweep", "tune"])
def test_a_pipe_is_read_like_a_file(what, tmp_path, monkeypatch, capsys):
    """Once: what a pipe gives is not there a second time."""
    monkeypatch.chdir(tmp_path)
    one_law = partial(carom.verify.tune, [carom.dem.LinearSpring()])  # all would take long
    monkeypatch.setattr(carom.verify, "tune", one_law)
    table = "psi_1,psi_2,chi\n0.5,0.1,1.44\n1.0,0.0,1.44\n2.0,-0.9,1.44\n"
    content, words = {
        "impact": (f"angle = 0.2\n{BODIES}", ["impact", "NAME"]),
        "sweep": (f"{BODIES}[sweep.axes]\nangle = [0.1, 0.2]\n", ["sweep", "NAME"]),
        "fit": (carom.datasets.path("kharaz2001").read_text(), ["fit", "NAME"]),
        "score": (table, ["verify", "score", "NAME"]),
        "tune": (f"angle = 0.2\n{BODIES}", ["verify", "tune", "NAME"]),
        "table of a sweep": ("angle,spin\n0.1,0\n0.2,1\n", ["sweep", "case.toml"]),
    }[what]
    Path("case.toml").write_text(f"{BODIES}[sweep]\ntable = 'pipe'\n")
    results = []
    for make in (Path.touch, os.mkfifo):
        pipe = Path("pipe")
        pipe.unlink(missing_ok=True)
        make(pipe)
        writer = threading.Thread(target=pipe.write_text, args=(content,), daemon=True)
        writer.start()
        if make is Path.touch:
            writer.join()
        code = main(["pipe" if word == "NAME" else word for word in words])
        results.append((code, *capsys.readouterr()))
    assert results[0] == results[1]
    assert results[0][0] == 0 or what == "score"
