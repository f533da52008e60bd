"""Loading, or compiling, all that an answer needs, so that none has to wait for it."""

from carom import datasets
from carom.explorer.overlays import exact_curve, law_curves
from carom.explorer.scenes import impact_of, scene_of
from carom.explorer.uploads import fit_of
from carom.explorer.views import LAWS, NUMBERS, View


def warm_up() -> None:
    """Answer once what can be asked: bodies, numbers, laws, fields, a fit."""
    for view in (View(law=LAWS), View(given=NUMBERS)):
        scene = scene_of(view)
        exact_curve(scene)
        law_curves(scene, view.law)
    hit = impact_of(View())
    hit.fields(0.5 * hit.duration)
    fit_of(datasets.names()[0])
