r"""One more ring of contact in stick
=================================

What one more ring of contact adds while the patch sticks: the traction under a rigid punch.

When the contact grows by :math:`db`, the traction grows at every radius, as under a rigid punch:
:math:`g(b)/\sqrt{b^2 - r^2}`. This moves the surface by the same amount everywhere within the
contact, and not at all sideways, so that nothing slips. Circles: differences of whole fields.

Barber (1979), ZAMP 30:468, equations (7) to (10).
"""

import numpy as np

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

BLUE, VERMILION, GREEN, _, BLACK = LINES
BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
G, NU, R, MU = BALL.material.shear_modulus, BALL.material.poisson, BALL.radius, PAIR.friction


def rates(hit, time, points, step=1e-4):
    """Rates of traction and displacement in stick, by central differences in time."""
    early, late = (hit.fields(time * (1 + side * step), points=points) for side in (-1, 1))
    change = (late - early) / (2 * step * time)
    return change.traction_x.values, change.displacement_x.values, change.displacement_y.values


with style():
    hit = carom.impact(PAIR, speed="1 m/s", angle="8 deg")
    stick = hit.phases[0]
    assert stick.kind == "stick"
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=58)
    worst = 0.0
    for share, color, dash in zip((0.4, 0.65, 0.9), (BLUE, VERMILION, GREEN), DASHES, strict=False):
        time = share * stick.end
        contact = hit.contact(time)
        b = contact.radius
        state = hit.solution.at(time / hit.scales.time)
        speed = state.speed[0] * hit.normal_speed
        velocity = state.psi[0] * hit.scales.tangential_speed
        growth = R * speed / (2 * b)  # (9) with (4)
        g = contact.profile.g[-1].sum()  # at the edge
        r = b * np.linspace(0, 0.98, 50)
        theta = np.pi * (3 - np.sqrt(5)) * np.arange(50)
        points = np.column_stack([r * np.cos(theta), r * np.sin(theta)])
        by_7 = 2 * G * MU * b * g * growth / (np.pi * R * (1 - NU) * np.sqrt(b**2 - r**2))
        by_8 = (2 - NU) * MU * b * g * growth / (R * (1 - NU))
        by_10 = (2 - NU) * MU * g * speed / (2 * (1 - NU))
        traction, along, across = rates(hit, time, points)
        np.testing.assert_allclose(traction, by_7, rtol=2e-4, err_msg="(7)")
        np.testing.assert_allclose(across, 0, atol=1e-6 * abs(velocity), err_msg="(8)")
        worst = max(worst, *np.abs([*(along - by_8), by_10 - velocity]) / abs(velocity))
        fine = b * np.linspace(0, 0.985, 200)
        shape = by_7[0] * b / np.sqrt(b**2 - fine**2)
        micro = 1e6
        axes[0].plot(fine * micro, shape / 1e12, color=color, ls=dash)
        marks = {"mfc": "white", "mec": color, "mew": 0.8}
        axes[0].plot(r[::4] * micro, traction[::4] / 1e12, "o", **marks)
        at = f"{time * micro:.1f} µs"
        axes[1].plot(fine * micro, 0 * fine + by_8, color=color, ls=dash, label=at)
        axes[1].plot(r[::4] * micro, along[::4], "o", **marks)
    assert worst < 1e-6, f"(8), (10): the patch does not move as a whole, {worst:.1e}"
    axes[0].plot([], [], color=BLACK, label="(7), as under a punch")
    axes[0].plot([], [], "o", **{**marks, "mec": BLACK}, label="differences of fields")
    axes[0].legend(loc="upper left", bbox_to_anchor=(0, 0.9))
    for axis in axes:
        axis.axhline(0, color="0.5", lw=0.5)
        axis.set(xlim=(0, None), xlabel="$r$ (µm)")
    axes[0].set(title="growth of the traction", ylabel=r"$\partial f_x/\partial t$ (MPa/µs)")
    axes[1].set(title="velocity of the surface", ylabel=r"$\partial u_x/\partial t$ (m/s)")
    axes[1].legend(title="time since the first touch", loc="upper right", bbox_to_anchor=(1, 0.9))
    save_figure(figure, "stick_rates.png")
    print(f"(7) holds; du_x/dt = V_x all over the patch, (8) and (10), within {worst:.0e}")
