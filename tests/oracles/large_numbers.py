"""The elastic impact in closed form, in arithmetic whose exponents have no end.

psi_2 is what `rebound` gives, where psi_1 is of order one.
"""

import mpmath as mp


def sphere(point, body):
    radius, hole = point[f"{body}.radius"], point.get(f"{body}.inner_radius", mp.mpf(0))
    mass = mp.mpf(4) / 3 * mp.pi * point[f"{body}.material.density"] * (radius**3 - hole**3)
    part = hole / radius
    ratio = mp.mpf(2) / 5 * (1 - part**5) / (1 - part**3)
    if f"{body}.gyration_radius" in point:
        ratio = (point[f"{body}.gyration_radius"] / radius) ** 2
    return radius, mass, ratio


def psi_lost(psi, chi, rebound):
    """psi_1 - psi_2: of slip throughout, or a constant part of small psi_1, or as it is solved."""
    if abs(psi) >= max(4 * chi, 1):
        return 4 * chi * mp.sign(psi)
    near = psi if abs(psi) > 1e-6 else mp.mpf(1e-6)
    actual = mp.mpf(float(rebound(float(near), float(chi))))
    return psi * (1 - actual / near)


def truth(point, kind, rebound):
    """Results of an elastic impact, and for what is a difference the larger of both parts."""
    p = {name: mp.mpf(float(value)) for name, value in point.items()}
    moving = [sphere(p, body) for body in ("first", "second")[: 1 + (kind == "sphere")]]
    curvature = sum(1 / radius for radius, _, _ in moving)
    curvature -= 1 / p["second.radius"] if kind == "cup" else 0
    stuff = [(p[f"{b}.material.young"], p[f"{b}.material.poisson"]) for b in ("first", "second")]
    modulus = 1 / sum((1 - nu**2) / young for young, nu in stuff)
    kappa = 1 / sum((2 - nu) * (1 + nu) / (2 * young) for young, nu in stuff) / modulus
    normal_mass = 1 / sum(1 / mass for _, mass, _ in moving)
    tangential_mass = 1 / sum((1 + 1 / ratio) / mass for _, mass, ratio in moving)
    spins = [p["spin"], p.get("spin2", mp.mpf(0))][: len(moving)]
    velocity = p["tangential_speed"]
    velocity += sum(r * w for (r, _, _), w in zip(moving, spins, strict=True))
    unit, chi = p["friction"] * p["normal_speed"] / kappa, kappa * normal_mass / tangential_mass / 2
    psi = velocity / unit
    lost = psi_lost(psi, chi, rebound)
    impulse = tangential_mass * unit * lost
    slowed = impulse / normal_mass
    left = p["tangential_speed"] - slowed
    base = 15 * normal_mass * p["normal_speed"] ** 2 * mp.sqrt(curvature) / (16 * modulus)
    depth = base ** mp.mpf("0.4")
    energy = tangential_mass * unit * lost * (velocity - unit * lost / 2)
    by_name = {
        "psi_in": (psi, psi),
        "psi_out": (psi - lost, psi),
        "chi": (chi, chi),
        "tangential_speed_out": (left, max(abs(p["tangential_speed"]), abs(slowed))),
        "rebound_speed": 2 * (mp.hypot(p["normal_speed"], left),),
        "dissipated_energy": (energy, tangential_mass * unit * lost * velocity),
        "max_penetration": (depth, depth),
        "max_radius": 2 * (mp.sqrt(depth / curvature),),
        "max_pressure": 2 * (2 * modulus / mp.pi * mp.sqrt(depth * curvature),),
        "max_force": 2 * (4 * modulus / 3 * mp.sqrt(depth**3 / curvature),),
    }
    for name, spin, (radius, mass, ratio) in zip(("spin", "spin2"), spins, moving, strict=False):
        turned = impulse / (mass * ratio * radius)
        by_name[f"{name}_out"] = spin - turned, max(abs(spin), abs(turned))
    return by_name
