r"""Impacts that lose energy
========================

Impacts that lose energy: how the rebound depends on restitution, and restitution on speed.

Left: the rebound for a restitution :math:`e` that is the same at all speeds; crosses are springs
with dashpots in small steps. What is lost in shear makes the ball spring back less. Impacts slide
throughout from :math:`\psi_1 = 2\chi(1 + e) - e` on, where the curves meet the thin lines
:math:`\psi_2 = \psi_1 - 2\chi(1 + e)`. Right: viscoelastic spheres (Kelvin & Voigt) lose little in
slow impacts, :math:`1 - e \sim V^{1/5}`. A standard linear solid loses most if the contact lasts as
long as it relaxes. Metals that yield lose more the faster they strike, :math:`e \sim V^{-1/4}`
(Thornton 1997).
"""

from pathlib import Path

import numpy as np

import carom
from carom.plots.legends import legend_above
from carom.plots.style import (
    BLACK,
    BLUE,
    DASHES,
    DOUBLE,
    GREEN,
    VERMILION,
    new_figure,
    save_figure,
    styled,
)

CHI = 1.44
WANTED = {1.0: BLACK, 0.9: BLUE, 0.7: GREEN, 0.5: VERMILION}
PSI = np.linspace(0.0, 8.0, 81)
CROSSES = (0.75, 2.0, 3.5, 5.0)


def rebounds(psi, e):
    """Return psi_2 of a sphere of this restitution."""
    return carom.rebound(psi, CHI, losses=carom.KelvinVoigt(restitution=e))


def restitutions(pair, speeds, law):
    """Return e at each normal speed."""
    hits = [carom.impact(pair, normal_speed=v, tangential_speed=0.0, losses=law) for v in speeds]
    return np.array([hit.normal_restitution for hit in hits])


def thornton(ratio):
    """Return e of an elastic-plastic sphere at V/V_y > 1 (Thornton 1997)."""
    y = 1.0 / ratio
    turned = y / (y + 2.0 * np.sqrt(1.2 - 0.2 * y * y))
    return np.sqrt(1.2 * np.sqrt(3.0)) * np.sqrt(1.0 - y * y / 6.0) * turned**0.25


@styled
def draw(curves, marched, speeds, plastic, viscous, relaxing):
    """Draw psi_2 against psi_1, and restitution against speed."""
    figure, axes = new_figure(1, 2, width=DOUBLE, height=74.0)
    left, right = axes[0]
    for (e, color), dash in zip(WANTED.items(), DASHES, strict=False):
        left.plot(PSI, curves[e], color=color, ls=dash, label=f"$e$ = {e:g}")
    for e, color in WANTED.items():
        first = e == 1.0
        left.plot(
            CROSSES, marched[e], "x", color=color, ms=4, label="small steps" if first else None
        )
        sliding = r"$\psi_1 - 2\chi(1 + e)$" if first else None
        left.plot(PSI, PSI - 2.0 * CHI * (1.0 + e), color=color, lw=0.4, label=sliding)
    left.set(xlim=(0.0, 8.0), ylim=(-2.0, 4.0), xlabel=r"$\psi_1$", ylabel=r"$\psi_2$")
    legend_above(left, 3)
    right.plot(speeds, plastic, color=BLACK, label="elastic-plastic, $V_y$ = 0.1 m/s")
    right.plot(speeds, viscous, color=BLUE, ls=DASHES[1], label=r"viscous, $\tau$ = 1 µs")
    linear = r"standard linear, $E_0/E$ = 2, $\tau$ = 7 µs"
    right.plot(speeds, relaxing, color=GREEN, ls=DASHES[2], label=linear)
    late = speeds[speeds > 1.0]
    slope = plastic[-1] * (late / late[-1]) ** -0.25
    right.plot(late, slope, color=VERMILION, lw=0.6, label=r"$\propto V_1^{-1/4}$")
    right.set(xscale="log", yscale="log", xlabel="normal speed $V_1$ (m/s)")
    right.set_ylabel("coefficient of restitution $e$")
    ticks = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    right.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    right.minorticks_off()
    legend_above(right, 1)
    return figure


def main(folder: str | Path = ".") -> str:
    """Solve impacts with losses, check them against other methods, and draw them."""
    curves = {e: rebounds(PSI, e) for e in WANTED}
    marched = {}
    for e in WANTED:
        law = carom.dem.ExactContactLaw(springs=1024, restitution=e)
        marched[e] = law.rebound(CROSSES, CHI, steps=8000)
        np.testing.assert_allclose(rebounds(CROSSES, e), marched[e], atol=2e-6)
        sliding = PSI - 2.0 * CHI * (1.0 + e)
        slides = 2.0 * CHI * (1.0 + e) - e <= PSI
        np.testing.assert_allclose(curves[e][slides], sliding[slides], atol=1e-9)
        assert np.all(curves[e][~slides] > sliding[~slides])

    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    speeds = np.geomspace(0.05, 20.0, 41)
    plastic = restitutions(pair, speeds, carom.ElasticPlastic(yield_velocity="0.1 m/s"))
    viscous = restitutions(pair, speeds, carom.KelvinVoigt(loss_time="1 us"))
    relaxing = restitutions(pair, speeds, carom.StandardLinearSolid(2.0, "7 us"))
    assert 0 < np.argmin(relaxing) < speeds.size - 1, "relaxing bodies lose most in between"
    yields = speeds > 0.1
    np.testing.assert_allclose(plastic[yields], thornton(speeds[yields] / 0.1), rtol=1e-8)
    growth = np.log((1.0 - viscous[1]) / (1.0 - viscous[0])) / np.log(speeds[1] / speeds[0])
    assert 0.18 < growth < 0.2, "1 - e grows as V^(1/5), and a little more slowly"

    figure = draw(curves, marched, speeds, plastic, viscous, relaxing)
    save_figure(figure, Path(folder) / "lossy_impacts.png")
    return (
        f"psi_2 at psi_1 = 3.5: {', '.join(f'{rebounds(3.5, e):.3f} (e = {e:g})' for e in WANTED)};"
        f" e at 20 m/s: {plastic[-1]:.3f} plastic, {viscous[-1]:.3f} viscous"
    )


if __name__ == "__main__":
    print(main())
