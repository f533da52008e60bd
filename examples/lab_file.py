r"""Fit a laboratory's file, with a report
======================================

`carom.fit` reads the table as the laboratory wrote it and returns friction, stiffness and
restitution with intervals; `report` writes all of it to one file.

Columns with other names are translated by `columns`; units stand in the head. The rows are made up,
with a friction of 0.12 and a restitution of 0.95. `fit` needs the extra `[fit]`.
"""

from pathlib import Path

import carom

ROWS = """Winkel zur Platte [°]; v [m/s]; Stoßzahl; Winkel danach [°]; Spin [1/min]
85; 0,60; 0,944; 86,6;  -36
80; 0,60; 0,953; 82,6;  -80
75; 0,60; 0,946; 80,4;    -
70; 0,60; 0,963; 77,1; -207
65; 0,60; 0,942; 73,2; -243
60; 0,60;     -; 69,4; -280
50; 0,60; 0,945; 57,7; -261
40; 0,60; 0,954; 44,8; -219
30; 0,60; 0,953; 32,1; -177
"""
Path("lab_file.csv").write_text(ROWS, encoding="utf-8")

ball = carom.Sphere(radius="10 mm", material="bearing-steel")
pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), friction=0.2)  # a guess
columns = {
    "Winkel zur Platte [°]": "surface_angle",
    "v [m/s]": "speed",
    "Stoßzahl": "normal_restitution",
    "Winkel danach [°]": "surface_angle_out",
    "Spin [1/min]": "spin_out [rpm]",
}
found = carom.fit("lab_file.csv", pair=pair, columns=columns)
print(found)
found.plot("lab_file.png")
found.report("lab_file.html")

# %%
# Check: the interval has the friction with which the rows were made.
assert found.friction.low < 0.12 < found.friction.high
assert abs(found.kappa.value / pair.kappa - 1) < 0.1
assert Path("lab_file.html").stat().st_size > 10_000
