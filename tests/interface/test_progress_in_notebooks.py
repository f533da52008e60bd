"""How far long work is, in notebooks that are run by a Jupyter kernel."""

import re

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::DeprecationWarning:jupyter_client"),
]

SOON = "import carom, time, carom.io.progress as p\np.PATIENCE = dict.fromkeys(p.Place, 0.2)"
WORK = """
with p.advancing("impacts", 20, {progress}, unit="steps") as advance:
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
    """What the cells of a notebook that was run put out."""
    sources = [
        *(SOON, WORK.format(progress="None", more=""), WORK.format(progress="False", more="")),
        *(WORK.format(progress="None", more="if step == 10: raise KeyboardInterrupt"), IMPACT),
        *(WITHOUT_WIDGETS, WORK.format(progress="None", more="print(step)")),
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(s) for s in sources])
    nbclient.NotebookClient(
        notebook, timeout=60, kernel_name="python3", allow_errors=True
    ).execute()
    return [cell.outputs for cell in notebook.cells]


def bar(outputs):
    """Return what the one bar among the outputs says, as text; its HTML says the same."""
    (data,) = [output["data"] for output in outputs if output["output_type"] == "display_data"]
    text = re.sub(r"\x1b\[[\d;]*m", "", data["text/plain"])
    assert re.sub(r"<[^>]*>", "", data["text/html"]).rstrip() == text.rstrip()
    return text.rstrip()


def test_long_work_shows_a_bar_without_asking(cells):
    assert re.fullmatch(r"impacts ━{24} 20/20 steps 0:00:00 left", bar(cells[1]))
    assert len(cells[1]) == 1, "nothing but the bar"


def test_nothing_is_shown_where_that_is_wanted(cells):
    assert cells[0] == cells[2] == []


def test_a_bar_that_stopped_says_so(cells):
    assert re.search(r"impacts, stopped .* 11/20 steps", bar(cells[3]))
    assert cells[3][-1]["ename"] == "KeyboardInterrupt"


def test_an_impact_by_boundary_elements_shows_one(cells):
    assert re.search(r"^solving by boundary elements ━{24} 175/175 ", bar(cells[4]))


def test_no_widgets_are_needed_and_what_is_printed_is_seen(cells):
    assert "20/20 steps" in bar(cells[6])
    printed = [output["text"] for output in cells[6] if output["output_type"] == "stream"]
    assert "".join(printed).split() == [str(step) for step in range(20)]
