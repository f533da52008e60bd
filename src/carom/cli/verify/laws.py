"""`carom verify laws`: the ranking of contact laws."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import typer

import carom
from carom.cli.cases import check_outputs, store, stored
from carom.cli.options import described
from carom.quantities.refusals import InputError
from carom.quantities.units import finite, positive

if TYPE_CHECKING:
    from carom.dem.base import Law


OPTIONS = {
    "chi": "Ratio of inertia to stiffness, chi = (kappa/2)(m_n/m_t), positive; the default is "
    "that of solid spheres with Poisson's ratio 0.3.",
    "kappa": "Stiffness ratio kappa = G*/E* (default: that of solid spheres, 4 chi/7).",
    "psi": "Incidence psi_1 = kappa V_x/(mu V_1) at which laws are compared (default: 15 from 0.1 "
    "to 6). You can repeat this option.",
    "law": "Rank only this law, e.g. mindlin_rescale.",
    "restitution": "Give all laws the damping for this normal coefficient of restitution, e.g. "
    "0.9 (default: no damping).",
    "output": "Store the ranking: .csv or .nc.",
    "error_map": typer.Option(
        "--map",
        help="Store a map of the errors of the one --law, for solid spheres of any Poisson's "
        "ratio: a figure or a table.",
    ),
}


@described(OPTIONS)
def laws_command(
    chi: str = "1.4412",
    kappa: str | None = None,
    psi: list[str] | None = None,
    law: str | None = None,
    restitution: str | None = None,
    as_json: bool = False,
    plot: str | None = None,
    output: str | None = None,
    error_map: str | None = None,
) -> None:
    """Rank contact laws of DEM codes by their largest error.

    Use this command to choose a contact law, or to see how wrong the law of your DEM code is. The
    error is that of psi_2, the dimensionless tangential velocity of the contact point after the
    impact, against the exact impact. The table also says how many time steps a law needs.

    \b
    Example: carom verify laws
    Damped laws, compared at equal restitution: carom verify laws --restitution 0.7
    Thin shells on a wall: carom verify laws --chi 1.0294 --kappa 0.8235 --plot laws.png
    One law for all solid spheres: carom verify laws --law mindlin --map mindlin.png
    """
    from carom.dem.damping import damped_restitution
    from carom.verify.entries import named
    from carom.verify.errors import INCIDENCES

    if error_map is not None and law is None:
        raise InputError("map: it shows one law; give --law, e.g. --law mindlin")
    if error_map is not None and (kappa is not None or psi):
        raise InputError("map: it shows solid spheres at all psi_1; leave --kappa and --psi out")
    check_outputs({"plot": plot, "output": output, "map": error_map})
    incidences = [finite("psi_in", value) for value in psi or INCIDENCES]
    ratio = None if kappa is None else positive("kappa", kappa)
    e = None if restitution is None else damped_restitution("restitution", restitution)
    size = positive("chi", chi)
    ranking = carom.verify.rank(named(law), chi=size, kappa=ratio, psi=incidences, restitution=e)
    store(ranking, output, plot)
    if error_map is not None:
        stored(_store_map(ranking.standings[0].entry.law, error_map))
    typer.echo(json.dumps(ranking.to_dict(), indent=2) if as_json else str(ranking))


def _store_map(law: "Law", path: str) -> Path:
    from carom.io.files import TABLES

    dataset = carom.verify.error_map(law)
    if path.lower().endswith(TABLES):
        return carom.save(dataset, path)
    return carom.plots.save_figure(carom.plots.plot_error_map(dataset), path)
