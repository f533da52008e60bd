"""Compiled kernels give what the same Python gives uncompiled."""

import json
import os
import subprocess
import sys

import numpy as np

import carom

CASES = [(0.5, 1.44), (1.5, 1.44), (3.5, 1.44), (0.3, 1.75), (0.5, 4.0), (0.2, 0.3), (0.5, 40.0)]
PROGRAM = """
import json, sys
import carom
from carom.dimensionless import hertz
cases = json.loads(sys.argv[1])
print(json.dumps({
    "rebounds": [carom.rebound(*case) for case in cases],
    "histories": [carom.solve(*case).history(9).force.tolist() for case in cases[:4]],
    "memory": [carom.solve(*case).memory(2.0).q([0.01, 0.2, 0.5]).tolist() for case in cases[:4]],
    "times": [hertz.penetration_and_speed(t) for t in (0.1, 1.0, 1.47, 2.9)],
}))
"""


def computed(**environment):
    arguments = [sys.executable, "-c", PROGRAM, json.dumps(CASES)]
    done = subprocess.run(
        arguments, env=os.environ | environment, capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


def test_compiled_equals_uncompiled():
    compiled, plain = computed(), computed(NUMBA_DISABLE_JIT="1")
    for name in compiled:
        for one, other in zip(compiled[name], plain[name], strict=True):
            assert np.allclose(one, other, rtol=0.0, atol=2e-13), name
    assert compiled["rebounds"] == [carom.rebound(*case) for case in CASES]
