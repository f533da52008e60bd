r"""Let small spheres adhere
========================

`carom.classical.adhesive_impact` gives the rebound of spheres that pull on each other.

Left: the contact of Johnson, Kendall & Roberts (1971) jumps in where the spheres touch, and out
where the approach is least; the shaded work is what an impact loses. Middle: the restitution that
is left, and how long the contact lasts. Right: the rebound of the contact point if nothing slips,
against the speed; lines at the margin are the limits without adhesion.
"""

import numpy as np
from scipy.special import rgamma

import carom
from carom.classical import adhesive_impact
from carom.plots.style import BLACK, DOUBLE, LINES, new_figure, save_figure, styled, zero_line

toner = carom.Material(young="3 GPa", poisson=0.3, density=1100.0)
bead = carom.Sphere(radius="10 um", material=toner)
pair = carom.Pair(bead, carom.HalfSpace(toner), friction=0.3)
hit = adhesive_impact(pair, normal_speed=0.2, work_of_adhesion=0.1)  # J/m^2
print(f"sticks below {hit.sticking_speed:.3f} m/s; at 0.2 m/s e {hit.normal_restitution:.3f}")

# %%
# The figure: the loop of force and approach, restitution, and the rebound without slip.

GAMMA = 0.1  # J/m^2
POISSONS = (0.5, 0.3, 0.1)
HERTZ = 2.943275184324700  # duration in d_max/V_1
SPEEDS = np.geomspace(1.00001, 1e4, 400)  # of the sticking speed


def pair_of(poisson: float) -> carom.Pair:
    """Return a bead of 10 um radius on a wall of its material."""
    stuff = carom.Material(young="3 GPa", poisson=poisson, density=1100.0)
    bead = carom.Sphere(radius="10 um", material=stuff)
    return carom.Pair(bead, carom.HalfSpace(stuff), friction=0.3)


def impacts(pair: carom.Pair):
    """Return impacts at speeds from the sticking speed on, of psi_1 = 0.01."""
    still = adhesive_impact(pair, normal_speed=1.0, work_of_adhesion=GAMMA)
    speeds = SPEEDS * still.sticking_speed
    along = 0.01 * pair.friction / pair.kappa * speeds
    return adhesive_impact(
        pair, normal_speed=speeds, tangential_speed=along, work_of_adhesion=GAMMA
    )


def loop(most: float = 1.5):
    """Return approach and force, over the pull-off force, of radii over that at no approach."""
    ends = 16.0 ** (-1.0 / 3.0), 1.0, most
    radius = np.concatenate([np.linspace(ends[i], ends[i + 1], 2001) for i in (0, 1)])
    approach = radius**2 - np.sqrt(radius)
    return radius, approach, 16.0 / 9.0 * (radius**3 - 1.5 * radius**1.5)


def large_friction(chi: float) -> float:
    """Return psi_2/psi_1 without adhesion, if nothing slips."""
    root = np.sqrt(240.0 * chi + 1.0)
    turned = rgamma((11.0 + root) / 20.0) * rgamma((11.0 - root) / 20.0) / rgamma(0.6)
    return 2.0 * np.pi * turned**2 - 1.0


@styled
def draw(rebounds):
    """Draw the loop of force and approach, e and duration, and psi_2/psi_1."""
    figure, axes = new_figure(1, 3, width=DOUBLE, height=70.0)
    left, middle, right = axes[0]
    radius, approach, force = loop()
    pulled = radius <= 1.0
    left.fill_between(approach[pulled], force[pulled], 0.0, color=LINES[0], alpha=0.15, lw=0)
    left.plot([-1.1, 0.0], [0.0, 0.0], color=LINES[1], label="apart")
    left.plot([0.0, 0.0], [0.0, -8.0 / 9.0], color=LINES[1], ls=":")
    left.plot(approach, force, color=LINES[0], label="in contact")
    left.plot([approach[0]] * 2, [force[0], 0.0], color=LINES[0], ls=":")
    left.set(xlim=(-1.1, 0.8), ylim=(-1.3, 0.7), xlabel="approach, $d R^*/a_0^2$", title="force")
    left.text(0.04, -0.15, "jumps in")
    left.text(-0.51, -0.3, "jumps out", ha="right")
    left.set_ylabel("force over pull-off force")
    first = rebounds[0.3]
    middle.plot(SPEEDS, first.normal_restitution, color=BLACK, label="$e$")
    middle.set_title("restitution and duration")
    middle.set(xscale="log", xlim=(1.0, 100.0), ylim=(0.0, 1.8), xlabel="$V_1/V_s$")
    share = first.duration / first.scales.time / HERTZ
    middle.plot(SPEEDS, share, color=LINES[2], ls="--", label="duration/Hertz's")
    for line, (poisson, hit) in zip(LINES, rebounds.items(), strict=False):
        right.plot(SPEEDS, hit.psi_out / hit.psi_in, color=line, label=f"$\\nu$ = {poisson:g}")
        right.plot([6e3, 1e4], [large_friction(hit.pair.chi)] * 2, color=line, lw=2.5)
    right.plot([], [], color="0.4", lw=2.5, label="limits without adhesion")
    zero_line(right)
    right.set(xscale="log", xlim=(1.0, 1e4), ylim=(-1.0, 1.0), xlabel="$V_1/V_s$")
    right.set(title="rebound without slip", ylabel="$\\psi_2/\\psi_1$")
    left.legend(loc="upper left")
    middle.legend(loc="upper right")
    right.legend(loc="lower right")
    return figure


rebounds = {poisson: impacts(pair_of(poisson)) for poisson in POISSONS}
radius, approach, force = loop()
pulled = radius <= 1.0
work = -np.trapezoid(force[pulled], approach[pulled])
for hit in rebounds.values():
    pair, energy = hit.pair, GAMMA
    a_0 = (2.0 * np.pi * energy * pair.effective_radius**2 / pair.effective_modulus) ** (1 / 3)
    unit = hit.pull_off_force * a_0**2 / pair.effective_radius
    np.testing.assert_allclose(hit.lost_energy, work * unit, rtol=1e-6)
    left = np.sqrt(1.0 - SPEEDS**-2.0)
    np.testing.assert_allclose(hit.normal_restitution, left, atol=1e-9)
    ratio = hit.psi_out / hit.psi_in
    assert np.all(np.abs(ratio) <= 1.0)
    np.testing.assert_allclose(ratio[-1], large_friction(pair.chi), atol=0.012)
    assert hit.tabor > 5.0
save_figure(draw(rebounds), "adhesion.png")
hit = rebounds[0.3]
print(
    f"a bead of 10 um sticks below {hit.sticking_speed:.3g} m/s; at ten times that "
    f"psi_2/psi_1 is {np.interp(10.0, SPEEDS, hit.psi_out / hit.psi_in):.2f}, "
    f"without adhesion {large_friction(hit.pair.chi):.2f}"
)
