"""The first number of a process waits for no compiler, and who must wait is told."""

import os
import re
import subprocess
import sys
from importlib.util import find_spec

import pytest

import carom
from carom.dimensionless.numerics import shared_library

BODIES = """
import carom, sys
ball = carom.Sphere(radius=0.005, material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
hit = carom.impact(pair, speed=2.0, angle=0.5)
"""
COMPILERS = {"numba", "llvmlite"}
FIRST = {
    "impact": "hit.psi_out",
    "losses": "carom.impact(pair, speed=2.0, losses=carom.KelvinVoigt(restitution=0.9), angle=0.5)",
    "history": "hit.history(20)",
    "fields": "hit.fields(0.5 * hit.duration)",
    "stress": "hit.stress(0.5 * hit.duration)",
    "load path": "carom.load_path(pair, normal_force=10.0, tangential_force=[0.0, 1.0, -1.0])",
    "collide": "carom.collide(pair, velocity1=[[1.0, 0.0, -2.0]], normal=[0.0, 0.0, -1.0])",
    "law": "carom.laws.ReboundLaw(1.44)(0.5)",
    "mixture": "carom.laws.ReboundLaw((1.4, 1.5))(0.5, 1.45)",
    "contact law": "carom.dem.LammpsMindlin().rebound([0.5], 1.44, steps=100)",
    "sweep": "carom.sweep({'first': {'radius': 0.005, 'material': 'steel'}, 'speed': 1.0, "
    "'friction': 0.2}, carom.Grid({'angle': [0.1, 0.2]}), progress=False, workers=1)",
    "fit": "str(carom.fit(carom.datasets.path('kharaz2001')))",
}
if find_spec("flask"):
    FIRST["page"] = "__import__('carom.page').page.explorer(port=0).close()"


def python(program, **environment):
    command = [sys.executable, "-c", program]
    more = {**os.environ, **environment}
    return subprocess.run(command, env=more, capture_output=True, text=True, check=True)


@pytest.mark.slow
@pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
def test_with_the_library_no_compiler_is_loaded():
    """One thing after another in a process, and who loads a compiler is named."""
    lines = [
        f"{work}\nassert not {COMPILERS} & set(sys.modules), {name!r}"
        for name, work in FIRST.items()
    ]
    python(BODIES + "\n".join(lines))


@pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
def test_an_elastic_impact_waits_neither_for_scipy_nor_for_pint_in_common_units():
    units = {"0.005": "'5 mm'", "=0.5": "='20 deg'", "2.0": "'2 m/s'"}
    program = re.sub("|".join(units), lambda actual: units[actual[0]], BODIES)
    assert program.count("'") == 6
    python(f"{program}assert not {{'scipy', 'pint'}} & set(sys.modules)")


@pytest.mark.slow
def test_who_waits_for_compilers_is_told_once_and_why(tmp_path):
    """Also where nobody watches; and whether one will have to wait again."""
    script = (
        "from carom.dimensionless.numerics import jit, shared_library; jit.PATIENCE = 0.0; "
        "shared_library.reason = lambda: 'no compiler'; "
        "from carom.dimensionless.numerics import hertz as h; "
        "print(*h.penetration_and_speed(h.HALF)); "
        "jit.waiting.unkept = jit.LOCKED; print(jit.waiting.message())"
    )
    ran = python(script, NUMBA_CACHE_DIR=str(tmp_path))
    assert ran.stderr.startswith("Carom is compiling its solver. This happens once ")
    assert ran.stderr.endswith("(no compiler).\n")
    numbers, again = ran.stdout.splitlines()
    assert "at every start" in again
    assert "set NUMBA_CACHE_DIR" in again
    assert [float(text) for text in numbers.split()] == [1.0, 0.0]


HIDDEN = "import sys; sys.modules['numba'] = None\n"  # as if it were not installed
NO_LIBRARY = """
from pathlib import Path
from carom.dimensionless.numerics import shared_library
shared_library.FOLDER = Path("/nowhere")
"""
INSTALL = 'pip install "carom[jit]"'


def test_without_library_and_numba_plain_python_runs_and_one_line_says_how_to_be_fast():
    ran = python(f"{HIDDEN}{NO_LIBRARY}import carom; print(*carom.rebound([0.5, 1.5], 1.44))")
    expected = carom.rebound([0.5, 1.5], 1.44)
    assert [float(text) for text in ran.stdout.split()] == pytest.approx(expected, abs=1e-14)
    assert ran.stderr.count("\n") == 1
    assert ran.stderr.startswith("Carom runs its solver as plain Python")
    assert "there is no compiled library; install carom again, with a C compiler" in ran.stderr
    assert INSTALL in ran.stderr


@pytest.mark.skipif(bool(shared_library.reason()), reason=shared_library.reason())
def test_the_library_needs_no_numba():
    """Nor does a kernel that is not in it, which is so small that Python may run it."""
    hertz = "from carom.dimensionless.numerics import hertz as h\n"
    ran = python(f"{HIDDEN}{hertz}print(*h.penetration_and_speed(h.HALF))\n{BODIES}")
    assert ([float(text) for text in ran.stdout.split()], ran.stderr) == ([1.0, 0.0], "")


def test_numba_is_refused_where_it_is_not_installed():
    ask = "import carom\ntry: carom.rebound(0.5, 1.44)\nexcept carom.InputError as e: print(e)"
    ran = python(HIDDEN + ask, CAROM_KERNELS="numba")
    assert ran.stdout == f"CAROM_KERNELS: numba is not installed; {INSTALL}\n"


def test_an_exact_impact_by_the_command_waits_for_no_boundary_elements():
    words = "impact --radius 5mm --material steel --friction 0.2 --speed 2 --angle 0.5"
    program = f"import sys; from carom.cli import main; assert main({words!r}.split()) == 0"
    python(f"{program}; assert 'carom.halfspace' not in sys.modules")
