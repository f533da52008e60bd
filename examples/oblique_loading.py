r"""Loading in a constant direction
===============================

A sphere is pressed and pushed at once in a constant direction: below a critical angle it sticks.

Up to :math:`F_x = \mu F_z`, or :math:`U/d = \mu/\kappa`, the whole contact sticks with a constant
:math:`g`, and unloading goes back along the same line. Beyond, the whole contact slides, and the
way back differs. An impact with :math:`\chi = 1/2` moves along such a line, :math:`U = \psi_1 d` in
dimensionless form, and therefore sticks to the last.

Mindlin & Deresiewicz (1953), J. Appl. Mech. 20:327; Barber (1979), ZAMP 30:468, (36), (37).
"""

import numpy as np

import carom
from carom.classical import critical_obliquity
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
DEEPEST = 1e-6
RATIOS = (0.4, 0.8, 1.2)  # of the critical obliquity


def path_at(ratio, n=80):
    """Go in and out along a line U = ratio (mu/kappa) d."""
    d = DEEPEST * np.concatenate([np.linspace(0, 1, n)[1:], np.linspace(1, 0, n)[1:-1]])
    moved = ratio * np.tan(critical_obliquity(PAIR).displacement) * d
    return carom.load_path(PAIR, penetration=d, displacement=moved)


with style():
    np.testing.assert_allclose(np.tan(critical_obliquity(PAIR).force), PAIR.friction, rtol=1e-14)
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=60)
    top = 78
    worst = 0.0
    for ratio, color, dash in zip(RATIOS, LINES, DASHES, strict=False):
        path = path_at(ratio)
        limit = PAIR.friction * path.normal_force
        unit = limit.max()
        going_in = slice(0, top + 1)
        expected = min(ratio, 1.0) * limit
        worst = max(worst, np.abs(path.tangential_force - expected)[going_in].max() / unit)
        sticks = path.stick_radius[going_in] / path.contact_radius[going_in]
        np.testing.assert_array_equal(sticks, 1.0 if ratio < 1 else 0.0)
        if ratio < 1:
            np.testing.assert_allclose(path.tangential_force, expected, atol=1e-10 * unit)
            assert path.frictional_work[-1] < 1e-9 * unit * path.displacement.max()
        r = np.linspace(0, path.contact_radius[top], 300)
        patch = path.fields(top, points=np.column_stack([r, 0 * r]))
        traction = patch.traction_x / (PAIR.friction * patch.pressure[0])
        profile = min(ratio, 1.0) * np.sqrt(np.maximum(1 - (r / r[-1]) ** 2, 0))
        np.testing.assert_allclose(traction[:-1], profile[:-1], atol=1e-7)
        drawn = going_in if ratio < 1 else slice(None)  # dashes on dashes would look solid
        axes[0].plot(path.normal_force[drawn], path.tangential_force[drawn], color=color, ls=dash)
        axes[1].plot(r * 1e6, traction, color=color, ls=dash, label=f"{ratio:g} of the critical")
    assert worst < 1e-10, f"F_x differs by {worst:.1e} of mu P"
    impact = carom.solve(0.8, 0.5).history(200)
    np.testing.assert_allclose(impact.displacement, 0.8 * impact.penetration, atol=1e-10)
    normal = np.array([0, path.normal_force.max()])
    for side in (-1, 1):
        axes[0].plot(normal, side * PAIR.friction * normal, color="0.6", lw=0.6, zorder=0)
    axes[0].text(normal[1] / 2, 1.25 * PAIR.friction * normal[1] / 2, r"$+\mu F_z$", ha="right")
    axes[0].text(normal[1] / 2, -1.25 * PAIR.friction * normal[1] / 2, r"$-\mu F_z$", ha="right")
    axes[0].set_xlim(0, None)
    axes[0].axhline(0, color="0.5", lw=0.5)
    axes[0].set(title="forces", xlabel="$F_z$ (N)", ylabel="$F_x$ (N)")
    axes[1].set(xlim=(0, None), ylim=(0, 1.4), xlabel="$r$ (µm)")
    axes[1].set(title="traction on the largest contact", ylabel=r"$f_x/\mu p_0$")
    axes[1].legend(title="obliquity", alignment="left")
    save_figure(figure, "oblique_loading.png")
    print(f"sticks below, slides beyond the critical angle; F_x within {worst:.0e} of mu P")
