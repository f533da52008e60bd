"""The lines of Python that give what a view shows."""

from carom.explorer.views import View

BODIES = """\
import carom

pair = carom.Pair({first}, {second}, friction={friction!r})
hit = carom.impact(pair, speed={speed!r}, angle="{angle!r} deg", spin={spin!r})
print(hit.psi_in, hit.psi_out, hit.rebound_angle, hit.spin_out)
carom.save(hit.history(201), "history.csv")  # or .nc
hit.plot("history.png")
patch = hit.fields({time!r} * hit.duration)
carom.plots.save_figure(carom.plots.plot_patch(patch), "patch.png")
"""
NUMBERS = """\
import numpy as np

import carom

impact = carom.solve({psi!r}, {chi!r})
print(impact.psi_out, impact.phases)
history = impact.history(201)  # time, psi, force, radii, energies as arrays
curve = carom.curve({chi!r}, np.linspace(0.0, {most!r}, 241))
carom.plots.save_figure(carom.plots.plot_curve(curve), "curve.png")
"""
LAWS = """\
laws = {{entry.label: entry.law for entry in carom.verify.CATALOGUE}}
for label in {labels!r}:
    print(label, laws[label].rebound({psi}, {chi}, kappa={kappa}))
"""
DATA = """\
found = carom.fit(carom.datasets.load({name!r}))  # pip install 'carom[fit]'
print(found)
"""


def script(view: View, time: float) -> str:
    """Return the lines for a view, fields at a time that is a share of the duration."""
    parts = [_numbers(view) if view.in_numbers else _bodies(view, time)]
    if view.law:
        names = ("impact.psi_in", "impact.chi", "None")
        if not view.in_numbers:
            names = ("hit.psi_in", "pair.chi", "pair.kappa")
        psi, chi, kappa = names
        parts.append(LAWS.format(labels=view.law, psi=psi, chi=chi, kappa=kappa))
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


def _numbers(view: View) -> str:
    return NUMBERS.format(psi=view.psi, chi=view.chi, most=max(4.0 * view.chi, abs(view.psi)))
