r"""Ask whether the theory holds for a ball
=======================================

`hit.validity` says whether each assumption of the theory holds for an impact, fails or was not
judged.

Each row of the picture is an assumption, judged for impacts at 10 degrees of surfaces that are
lapped to 30 nm together. Where all rows hold, the restitution and psi_2 are within 0.01 of those of
the theory. For a ball of your own, give its material, its
radius and, if it strikes a plate, the thickness: `python theory_ends.py alumina "2 mm" "10 mm"`.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.patches import Patch

import carom
from carom.plots.style import DOUBLE, VERMILION, new_figure, save_figure, styled

ball = carom.Sphere(radius="5 mm", material="bearing-steel")
pair = carom.Pair(ball, carom.HalfSpace("bearing-steel"), friction=0.15, roughness="30 nm")
hit = carom.impact(pair, speed="0.5 m/s", angle="10 deg")
print(hit.validity)

# %%
# The figure: three balls at many speeds.
SPEEDS = np.geomspace(1e-4, 100.0, 73)  # m/s
ABSENT = "speed by weight/V_1"  # where it holds
ROWS = {  # findings of validity by what one would call them
    "weight": (ABSENT,),
    "adhesion": ("work of adhesion",),
    "roughness": ("rms roughness/penetration",),
    "losses in the material": ("energy lost in the material",),
    "yield": ("von Mises stress/Y",),
    "waves in the ball": ("contact time/wave transit",),
    "waves in the wall": ("energy of waves in the wall",),
    "bending of the plate": ("bending wave/h", "error of e", "a_max/h", "deflection/h"),
    "rebound": ("error of psi_2",),
}
COLOURS = {True: "#56B4E9", None: "0.75", False: VERMILION}
WORDS = {True: "holds", None: "not judged", False: "fails"}
BENCHES = {
    "bearing steel, 10 mm, on a thick wall of it": ("bearing-steel", "5 mm", None),
    "the same on a plate of 10 mm": ("bearing-steel", "5 mm", "10 mm"),
    "bearing steel, 20 µm, on a thick wall of it": ("bearing-steel", "10 um", None),
}


def verdicts(material, radius, thickness=None):
    """Return whether each row holds at each speed; rows that do not apply are left out."""
    ball = carom.Sphere(radius=radius, material=material)
    wall = carom.HalfSpace(material, thickness=thickness)
    pair = carom.Pair(ball, wall, friction=0.15, roughness="30 nm")
    rows = {name: [] for name in ROWS}
    for speed in SPEEDS:
        hit = carom.impact(pair, speed=speed, angle="10 deg")
        judged = {ABSENT: True} | {each.name: each.holds for each in hit.validity.findings}
        for name, findings in ROWS.items():
            values = [judged[each] for each in findings if each in judged]
            if values:
                rows[name].append(False if False in values else None if None in values else True)
    return {name: row for name, row in rows.items() if row}


@styled
def draw(benches):
    """Draw a panel for each bench, with a bar for each row."""
    middle = np.sqrt(SPEEDS[1:] * SPEEDS[:-1])
    edges = np.concatenate([SPEEDS[:1], middle, SPEEDS[-1:]])
    height = 15.0 + 45.0 * len(benches)  # mm
    figure, axes = new_figure(len(benches), 1, width=DOUBLE, height=height, sharex=True)
    for axis, (title, rows) in zip(axes[:, 0], benches.items(), strict=True):
        for place, row in enumerate(rows.values()):
            colours = [COLOURS[holds] for holds in row]
            axis.barh(place, np.diff(edges), left=edges[:-1], height=0.8, color=colours, lw=0)
        axis.set_yticks(range(len(rows)), list(rows))
        axis.invert_yaxis()
        axis.set(xscale="log", xlim=(SPEEDS[0], SPEEDS[-1]))
        axis.set_title(title, loc="left")
    axes[-1, 0].set_xlabel("speed of an impact at 10° (m/s)")
    marks = [Patch(color=COLOURS[each], label=WORDS[each]) for each in WORDS]
    axes[0, 0].legend(handles=marks, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
    return figure


def holding(rows):
    """Return the lowest and the highest speed at which all rows hold, NaN if none."""
    there = SPEEDS[[all(each) for each in zip(*rows.values(), strict=True)]]
    return (there[0], there[-1]) if there.size else (np.nan, np.nan)


def main(folder: str | Path = ".") -> str:
    """Judge impacts of three balls at many speeds, and draw where each assumption holds."""
    benches = {title: verdicts(*bench) for title, bench in BENCHES.items()}
    thick, plate, bead = (holding(rows) for rows in benches.values())
    assert 0.01 < thick[0] < 0.1 < 0.5 < thick[1] < 2.0
    assert plate[0] == thick[0]
    assert plate[1] < 0.1  # waves along the plate, which change psi_2
    assert np.isnan(bead[0])  # too rough at all speeds at which it stays elastic
    save_figure(draw(benches), Path(folder) / "theory_ends.png")
    return f"10 mm: the theory holds from {thick[0]:.2g} to {thick[1]:.2g} m/s"


if __name__ == "__main__":
    if Path(sys.argv[0]).stem == "theory_ends" and len(sys.argv) > 2:
        rows = verdicts(*sys.argv[1:])
        save_figure(draw({", ".join(sys.argv[1:]): rows}), "theory_ends.png")
        low, high = holding(rows)
        some = f"the theory holds from {low:.2g} to {high:.2g} m/s"
        print("at no speed every row holds: see theory_ends.png" if np.isnan(low) else some)
    else:
        print(main())
