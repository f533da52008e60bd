"""Fourier transforms of fields on a grid, of which symmetry may leave a half or a quarter."""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Spectrum = NDArray[np.complex128] | Field
DENSE_ELEMENTS = 96  # up to which a product with a matrix is faster than a cosine transform


class Mirrors(NamedTuple):
    """Mirrored axes, of which one half is kept: p and q_x are even there, q_y is odd."""

    x: bool = False
    y: bool = False

    @property
    def copies(self) -> int:
        """How many elements each kept one stands for."""
        return (1 + self.x) * (1 + self.y)


NO_MIRRORS = Mirrors()


class Transform:
    """Transforms of fields, padded with zeros, and back.

    Along a mirrored axis even fields become cosines of wave numbers 0 to M - 1, odd ones sines of 1
    to M; `even` and `odd` cut out of such spectra the wave numbers that both have. `count` is how
    many transforms were made.
    """

    def __init__(self, size: int, mirrors: Mirrors, padding: int) -> None:
        self.period, self.count = padding * size, 0
        self.shape = tuple(size // 2 if one else size for one in mirrors)
        self.mirrored = [axis - 2 for axis in (0, 1) if mirrors[axis]]
        self.plain = [axis - 2 for axis in (1, 0) if not mirrors[axis]]
        self.even = tuple(slice(1, None) if one else slice(None) for one in mirrors)
        self.odd = tuple(slice(None, -1) if one else slice(None) for one in mirrors)

    def forward(self, field: Field, odd: bool = False) -> Spectrum:
        self.count += 1
        spectrum: Spectrum = field
        for axis in self.mirrored:
            spectrum = _waves(spectrum, self.period // 2, axis, odd)
        for axis in self.plain:
            transform = scipy.fft.rfft if axis == self.plain[0] else scipy.fft.fft
            spectrum = transform(spectrum, self.period, axis=axis)
        return spectrum

    def backward(self, spectrum: Spectrum, odd: bool = False) -> Field:
        """Return the field of a spectrum, without its padding."""
        self.count += 1
        for axis in reversed(self.plain):
            inverse = scipy.fft.irfft if axis == self.plain[0] else scipy.fft.ifft
            kept = (..., slice(self.shape[axis]), *(slice(None),) * (-1 - axis))
            spectrum = inverse(spectrum, self.period, axis=axis)[kept]
        for axis in self.mirrored:
            spectrum = _samples(spectrum, self.shape[axis], axis, odd)
        return np.asarray(spectrum)

    def of_kernel(self, kernel: Field, from_odd: bool = False, to_odd: bool = False) -> Spectrum:
        """Return what multiplies a spectrum in a convolution, from a kernel over one period."""
        numbers = [np.arange(self.period)] * 2
        for axis in self.mirrored:
            shared = slice(from_odd or to_odd, self.period // 2 + (from_odd and to_odd))
            numbers[axis] = numbers[axis][shared]
        if self.plain:
            numbers[self.plain[0]] = numbers[self.plain[0]][: self.period // 2 + 1]
        spectrum = scipy.fft.fft2(kernel)[np.ix_(*numbers)]
        if from_odd != to_odd:
            spectrum *= (1j if to_odd else -1j) ** len(self.mirrored)
        return np.real_if_close(spectrum, tol=1000)


def _waves(field: Spectrum, length: int, axis: int, odd: bool) -> Spectrum:
    """Return the cosines or sines of a field along an axis, padded to so many."""
    if field.shape[axis] > DENSE_ELEMENTS:
        transform = scipy.fft.dst if odd else scipy.fft.dct
        return np.asarray(transform(field, 2, length, axis))
    forward, _ = _matrices(field.shape[axis], length, odd)
    return field @ forward.T if axis == -1 else forward @ field


def _samples(spectrum: Spectrum, kept: int, axis: int, odd: bool) -> Spectrum:
    """Return the field of cosines or sines along an axis, as much of it as is kept."""
    if kept > DENSE_ELEMENTS:
        inverse = scipy.fft.idst if odd else scipy.fft.idct
        field = inverse(spectrum, 2, axis=axis)
        return np.asarray(field[..., :kept] if axis == -1 else field[..., :kept, :])
    _, backward = _matrices(kept, spectrum.shape[axis], odd)
    return spectrum @ backward.T if axis == -1 else backward @ spectrum


@lru_cache(maxsize=16)
def _matrices(kept: int, length: int, odd: bool) -> tuple[Field, Field]:
    """Return the transforms of the second kind, as `_waves` and `_samples` make them."""
    transform, inverse = (scipy.fft.dst, scipy.fft.idst) if odd else (scipy.fft.dct, scipy.fft.idct)
    forward = transform(np.eye(kept, length), 2, axis=1).T
    backward = inverse(np.eye(length), 2, axis=0)[:kept]
    return np.ascontiguousarray(forward), np.ascontiguousarray(backward)
