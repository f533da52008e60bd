"""Figures, drawn from datasets: a stored file is drawn without solving again.

They are as wide as one column of a paper, 86 mm, or two, 178 mm; `save_figure` stores them.

Examples
--------
>>> import carom
>>> figure = carom.plots.plot_curve(carom.curve(1.44, [0.0, 0.5, 1.0, 2.0, 6.0]))
>>> float(round(25.4 * figure.get_figwidth(), 9))
86.0
"""

from carom.plots.animation import animate, checked_animation
from carom.plots.cone import plot_cone
from carom.plots.impact import plot_forces, plot_impact, plot_radii
from carom.plots.laws import plot_error_map, plot_laws
from carom.plots.patch import plot_patch
from carom.plots.profiles import plot_profiles
from carom.plots.regimes import plot_curve, plot_regime_map
from carom.plots.scores import plot_score
from carom.plots.stress import plot_stress
from carom.plots.style import save_figure

__all__ = [
    "animate",
    "checked_animation",
    "plot_cone",
    "plot_curve",
    "plot_error_map",
    "plot_forces",
    "plot_impact",
    "plot_laws",
    "plot_patch",
    "plot_profiles",
    "plot_radii",
    "plot_regime_map",
    "plot_score",
    "plot_stress",
    "save_figure",
]
