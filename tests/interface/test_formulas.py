"""Formulas of docstrings, plain text in a terminal, are mathematics in the manual."""

import doctest
import sys
from importlib import import_module
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs/_ext"))
formulas = import_module("formulas")

INLINE = {  # a formula, or the formulas of a sentence, and their LaTeX
    "psi_2 = psi_2(psi_1, chi)": r"\psi_2 = \psi_2(\psi_1, \chi)",
    "kappa V_x / (mu V_1)": r"\kappa V_x/(\mu V_1)",
    "k_t/k_n": "k_t/k_n",
    "2 chi (1 + e) - e": r"2 \chi (1 + e) - e",
    "1e-10 max(1, |psi_1|)": r"10^{-10} \max(1, \lvert \psi_1\rvert)",
    "3e-8 max(1, |psi_1|)": r"3 \times 10^{-8} \max(1, \lvert \psi_1\rvert)",
    "sqrt(R* d)": r"\sqrt{R^* d}",
    "(Gamma^5 R*^4/E*^2)^(1/3)": r"(\Gamma^5 R^{*4}/E^{*2})^{1/3}",
    "V_1^(1/5)": "V_1^{1/5}",
    "V_1^(-1/4)": "V_1^{-1/4}",
    "(kappa/2)(m_n/m_t)": r"(\kappa/2)(m_n/m_t)",
    "0.05 <= chi <= 10": r"0.05 \le \chi \le 10",
    "1 - e": "1 - e",
    "y = 0": "y = 0",
    "g(s)": "g(s)",
    "d_max/V_1": r"d_{\max}/V_1",
    "8 G_eff a": r"8 G_{\mathrm{eff}} a",
    "psi_1 -+ 2 chi (1 + e)": r"\psi_1 \mp 2 \chi (1 + e)",
    "-ln e/sqrt(pi^2 + ln^2 e)": r"-\ln e/\sqrt{\pi^2 + \ln^2 e}",
    "V_x' = V_x - J_t/m_t": "V_x' = V_x - J_t/m_t",
    "1/m_t = sum (1/M)(1 + R^2/K^2)": r"1/m_t = \sum (1/M)(1 + R^2/K^2)",
    "lambda u_2 cos 2 theta": r"\lambda u_2 \cos 2 \theta",
    "2 E* mu int_0^b q dx": r"2 E^* \mu \int_0^b q \, dx",
    "sigma = integral of s Im[N + mu g(s) T] ds": (
        r"\sigma = \int s \mathrm{Im}[N + \mu g(s) T] \, ds"
    ),
    "(R_1 omega_1 + R_2 omega_2) x n": r"(R_1 \omega_1 + R_2 \omega_2) \times n",
    "V_n = V . n": r"V_n = V \cdot n",
    "dT** = -mu dN": r"dT^{**} = -\mu \, dN",
    "J/m^2": r"\mathrm{J/m^{2}}",
    "Pa m^0.5": r"\mathrm{Pa\,m^{0.5}}",
}
SENTENCES = {
    "If a chi is not positive, a psi not finite.": (
        r"If a :math:`\chi` is not positive, a :math:`\psi` not finite."
    ),
    "near psi_1 = 1 a code needs a step.": "near :math:`\\psi_1 = 1` a code needs a step.",
    "chi from 7/6 (nu = 1/2) to 7/4, in V_x.": (
        r":math:`\chi` from 7/6 :math:`(\nu = 1/2)` to 7/4, in :math:`V_x`."
    ),
    "by Barber's (15)-(37) of 1979, for mu\np and psi_in, in m/s": (
        r"by Barber's (15)-(37) of 1979, for :math:`\mu p` and ``psi_in``, in m/s"
    ),
    "max |psi_2 of the law|, psi_1's": r"max \|:math:`\psi_2` of the law\|, :math:`\psi_1`'s",
    "angle between slip and $x$": "angle between slip and :math:`x`",
}
UNTOUCHED = [
    "`psi_2` and ``k_t/k_n``, :math:`x_1` and :obj:`carom.rebound`",
    *('a text as "0.75 MPa m^0.5"', "psi, chi : array_like, shape (n, 2)"),
    *(":type psi: float, by default chi", ":param chi: positive"),
    ">>> psi_2 = carom.rebound(psi_1, chi)\npsi_2 = 4",
    "from 1 to 1.5 m/s, 20 to 70 ms; e.g. a law I take as it is - a sphere (1976), at 13 %",
    *(".. rubric:: psi_1", "See::\n\n    psi_2 = chi"),
]


@pytest.mark.parametrize("text", INLINE)
def test_a_formula_is_one_role_and_a_sentence_around_it_stays(text):
    assert formulas.convert([text]) == [f":math:`{INLINE[text]}`"]
    values = f"It is the ratio, {text}, and nothing else (Barber 1979)."
    want = f"It is the ratio, :math:`{INLINE[text]}`, and nothing else (Barber 1979)."
    assert formulas.convert([values]) == [want]


@pytest.mark.parametrize("text", SENTENCES)
def test_formulas_in_sentences(text):
    assert "\n".join(formulas.convert(text.split("\n"))) == SENTENCES[text]


@pytest.mark.parametrize("text", UNTOUCHED)
def test_what_is_no_formula_stays(text):
    assert "\n".join(formulas.convert(text.split("\n"))) == text


def test_a_description_behind_the_name_of_a_parameter_is_converted():
    lines = [":param psi: psi_1 =", "            kappa V_x.", ":type psi: float"]
    assert formulas.convert(lines) == [r":param psi: :math:`\psi_1 = \kappa V_x`.", lines[2]]


def test_indented_equations_are_displayed():
    text = """\
    The forces.

        F_n = k_n d while loading, k_n/e^2 (d - d_p) while unloading
        psi_2 = psi_1 - min((1 + beta_0) psi_1,
          2 chi (1 + e))

    The rest of it."""
    displayed = r"""    The forces.

    .. math::

       F_n & = k_n d\text{ while loading},\quad k_n/e^2 (d - d_p)\text{ while unloading}

       \psi_2 & = \psi_1 - \min((1 + \beta_0) \psi_1, 2 \chi (1 + e))


    The rest of it."""
    assert "\n".join(formulas.convert(text.split("\n"))) == displayed


def test_examples_of_the_extension_hold():
    outcome = doctest.testmod(formulas)
    assert (outcome.failed, outcome.attempted > 0) == (0, True)
