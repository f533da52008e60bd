"""Time of the strict reader: texts of quantities, and tables beside pandas; prints ratios.

python benchmarks/reading.py            some 20 s
python benchmarks/reading.py --smoke    a quick pass through the same code
"""

import argparse
import gc
import random
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
import pandas as pd

from carom.io.tables import read_table
from carom.quantities.texts import LONGEST_TEXT, Unreadable, read_text

SEED = 20261122
LETTERS = "0123456789.+-eE*/^ ·°%µ²⁻mskgNPadrinfGx_,;'"
USUAL = ("5 mm", "210 GPa", "2 m/s", "600 rpm", "30 deg", "7850 kg/m^3", "20 %", "0.2")


def seconds(work: Callable[[], object]) -> float:
    """Return the time of some work."""
    start = time.process_time()
    work()
    return time.process_time() - start


def attempt(text: str) -> None:
    """Read a text that may be none."""
    with suppress(Unreadable):
        read_text(text, "m")


def measure_texts(count: int) -> None:
    """Print the time of usual texts, and the longest of hostile ones up to the limit."""
    rng = random.Random(SEED)
    hostile = [
        rng.choice(("", "5 ", "5 m"))
        + "".join(rng.choices(LETTERS, k=rng.randrange(LONGEST_TEXT - 2)))
        for _ in range(count)
    ]
    attempt("5 mm")  # the first use loads the definitions of units
    usual = min(seconds(lambda: [read_text(text, _unit(text)) for text in USUAL]) for _ in range(5))
    gc.disable()  # a collection takes longer than any text
    times = np.array([seconds(lambda text=text: attempt(text)) for text in hostile])
    print(f"a usual text                  {usual / len(USUAL) * 1e6:8.1f} us")
    gc.enable()
    shown = f"{np.median(times) * 1e6:8.1f} us, {np.quantile(times, 0.999) * 1e6:.1f} us"
    print(f"a hostile text, median, 99.9 % {shown}, longest {times.max() * 1e3:.2f} ms")


def _unit(text: str) -> str:
    units = {"GPa": "Pa", "m/s": "m/s", "rpm": "rad/s", "deg": "rad", "m^3": "kg/m^3", "mm": "m"}
    return next((si for end, si in units.items() if text.endswith(end)), "1")


def measure_tables(rows: int) -> None:
    """Print the time of a table of three columns beside pandas, which checks less."""
    values = np.random.default_rng(SEED).random((rows, 3))
    frame = pd.DataFrame(values, columns=["psi_1", "psi_2", "chi"])
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "table.csv"
        frame.to_csv(file, index=False, float_format="%.6f")
        pairs = [
            (seconds(lambda: read_table(file)), seconds(lambda: pd.read_csv(file)))
            for _ in range(3)
        ]
    own, other = np.median(np.array(pairs), axis=0)
    print(f"a table of {rows} rows  {own:8.2f} s, {own / other:.1f} times pandas' read_csv")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    measure_texts(100 if smoke else 20_000)
    measure_tables(1000 if smoke else 1_000_000)


if __name__ == "__main__":
    main()
