"""The lines of Python that give what the page shows."""

from carom.explorer.knobs import OF_MATERIAL, OWN, SECOND
from carom.explorer.views import View

IMPORTS = """\
import numpy as np

import carom

"""
LOSSES = """\
losses = carom.KelvinVoigt(restitution={e!r})
"""
BODIES = """\
pair = carom.Pair({first}, {second}, friction={friction!r})
hit = carom.impact(pair, speed={speed!r}, angle="{angle!r} deg", spin={spin!r}{losses})
print(hit.psi_in, hit.psi_out, hit.rebound_angle, hit.spin_out)
carom.save(hit.history(201), "history.csv")  # or .nc
hit.plot("history.png")
patch = hit.fields({time!r} * hit.duration)
carom.plots.save_figure(carom.plots.plot_patch(patch), "patch.png")
"""
NUMBERS = """\
impact = carom.solve({psi!r}, {chi!r}{losses})
print(impact.psi_out, impact.phases)
history = impact.history(201)  # time, psi, force, radii, energies as arrays
"""
CURVE = """\
most = max(4.5 * {chi}, 1.15 * abs({psi}))  # all regimes, and this impact
psi = np.linspace(0.0, most, 241) * np.copysign(1.0, {psi})
figure = carom.plots.plot_curve(carom.curve({chi}, np.sort(psi){losses}))
axis = figure.axes[0]
shown = axis.get_legend().legend_handles
shown += axis.plot({psi}, {out}, "o", label="this impact")
"""
FREE = """\
psi = np.linspace(0.0, 4.5 * {chi}, 241)  # all regimes; without friction there is no psi_1
figure = carom.plots.plot_curve(carom.curve({chi}, psi{losses}))
axis = figure.axes[0]
shown = axis.get_legend().legend_handles
"""
LAWS = """\
laws = {{entry.label: entry.law for entry in carom.verify.catalogue()}}
for label in {labels!r}:
    law = {law}
{told}    shown += axis.plot(psi, law.rebound(psi, {chi}, kappa={kappa}), "--", label=label)
"""
TOLD = "    print(label, law.rebound({psi}, {chi}, kappa={kappa}))\n"
LAW, DAMPED = "laws[label]", "dataclasses.replace(laws[label], restitution={e!r})"
SAVED = """\
axis.legend(handles=shown)
carom.plots.save_figure(figure, "curve.png")
"""
DATA = """\
found = carom.fit(carom.datasets.load({name!r}))  # pip install 'carom[fit]'
print(found)
"""


def script(view: View, time: float) -> str:
    """Return the lines for a view, fields at a time that is a share of the duration."""
    e, losses = view.restitution, ", losses=losses" if view.losses else ""
    names = {"psi": "hit.psi_in", "out": "hit.psi_out", "chi": "pair.chi", "kappa": "pair.kappa"}
    if view.in_numbers:
        names = {"psi": "impact.psi_in", "out": "impact.psi_out", "chi": "impact.chi"}
        names["kappa"] = "None"
    damps = bool(view.losses and view.laid_over)
    parts = ["import dataclasses\n\n" if damps else "", IMPORTS]
    parts.append(LOSSES.format(e=e) if losses else "")
    if view.in_numbers:
        parts.append(NUMBERS.format(psi=view.psi, chi=view.chi, losses=losses))
    else:
        parts.append(_bodies(view, time, losses))
    rubs = view.in_numbers or view.friction > 0.0
    parts.append((CURVE if rubs else FREE).format(losses=losses, **names))
    if view.laid_over:
        law = DAMPED.format(e=e) if damps else LAW
        told = TOLD.format(**names) if rubs else ""
        parts.append(LAWS.format(labels=view.laid_over, law=law, told=told, **names))
    parts.append(SAVED)
    if view.data:
        parts.append(DATA.format(name=view.data))
    return "".join(parts)


def _bodies(view: View, time: float, losses: str) -> str:
    kinds = {"half-space": "HalfSpace", "sphere": "Sphere", "cup": "Cup"}
    first = f'carom.Sphere(radius="{view.radius!r} mm", material={_stuff(view)})'
    sized = f'radius="{view.second_radius!r} mm", ' if view.against != "half-space" else ""
    second = f"carom.{kinds[view.against]}({sized}material={_stuff(view, SECOND)})"
    bodies = {"first": first, "second": second, "friction": view.friction}
    motion = {"speed": view.speed, "angle": view.angle, "spin": view.spin}
    return BODIES.format(**bodies, **motion, time=min(max(time, 0.0), 1.0), losses=losses)


def _stuff(view: View, which: str = "") -> str:
    """Return the material of the ball, or with "second_" that of the second body."""
    name = getattr(view, f"{which}material")
    if name != OWN:
        return repr(name)
    young, poisson, density = (getattr(view, which + part) for part in OF_MATERIAL)
    return f'carom.Material(young="{young!r} GPa", poisson={poisson!r}, density={density!r})'
