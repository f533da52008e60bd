"""What the symbols of the page mean: one sentence each, for who points at one."""

from carom.quantities.glossary import GLOSSARY


def _named(name: str, more: str = "") -> str:
    """Return the meaning of a quantity of the glossary as a sentence, and what is to be added."""
    meaning = GLOSSARY[name].meaning
    return f"{meaning[0].upper()}{meaning[1:]}{more}."


SYMBOLS = {
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
