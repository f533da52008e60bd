"""An impact in equal time steps: velocity Verlet and the increments that codes take."""

import numpy as np

from carom.dem import coefficients as forces
from carom.dem.coefficients import ELASTIC_PULL, Coefficients, Shear
from carom.dimensionless.numerics.arrays import Matrix, Vector
from carom.dimensionless.numerics.hertz import DURATION
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.quantities.arrays import Array

HISTORY = ("time", "penetration", "normal_velocity", "psi", "normal_force", "tangential_force")
MOST_DURATIONS = 8  # durations of the elastic contact after which the bodies ought to have parted
FORCE, LIMIT, RADIUS, UPPER, LOWER, BRANCH = range(6)  # what is remembered from step to step
REMEMBERED = 6


@kernel
def follow(law: Coefficients, memory: Array, f: float, b: float, change: float) -> None:
    """Bring the force of an incremental law one step further."""
    t, df = memory[FORCE], f - memory[LIMIT]
    if law.shear == Shear.WALTON_BRAUN.value and memory[LIMIT] > 0.0:
        memory[UPPER] *= f / memory[LIMIT]
        memory[LOWER] *= f / memory[LIMIT]
    else:
        memory[UPPER] += df
        memory[LOWER] -= df
    branch = int(memory[BRANCH])
    if branch != forces.BACK and change < 0.0:
        memory[UPPER], branch = t, forces.BACK
    elif branch == forces.BACK and change > 0.0:
        memory[LOWER], branch = t, forces.AGAIN
    elif branch == forces.AGAIN and t > memory[UPPER]:
        branch = forces.FIRST
    memory[BRANCH] = branch
    theta = forces.softening(law.shear, branch, t, f, memory[UPPER], memory[LOWER])
    elastic = forces.shear_stiffness(law, b) * change
    memory[FORCE] = t + forces.force_change(law.shear, branch, theta, elastic, df)


@kernel
def shear_force(
    law: Coefficients, memory: Array, f: float, b: float, psi: float, dt: float
) -> float:
    """Return the tangential force at the end of a step of constant psi, and remember."""
    limit = abs(f)
    if law.shear == Shear.SPRING.value:
        if memory[RADIUS] > 0.0:
            memory[FORCE] *= (b / memory[RADIUS]) ** forces.kept(law, b >= memory[RADIUS])
        memory[FORCE] += forces.shear_stiffness(law, b) * psi * dt
    else:
        follow(law, memory, limit, b, psi * dt)
    memory[RADIUS], memory[LIMIT] = b, limit
    damping = law.shear_damping * b**law.damping_power * psi
    whole = float(memory[FORCE] + damping)
    if law.limits_damping and abs(whole) > limit:
        whole = float(np.copysign(limit, whole))
        memory[FORCE] = whole - damping
    elif not law.limits_damping and abs(memory[FORCE]) > limit:
        whole = float(np.copysign(limit, memory[FORCE]))
        memory[FORCE] = whole
    return whole


@entry_point()
def stepped(
    law: Coefficients, psi: float, steps: int, memory: Vector, record: Matrix
) -> tuple[int, float]:
    """Return how many rows of the record are filled and psi_2; -1 if the bodies do not part."""
    dt = DURATION / steps
    memory[:] = 0.0
    d, v, f, t = 0.0, 1.0, 0.0, 0.0
    loading, peak = True, 0.0
    for i in range(MOST_DURATIONS * steps):
        if i < record.shape[0]:
            record[i, 0], record[i, 1], record[i, 2] = i * dt, d, v
            record[i, 3], record[i, 4], record[i, 5] = psi, f, t
        v_half = v - 0.5 * dt * ELASTIC_PULL * f
        psi_half = psi - 0.5 * dt * 2.0 * ELASTIC_PULL * law.chi * t
        d += dt * v_half
        loading = loading and v_half > 0.0
        peak = max(peak, d)
        if d <= 0.0:
            return i + 1, psi_half
        b = np.sqrt(d)
        f = forces.normal_force(law, peak, loading, b, v_half)
        if f <= 0.0 and not loading and (law.unloading != 1.0 or not law.pulls):
            return i + 1, psi_half
        t = shear_force(law, memory, f, b, psi_half, dt)
        v = v_half - 0.5 * dt * ELASTIC_PULL * f
        psi = psi_half - 0.5 * dt * 2.0 * ELASTIC_PULL * law.chi * t
    return -1, np.nan
