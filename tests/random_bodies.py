"""Random bodies, walls and motions, in a plane of symmetry and in space; jams are among them."""

import numpy as np

import carom


def material(random):
    young, poisson = 10.0 ** random.uniform(9.0, 11.5), random.uniform(0.0, 0.49)
    return carom.Material(young=young, poisson=poisson, density=10.0 ** random.uniform(3.0, 4.0))


def body(random, side, planar, size):
    """Return a body of random points of mass, struck on its side up (1) or down (-1)."""
    points = random.normal(size=(6, 3)) * random.uniform(0.1, 1.0, 3) * size
    mass, around = 10.0 ** random.uniform(-3.0, 0.0), np.cov(points.T)
    tensor = mass * (np.trace(around) * np.eye(3) - around)
    place = size * random.normal(size=3)
    place[2] = side * size * random.uniform(0.3, 2.0)
    x, y, z = place.tolist()
    turn = np.linalg.qr(random.normal(size=(2, 2)))[0]
    curved = (turn * 10.0 ** random.uniform(0.5, 1.5, 2) / size) @ turn.T
    return carom.Body(
        mass=mass,
        inertia=float(tensor[1, 1]) if planar else (tensor + tensor.T) / 2.0,
        contact=(x, z) if planar else (x, y, z),
        curvatures=np.diag(curved) if planar else (curved + curved.T) / 2.0,
        material=material(random),
    )


def other(random, planar, size):
    """Return what is struck: mostly a wall, else a sphere, a body, or a wall that is curved."""
    kind = random.choice(["wall", "wall", "sphere", "body", "curved"])
    if kind == "wall":
        return carom.HalfSpace(material=material(random))
    if kind == "sphere":
        return carom.Sphere(radius=size * random.uniform(0.2, 2.0), material=material(random))
    if kind == "body":
        return body(random, 1.0, planar, size)
    return carom.Body(curvatures=random.uniform(0.0, 1.0, 2) / size, material=material(random))


def impacts(seed, count):
    """Yield pairs and motions before: velocity, spin and spin2 along x, y, z."""
    random, made = np.random.default_rng(seed), 0
    while made < count:
        planar, size = random.random() < 0.4, 10.0 ** random.uniform(-3.0, -1.0)
        bodies = body(random, -1.0, planar, size), other(random, planar, size)
        pair = carom.Pair(*bodies, friction=10.0 ** random.uniform(-1.5, 0.5))
        velocity, spins = random.normal(size=3), random.normal(size=(2, 3)) / size
        velocity[2] = -random.uniform(0.2, 2.0)
        spins[1] *= len(pair.moving) - 1
        if planar:
            velocity[1], spins[:, [0, 2]] = 0.0, 0.0
        if approach(pair, velocity, *spins) > 0.1 * np.linalg.norm(velocity):
            made += 1
            yield pair, velocity, *spins


def approach(pair, velocity, spin, spin2):
    """Return the speed at which the contact points approach."""
    points = [np.zeros(3), np.zeros(3)]
    for i, (each, side) in enumerate(((pair.first, -1.0), (pair.second, 1.0))):
        if isinstance(each, carom.Sphere):
            points[i] = np.array([0.0, 0.0, side * each.radius])
        elif getattr(each, "mass", None) is not None:
            x, *y, z = each.contact
            points[i] = np.array([x, *(y or [0.0]), z])
    return -(velocity + np.cross(spin, points[0]) - np.cross(spin2, points[1]))[2]


def strike(pair, velocity, spin, spin2, **inputs):
    """Return `carom.impact` of a random impact."""
    if pair.is_planar:
        turned = {"spin": -spin[1], "spin2": -spin2[1], "tangential_speed": velocity[0]}
    else:
        turned = {"spin": spin, "spin2": spin2, "tangential_speed": velocity[:2]}
    return carom.impact(pair, normal_speed=-velocity[2], **turned, **inputs)
