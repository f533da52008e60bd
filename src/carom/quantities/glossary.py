"""Symbol, unit and meaning of every quantity, `data/glossary.csv`, and what people call it."""

import csv
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from carom.folder import DATA
from carom.quantities.prefixes import DIGITS, span, text


class Quantity(NamedTuple):
    """An entry of the glossary: mathematical symbol, SI unit, meaning."""

    symbol: str
    unit: str
    meaning: str

    def text(self, value: float, digits: int = DIGITS) -> str:
        """Return a value with its unit, to read; a dash for what is no number."""
        return text(value, self.unit, digits)

    def span(self, low: float, high: float, digits: int = DIGITS) -> str:
        """Return from where to where values go, in one unit, to read."""
        return span(low, high, self.unit, digits)


def listed(numbers: Mapping[str, float], width: int = 0) -> list[str]:
    """Return quantities by name as lines to read."""
    return aligned({GLOSSARY[n].meaning: GLOSSARY[n].text(v) for n, v in numbers.items()}, width)


def aligned(rows: Mapping[str, str], width: int = 0) -> list[str]:
    """Return names and texts as lines to read, without marks of formulas, the texts aligned."""
    plain = {name.replace("$", ""): text for name, text in rows.items()}
    width = width or max(map(len, plain), default=0)
    return [f"  {name:{width}s} {text}" for name, text in plain.items()]


FILE = DATA / "glossary.csv"


def _read() -> dict[str, Quantity]:
    lines = FILE.read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {row.pop("name"): Quantity(**row) for row in rows}


GLOSSARY = _read()
PEAKS = ("peak_von_mises", "peak_shear", "peak_tension", "stress_intensity")  # of an impact
NEEDED_STRENGTHS: dict[str, tuple[str, ...]] = {  # of a body, for what a sweep tells of it
    **dict.fromkeys(PEAKS, ()),
    "stress_intensity": ("flaw_size",),
    "yield_speed": ("yield_strength",),
    "tensile_speed": ("tensile_strength",),
    "crack_speed": ("fracture_toughness", "flaw_size"),
}
CALLED = {  # in order: of names that one word stands for, the first that there is counts
    "friction": "mu cof reibungszahl reibungskoeffizient",
    "young": "E young_modulus youngs_modulus",
    "poisson": "nu poisson_ratio poissons_ratio",
    "density": "rho",
    "radius": "diameter d D r R",
    "speed": "v V v_in v_i velocity geschwindigkeit aufprallgeschwindigkeit tempo",
    "velocity1": "velocity",
    "normal_speed": "v_n",
    "tangential_speed": "v_t",
    "rebound_speed": "v_out v_r rückprallgeschwindigkeit",
    "angle": "theta theta_i theta_in incident_angle incidence impact_angle winkel einfallswinkel "
    "aufprallwinkel",
    "surface_angle": "grazing_angle glancing_angle winkel_zur_platte winkel_zur_oberfläche",
    "spin_out_magnitude": "spin_rate",
    "bounce_interval": "dt delta_t",
    "rebound_angle": "theta_r theta_out ausfallswinkel abprallwinkel rückprallwinkel",
    "spin_out": "omega omega_out omega_r drehzahl winkelgeschwindigkeit",
    "spin": "omega omega_in omega_i",
    "spin1": "omega",
    "normal_restitution": "e e_n restitution stoßzahl restitutionskoeffizient",
    "restitution": "e e_n",
    "losses": "restitution normal",  # the latter is its name in 0.1
    "tangential_restitution": "e_t",
    "contact_beta": "beta",
    "contact_restitution": "e_c",
    "drop_height": "h_0 fallhöhe",
    "rebound_height": "h_1 rücksprunghöhe rückprallhöhe sprunghöhe",
    "duration": "stoßdauer kontaktzeit kontaktdauer stoßzeit",
    "group": "gruppe messgruppe",
    "psi_in": "psi1",
    "psi_out": "psi2",
    "yield_strength": "sigma_y",
    "tensile_strength": "sigma_t",
    "fracture_toughness": "K_c K_Ic toughness",
    "flaw_size": "flaw",
    "hardness": "H HV",
    "surface_energy": "gamma",
    "loss_factor": "eta tan_delta",
    "work_of_adhesion": "surface_energy Gamma",
}
REMARKS = {
    "diameter": "radius, half of it",
    "d": "radius, half the diameter",
    "D": "radius, half the diameter",
    "surface_energy": "work_of_adhesion, twice the surface energy of like materials",
    "restitution": "losses=carom.KelvinVoigt(restitution=...)",
}


def remark(word: str, name: str) -> str:
    """Return what to write for a word that stands for a known name."""
    words = REMARKS.get(word, name)
    return words if words.startswith(name) else name


def meant(word: str, names: Iterable[str]) -> str:
    """Return that of these names for which a word stands, empty if there is none."""
    wanted = _named(word) or _named(word.lower())
    there = set(names)
    return next((name for name in wanted if name in there), "")


def _named(word: str) -> list[str]:
    return [name for name, words in CALLED.items() if word in words.split()]
