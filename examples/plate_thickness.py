"""Drop a ball on a plate
======================

`carom.HalfSpace(thickness=)` is a plate that bends: waves carry energy away, and :math:`e` falls.

Left: Zener's theory (1941), in which the plate bends as a whole; dotted where its bending waves
are shorter than six thicknesses, so that 1 - e is an estimate. Right: the same for steel on steel
near e = 1, beside what all waves of an elastic layer take away, to first order; circles mark six
thicknesses. The energy that waves take is

.. math:: W = \\frac{1}{\\pi} \\int_0^\\infty |\\hat P|^2 \\, \\mathrm{Re} \\, Y \\, d\\omega,

with the spectrum of Hertz's force and the mobility Y of the layer under a point force, from the
equations of Rayleigh and Lamb. A thin plate has :math:`Y = 1/(8 \\sqrt{D \\rho h})`.
"""

from math import nan, pi, sqrt

import numpy as np

import carom
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, DOUBLE, LINES, new_figure, save_figure, styled

ball = carom.Sphere(radius="5 mm", material="bearing-steel")
for thickness in ("3 mm", "10 mm", "30 mm"):
    plate = carom.HalfSpace(material="bearing-steel", thickness=thickness)
    hit = carom.impact(carom.Pair(ball, plate, friction=0.15), speed="0.5 m/s", angle="30 deg")
    print(f"{thickness}: e {hit.normal_restitution:.3f}, {1e6 * hit.duration:.1f} us in contact")

# %%
# Any thickness, by the theory of thin plates and by all waves of an elastic layer.

BODIES = (
    ("bearing-steel", "bearing-steel"),
    ("bearing-steel", "float-glass"),
    ("float-glass", "bearing-steel"),
)
SPEEDS = (0.1, 1.0)  # m/s
NEAR_ONE = (0.1, 1.0, 5.0)
DAMPING = 0.01  # of the frequency, from which the mobility is extrapolated to none
# t_c c_L/h, and what waves of a layer take, of what a thin plate loses, at a Poisson's ratio of 0.3
TABLE = {100: 1.02, 50: 1.04, 20: 1.11, 11: 1.21, 8: 1.30, 6: 1.43, 4: 1.78, 3: 2.50, 2: 5.35}


def mobility(frequencies, poisson, layer=True):
    """Return Re Y of a layer, or of a half-space; h, mu, rho and so c_T are 1."""

    def damped(damping):
        omega = frequencies[:, None] * (1.0 + 1j * damping)
        shear = omega**2
        slowest = np.minimum(frequencies, np.sqrt(frequencies * sqrt(6.0 * (1.0 - poisson))))
        fastest = 400.0 * np.maximum(np.sqrt(4.0 * frequencies), np.maximum(frequencies, 3.0))
        u = np.linspace(np.log(1e-4 * slowest), np.log(fastest), 6000, axis=1)
        k = np.exp(u)
        a = np.sqrt(k**2 - shear * (0.5 - poisson) / (1.0 - poisson))
        b = np.sqrt(k**2 - shear)
        normal, mixed = (2.0 * k**2 - shear) ** 2, 4.0 * k**2 * a * b
        compliance = 2.0 / (normal - mixed)
        if layer:  # faces that move against each other, and together
            p, q = np.tanh(0.5 * a), np.tanh(0.5 * b)
            compliance = 1.0 / (normal / p - mixed / q) + 1.0 / (normal * p - mixed * q)
        dynamic = -0.5 * shear * a * compliance - (1.0 - poisson) / k  # without the static dent
        return np.trapezoid((-0.5j * omega / pi * k**2 * dynamic).real, u, axis=1)

    return 2.0 * damped(DAMPING) - damped(2.0 * DAMPING)


def thin(poisson):
    """Return 1/(8 sqrt(D rho h)) in these units."""
    return 0.125 * sqrt(6.0 * (1.0 - poisson))


def pulse():
    """Return frequencies times the contact time, and the power spectrum of Hertz's force."""
    pair = carom.Pair(
        carom.Sphere(radius="5 mm", material="steel"), carom.HalfSpace("steel"), friction=0.0
    )
    hit = carom.impact(pair, speed=0.1, angle=0.0)
    spectrum = hit.spectrum(max_frequency=10.0 / hit.duration, n=1001)
    return 2.0 * pi * spectrum.frequency.values * hit.duration, spectrum.normal_spectrum.values**2


def excess(ratios, poisson):
    """Return what waves of a layer take, of what a thin plate loses, at ratios t_c c_L/h."""
    omega, power = pulse()
    over = np.geomspace(1e-2, 300.0, 400)
    factor = mobility(over, poisson) / thin(poisson)
    speed = sqrt((2.0 - 2.0 * poisson) / (1.0 - 2.0 * poisson))  # c_L/c_T
    at = [np.interp(omega * speed / ratio, over, factor, left=1.0) for ratio in ratios]
    return np.trapezoid(power * np.array(at), omega, axis=1) / np.trapezoid(power, omega)


def bent(pair, speed):
    """Return an impact on a thin plate, also where the contact ends before an echo is back."""
    wall = carom.HalfSpace(pair.second.material)
    law = carom.ZenerPlate(inelasticity=1.25**0.4 * pair.plate_give(speed))
    return carom.impact(carom.Pair(pair.first, wall, 0.0), speed=speed, angle=0.0, losses=law)


def impacts(first, second, speed, thicknesses):
    """Return e, bending waves in thicknesses, and t_c c_L/h, for thicknesses in radii of a ball."""
    rows = []
    for h in thicknesses:
        wall = carom.HalfSpace(second, thickness=5e-3 * h)
        pair = carom.Pair(carom.Sphere(radius="5 mm", material=first), wall, friction=0.0)
        try:
            hit = bent(pair, speed)
        except carom.InputError:  # a foil
            rows.append((nan, nan, nan))
            continue
        stuff = wall.material
        stiffness = stuff.young * wall.thickness**2 / (12.0 * (1.0 - stuff.poisson**2))
        wave = 2.0 * sqrt(pi * hit.duration * sqrt(stiffness / stuff.density)) / wall.thickness
        lame = stuff.young * (1.0 - stuff.poisson) / (1.0 + stuff.poisson)
        fast = sqrt(lame / (1.0 - 2.0 * stuff.poisson) / stuff.density)
        rows.append((hit.normal_restitution, wave, hit.duration * fast / wall.thickness))
    return np.array(rows).T


@styled
def draw(wide, near, radii, thick):
    """Draw e against the thickness, and 1 - e in logarithmic axes."""
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=72.0)
    left, right = axes
    for i, ((first, second), rows) in enumerate(wide.items()):
        for (e, wave, _), width in zip(rows, (1.4, 0.7), strict=True):
            left.plot(radii, np.where(wave >= 6.0, e, nan), color=LINES[i], lw=width)
            left.plot(radii, np.where(wave < 6.0, e, nan), color=LINES[i], lw=width, ls=":")
        left.plot([], [], color=LINES[i], label=f"{first} on {second}".replace("-", " "))
    left.set(xlim=(0.0, 6.0), ylim=(0.0, 1.0), ylabel="coefficient of restitution $e$")
    left.text(5.8, 0.05, "thick lines 0.1 m/s, thin lines 1 m/s,\ndotted: an estimate", ha="right")
    for i, (speed, (e, wave, exact)) in enumerate(near.items()):
        right.plot(thick, 1.0 - e, color=LINES[i], lw=0.7, ls="--")
        label = f"all waves, {speed:g} m/s"
        right.plot(thick, np.where(exact < 0.1, exact, nan), color=LINES[i], label=label)
        border = np.interp(-6.0, -wave, thick)
        loss = np.interp(border, thick, 1.0 - e)
        right.plot(border, loss, "o", color=LINES[i], mfc="white")
    right.plot([], [], color=BLACK, lw=0.7, ls="--", label="thin plate")
    right.plot([], [], "o", color=BLACK, mfc="white", label="bending wave of 6 $h$")
    right.axhline(0.01, color="0.6", lw=0.6)
    right.text(1.1, 0.0094, "$e$ = 0.99", color="0.4", va="top")
    right.set(xscale="log", yscale="log", xlim=thick[[0, -1]], ylim=(5e-4, 0.3), ylabel="$1 - e$")
    right.set_xticks([1, 2, 5, 10, 20, 50], minor=False)
    right.xaxis.set_major_formatter("{x:g}")
    right.yaxis.set_major_formatter("{x:g}")
    right.minorticks_off()
    for axis in axes:
        axis.set_xlabel("thickness of the plate over radius of the ball, $h/R$")
    legend_above(left, 2)
    legend_above(right, 2)
    return figure


slow, fast = np.array([0.02, 0.05]), np.array([60.0, 120.0])
for poisson in (0.0, 0.3, 0.45):  # the bending wave has k^2 h^2 = omega sqrt(6 (1 - nu))
    longer = thin(poisson) * (1.0 + 0.2 * slow * sqrt(6.0 * (1.0 - poisson)))
    np.testing.assert_allclose(mobility(slow, poisson), longer, rtol=1e-3)
np.testing.assert_allclose(mobility(fast, 0.3), mobility(fast, 0.3, layer=False), rtol=1e-2)
factors = excess(TABLE, 0.3)
np.testing.assert_allclose(factors, [*TABLE.values()], atol=6e-3)
radii, thick = np.linspace(0.15, 6.0, 80), np.geomspace(1.0, 50.0, 60)
wide = {pair: [impacts(*pair, v, radii) for v in SPEEDS] for pair in BODIES}
scale = excess(np.geomspace(0.5, 300.0, 80), carom.material("bearing-steel").poisson)
near = {}
for speed in NEAR_ONE:
    e, wave, ratio = impacts("bearing-steel", "bearing-steel", speed, thick)
    exact = (1.0 - e) * np.interp(ratio, np.geomspace(0.5, 300.0, 80), scale)
    near[speed] = e, wave, exact
enough = {v: np.interp(-0.01, -exact, thick) for v, (*_, exact) in near.items()}
by_bending = [np.interp(0.99, e, thick) for e, *_ in near.values()]
np.testing.assert_allclose(by_bending, [4.1, 5.2, 6.1], atol=0.06)
floors = [exact[-1] for *_, exact in near.values()]
np.testing.assert_allclose(floors, [0.00085, 0.00338, 0.00886], rtol=5e-3)
np.testing.assert_allclose([*enough.values()], [4.4, 6.1, 8.9], atol=0.06)
save_figure(draw(wide, near, radii, thick), "plate_thickness.png")
needed = ", ".join(f"{h:.1f} R at {v:g} m/s" for v, h in enough.items())
print(
    f"steel on steel, e > 0.99 needs {needed}; where bending waves are six thicknesses long,"
    f" 1 - e is {factors[3]:.2f} times that of a thin plate"
)
