"""What the page shows, as the words of a link: every state has one, and every link a state."""

from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, NamedTuple, Self
from urllib.parse import parse_qs, urlencode

from carom.bodies.losses import KelvinVoigt
from carom.bodies.materials import materials
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.datasets.shipped import names as dataset_names
from carom.explorer.limits import LONGEST_LINK
from carom.quantities.refusals import InputError, nearest, refusal
from carom.quantities.texts import Unreadable, read_text
from carom.verify.catalogue import CATALOGUE
from carom.verify.errors import losses_of

BODIES, NUMBERS = "bodies", "numbers"
OF_BODIES = ("radius", "material", "against", "second_radius", "second_material")
OF_MOTION = ("speed", "angle", "spin")
OF_NUMBERS = ("psi", "chi")
OF_BOTH = ("friction", "restitution")
AGAINST = ("half-space", "sphere", "cup")
LAWS = tuple(entry.label for entry in CATALOGUE)
UNDAMPED = tuple(each.label for each in CATALOGUE if not hasattr(each.law, "restitution"))
LONGEST_NAME = 80  # characters of an unknown name that are shown
PAGE_ONLY = ("time", "pace", "theme")  # what the page alone keeps of a link


class Knob(NamedTuple):
    """A number on the page: its unit there, what is allowed, and what its slider spans."""

    unit: str
    least: float
    most: float
    slider: tuple[float, float, float] | None  # from, to, step

    def read(self, name: str, text: Any) -> float:
        """Return the number in a text, or raise InputError."""
        unit = f" {self.unit}" if self.unit else ""
        allowed = f"must be a number from {self.least:g} to {self.most:g}{unit}"
        if not text:
            raise InputError(f"{name}: missing; {allowed}")
        try:
            value = read_text(str(text), self.unit or "1")
        except Unreadable as error:
            reason = f"{error}; " if str(error) else ""
            raise refusal(name, text, f"{reason}{allowed}") from None
        if not self.least <= value <= self.most:
            raise refusal(name, text, allowed)
        return value


KNOBS = {
    "radius": Knob("mm", 1e-3, 1e4, None),
    "second_radius": Knob("mm", 1e-3, 1e4, None),
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
    "material": tuple(materials()),
    "against": AGAINST,
    "second_material": tuple(materials()),
    "data": ("", *dataset_names()),
}


@dataclass(frozen=True)
class View:
    """A state of the page: bodies and their motion, or psi_1 and chi, and what lies over them."""

    given: str = BODIES
    radius: float = 5.0
    material: str = "bearing-steel"
    against: str = "half-space"
    second_radius: float = 10.0
    second_material: str = "bearing-steel"
    friction: float = 0.2
    restitution: float = 1.0
    speed: float = 0.6
    angle: float = 30.0
    spin: float = 0.0
    psi: float = 1.5
    chi: float = 1.44
    law: tuple[str, ...] = ()
    data: str = ""

    @classmethod
    def of(cls, query: str) -> Self:
        """Return the view of a link's query, or raise InputError for the first thing wrong."""
        view, wrong = cls.with_complaints(query)
        for name, error in wrong.items():
            if name not in view.unused:
                raise error
        return view

    @classmethod
    def with_complaints(cls, query: str) -> tuple[Self, dict[str, InputError]]:
        """Return the view of a link, defaults in place of what cannot be used, and why by name."""
        if not isinstance(query, str):
            return cls(), {"link": refusal("link", query, "must be text")}
        if len(query) > LONGEST_LINK:
            long = f"link: {len(query)} characters, at most {LONGEST_LINK} are read"
            return cls(), {"link": InputError(long)}
        found: dict[str, Any] = {}
        wrong: dict[str, InputError] = {}
        given = parse_qs(query.lstrip("?"), keep_blank_values=True)
        for name, texts in given.items():
            if name in PAGE_ONLY:
                continue
            try:
                found[name] = _read(name, texts)
            except InputError as error:
                wrong[name] = error
        return cls(**found), wrong

    def query(self) -> str:
        """Return the link's query: what differs from the page as it opens."""
        now = [(field, getattr(self, field.name)) for field in fields(self)]
        changed = {field.name: _text(value) for field, value in now if value != field.default}
        return urlencode(changed, doseq=True)

    @property
    def in_numbers(self) -> bool:
        """Whether psi_1 and chi are given instead of bodies."""
        return self.given == NUMBERS

    @property
    def unused(self) -> tuple[str, ...]:
        """What does not matter in this view, and may be anything."""
        if self.in_numbers:
            return (*OF_BODIES, *OF_MOTION)
        return OF_NUMBERS if self.against != "half-space" else (*OF_NUMBERS, "second_radius")

    @cached_property
    def pair(self) -> Pair:
        """The bodies; InputError if they do not fit."""
        first = Sphere(radius=self.radius * 1e-3, material=self.material)
        return Pair(first, self._second(), self.friction)

    def _second(self) -> Counterbody:
        if self.against == "half-space":
            return HalfSpace(material=self.second_material)
        body = Sphere if self.against == "sphere" else Cup
        return body(radius=self.second_radius * 1e-3, material=self.second_material)

    @property
    def losses(self) -> KelvinVoigt | None:
        """What the impact loses energy to besides friction."""
        return losses_of(self.restitution)

    @property
    def undamped(self) -> tuple[str, ...]:
        """The contact laws that have no damping, and cannot be laid over losses."""
        return tuple(label for label in self.law if label in UNDAMPED and self.losses)

    @property
    def laid_over(self) -> tuple[str, ...]:
        """The other contact laws, each with the damping for the restitution."""
        return tuple(label for label in self.law if label not in self.undamped)

    @property
    def motion(self) -> dict[str, Any]:
        """Speed, angle and spin as `carom.impact` takes them."""
        return {"speed": self.speed, "angle": f"{self.angle!r} deg", "spin": self.spin}


def _read(name: str, texts: list[str]) -> Any:
    """Return what the words of a link say of one thing, or raise InputError."""
    known = tuple(field.name for field in fields(View))
    if name not in known:
        shown = " ".join(name.split())[:LONGEST_NAME]
        raise InputError(f"{shown}: unknown in a link; {nearest(name, known) or 'leave it out'}")
    if name == "law":
        return tuple(dict.fromkeys(_one_of(name, text, LAWS) for text in texts if text))
    if name in KNOBS:
        return KNOBS[name].read(name, texts[-1])
    return _one_of(name, texts[-1], CHOICES[name])


def _one_of(name: str, text: str, known: Iterable[str]) -> str:
    if text not in known:
        hint = nearest(text, known) or f"must be one of: {'; '.join(filter(None, known))}"
        raise refusal(name, text, hint)
    return text


def _text(value: Any) -> Any:
    if isinstance(value, tuple):
        return list(value)
    return repr(value).removesuffix(".0") if isinstance(value, float) else value
