r"""Find where friction wears most
==============================

`hit.wear` gives the work of friction over the contact, which Archard's law turns into a depth.

Where the ball slides throughout, friction dissipates
:math:`W = 2\mu m_n V_1 (V_x - \mu m_n V_1/m_t)`. This is largest where
:math:`\tan 2\theta = -m_t/(\mu m_n)`, at 55 degrees from the normal for :math:`\mu = 0.1` and at 77
for 0.6. The work per area is then largest in the centre. Near the normal the middle of the contact
sticks for a long time, and the largest work per area lies on a ring. By Archard's law the depth of
wear is :math:`k/\mu` times the work per area.

Archard (1953), J. Appl. Phys. 24:981; Maw, Barber & Fawcett (1976), Wear 38:101.
"""

import numpy as np

import carom
from carom.impacts.curves import borders
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

ball = carom.Sphere(radius="5 mm", material="steel")
wall = carom.HalfSpace(material="steel")
pair = carom.Pair(ball, wall, friction=0.3)
wear = carom.impact(pair, speed="2 m/s", angle="50 deg").wear(coefficient="1e-13 m^2/N")
print(f"friction dissipates {1e3 * wear.dissipated_energy:.3f} mJ", end=", ")
print(f"wears {1e9 * wear.max_wear_depth:.3f} nm", end=", ")
print(f"most at a radius of {1e6 * wear.max_wear_radius:.0f} um")

# %%
# A steel ball on steel: which angle wears most, and where in the contact.

FRICTION = (0.1, 0.3, 0.6)
SPEED = 2.0
ANGLES = np.arange(1.0, 89.5, 1.0)
COLUMNS = ("dissipated_energy", "max_friction_work", "max_wear_radius", "max_radius", "work_error")


def worn(pair):
    """Return what describes the wear of an impact, for each angle."""
    found = [carom.impact(pair, speed=SPEED, angle=a).wear(101, x=[0], y=[0]) for a in radians()]
    return {name: np.array([float(each[name]) for each in found]) for name in COLUMNS}


def radians():
    return np.radians(ANGLES)


with style():
    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=62)
    most, error = {}, 0.0
    for mu, color, dash in zip(FRICTION, LINES, DASHES, strict=False):
        pair = carom.Pair(ball, wall, friction=mu)
        ratio, energy = pair.normal_mass / pair.tangential_mass, 0.5 * ball.mass * SPEED**2
        result, theta = worn(pair), radians()
        share = result["dissipated_energy"] / energy
        error = max(error, result["work_error"].max())
        normal, along = np.cos(theta), np.sin(theta)
        slides = pair.kappa / mu * along / normal > borders(pair.chi)[2]
        sliding = 4.0 * mu * normal * (along - mu * ratio * normal)
        np.testing.assert_allclose(share[slides], sliding[slides], rtol=1e-9)
        worst = np.pi / 2.0 - 0.5 * np.arctan(1.0 / (mu * ratio))
        most[mu] = float(np.degrees(worst))
        assert abs(ANGLES[share.argmax()] - most[mu]) <= 0.5, "the worst angle is that of sliding"
        inner = result["max_wear_radius"] / result["max_radius"]
        assert np.all(inner[slides] < 1e-6), "sliding wears the centre most"
        assert inner[ANGLES < 6.0].min() > 0.5, "a ring is worn most"
        style = {"color": color, "ls": dash, "label": rf"$\mu$ = {mu}"}
        axes[0].plot(ANGLES, 100.0 * share, **style)
        axes[1].plot(ANGLES, result["max_friction_work"] / 1e3, **style)
        jumps = np.append(np.abs(np.diff(inner)) > 0.3, False)
        axes[2].plot(ANGLES, np.where(jumps, np.nan, inner), **style)
        work = result["max_friction_work"] / 1e3
        for axis, values in ((axes[0], 100.0 * share), (axes[1], work)):
            axis.plot(ANGLES[values.argmax()], values.max(), "o", color=color)
    assert error < 1e-8, f"the work per area is off by {error:.0e} of the work"
    titles = ("work of friction", "largest work per area", "where it lies")
    labels = ("share of the energy (%)", "work per area (kJ/m²)", "$r_w/a_{max}$")
    for axis, title, label in zip(axes, titles, labels, strict=True):
        axis.set(title=title, xlabel=r"$\theta$ (deg)", ylabel=label, xlim=(0, 90))
        axis.set_ylim(bottom=0.0)
    axes[2].set_ylim(-0.02, 1.0)
    axes[0].legend(loc="upper left")
    save_figure(figure, "wear_against_angle.png")
    angles = ", ".join(f"{angle:.0f}" for angle in most.values())
    print(
        f"summed over the contact to {error:.0e}; most at {angles} degrees, where the ball slides"
    )
