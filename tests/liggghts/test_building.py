"""`carom liggghts build` and the model's source, without LIGGGHTS."""

import shutil
import stat
import subprocess
import sys
import tarfile
from pathlib import Path

import numpy as np
import pytest
from tests.checks import BALL, PAIR as WALL, refused

import carom
from carom.adapters import building, liggghts
from carom.cli import main
from carom.verify.engines.liggghts import INPUT

CPP = Path(__file__).parents[1] / "cpp"
HEADERS = (
    *("contact_models", "error", "global_properties"),
    *("neighbor", "tangential_model_base", "update"),
)
SPHERES = carom.Pair(BALL, BALL, friction=0.2)
compiles = pytest.mark.skipif(
    shutil.which("c++") is None or shutil.which("make") is None,
    reason="no C++ compiler, or no make",
)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """Run impacts with the model, compiled with a stand-in for the headers of LIGGGHTS."""
    folder = tmp_path_factory.mktemp("model")
    for name in HEADERS:
        (folder / f"{name}.h").write_text('#include "liggghts.h"\n')
    includes = [f"-I{path}" for path in (building.HEADERS, liggghts.MODEL, folder, CPP)]
    flags = ["-std=c++17", "-O2", "-Wall", "-Wextra", "-pedantic", "-Werror", *building.MATH_FLAGS]
    source = str(CPP / "in_liggghts.cpp")
    subprocess.run(["c++", *flags, *includes, source, "-o", folder / "run"], check=True)

    def run(*words):
        command = [folder / "run", *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    return run


@pytest.mark.first_case
@compiles
@pytest.mark.parametrize("springs", liggghts.SPRINGS)
@pytest.mark.parametrize("turns", [0, 1, 3])
def test_model_is_the_law_of_carom(model, springs, turns):
    """Also where the contact becomes the other sphere's: without mirroring it would be off by 1."""
    psi = np.linspace(0.25, 5.0, 8)
    values = np.array(model(springs, 100, turns, 0.0, *psi).split(), dtype=float)
    expected = carom.dem.ExactContactLaw(springs).rebound(psi, 3.5 * 0.8 / 2.0, steps=100)
    np.testing.assert_allclose(values, expected, atol=1e-5)


@compiles
def test_friction_opposes_the_slide_at_any_rate_of_approach(model):
    """Pressed to d = 0.3: spheres that stick have F = 2 G* a U, others reach Coulomb's limit."""
    rates = [0.0, *(sign * 10.0**power for power in range(-30, 1) for sign in (1.0, -1.0))]
    radius, moved = np.sqrt(0.3), 1e-9 * 1e-3
    values = np.array(model(32, "held", 1e-9, *rates).split(), dtype=float)
    sticking = 1.5 * radius * moved * 0.8 / 0.3 / 0.3**1.5  # of Coulomb's limit, kappa/mu = 0.8/0.3
    np.testing.assert_allclose(values, sticking, rtol=0.025)
    values = np.array(model(32, "held", 1e9, *rates).split(), dtype=float)
    np.testing.assert_allclose(values, 1.0, rtol=1e-6)


@compiles
def test_model_refuses_other_springs_and_cohesion(model):
    assert "springs must be 16, 32 or 64" in model(20, 100, 0, 0.0, 1.0)
    assert "the normal force must be that of elastic spheres" in model(32, 100, 0, 1e-3, 1.0)


@compiles
def test_model_says_once_where_steps_are_too_long_for_the_load(model):
    """k dt^2/m* = 0.1, with k = 2 E* a: (15/8) sqrt(d) in the units of Hertz's impact."""
    longest = np.sqrt(0.1 / (1.875 * np.sqrt(0.3)))
    assert model(16, "stiff", 0.99 * longest) == ""
    (line,) = model(16, "stiff", 1.25 * longest).splitlines()
    assert "too stiff for the timestep under its load" in line
    assert float(line.split("give ")[1].split()[0]) == pytest.approx(0.99 / 1.25, rel=1e-3)


@compiles
@pytest.mark.parametrize("share", [0.0, 0.3, -0.5])
def test_the_tangential_part_limits_friction_by_the_depth_alone(model, share):
    """Whatever cohesion or damping do to the normal force; the force stays on the tangent."""
    assert float(model(16, "part", share)) == pytest.approx(1.0, rel=1e-6)


@pytest.fixture
def sources(tmp_path):
    """A LIGGGHTS of one file, which prints what it was told, and what C++17 refuses of it."""
    src = tmp_path / "LIGGGHTS-PUBLIC" / "src"
    (src / "STUBS").mkdir(parents=True)
    (src / "tangential_model_base.h").write_text("")
    (src / "version_liggghts.txt").write_text("3.8.0\n")
    (src / "utils.h").write_text(
        "#include <string>\nstd::string text(int a) {\n"
        "    return static_cast<std::ostringstream &>(std::ostringstream() << a).str();\n}\n"
    )
    (src / "finish.cpp").write_text("bool has(int **x) { return x->numneigh > 0; }\n")
    (src / "dump_mesh_vtk.cpp").write_text("#include <vtk.h>\n")
    (src / "lammps.cpp").write_text(
        '#include "carom/contact.hpp"\n#include "utils.h"\n'
        f'int main() {{ return text(1) != "1"; }}  // {liggghts.MODEL_MARK.decode()}\n'
        f'extern const char *said; const char *said = "{liggghts.MODEL_MARK.decode()}";\n'
    )
    (src / "Makefile").write_text(
        "stubs:\n\t@true\n"
        "serial:\n\t$(CC) $(CCFLAGS) -c lammps.cpp\n\t$(LINK) lammps.o -o lmp_serial\n"
    )
    return src.parent


@pytest.mark.first_case
@compiles
@pytest.mark.parametrize("packed", [False, True], ids=["folder", "tarball"])
def test_build(sources, tmp_path, monkeypatch, capsys, packed):
    """Made from a copy, with the model and its headers; then the bench finds it."""
    values = sources
    if packed:
        values = tmp_path / "liggghts.orig.tar.xz"
        with tarfile.open(values, "w:xz") as archive:
            archive.add(sources, sources.name)
    before = sorted(path.name for path in (sources / "src").iterdir())
    monkeypatch.setattr(building, "home", lambda program: tmp_path / "home")
    assert not carom.verify.Liggghts().supports(carom.dem.ExactContactLaw(32))
    assert main(["liggghts", "build", "--source", str(values)]) == 0
    assert "built LIGGGHTS 3.8.0 with tangential model carom" in capsys.readouterr().out
    assert sorted(path.name for path in (sources / "src").iterdir()) == before
    engine = carom.verify.Liggghts()
    assert engine.executable() == tmp_path / "home" / "liggghts"
    assert engine.executable().stat().st_mode & stat.S_IXUSR
    for springs in liggghts.SPRINGS:
        assert engine.supports(carom.dem.ExactContactLaw(springs))
    assert not engine.supports(carom.dem.ExactContactLaw(48))
    assert not engine.supports(carom.dem.ExactContactLaw(32, restitution=0.9))


def test_sources_with_the_model(sources):
    """What is added, and what C++17 or a machine without VTK refuses."""
    src = sources / "src"
    (src / "carom").mkdir()  # as a LIGGGHTS that has the model has it
    liggghts.add_model(src)
    assert (src / "tangential_model_carom.h").read_text().startswith("// Tangential model carom")
    assert (src / "carom" / "contact_in_space.hpp").exists()
    assert "HERTZ, TANGENTIAL_CAROM" in (src / "style_contact_model.whitelist").read_text()
    assert "return std::to_string(a);" in (src / "utils.h").read_text()
    assert "numneigh != 0" in (src / "finish.cpp").read_text()
    assert not (src / "dump_mesh_vtk.cpp").exists()


@compiles
def test_refusals(sources, tmp_path, monkeypatch, capsys):
    with tarfile.open(tmp_path / "whole.tar.xz", "w:xz") as archive:
        archive.add(CPP)
    whole = (tmp_path / "whole.tar.xz").read_bytes()
    cut, spoilt = tmp_path / "cut.tar.xz", tmp_path / "spoilt.tar.xz"
    cut.write_bytes(whole[: len(whole) // 2])
    spoilt.write_bytes(whole[: len(whole) // 2] + bytes(len(whole)))
    for bad in (tmp_path / "none", tmp_path, CPP / "impacts.cpp", cut, spoilt):
        assert main(["liggghts", "build", "--source", str(bad)]) == 2
        line = capsys.readouterr().err
        assert line.count("\n") == 1
        assert "must be the folder or the tarball of LIGGGHTS-PUBLIC 3.8.0" in line
    (sources / "src" / "lammps.cpp").write_text("int main() { return nothing; }\n")
    refused(r"the compiler failed: .*nothing", liggghts.build, sources, tmp_path / "out")
    assert not (tmp_path / "out").exists()
    for folder in (cut, cut / "new"):
        refused(
            r"cannot be written: .*; give another with --folder",
            liggghts.build,
            tmp_path / "none",
            folder,
        )
    monkeypatch.setattr(liggghts.shutil, "which", lambda name: "c++" if name != "make" else None)
    refused("there is no make", liggghts.build, sources, tmp_path / "out")
    monkeypatch.setattr(building, "COMPILERS", ())
    refused("no C\\+\\+ compiler", liggghts.build, sources, tmp_path / "out")


def test_the_first_error_of_a_compiler_is_told():
    """Not the names of files that are compiled: LIGGGHTS has an error.cpp."""
    said = 50 * "g++ -c ../error.cpp\n" + "a.cpp:1:2: error: no such thing\n"
    command = [sys.executable, "-c", f"print({said!r}); raise SystemExit(1)"]
    refused(
        r"the compiler failed: a\.cpp:1:2: error: no such thing",
        building.carry_out,
        "build",
        command,
    )


def test_nothing_half_written_is_left(tmp_path):
    (tmp_path / "made").write_text("new")
    (tmp_path / "there" / "program").mkdir(parents=True)
    refused("cannot be written", building.place, tmp_path / "made", tmp_path / "there" / "program")
    assert [path.name for path in (tmp_path / "there").iterdir()] == ["program"]


@pytest.mark.parametrize("pair", [WALL, SPHERES], ids=["wall", "spheres"])
def test_inputs_with_the_law(pair):
    motion = {"normal_speed": 1e-4, "tangential_speed": (1e-4,), "steps": 100}
    law = carom.dem.ExactContactLaw(64)
    experiment = carom.verify.Experiment(pair=pair, law=law, **motion)
    text = carom.verify.Liggghts().files(experiment)[INPUT]
    assert text.count("hertz tangential carom") == (2 if pair is WALL else 1)
    assert "pair_style      gran model hertz tangential carom springs 64\n" in text
    assert "fix coefficientRestitution all property/global coefficientRestitution" in text
    assert " one 100 " in text


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ([], "LIGGGHTS: not found; install Debian's package liggghts, or carom liggghts build"),
        (["--program", sys.executable], "until carom liggghts build has built it"),
    ],
    ids=["no program", "no model"],
)
def test_a_line_says_what_to_do(tmp_path, monkeypatch, capsys, program, said):
    monkeypatch.setattr(building, "home", lambda program: tmp_path)
    monkeypatch.setenv("PATH", "")
    assert main(["verify", "liggghts", "--law", "carom", *program]) == 2
    assert said in capsys.readouterr().err
