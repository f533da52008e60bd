"""Figures, drawn from datasets: a stored file is drawn without solving again."""

from carom.plots.animation import animate, checked_animation
from carom.plots.cone import plot_cone
from carom.plots.impact import plot_forces, plot_impact, plot_radii
from carom.plots.patch import plot_patch
from carom.plots.profiles import plot_profiles
from carom.plots.regimes import plot_curve, plot_regime_map
from carom.plots.stress import plot_stress
from carom.plots.style import save_figure

__all__ = [
    "animate",
    "checked_animation",
    "plot_cone",
    "plot_curve",
    "plot_forces",
    "plot_impact",
    "plot_patch",
    "plot_profiles",
    "plot_radii",
    "plot_regime_map",
    "plot_stress",
    "save_figure",
]
