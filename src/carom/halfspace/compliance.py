"""How the surfaces of two half-spaces give way under tractions on a uniform grid, by FFT."""

from math import pi
from typing import NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from carom.halfspace.influence import Field, influence

Spectrum = NDArray[np.complex128]


class Materials(NamedTuple):
    """What the materials of both bodies enter with.

    `kappa` is G*/E*, `beta` Dundurs' second parameter, `friction` the coefficient of friction.
    """

    kappa: float
    beta: float = 0.0
    friction: float = 1.0

    @property
    def lateral(self) -> float:
        """Ratio of the kernels x^2/r^3 and 1/r under tangential load: nu/(1 - nu) if alike."""
        return 2.0 * (1.0 / self.kappa - 1.0)


class Compliance:
    """Displacements from tractions, both on the same square grid: convolutions with zero padding.

    Normal: N p - friction K D.q. Tangential: T q + (K/friction) D p, with N = 1/(pi r), T = (1/pi)
    [I/r + m x x/r^3], D = x/r^2, m = 2 (1/kappa - 1), K = beta/pi (Boussinesq, Cerruti; Johnson
    1985, sections 3.2, 3.6). Pressure in E* d_max/a_max, traction in friction times that, lengths
    along the surface in a_max, normal displacements in d_max, tangential ones in friction d_max.
    `transforms` counts the real two-dimensional transforms of padded fields that were made,
    `rough_transforms` those of fields without padding, by the preconditioners.
    """

    def __init__(self, size: int, spacing: float, materials: Materials) -> None:
        self.size, self.spacing, self.materials = size, spacing, materials
        self.transforms = self.rough_transforms = 0
        offsets = np.fft.fftfreq(2 * size, 1.0 / (2 * size))
        unit = influence(*np.meshgrid(offsets, offsets, indexing="ij"))
        scale, lateral = spacing / pi, materials.lateral
        normal = scale * (unit.xx + unit.yy)
        own = normal + scale * lateral * np.stack([unit.xx, unit.yy])
        cross, skew = scale * lateral * unit.xy, scale * materials.beta * np.stack([unit.x, unit.y])
        even = [self._spectrum(kernel).real.copy() for kernel in (normal, own, cross)]
        self._normal, self._own, self._cross = even
        self._skew = self._spectrum(skew)
        self._normal_inverse = 1.0 / self._circulant(normal)
        straight, slanted = self._circulant(own), self._circulant(cross)
        determinant = straight[0] * straight[1] - slanted**2
        self._own_inverse, self._cross_inverse = straight[::-1] / determinant, slanted / determinant
        self.normal_diagonal = float(normal[0, 0])
        self.tangential_diagonal = float(own[0, 0, 0])

    @property
    def couples(self) -> bool:
        """Whether pressure displaces tangentially, and traction normally."""
        return self.materials.beta != 0.0

    def normal(self, pressure: Field) -> Field:
        """Return the normal displacement under a pressure alone."""
        return self._backward(self._normal * self._forward(pressure))

    def tangential(self, traction: Field) -> Field:
        """Return the tangential displacement, along (x, y), under a traction alone."""
        loads = self._forward(traction)
        moved = self._own * loads
        moved += self._cross * loads[::-1]
        return self._backward(moved)

    def normal_of_traction(self, traction: Field) -> Field:
        """Return the normal displacement under a traction: none for like materials."""
        if not self.couples:
            return np.zeros(traction.shape[1:])
        moved = self._skew * self._forward(traction)
        return -self.materials.friction * self._backward(moved.sum(axis=0))

    def tangential_of_pressure(self, pressure: Field) -> Field:
        """Return the tangential displacement under a pressure: none for like materials."""
        if not self.couples:
            return np.zeros((2, *pressure.shape))
        return self._backward(self._skew * self._forward(pressure)) / self.materials.friction

    def roughly_pressure(self, displacement: Field) -> Field:
        """Return about the pressure under which the surface gives way so: a preconditioner."""
        self.rough_transforms += 2
        spectrum = scipy.fft.rfft2(displacement)
        return np.asarray(scipy.fft.irfft2(self._normal_inverse * spectrum, displacement.shape))

    def roughly_traction(self, displacement: Field) -> Field:
        """Return about the traction under which the surface gives way so: a preconditioner."""
        self.rough_transforms += 4
        spectrum = scipy.fft.rfft2(displacement)
        loads = self._own_inverse * spectrum - self._cross_inverse * spectrum[::-1]
        return np.asarray(scipy.fft.irfft2(loads, displacement.shape[1:]))

    def _spectrum(self, kernel: Field) -> Spectrum:
        """Return the spectrum of a kernel, without the offsets of `size` that no two elements have.

        They would spoil the symmetry by which spectra of even kernels are real.
        """
        used = np.ones((2 * self.size, 2 * self.size))
        used[self.size] = used[:, self.size] = 0.0
        return np.asarray(scipy.fft.rfft2(used * kernel))

    def _forward(self, field: Field) -> Spectrum:
        """Return the spectrum on the doubled grid; lines of padding are not transformed."""
        self._count(field)
        rows = scipy.fft.rfft(field, 2 * self.size, axis=-1)
        return np.asarray(scipy.fft.fft(rows, 2 * self.size, axis=-2))

    def _backward(self, spectrum: Spectrum) -> Field:
        self._count(spectrum)
        columns = scipy.fft.ifft(spectrum, axis=-2, overwrite_x=True)[..., : self.size, :]
        return np.asarray(scipy.fft.irfft(columns, 2 * self.size, axis=-1)[..., : self.size])

    def _count(self, fields: Field | Spectrum) -> None:
        self.transforms += fields.shape[0] if fields.ndim == 3 else 1

    def _circulant(self, kernel: Field) -> Field:
        """Return the spectrum of the nearest periodic kernel (T. Chan 1988, SIAM J. Sci. Stat.

        Comput. 9:766), which is positive wherever the convolution itself is.
        """
        size = self.size
        fade = np.maximum(1.0 - np.abs(np.fft.fftfreq(2 * size, 1.0 / (2 * size))) / size, 0.0)
        faded = kernel * fade[:, None] * fade
        halves = faded[..., :size, :] + faded[..., size:, :]
        periodic = halves[..., :size] + halves[..., size:]
        return np.asarray(scipy.fft.rfft2(periodic).real)
