"""How far off are rules for rigid bodies, for a slender rod that is dropped on its end?

python studies/rigid_rules.py    stores rigid_rules.csv

Routh's construction and Stronge's bilinear contact, in units of V_n, with b_tt and b_nt over b_nn.
With the normal impulse p the friction is F = sigma mu p' while it slides, V_n' = -(1 + sigma mu
b_nt), V_t' = -(b_nt + sigma mu b_tt), and F = -(b_nt/b_tt) p' while it sticks, which it does where
that is at most mu (Routh 1905; Stronge 2000, chapters 4 and 5).
"""

import csv
from itertools import product
from math import copysign, cos, radians, sin
from pathlib import Path

import numpy as np

import carom

TABLE = Path(__file__).with_suffix(".csv")
RULES = ("newton", "poisson", "stronge")
ANGLES, FRICTIONS, SLIDING = range(0, 90, 10), (0.1, 0.3, 0.5, 1.0), (-0.5, 0.0, 0.5)
LENGTH, MASS = 0.1, 0.01


def struck(degrees, mu, sliding=0.0):
    """Return the impact of a rod that leans, of steel, 10 cm, and b_tt and b_nt over b_nn."""
    x, z = 0.5 * LENGTH * sin(radians(degrees)), -0.5 * LENGTH * cos(radians(degrees))
    given = {"mass": MASS, "inertia": MASS * LENGTH**2 / 12.0, "contact": (x, z)}
    rod = carom.Body(**given, curvature_radius="3 mm", material="steel")
    pair = carom.Pair(rod, carom.HalfSpace("steel"), mu)
    normal = 1.0 / MASS + x * x / given["inertia"]
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=sliding)
    mixed = x * z / given["inertia"] / normal
    return hit, (1.0 / MASS + z * z / given["inertia"]) / normal, mixed


def pieces(tangential, mixed, mu, sliding):
    """Yield how long each piece of the path lasts, V_n' and V_t' on it; the last is endless."""
    sticks = abs(mixed) <= mu * tangential
    if sliding:
        sign = copysign(1.0, sliding)
        rates = -(1.0 + sign * mu * mixed), -(mixed + sign * mu * tangential)
        if sign * rates[1] >= 0.0:
            yield np.inf, *rates
            return
        yield -sliding / rates[1], *rates
    if sticks:
        yield np.inf, -(1.0 - mixed * mixed / tangential), 0.0
        return
    sign = -copysign(1.0, mixed)
    yield np.inf, -(1.0 + sign * mu * mixed), -(mixed + sign * mu * tangential)


def routh(tangential, mixed, mu, sliding, rule, coefficient=1.0):
    """Return e of the contact points and V_t'/V_n by Newton's, Poisson's or Stronge's rule.

    None where the normal impulse never turns the body back, as in a jam that does not stick.
    """
    normal, along, pushed, work, turned = 1.0, sliding, 0.0, 0.0, None
    for size, rate, rate_along in pieces(tangential, mixed, mu, sliding):
        left = size
        while left > 0.0:
            if turned is None:
                if rate >= 0.0 and left == np.inf:
                    return None
                ends = -normal / rate if rate < 0.0 else np.inf
            else:
                ends = end_of(rule, coefficient, normal, rate, pushed, work, turned)
            step = min(left, ends)
            work += step * (normal + 0.5 * rate * step)
            normal, along, pushed = normal + rate * step, along + rate_along * step, pushed + step
            left -= step
            if step == ends and turned is not None:
                return -normal, along
            if step == ends:
                turned, normal = (pushed, work), 0.0
    return None


def end_of(rule, coefficient, normal, rate, pushed, work, turned):
    """Return the impulse until the rule ends restitution."""
    if rule == "newton":
        return (-coefficient - normal) / rate
    if rule == "poisson":
        return (1.0 + coefficient) * turned[0] - pushed
    lost = coefficient**2 * turned[1] + (work - turned[1])  # that the normal force still gives
    return (-normal - np.sqrt(normal**2 - 2.0 * rate * lost)) / rate


def bilinear(tangential, mixed, mu, sliding, kappa, count=20_000):
    """Return the same of two linear springs, kappa the ratio of tangential to normal stiffness."""
    step = np.pi / count
    normal, along, depth, pulled = 1.0, sliding, 0.0, 0.0
    while depth >= 0.0:
        load, force = depth, pulled
        normal -= 0.5 * step * (load + mixed * force)
        along -= 0.5 * step * (tangential * force + mixed * load)
        depth += step * normal
        limit = mu * max(depth, 0.0)
        pulled = min(max(pulled + step * kappa * along, -limit), limit)
        normal -= 0.5 * step * (max(depth, 0.0) + mixed * pulled)
        along -= 0.5 * step * (tangential * pulled + mixed * max(depth, 0.0))
    return -normal, along


def rows():
    """Yield e and V_t'/V_n by all rules, and exactly, a row for each rod."""
    for degrees, mu, sliding in product(ANGLES, FRICTIONS, SLIDING):
        hit, *inertia = struck(float(degrees), mu, sliding)
        answers = {"exact": (hit.normal_restitution, hit.contact_velocity_out)}
        answers["bilinear"] = bilinear(*inertia, mu, sliding, hit.pair.kappa)
        answers |= {rule: routh(*inertia, mu, sliding, rule) for rule in RULES}
        columns = {"angle": degrees, "friction": mu, "sliding": sliding}
        for name, (e, along) in answers.items():
            columns |= {f"e_{name}": f"{e:.4f}", f"slip_{name}": f"{along + 0.0:.4f}"}
        yield columns


if __name__ == "__main__":
    table = list(rows())
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, table[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
