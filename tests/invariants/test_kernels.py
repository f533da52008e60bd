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
import numpy as np
import carom
from carom.dimensionless.numerics import hertz
from carom.dimensionless.fields import subsurface
cases = json.loads(sys.argv[1])
ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
hit = carom.impact(pair, speed=2.0, angle="18 deg")
reach = np.array([[0.1, 0.2], [0.7, 0.5], [0.0, 1.0], [1.2, 0.3]]) * hit.max_radius
below = np.array([[0.1, 0.2, 0.0], [0.7, 0.5, 0.03], [0.0, 1.0, 0.4], [1.2, 0.3, 3.0]])
rng = np.random.default_rng(7)
normal = rng.uniform(1.0, 9.0, 40)
path = carom.load_path(
    pair, normal_force=normal, tangential_force=0.2 * normal * rng.uniform(-1.0, 1.0, 40)
)
aside = carom.load_path(pair, normal_force=normal[:5], displacement=rng.normal(0.0, 1e-7, (5, 2)))

def values(dataset, unit):
    return [(dataset[name] / unit[dataset[name].units]).values.ravel().tolist() for name in dataset]

scale = hit.scales
unit = {"Pa": scale.pressure, "m": scale.tangential_length, "m/s": 1.0, "N": scale.force, "s": 1.0}
unit["1"] = 1.0
print(json.dumps({
    "rebounds": [carom.rebound(*case) for case in cases],
    "histories": [carom.solve(*case).history(9).force.tolist() for case in cases[:4]],
    "memory": [carom.solve(*case).memory(2.0).q([0.01, 0.2, 0.5]).tolist() for case in cases[:4]],
    "worn": [carom.solve(*case).friction_work([0.0, 0.3, 0.82, 0.97]).ravel().tolist()
             for case in [*cases[:4], (9.0, 1.44)]],
    "pressed": [carom.solve(*cases[0]).pressed([0.0, 0.3, 0.82]).tolist()],
    "fields": [v for t in (0.3, 0.6, 0.8)
               for v in values(hit.fields(t * hit.duration, points=reach).drop_vars("zone"), unit)],
    "stress": [subsurface.stresses(below, hit.contact(t * hit.duration).profile, friction=0.2,
                                   poisson=0.3).tolist() for t in (0.6, 0.8)],
    "angles": [list(angle) for angle in hit.slip_angles],
    "path": values(path.to_dataset(), unit | {"J": scale.force * scale.tangential_length}),
    "turning": values(aside.to_dataset(), unit | {"J": scale.force * scale.tangential_length}),
    "slip": values(path.fields(points=reach).drop_vars("zone"), unit),
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
    compiled, plain = computed(), computed(CAROM_KERNELS="python")
    for name in compiled:
        for one, other in zip(compiled[name], plain[name], strict=True):
            assert np.allclose(one, other, rtol=0.0, atol=2e-13), name
    assert compiled["rebounds"] == [carom.rebound(*case) for case in CASES]
