"""What is stored comes back as it was or is refused in one line; CSV is for other programs."""

import csv
import gc
import subprocess
import sys
import warnings

import h5py
import numpy as np
import pandas as pd
import pint
import pytest
import scipy.io
import xarray as xr
from tests.checks import BALL, refused

import carom
from carom import read, save
from carom.io.labels import flags, labelled_dataset

AWKWARD = [0.1, -0.0, 5e-324, 1.7976931348623157e308, 1 / 3, 2.5e-7, np.nan, np.inf, -np.inf]


def history():
    """Return a history with NaN (no tangential speed) and infinity (no friction) among it."""
    pair = carom.Pair(BALL, carom.HalfSpace(material="glass"), 0)
    return carom.impact(pair, normal_speed=2.0, spin=30.0).history(21)


def slip():
    pair = carom.Pair(BALL, carom.Sphere(radius=1, material="ice"), 0.2)
    return carom.impact(pair, speed=2.0, angle="30 deg", spin2=2.0)


def slipping():
    return slip().to_dataset()


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

ROW = ("row", [1.0, 2.0, 3.0])
CF = {"missing_value": 1.0, "scale_factor": 2.0, "add_offset": 1.0, "_Unsigned": "true"}
CF |= {"valid_range": np.array([0.0, 1.0]), "units": "days since 2000-01-01"}
CF |= {"grid_mapping": "speed", "calendar": "noleap"}
ATTRIBUTES = {"empty": "", "lines": 'two\n"lines", # of µ', "count": 3, "small": np.int8(-3)}
ATTRIBUTES |= {"large": 2**63, "single": np.float32(0.1), "gap": np.nan, "most": np.inf}
ATTRIBUTES |= {"none": [], "range": (1, 2), "limits": np.array([0.1, np.inf])}
ATTRIBUTES |= {"words": ["a", "bä"], "text": np.str_("x"), "matrix": np.eye(2)}
NAMES = ["a b", "ä", "1", "a.b", "a,b", 'a"b', ".a", "..", "[a]", "a:b", "a#b", " a", "__init__"]
KINDS = ["?", "i1", "u8", "f2", "f4", ">f8"]
PLAIN = {
    "without attributes": xr.Dataset({"a": ROW}),
    "empty": xr.Dataset(),
    "one number": xr.Dataset({"a": 1.5}),
    "attributes": xr.Dataset({"a": (*ROW, ATTRIBUTES)}, attrs=ATTRIBUTES),
    "of another program": xr.Dataset({"a": ROW}, attrs={"source": "LAMMPS", "title": "mine"}),
    "names of CF": xr.Dataset({"speed": (*ROW, CF), "a": ("row", [1, 2, 3], CF)}, attrs=CF),
    "names": xr.Dataset({name: (("row", name), [[1.0], [2.0]], {name: 1}) for name in NAMES}),
    "words": xr.Dataset(
        {"a": ("row", ["", "a\nb", "c\rd", "\r\n", '"#,;\t', "\u2028\x85", "None", "nan"])}
    ),
    "words of pandas": xr.Dataset.from_dataframe(pd.DataFrame({"a": ["x", "yä"], "b": [1, 2]})),
    "no rows": xr.Dataset({"a": ("row", []), "b": ("row", np.array([], np.str_))}),
    "types": xr.Dataset({t: ("row", np.arange(3).astype(t)) for t in KINDS}),
    "coordinates": xr.Dataset({"a": ROW}, {"row": [3, 1, 2], "t": ("row", [*"abc"]), "u": 2.0}),
    **{make.__name__: make for make in MAKERS},
}


@pytest.mark.first_case
@pytest.mark.parametrize("kind", PLAIN)
def test_a_dataset_comes_back_to_the_last_bit(kind, tmp_path):
    """Values, types, order of dimensions, coordinates, attributes; what was given is left alone."""
    stored = PLAIN[kind]() if callable(PLAIN[kind]) else PLAIN[kind]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        back = read(save(stored, tmp_path / "file.NC"))
    xr.testing.assert_identical(stored, back)
    assert set(stored.data_vars) == set(back.data_vars)
    assert type(ATTRIBUTES["text"]) is type(PLAIN["attributes"].attrs["text"]) is np.str_
    for name, item in stored.variables.items():
        values, again = item.values, back[name].values
        assert again.dtype.kind == values.dtype.kind or "O" in again.dtype.kind + values.dtype.kind
        if values.dtype.kind in "fiub" and values.dtype.isnative:
            assert again.dtype == values.dtype
            assert again.tobytes() == values.tobytes(), name
        for key, value in item.attrs.items():
            assert np.asarray(back[name].attrs[key]).dtype == np.asarray(value).dtype, key


def changed(**more):
    return xr.Dataset({"a": ROW}).assign(more)


VALUES = [True, None, {}, {1, 2}, [1], ["a"], [1, "a"], [1, [2]], [True, False], 2**70, b"a", ROW]
VALUES += [np.array("2020", "M8[s]"), "a\0b", "\udc00"]
REFUSED = {
    "dates": changed(when=("row", np.array(["2020"] * 3, "M8[ns]"))),
    "spans": changed(lasts=("row", np.arange(3).astype("m8[s]"))),
    "gap in words": changed(x=("row", np.array(["a", None, "b"], object))),
    "mixed": changed(x=("row", np.array(["a", 1, 2.0], object))),
    "categories": changed(x=("row", pd.Categorical([*"aba"]))),
    "NUL": changed(x=("row", ["a", "a\0b", "c"])),
    "half a character": changed(x=("row", ["a", "\ud800", "c"])),
    "pint": changed(x=("row", pint.Quantity(np.ones(3), "mm"))),
    "multi-index": xr.Dataset(
        {"a": ROW},
        xr.Coordinates.from_pandas_multiindex(
            pd.MultiIndex.from_tuples([(1, 2), (1, 3), (2, 2)], names=["x", "y"]), "row"
        ),
    ),
    "blank in a coordinate": xr.Dataset({"a": ROW}, {"t u": 1.0}),
    **{f"name {name!r}": changed().rename(a=name) for name in ("", "a/b", ".", "\0")},
    **{f"name {name!r}": xr.Dataset({name: ROW}) for name in (1, (1, 2))},
    **{f"dimension {name!r}": xr.Dataset({"a": ((name,), [1.0])}) for name in (1, "a/b")},
    **{f"attribute {value!r}": xr.Dataset({"a": (*ROW, {"k": value})}) for value in VALUES},
    **{
        f"attribute {name!r}": xr.Dataset({"a": ROW}, attrs={name: "a"})
        for name in (1, "", "coordinates", "CLASS", "_Netcdf4Dimid")
    },
    "array without a name": xr.DataArray([1.0, 2.0]),
    "array named as its coordinate": xr.DataArray([1.0, 2.0], {"a": ("a", [1, 2])}, name="a"),
    "type": xr.Dataset,
}


@pytest.mark.first_case
@pytest.mark.parametrize("kind", REFUSED)
def test_what_would_come_back_changed_is_refused(kind, tmp_path):
    words = r"it keeps numbers|cannot be used; (it needs|must)"
    assert len(refused(words, save, REFUSED[kind], tmp_path / "file.nc")) < 400
    assert list(tmp_path.iterdir()) == []


@pytest.mark.first_case
@pytest.mark.parametrize("seed", range(40))
def test_random_datasets_come_back_or_are_refused(seed, tmp_path):
    rng = np.random.default_rng(seed)

    def text(common='aµ #,;"\n\r', rare="\t\0"):
        return "".join(rng.choice([*common] * 20 + [*rare], rng.integers(1, 5)))

    def values(shape):
        numbers = rng.normal(size=shape) * 10.0 ** rng.integers(-300, 300, shape)
        words = np.array([text() for _ in numbers.ravel()]).reshape(shape)
        return [numbers, words, numbers > 0.0, rng.integers(-9, 9, shape)][rng.integers(4)]

    rare = "/\0" if seed % 4 == 0 else ""
    sizes = {"x": 2, "y": 3, "z": 1}
    dims = [rng.permutation([*sizes])[: rng.integers(4)].tolist() for _ in range(5)]
    source = xr.Dataset(
        {
            f"v{text('aµ #,;[]', rare)}": (d, values([sizes[n] for n in d]), {"k": text()})
            for d in dims
        },
        {"x": values(2)} if seed % 2 else {},
        {"title": text(), "n": float(rng.normal())},
    )
    if "\0" in repr(source.to_dict()).replace("\\x00", "\0") or "/" in "".join(source):
        refused("cannot hold it", save, source, tmp_path / "file.nc")
    else:
        xr.testing.assert_identical(read(save(source, tmp_path / "file.nc")), source)


@pytest.mark.parametrize("make", MAKERS)
def test_a_table_has_a_row_for_each_point_and_its_units(make, tmp_path):
    """Every number to the last bit, in the order of the dimensions, the last one fastest.

    Of a whole impact it has the phase at each time, of which an instant of change is the start.
    """
    dataset = make()
    with save(dataset, tmp_path / "table.csv").open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    dims = max((item.dims for item in dataset.data_vars.values()), key=len)
    along = {dim: dataset.sizes[dim] for dim in dims}
    if dims == ("time",) and "phase" in dataset.sizes:
        starts = dataset["phase_start"].values
        at = [max(np.flatnonzero(starts <= time)) for time in dataset["time"].values]
        dataset = dataset.isel(phase=("time", at))
    wanted = {
        name: item.to_base_variable()
        for name, item in dataset.variables.items()
        if set(item.dims) <= set(dims) and bool(item.dims) == bool(dims)
    }
    assert {each.partition(" [")[0] for each in head} == wanted.keys()
    assert len(rows) == np.prod([*along.values()], dtype=int)
    for each, column in zip(head, zip(*rows, strict=True), strict=True):
        name, _, unit = each.partition(" [")
        assert (unit or "1]") == f"{wanted[name].attrs.get('units', '1')}]"
        values = wanted[name].set_dims(along).values.ravel()
        if values.dtype.kind == "f":
            assert np.array(column, values.dtype).tobytes() == values.tobytes()
        else:
            assert list(column) == [str(value) for value in values.tolist()]


def test_a_table_is_read_by_others_and_refused_as_a_dataset(tmp_path):
    stored = save(history(), tmp_path / "hit.csv")
    assert stored.read_text().startswith("time [s],penetration [m],")
    for path in (stored, tmp_path / "none.csv"):
        refused(r"CSV is an export; store a dataset as \.nc", read, path)
    ball = carom.Table({"speed": [1.0, 2.0], "angle": [0.1, 0.2]})
    case = {"first": {"radius": "5 mm", "material": "steel"}, "friction": 0.1}
    swept = carom.sweep(case, ball, outputs=["rebound_angle"])
    again = carom.sweep(case, carom.Table(save(swept[["speed", "angle"]], tmp_path / "s.csv")))
    assert np.array_equal(again.rebound_angle, swept.rebound_angle)


def test_seconds_stay_numbers_for_every_reader(tmp_path):
    """A unit of s is decoded neither to a date nor to a time span; the checksum is passed over."""
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
    with h5py.File(path) as file:
        assert np.array_equal(file["normal_force"][...], dataset.normal_force)


def test_what_another_program_has_changed_is_refused_and_stored_again(tmp_path):
    """HDF5 drops the checksum; what the refusal names reads the file as it is now."""
    path = save(curve(), tmp_path / "curve.nc")
    with h5py.File(path, "r+") as file:
        file.attrs["note"] = "mine"
    refused(r"xarray\.load_dataset\(path, engine='h5netcdf'\) reads", read, path)
    again = read(save(xr.load_dataset(path, engine="h5netcdf"), path))
    assert again.attrs.pop("note") == "mine"
    assert again.equals(curve())


def foreign(folder):
    """Write files of other programs and others that are none."""
    rng = np.random.default_rng(1)
    whole = save(slipping(), folder / "whole.nc").read_bytes()
    flipped = bytearray(whole)
    flipped[len(whole) // 2] ^= 1
    cut = {"few": 20, "head": 100, "half": len(whole) // 2, "end": -200}
    for name, content in {
        "empty": b"",
        "text": b"no NetCDF at all",
        **{name: whole[:end] for name, end in cut.items()},
        "flipped": bytes(flipped),
        "noise": rng.bytes(5000),
        "head and noise": whole[:8] + rng.bytes(5000),
        "zeros": whole[:512] + bytes(len(whole) - 512),
    }.items():
        (folder / f"{name}.nc").write_bytes(content)
    with h5py.File(folder / "other.nc", "w") as file:
        file["x"] = np.arange(3)
        file.create_group("g").attrs["empty"] = h5py.Empty("f")
    with h5py.File(folder / "odd.nc", "w") as file:
        file["z"], file["words"] = np.array([1 + 2j]), np.array([b"a"])
        file["link"] = h5py.SoftLink("/none")
        file.attrs["source"] = "carom 0.1.0"
    with scipy.io.netcdf_file(folder / "three.nc", "w") as file:
        file.createDimension("x", 3)
        file.createVariable("x", "f8", ("x",))[:] = 1.0
        file.source = "carom 0.1.0"
    (folder / "whole.nc").unlink()
    return sorted(folder.iterdir())


PROGRAM = """
import gc, sys, carom
for path in sys.argv[1:]:
    try:
        carom.read(path)
    except carom.InputError as error:
        print(str(error).count(chr(10)))
    gc.collect()
"""


@pytest.mark.slow
def test_what_is_not_of_carom_is_refused_without_noise(tmp_path):
    """With all warnings shown, in a process of its own: nothing of HDF5, h5netcdf or xarray."""
    files = foreign(tmp_path)
    command = [sys.executable, "-W", "always", "-c", PROGRAM, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.stderr == ""
    assert done.stdout.split() == ["0"] * len(files)
    gc.collect()
    for path in files:
        refused("it is not as Carom stored it: damaged, changed sin", read, path)


def test_what_is_no_file_is_refused(tmp_path):
    (tmp_path / "folder.nc").mkdir()
    for name, reason in {
        "missing.nc": "there is no such file",
        "folder.nc": "there is no such file",
        "table.xls": r"must end in \.nc, or be the store of a sweep, \.zarr",
    }.items():
        refused(f"file: .*{name}.* cannot be used; {reason}", read, tmp_path / name)
