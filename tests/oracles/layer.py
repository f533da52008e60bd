"""An impact on an elastic layer with free faces, all its waves included, by springs.

The contact is small against the layer and its waves, so that it sees the wall by the motion of one
point: beyond the dent of the half-space, which Hertz's contact has, the point answers a force of
the spectrum F(w) with W(w) F(w), W = (1/2 pi) int k (C(k, w) - C of the half-space at rest) dk,
with the compliance C of the surface at wave number k by the equations of Rayleigh and Lamb. Units
of the layer are its thickness, its shear modulus and the speed of shear waves.
"""

from functools import cache
from typing import NamedTuple

import numba
import numpy as np
from scipy.interpolate import CubicSpline

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
EARLY = 15.0  # until when echoes are sharp


def compliances(k, omega, poisson, layer=True):
    """Return those of the surface to normal and to tangential stress, the latter a mean.

    The mean is over all directions of k: half of it is shear in a plane with the normal, half is
    horizontal shear.
    """
    shear = omega**2
    p = np.sqrt(k**2 - shear * (0.5 - poisson) / (1.0 - poisson))
    q = np.sqrt(k**2 - shear)
    bulk, mixed = (2.0 * k**2 - shear) ** 2, 4.0 * k**2 * p * q
    if not layer:
        return -p * shear / (bulk - mixed), 0.5 * (-q * shear / (bulk - mixed) + 1.0 / q)
    a, b = np.tanh(0.5 * p), np.tanh(0.5 * q)
    normal = 1.0 / (bulk / a - mixed / b) + 1.0 / (bulk * a - mixed * b)
    along = 1.0 / (mixed * a - bulk * b) + 1.0 / (mixed / a - bulk / b)
    horizontal = (b + 1.0 / b) / (2.0 * q)
    return -0.5 * p * shear * normal, 0.5 * (0.5 * q * shear * along + horizontal)


def answers(omega, poisson, layer=True):
    """Return W for normal and for tangential forces at a frequency with an imaginary part."""
    rough = 1.3 * abs(omega) + 3.0  # up to which the poles are, as near as the imaginary part
    fine = np.linspace(0.0, rough, 1 + int(np.ceil(rough / min(1.0, 3.0 * omega.imag))))
    coarse = np.linspace(rough, 5.0 * abs(omega) + 12.0, 12)
    edges = np.concatenate([fine, coarse[1:]])
    half = 0.5 * np.diff(edges)[:, np.newaxis]
    k = (edges[:-1, np.newaxis] + half * (1.0 + NODES)).ravel()
    weights = (half * WEIGHTS).ravel()
    far = 0.5 * (1.0 + NODES)  # k = reach/u up to infinity
    k = np.concatenate([k, edges[-1] / far])
    weights = np.concatenate([weights, 0.5 * WEIGHTS * edges[-1] / far**2])
    normal, along = compliances(k, omega, poisson, layer)
    at_rest = (1.0 - poisson) / k, 0.5 * (2.0 - poisson) / k
    return [
        np.sum(weights * k * (c - rest)) / (2.0 * np.pi)
        for c, rest in zip((normal, along), at_rest, strict=True)
    ]


@cache
def half_space(poisson):
    """Return beta_z and beta_x: on a half-space the point is behind by beta F'/(mu c_T)."""
    omega = 1.0 + 0.5j
    return [float((w / (1j * omega)).real) for w in answers(omega, poisson, layer=False)]


def grown(poisson, times, highest):
    """Return the displacements of the point of a layer under forces that grow as t.

    Less those of the half-space, by the inverse Laplace transform on a line above the real axis.
    """
    above, spacing = 5.0 / times[-1], 0.6 / times[-1]
    omega = spacing * (np.arange(int(highest / spacing)) + 0.5) + 1j * above
    beta = half_space(poisson)
    echoes = np.array([answers(w, poisson) for w in omega]) - 1j * omega[:, np.newaxis] * beta
    taper = np.cos(0.5 * np.pi * omega.real / highest) ** 2
    spectrum = echoes * (taper / (-1j * omega) ** 2)[:, np.newaxis]
    kernel = np.exp(-1j * np.outer(times, omega.real))
    return np.exp(above * times)[:, np.newaxis] * (kernel @ spectrum).real * spacing / np.pi


@cache
def ramps(poisson, longest):
    """Return them as splines, the echoes of early times with more frequencies."""
    early, late = np.linspace(0.0, EARLY, 500), np.linspace(0.0, longest, 1 + int(4.0 * longest))
    first, rest = grown(poisson, early, 60.0), grown(poisson, late, 8.0)
    echo = 2.0 * np.sqrt((0.5 - poisson) / (1.0 - poisson))
    first[early < 0.99 * echo] = 0.0  # the first echo is not back
    times = np.concatenate([early, late[late > EARLY]])
    return [CubicSpline(times, np.append(first[:, i], rest[late > EARLY, i])) for i in (0, 1)]


class Layered(NamedTuple):
    """What comes of an impact: psi_2 and e of the sphere's own velocities, and the duration."""

    psi_out: float
    restitution: float
    duration: float
    change: float  # of psi_2 in the last pass


@numba.njit(cache=True)
def march(psi, chi, step, sinks, slides, places, width, forces):
    """March the sphere over a wall that moves as given, and write the forces; return the end."""
    steps = sinks.size - 1
    depth, speed, aside = 0.0, 1.0, 0.0
    springs = np.zeros(places.size)
    before, force, shear = 0.0, 0.0, 0.0
    forces[:] = 0.0
    ended, touched = steps * step, False
    for i in range(1, steps + 1):
        half, across = speed - 0.625 * step * force, psi - 1.875 * chi * step * shear
        depth += step * half
        aside += step * across
        d, u = depth - sinks[i], aside - slides[i]
        moved = u - before
        before = u
        shear = 0.0
        if d > 0.0:
            touched = True
            force = d**1.5
            for j in range(places.size):
                room = d - places[j] ** 2
                if room <= 0.0:
                    # The cell at the edge counts as far as it is in contact.
                    for m in range(j, places.size):
                        springs[m] = 0.0
                    break
                springs[j] = min(max(springs[j] + moved, -room), room)
                shear += springs[j] * width
        else:
            force = 0.0
        speed, psi = half - 0.625 * step * force, across - 1.875 * chi * step * shear
        forces[0, i], forces[1, i] = force, shear
        if touched and d <= 0.0 and i * step > 0.5:
            ended = i * step
            break
    return psi, -speed, ended


def impact_on_layer(pair, normal_speed, psi, *, duration=None, steps=1600, springs=300, passes=40):
    """Return the impact of a pair at psi_1: on a plate, about so long in s, or on a half-space."""
    scales, stuff = pair.scales(normal_speed), pair.second.material
    shear = np.sqrt(stuff.shear_modulus / stuff.density)
    thickness = pair.thickness or scales.length
    thick = duration is None
    duration = 2.943275 if thick else duration / scales.time
    unit = scales.time * shear / thickness  # of time, in that of the layer
    last = 1.15 * duration
    times = np.linspace(0.0, last, steps + 1)
    step = times[1]

    size = scales.force / (stuff.shear_modulus * thickness * scales.length)
    sizes = np.array([size, 1.5 * pair.kappa * size])
    beta = np.array(half_space(stuff.poisson))

    answer = np.zeros((2, steps + 1))
    if not thick:  # a few lengths of time serve all thicknesses
        longest = 16.0 * 1.5 ** max(0.0, np.ceil(np.log(last * unit / 16.0) / np.log(1.5)))
        for i, ramp in enumerate(ramps(stuff.poisson, longest)):
            answer[i] = ramp(times * unit) / (step * unit)
    kernels = np.diff(np.concatenate([np.zeros((2, 1)), answer], axis=1), axis=1)

    places, width = (np.arange(springs) + 0.5) * 1.02 / springs, 1.02 / springs
    sinks, forces = np.zeros((2, steps + 1)), np.zeros((2, steps + 1))
    history = []
    length = 2 * (steps + 1)
    transformed = np.fft.rfft(kernels, length, axis=1)

    for _ in range(passes):
        out = march(psi, pair.chi, step, sinks[0], sinks[1], places, width, forces)
        history.append(out)
        growth = np.diff(forces, axis=1, prepend=0.0)
        late = np.fft.irfft(np.fft.rfft(growth, length, axis=1) * transformed, length, axis=1)
        behind = smooth_rate(forces, step) / unit
        following = sizes[:, np.newaxis] * (late[:, : steps + 1] - beta[:, np.newaxis] * behind)
        sinks = 0.5 * (sinks + following) if len(history) > 1 else following
        if len(history) > 3 and abs(history[-1][0] - history[-2][0]) < 1e-6:
            break

    psi_out, e, duration = history[-1]
    return Layered(psi_out, e, duration * scales.time, abs(history[-1][0] - history[-2][0]))


def smooth_rate(forces, step):
    """Return the rate of change of histories, without what one step or two can tell."""
    window = 9
    kernel = np.arange(window) - window // 2
    kernel = -kernel / np.sum(kernel**2)
    padded = np.pad(forces, ((0, 0), (window // 2, window // 2)))
    return np.array([np.convolve(row, kernel, "valid") for row in padded]) / step
