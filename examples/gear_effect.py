"""Gear effect of a golf driver
============================

Sidespin of a golf ball against how far off the centre of the face a driver strikes it.

The centre of mass lies behind the face. Struck towards the toe, the head turns, its face moves
towards the toe and takes the ball along, as one gear takes another: a hook. A face that bulges is
inclined there and makes less of it.
"""

from math import asin, cos, pi, sin
from pathlib import Path

import numpy as np

import carom
from carom.plots.legends import legend_above
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled, zero_line

DEPTH, BULGE, FLAT = 0.036, 0.305, 1e3  # m: centre of mass behind the face; 12 inches
RUBBER = carom.Material(young="60 MPa", poisson=0.45, density=1127)  # in contact for 0.5 ms
BALL = carom.Sphere(radius="21.35 mm", material=RUBBER)
LOSS = carom.StandardLinearSolid(modulus_ratio=1.5, relaxation_time="0.2 ms")  # e = 0.82
PLACES = np.linspace(-30.0, 30.0, 61)  # mm off the centre of the face, positive to the toe


def strike(place, friction=0.4, bulge=BULGE, speed=45.0, losses=LOSS):
    """Return the impact of a driver's head that moves straight on, at a place in mm."""
    lean = asin(1e-3 * place / bulge)  # of the face there
    x, z = (bulge - DEPTH) * sin(lean), (bulge - DEPTH) * cos(lean) - bulge
    size = {"mass": "200 g", "inertia": 4.5e-4, "contact": (x, z), "curvature_radius": bulge}
    head = carom.Body(**size, material="titanium alloy", name="driver")
    pair = carom.Pair(head, BALL, friction)
    along = {"normal_speed": speed * cos(lean), "tangential_speed": -speed * sin(lean)}
    return carom.impact(pair, **along, losses=losses)


def hook(hit):
    """Return the sidespin of the ball in rpm, positive for a hook of a right-handed player."""
    return -hit.spin2_out * 30.0 / pi


@styled
def draw(faces, frictions):
    """Draw sidespin over the place, for two faces and for four frictions."""
    figure, axes = new_figure(1, 2, width=DOUBLE, height=66.0)
    alike = r"$\mu$ = 0.4", "bulge 305 mm"
    for axis, curves, words in zip(axes[0], (faces, frictions), alike, strict=True):
        zero_line(axis)
        axis.text(0.97, 0.05, words, ha="right", transform=axis.transAxes)
        for color, dash, (name, spins) in zip(LINES, DASHES, curves.items(), strict=False):
            axis.plot(PLACES, spins, color=color, ls=dash, label=name)
        axis.set(xlim=PLACES[[0, -1]], xlabel="place on the face, toe positive (mm)")
        axis.set_ylabel("sidespin, hook positive (rpm)")
        legend_above(axis, 2)
    return figure


def main(folder: str | Path = ".") -> str:
    """Check the mirror, momentum of the ball, rolling off a flat face; draw both dependences."""
    faces = {"flat face": FLAT, "bulge 305 mm": BULGE}
    faces = {name: [hook(strike(x, bulge=b)) for x in PLACES] for name, b in faces.items()}
    friction = {f"$\\mu$ = {m:g}": m for m in (0.05, 0.1, 0.2, 0.4)}
    friction = {name: [hook(strike(x, m)) for x in PLACES] for name, m in friction.items()}
    for spins in (*faces.values(), *friction.values()):
        np.testing.assert_allclose(spins, -np.array(spins)[::-1], atol=1e-6, err_msg="toe, heel")
    hit = strike(12.7)
    turned = BALL.gyration_ratio * BALL.mass * BALL.radius * hit.spin2_out  # I omega = R J
    np.testing.assert_allclose(turned, hit.tangential_impulse * -1.0, rtol=1e-9)
    np.testing.assert_allclose(strike(12.7, losses=None).lost_energy, 0.0, atol=1e-9)
    assert hook(strike(12.7, bulge=FLAT)) > hook(hit) > 0.0, "bulge makes less hook"
    assert hook(strike(25.0, 0.05)) < 0.0, "a slippery face slices"
    save_figure(draw(faces, friction), Path(folder) / "gear_effect.png")
    flat = hook(strike(12.7, bulge=FLAT))
    return f"half an inch to the toe: hook of {hook(hit):.0f} rpm, of a flat face {flat:.0f} rpm"


if __name__ == "__main__":
    print(main())
