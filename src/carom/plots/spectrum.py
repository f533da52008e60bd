"""The amplitude spectra of the forces of an impact, with their corner frequencies."""

from typing import Unpack

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_above
from carom.plots.look import Look
from carom.quantities.refusals import InputError

FORCES = {
    "normal": (style.BLUE, style.DASHES[0], "normal, $F_z$"),
    "tangential": (style.VERMILION, style.DASHES[1], "tangential, $F_x$"),
}
MARKS = {"corner": ("o", "\u22123 dB"), "half": ("s", "\u22126 dB")}
LOWEST = 1e-4  # of the largest amplitude


@draws(
    "the spectra of an impact, what Impact.spectrum returns",
    *(f"{name}_spectrum" for name in FORCES),
    *(f"{name}_{mark}_frequency" for name in FORCES for mark in MARKS),
    "normal_notch_frequency",
    along="frequency",
    take="spectrum",
)
def plot_spectrum(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the amplitude spectra of normal and tangential force on logarithmic axes.

    Marks stand at the corner frequencies, where an amplitude has fallen by 3 and by 6 dB; a dotted
    line at the first minimum of the normal force. The frequency zero is left out. The spectrum of
    the moment has the shape of that of the tangential force.

    Raises
    ------
    InputError
        If the dataset is another one, or has fewer than two frequencies above zero.

    Examples
    --------
    >>> carom.plots.plot_spectrum(hit.spectrum()).axes[0].get_xscale()
    'log'
    """
    shown = dataset.sortby("frequency")
    shown = shown.isel(frequency=np.unique(shown["frequency"].values, return_index=True)[1])
    shown = shown.isel(frequency=shown["frequency"].values > 0.0)
    if shown.sizes["frequency"] < 2:
        raise InputError("plot_spectrum: it needs two frequencies above zero, or more")
    figure, axis = style.single_axis(height=66.0)
    frequency, unit, times = style.scaled(shown, "frequency")
    largest = max(float(shown[f"{name}_spectrum"].max()) for name in FORCES)
    scale, force_unit = style.prefixed(largest, "N s")
    for name, (color, dash, label) in FORCES.items():
        values = scale * shown[f"{name}_spectrum"].values
        if values.any():
            axis.plot(frequency, values, color=color, ls=dash, label=label)
            for mark, (symbol, _) in MARKS.items():
                place = times * float(shown[f"{name}_{mark}_frequency"])
                height = np.interp(place, frequency, values, left=np.nan, right=np.nan)
                axis.plot(place, height, symbol, color=color, mfc="white", zorder=3)
    for symbol, label in MARKS.values():
        axis.plot([], [], symbol, color=style.BLACK, mfc="white", label=label)
    notch = times * float(shown["normal_notch_frequency"])
    if np.isfinite(notch):
        axis.axvline(notch, color="0.5", lw=0.8, ls=":", label="first minimum")
    axis.set(xscale="log", yscale="log", ylim=(LOWEST * largest * scale, 2.0 * largest * scale))
    style.span(axis, frequency)
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_xlabel(style.label("frequency", unit))
    axis.set_ylabel(rf"$|\hat F_z|$, $|\hat F_x|$ ({force_unit})")
    legend_above(axis, 3, columnspacing=0.8, handlelength=2.0)
    return figure
