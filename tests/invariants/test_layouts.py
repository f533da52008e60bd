"""Results do not depend on how the arrays of users lie in memory.

NumPy computes powers of contiguous numbers with other instructions than those of numbers that lie
apart, so the last digits may differ; more may not.
"""

import numpy as np
import pytest
from tests.checks import BALL, FLOOR

import carom

PAIR = carom.Pair(BALL, FLOOR, friction=0.3)
VISCOUS = carom.KelvinVoigt(restitution=0.8)
HIT = carom.impact(PAIR, speed=1.0, angle=0.6)
LAW, MIXTURE = carom.laws.ReboundLaw(1.44), carom.laws.ReboundLaw((1.2, 1.6))
rng = np.random.default_rng(4)
PSI, CHI = rng.uniform([[0.1], [0.8]], [[6.0], [2.0]], (6, 2, 8)).swapaxes(0, 1)
PLACES = 1e-4 * rng.uniform(-1.0, 1.0, (40, 3))
PLACES[:, 2] = abs(PLACES[:, 2])
SPEEDS, SPINS, NORMALS = rng.normal(size=(3, 30, 3))
NORMALS /= np.linalg.norm(NORMALS, axis=1)[:, None]
NORMALS *= np.sign(np.sum(NORMALS * SPEEDS, axis=1))[:, None]  # so that the bodies approach
ANGLES = np.linspace(0.1, 1.2, 6)
MOVED = 1e-7 * np.cumsum(rng.normal(size=(6, 2)), axis=0)
LOADS = rng.uniform(10.0, 20.0, 6)
BACK = np.array([0.8, 0.6, 0.55, 0.65, 0.8, 0.9])

LAYOUTS = {
    "columns first": np.asfortranarray,
    "strided": lambda a: np.repeat(a, 3, axis=0)[::3],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "part of a wider one": lambda a: np.pad(a, [(0, 0)] * (a.ndim - 1) + [(2, 3)])[..., 2:-3],
    "of another order of bytes": lambda a: a.astype(">f8"),
    "read-only": lambda a: np.broadcast_to(a, a.shape),
}
CALLS = {
    "rebound": lambda of: carom.rebound(of(PSI), of(CHI)),
    "rebound with losses": lambda of: carom.rebound(of(PSI), of(CHI), losses=VISCOUS),
    "law": lambda of: LAW(of(PSI)),
    "mixture": lambda of: MIXTURE(of(PSI), of(1.2 + 0.3 * (CHI - 0.8))),
    "contact law": lambda of: carom.dem.LammpsMindlin().rebound(of(PSI[0]), of(CHI[0]), steps=100),
    "memory law": lambda of: carom.dem.ExactContactLaw(springs=16).rebound(
        of(PSI[0]), 1.44, steps=50
    ),
    "fields": lambda of: HIT.fields(0.4 * HIT.duration, points=of(PLACES[:, :2])),
    "stress": lambda of: HIT.stress(0.4 * HIT.duration, points=of(PLACES)),
    "collide": lambda of: carom.collide(
        PAIR, velocity1=of(SPEEDS), spin1=of(SPINS), normal=of(NORMALS)
    ),
    "load path": lambda of: carom.load_path(
        PAIR, normal_force=of(LOADS), displacement=of(MOVED[:, 0])
    ),
    "path that turns": lambda of: carom.load_path(
        PAIR, normal_force=of(LOADS), displacement=of(MOVED)
    ),
    "wear": lambda of: carom.wear_of_many(PAIR, speed=of(1.0 + ANGLES), angle=of(ANGLES)),
    "curve": lambda of: carom.curve(1.44, of(PSI[0])),
    "score": lambda of: carom.verify.score(
        {"psi_1": of(PSI[0]), "psi_2": of(0.5 - PSI[0])}, chi=1.44, code="own"
    ),
    "fit": lambda of: (
        carom.fit(
            {"angle": of(ANGLES), "tangential_restitution": of(BACK)}, pair=PAIR, vary="friction"
        )
        .estimates["friction"]
        .value
    ),
}


def arrays(result):
    """The numbers of a result."""
    dataset = result.to_dataset() if hasattr(result, "to_dataset") else result
    if hasattr(dataset, "data_vars"):
        return [each.values for each in dataset.data_vars.values() if each.dtype.kind == "f"]
    parts = dataset if isinstance(dataset, tuple) else (dataset,)
    return [np.asarray(each) for each in parts if np.asarray(each).dtype.kind == "f"]


@pytest.mark.first_case
@pytest.mark.parametrize("call", CALLS)
def test_of_any_layout(call):
    plain = arrays(CALLS[call](np.ascontiguousarray))
    for name, layout in LAYOUTS.items():
        other = arrays(CALLS[call](layout))
        assert len(plain) == len(other) > 0
        for expected, value in zip(plain, other, strict=True):
            size = np.abs(expected).max(initial=0.0)
            np.testing.assert_allclose(value, expected, rtol=1e-13, atol=1e-14 * size, err_msg=name)
