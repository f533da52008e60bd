"""What many tests assert: that a call is refused in one line, that the text of a figure is seen.

And what many tests strike: a ball of steel on a floor of steel, as objects and as a file.
"""

import itertools
import re

import numpy as np
import pytest
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

import carom

BALL = carom.Sphere(radius="5 mm", material="steel")
FLOOR = carom.HalfSpace(material="steel")
PAIR = carom.Pair(BALL, FLOOR, friction=0.2)
CASE = """\
friction = 0.2
speed = "2 m/s"
angle = "30 deg"
[first]
radius = "5 mm"
material = "steel"
"""


def experiment(**changed):
    """Return impacts that an engine is asked for: of linear springs, in 1000 steps."""
    given = {"pair": PAIR, "law": carom.dem.LinearSpring(), "normal_speed": 0.01, "steps": 1000}
    given |= {"tangential_speed": (0.005, -0.02), "spin": (0.0, 3.0)}
    return carom.verify.Experiment(**(given | changed))


def measured(friction):
    """Return a table of rebounds of a ball of bearing steel, 5 mm, whose friction is known."""
    body = {"material": "bearing-steel"}
    pair = carom.Pair(carom.Sphere(radius="5 mm", **body), carom.HalfSpace(**body), friction)
    lines, random = ["angle [deg],contact_beta,run"], np.random.default_rng(20261121)
    for run, angle in enumerate(range(4, 76, 4)):
        hit = carom.impact(pair, speed=0.6, angle=f"{angle} deg")
        lines.append(f"{angle},{-hit.contact_restitution + random.normal(0.0, 0.004)},{run}")
    return "\n".join([*lines, ""])


def refused(words, function, *given, **named):
    """Assert that a call is refused in one line with these words, a pattern; return the line."""
    with pytest.raises(carom.InputError) as error:
        function(*given, **named)
    line = str(error.value)
    assert "\n" not in line
    assert len(line) < 10_000
    assert re.search(words, line), line
    return line


def seen_texts(figure):
    """Return all texts that are seen: not the labels of ticks outside the limits."""
    hidden = set()
    for axis in figure.axes:
        for side, limits in ((axis.xaxis, axis.get_xlim()), (axis.yaxis, axis.get_ylim())):
            for tick in side.get_major_ticks():
                if not min(limits) <= tick.get_loc() <= max(limits):
                    hidden |= {id(tick.label1), id(tick.label2)}
    texts = [t for t in figure.findobj(Text) if t.get_visible() and t.get_text().strip()]
    return [t for t in texts if id(t) not in hidden]


def is_legible(figure, least=11):
    """Assert that every text that is seen lies within the figure and clear of every other."""
    FigureCanvasAgg(figure)
    figure.draw_without_rendering()
    page = figure.bbox
    boxes = [(text.get_text(), text.get_window_extent()) for text in seen_texts(figure)]
    assert len(boxes) >= least
    for text, box in boxes:
        inside = box.x0 >= -0.5 and box.y0 >= -0.5 and box.x1 <= page.x1 and box.y1 <= page.y1
        assert inside, text
    for (first, box), (second, other) in itertools.combinations(boxes, 2):
        wide = min(box.x1, other.x1) - max(box.x0, other.x0)
        high = min(box.y1, other.y1) - max(box.y0, other.y0)
        assert wide <= 0.5 or high <= 0.5, (first, second)
    return True


def one_line(error, longest=10_000):
    """Return the line that a refusal is; it begins with what is refused."""
    assert re.fullmatch(r"[^\n:]+: .+", str(error)), error
    assert len(str(error)) < longest
    return str(error)


def is_stored(result, folder):
    """Assert that the file of a result gives it back, and that it is drawn and shown."""
    dataset = result.to_dataset()
    xr.testing.assert_identical(carom.read(carom.save(result, folder / "result.nc")), dataset)
    result.plot(folder / "result.png")
    assert "<table" in result._repr_html_()
