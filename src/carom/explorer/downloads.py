"""Files of a view: histories, pictures and lines of Python, each at an address of its own."""

from collections.abc import Callable
from math import isfinite
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.parse import parse_qs

import xarray as xr
from flask import Flask, Response, request
from matplotlib.figure import Figure

from carom.dimensionless.solution import solve
from carom.explorer.limits import LAW_SECONDS, Busy, Turns
from carom.explorer.overlays import LawCurve, exact_curve, followers, law_curves
from carom.explorer.scenes import TIMES, Scene, impact_of, scene_of
from carom.explorer.scripts import script
from carom.explorer.views import View
from carom.impacts.curves import curve
from carom.impacts.exact import Impact
from carom.io.files import save
from carom.io.labels import labelled_dataset
from carom.plots import plot_curve, plot_impact, plot_patch, save_figure
from carom.plots.legends import legend_above
from carom.plots.style import DASHES, LINES, MM, VERMILION, styled
from carom.quantities.refusals import InputError, refusal
from carom.quantities.texts import Unreadable, read_text
from carom.verify.errors import losses_of

KINDS = {
    ".csv": "text/csv; charset=utf-8",
    ".nc": "application/x-netcdf",
    ".png": "image/png",
    ".py": "text/x-python; charset=utf-8",
}
MEANINGS = {  # of the columns of `Solution.history`
    "penetration": "penetration, in d_max",
    "speed": "normal speed of approach, in V_1",
    "psi": "velocity of the contact point, in mu V_1/kappa",
    "displacement": "tangential displacement, in mu d_max/kappa",
    "force": "(2/3) F_x/(mu P_max)",
    "stick_radius": "radius of the stick zone, in the largest of the contact",
    "contact_radius": "radius of the contact, in its largest",
    "stored": "tangential elastic energy; that of motion is psi^2/2",
    "dissipated": "work of friction, as above",
    "normal_force": "F_z/P_max",
    "normal_stored": "normal elastic energy, in that of the impact",
    "shear_lost": "what viscosity took in shear, in psi^2/2",
    "normal_lost": "what the normal motion lost, as above",
}
ENTRY = 1.8  # mm that a law adds to the legend of the rebound curve
_turns = Turns()  # besides, matplotlib's settings are those of the whole process


def add_downloads(server: Flask) -> None:
    """Let the server answer with files of a view at /history.csv and so on, ?... as in a link."""
    for name in WRITERS:
        server.add_url_rule(f"/{name}", name, _answer(name))


def _answer(name: str) -> Callable[[], Response]:
    def answer() -> Response:
        query = request.query_string.decode("ascii", "replace")
        with _turns, TemporaryDirectory() as folder:
            file = Path(folder) / name
            WRITERS[name](View.of(query), _time(query), file)
            content = file.read_bytes()
        attached = {"Content-Disposition": f"attachment; filename={name}"}
        return Response(content, headers=attached, content_type=KINDS[file.suffix])

    return answer


def _time(query: str) -> float:
    """Return the time in a link, within the contact, as a share of its duration."""
    text = parse_qs(query).get("time", ["0.5"])[-1]
    try:
        return min(max(read_text(text, "1"), 0.0), 1.0)
    except Unreadable:
        raise refusal("time", text, "must be a share of the duration, e.g. 0.5") from None


def _history(view: View, _: float, file: Path) -> None:
    save(dimensionless_history(view) if view.in_numbers else impact_of(view).history(TIMES), file)


def _picture(view: View, _: float, file: Path) -> None:
    history = _hit(view).history(TIMES)
    save_figure(plot_impact(history), file)


def _curve(view: View, _: float, file: Path) -> None:
    scene = scene_of(view)
    found = law_curves(scene, view.laid_over, LAW_SECONDS, followers.joined())
    laws = [law for law in found if law is not None]
    if len(laws) < len(found):
        raise Busy
    save_figure(curve_figure(scene, laws), file)


@styled
def curve_figure(scene: Scene, laws: list[LawCurve]) -> Figure:
    """Return the rebound curve with the present point and the contact laws over it."""
    figure = plot_curve(
        curve(scene.chi, exact_curve(scene)[0], losses=losses_of(scene.restitution))
    )
    axis = figure.axes[0]
    legend = axis.get_legend()
    entries: list[Any] = [] if legend is None else list(legend.legend_handles)
    for row, law in enumerate(laws):
        look: Any = {"color": LINES[1 + row % 4], "ls": DASHES[1 + row // 4 % 4], "lw": 0.9}
        entries += axis.plot(law.psi_in, law.psi_out, label=law.label, **look)
    if isfinite(scene.psi_in):
        point: Any = {"marker": "o", "ls": "", "color": VERMILION, "label": "this impact"}
        entries += axis.plot(scene.psi_in, scene.psi_out, **point)
    if laws:  # whose names are long
        height = figure.get_figheight() + ENTRY * MM * len(laws)
        figure.set_size_inches(1.5 * figure.get_figwidth(), height)
    legend_above(axis, 2, handles=entries)
    return figure


def _patch(view: View, time: float, file: Path) -> None:
    hit = _hit(view)
    fields_then = hit.fields(time * hit.duration)
    save_figure(plot_patch(fields_then), file)


def _hit(view: View) -> Impact:
    if view.in_numbers:
        raise InputError("given: this has units; choose bodies instead of psi_1 and chi")
    return impact_of(view)


def _lines(view: View, time: float, file: Path) -> None:
    file.write_text(script(view, time), encoding="utf-8")


WRITERS: dict[str, Callable[[View, float, Path], None]] = {
    "history.csv": _history,
    "history.nc": _history,
    "history.png": _picture,
    "curve.png": _curve,
    "patch.png": _patch,
    "view.py": _lines,
}


def dimensionless_history(view: View) -> xr.Dataset:
    """Return the history of an impact that psi_1 and chi tell, in the units of `carom.solve`."""
    solution = solve(view.psi, view.chi, losses=view.losses)
    history = solution.history(TIMES)
    columns = {
        name: ("time", getattr(history, name), {"long_name": meaning, "units": "1"})
        for name, meaning in MEANINGS.items()
    }
    time = ("time", history.time, {"long_name": "time, in d_max/V_1", "units": "1"})
    numbers = {"psi_in": view.psi, "chi": view.chi, "psi_out": solution.psi_out}
    numbers |= {"restitution": view.restitution} if view.losses else {}
    title = {"title": "oblique impact, in the units of carom.solve"}
    return labelled_dataset({**columns, **numbers}, {"time": time}, title)
