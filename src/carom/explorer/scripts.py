"""The lines of Python that give what a view shows."""

from carom.explorer.views import View

BODIES = """\
import numpy as np

import carom

pair = carom.Pair({first}, {second}, friction={friction!r})
hit = carom.impact(pair, speed={speed!r}, angle="{angle!r} deg", spin={spin!r})
print(hit.psi_in, hit.psi_out, hit.rebound_angle, hit.spin_out)
carom.save(hit.history(201), "history.csv")  # or .nc
hit.plot("history.png")
patch = hit.fields({time!r} * hit.duration)
carom.plots.save_figure(carom.plots.plot_patch(patch), "patch.png")
"""
CURVE = """\
most = max(4.5 * {chi}, 1.15 * abs({psi}))  # all regimes, and this impact
psi = np.linspace(0.0, most, 241) * np.copysign(1.0, {psi})
figure = carom.plots.plot_curve(carom.curve({chi}, np.sort(psi)))
axis = figure.axes[0]
shown = axis.get_legend().legend_handles
shown += axis.plot({psi}, {out}, "o", label="this impact")
"""
SAVED = """\
axis.legend(handles=shown)
carom.plots.save_figure(figure, "curve.png")
"""
NUMBERS = """\
import numpy as np

import carom

impact = carom.solve({psi!r}, {chi!r})
print(impact.psi_out, impact.phases)
history = impact.history(201)  # time, psi, force, radii, energies as arrays
"""
FREE = """\
psi = np.linspace(0.0, 4.5 * {chi}, 241)  # all regimes; without friction there is no psi_1
figure = carom.plots.plot_curve(carom.curve({chi}, psi))
axis = figure.axes[0]
shown = axis.get_legend().legend_handles
"""
LAWS = """\
laws = {{entry.label: entry.law for entry in carom.verify.CATALOGUE}}
for label in {labels!r}:
    print(label, laws[label].rebound({psi}, {chi}, kappa={kappa}))
    shown += axis.plot(psi, laws[label].rebound(psi, {chi}, kappa={kappa}), "--", label=label)
"""
DATA = """\
found = carom.fit(carom.datasets.load({name!r}))  # pip install 'carom[fit]'
print(found)
"""


def script(view: View, time: float) -> str:
    """Return the lines for a view, fields at a time that is a share of the duration."""
    names = {"psi": "hit.psi_in", "out": "hit.psi_out", "chi": "pair.chi", "kappa": "pair.kappa"}
    rubs = view.in_numbers or view.friction > 0.0
    if view.in_numbers:
        names = {"psi": "impact.psi_in", "out": "impact.psi_out", "chi": "impact.chi"}
        names["kappa"] = "None"
    parts = [NUMBERS.format(psi=view.psi, chi=view.chi) if view.in_numbers else _bodies(view, time)]
    parts.append((CURVE if rubs else FREE).format(**names))
    if view.law:
        parts.append(LAWS.format(labels=view.law, **names))
    parts.append(SAVED)
    if view.data:
        parts.append(DATA.format(name=view.data))
    return "".join(parts)


def _bodies(view: View, time: float) -> str:
    kinds = {"half-space": "HalfSpace", "sphere": "Sphere", "cup": "Cup"}
    first = f'carom.Sphere(radius="{view.radius!r} mm", material={view.material!r})'
    sized = f'radius="{view.second_radius!r} mm", ' if view.against != "half-space" else ""
    second = f"carom.{kinds[view.against]}({sized}material={view.second_material!r})"
    return BODIES.format(
        first=first,
        second=second,
        friction=view.friction,
        speed=view.speed,
        angle=view.angle,
        spin=view.spin,
        time=min(max(time, 0.0), 1.0),
    )
