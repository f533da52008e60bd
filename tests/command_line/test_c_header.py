"""`carom curve --export c`: the header, compiled, is the law of Python and the exact rebound."""

import ctypes
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.many.laws.header import c_header

CHIS = [0.2, 0.5, 1.44, 3.0]
STRICT = ["-Wall", "-Wextra", "-pedantic", "-Werror"]
LOOP = """\
#include "rebound.h"
#include "rebound.h" /* twice: it guards itself */
#ifdef __cplusplus
extern "C"
#endif
void many(const double *psi, double *psi_out, int count);
void many(const double *psi, double *psi_out, int count)
{
    int i;
    for (i = 0; i < count; ++i)
        psi_out[i] = FUNCTION(psi[i]);
}
"""


def compiled(function="carom_rebound", language="c", standard="c99"):
    """The header of this folder as a function of NumPy arrays."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("needs a C compiler, cc, on the path")
    Path("loop.c").write_text(LOOP.replace("FUNCTION", function))
    source = ["-x", language, f"-std={standard}", *STRICT, "-O1", "loop.c"]
    library = Path(f"{function}-{language}.so").absolute()
    made = subprocess.run(
        [compiler, *source, "-shared", "-fPIC", "-o", str(library)], capture_output=True, text=True
    )
    if "cc1plus" in made.stderr:
        pytest.skip("cc cannot compile C++ here")
    assert made.returncode == 0, made.stderr
    many = ctypes.CDLL(str(library)).many

    def call(psi):
        psi = np.ascontiguousarray(psi, dtype=np.float64)
        out = np.empty_like(psi)
        pointers = (each.ctypes.data_as(ctypes.c_void_p) for each in (psi, out))
        many(*pointers, ctypes.c_int(psi.size))
        return out

    return call


def slopes(law):
    """psi_1 all over the regimes, at the ends of all panels and beside them, tiny and huge."""
    ends = np.concatenate([np.nextafter(law.edges, 0.0), law.edges, np.nextafter(law.edges, 9.0)])
    fine = np.geomspace(1e-12, 20.0, 4000)
    even = np.linspace(0.0, 1.1 * law.edges[-1], 6000)
    extreme = [0.0, 5e-324, 1e-300, 1e6, 1e15, 1e300, np.finfo(float).max]
    psi = np.concatenate([ends, fine, even, extreme])
    return np.concatenate([psi, -psi])


@pytest.mark.first_case
@pytest.mark.parametrize("chi", CHIS)
def test_is_the_law_and_the_exact_rebound(run, chi):
    """To 1e-14 of ReboundLaw and 1e-9 of `carom.rebound`; odd to the bit; IEEE values pass."""
    code, out, err = run("curve", "--chi", chi, "--export", "c", "--output", "rebound.h")
    assert (code, out) == (0, "")
    assert err.endswith("Carom has stored rebound.h.\n")
    function, law = compiled(), carom.laws.ReboundLaw(chi)
    psi = slopes(law)
    assert psi.size > 20000
    got = function(psi)
    size = np.maximum(1.0, np.abs(psi))
    assert np.max(np.abs(got - law(psi)) / size) <= 1e-14
    some = np.abs(psi) < 1e6
    sample = psi[some][:: 1 if chi == 1.44 else 20]
    exact = carom.rebound(sample, chi)
    assert np.max(np.abs(function(sample) - exact)) <= 1e-9
    np.testing.assert_array_equal(function(-psi), -got)
    np.testing.assert_array_equal(
        function([np.inf, -np.inf, np.nan, -0.0]), [np.inf, -np.inf, np.nan, 0.0]
    )
    assert np.all(np.abs(got) <= np.abs(psi)), "energy never grows"


def test_several_laws_in_one_header_and_in_cpp(run):
    """Each has its chi in its name; the same text compiles as C++, to the same numbers."""
    code, text, _ = run("curve", "--chi", "1.44", "--chi", "2", "--export", "c")
    assert code == 0
    Path("rebound.h").write_text(text)
    psi = np.linspace(-9.0, 9.0, 101)
    for name, chi in (("carom_rebound_1_44", 1.44), ("carom_rebound_2", 2.0)):
        want = carom.laws.ReboundLaw(chi)(psi)
        np.testing.assert_allclose(compiled(name)(psi), want, rtol=0, atol=1e-14)
        got = compiled(name, "c++", "c++11")(psi)
        np.testing.assert_allclose(got, want, rtol=0, atol=1e-14)


def test_the_law_of_a_plate(run):
    """At one lambda: to 1e-14 of ReboundLaw and 1e-9 of `carom.rebound`; its e is in the text."""
    code, text, _ = run("curve", "--chi", 1.44, "--inelasticity", 0.4, "--export", "c")
    assert code == 0
    Path("rebound.h").write_text(text)
    plate = carom.ZenerPlate(inelasticity=0.4)
    law, function = carom.laws.ReboundLaw(1.44, losses=plate), compiled()
    psi = slopes(law)
    size = np.maximum(1.0, np.abs(psi))
    assert np.max(np.abs(function(psi) - law(psi)) / size) <= 1e-14
    some = psi[np.abs(psi) < 1e6][::20]
    assert np.max(np.abs(function(some) - carom.rebound(some, 1.44, losses=plate))) <= 1e-9
    assert f"e = {law.restitution!r}" in text
    assert "1e-9" in text[: text.index("*/")]
    laws = [carom.laws.ReboundLaw(1.44, losses=each) for each in (None, plate)]
    assert "carom_rebound_1_44_plate_0_4(double psi)" in c_header(laws)


def test_says_what_it_is(run):
    """Version, chi, the error and the equation stand in the comment, in ASCII."""
    _, text, _ = run("curve", "--chi", "0.75", "--export", "c")
    comment = text[: text.index("*/")]
    for word in (carom.__version__, "chi = 0.75", "1e-9", "kappa V_x / (mu V_1)", "Maw, Barber"):
        assert word in comment
    assert text.isascii()
    assert max(map(len, text.splitlines())) <= 100
    assert run("curve", "--help")[1].count("--export c") >= 1


REFUSED = [
    (["--export", "rust"], "export: 'rust' cannot be used; must be c"),
    (["--export", "c", "--json"], "--json: has no effect with --export"),
    (["--export", "c", "--plot", "x.png"], "--plot: has no effect with --export"),
    (["--export", "c", "--from", "1"], "--from: has no effect with --export"),
    (["--export", "c", "--to", "2"], "--to: has no effect with --export"),
    (["--export", "c", "--points", "9"], "--points: has no effect with --export"),
    (["--export", "c", "--output", "x.csv"], "output file: 'x.csv' cannot be used; must end in .h"),
    (["--export", "c", "--output", "no/x.h"], "output file: 'no/x.h' .*folder must exist"),
    (["--export", "c", "--chi", "1.440"], "chi: 1.44 comes twice"),
    (["--restitution", "0.9", "--inelasticity", "0.4"], "inelasticity: give it or --restitution"),
    (["--inelasticity", "3"], "inelasticity: '3' cannot be used"),
    (["--export", "c", "--chi", "-1"], "chi: '-1' cannot be used; must be positive"),
    (["--output", "x.h"], "output file: 'x.h' cannot be used; must end in .nc or .csv"),
]


@pytest.mark.parametrize(("arguments", "message"), REFUSED)
def test_refusals(refusal, arguments, message):
    """One line, and no file."""
    assert re.search(message, refusal("curve", "--chi", "1.44", *arguments))
    assert not list(Path().iterdir())
