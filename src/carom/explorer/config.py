"""What the page is made from: its fields, materials, laws, symbols, examples; as JSON holds it."""

from dataclasses import fields
from math import isinf
from typing import Any

from carom.bodies.materials import material
from carom.datasets import names as dataset_names, path
from carom.explorer.knobs import CHOICES, KNOBS, NEEDS, OPTIONS, OWN, WORDS, label
from carom.explorer.limits import LARGEST_UPLOAD, LONGEST_LINK
from carom.explorer.presets import PRESETS
from carom.explorer.scenes import ENERGIES, OF_CONTACT
from carom.explorer.tables import RESTITUTIONS
from carom.explorer.views import LAWS, PAGE_ONLY, View
from carom.impacts.curves import REGIMES as LONG
from carom.io.tables import read_table
from carom.io.version import __version__
from carom.quantities.glossary import GLOSSARY
from carom.verify.entries import CATALOGUE

REGIMES = ("stick", "gross slip, stick", "gross slip, slip", "gross slip only")  # as in figures


def config(*, static: bool = False) -> dict[str, Any]:
    """Return what the page reads once, before anything is asked; a static one has no server."""
    return {
        "version": __version__,
        "static": static,
        "page_only": PAGE_ONLY,
        "longest_link": LONGEST_LINK,
        "largest_upload": LARGEST_UPLOAD,
        "fields": _fields() | (_of_copy() if static else {}),
        "materials": {name: _material(name) for name in CHOICES["second_material"] if name != OWN},
        "laws": [{"label": entry.label, "used_by": entry.used_by} for entry in CATALOGUE],
        "regimes": [{"name": name, "long": long} for name, long in zip(REGIMES, LONG, strict=True)],
        "symbols": SYMBOLS,
        "energies": ENERGIES | OF_CONTACT,
        "presets": [preset._asdict() for preset in PRESETS],
        "datasets": [{"name": name, "title": _title(name)} for name in dataset_names()],
    }


def _fields() -> dict[str, dict[str, Any]]:
    choices = CHOICES | {"law": LAWS}
    found = {}
    for field in fields(View):
        knob, words = KNOBS.get(field.name), WORDS[field.name]
        options = [[value, OPTIONS.get(value, value)] for value in choices.get(field.name, ())]
        default = list(field.default) if isinstance(field.default, tuple) else field.default
        found[field.name] = {
            "label": label(field.name),
            "unit": knob.unit.replace("^3", "³") if knob else "",
            "symbol": words.symbol,
            "hint": words.hint,
            "least": knob.least if knob else None,
            "most": knob.most if knob else None,
            "slider": knob.slider if knob else None,
            "choices": options or None,
            "default": default,
            "needs": NEEDS.get(field.name, {}),
        }
    return found


def _of_copy() -> dict[str, dict[str, Any]]:
    """Return the fields that differ in a copy without a server, which has tables and no units."""
    held = [[f"{e:g}", OPTIONS.get(f"{e:g}", f"{e:g}")] for e in RESTITUTIONS]
    known = _fields()
    chosen = {"slider": None, "choices": held, "default": f"{View.restitution:g}"}
    plain = {"hint": ""}  # its numbers are read in the unit of the field alone
    return {"restitution": known["restitution"] | chosen, "radius": known["radius"] | plain}


def _material(name: str) -> dict[str, float | None]:
    stuff = material(name)
    young = None if isinf(stuff.young) else stuff.young
    return {"young": young, "poisson": stuff.poisson, "density": stuff.density}


def _title(name: str) -> str:
    return str(read_table(path(name)).comments["title"])


def _named(name: str, more: str = "") -> str:
    """Return the meaning of a quantity of the glossary as a sentence, and what is to be added."""
    meaning = GLOSSARY[name].meaning
    return f"{meaning[0].upper()}{meaning[1:]}{more}."


SYMBOLS = {  # one sentence each, for who points at one
    # what decides
    "ψ₁": "How obliquely the contact point arrives: ψ₁ = κ Vₓ/(µ V₁). Up to 1 it sticks at once.",
    "ψ₂": "The same number after the impact. It is negative if the contact point leaves backwards.",
    "ψ": "Tangential velocity of the contact point over the largest that sticks from the first "
    "touch: ψ = κ Vₓ/(µ V₁).",
    "χ": "How fast the contact turns the tangential motion back, against the normal one: "
    "χ = (κ/2) (mₙ/mₜ), about 1.45 for solid balls of steel.",
    "κ": "How stiff the contact is sideways, against pressing: κ = G*/E*, about 0.83 for steel.",
    "µ": _named("friction", ": surfaces that slide rub with µ times the normal force"),
    # what is given
    "R": "Radius of the ball.",
    "R₂": "Radius of the second body.",
    "E": _named("young", ": how stiff the material is"),
    "ν": _named("poisson", ": how much the material grows thinner when it is stretched"),
    "ρ": "Density of the material.",
    "e": "Normal speed after the impact over that before it; 1 without losses.",
    "V": _named("speed"),
    "V₁": _named("normal_speed"),
    "θ": "Angle of incidence: between the normal and the path of the centre; of two balls, of the "
    "first as seen from the second.",
    "ω": "Spin of the first body; positive if it adds to the motion of the contact point, as "
    "backspin does.",
    # what comes of it
    "V′": _named("rebound_speed", "; of two balls, of the first as seen from the second"),
    "θ′": "Angle of rebound: between the normal and the path of the centre, as for θ; negative if "
    "the ball comes back.",
    "ω′": "Spin of the first body after; negative for topspin of a ball that flies on.",
    "ω₂′": "Spin of the second body after; positive spins of both have the same sense of rotation.",
    "e_c": "Tangential velocity of the contact point, after over before: e_c = ψ₂/ψ₁.",
    "e_t": "Tangential velocity of the centres, after over before: e_t = vₜ′/vₜ.",
    "δω": "Spin before the impact that was not intended.",
    "τ": "How long the material takes to follow a load that stays.",
    "V_y": "Normal speed from which the material yields.",
    "W": "Energy that friction turns into heat.",
    "W_n": "Energy that the material loses in compression.",
    "W_s": "Energy that the material loses in shear.",
    "t": _named("time"),
    "t_c": "How long the bodies touch.",
    "P_max": "Largest normal force.",
    "a_max": "Largest radius of the contact.",
    # in charts and in the contact
    "F_x": "Friction: the tangential force, positive if it slows the contact point down.",
    "F_z": "Normal force, with which the bodies press on each other.",
    "F_max": "Largest normal force without losses.",
    "µ F_z": "Limit of friction. The force reaches it where the whole contact slides.",
    "µ F_max": "Unit of force: friction times the largest normal force without losses.",
    "d_max": "Largest approach of the centres since the first touch.",
    "d_max/V₁": "Unit of time: what the ball would need for the largest penetration at its first "
    "speed.",
    "p": "Pressure in the contact: normal force per area.",
    "p₀": "Largest pressure, in the middle of the contact.",
    "fₓ": "Tangential traction: friction per area, positive if it slows the contact point down.",
    "f_x": "Tangential traction: friction per area, positive if it slows the contact point down.",
    "µ p": "Limit of traction. Points at the limit slip, others stick.",
    "a": "Radius of the stick zone, whose points do not slip.",
    "b": "Radius of the contact.",
    "β": "Dundurs' parameter: how strongly pressing unlike materials also shears them.",
    "r": "Distance from the centre of the contact.",
    "K": "Radius of gyration of the ball: K² = (2/5) R² if it is solid.",
}
