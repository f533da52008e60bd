"""What the exact contact law costs per contact and step, in times of a bare Hertz-Mindlin force.

python benchmarks/contact_law.py            with the vectors of this processor, AVX2 and SSE2
python benchmarks/contact_law.py --smoke    a quick pass through the same code

Needs a C++ compiler.
"""

import argparse
import shutil
import subprocess
from pathlib import Path
from tempfile import TemporaryDirectory

import carom

SOURCE = Path(__file__).with_suffix(".cpp")
FAST = ("-O3", "-fno-math-errno")
VECTORS = {"this processor": ("-march=native",), "AVX2": ("-mavx2", "-mfma"), "SSE2": ()}


def times(folder: Path, options: tuple[str, ...]) -> dict[str, float]:
    """Return ns per contact and step, by kind of contact."""
    program = folder / "contact_law"
    include = f"-I{carom.get_include()}"
    command = ["c++", "-std=c++17", *FAST, *options, include, str(SOURCE), "-o", str(program)]
    subprocess.run(command, check=True)
    ran = subprocess.run([str(program)], capture_output=True, text=True, check=True)
    rows = (line.split() for line in ran.stdout.splitlines())
    return {name: float(value) for name, value in rows}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    if shutil.which("c++") is None:
        print("skipped: no C++ compiler")
        return
    with TemporaryDirectory() as folder:
        for name, options in list(VECTORS.items())[: 1 if smoke else None]:
            found = times(Path(folder), options)
            unit = found.pop("mindlin")
            told = ", ".join(f"{kind}: {value / unit:.1f}" for kind, value in found.items())
            print(f"{name:15s} Hertz-Mindlin {unit:.0f} ns; springs {told}")


if __name__ == "__main__":
    main()
