"""The fields of the page: what each is called, what it may be, and what its slider spans."""

from typing import Any, NamedTuple

from carom.bodies.materials import materials
from carom.datasets.shipped import names as dataset_names
from carom.explorer.limits import Refused
from carom.quantities.refusals import clipped, nearest
from carom.quantities.texts import Unreadable, read_text

BODIES, NUMBERS = "bodies", "numbers"
PLANE, SPHERE, CUP = AGAINST = ("half-space", "sphere", "cup")
OWN, RIGID = "own", "rigid"
MATERIALS = (*materials(), OWN)
OF_MATERIAL = ("young", "poisson", "density")
SECOND = "second_"


class Words(NamedTuple):
    """What the page says of a field: its label, its symbol there, and a hint to point at."""

    label: str
    symbol: str
    hint: str


class Knob(NamedTuple):
    """A number on the page: its unit there, what is allowed, and what its slider spans."""

    unit: str
    least: float
    most: float
    slider: tuple[float, float, float] | None = None  # from, to, step

    def read(self, name: str, text: Any) -> float:
        """Return the number in a text, or raise Refused."""
        unit = f" {self.unit}" if self.unit else ""
        allowed = f"must be a number from {self.least:g} to {self.most:g}{unit}"
        if not text:
            raise refused(name, f"{allowed}; it is empty")
        shown = clipped(str(text))
        try:
            value = read_text(str(text), self.unit or "1")
        except Unreadable as error:
            reason = f"; {error}" if str(error) else ""
            raise refused(name, f"{allowed}, not '{shown}'{reason}") from None
        if not self.least <= value <= self.most:
            raise refused(name, f"{allowed}, not '{shown}'")
        return value


KNOBS = {
    "radius": Knob("mm", 1e-3, 1e4),
    "young": Knob("GPa", 1e-4, 1e4),
    "poisson": Knob("", 0.0, 0.5, (0.0, 0.5, 0.01)),
    "density": Knob("kg/m^3", 1.0, 3e4),
    "second_radius": Knob("mm", 1e-3, 1e4),
    "second_young": Knob("GPa", 1e-4, 1e4),
    "second_poisson": Knob("", 0.0, 0.5, (0.0, 0.5, 0.01)),
    "second_density": Knob("kg/m^3", 1.0, 3e4),
    "friction": Knob("", 0.0, 10.0, (0.0, 1.0, 0.005)),
    "restitution": Knob("", 0.05, 1.0, (0.3, 1.0, 0.01)),
    "speed": Knob("m/s", 1e-4, 1e3, (0.05, 10.0, 0.05)),
    "angle": Knob("deg", 0.0, 89.9, (0.0, 89.0, 0.25)),
    "spin": Knob("rad/s", -1e6, 1e6, (-1000.0, 1000.0, 5.0)),
    "psi": Knob("", -1e6, 1e6, (0.0, 10.0, 0.01)),
    "chi": Knob("", 0.05, 10.0, (0.5, 3.0, 0.005)),
}
CHOICES: dict[str, tuple[str, ...]] = {
    "given": (BODIES, NUMBERS),
    "material": MATERIALS,
    "against": AGAINST,
    "second_material": (*MATERIALS[:-1], RIGID, OWN),
    "data": ("", *dataset_names()),
}
OF_BODIES: dict[str, tuple[str, ...]] = {"given": (BODIES,)}
OWN_FIRST = OF_BODIES | {"material": (OWN,)}
OWN_SECOND = OF_BODIES | {"second_material": (OWN,)}
# what other fields must be for one to matter; it is not shown otherwise
NEEDS: dict[str, dict[str, tuple[str, ...]]] = {
    "psi": {"given": (NUMBERS,)},
    "chi": {"given": (NUMBERS,)},
    **dict.fromkeys(("speed", "angle", "spin", "radius", "material", "against"), OF_BODIES),
    **dict.fromkeys(OF_MATERIAL, OWN_FIRST),
    "second_radius": OF_BODIES | {"against": (SPHERE, CUP)},
    "second_material": OF_BODIES,
    "second_young": OWN_SECOND,
    "second_poisson": OWN_SECOND,
    "second_density": OWN_SECOND | {"against": (SPHERE,)},  # others do not move
}
OPTIONS = {  # what a choice is called where its word is not what one would say
    BODIES: "bodies",
    NUMBERS: "ψ₁ and χ",
    PLANE: "plane",
    SPHERE: "ball",
    RIGID: "rigid",
    OWN: "own material",
    "": "none",
}
YOUNG = Words("Young's modulus", "E", "stiffness in tension; steel has 210 GPa, rubber 0.01 GPa")
POISSON = Words("Poisson's ratio", "ν", "how much it narrows when stretched; most have 0.2 to 0.5")
DENSITY = Words("Density", "ρ", "mass per volume; steel has 7850, glass 2500, nylon 1140 kg/m³")
WORDS = {
    "given": Words("Given are", "", "the bodies and their motion, or the two numbers that count"),
    "radius": Words("Ball radius", "R", "other units may be written, as in 3 cm or 200 um"),
    "material": Words("Ball material", "", ""),
    "young": YOUNG,
    "poisson": POISSON,
    "density": DENSITY,
    "against": Words("Strikes a", "", "a plane and a cup do not move; a ball is free"),
    "second_radius": Words(
        "Its radius", "R₂", "a cup must be larger than the ball that strikes it"
    ),
    "second_material": Words("Its material", "", "of the body that is struck"),
    "second_young": YOUNG,
    "second_poisson": POISSON,
    "second_density": DENSITY,
    "friction": Words("Friction", "µ", "largest ratio of tangential to normal force"),
    "restitution": Words(
        "Restitution", "e", "normal velocity after to before; 1 is without losses but friction"
    ),
    "speed": Words("Speed", "V", "of the centres, before"),
    "angle": Words("Incidence", "θ", "of the velocity, from the normal; 0 is head-on"),
    "spin": Words("Spin", "ω", "of the ball before; positive is backspin"),
    "psi": Words(
        "Velocity before", "ψ₁", "of the contact point along the surface, scaled by friction"
    ),
    "chi": Words(
        "Inertia to stiffness", "χ", "tangential against normal; solid balls have 1.2 to 1.75"
    ),
    "law": Words("Contact law", "", "laid over the exact curves"),
    "data": Words("Measured rebounds", "", "that come along"),
}
LONGEST_NAME = 80  # characters of an unknown name that are shown


def label(name: str) -> str:
    """Return what the page calls a field, the second body's told apart from the ball's."""
    words = WORDS.get(name)
    if words is None:
        return ""
    of_second = name.removeprefix(SECOND) in OF_MATERIAL and name.startswith(SECOND)
    return f"{words.label}, second body" if of_second else words.label


def refused(name: str, message: str) -> Refused:
    """Return the error that refuses what a field is."""
    return Refused(name, message, label(name))


def one_of(name: str, text: str, known: tuple[str, ...]) -> str:
    """Return a word that is one of those known, or raise Refused with the nearest of them."""
    if text not in known:
        shown = clipped(text)[:LONGEST_NAME]
        hint = nearest(text, known) or f"there are {'; '.join(filter(None, known))}"
        raise refused(name, f"there is no '{shown}'; {hint}")
    return text
