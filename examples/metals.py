r"""Let metals yield
================

`losses=carom.Metal()` gives the restitution of metals beyond yield, from their yield strength.

Left: the restitution of spheres that yield at the normal velocity :math:`V_y`. In `carom.Metal` the
load and the contact radius are those of finite elements (Jackson & Green 2005), drawn for yield
strengths of 0.001 and 0.008 of the modulus. In `carom.ElasticPlastic` the pressure stays at that of
first yield (Thornton 1997), so that the sphere rebounds too slowly. Thin lines are scalings of
fully plastic contacts: Johnson's (1985, chapter 11) at 3 yield strengths, and those of finite
elements (Wu, Li & Thornton 2003, as quoted). The upper one of these follows from a uniform pressure
of 2.84 yield strengths, the lower one is for a strength of 0.008 of the modulus. Dots are the fit
of Jackson, Green & Marghitu (2010, as quoted). Right: the mean pressure on the largest contact.
"""

import numpy as np

import carom
from carom.bodies.losses import yield_velocity
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled

steel = carom.Material(young="210 GPa", poisson=0.3, density=7850, yield_strength="400 MPa")
ball = carom.Sphere(radius="5 mm", material=steel)
pair = carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)
for speed in ("0.1 m/s", "1 m/s", "10 m/s"):
    hit = carom.impact(pair, speed=speed, angle="20 deg", losses=carom.Metal())
    print(f"{speed}: e {hit.normal_restitution:.2f}, {hit.lost_energy:.1e} J lost in yield")

# %%
# The figure: restitution and pressure against speed, by several laws.

BLUE, VERMILION, GREEN, _, BLACK = LINES
RATIOS = np.geomspace(1.0, 1000.0, 40)
STRAINS = {0.001: BLACK, 0.008: BLUE}  # yield strength over E/(1 - nu^2)
SCALING = 2.08  # e (V_1/V_y)^(1/4) of fully plastic contacts by finite elements
LARGE = 0.008  # V_1/V_y (Y/E*)^2 from which their e falls as V_1^(-1/2)
HARDNESS, JOHNSON = 2.84, 3.0  # pressures of fully plastic contacts, in yield strengths
UNIFORM = 80.0 / (9.0 * np.pi**2)  # elastic energy under a uniform pressure, over that of Hertz's


def of_strain(strain):
    """Return a steel ball on a plate that yields at this strain."""
    steel = carom.Material(
        young="210 GPa", poisson=0.3, density=7850, yield_strength=strain * 210e9 / 0.91
    )
    ball = carom.Sphere(radius="5 mm", material=steel)
    return carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)


def impacts(pair, law):
    """Return e and the mean pressure in yield strengths at each V_1/V_y."""
    slow, strength = yield_velocity(pair), pair.first.material.yield_strength
    hits = [carom.impact(pair, normal_speed=ratio * slow, losses=law) for ratio in RATIOS]
    mean = [hit.max_force / (np.pi * hit.max_radius**2 * strength) for hit in hits]
    return np.array([hit.normal_restitution for hit in hits]), np.array(mean)


def fully_plastic(pressure, share=1.0):
    """Return e (V_1/V_y)^(1/4) of a constant pressure, in yield strengths, with a^2 = 2 R d.

    g = pressure b_y/1.6: P = (3/2) g b^2 takes 1 = (15/4) g d^2, and e^2 = share P^2/b.
    """
    g = pressure / 1.6
    deepest = (3.75 * g) ** -0.5
    return np.sqrt(share * (1.5 * g) ** 2 * (2.0 * deepest) ** 1.5)


def jackson(ratio):
    """Return e by the fit of Jackson, Green & Marghitu for V_1/V_y from 1 to 60."""
    return 1.0 - 0.1 * np.log(ratio) * ((ratio - 1.0) / 59.0) ** 0.156


@styled
def draw(metals, plastic):
    """Draw e and the mean pressure against V_1/V_y."""
    figure, axes = new_figure(1, 2, width=DOUBLE, height=84.0)
    left, right = axes[0]
    for (strain, (e, mean)), dash in zip(metals.items(), DASHES, strict=False):
        style = {"color": STRAINS[strain], "ls": dash, "label": f"Metal, $Y/E'$ = {strain:g}"}
        left.plot(RATIOS, e, **style)
        right.plot(RATIOS, mean, **style)
    for axis, values in zip((left, right), plastic, strict=True):
        axis.plot(RATIOS, values, color=VERMILION, ls=DASHES[2], label="ElasticPlastic")
        axis.set(
            xscale="log", xlim=(1.0, 1000.0), xlabel="speed over that of first yield, $V_1/V_y$"
        )
    late = RATIOS[RATIOS > 60.0]
    johnson, scaled = (value * late**-0.25 for value in (fully_plastic(JOHNSON), SCALING))
    left.plot(late, johnson, color="0.5", lw=0.7, label="Johnson, fully plastic at 3 $Y$")
    left.plot(late, scaled, color=GREEN, lw=0.9, label="scalings of finite elements")
    large = RATIOS[RATIOS * max(STRAINS) ** 2 > LARGE]
    left.plot(large, 0.62 * (large * max(STRAINS)) ** -0.5, color=GREEN, lw=0.9)
    early = np.geomspace(2.0, 60.0, 13)
    left.plot(early, jackson(early), ".", color=BLACK, ms=3, label="Jackson, Green & Marghitu")
    left.set(title="restitution", ylim=(0.2, 1.02), ylabel="$e$")
    right.axhline(HARDNESS, color="0.4", lw=0.6)
    right.text(1.1, HARDNESS + 0.02, "2.84 $Y$, fully plastic", color="0.4")
    right.set(title="mean pressure on the largest contact", ylim=(0.9, 3.0), ylabel="$p_m/Y$")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


metals = {strain: impacts(of_strain(strain), carom.Metal()) for strain in STRAINS}
plastic = impacts(of_strain(0.001), carom.ElasticPlastic())
scaling = fully_plastic(HARDNESS, UNIFORM)
np.testing.assert_allclose(scaling, SCALING, rtol=5e-3)
late = RATIOS > 100.0
for strain, (e, mean) in metals.items():
    assert np.all(np.diff(e) <= 0.0)
    off = e[late] - scaling * RATIOS[late] ** -0.25
    assert np.max(np.abs(off)) < (0.05 if strain < 0.002 else 0.2)
    assert np.all(mean[late & (RATIOS < 300.0)] > 2.1)
assert np.all(plastic[0][late] < metals[0.001][0][late] - 0.15)
figure = draw(metals, plastic)
save_figure(figure, "metals.png")
at = int(np.argmin(np.abs(RATIOS - 277.0)))
print(
    f"e at {RATIOS[at]:.0f} V_y: {metals[0.001][0][at]:.2f}, finite elements "
    f"{SCALING * RATIOS[at] ** -0.25:.2f}, Thornton {plastic[0][at]:.2f}"
)
