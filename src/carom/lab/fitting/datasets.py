"""A fit as labelled datasets: data, curves, residuals, intervals, laws; and posterior samples."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.impacts.curves import REGIMES
from carom.io.extras import extra
from carom.io.labels import flags, labelled_dataset
from carom.io.progress import Progress, advancing
from carom.lab.fitting.comparison import FitRecord, LossComparison
from carom.lab.fitting.estimation import Best
from carom.lab.fitting.least_squares import jacobian
from carom.lab.fitting.model import half_ratio
from carom.lab.fitting.problem import OUTLIER, FitProblem, IncomingMotion
from carom.quantities.arrays import Array
from carom.quantities.refusals import refuse
from carom.quantities.units import counted

if TYPE_CHECKING:
    import xarray as xr

CURVE_POINTS = 241
CURVE_MARGIN = np.radians(4.0)
STEEPEST = np.radians(88.0)
OWN = "in the unit of the response"
WIDE, ALONG = ("row", "response"), ("curve", "response")


def fit_dataset(fit: FitRecord) -> "xr.Dataset":
    """Return a fit as a dataset, as `Fit.to_dataset`."""
    problem, losses = fit._best.model.problem, fit.losses
    variables = {
        **_rows(fit._best),
        **_curves(fit),
        **_parameters(fit),
        **({} if losses is None else _losses(losses)),
        "row": _named("row", problem.rows.rows, f"{problem.rows.word} of the data"),
        "response": _named("response", list(problem.responses), "what was measured"),
        "law": _named("law", [each.law for each in fit.comparison], "law of rebound"),
        "parameter": _named("parameter", list(fit.estimates), "parameter"),
        "regime_border": _named("regime_border", list(REGIMES[1:]), "regime from here on"),
    }
    attrs = {
        "title": "parameters from measured rebounds",
        "confidence": fit.confidence,
        "notes": "; ".join(fit.notes),
        "verdict": fit.comparison.verdict,
        "spinning": int(np.any(problem.motion.spin) or np.any(problem.motion.spin2)),
    }
    return labelled_dataset(variables, {}, attrs)


def _named(
    dims: str | Sequence[str], values: Any, words: str, unit: str = ""
) -> tuple[Any, Any, dict[str, str]]:
    """Return a variable with its meaning, and its unit if it has one of its own."""
    return dims, values, ({"units": unit} if unit else {}) | {"long_name": words}


def _rows(best: Best) -> dict[str, Any]:
    problem, expected = best.model.problem, best.expected
    factors = best.weights.factors
    covariance = np.linalg.inv(np.einsum("rji,rjk->rik", factors, factors))
    error = np.where(problem.present, np.sqrt(np.einsum("rjj->rj", covariance)), np.nan)
    residual = np.where(problem.present, problem.measured - expected, np.nan)
    angle = np.arctan2(problem.contact_velocity, problem.motion.normal_speed)
    deviation = f"standard deviation with the part of the motion before, {OWN}"
    outlier = (np.abs(best.residuals) > OUTLIER).astype(np.int8)
    no_or_yes = flags(("no", "yes")) | {"long_name": "whether it is an outlier"}
    return {
        "incidence": _named("row", angle, "incidence of contact point", "rad"),
        "measured": _named(WIDE, problem.measured, f"what was measured, {OWN}"),
        "error": _named(WIDE, error, deviation),
        "expected": _named(WIDE, expected, f"what the fit gives, {OWN}"),
        "residual": _named(WIDE, residual, f"measured less expected, {OWN}"),
        "outlier": (WIDE, outlier, no_or_yes),
        "regime": ("row", best.model.regimes(best.at), flags(REGIMES)),
    }


def _losses(losses: LossComparison) -> dict[str, Any]:
    """Return restitutions against speed, measured and by the laws of losses."""
    speeds = np.geomspace(losses.speeds.min(), losses.speeds.max(), CURVE_POINTS)
    lines = [each.restitution(speeds) for each in losses.standings]
    errors = np.where(np.isfinite(losses.measured), losses.errors, np.nan)
    laws, excess = zip(*((each.law, each.excess) for each in losses), strict=True)
    return {
        "loss_law": _named("loss_law", laws, "law of losses"),
        "normal_speed": _named("row", losses.speeds, "normal speed before", "m/s"),
        "restitution": _named("row", losses.measured, "normal restitution", "1"),
        "restitution_error": _named("row", errors, "standard deviation of restitution", "1"),
        "loss_speed": _named("loss_curve", speeds, "normal speed before", "m/s"),
        "loss_restitution": _named(("loss_law", "loss_curve"), lines, "restitution by a law", "1"),
        "loss_excess": _named("loss_law", excess, "Akaike's criterion above the least", "1"),
    }


def _curves(fit: FitRecord) -> dict[str, Any]:
    best = fit._best
    angles, motion = _usual(best.model.problem)
    fits = [each._best for each in fit.comparison]
    lines = [each.model.expected(each.at[np.newaxis], motion)[0] for each in fits]
    half_width = _band(fit, motion)
    mu, kappa = (best.values[name] for name in ("friction", "kappa"))
    psi = np.median(best.model.borders(best.at, motion), axis=0)
    border = np.arctan(mu / kappa * psi)
    words = "incidence of the contact point at which a regime starts"
    return {
        "curve_incidence": _named("curve", angles, "incidence of contact point", "rad"),
        "curve_expected": _named(("law", *ALONG), np.stack(lines), f"what laws give, {OWN}"),
        "curve_low": _named(ALONG, lines[0] - half_width, f"lower end of the band, {OWN}"),
        "curve_high": _named(ALONG, lines[0] + half_width, f"upper end of the band, {OWN}"),
        "border": _named("regime_border", border, words, "rad"),
    }


def _usual(problem: FitProblem) -> tuple[Array, IncomingMotion]:
    """Return incidences over the range of the data and the motion there, at the usual speed."""
    normal, velocity = problem.motion.normal_speed, problem.contact_velocity
    seen = np.arctan2(velocity, normal)
    low = float(seen.min()) - CURVE_MARGIN if np.any(seen < -CURVE_MARGIN) else 0.0
    high = float(seen.max()) + CURVE_MARGIN if np.any(seen > CURVE_MARGIN) or low == 0.0 else 0.0
    angles = np.linspace(max(low, -STEEPEST), min(high, STEEPEST), CURVE_POINTS)
    angles = angles[np.abs(angles) > 1e-9]
    speed = np.hypot(normal, velocity)
    is_total = np.std(speed) / np.median(speed) <= np.std(normal) / np.median(normal)
    along = np.median(speed) * np.cos(angles) if is_total else np.median(normal) + 0.0 * angles
    nothing, thickness = np.zeros(angles.size), problem.motion.thickness
    usual = None if thickness is None else nothing + float(np.median(thickness))
    return angles, IncomingMotion(along, along * np.tan(angles), nothing, nothing, usual)


def _band(fit: FitRecord, motion: IncomingMotion) -> Array:
    """Return half the width of the band of the curve, to first order in the parameters."""
    best = fit._best
    model = best.model

    def lines(at: Array) -> Array:
        return model.expected(at, motion).reshape(len(at), -1)

    at = best.at[np.newaxis]
    slopes = jacobian(lines, at, lines(at), model.bounds)[0]
    variance = np.einsum("mp,pq,mq->m", slopes, best.information.covariance, slopes)
    half_width = np.sqrt(best.rises(fit.confidence).max() * variance)
    return np.asarray(half_width.reshape(-1, len(model.problem.responses)))


def _parameters(fit: FitRecord) -> dict[str, Any]:
    each = list(fit.estimates.values())
    criteria = [law.criterion for law in fit.comparison]
    return {
        "value": _named("parameter", [e.value for e in each], "value, SI"),
        "low": _named("parameter", [e.low for e in each], "lower end of the interval, SI"),
        "high": _named("parameter", [e.high for e in each], "upper end of the interval, SI"),
        "reason": _named("parameter", [e.reason for e in each], "why it is not determined"),
        "aicc": _named("law", criteria, "Akaike's criterion, corrected", "1"),
    }


WALKERS = 8  # per parameter
BURN_IN = 0.25  # part of the steps that is left out
FEWEST_STEPS, MOST_STEPS = 100, 100_000
MOST_SEED = 2**63 - 1  # that a file can hold
LEAST_TIMES = 50.0  # autocorrelation times of a chain (emcee's documentation)


def sample(fit: FitRecord, steps: int, seed: int | None, progress: Progress) -> "xr.Dataset":
    """Return samples of the parameters that the data determine, as `Fit.posterior`."""
    emcee = extra("emcee", "posterior", "fit")
    count = counted("steps", steps, FEWEST_STEPS, MOST_STEPS)
    if seed is not None:
        counted("seed", seed, 0, MOST_SEED)
    best = fit._best
    refuse(best.elsewhere is not None and "posterior: not of sets that share parameters; fit alone")
    low, high = best.model.bounds
    stopped: list[BaseException] = []

    def log_probability(at: Array) -> Array:
        try:
            inside = np.all((at >= low) & (at <= high), axis=1)
            values = best.roots(np.clip(at, low, high))
            loss = np.einsum("bm,bm->b", values, values)
            return np.where(inside, -0.5 * loss / best.spread, -np.inf)
        except BaseException as error:  # which emcee would print, Ctrl-C as well
            stopped.append(error)
            return np.full(len(at), -np.inf)

    free = len(best.model.free)
    generator = np.random.default_rng(seed)
    deviations = np.sqrt(np.diag(best.information.covariance))
    offsets = generator.normal(size=(WALKERS * free, free)) * np.minimum(deviations, 0.3)
    start = best.at + offsets  # reflected into the ranges, so that walkers stay apart at a bound
    start = np.where(start > high, 2.0 * high - start, start)
    start = np.clip(np.where(start < low, 2.0 * low - start, start), low, high)
    moves = [(emcee.moves.DEMove(), 0.9), (emcee.moves.DEMove(gamma0=1.0), 0.1)]
    sampler = emcee.EnsembleSampler(len(start), free, log_probability, vectorize=True, moves=moves)
    sampler.random_state = np.random.RandomState(generator.integers(2**31)).get_state()
    with advancing("sampling the posterior", count, progress, unit="steps") as advance:
        for _ in sampler.sample(start, iterations=count):
            if stopped:
                raise stopped[0]
            advance(1)
    chain = sampler.get_chain(discard=int(BURN_IN * count), flat=True)
    times = sampler.get_autocorr_time(tol=0)
    return _dataset(fit, chain, times, count, seed)


def _dataset(
    fit: FitRecord, chain: Array, times: Array, steps: int, seed: int | None
) -> "xr.Dataset":
    model = fit._best.model
    values = model.values(chain)
    variables: dict[str, Any] = {name: ("sample", values[name][:, 0]) for name in model.free}
    if "kappa" in model.free:
        variables["chi"] = ("sample", half_ratio(model.problem.pair) * values["kappa"][:, 0])
    longest = float(np.nanmax(times)) if np.isfinite(times).any() else float("nan")
    attributes = {
        "title": "posterior of parameters from measured rebounds",
        "steps": steps,
        "seed": -1 if seed is None else seed,
        "autocorrelation_time": longest,
        "converged": int(steps > LEAST_TIMES * longest),
        "inputs": {name: each.value for name, each in fit.estimates.items()},
    }
    coords = {"sample": ("sample", np.arange(len(chain)), {"long_name": "sample"})}
    return labelled_dataset(variables, coords, attributes)
