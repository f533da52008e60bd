"""Loops of a swinging force
=========================

A tangential force that swings at constant normal force: its loops, and the energy of each loop.

The first push of the force :math:`F_x`, with the displacement :math:`U`, runs along the curve of
Cattaneo and Mindlin. Every later swing is that curve, twice as large in both directions, so the
loop closes at once. For small amplitudes the energy per cycle goes with their third power: what
slips is a thin ring, and it slips little.

Mindlin & Deresiewicz (1953), J. Appl. Mech. 20:327; Johnson (1985), section 7.4.
"""

from pathlib import Path

import numpy as np

import carom
from carom.classical import loop_energy
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
LOAD = 10.0
MOST = PAIR.friction * LOAD
N = 100
SHARES = (0.3, 0.6, 0.9, 1.0)


def swing(amplitude, n=N):
    """A push to the amplitude and one whole cycle, in steps that are small where it turns."""
    half = amplitude * np.cos(np.linspace(0, np.pi, n))
    return np.concatenate([amplitude * np.sin(np.linspace(0, np.pi / 2, n)), half, half[::-1]])


def energy_in_closed_form(share, a):
    """Return the energy by Johnson, section 7.4, with 4/G* for (2 - nu)/G of both bodies."""
    bracket = 1 - (1 - share) ** (5 / 3) - 5 / 6 * share * (1 + (1 - share) ** (2 / 3))
    return 18 * MOST**2 / (5 * a * PAIR.effective_shear_modulus) * bracket


@styled
def main(folder: str | Path = ".") -> str:
    """Check the doubling rule, the closing of loops and their energy; draw loops and energy."""
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=62)
    worst = 0.0
    for share, color, dash in zip(SHARES, LINES, DASHES, strict=False):
        force = swing(share * MOST)
        path = carom.load_path(PAIR, normal_force=LOAD, tangential_force=force)
        moved, a = path.displacement, path.contact_radius[0]
        unit = 3 * MOST / (4 * a * PAIR.effective_shear_modulus)
        first, down = slice(0, N), slice(N, 2 * N)
        np.testing.assert_allclose(
            moved[first], unit * (1 - (1 - force[first] / MOST) ** (2 / 3)), atol=1e-10 * unit
        )
        drop = (share - force[down] / MOST) / 2
        doubled = moved[N - 1] - 2 * unit * (1 - np.maximum(1 - drop, 0) ** (2 / 3))
        np.testing.assert_allclose(moved[down], doubled, atol=1e-10 * unit, err_msg="doubling")
        np.testing.assert_allclose(
            moved[-1], moved[N - 1], atol=1e-10 * unit, err_msg="loop closes"
        )
        lost = path.frictional_work[-1] - path.frictional_work[N - 1]
        area = np.trapezoid(force[N:], moved[N:])
        np.testing.assert_allclose(area, lost, rtol=2e-3, err_msg="area of the loop")
        worst = max(worst, abs(lost / energy_in_closed_form(share, a) - 1))
        axes[0].plot(moved * 1e9, force, color=color, ls=dash, label=f"{share:g}")
        axes[1].plot(share, lost * 1e9, "o", color=color)
    assert worst < 1e-9, f"energy per cycle differs by {worst:.1e}"
    share = np.geomspace(0.02, 1, 200)
    lost = loop_energy(PAIR, LOAD, share * MOST)
    np.testing.assert_allclose(lost[100:], energy_in_closed_form(share[100:], a), rtol=1e-9)
    thin = MOST**2 / (9 * a * PAIR.effective_shear_modulus) * share**3
    np.testing.assert_allclose(lost[0], thin[0], rtol=0.05, err_msg="third power")
    axes[1].loglog(share, lost * 1e9, color="black", label="closed form")
    axes[1].loglog(share, thin * 1e9, color="0.5", ls=DASHES[1], lw=0.8, label="third power")
    axes[0].axhline(0, color="0.5", lw=0.5)
    axes[0].set(xlabel="$U$ (nm)", ylabel="$F_x$ (N)")
    axes[1].set(xlabel=r"$F_x/\mu F_z$", ylabel="energy per cycle (nJ)")
    axes[0].legend(title=r"$F_x/\mu F_z$", loc="upper left")
    axes[1].legend(loc="upper left")
    save_figure(figure, Path(folder) / "hysteresis_loops.png")
    return f"loops close, swings are doubled pushes; energy per cycle within {worst:.0e}"


if __name__ == "__main__":
    print(main())
