"""Contact laws are what their codes and papers define, computed anew in SI units.

None of the powers and units of the package are in the twins (`tests.oracles.dem_*`).
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from tests.oracles import dem_codes as codes, dem_softening as softening, dem_steps as steps
from tests.oracles.dem_contact import CHI, KAPPA, MASS

from carom import dem

FULL = {"normal_dashpot": codes.normal_dashpot}
SOFT = FULL | {"stiffness": lambda d: 2 / 3 * codes.mindlin(d)}
SOFT |= {"dashpot": lambda d: 0.5 * codes.normal_dashpot(d)}
DAMPED = codes.Code(**FULL)
HALF = {"restitution": codes.E, "tangential_damping": 0.5}
CODES = {
    "mindlin": codes.Code(),
    "mindlin/force": codes.Code(force_stored=True),
    "mindlin_rescale": codes.Code(shrinks=True),
    "mindlin_rescale/force": codes.Code(force_stored=True, shrinks=True),
}
ALL = (0.3, 0.8, 1.3, 3.0, 4.6)

CASES = [
    *((dem.LammpsMindlin(name), code, ALL) for name, code in CODES.items()),
    *(
        (dem.LammpsMindlin(name, restitution=codes.E), replace(code, **FULL), (0.3, 3.0))
        for name, code in CODES.items()
    ),
    *(
        (dem.LammpsMindlin(name, stiffness=2 / 3, **HALF), replace(code, **SOFT), (0.8, 1.3, 4.6))
        for name, code in CODES.items()
    ),
    (
        dem.LammpsMindlin("mindlin", restitution=codes.E, damping="tsuji"),
        codes.Code(normal_dashpot=codes.tsuji_dashpot),
        (0.8, 3.0),
    ),
    (
        dem.HertzLinearHistory(1.2, **HALF),
        replace(
            DAMPED,
            stiffness=lambda d: 1.2 * codes.mindlin(codes.DEEPEST),
            dashpot=lambda d: 0.5 * codes.normal_dashpot(d),
        ),
        ALL,
    ),
    (
        dem.LinearSpring(0.5, **HALF),
        codes.Code(
            stiffness=lambda d: 0.5 * codes.LINEAR,
            elastic=lambda d: codes.LINEAR * d,
            normal_dashpot=lambda d: 2 * codes.BETA * np.sqrt(codes.LINEAR * codes.MASS),
            dashpot=lambda d: codes.BETA * np.sqrt(codes.LINEAR * codes.MASS),
        ),
        ALL,
    ),
    (
        dem.LiggghtsHertz(codes.E),
        replace(DAMPED, dashpot=codes.tangential_dashpot, limits_sum=False),
        ALL,
    ),
    (dem.EdemHertzMindlin(codes.E), replace(DAMPED, dashpot=codes.tangential_dashpot), ALL),
]


@pytest.mark.first_case
@pytest.mark.parametrize(("law", "code", "psi"), CASES, ids=[str(case[0]) for case in CASES])
def test_law_is_what_the_code_defines(law, code, psi):
    twin = [codes.rebound(code, each) for each in psi]
    assert np.allclose(law.rebound(psi, CHI, kappa=KAPPA), twin, rtol=0.0, atol=1e-8)


VARIANTS = ("mindlin", "mindlin/force", "mindlin_rescale", "mindlin_rescale/force")
OF_HERTZ = [
    *((dem.LammpsMindlin(name), lambda name=name: steps.Lammps(name)) for name in VARIANTS),
    *(
        (
            dem.LammpsMindlin(name, restitution=steps.E, tangential_damping=0.6),
            lambda name=name: steps.Lammps(name, 0.6, damped=True),
        )
        for name in VARIANTS
    ),
    (dem.LiggghtsHertz(steps.E), lambda: steps.Liggghts(limits_sum=False)),
    (dem.EdemHertzMindlin(steps.E), lambda: steps.Liggghts(limits_sum=True)),
]
OF_SPRINGS = [
    (dem.LinearSpring(0.4), lambda: steps.Springs(0.4)),
    (dem.LinearSpring(0.4, steps.E, 0.5), lambda: steps.Springs(0.4, 0.5, damped=True)),
    (dem.StrongeLaw(0.9, steps.E), lambda: steps.Springs(0.9, bilinear=True)),
]
PSI = (0.2, 0.7, 1.1, 2.5, 4.5)


@pytest.mark.parametrize("count", [20, 57])
@pytest.mark.parametrize(("law", "code"), OF_HERTZ, ids=[str(law) for law, _ in OF_HERTZ])
def test_steps_are_those_of_the_code(law, code, count):
    """A law in fixed steps is what its code does, step for step."""
    expected = [steps.rebound(code(), psi, count) for psi in PSI]
    psi_out = law.rebound(PSI, CHI, kappa=KAPPA, steps=count)
    assert np.allclose(psi_out, expected, rtol=0.0, atol=1e-11)


@pytest.mark.parametrize(("law", "code"), OF_SPRINGS, ids=[str(law) for law, _ in OF_SPRINGS])
def test_steps_of_springs(law, code):
    """A linear contact as deep as Hertz's lasts pi, where Hertz's lasts 2.943."""
    duration = np.sqrt(MASS / steps.K_LINEAR) * 2.94327518432470
    expected = [steps.rebound(code(), psi, 50, duration) for psi in PSI]
    psi_out = law.rebound(PSI, CHI, kappa=KAPPA, steps=50)
    assert np.allclose(psi_out, expected, rtol=0.0, atol=1e-11)


Walton, K = softening.Walton, KAPPA * softening.K_1
Braun = dem.WaltonBraunLaw
SOLID, LIGHT = 3.5, 9.0  # m_n/m_t: of a solid sphere; of one that turns back more often
SOFTENING = [
    (dem.ThorntonLaw(), softening.Thornton(), SOLID, (0.3, 0.8, 1.3, 3.0, 4.6)),
    (dem.ThorntonLaw(), softening.Thornton(), LIGHT, (0.3, 0.8, 1.5, 3.5)),
    (Braun(), Walton(1.0, K), SOLID, (0.3, 0.8, 1.3, 3.0)),
    (Braun(), Walton(1.0, K), LIGHT, (0.3, 1.5, 3.5)),
    (Braun(restitution=0.7), Walton(0.7, K), SOLID, (0.3, 1.3, 3.0)),
    (Braun(0.5, 0.7), Walton(0.7, 0.5 * softening.K_1), LIGHT, (0.3, 1.5)),
]


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("law", "twin", "ratio", "psi"), SOFTENING, ids=[f"{each[0]}-{each[2]}" for each in SOFTENING]
)
def test_law_is_what_the_paper_defines(law, twin, ratio, psi):
    expected = [softening.rebound(twin, each, ratio) for each in psi]
    psi_out = law.rebound(psi, KAPPA / 2 * ratio, kappa=KAPPA)
    assert np.allclose(psi_out, expected, rtol=0.0, atol=5e-8)


@pytest.mark.parametrize("restitution", [1.0, 0.7])
def test_walton_braun_all_but_slides(restitution):
    """While N grows T keeps up with it: K_0 theta V_x = mu dN/dt, 1 - T/(mu N) = (cos t/psi)^3."""
    psi, chi = 20.0, 1.4
    missing = quad(lambda c: 2 * chi * (c / (psi - 2 * chi * (1 - c))) ** 3, 0, 1)[0]
    out = dem.WaltonBraunLaw(restitution=restitution).rebound(psi, chi)
    assert out - (psi - 2 * chi * (1 + restitution)) == pytest.approx(missing, rel=0.01)
