"""Samples of the posterior by an ensemble of walkers, those of emcee."""

from typing import TYPE_CHECKING, Any

import numpy as np

from carom.fitting.comparison import FitRecord
from carom.fitting.model import half_ratio
from carom.io.extras import extra
from carom.io.labels import labelled_dataset
from carom.io.progress import Progress, advancing
from carom.quantities.arrays import Array
from carom.quantities.units import counted

if TYPE_CHECKING:
    import xarray as xr

WALKERS = 8  # per parameter
BURN = 0.25  # part of the steps that is left out
FEWEST_STEPS, MOST_STEPS = 100, 100_000
MOST_SEED = 2**63 - 1  # that a file can hold
LONG = 50.0  # autocorrelation times that a chain should have (emcee's documentation)


def sample(fit: FitRecord, steps: int, seed: int | None, progress: Progress) -> "xr.Dataset":
    """Return samples of the parameters that the data determine, as `Fit.posterior`."""
    emcee = extra("emcee", "posterior", "fit")
    count = counted("steps", steps, FEWEST_STEPS, MOST_STEPS)
    if seed is not None:
        counted("seed", seed, 0, MOST_SEED)
    best = fit.best
    low, high = best.model.bounds
    residuals = best.model.residuals(best.weights, best.loss)
    stopped: list[BaseException] = []

    def log_probability(at: Array) -> Array:
        try:
            inside = np.all((at >= low) & (at <= high), axis=1)
            values = residuals(np.clip(at, low, high))
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
    chain = sampler.get_chain(discard=int(BURN * count), flat=True)
    times = sampler.get_autocorr_time(tol=0)
    return _dataset(fit, chain, times, count, seed)


def _dataset(
    fit: FitRecord, chain: Array, times: Array, steps: int, seed: int | None
) -> "xr.Dataset":
    model = fit.best.model
    values = model.values(chain)
    variables: dict[str, Any] = {name: ("sample", values[name][:, 0]) for name in model.free}
    if "kappa" in model.free:
        variables["chi"] = ("sample", half_ratio(model.problem.pair) * values["kappa"][:, 0])
    longest = float(np.nanmax(times)) if np.isfinite(times).any() else float("nan")
    told = {
        "title": "posterior of parameters from measured rebounds",
        "steps": steps,
        "seed": -1 if seed is None else seed,
        "autocorrelation_time": longest,
        "converged": int(steps > LONG * longest),
        "inputs": {name: each.value for name, each in fit.estimates.items()},
    }
    coords = {"sample": ("sample", np.arange(len(chain)), {"long_name": "sample"})}
    return labelled_dataset(variables, coords, told)
