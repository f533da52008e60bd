"""What people call a quantity that has a name of its own here."""

from collections.abc import Iterable

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
