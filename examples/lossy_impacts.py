r"""Let spheres lose energy
=======================

A law of losses in `carom.impact` gives a restitution below 1: viscous, relaxing or yielding bodies.

Left: the rebound for a restitution :math:`e` that is the same at all speeds; crosses are springs
with dashpots in small steps. What is lost in shear makes the ball spring back less. Impacts slide
throughout from :math:`\psi_1 = 2\chi(1 + e) - e` on, where the curves meet the thin lines
:math:`\psi_2 = \psi_1 - 2\chi(1 + e)`. Right: viscoelastic spheres (Kelvin & Voigt) lose little in
slow impacts, :math:`1 - e \sim V^{1/5}`. A standard linear solid loses most if the contact lasts as
long as it relaxes. Metals that yield lose more the faster they strike, :math:`e \sim V^{-1/4}`
(Thornton 1997).
"""

import numpy as np

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
LAWS = {
    "elastic-plastic, $V_y$ = 0.1 m/s": carom.ElasticPlastic(yield_velocity="0.1 m/s"),
    r"viscous, $\tau$ = 1 µs": carom.KelvinVoigt(loss_time="1 us"),
    r"standard linear, $E_0/E$ = 2, $\tau$ = 7 µs": carom.StandardLinearSolid(2.0, "7 us"),
}
for law in (*LAWS.values(), carom.KelvinVoigt(restitution=0.8)):
    hit = carom.impact(pair, speed="1 m/s", angle="20 deg", losses=law)
    print(f"{type(law).__name__}: e {hit.normal_restitution:.3f}", end=", ")
    print(f"leaves at {np.degrees(hit.rebound_angle):.1f} deg, {hit.lost_energy:.2e} J lost")

# %%
# The figure, and checks against other methods.
CHI, WANTED = 1.44, (1.0, 0.9, 0.7, 0.5)
PSI = np.linspace(0.0, 8.0, 81)
CROSSES = (0.75, 2.0, 3.5, 5.0)
SPEEDS = np.geomspace(0.05, 20.0, 41)


def rebounds(psi, e):
    """Return psi_2 of a sphere of this restitution."""
    return carom.rebound(psi, CHI, losses=carom.KelvinVoigt(restitution=e))


def restitutions(law):
    """Return e at each normal speed."""
    hits = [carom.impact(pair, normal_speed=v, tangential_speed=0.0, losses=law) for v in SPEEDS]
    return np.array([hit.normal_restitution for hit in hits])


def thornton(ratio):
    """Return e of an elastic-plastic sphere at V/V_y > 1 (Thornton 1997)."""
    y = 1.0 / ratio
    turned = y / (y + 2.0 * np.sqrt(1.2 - 0.2 * y * y))
    return np.sqrt(1.2 * np.sqrt(3.0)) * np.sqrt(1.0 - y * y / 6.0) * turned**0.25


@styled
def draw(curves, marched, restitution):
    """Draw psi_2 against psi_1, and restitution against speed."""
    figure, ((left, right),) = new_figure(1, 2, width=DOUBLE, height=84.0)
    for e, color, dash in zip(WANTED, (LINES[4], *LINES), DASHES, strict=False):
        left.plot(PSI, curves[e], color=color, ls=dash, label=f"$e$ = {e:g}")
        left.plot(PSI, PSI - 2.0 * CHI * (1.0 + e), color=color, lw=0.4)
        left.plot(CROSSES, marched[e], "x", color=color, ms=4)
    left.plot([], [], color="0.4", lw=0.4, label="slides throughout")
    left.plot([], [], "x", color="0.4", ms=4, label="in small steps")
    left.set(title="rebound", xlabel=r"$\psi_1$", ylabel=r"$\psi_2$", xlim=(0.0, 8.0), ylim=(-2, 4))
    for (name, values), color, dash in zip(restitution.items(), LINES, DASHES, strict=False):
        right.plot(SPEEDS, values, color=color, ls=dash, label=name)
    late, plastic = SPEEDS[SPEEDS > 1.0], next(iter(restitution.values()))
    law = plastic[-1] * (late / late[-1]) ** -0.25
    right.plot(late, 0.92 * law, color="0.4", lw=0.6, label="slope of $V_1^{-1/4}$")
    right.set(title="restitution", xscale="log", yscale="log", xlabel="$V_1$ (m/s)", ylabel="$e$")
    ticks = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    right.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    right.minorticks_off()
    left.legend(loc="upper left", ncols=2)
    right.legend(loc="lower left")
    return figure


curves, marched = {e: rebounds(PSI, e) for e in WANTED}, {}
for e in WANTED:
    law = carom.dem.ExactContactLaw(springs=1024, restitution=e)
    marched[e] = law.rebound(CROSSES, CHI, steps=8000)
    np.testing.assert_allclose(rebounds(CROSSES, e), marched[e], atol=2e-6)
    sliding = PSI - 2.0 * CHI * (1.0 + e)
    slides = 2.0 * CHI * (1.0 + e) - e <= PSI
    np.testing.assert_allclose(curves[e][slides], sliding[slides], atol=1e-9)
    assert np.all(curves[e][~slides] > sliding[~slides])

found = {name: restitutions(law) for name, law in LAWS.items()}
plastic, viscous, relaxing = found.values()
assert 0 < np.argmin(relaxing) < SPEEDS.size - 1, "relaxing bodies lose most in between"
yields = SPEEDS > 0.1
np.testing.assert_allclose(plastic[yields], thornton(SPEEDS[yields] / 0.1), rtol=1e-8)
growth = np.log((1.0 - viscous[1]) / (1.0 - viscous[0])) / np.log(SPEEDS[1] / SPEEDS[0])
assert 0.18 < growth < 0.2, "1 - e grows as V^(1/5), and a little more slowly"
save_figure(draw(curves, marched, found), "lossy_impacts.png")
print(f"e at 20 m/s: {plastic[-1]:.3f} elastic-plastic, {viscous[-1]:.3f} viscous")
