"""`carom sweep`, as a user would type it."""

import errno
import json
import os
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import carom

CASE = """\
speed = "2 m/s"
angle = "30 deg"
friction = 0.2

[first]
radius = "5 mm"
material = "steel"

[sweep]
outputs = ["rebound_angle", "spin_out"]

[sweep.axes]
angle = {from = "0 deg", to = "80 deg", points = 9}
friction = [0.1, 0.3]
"""
RADII = '"first.radius" = [0.001]\nfirst.radius = [0.002]'
CLOSED = "tcp://127.0.0.1:1"  # nobody listens there


@pytest.fixture(autouse=True)
def case(run):
    Path("case.toml").write_text(CASE)


def changed(old: str, new: str) -> None:
    assert old in CASE
    Path("case.toml").write_text(CASE.replace(old, new))


def test_every_point_is_the_impact_of_the_library(run, pair):
    code, out, err = run("sweep", "case.toml", "--output", "sweep.nc")
    assert (code, err) == (0, "Carom has stored sweep.nc.\n")
    result = carom.read("sweep.nc")
    assert result.sizes == {"angle": 9, "friction": 2}
    for friction in (0.1, 0.3):
        bodies = carom.Pair(pair.first, pair.second, friction=friction)
        for angle in (20.0, 80.0):
            hit = carom.impact(bodies, speed=2.0, angle=f"{angle} deg")
            point = result.sel(friction=friction).sel(angle=np.radians(angle), method="nearest")
            for name in ("rebound_angle", "spin_out"):
                assert float(point[name]) == pytest.approx(getattr(hit, name), rel=1e-9)
    assert "18 points along angle (9), friction (2)" in out


def test_without_a_place_it_says_how_to_keep_the_results(run):
    code, out, err = run("sweep", "case.toml")
    assert code == 0
    assert "18 points" in out
    assert err == (
        "Carom has not stored the results; add --output sweep.nc or --store sweep.zarr to keep "
        "them.\n"
    )
    assert not [path for path in Path().iterdir() if path.name != "case.toml"]


def test_json_counts_the_points_and_gives_their_ranges(run):
    code, out, _ = run("sweep", "case.toml", "--json", "--store", "sweep.zarr")
    record = json.loads(out)
    stored = xr.open_zarr("sweep.zarr", chunks=None)
    assert code == 0
    assert (record["points"], record["sizes"]) == (18, {"angle": 9, "friction": 2})
    assert list(record["status"].values()) == [18]
    angles = record["ranges"]["rebound_angle"]
    assert angles["min"] == float(stored.rebound_angle.min())
    assert angles["max"] == float(stored.rebound_angle.max())
    assert (angles["units"], record["store"], record["output"]) == ("rad", "sweep.zarr", None)


def test_bad_points_are_counted_with_their_reason_and_the_exit_code_is_0(run):
    Path("cases.csv").write_text("angle,friction\n10 deg,0.1\n20 deg,-0.1\n30 deg,nan\n")
    changed(CASE[CASE.index("[sweep.axes]") :], "")
    Path("case.toml").write_text(Path("case.toml").read_text() + 'table = "cases.csv"\n')
    code, out, _ = run("sweep", "case.toml", "--json")
    statuses = json.loads(out)["status"]
    assert code == 0
    assert sum(statuses.values()) == 3
    assert statuses["solved"] == 1


def test_resume_goes_on_and_is_needed(run, refusal):
    assert run("sweep", "case.toml", "--store", "sweep.zarr")[0] == 0
    assert "--resume" in refusal("sweep", "case.toml", "--store", "sweep.zarr")
    assert run("sweep", "case.toml", "--store", "sweep.zarr", "--resume")[0] == 0


def test_hypercube_of_the_axes(run):
    changed('outputs = ["rebound_angle", "spin_out"]', "samples = 7\nseed = 3")
    drawn = Path("case.toml").read_text().replace(", points = 9", "")
    radius = '"first.radius" = {from = "1 mm", to = "9 mm", spacing = "log"}'
    Path("case.toml").write_text(drawn.replace("friction = [0.1, 0.3]", radius))
    code, out, _ = run("sweep", "case.toml", "--json", "--output", "sweep.nc")
    assert code == 0
    assert json.loads(out)["points"] == 7
    radii = np.sort(carom.read("sweep.nc").first_radius)
    strata = np.geomspace(1e-3, 9e-3, 8)
    assert np.all((strata[:-1] <= radii) & (radii <= strata[1:]))


def test_file_that_the_case_names_is_written(run):
    changed("[sweep]", '[output]\ndata = "mine.nc"\n[sweep]')
    assert run("sweep", "case.toml")[0] == 0
    assert carom.read("mine.nc").status.size == 18


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("outputs =", "output =", ("output", "line 10", "'outputs'")),
        ("[sweep.axes]", "[sweep.axis]", ("axis", "line 12", "'axes'")),
        ("friction = [", "fiction = [", ("fiction", "'friction'")),
        ("outputs = [", "seed = 1\noutputs = [", ("seed", "grid")),
        ("outputs = [", "samples = 0\noutputs = [", ("samples",)),
        ("outputs = [", "samples = 9\noutputs = [", ("angle.points",)),
        ('"spin_out"', '"spin_off"', ("spin_off", "'spin_out'")),
        ("[0.1, 0.3]", "[]", ("friction", "at least one")),
        ('["rebound_angle", "spin_out"]', '"spin_out"', ("outputs", "list of names")),
        ("[sweep]", '[output]\nplot = "hit.png"\n[sweep]', ("plot", "carom sweep draws none")),
        ("[sweep.axes]", "[sweep.axes.first]", ("first.friction",)),
        ("friction = [0.1, 0.3]", RADII, ("first.radius: it is given twice in [sweep.axes]",)),
    ],
)
def test_refuses_in_one_line(refusal, old, new, words):
    changed(old, new)
    err = refusal("sweep", "case.toml")
    assert [word for word in words if word not in err] == [], err


AXES = """\
[sweep.axes]
"first.radius" = [0.005, 5]
first.material.young = [210, "200 GPa"]
first.material.poisson = [0.3, 0.2]
first.material.density = [7850, 7800]
"""
MATERIAL = "first.material = {poisson = 0.3, density = 7850}\n"
TABLE = "first.radius,first.material.young\n0.005,200 GPa\n,nan\n5,210\n"


@pytest.mark.parametrize(
    "design",
    [AXES, f"[sweep]\nsamples = 3\n{AXES}", '[sweep]\ntable = "cases.csv"\n'],
    ids=["grid", "samples", "table"],
)
def test_what_is_hardly_meant_is_told_wherever_it_stands(run, design):
    """In axes, ranges and columns as outside of them."""
    Path("cases.csv").write_text(TABLE)
    stuff = 'second.material = "steel"\n' + ("" if "axes" in design else MATERIAL)
    Path("case.toml").write_text(f"speed = 1\nfriction = 0.2\nfirst.radius = 1\n{stuff}{design}")
    code, _, err = run("sweep", "case.toml")
    assert code == 0
    answer = {"carom: a radius of 5 m; write '5 mm'?", "carom: a Young's modulus of 210 Pa"}
    assert {line.partition("; write '210")[0] for line in err.splitlines()[:2]} == answer


def test_a_single_impact_tells_that_it_leaves_the_sweep_out(run):
    wrong = ["verify", "tune", "case.toml", "--restitution", "2"]  # soon over
    for arguments, ended in ((["impact", "case.toml"], 0), (wrong, 2)):
        code, _, err = run(*arguments)
        assert code == ended
        assert "[sweep] is ignored here; carom sweep computes" in err


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        *((["--store", "sweep.nc"], ".zarr"), (["--store", "nowhere/sweep.zarr"], "folder")),
        *((["--output", "sweep.zarr"], ".nc"), (["--workers", "0"], "workers")),
        *((["--resume"], "store"), (["--scheduler", "nonsense"], "tcp://host:8786")),
        (["--scheduler", CLOSED, "--workers", "2"], "workers"),
        (["--scheduler", CLOSED], "dask scheduler"),
    ],
)
def test_refuses_flags_in_one_line_and_leaves_nothing(refusal, monkeypatch, arguments, word):
    monkeypatch.setattr("carom.many.sweeps.schedulers.ANSWER_SECONDS", 0.5)
    assert word in refusal("sweep", "case.toml", *arguments)
    assert [path.name for path in Path().iterdir()] == ["case.toml"]


def test_case_without_a_sweep_is_refused(refusal):
    Path("case.toml").write_text(CASE[: CASE.index("[sweep]")])
    assert "[sweep.axes]" in refusal("sweep", "case.toml")


def test_full_disk_says_what_is_safe_and_resume_goes_on(run, refusal, monkeypatch):
    replace, written = os.replace, []

    def onto_a_full_disk(partial, target):
        written.append(Path(target).parts[1:3])
        if written.count(("status", "c")) == 2:
            raise OSError(errno.ENOSPC, "No space left on device")
        return replace(partial, target)

    with monkeypatch.context() as full:
        full.setattr("carom.many.sweeps.designs.FEWEST", 4)
        full.setattr("os.replace", onto_a_full_disk)
        err = refusal("sweep", "case.toml", "--store", "sweep.zarr", code=1)
    assert "No space left on device; free some space; 1 of 5 blocks are safe" in err
    assert "--resume" in err
    assert not list(Path("sweep.zarr").rglob("*.partial"))
    code, out, _ = run("sweep", "case.toml", "--store", "sweep.zarr", "--resume", "--json")
    assert code == 0
    assert json.loads(out)["status"] == {"solved": 18}


def test_interrupted_it_says_what_is_safe_and_how_to_go_on(run, refusal, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as pressed:
        pressed.setattr("carom.many.sweeps.stores.StoreRecord.write", interrupted)
        err = refusal("sweep", "case.toml", "--store", "sweep.zarr", code=130)
    assert err == (
        "carom: the sweep was stopped; 0 of 1 blocks are safe in sweep.zarr; "
        "--resume (resume=True) continues there\n"
    )
    assert run("sweep", "case.toml", "--store", "sweep.zarr", "--resume")[0] == 0
