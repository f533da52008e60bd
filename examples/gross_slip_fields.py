r"""A patch that slides as a whole
==============================

A patch that slides as a whole: its traction, and the displacements of the surface under it.

The traction is :math:`\mu p`. The displacement :math:`u_x` falls off from the centre, more slowly
along the motion than across it. The displacement :math:`u_y` has four lobes and does not change
while the contact grows, so that all points slip exactly along :math:`x`. As the patch grows,
:math:`\partial u_x/\partial t` is the same everywhere: slip can only stop at all points at once.

Barber (1979), ZAMP 30:468, equations (28) to (30).
"""

import numpy as np
from matplotlib.patches import Circle
from matplotlib.ticker import MaxNLocator

import carom
from carom.plots.style import BLUE, DASHES, DOUBLE, MAP, VERMILION, new_figure, save_figure, style

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
G, NU, R, MU = BALL.material.shear_modulus, BALL.material.poisson, BALL.radius, PAIR.friction


def traction_28(r, b):
    """Return the traction of gross slip, (28)."""
    return 2 * G * MU * np.sqrt(np.maximum(b**2 - r**2, 0)) / (np.pi * R * (1 - NU))


def displacement_29(x, y, b):
    """Return the combined displacements along x and y in the contact, (29)."""
    r2, theta = x**2 + y**2, np.arctan2(y, x)
    unit = MU / (8 * R * (1 - NU))
    along = unit * (2 * (2 - NU) * (2 * b**2 - r2) + NU * r2 * np.cos(2 * theta))
    return along, unit * NU * r2 * np.sin(2 * theta)


with style():
    hit = carom.impact(PAIR, speed="2 m/s", angle="45 deg")
    assert hit.phases[0].kind == "gross slip"
    time = 0.5 * hit.phases[0].end
    b = hit.contact(time).radius
    line = np.linspace(-1.04 * b, 1.04 * b, 121)
    patch = hit.fields(time, line, line)
    x, y = np.meshgrid(line, line)
    inside = np.hypot(x, y) < 0.999 * b  # rounding of b moves the rim
    largest = float(patch.traction_x.max())
    traction = traction_28(np.hypot(x, y), b)
    errors = [np.abs(patch.traction_x - traction).values[inside].max() / largest]
    wide = float(patch.displacement_x.max())
    for name, formula in zip("xy", displacement_29(x, y, b), strict=True):
        errors.append(np.abs(patch[f"displacement_{name}"] - formula).values[inside].max() / wide)
    step = 1e-4 * time
    ends = [hit.fields(time + side * step, line, line) for side in (-1, 1)]
    rates = [np.asarray((ends[1] - ends[0])[f"displacement_{n}"])[inside] / 2 / step for n in "xy"]
    growth = (hit.contact(time + step).radius - hit.contact(time - step).radius) / (2 * step)
    rate_30 = MU * (2 - NU) * b / (R * (1 - NU)) * growth
    assert max(errors) < 1e-12, f"(28), (29): differences {errors}"
    np.testing.assert_allclose(rates[0], rate_30, rtol=1e-6, err_msg="(30)")
    np.testing.assert_allclose(rates[1], 0, atol=1e-8 * rate_30, err_msg="(30)")

    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=60, width_ratios=(1.1, 1, 1))
    micro = 1e6
    middle = line.size // 2
    along, across = patch.isel(y=middle), patch.isel(x=middle)
    within = b * np.sin(np.linspace(-np.pi / 2, np.pi / 2, 121))
    rubs = hit.fields(time, points=np.column_stack([within, 0 * within])).traction_x / largest
    axes[0].plot(within * micro, rubs, color="black", label=r"$f_x/\mu p_0$")
    axes[0].plot(
        line * micro, along.displacement_x / wide, color=BLUE, ls=DASHES[1], label="$u_x$, $y = 0$"
    )
    axes[0].plot(
        line * micro,
        across.displacement_x / wide,
        color=VERMILION,
        ls=DASHES[2],
        label="$u_x$ across, $x = 0$",
    )
    axes[0].set(xlabel="$x$, or $y$ (µm)", ylabel="share of the value at the centre", ylim=(0, 1.1))
    axes[0].legend(loc="lower center")
    for axis, name in zip(axes[1:], "xy", strict=True):
        values = patch[f"displacement_{name}"].where(x**2 + y**2 < (1.05 * b) ** 2) * 1e9
        levels = MaxNLocator(10, symmetric=name == "y").tick_values(values.min(), values.max())
        shading = axis.contourf(line * micro, line * micro, values, levels, cmap=MAP)
        lines = axis.contour(
            line * micro, line * micro, values, levels, colors="white", linewidths=0.4,
            negative_linestyles="solid",
        )  # fmt: skip
        for drawn in (shading, lines):
            drawn.set_clip_path(Circle((0, 0), b * micro, transform=axis.transData))
        axis.add_patch(Circle((0, 0), b * micro, fill=False, lw=1))
        bar = figure.colorbar(shading, ax=axis, location="top", label=f"$u_{name}$ (nm)", aspect=24)
        bar.set_ticks(levels[:: len(levels) // 4])
        axis.set(aspect="equal", xlabel="$x$ (µm)", ylabel="$y$ (µm)")
    save_figure(figure, "gross_slip_fields.png")
    spread = np.ptp(rates[0]) / rate_30
    print(f"(28), (29) within {max(errors):.0e}; (30): du_x/dt uniform within {spread:.0e}")
