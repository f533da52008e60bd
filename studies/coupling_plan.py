"""Which impacts the study of the coupling computes, and what each of them comes to."""

from itertools import product
from typing import NamedTuple

import numpy as np
from coupling_laws import Impact

import carom

SOLID = 1.75  # chi/kappa of a solid sphere on a half-space
SPEED, RADIUS = 3.9, 2.5e-3
PAIR = carom.Pair(
    carom.Sphere(radius=RADIUS, material="alumina"),
    carom.HalfSpace(material="soda-lime-glass"),
    0.092,
)
KAPPA, BETA, FRICTION = PAIR.kappa, PAIR.dundurs_beta, PAIR.friction
ANGLES = (1.84, 3.703, 6.143, 9.496, 10.991, 20.012, 21.251, 30.127, 31.157)  # as measured
STEEL = 0.823529412, 0.285714286, 0.3  # kappa, beta, friction; on a rigid plane, nu = 0.3
FALLS = (1.5, 2.0, 2.5, 3.0, 4.0)  # of friction before slip over that in sliding
# Finite elements: series "FEM" of test 5 of Chung & Ooi (2011), Granular Matter 13:643, as
# digitised in the benchmark data of Kratos, but for its first and last point. Pairs of
# x = V_x/(mu V_1) before the impact and y = V_x'/(mu V_1') after it; V_x: of the surface at the
# contact, along the plane, V_1: of the centre, along the normal
ELEMENTS = """0.2719 -0.0267 0.5861 -0.0267 0.8761 -0.0800 1.1903 -0.2133 1.5529 -0.3733
1.9154 -0.6267 2.3142 -0.9467 2.7855 -1.2533 3.3172 -1.5200 3.9698 -1.7200 4.7553 -1.7067
5.7583 -1.2000 7.1239 0.1333 9.1178 2.1467 12.3565 5.4267"""


class Row(NamedTuple):
    """What an impact came to."""

    psi_2: float
    restitution: float
    slipping: float
    slip_angle: float


Rows = dict[Impact, Row]


class Variant(NamedTuple):
    """A law at a strength and a physical scale, in SI units; `elements` across."""

    law: str = "coulomb"
    strength: float = 0.0
    scale: float = 0.0
    friction: float = FRICTION
    beta: float = BETA
    elements: int = 32

    @property
    def name(self) -> str:
        """What the table of variants calls it."""
        law = (
            f"{self.law} {self.strength:.3g} {self.scale:g}"
            if self.strength or self.scale
            else self.law
        )
        return f"{law}, friction {self.friction:.3g}, beta {self.beta:.3f}, {self.elements} across"

    def at(self, angle: float) -> Impact:
        """Return the impact of alumina on glass at an angle in degrees."""
        normal = SPEED * np.cos(np.radians(angle))
        scales = PAIR.scales(normal)
        units = {
            "slip": FRICTION * scales.length,
            "speed": FRICTION * normal,
            "asperities": scales.length,
            "layer": KAPPA,  # the scale is in a_max/G*
        }
        numbers = np.tan(np.radians(angle)) / self.friction, KAPPA, self.beta, self.friction
        law = self.law, self.strength, self.scale / units.get(self.law, 1.0)
        rounded = [float(f"{n:.9g}") for n in (*numbers, *law[1:])]
        grid = self.elements, round(4.6875 * self.elements)
        return Impact("alumina", f"{angle:g} deg", *rounded[:4], law[0], *rounded[4:], *grid)


FULL, LIKE = Variant(), Variant(beta=0.0)
SLIPS = [Variant("slip", r, s) for r, s in product(FALLS, (2e-7, 3e-7, 5e-7, 1e-6))]
BEST = Variant("slip", 3.0, 3e-7)
OTHERS = [
    *(Variant(friction=n * FRICTION) for n in (2.0, 3.0)),
    *(Variant("pressure", n) for n in (1 / 3, 2 / 3)),
    *(Variant("speed", 3.0, v) for v in (0.1, 0.3)),
    *(Variant("layer", 0.0, n) for n in (0.03, 0.1, 0.3)),
    *(Variant("asperities", 0.0, n) for n in (1e-7, 3e-7, 1e-6)),
]
CHECKS = [
    BEST._replace(beta=0.0),
    *(variant._replace(elements=48) for variant in (FULL, BEST)),
    *(Variant("speed", 3.0, v, elements=16) for v in (0.1, 0.3)),
]
SHARP = [
    Variant("slip", 4.0, s, elements=n) for s, n in product((1e-8, 3e-8, 1e-7, 3e-7), (32, 64))
]
KAPPAS, RATIOS = (0.83, 0.91), (0.6, 1.2, 1.8, 2.46, 3.1)  # of the map, |beta|/friction
XS = (0.15, 0.4, 0.8, 1.15, 1.5, 1.9, 2.4, 3.0, 3.6, 4.2, 4.8, 5.3, 5.8, 6.3, 7.0, 8.2)


def plan() -> list[Impact]:
    """Return all impacts of the study."""
    found = [variant.at(angle) for variant in (FULL, LIKE) for angle in ANGLES]
    for kappa, ratio, x in product(KAPPAS, RATIOS, XS):
        numbers = x, kappa, round(ratio * FRICTION, 6), FRICTION
        found.append(Impact("map", f"ratio {ratio:g}", *numbers, "coulomb", 0.0, 0.0, 24, 112))
    x = [float(x) for x in ELEMENTS.split()[::2]]
    found += [Impact("steel", "rigid", each, *STEEL, "coulomb", 0.0, 0.0, 32, 150) for each in x]
    found += [variant.at(ANGLES[1]) for variant in SHARP]
    found += [variant.at(angle) for variant in (*SLIPS, *OTHERS, *CHECKS) for angle in ANGLES]
    return list(dict.fromkeys(found))
