"""While uploads never end and hundreds of connections dawdle, the page answers its other visitors.

How much slower it does is measured by benchmarks/explorer_attack.py, whose attacks these are.
"""

import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

pytest.importorskip("flask")

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from explorer import Page
from explorer_attack import attacked, served

PATIENCE = 30.0  # s, of each answer: nothing hangs, on a machine that is busy as well


@pytest.mark.slow
def test_a_page_under_attack_answers():
    with served() as url, attacked(url, "all at once"):
        time.sleep(3.0)
        for angle in (20, 40, 60):
            with closing(Page(url, PATIENCE)) as page:
                assert page.verdict(f"angle={angle}")
            time.sleep(0.5)
