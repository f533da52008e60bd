r"""Find friction from measured rebounds
====================================

`carom.fit` finds friction, stiffness ratio and restitution from measured rebounds, with intervals.

Alumina spheres of 5 mm strike soda-lime glass at 3.9 m/s, from grazing to nearly normal (Kharaz,
Gorham & Salman 2001, Powder Technol. 120:281). The fit takes tangential restitution, spin and
rebound angle at once. The stiffness ratio that it finds is that of the elastic constants, which it
did not know. The laws of DEM codes, with the same friction, are up to several times further off:
they go wrong where the contact sticks, below 35 degrees. Errors of the digitisation, 0.002 in
:math:`e_t` and 2 rad/s, are smaller than the marks.
"""

import numpy as np

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

data = carom.datasets.load("kharaz2001")  # or "rebounds.csv", with pair=carom.Pair(...)
found = carom.fit(data)
print(found)
mu, kappa, e, pair = found.friction, found.kappa, found.restitution, found.pair

# %%
# Check: the literature models this experiment with a friction of 0.092.
assert mu.low < 0.092 < mu.high
assert 0.03 < (mu.high - mu.low) / mu.value < 0.15, "known to some per cent"
np.testing.assert_allclose(kappa.value, pair.kappa, rtol=0.05)

# %%
# The figure: the fit beside laws of DEM codes with the same friction. For a solid sphere without
# spin :math:`1 - e_t = (2/7)(1 - \psi_2/\psi_1)`, and the spin is
# :math:`(5/2)\,v_t\,(1 - e_t)/R`.
laws = {
    "linear spring": carom.dem.LinearSpring(),
    "mindlin": carom.dem.LammpsMindlin("mindlin"),
    "mindlin_rescale/force": carom.dem.LammpsMindlin("mindlin_rescale/force"),
    "Thornton": carom.dem.ThorntonLaw(),
    "rigid Coulomb": carom.dem.HardSphere(),
}
along = 2.5 * 3.9 / 2.5e-3 * np.sin(data.angle.values)  # (5/2) v_t/R
by_spin = 1.0 + data.spin_out.values / along


def restitution(angle, name):
    """Return e_t of a solid sphere by the fit or by a law of a DEM code."""
    stiffness = pair.kappa if name in laws else kappa.value  # as a user of the code would set it
    psi, chi = stiffness * np.tan(angle) / mu.value, 1.75 * stiffness
    if name in laws:
        after = laws[name].rebound(psi, chi, kappa=stiffness)
    else:
        after = carom.rebound(psi, chi, losses=carom.KelvinVoigt(restitution=e.value))
    return 1.0 - 2.0 / 7.0 * (1.0 - after / psi)


line, misfits = np.radians(np.linspace(0.5, 65.0, 130)), {}
with style():
    figure, ((left, middle, right),) = new_figure(1, 3, width=DOUBLE, height=72)
    for number, name in enumerate(("Carom's fit", *laws)):
        curve, there = restitution(line, name), restitution(data.angle.values, name)
        off = [data.tangential_restitution.values - there, by_spin - there]
        misfits[name] = float(np.sqrt(np.nanmean(np.square(off))))
        color = "0.5" if number == 5 else LINES[number - 1]
        look = {"color": color, "ls": DASHES[number % 5], "lw": 1.6 if number == 0 else 0.9}
        left.plot(np.degrees(line), curve, label=name, **look)
        middle.plot(np.degrees(line), 3900.0 * np.sin(line) * (1.0 - curve), **look)
        right.barh(-number, misfits[name], color=color, height=0.6)
    degrees = np.degrees(data.angle)
    left.plot(degrees, data.tangential_restitution, "ko", mfc="white", label="measured")
    middle.plot(degrees, -data.spin_out, "ko", mfc="white")
    left.set(title="tangential restitution", ylabel="$e_t$", ylim=(0.4, 1.0))
    middle.set(title="spin after", ylabel=r"$|\omega'|$ (rad/s)", ylim=(0.0, 800.0))
    for axis in (left, middle):
        axis.set(xlim=(0.0, 65.0), xlabel=r"$\theta$ (deg)")
    right.set_yticks([-number for number in range(6)], misfits)
    right.set(title="distance from the points", xlabel="rms in $e_t$")
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    save_figure(figure, "kharaz.png")
assert misfits["Carom's fit"] == min(misfits.values())
assert misfits["mindlin"] > 1.5 * misfits["Carom's fit"]
