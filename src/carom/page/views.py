"""What the page shows, as the words of a link: every state has one, and every link a state.

Also the fields of the page: what each is called, what it may be, and how it is refused. Their words
stand in `data/page.toml`, with others of the page.
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cached_property, partial
from math import inf, isfinite
from typing import Any, NamedTuple, Self
from urllib.parse import parse_qs, urlencode

from carom.bodies.losses import KelvinVoigt, ZenerPlate
from carom.bodies.materials import Material, material, materials
from carom.bodies.pairs import Counterbody, Pair
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.folder import DATA
from carom.lab.datasets.shipped import names as dataset_names
from carom.page.limits import LONGEST_LINK
from carom.quantities.refusals import InputError, clipped, nearest
from carom.quantities.texts import Unreadable, read_text
from carom.verify.entries import CATALOGUE
from carom.verify.errors import losses_of

PAGE = tomllib.loads((DATA / "page.toml").read_text("utf-8"))
BODIES, NUMBERS = "bodies", "numbers"
PLANE, SPHERE, CUP = AGAINST = ("half-space", "sphere", "cup")
OWN, RIGID = "own", "rigid"
MATERIALS = (*materials(), OWN)
OF_MATERIAL = ("young", "poisson", "density")
SECOND = "second_"
LAWS = tuple(entry.label for entry in CATALOGUE)
UNDAMPED = tuple(each.label for each in CATALOGUE if not hasattr(each.law, "restitution"))
PAGE_ONLY = (  # words of links that are for the page alone
    *("time", "pace", "theme", "slow", "tab", "preset", "beside", "level", "story"),
)
LONGEST_NAME = 80  # characters of an unknown name that are shown
CHOICES: dict[str, tuple[str, ...]] = {
    "given": (BODIES, NUMBERS),
    "material": MATERIALS,
    "against": AGAINST,
    "second_material": (*MATERIALS[:-1], RIGID, OWN),
    "law": LAWS,
    "data": ("", *dataset_names()),
}


class Field(NamedTuple):
    """A field: its label, its letter and a hint; of a number its unit, its range and its slider.

    `plain` is its label in the first level of the page, where only fields that have one are shown;
    `of_balls` that between two balls, if it is another.

    `otherwise` is the word for no number, which is an infinite one, `needs` what other fields must
    be for this one to matter.
    """

    label: str
    plain: str = ""
    of_balls: str = ""
    symbol: str = ""
    hint: str = ""
    unit: str = ""
    least: float = 0.0
    most: float = 0.0
    slider: tuple[float, float, float] | None = None  # from, to, step
    otherwise: str = ""
    needs: Mapping[str, list[str]] = {}

    @property
    def is_number(self) -> bool:
        """Whether the field holds a number."""
        return self.most > self.least


FIELDS = {name: Field(**words) for name, words in PAGE["fields"].items()}


def in_words(text: str) -> str:
    """Return a text of the library without its arguments and letters spelt out."""
    for pattern, words in PAGE["wording"].items():
        text = re.sub(pattern, words, text)
    return text


class Refused(InputError):
    """A field of the page cannot be what it is, in the page's own words; "" is the whole link.

    Its text begins with the label of the field, for those who have no field to look at. `more` is
    what else the page is told, as lists to choose from for a file.
    """

    def __init__(self, field: str, message: str, **more: Any) -> None:
        super().__init__(f"{FIELDS[field].label}: {message}" if field else message)
        self.field = field
        self.message = " ".join(message.splitlines())
        self.more = more

    def __reduce__(self) -> Any:
        return partial(Refused, **self.more), (self.field, self.message)


def read_number(name: str, text: Any) -> float:
    """Return the number in the text of a field, or raise Refused."""
    field = FIELDS[name]
    if field.otherwise and str(text).strip() in ("", field.otherwise):
        return inf
    unit = f" {field.unit}" if field.unit else ""
    allowed = f"must be a number from {field.least:g} to {field.most:g}{unit}"
    allowed += f", or {field.otherwise}" if field.otherwise else ""
    if not text:
        raise Refused(name, f"{allowed}; it is empty")
    reason = ""
    try:
        value = read_text(str(text), field.unit or "1")
        if field.least <= value <= field.most:
            return value
    except Unreadable as error:
        reason = f"; {error}" if str(error) else ""
    raise Refused(name, f"{allowed}, not '{clipped(str(text))}'{reason}")


def one_of(name: str, text: str) -> str:
    """Return a text that is a choice of a field, or raise Refused with the nearest of them."""
    if text not in (words := CHOICES[name]):
        shown = clipped(text)[:LONGEST_NAME]
        hint = nearest(text, words) or f"there are {'; '.join(filter(None, words))}"
        raise Refused(name, f"there is no '{shown}'; {hint}")
    return text


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
    thickness: float = inf
    friction: float = 0.2
    restitution: float = 1.0
    inelasticity: float = 0.0
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
        if len(query) > LONGEST_LINK:
            long = f"the link has {len(query)} characters; at most {LONGEST_LINK} are read"
            raise Refused("", long)
        values: dict[str, Any] = {}
        wrong: dict[str, Refused] = {}
        for name, texts in parse_qs(query.lstrip("?"), keep_blank_values=True).items():
            try:
                if name not in PAGE_ONLY:
                    values[name] = _read(name, texts)
            except Refused as error:
                wrong[name] = error
        view = cls(**values)
        for name, refused in wrong.items():
            if name not in view.unused:
                raise refused
        return view

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
            for name, field in FIELDS.items()
            if any(getattr(self, other) not in words for other, words in field.needs.items())
        )

    @cached_property
    def pair(self) -> Pair:
        """The bodies; Refused if they do not fit."""
        if self.against == CUP and not self.second_radius > self.radius:
            allowed = f"must be above {self.radius:g} mm: the ball has to fit into the cup"
            raise Refused("second_radius", allowed)
        if self.against == SPHERE and self.second_material == RIGID:
            why = "a ball that moves must have a density, which a rigid one has not; take another"
            raise Refused("second_material", why)
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
            if not self.on_plate:
                return HalfSpace(material=stuff)
            if self.second_material == RIGID:
                raise Refused("second_material", "a rigid plate gives no way; take another")
            return HalfSpace(material=stuff, thickness=self.thickness * 1e-3)
        shape = Sphere if self.against == SPHERE else Cup
        return shape(radius=self.second_radius * 1e-3, material=stuff)

    @property
    def on_plate(self) -> bool:
        """Whether it is a plate, which gives way, that is struck."""
        if self.in_numbers:
            return self.inelasticity > 0.0
        return self.against == PLANE and isfinite(self.thickness)

    @property
    def is_lossy(self) -> bool:
        """Whether the normal motion loses energy, to the bodies or to waves in a plate."""
        return self.on_plate or self.restitution != 1.0

    @property
    def losses(self) -> KelvinVoigt | ZenerPlate | None:
        """What `carom.impact` and `carom.solve` take as losses, or Refused."""
        if not self.on_plate:
            return losses_of(self.restitution)
        if self.restitution != 1.0:
            raise Refused("restitution", "must be 1 on a plate: the bodies are elastic so far")
        return ZenerPlate(inelasticity=self.inelasticity) if self.in_numbers else None

    @property
    def undamped(self) -> tuple[str, ...]:
        """The contact laws that have no damping, and cannot be laid over losses."""
        return tuple(label for label in self.law if label in UNDAMPED and self.is_lossy)

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
    if name not in FIELDS:
        shown = " ".join(name.split())[:LONGEST_NAME]
        hint = nearest(name, FIELDS) or "leave it out"
        raise Refused("", f"the link says '{shown}', which is unknown; {hint}")
    if name == "law":
        return tuple(dict.fromkeys(one_of(name, text) for text in texts if text))
    if FIELDS[name].is_number:
        return read_number(name, texts[-1])
    return one_of(name, texts[-1])


def _text(value: Any) -> Any:
    if isinstance(value, tuple):
        return list(value)
    return repr(value).removesuffix(".0") if isinstance(value, float) else value
