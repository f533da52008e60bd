"""The score as one labelled dataset, from which its figure is drawn."""

from typing import TYPE_CHECKING, Any

import numpy as np

from carom.dimensionless.rebounds import regime_borders
from carom.impacts.curves import curve
from carom.io.labels import flags, labelled, labelled_dataset
from carom.quantities.glossary import GLOSSARY
from carom.verify.errors import losses_of, pure
from carom.verify.scoring.histories import Forces
from carom.verify.scoring.record import ScoreRecord
from carom.verify.scoring.report import verdict

if TYPE_CHECKING:
    import xarray as xr

CURVES = 5  # chi of which the exact curve is part of the dataset
SMOOTH = 401  # psi_1 of such a curve
NUMBERS = {
    "tolerance": "largest error that passes",
    "restitution": "restitution of the exact impacts",
    "max_error": "largest |error in psi_2|",
    "rms_error": "root mean square of the errors in psi_2",
    "mean_error": "mean error in psi_2",
}


def score_dataset(score: ScoreRecord) -> "xr.Dataset":
    """Return the score as a dataset: errors along `point`, findings along `audit`.

    Exact curves of few chi lie along `curve`, one after the other; a history along `time`.
    """
    attrs = {
        "title": "results against the exact impact",
        "kind": score.kind,
        "verdict": verdict(score),
        "inputs": dict(score.inputs),
    }
    numbers = {name: ((), getattr(score, name), pure(words)) for name, words in NUMBERS.items()}
    passed = {"passed": ((), np.int8(score.passed), flags(("failed", "passed")))}
    variables = {**_points(score), **_findings(score), **numbers, **passed}
    points, words = score.points, {"long_name": f"{score.points.word} of the results"}
    names = {"long_name": "phases of the exact impact for psi_1 > 0, with losses its regime"}
    coords = {
        "row": ("point", points.rows, words),
        "sequence_name": ("sequence_name", list(points.sequence_names), names),
    }
    if score.forces is None:
        return labelled_dataset(variables | _curves(score), coords, attrs)
    whole = labelled_dataset(variables, coords, attrs)
    return _history(score.forces).merge(whole).assign_attrs(whole.attrs)


def _points(score: ScoreRecord) -> dict[str, Any]:
    points = score.points
    energy = {"units": "1" if score.kind == "psi" else "J"}
    energy["long_name"] = "kinetic energy after less that before"
    if score.kind == "psi":
        energy["long_name"] += ", in m_t (mu V_1/kappa)^2/2"
    order = pure("sequence of phases of the exact impact, its place in sequence_name")
    return {
        "psi_in": ("point", points.psi_in),
        "psi_out": ("point", points.psi_out),
        "psi_out_exact": ("point", points.exact, pure("exact psi_2")),
        "error": ("point", points.error, pure("error in psi_2")),
        "chi": ("point", points.chi),
        "energy_change": ("point", points.energy_change, energy),
        "sequence": ("point", points.sequence.astype(np.int16), order),
        **_origins(score),
    }


def _origins(score: ScoreRecord) -> dict[str, Any]:
    """Return code and law of each point, where any is known."""
    known, places = score.origins
    if not score.origins.named:
        return {}
    words = {"code": "program that computed the results", "law": "contact law of the results"}
    return {
        name: ("point", [getattr(known[place], name) for place in places], {"long_name": meaning})
        for name, meaning in words.items()
    }


def _findings(score: ScoreRecord) -> dict[str, Any]:
    audit = score.audit
    words: dict[str, dict[str, Any]] = {
        "name": {"long_name": "what is told"},
        "value": pure("what was found"),
        "limit": pure("its limit"),
        "holds": flags(("broken", "holds")),
        "verdict": {"long_name": "in words"},
    }
    columns: dict[str, Any] = {name: [getattr(one, name) for one in audit] for name in words}
    columns["holds"] = np.array(columns["holds"], dtype=np.int8)
    return {f"audit_{name}": ("audit", columns[name], words[name]) for name in words}


def _curves(score: ScoreRecord) -> dict[str, Any]:
    """Return the exact curves, if they are few, and the borders of the regimes of a single one."""
    points = score.points
    chis = np.unique(points.chi)
    if chis.size > CURVES:
        return {}
    low, high = min(0.0, float(points.psi_in.min())), max(0.0, float(points.psi_in.max()))
    psi = np.linspace(low, high, SMOOTH)
    e = points.restitution
    exact = curve(chis.tolist(), psi, losses=losses_of(e))["psi_out"].values.ravel()
    lines = {
        "curve_chi": ("curve", np.repeat(chis, SMOOTH), pure(GLOSSARY["chi"].meaning)),
        "curve_psi_in": ("curve", np.tile(psi, chis.size), pure("psi_1")),
        "curve_psi_out": ("curve", exact, pure("exact psi_2")),
    }
    if chis.size > 1:
        return lines
    words = pure("|psi_1| at which the regime changes")
    return lines | {"border": ("regime_border", regime_borders(float(chis[0]), e), words)}


def _history(forces: Forces) -> "xr.Dataset":
    hit = forces.hit
    dataset = labelled(
        {
            "time": forces.time,
            "normal_force": forces.normal_force,
            "tangential_force": forces.tangential_force,
        },
        {"friction": hit.pair.friction, "max_force": hit.max_force, "duration": hit.duration},
        hit.phases,
        hit.inputs(),
    )
    exact = {
        "normal force": forces.exact_normal_force,
        "tangential force": forces.exact_tangential_force,
    }
    newton = {
        f"{name.replace(' ', '_')}_exact": (
            "time",
            values,
            {"units": "N", "long_name": f"exact {name}"},
        )
        for name, values in exact.items()
    }
    return dataset.assign(labelled_dataset(newton, {}, {}).data_vars)
