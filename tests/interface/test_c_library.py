"""The compiled kernels from other languages: the same bits as in Python, from any thread."""

import ctypes
import os
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.dimensionless.numerics import shared_library

EXAMPLES = Path(__file__).parents[2] / "examples" / "c"
pytestmark = pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
COMPILERS = {"rebound.c": ("cc", "-std=c99"), "rebound.f90": ("gfortran",)}
STRICT = ("-Wall", "-Wextra", "-pedantic", "-Werror")
DOUBLES, CODES = (np.ctypeslib.ndpointer(kind, flags="C") for kind in (np.float64, np.int8))


@pytest.fixture(scope="module")
def functions():
    library = ctypes.CDLL(carom.get_library())
    library.carom_rebound.argtypes = [ctypes.c_size_t, DOUBLES, DOUBLES, DOUBLES, CODES]
    library.carom_rebound_on_plate.argtypes = [ctypes.c_size_t, *[DOUBLES] * 4, CODES]
    library.carom_motion_on_plate.argtypes = [ctypes.c_size_t, *[DOUBLES] * 3]
    library.carom_rebound_viscous.argtypes = [ctypes.c_size_t, *[DOUBLES] * 5, CODES]
    library.carom_status_message.restype = ctypes.c_char_p
    return library


def rebound(functions, psi, chi):
    psi_out, status = np.zeros(psi.size), np.zeros(psi.size, np.int8)
    assert functions.carom_rebound(psi.size, psi, chi, psi_out, status) == 0
    return psi_out, status


def impacts(seed, count=500):
    rng = np.random.default_rng(seed)
    psi, chi = rng.uniform(-9.0, 9.0, count), rng.uniform(0.1, 5.0, count)
    psi[:4], chi[4:8] = [np.nan, np.inf, 0.0, 1e-9], [np.nan, -1.0, 0.0, 1e6]
    return psi, chi


def test_the_same_bits_as_in_python(functions):
    psi, chi = impacts(1)
    expected, codes = carom.rebound(psi, chi, return_status=True)
    actual, status = rebound(functions, psi, chi)
    assert actual.tobytes() == expected.tobytes()
    assert np.array_equal(status, codes)


def test_plates_are_those_of_python(functions):
    psi, chi = impacts(3)
    give, expected = np.linspace(0.0, 2.1, psi.size), np.empty(psi.size)
    actual, status = np.zeros(psi.size), np.zeros(psi.size, np.int8)
    assert functions.carom_rebound_on_plate(psi.size, psi, chi, give, actual, status) == 0
    codes = np.zeros(psi.size, np.int8)
    for i, each in enumerate(give):
        plate = carom.ZenerPlate(inelasticity=min(each * 1.25**0.4, 2.18))
        one = carom.rebound(psi[i], chi[i], losses=plate, return_status=True)
        expected[i], codes[i] = one
    solved = (status == 0) & (give < 1.99)
    assert np.array_equal(status[give < 1.99], codes[give < 1.99])
    assert np.count_nonzero(solved) > 400
    assert actual[solved] == pytest.approx(expected[solved], abs=1e-12, rel=1e-12)
    assert np.all(status[give > 2.0][np.isfinite(psi[give > 2.0])] == 5)


def test_the_motion_on_plates_is_that_of_python(functions):
    give = np.array([0.0, 1e-4, 0.345, 1.0, 1.99, 2.1, -0.1, np.nan, np.inf])
    e, duration = np.zeros(give.size), np.zeros(give.size)
    assert functions.carom_motion_on_plate(give.size, give, e, duration) == 0
    laws = [
        carom.laws.ReboundLaw(0.3, losses=carom.ZenerPlate(inelasticity=each * 1.25**0.4))
        for each in give[:5]
    ]
    assert e[:5] == pytest.approx([law.restitution for law in laws], abs=1e-10)
    assert duration[:5] == pytest.approx([law.duration for law in laws], abs=1e-9)
    assert np.isnan([e[5:], duration[5:]]).all()


def test_the_same_bits_with_losses(functions):
    psi, chi = (values[8:80].copy() for values in impacts(2))
    restitution = np.linspace(0.2, 1.0, psi.size)
    expected = [
        carom.rebound(one, other, losses=carom.KelvinVoigt(restitution=e))
        for one, other, e in zip(psi, chi, restitution, strict=True)
    ]
    alpha = np.array([carom.KelvinVoigt(restitution=e)._scale_free()[1] for e in restitution])
    actual, e, status = np.zeros(psi.size), np.zeros(psi.size), np.zeros(psi.size, np.int8)
    assert functions.carom_rebound_viscous(psi.size, psi, chi, alpha, actual, e, status) == 0
    assert actual.tolist() == expected
    assert not status.any()
    assert e == pytest.approx(restitution, abs=1e-9)


def test_from_many_threads_at_once(functions):
    values = [impacts(seed) for seed in range(8)]
    alone = [rebound(functions, *each)[0].tobytes() for each in values]
    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(lambda each: rebound(functions, *each)[0].tobytes(), values))
    assert together == alone


def test_no_impacts_at_all(functions):
    assert rebound(functions, np.zeros(0), np.zeros(0))[0].size == 0


def test_every_status_has_its_words(functions):
    for status in carom.status.Status:
        assert functions.carom_status_message(status).decode() == status.message
    assert functions.carom_status_message(99) == b"no status"


def test_codes_in_the_header_are_those_of_python():
    text = Path(carom.get_include(), "carom.h").read_text()
    codes = dict(re.findall(r"CAROM_([A-Z_]+) = (\d+)", text))
    assert {name: int(code) for name, code in codes.items()} == {
        s.name: s.value for s in carom.status.Status
    }


@pytest.mark.parametrize("name", COMPILERS)
def test_the_examples_run(name, tmp_path):
    compiler, *options = COMPILERS[name]
    if shutil.which(compiler) is None:
        pytest.skip(f"there is no {compiler}")
    program = tmp_path / "rebound"
    include = f"-I{carom.get_include()}"
    command = [compiler, *options, *STRICT, include, EXAMPLES / name, "-o", program]
    subprocess.run([*command, carom.get_library(), "-lm"], check=True)
    where = {**os.environ, "LD_LIBRARY_PATH": str(Path(carom.get_library()).parent)}
    output = subprocess.run([program], check=True, capture_output=True, text=True, env=where)
    rows = [line.split() for line in output.stdout.splitlines()]
    psi, psi_out = (np.array([float(row[i]) for row in rows]) for i in (0, 1))
    assert psi_out == pytest.approx(carom.rebound(psi, 1.44), abs=1e-12)


def test_it_needs_nothing_but_the_c_library():
    if shutil.which("ldd") is None:
        pytest.skip("there is no ldd")
    words = ["ldd", carom.get_library()]
    output = subprocess.run(words, check=True, capture_output=True, text=True)
    names = set(re.findall(r"^\s*(?:\S*/)?(\w[\w-]*)\.", output.stdout, re.MULTILINE))
    assert names <= {"linux-vdso", "libm", "libc", "ld-linux-x86-64", "ld-linux-aarch64"}
