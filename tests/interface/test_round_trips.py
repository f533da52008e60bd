"""What is stored comes back as it was: NetCDF and CSV."""

import json
import warnings

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import carom
from carom import HalfSpace, InputError, Pair, Sphere, read, save
from carom.cli import main
from carom.io.labels import flags, labelled_dataset

AWKWARD = [0.1, -0.0, 5e-324, 1.7976931348623157e308, 1 / 3, 2.5e-7, np.nan, np.inf, -np.inf]


def history():
    """Return a history with NaN (no tangential speed) and infinity (no friction) among it."""
    pair = Pair(Sphere(radius="5 mm", material="steel"), HalfSpace(material="glass"), 0)
    return carom.impact(pair, normal_speed=2.0, spin=30.0).history(21)


def slip():
    pair = Pair(Sphere(radius="5 mm", material="steel"), Sphere(radius=1, material="ice"), 0.2)
    return carom.impact(pair, speed=2.0, angle="30 deg", spin2=2.0)


def slipping():
    return slip().history(400)


def contact():
    hit = slip()
    side = np.linspace(-1.5, 1.5, 21) * hit.max_radius
    return hit.fields(0.7 * hit.duration, x=side, y=side[:10])


def curve():
    return carom.curve([0.3, 1.44, 2.0], np.linspace(-3.0, 9.0, 101))


def patch():
    """Return what fields on a grid look like: many variables along (y, x), zones, scalars."""
    rng = np.random.default_rng(4)
    x, y = np.linspace(-1e-4, 1e-4, 7), np.linspace(-1e-4, 1e-4, 5)
    pressure = rng.normal(size=(5, 7)) * 10.0 ** rng.integers(-300, 300, (5, 7))
    pressure.ravel()[: len(AWKWARD)] = AWKWARD
    zone = rng.integers(0, 3, (5, 7)).astype(np.int8)
    wide = ("y", "x")
    return labelled_dataset(
        {
            "pressure": (wide, pressure),
            "traction_x": (("x", "y"), rng.normal(size=(7, 5)).astype(np.float32)),
            "zone": (wide, zone, {"long_name": "zone"} | flags(("outside", "stick", "slip"))),
            "sticks": (wide, zone == 1, {"long_name": "whether it sticks"}),
            "note": (wide, np.full((5, 7), 'a, "b"\nµ; #1'), {"long_name": "words to quote"}),
            "distance": (("y",), abs(y)),
            "time": 1e-6,
        },
        {"x": x, "y": y},
        {"title": "fields of a contact", "inputs": {"first": "µm — # Kugel"}, "phase_sign": -1},
    )


def points():
    """Return what fields at points look like: coordinates that are no index."""
    rng = np.random.default_rng(5)
    return labelled_dataset(
        {"pressure": ("point", rng.normal(size=6)), "friction": 0.2},
        {"x": ("point", [1.0, 1.0, 2.0, 2.0, np.nan, 3.0]), "y": ("point", rng.normal(size=6))},
        {"title": "fields of a contact", "level": 0.1, "limits": np.array([0.1, np.inf])},
    )


def numbers():
    return labelled_dataset({"chi": 1.44, "psi_out": np.nan}, {}, {"title": "numbers"})


MAKERS = (history, slipping, contact, curve, patch, points, numbers)


@pytest.mark.parametrize("ending", ["nc", "csv", "CSV"])
@pytest.mark.parametrize("make", MAKERS)
def test_a_dataset_comes_back_to_the_last_bit(make, ending, tmp_path):
    """Values, types, order of dimensions, coordinates, attributes of all and of each variable."""
    stored = make()
    back = read(save(stored, tmp_path / f"file.{ending}"))
    xr.testing.assert_identical(stored, back)
    assert set(stored.data_vars) == set(back.data_vars)
    for name, item in stored.variables.items():
        values, again = item.values, back[name].values
        assert again.dtype == values.dtype, name
        if values.dtype.kind in "fiub":
            assert again.tobytes() == values.tobytes(), name
        for key, value in item.attrs.items():
            assert np.asarray(back[name].attrs[key]).dtype == np.asarray(value).dtype, key


@pytest.mark.parametrize("make", MAKERS)
def test_storing_again_gives_the_same_file(make, tmp_path):
    first = save(make(), tmp_path / "first.csv")
    netcdf = save(read(first), tmp_path / "second.nc")
    assert save(read(netcdf), tmp_path / "third.csv").read_bytes() == first.read_bytes()


def test_the_table_is_one_that_pandas_reads(tmp_path):
    dataset = curve()
    table = pd.read_csv(save(dataset, tmp_path / "curve.csv"), comment="#")
    assert list(table.columns[:3]) == ["chi", "psi_in", "psi_out"]
    assert len(table) == 3 * 101
    row = table[(table.chi == 1.44) & (table.psi_in == 9.0)]
    assert row.psi_out.item() == float(dataset.psi_out.sel(chi=1.44, psi_in=9.0))
    table = pd.read_csv(save(history(), tmp_path / "hit.csv"), comment="#")
    assert table.spin.tolist() == [30.0] * 21


def test_the_head_is_json_that_says_all(tmp_path):
    lines = save(slipping(), tmp_path / "hit.csv").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "# carom table 1"
    head = [json.loads(line[2:]) for line in lines[1:] if line.startswith("# ")]
    assert head[0]["attributes"]["Conventions"] == "CF-1.11"
    said = {line.get("variable"): line for line in head}
    assert said["friction"]["values"] == 0.2
    assert said["normal_force"]["attributes"]["units"] == "N"
    assert said["phase_kind"]["values"][0] in ("stick", "gross slip")


def test_seconds_stay_numbers_for_every_reader(tmp_path):
    """A unit of s is decoded neither to a date nor to a time span."""
    dataset = slipping()
    path = save(dataset, tmp_path / "hit.nc")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with xr.open_dataset(path, engine="h5netcdf") as plain:
            for name in ("time", "phase_start", "phase_end", "duration"):
                assert plain[name].dtype == np.float64
                assert np.array_equal(plain[name], dataset[name])
            assert plain.time.units == "s"
            assert "_FillValue" not in plain.time.encoding


def test_what_the_commands_store_can_be_read(tmp_path, capsys):
    flags = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2", "--speed", "2"]
    path = str(tmp_path / "hit.csv")
    assert main(["impact", *flags, "--angle", "30 deg", "--output", path]) == 0
    ball = Sphere(radius="5 mm", material="steel")
    pair = Pair(ball, HalfSpace(material="steel"), friction=0.2)
    hit = carom.impact(pair, speed=2.0, angle="30 deg")
    xr.testing.assert_identical(read(path), hit.to_dataset())
    path = str(tmp_path / "curve.nc")
    assert main(["curve", "--chi", "1.44", "--to", "6", "--output", path]) == 0
    xr.testing.assert_identical(read(path), carom.curve(1.44, np.linspace(0.0, 6.0, 401)))
    capsys.readouterr()


DAMAGE = {
    "cut": lambda text: text[:-400],
    "row lost": lambda text: text[: text.rindex("\n", 0, -2) + 1],
    "number spoilt": lambda text: text[:-3] + "x\n",
    "value lost": lambda text: text[: text.rindex(",")] + "\n",
    "head without JSON": lambda text: text.replace('{"coordinate"', '"coordinate"', 1),
    "dimension lost": lambda text: text.replace('"psi_in": 101, ', "", 1),
    "variable lost": lambda text: text.replace('"variable": "psi_out"', '"variable": "psi"', 1),
    "type unknown": lambda text: text.replace('"f8"', '"O8"', 1),
    "coordinate moved": lambda text: text.replace("\n1.44,", "\n1.45,", 1),
    "head alone": lambda text: text[: text.index("\nchi,") + 1],
    "first line alone": lambda text: text[: text.index("\n") + 1],
}


def unsealed(text):
    """Return a table as it was stored before there were checksums."""
    return "".join(x for x in text.splitlines(keepends=True) if not x.startswith('# {"sha256"'))


@pytest.mark.parametrize("kind", DAMAGE)
@pytest.mark.parametrize("older", [str, unsealed], ids=["sealed", "older"])
def test_damaged_tables_are_refused_in_one_line(kind, older, tmp_path):
    path = save(curve(), tmp_path / "curve.csv")
    path.write_text(DAMAGE[kind](older(path.read_text(encoding="utf-8"))), encoding="utf-8")
    with pytest.raises(InputError, match=r"file: .*curve\.csv' cannot be used; it is damaged") as e:
        read(path)
    assert "\n" not in str(e.value)


def foreign(folder):
    """Write files that Carom cannot read; return them by what is said of them."""
    (folder / "other.csv").write_text("a,b\n1,2\n")
    (folder / "empty.csv").write_text("")
    (folder / "binary.csv").write_bytes(bytes(range(128, 256)))
    (folder / "text.nc").write_text("no NetCDF at all")
    xr.Dataset({"a": 1.0}).to_netcdf(folder / "other.nc", engine="h5netcdf")
    whole = save(slipping(), folder / "cut.nc").read_bytes()
    (folder / "cut.nc").write_bytes(whole[: len(whole) // 2])
    (folder / "folder.nc").mkdir()
    return {
        "other.csv": "not stored by Carom",
        "empty.csv": "not stored by Carom",
        "binary.csv": "not text",
        "text.nc": "damaged, or not NetCDF-4",
        "other.nc": "not stored by Carom",
        "cut.nc": "damaged, or not NetCDF-4",
        "missing.nc": "there is no such file",
        "folder.nc": "there is no such file",
        "table.xls": "must end in .nc or .csv",
    }


def test_other_files_are_refused_in_one_line(tmp_path):
    for name, reason in foreign(tmp_path).items():
        with pytest.raises(InputError, match=f"file: .*{name}.* cannot be used; .*{reason}") as e:
            read(tmp_path / name)
        assert "\n" not in str(e.value)


def test_what_cannot_be_stored_is_refused(tmp_path):
    dates = xr.Dataset({"when": ("time", np.array(["2020-01-01"], dtype="datetime64[ns]"))})
    with pytest.raises(
        InputError, match=r"when: 'datetime64\[ns\]' cannot be used; Carom stores only"
    ):
        save(dates, tmp_path / "dates.csv")
    assert list(tmp_path.iterdir()) == []


def test_netcdf_that_may_not_grow_leaves_the_process_and_the_older_file_alone(tmp_path):
    """HDF5 would take the process down when it ends, if not before; nothing is left behind."""
    resource = pytest.importorskip("resource")
    (tmp_path / "curve.nc").write_text("older")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    for limit in (0, 100, 4096, 8000):
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, before[1]))
        try:
            with pytest.raises(carom.InputError, match=r"cannot be written; File too large$"):
                carom.save(carom.curve(1.44, [0.5, 2.0]), tmp_path / "curve.nc")
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
        assert [path.name for path in tmp_path.iterdir()] == ["curve.nc"]
        assert (tmp_path / "curve.nc").read_text() == "older"
