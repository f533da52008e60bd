"""What the page shows, as the words of a link: every state has one, and every link a state."""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Self
from urllib.parse import parse_qs, urlencode

from carom.bodies.losses import KelvinVoigt
from carom.bodies.materials import Material, material
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.explorer.knobs import (
    BODIES,
    CHOICES,
    CUP,
    KNOBS,
    LONGEST_NAME,
    NEEDS,
    NUMBERS,
    OF_MATERIAL,
    OWN,
    PLANE,
    RIGID,
    SECOND,
    SPHERE,
    one_of,
    refused,
)
from carom.explorer.limits import LONGEST_LINK, Refused
from carom.quantities.refusals import nearest
from carom.verify.entries import CATALOGUE
from carom.verify.errors import losses_of

LAWS = tuple(entry.label for entry in CATALOGUE)
UNDAMPED = tuple(each.label for each in CATALOGUE if not hasattr(each.law, "restitution"))
PAGE_ONLY = ("time", "pace", "theme", "slow", "tab", "preset", "beside")  # the page alone has them


@dataclass(frozen=True)
class View:
    """A state of the page: bodies and their motion, or psi_1 and chi, and what lies over them."""

    given: str = BODIES
    radius: float = 5.0
    material: str = "bearing-steel"
    young: float = 210.0
    poisson: float = 0.3
    density: float = 7850.0
    against: str = PLANE
    second_radius: float = 10.0
    second_material: str = "bearing-steel"
    second_young: float = 70.0
    second_poisson: float = 0.23
    second_density: float = 2500.0
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
        """Return the view of a link's query, or raise Refused for the first thing wrong."""
        view, wrong = cls.with_complaints(query)
        for name, error in wrong.items():
            if name not in view.unused:
                raise error
        return view

    @classmethod
    def with_complaints(cls, query: str) -> tuple[Self, dict[str, Refused]]:
        """Return the view of a link, defaults in place of what cannot be used, and why by name."""
        if not isinstance(query, str):
            return cls(), {"link": Refused("", "a link must be text")}
        if len(query) > LONGEST_LINK:
            long = f"the link has {len(query)} characters; at most {LONGEST_LINK} are read"
            return cls(), {"link": Refused("", long)}
        found: dict[str, Any] = {}
        wrong: dict[str, Refused] = {}
        for name, texts in parse_qs(query.lstrip("?"), keep_blank_values=True).items():
            if name in PAGE_ONLY:
                continue
            try:
                found[name] = _read(name, texts)
            except Refused as error:
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
        return tuple(
            name
            for name, needs in NEEDS.items()
            if any(getattr(self, other) not in words for other, words in needs.items())
        )

    @cached_property
    def pair(self) -> Pair:
        """The bodies; Refused if they do not fit."""
        if self.against == CUP and not self.second_radius > self.radius:
            told = f"must be above {self.radius:g} mm: the ball has to fit into the cup"
            raise refused("second_radius", told)
        if self.against == SPHERE and self.second_material == RIGID:
            told = "a ball that moves must have a density, which a rigid one has not; take another"
            raise refused("second_material", told)
        first = Sphere(radius=self.radius * 1e-3, material=self.stuff())
        return Pair(first, self._second(), self.friction)

    def stuff(self, which: str = "") -> Material:
        """Return the material of the ball, or with "second_" that of the second body."""
        name = getattr(self, f"{which}material")
        if name != OWN:
            return material(name)
        young, poisson, density = (getattr(self, which + part) for part in OF_MATERIAL)
        return Material(young=young * 1e9, poisson=poisson, density=density, name=OWN)

    def _second(self) -> Counterbody:
        stuff = self.stuff(SECOND)
        if self.against == PLANE:
            return HalfSpace(material=stuff)
        shape = Sphere if self.against == SPHERE else Cup
        return shape(radius=self.second_radius * 1e-3, material=stuff)

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
    """Return what the words of a link say of one thing, or raise Refused."""
    known = tuple(field.name for field in fields(View))
    if name not in known:
        shown = " ".join(name.split())[:LONGEST_NAME]
        hint = nearest(name, known) or "leave it out"
        raise Refused("", f"the link says '{shown}', which is unknown; {hint}")
    if name == "law":
        return tuple(dict.fromkeys(one_of(name, text, LAWS) for text in texts if text))
    if name in KNOBS:
        return KNOBS[name].read(name, texts[-1])
    return one_of(name, texts[-1], CHOICES[name])


def _text(value: Any) -> Any:
    if isinstance(value, tuple):
        return list(value)
    return repr(value).removesuffix(".0") if isinstance(value, float) else value
