r"""A real ball: measured and calculated
====================================

Angle, spin and restitution of 5 mm alumina balls on glass at 3.9 m/s, calculated and measured.

Where the ball slides throughout, from :math:`\psi_1 = 4\chi - 1` on, friction acts on all impacts
alike: :math:`\tan\theta' = \tan\theta - 2\mu` and :math:`\omega = 5\mu V_1/R`. At smaller angles
the ball sticks for a while, and the slip ring decides how much it is turned and thrown back.
Only :math:`\mu` is fitted, to the impacts that slide; those at smaller angles are the test.

Kharaz, Gorham & Salman (2001), Powder Technol. 120:281, as digitised, see data/.
"""

from pathlib import Path

import numpy as np

import carom
from carom.impacts.curves import borders
from carom.plots.style import BLACK, BLUE, DASHES, DOUBLE, new_figure, save_figure, styled

ALUMINA = carom.Material(young="380 GPa", poisson=0.23, density=4000)
GLASS = carom.Material(young="70 GPa", poisson=0.25, density=2500)
BALL = carom.Sphere(radius="2.5 mm", material=ALUMINA)
PAIR = carom.Pair(BALL, carom.HalfSpace(material=GLASS), friction=0.092)
SPEED = 3.9
DATA = Path(__file__).parent / "data"


def measured(name):
    """Angles of incidence in degrees, and what was measured."""
    return np.genfromtxt(DATA / f"kharaz2001_{name}.csv", delimiter=",").T[:, 1:]


def calculated(degrees):
    """Angle of rebound in degrees, spin in rad/s and restitution for angles of incidence."""
    hits = [carom.impact(PAIR, speed=SPEED, angle=np.radians(a)) for a in degrees]
    angles = [np.degrees(hit.rebound_angle) for hit in hits]
    return np.array([angles, [-h.spin_out for h in hits], [h.tangential_restitution for h in hits]])


@styled
def main(folder: str | Path = ".") -> str:
    """Check sliding in closed form and the measured values within their scatter; draw them."""
    theta = np.linspace(0.5, 65, 130)
    angle, spin, restitution = calculated(theta)
    tangent, mu = np.tan(np.radians(theta)), PAIR.friction
    slides = PAIR.kappa * tangent / mu > borders(PAIR.chi)[2]
    sliding = np.degrees(np.arctan(tangent - 2 * mu))
    turned = 5 * mu * SPEED * np.cos(np.radians(theta)) / BALL.radius
    np.testing.assert_allclose(angle[slides], sliding[slides], rtol=1e-12)
    np.testing.assert_allclose(spin[slides], turned[slides], rtol=1e-12)

    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=60)
    limits = {"centre_rebound_angle": 1.5, "omega": 40.0, "et": 0.03}
    labels = (r"angle of rebound, $\theta'$ (deg)", "spin after (rad/s)", "restitution, $v_t'/v_t$")
    scatter = []
    for row, (axis, (name, limit)) in enumerate(zip(axes, limits.items(), strict=True)):
        at, value = measured(name)
        difference = np.abs(calculated(at)[row] - value).max()
        assert difference < limit, f"{name}: differs by {difference:.3g}"
        scatter.append(difference)
        axis.plot(theta, (angle, spin, restitution)[row], color=BLUE, label="calculated")
        axis.plot(at, value, "o", mfc="white", mec=BLACK, mew=0.8, label="measured")
        axis.set(xlabel=r"$\theta$ (deg)", ylabel=labels[row], xlim=(0, 65))
    closed = (sliding, turned, 1 - 2 * mu / tangent)
    for axis, line in zip(axes, closed, strict=True):
        grips = ~slides & (theta > 8)
        axis.plot(theta[grips], line[grips], color="0.5", ls=DASHES[1], lw=0.8, label="sliding")
    axes[0].set_ylim(0, 65)
    axes[1].set_ylim(0, 900)
    axes[2].set_ylim(0.5, 1)
    axes[0].legend(loc="upper left")
    save_figure(figure, Path(folder) / "rebound_angles.png")
    return "measured within {:.1f} deg, {:.0f} rad/s, {:.3f}; sliding exact".format(*scatter)


if __name__ == "__main__":
    print(main())
