"""Draw docs/figures/turning_paths.png from studies/turning_paths.csv.

python docs/make/turning_figure.py
"""

import pandas as pd
from run_pages import DOCS, store_small

from carom.plots.legends import legend_above
from carom.plots.style import DASHES, LINES, new_figure, style

LAWS = {  # columns, and what they are called
    "load_path": "load_path",
    "springs": "32 springs",
    "mindlin_rescale/force": "mindlin_rescale/force",
}
TICKS = (0.1, 0.2, 0.5, 1, 2, 3)


def main() -> None:
    """Draw the circles, not the impacts."""
    table = pd.read_csv(DOCS.parent / "studies" / "turning_paths.csv")
    circles = table[table.path.str.startswith("circle")]
    radius = circles.path.str.split().str[1].astype(float)
    with style():
        figure, ((axes,),) = new_figure(width=86, height=62)
        for (column, name), color, dash in zip(LAWS.items(), LINES, DASHES, strict=False):
            axes.plot(radius, circles[column], color=color, ls=dash, marker="o", ms=3, label=name)
        axes.set(xscale="log", yscale="log", ylim=(1e-4, 1))
        axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
        axes.minorticks_off()
        axes.set_xlabel(r"radius of the circle, $\kappa U/(\mu d)$")
        axes.set_ylabel(r"largest error of the force over $\mu P$")
        legend_above(axes, 3)
        store_small(figure, DOCS / "figures" / "turning_paths.png")


if __name__ == "__main__":
    main()
