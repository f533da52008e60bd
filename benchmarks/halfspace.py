"""What an impact by boundary elements costs, beside the Fourier transforms that it cannot avoid.

python benchmarks/halfspace.py            16 to 128 elements across the contact, some minutes
python benchmarks/halfspace.py --smoke    a quick pass through the same code
"""

import argparse
import resource
import time

import numpy as np

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NO_SPIN, NormalSpin, move
from carom.halfspace.quasistatic import Patch
from carom.halfspace.transforms import Mirrors, Transform

PSI, CHI, KAPPA = 1.5, 1.4411764705882353, 0.8235294117647058  # steel on steel, all phases
LIKE, UNLIKE = Materials(KAPPA), Materials(KAPPA, beta=0.2, friction=0.3)
CASES = {
    "like": (LIKE, Mirrors(True, True), NO_SPIN),
    "like, spinning": (LIKE, Mirrors(True, False), NormalSpin(0.5, 0.01)),
    "unlike": (UNLIKE, Mirrors(False, True), NO_SPIN),
}
GRIDS = ((16, 75), (32, 150), (64, 300), (128, 600))
REPEATS = 200


def transform_seconds(transform: Transform) -> float:
    """Return the time of one transform, there and back on average."""
    field = np.random.default_rng(20261121).normal(size=transform.shape)
    best = np.inf
    for _ in range(REPEATS):
        start = time.perf_counter()
        transform.backward(transform.forward(field))
        best = min(best, time.perf_counter() - start)
    return 0.5 * float(best)


def measure(name: str, elements: int, steps: int) -> None:
    """Print what one impact costs."""
    materials, mirrors, spin = CASES[name]
    patch = Patch.across(elements, materials, mirrors)
    start = time.process_time()
    for count, now in enumerate(move(patch, np.array([PSI, 0.0]), CHI, steps, spin)):
        steps_done, psi_out = count, materials.kappa * float(now.velocity[0])
    whole = time.process_time() - start
    made = [(transform, transform.count) for transform in patch.compliance.transforms]
    bound = sum(count * transform_seconds(transform) for transform, count in made)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(
        f"{name:14s} {elements:4d} across, {steps_done:4d} steps: {whole:7.2f} s,"
        f" {1e3 * whole / steps_done:7.2f} ms a step, {made[0][1] / steps_done:5.0f}"
        f" padded transforms each; {whole / bound:4.1f} times the transforms alone;"
        f" psi_2 {psi_out:.6f}, memory so far {peak:.0f} MB",
        flush=True,
    )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    print(f"psi_1 = {PSI}, chi = {CHI:.4f}; the theory: psi_2 = {carom.rebound(PSI, CHI):.6f}")
    for name in CASES:
        grids = GRIDS if name == "like" else GRIDS[:3]  # unlike materials take ten times as long
        for elements, steps in GRIDS[:1] if smoke else grids:
            measure(name, elements, steps)


if __name__ == "__main__":
    main()
