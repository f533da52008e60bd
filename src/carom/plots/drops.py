"""Normal drops: restitution against speed, and the laws of losses fitted to it."""

from typing import Any, Unpack

from matplotlib.figure import Figure

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.look import Look

HEIGHT = 62.0  # in mm
LAW_STYLES: dict[str, Any] = {
    "constant": {"color": style.GREEN, "ls": (0, (1.5, 1))},
    "KelvinVoigt": {"color": style.BLUE, "ls": (0, (5, 1.5))},
    "ElasticPlastic": {"color": style.VERMILION, "ls": "-"},
}


@draws(
    "a fit of normal impacts, what carom.fit(...).to_dataset() returns",
    *("restitution", "normal_speed", "loss_speed", "loss_restitution"),
)
def plot_drops(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw measured restitutions against normal speed, and the laws of losses fitted to them.

    Error bars are standard deviations; of the laws the one that is likeliest comes first.

    Parameters
    ----------
    dataset : xarray.Dataset or result
        What `carom.fit(...).to_dataset()` returns, of impacts of which none is oblique.

    Examples
    --------
    >>> import carom
    >>> from carom.plots.drops import plot_drops
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> drops = {"drop_height": [0.1, 0.2, 0.4, 0.8], "rebound_height": [0.06, 0.1, 0.17, 0.29]}
    >>> len(plot_drops(carom.fit(drops, pair=pair).to_dataset()).axes)
    1
    """
    figure, axes = style.new_figure(1, 1, width=style.SINGLE, height=HEIGHT)
    axis = axes[0, 0]
    for law in dataset["loss_law"].values:
        curve = dataset["loss_restitution"].sel(loss_law=law)
        axis.plot(dataset["loss_speed"], curve, lw=1.1, label=str(law), **LAW_STYLES[str(law)])
    axis.errorbar(
        *(dataset["normal_speed"], dataset["restitution"], dataset["restitution_error"]),
        **style.POINTS,
        label="measured",
    )
    axis.set_xlabel(style.label("normal_speed"))
    axis.set_ylabel(style.label("normal_restitution"))
    axis.legend(loc="best")
    return figure
