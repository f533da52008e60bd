"""What an impact by boundary elements costs, beside the Fourier transforms that it cannot avoid.

python benchmarks/halfspace.py            16 to 128 elements across the contact, a few minutes
python benchmarks/halfspace.py --smoke    a quick pass through the same code
"""

import argparse
import resource
import time

import numpy as np
import scipy.fft

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import move
from carom.halfspace.quasistatic import Patch

PSI, CHI, KAPPA = 1.5, 1.4411764705882353, 0.8235294117647058  # steel on steel, all phases
PAIRS = {"like": Materials(KAPPA), "unlike": Materials(KAPPA, beta=0.2, friction=0.3)}
GRIDS = ((16, 75), (32, 150), (64, 300), (128, 600))
REPEATS = 200


def transform_seconds(size: int) -> float:
    """Return the time of one real transform of a square field, there and back on average."""
    field = np.random.default_rng(20261121).normal(size=(size, size))
    best = np.inf
    for _ in range(REPEATS):
        start = time.perf_counter()
        scipy.fft.irfft2(scipy.fft.rfft2(field), field.shape)
        best = min(best, time.perf_counter() - start)
    return 0.5 * float(best)


def measure(name: str, materials: Materials, elements: int, steps: int) -> None:
    """Print what one impact costs."""
    patch = Patch.across(elements, materials)
    start = time.process_time()
    for count, now in enumerate(move(patch, np.array([PSI, 0.0]), CHI, steps)):
        steps_done, psi_out = count, materials.kappa * float(now.velocity[0])
    whole = time.process_time() - start
    surface = patch.compliance
    bound = surface.transforms * transform_seconds(
        2 * surface.size
    ) + surface.rough_transforms * transform_seconds(surface.size)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(
        f"{name:6s} {elements:4d} across, {steps_done:4d} steps: {whole:7.2f} s,"
        f" {1e3 * whole / steps_done:7.2f} ms a step, {surface.transforms / steps_done:5.0f}"
        f" transforms of {2 * surface.size}^2 each; {whole / bound:4.1f} times their time alone;"
        f" psi_2 {psi_out:.6f}, memory so far {peak:.0f} MB",
        flush=True,
    )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    print(f"psi_1 = {PSI}, chi = {CHI:.4f}; the theory: psi_2 = {carom.rebound(PSI, CHI):.6f}")
    for name, materials in PAIRS.items():
        grids = GRIDS if name == "like" else GRIDS[:3]  # unlike materials take five times as long
        for elements, steps in GRIDS[:1] if smoke else grids:
            measure(name, materials, elements, steps)


if __name__ == "__main__":
    main()
