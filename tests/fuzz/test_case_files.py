"""Case files, mutated: a case whose bodies and motion are numbers, or one line."""

from math import isfinite
from pathlib import Path

import pytest

from carom.bodies.cases import losses_of, motion_of, pair_of, read_case
from carom.bodies.kinematics import approach
from carom.bodies.plausibility import doubts_of_case
from carom.many.sweeps.tables import plan

EXAMPLES = Path(__file__).parents[2] / "examples"
TEXTS = [path.read_text(encoding="utf-8") for path in sorted(EXAMPLES.glob("*.toml"))]


@pytest.mark.parametrize("text", TEXTS)
def test_case_files(calls, tmp_path, mutated, answered, text):
    def read(text):
        path = tmp_path / "case.toml"
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        case = read_case(path, losses=True)
        doubts_of_case(case)
        if "sweep" in case:
            plan(case, path)
            return
        pair, motion = pair_of(case), motion_of(case)
        losses_of(case)
        assert isfinite(pair.chi)
        names = ("speed", "angle", "normal_speed", "tangential_speed")
        assert all(map(isfinite, approach(*(motion.get(name) for name in names))))

    assert answered(read, text)
    total = sum(answered(read, mutated(text)) for _ in range(calls // 4))
    assert 0 < total < calls // 4
