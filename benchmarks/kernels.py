"""The compiled library beside numba in one process: time of impacts and collisions, as ratios.

python benchmarks/kernels.py            a minute
python benchmarks/kernels.py --smoke    a quick pass through the same code
"""

import argparse
import time
from collections.abc import Callable

import numpy as np

import carom
from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.kernels import ENTRIES

SEED = 20


def works(count: int) -> dict[str, Callable[[], object]]:
    """Return what is timed: many at once on one core, and one at a time."""
    rng = np.random.default_rng(SEED)
    psi, chi = rng.uniform(0.0, 6.0, count), rng.uniform(0.5, 2.0, count)
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    velocity = rng.normal(size=(10 * count, 3))
    normal = rng.normal(size=velocity.shape)
    normal /= np.linalg.norm(normal, axis=1)[:, np.newaxis]
    few, lossy = slice(0, max(1, count // 20)), carom.KelvinVoigt(restitution=0.9)
    law, one = carom.dem.LammpsMindlin(), {"velocity1": velocity[:1], "normal": normal[:1]}
    return {
        "impacts": lambda: carom.rebound(psi, chi, threads=1),
        "impacts with losses": lambda: carom.rebound(psi[few], chi[few], losses=lossy, threads=1),
        "collisions": lambda: carom.collide(pair, velocity1=velocity, normal=normal, threads=1),
        "a contact law of a DEM code": lambda: law.rebound(psi[few], 1.44, threads=1),
        "one rebound": lambda: [carom.rebound(1.5, 1.44) for _ in range(count // 100)],
        "one solution": lambda: [carom.solve(1.5, 1.44) for _ in range(count // 400)],
        "one collision": lambda: [carom.collide(pair, **one) for _ in range(count // 100)],
    }


def use(by_library: bool) -> None:
    """Let all kernels run in one way from now on."""
    for kernel in ENTRIES:
        found = shared_library.function(kernel.signatures(), kernel.floats) if by_library else None
        kernel.__dict__["compiled"] = found or kernel.dispatcher


def seconds(work: Callable[[], object], by_library: bool) -> float:
    """Return the CPU time of some work."""
    use(by_library)
    start = time.process_time()
    work()
    return time.process_time() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="few impacts, once")
    count, repeats = (400, 1) if parser.parse_args().smoke else (20_000, 9)
    if shared_library.reason():
        print(f"nothing to compare: {shared_library.reason()}")
        return
    for name, work in works(count).items():
        pairs = [(seconds(work, True), seconds(work, False)) for _ in range(repeats + 1)][1:]
        ratio = np.median([ours / numbas for ours, numbas in pairs])
        ours, numbas = np.min(pairs, axis=0)
        print(
            f"{name:28s} {1e3 * ours:8.2f} ms by the library, {1e3 * numbas:8.2f} ms by numba, "
            f"ratio {ratio:.2f}"
        )


if __name__ == "__main__":
    main()
