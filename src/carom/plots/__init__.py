"""Figures, drawn from datasets: a stored file is drawn without solving again.

They are as wide as one column of a paper, 86 mm, or two, 178 mm; `save_figure` stores them.

Examples
--------
>>> import carom
>>> figure = carom.plots.plot_curve(carom.curve(1.44, [0.0, 0.5, 1.0, 2.0, 6.0]))
>>> float(round(25.4 * figure.get_figwidth(), 9))
86.0
"""

from carom.names import attach

__getattr__, __dir__, __all__ = attach(__name__, __file__)
__all__.remove("style")
