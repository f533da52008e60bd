"""What a fit takes for granted, a restitution of 1 and an elastic kappa, against the data."""

from dataclasses import replace

from scipy.special import chdtri

from carom.fitting.estimation import Best, estimate, likelihood
from carom.fitting.model import KAPPA, Model

ELASTIC_KAPPA = (2.0 / 3.0, 1.0)  # for Poisson's ratios from 1/2 to 0
CLEAR = 10.0  # of -2 log likelihood, by which the data contradict a bound
CONTRADICTED = float(chdtri(1.0, 0.01))  # by one parameter more, by chance once in 100


def elastic_bounds(model: Model) -> tuple[float, float] | None:
    """Return the range of elastic bodies, if kappa is kept in it."""
    own = next((each for each in model.law.parameters if each.name == KAPPA.name), KAPPA)
    return None if own == KAPPA else (own.low, own.high)


def within_elastic_range(best: Best) -> Best:
    """Return the fit with kappa in the range of elastic bodies, unless the data contradict that.

    The kappa of the pair is always in it, also that of a negative Poisson's ratio.
    """
    if KAPPA.name not in best.model.free:
        return best
    own = best.model.problem.pair.kappa
    low, high = min(ELASTIC_KAPPA[0], own), max(ELASTIC_KAPPA[1], own)
    inner = KAPPA._replace(low=low, high=high)
    law = best.model.law
    parameters = tuple(inner if each == KAPPA else each for each in law.parameters)
    bounded = replace(best.model, law=replace(law, parameters=parameters))
    if low <= best.values[KAPPA.name] <= high:
        return replace(best, model=bounded)
    inside = estimate(bounded, best.loss)
    return inside if likelihood(inside) - likelihood(best) < CLEAR else best
