"""A dataset of a user's comes back as it was, or is refused in one line, whatever the format."""

import json
import warnings

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

from carom import InputError, read, save

KINDS = ["?", "i1", "u8", "f2", "f4", ">f8"]
ROW = ("row", [1.0, 2.0, 3.0])
CF = {
    "missing_value": 1.0,
    "scale_factor": 2.0,
    "add_offset": 1.0,
    "_Unsigned": "true",
    "valid_range": np.array([0.0, 1.0]),
    "units": "days since 2000-01-01",
    "grid_mapping": "speed",
    "calendar": "noleap",
}
ATTRIBUTES = {
    "empty": "",
    "lines": 'two\n"lines", # of µ',
    "count": 3,
    "small": np.int8(-3),
    "large": 2**63,
    "single": np.float32(0.1),
    "gap": np.nan,
    "most": np.inf,
    "none": [],
    "range": (1, 2),
    "limits": np.array([0.1, np.inf]),
    "words": ["a", "bä"],
    "text": np.str_("x"),
}
NAMES = ["a b", "ä", "1", "a.b", "a,b", 'a"b', ".a", "..", "[a]", "a:b", "a#b", " a", "__init__"]
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
}


def changed(**more):
    return xr.Dataset({"a": ROW}).assign(more)


VALUES = [True, None, {}, {1, 2}, [1], ["a"], [1, "a"], [1, [2]], [True, False], 2**70, 1j, b"a"]
VALUES += [np.array("2020", "M8[s]"), np.eye(2), "a\0b", "\udc00", np.longdouble(1), ROW]
REFUSED = {
    "dates": changed(when=("row", np.array(["2020"] * 3, "M8[ns]"))),
    "spans": changed(lasts=("row", np.arange(3).astype("m8[s]"))),
    "complex": changed(z=("row", np.ones(3, complex))),
    "long": changed(x=("row", np.ones(3, np.longdouble))),
    "bytes": changed(x=("row", np.array([b"a"] * 3))),
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
    "blank before one": xr.Dataset({"a": ROW}, {" t": 1.0}),
    **{f"name {name!r}": changed().rename(a=name) for name in ("", "a/b", ".", "#a", "a\rb", "\0")},
    **{f"name {name!r}": xr.Dataset({name: ROW}) for name in (1, (1, 2), None)},
    **{f"dimension {name!r}": xr.Dataset({"a": ((name,), [1.0])}) for name in (1, "a/b")},
    **{f"attribute {value!r}": xr.Dataset({"a": (*ROW, {"k": value})}) for value in VALUES},
    **{
        f"attribute {name!r}": xr.Dataset({"a": ROW}, attrs={name: "a"})
        for name in (1, "", "a/b", "_FillValue", "coordinates", "dtype", "_Encoding", "CLASS")
    },
    "array without a name": xr.DataArray([1.0, 2.0]),
    "array named as its coordinate": xr.DataArray([1.0, 2.0], {"a": ("a", [1, 2])}, name="a"),
    "type": xr.Dataset,
}


@pytest.mark.parametrize("ending", [".nc", ".csv"])
@pytest.mark.parametrize("kind", PLAIN)
def test_it_comes_back_as_it_was(kind, ending, tmp_path):
    """Values, types of numbers, coordinates, attributes; what was given is left alone."""
    given = PLAIN[kind]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        back = read(save(given.copy(deep=True), tmp_path / f"file{ending}"))
    xr.testing.assert_identical(back, given)
    for name, item in given.variables.items():
        if item.dtype.kind != "O" and item.dtype.isnative:
            assert back[name].dtype.kind == item.dtype.kind
    assert back.attrs.keys() == given.attrs.keys()


@pytest.mark.parametrize("ending", [".nc", ".csv"])
@pytest.mark.parametrize("kind", REFUSED)
def test_what_would_come_back_changed_is_refused(kind, ending, tmp_path):
    with pytest.raises(InputError, match="cannot be used") as told:
        save(REFUSED[kind], tmp_path / f"file{ending}")
    assert "\n" not in str(told.value)
    assert len(str(told.value)) < 400
    assert list(tmp_path.iterdir()) == []


def test_what_is_saved_is_not_changed(tmp_path):
    """The attributes that are made plain are those of the file alone."""
    given = xr.Dataset({"a": (*ROW, {"k": [1, 2]})}, attrs={"k": np.str_("x")})
    save(given, tmp_path / "file.csv")
    assert type(given.attrs["k"]) is np.str_
    assert type(given.a.attrs["k"]) is list


NAMED = 'aµ #,;"[]'


@pytest.mark.parametrize("seed", range(40))
def test_random_datasets_are_alike_in_both_formats(seed, tmp_path):
    """Either both give it back, or both refuse it."""
    rng = np.random.default_rng(seed)

    def text(common='aµ #,;"\n\r', rare="\t\0"):
        letters = [*common] * 20 + [*rare]
        return "".join(rng.choice(letters, rng.integers(1, 5)))

    def values(shape):
        numbers = rng.normal(size=shape) * 10.0 ** rng.integers(-300, 300, shape)
        words = np.array([text() for _ in numbers.ravel()]).reshape(shape)
        return [numbers, words, numbers > 0.0, rng.integers(-9, 9, shape)][rng.integers(4)]

    rare = "/\0" if seed % 4 == 0 else ""
    sizes = {"x": 2, "y": 3, "z": 1}
    dims = [rng.permutation([*sizes])[: rng.integers(4)].tolist() for _ in range(5)]
    given = xr.Dataset(
        {f"v{text(NAMED, rare)}": (d, values([sizes[n] for n in d]), {"k": text()}) for d in dims},
        {"x": values(2)} if seed % 2 else {},
        {"title": json.dumps(text()), "n": float(rng.normal())},
    )
    told = []
    for ending in (".nc", ".csv"):
        try:
            xr.testing.assert_identical(read(save(given, tmp_path / f"file{ending}")), given)
            told.append("")
        except InputError as error:
            told.append(str(error))
    assert told[0] == told[1]
