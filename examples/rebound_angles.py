r"""Compare measured balls with theory
==================================

`carom.sweep` calculates angle, spin and restitution at all angles, to be laid beside measurements.

Balls of 5 mm of alumina strike glass at 3.9 m/s. Where the ball slides throughout, from
:math:`\psi_1 = 4\chi - 1` on, friction acts on all impacts alike:
:math:`\tan\theta' = \tan\theta - 2\mu` and :math:`\omega' = 5\mu V_1/R`. At smaller angles the ball
sticks for a while, and the slip ring decides how much it is turned and thrown back. Only
:math:`\mu` is fitted, to the impacts that slide; those at smaller angles are the test.

Kharaz, Gorham & Salman (2001), Powder Technol. 120:281, as digitised.
"""

import numpy as np

import carom
from carom.impacts.curves import borders
from carom.plots.style import BLUE, DASHES, DOUBLE, new_figure, save_figure, style

case = {
    "first": {"radius": "2.5 mm", "material": "alumina"},
    "second": {"material": "soda-lime-glass"},
    "friction": 0.092,
    "speed": "3.9 m/s",
}
data = carom.datasets.load("kharaz2001")
line = carom.sweep(case, carom.Grid({"angle": {"from": 0.01, "to": 1.13, "points": 130}}))
there = carom.sweep(case, carom.Table({"angle": data.angle.values}))
limits = {"rebound_angle": 0.026, "spin_out": 40.0, "tangential_restitution": 0.03}  # scatter
for name, limit in limits.items():
    off = float(np.abs(data[name] - there[name]).max())
    print(f"{name}: differs by up to {off:.3g} {data[name].units}")
    assert off < limit

# %%
# Check: sliding throughout in closed form.
mu, normal = case["friction"], 3.9 * np.cos(line.angle.values)
ball = carom.Sphere(radius="2.5 mm", material="alumina")
pair = carom.Pair(ball, carom.HalfSpace("soda-lime-glass"), friction=mu)
tangent = np.tan(line.angle.values)
slides = pair.kappa * tangent / mu > borders(pair.chi)[2]
assert 27.5 < np.degrees(line.angle.values[slides][0]) < 29.0, "slides throughout above 28 deg"
sliding = np.arctan(tangent - 2 * mu), -5 * mu * normal / ball.radius, 1 - 2 * mu / tangent
for name, closed in zip(limits, sliding, strict=True):
    np.testing.assert_allclose(line[name].values[slides], closed[slides], rtol=1e-9)

with style():
    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=64)
    scales = (180 / np.pi, -1, 1)
    labels = (r"$\theta'$ (deg)", r"$|\omega'|$ (rad/s)", "$v_t'/v_t$")
    titles = ("angle of rebound", "spin after", "tangential restitution")
    for axis, name, closed, scale in zip(axes, limits, sliding, scales, strict=True):
        axis.plot(np.degrees(line.angle), scale * line[name], color=BLUE, label="calculated")
        grips = ~slides & (tangent > 0.15)
        rest = {"color": "0.5", "ls": DASHES[1], "lw": 0.8, "label": "if it slid throughout"}
        axis.plot(np.degrees(line.angle)[grips], scale * closed[grips], **rest)
        axis.plot(np.degrees(data.angle), scale * data[name], "ko", mfc="white", label="measured")
    for axis, title, label, top in zip(axes, titles, labels, (65, 900, 1), strict=True):
        axis.set(xlim=(0, 65), ylim=(0.5 * (top == 1), top), xlabel=r"$\theta$ (deg)")
        axis.set(title=title, ylabel=label)
    axes[0].legend(loc="upper left")
    save_figure(figure, "rebound_angles.png")
