r"""Get the force and its spectrum
==============================

`hit.spectrum` gives the force of an impact in frequency, with its corners and first zero.

Left: the normal force in time, and below it how far the powers of a sine of the same peak and
duration are from it. Right: the amplitude spectra over the impulse of Hertz's pulse, with the
corners at -3 dB and -6 dB. The first zero lies at :math:`1.804/t_c`. For :math:`\sin^{3/2}` it lies
at :math:`1.75/t_c`, and for the half sine at :math:`1.5/t_c`.
"""

import numpy as np
from scipy.special import gamma, rgamma

import carom
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, styled, zero_line

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
hit = carom.impact(pair, normal_speed=2.0, tangential_speed=0.0)
spectrum = hit.spectrum(np.linspace(0.0, 6.0, 1201) / hit.duration)
print(f"half of the impulse's amplitude at {spectrum.normal_half_frequency:.0f} Hz", end=", ")
print(f"first zero at {spectrum.normal_notch_frequency:.0f} Hz")

# %%
# Hertz's pulse beside the powers of a sine that stand for it in codes and sensors.

BLUE, VERMILION, _, _, BLACK = LINES
POWERS = {1.5: (BLUE, DASHES[1], r"$\sin^{3/2}$"), 1.0: (VERMILION, DASHES[2], "half sine")}


def sine_spectrum(nu, cycles):
    """Return the amplitude spectrum of sin^nu(pi t), 0 < t < 1."""
    half = 0.5 * nu
    front = gamma(1.0 + nu) / 2.0**nu
    return front * np.abs(rgamma(1.0 + half + cycles) * rgamma(1.0 + half - cycles))


@styled
def draw(time, force, cycles, spectra, corners):
    """Draw pulses and their differences over time, spectra over frequency."""
    figure, axes = new_figure(2, 2, width=DOUBLE, height=92.0, height_ratios=(1.6, 1.0))
    pulse, difference = axes[:, 0]
    grid = axes[0, 0].get_gridspec()
    for axis in axes[:, 1]:
        axis.remove()
    right = figure.add_subplot(grid[:, 1])
    pulse.plot(time, force, color=BLACK, label="Hertz, exact")
    right.plot(cycles, spectra[0.0], color=BLACK, label="Hertz, exact")
    for nu, (color, dash, label) in POWERS.items():
        power = np.sin(np.pi * time) ** nu
        pulse.plot(time, power, color=color, ls=dash, label=label)
        difference.plot(time, 100.0 * (power - force), color=color, ls=dash)
        right.plot(cycles, spectra[nu], color=color, ls=dash, label=label)
    for place, share, mark in zip(corners, (0.5**0.5, 0.5), "os", strict=True):
        right.plot(place, share, mark, color=BLACK, mfc="white")
    zero_line(difference)
    pulse.set(title="force in time", xlim=(0.0, 1.0), ylim=(0.0, 1.05), ylabel=r"$F_z/P_{max}$")
    difference.set(xlim=(0.0, 1.0), xlabel=r"$t/t_c$", ylabel="difference (% of peak)")
    right.set(xscale="log", yscale="log", xlim=(0.05, cycles[-1]), ylim=(1e-4, 2.0))
    right.set(title="amplitude spectrum", xlabel=r"$f\,t_c$", ylabel=r"$|\hat F_z|/J_n$")
    figure.legend(*right.get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


history = hit.history(2001)
time = history.time.values / hit.duration
force = history.normal_force.values / hit.max_force
far = {nu: float(np.abs(np.sin(np.pi * time) ** nu - force).max()) for nu in POWERS}
np.testing.assert_allclose([far[1.5], far[1.0]], [0.02432, 0.16899], atol=1e-5)

cycles, impulse = spectrum.frequency.values * hit.duration, float(spectrum.normal_impulse)
spectra = {0.0: spectrum.normal_spectrum.values / impulse}
for nu in POWERS:
    spectra[nu] = sine_spectrum(nu, cycles) * hit.max_force * hit.duration / impulse
np.testing.assert_allclose([s[0] for s in spectra.values()], [1.0, 1.02356, 1.17109], atol=1e-5)
names = ("corner", "half", "notch")
told = [float(spectrum[f"normal_{name}_frequency"]) * hit.duration for name in names]
np.testing.assert_allclose(told, [0.669616, 0.927810, 1.804028], atol=1e-6)

save_figure(draw(time, force, cycles, spectra, told[:2]), "force_pulse.png")
more = spectra[1.5][0] - 1.0
print(
    f"sin^1.5 is off by {100 * far[1.5]:.1f} % of the peak, {100 * more:.1f} % of the impulse;"
    f" the first zero lies at {told[2]:.3f}/t_c instead of 1.75/t_c"
)
