"""The first number after installation does not wait for compilers, and is the same number."""

import json
import os
import subprocess
import sys

import pytest

import carom

BALL = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2", "--speed", "2"]
LOSS = {"elastic": [], "viscous": ["--restitution", "0.9"]}
START = "import sys; from carom.cli import run; run()"
LISTEN = """
from numba.core import event
class Told(event.Listener):
    def on_start(self, happened): print("COMPILED", file=sys.stderr)
    def on_end(self, happened): pass
event.register("numba:compile", Told())
"""


@pytest.mark.parametrize("loss", LOSS)
def test_one_impact_needs_no_compiler_and_gives_the_compiled_number(loss, tmp_path):
    flags = [*BALL, "--angle", "30 deg", "--json", *LOSS[loss]]
    ran = subprocess.run(
        [sys.executable, "-c", f"import sys{LISTEN}{START}", "impact", *flags],
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stderr == ""
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    normal = carom.KelvinVoigt(restitution=0.9) if loss == "viscous" else None
    hit = carom.impact(pair, speed=2.0, angle="30 deg", normal=normal)
    result = json.loads(ran.stdout)["result"]
    for name, value in hit.scalars().items():
        assert result[name] == pytest.approx(value, rel=1e-12, abs=1e-300), name


def test_who_waits_for_compilers_is_told_once(tmp_path):
    """On a terminal; nothing is written where nobody watches."""
    script = (
        "import sys, time; from carom.dimensionless.numerics import jit as c; "
        "c.is_watched = lambda: True; c.PATIENCE = 0.0; "
        "from carom.dimensionless.numerics import hertz as h; "
        "print(*h.penetration_and_speed(h.HALF))"
    )
    ran = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), "NUMBA_DISABLE_JIT": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert ran.stderr.count("compiling") == 1
    assert [float(text) for text in ran.stdout.split()] == [1.0, 0.0]
