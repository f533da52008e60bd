"""At which sizes and speeds does a steel ball rebound as the theory says?

python studies/validity_map.py    prints the limits and draws docs/figures/validity.png
"""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

import carom
from carom.impacts.validity import SLOW_CONTACT, SMALL_CONTACT, YIELD_PRESSURE
from carom.plots import style
from carom.plots.bands import STICK

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "validity.png"
MATERIAL = carom.material("bearing-steel")
ROUGHNESS, ROUGH = 0.02e-6, 0.05  # m; of the penetration (Greenwood, Johnson & Matsubara 1984)
ADHESION, CLOSE = 0.1, 0.01  # J/m^2; loss of restitution
RADII = np.geomspace(1e-6, 0.1, 101)
TORN = 7.09  # work of separation over (Gamma^5 R^4/E^2)^(1/3) of Johnson, Kendall & Roberts


def pair(radius: float) -> carom.Pair:
    """Return a ball on a plate of its own steel."""
    ball = carom.Sphere(radius=radius, material=MATERIAL)
    return carom.Pair(ball, carom.HalfSpace(material=MATERIAL), friction=0.2)


def upper() -> dict[str, float]:
    """Return the normal speeds in m/s at which assumptions end; they hold for every radius."""
    one = pair(1e-3)
    scales = one.scales(1.0)
    hit = carom.impact(one, speed=1.0, angle=0.0)
    transits = next(f.value for f in hit.validity.findings if f.name.startswith("contact time"))
    bound = YIELD_PRESSURE * (MATERIAL.yield_strength or np.nan)
    return {
        "yields": (bound / scales.pressure) ** 2.5,
        "waves": (transits / SLOW_CONTACT) ** 5,
        "too large": (SMALL_CONTACT * one.effective_radius / scales.radius) ** 2.5,
    }


def rough() -> Any:
    """Return the speeds below which roughness is more than a twentieth of the penetration."""
    return [(ROUGHNESS / ROUGH / pair(r).scales(1.0).length) ** 1.25 for r in RADII]


def sticky() -> Any:
    """Return the speeds below which separation takes more than a hundredth of the speed."""
    work = TORN * (ADHESION**5 * RADII**4 / pair(1e-3).effective_modulus ** 2) ** (1 / 3)
    mass = [pair(r).normal_mass for r in RADII]
    return np.sqrt(2.0 * work / mass / (1.0 - (1.0 - CLOSE) ** 2))


def draw(axis: Axes) -> None:
    """Draw the lines and what is between them."""
    tops, low = upper(), np.maximum(rough(), sticky())
    top = min(tops.values())
    axis.fill_between(RADII * 1e3, low, top, where=low < top, color=STICK.face, lw=0.0)
    places = zip(tops.items(), (style.BLACK, style.VERMILION, style.PURPLE), strict=True)
    for number, ((name, speed), color) in enumerate(places):
        label = f"{name}, {speed:.3g} m/s"
        axis.axhline(speed, color=color, ls=style.DASHES[number], lw=0.9, label=label)
    axis.loglog(RADII * 1e3, rough(), color=style.BLUE, label="roughness 0.02 µm")
    axis.loglog(
        RADII * 1e3, sticky(), color=style.GREEN, ls=style.DASHES[1], label="adhesion 0.1 J/m²"
    )
    axis.set(xlim=(1e-3, 100), ylim=(1e-4, 1e3), xlabel="radius (mm)", ylabel="normal speed (m/s)")
    axis.text(6.0, 0.12, "exact", color="0.3")
    axis.legend(loc="lower left", bbox_to_anchor=(-0.15, 1.0), ncols=2)


def main() -> None:
    """Print the limits and draw."""
    print({name: f"{speed:.3g} m/s" for name, speed in upper().items()})
    with style.style():
        figure, axes = style.new_figure(height=72)
        draw(axes[0, 0])
        style.save_figure(figure, FIGURE)


if __name__ == "__main__":
    main()
