"""Parameters from measured rebounds
=================================

Friction and restitution from published rebounds, and contact laws against the same points.

5 mm alumina spheres strike soda-lime glass at 3.9 m/s, from grazing to nearly normal (Kharaz,
Gorham & Salman 2001, Powder Technol. 120:281). `fit` finds friction, stiffness ratio and
restitution from tangential restitution, spin and rebound angle at once. The stiffness ratio that it
finds is that of the elastic constants, which it did not know. The laws of DEM codes, each with the
friction that suits it best, are up to several times further off: they go wrong where the contact
sticks, below 35 degrees.
"""

from pathlib import Path

import numpy as np

import carom
from carom.plots.style import (
    BLACK,
    BLUE,
    DASHES,
    DOUBLE,
    GREEN,
    PURPLE,
    VERMILION,
    new_figure,
    save_figure,
    styled,
)

OWN = "Carom's fit"
SPEED, RADIUS = 3.9, 2.5e-3  # m/s, m
SPHERE = 2.0 / 7.0  # m_t/m_n of a solid sphere on a fixed body
LAWS = {
    "linear spring": (carom.dem.LinearSpring(), BLUE),
    "mindlin": (carom.dem.LammpsMindlin("mindlin"), VERMILION),
    "mindlin_rescale/force": (carom.dem.LammpsMindlin("mindlin_rescale/force"), GREEN),
    "Thornton": (carom.dem.ThorntonLaw(), PURPLE),
    "rigid Coulomb": (carom.dem.HardSphere(), "0.5"),
}


def restitution(angle, friction, kappa, rebound):
    """Return e_t of the centre of a solid sphere without spin, from a law's psi_2(psi_1)."""
    psi = kappa * np.tan(angle) / friction
    return 1.0 - SPHERE * (1.0 - rebound(psi) / psi)


def spin(angle, tangential):
    """Return the spin that goes with e_t: (2/5) m R^2 omega = -m R v_t (1 - e_t)."""
    return -2.5 * SPEED * np.sin(angle) / RADIUS * (1.0 - tangential)


def misfit(data, friction, kappa, rebound):
    """Return the rms distance in e_t from all points, with spins converted to e_t."""
    angle = data.angle.values
    found = restitution(angle, friction, kappa, rebound)
    own = 1.0 + data.spin_out.values * RADIUS / (2.5 * SPEED * np.sin(angle))
    off = np.concatenate([data.tangential_restitution.values - found, own - found])
    return float(np.sqrt(np.nanmean(off**2)))


@styled
def draw(data, curves, misfits):
    """Draw e_t and spin against incidence with all curves, and how far each law is off."""
    figure, axes = new_figure(1, 3, width=DOUBLE, height=68.0)
    left, middle, right = axes[0]
    degrees = np.degrees(data.angle.values)
    dots = {"ls": "none", "marker": "o", "ms": 3, "color": BLACK, "zorder": 3}
    left.plot(degrees, data.tangential_restitution, label="measured", **dots)
    middle.plot(degrees, -data.spin_out, **dots)
    for number, (name, (angle, tangential, color)) in enumerate(curves.items()):
        how = {"color": color, "ls": DASHES[number % len(DASHES)], "lw": 1.6 - 0.7 * (number > 0)}
        left.plot(np.degrees(angle), tangential, label=name, **how)
        middle.plot(np.degrees(angle), -spin(angle, tangential), **how)
    left.set(ylim=(0.4, 1.0), title="Rebound of the centre", ylabel="tangential restitution $e_t$")
    middle.set(ylim=(0.0, 800.0), title="Spin", ylabel=r"spin after the impact $|\omega'|$ (rad/s)")
    for axis in (left, middle):
        axis.set(xlim=(0.0, 65.0), xlabel=r"angle of incidence $\theta$ (deg)")
    places = np.arange(len(misfits))[::-1]
    right.barh(places, misfits.values(), color=[color for *_, color in curves.values()], height=0.6)
    right.set_yticks(places, misfits)
    right.set(xlabel="rms distance in $e_t$", xlim=(0.0, None), title="Distance from all points")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=7)
    return figure


def main(folder: str | Path = ".") -> str:
    """Fit the measured rebounds, put contact laws beside them, and draw both."""
    data = carom.datasets.load("kharaz2001")
    found = carom.fit(data)
    mu, kappa, e = found.friction, found.kappa, found.restitution
    assert mu.low < 0.092 < mu.high, "the literature models the experiment with 0.092"
    assert 0.03 < (mu.high - mu.low) / mu.value < 0.15, "known to some per cent"
    np.testing.assert_allclose(kappa.value, found.pair.kappa, rtol=0.05)

    chi = 0.5 * kappa.value / SPHERE
    exact = lambda psi: carom.rebound(psi, chi, losses=carom.KelvinVoigt(restitution=e.value))  # noqa: E731
    line = np.radians(np.linspace(0.5, 65.0, 130))
    curves = {OWN: (line, restitution(line, mu.value, kappa.value, exact), BLACK)}
    misfits = {OWN: misfit(data, mu.value, kappa.value, exact)}
    elastic = found.pair.kappa  # as a user of a DEM code would set it
    for name, (law, color) in LAWS.items():
        rebound = lambda psi, law=law: law.rebound(psi, found.pair.chi, kappa=elastic)  # noqa: E731
        misfits[name] = misfit(data, mu.value, elastic, rebound)
        curves[name] = (line, restitution(line, mu.value, elastic, rebound), color)
    assert misfits[OWN] == min(misfits.values())
    assert misfits["mindlin"] > 1.5 * misfits[OWN]

    save_figure(draw(data, curves, misfits), Path(folder) / "kharaz.png")
    return (
        f"mu = {mu.value:.3f} ({mu.low:.3f} to {mu.high:.3f}), e = {e.value:.3f}, kappa ="
        f" {kappa.value:.3f} (elastic constants: {elastic:.3f}); rms distance"
        f" {misfits[OWN]:.3f}, mindlin {misfits['mindlin']:.3f}"
    )


if __name__ == "__main__":
    print(main())
