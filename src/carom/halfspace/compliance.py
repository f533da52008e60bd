"""How the surfaces of two half-spaces give way under tractions on a uniform grid, by FFT.

Influence coefficients are what a square element under constant traction does to a half-space. Point
forces are Boussinesq's (normal) and Cerruti's (tangential); over a rectangle their integrals have
closed forms (Love 1929, Phil. Trans. R. Soc. A 228:377; Johnson 1985, sections 3.2 and 3.6), a sum
over the corners with signs.
"""

from collections.abc import Callable
from math import pi
from typing import NamedTuple

import numpy as np

from carom.halfspace.transforms import NO_MIRRORS, Field, Mirrors, Spectrum, Transform

Antiderivative = Callable[[Field, Field], Field]


class Influence(NamedTuple):
    """Integrals over the unit element around the origin, seen from (x, y), r^2 = x^2 + y^2."""

    xx: Field  # of x^2/r^3
    yy: Field  # of y^2/r^3
    xy: Field  # of x y/r^3
    x: Field  # of x/r^2
    y: Field  # of y/r^2


def influence(x: Field, y: Field) -> Influence:
    """Return the influence of the unit element at points none of which lies on a line of corners.

    The sum of `xx` and `yy` is the integral of 1/r, the normal influence of a normal load.
    """
    return Influence(
        _over_corners(_xx, x, y),
        _over_corners(lambda x, y: _xx(y, x), x, y),
        _over_corners(lambda x, y: -np.hypot(x, y), x, y),
        _over_corners(_x, x, y),
        _over_corners(lambda x, y: _x(y, x), x, y),
    )


def _over_corners(antiderivative: Antiderivative, x: Field, y: Field) -> Field:
    right, left, above, below = x + 0.5, x - 0.5, y + 0.5, y - 0.5
    return (
        antiderivative(right, above)
        - antiderivative(left, above)
        - antiderivative(right, below)
        + antiderivative(left, below)
    )


def _xx(x: Field, y: Field) -> Field:
    """Return the function whose mixed derivative is x^2/r^3: y ln(x + r), less y ln|y|."""
    return y * np.arcsinh(x / np.abs(y))


def _x(x: Field, y: Field) -> Field:
    """Return the function whose mixed derivative is x/r^2."""
    return y * np.log(np.hypot(x, y)) + x * np.arctan(y / x)


class Materials(NamedTuple):
    """What the materials of both bodies enter with: G*/E*, Dundurs' beta, and the friction."""

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
    `size` is that of the whole grid; fields are of the elements that `mirrors` leave. Unlike
    materials are not mirrored in x: pressure would pull both ways there.
    """

    def __init__(
        self, size: int, spacing: float, materials: Materials, mirrors: Mirrors = NO_MIRRORS
    ) -> None:
        if materials.beta and mirrors.x:
            raise ValueError("what pressure does along x is odd there, traction along x even")
        self.size, self.spacing, self.materials, self.mirrors = size, spacing, materials, mirrors
        self.transforms = Transform(size, mirrors, 2), Transform(size, mirrors, 1)
        self.padded, self.rough = self.transforms
        offsets = np.fft.fftfreq(2 * size, 1.0 / (2 * size))
        unit = influence(*np.meshgrid(offsets, offsets, indexing="ij"))
        scale, lateral = spacing / pi, materials.lateral
        kernels = unit.xx + unit.yy, unit.xx, unit.yy, unit.xy, unit.x, unit.y
        isotropic, xx, yy, xy, x, y = (scale * _used(kernel) for kernel in kernels)
        along, across = isotropic + lateral * xx, isotropic + lateral * yy
        self._normal = self.padded.of_kernel(isotropic)
        self._tangential = _Tensor.of(self.padded, along, across, lateral * xy)
        self._skew = materials.beta * self.padded.of_kernel(x)
        self._skew_across = materials.beta * self.padded.of_kernel(y, to_odd=True)
        self._normal_inverse = 1.0 / self.rough.of_kernel(_periodic(isotropic))
        nearest = (_periodic(kernel) for kernel in (along, across, lateral * xy))
        self._tangential_inverse = _Tensor.of(self.rough, *nearest).inverse(self.rough)
        self.normal_diagonal = float(isotropic[0, 0])
        self.tangential_diagonal = float(along[0, 0])

    @property
    def couples(self) -> bool:
        """Whether pressure displaces tangentially, and traction normally."""
        return self.materials.beta != 0.0

    def normal(self, pressure: Field) -> Field:
        return self.padded.backward(self._normal * self.padded.forward(pressure))

    def tangential(self, traction: Field) -> Field:
        return self._tangential.applied(self.padded, traction)

    def normal_of_traction(self, traction: Field) -> Field:
        """Return the normal displacement under a traction: none for like materials."""
        if not self.couples:
            return np.zeros(traction.shape[1:])
        to_even = -1.0 if self.mirrors.y else 1.0
        moved = self._skew * self.padded.forward(traction[0])
        across = self._skew_across * self.padded.forward(traction[1], odd=True)[self.padded.odd]
        moved[self.padded.even] += to_even * across
        return -self.materials.friction * self.padded.backward(moved)

    def tangential_of_pressure(self, pressure: Field) -> Field:
        """Return the tangential displacement under a pressure: none for like materials."""
        if not self.couples:
            return np.zeros((2, *pressure.shape))
        load = self.padded.forward(pressure)
        across = np.zeros_like(load)
        across[self.padded.odd] = self._skew_across * load[self.padded.even]
        moved = self.padded.backward(self._skew * load), self.padded.backward(across, odd=True)
        return np.stack(moved) / self.materials.friction

    def roughly_pressure(self, displacement: Field) -> Field:
        """Return about the pressure under which the surface gives way so: a preconditioner."""
        return self.rough.backward(self._normal_inverse * self.rough.forward(displacement))

    def roughly_traction(self, displacement: Field) -> Field:
        """Return about the traction under which the surface gives way so: a preconditioner."""
        return self._tangential_inverse.applied(self.rough, displacement)


class _Tensor(NamedTuple):
    """A symmetric kernel of two by two, in wave numbers: from (even, odd) fields to such fields."""

    along: Spectrum
    across: Spectrum
    to_even: Spectrum
    to_odd: Spectrum

    @classmethod
    def of(cls, transform: Transform, along: Field, across: Field, slanted: Field) -> "_Tensor":
        return cls(
            transform.of_kernel(along),
            transform.of_kernel(across, from_odd=True, to_odd=True),
            transform.of_kernel(slanted, from_odd=True),
            transform.of_kernel(slanted, to_odd=True),
        )

    def inverse(self, transform: Transform) -> "_Tensor":
        """Return the kernel that undoes this one, wave number by wave number."""
        along, across = 1.0 / self.along, 1.0 / self.across
        one, other = self.along[transform.even], self.across[transform.odd]
        determinant = one * other - np.real(self.to_even * self.to_odd)
        along[transform.even], across[transform.odd] = other / determinant, one / determinant
        return _Tensor(along, across, -self.to_even / determinant, -self.to_odd / determinant)

    def applied(self, transform: Transform, field: Field) -> Field:
        even, odd = transform.forward(field[0]), transform.forward(field[1], odd=True)
        along, across = self.along * even, self.across * odd
        along[transform.even] += self.to_even * odd[transform.odd]
        across[transform.odd] += self.to_odd * even[transform.even]
        return np.stack([transform.backward(along), transform.backward(across, odd=True)])


def _used(kernel: Field) -> Field:
    """Return a kernel without the offsets that no two elements have, which spoil its symmetry."""
    kernel = kernel.copy()
    size = len(kernel) // 2
    kernel[size] = kernel[:, size] = 0.0
    return kernel


def _periodic(kernel: Field) -> Field:
    """Return the kernel of half the period that is nearest, and positive (T. Chan 1988)."""
    size = len(kernel) // 2
    fade = np.maximum(1.0 - np.abs(np.fft.fftfreq(2 * size, 1.0 / (2 * size))) / size, 0.0)
    faded = kernel * fade[:, None] * fade
    halves = faded[:size] + faded[size:]
    return np.asarray(halves[:, :size] + halves[:, size:])
