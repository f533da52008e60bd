"""How far long work is, in notebooks that are run by a Jupyter kernel."""

import re

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
pytest.importorskip("ipywidgets")

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning:jupyter_client")

SOON = "import time, carom.io.progress\ncarom.io.progress.PATIENCE = 0.2"
WORK = """
with carom.io.progress.advancing("impacts", 20, {progress}, unit="steps") as advance:
    for step in range(20):
        time.sleep(0.05)
        advance(1)
        {more}
"""
IMPACT = """
ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
coarse = carom.BoundaryElements(elements=16, steps=100)
hit = carom.impact(pair, speed=2.0, angle="30 deg", method=coarse)
"""
WITHOUT_WIDGETS = "import sys\nsys.modules['ipywidgets'] = None"


@pytest.fixture(scope="module")
def cells():
    """The cells of a notebook that was run, and the widgets that it shows, by model."""
    sources = [
        SOON,
        WORK.format(progress="None", more=""),
        WORK.format(progress="False", more=""),
        WORK.format(progress="None", more="if step == 10: raise KeyboardInterrupt"),
        IMPACT,
        WITHOUT_WIDGETS,
        WORK.format(progress="None", more=""),
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(s) for s in sources])
    nbclient.NotebookClient(
        notebook, timeout=60, kernel_name="python3", allow_errors=True
    ).execute()
    states = notebook.metadata["widgets"]["application/vnd.jupyter.widget-state+json"]["state"]
    return [cell.outputs for cell in notebook.cells], states


def widgets(outputs):
    return [
        output["data"]["application/vnd.jupyter.widget-view+json"]["model_id"]
        for output in outputs
        if output["output_type"] == "display_data"
    ]


def bar(states, model):
    """Return what a bar of tqdm holds: what is before it, the bar, what is after."""
    return [
        states[name.removeprefix("IPY_MODEL_")]["state"]
        for name in states[model]["state"]["children"]
    ]


def test_long_work_shows_a_widget_without_asking(cells):
    outputs, states = cells
    (model,) = widgets(outputs[1])
    before, shown, after = bar(states, model)
    assert "impacts" in before["value"]
    assert (shown["value"], shown["max"], shown["bar_style"]) == (20.0, 20.0, "success")
    assert re.search(r"20.0/20.0 \[00:0\d.*steps/s\]", after["value"].replace("\u2007", " "))


def test_nothing_is_shown_where_that_is_wanted(cells):
    outputs, _ = cells
    assert outputs[0] == outputs[2] == []


def test_a_bar_that_stopped_says_so(cells):
    outputs, states = cells
    (model,) = widgets(outputs[3])
    _, shown, _ = bar(states, model)
    assert (shown["value"], shown["bar_style"]) == (11.0, "danger")
    assert outputs[3][-1]["ename"] == "KeyboardInterrupt"


def test_an_impact_by_boundary_elements_shows_one(cells):
    outputs, states = cells
    (model,) = widgets(outputs[4])
    before, shown, _ = bar(states, model)
    assert before["value"].startswith("boundary\u2007elements")
    assert shown["value"] == shown["max"] == 150.0


def test_text_is_shown_without_widgets(cells):
    outputs, _ = cells
    assert widgets(outputs[6]) == []
    text = "".join(output["text"] for output in outputs[6])
    assert "impacts: 100%" in text
