"""One impact with losses, solved in the way that suits them."""

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.marched_solution import solve_by_marching
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.viscoelastic_solution import solve_viscoelastic
from carom.quantities.refusals import refusal


def solve_with_losses(psi: float, chi: float, losses: LossNumbers) -> LossySolution:
    """Solve one oblique impact with losses; InputError for bad numbers."""
    solved_by = solve_viscoelastic if losses.loss == Loss.VISCOUS else solve_by_marching
    solution = solved_by(psi, chi, losses)
    if solution.status in (Status.PSI_NOT_FINITE, Status.CHI_NOT_POSITIVE):
        bad_psi = solution.status is Status.PSI_NOT_FINITE
        name, value = ("psi", psi) if bad_psi else ("chi", chi)
        raise refusal(name, value, f"not allowed: {solution.status.message}")
    return solution
