"""Checksums of stored files, and files that are not Carom's: nothing but one line is shown."""

import gc
import subprocess
import sys

import h5py
import numpy as np
import pytest
import scipy.io
import xarray as xr

import carom

CURVE = carom.curve(1.44, np.linspace(0.0, 6.0, 50))


@pytest.fixture
def stored(tmp_path):
    return {ending: carom.save(CURVE, tmp_path / f"curve{ending}") for ending in (".nc", ".csv")}


def test_other_programs_pass_over_the_checksum(stored):
    """h5py and xarray read the file; the checksum is that of all before it."""
    content = stored[".nc"].read_bytes()
    assert content.endswith(b"\n")
    assert b"\n# carom sha256 " in content[-90:]
    with h5py.File(stored[".nc"]) as file:
        assert np.array_equal(file["psi_out"][...], CURVE.psi_out)
    with xr.open_dataset(stored[".nc"], engine="h5netcdf") as plain:
        assert np.array_equal(plain.psi_out, CURVE.psi_out)


def test_what_another_program_has_changed_is_read(stored):
    """HDF5 drops what is behind its end; a note that a user adds is no damage."""
    with h5py.File(stored[".nc"], "r+") as file:
        file.attrs["note"] = "mine"
    again = carom.read(stored[".nc"])
    assert again.attrs.pop("note") == "mine"
    assert again.identical(CURVE)


def test_files_without_a_checksum_are_read(stored):
    """As they were stored before there was one."""
    content = stored[".nc"].read_bytes()
    stored[".nc"].write_bytes(content[: content.rindex(b"\n# carom sha256")])
    lines = stored[".csv"].read_bytes().splitlines(keepends=True)
    stored[".csv"].write_bytes(b"".join(x for x in lines if b'{"sha256"' not in x))
    assert stored[".nc"].stat().st_size < len(content)
    for path in stored.values():
        assert carom.read(path).identical(CURVE)


def test_ends_of_lines_are_no_change(stored):
    """What git or a mail program makes of them."""
    content = stored[".csv"].read_bytes()
    stored[".csv"].write_bytes(b"\xef\xbb\xbf" + content.replace(b"\n", b"\r\n"))
    assert carom.read(stored[".csv"]).identical(CURVE)


@pytest.mark.parametrize("ending", [".nc", ".csv"])
def test_one_digit_that_differs_is_told(ending, stored):
    """In the middle of the numbers, where nothing else would tell."""
    content = bytearray(stored[ending].read_bytes())
    if ending == ".csv":
        place = content.rindex(b"\n", 0, -2) - 3
        content[place] = ord("7") if content[place] != ord("7") else ord("3")
        words = "changed after it was stored; delete its line 'sha256' to read it anyway"
    else:
        content[content.index(CURVE.psi_out.values.tobytes()) + 100] ^= 1
        words = "it is damaged; it has changed since it was stored"
    stored[ending].write_bytes(content)
    with pytest.raises(carom.InputError, match=words) as told:
        carom.read(stored[ending])
    assert "\n" not in str(told.value)


def test_a_table_that_was_changed_on_purpose_is_read_without_its_checksum(stored):
    """What the refusal says to do."""
    text = stored[".csv"].read_text(encoding="utf-8").replace('"title": "', '"title": "my ', 1)
    stored[".csv"].write_text(text, encoding="utf-8")
    with pytest.raises(carom.InputError, match="line 'sha256'"):
        carom.read(stored[".csv"])
    lines = [line for line in text.splitlines(keepends=True) if '"sha256"' not in line]
    stored[".csv"].write_text("".join(lines), encoding="utf-8")
    assert carom.read(stored[".csv"]).attrs["title"].startswith("my ")


def foreign(folder):
    """Write files of other programs and others that are none."""
    rng = np.random.default_rng(1)
    whole = carom.save(CURVE, folder / "whole.nc").read_bytes()
    for name, content in {
        "empty": b"",
        "few": whole[:20],
        "head": whole[:100],
        "half": whole[: len(whole) // 2],
        "end": whole[:-200],
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


def test_what_is_not_of_carom_is_refused_without_noise(tmp_path):
    """With all warnings shown, in a process of its own: nothing of HDF5, h5netcdf or xarray."""
    files = foreign(tmp_path)
    command = [sys.executable, "-W", "always", "-c", PROGRAM, *map(str, files)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.stderr == ""
    assert done.stdout.split() == ["0"] * len(files)
    gc.collect()
