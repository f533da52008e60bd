"""The fields of the page: what each is called, what it may be, and how it is refused.

The words stand in `data/page.toml`, with others of the page.
"""

import tomllib
from collections.abc import Mapping
from importlib.resources import files
from typing import Any, NamedTuple

from carom.bodies.materials import materials
from carom.datasets.shipped import names as dataset_names
from carom.quantities.refusals import InputError, clipped, nearest
from carom.quantities.texts import Unreadable, read_text

PAGE = tomllib.loads(files("carom").joinpath("data/page.toml").read_text("utf-8"))
BODIES, NUMBERS = "bodies", "numbers"
PLANE, SPHERE, CUP = AGAINST = ("half-space", "sphere", "cup")
OWN, RIGID = "own", "rigid"
MATERIALS = (*materials(), OWN)
OF_MATERIAL = ("young", "poisson", "density")
SECOND = "second_"
LONGEST_NAME = 80  # characters of an unknown name that are shown
CHOICES: dict[str, tuple[str, ...]] = {
    "given": (BODIES, NUMBERS),
    "material": MATERIALS,
    "against": AGAINST,
    "second_material": (*MATERIALS[:-1], RIGID, OWN),
    "data": ("", *dataset_names()),
}


class Field(NamedTuple):
    """A field: its label, its letter and a hint; of a number its unit, its range and its slider.

    `needs` says what other fields must be for this one to matter.
    """

    label: str
    symbol: str = ""
    hint: str = ""
    unit: str = ""
    least: float = 0.0
    most: float = 0.0
    slider: tuple[float, float, float] | None = None  # from, to, step
    needs: Mapping[str, list[str]] = {}

    @property
    def is_number(self) -> bool:
        """Whether the field holds a number."""
        return self.most > self.least


FIELDS = {name: Field(**words) for name, words in PAGE["fields"].items()}


class Refused(InputError):
    """A field of the page cannot be what it is, in the page's own words; "" is the whole link.

    Its text begins with the label of the field, for those who have no field to look at.
    """

    def __init__(self, field: str, message: str) -> None:
        super().__init__(f"{FIELDS[field].label}: {message}" if field else message)
        self.field = field
        self.message = " ".join(message.splitlines())

    def __reduce__(self) -> tuple[type["Refused"], tuple[str, str]]:
        return Refused, (self.field, self.message)


def read_number(name: str, text: Any) -> float:
    """Return the number in the text of a field, or raise Refused."""
    field = FIELDS[name]
    unit = f" {field.unit}" if field.unit else ""
    allowed = f"must be a number from {field.least:g} to {field.most:g}{unit}"
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


def one_of(name: str, text: str, words: tuple[str, ...]) -> str:
    """Return a text that is one of these words, or raise Refused with the nearest of them."""
    if text not in words:
        shown = clipped(text)[:LONGEST_NAME]
        hint = nearest(text, words) or f"there are {'; '.join(filter(None, words))}"
        raise Refused(name, f"there is no '{shown}'; {hint}")
    return text
