r"""Find the stress below the surface
=================================

`hit.stress` gives all stresses below the contact at an instant, `hit.peaks` the largest of all.

Without friction the largest shear stress lies at a depth of :math:`0.48\,b`. Friction moves the
largest stress up, from :math:`\mu = 0.3` or so to the surface, and stretches the surface behind the
contact. In an impact the middle still pulls forward while the edge already slips back; the stress
has a cusp between them.

Huber (1904) on the axis, Hamilton (1983) in sliding; Johnson (1985), sections 3.4 and 7.1.
"""

import numpy as np
from matplotlib.patheffects import withStroke

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, MAP, new_figure, save_figure, style

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.4)
hit = carom.impact(pair, normal_speed="1 m/s", tangential_speed="0.5 m/s")
now = hit.stress(0.6 * hit.duration)
print(f"now {now.max_von_mises / 1e9:.2f} GPa, {1e6 * now.max_von_mises_z:.0f} um deep", end=", ")
print(f"in the whole impact {hit.peaks().sel(body='second').peak_von_mises / 1e9:.2f} GPa")

# %%
# The stress below a patch in Hertz's contact, in a sliding one, and in the middle of an impact.

BLUE, VERMILION, _, _, BLACK = LINES
LEVELS = np.linspace(0, 0.8, 17)
NU = ball.material.poisson


def on_axis(z):
    """sigma_xx and sigma_zz over p_0 at a depth z/a under Hertz's pressure."""
    steep = 1 / (1 + z**2)
    turn = np.arctan2(1, z)
    return -(1 + NU) * (1 - z * turn) + 0.5 * steep, -steep


def draw_map(axis, stress, peak):
    """Draw the von Mises stress, and mark the largest in the whole body."""
    a = float(stress.contact_radius)
    x, z, values = stress.x.values / a, stress.z.values / a, stress.von_mises / peak
    shading = axis.contourf(x, z, values, LEVELS, cmap=MAP, extend="max")
    axis.contour(x, z, values, LEVELS, colors="white", linewidths=0.3)
    place = [float(stress[f"max_von_mises_{name}"]) / a for name in "xz"]
    (mark,) = axis.plot(*place, "+", color="black", ms=7, mew=1.2, clip_on=False, zorder=5)
    mark.set_path_effects([withStroke(linewidth=2.6, foreground="white")])
    axis.plot([-1, 1], [0, 0], color="black", lw=3, clip_on=False, solid_capstyle="butt")
    axis.set(xlim=(-1.8, 1.8), ylim=(1.4, 0), aspect="equal", xlabel="$x/b$", ylabel="$z/b$")
    return shading


def struck(friction, velocity):
    """A ball that comes in at 1 m/s and with a velocity along the surface."""
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction)
    return carom.impact(pair, normal_speed="1 m/s", tangential_speed=velocity)


def below(hit, time):
    """The stress in the plane y = 0."""
    b = hit.contact(time).radius
    return hit.stress(
        time, x=np.linspace(-1.8, 1.8, 121) * b, z=1.4 * np.linspace(0, 1, 36) ** 2 * b
    )


with style():
    rest, rubbed, gripped = struck(0.0, 0.0), struck(0.4, 10.0), struck(0.4, 0.5)
    half, b, peak = rest.duration / 2, rest.max_radius, rest.max_pressure
    z = np.linspace(0, 2, 101)
    under = rest.stress(half, points=np.column_stack([0 * z, 0 * z, z * b]))
    along, down = on_axis(z)
    error = np.abs([under.sigma_xx / peak - along, under.sigma_zz / peak - down]).max()
    assert error < 1e-9, f"on the axis: differs from Huber's by {error:.1e} of p_0"
    shear = under.max_shear.values / peak
    assert abs(shear.max() - 0.31) < 0.001, "largest shear 0.31 p_0 (Johnson)"
    assert abs(z[shear.argmax()] - 0.48) < 0.02, "at a depth of 0.48 b (Johnson)"
    slides = below(rubbed, half)
    tension = (1 - 2 * NU) / 3 + np.pi * 0.4 * (4 + NU) / 8  # Hamilton & Goodman
    np.testing.assert_allclose(slides.max_tension / peak, tension, rtol=1e-9)
    np.testing.assert_allclose(slides.max_tension_x, -b, rtol=1e-9, err_msg="behind the contact")
    slip = next(phase for phase in gripped.phases if phase.kind == "slip")
    turns = below(gripped, 0.5 * (slip.start + slip.end))
    now = turns.contact_radius * 2 * ball.material.shear_modulus / (np.pi * ball.radius * (1 - NU))

    figure, axes = new_figure(2, 2, width=DOUBLE, height=94)
    axes[0, 0].plot(-along, z, color=BLUE, label=r"$-\sigma_{xx}$")
    axes[0, 0].plot(-down, z, color=VERMILION, ls=DASHES[1], label=r"$-\sigma_{zz}$")
    axes[0, 0].plot(shear, z, color=BLACK, ls=DASHES[2], label=r"$\tau_{max}$")
    axes[0, 0].plot(0.31, 0.48, "+", color=BLACK, ms=7)
    axes[0, 0].set(title="no friction, on the axis", xlim=(0, 1.02), ylim=(2, 0), ylabel="$z/b$")
    axes[0, 0].set_xlabel("stress at rest, over $p_0$")
    axes[0, 0].legend(loc="lower right")
    maps = {
        "no friction": (below(rest, half), peak),
        r"sliding, $\mu = 0.4$": (slides, peak),
        r"slip ring, $\mu = 0.4$": (turns, float(now)),
    }
    for axis, (title, (stress, p_0)) in zip(axes.flat[1:], maps.items(), strict=True):
        shading = draw_map(axis, stress, p_0)
        axis.set_title(f"{title}: {float(stress.max_von_mises) / p_0:.2f} $p_0$ at +", pad=7)
    figure.colorbar(shading, ax=axes[:, 1], label=r"von Mises stress, $\sigma_{vM}/p_0$", aspect=40)
    save_figure(figure, "stress_below.png")
    print(f"axis within {error:.0e} of p_0; tension behind sliding {tension:.3f} p_0 exact")
