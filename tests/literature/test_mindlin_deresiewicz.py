"""Mindlin & Deresiewicz (1953), J. Appl. Mech. 20:327-344: compliances under varying forces.

Their tangential compliances in units of 1/(2 a G*), a the contact radius, theta = mu dP/dT:

    T grows       theta + (1 - theta) (1 - T/(mu P))^(-1/3)
    T falls      -theta + (1 + theta) (1 - (T* - T)/(2 mu P))^(-1/3),    dT* = mu dP
    T grows anew  theta + (1 - theta) (1 - (T - T**)/(2 mu P))^(-1/3),   dT** = -mu dP
    no slip       1, where P grows and |dT| <= mu dP

T* and T** are the forces of the last reversals. Integrated numerically they are the displacement.
"""

import numpy as np
import pytest
from scipy.integrate import quad

import carom
from carom.impacts.contacts.load_paths import load_path

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.Sphere(radius="8 mm", material="steel"), friction=0.4)
MU = PAIR.friction
P0 = 10.0  # N, at the first reversal
UNIT = 3 * MU * P0 / (4 * PAIR.effective_shear_modulus)  # of displacement, times 1/a(P0)


def radius(load):
    return (0.75 * load * PAIR.effective_radius / PAIR.effective_modulus) ** (1 / 3)


def share(kind, load, force, reversal):
    """The cube of the ratio of stick radius to contact radius."""
    if kind == "first":
        return 1 - force / (MU * load)
    moved = MU * (load - P0)
    if kind == "down":
        return 1 - (reversal + moved - force) / (2 * MU * load)
    return 1 - (force - (reversal - moved)) / (2 * MU * load)


def displaced(kind, start, end, reversal):
    """The published compliance integrated along a straight line in (P, T)."""
    theta = MU * (end[0] - start[0]) / (end[1] - start[1])
    sign = -1 if kind == "down" else 1

    def compliance(t):
        load, force = (one + t * (two - one) for one, two in zip(start, end, strict=True))
        slip = 1.0
        if kind != "stick":
            slip = sign * theta + (1 - sign * theta) * share(kind, load, force, reversal) ** (
                -1 / 3
            )
        return slip / (2 * radius(load) * PAIR.effective_shear_modulus)

    value, _ = quad(compliance, 0.0, 1.0, epsabs=0.0, epsrel=1e-13)
    return (end[1] - start[1]) * value


def driven(*forces):
    loads, across = zip(*forces, strict=True)
    return load_path(PAIR, normal_force=np.array(loads), tangential_force=np.array(across))


def check(path, expected, stick_cubed):
    scale = UNIT / radius(P0)
    assert path.displacement[-1] == pytest.approx(expected, rel=0.0, abs=1e-12 * scale)
    stick = stick_cubed ** (1 / 3) * path.contact_radius[-1]
    assert path.stick_radius[-1] == pytest.approx(stick, rel=1e-12, abs=0.0)


A, B = (P0, 0.0), (P0, 0.6 * MU * P0)  # loaded, then pushed
C = (P0, -0.1 * MU * P0)  # and drawn back


def test_constant_normal_force():
    path = driven(A, B)
    check(path, displaced("first", A, B, 0.0), share("first", *B, 0.0))
    path = driven(A, B, C)
    moved = displaced("first", A, B, 0.0) + displaced("down", B, C, B[1])
    check(path, moved, share("down", *C, B[1]))
    up = (P0, 0.45 * MU * P0)
    check(driven(A, B, C, up), moved + displaced("up", C, up, C[1]), share("up", *up, C[1]))


@pytest.mark.parametrize(
    ("load", "force"),
    [
        pytest.param(1.3, 0.95, id="P up, T up"),
        pytest.param(0.8, 0.7, id="P down, T up"),
        pytest.param(0.9, 0.55, id="P down, T down, slipping on"),
        pytest.param(0.66, 0.65, id="P down until nearly all slides"),
    ],
)
def test_first_branch(load, force):
    """dT > mu dP: slip goes on as it began, with either force rising or falling."""
    end = (load * P0, force * MU * P0)
    moved = displaced("first", A, B, 0.0) + displaced("first", B, end, 0.0)
    check(driven(A, B, end), moved, share("first", *end, 0.0))


@pytest.mark.parametrize(
    ("load", "force"),
    [
        pytest.param(1.3, 0.1, id="P up, T down"),
        pytest.param(0.9, 0.3, id="P down, T down"),
        pytest.param(0.85, 0.25, id="P down, T down more"),
    ],
)
def test_unloading_branch(load, force):
    """|dT| > mu |dP| downwards, at once from the first branch or from the unloading one."""
    end = (load * P0, force * MU * P0)
    moved = displaced("first", A, B, 0.0) + displaced("down", B, end, B[1])
    check(driven(A, B, end), moved, share("down", *end, B[1]))
    end = (load * P0, end[1] - 0.6 * MU * P0)
    moved = displaced("first", A, B, 0.0) + displaced("down", B, C, B[1])
    moved += displaced("down", C, end, B[1])
    check(driven(A, B, C, end), moved, share("down", *end, B[1]))


@pytest.mark.parametrize(
    ("load", "force"),
    [pytest.param(1.2, 0.45, id="P up, T up"), pytest.param(0.85, 0.2, id="P down, T up")],
)
def test_reloading_branch(load, force):
    end = (load * P0, force * MU * P0)
    moved = displaced("first", A, B, 0.0) + displaced("down", B, C, B[1])
    moved += displaced("up", C, end, C[1])
    check(driven(A, B, C, end), moved, share("up", *end, C[1]))


@pytest.mark.parametrize("force", [0.35, 0.5, 0.7, 0.85])
def test_no_slip_where_the_normal_force_grows_faster(force):
    end = (1.3 * P0, force * MU * P0)
    moved = displaced("first", A, B, 0.0) + displaced("stick", B, end, 0.0)
    path = driven(A, B, end)
    check(path, moved, 1.0)
    assert path.frictional_work[-1] == path.frictional_work[-2]


@pytest.mark.parametrize("ratio", [-0.99, 0.3, 0.99])
def test_constant_obliquity_from_first_touch(ratio):
    """Below the critical obliquity the compliance is that without slip, loading and unloading."""
    forces = [(load, ratio * MU * load) for load in (2.0, 7.0, 10.0, 4.0)]
    path = driven(*forces)
    moved = displaced("stick", (0.0, 0.0), forces[2], 0.0)
    assert path.displacement[2] == pytest.approx(moved, rel=1e-12, abs=0.0)
    back = moved + displaced("stick", forces[2], forces[3], 0.0)
    assert path.displacement[3] == pytest.approx(back, rel=1e-12, abs=0.0)
