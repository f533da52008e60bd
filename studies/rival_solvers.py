"""How else can the tangential problem be solved? The rivals of Carom in tangential_solvers.py.

Each minimises (1/2) q.T q - g.q over discs |q| <= p and yields, iteration by iteration, its
traction q and T q, or nothing where T q would have to be computed first. Whoever iterates decides
when it is enough.
"""

from collections.abc import Callable, Iterator
from math import pi, sqrt
from typing import NamedTuple

import numpy as np
import scipy.fft
from numba import njit

from carom.halfspace.compliance import Compliance
from carom.halfspace.influence import Field, influence
from carom.halfspace.traction import Discs, at_bound

MEMORY = 10  # iterations over which the spectral gradient may rise
FORCING = 0.1  # what conjugate gradients leave of the residual within ADMM
INNER = 50


class Problem(NamedTuple):
    """Displacements `given`, bounds of the tractions, and what displacement a traction causes.

    The largest eigenvalue of T, which some solvers want, is a present to them.
    """

    compliance: Compliance
    given: Field
    bound: Field
    eigenvalue: float

    @property
    def touching(self) -> Field:
        """Return where traction is possible at all."""
        return self.bound > 0.0

    def project(self, traction: Field) -> Field:
        """Return the nearest traction on the discs."""
        return Discs(self.bound, 1.0).project(traction)

    def inverse(self, displacement: Field) -> Field:
        """Return about the traction that causes it."""
        return self.compliance.roughly_traction(displacement)

    def scaled(self, displacement: Field) -> Field:
        """Return the traction that causes it if elements do not feel each other."""
        return displacement / self.compliance.tangential_diagonal

    def slip(self, displacement: Field) -> Field:
        """Return what is not followed: the negative gradient."""
        return np.where(self.touching, self.given - displacement, 0.0)


Iterates = Iterator[tuple[Field, Field] | None]
Solver = Callable[[Problem, Field], Iterates]


class Circulant:
    """The circulant next to T (T. Chan 1988, SIAM J. Sci. Stat. Comput. 9:766), plus a shift."""

    def __init__(self, problem: Problem, shift: float) -> None:
        self.problem, compliance, size = problem, problem.compliance, problem.compliance.size
        offsets = np.fft.fftfreq(2 * size, 1.0 / (2 * size))
        unit = influence(*np.meshgrid(offsets, offsets, indexing="ij"))
        near = np.maximum(1.0 - np.abs(offsets) / size, 0.0)
        weight = compliance.spacing / pi * np.outer(near, near)
        lateral = compliance.materials.lateral

        def symbol(kernel: Field) -> Field:
            return scipy.fft.rfft2((weight * kernel).reshape(2, size, 2, size).sum((0, 2))).real

        xx = symbol(unit.xx + unit.yy + lateral * unit.xx) + shift
        yy = symbol(unit.xx + unit.yy + lateral * unit.yy) + shift
        xy = symbol(lateral * unit.xy)
        self.own, self.cross = np.stack([yy, xx]) / (xx * yy - xy**2), -xy / (xx * yy - xy**2)

    def solve(self, loads: Field) -> Field:
        """Return its inverse times loads."""
        self.problem.compliance.rough.count += 4
        spectrum = scipy.fft.rfft2(loads)
        turned = self.own * spectrum + self.cross * spectrum[::-1]
        return scipy.fft.irfft2(turned, loads.shape[1:])


def spectral_gradient(problem: Problem, start: Field) -> Iterates:
    """Birgin, Martinez & Raydan 2000, SIAM J. Optim. 10:1196: their second method."""
    traction = problem.project(start)
    moved = problem.compliance.tangential(traction)
    length, energies = 1.0 / problem.compliance.tangential_diagonal, []
    while True:
        yield traction, moved
        slip = problem.slip(moved)
        energy = -0.5 * float(np.sum(traction * (slip + problem.given)))
        energies = [*energies, energy][-MEMORY:]
        change = problem.project(traction + length * slip) - traction
        bent = problem.compliance.tangential(change)
        slope, curvature = float(np.sum(slip * change)), float(np.sum(change * bent))
        step, highest = 1.0, max(energies)
        while energy - step * slope + 0.5 * step**2 * curvature > highest - 1e-4 * step * slope:
            step = min(0.5 * step, slope / curvature)
            if step < 1e-10:
                return
        traction, moved = traction + step * change, moved + step * bent
        length = float(np.sum(change**2)) / curvature if curvature > 0.0 else length


def fast_gradient(problem: Problem, start: Field) -> Iterates:
    """FISTA (Beck & Teboulle 2009, SIAM J. Imaging Sci. 2:183), started anew where it rises
    (O'Donoghue & Candes 2015, Found. Comput. Math. 15:715)."""
    traction = problem.project(start)
    moved = problem.compliance.tangential(traction)
    length, pace = 1.0 / problem.eigenvalue, 1.0
    ahead, moved_ahead = traction, moved
    while True:
        yield traction, moved
        last, last_moved = traction, moved
        traction = problem.project(ahead + length * problem.slip(moved_ahead))
        moved = problem.compliance.tangential(traction)
        if float(np.sum((ahead - traction) * (traction - last))) > 0.0:
            pace = 1.0
        faster = 0.5 * (1.0 + sqrt(1.0 + 4.0 * pace**2))
        beyond, pace = (pace - 1.0) / faster, faster
        ahead = traction + beyond * (traction - last)
        moved_ahead = moved + beyond * (moved - last_moved)


def proportioned(problem: Problem, start: Field) -> Iterates:
    """MPGP: conjugate gradients inside the discs, gradient projection for what is on their edge
    (Dostal & Kozubek 2012, Math. Program. 135:195)."""
    length = 1.9 / problem.eigenvalue
    traction = problem.project(start)
    moved, direction = problem.compliance.tangential(traction), None
    while True:
        yield traction, moved
        slip = problem.slip(moved)
        inside = ~at_bound(traction, problem.bound)
        free = inside * slip
        reduced = (problem.project(traction + length * slip) - traction) / length
        if float(np.sum(np.where(inside, 0.0, reduced) ** 2)) <= float(np.sum(free * reduced)):
            if direction is None:
                direction = free
            bent = problem.compliance.tangential(direction)
            curvature = float(np.sum(direction * bent))
            step = float(np.sum(slip * direction)) / curvature
            room = _room(traction, direction, problem.bound)
            traction, moved = traction + min(step, room) * direction, moved + min(step, room) * bent
            if step <= room:
                left = inside * problem.slip(moved)
                direction = left - float(np.sum(left * bent)) / curvature * direction
                continue
            slip = problem.slip(moved)
        traction = problem.project(traction + length * slip)
        moved, direction = problem.compliance.tangential(traction), None


def _room(traction: Field, direction: Field, bound: Field) -> float:
    """Return how far a direction can be followed inside all discs."""
    square, along = np.sum(direction**2, axis=0), np.sum(traction * direction, axis=0)
    moving = square > 0.0
    room = np.maximum(bound**2 - np.sum(traction**2, axis=0), 0.0)
    root = np.sqrt(along**2 + square * room)
    return float(np.min((root - along)[moving] / square[moving], initial=np.inf))


def face_gradients(problem: Problem, start: Field, circulant: bool) -> Iterates:
    """Nonlinear conjugate gradients along the discs, projected back, after TangCG
    (Zhao, Vollebregt & Oosterlee 2015, J. Comput. Phys. 288:86)."""
    inverse = problem.inverse if circulant else problem.scaled
    diagonal, bound = problem.compliance.tangential_diagonal, problem.bound
    traction = problem.project(start)
    moved = problem.compliance.tangential(traction)
    direction, before, last, residual_before = None, None, 1.0, None
    while True:
        yield traction, moved
        slip, size = problem.slip(moved), np.hypot(*traction)
        unit = traction / np.where(size > 0.0, size, 1.0)
        outwards = np.sum(slip * unit, axis=0)
        slips = problem.touching & at_bound(traction, bound) & (outwards > 0.0)

        def along(field: Field, slips: Field = slips, unit: Field = unit) -> Field:
            field = np.where(slips, field - np.sum(field * unit, axis=0) * unit, field)
            return field * problem.touching

        bend = np.where(slips, outwards / np.where(slips, bound, 1.0), 0.0)
        scale = np.sqrt(diagonal / (diagonal + bend))
        residual = along(slip)
        scaled = scale * along(inverse(scale * residual))
        square = float(np.sum(residual * scaled))
        if direction is None or np.any(slips != before):
            direction = scaled
        else:
            turned = square - float(np.sum(scaled * residual_before))
            direction = scaled + max(turned / last, 0.0) * along(direction)
        bent = problem.compliance.tangential(direction)
        length = float(np.sum(residual * direction) / np.sum(direction * (bent + bend * direction)))
        before, last, residual_before = slips, square, residual
        onward = traction + length * direction
        traction = problem.project(onward)
        if np.array_equal(traction, onward):
            moved = moved + length * bent
        else:
            moved = problem.compliance.tangential(traction)


def splitting(problem: Problem, start: Field) -> Iterates:
    """ADMM (Boyd et al. 2011, Found. Trends Mach. Learn. 3:1): elasticity and discs in turns,
    elasticity by conjugate gradients with a circulant, weight kept in balance (their 3.4.1)."""
    compliance, touching = problem.compliance, problem.touching
    on_discs = problem.project(start)
    moved = compliance.tangential(on_discs)
    yield on_discs, moved
    weight = sqrt(compliance.tangential_diagonal * problem.eigenvalue)
    multiplier = problem.slip(moved) / weight
    free, bent, inverse = on_discs, moved, Circulant(problem, weight)
    while True:
        target = problem.given + weight * (on_discs - multiplier)
        residual = touching * (target - bent - weight * free)
        free, bent = _shifted(inverse, weight, free, bent, residual)
        relaxed = 1.6 * free - 0.6 * on_discs
        last, on_discs = on_discs, problem.project(relaxed + multiplier)
        multiplier = multiplier + relaxed - on_discs
        primal, dual = float(np.abs(free - on_discs).max()), float(np.abs(on_discs - last).max())
        dual *= weight / compliance.tangential_diagonal
        near = max(primal, dual) <= 1e-7 * problem.bound.max()
        yield (on_discs, compliance.tangential(on_discs)) if near else None
        factor = 2.0 if primal > 10.0 * dual else 0.5 if dual > 10.0 * primal else 1.0
        if factor != 1.0:
            weight, multiplier = weight * factor, multiplier / factor
            inverse = Circulant(problem, weight)


def _shifted(
    inverse: Circulant, weight: float, free: Field, bent: Field, residual: Field
) -> tuple[Field, Field]:
    """Return the traction under T + weight, and T times it."""
    problem, direction, last = inverse.problem, np.zeros_like(free), 0.0
    wanted = FORCING * float(np.abs(residual).max())
    for _ in range(INNER):
        if np.abs(residual).max() <= wanted:
            break
        scaled = problem.touching * inverse.solve(residual)
        square = float(np.sum(residual * scaled))
        direction = scaled + (square / last if last else 0.0) * direction
        moved = problem.compliance.tangential(direction)
        full = problem.touching * moved + weight * direction
        length = square / float(np.sum(direction * full))
        free, bent = free + length * direction, bent + length * moved
        residual, last = residual - length * full, square
    return free, bent


def gauss_seidel(problem: Problem, start: Field) -> Iterates:
    """Element by element on the dense matrix, each exactly: ConvexGS (Vollebregt 1995, J. Optim.
    Theory Appl. 87:47).

    A sweep counts as one product with T.
    """
    touching = problem.touching
    unit = influence(*(1.0 * (line[:, None] - line) for line in np.nonzero(touching)))
    scale, lateral = problem.compliance.spacing / pi, problem.compliance.materials.lateral
    xx = scale * (unit.xx + unit.yy + lateral * unit.xx)
    yy = scale * (unit.xx + unit.yy + lateral * unit.yy)
    matrix = np.stack([xx, scale * lateral * unit.xy, yy])
    given, bound = problem.given[:, touching], problem.bound[touching]
    values = np.ascontiguousarray(problem.project(start)[:, touching])
    while True:
        traction, moved = np.zeros_like(problem.given), np.zeros_like(problem.given)
        traction[:, touching] = values
        moved[0, touching] = matrix[0] @ values[0] + matrix[1] @ values[1]
        moved[1, touching] = matrix[1] @ values[0] + matrix[2] @ values[1]
        yield traction, moved
        sweep(matrix, given, bound, values)
        problem.compliance.padded.count += 4


@njit  # type: ignore[untyped-decorator]
def sweep(matrix: Field, given: Field, bound: Field, values: Field) -> None:
    """Solve each element once, in place, with the newest of all others."""
    for i in range(bound.size):
        own = matrix[0, i, i]
        x = values[0, i] + (given[0, i] - matrix[0, i] @ values[0] - matrix[1, i] @ values[1]) / own
        y = values[1, i] + (given[1, i] - matrix[1, i] @ values[0] - matrix[2, i] @ values[1]) / own
        size = np.hypot(x, y)
        less = bound[i] / size if size > bound[i] else 1.0
        values[0, i], values[1, i] = less * x, less * y


def largest_eigenvalue(compliance: Compliance, bound: Field) -> float:
    """Return that of T within the contact, a little more rather than less."""
    vector, size = np.ones((2, *bound.shape)), 1.0
    for _ in range(30):
        vector = (bound > 0.0) * compliance.tangential(vector / size)
        size = float(np.sqrt(np.sum(vector**2)))
    return 1.02 * size
