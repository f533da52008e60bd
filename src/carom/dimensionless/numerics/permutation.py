"""Permutations and random numbers computed point by point, so that nothing has to be stored.

A permutation of n points is a Feistel network on the next larger power of two, walked along its
cycles until it falls below n (Black & Rogaway 2002). Random numbers are SplitMix64 (Steele, Lea &
Flood 2014), a function of a counter. Integers of 64 bits throughout, hence the same on
every machine.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array, Vector, Words
from carom.dimensionless.numerics.kernels import entry_point, kernel

Whole = NDArray[np.uint64]

GOLDEN, FIRST, SECOND = (
    np.uint64(value) for value in (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)
)
S27, S30, S31, WORD = (np.uint64(value) for value in (27, 30, 31, 64))
ONE = np.uint64(1)
ROUNDS = 6  # even: then both parts are back in their places
FEWEST_BITS = 8  # below, a network has too few bits to mix
EXACT_BITS = 52  # which a place in (0, n) may have to be exact as a float


@kernel
def mixed(x: np.uint64) -> np.uint64:
    """Return 64 bits that depend on all bits of x: the output function of SplitMix64."""
    x = (x ^ (x >> S30)) * FIRST
    x = (x ^ (x >> S27)) * SECOND
    return x ^ (x >> S31)


@kernel
def network(x: np.uint64, bits: int, secret: Whole) -> np.uint64:
    """Permute numbers of so many bits: a hash of a part (Dietzfelbinger 1996) changes the other."""
    high = np.uint64(bits // 2)
    low = np.uint64(bits) - high
    left, right = x >> low, x & ((ONE << low) - ONE)
    for i in range(ROUNDS):
        hashed = (right * (secret[2 * i] | ONE) + secret[2 * i + 1]) >> (WORD - high)
        left, right = right, left ^ hashed
        low, high = high, low
    return (left << low) | right


@kernel
def permuted(index: np.uint64, n: int, bits: int, secret: Whole) -> np.uint64:
    """Return where a permutation of 0, ..., n - 1, chosen by the secret, sends an index."""
    x = index
    for _ in range(2**bits):  # a cycle that started below n comes back there
        x = network(x, bits, secret)
        if x < np.uint64(n):
            break
    return x


@entry_point()
def fill_fractions(index: Words, n: int, bits: int, secret: Words, out: Vector) -> None:
    """Write where samples lie in (0, 1): each in a part of its own of n, at random in it."""
    places = EXACT_BITS - bits
    unit = 0.5**places
    for i in range(index.size):
        place = mixed(secret[-1] + index[i] * GOLDEN) >> (WORD - np.uint64(places))
        part = permuted(index[i], n, bits, secret)
        out[i] = (np.float64(part) + (np.float64(place) + 0.5) * unit) / n


def fractions(index: Whole, n: int, secret: Whole) -> Array:
    """Return where samples of a Latin hypercube lie along one dimension, in (0, 1)."""
    out = np.empty(index.size)
    fill_fractions(index, n, max((n - 1).bit_length(), FEWEST_BITS), secret, out)
    return out


def secrets(seed: int, dimensions: int) -> Whole:
    """Return independent words for each dimension: two for every round, one for the jitter."""
    words = 2 * ROUNDS + 1
    state = np.random.SeedSequence(seed).generate_state(words * dimensions, np.uint64)
    return np.asarray(state, dtype=np.uint64).reshape(dimensions, words)
