"""What people call a quantity that has a name of its own here."""

from collections.abc import Iterable

SYMBOLS: dict[str, tuple[str, ...]] = {  # the first that is known where one is asked for
    "mu": ("friction",),
    "cof": ("friction",),
    "E": ("young",),
    "young_modulus": ("young",),
    "youngs_modulus": ("young",),
    "nu": ("poisson",),
    "poisson_ratio": ("poisson",),
    "poissons_ratio": ("poisson",),
    "rho": ("density",),
    "diameter": ("radius",),
    "d": ("radius",),
    "D": ("radius",),
    "r": ("radius",),
    "R": ("radius",),
    "v": ("speed",),
    "V": ("speed",),
    "v_in": ("speed",),
    "v_i": ("speed",),
    "velocity": ("speed", "velocity1"),
    "v_n": ("normal_speed",),
    "v_t": ("tangential_speed",),
    "v_out": ("rebound_speed",),
    "v_r": ("rebound_speed",),
    "theta": ("angle",),
    "theta_i": ("angle",),
    "theta_in": ("angle",),
    "incident_angle": ("angle",),
    "incidence": ("angle",),
    "impact_angle": ("angle",),
    "theta_r": ("rebound_angle",),
    "theta_out": ("rebound_angle",),
    "omega": ("spin_out", "spin", "spin1"),
    "omega_in": ("spin",),
    "omega_i": ("spin",),
    "omega_out": ("spin_out",),
    "omega_r": ("spin_out",),
    "e": ("normal_restitution", "restitution"),
    "e_n": ("normal_restitution", "restitution"),
    "restitution": ("normal_restitution", "losses"),
    "normal": ("losses",),  # its name in 0.1
    "e_t": ("tangential_restitution",),
    "beta": ("contact_beta",),
    "e_c": ("contact_restitution",),
    "psi1": ("psi_in",),
    "psi2": ("psi_out",),
    "sigma_y": ("yield_strength",),
    "sigma_t": ("tensile_strength",),
    "K_c": ("fracture_toughness",),
    "K_Ic": ("fracture_toughness",),
    "toughness": ("fracture_toughness",),
    "flaw": ("flaw_size",),
}
REMARKS = {
    "diameter": "radius, half of it",
    "d": "radius, half the diameter",
    "D": "radius, half the diameter",
    "restitution": "losses=carom.KelvinVoigt(restitution=...)",
}


def remark(word: str, name: str) -> str:
    """Return what to write for a word that stands for a known name."""
    words = REMARKS.get(word, name)
    return words if words.startswith(name) else name


def meant(word: str, known: Iterable[str]) -> str:
    """Return the known name that a word stands for, empty if there is none.

    Examples
    --------
    >>> from carom.quantities.symbols import meant
    >>> meant("mu", ["friction", "speed"]), meant("omega", ["angle", "spin"]), meant("x", ["spin"])
    ('friction', 'spin', '')
    """
    wanted = SYMBOLS.get(word) or SYMBOLS.get(word.lower(), ())
    known = set(known)
    return next((name for name in wanted if name in known), "")
