r"""The normal impact
=================

A steel ball strikes a steel plate at a right angle: force, radius, speed and pressure.

The force rises and falls within :math:`2.943\,d_{max}/V_1`, at any speed. At first the radius
:math:`b` of the contact grows like a root, so that :math:`V_z = V_1 \sqrt{1 - c b^5}` is flat at
the touch.

Barber (1979), ZAMP 30:468, equations (1) to (5) and (9); Hertz (1882). The course in time is
checked by stepping the equation of motion with (2) and (3).
"""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import beta

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

BALL = carom.Sphere(radius="5 mm", material="steel")
PLATE = carom.HalfSpace(material="steel")


with style():
    hit = carom.impact(carom.Pair(BALL, PLATE, friction=0.2), normal_speed="1 m/s")
    history = hit.history(201)
    t, b, depth, speed, force = (
        history[name].values
        for name in ("time", "contact_radius", "penetration", "normal_velocity", "normal_force")
    )
    g, nu, radius, mass = BALL.material.shear_modulus, BALL.material.poisson, BALL.radius, BALL.mass

    def pressure_1(r, b):
        return 2 * g * np.sqrt(np.maximum(b**2 - r**2, 0)) / (np.pi * radius * (1 - nu))

    c = 16 * g / (15 * mass * radius**2 * hit.normal_speed**2 * (1 - nu))  # (5)
    force_2 = 4 * b**3 * g / (3 * radius * (1 - nu))
    speed_4 = np.sign(t[-1] / 2 - t) * hit.normal_speed * np.sqrt(np.maximum(1 - c * b**5, 0))
    np.testing.assert_allclose(force, force_2, rtol=1e-12, err_msg="(2)")
    np.testing.assert_allclose(depth, b**2 / radius, rtol=1e-12, err_msg="(3)")
    np.testing.assert_allclose(speed, speed_4, atol=1e-7, err_msg="(4)")
    duration = 0.8 * beta(0.4, 0.5) * hit.max_penetration / hit.normal_speed
    np.testing.assert_allclose(hit.duration, duration, rtol=1e-14, err_msg="duration")

    def motion(_, state):
        b = np.sqrt(max(state[0], 0) * radius)
        return [state[1], -4 * b**3 * g / (3 * radius * (1 - nu)) / mass]

    stepped = solve_ivp(motion, (0, t[-1]), [0, 1], "DOP853", t, rtol=1e-12, atol=1e-16).y
    error = np.abs(stepped[0] - depth).max() / hit.max_penetration
    assert error < 1e-10, f"penetration by stepping the motion differs by {error:.1e}"

    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=64)
    in_time = ((force / hit.max_force, "$F_z/P_{max}$"), (b / b.max(), "$b/b_{max}$"))
    for (values, name), color, dash in zip(
        (*in_time, (speed, "$V_z/V_1$")), LINES, DASHES, strict=False
    ):
        axes[0].plot(t * 1e6, values, color=color, ls=dash, label=name)
    axes[0].set(xlabel="$t$ (µs)", ylabel="share of its scale")
    axes[1].plot(b * 1e6, speed, color=LINES[0])
    axes[1].set(xlabel="$b$ (µm)", ylabel="$V_z$ (m/s)")
    for axis in axes[:2]:
        axis.axhline(0, color="0.5", lw=0.5)
    for share, color, dash in zip((0.05, 0.15, 0.3, 0.5), LINES, DASHES, strict=False):
        contact = hit.contact(share * hit.duration)
        rim = contact.radius * (1 - np.geomspace(1e-6, 0.1, 40))
        r = np.sort(np.append(np.linspace(0, b.max(), 201), rim))
        found = hit.fields(share * hit.duration, points=np.column_stack([r, 0 * r])).pressure
        np.testing.assert_allclose(
            found, pressure_1(r, contact.radius), atol=1e-12 * hit.max_pressure, err_msg="(1)"
        )
        inside = r <= contact.radius
        axes[2].plot(
            r[inside] * 1e6, found[inside] / 1e9, color=color, ls=dash, label=f"{share:g} $t_c$"
        )
    axes[2].set(xlabel="$r$ (µm)", ylabel="$p$ (GPa)")
    axes[2].set(xlim=(0, 255), xticks=[0, 100, 200], ylim=(0, 5))
    axes[1].set(xlim=(0, 255), xticks=[0, 100, 200])
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper left", ncols=3)
    for axis, title in zip(axes, ("in time", "speed and radius", "pressure"), strict=True):
        axis.set_title(title)
    axes[2].legend(loc="upper right", handlelength=1.8)
    save_figure(figure, "normal_impact.png")
    ratio = hit.duration * hit.normal_speed / hit.max_penetration
    print(f"(1)-(5) hold; duration {ratio:.4f} d_max/V_1; stepped motion differs by {error:.0e}")
