"""What a fit takes for granted, a restitution of 1 and an elastic kappa, against the data."""

from dataclasses import replace
from math import log

from scipy.special import chdtri

from carom.fitting.estimation import Best, estimate
from carom.fitting.model import KAPPA, RESTITUTION, Model, ranged
from carom.io.remedies import REMEDIES
from carom.quantities.refusals import InputError

ELASTIC_KAPPA = (2.0 / 3.0, 1.0)  # for Poisson's ratios from 1/2 to 0
AUXETIC_KAPPA = 4.0 / 3.0  # for a Poisson's ratio of -1
CLEAR = 2.0 * log(1000.0)  # of -2 log likelihood, by which the data contradict a bound
CONTRADICTED = float(chdtri(1.0, 0.01))  # by one parameter more, by chance once in 100

ELASTIC_TAKEN = (
    "restitution: taken as 1, since it is neither varied nor fixed; from rows that slip throughout "
    "only friction (1 + restitution) follows"
)


def elastic_bounds(model: Model) -> tuple[float, float] | None:
    """Return the range of elastic bodies, if kappa is kept in it."""
    own = next((each for each in model.law.parameters if each.name == KAPPA.name), KAPPA)
    return None if own == KAPPA else ranged(own, model.problem)[1:3]


def within_elastic_range(best: Best) -> Best:
    """Return the fit with kappa in the range of elastic bodies, unless the data contradict that.

    The kappa of like bodies is 2 (1 - nu)/(2 - nu); that of unlike ones lies between those of each.
    """
    if KAPPA.name not in best.model.free:
        return best
    low, high = ELASTIC_KAPPA
    if best.model.problem.pair.kappa > high:
        high = AUXETIC_KAPPA
    inner = KAPPA._replace(low=low, high=high)
    law = best.model.law
    parameters = tuple(inner if each == KAPPA else each for each in law.parameters)
    bounded = replace(best.model, law=replace(law, parameters=parameters))
    if low <= best.values[KAPPA.name] <= high:
        return replace(best, model=bounded)
    inside = estimate(bounded, best.loss)
    return inside if inside.deviance - best.deviance < CLEAR else best


def refuse_contradicted(best: Best) -> None:
    """Raise InputError if the data contradict the restitution of 1 that nobody has given.

    They do if a restitution of its own makes them likelier than chance does in one of 100 sets.
    """
    name = RESTITUTION.name
    if best.model.problem.count <= len(best.model.free) + 1:  # too few to tell
        return
    freed = estimate(best.model.freeing([name]), best.loss)
    if best.deviance - freed.deviance > CONTRADICTED:
        said = round(freed.values[name], 2)
        fix = REMEDIES.get().fix.format(name=name, value=said)
        words = f"it would be held at 1, but the data say about {said}"
        raise InputError(f"{name}: {words}; add it to vary, or fix it, e.g. {fix}")
