"""Files of a view are what the library says, with bodies and with psi_1 and chi alike."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from PIL import Image

import carom

pytest.importorskip("flask")

from carom.page import files
from carom.page.app import PICTURES
from carom.page.files import NumbersImpact, contact_figure, history_figure
from carom.page.outcomes import impact_of
from carom.page.views import NUMBERS, View

BODIES = View(angle=41.5)
STATES = {
    "bodies": BODIES,
    "losses": View(restitution=0.7, angle=55.0),
    "numbers": View(given=NUMBERS, psi=2.2, chi=1.3),
    "numbers with losses": View(given=NUMBERS, psi=-1.5, chi=1.44, restitution=0.6),
    "plate": View(thickness=3.0, angle=41.5),
    "numbers on a plate": View(given=NUMBERS, psi=2.2, chi=1.3, inelasticity=0.4),
}


@pytest.fixture(autouse=True)
def _coarse(monkeypatch):
    monkeypatch.setattr("carom.plots.style.DPI", 100)  # sooner stored


def some_slow(cases, slow):
    return [pytest.param(x, id=str(x), marks=[pytest.mark.slow] * (x in slow)) for x in cases]


@pytest.mark.slow
@pytest.mark.parametrize("name", some_slow(STATES, ("losses", "numbers with losses", "plate")))
def test_every_picture_is_written_in_both_modes(name, tmp_path):
    for picture in PICTURES:
        with Image.open(files.write(f"{picture}.png", STATES[name], 0.6, tmp_path)) as image:
            assert min(image.size) >= 200
            assert len(image.convert("RGB").getcolors(2**24)) > 50  # not an empty sheet


@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("time", [-0.6, 0.0, 1.0, 1.6])
def test_the_contact_outside_its_time_is_apart(name, time):
    """As the page says at that time of its film, and with that time."""
    axis = contact_figure(STATES[name], time).axes[0]
    assert [text.get_text() for text in axis.texts] == ["apart"]
    title = axis.get_title()
    assert title.startswith("apart, $t$ = ")
    lasts = NumbersImpact(STATES[name]) if "numbers" in name else impact_of(STATES[name])
    unit = 1.0 if "numbers" in name else 1e-6
    told = float(title.removeprefix("apart, $t$ = ").split("\xa0")[0].replace("\u2212", "-"))
    assert told == pytest.approx(time * lasts.duration / unit, rel=5e-3, abs=1e-12)


def test_a_picture_is_written_as_pdf(tmp_path):
    assert files.write("contact.pdf", BODIES, 0.6, tmp_path).read_bytes().startswith(b"%PDF")


ODD = [View(given=NUMBERS, psi=0.0), View(friction=0.0), View(angle=0.0), View(angle=89.9)]


@pytest.mark.slow
@pytest.mark.parametrize("view", some_slow(ODD, ODD[2:]))
def test_pictures_of_odd_states(view, tmp_path):
    for picture, time in (*((picture, 0.0) for picture in PICTURES), ("contact", 1.0)):
        stored = files.write(f"{picture}.svg", view, time, tmp_path).read_bytes()
        assert stored.startswith(b"<?xml")
        assert len(stored) > 10_000


@pytest.mark.parametrize("name", ["numbers", "numbers with losses", "numbers on a plate"])
def test_figures_of_numbers_are_those_of_bodies_in_units_of_the_theory(name):
    """The same psi_1, chi and e as of bodies: the lines differ by a factor each."""
    values = STATES[name]
    shown = {"friction": 0.2, "angle": 41.5, "restitution": values.restitution}
    if values.on_plate:
        shown["thickness"] = 3.0
    hit = impact_of(View(**shown))
    give = 1.25**0.4 * hit.pair.plate_give(hit.normal_speed)
    exact = {"psi": hit.psi_in, "chi": hit.pair.chi, "inelasticity": give}
    numbers = NumbersImpact(replace(values, **exact))
    history, theirs, scales = numbers.history(201), hit.history(201), hit.scales
    units = {
        "time": scales.time,
        "normal_force": scales.force,
        "tangential_force": hit.pair.friction * scales.force,
        "contact_velocity": scales.tangential_speed,
        "normal_velocity": hit.normal_speed,
        "contact_radius": scales.radius,
        "stick_radius": scales.radius,
    }
    for column, unit in units.items():
        expected = theirs[column].values / unit
        np.testing.assert_allclose(history[column], expected, rtol=1e-9, atol=1e-9, err_msg=column)
    share = 0.6
    line = np.linspace(0.0, float(history["contact_radius"][120]), 20)[:-1]
    points = np.column_stack([line, 0.0 * line])
    ours = numbers.fields(share * float(history["time"][-1]))
    fields = hit.fields(share * hit.duration, points=points * scales.radius)
    along = ours["traction_x"].sel(y=0.0, method="nearest").interp(x=line[:-4])
    expected = fields["traction_x"].values[:-4] / (hit.pair.friction * scales.pressure)
    np.testing.assert_allclose(along, expected, atol=0.02)


def test_axes_of_numbers_tell_units_of_the_theory():
    view = STATES["numbers"]
    for figure in (history_figure(view), contact_figure(view, 0.6)):
        for axis in figure.axes:
            for text in (axis.get_xlabel(), axis.get_ylabel()):
                assert not any(unit in text for unit in ("(N)", "(s)", "(m)", "µ", "Pa", "m/s"))
    labels = [axis.get_ylabel() for axis in history_figure(view).axes]
    assert labels[0] == "$F_x$\xa0($\\mu F_{max}$)"
    assert labels[3] == "share of tangential energy"


@pytest.mark.first_case
@pytest.mark.parametrize("name", STATES)
def test_histories_are_those_of_the_library(name, tmp_path):
    view = STATES[name]
    if view.in_numbers:
        e = view.restitution
        losses = None if e == 1.0 else carom.KelvinVoigt(restitution=e)
        if view.on_plate:
            losses = carom.ZenerPlate(inelasticity=view.inelasticity)
        solution = carom.solve(view.psi, view.chi, losses=losses)
        columns = ("psi", "stored", "shear_lost")
        expected = {column: getattr(solution.history(201), column) for column in columns}
    else:
        history = impact_of(view).history(201)
        expected = {column: history[column].values for column in ("contact_velocity", "shear_loss")}
    stored = carom.read(files.write("history.nc", view, 0.5, tmp_path))
    table = pd.read_csv(files.write("history.csv", view, 0.5, tmp_path))
    table.columns = [head.partition(" [")[0] for head in table.columns]
    for actual in (stored, table):
        for column, values in expected.items():
            bound = 1e-9 * np.ptp(values) + 1e-300
            np.testing.assert_allclose(np.asarray(actual[column]), values, atol=bound)


def test_the_template_is_that_of_the_command_line(tmp_path):
    from carom.lab.fitting.template import TEMPLATE

    assert files.write("template.csv", View(), 0.5, tmp_path).read_text() == TEMPLATE
