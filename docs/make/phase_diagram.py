"""Write docs/phases.md: the diagram of phases, drawn from the table that the solver follows."""

from pathlib import Path

from carom.dimensionless.elastic.phases import OPPOSITE, SAME, TRANSITIONS, Kind
from carom.dimensionless.states import KIND_NAMES
from carom.quantities.causes import Cause

PAGE = Path(__file__).parents[1] / "phases.md"
HALVES = {False: "loading", True: "unloading"}
SIGNS = {SAME: ", same sign", OPPOSITE: ", opposite sign"}
HEAD = """\
# Diagram of the phases

*Through which phases does an impact go, and what ends each of them?*

The diagram and the table show every transition of the solver: the phase that ends, what ends it,
whether this happens while loading or unloading, and the phase that follows. An impact with
$\\lvert\\psi_1\\rvert \\le 1$ begins with stick, any other with gross slip. The contact may also
separate in any phase: slip and gross slip end so, and stick only where the load retraces its path.
The transitions are derived in [the theory](theory/sequences.md).
"""
TAIL = """
This page is drawn by `python docs/make/phase_diagram.py` from `TRANSITIONS` in
`src/carom/dimensionless/elastic/phases.py`, the one place that decides which phase follows.
"""


def name(kind: Kind) -> str:
    """Return a kind as an identifier of the diagram."""
    return KIND_NAMES[kind].replace(" ", "_")


def page() -> str:
    """Return the whole page."""
    arrows = ["    [*] --> stick: |ψ₁| ≤ 1", "    [*] --> gross_slip: |ψ₁| > 1"]
    rows = ["| phase | ends while | because | then |", "|---|---|---|---|"]
    for (kind, cause, unloading), (after, sign) in TRANSITIONS.items():
        half = HALVES[unloading]
        arrows.append(f"    {name(kind)} --> {name(after)}: {cause.message}, {half}")
        then = KIND_NAMES[after] + SIGNS.get(sign, "")
        rows.append(f"| {KIND_NAMES[kind]} | {half} | {cause.message} | {then} |")
    arrows += [f"    {name(kind)} --> [*]: {Cause.SEPARATION.message}" for kind in KIND_NAMES]
    diagram = ["```mermaid", "stateDiagram-v2", *arrows, "```"]
    return "\n".join([HEAD, *diagram, "", *rows, TAIL])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
