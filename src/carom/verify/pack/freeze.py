"""Making the frozen numbers anew: python -m carom.verify.pack.freeze src/carom/data/benchmarks/pack

For a new version of the pack only; tests compare what is frozen with what is computed.
"""

import sys
from pathlib import Path

from carom.verify.pack.references import references


def freeze(folder: Path) -> list[Path]:
    """Write every table of reference numbers below a folder and return the paths."""
    paths = []
    for name, table in references().items():
        path = folder / name
        path.write_text(table.as_csv(), encoding="utf-8", newline="\n")
        paths.append(path)
    return paths


if __name__ == "__main__":
    print(*freeze(Path(sys.argv[1])), sep="\n")
