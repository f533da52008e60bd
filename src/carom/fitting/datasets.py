"""A fit as one labelled dataset: data, curves, residuals, intervals, laws."""

from typing import TYPE_CHECKING, Any

import numpy as np

from carom.fitting.estimation import Best
from carom.fitting.interpolation import borders
from carom.fitting.intervals import rise_of, row_regimes
from carom.fitting.laws import Motion, half_ratio, predicted
from carom.fitting.least_squares import jacobian
from carom.fitting.model import Model
from carom.fitting.problem import Problem
from carom.impacts.curves import REGIMES
from carom.io.labels import flags, labelled_dataset
from carom.quantities.arrays import Array

if TYPE_CHECKING:
    import xarray as xr

    from carom.fitting.result import Fit


SMOOTH = 241  # points of a curve
BEYOND = np.radians(4.0)  # how far curves go beyond the data
STEEPEST = np.radians(88.0)


def fit_dataset(fit: "Fit") -> "xr.Dataset":
    """Return a fit as a dataset along row, response, curve, law and parameter.

    Responses are in SI units, which `response_unit` names; incidences are those of the contact
    point, tan = V_x/V_n, in rad.
    """
    best = fit.best
    problem = best.model.problem
    variables = {**_rows(best), **_curves(fit), **_parameters(fit)}
    coords = {
        "row": ("row", problem.rows.rows, {"long_name": f"{problem.rows.word} of the data"}),
        "response": ("response", list(problem.responses), {"long_name": "what was measured"}),
        "law": ("law", [each.law for each in fit.comparison], {"long_name": "law of rebound"}),
        "parameter": ("parameter", list(fit.estimates), {"long_name": "parameter"}),
        "regime_border": ("regime_border", list(REGIMES[1:]), {"long_name": "regime from here on"}),
    }
    attrs = {
        "title": "parameters from measured rebounds",
        "confidence": fit.confidence,
        "notes": "; ".join(fit.notes),
        "verdict": fit.comparison.verdict,
        "spinning": int(np.any(problem.motion.spin) or np.any(problem.motion.spin2)),
    }
    return labelled_dataset(variables, coords, attrs)


def _rows(best: Best) -> dict[str, Any]:
    problem = best.model.problem
    wide = ("row", "response")
    expected = best.model.expected(best.at[np.newaxis])[0]
    factors = best.weights.factors
    covariance = np.linalg.inv(np.einsum("rji,rjk->rik", factors, factors))
    error = np.sqrt(np.einsum("rjj->rj", covariance))
    present = problem.present
    own = "in the unit of the response"
    angle = np.arctan2(problem.contact_velocity, problem.motion.normal_speed)
    residual = np.where(present, problem.measured - expected, np.nan)
    return {
        "incidence": ("row", angle, {"units": "rad", "long_name": "incidence of contact point"}),
        "measured": (wide, problem.measured, {"long_name": f"what was measured, {own}"}),
        "error": (
            wide,
            np.where(present, error, np.nan),
            {"long_name": f"standard deviation with the part of the motion before, {own}"},
        ),
        "expected": (wide, expected, {"long_name": f"what the fit gives, {own}"}),
        "residual": (wide, residual, {"long_name": f"measured less expected, {own}"}),
        "regime": ("row", row_regimes(best), flags(REGIMES)),
    }


def _curves(fit: "Fit") -> dict[str, Any]:
    best = fit.best
    model, problem = best.model, best.model.problem
    angles, motion = _usual(problem)
    lines = [
        predicted(
            each.best.model.law,
            problem.pair,
            motion,
            each.best.model.values(each.best.at[np.newaxis]),
            problem.responses,
        )[0]
        for each in fit.comparison
    ]
    half_width = _band(fit, motion)
    values = model.values(best.at[np.newaxis])
    mu, kappa, e = (float(values[name][0, 0]) for name in ("friction", "kappa", "restitution"))
    psi = borders(half_ratio(problem.pair) * kappa, e)[1:]
    words = {"units": "rad", "long_name": "incidence of the contact point at which a regime starts"}
    own = "in the unit of the response"
    wide = ("curve", "response")
    return {
        "curve_incidence": (
            "curve",
            angles,
            {"units": "rad", "long_name": "incidence of contact point"},
        ),
        "curve_expected": (
            ("law", *wide),
            np.stack(lines),
            {"long_name": f"what laws give, {own}"},
        ),
        "curve_low": (wide, lines[0] - half_width, {"long_name": f"lower end of the band, {own}"}),
        "curve_high": (wide, lines[0] + half_width, {"long_name": f"upper end of the band, {own}"}),
        "border": ("regime_border", np.arctan(mu / kappa * psi), words),
    }


def _usual(problem: Problem) -> tuple[Array, Motion]:
    """Return incidences over the range of the data and the motion there, at the usual speed."""
    normal, velocity = problem.motion.normal_speed, problem.contact_velocity
    seen = np.arctan2(velocity, normal)
    low = float(seen.min()) - BEYOND if np.any(seen < -BEYOND) else 0.0
    high = float(seen.max()) + BEYOND if np.any(seen > BEYOND) or low == 0.0 else 0.0
    angles = np.linspace(max(low, -STEEPEST), min(high, STEEPEST), SMOOTH)
    angles = angles[np.abs(angles) > 1e-9]
    speed = np.hypot(normal, velocity)
    if np.std(speed) / np.median(speed) <= np.std(normal) / np.median(normal):
        along = np.median(speed) * np.cos(angles)
    else:
        along = np.full(angles.size, float(np.median(normal)))
    nothing = np.zeros(angles.size)
    return angles, Motion(along, along * np.tan(angles), nothing, nothing)


def _band(fit: "Fit", motion: Motion) -> Array:
    """Return half the width of the band of the curve, to first order in the parameters."""
    best = fit.best
    model: Model = best.model
    names = model.problem.responses

    def lines(at: Array) -> Array:
        seen = predicted(model.law, model.problem.pair, motion, model.values(at), names)
        return seen.reshape(len(at), -1)

    at = best.at[np.newaxis]
    slopes = jacobian(lines, at, lines(at), model.bounds)[0]
    variance = np.einsum("mp,pq,mq->m", slopes, best.information.covariance, slopes)
    rise = float((best.caution * rise_of(fit.confidence, best.freedom)).max())
    return np.asarray(np.sqrt(best.spread * rise * variance).reshape(-1, len(names)))


def _parameters(fit: "Fit") -> dict[str, Any]:
    each = list(fit.estimates.values())
    words = {"long_name": "why it is not determined"}
    return {
        "value": ("parameter", [e.value for e in each], {"long_name": "value, SI"}),
        "low": ("parameter", [e.low for e in each], {"long_name": "lower end of the interval, SI"}),
        "high": (
            "parameter",
            [e.high for e in each],
            {"long_name": "upper end of the interval, SI"},
        ),
        "reason": ("parameter", [e.reason for e in each], words),
        "aicc": (
            "law",
            [s.criterion for s in fit.comparison],
            {"units": "1", "long_name": "Akaike's criterion, corrected"},
        ),
    }
