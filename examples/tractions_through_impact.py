r"""The traction at six instants
============================

The traction at six instants of one impact: gross slip, stick, slip from the edge, gross slip.

The ball first slides and drags the surface forward. While it sticks, new contact is laid down with
ever less traction. Then the edge slips backwards and the slip ring grows inwards. The traction in
the middle, laid down long before, lasts to the end. Dashed: the limits :math:`\pm\mu p`.

Barber (1979), ZAMP 30:468, equation (6) and section 7; here with the slip ring solved.
"""

import numpy as np
from matplotlib.patches import Patch
from numpy.polynomial.chebyshev import chebval

import carom
from carom.plots.bands import BANDS, SIGNS, STICK, shade, slip_band
from carom.plots.style import BLACK, BLUE, DASHES, DOUBLE, new_figure, save_figure, style

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)
SHARES = (0.25, 0.38, 0.45, 0.6, 0.72, 0.92)


def traction_6(contact, r):
    """Return (6) by Gauss's rule, part by part; with s^2 = r^2 + w^2 the root cancels."""
    edges = contact.profile.edges
    total = 0.0
    for low, high, row in zip(edges, edges[1:], contact.profile.g, strict=False):
        ends = np.sqrt(np.maximum(np.array([low, high]) ** 2 - r**2, 0))
        w = ends.mean() + np.diff(ends) / 2 * NODES
        total += np.diff(ends)[0] / 2 * WEIGHTS @ read(row, low, high, np.sqrt(r**2 + w**2))
    return total * contact.scales.pressure * contact.pair.friction


def read(row, low, high, r):
    """The value of a memory function between two radii."""
    return chebval((2 * r - low - high) / (high - low), row)


def places(profile):
    """Radii, weights and g for integrals over the contact, dense at the borders of its parts."""
    parts = []
    for low, high, row in zip(profile.edges, profile.edges[1:], profile.g, strict=False):
        r = (low + high) / 2 + (high - low) / 2 * np.sin(np.pi / 2 * NODES)
        weight = (high - low) * np.pi / 4 * np.cos(np.pi / 2 * NODES) * WEIGHTS
        parts.append(np.array([r, weight, read(row, low, high, r)]))
    return np.hstack(parts)


def explain(figure, axis):
    """Say in a legend what the lines and the zones are."""
    marks = {"stick": STICK}
    marks |= {f"slip{SIGNS[sign]}": BANDS["slip", sign] for sign in (1, -1)}
    marks |= {f"gross slip{SIGNS[sign]}": BANDS["gross slip", sign] for sign in (1, -1)}
    zones = [Patch(fc=b.face, ec=b.edge, hatch=b.hatch, label=name) for name, b in marks.items()]
    lines = axis.get_legend_handles_labels()[0]
    figure.legend(handles=[*lines, *zones], loc="outside upper center", ncols=7)


with style():
    hit = carom.impact(PAIR, speed="2 m/s", angle="25 deg")
    kinds = [phase.kind for phase in hit.phases]
    assert kinds == ["gross slip", "stick", "slip", "gross slip"], kinds
    reach, unit = 1e6 * hit.max_radius, 1e6
    figure, axes = new_figure(2, 3, width=DOUBLE, height=86, sharex=True, sharey=True)
    worst = 0.0
    for axis, share in zip(axes.flat, SHARES, strict=True):
        contact = hit.contact(share * hit.duration)
        r, weight, g = places(contact.profile)
        r_m, scale = r * contact.scales.radius, PAIR.friction * hit.max_pressure
        patch = hit.fields(share * hit.duration, points=np.column_stack([r_m, 0 * r]))
        f, limit = patch.traction_x.values, PAIR.friction * patch.pressure.values
        worst = max(worst, np.abs(f - [traction_6(contact, at) for at in r]).max() / scale)
        assert np.all(np.abs(f) <= limit * (1 + 1e-9) + 1e-12 * scale), "Coulomb's law"
        force, largest = float(patch.tangential_force), PAIR.friction * hit.max_force
        by_11 = contact.scales.radius * weight @ (2 * np.pi * r_m * f)
        by_12 = contact.scales.tangential_force * weight @ (2 * r**2 * g)
        np.testing.assert_allclose([by_11, by_12], force, atol=1e-9 * largest, err_msg="(11), (12)")
        b = contact.radius
        stick = contact.stick_radius * contact.scales.radius
        shade(axis, 0, stick * unit, STICK)
        shade(axis, stick * unit, b * unit, slip_band(patch))
        line = np.column_stack([np.linspace(0, b, 400), np.zeros(400)])
        fine = hit.fields(share * hit.duration, points=line)
        axis.plot(line[:, 0] * unit, fine.traction_x / scale, color=BLUE, lw=1.6, label="traction")
        limit = PAIR.friction * fine.pressure / scale
        for side, name in ((-1, None), (1, r"limits, $\pm\mu p$")):
            axis.plot(
                line[:, 0] * unit, side * limit, color=BLACK, ls=DASHES[1], lw=0.8, label=name
            )
        axis.axhline(0, color="0.5", lw=0.5)
        phase = patch.attrs["phase_kind"] + SIGNS[int(patch.attrs["phase_sign"])]
        axis.set_title(f"{phase}, {share:g} $t_c$")
    axes[0, 0].set(xlim=(0, 1.02 * reach), ylim=(-1.05, 1.05))
    for axis in axes[-1]:
        axis.set_xlabel("$r$ (µm)")
    for axis in axes[:, 0]:
        axis.set_ylabel(r"$f_x/\mu p_{max}$")
    assert worst < 1e-10, f"(6) by quadrature differs by {worst:.1e}"
    explain(figure, axes[0, 0])
    save_figure(figure, "tractions_through_impact.png")
    print(f"(6) by quadrature within {worst:.0e} of mu p_max; (11), (12) and Coulomb's law hold")
