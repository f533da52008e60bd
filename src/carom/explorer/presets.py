"""Examples for a class: impacts with a story, and where their numbers are from."""

import tomllib
from importlib.resources import files
from typing import NamedTuple
from urllib.parse import urlencode


class Preset(NamedTuple):
    """An impact to begin with: its link's query, and what there is to see in it.

    `sources` say of each number where it was published or that it is assumed, `caution` where the
    theory of elastic spheres is stretched.
    """

    id: str
    title: str
    story: str
    query: str
    sources: tuple[str, ...]
    caution: str = ""


def _presets() -> tuple[Preset, ...]:
    told = tomllib.loads(files("carom").joinpath("data/presets.toml").read_text("utf-8"))
    shared = told["sources"]
    return tuple(
        Preset(
            name,
            each["title"],
            each["story"],
            urlencode(each["impact"]),
            tuple(shared.get(source, source) for source in each["sources"]),
            each.get("caution", ""),
        )
        for name, each in told["presets"].items()
    )


PRESETS = _presets()
