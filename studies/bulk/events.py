"""A gas of hard spheres, event by event: spheres fly freely and meet as `carom.collide` has it."""

import numba
import numpy as np

import carom
from bulk.contact_laws import POISSON

NEVER, NOBODY = np.inf, -1
BALL = carom.Sphere(
    radius=0.5, material=carom.Material(young=1e9, poisson=POISSON, density=6 / np.pi)
)


@numba.njit
def meeting(place, velocity, side, one, other):
    """Return when two spheres of diameter 1 meet, of the nearest images."""
    product = square = distance = 0.0
    for k in range(3):
        gap = place[other, k] - place[one, k]
        gap -= side * np.round(gap / side)
        speed = velocity[other, k] - velocity[one, k]
        product += gap * speed
        square += speed * speed
        distance += gap * gap
    root = product * product - square * (distance - 1.0)
    if product >= 0.0 or root < 0.0:
        return NEVER
    return (distance - 1.0) / (np.sqrt(root) - product)


@numba.njit
def look_ahead(place, velocity, side, one, when, whom, now):
    """Find whom a sphere meets first, and tell this one if it is earlier than what it expects."""
    when[one], whom[one] = NEVER, NOBODY
    for other in range(len(place)):
        if other == one:
            continue
        time = now + max(meeting(place, velocity, side, one, other), 0.0)
        if time < when[one]:
            when[one], whom[one] = time, other
    other = whom[one]
    if other != NOBODY and when[one] < when[other]:
        when[other], whom[other] = when[one], one


@numba.njit
def next_event(place, velocity, side, when, whom, now, end, met):
    """Move to the next meeting before the end, or to the end; returns the time and the sphere.

    First all look ahead who were, or expected to meet, one of the spheres that have just met;
    everybody if none has.
    """
    for one in range(len(place)):
        if met[0] == NOBODY or one in met or whom[one] in met:
            look_ahead(place, velocity, side, one, when, whom, now)
    one = np.argmin(when)
    time = min(when[one], end)
    place += (time - now) * velocity
    return time, (one if when[one] < end else NOBODY)


def cool(place, velocity, side, friction, times):
    """Return mean energies of translation and rotation of spheres of mass 1, (2, n).

    Nearest images decide as long as no two spheres move by half a box: then all look ahead again.
    """
    pair = carom.Pair(BALL, BALL, friction)
    place, velocity = place.copy(), velocity.copy()
    spin = np.zeros_like(velocity)
    when, whom = np.full(len(place), NEVER), np.full(len(place), NOBODY)
    now, means = 0.0, []
    for told in times:
        while now < told:
            fastest = np.sqrt((velocity**2).sum(1).max())
            end = min(told, now + (side / 2 - 1) / (4 * fastest))  # room for those that speed up
            met = np.array([NOBODY, NOBODY])
            while now < end:
                now, one = next_event(place, velocity, side, when, whom, now, end, met)
                if one == NOBODY:
                    break
                met = np.array([one, whom[one]])
                collide(pair, place, velocity, spin, side, met)
        means.append((0.5 * (velocity**2).sum(1).mean(), 0.05 * (spin**2).sum(1).mean()))
    return np.array(means).T


def collide(pair, place, velocity, spin, side, met):
    """Let two spheres that touch collide."""
    one, other = met
    gap = place[other] - place[one]
    gap -= side * np.round(gap / side)
    after = carom.collide(
        pair,
        velocity1=velocity[one],
        spin1=spin[one],
        velocity2=velocity[other],
        spin2=spin[other],
        normal=gap / np.linalg.norm(gap),
    )
    velocity[one], spin[one] = after.velocity1, after.spin1
    velocity[other], spin[other] = after.velocity2, after.spin2
