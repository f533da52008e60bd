from . import style as style
from .animation import animate as animate, checked_animation as checked_animation
from .cone import plot_cone as plot_cone
from .contact import plot_contact as plot_contact
from .impact import plot_forces as plot_forces, plot_impact as plot_impact, plot_radii as plot_radii
from .laws import plot_error_map as plot_error_map, plot_laws as plot_laws
from .patch import plot_patch as plot_patch
from .profiles import plot_profiles as plot_profiles
from .regime_map import plot_regime_map as plot_regime_map
from .regimes import plot_curve as plot_curve
from .scores import plot_score as plot_score
from .spectrum import plot_spectrum as plot_spectrum
from .strength import plot_strength as plot_strength
from .stress import plot_stress as plot_stress
from .style import save_figure as save_figure
from .wear import plot_wear as plot_wear
